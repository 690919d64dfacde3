"""The whey line: it closes, every check holds, protein and lactose part as in dairies."""

from __future__ import annotations

from functools import cache

import pytest
from tests.sharing.places import EXAMPLES

import granum as gr


@cache
def line():
    return gr.read(EXAMPLES / "whey" / "line.toml").solve()


def test_closes_within_all_limits() -> None:
    run = line()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    assert all(check.ok for unit in run.units.values() for check in unit.checks)


def test_the_concentrate_is_mostly_protein() -> None:
    """Baldasso, Barros and Tessaro 2011 (abstract): more than 70 % of the dry matter."""
    stream = line().streams["protein_concentrate"]
    dry = float(stream.solid_flow + stream.liquid[1])
    assert 0.70 < float(stream.solid_flow) / dry < 0.95


def test_the_membranes_take_most_of_the_water() -> None:
    run = line()
    taken = float(run.streams["recovered_water"].mass_flow)
    boiled = run.figure("evaporation.evaporation_rate")
    assert taken > 4.0 * boiled
    # membranes take a kilowatt hour or two per cubic meter, boiling in three effects two hundred and more
    assert run.figure("reverse_osmosis.energy_per_filtrate") < 2.0 * 3.6e6
    assert run.figure("evaporation.heat_duty") / boiled * 1e3 > 200.0 * 3.6e6


def test_lactose_is_where_it_went() -> None:
    streams = line().streams
    molar = 342.2965 / 360.3118
    fed = float(streams["whey"].liquid[1])
    crystals = float(streams["lactose"].solid_by_species[0]) * molar
    assert 0.5 < crystals / fed < 0.65
    assert float(streams["clean_water"].liquid[1]) / fed == pytest.approx(0.0, abs=0.01)
