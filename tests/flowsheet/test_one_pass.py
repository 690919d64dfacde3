"""A unit solves itself once: run, note, study and line in time tell the same flags, checks and figures."""

from __future__ import annotations

from functools import wraps

import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

import granum as gr
from granum import studies
from granum.core.notices import describe
from granum.flowsheet import Flowsheet, march
from granum.fluidization.equipment.bed import FluidizedBed
from granum.settling.equipment.gravity import AbstractSettler
from granum.settling.equipment.thickener import Thickener
from granum.streams.units import Unit

BED = (EXAMPLES / "fluidized-bed" / "bed.toml").read_text(encoding="utf-8")
OTHER_LAW = BED.replace('mass = "900 kg"', 'mass = "900 kg"\nminimum_fluidization = "saxena_vogel"')


@pytest.fixture(scope="module")
def line():
    assert OTHER_LAW != BED
    return gr.cases.read_text(OTHER_LAW)


def told(rows) -> set[tuple[str, str, str]]:
    return {(row["flag"], row["card"], row["name"]) for row in rows}


def test_run_note_study_and_course_tell_the_same_flags(line) -> None:
    """Saxena and Vogel's law stands on coarse dolomite: the sand of this bed lies outside, whoever asks."""
    run = line.solve()
    steady = told(run.flags)
    assert (
        "extrapolated",
        "fluidization.minimum_fluidization_velocity_saxena_vogel",
        "reynolds",
    ) in steady or any(flag == "extrapolated" and "saxena_vogel" in card for flag, card, _name in steady)
    alone = [unit.operate(**run._inlets(name)) for name, unit in run.sheet.units.items()]
    assert told(row for made in alone for row in describe(made.records)) == steady
    course = march(line.sheet, np.linspace(0.0, 2.0, 3))
    assert told(course.flags) == steady
    assert all(row["count"] == 3 for row in course.flags if row["flag"] == "extrapolated")
    found = studies.sweep(line, {"bed.area": [1.4, 1.5]}, outputs=["bed.pressure_drop"])
    assert found.counts()["extrapolated"] == 2


def test_unit_and_run_have_the_same_checks_and_figures(line) -> None:
    run = line.solve()
    report, made = run.units["bed"], run.sheet.units["bed"].operate(**run._inlets("bed"))
    assert [(c.name, c.low, c.high, c.source) for c in report.checks] == [
        (c.name, c.low, c.high, c.source) for c in made.checks
    ]
    assert [float(c.value) for c in report.checks] == pytest.approx(
        [float(c.value) for c in made.checks], rel=1e-12
    )
    assert list(map(float, report.values)) == pytest.approx(list(map(float, made.figures)), rel=1e-12)


def test_limits_are_known_before_anything_is_calculated() -> None:
    names = [limit.name for limit in FluidizedBed.card.limits]
    assert names == [limit["name"] for limit in FluidizedBed.card.as_json()["limits"]]
    assert "distributor to bed pressure drop" in names
    assert AbstractSettler.limits.items() <= gr.settling.Lamella.limits.items()


def test_a_sheet_built_in_python_is_solved_audited_and_reported(line, tmp_path) -> None:
    run = Flowsheet(
        line.sheet.units, line.sheet.feeds, {k.name: (k.origin, k.target) for k in line.sheet.links}
    ).solve(title="By hand")
    assert run.figure("bed.pressure_drop") == pytest.approx(line.solve().figure("bed.pressure_drop"))
    run.report(tmp_path / "by_hand.html")
    assert "By hand" in (tmp_path / "by_hand.html").read_text(encoding="utf-8")


def test_only_what_is_asked_for_is_worked_out(monkeypatch) -> None:
    """A loop that only needs streams does not work out figures; whole, each of the four is entered once."""
    entered: list[str] = []
    for name in ("inside", "outlets", "figures", "measured"):
        own = getattr(Thickener, name)

        def counted(*given, own=own, name=name, **inlets):
            entered.append(name)
            return own(*given, **inlets)

        monkeypatch.setattr(Thickener, name, wraps(own)(counted))
    feed = gr.read(EXAMPLES / "potassium-nitrate" / "line.toml").sheet.feeds
    feed = next(iter(feed.values()))
    unit = Thickener(area=10.0, underflow_concentration=400.0, settling=gr.settling.Vesilind("5 m/hour", 0.5))
    unit(feed)
    assert entered == ["inside", "outlets"]
    entered.clear()
    assert unit.operate(feed=feed).figures is not None
    assert entered == ["inside", "outlets", "figures", "measured"]


def test_ports_are_named_by_the_balance() -> None:
    assert Thickener.inlet_names() == ("feed",)
    assert Thickener.outlet_names() == ("underflow", "overflow")
    assert gr.filtration.Nutsche.inlet_names() == ("feed", "wash")
    assert gr.filtration.Nutsche.optional_inlets() == ("wash",)
    assert issubclass(Thickener, Unit)
    assert Thickener.power_names() == ()
