"""Single properties of a humid gas from temperature, humidity and pressure."""

from __future__ import annotations

import jax.numpy as jnp

import granum.humid_gas.relations as rel
from granum.core import flags, formula
from granum.core.constants import STANDARD_ATMOSPHERE, ZERO_CELSIUS
from granum.core.kinds import (
    Density,
    HeatCapacity,
    HumidityRatio,
    Position,
    PositiveNumber,
    Pressure,
    RelativeHumidity,
    SpecificEnergy,
    SpecificVolume,
    Temperature,
)
from granum.humid_gas.formulas.state import RANGE, GasVaporPair, within_pair
from granum.humid_gas.pairs import AIR_WATER

_SOURCE = "ashrae2017, ch. 1; wagner2002; lemmon2000; iapwsif97, eq. 30"
BOILS = "The limit is the boiling point."
_WARM = {"temperature": (303.15, 363.15), "humidity_ratio": (0.002, 0.02), "pressure": (8e4, 2e5)}


def _gas(pair: GasVaporPair, T: Temperature, w: HumidityRatio, P: Pressure) -> rel.Gas:
    within_pair(pair, P)
    return rel.settled(
        pair,
        jnp.asarray(T, dtype=float),
        jnp.asarray(P, dtype=float),
        pair.fraction(jnp.asarray(w, dtype=float)),
    )


@formula(
    source="ashrae2017, ch. 1, eq. 3",
    equation=r"p = 101325\,(1 - 2.25577\times 10^{-5}\,Z)^{5.2559}",
    fitted={"altitude": (-5000.0, 11000.0)},
    title="Air pressure at an altitude",
)
def pressure_at_altitude(altitude: Position) -> Pressure:
    """Pressure of the standard atmosphere at a height above sea level, to put into every formula of humid
    air.

    A sensible default where the barometer is not known; weather moves it by a few percent.

    >>> round(pressure_at_altitude(altitude="1500 m"))
    84556
    """
    return STANDARD_ATMOSPHERE * jnp.maximum(1.0 - 2.25577e-5 * altitude, 1e-3) ** 5.2559


@formula(
    source=_SOURCE,
    equation=r"w = \frac{M_v}{M_g}\,\frac{p_v}{p - p_v}",
    typical={"vapor_pressure": (500.0, 2e4)},
    title="Humidity ratio from vapor pressure",
)
def humidity_ratio(
    vapor_pressure: Pressure, pressure: Pressure = STANDARD_ATMOSPHERE, pair: GasVaporPair = AIR_WATER
) -> HumidityRatio:
    """Mass of vapor per mass of dry gas at a partial pressure of the vapor.

    >>> round(humidity_ratio(vapor_pressure="2339 Pa"), 4)
    0.0147
    """
    y = jnp.where(vapor_pressure < pressure, vapor_pressure / pressure, jnp.nan)
    flags.impossible(vapor_pressure >= pressure, vapor_pressure, "vapor_pressure", 0.0, pressure)
    return pair.humidity_ratio(y)


@formula(
    source=_SOURCE, equation=r"p_v = p\,\frac{w}{M_v/M_g + w}", title="Vapor pressure from humidity ratio"
)
def vapor_pressure(
    humidity_ratio: HumidityRatio, pressure: Pressure = STANDARD_ATMOSPHERE, pair: GasVaporPair = AIR_WATER
) -> Pressure:
    """Partial pressure of the vapor in a gas of given humidity ratio.

    >>> round(vapor_pressure(humidity_ratio=0.0147))
    2340
    """
    return pair.fraction(humidity_ratio) * pressure


