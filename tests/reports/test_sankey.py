"""Sankey diagrams: as much out of every unit as into it, vapor with its heat of vaporization, what stands on
the page and in the report.
"""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.core.errors import InputError
from granum.core.i18n import language
from granum.reports.html import line_report
from granum.reports.sankey import diagrams, flows, sankey, subjects
from granum.streams.names import pretty

LINES = ("spray-drying", "grinding-circuit/circuit.toml", "potassium-nitrate")


@pytest.fixture(scope="module")
def spray():
    return gr.read(EXAMPLES / "spray-drying" / "line.toml").solve()


@pytest.fixture(scope="module", params=LINES)
def run(request):
    place = EXAMPLES / request.param
    return gr.read(place if place.suffix else place / "line.toml").solve()


def test_every_unit_gives_what_it_takes(run) -> None:
    for of in subjects(run):
        into, out = Counter(), Counter()
        for flow in flows(run, of):
            assert flow.value > 0.0
            into[flow.target] += flow.value
            out[flow.source] += flow.value
        for unit in run.sheet.units:
            assert into[unit] == pytest.approx(out[unit], rel=1e-8), (of, unit)


def test_mass_is_that_of_the_streams(spray) -> None:
    drawn = Counter()
    for flow in flows(spray):
        drawn[flow.name] += flow.value
    for name, stream in spray.streams.items():
        assert drawn[name] == pytest.approx(float(stream.mass_flow), rel=1e-8)


def test_vapor_carries_its_heat_of_vaporization(spray) -> None:
    """Steam tables: 2442 kJ/kg at 25 °C; what air and vapor hold above that is sensible heat, 1.006 and 1.86
    kJ/(kg K).
    """
    [drawn] = [flow for flow in flows(spray, "energy") if flow.name == "stack"]
    dry, vapor = np.asarray(spray.streams["stack"].gas)
    above = float(spray.streams["stack"].temperature) - 298.15
    expected = vapor * 2442e3 + (1006.0 * dry + 1860.0 * vapor) * above
    assert drawn.value == pytest.approx(expected, rel=5e-3)


def test_heat_and_work_stand_in_the_diagram(spray) -> None:
    drawn = {flow.name: flow for flow in flows(spray, "energy")}
    heat, loss = drawn["heater · heat duty"], drawn["tower · heat duty"]
    assert heat.value == pytest.approx(float(spray.figure("heater.heat_duty")))
    assert (heat.target, loss.source, loss.value) == ("heater", "tower", pytest.approx(20e3))


def test_what_is_no_subject_is_refused(spray) -> None:
    with pytest.raises(InputError, match="dry air"):
        spray.sankey("dry ait")


def test_page_and_report_show_them_in_both_languages(spray) -> None:
    assert [d["name"] for d in diagrams(spray)] == [
        "mass",
        "energy",
        "water",
        "dry air",
        "lactose monohydrate",
    ]
    assert "Flow of energy" in line_report(spray)
    with language("fr"):
        assert "Flux d’énergie" in line_report(spray)
        assert diagrams(spray)[2]["title"] == "Flux : eau"


def test_figure_has_all_flows(spray) -> None:
    link = sankey(spray, "water").data[0].link
    assert len(link.value) == len(flows(spray, "water"))
    assert np.sum(link.value) > 0.0


def test_units_and_streams_are_named_as_the_page_names_them(spray) -> None:
    with language("fr"):
        (mass, *_others) = diagrams(spray)
        labels = {name for part in ("node", "link") for name in mass["figure"]["data"][0][part]["label"]}
        assert labels >= {pretty(unit) for unit in spray.sheet.order}
        assert {"air chaud", "cheminée"} <= labels
        assert pretty("cyclones.gas_inlet").startswith("cyclones · ")
        assert pretty("dryer.vapor") == "séchoir · vapeur"
