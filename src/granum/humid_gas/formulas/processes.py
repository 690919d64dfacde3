"""Processes of a humid gas at constant pressure: every one is a line between two states on the charts."""

from __future__ import annotations

from math import inf
from typing import Any, NamedTuple

import jax.numpy as jnp

import granum.humid_gas.relations as rel
from granum.core import flags, formula
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.kinds import (
    Fraction,
    HumidityRatio,
    MassFlow,
    MassRatio,
    Power,
    Pressure,
    RelativeHumidity,
    SpecificEnergy,
    Temperature,
)
from granum.humid_gas.formulas.state import RANGE, GasVaporPair, within_pair
from granum.humid_gas.pairs import AIR_WATER

_SOURCE = "ashrae2017, ch. 1; keey1978"
SHARES = "The shares of the fuel add up to more than 1."
BURNT = "The fuel holds more oxygen than it can burn with."
ONLY_WATER = "So little air leaves no dry gas."
TOO_HOT = (
    "The gas would be hotter than 1230 °C, where it dissociates: no temperature is given. Take more air."
)
_WARM = {
    "temperature": (303.15, 343.15),
    "humidity_ratio": (0.005, 0.015),
    "pressure": (9e4, 2e5),
    "dry_gas_flow": (1.0, 2.0),
}


class Process(NamedTuple):
    """The gas after a process."""

    temperature: Temperature
    humidity_ratio: HumidityRatio
    relative_humidity: RelativeHumidity
    enthalpy: SpecificEnergy
    condensate_ratio: MassRatio


class Duty(NamedTuple):
    """The gas after an exchange of heat, the heat given to it, and what drained off."""

    temperature: Temperature
    humidity_ratio: HumidityRatio
    relative_humidity: RelativeHumidity
    enthalpy: SpecificEnergy
    heat_duty: Power
    condensate_flow: MassFlow


def gas_at(pair: Any, T: Any, w: Any, P: Any) -> tuple[rel.Gas, Any]:
    """State and enthalpy at temperature and humidity ratio, fog included."""
    T, w, P = (jnp.asarray(x, dtype=float) for x in (T, w, P))
    within_pair(pair, P)
    gas = rel.settled(pair, T, P, pair.fraction(w))
    return gas, rel.enthalpy_of(pair, gas, P)


def after(pair: Any, w: Any, h: Any, P: Any) -> Process:
    """The state of humidity ratio w and enthalpy h."""
    w, h, P = (jnp.asarray(x, dtype=float) for x in (w, h, P))
    within_pair(pair, P)
    y = pair.fraction(w)
    T = rel.temperature_at_enthalpy(pair, P, y, h)
    gas = rel.settled(pair, T, P, y)
    return Process(
        T,
        w + 0.0 * T,
        gas.y / rel.saturated_fraction(pair, T, P),
        h + 0.0 * T,
        pair.molar_mass_ratio * gas.fog,
    )


@formula(
    source=_SOURCE,
    equation=r"w = \frac{G_1 w_1 + G_2 w_2}{G_1+G_2},\quad h = \frac{G_1 h_1 + G_2 h_2}{G_1+G_2}",
    fitted=RANGE,
    typical={
        "humidity_ratio_first": (0.005, 0.01),
        "humidity_ratio_second": (0.01, 0.02),
        "enthalpy_first": (4e4, 5e4),
        "enthalpy_second": (8e4, 1e5),
    },
    title="Mixing of two humid gases",
    output="humid_process",
    symbols={
        "dry_gas_flow_first": "G_1",
        "humidity_ratio_first": "w_1",
        "enthalpy_first": "h_1",
        "dry_gas_flow_second": "G_2",
        "humidity_ratio_second": "w_2",
        "enthalpy_second": "h_2",
    },
)
def mixing(
    dry_gas_flow_first: MassFlow,
    humidity_ratio_first: HumidityRatio,
    enthalpy_first: SpecificEnergy,
    dry_gas_flow_second: MassFlow,
    humidity_ratio_second: HumidityRatio,
    enthalpy_second: SpecificEnergy,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
) -> Process:
    """Adiabatic mixing of two gases: on a straight line between them, in proportion to their dry gas; fog
    where it passes saturation.

    The exercise of the notes (D I.3.2): 1.5 kg at 100 kJ/kg and 0.027 with 2.5 kg at 160 kJ/kg and 0.04. They
    print 46.5 °C and 0.58.

    >>> mixed = mixing(1.5, 0.027, 100e3, 2.5, 0.04, 160e3)
    >>> round(mixed.enthalpy / 1e3, 1), round(mixed.humidity_ratio, 4)
    (137.5, 0.0351)
    """
    total = dry_gas_flow_first + dry_gas_flow_second
    w = (dry_gas_flow_first * humidity_ratio_first + dry_gas_flow_second * humidity_ratio_second) / total
    h = (dry_gas_flow_first * enthalpy_first + dry_gas_flow_second * enthalpy_second) / total
    return after(pair, w, h, pressure)


