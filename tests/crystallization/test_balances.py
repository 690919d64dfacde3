"""Steady balances against worked examples of textbooks."""

from __future__ import annotations

import pytest

from granum.core.errors import ApplicabilityError
from granum.crystallization.formulas.balances import (
    area_jacket,
    crystallizer_balance,
    evaporation_for_yield,
    heat_duty_crystallizer,
    log_mean_temperature_difference,
    vacuum_crystallizer_balance,
)
from granum.crystallization.formulas.supersaturation import (
    solute_per_solvent_from_hydrate,
    solute_per_solvent_hydrate,
)


def test_sodium_carbonate_of_geankoplis():
    """Example 12.11-1: 10 000 kg of 30 % Na2CO3 to 20 °C; without and with 3 % of the weight evaporated:
    6370 and 6630 kg.
    """
    x = 106.0 / 286.2
    dry = crystallizer_balance(10000.0, 0.30, 0.215, x)
    wet = crystallizer_balance(10000.0, 0.30, 0.215, x, 300.0)
    assert dry.crystal_flow == pytest.approx(6370, rel=2e-3)
    assert dry.mother_liquor_flow == pytest.approx(3630, rel=3e-3)
    assert wet.crystal_flow == pytest.approx(6630, rel=2e-3)
    assert wet.mother_liquor_flow == pytest.approx(3070, rel=3e-3)


def test_magnesium_sulfate_of_geankoplis():
    """Example 12.11-2: 2268 kg/h from 327.6 to 293.2 K with 616.9 kg/h of crystals, -261 912 kJ/h."""
    duty = heat_duty_crystallizer(2268 / 3600, 2930.0, 327.6, 293.2, 616.9 / 3600, 13.31e6 / 246.49)
    assert duty * 3600 / 1e3 == pytest.approx(-261912, rel=1e-3)


def test_sodium_acetate_of_mullin():
    """Vacuum crystallizer fed with 2000 kg/h of 40 % solution at 80 °C, boiling at 29 °C: 0.153 kg/kg
    evaporates.

    Mullin's yield equation, W R (c1 - c2 (1 - V)) / (1 - c2 (R - 1)), evaluated by hand with that: 648.3 kg/h
    of trihydrate.
    """
    out = vacuum_crystallizer_balance(2000.0, 0.4, 0.539, 353.15, 302.15, 3500.0, 144e3, 2.46e6, 82.0 / 136.0)
    assert out.evaporation / 1200 == pytest.approx(0.153, rel=5e-3)
    assert out.crystal_flow == pytest.approx(648.3, rel=2e-3)
    # The balance closes on solute and on heat.
    solute = out.mother_liquor_flow * 0.539 / 1.539 + out.crystal_flow * 82.0 / 136.0
    assert solute == pytest.approx(800.0, rel=1e-12)
    heat = heat_duty_crystallizer(
        2000.0, 3500.0, 353.15, 302.15, out.crystal_flow, 144e3, out.evaporation, 2.46e6
    )
    assert heat == pytest.approx(0.0, abs=1e-3)


def test_undersaturated_feed_makes_nothing_and_says_so():
    found = crystallizer_balance.evaluate(mass_flow=1.0, solute_mass_fraction=0.1, solubility_per_solvent=0.5)
    assert found.value.crystal_flow == 0.0
    assert any(n["flag"] == "limit active" for n in found.notices)


def test_log_mean_and_area():
    assert log_mean_temperature_difference(20.0, 20.0) == pytest.approx(20.0)
    assert log_mean_temperature_difference(20.0, 19.9999) == pytest.approx(19.99995, rel=1e-9)
    assert area_jacket(-100e3, 500.0, 20.0, 10.0) == pytest.approx(100e3 / 500 / 14.4269504, rel=1e-8)


def test_evaporation_for_a_yield():
    """By hand: 1000 kg/h of 20 % brine, 70 % of the salt: 140 kg/h crystals, 60 kg/h in liquor of
    0.384/1.384, the rest is vapor; hydrates by the balance.
    """
    assert evaporation_for_yield(1000.0, 0.7, 0.2, 0.384) == pytest.approx(1000 - 140 - 60 * 1.384 / 0.384)
    x = 142.04 / 322.2
    V = evaporation_for_yield(1000.0, 0.6, 0.15, 0.09, x)
    assert crystallizer_balance(1000.0, 0.15, 0.09, x, V).yield_fraction == pytest.approx(0.6)
    with pytest.raises(ApplicabilityError):
        evaporation_for_yield(1000.0, 0.3, 0.3, 0.09, x)  # cooling alone gives more


def test_states_that_cannot_be_are_told():
    """A solubility in hydrate per water, more evaporated than there is, and a feed richer than the crystal;
    the dry end is possible.
    """
    with pytest.raises(ApplicabilityError, match="solute_per_solvent_from_hydrate"):
        crystallizer_balance(1.0, 0.3, 1.05, 0.44)
    for impossible in ((1.0, 0.2, 0.384, 1.0, 0.9), (1.0, 0.5, 0.2, 0.44)):
        with pytest.raises(ApplicabilityError, match="No mother liquor"):
            crystallizer_balance(*impossible)
    assert crystallizer_balance(1.0, 0.2, 0.384, 1.0, 0.8).crystal_flow == pytest.approx(0.2)
    assert float(crystallizer_balance(1.0, 0.1, 0.384).crystal_flow) == 0.0


def test_hydrate_per_water_and_back():
    fraction = 120.3 / 246.3
    assert solute_per_solvent_from_hydrate(
        solute_per_solvent_hydrate(0.642, fraction), fraction
    ) == pytest.approx(0.642)
