"""Viscosity and thermal conductivity of water and steam: IAPWS 2008 and 2011, without the critical
enhancement.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np

from granum.core import formula
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.kinds import Concentration, DynamicViscosity, Pressure, Temperature, ThermalConductivity
from granum.materials.formulas.water import water_density

_CRITICAL_TEMPERATURE, _CRITICAL_DENSITY = 647.096, 322.0
# (i, j, H) of the 2008 viscosity release, table 2
_VISCOSITY = np.array([
    (0, 0, 0.520094), (1, 0, 0.0850895), (2, 0, -1.08374), (3, 0, -0.289555), (0, 1, 0.222531), (1, 1, 0.999115),  # noqa: E501
    (2, 1, 1.88797), (3, 1, 1.26613), (5, 1, 0.120573), (0, 2, -0.281378), (1, 2, -0.906851), (2, 2, -0.772479),  # noqa: E501
    (3, 2, -0.489837), (4, 2, -0.257040), (0, 3, 0.161913), (1, 3, 0.257399), (0, 4, -0.0325372), (3, 4, 0.0698452),  # noqa: E501
    (4, 5, 0.00872102), (3, 6, -0.00435673), (5, 6, -0.000593264),
])  # fmt: skip
# rows i, columns j of the 2011 conductivity release, table 2
_CONDUCTIVITY = np.array(
    [
        (1.60397357, -0.646013523, 0.111443906, 0.102997357, -0.0504123634, 0.00609859258),
        (2.33771842, -2.78843778, 1.53616167, -0.463045512, 0.0832827019, -0.00719201245),
        (2.19650529, -4.54580785, 3.55777244, -1.40944978, 0.275418278, -0.0205938816),
        (-1.21051378, 1.60812989, -0.621178141, 0.0716373224, 0.0, 0.0),
        (-2.7203370, 4.57586331, -3.18369245, 1.1168348, -0.19268305, 0.012913842),
    ]
)
_RANGE = {"temperature": (273.15, 1173.15)}


def _series(terms: np.ndarray, x: Any, y: Any) -> Any:
    """Sum of H x^i y^j over rows (i, j, H), by Horner's rule in both."""
    total: Any = 0.0
    for i in range(int(terms[:, 0].max()), -1, -1):
        row = {int(j): H for k, j, H in terms if k == i}
        inner: Any = 0.0
        for j in range(max(row, default=0), -1, -1):
            inner = inner * y + row[j] if j in row else inner * y
        total = total * x + inner
    return total


def _dilute_viscosity(T: Any) -> Any:
    tau = _CRITICAL_TEMPERATURE / T
    return 100.0 * tau**-0.5 / (1.67752 + 2.20462 * tau + 0.6366564 * tau**2 - 0.241605 * tau**3)  # µPa s


def _dilute_conductivity(T: Any) -> Any:
    tau = _CRITICAL_TEMPERATURE / T
    series = (
        2.443221e-3 + 1.323095e-2 * tau + 6.770357e-3 * tau**2 - 3.454586e-3 * tau**3 + 4.096266e-4 * tau**4
    )
    return tau**-0.5 / series  # mW/(m K)


@formula(
    source="iapws2008viscosity, eq. 10–12",
    equation=(
        r"\eta = \eta_0(\bar T)\,\exp\left[\bar\rho\sum_i\left(\tfrac{1}{\bar T}-1\right)^i\sum_j "
        r"H_{ij}(\bar\rho-1)^j\right],\quad \bar T = \frac{T}{647.096\,\mathrm K},\ \bar\rho = "
        r"\frac{\rho}{322\,\mathrm{kg/m^3}}"
    ),
    fitted=_RANGE,
    title="Viscosity of water or steam at a density (IAPWS 2008)",
)
def dynamic_viscosity_iapws(temperature: Temperature, density: Concentration) -> DynamicViscosity:
    """Viscosity of water substance, liquid or vapor, from temperature and its density, zero included.

    Within 1 % for the liquid near ambient conditions; the critical enhancement, which matters within a few
    kelvin of the critical point only, is left out.

    >>> round(dynamic_viscosity_iapws(temperature=298.15, density=998.0) * 1e6, 6)
    889.7351
    """
    tau, delta = jnp.asarray(_CRITICAL_TEMPERATURE / temperature), jnp.asarray(density / _CRITICAL_DENSITY)
    x, y = tau - 1.0, delta - 1.0
    total = _series(_VISCOSITY, x, y)
    return 1e-6 * _dilute_viscosity(temperature) * jnp.exp(delta * total)


