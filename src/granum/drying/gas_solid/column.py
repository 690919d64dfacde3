"""Gas blown through a layer that is carried along or lies still: layers of standing solid in time, the core
without flow of solid.

A column that travels through a dryer sees in time what the dryer shows along its length, so one sweep in time
gives the steady dryer.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from granum.drying.gas_solid.cells import ENTHALPY, Contact, Inlet, Network, Profile


class Zone(NamedTuple):
    """A stretch of the dryer: time in it, dry gas per dry solid and second, whether the gas enters at the
    last layer, and its state.
    """

    duration: Any
    gas_per_solid: Any
    backwards: Any  # whether
    humidity: Any
    temperature: Any


class Passage(NamedTuple):
    """What leaves a zone per kg of dry solid that passed, and how it got there (steps × layers)."""

    layers: Profile
    time: Any
    gas_per_solid: Any
    vapor: Any
    gas_enthalpy: Any  # J


def pass_zones(like: Contact, X: Any, T: Any, zones: Sequence[Zone], steps: int) -> list[Passage]:
    """Take a column of one kilogram of dry solid, of moisture X and temperature T at first, through zones one
    after the other.

    ``like`` gives matter, kinetics, exchange and the shares of solid in its layers (layers × 1).
    """
    n = like.solid.shape[0]
    edges = (jnp.arange(steps + 1) / steps) ** 2  # short steps where a zone begins
    up, down = Network.counter_current(n), Network.co_current(n)

    def through(carry: tuple[Any, Any], zone: Zone) -> tuple[tuple[Any, Any], tuple[Profile, Any]]:
        X, T = carry
        network = Network(
            jnp.where(zone.backwards, up.from_before, down.from_before),
            jnp.where(zone.backwards, up.from_after, down.from_after),
            jnp.where(zone.backwards, up.inlet, down.inlet),
            jnp.where(zone.backwards, up.outlet, down.outlet),
        )
        column = Contact(
            like.matter,
            like.kinetics,
            like.solid,
            jnp.zeros((n, 1)),
            zone.gas_per_solid,
            network,
            like.exchange,
            like.wall_exchange,
            like.wall_temperature,
            like.heat_loss,
        )
        # gas at rest with the solid, so that the first step is mild
        start = column.state(X, T, jnp.full(n, 1.0) * zone.humidity, T[:, 0])
        inlets = Inlet(
            *(
                jnp.broadcast_to(v, (steps, *jnp.shape(v)))
                for v in (X[0], T[0], zone.humidity, zone.temperature)
            )
        )
        layers, totals = column.dynamic(start, inlets, zone.duration * jnp.diff(edges))
        return (layers.moisture[-1], layers.temperature[-1]), (layers, totals[-1])

    stacked = Zone(
        *(jnp.stack([jnp.asarray(v, dtype=float) for v in values]) for values in zip(*zones, strict=True))
    )
    stacked = stacked._replace(backwards=stacked.backwards > 0.5)
    _end, (layers, totals) = jax.lax.scan(
        through, (jnp.broadcast_to(X, (n, 1)) + 0.0, jnp.broadcast_to(T, (n, 1)) + 0.0), stacked
    )
    found, clock = [], 0.0
    for i, zone in enumerate(zones):
        here = jax.tree.map(lambda leaf, i=i: leaf[i], layers)
        found.append(
            Passage(
                here,
                clock + zone.duration * edges[1:],
                zone.gas_per_solid,
                totals[i, -2],
                ENTHALPY * totals[i, -1],
            )
        )
        clock = clock + zone.duration
    return found


def mean_moisture(like: Contact, passage: Passage) -> Any:
    """Of the layers, over the steps."""
    return jnp.sum(passage.layers.moisture[..., 0] * like.solid[:, 0], axis=1)


def product_enthalpy(like: Contact, passage: Passage) -> Any:
    """Of the column at the end, J per kg of dry solid."""
    last = jax.tree.map(lambda leaf: leaf[-1], (passage.layers.moisture, passage.layers.temperature))
    return jnp.sum(like.solid * like.matter.moist_solid(last[1], last[0]))