@formula(
    source=_SOURCE,
    equation=r"w_s = \frac{M_v}{M_g}\,\frac{p_s(T)}{p - p_s(T)}",
    fitted=RANGE,
    typical={"temperature": (275.0, 365.0), "pressure": (8e4, 2e5)},
    title="Humidity ratio at saturation",
)
def humidity_ratio_saturated(
    temperature: Temperature, pressure: Pressure = STANDARD_ATMOSPHERE, pair: GasVaporPair = AIR_WATER
) -> HumidityRatio:
    """Humidity ratio of saturated gas, over ice below the triple point; no value at and above the boiling
    point.

    >>> [
    ...     round(humidity_ratio_saturated(temperature=t), 4)
    ...     for t in ("0 degC", "10 degC", "20 degC", "30 degC")
    ... ]
    [0.0038, 0.0076, 0.0147, 0.0272]
    """
    within_pair(pair, pressure)
    y = rel.saturated_fraction(pair, jnp.asarray(temperature), pressure)
    if flags.listening():
        flags.impossible(
            y >= 1,
            temperature,
            "temperature",
            -jnp.inf,
            pair.boiling_temperature(jnp.asarray(pressure)),
            BOILS,
        )
    return pair.humidity_ratio(jnp.where(y < 1, y, jnp.nan))


@formula(
    source=_SOURCE,
    equation=r"\varphi = p_v/p_s(T),\quad p_v = \frac{w\,p}{w + M_v/M_g}",
    fitted=RANGE,
    typical=_WARM,
    title="Relative humidity",
)
def relative_humidity(
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
) -> RelativeHumidity:
    """Vapor pressure over the saturation pressure at the same temperature; 1 in fog.

    >>> round(relative_humidity(temperature="55 degC", humidity_ratio=0.01), 2)
    0.1
    """
    gas = _gas(pair, temperature, humidity_ratio, pressure)
    return gas.y / rel.saturated_fraction(pair, gas.T, pressure)


@formula(
    source=_SOURCE,
    equation=r"T_r = T_s(p_v),\quad p_s(T_s) = p_v,\quad p_v = \frac{w\,p}{w + M_v/M_g}",
    fitted={"dew_point_temperature": RANGE["temperature"]},
    typical=_WARM,
    title="Dew or frost point",
)
def dew_point_temperature(
    humidity_ratio: HumidityRatio, pressure: Pressure = STANDARD_ATMOSPHERE, pair: GasVaporPair = AIR_WATER
) -> Temperature:
    """Temperature at which cooling at constant humidity brings the first drop, or the first ice below the
    triple point.

    >>> round(dew_point_temperature(humidity_ratio=0.01) - 273.15, 1)
    14.0
    """
    within_pair(pair, pressure)
    return rel.dew_point(
        pair, jnp.asarray(pressure, dtype=float), pair.fraction(jnp.asarray(humidity_ratio, dtype=float))
    )


@formula(
    source=_SOURCE,
    equation=r"h = h_g(T) + w\,h_v(T)",
    fitted=RANGE,
    typical=_WARM,
    title="Enthalpy of a humid gas",
)
def enthalpy(
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
) -> SpecificEnergy:
    """Enthalpy per mass of dry gas, zero for dry gas and for liquid at 0 °C; fog counts as liquid or ice.

    >>> round(enthalpy(temperature="55 degC", humidity_ratio=0.01) / 1e3, 1)
    81.4
    """
    return rel.enthalpy_of(
        pair, _gas(pair, temperature, humidity_ratio, pressure), jnp.asarray(pressure, dtype=float)
    )


@formula(
    source="ashrae2017, ch. 1, eq. 30",
    equation=r"h = c_g t + w\,(L_0 + c_v t)",
    fitted={"temperature": (273.15, 333.15)},
    typical={**_WARM, "temperature": (283.15, 333.15)},
    output="enthalpy",
    title="Enthalpy of a humid gas, constant heat capacities",
    symbols={"temperature": "t"},
)
def enthalpy_linear(
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    gas_heat_capacity: HeatCapacity = 1006.0,
    vapor_heat_capacity: HeatCapacity = 1860.0,
    heat_of_vaporization: SpecificEnergy = 2.501e6,
) -> SpecificEnergy:
    """Hand form of the enthalpy of humid air, with the handbook's constants unless others are given.

    The notes print 1.01 θ + w (2494 + 1.92 θ) in kJ/kg and 595 Y + (0.24 + 0.47 Y) t in kcal/kg: give their
    constants to repeat them. With the handbook's constants it stays within 41 J/kg of ``air_water`` from 0 to
    60 °C, up to a humidity ratio of 0.03.

    >>> round(
    ...     enthalpy_linear(
    ...         temperature="50 degC",
    ...         humidity_ratio=0.02,
    ...         gas_heat_capacity="0.24 kcal/(kg*K)",
    ...         vapor_heat_capacity="0.47 kcal/(kg*K)",
    ...         heat_of_vaporization="595 kcal/kg",
    ...     )
    ...     / 4184,
    ...     2,
    ... )
    24.37
    """
    t = temperature - ZERO_CELSIUS
    return gas_heat_capacity * t + humidity_ratio * (heat_of_vaporization + vapor_heat_capacity * t)


