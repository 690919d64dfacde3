"""The report of a line: findings first, every figure, each step of the note once, nothing fetched from
outside, both languages.
"""

from __future__ import annotations

import re
from typing import Any

import pytest
from tests.sharing.places import EXAMPLES

from granum.cases import read
from granum.core.i18n import language
from granum.reports.html import line_report, note_steps, size_chart
from granum.reports.streams import stream_sheet
from granum.streams.names import pretty

LINES = ("grinding-circuit/circuit.toml", "humid-air/line.toml", "filters/drum.toml")


@pytest.fixture(scope="module", params=LINES)
def run(request: pytest.FixtureRequest) -> Any:
    return read(EXAMPLES / request.param).solve()


def test_a_report_holds_everything_and_opens_anywhere(run: Any) -> None:
    page = line_report(run)
    for unit in run.sheet.order:
        assert f">{pretty(unit)}<" in page
    for name in run.streams:
        assert f">{pretty(name)}<" in page
    steps = [step for name in run.sheet.order for step in note_steps(run.notes[name])]
    places = [
        page.index(f"<h2>{head}")
        for head in ("Findings", "Flow diagram", "Streams", "Calculation note", "Sources")
    ]
    assert ("no formula stands by itself" in page) == (not steps)
    assert places == sorted(places)
    outside = re.findall(
        r"""(?:src|href)=["'](?!data:|#)([^"']+)""",
        page.split("<script")[0] + page.rsplit("</script>", 1)[-1],
    )
    assert not outside
    assert "@page" in page
    # letters of equations: elsewhere a root would stand over the numerator alone
    assert 'math { font-family: "STIX Two Math"' in page
    assert 'src: local("STIX Two Math"), url(data:font/woff2;base64,' in page
    assert all(step["source"] for step in steps), [s["key"] for s in steps if not s["source"]]


def test_a_step_taken_again_stands_once(run: Any) -> None:
    for name in run.sheet.order:
        once = note_steps(run.notes[name])
        assert note_steps([*run.notes[name], *run.notes[name]]) == once
        assert {step["key"] for step in once} == {step.card.key for step in run.notes[name]}


def test_a_report_in_french(run: Any) -> None:
    with language("fr"):
        page, sizes = line_report(run), size_chart(run)
        drawn = {trace.name for trace in sizes.data} if sizes else set()
        assert drawn <= {pretty(name) for name in run.streams}
        for heading in run.charts():
            unit, _dot, inside = heading.partition(" · ")
            assert f"<h2>{pretty(unit)} · {inside}" in page
    assert '<html lang="fr">' in page
    for english in ("Findings", "Calculation note", "Flow diagram"):
        assert f"<h2>{english}" not in page


def test_sizes_of_molecules_and_of_crystals_stand_each_in_its_own_unit() -> None:
    with language("fr"):
        sheet = stream_sheet(read(EXAMPLES / "whey" / "line.toml").solve())
    heads = [head.label for head in sheet["heads"]]
    sizes = {name: cells[heads.index("d₅₀")] for name, cells in sheet["rows"]}
    assert sheet["heads"][heads.index("d₅₀")].unit == ""
    assert sizes["whey"].endswith(" nm")
    assert sizes["lactose"].endswith(" µm")
    assert "w sucre de lait" in heads  # the name that the file of the case gives
