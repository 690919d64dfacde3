"""Isotherms of grain standards, with temperature in °C and the printed moisture basis (ASAE D245)."""

from __future__ import annotations

from typing import Any, ClassVar

import jax.numpy as jnp

from granum.core import law
from granum.core.constants import ZERO_CELSIUS
from granum.core.kinds import MoistureDryBasis, Number, PositiveNumber, Temperature, WaterActivity
from granum.drying.isotherms.base import ROOM, AbstractIsotherm, before_bend, bounded, run_out


class _Called(AbstractIsotherm):
    """Call form shared by the laws of this file."""

    def __call__(self, water_activity: WaterActivity, temperature: Temperature = ROOM) -> MoistureDryBasis:
        return self.moisture(water_activity, temperature)


def _celsius(T: Any) -> Any:
    return jnp.asarray(T) - ZERO_CELSIUS


@law(
    "isotherm",
    name="isotherm_henderson_modified",
    source="thompson1968; asaed245",
    fitted={"water_activity": (0.2, 0.95)},
    title="Modified Henderson isotherm",
    equation=r"1 - a = \exp\left[-K\,(t + C)\,M^{N}\right],\quad M\text{ in }\mathrm{\%}",
    symbols={"isotherm_coefficient": "K", "isotherm_exponent": "N", "water_activity": "a"},
)
class HendersonModified(_Called):
    """Thompson's modification of Henderson for grains; the printed coefficients take moisture in percent, dry
    basis.

    Shelled corn at 25 °C and 70 %, by hand: [1.204/(8.6541e-5 · 74.81)]^(1/1.8634) = 16.5 %.

    The data behind the standard lie between 0.2 and 0.95.

    >>> corn = HendersonModified(
    ...     isotherm_coefficient=8.6541e-5, isotherm_exponent=1.8634, isotherm_temperature_offset=49.810
    ... )
    >>> round(float(corn(0.7, 298.15)), 3)
    0.165
    """

    curve: ClassVar[str] = "henderson"
    isotherm_coefficient: PositiveNumber
    isotherm_exponent: PositiveNumber
    isotherm_temperature_offset: Number

    def moisture(self, a: Any, T: Any) -> Any:
        heat = self.isotherm_coefficient * (_celsius(T) + self.isotherm_temperature_offset)
        return 0.01 * (-jnp.log1p(-bounded(a)) / heat) ** (1.0 / self.isotherm_exponent)

    def activity(self, X: Any, T: Any) -> Any:
        heat = self.isotherm_coefficient * (_celsius(T) + self.isotherm_temperature_offset)
        return -jnp.expm1(-heat * (100.0 * jnp.maximum(X, 1e-30)) ** self.isotherm_exponent)


@law(
    "isotherm",
    name="isotherm_chung_pfost",
    source="chung1967; asaed245",
    fitted={"water_activity": (0.2, 0.95)},
    title="Modified Chung–Pfost isotherm",
    equation=r"a = \exp\left[-\frac{A}{t+C}\,e^{-B X}\right]",
    symbols={"water_activity": "a"},
)
class ChungPfost(_Called):
    """Chung and Pfost's potential theory, modified with a temperature offset; moisture as a mass ratio.

    The standard's later editions print B for moisture in percent: a hundred times it is the exponent here.

    The data behind the standard lie between 0.2 and 0.95.

    Differs from the print: where the equation falls below no moisture, it bends to none within 0.001 kg/kg.

    >>> corn = ChungPfost(
    ...     isotherm_coefficient=312.30, isotherm_exponent=16.958, isotherm_temperature_offset=30.205
    ... )
    >>> round(float(corn(0.7, 298.15)), 3)
    0.163
    """

    curve: ClassVar[str] = "chung_pfost"
    isotherm_coefficient: PositiveNumber
    isotherm_exponent: PositiveNumber
    isotherm_temperature_offset: Number

    def moisture(self, a: Any, T: Any) -> Any:
        scaled = (
            -(_celsius(T) + self.isotherm_temperature_offset)
            * jnp.log(bounded(a))
            / self.isotherm_coefficient
        )
        return run_out(-jnp.log(scaled) / self.isotherm_exponent)

    def activity(self, X: Any, T: Any) -> Any:
        heat = self.isotherm_coefficient / (_celsius(T) + self.isotherm_temperature_offset)
        return jnp.exp(-heat * jnp.exp(-self.isotherm_exponent * before_bend(X)))


