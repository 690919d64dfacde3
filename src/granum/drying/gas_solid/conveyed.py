"""Particles or drops carried by gas through a duct or chamber: their speed, time and heat transfer, cell by
cell.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jax import lax

from granum.drying.gas_solid.cells import (
    ENTHALPY,
    Contact,
    Entering,
    Inlet,
    Network,
    Profile,
    largest_change,
    left,
    march,
)
from granum.drying.gas_solid.kinetics import AbstractKinetics
from granum.drying.gas_solid.matter import Matter
from granum.numerics import Cells, Rates, solve_chain
from granum.particles.formulas.transfer import nusselt_number_ranz_marshall
from granum.streams.stream import Stream

AMBIENT = 298.15  # K, at which the liquid of a drop has its density
# of the solver: where vapor of hot gas condenses on the cold drops above, much water goes round, and at the
# usual 1e-12 the balance of what leaves had closed to 1.5e-9 only
TOLERANCE = 1e-13
TURNS = 40  # of solid and gas
NEAR, ASTRAY = (
    1e-5,
    3.0,
)  # of a change from one turn to the next: Newton's method may begin, or there is no use
LESS_MIXED = (30.0, 10.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01)  # gas exchanged between neighbors over that through
ROUGH, LONG, LONGEST = 1e-6, 300, 2000  # tolerance on the way there, steps on it and of the last attempt
SLOWEST = 1e-3  # m/s, of a particle against its duct: below it would fall out, which a check reports


class Path(NamedTuple):
    """Where the particles are carried: lengths of the cells, section, how gravity acts along the way, speed
    at the start, sizes.

    ``dry_size`` and ``dry_density`` are of the dry particle; a wet one is a ball of its solid and liquid,
    never smaller than the dry one.
    """

    steps: Any
    section: Any
    gravity: Any  # m/s² along the way, negative when it brakes
    start: Any
    dry_size: Any
    dry_density: Any
    solid_density: Any  # of the solid without pores
    liquid_density: Any
    shrinks: bool
    gas_way: float = 1.0  # −1 for gas that flows against the particles


def wet_size(path: Path, X: Any) -> Any:
    """Diameter at a moisture."""
    if not path.shrinks:
        return path.dry_size + 0.0 * X
    return path.dry_size * jnp.maximum(
        1.0, drop_ratio(path.dry_density, path.solid_density, path.liquid_density, X)
    )


def liquid_density(feed: Stream) -> Any:
    """Of the liquid that evaporates."""
    feed.mixture.require("liquids")
    return feed.mixture.densities("liquids", AMBIENT)[0]


def drop_ratio(dry_density: Any, solid_density: Any, liquid_density: Any, X: Any) -> Any:
    """Diameter of a full drop of solid and liquid over that of the dry particle it becomes."""
    return (dry_density * (1.0 / solid_density + jnp.maximum(X, 0.0) / liquid_density)) ** (1.0 / 3.0)


def relaxed(path: Path, gas: Flight, before: Any, own: Any, X: Any) -> tuple[Any, Any]:
    """Speed of each class at the end of a cell entered at a speed, and the time in it: drag of Schiller and
    Naumann at the mean speed, and gravity. ``own`` is the speed at the end as far as it is known; at the
    solution both agree.
    """
    d = wet_size(path, X)
    density = path.dry_density * (path.dry_size / d) ** 3 * (1.0 + X)  # mass per volume of the wet particle
    mean = jnp.maximum(0.5 * (before + own), SLOWEST)
    time = gas.length / mean
    Re = gas.density * d * jnp.hypot(gas.speed - mean, SLOWEST) / gas.viscosity
    relaxation = density * d**2 / (18.0 * gas.viscosity * (1.0 + 0.15 * jnp.maximum(Re, 1e-12) ** 0.687))
    final = gas.speed + path.gravity * relaxation
    return jnp.maximum(final + (before - final) * jnp.exp(-time / relaxation), SLOWEST), time


class Flight(NamedTuple):
    """Gas that carries the particles through cells of a length (cells × 1)."""

    speed: Any
    density: Any  # with its vapor
    viscosity: Any
    length: Any


def convey(
    path: Path,
    matter: Matter,
    kinetics: AbstractKinetics,
    gas: Stream,
    inlet: Inlet,
    solid_flow: Any,
    network: Network,
    heat_loss: Any,
) -> tuple[Profile, Any]:
    """Steady state of particles carried by gas; their speeds are unknowns beside moisture and temperature.
    Also the dry solid under way, kg.

    Without dispersion of the gas every cell depends on the one before alone, and they are solved one after
    the other. Against gas this is only the guess, the gas of it turned around.
    """
    n, m = path.steps.shape[0], path.dry_size.shape[0]
    dry = matter.humid.carrier_flow(gas)
    shape = (m,)
    viscosity_of, conductivity_of = gas.mixture.gas_viscosity, gas.mixture.gas_conductivity
    assert viscosity_of is not None
    assert conductivity_of is not None

    def contact(times: Any, slip: Any, network: Network, lengths: Any) -> Contact:
        def exchange(X: Any, Ts: Any, Tg: Any, Y: Any) -> Any:
            film = 0.5 * (Ts + Tg)
            conductivity, viscosity = (of(matter.gas_shares, film) for of in (conductivity_of, viscosity_of))
            size = wet_size(path, X)
            density = matter.gas_density(film, Y) * (1.0 + Y)
            prandtl = matter.gas_heat_capacity(film, Y) * viscosity / conductivity
            nusselt = nusselt_number_ranz_marshall.function(density * slip * size / viscosity, prandtl)
            return nusselt * conductivity / size * 6.0 * size**2 / (path.dry_density * path.dry_size**3)

        lost = heat_loss * lengths[:, 0] / jnp.sum(path.steps)
        return Contact(
            matter, kinetics, solid_flow * times, 1.0 / times, dry, network, exchange, heat_loss=lost
        )

    def split(v: Cells, first: Any, network: Network, lengths: Any) -> tuple[Contact, Any, Any]:
        """The core for speeds at the ends of the cells, what these lack, and the times in the cells."""
        X, own, Y = v.lanes[..., 0], v.lanes[..., 2], v.shared[:, :1]
        Tg = matter.gas_temperature(ENTHALPY * v.shared[:, 1:], Y)
        density = matter.gas_density(Tg, Y)
        gas_speed = path.gas_way * dry / (density * path.section)
        before = jnp.concatenate([jnp.broadcast_to(first, (1, m)), own[:-1]])
        ends, times = relaxed(
            path,
            Flight(gas_speed, density * (1.0 + Y), viscosity_of(matter.gas_shares, Tg), lengths),
            before,
            own,
            X,
        )
        slip = jnp.hypot(gas_speed - 0.5 * (before + own), SLOWEST)
        return contact(times, slip, network, lengths), (ends - own) / times, times

    def rates(v: Cells, fresh: Entering, first: Any, network: Network, lengths: Any) -> Rates:
        core, lack, times = split(v, first, network, lengths)
        found = core.rates(v, fresh)
        # Newton's method sees the balance of a whole passage, which is linear in what solid and gas carry
        # off: so it closes with every step, however fast the finest drops change
        lanes = found.lanes * (times / lax.stop_gradient(times))[..., None]
        return found._replace(lanes=jnp.concatenate([lanes, lack[..., None]], axis=-1))

    lengths = path.steps[:, None]
    still = contact(jnp.ones((n, m)), 1.0, network, lengths)
    fresh, start = still.entering(inlet), jnp.broadcast_to(path.start, shape)
    begin = still.start(inlet)
    first = Cells(jnp.concatenate([begin.lanes[0], start[:, None]], axis=-1), begin.shared[0])
    moving = largest_change(inlet.moisture, jnp.asarray(jnp.inf))
    fastest = jnp.maximum(
        jnp.max(start), dry / (matter.gas_density(inlet.gas_temperature, inlet.humidity) * path.section)
    )
    alone = Network.co_current(1)

    def cell(v: Cells, before: Cells, length: Any) -> Rates:
        return rates(v, left(before), before.lanes[:, 2], alone, length[None])

    states, converged = march(cell, first, lengths, 0.1 * path.steps / fastest, moving)
    # from the dryer without dispersion, its gas mixed with that at the end in proportion
    if not network.one_way:
        against = path.gas_way < 0.0
        exchanged = network.from_before[-1] if against else network.from_after[0]
        share, gas_guess = 1.0 / (1.0 + exchanged), states.shared
        mixed = share * gas_guess + (1.0 - share) * gas_guess[-1]
        guess = states._replace(shared=mixed[::-1] if against else mixed)

        def in_gas(v: Cells, before: Cells, row: Any) -> Rates:
            """A cell whose gas is given."""
            length, known = row
            found = cell(v._replace(shared=known[None]), before, length)
            return Rates(found.lanes, 0.0 * found.parts, known[None] - v.shared)

        def solids(given: Any, most: Any) -> Cells:
            met, _well = march(in_gas, first, (lengths, given), 0.1 * path.steps / fastest, moving, most)
            return met._replace(shared=given)

        def gas_of(met: Cells) -> Any:
            """The gas that takes what these solids give."""
            found = rates(met, fresh, start, network, lengths)
            at_rest = found.shared + jnp.sum(found.parts, axis=1)
            return met.shared - jnp.linalg.solve(network.matrix(), at_rest)

        def solve(flow: Any, guess: Cells, tolerance: Any, most: Any) -> tuple[Cells, Any]:
            found = solve_chain(
                lambda v: rates(v, fresh, start, network.dispersed(flow), lengths),
                guess,
                Cells(1.0, lengths / fastest),
                first_step=0.1 * jnp.min(path.steps) / fastest,
                largest_change=moving,
                tolerance=tolerance,
                max_steps=most,
            )
            return found.state, found.converged

        states, converged = turns(solids, gas_of, solve, guess)
    core, _lack, _times = split(states, start, network, lengths)
    place = jnp.cumsum(path.steps) / jnp.sum(path.steps)
    return core.profile(states, converged)._replace(place=place), jnp.sum(core.solid)


def turns(
    solids: Callable[[Any, Any], Cells],
    gas_of: Callable[[Cells], Any],
    solve: Callable[..., tuple[Cells, Any]],
    guess: Cells,
) -> tuple[Cells, Any]:
    """Solid and gas that meet from both ends: first by turns, the solid through a gas that is known and the
    gas over a solid that is, then together by Newton's method. Where that fails, for water goes round
    between a hot foot and a cold head, from a gas that is mixed and is so ever less.

    Parameters
    ----------
    solids: the steady state of the solid in a gas, in so many steps a cell. gas_of: the gas for such a state.
    solve: the steady state with so much gas exchanged between neighbors, from a guess, to a tolerance, in so
        many steps. Work that is not needed takes no steps, so that a batch waits for nothing else.
    """

    def turn(carry: tuple[Cells, Any], _row: None) -> tuple[tuple[Cells, Any], None]:
        before, change = carry
        on = (change > NEAR) & (change < ASTRAY)
        met = solids(before.shared, jnp.where(on, LONG, 0))
        new = gas_of(met)
        after = met._replace(shared=0.5 * (before.shared + new)), jnp.max(abs(new - before.shared))
        return jax.tree.map(lambda a, b: jnp.where(on, a, b), after, (before, change)), None

    (near, change), _none = lax.scan(turn, (guess, jnp.asarray(0.5 * ASTRAY)), None, TURNS)
    first = jax.tree.map(lambda a, b: jnp.where(change <= NEAR, a, b), near, guess)

    def stage(carry: tuple[Cells, Any], row: tuple[Any, ...]) -> tuple[tuple[Cells, Any], None]:
        states, done = carry
        flow, tolerance, most, last, anew = row
        begin = jax.tree.map(lambda a, b: jnp.where(anew & ~done, a, b), guess, states)
        found, well = solve(flow, begin, tolerance, jnp.where(done, 0, most))
        kept = jax.tree.map(lambda a, b: jnp.where(done, a, b), states, found)
        return (kept, done | (well & last)), None

    flows = jnp.asarray([0.0, *LESS_MIXED, 0.0])
    plain, number = flows == 0.0, jnp.arange(len(flows))
    most = jnp.where(number == len(flows) - 1, LONGEST, LONG)
    rows = flows, jnp.where(plain, TOLERANCE, ROUGH), most, plain, number == 1
    return lax.scan(stage, (first, jnp.asarray(False)), rows)[0]
