"""Caustic soda liquors: their enthalpy and vapor pressure by Olsson, Jernqvist and Aly."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import ZERO_CELSIUS
from granum.core.flags import extrapolated
from granum.core.kinds import MassFraction, Pressure, SpecificEnergy, Temperature

STRONGEST = 0.78
# numerator and denominator over the mass fraction of water, then what goes with t, t² and t³
_TOP = (1288.4485, -4387.8908, 4938.2298, -1841.1890)
_BOTTOM = (1.0, -0.49649131, -4.0915144, 7.2887292, -3.0202651)
_FIRST = (
    2.3087919,
    -9.0004252,
    167.59914,
    -1051.6368,
    3394.3378,
    -6115.0986,
    6220.8249,
    -3348.8098,
    743.87432,
)
_SECOND = (0.02302860, -0.37866056, 2.4529593, -8.2693542, 15.728833, -16.944427, 9.6254192, -2.2410628)
_THIRD = (-8.5131313e-5, 136.52823e-5, -875.68741e-5, 2920.0398e-5, -5488.2983e-5, 5841.8034e-5, -3278.7483e-5, 754.45993e-5)  # noqa: E501  # fmt: skip
# over the logarithm of the mass fraction of water
_A = (-113.93947, 209.82305, 494.77153, 6860.8330, 2676.6433, -21740.328, -34750.872, -20122.157, -4102.9890)
_B = (16.240074, -11.864008, -223.47305, -1650.3997, -5997.3118, -12318.744, -15303.153, -11707.480, -5364.9554, -1338.5412, -137.96889)  # noqa: E501  # fmt: skip
_C = (-226.80157, 293.17155, 5081.8791, 36752.126, 131262.00, 259399.54, 301696.22, 208617.90, 81774.024, 15648.526, 906.29769)  # noqa: E501  # fmt: skip


# °C from which on, and the mass fraction to which, the source has data
_HEATS = (
    (0.0, 4.0, 10.0, 15.0, 26.0, 37.0, 48.0, 60.0, 71.0, 82.0, 93.0),
    (0.22, 0.32, 0.42, 0.46, 0.56, 0.6, 0.66, 0.7, 0.72, 0.76, STRONGEST),
)
_PRESSURES = ((0.0, 20.0, 60.0, 70.0), (0.418, 0.5, 0.647, 0.7))


def _told(data: tuple[tuple[float, ...], ...], temperature: Any, w: Any) -> None:
    """Flag a liquor that is stronger than those behind the equation at its temperature."""
    starts, ends = (jnp.asarray(row) for row in data)
    t = jnp.asarray(temperature - ZERO_CELSIUS)
    most = ends[jnp.clip(jnp.searchsorted(starts, t, side="right") - 1, 0, len(starts) - 1)]
    beyond = (w > most) & (most < ends[-1])  # more than the last is told of the range as a whole
    extrapolated(beyond, w, "solute_mass_fraction", 0.0, most)


def _polynomial(coefficients: tuple[float, ...], x: Any) -> Any:
    return jnp.polyval(jnp.asarray(coefficients[::-1]), x)


@formula(
    source="olsson1997",
    equation=(
        r"h = \frac{\sum_{i=0}^3 a_i X_w^i}{\sum_{i=0}^4 b_i X_w^i} + t\sum_{i=0}^8 c_i X_w^i + "
        r"t^2\sum_{i=0}^7 d_i X_w^i + t^3\sum_{i=0}^7 e_i X_w^i,\quad X_w = 1 - x,\quad "
        r"t = T - 273.15\,\mathrm K"
    ),
    fitted={"temperature": (ZERO_CELSIUS, 477.15), "solute_mass_fraction": (0.0, STRONGEST)},
    typical={"temperature": (370.0, 440.0), "solute_mass_fraction": (0.05, 0.5)},
    output="specific_enthalpy",
    title="Enthalpy of caustic soda liquor (Olsson)",
)
def caustic_enthalpy_olsson(temperature: Temperature, solute_mass_fraction: MassFraction) -> SpecificEnergy:
    """Specific enthalpy of a solution of sodium hydroxide, zero for water at 0 °C and for the dissolved
    hydroxide in much water near 25 °C.

    It holds the heat of dilution: 50 % liquor thinned to 10 % gives off half a megajoule per kilogram of
    hydroxide. Cold strong liquors freeze before the ends of the range: below 60 °C the data end at 66 %,
    below 37 °C at 56 %, below 15 °C at 42 %.

    Geankoplis reads 214 kJ/kg off a chart for 20 % at 60 °C.

    >>> round(caustic_enthalpy_olsson("60 degC", "20 %") / 1e3, 0)
    213.0
    """
    _told(_HEATS, temperature, solute_mass_fraction)
    return specific_enthalpy(temperature, solute_mass_fraction)


def specific_enthalpy(temperature: Any, solute_mass_fraction: Any) -> Any:
    """The same without flags, J/kg."""
    t, x = temperature - ZERO_CELSIUS, 1.0 - solute_mass_fraction
    cold = _polynomial(_TOP, x) / _polynomial(_BOTTOM, x)
    warm = _polynomial(_FIRST, x) + t * (_polynomial(_SECOND, x) + t * _polynomial(_THIRD, x))
    return 1e3 * (cold + t * warm)


@formula(
    source="olsson1997",
    equation=(
        r"\ln\frac{p_v}{1\,\mathrm{kPa}} = \frac{A + B\,t}{t - C},\quad A, B, C = "
        r"\sum_i a_i\left[\ln(1-x)\right]^i,\quad t = T - 273.15\,\mathrm K"
    ),
    fitted={"temperature": (ZERO_CELSIUS, 473.15), "solute_mass_fraction": (0.0, 0.7)},
    typical={"temperature": (345.0, 420.0), "solute_mass_fraction": (0.05, 0.5)},
    output="vapor_pressure",
    title="Vapor pressure of caustic soda liquor (Olsson)",
)
def caustic_vapor_pressure_olsson(temperature: Temperature, solute_mass_fraction: MassFraction) -> Pressure:
    """Pressure of water over a solution of sodium hydroxide: where it equals that of the evaporator, the
    liquor boils.

    Below 70 °C the data end at 65 %, below 60 °C at 50 %, below 20 °C at 42 %; those from
    150 °C on, to 80 %, are flagged here beyond 70.

    Geankoplis' Dühring lines have a liquor of 50 % boil at 89.5 °C under 11.7 kPa.

    >>> round(caustic_vapor_pressure_olsson("89.5 degC", "50 %") / 1e3)
    11
    """
    _told(_PRESSURES, temperature, solute_mass_fraction)
    return vapor_pressure(temperature, solute_mass_fraction)


def vapor_pressure(temperature: Any, solute_mass_fraction: Any) -> Any:
    """The same without flags, Pa."""
    t, y = temperature - ZERO_CELSIUS, jnp.log(1.0 - solute_mass_fraction)
    return 1e3 * jnp.exp((_polynomial(_A, y) + _polynomial(_B, y) * t) / (t - _polynomial(_C, y)))
