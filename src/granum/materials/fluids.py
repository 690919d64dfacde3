"""``Fluid``: a pure substance as liquid and as dilute vapor or gas."""

from __future__ import annotations

from typing import Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core.at_once import at_once
from granum.core.constants import STANDARD_ATMOSPHERE, ZERO_CELSIUS
from granum.core.i18n import _, current_language
from granum.materials.correlation import Correlation, Missing, as_pressure, as_temperature
from granum.materials.formulas.gases import ideal_gas_density
from granum.numerics import find_root, gauss_legendre

Property = Correlation | Missing


class Combustion(NamedTuple):
    """Of a kilogram of fuel: dry air needed and water formed, kg, and its lower heating value at 25 °C, J."""

    air: float
    water: float
    lower_heating_value: float


class Flammability(NamedTuple):
    """Of a vapor in ambient air, mole fractions: its lower explosive limit, and the oxygen below which no
    mixture with nitrogen burns (NaN when unknown).
    """

    lower_limit: float
    limiting_oxygen: float


class Fluid(eqx.Module):
    """A pure fluid. Its properties are functions of temperature:
    ``fluid("ethanol").liquid_viscosity("25 degC")``.

    All of them work on floats, arrays and tracers, are differentiable, and flag temperatures outside their
    range. Enthalpies of everything condensable are zero for the liquid at 0 °C, those of permanent gases for
    the gas at 0 °C.

    Parameters
    ----------
    name, french, formula: what it is.
    molar_mass: kg/mol.
    critical_temperature, critical_pressure: K, Pa; NaN when not given.
    diffusion_volume: Fuller's molecular diffusion volume, cm³/mol; NaN when not given.
    heat_of_vaporization_at_zero: at 0 °C, J/kg: the step between the two enthalpy scales; NaN for a permanent
        gas.
    combustion: what it takes and gives when it burns; None for what is no fuel.
    flammability: limits of its vapor in air; None for what does not burn or is not known.
    """

    name: str = eqx.field(static=True)
    french: str = eqx.field(static=True)
    formula: str = eqx.field(static=True)
    molar_mass: float
    critical_temperature: float
    critical_pressure: float
    diffusion_volume: float
    heat_of_vaporization_at_zero: float
    liquid_density: Property
    liquid_viscosity: Property
    liquid_heat_capacity: Property
    liquid_conductivity: Property
    surface_tension: Property
    vapor_pressure: Property
    heat_of_vaporization: Property
    vapor_heat_capacity: Property
    vapor_viscosity: Property
    vapor_conductivity: Property
    combustion: Combustion | None = eqx.field(static=True, default=None)
    flammability: Flammability | None = eqx.field(static=True, default=None)

    @property
    def label(self) -> str:
        """Its name in the current language."""
        return self.french if current_language() == "fr" and self.french else self.name

    @property
    def condensable(self) -> bool:
        """Whether it has a liquid here (dry air and nitrogen have none)."""
        return isinstance(self.vapor_pressure, Correlation)

    def vapor_density(self, temperature: Any, pressure: Any = STANDARD_ATMOSPHERE) -> Any:
        """Density as an ideal gas, kg/m³."""
        return ideal_gas_density(as_temperature(temperature), self.molar_mass, as_pressure(pressure))

    @at_once(pressure=as_pressure)
    def boiling_temperature(self, pressure: Any = STANDARD_ATMOSPHERE) -> Any:
        """Temperature at which the vapor pressure reaches a pressure, K; also the dew point at a partial
        pressure.
        """
        p, law = jnp.asarray(as_pressure(pressure)), self.vapor_pressure
        if isinstance(law, Missing):
            return law(p)
        goal = jnp.log(jnp.maximum(p, 1e-300))
        root = find_root(lambda T, y: jnp.log(law.value(T)) - y, law.low, law.high, goal)
        return root.value

    @at_once(temperature=as_temperature)
    def liquid_enthalpy(self, temperature: Any) -> Any:
        """Specific enthalpy of the liquid, J/kg, zero at 0 °C."""
        return self._integral(self.liquid_heat_capacity, temperature)

    @at_once(temperature=as_temperature)
    def vapor_enthalpy(self, temperature: Any) -> Any:
        """Specific enthalpy of the vapor or gas, J/kg: evaporated at 0 °C, then heated."""
        sensible = self._integral(self.vapor_heat_capacity, temperature)
        return sensible + self.heat_of_vaporization_at_zero if self.condensable else sensible

    @staticmethod
    def _integral(heat_capacity: Property, temperature: Any) -> Any:
        T = as_temperature(temperature)
        heat_capacity.check_range(T)
        return gauss_legendre(heat_capacity.value, ZERO_CELSIUS, T, order=8)

    def __repr__(self) -> str:
        return _("fluid {name} ({formula})").format(name=self.label, formula=self.formula)
