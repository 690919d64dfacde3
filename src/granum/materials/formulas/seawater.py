"""Seawater at ordinary pressure, by temperature and salinity."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import ZERO_CELSIUS
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    HeatCapacity,
    MassFraction,
    Pressure,
    Temperature,
    ThermalConductivity,
    Within,
)
from granum.materials.formulas.water import water_vapor_pressure

Salinity = Annotated[MassFraction, Within(0.0, 0.3)]
OCEAN = 0.035


@formula(
    source="sharqawy2010, eq. 8",
    title="Density of seawater",
    equation=r"\rho_l = \sum_{i=0}^4 a_i t^i + \sum_{i=0}^3 b_i S t^i + b_4 S^2 t^2,\quad t = T - 273.15",
    fitted={"temperature": (ZERO_CELSIUS, 453.15), "salinity": (0.0, 0.16)},
    output="liquid_density",
)
def seawater_density(temperature: Temperature, salinity: Salinity = OCEAN) -> Density:
    """Density of seawater at 1 atm or its own vapor pressure.

    Within 0.1 % of the data.

    >>> round(seawater_density(temperature="25 degC"), 1)
    1023.6
    """
    t, S = temperature - ZERO_CELSIUS, salinity
    pure = 9.999e2 + t * (2.034e-2 + t * (-6.162e-3 + t * (2.261e-5 - t * 4.657e-8)))
    return pure + S * (8.020e2 + t * (-2.001 + t * (1.677e-2 - t * 3.060e-5))) - 1.613e-5 * S**2 * t**2


@formula(
    source="sharqawy2010, eq. 22–23",
    title="Viscosity of seawater",
    equation=r"\eta = \eta_w(T)\,(1 + A S + B S^2)",
    fitted={"temperature": (ZERO_CELSIUS, 453.15), "salinity": (0.0, 0.15)},
    output="dynamic_viscosity",
)
def seawater_viscosity(temperature: Temperature, salinity: Salinity = OCEAN) -> DynamicViscosity:
    """Dynamic viscosity of seawater.

    Within 1.5 % of the data.

    >>> round(1e3 * seawater_viscosity(temperature="25 degC"), 3)
    0.959
    """
    t, S = temperature - ZERO_CELSIUS, salinity
    water = 4.2844e-5 + 1.0 / (0.157 * (t + 64.993) ** 2 - 91.296)
    A = 1.541 + 1.998e-2 * t - 9.52e-5 * t**2
    B = 7.974 - 7.561e-2 * t + 4.724e-4 * t**2
    return water * (1.0 + A * S + B * S**2)


@formula(
    source="sharqawy2010, eq. 9",
    title="Heat capacity of seawater",
    equation=r"c_p = A + B T + C T^2 + D T^3",
    fitted={"temperature": (ZERO_CELSIUS, 453.15), "salinity": (0.0, 0.18)},
    output="specific_heat_capacity",
)
def seawater_heat_capacity(temperature: Temperature, salinity: Salinity = OCEAN) -> HeatCapacity:
    """Specific heat capacity of seawater at constant pressure.

    Within 0.3 % of the data.

    >>> round(seawater_heat_capacity(temperature="25 degC"), -1)
    4000.0
    """
    T, s = temperature, 1e3 * salinity
    A = 5.328 - 9.76e-2 * s + 4.04e-4 * s**2
    B = -6.913e-3 + 7.351e-4 * s - 3.15e-6 * s**2
    C = 9.6e-6 - 1.927e-6 * s + 8.23e-9 * s**2
    D = 2.5e-9 + 1.666e-9 * s - 7.125e-12 * s**2
    return 1e3 * (A + T * (B + T * (C + T * D)))


@formula(
    source="sharqawy2010, eq. 13",
    title="Thermal conductivity of seawater",
    equation=r"\log_{10}\lambda = \log_{10}(240 + 0.2 S) - 3 + 0.434\left(2.3 - \frac{343.5 + 37 S}{T}\right)"
    r"\left(1 - \frac{T}{647 + 30 S}\right)^{0.333}",
    fitted={"temperature": (ZERO_CELSIUS, 453.15), "salinity": (0.0, 0.16)},
    output="thermal_conductivity",
)
def seawater_conductivity(temperature: Temperature, salinity: Salinity = OCEAN) -> ThermalConductivity:
    """Thermal conductivity of seawater.

    Within 3 % of the data.

    >>> round(seawater_conductivity(temperature="25 degC"), 2)
    0.61
    """
    T, s = temperature, 1e3 * salinity
    below = jnp.maximum(1.0 - T / (647.0 + 0.03 * s), 0.0)
    power = jnp.where(below > 0.0, below, 1.0) ** 0.333 * (below > 0.0)
    return 1e-3 * 10.0 ** (jnp.log10(240.0 + 2e-4 * s) + 0.434 * (2.3 - (343.5 + 0.037 * s) / T) * power)


@formula(
    source="sharqawy2010, eq. 32",
    title="Pressure of the vapor of seawater",
    equation=r"p_v = \frac{p_{v,w}(T)}{1 + 0.57357\,\frac{S}{1-S}}",
    fitted={"temperature": (ZERO_CELSIUS, 453.15), "salinity": (0.0, 0.16)},
    output="vapor_pressure",
)
def seawater_vapor_pressure(temperature: Temperature, salinity: Salinity = OCEAN) -> Pressure:
    """Vapor pressure of seawater by Raoult's law with the mean molar mass of sea salts.

    >>> round(seawater_vapor_pressure(temperature="100 degC") / 101325, 3)
    0.981
    """
    return water_vapor_pressure(temperature) / (1.0 + 0.57357 * salinity / (1.0 - salinity))
