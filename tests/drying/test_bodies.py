"""Coupled heat and moisture in a body: Crank's limit, wet bulb at the start, equilibrium at the end; products' isotherms."""

from __future__ import annotations

import numpy as np
import pytest

from granum.drying.bodies import body_drying
from granum.drying.formulas import diffusion
from granum.drying.formulas.moisture import moisture_wet_basis
from granum.drying.formulas.storage import moisture_for_storage, water_activity_margin
from granum.drying.isotherms.adsorption import Gab
from granum.drying.isotherms.products import PRODUCTS
from granum.humid_gas.formulas.transport import transport


@pytest.mark.parametrize(("shape", "series"), [("plate", diffusion.plate), ("sphere", diffusion.sphere)])
def test_crank_is_the_limit_of_fast_films(shape: str, series) -> None:
    t = np.linspace(0.0, 40000.0, 9)
    course = body_drying(
        t, 0.005, 0.5, 333.15, 0.01, 1e5, 3e-10, isotherm=Gab(0.07, 12.0, 0.85), shape=shape, shrinkage_coefficient=0.0,
        mass_transfer_coefficient=100.0, thermal_conductivity=100.0, initial_temperature=333.15,
    )  # fmt: skip
    Xe = course.moisture_dry_basis_surface[-1]
    MR = (course.moisture_dry_basis - Xe) / (0.5 - Xe)
    np.testing.assert_allclose(MR, series(3e-10 * t / 0.005**2), atol=2e-3)
    # the defect of a known open tool: its center never dries
    assert course.moisture_dry_basis_center[-1] < 0.4


def test_wet_start_and_dry_end() -> None:
    iso = Gab(0.07, 12.0, 0.85)
    t = np.array([0.0, 300.0, 900.0, 1e4, 3e4, 6e4, 1e5, 1.5e5, 2e5])  # as many as above: one compiled integration
    course = body_drying(t, 0.005, 4.0, 333.15, 0.01, 30.0, 3e-8, isotherm=iso, dry_density=1400.0, shrinkage_coefficient=1.4)
    # internal transport being fast, the surface sits at the wet bulb with the analogy's Lewis factor of 0.89; by hand at 26.9 °C:
    # (0.0224 − 0.010) · 2437 kJ/kg = 30.2 against 0.89 · 1.026 · 33.1 = 30.2 kJ per kg of dry air
    assert course.surface_temperature[2] == pytest.approx(273.15 + 26.9, abs=0.4)
    assert course.temperature_center[-1] == pytest.approx(333.15, abs=0.05)
    phi = 0.01 / (0.62195 + 0.01) * 101325 / 19946.0  # p_s(60 °C) of the steam tables
    assert course.moisture_dry_basis[-1] == pytest.approx(float(iso(phi)), rel=0.01)
    # all the water that left is the volume that left: dry solid is conserved by the moving grid
    thickness = 0.005 * (1 + 1.4 * course.moisture_dry_basis) / (1 + 1.4 * 4.0)
    np.testing.assert_allclose(course.half_thickness, thickness, rtol=1e-9)


def test_products() -> None:
    a = np.linspace(0.2, 0.9, 8)
    for product in PRODUCTS.values():
        isotherm = product()
        X = np.asarray(isotherm.moisture(a, 303.15))
        assert np.all(np.diff(X) > 0)
        np.testing.assert_allclose(isotherm.activity(X, 303.15), a, rtol=1e-9)
    # grain trade keeps maize, wheat and paddy at 13 to 14 % wet basis
    for name in ("maize", "hard_wheat", "rice"):
        assert 0.125 < moisture_wet_basis(moisture_for_storage(298.15, PRODUCTS[name](), "molds")) < 0.15
    assert water_activity_margin(0.92).water_activity_margin_bacteria == pytest.approx(-0.01)


def test_transport_of_humid_air() -> None:
    # pure ends: dry air at 300 K (Incropera, table A.4: 184.6e-7 Pa s, 26.3 mW/(m K), Pr 0.707), water in air D = 0.26 cm²/s at 298 K
    dry = transport(300.0, 0.0)
    assert dry.dynamic_viscosity == pytest.approx(184.6e-7, rel=0.01)
    assert dry.thermal_conductivity == pytest.approx(26.3e-3, rel=0.01)
    assert dry.prandtl_number == pytest.approx(0.707, rel=0.015)
    assert transport(298.0, 0.0).diffusivity == pytest.approx(0.26e-4, rel=0.05)
    assert 0.8 < dry.lewis_number < 0.9
    steam = transport(400.0, 1e9)  # saturated-steam tables continue to 13.4e-6 Pa s at 400 K, low pressure
    assert steam.dynamic_viscosity == pytest.approx(13.3e-6, rel=0.02)
