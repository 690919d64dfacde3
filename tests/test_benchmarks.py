"""The command that runs the benchmarks: rows, tables, failures. No times are tested."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest
import typer
from benchmarks import __main__ as command
from benchmarks.rows import COLLECTOR, Row, number, spelled, tell
from benchmarks.tables import rewritten, table
from typer.testing import CliRunner

FALLING = Row("falling", 0.0771, "fluids", 9.87, "4.6 %", script="terminal_velocity")
RISING = Row("rising", 2.0, "psychrolib", script="wet_bulb")


def test_rows_make_a_table() -> None:
    assert table([FALLING, RISING]).splitlines() == [
        "| question | script | Granum | peer | ratio | the two agree within |",
        "| --- | --- | --: | --: | --: | --: |",
        "| falling | `terminal_velocity.py` | 77 ms | fluids: 9.9 s | 128 | 4.6 % |",
        "| rising | `wet_bulb.py` | 2 s | psychrolib: not installed |  |  |",
    ]


def test_columns_that_no_row_fills_are_left_out() -> None:
    rows = [Row("half", kind="recycle", figures={"Anderson": "3"}), Row("all", kind="recycle", figures={})]
    assert table(rows) == "| case | Anderson |\n| --- | --: |\n| half | 3 |\n| all |  |"


def test_of_a_start_the_ratio_says_how_many_times_longer_granum_takes() -> None:
    assert Row("`granum list`", 0.5, "import jax", 1.0, kind="start").ratio == 0.5
    assert Row("sizes", 0.5, "fluids", 1.0).ratio == 2.0


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        (9.96, "10 s"),
        (99.7, "100 s"),
        (1638.0, "1638 s"),
        (0.9996, "1 s"),
        (1.14e-3, "1.1 ms"),
        (7e-5, "70 µs"),
    ],
)
def test_times_are_spelled(seconds: float, text: str) -> None:
    assert spelled(seconds) == text


def test_numbers_keep_the_digits_before_the_point() -> None:
    assert [number(x) for x in (0.0, 0.123, 3.0, 9.96, 453.2)] == ["0", "0.12", "3", "10", "453"]


def test_only_measured_tables_are_rewritten() -> None:
    peers = "<!-- benchmarks: peer -->\nold\n<!-- /benchmarks -->"
    page = f"a\n{peers}\nb\n<!-- benchmarks: line -->\nkept\n<!-- /benchmarks -->\n"
    anew = rewritten(page, {"peer": "new"})
    assert anew == page.replace("old", "\nnew\n")
    assert rewritten(anew, {"peer": "new"}) == anew


def test_the_tables_of_the_page_hold_what_was_measured() -> None:
    runs = json.loads((command.HERE / "results.json").read_text(encoding="utf-8"))
    page = command.PAGE.read_text(encoding="utf-8")
    assert rewritten(page, command.pages(runs)) == page


def test_a_row_is_handed_over(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(COLLECTOR, str(tmp_path / "rows"))
    tell(FALLING)
    assert Row(**json.loads((tmp_path / "rows").read_text(encoding="utf-8"))) == FALLING


PROGRAMS = {
    "terminal_velocity": "from benchmarks.rows import *; tell(Row('falling', 1.0, 'fluids', 3.0))",
    "wet_bulb": "import sys; print('noise', file=sys.stderr); raise SystemExit('over budget')",
    "studies": "from benchmarks.rows import *; tell(Row('cases', 2.0, kind='alone'))",
}


@pytest.fixture
def page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A page of its own, and programs of one line in place of the scripts."""
    page = tmp_path / "page.md"
    page.write_text("<!-- benchmarks: peer -->\n<!-- /benchmarks -->\n", encoding="utf-8")
    monkeypatch.setattr(command, "PAGE", page)
    monkeypatch.setattr(command, "command", lambda script: [sys.executable, "-c", PROGRAMS[script]])
    return page


def run(page: Path, *words: str) -> tuple[int, str]:
    """Exit status and complaints; the rows stand in ``rows.json`` beside the page."""
    app = typer.Typer()
    app.command()(command.main)
    found = CliRunner().invoke(app, [*words, "--json", str(page.with_name("rows.json"))])
    return found.exit_code, found.stderr


def test_scripts_that_run_are_kept_and_written(page: Path) -> None:
    assert run(page, "studies")[0] == 0
    assert run(page, "terminal_velocity", "--write")[0] == 0
    runs = json.loads(page.with_name("rows.json").read_text(encoding="utf-8"))
    assert list(runs) == ["studies", "terminal_velocity"]
    assert runs["studies"]["rows"][0]["script"] == "studies"
    assert "| falling | 1 s | fluids: 3 s | 3 |" in page.read_text(encoding="utf-8")


def test_a_script_that_fails_is_told_and_the_others_run(page: Path) -> None:
    status, complaints = run(page, "wet_bulb", "studies")
    assert status == 1
    assert "wet_bulb failed, exit status 1: over budget" in complaints
    assert list(json.loads(page.with_name("rows.json").read_text(encoding="utf-8"))) == ["studies"]


def test_an_unknown_script_is_named(page: Path) -> None:
    status, complaints = run(page, "weather")
    assert status == 2
    assert "weather" in complaints
