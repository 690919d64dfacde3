"""Every program among the examples runs with what it asserts, and every case file can be read."""

from __future__ import annotations

import runpy
import tomllib

import pytest
from tests.sharing.places import EXAMPLES

import granum as gr

PROGRAMS = sorted(path.relative_to(EXAMPLES).as_posix() for path in EXAMPLES.glob("*/*.py"))
CASES = sorted(
    path.relative_to(EXAMPLES).as_posix()
    for path in EXAMPLES.rglob("*.toml")
    if "mixture" in tomllib.loads(path.read_text(encoding="utf-8"))
)
SLOW = {"seeded-crystallizer/seeded_batch.py", "polymorph/polymorph.py", "humid-air/humid_air.py"}


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=pytest.mark.long if n in SLOW else ()) for n in PROGRAMS]
)
def test_a_program_runs(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.argv", [name])
    runpy.run_path(str(EXAMPLES / name), run_name="__main__")


@pytest.mark.parametrize("name", CASES)
def test_a_case_can_be_read(name: str) -> None:
    assert gr.read(EXAMPLES / name).sheet.units