@law(
    "isotherm",
    name="isotherm_halsey_modified",
    source="iglesias1976; asaed245",
    fitted={"water_activity": (0.2, 0.95)},
    title="Modified Halsey isotherm",
    equation=r"a = \exp\left[-e^{A + B t}\,M^{-C}\right],\quad M\text{ in }\mathrm{\%}",
    symbols={"isotherm_coefficient_per_celsius": "B", "isotherm_exponent": "C", "water_activity": "a"},
)
class HalseyModified(_Called):
    """Halsey with an exponential temperature factor, the standard's choice for oilseeds; coefficients for
    moisture in percent.

    The data behind the standard lie between 0.2 and 0.95.

    >>> soybean = HalseyModified(
    ...     isotherm_coefficient=2.87, isotherm_coefficient_per_celsius=-0.0054, isotherm_exponent=1.38
    ... )
    >>> round(float(soybean(0.7, 298.15)), 3)
    0.153
    """

    curve: ClassVar[str] = "halsey"
    isotherm_coefficient: Number
    isotherm_coefficient_per_celsius: Number
    isotherm_exponent: PositiveNumber

    def _factor(self, T: Any) -> Any:
        return jnp.exp(self.isotherm_coefficient + self.isotherm_coefficient_per_celsius * _celsius(T))

    def moisture(self, a: Any, T: Any) -> Any:
        return 0.01 * (self._factor(T) / -jnp.log(bounded(a))) ** (1.0 / self.isotherm_exponent)

    def activity(self, X: Any, T: Any) -> Any:
        return jnp.exp(-self._factor(T) * (100.0 * jnp.maximum(X, 1e-12)) ** -self.isotherm_exponent)


@law(
    "isotherm",
    name="isotherm_oswin_modified",
    source="chen1989; asaed245",
    fitted={"water_activity": (0.2, 0.95)},
    title="Modified Oswin isotherm",
    equation=r"M = (A + B t)\left(\frac{a}{1-a}\right)^{1/C},\quad M\text{ in }\mathrm{\%}",
    symbols={"isotherm_coefficient_per_celsius": "B", "isotherm_exponent": "C", "water_activity": "a"},
)
class OswinModified(_Called):
    """Oswin with a coefficient linear in °C, printed for moisture in percent and with the inverse exponent.

    The data behind the standard lie between 0.2 and 0.95.

    >>> corn = OswinModified(
    ...     isotherm_coefficient=15.303, isotherm_coefficient_per_celsius=-0.10164, isotherm_exponent=3.0358
    ... )
    >>> round(float(corn(0.7, 298.15)), 3)
    0.169
    """

    curve: ClassVar[str] = "oswin"
    isotherm_coefficient: PositiveNumber
    isotherm_coefficient_per_celsius: Number
    isotherm_exponent: PositiveNumber

    def _factor(self, T: Any) -> Any:
        return 0.01 * (self.isotherm_coefficient + self.isotherm_coefficient_per_celsius * _celsius(T))

    def moisture(self, a: Any, T: Any) -> Any:
        a = bounded(a)
        return self._factor(T) * (a / (1.0 - a)) ** (1.0 / self.isotherm_exponent)

    def activity(self, X: Any, T: Any) -> Any:
        ratio = (jnp.maximum(X, 1e-30) / self._factor(T)) ** self.isotherm_exponent
        return ratio / (1.0 + ratio)
