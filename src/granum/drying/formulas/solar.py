"""Drying by the sun: a flat collector of hot air, the draft of a chimney, and what wind and radiation take
from a wet surface in the open.
"""

from __future__ import annotations

from typing import NamedTuple

import jax
import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import GAS_CONSTANT, STANDARD_ATMOSPHERE, STANDARD_GRAVITY
from granum.core.kinds import (
    Area,
    Fraction,
    HeatCapacity,
    HeatFlux,
    HeatTransferCoefficient,
    Length,
    MassFlow,
    MassFlux,
    PositiveNumber,
    Power,
    Pressure,
    PressureDrop,
    Ratio,
    RelativeHumidity,
    Speed,
    Temperature,
)
from granum.humid_gas.pairs import AIR_WATER
from granum.materials.formulas.steam import water_heat_of_vaporization
from granum.materials.formulas.water import water_vapor_pressure
from granum.numerics import safe_divide

AIR_HEAT = 1013.0  # J/(kg K), of moist air, as the psychrometric constant of the source has it
WIND, WIND_SLOPE = 6.43e6 / 86400.0 / 1e3, 0.536  # W/(m² Pa) and s/m


class SolarHeat(NamedTuple):
    """What a collector gives to its air."""

    heat_duty: Power
    temperature_outlet: Temperature
    heat_removal_factor: Ratio
    solar_efficiency: Ratio


@formula(
    source="duffie2013, ch. 6",
    equation=(
        r"\dot Q = A F_R\left[\tau\alpha\,G - U_L (T_1 - T_a)\right],\quad "
        r"F_R = \frac{\dot m c}{A U_L}\left(1 - e^{-A U_L F'/\dot m c}\right),\quad "
        r"T_2 = T_1 + \frac{\dot Q}{\dot m c},\quad \eta = \frac{\dot Q}{A G}"
    ),
    typical={
        "irradiance": (200.0, 1000.0),
        "area_collector": (2.0, 50.0),
        "mass_flow": (0.05, 1.0),
        "temperature_inlet": (288.15, 308.15),
        "temperature_air": (288.15, 308.15),
    },
    title="Flat-plate solar collector",
    symbols={
        "irradiance": "G",
        "area_collector": "A",
        "mass_flow": r"\dot m",
        "temperature_inlet": "T_1",
        "temperature_air": "T_a",
        "temperature_outlet": "T_2",
        "heat_duty": r"\dot Q",
        "specific_heat_capacity": "c",
    },
)
def solar_collector(
    irradiance: HeatFlux,
    area_collector: Area,
    mass_flow: MassFlow,
    temperature_inlet: Temperature,
    temperature_air: Temperature,
    transmittance_absorptance: Fraction = 0.8,
    heat_loss_coefficient: HeatTransferCoefficient = 6.0,
    collector_efficiency_factor: Fraction = 0.75,
    specific_heat_capacity: HeatCapacity = 1007.0,
) -> SolarHeat:
    """Heat that a flat collector gives to the air that passes it, after Hottel, Whillier and Bliss.

    ``collector_efficiency_factor`` is the share of the heat that the air would take if the absorber had its
    temperature: 0.6 to 0.8 for air under a bare plate. Source not opened, the equation itself read elsewhere;
    its example for water, remembered: A 2 m², U_L 8 W/(m² K), F' 0.841 and 0.03 kg/s give F_R = 0.797.

    >>> found = solar_collector(
    ...     800.0, 2.0, 0.03, 293.15, 293.15, 0.8, 8.0, 0.841, specific_heat_capacity=4190.0
    ... )
    >>> round(float(found.heat_removal_factor), 2)
    0.8
    """
    capacity, loss = mass_flow * specific_heat_capacity, area_collector * heat_loss_coefficient
    units = safe_divide(loss * collector_efficiency_factor, capacity)
    removal = safe_divide(capacity, loss, 1.0) * -jnp.expm1(-units)
    # without loss all that the plate takes
    removal = jnp.where(loss > 0.0, removal, 1.0)
    taken = transmittance_absorptance * irradiance - heat_loss_coefficient * (
        temperature_inlet - temperature_air
    )
    heat = area_collector * removal * taken
    return SolarHeat(
        heat,
        temperature_inlet + safe_divide(heat, capacity),
        removal,
        safe_divide(heat, area_collector * irradiance),
    )


class Draft(NamedTuple):
    """Draft of a chimney and the speed that it drives."""

    pressure_drop: PressureDrop
    velocity: Speed


