"""Audits: does a unit, or a whole line, conserve every component and energy?"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import jax.numpy as jnp

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
    inlets, outlets = list(inlets), list(outlets)
    mass_in = sum((s.components for s in inlets), jnp.zeros(()))
    mass_out = sum((s.components for s in outlets), jnp.zeros(()))
    total = jnp.maximum(jnp.sum(mass_in), 1e-300)
    by_component = (mass_out - mass_in) / total
    energy_in = sum((s.enthalpy_flow for s in inlets), jnp.zeros(()))
    energy_out = sum((s.enthalpy_flow for s in outlets), jnp.zeros(()))
    turnover = sum((jnp.abs(s.enthalpy_flow) for s in (*inlets, *outlets)), jnp.abs(power))
    energy = (energy_out - energy_in - power) / jnp.maximum(turnover, 1e-300)
    return Closure(jnp.max(jnp.abs(by_component)), jnp.abs(energy), by_component)
