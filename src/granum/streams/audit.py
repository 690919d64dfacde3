"""Audits: does a unit, or a whole line, conserve every component and energy?"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core.at_once import at_once
from granum.streams.stream import Stream


class Closure(NamedTuple):
    """Relative imbalance: ``mass`` is the worst component, ``energy`` the enthalpy and power balance."""

    mass: Any
    energy: Any
    by_component: Any


def closure(inlets: Iterable[Stream], outlets: Iterable[Stream], power: Any = 0.0) -> Closure:
    """Imbalance between what enters and what leaves, relative to what enters.

    Parameters
    ----------
    inlets, outlets: streams crossing the boundary.
    power: heat and work taken up from outside, W.
    """
    return _closure(tuple(inlets), tuple(outlets), power)


@at_once()
def _closure(inlets: tuple[Stream, ...], outlets: tuple[Stream, ...], power: Any) -> Closure:
    streams = [*inlets, *outlets]
    entering = jnp.array([[1.0] * len(inlets) + [0.0] * len(outlets)])
    components, enthalpies = (
        jnp.stack([getattr(s, name) for s in streams]) for name in ("components", "enthalpy_flow")
    )
    found = closures(
        components, enthalpies, entering, 1.0 - entering, jnp.reshape(jnp.asarray(power, dtype=float), 1)
    )
    return Closure(*(part[0] for part in found))


def closures(components: Any, enthalpies: Any, entering: Any, leaving: Any, powers: Any) -> Closure:
    """Closure of several boundaries at once; a stream without number spoils those that it crosses.

    Parameters
    ----------
    components, enthalpies: mass flow by component (streams × components) and enthalpy flow of every stream.
    entering, leaving: 1 where a stream enters or leaves a boundary (boundaries × streams).
    powers: heat and work that each boundary takes up, W.
    """
    known = jnp.isfinite(jnp.sum(components, axis=1) + enthalpies)
    components, enthalpies = jnp.where(known[:, None], components, 0.0), jnp.where(known, enthalpies, 0.0)
    lost = jnp.where((entering + leaving) @ ~known > 0, jnp.nan, 0.0)
    mass_in, mass_out = entering @ components, leaving @ components
    by_component = (mass_out - mass_in) / jnp.maximum(jnp.sum(mass_in, axis=1, keepdims=True), 1e-300)
    turnover = (entering + leaving) @ jnp.abs(enthalpies) + jnp.abs(powers)
    energy = jnp.abs((leaving - entering) @ enthalpies - powers) / jnp.maximum(turnover, 1e-300)
    return Closure(jnp.max(jnp.abs(by_component), axis=1) + lost, energy + lost, by_component)
