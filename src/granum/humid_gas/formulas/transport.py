"""Transport properties of humid air: viscosity, conductivity, diffusivity and their numbers."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import GAS_CONSTANT, STANDARD_ATMOSPHERE
from granum.core.kinds import (
    Diffusivity,
    DynamicViscosity,
    HeatCapacity,
    HumidityRatio,
    PositiveNumber,
    Pressure,
    Temperature,
    ThermalConductivity,
)
from granum.humid_gas.pairs import AIR_HEAT_CAPACITY, AIR_WATER, STEAM_HEAT_CAPACITY, polynomial
from granum.materials.formulas.diffusivity import diffusivity_marrero_mason
from granum.materials.formulas.gases import air_conductivity, air_viscosity
from granum.materials.formulas.water_transport import steam_conductivity, steam_viscosity


class Transport(NamedTuple):
    """Transport properties of a humid gas; the heat capacity is per kilogram of humid gas."""

    dynamic_viscosity: DynamicViscosity
    thermal_conductivity: ThermalConductivity
    specific_heat_capacity: HeatCapacity
    diffusivity: Diffusivity
    prandtl_number: PositiveNumber
    schmidt_number: PositiveNumber
    lewis_number: PositiveNumber


def _mixed(first: Any, second: Any, y: Any, weights: tuple[Any, Any]) -> Any:
    """Wilke's rule: each share over what it and the other make of it."""
    return (1.0 - y) * first / ((1.0 - y) + y * weights[0]) + y * second / (y + (1.0 - y) * weights[1])


@formula(
    source=(
        "poling2001, eq. 9-5.14 and 10-6.2; lemmon2004; iapws2008viscosity; iapws2011conductivity; "
        "marrero1972"
    ),
    equation=(
        r"\eta = \sum_i \frac{y_i\eta_i}{\sum_j y_j\phi_{ij}},\quad \phi_{ij} = "
        r"\frac{[1+(\eta_i/\eta_j)^{1/2}(M_j/M_i)^{1/4}]^2}{[8(1+M_i/M_j)]^{1/2}},\quad \eta_i = "
        r"\eta_i(T),\ y_i = y_i(w)"
    ),
    fitted={"temperature": (273.15, 623.15)},
    typical={"temperature": (293.15, 393.15), "humidity_ratio": (0.005, 0.1), "pressure": (9e4, 2e5)},
    title="Transport properties of humid air",
    output="humid_gas_state",
)
def transport(
    temperature: Temperature, humidity_ratio: HumidityRatio, pressure: Pressure = STANDARD_ATMOSPHERE
) -> Transport:
    """Viscosity (Wilke), conductivity (Mason and Saxena), heat capacity and diffusivity of humid air at low
    pressure.

    Dry air at 27 °C: 18.5 µPa s, 26.4 mW/(m K), Pr 0.71.

    >>> dry = transport(temperature=300.0, humidity_ratio=0.0)
    >>> (
    ...     round(dry.dynamic_viscosity * 1e6, 1),
    ...     round(dry.thermal_conductivity * 1e3, 1),
    ...     round(dry.prandtl_number, 2),
    ... )
    (18.5, 26.4, 0.71)
    """
    T, w = temperature, humidity_ratio
    y = AIR_WATER.fraction(w)
    Ma, Mw = AIR_WATER.gas_molar_mass, AIR_WATER.vapor_molar_mass
    air, steam = air_viscosity.function(T), steam_viscosity.function(T)
    ratio = jnp.sqrt(air / steam)
    weights = (
        (1.0 + ratio * (Mw / Ma) ** 0.25) ** 2 / (8.0 * (1.0 + Ma / Mw)) ** 0.5,
        (1.0 + (Ma / Mw) ** 0.25 / ratio) ** 2 / (8.0 * (1.0 + Mw / Ma)) ** 0.5,
    )
    viscosity = _mixed(air, steam, y, weights)
    conductivity = _mixed(air_conductivity.function(T), steam_conductivity.function(T), y, weights)
    t = T - 273.15
    heat = (polynomial(AIR_HEAT_CAPACITY, t) + w * polynomial(STEAM_HEAT_CAPACITY, t)) / (1.0 + w)
    density = pressure * ((1.0 - y) * Ma + y * Mw) / (GAS_CONSTANT * T)
    D = diffusivity_marrero_mason.function(T, pressure)
    return Transport(
        viscosity,
        conductivity,
        heat,
        D + 0.0 * y,
        viscosity * heat / conductivity,
        viscosity / (density * D),
        conductivity / (density * heat * D),
    )
