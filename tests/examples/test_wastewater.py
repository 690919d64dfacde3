"""The waste-water line: it closes, every check holds, and the cake is that of belt presses."""

from __future__ import annotations

from functools import cache

from tests.sharing.places import EXAMPLES

import granum as gr


@cache
def line():
    return gr.read(EXAMPLES / "wastewater" / "line.toml").solve()


def test_closes_within_all_limits() -> None:
    run = line()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    assert all(check.ok for unit in run.units.values() for check in unit.checks)


def test_most_solids_end_in_a_cake_of_usual_dryness() -> None:
    """Metcalf and Eddy 2003, ch. 14 (from memory): 16 to 25 % of solids."""
    streams = line().streams
    caught = float(streams["cake"].solid_flow / streams["waste_water"].solid_flow)
    assert 0.75 < caught < 0.9
    assert 0.16 < float(streams["cake"].solids_mass_fraction) < 0.25


def test_what_stays_in_the_water_is_the_fines() -> None:
    before, after = (line().streams[n].size_fractions for n in ("flocs", "clear_water"))
    sizes = line().streams["flocs"].mixture.sizes
    assert float(after @ (sizes > 3e-5)) < 0.1 * float(before @ (sizes > 3e-5))
