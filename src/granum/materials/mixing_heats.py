"""Heat of mixing of solutions, over the enthalpies of their parts.

Elsewhere the enthalpies of solvent and solute add up, and diluting gives off no heat.
"""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.core.constants import ZERO_CELSIUS
from granum.materials.activities import ElectrolyteActivity
from granum.materials.formulas.caustic import STRONGEST, caustic_enthalpy_olsson, specific_enthalpy
from granum.numerics.smooth import safe_divide

ROOM = 298.15
DILUTE = 1e-4  # mass fraction at which the solute is in much water
THINNEST = 1e-7


class CausticMixing(eqx.Module):
    """Of sodium hydroxide in water. ``heat_capacity`` is that by which the solute counts elsewhere, J/(kg K).

    Beyond the strongest solution that was measured a kilogram of solute keeps what it has there.
    """

    heat_capacity: float
    coldest, hottest = 273.15, 477.15
    others = True

    def __call__(self, temperature: Any, solute: Any, solvent: Any) -> Any:
        """What these amounts (kg or kg/s) hold over their parts, J or W; nothing in much water at 25 °C."""
        total = solute + solvent
        w = jnp.clip(solute / jnp.where(total > 0.0, total, 1.0), THINNEST, STRONGEST)
        return solute * (self._apparent(temperature, w) - self._apparent(ROOM, DILUTE))

    def heard(self, temperature: Any, solute: Any, solvent: Any) -> None:
        """Flag a liquor outside the data."""
        caustic_enthalpy_olsson(temperature, safe_divide(solute, solute + solvent, 0.0))

    def _apparent(self, temperature: Any, w: Any) -> Any:
        T = jnp.clip(jnp.asarray(temperature, dtype=float), self.coldest, self.hottest)
        h = specific_enthalpy
        return (h(T, w) - (1.0 - w) * h(T, 0.0 * w)) / w - self.heat_capacity * (T - ZERO_CELSIUS)


class ElectrolyteMixing(eqx.Module):
    """Of a salt in water, by the slope of its activities with temperature. The solute counts elsewhere with
    the heat capacity that it has in a solution of the molality ``strong``.

    Beyond the temperatures of the activities it keeps what it has at their end; beyond their molality it goes
    on with the slope that it has there over the mass fraction.
    """

    activity: ElectrolyteActivity
    coldest: float = eqx.field(static=True)
    strong: float
    others = False
    """Whether it holds beside other salts."""

    def __call__(self, temperature: Any, solute: Any, solvent: Any) -> Any:
        """What these amounts (kg or kg/s) hold over their parts, J or W; nothing in much water at 25 °C."""
        law = self.activity
        m = jnp.minimum(self._molality(solute, solvent), law.most)
        T = jnp.clip(jnp.asarray(temperature, dtype=float), self.coldest, law.hottest)
        total, strongest = solute + solvent, law.most * law.molar_mass
        beyond = safe_divide(solute, total, 0.0) - strongest / (1.0 + strongest)
        further = jnp.maximum(beyond, 0.0) * (1.0 + strongest) ** 2 / law.molar_mass
        both = jnp.stack([T, jnp.full_like(T, ROOM)])
        slopes = law.slopes(both)
        here = [slope[0] for slope in slopes]
        held, slope = jax.jvp(lambda m: law.apparent_enthalpy(T, m, here), (m,), (further,))
        strong, strong_at_room = law.apparent_enthalpy(both, self.strong, slopes)
        return solute / law.molar_mass * (held + slope - strong + strong_at_room)

    def heard(self, temperature: Any, solute: Any, solvent: Any) -> None:
        """Flag a solution outside the temperatures and the molality of the activities."""
        self.activity.heard(temperature, self._molality(solute, solvent))

    def _molality(self, solute: Any, solvent: Any) -> Any:
        """Of no solution that of the strongest."""
        law = self.activity
        return safe_divide(solute, solvent * law.molar_mass, jnp.where(solute > 0.0, law.most, 0.0))
