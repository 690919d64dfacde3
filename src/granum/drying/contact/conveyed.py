"""Particles or drops carried by gas through a duct or chamber: their speed, time and heat transfer, cell by cell."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from granum.drying.contact.cells import Contact, Inlet, Network, Profile
from granum.drying.contact.kinetics import AbstractKinetics
from granum.drying.contact.matter import Matter
from granum.particles.formulas.transfer import nusselt_number_ranz_marshall
from granum.streams.stream import Stream

WATER_DENSITY = 997.0
PASSES, AGREED = 8, 0.05  # solutions in turn, and the change (K, kg/kg) below which speeds and drying agree
SLOWEST = 1e-3  # m/s, of a particle against its duct: below it would fall out, which a check reports


class Path(NamedTuple):
    """Where the particles are carried: lengths of the cells, section, how gravity acts along the way, speed at the start, sizes.

    ``dry_size`` and ``dry_density`` are of the dry particle; a wet one is a ball of its solid and water, never smaller than the dry one.
    """

    steps: Any
    section: Any
    gravity: Any  # m/s² along the way, negative when it brakes
    start: Any
    dry_size: Any
    dry_density: Any
    solid_density: Any  # of the solid without pores
    shrinks: bool


def wet_size(path: Path, X: Any) -> Any:
    """Diameter at a moisture."""
    if not path.shrinks:
        return path.dry_size + 0.0 * X
    return path.dry_size * jnp.maximum(1.0, drop_ratio(path.dry_density, path.solid_density, X))


def drop_ratio(dry_density: Any, solid_density: Any, X: Any) -> Any:
    """Diameter of a full drop of solid and water over that of the dry particle it becomes."""
    return (dry_density * (1.0 / solid_density + jnp.maximum(X, 0.0) / WATER_DENSITY)) ** (1.0 / 3.0)


def speeds(path: Path, gas_speed: Any, gas_density: Any, viscosity: Any, X: Any) -> tuple[Any, Any]:
    """Speed of each class at the end of each cell and the time in it: drag of Schiller and Naumann and gravity, relaxed over each cell."""
    d = wet_size(path, X)
    mass = path.dry_density * (path.dry_size / d) ** 3 * (1.0 + X)  # per volume of the wet particle

    def cell(u: Any, given: tuple) -> tuple[Any, tuple[Any, Any]]:
        ug, rho, eta, size, density, length = given

        def through(u_end: Any) -> tuple[Any, Any]:
            mean = jnp.maximum(0.5 * (u + u_end), SLOWEST)
            time = length / mean
            Re = rho * size * jnp.abs(ug - mean) / eta
            relaxation = density * size**2 / (18.0 * eta * (1.0 + 0.15 * jnp.maximum(Re, 1e-12) ** 0.687))
            final = ug + path.gravity * relaxation
            return jnp.maximum(final + (u - final) * jnp.exp(-time / relaxation), SLOWEST), time

        end = u
        for _pass in range(4):  # time and drag of the cell at its mean speed
            end, time = through(end)
        return end, (end, time)

    rows = (gas_speed[:, None], gas_density[:, None], viscosity[:, None], d, mass, path.steps[:, None])
    _last, (ends, times) = jax.lax.scan(cell, jnp.broadcast_to(path.start, d.shape[1:]), rows)
    return ends, times


def convey(
    path: Path,
    matter: Matter,
    kinetics: AbstractKinetics,
    feed: Stream,
    gas: Stream,
    inlet: Inlet,
    solid_flow: Any,
    network: Network,
    heat_loss: Any,
) -> tuple[Profile, Any]:
    """Steady state of particles carried by gas: speeds follow from the gas, the gas from what the particles
    evaporate, in turn until both agree. Also the dry solid under way, kg.
    """
    n = path.steps.shape[0]
    dry = gas.gas_flow - gas.gas[matter.vapor]

    def contact(times: Any, slip: Any) -> Contact:
        def exchange(X: Any, Ts: Any, Tg: Any, Y: Any) -> Any:
            film = 0.5 * (Ts + Tg)
            conductivity, viscosity = gas.mixture.gas_conductivity(film), gas.mixture.gas_viscosity(film)  # type: ignore[misc]
            size = wet_size(path, X)
            density = matter.gas_density(film, Y) * (1.0 + Y)
            prandtl = matter.gas_heat_capacity(film, Y) * viscosity / conductivity
            nusselt = nusselt_number_ranz_marshall.function(density * slip * size / viscosity, prandtl)
            return nusselt * conductivity / size * 6.0 * size**2 / (path.dry_density * path.dry_size**3)

        return Contact(
            matter,
            kinetics,
            solid_flow * times,
            1.0 / times,
            dry,
            network,
            exchange,
            heat_loss=heat_loss * path.steps / jnp.sum(path.steps),
        )

    def motion(state: tuple[Any, Any, Any]) -> tuple[Any, Any]:
        X, Y, Tg = state
        density = matter.gas_density(Tg, Y)
        gas_speed = dry / (density * path.section)
        ends, times = speeds(path, gas_speed, density * (1.0 + Y), gas.mixture.gas_viscosity(Tg), X)  # type: ignore[misc]
        starts = jnp.concatenate([jnp.broadcast_to(path.start, ends[:1].shape), ends[:-1]])
        return times, jnp.abs(gas_speed[:, None] - 0.5 * (starts + ends))

    def again(state: tuple[Any, Any, Any], _pass: Any) -> tuple[tuple[Any, Any, Any], tuple[Profile, Any, Any]]:
        core = contact(*motion(state))
        found = core.steady(inlet)
        change = jnp.max(jnp.abs(found.gas_temperature - state[2])) + jnp.max(jnp.abs(found.moisture - state[0]))
        return (found.moisture, found.humidity, found.gas_temperature), (found, jnp.sum(core.solid), change)

    first = (
        jnp.broadcast_to(inlet.moisture, (n, *jnp.shape(inlet.moisture))),
        jnp.full(n, 1.0) * inlet.humidity,
        jnp.full(n, 1.0) * inlet.gas_temperature,
    )
    _state, passes = jax.lax.scan(again, first, None, length=PASSES)
    found, holdup, change = jax.tree.map(lambda leaf: leaf[-1], passes)
    place = jnp.cumsum(path.steps) / jnp.sum(path.steps)
    return found._replace(place=place, converged=found.converged & (change < AGREED)), holdup
