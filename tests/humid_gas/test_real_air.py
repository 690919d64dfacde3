"""Real moist air against CoolProp 8.0.0 (HAPropsSI, the reference implementation of RP-1485) and ASHRAE's
printed saturation table.
"""

from __future__ import annotations

import numpy as np
import pytest

import granum.humid_gas.relations as rel
from granum.humid_gas.formulas.state import state
from granum.humid_gas.real_air import AIR_WATER_REAL as REAL

# HAPropsSI('W' / 'H' / 'V', 'T', t + 273.15, 'P', P, 'R', 1): pressure, °C, kg/kg, J/kg, from CoolProp 8.0.0
SATURATED = np.array([
    (1e4, -60, 6.73083e-05, -59782.3), (1e4, 20, 0.190206, 502980.0), (101325.0, -60, 6.68449e-06, -60325.2),
    (101325.0, -20, 0.000637284, -18541.7), (101325.0, 1, 0.00407633, 11203.7), (101325.0, 20, 0.0147605, 57559.2),  # noqa: E501
    (101325.0, 50, 0.0868629, 275353.0), (101325.0, 90, 1.42024, 3.86763e6), (1e6, -20, 6.71498e-05, -22787.3),  # noqa: E501
    (1e6, 50, 0.00799306, 69252.2), (1e6, 150, 0.596704, 1.78724e6), (5e6, 20, 0.000339596, 9979.3), (5e6, 200, 0.328145, 1.10781e6),  # noqa: E501
    (1e7, -20, 1.0398e-05, -48538.0), (1e7, 90, 0.00538723, 92501.8), (1e7, 250, 0.558811, 1.78352e6), (1e7, 300, 5.59881, 1.53319e7),  # noqa: E501
])  # fmt: skip


def test_saturated_air_against_reference_program() -> None:
    P, T, w, h = SATURATED[:, 0], SATURATED[:, 1] + 273.15, SATURATED[:, 2], SATURATED[:, 3]
    y = rel.saturated_fraction(REAL, T, P)
    np.testing.assert_allclose(REAL.humidity_ratio(y), w, rtol=1.05e-4)
    own = rel.enthalpy_of(REAL, rel.Gas(T, y, np.zeros_like(T)), P)
    np.testing.assert_allclose(own, h, rtol=1e-4, atol=2.0)


def test_printed_ashrae_table() -> None:
    # ASHRAE Handbook Fundamentals, moist air at 101.325 kPa, saturated: 20 °C has W 0.014761, v 0.8498, h
    # 57.555
    air = state(temperature=293.15, relative_humidity=1.0, pair=REAL)
    assert air.humidity_ratio == pytest.approx(0.014761, rel=1e-4)
    assert air.specific_volume == pytest.approx(0.8498, rel=1e-4)
    assert air.enthalpy == pytest.approx(57.555e3, rel=1e-4)


def test_differs_little_from_ideal_near_one_bar() -> None:
    given = {"temperature": 353.15, "humidity_ratio": 0.05}
    real, ideal = state(**given, pair=REAL), state(**given)
    for name, a, b in zip(real._fields, real, ideal, strict=True):
        # w_s = 0.622 y_s/(1 − y_s): at 80 °C half a percent of y_s is one percent of w_s
        assert a == pytest.approx(b, rel=1.2e-2 if name == "percentage_humidity" else 6e-3), name