@formula(
    source="duffie2013",
    equation=(
        r"\Delta p = \frac{p M g H}{R}\left(\frac{1}{T_a} - \frac{1}{T_g}\right),\quad "
        r"v = \sqrt{\frac{2\,\Delta p\,R\,T_g}{\zeta\,p M}}"
    ),
    typical={"height": (2.0, 10.0), "temperature": (303.15, 333.15), "temperature_air": (288.15, 308.15)},
    title="Draft of a chimney",
    symbols={"temperature": "T_g", "temperature_air": "T_a", "velocity": "v", "pressure": "p"},
)
def chimney_draft(
    height: Length,
    temperature: Temperature,
    temperature_air: Temperature,
    loss_coefficient: PositiveNumber = 5.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
) -> Draft:
    """Pressure that warm air in a chimney gives, and its speed there when everything on its way loses
    ``loss_coefficient`` velocity heads.

    Derived from the weights of the two columns of air. By hand: 5 m of 45 °C in 25 °C weigh
    5 · 9.81 · (1.184 − 1.110) = 3.65 Pa less. Air no warmer than outside gives none.

    >>> round(float(chimney_draft(5.0, "45 degC", "25 degC").pressure_drop), 2)
    3.65
    """
    cold, warm = (
        pressure * AIR_WATER.gas_molar_mass / (GAS_CONSTANT * T) for T in (temperature_air, temperature)
    )
    draft = jnp.maximum((cold - warm) * STANDARD_GRAVITY * height, 0.0)
    square = 2.0 * draft / (loss_coefficient * warm)
    return Draft(draft, jnp.sqrt(jnp.where(square > 0.0, square, 1.0)) * (square > 0.0))


@formula(
    source="penman1948; shuttleworth1993, eq. 4.2.30",
    equation=(
        r"N = \frac{\Delta\,R_n/\lambda + \gamma\,f(u)\,p_s (1 - \varphi)}{\Delta + \gamma},\quad "
        r"\Delta = \frac{dp_s}{dT},\quad \gamma = \frac{c\,p}{0.622\,\lambda},\quad "
        r"f(u) = \frac{6.43\,(1 + 0.536\,u)}{\lambda}\ \mathrm{MJ/(m^2\,d\,kPa)}"
    ),
    typical={
        "net_radiation": (50.0, 600.0),
        "wind_speed": (0.5, 6.0),
        "temperature": (283.15, 313.15),
        "relative_humidity": (0.2, 0.9),
    },
    output="drying_flux",
    title="Drying in the open by sun and wind",
    symbols={"drying_flux": "N", "temperature": "T", "net_radiation": "R_n", "wind_speed": "u"},
)
def drying_flux_penman(
    net_radiation: HeatFlux,
    wind_speed: Speed,
    temperature: Temperature,
    relative_humidity: RelativeHumidity,
    pressure: Pressure = STANDARD_ATMOSPHERE,
) -> MassFlux:
    """Water that a wet surface in the open loses: what the radiation that stays with it evaporates, and what
    wind and dry air do by themselves.

    For crops, hides or clay spread to dry, as long as they are wet; below the critical moisture the flux
    falls. ``net_radiation`` is that which the surface keeps, after reflection and what it radiates to the
    sky; wind in m/s at 2 m. The temperature of the surface drops out since vapor pressure is taken as
    straight between surface and air. Sources not opened. The slope of the vapor pressure at 20 °C is 145 Pa/K
    and γ 67 Pa/K: at saturation 0.68 of the radiation evaporates.

    >>> open_air = drying_flux_penman("200 W/m2", "2 m/s", "20 degC", "50 %")
    >>> flux = drying_flux_penman(200.0, 2.0, 293.15, 1.0)
    >>> bool(open_air > flux)
    True
    >>> round(float(flux * water_heat_of_vaporization(293.15)) / 200.0, 2)
    0.68
    """
    T = jnp.asarray(temperature, dtype=float)
    saturated, slope = jax.jvp(water_vapor_pressure.function, (T,), (jnp.ones_like(T),))
    latent = water_heat_of_vaporization.function(T)
    gamma = AIR_HEAT * pressure / (AIR_WATER.molar_mass_ratio * latent)
    wind = WIND * (1.0 + WIND_SLOPE * wind_speed) / latent
    dry = saturated * (1.0 - relative_humidity)
    return (slope * net_radiation / latent + gamma * wind * dry) / (slope + gamma)
