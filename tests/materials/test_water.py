"""Water and steam against the verification tables printed in the IAPWS releases."""

from __future__ import annotations

import jax
import numpy as np
import pytest

from granum import materials as m


@pytest.mark.parametrize(
    ("temperature", "megapascal"), [(300, 0.353658941e-2), (500, 0.263889776e1), (600, 0.123443146e2)]
)
def test_saturation_pressure_table_35(temperature: float, megapascal: float) -> None:
    assert m.water_vapor_pressure(temperature) / 1e6 == pytest.approx(megapascal, rel=2e-9)


@pytest.mark.parametrize(
    ("megapascal", "temperature"), [(0.1, 0.372755919e3), (1, 0.453035632e3), (10, 0.584149488e3)]
)
def test_saturation_temperature_table_36(megapascal: float, temperature: float) -> None:
    assert m.water_boiling_temperature(megapascal * 1e6) == pytest.approx(temperature, rel=2e-9)


@pytest.mark.parametrize(
    ("T", "p", "v", "h", "cp"),
    [
        (300, 3, 0.100215168e-2, 0.115331273e3, 0.417301218e1),
        (300, 80, 0.971180894e-3, 0.184142828e3, 0.401008987e1),
        (500, 3, 0.120241800e-2, 0.975542239e3, 0.465580682e1),
    ],
)
def test_liquid_table_5(T: float, p: float, v: float, h: float, cp: float) -> None:
    assert 1 / m.water_density(T, p * 1e6) == pytest.approx(v, rel=1e-8)
    assert m.water_enthalpy(T, p * 1e6) / 1e3 == pytest.approx(h, rel=1e-8)
    assert m.water_heat_capacity(T, p * 1e6) / 1e3 == pytest.approx(cp, rel=1e-8)


@pytest.mark.parametrize(
    ("T", "p", "v", "h", "cp"),
    [
        (300, 0.0035, 0.394913866e2, 0.254991145e4, 0.191300162e1),
        (700, 0.0035, 0.923015898e2, 0.333568375e4, 0.208141274e1),
        (700, 30, 0.542946619e-2, 0.263149474e4, 0.103505092e2),
    ],
)
def test_steam_table_15(T: float, p: float, v: float, h: float, cp: float) -> None:
    assert 1 / m.steam_density(T, p * 1e6) == pytest.approx(v, rel=1e-8)
    assert m.steam_enthalpy(T, p * 1e6) / 1e3 == pytest.approx(h, rel=1e-8)
    assert m.steam_heat_capacity(T, p * 1e6) / 1e3 == pytest.approx(cp, rel=1e-8)


def test_viscosity_release_table_4() -> None:
    T = np.array([298.15, 298.15, 373.15, 433.15, 433.15, 873.15, 873.15])
    rho = np.array([998.0, 1200.0, 1000.0, 1.0, 1000.0, 1.0, 100.0])
    printed = [889.735100, 1437.649467, 307.883622, 14.538324, 217.685358, 32.619287, 35.802262]
    np.testing.assert_allclose(m.dynamic_viscosity_iapws(T, rho) * 1e6, printed, rtol=5e-8)


def test_conductivity_release_table_4() -> None:
    T = np.array([298.15, 298.15, 298.15, 873.15])
    printed = [18.4341883, 607.712868, 799.038144, 79.1034659]
    np.testing.assert_allclose(
        m.thermal_conductivity_iapws(T, np.array([0.0, 998.0, 1200.0, 0.0])) * 1e3, printed, rtol=1e-8
    )


def test_surface_tension_release_table_1() -> None:
    celsius = np.array([0.01, 20.0, 25.0, 100.0, 200.0])
    np.testing.assert_allclose(
        m.water_surface_tension(celsius + 273.15) * 1e3, [75.65, 72.74, 71.97, 58.91, 37.67], atol=0.006
    )


def test_ice_release_check_values() -> None:
    assert m.ice_vapor_pressure(230.0) == pytest.approx(8.94735, rel=1e-6)
    assert m.ice_melting_pressure(260.0) / 1e6 == pytest.approx(138.268, rel=1e-5)
    # meet at the triple point
    assert m.ice_vapor_pressure(273.16) == pytest.approx(m.water_vapor_pressure(273.16), rel=1e-4)


def test_liquid_against_printed_tables() -> None:
    """Density, viscosity, heat of vaporization: haynes2014 sec. 6; steam tables of wagner and kretzschmar."""
    celsius = np.array([20.0, 50.0, 80.0])
    np.testing.assert_allclose(m.water_density(celsius + 273.15), [998.21, 988.04, 971.80], rtol=3e-5)
    np.testing.assert_allclose(m.water_viscosity(celsius + 273.15) * 1e3, [1.0016, 0.5465, 0.3540], rtol=1e-3)
    # Ramires 1995, standard reference value
    assert m.water_conductivity(298.15) == pytest.approx(0.6065, rel=1e-4)
    full = m.thermal_conductivity_iapws(celsius + 273.15, m.water_density(celsius + 273.15))
    # two releases; the second lacks the enhancement
    np.testing.assert_allclose(m.water_conductivity(celsius + 273.15), full, rtol=6e-3)
    np.testing.assert_allclose(
        m.water_heat_of_vaporization(np.array([273.16, 373.15])) / 1e3, [2500.9, 2256.4], rtol=1e-4
    )


def test_saturation_curve_rises_and_inverts() -> None:
    T = np.linspace(275.0, 640.0, 30)
    np.testing.assert_allclose(m.water_boiling_temperature(m.water_vapor_pressure(T)), T, rtol=1e-6)
    slope = jax.vmap(jax.grad(lambda t: m.water_vapor_pressure(t)))(T)
    assert np.all(np.asarray(slope) > 0)
    volume_change = 1 / m.steam_density(T, m.water_vapor_pressure(T)) - 1 / m.water_density(
        T, m.water_vapor_pressure(T)
    )
    clapeyron = m.water_heat_of_vaporization(T) / (T * volume_change)
    low = T < 500  # the three fits agree to 0.3 % with Clapeyron's equation away from the critical point
    np.testing.assert_allclose(np.asarray(slope)[low], np.asarray(clapeyron)[low], rtol=3e-3)
