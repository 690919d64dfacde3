"""Gases and vapors in gases against printed values."""

from __future__ import annotations

import numpy as np
import pytest

from granum import materials as m


def test_lemmon_jacobsen_table_of_check_values() -> None:
    T = np.array([100.0, 300.0])
    np.testing.assert_allclose(m.air_viscosity(T) * 1e6, [7.09559, 18.5230], rtol=1e-5)
    np.testing.assert_allclose(m.air_conductivity(T) * 1e3, [9.35902, 26.3529], rtol=1e-5)
    np.testing.assert_allclose(m.nitrogen_viscosity(T) * 1e6, [6.90349, 17.8771], rtol=1e-5)
    np.testing.assert_allclose(m.nitrogen_conductivity(T) * 1e3, [9.27749, 25.9361], rtol=1e-5)


def test_heat_capacities_against_printed_tables() -> None:
    """Incropera table A.4 (1 atm): air 1.007 and 1.030, nitrogen 1.041 and 1.056 kJ/(kg K) at 300 and
    500 K.
    """
    T = np.array([300.0, 500.0])
    np.testing.assert_allclose(m.air_heat_capacity(T) / 1e3, [1.007, 1.030], rtol=3e-3)
    np.testing.assert_allclose(m.nitrogen_heat_capacity(T) / 1e3, [1.041, 1.056], rtol=2e-3)
    # JANAF
    np.testing.assert_allclose(
        m.steam_heat_capacity_ideal(np.array([298.15, 500.0])) * 18.0153e-3, [33.59, 35.23], rtol=1e-3
    )


def test_density_of_dry_air() -> None:
    assert m.gas_properties("20 degC").gas_density == pytest.approx(1.2041, rel=1e-3)
    assert m.gas_properties("20 degC", "1 bar", "nitrogen").gas_density == pytest.approx(1.150, rel=1e-3)


LUGG_1968 = {
    "benzene": 0.0932,
    "toluene": 0.0849,
    "acetone": 0.1049,
    "methanol": 0.1520,
    "ethanol": 0.1181,
    "1-propanol": 0.0993,
    "2-propanol": 0.1013,
    "ethyl acetate": 0.0861,
    "hexane": 0.0732,
    "dichloromethane": 0.1037,
}


@pytest.mark.parametrize("vapor", LUGG_1968)
def test_vapors_in_air_against_lugg(vapor: str) -> None:
    """Measured at 25 °C and 1 atm, cm²/s: Lugg, Anal. Chem. 40 (1968) 1072. Fuller's method is good to some
    10 %.
    """
    assert m.gas_vapor(vapor, "dry air").diffusivity("25 degC") * 1e4 == pytest.approx(
        LUGG_1968[vapor], rel=0.12
    )


def test_water_in_air() -> None:
    pair = m.gas_vapor()
    assert pair.molar_mass_ratio == pytest.approx(0.62198, rel=3e-4)
    assert pair.diffusivity("25 degC") * 1e4 == pytest.approx(0.26, rel=0.05)  # Incropera table A.8
    assert pair.lewis_number("25 degC") == pytest.approx(0.86, rel=0.05)
    assert pair.diffusivity(350.0) == pytest.approx(
        float(m.diffusivity_fuller(350.0, 0.018015, 13.1)), rel=0.06
    )
    assert m.gas_vapor("toluene", "nitrogen").lewis_number("25 degC") > 2.0
    assert pair.diffusivity(300.0, "2 bar") == pytest.approx(pair.diffusivity(300.0, "1 bar") / 2)


@pytest.mark.parametrize(
    ("gas", "density", "viscosity", "conductivity", "heat_capacity"),
    [  # Incropera and DeWitt, table A.4 (1 atm, 300 K), as remembered; argon and methane: NIST
        ("carbon dioxide", 1.773, 14.9e-6, 16.55e-3, 851),
        ("oxygen", 1.284, 20.72e-6, 26.8e-3, 920),
        ("argon", 1.623, 22.74e-6, 17.7e-3, 520),
        ("helium", 0.1625, 19.9e-6, 152e-3, 5193),
        ("methane", 0.651, 11.1e-6, 34.2e-3, 2232),
        ("hydrogen", 0.08078, 8.96e-6, 183e-3, 14310),
    ],
)
def test_other_gases(gas, density, viscosity, conductivity, heat_capacity) -> None:
    found = m.gas_properties("300 K", "1 atm", gas)
    assert found.gas_density == pytest.approx(density, rel=0.015)
    assert found.dynamic_viscosity == pytest.approx(viscosity, rel=0.015)
    assert found.thermal_conductivity == pytest.approx(conductivity, rel=0.025)
    assert found.specific_heat_capacity == pytest.approx(heat_capacity, rel=0.01)
