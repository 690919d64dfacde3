"""The line of carnallite: water that takes up the magnesium chloride leaves the potash behind."""

from __future__ import annotations

import pytest
from tests.sharing.places import EXAMPLES

import granum as gr

pytestmark = pytest.mark.long

LINE = EXAMPLES / "carnallite" / "line.toml"


def test_potash_as_by_hand_from_the_point_of_tables():
    """3.3 % KCl and 26.9 % MgCl2 beside potash and carnallite at 25 °C (D'Ans, 1933; recalled): 10 t of
    carnallite want 5.0 t of water and leave 2.26 t of potash.
    """
    run = gr.read(LINE).solve()
    assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9
    assert all(check.ok for unit in run.units.values() for check in unit.checks)
    potash, brine = run.streams["potash"], run.streams["magnesium_brine"]
    assert float(brine.liquid_fractions[1]) == pytest.approx(0.033, abs=0.005)
    assert float(brine.liquid_fractions[2]) == pytest.approx(0.269, abs=0.005)
    made = float(potash.solid_by_species[0] + brine.solid_by_species[0]) * 3600.0
    assert made == pytest.approx(2263.0, rel=0.03)
    assert float(potash.solid_by_species[1]) == 0.0
    # what comes as magnesium leaves in the brine, but for what clings to the potash
    kept = float(potash.solid_by_species[2] / potash.solid_flow)
    assert 0.0 < kept < 0.01
