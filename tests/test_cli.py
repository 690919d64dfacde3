"""The command line as a user types it: values, messages that help, exit status, JSON."""

from __future__ import annotations

import contextvars
import json
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from granum.cli import app

TERMINAL = ["calc", "particles.terminal_velocity"]
GOOD = ["particle_diameter=85um", "particle_density=2630kg/m3", "fluid_density=1020kg/m3", "dynamic_viscosity=1.2cP"]
ROOT = Path(__file__).parents[1]


def granum(*words: str) -> tuple[int, str, str]:
    outcome = contextvars.copy_context().run(CliRunner().invoke, app, list(words))  # the language ends with the command
    return outcome.exit_code, outcome.stdout, outcome.stderr


def test_terminal_velocity_with_source() -> None:
    code, out, _err = granum(*TERMINAL, *GOOD, "--json")
    data = json.loads(out)
    assert code == 0
    assert set(data) == {"card", "inputs", "outputs", "flags", "source"}
    # U notes, exercise IV.8.4: below the Stokes value 5.28 mm/s by the inertia at Re ≈ 0.36 (about 7 %)
    assert data["outputs"]["terminal_velocity"]["value"] == pytest.approx(4.92e-3, rel=0.01)
    assert data["outputs"]["terminal_velocity"]["unit"] == "m/s"
    assert data["source"]


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        (["particle_diametre=85um", *GOOD[1:]], "Did you mean 'particle_diameter'?"),
        (["particle_diameter=85s", *GOOD[1:]], "is a length: unit 's' does not fit"),
        (["particle_diameter=-85um", *GOOD[1:]], "must be greater than 0"),
        (["particle_diameter=abc", *GOOD[1:]], "is not a number with a unit"),
        (["particle_diameter", *GOOD[1:]], "is not of the form name=value"),
        (GOOD[1:], "particle_diameter"),
        ([*GOOD, "drag=stoks"], "Did you mean 'stokes'?"),
    ],
)
def test_bad_input_gets_one_message_and_status_two(words: list[str], wanted: str) -> None:
    code, out, err = granum(*TERMINAL, *words, "--json")
    assert code == 2
    assert wanted in err
    assert json.loads(out)["error"]["message"].strip() == err.strip()


def test_unknown_card_suggests() -> None:
    code, _out, err = granum("calc", "particles.terminal_velocty")
    assert code == 2
    assert "Did you mean 'particles.terminal_velocity'?" in err


def test_messages_in_french() -> None:
    code, _out, err = granum("--lang", "fr", *TERMINAL, "particle_diameter=-85um", *GOOD[1:])
    assert code == 2
    assert "diamètre" in err
    assert "doit être" in err


def test_table_in_a_narrow_terminal() -> None:
    code, out, _err = granum(*TERMINAL, *GOOD)
    assert code == 0
    assert max(map(len, out.splitlines())) <= 80
    assert "mm/s" in out


def test_list_and_show() -> None:
    assert "particles.terminal_velocity" in granum("list", "terminal")[1]
    assert "humid_gas.wet_bulb_temperature" in granum("list", "bulb", "wet")[1]
    assert "centrifuges.centrifugal_effect" in granum("list", "g-force")[1]  # another name, in the description only
    code, out, _err = granum("show", "particles.terminal_velocity", "--json")
    assert code == 0
    assert {p["name"] for p in json.loads(out)["parameters"]} >= {"particle_diameter", "dynamic_viscosity"}


def test_missing_case_file_is_one_message() -> None:
    code, _out, err = granum("run", "no-such-line.toml")
    assert code == 2
    assert "cannot be read" in err


def test_import_and_help_load_nothing_heavy() -> None:
    text = "import sys, granum, granum.cli; print([m for m in ('jax', 'plotly', 'pint', 'scipy') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
