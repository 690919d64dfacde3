"""Liquids that do not follow Newton, in which solids settle: power law, Bingham, Herschel and Bulkley."""

from __future__ import annotations

from dataclasses import KW_ONLY
from typing import Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core.errors import CaseError
from granum.core.i18n import _
from granum.core.kinds import DynamicViscosity, FlowIndex, YieldStress
from granum.numerics import safe_power
from granum.numerics.smooth import safe_divide
from granum.particles.formulas.non_newtonian import (
    AROUND,
    reynolds_number_power_law,
    terminal_velocity_ansley_smith,
    terminal_velocity_renaud,
)


class Carrier(NamedTuple):
    """Consistency, Pa s at 1/s, flow index and yield stress of a liquid; none of the last is a power law."""

    consistency: Any
    flow_index: Any
    yield_stress: Any

    def falling(self, size: Any, density: Any, liquid: Any, there: Any) -> tuple[Any, Any]:
        """Terminal velocity of each class, m/s, and the number that stands for its Reynolds number.

        What is not there falls as the mean of what is: it shall not be told to lie outside the range of a
        law, nor to be held.
        """
        count = jnp.maximum(jnp.sum(there), 1)
        mean = jnp.sum(jnp.where(there, size, 0.0)) / count
        size = jnp.where(there, size, jnp.where(mean > 0.0, mean, 1e-4))
        if self.yield_stress is None:
            alone = terminal_velocity_renaud(size, density, liquid, self.consistency, self.flow_index)
            return alone, reynolds_number_power_law(
                size, jnp.abs(alone), liquid, self.consistency, self.flow_index
            )
        held = jnp.where(there, self.yield_stress, 0.0)
        alone = terminal_velocity_ansley_smith(size, density, liquid, self.consistency, held, self.flow_index)
        speed = jnp.abs(alone)
        resisting = self.consistency * safe_power(speed / size, self.flow_index) + AROUND * held
        return alone, jnp.where(speed > 0.0, liquid * speed**2 / jnp.maximum(resisting, 1e-30), 0.0)

    def between_plates(self, velocity: Any, gap: Any) -> Any:
        """Viscosity of a liquid of Newton that would flow between wide plates with the same friction,
        Pa s: a power law as it is, a yield stress added to it at the wall, which is a little too little.
        """
        n = self.flow_index
        newton = 6.0 * velocity / gap  # shear rate at the wall of a liquid of Newton
        wall = self.consistency * safe_power((2.0 * n + 1.0) / (3.0 * n) * newton, n)
        return safe_divide(wall + (0.0 if self.yield_stress is None else self.yield_stress), newton)


class Carried(eqx.Module):
    """Abstract settler whose liquid may thin as it is sheared or hold grains by a yield stress:
    ``consistency``, its viscosity at 1/s, with ``flow_index`` for a power law, with ``yield_stress`` for a
    Bingham liquid, with both for that of Herschel and Bulkley.
    """

    _: KW_ONLY
    consistency: DynamicViscosity | None = None
    flow_index: FlowIndex | None = None
    yield_stress: YieldStress | None = None

    @property
    def carrier(self) -> Carrier | None:
        """The liquid, unless it is one of Newton."""
        eta, n, stress = self.consistency, self.flow_index, self.yield_stress
        if eta is None and n is None and stress is None:
            return None
        if eta is None:
            raise CaseError(
                _("A liquid with 'flow_index' or 'yield_stress' needs its 'consistency': give it too.")
            )
        if n is None and stress is None:
            raise CaseError(
                _(
                    "'consistency' alone does not tell what liquid it is: give 'flow_index' for a power law, "
                    "'yield_stress' for a Bingham liquid, or both."
                )
            )
        return Carrier(eta, 1.0 if n is None else n, stress)