@formula(
    source=_SOURCE,
    equation=r"\dot Q = G\,(h_2 - h_1),\qquad w_2 = w_1,\qquad h_1 = h(T_1, w_1),\ h_2 = h(T_2, w_1)",
    title="Heating of a humid gas",
    output="humid_process",
    fitted={**RANGE, "temperature_outlet": RANGE["temperature"]},
    typical={**_WARM, "temperature": (285.0, 300.0), "temperature_outlet": (320.0, 400.0)},
    symbols={
        "temperature": "T_1",
        "humidity_ratio": "w_1",
        "=temperature": "T_2",
        "=humidity_ratio": "w_2",
        "=enthalpy": "h_2",
        "=relative_humidity": r"\varphi_2",
        "temperature_outlet": "T_2",
    },
)
def heating(
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    temperature_outlet: Temperature,
    dry_gas_flow: MassFlow = 1.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
) -> Duty:
    """Heating at constant humidity to a temperature: a horizontal line on the psychrometric chart.

    By hand: 1.006·40 + 0.01·1.86·40 = 41.0 kJ per kg of dry air.

    >>> round(
    ...     heating(temperature="20 degC", humidity_ratio=0.01, temperature_outlet="60 degC").heat_duty / 1e3,
    ...     1,
    ... )
    41.0
    """
    _gas, h1 = gas_at(pair, temperature, humidity_ratio, pressure)
    gas, h2 = gas_at(pair, temperature_outlet, humidity_ratio, pressure)
    phi = gas.y / rel.saturated_fraction(pair, gas.T, pressure)
    return Duty(gas.T, humidity_ratio + 0.0 * h2, phi, h2, dry_gas_flow * (h2 - h1), 0.0 * dry_gas_flow * h2)


@formula(
    source=_SOURCE,
    equation=r"h_2 = h_1 + \dot Q/G,\qquad w_2 = w_1,\quad h_1 = h(T_1, w_1)",
    title="Heating of a humid gas by a duty",
    output="humid_process",
    fitted=RANGE,
    typical={**_WARM, "heat_duty": (1e4, 5e4)},
    symbols={
        "temperature": "T_1",
        "humidity_ratio": "w_1",
        "=temperature": "T_2",
        "=humidity_ratio": "w_2",
        "=enthalpy": "h_2",
        "=relative_humidity": r"\varphi_2",
    },
)
def heating_by_duty(
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    heat_duty: Power,
    dry_gas_flow: MassFlow = 1.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
) -> Process:
    """The state after a heat duty at constant humidity; a negative duty cools, fog staying in the gas.

    >>> round(
    ...     heating_by_duty(temperature="20 degC", humidity_ratio=0.01, heat_duty="41 kW").temperature
    ...     - 273.15,
    ...     0,
    ... )
    60.0
    """
    _gas, h1 = gas_at(pair, temperature, humidity_ratio, pressure)
    return after(pair, humidity_ratio, h1 + heat_duty / dry_gas_flow, pressure)


