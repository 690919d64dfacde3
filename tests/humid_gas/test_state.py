"""Humid gas: the notes' readings, printed tables, round trips through every pair, fog, ice and impossible states."""

from __future__ import annotations

import itertools

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.core.errors import ApplicabilityError, InputError
from granum.humid_gas.formulas.properties import humidity_ratio_saturated, pressure_at_altitude, wet_bulb_temperature
from granum.humid_gas.formulas.state import state
from granum.humid_gas.inputs import MOISTURE, NAMES, WET, Solver
from granum.humid_gas.pairs import AIR_WATER
from granum.humid_gas.solvents import AirToluene

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
    # ASHRAE Handbook Fundamentals, thermodynamic properties of moist air at 101.325 kPa (real gas, hence 0.5 %)
    t = np.array([-60.0, -40.0, -20.0, 0.0, 10.0, 20.0, 30.0, 50.0, 80.0, 90.0])
    printed = np.array([0.0000067, 0.0000793, 0.0006373, 0.0037895, 0.0076606, 0.014758, 0.027329, 0.086858, 0.55295, 1.42031])
    np.testing.assert_allclose(humidity_ratio_saturated(temperature=t + C), printed, rtol=0.016)
    np.testing.assert_allclose(humidity_ratio_saturated(temperature=t[3:8] + C), printed[3:8], rtol=0.0062)


def _states(count: int) -> tuple[dict, np.ndarray]:
    rng = np.random.default_rng(1)
    T = rng.uniform(213.5, 623.0, count)
    P = 10 ** rng.uniform(3.0, 7.0, count)
    ys = np.asarray(AIR_WATER.saturated_fraction(T, P, AIR_WATER.is_frozen(T)))
    y = np.minimum(ys, 0.97) * rng.uniform(0.001, 0.999, count)
    full = state(temperature=T, humidity_ratio=np.asarray(AIR_WATER.humidity_ratio(y)), pressure=P)
    return full._asdict(), P


COMBINATIONS = [
    (a, b)
    for a, b in itertools.combinations(NAMES, 2)
    if not ((a in MOISTURE and b in MOISTURE) or (a in WET and b in WET)) and "adiabatic_saturation_temperature" not in (a, b)
]
FULL, PRESSURES = _states(200)


@pytest.mark.parametrize(("first", "second"), COMBINATIONS)
def test_round_trip(first: str, second: str) -> None:
    given = {first: FULL[first], second: FULL[second]}
    gas, possible = jax.jit(lambda given, P: Solver(AIR_WATER, P, None, given).solve())(given, PRESSURES)
    assert np.all(possible)
    np.testing.assert_allclose(gas.T, FULL["temperature"], rtol=1e-9)
    # the fraction is compared on the scale at which the given pair fixes it: dry states leave little trace in h, v and wet bulb
    np.testing.assert_allclose(gas.y, FULL["vapor_mole_fraction"], rtol=1e-9, atol=1e-10)


def test_order_of_temperatures_and_hot_moist_gas() -> None:
    full = FULL
    assert np.all(full["dew_point_temperature"] <= full["wet_bulb_temperature"] + 1e-6)
    assert np.all(full["wet_bulb_temperature"] <= full["temperature"] + 1e-6)
    # psychrolib issues 31 and 96: at 150 °C and w = 1 the wet bulb must lie below boiling. Energy by hand with steam-table values
    # (h_g 2656.5, h_l 367.4 kJ/kg at 87.7 °C; air 1.01 kJ/(kg K)) closes within 1 %.
    Ts = wet_bulb_temperature(temperature=150 + C, humidity_ratio=1.0)
    assert 86 + C < Ts < 89 + C


def test_pure_vapor_limit() -> None:
    gas = state(temperature=150 + C, vapor_pressure=101325.0 * (1 - 1e-9))
    assert gas.wet_bulb_temperature == pytest.approx(373.124, abs=0.01)
    assert gas.dew_point_temperature == pytest.approx(373.124, abs=0.01)
    assert gas.density == pytest.approx(0.5188, rel=1e-3)  # p M/(R T); steam tables 0.5164 for the real vapor


