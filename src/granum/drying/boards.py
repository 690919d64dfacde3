"""Boards that dry in a kiln by a schedule: water diffuses where the wood is below fiber saturation."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from granum.drying.formulas.wood import Schedule, air_at, airs_of, fiber_saturation, wood_diffusivity
from granum.numerics import safe_divide

CELLS = 24  # in half a board
STEPS = 500  # in which the mean would fall evenly if nothing slowed it
PATIENCE = 3  # times as many steps at most
LEAST = 1e-12  # kg/(m² s)
# of the time of diffusion, that a step takes where the surface is drier than the air of the next step asks
LONGEST = 0.01
LATENT = 2.4e6  # J/kg, of the water that the film lets pass
DAY = 86400.0
CHECKS = 0.45  # kg/kg, down to which boards of oak get surface checks (Wengert)


class Board(NamedTuple):
    """Half thickness, dry mass per green volume, heat transfer coefficient, and the three numbers of the
    diffusivity.
    """

    half_thickness: Any
    density: Any
    heat_transfer: Any
    diffusivity: tuple[Any, Any, Any]


class BoardDrying(NamedTuple):
    """Over time, from green on: time, mean moisture, that of core and surface, and temperature, wet bulb and
    relative humidity of the air of the step that ends there.
    """

    time: Any
    moisture: Any
    core: Any
    surface: Any
    temperature: Any
    wet_bulb: Any
    relative_humidity: Any


class _State(NamedTuple):
    moisture: Any
    time: Any


def followed(board: Board, schedule: Schedule, first: Any, last: Any, pressure: Any) -> BoardDrying:
    """A board from a moisture to another, dt by dt such that the mean falls evenly; it stays where it is once
    it is there.

    Within a step the flow follows the moistures at its end, with the diffusivity and the saturation of its
    beginning: what leaves a cell enters the next, to rounding.
    """
    n, L = CELLS, board.half_thickness
    width = L / n
    mass = board.density * width  # dry, per area of a cell
    fall, airs = (first - last) / STEPS, airs_of(schedule, pressure)

    def step(state: _State, _none: None) -> tuple[_State, Any]:
        X = state.moisture
        mean = jnp.mean(X)
        air = air_at(schedule, airs, mean)
        full, low = fiber_saturation.function(air.temperature), air.moisture_dry_basis_equilibrium
        moving = (full > X).astype(float)
        potential = jnp.minimum(X, full)
        within = board.density * wood_diffusivity.function(air.temperature, potential, *board.diffusivity)
        inner = 2.0 / (1.0 / within[:-1] + 1.0 / within[1:]) / width
        film = (
            board.heat_transfer
            * (air.temperature - air.wet_bulb_temperature)
            / LATENT
            / jnp.maximum(full - low, 0.02)
        )
        outer = 1.0 / (1.0 / film + 0.5 * width / within[-1])
        flow = jnp.append(inner * (potential[:-1] - potential[1:]), outer * (potential[-1] - low))
        even = fall * board.density * L / jnp.maximum(flow[-1], LEAST)
        longest = LONGEST * L**2 * board.density / jnp.max(within)
        dt = jnp.where(mean > last, jnp.minimum(even, longest), 0.0)
        # flows at the end of the step are linear in what each cell loses
        matrix = jnp.zeros((n, n))
        k = jnp.arange(n)
        right = jnp.append(inner, outer) * moving
        left = jnp.append(0.0, inner) * moving
        matrix = matrix.at[k, k].add(right + left)
        matrix = matrix.at[k[:-1], k[1:]].add(-inner * moving[1:])
        matrix = matrix.at[k[1:], k[:-1]].add(-inner * moving[:-1])
        net = jnp.diff(flow, prepend=0.0)
        change = -jnp.linalg.solve(jnp.eye(n) * mass + dt * matrix, dt * net)
        new = _State(X + change, state.time + dt)
        skin = low + outer / film * (jnp.minimum(new.moisture[-1], full) - low)
        found = BoardDrying(
            new.time,
            jnp.mean(new.moisture),
            new.moisture[0],
            skin,
            air.temperature,
            air.wet_bulb_temperature,
            air.relative_humidity,
        )
        return new, found

    start = _State(jnp.full(n, 1.0) * first, jnp.zeros(()))
    _end, found = jax.lax.scan(step, start, None, length=PATIENCE * STEPS)
    return found


def reached(found: BoardDrying, first: Any, last: Any) -> tuple[Any, Any]:
    """Time at which the mean has a moisture, and whether it does."""
    time, X = jnp.append(0.0, found.time), jnp.append(first, found.moisture)
    at = jnp.argmax(last >= X)
    here, before = X[at], X[jnp.maximum(at - 1, 0)]
    part = jnp.clip(safe_divide(before - last, before - here), 0.0, 1.0)
    known = jnp.any(last >= X)
    return time[jnp.maximum(at - 1, 0)] + part * (time[at] - time[jnp.maximum(at - 1, 0)]), known


def most_in_a_day(found: BoardDrying, first: Any, last: Any) -> Any:
    """Largest fall of the mean in a day, while it is so wet that its surface may check; the first day, which
    dries the skin, is not counted.
    """
    time, X = jnp.append(0.0, found.time), jnp.maximum(jnp.append(first, found.moisture), last)
    fallen = X - jnp.interp(time + DAY, time, X)
    return jnp.max(jnp.where((time >= DAY) & (X > CHECKS), fallen, 0.0))
