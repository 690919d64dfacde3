"""``Solid``: a solid substance, as crystals, mineral or product."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.core.at_once import at_once
from granum.core.constants import GAS_CONSTANT, ZERO_CELSIUS
from granum.core.i18n import _, current_language
from granum.materials.correlation import Correlation, Missing, as_temperature
from granum.numerics import gauss_legendre

Property = Correlation | Missing


class Solid(eqx.Module):
    """A solid. ``density``, ``heat_capacity``, ``conductivity`` and ``sublimation_pressure`` are functions of
    temperature.

    Parameters
    ----------
    name, french, formula: what it is.
    molar_mass: kg/mol; NaN for rocks, foods and polymers.
    sphericity: ordinary value for its crushed or crystallized particles; NaN when not given.
    mohs_hardness: on Mohs' scale; NaN when not given.
    dust: the tested dust that its own burns like, by name; empty for what does not burn or is not known.
    """

    name: str = eqx.field(static=True)
    french: str = eqx.field(static=True)
    formula: str = eqx.field(static=True)
    molar_mass: float
    sphericity: float
    mohs_hardness: float
    density: Property
    heat_capacity: Property
    conductivity: Property
    sublimation_pressure: Property
    dust: str = eqx.field(static=True, default="")

    @property
    def label(self) -> str:
        """Its name in the current language."""
        return self.french if current_language() == "fr" and self.french else self.name

    @at_once(temperature=as_temperature)
    def enthalpy(self, temperature: Any) -> Any:
        """Specific enthalpy, J/kg, zero at 0 °C."""
        T = as_temperature(temperature)
        self.heat_capacity.check_range(T)
        return gauss_legendre(self.heat_capacity.value, ZERO_CELSIUS, T, order=8)

    @property
    def sublimes(self) -> bool:
        """Whether the pressure of its vapor is known."""
        return isinstance(self.sublimation_pressure, Correlation)

    @at_once(temperature=as_temperature)
    def heat_of_sublimation(self, temperature: Any) -> Any:
        """By Clausius and Clapeyron from the slope of the pressure of its vapor, J/kg."""
        T = jnp.asarray(as_temperature(temperature), dtype=float)
        law = self.sublimation_pressure
        _value, slope = jax.jvp(lambda x: jnp.log(law.value(x)), (T,), (jnp.ones_like(T),))
        return GAS_CONSTANT * T**2 * slope / self.molar_mass

    def __repr__(self) -> str:
        return _("solid {name} ({formula})").format(name=self.label, formula=self.formula)
