"""Grain in a bin through which ambient air is blown: a front that cools, and far behind it one that dries."""

from __future__ import annotations

from typing import Annotated, Any, Literal, NamedTuple

import jax.numpy as jnp

import granum.humid_gas.relations as rel
from granum.core import formula, unconverged
from granum.core.constants import STANDARD_ATMOSPHERE, ZERO_CELSIUS
from granum.core.datasets import dataset
from granum.core.kinds import (
    Area,
    Density,
    HeatCapacity,
    Mass,
    MassRatio,
    MoistureDryBasis,
    PositiveNumber,
    Power,
    Pressure,
    PressureDrop,
    RelativeHumidity,
    SpecificEnergy,
    Speed,
    Temperature,
    Time,
    VolumeFlow,
    Within,
)
from granum.drying.formulas.beds import pressure_gradient_shedd
from granum.drying.formulas.moisture import IsothermLaw
from granum.drying.isotherms.base import bounded
from granum.drying.isotherms.products import PRODUCTS
from granum.humid_gas.pairs import AIR_WATER
from granum.numerics import find_root, safe_divide
from granum.streams.utilities import fanned

MAIZE = PRODUCTS["maize"]()
WATER_HEAT = 4187.0  # J/(kg K)
COLDEST, HOTTEST = 230.0, 350.0  # K
PASSES = 4  # each a tenth or less of the last
NEAR = 1e-3  # K of a front below which the slope stands for the chord
Grain = Literal[
    "barley",
    "flaxseed",
    "lentils",
    "maize",
    "oats",
    "rough rice",
    "sorghum",
    "soybeans",
    "wheat",
]


class Fronts(NamedTuple):
    """Grain behind the cooling front and behind the drying front, and the dry air that each front takes."""

    temperature_cooled: Temperature
    moisture_dry_basis_cooled: MoistureDryBasis
    moisture_dry_basis_equilibrium: MoistureDryBasis
    air_per_grain_cooling: MassRatio
    air_per_grain_drying: MassRatio


class _Air(NamedTuple):
    """Air in equilibrium with grain: humidity ratio and enthalpy per dry air."""

    humidity: Any
    enthalpy: Any


def _over(isotherm: Any, X: Any, T: Any, P: Any) -> _Air:
    """Air over grain of a moisture and temperature."""
    return _at(bounded(isotherm.activity(X, T)), T, P)


def _at(relative_humidity: Any, T: Any, P: Any) -> _Air:
    y = relative_humidity * rel.saturated_fraction(AIR_WATER, T, P)
    gas = rel.Gas(T, y, jnp.zeros_like(y))
    return _Air(AIR_WATER.humidity_ratio(y), rel.enthalpy_of(AIR_WATER, gas, P))


@formula(
    source="sutherland1971",
    equation=(
        r"h(T_B, Y^*(X_B, T_B)) = h(T_a, Y_a(\varphi)),\quad "
        r"\Gamma_c = \frac{(c_s + X c_w)(T_g - T_B)}{h_g - h_B - c_w t_B (Y_g - Y_B)},\quad "
        r"X_B = X - \Gamma_c (Y_g - Y_B),\quad \Gamma_d = \frac{X_B - X_a}{Y_B - Y_a}"
    ),
    typical={
        "temperature": (288.15, 308.15),
        "temperature_air": (278.15, 298.15),
        "relative_humidity": (0.4, 0.7),
        "moisture_dry_basis": (0.2, 0.28),
    },
    title="Fronts of aerated grain",
    symbols={"temperature": "T_g", "temperature_air": "T_a", "specific_heat_capacity": "c_s"},
)
def aeration_fronts(
    temperature: Temperature,
    moisture_dry_basis: MoistureDryBasis,
    temperature_air: Temperature,
    relative_humidity: RelativeHumidity,
    isotherm: IsothermLaw = MAIZE,
    specific_heat_capacity: HeatCapacity = 1500.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
) -> Fronts:
    """Air leaves grain in equilibrium with it: a fast front brings the grain to the temperature at which air
    and grain meet adiabatically, a slow one far behind to the moisture of the air.

    Real fronts are wider: the air that they take is the least. Warm air warms the grain, and moist air wets
    it, in the same way. Heat of sorption beyond vaporization is left out. Source not opened: derived from the
    balances of water and heat across each front.

    Grain gives off water as it cools: an extension service (read) counts a quarter of a percent, wet basis,
    per 10 °F, which are 5.6 K; here 0.22 % for 4.9 K.

    >>> found = aeration_fronts("80 degF", 0.15, "70 degF", 0.65)
    >>> x = float(found.moisture_dry_basis_cooled)
    >>> round(100 * (0.15 / 1.15 - x / (1 + x)), 2), round(float(found.temperature_cooled) - 273.15, 1)
    (0.22, 21.8)
    """
    X, Tg, Ta, P = moisture_dry_basis, temperature, temperature_air, pressure
    air = _at(relative_humidity, Ta, P)

    def front(cooled: Any) -> tuple[Any, ...]:
        """Plateau over grain of a moisture: its temperature, air taken, moisture by the balance of water."""
        plateau = find_root(
            lambda T, X, P, h: _over(isotherm, X, T, P).enthalpy - h,
            COLDEST,
            HOTTEST,
            cooled,
            P,
            air.enthalpy,
            start=Ta,
        )
        unconverged(plateau.converged)
        Tb, none = plateau.value, abs(Tg - plateau.value) < NEAR
        far = jnp.where(none, Tb + NEAR, Tg)  # the chord of a front that is none
        ahead, behind = _over(isotherm, X, far, P), _over(isotherm, cooled, Tb, P)
        taken = ahead.humidity - behind.humidity
        heat = ahead.enthalpy - behind.enthalpy - WATER_HEAT * (Tb - ZERO_CELSIUS) * taken
        air_taken = (specific_heat_capacity + X * WATER_HEAT) * (far - Tb) / heat
        return Tb, air_taken, X - air_taken * jnp.where(none, 0.0, taken), behind

    cooled = X + 0.0 * Tg
    for _pass in range(PASSES):
        Tb, cooling, cooled, behind = front(cooled)
    dry = isotherm(relative_humidity, Ta)
    change = behind.humidity - air.humidity
    drying = safe_divide(cooled - dry, change)
    return Fronts(Tb, cooled, dry, cooling, jnp.maximum(drying, 0.0))


