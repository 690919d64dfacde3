"""Ways to save heat in a dryer, per kilogram of dry air or of evaporated water."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import jax
import jax.numpy as jnp

from granum.core import flags, formula
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.kinds import (
    Fraction,
    HumidityRatio,
    MassRatio,
    OpenFraction,
    PositiveNumber,
    Pressure,
    Ratio,
    RelativeHumidity,
    SpecificEnergy,
    SpecificMoistureExtraction,
    Temperature,
    TemperatureDifference,
    Within,
)
from granum.drying.balances.convective import COLDEST, PAIR, enthalpy, humidity_at, temperature_of
from granum.humid_gas.formulas.processes import combustion_gas
from granum.humid_gas.formulas.processes import cooling as cooled
from granum.materials.formulas.steam import steam_density, steam_enthalpy, steam_heat_capacity
from granum.materials.formulas.water import water_boiling_temperature, water_enthalpy
from granum.numerics import find_root

NOTHING_TAKEN = "The air would leave no more humid than it came: it takes no water."
_FRESH = {
    "temperature_fresh": (285.0, 300.0),
    "humidity_ratio_fresh": (0.005, 0.009),
    "relative_humidity_outlet": (0.6, 0.9),
}


class StagedHeating(NamedTuple):
    """Air after the last stage, and the heat of all heaters."""

    temperature_outlet: Temperature
    humidity_ratio_outlet: HumidityRatio
    energy_per_water: SpecificEnergy
    dry_gas_per_water: MassRatio
    specific_energy_heating: SpecificEnergy


@formula(
    source="keey1978; mujumdar2014; wagner2002; iapws2011melting",
    fitted={"temperature_fresh": (213.0, 623.2), "temperature_inlet": (213.0, 623.2)},
    equation=(
        r"q = \sum_k (h_{1,k} - h_{2,k-1}),\qquad \mathrm{CEM} = \frac{q}{w_{2,n} - w_0},\qquad h_{1,k} "
        r"= h(T_1, w_{2,k-1}),\ h_{2,k} = h_{1,k},\ h_{2,0} = h(T_0, w_0),\ w_{2,k} = w(T_{2,k}, "
        r"\varphi_2)"
    ),
    typical={**_FRESH, "temperature_inlet": (335.0, 360.0)},
    title="Dryer with staged heating",
    symbols={
        "temperature_fresh": "T_0",
        "humidity_ratio_fresh": "w_0",
        "temperature_inlet": "T_1",
        "temperature_outlet": "T_2",
        "humidity_ratio_outlet": "w_2",
    },
)
def staged_heating(
    temperature_fresh: Temperature,
    humidity_ratio_fresh: HumidityRatio,
    temperature_inlet: Temperature,
    relative_humidity_outlet: RelativeHumidity,
    stage_count: Annotated[int, Within(1, 20)] = 2,
    pressure: Pressure = STANDARD_ATMOSPHERE,
) -> StagedHeating:
    """Air that is heated again and again to the same temperature and dries isenthalpically to the same
    relative humidity in between.

    The same air carries more water, so less of it is heated from the outside; the notes (D III.3) advise it
    for that reason.

    Without a second stage it is the dryer of the notes' maize: 2 550 kJ/kg at saturation.

    Temperatures are those of the air–water properties behind it, 213 to 623.2 K.

    >>> one = staged_heating("25 degC", "9.9 g/kg", "50 degC", "100 %", stage_count=1)
    >>> two = staged_heating("25 degC", "9.9 g/kg", "50 degC", "100 %", stage_count=2)
    >>> round(one.energy_per_water / 1e5, 1), two.dry_gas_per_water < one.dry_gas_per_water
    (25.4, True)
    """
    P = jnp.asarray(pressure, dtype=float)
    T, w, phi = (
        jnp.asarray(temperature_fresh, dtype=float),
        jnp.asarray(humidity_ratio_fresh, dtype=float),
        relative_humidity_outlet,
    )
    heat = 0.0
    for _stage in range(int(stage_count)):
        hot = enthalpy(temperature_inlet, w, P)
        heat = heat + hot - enthalpy(T, w, P)
        T = temperature_of(P, phi=phi, h=hot)
        w = humidity_at(T, phi, P)
    taken = w - humidity_ratio_fresh
    flags.impossible(
        temperature_inlet < temperature_fresh,
        temperature_inlet,
        "temperature_inlet",
        temperature_fresh,
        jnp.inf,
    )
    flags.impossible(
        ~(taken > 0.0), relative_humidity_outlet, "relative_humidity_outlet", reason=NOTHING_TAKEN
    )
    return StagedHeating(T, w, heat / taken, 1.0 / taken, heat)


class HeatRecovery(NamedTuple):
    """Both airs after the exchanger, per kilogram of dry exhaust air."""

    specific_energy_recovered: SpecificEnergy
    temperature_fresh_heated: Temperature
    temperature_exhaust: Temperature
    humidity_ratio_exhaust: HumidityRatio
    condensate_ratio: MassRatio
    recovered_share: Ratio


@formula(
    source="keey1978; mujumdar2014; wagner2002; iapws2011melting",
    fitted={"temperature_fresh": (213.0, 623.2), "temperature_outlet": (213.0, 623.2)},
    equation=(
        r"q_r = \varepsilon\,\min\!\left(g\,[h(T_2, w_0) - h_0],\; h_2 - h(T_0, w_s) - (w_2 - w_s) "
        r"h_l\right)"
    ),
    typical={**_FRESH, "temperature_outlet": (320.0, 350.0), "humidity_ratio_outlet": (0.03, 0.06)},
    title="Recovery of heat from the exhaust",
    symbols={
        "temperature_outlet": "T_2",
        "humidity_ratio_outlet": "w_2",
        "temperature_fresh": "T_0",
        "humidity_ratio_fresh": "w_0",
        "temperature_fresh_heated": "T_0'",
        "humidity_ratio_exhaust": "w_x",
    },
)
def exhaust_heat_recovery(
    temperature_outlet: Temperature,
    humidity_ratio_outlet: HumidityRatio,
    temperature_fresh: Temperature,
    humidity_ratio_fresh: HumidityRatio,
    effectiveness: Fraction = 0.7,
    fresh_per_exhaust: PositiveNumber = 1.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
) -> HeatRecovery:
    """Fresh air warmed by the exhaust in an exchanger; below its dew point the exhaust condenses and
    drains.

    The most that can pass is what would bring one air to the other's inlet temperature, condensation
    included; the effectiveness is the share of it. ``fresh_per_exhaust`` is dry fresh air per dry exhaust
    air. ``recovered_share`` is the heat recovered over that of the exhaust above the fresh air.

    By hand, dry air from 80 against 20 °C, half of it: 1.008·30 = 30 kJ/kg.

    Temperatures are those of the air–water properties behind it, 213 to 623.2 K.

    >>> round(exhaust_heat_recovery("80 degC", 0.0, "20 degC", 0.0, 0.5).specific_energy_recovered / 1e3, 1)
    30.2
    """
    P = jnp.asarray(pressure, dtype=float)
    h2, h0 = (
        enthalpy(temperature_outlet, humidity_ratio_outlet, P),
        enthalpy(temperature_fresh, humidity_ratio_fresh, P),
    )
    flags.impossible(
        temperature_fresh > temperature_outlet,
        temperature_fresh,
        "temperature_fresh",
        0.0,
        temperature_outlet,
    )
    coldest = cooled.function(temperature_outlet, humidity_ratio_outlet, temperature_fresh, 1.0, P, PAIR)
    fresh_most = fresh_per_exhaust * (enthalpy(temperature_outlet, humidity_ratio_fresh, P) - h0)
    passed = effectiveness * jnp.minimum(fresh_most, -coldest.heat_duty)
    warm = temperature_of(P, w=humidity_ratio_fresh, h=h0 + passed / fresh_per_exhaust)

    def excess(T: jax.Array) -> jax.Array:
        return _drained(T, humidity_ratio_outlet, P)[0] - (h2 - passed)

    left = find_root(
        excess,
        jnp.minimum(temperature_fresh, temperature_outlet) - 1e-6,
        temperature_outlet + 1e-6,
        tolerance=1e-12,
    ).value
    w = _drained(left, humidity_ratio_outlet, P)[1]
    whole = h2 - enthalpy(temperature_fresh, humidity_ratio_fresh, P)
    return HeatRecovery(passed, warm, left, w, humidity_ratio_outlet - w, passed / whole)


def _drained(T: jax.Array, w: jax.Array, P: jax.Array) -> tuple[jax.Array, jax.Array]:
    """Enthalpy and humidity of air cooled to a temperature, condensate counted with it but outside the
    humidity.
    """
    most = jnp.where(PAIR.boiling_temperature(P) > T, humidity_at(T, 1.0, P), w + 1.0)
    left = jnp.minimum(w, most)
    liquid = PAIR.condensate_molar_enthalpy(T, P, False) / PAIR.vapor_molar_mass
    return enthalpy(T, left, P) + (w - left) * liquid, left


class HeatPump(NamedTuple):
    """Air and energy of a closed heat-pump dryer."""

    temperature_outlet: Temperature
    humidity_ratio_inlet: HumidityRatio
    humidity_ratio_outlet: HumidityRatio
    coefficient_of_performance: PositiveNumber
    energy_per_water: SpecificEnergy
    moisture_extraction_rate: SpecificMoistureExtraction
    dry_gas_per_water: MassRatio
    specific_energy_rejected: SpecificEnergy


@formula(
    source="mujumdar2014; keey1978; wagner2002; iapws2011melting",
    fitted={"temperature_inlet": (213.0, 623.2), "coil_temperature": (213.0, 623.2)},
    equation=(
        r"\mathrm{COP} = \eta_C\frac{T_c}{T_c - T_e},\qquad P = \frac{q_e}{\mathrm{COP} - 1},\qquad "
        r"\mathrm{SMER} = \frac{w_2 - w_1}{P},\qquad h(T_2, w_2) = h(T_1, w_1),\ w_2 = w(T_2, "
        r"\varphi_2),\ w_1 = \mathrm{BF}\,w_2 + (1 - \mathrm{BF})\,w_s(T_b)"
    ),
    typical={
        "temperature_inlet": (318.0, 333.0),
        "relative_humidity_outlet": (0.6, 0.9),
        "coil_temperature": (283.0, 288.0),
        "carnot_efficiency": (0.4, 0.6),
        "coil_bypass_fraction": (0.05, 0.3),
    },
    title="Heat-pump dryer in a closed loop",
    symbols={
        "temperature_inlet": "T_1",
        "temperature_outlet": "T_2",
        "humidity_ratio_inlet": "w_1",
        "humidity_ratio_outlet": "w_2",
    },
)
def heat_pump_dryer(
    temperature_inlet: Temperature,
    relative_humidity_outlet: RelativeHumidity,
    coil_temperature: Temperature,
    coil_bypass_fraction: Fraction = 0.1,
    carnot_efficiency: OpenFraction = 0.5,
    temperature_approach: TemperatureDifference = 5.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
) -> HeatPump:
    """Air dried on the evaporator of a heat pump, warmed on its condenser and returned: only the compressor
    is paid for.

    The dryer is isenthalpic; part of the air bypasses the coil. Evaporation and condensation lie a
    temperature approach beyond coil and hot air; the coefficient of performance is a share of Carnot's. What
    the condenser gives beyond the need of the air is rejected. Usual heat-pump dryers remove 1 to 4 kg/kWh.

    Temperatures are those of the air–water properties behind it, 213 to 623.2 K.

    >>> pump = heat_pump_dryer("50 degC", "80 %", "12 degC")
    >>> 1.0 < pump.moisture_extraction_rate * 3.6e6 < 4.0
    True
    """
    P = jnp.asarray(pressure, dtype=float)
    coil = humidity_at(coil_temperature, 1.0, P)
    BF, phi = coil_bypass_fraction, relative_humidity_outlet

    def inlet(T: jax.Array) -> tuple[jax.Array, jax.Array]:
        w2 = humidity_at(T, phi, P)
        return BF * w2 + (1.0 - BF) * coil, w2

    def mismatch(T: jax.Array) -> jax.Array:
        w1, w2 = inlet(T)
        return enthalpy(temperature_inlet, w1, P) - enthalpy(T, w2, P)

    T2 = find_root(
        mismatch,
        COLDEST,
        jnp.minimum(temperature_inlet, PAIR.boiling_temperature(P) * (1 - 1e-9)),
        tolerance=1e-15,
    ).value
    w1, w2 = inlet(T2)
    flags.impossible(
        ~(w2 > w1),
        coil_temperature,
        "coil_temperature",
        reason="The coil is too warm to take water from the air.",
    )
    taken = jnp.where(w2 > w1, w2 - w1, jnp.nan)
    liquid = PAIR.condensate_molar_enthalpy(jnp.asarray(coil_temperature), P, False) / PAIR.vapor_molar_mass
    cold = BF * enthalpy(T2, w2, P) + (1.0 - BF) * enthalpy(coil_temperature, coil, P)
    extracted = enthalpy(T2, w2, P) - cold - taken * liquid
    condensing = temperature_inlet + temperature_approach
    evaporating = coil_temperature - temperature_approach
    cop = carnot_efficiency * condensing / (condensing - evaporating)
    power = extracted / (cop - 1.0)
    needed = enthalpy(temperature_inlet, w1, P) - cold
    return HeatPump(
        T2,
        w1,
        w2,
        cop + 0.0 * T2,
        power / taken,
        taken / power,
        1.0 / taken,
        (extracted + power - needed) / taken,
    )


class SteamDrying(NamedTuple):
    """Superheated-steam dryer per kilogram of evaporated water."""

    steam_per_water: MassRatio
    energy_per_water: SpecificEnergy
    boiling_temperature: Temperature
    specific_energy_recoverable: SpecificEnergy


@formula(
    source="mujumdar2014; iapwsif97",
    fitted={
        "pressure": (611.213, 16.529e6),
        "temperature_inlet": (273.15, 1073.15),
        "temperature_outlet": (273.15, 1073.15),
    },
    equation=r"m = \frac{h_v(T_2) - h_l(T_0)}{h_v(T_1) - h_v(T_2)},\qquad \mathrm{CEM} = h_v(T_2) - h_l(T_0)",
    typical={
        "temperature_inlet": (430.0, 500.0),
        "temperature_outlet": (385.0, 410.0),
        "temperature_product": (285.0, 300.0),
        "pressure": (9e4, 1.5e5),
    },
    title="Drying in superheated steam",
    symbols={"temperature_inlet": "T_1", "temperature_outlet": "T_2", "temperature_product": "T_0"},
)
def superheated_steam_drying(
    temperature_inlet: Temperature,
    temperature_outlet: Temperature,
    temperature_product: Temperature = 293.15,
    pressure: Pressure = STANDARD_ATMOSPHERE,
) -> SteamDrying:
    """Steam that gives its superheat to the product and returns to the heater; what evaporates leaves as
    steam whose heat can be used again.

    The product boils at the saturation temperature. Recoverable is the excess steam's heat down to its
    condensate. The first condensation on the cold product is left out.

    With steam tables at 1.013 bar, 200 to 120 °C, water at 20 °C: (2716.5 − 84)/(2875.4 − 2716.5) = 16.57.

    Boiling pressures and the liquid's enthalpy hold up to 350 °C, that is 16.5 MPa. Steam does up to 800 °C.

    >>> round(superheated_steam_drying("200 degC", "120 degC", "20 degC").steam_per_water, 1)
    16.6
    """
    p = jnp.asarray(pressure, dtype=float)
    boiling = water_boiling_temperature.function(p)
    out = steam_enthalpy.function(jnp.asarray(temperature_outlet), p)
    energy = out - water_enthalpy.function(jnp.asarray(temperature_product), p)
    possible = boiling <= temperature_outlet
    flags.impossible(~possible, temperature_outlet, "temperature_outlet", boiling)
    flags.impossible(
        ~(temperature_inlet > temperature_outlet),
        temperature_inlet,
        "temperature_inlet",
        temperature_outlet,
        jnp.inf,
    )
    flags.impossible(~(energy > 0.0), temperature_product, "temperature_product", 0.0, temperature_outlet)
    ratio = energy / (steam_enthalpy.function(jnp.asarray(temperature_inlet), p) - out)
    return SteamDrying(
        jnp.where(possible, ratio, jnp.nan),
        energy,
        boiling + 0.0 * energy,
        out - water_enthalpy.function(boiling * (1.0 - 1e-9), p),
    )


class Recompression(NamedTuple):
    """Mechanical vapor recompression per kilogram of vapor."""

    energy_per_water: SpecificEnergy
    temperature_discharge: Temperature
    temperature_condensing: Temperature
    coefficient_of_performance: PositiveNumber


@formula(
    source="mujumdar2014; iapwsif97",
    fitted={"pressure_inlet": (611.213, 16.529e6), "pressure_outlet": (611.213, 16.529e6)},
    equation=(
        r"w = \frac{h(p_2, s_1) - h_1}{\eta},\qquad \mathrm{COP} = \frac{h_2 - h_l(p_2)}{w},\quad h_1 = "
        r"h_v(p_1)"
    ),
    typical={
        "pressure_inlet": (8e4, 1.2e5),
        "pressure_outlet": (1.8e5, 3e5),
        "compressor_efficiency": (0.65, 0.85),
    },
    title="Mechanical vapor recompression",
    symbols={"energy_per_water": "w"},
)
def vapor_recompression(
    pressure_inlet: Pressure, pressure_outlet: Pressure, compressor_efficiency: OpenFraction = 0.75
) -> Recompression:
    """Saturated steam from a dryer compressed so that its condensation heats the dryer.

    The work is the isentropic one of real steam over the efficiency. The notes' table III.2 gives 160 to
    200 kJ/kg of water for superheated steam with compression.

    Boiling pressures and the liquid's enthalpy hold up to 350 °C, that is 16.5 MPa.

    >>> round(vapor_recompression("1.013 bar", "2 bar", 0.75).energy_per_water / 1e3)
    167
    """
    p1, p2 = jnp.asarray(pressure_inlet, dtype=float), jnp.asarray(pressure_outlet, dtype=float)
    flags.impossible(~(p2 > p1), p2, "pressure_outlet", p1, jnp.inf)
    T1 = water_boiling_temperature.function(p1) * (1.0 + 1e-9)
    steps, start = 6, jnp.log(p1)
    dx = (jnp.log(p2) - start) / steps

    def slope(x: jax.Array, T: jax.Array) -> jax.Array:
        """dT/d ln p on an isentrope."""
        p = jnp.exp(x)
        T, p = jnp.broadcast_arrays(T, p)
        expansion = jax.jvp(lambda T: 1.0 / steam_density.function(T, p), (T,), (jnp.ones_like(T),))[1]
        return p * T * expansion / steam_heat_capacity.function(T, p)

    def advance(T: jax.Array, k: jax.Array) -> tuple[jax.Array, None]:
        x = start + k * dx
        a = slope(x, T)
        b = slope(x + dx / 2, T + dx / 2 * a)
        c = slope(x + dx / 2, T + dx / 2 * b)
        d = slope(x + dx, T + dx * c)
        return T + dx / 6 * (a + 2 * b + 2 * c + d), None

    T2s, _none = jax.lax.scan(advance, T1 + 0.0 * dx, jnp.arange(steps, dtype=float))
    h1 = steam_enthalpy.function(T1, p1)
    work = (steam_enthalpy.function(T2s, p2) - h1) / compressor_efficiency
    h2 = h1 + work
    T2 = find_root(lambda T: steam_enthalpy.function(T, p2) - h2, 300.0, 1000.0, start=T2s).value
    condensing = water_boiling_temperature.function(p2)
    return Recompression(
        work, T2, condensing + 0.0 * work, (h2 - water_enthalpy.function(condensing * (1 - 1e-9), p2)) / work
    )


class DirectFiring(NamedTuple):
    """Direct-fired dryer per kilogram of evaporated water."""

    excess_air_ratio: MassRatio
    humidity_ratio_inlet: HumidityRatio
    humidity_ratio_outlet: HumidityRatio
    relative_humidity_outlet: Ratio
    fuel_per_water: MassRatio
    dry_gas_per_water: MassRatio
    energy_per_water: SpecificEnergy


@formula(
    source="keey1978; wagner2002; iapws2011melting",
    fitted={"temperature_fresh": (213.0, 623.2), "temperature_outlet": (213.0, 623.2)},
    equation=(
        r"h_1(n) = h(T_1, w_1(n)),\qquad h_2 = h_1,\qquad \mathrm{CEM} = \frac{\mathrm{PCI}}{m_g\,(w_2 "
        r"- w_1)},\qquad h_2 = h(T_2, w_2)"
    ),
    typical={
        "temperature_inlet": (450.0, 700.0),
        "temperature_outlet": (340.0, 370.0),
        "fuel_fraction_carbon": (0.7, 0.75),
        "fuel_fraction_hydrogen": (0.2, 0.25),
        "lower_heating_value": (4.5e7, 5e7),
        "temperature_fresh": (285.0, 300.0),
        "humidity_ratio_fresh": (0.005, 0.01),
        "heat_loss_share": (0.01, 0.05),
    },
    title="Dryer fired directly",
    symbols={
        "temperature_inlet": "T_1",
        "temperature_outlet": "T_2",
        "humidity_ratio_inlet": "w_1",
        "humidity_ratio_outlet": "w_2",
    },
)
def direct_firing(
    temperature_inlet: Temperature,
    temperature_outlet: Temperature,
    fuel_fraction_carbon: Fraction = 0.749,
    fuel_fraction_hydrogen: Fraction = 0.251,
    lower_heating_value: SpecificEnergy = 50.0e6,
    temperature_fresh: Temperature = 293.15,
    humidity_ratio_fresh: HumidityRatio = 0.008,
    heat_loss_share: Fraction = 0.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
) -> DirectFiring:
    """Burner gas diluted with air to the inlet temperature, which then dries isenthalpically to the outlet
    temperature.

    The energy counts the lower heating value; the fuel (methane unless its composition is given) brings water
    of its own. A burner cannot give gas hotter than that without excess air.

    Temperatures are those of the air–water properties behind it, 213 to 623.2 K.

    >>> gas = direct_firing("400 degC", "100 degC", temperature_fresh="20 degC")
    >>> 2.9e6 < gas.energy_per_water < 3.6e6
    True
    """
    P = jnp.asarray(pressure, dtype=float)
    with flags.collect():  # without excess air it is hotter than it will ever be here
        just = combustion_gas.function(
            fuel_fraction_carbon,
            fuel_fraction_hydrogen,
            lower_heating_value,
            1.0,
            temperature_fresh,
            humidity_ratio_fresh,
            heat_loss_share=heat_loss_share,
            pressure=P,
        )
    # dilution: flue gas of one kilogram of fuel and m kilograms of dry air meet at the inlet temperature;
    # enthalpies are linear in vapor
    at_inlet = enthalpy(temperature_inlet, just.humidity_ratio, P)
    air = just.dry_gas_per_fuel * (just.enthalpy - at_inlet)
    air = air / (
        enthalpy(temperature_inlet, humidity_ratio_fresh, P)
        - enthalpy(temperature_fresh, humidity_ratio_fresh, P)
    )
    flags.impossible(
        ~(air >= 0),
        temperature_inlet,
        "temperature_inlet",
        reason="The fuel without excess air does not give gas as hot as that.",
    )
    air = jnp.where(air >= 0, air, jnp.nan)
    gas = just.dry_gas_per_fuel + air
    w1 = (just.dry_gas_per_fuel * just.humidity_ratio + air * humidity_ratio_fresh) / gas
    dry = enthalpy(temperature_outlet, 0.0, P)
    w2 = (enthalpy(temperature_inlet, w1, P) - dry) / (enthalpy(temperature_outlet, 1.0, P) - dry)
    flags.impossible(~(w2 > w1), temperature_outlet, "temperature_outlet", high=temperature_inlet)
    taken = jnp.where(w2 > w1, w2 - w1, jnp.nan)
    phi = humidity_share(temperature_outlet, w2, P)
    return DirectFiring(
        1.0 + air / just.air_per_fuel,
        w1,
        w2,
        phi,
        1.0 / (gas * taken),
        1.0 / taken,
        lower_heating_value / (gas * taken),
    )


def humidity_share(T: jax.Array, w: jax.Array, P: jax.Array) -> jax.Array:
    """Vapor pressure over saturation pressure."""
    return PAIR.fraction(w) / PAIR.saturated_fraction(T, P, False)
