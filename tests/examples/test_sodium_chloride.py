"""The salt line: it closes, and its steam, its salt and its purge are what a hand balance and tables give."""

from __future__ import annotations

import pytest
from tests.sharing.places import EXAMPLES

import granum as gr

ENDS = ("brine", "vapor", "condensate", "purged", "salt")


@pytest.fixture(scope="module")
def run():
    return gr.read(EXAMPLES / "sodium-chloride" / "line.toml").solve()


def test_it_closes(run):
    assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9
    salt = {name: float(run.streams[name].liquid[1] + run.streams[name].solid_flow) for name in ENDS}
    assert salt.pop("brine") == pytest.approx(sum(salt.values()), rel=1e-9)
    assert all(check.ok for unit in run.units.values() for check in unit.checks)


def test_steam_is_that_of_a_hand_balance(run):
    """2163 kJ/kg condense at 3 bar (steam tables); with four effects a kilogram boils off less than four."""
    made = run.units["evaporation"].values
    steam = float(made.steam_flow)
    assert steam * 2163e3 == pytest.approx(float(made.heat_duty), rel=0.002)
    boiled = float(run.streams["vapor"].gas[1] + run.streams["condensate"].liquid[0])
    assert float(made.evaporation_rate) == pytest.approx(boiled, rel=1e-9)
    assert 2.5 < boiled / steam < 4.0


def test_the_purge_is_saturated(run):
    """38.0 g per 100 g of water at 80 °C, 38.5 at 90 °C (CRC Handbook of Chemistry and Physics)."""
    purged = run.streams["purged"]
    assert 0.376 < float(purged.liquid[1] / purged.liquid[0]) < 0.389


def test_water_that_boils_off_counts_for_the_line(run):
    boiled = float(run.streams["vapor"].gas[1] + run.streams["condensate"].liquid[0])
    dried = float(run.streams["exhaust_air"].gas[1] - run.streams["hot_air"].gas[1])
    assert run.utilities.evaporation_rate == pytest.approx(boiled + dried, rel=1e-9)
