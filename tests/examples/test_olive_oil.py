"""The olive-oil line: it closes, every check holds, and what leaves is what mills have."""

from __future__ import annotations

from functools import cache

import pytest
from tests.sharing.places import EXAMPLES

import granum as gr


@cache
def line():
    return gr.read(EXAMPLES / "olive-oil" / "line.toml").solve()


def test_closes_within_all_limits() -> None:
    run = line()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    assert all(check.ok for unit in run.units.values() for check in unit.checks)


def test_oil_pomace_and_vegetable_water_of_a_mill() -> None:
    """Biosystems Engineering, p. 393: 35 kg and more of pomace and 40 to 100 L of waste water per 100 kg of
    olives; wet pomace of three-phase decanters holds 45 to 50 % of water (from memory).
    """
    flows = {name: stream.mass_flow * 3600 / 20.0 for name, stream in line().streams.items()}
    assert 35.0 < flows["pomace"] < 60.0
    assert 40.0 < flows["vegetable_water"] < 100.0
    pomace = line().streams["pomace"]
    assert 0.45 < float(pomace.liquid_flow / pomace.mass_flow) < 0.50
    assert 0.9 < line().figure("decanter.light_recovery") < 1.0


def test_water_leaves_the_oil_and_oil_the_water() -> None:
    oil, water = line().streams["oil"], line().streams["vegetable_water"]
    # 0.2 % of moisture and volatile matter is the limit for virgin oil (Codex Alimentarius CXS 33)
    assert float(oil.liquid_flow / oil.mass_flow) < 2e-3
    lost = float(water.solid_by_species[0]) / (400.0 / 3600.0)
    assert lost < 0.015
    assert line().figure("separator.light_recovery") > 0.8


def test_the_scroll_takes_a_part_of_the_power() -> None:
    run = line()
    whole = run.figure("decanter.shaft_power")
    parts = [run.figure(f"decanter.power_{x}") for x in ("acceleration", "windage", "conveying")]
    assert sum(parts) == pytest.approx(whole)
    assert 0.1 < parts[2] / whole < 0.7