@formula(
    source="iapws2011conductivity, eq. 15–17",
    equation=(
        r"\lambda = \lambda_0(\bar T)\,\exp\left[\bar\rho\sum_i\left(\tfrac{1}{\bar T}-1\right)^i\sum_j "
        r"L_{ij}(\bar\rho-1)^j\right],\quad \bar T = \frac{T}{647.096\,\mathrm K},\ \bar\rho = "
        r"\frac{\rho}{322\,\mathrm{kg/m^3}}"
    ),
    fitted=_RANGE,
    title="Thermal conductivity of water or steam at a density (IAPWS 2011)",
)
def thermal_conductivity_iapws(temperature: Temperature, density: Concentration) -> ThermalConductivity:
    """Thermal conductivity of water substance, liquid or vapor, from temperature and its density, without
    critical enhancement.

    The part left out is about 0.5 % of the liquid's value up to 100 °C and grows toward the critical point.

    >>> round(thermal_conductivity_iapws(temperature=298.15, density=998.0) * 1e3, 6)
    607.712868
    """
    tau, delta = jnp.asarray(_CRITICAL_TEMPERATURE / temperature), jnp.asarray(density / _CRITICAL_DENSITY)
    x, y = tau - 1.0, delta - 1.0
    total = sum(float(L) * x**i * y**j for i, row in enumerate(_CONDUCTIVITY) for j, L in enumerate(row) if L)
    return 1e-3 * _dilute_conductivity(temperature) * jnp.exp(delta * total)


@formula(
    source="iapws2008viscosity, eq. 10–12; iapwsif97, eq. 7",
    fitted={"temperature": (273.15, 623.15)},
    output="dynamic_viscosity",
    title="Viscosity of liquid water (IAPWS 2008)",
)
def water_viscosity(temperature: Temperature, pressure: Pressure = STANDARD_ATMOSPHERE) -> DynamicViscosity:
    """Dynamic viscosity of liquid water.

    >>> round(water_viscosity(temperature="20 degC") * 1e3, 4)
    1.0016
    """
    return dynamic_viscosity_iapws(temperature, water_density(temperature, pressure))


@formula(
    source="iapws2011liquid, eq. 8",
    equation=r"\lambda = \sum_i c_i\,(T/300\,\mathrm{K})^{d_i}",
    fitted={"temperature": (273.15, 383.15)},
    output="thermal_conductivity",
    title="Thermal conductivity of liquid water at 0.1 MPa (IAPWS 2011)",
)
def water_conductivity(temperature: Temperature) -> ThermalConductivity:
    """Thermal conductivity of liquid water at ambient pressure, critical enhancement included, within 1.5 %.

    >>> round(water_conductivity(temperature=298.15), 4)
    0.6065
    """
    t = temperature / 300.0
    return 1.6630 * t**-1.15 - 1.7781 * t**-3.4 + 1.1567 * t**-6.0 - 0.432115 * t**-7.6


@formula(
    source="iapws2008viscosity, eq. 11",
    equation=(
        r"\eta = \frac{100\sqrt{\bar T}}{\sum_i H_i/\bar T^i}\ \mathrm{\mu Pa\,s},\quad \bar T = "
        r"\frac{T}{647.096\,\mathrm K}"
    ),
    fitted=_RANGE,
    typical={"temperature": (280.0, 600.0)},
    output="dynamic_viscosity",
    title="Viscosity of dilute steam (IAPWS 2008)",
)
def steam_viscosity(temperature: Temperature) -> DynamicViscosity:
    """Dynamic viscosity of water vapor in the limit of zero density; below 1 % off up to 1 bar.

    >>> round(steam_viscosity(temperature=873.15) * 1e6, 1)
    32.6
    """
    return 1e-6 * _dilute_viscosity(temperature)


@formula(
    source="iapws2011conductivity, eq. 16",
    equation=(
        r"\lambda = \frac{\sqrt{\bar T}}{\sum_k L_k/\bar T^k}\ \mathrm{mW\,m^{-1}K^{-1}},\quad \bar T = "
        r"\frac{T}{647.096\,\mathrm K}"
    ),
    fitted=_RANGE,
    typical={"temperature": (280.0, 600.0)},
    output="thermal_conductivity",
    title="Thermal conductivity of dilute steam (IAPWS 2011)",
)
def steam_conductivity(temperature: Temperature) -> ThermalConductivity:
    """Thermal conductivity of water vapor in the limit of zero density.

    >>> round(steam_conductivity(temperature=298.15) * 1e3, 7)
    18.4341883
    """
    return 1e-3 * _dilute_conductivity(temperature)
