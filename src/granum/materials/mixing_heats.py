"""Heat of mixing of solutions whose enthalpy was measured as a whole, over that of their parts.

Elsewhere the enthalpies of solvent and solute add up, and diluting gives off no heat.
"""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax.numpy as jnp

from granum.core.constants import ZERO_CELSIUS
from granum.materials.formulas.caustic import STRONGEST, specific_enthalpy

DILUTE = 1e-4  # mass fraction at which the solute is in much water
THINNEST = 1e-7


class CausticMixing(eqx.Module):
    """Of sodium hydroxide in water. ``heat_capacity`` is that by which the solute counts elsewhere, J/(kg K).

    Beyond the strongest solution that was measured a kilogram of solute keeps what it has there.
    """

    heat_capacity: float
    coldest, hottest = 273.15, 477.15

    def __call__(self, temperature: Any, solute: Any, solvent: Any) -> Any:
        """What these amounts (kg or kg/s) hold over their parts, J or W; nothing in much water at 25 °C."""
        total = solute + solvent
        w = jnp.clip(solute / jnp.where(total > 0.0, total, 1.0), THINNEST, STRONGEST)
        return solute * (self._apparent(temperature, w) - self._apparent(298.15, DILUTE))

    def _apparent(self, temperature: Any, w: Any) -> Any:
        T = jnp.clip(jnp.asarray(temperature, dtype=float), self.coldest, self.hottest)
        h = specific_enthalpy
        return (h(T, w) - (1.0 - w) * h(T, 0.0 * w)) / w - self.heat_capacity * (T - ZERO_CELSIUS)
