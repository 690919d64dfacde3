"""Coupled heat and moisture in a body: Crank's limit, wet bulb at the start, equilibrium at the end;
products' isotherms.
"""

from __future__ import annotations

import numpy as np
import pytest

from granum.core import flags
from granum.drying.bodies import body_drying
from granum.drying.formulas import diffusion
from granum.drying.formulas.moisture import equilibrium_moisture, moisture_wet_basis
from granum.drying.formulas.storage import moisture_for_storage, water_activity_margin
from granum.drying.isotherms.adsorption import Gab
from granum.drying.isotherms.grains import ChungPfost
from granum.drying.isotherms.products import PRODUCTS
from granum.humid_gas.formulas.transport import transport


@pytest.mark.parametrize(
    ("shape", "series"),
    [pytest.param("plate", diffusion.plate, marks=pytest.mark.long), ("sphere", diffusion.sphere)],
)
def test_crank_is_the_limit_of_fast_films(shape: str, series) -> None:
    t = np.linspace(0.0, 40000.0, 9)
    course = body_drying(
        t,
        0.005,
        0.5,
        333.15,
        0.01,
        1e5,
        3e-10,
        isotherm=Gab(0.07, 12.0, 0.85),
        shape=shape,
        shrinkage_coefficient=0.0,
        mass_transfer_coefficient=100.0,
        thermal_conductivity=100.0,
        initial_temperature=333.15,
    )
    Xe = course.moisture_dry_basis_surface[-1]
    MR = (course.moisture_dry_basis - Xe) / (0.5 - Xe)
    np.testing.assert_allclose(MR, series(3e-10 * t / 0.005**2), atol=2e-3)
    # the defect of a known open tool: its center never dries
    assert course.moisture_dry_basis_center[-1] < 0.4


def test_wet_start_and_dry_end() -> None:
    iso = Gab(0.07, 12.0, 0.85)
    # as many as above: one compiled integration
    t = np.array([0.0, 300.0, 900.0, 1e4, 3e4, 6e4, 1e5, 1.5e5, 2e5])
    course = body_drying(
        t, 0.005, 4.0, 333.15, 0.01, 30.0, 3e-8, isotherm=iso, dry_density=1400.0, shrinkage_coefficient=1.4
    )
    # internal transport being fast, the surface sits at the wet bulb with the analogy's Lewis factor of 0.89;
    # by hand at 26.9 °C:
    # (0.0224 − 0.010) · 2437 kJ/kg = 30.2 against 0.89 · 1.026 · 33.1 = 30.2 kJ per kg of dry air
    assert course.surface_temperature[2] == pytest.approx(273.15 + 26.9, abs=0.4)
    assert course.temperature_center[-1] == pytest.approx(333.15, abs=0.05)
    phi = 0.01 / (0.62195 + 0.01) * 101325 / 19946.0  # p_s(60 °C) of the steam tables
    assert course.moisture_dry_basis[-1] == pytest.approx(float(iso(phi)), rel=0.01)
    # all the water that left is the volume that left: dry solid is conserved by the moving grid
    thickness = 0.005 * (1 + 1.4 * course.moisture_dry_basis) / (1 + 1.4 * 4.0)
    np.testing.assert_allclose(course.half_thickness, thickness, rtol=1e-9)


def test_products() -> None:
    for name, product in PRODUCTS.items():
        isotherm, T = product(), np.mean(product.card.fitted.get("temperature", 303.15))
        a = np.linspace(*product.card.fitted["water_activity"], 7)
        X = np.asarray(isotherm.moisture(a, T))
        assert np.all(np.diff(X) > 0), name
        np.testing.assert_allclose(isotherm.activity(X, T), a, rtol=1e-9)
    # grain trade keeps maize, wheat and paddy at 13 to 14 % wet basis
    for name in ("maize", "hard_wheat", "rice"):
        assert 0.125 < moisture_wet_basis(moisture_for_storage(298.15, PRODUCTS[name](), "molds")) < 0.15
    # Beuchat (1981) as opened: 0.91, 0.87, 0.65, 0.60; molds after the notes
    np.testing.assert_allclose(water_activity_margin(1.0), [-0.09, -0.13, -0.3, -0.35, -0.4], atol=1e-12)


