"""Resistances from two readings: the books' own numbers, carried on to the machine, and the fit of many."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import granum as gr
from granum.core.errors import GranumError, InputError
from granum.filtration import (
    ConstantRateTest,
    LeafTest,
    filtration_time_constant_pressure,
    pressure_drop_constant_rate,
    resistances_two_pressures,
    resistances_two_volumes,
)

SLURRY = {"dynamic_viscosity": "1 mPa*s", "dry_cake_per_filtrate": "150 kg/m3"}
LEAF = {"area": "0.05 m2", "pressure_drop": "71.3 kPa", **SLURRY}


def test_leaf_of_coulson_and_richardson():
    """Example 7.1 (opened as the Scilab companion): 250 cm³ in 5 min and 400 cm³ in 10 min give a product of
    specific resistance, viscosity and cake per filtrate of 7.13e11 and 3.5 mm of cake for the cloth.
    """
    found = resistances_two_volumes("300 s", "250 cm3", "600 s", "400 cm3", **LEAF)
    assert found.cake_resistance * 1e-3 * 150 == pytest.approx(7.13e11, rel=0.005)
    assert found.medium_resistance * 1e-3 / 7.13e11 == pytest.approx(3.5e-3, rel=0.005)


def test_press_of_brasch_and_whyman_at_constant_rate():
    """Example 8.2 (opened as the Python companion): 5.34 kPa after 3 min, 9.31 kPa after 8 min; 15 kPa are
    reached after 909.97 s.
    """
    state = {"filtrate_flow": "240 cm3/s", "area": "0.3 m2", **SLURRY}
    found = resistances_two_pressures("3 min", "5.34 kPa", "8 min", "9.31 kPa", **state)
    later = pressure_drop_constant_rate(
        "909.97 s",
        cake_resistance=found.cake_resistance,
        medium_resistance=found.medium_resistance,
        **state,
    )
    assert later == pytest.approx(15e3, rel=1e-5)


def test_press_of_brasch_and_whyman_after_half_an_hour():
    """Example 8.1: 3.23 kPa after 2 min and 6.53 kPa after 5 min at 78 L/s; 34.03 kPa after 30 min, when
    the cake over 29.75 m² is 102.6 mm thick, and the cloth is worth 3.2 mm of it.
    """
    moist = (
        0.0278 * 998 / ((1 - 0.0278) * 1324 - 0.0278 * (1 - 1324 / 2230) * 998)
    )  # cake per filtrate, volume
    state = {
        "filtrate_flow": "78 L/s",
        "area": "29.75 m2",
        "dynamic_viscosity": "1.003 mPa*s",
        "dry_cake_per_filtrate": moist * 1324,
    }
    found = resistances_two_pressures("2 min", "3.23 kPa", "5 min", "6.53 kPa", **state)
    later = pressure_drop_constant_rate(
        "30 min",
        cake_resistance=found.cake_resistance,
        medium_resistance=found.medium_resistance,
        **state,
    )
    assert later == pytest.approx(34.03e3, rel=1e-4)
    assert moist * 0.078 * 1800 / 29.75 == pytest.approx(0.1026, rel=1e-3)
    assert found.medium_resistance / (found.cake_resistance * 1324) == pytest.approx(0.0032, abs=5e-5)


@given(
    alpha=st.floats(1e9, 1e13),
    medium=st.floats(1e9, 1e13),
    first=st.floats(0.1, 0.9),
)
def test_two_readings_of_a_known_filtration_give_its_resistances(alpha, medium, first):
    state = {"area": 0.05, "pressure_drop": 71.3e3, "dynamic_viscosity": 1e-3, "dry_cake_per_filtrate": 150.0}
    times = [
        filtration_time_constant_pressure(
            filtrate_volume=v, cake_resistance=alpha, medium_resistance=medium, **state
        )
        for v in (first * 1e-3, 1e-3)
    ]
    found = resistances_two_volumes(times[0], first * 1e-3, times[1], 1e-3, **state)
    whole = 7.5e-6 * alpha / 0.05 + 1e-3 * medium  # either may be lost beside the other
    assert abs(found.cake_resistance - alpha) * 7.5e-6 / 0.05 < 1e-9 * whole / (1 - first)
    assert abs(found.medium_resistance - medium) * 1e-3 < 1e-9 * whole / (1 - first)


@pytest.mark.parametrize(
    ("second", "words"),
    [
        (("10 min", "200 cm3"), "must be the later one"),
        (("6 min", "400 cm3"), "t/V must rise"),
        (("30 min", "400 cm3"), "meets zero below"),
    ],
)
def test_readings_that_contradict_each_other_are_told(second, words):
    with pytest.raises(GranumError, match=words):
        resistances_two_volumes("5 min", "250 cm3", *second, **LEAF)


def test_lab_tests_say_where_two_readings_are_read():
    with pytest.raises(GranumError, match="resistances_two_volumes"):
        LeafTest(time=[300, 600], filtrate_volume=[2.5e-4, 4e-4], **LEAF)
    with pytest.raises(GranumError, match="resistances_two_pressures"):
        ConstantRateTest(
            time=np.array([120, 300]), pressure_drop=[3230, 6530], filtrate_flow=0.078, area=29.75, **SLURRY
        )


def test_resistances_at_two_pressures_give_the_compressibility() -> None:
    """Back from the power law that filters use; a lab test of two points leads there."""
    alpha = [float(gr.filtration.cake_resistance_power_law(p, 4.37e9, 0.3)) for p in (4e4, 3e5)]
    found = gr.filtration.compressibility_two_resistances(alpha[0], 4e4, alpha[1], 3e5, 1.0)
    assert float(found.compressibility) == pytest.approx(0.3, rel=1e-9)
    assert float(found.cake_resistance_reference) == pytest.approx(4.37e9, rel=1e-9)
    with pytest.raises(InputError, match="compressibility_two_resistances"):
        gr.filtration.Compressibility(pressure_drop=[4e4, 3e5], cake_resistance=alpha)


def test_a_cake_that_loosens_under_pressure_is_doubted() -> None:
    turned = gr.filtration.compressibility_two_resistances.evaluate(2e11, "1 bar", 1e11, "4 bar")
    assert any("lets more through" in told["message"] for told in turned.notices)
    with pytest.raises(GranumError, match="must differ"):
        gr.filtration.compressibility_two_resistances(1e11, "1 bar", 2e11, "1 bar")