def resistance_of(grain: str) -> dict[str, float]:
    """Coefficient and constant of Shedd's law for a grain, and the speeds between which they were fitted."""
    row = {str(r["grain"]): r for r in dataset("drying", "airflow_asaed272")}[grain]
    return {name: float(row[name]) for name in ("coefficient", "constant", "velocity_low", "velocity_high")}


class Aerated(NamedTuple):
    """Fan and times of an aerated bin; grain behind the fronts."""

    superficial_velocity: Speed
    pressure_drop: PressureDrop
    electric_power_fan: Power
    time_cooling: Time
    specific_energy_cooling: SpecificEnergy
    time_drying: Time
    temperature_cooled: Temperature
    moisture_dry_basis_cooled: MoistureDryBasis
    moisture_dry_basis_equilibrium: MoistureDryBasis


@formula(
    source="asaed272; sutherland1971",
    equation=(
        r"U = \frac{Q}{A},\quad \Delta p = f\,L\,\frac{a\,U^2}{\ln(1 + b\,U)},\quad "
        r"L = \frac{m}{\rho_b A},\quad t = \Gamma(T_g, X, T_a, \varphi)\,\frac{m/(1 + X)}{Q\,\rho_a}"
    ),
    typical={
        "mass": (2e4, 1e6),
        "area": (20.0, 200.0),
        "bulk_density": (600.0, 800.0),
        "volume_flow": (0.5, 5.0),
        "temperature": (288.15, 308.15),
        "temperature_air": (278.15, 298.15),
        "relative_humidity": (0.4, 0.7),
        "moisture_dry_basis": (0.2, 0.28),
    },
    fitted={"superficial_velocity": (0.0056, 0.152)},
    title="Aeration of a grain bin",
    symbols={"temperature": "T_g", "temperature_air": "T_a", "packing_resistance": "f"},
)
def bin_aeration(
    mass: Mass,
    area: Area,
    volume_flow: VolumeFlow,
    temperature: Temperature,
    moisture_dry_basis: MoistureDryBasis,
    temperature_air: Temperature,
    relative_humidity: RelativeHumidity,
    grain: Grain = "maize",
    isotherm: IsothermLaw = MAIZE,
    bulk_density: Density = 720.0,
    packing_resistance: Annotated[PositiveNumber, Within(0.5, 3.0)] = 1.5,
    specific_heat_capacity: HeatCapacity = 1500.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
) -> Aerated:
    """Pressure, fan power and time to cool a bin of grain with ambient air, and to bring it to the moisture
    of the air.

    ``temperature_air`` and ``relative_humidity`` are those of the air as it enters the grain, behind the fan;
    ``grain`` names the resistance to air, ``isotherm`` the moisture in equilibrium. ``packing_resistance``
    multiplies the resistance of loose, clean, dry grain: up to 1.5 where it was not spread well. Times are
    those of fronts without width, the least: extension services (read) count 100 to 200 h for cooling at
    0.1 cfm per bushel, here 90 h, and 45 to 50 days for drying maize from 20 % at 1 cfm per bushel with air
    of 45 °F and 60 %, here 36 days.

    >>> found = bin_aeration(1e5, 30.0, "3937 ft^3/min", "45 degF", 0.25, "45 degF", 0.6)
    >>> round(found.time_drying / 86400, 1)
    35.9
    """
    U, depth = volume_flow / area, mass / (bulk_density * area)
    row = resistance_of(grain)
    resistance = pressure_gradient_shedd.function(U, row["coefficient"], row["constant"])
    lost = packing_resistance * depth * resistance
    power = fanned(volume_flow, lost)
    found = aeration_fronts.function(
        temperature,
        moisture_dry_basis,
        temperature_air,
        relative_humidity,
        isotherm,
        specific_heat_capacity,
        pressure,
    )
    y = relative_humidity * rel.saturated_fraction(AIR_WATER, temperature_air, pressure)
    volume = rel.volume_of(AIR_WATER, rel.Gas(temperature_air, y, 0.0 * y), pressure)
    per_air = mass / (1.0 + moisture_dry_basis) / (volume_flow / volume)
    cooling, drying = found.air_per_grain_cooling * per_air, found.air_per_grain_drying * per_air
    return Aerated(
        U,
        lost,
        power,
        cooling,
        power * cooling / mass,
        drying,
        found.temperature_cooled,
        found.moisture_dry_basis_cooled,
        found.moisture_dry_basis_equilibrium,
    )