@formula(
    source=_SOURCE,
    equation=(
        r"\dot Q = G\left[h_2 - h_1 + (w_1-w_2) h_l(T_2)\right],\quad w_2 = \min(w_1, w_s(T_2)),\quad "
        r"h_1 = h(T_1, w_1)"
    ),
    title="Cooling with condensation",
    output="humid_process",
    fitted={**RANGE, "temperature_outlet": RANGE["temperature"]},
    typical={**_WARM, "temperature_outlet": (276.0, 282.0)},
    symbols={
        "temperature": "T_1",
        "humidity_ratio": "w_1",
        "=temperature": "T_2",
        "=humidity_ratio": "w_2",
        "=enthalpy": "h_2",
        "=relative_humidity": r"\varphi_2",
        "temperature_outlet": "T_2",
    },
)
def cooling(
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    temperature_outlet: Temperature,
    dry_gas_flow: MassFlow = 1.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
) -> Duty:
    """Cooling to a temperature; below the dew point the condensate drains at the outlet temperature and the
    gas leaves saturated.

    >>> cold = cooling(temperature="30 degC", humidity_ratio=0.02, temperature_outlet="10 degC")
    >>> round(cold.humidity_ratio, 4), round(cold.condensate_flow, 4), round(cold.heat_duty / 1e3, 1)
    (0.0076, 0.0124, -51.5)
    """
    _gas, h1 = gas_at(pair, temperature, humidity_ratio, pressure)
    gas, h_fog = gas_at(pair, temperature_outlet, humidity_ratio, pressure)
    drained = pair.molar_mass_ratio * gas.fog
    dry = rel.Gas(gas.T, gas.y, 0.0 * gas.fog)
    phi = gas.y / rel.saturated_fraction(pair, gas.T, pressure)
    return Duty(
        gas.T,
        pair.humidity_ratio(gas.y),
        phi,
        rel.enthalpy_of(pair, dry, pressure),
        dry_gas_flow * (h_fog - h1),
        dry_gas_flow * drained,
    )


@formula(
    source="ashrae2017, ch. 1; mcquiston2005",
    equation=(
        r"w_2 = \mathrm{BF}\,w_1 + (1-\mathrm{BF})\,\min(w_1, w_s(T_b)),\quad h_2 = \mathrm{BF}\,h(T_1, "
        r"w_1) + (1-\mathrm{BF})\,h(T_b, w_s)"
    ),
    title="Dehumidifying coil with bypass",
    output="humid_process",
    fitted={**RANGE, "coil_temperature": RANGE["temperature"]},
    typical={**_WARM, "coil_temperature": (276.0, 282.0)},
    symbols={
        "temperature": "T_1",
        "humidity_ratio": "w_1",
        "=temperature": "T_2",
        "=humidity_ratio": "w_2",
        "=enthalpy": "h_2",
        "=relative_humidity": r"\varphi_2",
    },
)
def dehumidifying(
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    coil_temperature: Temperature,
    coil_bypass_fraction: Fraction = 0.1,
    dry_gas_flow: MassFlow = 1.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
) -> Duty:
    """A cold coil: part of the gas leaves saturated at the temperature of the surface, the rest passes it
    unchanged.

    >>> out = dehumidifying(
    ...     temperature="30 degC", humidity_ratio=0.016, coil_temperature="8 degC", coil_bypass_fraction=0.1
    ... )
    >>> round(out.humidity_ratio, 4), round(out.temperature - 273.15, 1)
    (0.0076, 10.2)
    """
    _gas, h1 = gas_at(pair, temperature, humidity_ratio, pressure)
    cold, h_fog = gas_at(pair, coil_temperature, humidity_ratio, pressure)
    drained = pair.molar_mass_ratio * cold.fog
    touched = rel.enthalpy_of(pair, rel.Gas(cold.T, cold.y, 0.0 * cold.fog), pressure)
    share = 1.0 - coil_bypass_fraction
    w2 = humidity_ratio - share * drained
    h2 = coil_bypass_fraction * h1 + share * touched
    out = after(pair, w2, h2, pressure)
    return Duty(
        out.temperature,
        w2 + 0.0 * h2,
        out.relative_humidity,
        h2,
        dry_gas_flow * share * (h_fog - h1),
        dry_gas_flow * share * drained,
    )


