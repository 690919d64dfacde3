"""Compression of a settled bed: effective stress of the solids network, the laws of the family
``solids_stress``.

Above a critical concentration flocs touch and carry weight. A law gives the slope of the effective stress
with concentration; the bed spreads with the diffusivity ``d = v ρ_s σ'/(g Δρ)``.
"""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax.numpy as jnp

from granum.core import law
from granum.core.kinds import Concentration, PositiveNumber, PressureDifference
from granum.numerics import safe_power


@law(
    "solids_stress",
    name="logarithmic_stress",
    source="burger2011; declercq2008",
    equation=r"\sigma_e = \alpha\,\ln\frac{C - C_c + \beta}{\beta},\quad C > C_c",
    symbols={"stress_scale": r"\alpha"},
    title="Logarithmic effective stress",
)
class LogarithmicStress(eqx.Module):
    """Effective stress of activated sludge growing as a logarithm above the critical concentration.

    >>> round(float(LogarithmicStress(6.0, 4.0, 4.0)(10.0)), 4)
    2.7726
    """

    critical_concentration: Concentration
    stress_scale: PressureDifference
    stress_concentration: Concentration

    def __call__(self, solids_concentration: Concentration) -> PressureDifference:
        """Stress at a concentration; zero below the critical one."""
        over = jnp.maximum(jnp.asarray(solids_concentration) - self.critical_concentration, 0.0)
        return self.stress_scale * jnp.log1p(over / self.stress_concentration)

    def slope(self, concentration: Any) -> Any:
        """``dσ/dC`` just above the given concentration, which is at least the critical one, m²/s²."""
        return self.stress_scale / (self.stress_concentration + concentration - self.critical_concentration)


@law(
    "solids_stress",
    name="power_stress",
    source="burger2000",
    equation=r"\sigma_e = \sigma_0\left[(C/C_c)^m - 1\right],\quad C > C_c",
    title="Power-law effective stress",
)
class PowerStress(eqx.Module):
    """Effective stress of mineral slurries growing as a power above the critical (gel) concentration.

    The same form, on volume fraction, is the compressive yield stress of flocculated networks.

    >>> round(float(PowerStress(200.0, 5.0, 6.0)(300.0)), 3)
    51.953
    """

    critical_concentration: Concentration
    stress_scale: PressureDifference
    stress_exponent: PositiveNumber

    def __call__(self, solids_concentration: Concentration) -> PressureDifference:
        """Stress at a concentration; zero below the critical one."""
        ratio = jnp.maximum(jnp.asarray(solids_concentration) / self.critical_concentration, 1.0)
        return self.stress_scale * (safe_power(ratio, self.stress_exponent) - 1.0)

    def slope(self, concentration: Any) -> Any:
        """``dσ/dC`` just above the given concentration, which is at least the critical one, m²/s²."""
        ratio = concentration / self.critical_concentration
        return (
            self.stress_scale
            * self.stress_exponent
            / self.critical_concentration
            * safe_power(ratio, self.stress_exponent - 1.0)
        )
