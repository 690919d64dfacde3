"""Worked examples of textbooks, to the digits they print: air and water as ideal gases. Numbers recalled from the books, not re-opened."""

from __future__ import annotations

import numpy as np
import pytest

from granum.humid_gas.formulas.state import state
from granum.humid_gas.solvents import AirToluene

C = 273.15


def test_dry_and_wet_bulb() -> None:
    # Çengel and Boles, ex. 14-4; Geankoplis, ex. 9.3-4; Singh and Heldman, ch. 9 (chart); ASHRAE Fundamentals ch. 1, ex. 1 (chart)
    dry, wet = np.array([25.0, 60.0, 60.0, 40.0]) + C, np.array([15.0, 29.5, 30.0, 20.0]) + C
    found = state(temperature=dry, wet_bulb_temperature=wet, pressure=np.full(4, 101325.0))
    np.testing.assert_allclose(found.humidity_ratio, [0.00653, 0.0135, 0.0145, 0.0065], atol=1e-4)
    np.testing.assert_allclose(np.asarray(found.relative_humidity)[[0, 2, 3]], [0.332, 0.115, 0.14], atol=0.005)
    np.testing.assert_allclose(np.asarray(found.enthalpy)[[0, 3]] / 1e3, [41.8, 56.7], atol=0.1)


def test_temperature_and_relative_humidity() -> None:
    # Çengel and Boles, ex. 14-5 (chart); Felder and Rousseau, ex. 8.4-5 (chart)
    found = state(temperature=np.array([35.0, 41.0]) + C, relative_humidity=np.array([0.4, 0.1]), pressure=np.full(2, 101325.0))
    np.testing.assert_allclose(found.humidity_ratio, [0.0142, 0.0048], atol=1e-4)
    np.testing.assert_allclose(found.wet_bulb_temperature - C, [24.0, 19.0], atol=0.3)
    np.testing.assert_allclose(found.dew_point_temperature - C, [19.4, 3.0], atol=0.5)
    np.testing.assert_allclose(found.enthalpy / 1e3, [71.5, 53.5], atol=0.2)
    np.testing.assert_allclose(found.specific_volume, [0.893, 0.897], atol=1e-3)


def test_temperature_and_humidity_ratio() -> None:
    # Treybal, illustrations 7.7 and 7.8; Geankoplis, ex. 9.3-3 and 9.6-3; all read from charts to half a kelvin
    T, w = np.array([55.0, 83.0, 87.8, 65.6]) + C, np.array([0.030, 0.030, 0.030, 0.010])
    found = state(temperature=T, humidity_ratio=w, pressure=np.full(4, 101325.0))
    np.testing.assert_allclose(found.wet_bulb_temperature[1:] - C, [40.0, 40.5, 28.9], atol=0.5)
    assert found.dew_point_temperature[0] - C == pytest.approx(31.5, abs=0.5)
    assert found.vapor_pressure[0] == pytest.approx(4660.0, rel=0.01)


def test_toluene_has_a_wet_bulb_of_its_own() -> None:
    # Treybal, illustration 7.9: toluene and air at 60 °C with 0.050 kg/kg, Bedingfield and Drew's exponent: 31.8 °C
    found = state(temperature=60.0 + C, humidity_ratio=0.05, pair=AirToluene(lewis_exponent=0.567))
    assert found.wet_bulb_temperature - C == pytest.approx(31.8, abs=0.5)
