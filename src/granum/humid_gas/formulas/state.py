"""The full state of a humid gas from any two of its properties."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax
import jax.numpy as jnp

import granum.humid_gas.relations as rel
from granum.core import flags, formula
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    HeatCapacity,
    HumidityRatio,
    Law,
    MassRatio,
    MoleFraction,
    PositiveNumber,
    Pressure,
    Ratio,
    RelativeHumidity,
    SpecificEnergy,
    SpecificVolume,
    Temperature,
)
from granum.humid_gas.inputs import Solver
from granum.humid_gas.pairs import AIR_WATER, LEAST_PRESSURE, MOST_PRESSURE

GasVaporPair = Annotated[Any, Law("gas_vapor_pair")]
NO_DEW_POINT = (
    "The gas is so dry that its dew point lies below the coldest temperature of the pair, which is given "
    "instead."
)
IDEAL = "Both gases are taken as ideal there: give the pair air_water_real, which is the real mixture."
NO_SATURATION = (
    "Above the boiling point no gas is saturated and percentage humidity has no meaning: give the "
    "humidity ratio."
)
RANGE = {"temperature": (213.0, 623.2)}  # that of the pressure is the pair's


class HumidGasState(NamedTuple):
    """Everything about a humid gas; per kg of dry gas where a mass is meant."""

    temperature: Temperature
    humidity_ratio: HumidityRatio
    relative_humidity: RelativeHumidity
    wet_bulb_temperature: Temperature
    adiabatic_saturation_temperature: Temperature
    dew_point_temperature: Temperature
    enthalpy: SpecificEnergy
    specific_volume: SpecificVolume
    density: Density
    vapor_pressure: Pressure
    vapor_mole_fraction: MoleFraction
    condensate_ratio: MassRatio
    percentage_humidity: Ratio
    saturation_pressure: Pressure
    humid_heat: HeatCapacity


def within_pair(pair: Any, pressure: Any) -> None:
    """Inside a formula body: flag pressures at which the substances of a pair are no longer what it takes
    them for.
    """
    P, highest = jnp.asarray(pressure), pair.highest_pressure
    flags.extrapolated(
        (P < LEAST_PRESSURE) | (highest < P),
        P,
        "pressure",
        LEAST_PRESSURE,
        highest,
        IDEAL if highest < MOST_PRESSURE else "",
    )


@formula(
    source="ashrae2017, ch. 1; keey1978; wagner2002; lemmon2000; iapwsif97, eq. 30",
    equation=r"w = \frac{M_v}{M_g}\frac{p_v}{p-p_v},\quad h = h_g(T) + w\,h_v(T),\quad "
    r"(w_s(T_w)-w)\,L_v(T_w) = \frac{h}{k_Y c}\,[h_g + w h_v]_{T_w}^{T}",
    fitted=RANGE,
    typical={"temperature": (303.15, 363.15), "humidity_ratio": (0.002, 0.02), "pressure": (8e4, 2e5)},
    output="humid_gas_state",
    title="State of a humid gas",
)
def state(
    temperature: Temperature | None = None,
    humidity_ratio: HumidityRatio | None = None,
    relative_humidity: RelativeHumidity | None = None,
    wet_bulb_temperature: Temperature | None = None,
    adiabatic_saturation_temperature: Temperature | None = None,
    dew_point_temperature: Temperature | None = None,
    enthalpy: SpecificEnergy | None = None,
    specific_volume: SpecificVolume | None = None,
    vapor_pressure: Pressure | None = None,
    percentage_humidity: Ratio | None = None,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
    lewis_factor: PositiveNumber | None = None,
) -> HumidGasState:
    """State of a humid gas from any two of its properties, at any pressure and for any gas–vapor pair.

    Temperatures below the triple point are over ice. A humidity ratio or enthalpy beyond saturation gives
    fog: saturated gas with ``condensate_ratio`` kg of drops per kg of dry gas, to which humidity ratio and
    enthalpy then belong too, but not the humid heat. The dew point of perfectly dry gas does not exist; the
    coldest temperature of the pair is given instead. A relative humidity above the boiling point is vapor
    pressure over saturation pressure. Percentage humidity is humidity ratio over that at saturation, which
    has no end above the boiling point (0 there); as an input it goes with the temperature alone. Wet bulb and
    enthalpy lie nearly on one line and fix the state badly: that is flagged.

    Air and water are ideal gases by default, as in most textbooks. The tables of ASHRAE, and pressures above
    a few bar, are of the real mixture: ``pair="air_water_real"``. Solvents: ``pair="nitrogen_ethanol"``,
    ``"air_acetone"`` and others, or ``GasAndVapor`` of any two.

    The notes' reading at 22.2 °C dry and 17 °C wet: 60 %, 47.8 kJ/kg, dew point 14 °C.

    >>> air = state(temperature="22.2 degC", wet_bulb_temperature="17 degC")
    >>> (
    ...     round(air.relative_humidity, 2),
    ...     round(air.enthalpy / 1e3, 1),
    ...     round(air.dew_point_temperature - 273.15),
    ... )
    (0.6, 47.7, 14)
    """
    given = {
        "temperature": temperature,
        "humidity_ratio": humidity_ratio,
        "vapor_pressure": vapor_pressure,
        "dew_point_temperature": dew_point_temperature,
        "relative_humidity": relative_humidity,
        "wet_bulb_temperature": wet_bulb_temperature,
        "adiabatic_saturation_temperature": adiabatic_saturation_temperature,
        "enthalpy": enthalpy,
        "specific_volume": specific_volume,
    }
    given = {name: jnp.asarray(value, dtype=float) for name, value in given.items() if value is not None}
    P = jnp.asarray(pressure, dtype=float)
    within_pair(pair, P)
    if percentage_humidity is not None:
        given["humidity_ratio"] = _from_percentage(
            pair, P, given, jnp.asarray(percentage_humidity, dtype=float)
        )
    lewis = pair.lewis_factor() if lewis_factor is None else lewis_factor
    gas, possible = Solver(pair, P, lewis, given).solve()
    if percentage_humidity is not None:
        given["percentage_humidity"] = jnp.asarray(percentage_humidity, dtype=float)
    return describe(pair, gas, P, lewis, possible, given)


def _from_percentage(pair: Any, P: Any, given: dict[str, Any], share: Any) -> Any:
    """Humidity ratio of a percentage humidity at the temperature given with it."""
    if list(given) != ["temperature"]:
        raise InputError(
            _(
                "Percentage humidity fixes a state beside the temperature alone; given with it: {names}."
            ).format(names=", ".join(given) or _("none")),
            given=list(given),
        )
    ys = rel.saturated_fraction(pair, given["temperature"], P)
    flags.impossible(ys >= 1.0, given["temperature"], "temperature", reason=NO_SATURATION)
    return share * pair.humidity_ratio(jnp.where(ys < 1.0, ys, jnp.nan))


def describe(
    pair: Any, gas: rel.Gas, P: Any, lewis: Any, possible: Any, given: dict[str, Any]
) -> HumidGasState:
    """All properties of a solved state; the given ones are repeated exactly, an impossible state is NaN and
    flagged.
    """
    T = jnp.where(possible, gas.T, 300.0)
    y = jnp.where(possible, gas.y, 0.0)
    fog = jnp.where(possible, gas.fog, 0.0)
    gas = rel.Gas(T, y, fog)
    ys = rel.saturated_fraction(pair, T, P)
    adiabatic = rel.polished_wet_bulb(pair, T, P, y, None)
    wet = adiabatic if lewis is None else rel.polished_wet_bulb(pair, T, P, y, lewis)
    outside = (pair.lowest_temperature > T) | (pair.highest_temperature < T)
    flags.record(
        flags.EXTRAPOLATED,
        possible & outside,
        T,
        "temperature",
        "humid_gas.state",
        pair.lowest_temperature,
        pair.highest_temperature,
    )
    critical = pair.highest_condensation
    if critical < jnp.inf:
        above = possible & (wet > critical)
        flags.record(
            flags.EXTRAPOLATED,
            above,
            wet,
            "wet_bulb_temperature",
            "humid_gas.state",
            pair.lowest_temperature,
            critical,
        )
    driest = y < rel.saturated_fraction(pair, jnp.asarray(pair.lowest_temperature), P)
    flags.limit_active(possible & driest, pair.lowest_temperature, "dew_point_temperature", NO_DEW_POINT)
    humidity = rel.humidity_of(pair, gas)
    heat = jax.jvp(lambda T: pair.molar_enthalpy(T, P, y), (T,), (jnp.ones_like(T),))[1]
    values = {
        "temperature": T,
        "humidity_ratio": humidity,
        "relative_humidity": y / ys,
        "wet_bulb_temperature": wet,
        "adiabatic_saturation_temperature": adiabatic,
        "dew_point_temperature": rel.dew_point(pair, P, y),
        "enthalpy": rel.enthalpy_of(pair, gas, P),
        "specific_volume": rel.volume_of(pair, gas, P),
        "vapor_pressure": y * P,
        "vapor_mole_fraction": y,
        "condensate_ratio": pair.molar_mass_ratio * fog,
        "percentage_humidity": jnp.where(ys < 1.0, humidity, 0.0)
        * jnp.maximum(1.0 - ys, 0.0)
        / (pair.molar_mass_ratio * ys),
        "saturation_pressure": ys * P,
        "humid_heat": heat / ((1.0 - y) * pair.gas_molar_mass),
    }
    mass = (1.0 - y) * pair.gas_molar_mass * (1.0 + pair.molar_mass_ratio * fog) + y * pair.vapor_molar_mass
    values["density"] = mass / pair.molar_volume(T, P, y)
    values |= given
    shape = jnp.broadcast_shapes(*(jnp.shape(v) for v in values.values()), jnp.shape(possible))
    return HumidGasState(
        **{
            name: jnp.where(possible, jnp.broadcast_to(values[name], shape), jnp.nan)
            for name in HumidGasState._fields
        }
    )
