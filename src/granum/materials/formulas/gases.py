"""Dry air, nitrogen and ideal gases: density, heat capacity, viscosity and conductivity at low pressure."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import GAS_CONSTANT, STANDARD_ATMOSPHERE
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    HeatCapacity,
    MolarMass,
    Pressure,
    Temperature,
    ThermalConductivity,
)

MOLAR_MASS_AIR, MOLAR_MASS_NITROGEN = 28.9586e-3, 28.01348e-3  # kg/mol, as in lemmon2004


@formula(
    source="poling2001, ch. 3",
    equation=r"\rho_g = \frac{p M}{R T}",
    title="Density of an ideal gas",
    typical={"molar_mass": (0.018, 0.1)},
    output="gas_density",
)
def ideal_gas_density(
    temperature: Temperature, molar_mass: MolarMass, pressure: Pressure = STANDARD_ATMOSPHERE
) -> Density:
    """Density of an ideal gas; near ambient pressure dry air departs by less than 0.1 %, vapors near
    saturation by 1 to 4 %.

    >>> round(ideal_gas_density(temperature="0 degC", molar_mass="28.9586 g/mol"), 4)
    1.292
    """
    return pressure * molar_mass / (GAS_CONSTANT * temperature)


def _lennard_jones(T: Any, molar_mass: float, energy: float, length: float) -> Any:
    """Dilute-gas viscosity, µPa s, with the collision integral of lemmon2004; molar mass in g/mol, energy in
    K, length in nm.
    """
    x = jnp.log(T / energy)
    omega = jnp.exp(0.431 + x * (-0.4623 + x * (0.08406 + x * (0.005341 - 0.00331 * x))))
    return 0.0266958 * jnp.sqrt(molar_mass * T) / (length**2 * omega)


def _air(T: Any) -> Any:
    return _lennard_jones(T, 28.9586, 103.3, 0.360)


def _nitrogen(T: Any) -> Any:
    return _lennard_jones(T, 28.01348, 98.94, 0.3656)


_TRANSPORT = {"temperature": (70.0, 2000.0)}


@formula(
    source="lemmon2004, eq. 2",
    equation=r"\eta_0 = \frac{0.0266958\sqrt{MT}}{\sigma^2\,\Omega(T^*)}",
    fitted=_TRANSPORT,
    output="dynamic_viscosity",
    title="Viscosity of dry air (Lemmon–Jacobsen)",
    symbols={"dynamic_viscosity": r"\eta_0"},
)
def air_viscosity(temperature: Temperature) -> DynamicViscosity:
    """Viscosity of dry air at low pressure, within 1 %; at 1 bar the density adds less than 0.1 %.

    >>> round(air_viscosity(temperature=300.0) * 1e6, 3)
    18.523
    """
    return 1e-6 * _air(temperature)


@formula(
    source="lemmon2004, eq. 5",
    equation=(
        r"\lambda_0 = N_1\eta_0 + N_2\tau^{t_2} + N_3\tau^{t_3},\quad \tau = \frac{132.6312\,\mathrm "
        r"K}{T}"
    ),
    fitted=_TRANSPORT,
    output="thermal_conductivity",
    title="Thermal conductivity of dry air (Lemmon–Jacobsen)",
    symbols={"thermal_conductivity": r"\lambda_0"},
)
def air_conductivity(temperature: Temperature) -> ThermalConductivity:
    """Thermal conductivity of dry air at low pressure, within 2 %.

    >>> round(air_conductivity(temperature=300.0) * 1e3, 3)
    26.353
    """
    tau = 132.6312 / temperature
    return 1e-3 * (1.308 * _air(temperature) + 1.405 * tau**-1.1 - 1.036 * tau**-0.3)


def _einstein(x: Any) -> Any:
    """x² eˣ / (eˣ − 1)², written so that large x does not overflow."""
    e = jnp.exp(-x)
    return x**2 * e / (1.0 - e) ** 2


@formula(
    source="lemmon2000, eq. 18",
    fitted={"temperature": (60.0, 2000.0)},
    output="specific_heat_capacity",
    title="Heat capacity of dry air (Lemmon)",
)
def air_heat_capacity(temperature: Temperature) -> HeatCapacity:
    """Isobaric heat capacity of dry air as an ideal gas; at 1 bar and 300 K the real gas lies 0.17 % higher.

    >>> round(air_heat_capacity(temperature=300.0), 0)
    1005.0
    """
    T = temperature
    e = jnp.exp(-11580.4 / T)
    tail = 0.197938904 * (11580.4 / T) ** 2 * (2 / 3) * e / (1.0 + (2 / 3) * e) ** 2
    series = (
        3.490888032
        + T * (2.395525583e-6 + T * (7.172111248e-9 - 3.115413101e-13 * T))
        + 0.223806688 * T**-1.5
    )
    return (
        8.314510
        / MOLAR_MASS_AIR
        * (series + 0.791309509 * _einstein(3364.011 / T) + 0.212236768 * _einstein(2242.45 / T) + tail)
    )


@formula(
    source="lemmon2004, eq. 2",
    equation=r"\eta_0 = \frac{0.0266958\sqrt{MT}}{\sigma^2\,\Omega(T^*)}",
    fitted=_TRANSPORT,
    output="dynamic_viscosity",
    title="Viscosity of nitrogen (Lemmon–Jacobsen)",
    symbols={"dynamic_viscosity": r"\eta_0"},
)
def nitrogen_viscosity(temperature: Temperature) -> DynamicViscosity:
    """Viscosity of nitrogen at low pressure, within 0.5 %.

    >>> round(nitrogen_viscosity(temperature=300.0) * 1e6, 4)
    17.8771
    """
    return 1e-6 * _nitrogen(temperature)


@formula(
    source="lemmon2004, eq. 5",
    equation=(
        r"\lambda_0 = N_1\eta_0 + N_2\tau^{t_2} + N_3\tau^{t_3},\quad \tau = \frac{126.192\,\mathrm "
        r"K}{T}"
    ),
    fitted=_TRANSPORT,
    output="thermal_conductivity",
    title="Thermal conductivity of nitrogen (Lemmon–Jacobsen)",
    symbols={"thermal_conductivity": r"\lambda_0"},
)
def nitrogen_conductivity(temperature: Temperature) -> ThermalConductivity:
    """Thermal conductivity of nitrogen at low pressure, within 2 %.

    >>> round(nitrogen_conductivity(temperature=300.0) * 1e3, 4)
    25.9361
    """
    tau = 126.192 / temperature
    return 1e-3 * (1.511 * _nitrogen(temperature) + 2.117 * tau**-1.0 - 3.332 * tau**-0.7)


@formula(
    source="span2000, eq. 53",
    fitted={"temperature": (63.0, 1000.0)},
    output="specific_heat_capacity",
    title="Heat capacity of nitrogen (Span)",
)
def nitrogen_heat_capacity(temperature: Temperature) -> HeatCapacity:
    """Isobaric heat capacity of nitrogen as an ideal gas.

    >>> round(nitrogen_heat_capacity(temperature=300.0), 0)
    1040.0
    """
    T = temperature
    series = (
        3.5 + T * (3.066469e-6 + T * (4.701240e-9 - 3.987984e-13 * T)) + 1.012941 * _einstein(3364.011 / T)
    )
    return 8.314510 / MOLAR_MASS_NITROGEN * series
