"""The line of brine with sulfate: a purge that is large enough keeps the sulfate in solution."""

from __future__ import annotations

import pytest
from tests.sharing.places import EXAMPLES

import granum as gr

pytestmark = pytest.mark.long


def test_sulfate_leaves_with_the_purge():
    """4.4 % of sulfate at the invariant point in tables (Linke and Seidell; recalled), 3.9 by Pitzer's
    equations.
    """
    run = gr.read(EXAMPLES / "brine-with-sulfate" / "line.toml").solve()
    assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9
    assert all(check.ok for unit in run.units.values() for check in unit.checks)
    purged, salt, brine = (run.streams[name] for name in ("purged", "salt", "brine"))
    assert float(purged.liquid_fractions[2]) < 0.039
    left = float(purged.liquid[2] + salt.liquid[2] + salt.solid_by_species[1])
    assert left == pytest.approx(float(brine.liquid[2]), rel=1e-9)
    assert float(salt.solid_by_species[1] / salt.solid_flow) < 0.001
