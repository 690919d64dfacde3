"""Gas–vapor pairs: everything a humid-gas calculation asks of the two substances, per mole of mixture.

A state is (temperature, pressure, vapor mole fraction), which stays finite from dry gas to pure vapor. A pair
is a law of the family ``gas_vapor_pair``; all of psychrometrics is written on the methods of ``AbstractPair``
alone.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import Any, ClassVar

import equinox as eqx
import jax.numpy as jnp

from granum.core import law
from granum.core.constants import GAS_CONSTANT, STANDARD_ATMOSPHERE, ZERO_CELSIUS
from granum.core.kinds import MoleFraction, Pressure, Temperature
from granum.materials.formulas.water import water_boiling_temperature, water_vapor_pressure
from granum.numerics.quick_roots import newton_root

NEARLY_LINEAR = 8  # Newton steps at most on functions that are nearly linear
LEAST_PRESSURE, MOST_PRESSURE = 1e3, 1e7
COLDEST, HOTTEST, IDEAL_PRESSURE = 150.0, 1500.0, 2.5e5  # of air and water as ideal gases
SLACK = 1e-9  # brackets are widened by this fraction so that rounding cannot hide a root that lies at an end


class AbstractPair(eqx.Module):
    """A carrier gas and a condensable vapor."""

    gas_molar_mass: ClassVar[float]
    vapor_molar_mass: ClassVar[float]
    freezing_temperature: ClassVar[float]
    lowest_temperature: ClassVar[float]
    highest_temperature: ClassVar[float]
    # no liquid above, so that a wet bulb there is an extrapolation
    highest_condensation: ClassVar[float] = float("inf")
    # beyond it the substances are no longer what the pair takes them for
    highest_pressure: ClassVar[float] = MOST_PRESSURE
    # whether evaporation can shrink the gas, so that two states share a volume
    heavy_vapor: ClassVar[bool] = False

    def __call__(self, temperature: Temperature, pressure: Pressure = STANDARD_ATMOSPHERE) -> MoleFraction:
        """Mole fraction of vapor in saturated gas; none above the boiling point."""
        T, P = jnp.asarray(temperature, dtype=float), jnp.asarray(pressure, dtype=float)
        return self.saturated_fraction(T, P, self.is_frozen(T))

    @abstractmethod
    def lewis_factor(self) -> Any:
        """Heat over mass transfer, h/(k_Y c_humid), of the wet bulb; None where wet bulb and adiabatic
        saturation agree.
        """

    @abstractmethod
    def saturated_fraction(self, T: Any, P: Any, frozen: Any) -> Any:
        """Mole fraction of vapor in saturated gas; above the boiling point it goes beyond 1 and only serves
        as a divisor.
        """

    @abstractmethod
    def boiling_temperature(self, P: Any) -> Any:
        """Temperature at which the saturated fraction is 1."""

    @abstractmethod
    def molar_enthalpy(self, T: Any, P: Any, y: Any) -> Any:
        """Enthalpy of the gas phase, J/mol of mixture; zero for dry gas and for liquid at 0 °C."""

    @abstractmethod
    def molar_volume(self, T: Any, P: Any, y: Any) -> Any:
        """Volume of the gas phase, m³/mol."""

    @abstractmethod
    def condensate_molar_enthalpy(self, T: Any, P: Any, frozen: Any) -> Any:
        """Enthalpy of the liquid, or of the solid where frozen, J/mol."""

    @abstractmethod
    def vapor_partial_enthalpy(self, T: Any, P: Any, y: Any) -> Any:
        """Partial molar enthalpy of the vapor, J/mol; with the condensate's it gives the heat of
        vaporization.
        """

    def fraction_at_volume(self, T: Any, P: Any, v: Any) -> Any:
        """Mole fraction of vapor in unsaturated gas of a volume per mass of dry gas; negative where even dry
        gas takes more room.
        """
        first = jnp.zeros_like(T * P * v)
        return newton_root(
            lambda y: self.molar_volume(T, P, y) - v * self.gas_molar_mass * (1.0 - y), first, NEARLY_LINEAR
        )

    def simplified(self) -> AbstractPair | None:
        """A cheaper pair that saturates with less vapor, for pairs whose functions cost much."""
        return None

    def nearby(self) -> AbstractPair | None:
        """A cheaper pair with nearly the same values and derivatives, from which searches start."""
        return self.simplified()

    @property
    def molar_mass_ratio(self) -> float:
        """Vapor over gas."""
        return self.vapor_molar_mass / self.gas_molar_mass

    def fraction(self, w: Any) -> Any:
        """Mole fraction of vapor from humidity ratio."""
        return w / (self.molar_mass_ratio + w)

    def humidity_ratio(self, y: Any) -> Any:
        """Humidity ratio from mole fraction of vapor; infinite for pure vapor."""
        return self.molar_mass_ratio * y / (1.0 - y)

    def is_frozen(self, T: Any) -> Any:
        """Whether the condensed phase at this temperature is the solid."""
        return self.freezing_temperature > T


class AbstractIdealPair(AbstractPair):
    """A pair of ideal gases with heat capacities that depend on temperature alone."""

    @abstractmethod
    def gas_molar_enthalpy(self, T: Any) -> Any:
        """Dry gas, J/mol, zero at 0 °C."""

    @abstractmethod
    def vapor_molar_enthalpy(self, T: Any) -> Any:
        """Vapor, J/mol, above the liquid at 0 °C."""

    @abstractmethod
    def saturation_pressure(self, T: Any, frozen: Any) -> Any:
        """Vapor pressure of the condensed phase, Pa."""

    def saturated_fraction(self, T: Any, P: Any, frozen: Any) -> Any:
        return self.saturation_pressure(T, frozen) / P

    def molar_enthalpy(self, T: Any, P: Any, y: Any) -> Any:
        return (1.0 - y) * self.gas_molar_enthalpy(T) + y * self.vapor_molar_enthalpy(T)

    def vapor_partial_enthalpy(self, T: Any, P: Any, y: Any) -> Any:
        return self.vapor_molar_enthalpy(T)

    def molar_volume(self, T: Any, P: Any, y: Any) -> Any:
        return GAS_CONSTANT * T / P + 0.0 * y

    def fraction_at_volume(self, T: Any, P: Any, v: Any) -> Any:
        return 1.0 - GAS_CONSTANT * T / (P * v * self.gas_molar_mass)


def polynomial(coefficients: tuple[float, ...], x: Any) -> Any:
    """Polynomial, lowest power first."""
    total = coefficients[-1]
    for c in coefficients[-2::-1]:
        total = total * x + c
    return total


def integrated(coefficients: tuple[float, ...]) -> tuple[float, ...]:
    """The integral of a polynomial, zero at zero."""
    return (0.0, *(c / (i + 1) for i, c in enumerate(coefficients)))


# Least-squares fits, J/(kg K) in °C over −60…700 °C: dry air at 1 atm (ideal-gas part of Lemmon et al.
# 2000 with the virial
# departure of RP-1485) within 0.006 %, steam to the ideal-gas part of IAPWS-95 within 0.06 %. Liquid:
# saturated-liquid enthalpy of IAPWS-95 within 30 J/kg to 200 °C, 0.8 % at 350 °C.
AIR_HEAT_CAPACITY = (1005.64374, 0.0138250024, 4.06324069e-4, 2.64525859e-7, -1.30178416e-9, 8.53970779e-13)
STEAM_HEAT_CAPACITY = (1858.74781, 0.194446998, 1.38085867e-3, -1.85866061e-6, 9.95166919e-10)
WATER_ENTHALPY = (
    0.0,
    4205.6226770918265,
    -0.673452525234526,
    0.007153028365726702,
    -2.4556661120696613e-05,
    6.304380417709865e-08,
)
WATER_VAPORIZATION = 2500.9e3  # J/kg at 0 °C, IAPWS-95
# J/kg in °C: heat of fusion and heat capacity of IAPWS-06 near the triple point
ICE_ENTHALPY = (-333.43e3, 2097.0, 3.85)
TRIPLE_POINT = 273.16


# Sixteenth root of the sublimation pressure (IAPWS 2011) as a polynomial in (T − 211 K)/62 K: within
# 1e-10 over 150…273.2 K and many
# times cheaper than its powers, which would otherwise cost more than all the rest of a wet bulb.
ICE_ROOT = (
    0.9866186732128,
    0.5276389580655,
    -0.01275357278964,
    -0.01282979704806,
    0.004171312777888,
    -0.0008474752908464,
    0.0001060650812627,
    5.187430305465e-06,
    -8.870543509793e-06,
    3.688941668704e-06,
    -1.165827950312e-06,
    3.395199074408e-07,
    -6.812142353467e-08,
)


def ice_vapor_pressure(T: Any) -> Any:
    """Sublimation pressure of ice, Pa."""
    x = polynomial(ICE_ROOT, (jnp.clip(T, 150.0, 280.0) - 211.0) / 62.0)
    for _squaring in range(4):
        x = x * x
    return x


@law(
    "gas_vapor_pair",
    name="air_water",
    source="wagner2002; lemmon2000; iapwsif97, eq. 30; iapws2011melting",
    title="Air and water, ideal gases",
    fitted={"temperature": (COLDEST, HOTTEST), "pressure": (LEAST_PRESSURE, IDEAL_PRESSURE)},
    equation=r"h = h_a(T) + w\,h_v(T), \qquad h_v(0\,°\mathrm{C}) = 2500.9\,\mathrm{kJ/kg}",
)
class AirWater(AbstractIdealPair):
    """Air and water as ideal gases with heat capacities that rise with temperature.

    The heat capacity of dry air is that at 1 atm. There the enthalpy agrees with the real mixture (RP-1485)
    from 0 to 100 °C within 3 J/kg dry and 0.06 % up to a humidity ratio of 0.03, and with the hand form
    1.006 t + w (2501 + 1.86 t) within 40 J/kg up to 60 °C; it stays right at the temperatures of dryers and
    burners. Ice below 0.01 °C. At 1 atm saturation is 0.4 % drier than in the real mixture up to 40 °C and
    the volume 0.1 % larger. Up to 2.5 bar and 60 °C saturation stays within 1.1 % and the enthalpy within
    0.4 kJ/kg; beyond, values are flagged: use ``air_water_real`` there (at 30 bar saturation is 7 to 10 %
    off, the enthalpy 7 kJ/kg).
    """

    gas_molar_mass: ClassVar[float] = 0.028966
    vapor_molar_mass: ClassVar[float] = 0.018015268
    freezing_temperature: ClassVar[float] = TRIPLE_POINT
    lowest_temperature: ClassVar[float] = COLDEST
    highest_temperature: ClassVar[float] = HOTTEST
    highest_pressure: ClassVar[float] = IDEAL_PRESSURE

    def lewis_factor(self) -> Any:
        return None

    def gas_molar_enthalpy(self, T: Any) -> Any:
        return self.gas_molar_mass * polynomial(integrated(AIR_HEAT_CAPACITY), T - ZERO_CELSIUS)

    def vapor_molar_enthalpy(self, T: Any) -> Any:
        return self.vapor_molar_mass * (
            WATER_VAPORIZATION + polynomial(integrated(STEAM_HEAT_CAPACITY), T - ZERO_CELSIUS)
        )

    def saturation_pressure(self, T: Any, frozen: Any) -> Any:
        if frozen is False:
            return water_vapor_pressure.function(T)
        return jnp.where(frozen, ice_vapor_pressure(T), water_vapor_pressure.function(T))

    def boiling_temperature(self, P: Any) -> Any:
        return water_boiling_temperature.function(P)

    def condensate_molar_enthalpy(self, T: Any, P: Any, frozen: Any) -> Any:
        t = T - ZERO_CELSIUS
        liquid = polynomial(WATER_ENTHALPY, t)
        return self.vapor_molar_mass * (
            liquid if frozen is False else jnp.where(frozen, polynomial(ICE_ENTHALPY, t), liquid)
        )


AIR_WATER = AirWater()