def test_products_against_works_that_quote_or_measured_them_too() -> None:
    # second form of ASAE D245, M = E - F ln[-(t + C) ln a], as opened in open firmware: maize and rice
    for name, E, F, C in (("maize", 0.3387, 0.0590, 30.205), ("rice", 0.2939, 0.0460, 35.703)):
        assert float(PRODUCTS[name]().moisture(0.7, 298.15)) == pytest.approx(
            E - F * np.log(-(25 + C) * np.log(0.7)), rel=2e-3
        )
    # later edition, B per percent, and the extension tables drawn from it: maize at 60 °F and 80 % keeps
    # 16.1 %, wet basis
    assert moisture_wet_basis(
        float(ChungPfost(374.34, 18.662, 31.696).moisture(0.8, 288.706))
    ) == pytest.approx(0.161, abs=5.1e-4)
    # extension table of the standard, wet basis: soybeans at 25 % and 1.7, 10, 21.1, 37.8 °C, then 80 and
    # 30 %
    beans = PRODUCTS["soybean"]()
    a, t = np.array([0.25, 0.25, 0.25, 0.25, 0.8, 0.3]), np.array([1.7, 10.0, 21.1, 37.8, 15.556, 10.0])
    np.testing.assert_allclose(
        moisture_wet_basis(beans.moisture(a, t + 273.15)),
        [0.059, 0.057, 0.055, 0.052, 0.1825, 0.063],
        atol=5.1e-4,
    )
    # wheat, wet basis, to half a percent between varieties: 14.5 % at 20 °C and 70 % (a store's handbook),
    # 10.8 % at 90 °F and 50 % (Kentucky, soft red)
    wheat = moisture_wet_basis(
        PRODUCTS["wheat"]().moisture(np.array([0.7, 0.5]), np.array([293.15, 305.372]))
    )
    np.testing.assert_allclose(wheat, [0.145, 0.108], atol=5e-3)
    # other hands at 25 °C: Sun (2008), Avicel PH102; Roos and Karel, amorphous lactose, of which Roos (2002)
    # gives 6.8 g/100 g at 37 %
    a = np.array([0.2, 0.37, 0.5])
    np.testing.assert_allclose(
        PRODUCTS["microcrystalline_cellulose"]().moisture(a, 298.15),
        Gab(0.0355, 14.42, 0.814).moisture(a, 298.15),
        rtol=0.1,
    )
    np.testing.assert_allclose(
        PRODUCTS["amorphous_lactose"]().moisture(a, 298.15),
        Gab(0.0491, 4.33, 1.18).moisture(a, 298.15),
        rtol=0.15,
    )
    assert float(PRODUCTS["amorphous_lactose"]().moisture(0.37, 298.15)) == pytest.approx(0.068, rel=0.15)
    # a crystal of lactose holds a thousandth, Bronlund and Paterson (2004): m 1.68e-4, C 8.8, K 0.878
    assert float(PRODUCTS["lactose_monohydrate"]().moisture(0.6, 298.15)) < 2e-3
    with flags.collect() as records, flags.inside(equilibrium_moisture):
        PRODUCTS["hypromellose"]()(0.03, 298.15)
    assert [bool(r.mask) for r in records] == [True, False]


def test_transport_of_humid_air() -> None:
    # pure ends: dry air at 300 K (Incropera, table A.4: 184.6e-7 Pa s, 26.3 mW/(m K), Pr 0.707), water in air
    # D = 0.26 cm²/s at 298 K
    dry = transport(300.0, 0.0)
    assert dry.dynamic_viscosity == pytest.approx(184.6e-7, rel=0.01)
    assert dry.thermal_conductivity == pytest.approx(26.3e-3, rel=0.01)
    assert dry.prandtl_number == pytest.approx(0.707, rel=0.015)
    assert transport(298.0, 0.0).diffusivity == pytest.approx(0.26e-4, rel=0.05)
    assert 0.8 < dry.lewis_number < 0.9
    steam = transport(400.0, 1e9)  # saturated-steam tables continue to 13.4e-6 Pa s at 400 K, low pressure
    assert steam.dynamic_viscosity == pytest.approx(13.3e-6, rel=0.02)