@formula(
    source=_SOURCE,
    equation=r"w_2 = w_1 + \dot m_i/G,\quad h_2 = h_1 + h_i\,\dot m_i/G,\quad h_1 = h(T_1, w_1)",
    title="Injection of water or steam",
    output="humid_process",
    fitted=RANGE,
    typical=_WARM,
    symbols={
        "temperature": "T_1",
        "humidity_ratio": "w_1",
        "=temperature": "T_2",
        "=humidity_ratio": "w_2",
        "=enthalpy": "h_2",
        "=relative_humidity": r"\varphi_2",
    },
)
def injection(
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    injected_flow: MassFlow,
    injected_enthalpy: SpecificEnergy,
    dry_gas_flow: MassFlow = 1.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
) -> Process:
    """Injection of liquid or vapor of the pair's own substance; its enthalpy counts from the liquid at 0 °C.

    Saturated steam at 1 bar has 2675 kJ/kg, water at 20 °C has 84 kJ/kg. Beyond saturation the excess is fog.

    >>> out = injection(
    ...     temperature="25 degC", humidity_ratio=0.005, injected_flow=0.005, injected_enthalpy="2675 kJ/kg"
    ... )
    >>> round(out.humidity_ratio, 3), round(out.temperature - 273.15, 1)
    (0.01, 25.6)
    """
    _gas, h1 = gas_at(pair, temperature, humidity_ratio, pressure)
    ratio = injected_flow / dry_gas_flow
    return after(pair, humidity_ratio + ratio, h1 + injected_enthalpy * ratio, pressure)


@formula(
    source=_SOURCE,
    equation=r"h_2 = h_1 + (w_2 - w_1)\,h_l(T_{as}),\quad h_1 = h(T_1, w_1)",
    title="Adiabatic drying",
    output="humid_process",
    fitted=RANGE,
    typical={**_WARM, "humidity_ratio": (0.005, 0.01), "humidity_ratio_outlet": (0.011, 0.014)},
    symbols={
        "temperature": "T_1",
        "humidity_ratio": "w_1",
        "=temperature": "T_2",
        "=humidity_ratio": "w_2",
        "=enthalpy": "h_2",
        "=relative_humidity": r"\varphi_2",
        "humidity_ratio_outlet": "w_2",
    },
)
def adiabatic_drying(
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    humidity_ratio_outlet: HumidityRatio,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
) -> Process:
    """Gas that takes up moisture from a product at its adiabatic-saturation temperature, without loss: a line
    of constant wet bulb.

    >>> out = adiabatic_drying(temperature="80 degC", humidity_ratio=0.01, humidity_ratio_outlet=0.02)
    >>> round(out.temperature - 273.15, 1)
    55.9
    """
    P = jnp.asarray(pressure, dtype=float)
    gas, h1 = gas_at(pair, temperature, humidity_ratio, P)
    Ts = rel.wet_bulb(pair, gas.T, P, gas.y, None)
    liquid = pair.condensate_molar_enthalpy(Ts, P, pair.is_frozen(Ts)) / pair.vapor_molar_mass
    return after(pair, humidity_ratio_outlet, h1 + (humidity_ratio_outlet - humidity_ratio) * liquid, P)


@formula(
    source=_SOURCE,
    equation=r"h_2 = h_1 + \Delta\,(w_2 - w_1),\quad h_1 = h(T_1, w_1)",
    title="Real drying",
    output="humid_process",
    fitted=RANGE,
    typical={
        **_WARM,
        "humidity_ratio": (0.005, 0.01),
        "humidity_ratio_outlet": (0.011, 0.014),
        "drying_slope": (-4e5, -2e5),
    },
    symbols={
        "temperature": "T_1",
        "humidity_ratio": "w_1",
        "=temperature": "T_2",
        "=humidity_ratio": "w_2",
        "=enthalpy": "h_2",
        "=relative_humidity": r"\varphi_2",
        "humidity_ratio_outlet": "w_2",
    },
)
def real_drying(
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    humidity_ratio_outlet: HumidityRatio,
    drying_slope: SpecificEnergy = 0.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
) -> Process:
    """Gas through a dryer whose losses and additions per kilogram of evaporated water are summed in the
    drying slope.

    A slope of zero is the isenthalpic drying of the notes; losses make it negative and the outlet colder.

    >>> out = real_drying(
    ...     temperature="80 degC", humidity_ratio=0.01, humidity_ratio_outlet=0.02, drying_slope="-300 kJ/kg"
    ... )
    >>> round(out.temperature - 273.15, 1)
    51.8
    """
    _gas, h1 = gas_at(pair, temperature, humidity_ratio, pressure)
    return after(
        pair, humidity_ratio_outlet, h1 + drying_slope * (humidity_ratio_outlet - humidity_ratio), pressure
    )


