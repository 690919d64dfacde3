"""A full, mixed volume of slurry in time, by the trapezoidal rule: what is held changes by exactly what
enters and leaves.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.streams.mixture import Mixture
from granum.streams.stream import Stream


class Held(NamedTuple):
    """Contents of a basin: kg of each species and class, and their temperature."""

    solid: Any
    liquid: Any
    temperature: Any


def filled(mixture: Mixture, volume: Any, temperature: Any = 298.15) -> Held:
    """The volume full of the first liquid."""
    liquid = jnp.zeros(len(mixture.liquids)).at[0].set(volume * mixture.densities("liquids", temperature)[0])
    return Held(jnp.zeros(mixture.solid_shape), liquid, jnp.asarray(temperature, dtype=float))


def at_rest(feed: Stream, volume: Any) -> Held:
    """The volume full of a feed."""
    time = volume / jnp.maximum(feed.slurry_volume_flow, 1e-12)
    return Held(feed.solid * time, feed.liquid * time, jnp.asarray(feed.temperature, dtype=float))


def trapezoid(held: Any, entered: Any, lost: Any, losing: Any, step: Any) -> Any:
    """What is held after a step: flows entering at both ends summed, shares lost per second at its start and
    at its end.

    Not a number where the step is longer than twice the time of turnover.
    """
    left = 1.0 - 0.5 * step * lost
    return (held * jnp.where(left >= 0, left, jnp.nan) + 0.5 * step * entered) / (1.0 + 0.5 * step * losing)


def mixed(held: Held, then: Stream, now: Stream, volume: Any, step: Any) -> tuple[Held, Stream]:
    """The contents after a step in which the inlet changed from one stream to another, and what flows out
    then. Gas passes at once.
    """
    early, late = then.slurry_volume_flow / volume, now.slurry_volume_flow / volume
    solid = trapezoid(held.solid, then.solid + now.solid, early, late, step)
    liquid = trapezoid(held.liquid, then.liquid + now.liquid, early, late, step)
    before = now.replace(
        solid=held.solid, liquid=held.liquid, gas=0.0 * now.gas, temperature=held.temperature
    )
    heat = trapezoid(
        before.enthalpy_flow,
        _condensed(then).enthalpy_flow + _condensed(now).enthalpy_flow,
        early,
        late,
        step,
    )
    inside = before.replace(solid=solid, liquid=liquid).at_enthalpy(heat)
    return Held(solid, liquid, inside.temperature), inside.part(late, late).replace(gas=now.gas)


def _condensed(stream: Stream) -> Stream:
    return stream.replace(gas=0.0 * stream.gas)


def mass(held: Held) -> Any:
    """kg."""
    return jnp.sum(held.solid) + jnp.sum(held.liquid)