def test_fog_and_impossible_states() -> None:
    fog = state(temperature=20 + C, humidity_ratio=0.03)
    assert fog.relative_humidity == pytest.approx(1.0)
    assert fog.condensate_ratio == pytest.approx(0.03 - 0.0147, abs=2e-4)
    again = state(enthalpy=fog.enthalpy, humidity_ratio=0.03)
    assert again.temperature == pytest.approx(20 + C, rel=1e-9)
    by_enthalpy = state(temperature=20 + C, enthalpy=fog.enthalpy)
    assert by_enthalpy.humidity_ratio == pytest.approx(0.03, rel=1e-6)
    # fog that is partly frozen sits at the triple point
    assert state(enthalpy=9.1e3, humidity_ratio=0.006).temperature == pytest.approx(273.16)
    for bad in (
        {"temperature": 293.15, "wet_bulb_temperature": 294.15},
        {"temperature": 293.15, "vapor_pressure": 3000.0},
        {"temperature": 293.15, "specific_volume": 0.5},
        {"temperature": 353.15, "wet_bulb_temperature": 283.15},
        {"temperature": 293.15, "dew_point_temperature": 300.0},
    ):
        for call in (state, state.evaluate):
            with pytest.raises(ApplicabilityError, match="Change one"):
                call(**bad)
        result = state.evaluate(**{name: np.array([value]) for name, value in bad.items()})
        assert np.isnan(result.value.humidity_ratio[0])
        with pytest.raises(ApplicabilityError):
            result.check()


@pytest.mark.parametrize(
    "given",
    [{}, {"temperature": 300.0}, {"temperature": 300.0, "humidity_ratio": 0.01, "enthalpy": 5e4},
     {"humidity_ratio": 0.01, "vapor_pressure": 900.0}, {"wet_bulb_temperature": 290.0, "adiabatic_saturation_temperature": 290.0}],
)  # fmt: skip
def test_wrong_count_of_inputs(given: dict) -> None:
    with pytest.raises(InputError) as found:
        state(**given)
    for name in given:
        assert name in str(found.value)


@pytest.mark.parametrize("T", [250.0, 273.15, 273.16, 300.0, 373.124, 420.0])
def test_gradients_are_finite_everywhere(T: float) -> None:
    ws = float(AIR_WATER.humidity_ratio(min(float(AIR_WATER.saturated_fraction(T, 101325.0, T < 273.16)), 0.9)))
    for w in (0.0, 0.5 * ws, ws, 1.5 * ws):
        slopes = jax.grad(lambda x: sum(jnp.sum(v) for v in state(temperature=x[0], humidity_ratio=x[1], pressure=x[2])))(
            jnp.array([T, w, 101325.0])
        )
        assert jnp.all(jnp.isfinite(slopes)), (T, w, slopes)


def test_two_states_of_one_wet_bulb_and_volume_are_flagged() -> None:
    # vapor of toluene is heavy: along a line of constant wet bulb the volume per dry gas falls and then rises
    pair = AirToluene()
    warm = state(temperature=398.23, humidity_ratio=float(pair.humidity_ratio(0.30625)), pressure=65985.0, pair=pair)
    found = state.evaluate(
        wet_bulb_temperature=float(warm.wet_bulb_temperature), specific_volume=float(warm.specific_volume), pressure=65985.0, pair=pair
    )
    assert found.value.temperature < 398.0
    assert [n["flag"] for n in found.notices] == ["limit active"]
    assert "Two states" in found.notices[0]["message"]
    again = state(temperature=found.value.temperature, humidity_ratio=found.value.humidity_ratio, pressure=65985.0, pair=pair)
    assert again.specific_volume == pytest.approx(warm.specific_volume, rel=1e-8)
    assert again.wet_bulb_temperature == pytest.approx(warm.wet_bulb_temperature, rel=1e-8)


def test_pressure_at_altitude() -> None:
    # standard atmosphere, ASHRAE Fundamentals ch. 1, table 1
    heights = np.array([-500.0, 0.0, 500.0, 1000.0, 1500.0, 2000.0, 3000.0, 5000.0, 10000.0])
    printed = np.array([107478.0, 101325.0, 95461.0, 89875.0, 84556.0, 79495.0, 70108.0, 54020.0, 26436.0])
    np.testing.assert_allclose(pressure_at_altitude(heights), printed, rtol=2e-4)
    assert pressure_at_altitude("5000 ft") == pytest.approx(12.228 * 6894.757, rel=1e-3)