class Recirculation(NamedTuple):
    """Gas entering and leaving a dryer that recirculates."""

    humidity_ratio_inlet: HumidityRatio
    humidity_ratio_outlet: HumidityRatio
    dry_gas_flow_fresh: MassFlow


@formula(
    source="keey1978",
    equation=r"w_2 = w_0 + \frac{e}{1-r},\qquad w_1 = w_2 - e,\qquad G_0 = (1-r)\,G",
    title="Recirculation of a dryer's gas",
    output="humid_process",
    typical={"humidity_ratio_fresh": (0.005, 0.01)},
    symbols={
        "humidity_ratio_fresh": "w_0",
        "humidity_ratio_inlet": "w_1",
        "humidity_ratio_outlet": "w_2",
        "dry_gas_flow_fresh": "G_0",
    },
)
def recirculation(
    humidity_ratio_fresh: HumidityRatio,
    evaporation_per_dry_gas: MassRatio,
    recirculated_fraction: Fraction,
    dry_gas_flow: MassFlow = 1.0,
) -> Recirculation:
    """Steady humidity before and after a dryer whose outlet gas returns in part: the loop builds up until the
    exhaust carries it all.

    By hand: fresh 0.01, 0.01 taken up per pass, 80 % returned, exhaust 0.01 + 0.01/0.2 = 0.06.

    >>> round(recirculation(0.01, 0.01, 0.8).humidity_ratio_outlet, 6)
    0.06
    """
    w2 = humidity_ratio_fresh + evaporation_per_dry_gas / (1.0 - recirculated_fraction)
    fresh = (1.0 - recirculated_fraction) * dry_gas_flow
    return Recirculation(w2 - evaporation_per_dry_gas, w2, fresh + 0.0 * w2)


class CombustionGas(NamedTuple):
    """Flue gas of a direct burner, dry part taken as air."""

    temperature: Temperature
    humidity_ratio: HumidityRatio
    enthalpy: SpecificEnergy
    air_per_fuel: MassRatio
    dry_gas_per_fuel: MassRatio


