"""Isotherms: printed tables, both directions, equal curves, isosteric heat; bases of moisture."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import granum as gr
from granum.drying.formulas.moisture import (
    equilibrium_moisture,
    glass_transition_temperature,
    isosteric_heat,
    kinds_of_water,
    moisture_dry_basis,
    moisture_wet_basis,
    sticking_share_particle_gun,
    water_activity,
)
from granum.drying.isotherms import adsorption as ads
from granum.drying.isotherms import empirical as emp
from granum.drying.isotherms import grains

T25 = 298.15
ISOTHERMS = [
    ads.Bet(0.05, 10.0),
    ads.BetLayers(0.05, 10.0, 8.0),
    ads.Gab(0.07, 12.0, 0.85),
    ads.Gab(0.0560, 0.017, 0.94, 1390.0, 20000.0, -920.0),
    ads.HailwoodHorrobin(),
    emp.Oswin(0.12, 0.4),
    emp.LewickiTwo(0.12, 0.6),
    emp.LewickiThree(0.17, 0.33, 0.7),
    emp.Halsey(0.02, 1.5),
    emp.FerroFontan(1.05, 0.03, 1.4),
    emp.Henderson(0.2, 1.8),
    emp.Smith(0.02, 0.1),
    emp.Peleg(0.15, 0.6, 0.27, 5.5),
    emp.DoubleLog(0.1, -0.05, 0.01, 0.0),
    emp.IglesiasChirife(2.0, -1.2, 0.04),
    emp.Caurie(-3.0, 2.0),
    emp.Kuhn(0.02, 0.03),
    emp.Bradley(1e-5, 3.0),
    emp.Chen(3.5, 14.0, -0.01),
    grains.HendersonModified(8.6541e-5, 1.8634, 49.810),
    grains.ChungPfost(312.30, 16.958, 30.205),
    grains.HalseyModified(2.87, -0.0054, 1.38),
    grains.OswinModified(15.303, -0.10164, 3.0358),
]


@pytest.mark.parametrize("isotherm", ISOTHERMS, ids=lambda i: type(i).__name__)
def test_both_directions_agree_and_rise(isotherm) -> None:
    a = np.linspace(0.15, 0.85, 8)
    X = np.asarray(isotherm.moisture(a, T25))
    assert np.all(np.diff(X) > 0)
    np.testing.assert_allclose(isotherm.activity(X, T25), a, rtol=1e-8)
    slopes = jax.vmap(jax.grad(lambda x: jnp.sum(jnp.asarray(isotherm.moisture(x, T25)))))(
        jnp.array([0.0, 0.5, 1.0])
    )
    assert jnp.all(jnp.isfinite(slopes))


def test_wood_handbook_table() -> None:
    # FPL-GTR-190, table 4-2, at 21.1 °C (70 °F): 30, 50, 65, 80 %
    wood = ads.HailwoodHorrobin()
    np.testing.assert_allclose(
        wood.moisture(np.array([0.3, 0.5, 0.65, 0.8]), 294.25), [0.062, 0.092, 0.120, 0.160], atol=6e-4
    )


def test_potato_of_the_survey_and_grain_forms() -> None:
    # wet-basis 13.9–14.3 % is the usual table value of shelled corn at 25 °C and 70 %
    for corn in ISOTHERMS[-4:-2]:
        x = moisture_wet_basis(float(corn.moisture(0.7, T25)))
        assert 0.137 < x < 0.145
    # the printed E, F form of Chung and Pfost: M = E − F ln[−(t + C) ln a] with E = ln(A)/B, F = 1/B
    E, F = np.log(312.30) / 16.958, 1 / 16.958
    assert float(ISOTHERMS[-3].moisture(0.7, T25)) == pytest.approx(
        E - F * np.log(-(25 + 30.205) * np.log(0.7)), rel=1e-12
    )


def test_equal_curves() -> None:
    a = np.linspace(0.1, 0.9, 9)
    np.testing.assert_allclose(
        emp.Oswin(0.12, 0.4).moisture(a, T25), emp.LewickiTwo(0.12, 0.6).moisture(a, T25), rtol=1e-12
    )
    A, B = 312.30 / 55.205, 16.958
    np.testing.assert_allclose(
        emp.Bradley(np.exp(-B), A).moisture(a, T25), ISOTHERMS[-3].moisture(a, T25), rtol=1e-9
    )
    np.testing.assert_allclose(
        emp.FerroFontan(1.0, 0.02, 1.5).moisture(a, T25), emp.Halsey(0.02, 1.5).moisture(a, T25), rtol=1e-9
    )
    # BET with many layers, GAB with K = 1
    np.testing.assert_allclose(
        ads.Gab(0.05, 10.0, 1.0).moisture(a, T25), ads.Bet(0.05, 10.0).moisture(a, T25), rtol=1e-12
    )
    # Langmuir
    np.testing.assert_allclose(
        ads.BetLayers(0.05, 10.0, 1.0).moisture(a, T25), 0.05 * 10 * a / (1 + 10 * a), rtol=1e-9
    )


def test_grain_equations_run_out_to_dry() -> None:
    """Chung and Pfost's equation ends at a water activity above zero; below it solid that is nearly dry had
    nothing to settle at, and dryers were not solved.
    """
    wheat = grains.ChungPfost(529.43, 17.609, 50.998)
    same = emp.Bradley(isotherm_base=float(np.exp(-17.609)), isotherm_coefficient=529.43 / (25.0 + 50.998))
    T, a = 298.15, np.geomspace(1e-6, 0.9, 60)
    X = np.asarray(wheat.moisture(a, T))
    assert np.all(np.diff(X) > 0.0)
    assert float(wheat.moisture(1e-9, T)) < 1e-12
    np.testing.assert_allclose(same.moisture(a, T), X, rtol=1e-9, atol=1e-15)
    np.testing.assert_allclose(wheat.activity(X, T), a, rtol=1e-6)
    printed = -np.log(-(25.0 + 50.998) * np.log(a) / 529.43) / 17.609
    np.testing.assert_allclose(X[printed > 0.01], printed[printed > 0.01], rtol=1e-5)


def test_isosteric_heat() -> None:
    corn = ISOTHERMS[-3]
    T, X = 298.15, 0.15
    by_hand = 8.314462618 / 0.018015268 * T**2 * 312.30 / (T - 273.15 + 30.205) ** 2 * np.exp(-16.958 * X)
    assert isosteric_heat(X, corn, T).isosteric_heat_net == pytest.approx(by_hand, rel=1e-9)
    assert isosteric_heat(0.1, ads.Gab(0.07, 12.0, 0.85), T).isosteric_heat_net == pytest.approx(
        0.0, abs=1e-6
    )
    assert isosteric_heat(X, corn, T).isosteric_heat > 2.44e6
    # Clausius–Clapeyron between two temperatures, as laboratories do it
    one, two = (float(corn.activity(X, t)) for t in (298.14, 298.16))
    difference = -8.314462618 / 0.018015268 * (np.log(two) - np.log(one)) / (1 / 298.16 - 1 / 298.14)
    assert isosteric_heat(X, corn, T).isosteric_heat_net == pytest.approx(difference, rel=1e-6)


def test_bases_and_kinds_of_water() -> None:
    x = np.linspace(0.0, 0.95, 5)
    np.testing.assert_allclose(moisture_wet_basis(moisture_dry_basis(x)), x, atol=1e-15)
    kinds = kinds_of_water(0.05, 0.5)  # drier than equilibrium: nothing to remove
    assert kinds.moisture_dry_basis_free == 0.0
    assert kinds.moisture_dry_basis_unbound == 0.0
    assert water_activity(equilibrium_moisture(0.6, ISOTHERMS[2]), ISOTHERMS[2]) == pytest.approx(0.6)
    assert glass_transition_temperature(0.0, 374.15, 6.7) == pytest.approx(374.15)


def test_milk_powder_sticks_as_the_particle_gun_found() -> None:
    """Murti and others, abstract read: 33.6 K over the glass transition of lactose, then 3.1 % per kelvin;
    and Roos, abstract read: lactose with 6.8 g of water in 100 g has its transition about room temperature.
    """
    glass = float(glass_transition_temperature(0.068 / 0.932, "101 degC", 6.7))
    assert 293.15 < glass < 300.15
    assert float(sticking_share_particle_gun(glass + 33.6, glass)) == pytest.approx(0.0, abs=1e-12)
    assert float(sticking_share_particle_gun(glass + 43.6, glass)) == pytest.approx(0.31)
    assert float(sticking_share_particle_gun(glass + 100.0, glass)) == 1.0


def test_a_spray_dryer_tells_what_would_stay_on_its_wall() -> None:
    """Every class apart: by hand from their temperatures and moistures as they end. Wetter feeds stick more,
    and without a glass transition nothing is told.
    """
    shares = []
    for liquid in ("1.2 t/h", "1.6 t/h", "2.2 t/h"):
        line = gr.alone(
            "drying.spray_dryer",
            glass_transition_temperature_dry="101 degC",
            **{"feed.liquid_flow": liquid},
        )
        checks = {c["name"]: c for c in line.solve().as_json()["units"]["spray_dryer"]["checks"]}
        told = checks["share of what meets a wall that stays on it"]["value"]
        profile = line.sheet.units["spray_dryer"].operate(**line.sheet.feeds).inside.profile
        X, T = np.asarray(profile.moisture)[-1], np.asarray(profile.temperature)[-1]
        glass = (374.15 + 6.7 * X * 138.15) / (1.0 + 6.7 * X)
        stays = np.clip(0.031 * (T - glass - 33.6), 0.0, 1.0)
        part = np.asarray(profile.shares)
        part = part[-1] if part.ndim == 2 else part
        assert told == pytest.approx(float(np.sum(part * stays) / np.sum(part)), rel=1e-6)
        shares.append(told)
    assert shares == sorted(shares)
    plain = gr.alone("drying.spray_dryer").solve().as_json()["units"]["spray_dryer"]["checks"]
    assert not [c for c in plain if "wall" in c["name"]]
