"""Thermal vapor recompression: a maker's plant, the program of others, balances, refusals."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import granum as gr
from granum.cases.alone import alone
from granum.core.errors import ApplicabilityError, ConvergenceError, InputError
from granum.evaporation.equipment.multiple_effect import MultipleEffectEvaporator, SteamJetEvaporator
from granum.streams.feeding import feed
from granum.streams.from_materials import mixture_of

SYRUP = mixture_of(["water", "sucrose"], [], ["water"], np.geomspace(1e-5, 4e-3, 3))
WIDE: dict[str, Any] = {
    "heat_transfer_coefficient_first": 3000.0,
    "elevation_linear": 0.0,
    "effect_count": "2",
}


def juice():
    return feed(SYRUP, temperature="75 degC", liquid_flow="15 t/h", liquid={"water": 0.92, "sucrose": 0.08})


def test_the_ratio_is_that_of_another_program_but_for_its_sign() -> None:
    """WaterTAP's test, opened: 3 bar, 1 bar to 1.9 bar at 100 °C give 2.601 with + 0.0009 p_m, where its own
    documentation, and this, have −.
    """
    pm = 300.0
    right, slipped = (3e-7 * pm**2 + sign * 0.0009 * pm + 1.6101 for sign in (-1.0, 1.0))
    found = gr.evaporation.motive_steam_ratio_el_dessouky("3 bar", "1 bar", "1.9 bar", "100 degC")
    assert found * slipped / right == pytest.approx(2.601, rel=1e-3)


def test_a_jet_saves_a_third_of_the_steam_of_two_effects() -> None:
    """Swenson's page, opened: sodium sulfate in two effects, 85 psig; the jet takes vapor of 19 inHg to 32
    inHg (absolute); 2.90 lb are evaporated per lb of steam, 1.94 without the jet.
    """
    # the area and the second coefficient put the first effect at 19 inHg; the last is at 4 inHg
    jet = SteamJetEvaporator(
        "60 m2",
        "13.5 kPa",
        "108.4 kPa",
        pressure_motive="687 kPa",
        heat_transfer_coefficient_last=700.0,
        **WIDE,
    )
    made = jet.operate(feed=juice())
    assert float(made.figures.pressure_suction) == pytest.approx(64.3e3, rel=0.1)
    plain = MultipleEffectEvaporator(
        "60 m2", "13.5 kPa", "108.4 kPa", heat_transfer_coefficient_last=700.0, **WIDE
    )
    without = plain.operate(feed=juice())
    gain = float(made.figures.steam_economy / without.figures.steam_economy)
    assert gain == pytest.approx(2.90 / 1.94, rel=0.08)
    assert float(made.figures.steam_economy) == pytest.approx(2.90, rel=0.1)


@pytest.mark.parametrize(("feeding", "effect"), [("forward", "1"), ("backward", "2")])
def test_mass_energy_and_the_heat_of_the_first_chest(feeding: Any, effect: Any) -> None:
    jet = SteamJetEvaporator(
        "40 m2",
        "20 kPa",
        "120 kPa",
        pressure_motive="9 bar",
        feeding=feeding,
        suction_effect=effect,
        effect_count="3",
        elevation_linear=0.0,
    )
    entering = juice()
    made = jet.operate(feed=entering)
    out = made.outlets
    streams = (out.product, out.vapor, out.condensate)
    total = sum(np.asarray(x.components) for x in streams)
    np.testing.assert_allclose(total, np.asarray(entering.components), rtol=1e-12)
    # by hand from steam tables: motive steam of 9 bar to condensate of 1.2 bar, 2773 − 439 kJ/kg
    figures, inside = made.figures, made.inside
    sucked = float(inside.suction.condensate.mass_flow)
    motive = float(figures.steam_flow)
    assert motive == pytest.approx(sucked * float(figures.motive_steam_ratio), rel=1e-9)
    assert float(out.heat_duty) == pytest.approx(motive * 2334e3, rel=5e-3)
    first = float(inside.effects[0].duty)
    assert first == pytest.approx(motive * 2334e3 + sucked * 2190e3, rel=0.02)


def test_more_motive_pressure_saves_and_pressing_higher_costs() -> None:
    ratio = gr.evaporation.motive_steam_ratio_el_dessouky
    assert ratio("12 bar", "0.5 bar", "1 bar", "81 degC") < ratio("4 bar", "0.5 bar", "1 bar", "81 degC")
    assert ratio("8 bar", "0.5 bar", "1.5 bar", "81 degC") > ratio("8 bar", "0.5 bar", "1 bar", "81 degC")


def test_what_a_jet_cannot_is_refused() -> None:
    with pytest.raises(InputError, match="cannot suck from number 3"):
        alone("evaporation.steam_jet_evaporator", suction_effect="3")
    with pytest.raises(ApplicabilityError, match="above what it sucks"):
        gr.evaporation.motive_steam_ratio_el_dessouky("8 bar", "1 bar", "0.9 bar", "99 degC")
    cold = feed(SYRUP, temperature="5 degC", liquid_flow="60 t/h", liquid={"water": 0.92, "sucrose": 0.08})
    jet = SteamJetEvaporator("60 m2", "50 kPa", "75 kPa", pressure_motive="15 bar", **WIDE)
    made = jet.operate(feed=cold)
    assert any("suck more vapor" in r.reason for r in made.records if np.any(r.mask))


def test_motive_steam_must_be_above_what_the_jet_delivers() -> None:
    with pytest.raises(ApplicabilityError, match="drives a jet only"):
        gr.evaporation.motive_steam_ratio_el_dessouky("1 bar", "0.5 bar", "1.2 bar", "81 degC")
    with pytest.raises(ConvergenceError, match="drives a jet only"):
        alone("evaporation.steam_jet_evaporator", pressure_motive="1.1 bar", pressure_steam="1.2 bar").solve()