@formula(
    source="keey1978",
    equation=(
        r"m_{a} = n\,\frac{x_C/12.011 + x_H/4.032 + x_S/32.06 - x_O/31.998}{0.2095}\,28.966,\quad h = "
        r"\frac{m_a h_a + \mathrm{PCI} + L_0\,(9x_H + x_W)}{m_g},\quad w = w(x_H, x_W),\ T = T(h, w)"
    ),
    fitted={"excess_air_ratio": (4.0, inf)},
    typical={
        "temperature": (285.0, 300.0),
        "fuel_fraction_hydrogen": (0.1, 0.2),
        "fuel_fraction_carbon": (0.7, 0.75),
        "humidity_ratio": (0.004, 0.01),
        "excess_air_ratio": (4.0, 10.0),
        "fuel_fraction_oxygen": (0.0, 0.02),
        "fuel_fraction_sulfur": (0.0, 0.01),
        "fuel_fraction_water": (0.0, 0.01),
        "heat_loss_share": (0.01, 0.05),
        "lower_heating_value": (4e7, 5e7),
    },
    title="Combustion gas for direct firing",
    symbols={
        "fuel_fraction_carbon": "x_C",
        "fuel_fraction_hydrogen": "x_H",
        "fuel_fraction_oxygen": "x_O",
        "fuel_fraction_sulfur": "x_S",
        "fuel_fraction_water": "x_W",
    },
)
def combustion_gas(
    fuel_fraction_carbon: Fraction,
    fuel_fraction_hydrogen: Fraction,
    lower_heating_value: SpecificEnergy,
    excess_air_ratio: MassRatio,
    temperature: Temperature = 298.15,
    humidity_ratio: HumidityRatio = 0.01,
    fuel_fraction_oxygen: Fraction = 0.0,
    fuel_fraction_sulfur: Fraction = 0.0,
    fuel_fraction_water: Fraction = 0.0,
    heat_loss_share: Fraction = 0.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
) -> CombustionGas:
    """Gas of a burner fired straight into the drying air: its humidity, enthalpy and temperature, complete
    combustion.

    The dry flue gas is taken as air, within 1 % of its enthalpy from four times the air needed. Hydrogen
    burns to nine times its mass of water. Methane needs 17.2 kg of air per kg.

    >>> gas = combustion_gas(
    ...     fuel_fraction_carbon=0.749,
    ...     fuel_fraction_hydrogen=0.251,
    ...     lower_heating_value="50 MJ/kg",
    ...     excess_air_ratio=5.0,
    ... )
    >>> round(gas.air_per_fuel)
    86
    >>> gas = combustion_gas(
    ...     fuel_fraction_carbon=0.749,
    ...     fuel_fraction_hydrogen=0.251,
    ...     lower_heating_value="50 MJ/kg",
    ...     excess_air_ratio=1.0,
    ... )
    >>> round(gas.air_per_fuel, 1)
    17.2
    """
    P = jnp.asarray(pressure, dtype=float)
    oxygen = (
        fuel_fraction_carbon / 12.011
        + fuel_fraction_hydrogen / 4.032
        + fuel_fraction_sulfur / 32.06
        - fuel_fraction_oxygen / 31.998
    )
    others = fuel_fraction_hydrogen + fuel_fraction_oxygen + fuel_fraction_sulfur + fuel_fraction_water
    too_much = fuel_fraction_carbon + others > 1.0 + 1e-9
    flags.impossible(too_much, fuel_fraction_carbon, "fuel_fraction_carbon", 0.0, 1.0 - others, SHARES)
    flags.impossible(oxygen < 0.0, fuel_fraction_oxygen, "fuel_fraction_oxygen", reason=BURNT)
    air = excess_air_ratio * oxygen / 0.2095 * 28.966
    water = 8.937 * fuel_fraction_hydrogen + fuel_fraction_water
    dry = air + 1.0 - water
    flags.impossible(~(dry > 0.0), excess_air_ratio, "excess_air_ratio", reason=ONLY_WATER)
    _gas, h1 = gas_at(AIR_WATER, temperature, humidity_ratio, P)
    latent = AIR_WATER.vapor_molar_enthalpy(273.15) / AIR_WATER.vapor_molar_mass
    # the lower heating value leaves the water as vapor; the scale of enthalpies counts from the liquid
    h2 = (air * h1 + lower_heating_value * (1.0 - heat_loss_share) + latent * water) / dry
    w2 = (air * humidity_ratio + water) / dry
    out = after(AIR_WATER, w2, h2, P)
    flags.limit_active(jnp.isnan(out.temperature), excess_air_ratio, "excess_air_ratio", TOO_HOT)
    return CombustionGas(out.temperature, w2 + 0.0 * h2, h2, air + 0.0 * h2, dry + 0.0 * h2)


@formula(
    source="keey1978",
    equation=r"\Delta = h_l(T_{s1}) - q_s - q_{loss} + q_{add}",
    fitted={"temperature_solid": (273.15, 623.15)},
    typical={
        "temperature_solid": (285.0, 300.0),
        "specific_energy_solid": (5e4, 2e5),
        "specific_energy_loss": (5e4, 2e5),
        "specific_energy_added": (1e4, 5e4),
    },
    title="Drying slope from losses",
    symbols={
        "temperature_solid": "T_{s1}",
    },
)
def drying_slope(
    temperature_solid: Temperature,
    specific_energy_solid: SpecificEnergy = 0.0,
    specific_energy_loss: SpecificEnergy = 0.0,
    specific_energy_added: SpecificEnergy = 0.0,
) -> SpecificEnergy:
    """Change of the gas's enthalpy per kilogram of water taken up: what the water brings less what solid and
    surroundings take.

    All per kilogram of evaporated water: heat to warm the solid, heat lost, heat added inside the dryer.
    Water is liquid: from 0 to 350 °C, where the fit of its enthalpy ends.

    >>> round(
    ...     drying_slope(
    ...         temperature_solid="20 degC",
    ...         specific_energy_solid="150 kJ/kg",
    ...         specific_energy_loss="200 kJ/kg",
    ...     )
    ...     / 1e3
    ... )
    -266
    """
    liquid = (
        AIR_WATER.condensate_molar_enthalpy(jnp.asarray(temperature_solid), STANDARD_ATMOSPHERE, False)
        / AIR_WATER.vapor_molar_mass
    )
    return liquid - specific_energy_solid - specific_energy_loss + specific_energy_added
