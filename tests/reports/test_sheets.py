"""Streams and results as tables of a spreadsheet, in the form that it opens in either language."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest
from tests.sharing.places import EXAMPLES

from granum import cases, studies
from granum.core.i18n import language
from granum.flowsheet.run import Run


@pytest.fixture(scope="module")
def sized() -> Run:
    return cases.read(EXAMPLES / "lab-to-plant" / "line.toml").solve()


def test_workbook_holds_what_specifications_found_and_the_checks(sized: Run, tmp_path: Path) -> None:
    sized.tables(tmp_path / "line.xlsx")
    sheets = pd.read_excel(tmp_path / "line.xlsx", sheet_name=None)
    assert list(sheets) == ["streams", "sizes", "results", "specifications", "checks", "utilities"]
    (found,) = sheets["specifications"].to_dict("records")
    assert (found["unit"], found["input"]) == ("press", "area")
    assert found["value"] == pytest.approx(sized.found["press.area"])
    assert found["value"] == pytest.approx(
        sized.figure("press.area_required") / 0.8
    )  # what the case asks for
    checks = sheets["checks"]
    assert checks["kept"].all()
    assert len(checks) == len(sized.units["press"].checks)
    cycle = sheets["results"].set_index("result").loc["cycle_time"]
    assert cycle["unit as read"] == "min"
    assert cycle["as read"] == pytest.approx(cycle["value"] / 60.0)


def test_french_text_has_semicolons_and_decimal_commas(sized: Run, tmp_path: Path) -> None:
    sized.tables(tmp_path / "en.csv")
    with language("fr"):
        sized.tables(tmp_path / "fr.csv")
    assert (tmp_path / "fr.csv").read_bytes().startswith(b"\xef\xbb\xbf")
    rows = len(sized.streams)
    english = pd.read_csv(tmp_path / "en.csv", nrows=rows)
    french = pd.read_csv(tmp_path / "fr.csv", nrows=rows, sep=";", decimal=",", encoding="utf-8-sig")
    pd.testing.assert_frame_equal(english, french)


def test_cases_of_a_study_come_as_a_workbook_and_as_french_text(tmp_path: Path) -> None:
    spread = studies.sweep(
        "particles.terminal_velocity_stokes",
        {"particle_diameter": ["10 um", "20 um", "40 um"]},
        fixed={"particle_density": 2650, "fluid_density": 1000, "dynamic_viscosity": "1 cP"},
    )
    spread.save(tmp_path / "cases.xlsx")
    with language("fr"):
        spread.save(tmp_path / "cases.csv")
    workbook = pd.read_excel(tmp_path / "cases.xlsx")
    text = pd.read_csv(tmp_path / "cases.csv", sep=";", decimal=",", encoding="utf-8-sig")
    pd.testing.assert_frame_equal(workbook, text)
    # Stokes: with the square of the diameter
    speeds = workbook["terminal_velocity [m/s]"]
    assert list(speeds / speeds[0]) == pytest.approx([1.0, 4.0, 16.0])
