"""The command line as a user types it: values, messages that help, exit status, JSON."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest
from tests.sharing.commands import granum

from granum import __version__
from granum.particles import terminal_velocity

TERMINAL = ["calc", "particles.terminal_velocity"]
GOOD = [
    "particle_diameter=85um",
    "particle_density=2630kg/m3",
    "fluid_density=1020kg/m3",
    "dynamic_viscosity=1.2cP",
]


def test_version() -> None:
    assert granum("--version")[:2] == (0, f"granum {__version__}\n")


@pytest.mark.parametrize(
    "words",
    [
        ["--lang", "fr", "show", "particles.terminal_velocity"],
        ["show", "particles.terminal_velocity", "--lang", "fr"],
    ],
)
def test_the_language_stands_before_or_after_the_command(words: list[str]) -> None:
    code, out, _err = granum(*words)
    assert code == 0
    assert "Vitesse terminale" in out


def test_units_and_bad_languages_after_the_command(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GRANUM_UNITS", "si")
    assert "ft" in granum(*TERMINAL, *GOOD, "--units", "field")[1]
    assert granum("list", "settling", "--lang", "de")[0] == 2


def test_bounds_of_counts_are_shown() -> None:
    assert "2 … 100000" in granum("show", "crystallization.batch")[1]


def test_a_result_prints_in_a_few_lines() -> None:
    fall = terminal_velocity.evaluate(
        particle_diameter="85 um", particle_density=2630, fluid_density=1020, dynamic_viscosity="1.2 cP"
    )
    assert str(fall) == "particles.terminal_velocity\nterminal velocity = 4.917 mm/s"
    assert repr(fall) == "<particles.terminal_velocity; terminal velocity = 4.917 mm/s>"
    beyond = str(
        terminal_velocity.evaluate(
            particle_diameter=["1 mm", "20 cm"],
            particle_density=2630,
            fluid_density=1020,
            dynamic_viscosity="1.2 cP",
        )
    )
    assert "! " in beyond
    assert "extrapolated" in beyond
    assert len(beyond) < 700


def test_terminal_velocity_with_source() -> None:
    code, out, _err = granum(*TERMINAL, *GOOD, "--json")
    data = json.loads(out)
    assert code == 0
    assert set(data) == {"card", "inputs", "outputs", "beside", "flags", "source"}
    # U notes, exercise IV.8.4: below the Stokes value 5.28 mm/s by the inertia at Re ≈ 0.36 (about 7 %)
    assert data["outputs"]["terminal_velocity"]["value"] == pytest.approx(4.92e-3, rel=0.01)
    assert data["outputs"]["terminal_velocity"]["unit"] == "m/s"
    assert data["source"]


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        (["particle_diametre=85um", *GOOD[1:]], "Did you mean 'particle_diameter'?"),
        (["particle_diameter=85s", *GOOD[1:]], "unit 's' does not fit"),
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
    code, out, _err = granum("show", "particles.terminal_velocity", "--json")
    assert code == 0
    assert {p["name"] for p in json.loads(out)["parameters"]} >= {"particle_diameter", "dynamic_viscosity"}


@pytest.mark.parametrize(
    ("word", "card"),
    [
        ("voidage", "porous.void_fraction_packed_bed"),
        ("umf", "fluidization.minimum_fluidization_velocity_wen_yu"),
        ("g-force", "centrifuges.centrifugal_effect"),
        ("SVI", "settling.sludge_volume_index"),
        ("tension de vapeur", "materials.water_vapor_pressure"),
        ("trainee", "particles.drag_coefficient_stokes"),
        ("Kozeny", "porous.permeability_kozeny_carman"),
    ],
)
def test_things_are_found_by_their_other_names(word: str, card: str) -> None:
    assert card in granum("list", *word.split())[1]


def test_missing_case_file_is_one_message() -> None:
    code, _out, err = granum("run", "no-such-line.toml")
    assert code == 2
    assert "cannot be read" in err


def test_import_and_help_load_nothing_heavy() -> None:
    text = (
        "import sys, granum, granum.cli; print([m for m in ('jax', 'numpy', 'plotly', 'pint', "
        "'scipy') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_a_reader_who_stops_is_no_failure() -> None:
    """As behind ``| head -1``: silence, and a status of its own."""
    words = [sys.executable, "-m", "granum", "list", "--json"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as child:
        assert child.stdout is not None
        assert child.stderr is not None
        child.stdout.read(1)
        child.stdout.close()
        assert child.stderr.read() == b""
        assert child.wait() in (1, 141)