@formula(
    source=_SOURCE,
    equation=r"v = \frac{R T}{p M_g}\left(1 + \frac{M_g}{M_v} w\right)",
    fitted=RANGE,
    typical=_WARM,
    title="Volume of a humid gas per mass of dry gas",
)
def specific_volume(
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
) -> SpecificVolume:
    """Volume of humid gas per mass of dry gas; drops of fog take none.

    >>> round(specific_volume(temperature="22.2 degC", humidity_ratio=0.01005), 2)
    0.85
    """
    return rel.volume_of(
        pair, _gas(pair, temperature, humidity_ratio, pressure), jnp.asarray(pressure, dtype=float)
    )


@formula(
    source=_SOURCE,
    equation=r"\rho_g = \frac{1 + w}{v},\quad v = v(T, w, p)",
    fitted=RANGE,
    typical=_WARM,
    output="gas_density",
    title="Density of a humid gas",
)
def gas_density(
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
) -> Density:
    """Mass of humid gas, vapor and fog included, per volume.

    >>> round(gas_density(temperature="20 degC", humidity_ratio=0.0), 3)
    1.204
    """
    gas = _gas(pair, temperature, humidity_ratio, pressure)
    return (1.0 + humidity_ratio) / rel.volume_of(pair, gas, jnp.asarray(pressure, dtype=float))


@formula(
    source=_SOURCE,
    equation=r"h(T, w) + (w_s - w)\,h_l(T_{as}) = h_s(T_{as})",
    fitted=RANGE,
    typical=_WARM,
    title="Adiabatic-saturation temperature",
)
def adiabatic_saturation_temperature(
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
) -> Temperature:
    """Temperature that a gas reaches when liquid of that same temperature evaporates into it until it is
    saturated.

    Sought between freezing and the lower of dry bulb and boiling point, so it is right for hot, moist gas
    too. Where a state over liquid and one over ice exist, just around 0 °C, the liquid one is given.

    >>> round(adiabatic_saturation_temperature(temperature="150 degC", humidity_ratio=1.0) - 273.15, 1)
    87.7
    """
    within_pair(pair, pressure)
    return rel.wet_bulb_of_total(pair, temperature, pressure, humidity_ratio, None)


@formula(
    source="keey1978; chilton1934; bedingfield1950; ashrae2017, ch. 1",
    equation=r"(w_s(T_h) - w)\,L_v(T_h) = \mathrm{Le}_f\,[h_g + w\,h_v]_{T_h}^{T}",
    fitted=RANGE,
    typical=_WARM,
    title="Wet-bulb temperature",
)
def wet_bulb_temperature(
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
    lewis_factor: PositiveNumber | None = None,
) -> Temperature:
    """Temperature of a small wet surface in a stream of gas: the temperature of a product in its
    constant-rate period.

    For air and water it is the adiabatic-saturation temperature (the Lewis factor is 1 by convention); for
    other pairs the Lewis factor of the pair lifts it above. Heat by radiation and conduction is left out.

    >>> round(wet_bulb_temperature(temperature="22.2 degC", humidity_ratio=0.01) - 273.15, 1)
    17.0
    """
    within_pair(pair, pressure)
    lewis = pair.lewis_factor() if lewis_factor is None else lewis_factor
    return rel.wet_bulb_of_total(pair, temperature, pressure, humidity_ratio, lewis)
