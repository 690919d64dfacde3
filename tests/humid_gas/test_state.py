"""Humid gas: the notes' readings, printed tables, fog, ice and impossible states."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.core.errors import ApplicabilityError, InputError
from granum.core.flags import EXTRAPOLATED
from granum.humid_gas.formulas.properties import (
    enthalpy,
    humidity_ratio_saturated,
    pressure_at_altitude,
    wet_bulb_temperature,
)
from granum.humid_gas.formulas.state import state
from granum.humid_gas.pairs import AIR_WATER

C = 273.15


def test_readings_of_the_notes() -> None:
    # U V.7 exercise 1 and 2, read from a chart
    room = state(temperature=22.2 + C, wet_bulb_temperature=17 + C)
    assert room.relative_humidity == pytest.approx(0.60, abs=0.01)
    assert room.enthalpy == pytest.approx(47.8e3, rel=0.01)
    assert room.dew_point_temperature == pytest.approx(14 + C, abs=0.3)
    assert room.humidity_ratio == pytest.approx(0.01005, rel=0.01)
    assert room.specific_volume == pytest.approx(0.85, abs=0.005)
    cold = state(temperature=C, relative_humidity=0.8)
    assert cold.humidity_ratio == pytest.approx(0.0029, rel=0.05)
    assert cold.wet_bulb_temperature == pytest.approx(-1 + C, abs=0.3)
    assert cold.dew_point_temperature == pytest.approx(-3 + C, abs=0.5)
    assert cold.specific_volume == pytest.approx(0.778, abs=0.002)
    # issue: h = 80 kJ/kg, w = 0.01
    warm = state(enthalpy=80e3, humidity_ratio=0.01)
    assert warm.temperature == pytest.approx(55 + C, abs=1.5)
    assert warm.relative_humidity == pytest.approx(0.1, abs=0.015)


def test_saturation_against_ashrae_table() -> None:
    # ASHRAE Handbook Fundamentals, thermodynamic properties of moist air at 101.325 kPa (real gas, hence
    # 0.5 %)
    t = np.array([-60.0, -40.0, -20.0, 0.0, 10.0, 20.0, 30.0, 50.0, 80.0, 90.0])
    printed = np.array(
        [
            0.0000067,
            0.0000793,
            0.0006373,
            0.0037895,
            0.0076606,
            0.014758,
            0.027329,
            0.086858,
            0.55295,
            1.42031,
        ]
    )
    np.testing.assert_allclose(humidity_ratio_saturated(temperature=t + C), printed, rtol=0.016)
    np.testing.assert_allclose(humidity_ratio_saturated(temperature=t[3:8] + C), printed[3:8], rtol=0.0062)


def test_enthalpy_of_dry_air_at_one_atmosphere() -> None:
    # ASHRAE's own equation 30, h = 1.006 t for dry air, and the real gas of RP-1485, which gives
    # 1.0061 kJ/(kg K) at 20 °C
    t = np.array([-20.0, 10.0, 20.0, 30.0, 50.0])
    air = enthalpy(temperature=t + C, humidity_ratio=0.0)
    np.testing.assert_allclose(air, 1006.0 * t, atol=35.0)
    np.testing.assert_allclose(
        air, enthalpy(temperature=t + C, humidity_ratio=0.0, pair="air_water_real"), atol=5.0
    )
    assert state(temperature="20 degC", humidity_ratio=0.0).humid_heat == pytest.approx(1006.1, abs=0.1)


def test_ideal_air_under_pressure_says_so() -> None:
    for pressure, told in (("1 atm", False), ("2 bar", False), ("3 bar", True), ("30 bar", True)):
        found = enthalpy.evaluate(temperature="50 degC", humidity_ratio=0.001, pressure=pressure)
        assert bool(found.flags & EXTRAPOLATED) is told, pressure
    assert found.notices[0]["message"].endswith("give the pair air_water_real, which is the real mixture.")
    assert "pressure = 30 bar" in found.notices[0]["message"]
    assert not enthalpy.evaluate(
        temperature="50 degC", humidity_ratio=0.001, pressure="30 bar", pair="air_water_real"
    ).flags


def test_percentage_humidity_humid_heat_and_saturation_pressure() -> None:
    # By hand at 30 °C and 1 atm: p_s = 4.2470 kPa (steam tables), w_s = 0.62194·4.2470/(101.325 − 4.2470) =
    # 0.027209
    air = state(temperature="30 degC", humidity_ratio=0.0136)
    assert air.saturation_pressure == pytest.approx(4247.0, rel=1e-4)
    assert air.percentage_humidity == pytest.approx(0.0136 / 0.027209, rel=2e-4)
    assert air.humid_heat == pytest.approx(1006.0 + 0.0136 * 1865.0, rel=1e-3)
    back = state(temperature="30 degC", percentage_humidity=air.percentage_humidity)
    assert back.humidity_ratio == pytest.approx(0.0136, rel=1e-12)
    with pytest.raises(InputError, match="beside the temperature alone"):
        state(enthalpy=5e4, percentage_humidity=0.5)
    with pytest.raises(ApplicabilityError, match="Above the boiling point"):
        state(temperature="120 degC", percentage_humidity=0.5)


def _states(count: int) -> tuple[dict, np.ndarray]:
    rng = np.random.default_rng(1)
    T = rng.uniform(213.5, 623.0, count)
    P = 10 ** rng.uniform(3.0, 7.0, count)
    ys = np.asarray(AIR_WATER.saturated_fraction(T, P, AIR_WATER.is_frozen(T)))
    y = np.minimum(ys, 0.97) * rng.uniform(0.001, 0.999, count)
    full = state(temperature=T, humidity_ratio=np.asarray(AIR_WATER.humidity_ratio(y)), pressure=P)
    return full._asdict(), P


FULL, PRESSURES = _states(200)


def test_order_of_temperatures_and_hot_moist_gas() -> None:
    full = FULL
    assert np.all(full["dew_point_temperature"] <= full["wet_bulb_temperature"] + 1e-6)
    assert np.all(full["wet_bulb_temperature"] <= full["temperature"] + 1e-6)
    # psychrolib issues 31 and 96: at 150 °C and w = 1 the wet bulb must lie below boiling. Energy by hand
    # with steam-table values
    # (h_g 2656.5, h_l 367.4 kJ/kg at 87.7 °C; air 1.01 kJ/(kg K)) closes within 1 %.
    Ts = wet_bulb_temperature(temperature=150 + C, humidity_ratio=1.0)
    assert 86 + C < Ts < 89 + C


def test_pure_vapor_limit() -> None:
    gas = state(temperature=150 + C, vapor_pressure=101325.0 * (1 - 1e-9))
    assert gas.wet_bulb_temperature == pytest.approx(373.124, abs=0.01)
    assert gas.dew_point_temperature == pytest.approx(373.124, abs=0.01)
    assert gas.density == pytest.approx(0.5188, rel=1e-3)  # p M/(R T); steam tables 0.5164 for the real vapor


def test_fog() -> None:
    fog = state(temperature=20 + C, humidity_ratio=0.03)
    assert fog.relative_humidity == pytest.approx(1.0)
    assert fog.condensate_ratio == pytest.approx(0.03 - 0.0147, abs=2e-4)
    again = state(enthalpy=fog.enthalpy, humidity_ratio=0.03)
    assert again.temperature == pytest.approx(20 + C, rel=1e-9)
    by_enthalpy = state(temperature=20 + C, enthalpy=fog.enthalpy)
    assert by_enthalpy.humidity_ratio == pytest.approx(0.03, rel=1e-6)
    # fog that is partly frozen sits at the triple point
    assert state(enthalpy=9.1e3, humidity_ratio=0.006).temperature == pytest.approx(273.16)


def test_impossible_states_name_the_limits() -> None:
    # limits from steam tables: 2.339 kPa at 20 °C; dry air, cp 1.006, and saturated air, 47.8 kJ/kg, of a wet
    # bulb of 17 °C
    for given, limits in (
        ({"temperature": "20 degC", "vapor_pressure": "3 kPa"}, "0 … 2.339 kPa"),
        ({"wet_bulb_temperature": "17 degC", "enthalpy": "80 kJ/kg"}, "46.95 … 47.82 kJ/kg"),
    ):
        with pytest.raises(ApplicabilityError) as found:
            state(**given)
        assert limits in str(found.value)
        assert "Change one" in str(found.value)
    result = state.evaluate(temperature=np.array([293.15, 293.15]), vapor_pressure=np.array([3000.0, 2000.0]))
    assert np.isnan(result.value.humidity_ratio[0])
    assert np.isfinite(result.value.humidity_ratio[1])
    with pytest.raises(ApplicabilityError):
        result.check()


@pytest.mark.parametrize(
    "given",
    [
        {},
        {"temperature": 300.0},
        {"temperature": 300.0, "humidity_ratio": 0.01, "enthalpy": 5e4},
        {"humidity_ratio": 0.01, "vapor_pressure": 900.0},
        {"wet_bulb_temperature": 290.0, "adiabatic_saturation_temperature": 290.0},
    ],
)
def test_wrong_count_of_inputs(given: dict) -> None:
    with pytest.raises(InputError) as found:
        state(**given)
    for name in given:
        assert name in str(found.value)


def test_gradients_are_finite_everywhere() -> None:
    T = jnp.repeat(jnp.array([250.0, 273.15, 273.16, 300.0, 373.124, 420.0]), 4)
    ys = jnp.minimum(AIR_WATER.saturated_fraction(T, 101325.0, T < 273.16), 0.9)
    w = AIR_WATER.humidity_ratio(ys) * jnp.tile(jnp.array([0.0, 0.5, 1.0, 1.5]), 6)
    total = jax.grad(
        lambda x: sum(jnp.sum(v) for v in state(temperature=x[0], humidity_ratio=x[1], pressure=x[2]))
    )
    slopes = jax.jit(jax.vmap(total))(jnp.stack([T, w, jnp.full_like(T, 101325.0)], axis=1))
    assert jnp.all(jnp.isfinite(slopes))


def test_pressure_at_altitude() -> None:
    # standard atmosphere, ASHRAE Fundamentals ch. 1, table 1
    heights = np.array([-500.0, 0.0, 500.0, 1000.0, 1500.0, 2000.0, 3000.0, 5000.0, 10000.0])
    printed = np.array([107478.0, 101325.0, 95461.0, 89875.0, 84556.0, 79495.0, 70108.0, 54020.0, 26436.0])
    np.testing.assert_allclose(pressure_at_altitude(heights), printed, rtol=2e-4)
    assert pressure_at_altitude("5000 ft") == pytest.approx(12.228 * 6894.757, rel=1e-3)
