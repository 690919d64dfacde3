"""A fluid in place of its properties."""

import json
import subprocess
import sys

import jax.numpy as jnp
import numpy as np
import pytest

import granum as gr
from granum.cases.studying import studies_of_text
from granum.cases.worded import study_text
from granum.core.errors import InputError
from granum.materials.stated import StatedFluid
from granum.studies.subjects import EXTRAPOLATED, FINE, FormulaSubject

GRAIN = {"particle_diameter": "85 um", "particle_density": 2630.0}


def test_water_gives_its_density_and_viscosity():
    """At 20 °C 998.2 kg/m³ and 1.0016 mPa s (IAPWS tables); the note says where they come from, and the
    velocity is that of these numbers.
    """
    result = gr.particles.terminal_velocity.evaluate(**GRAIN, fluid="water at 20 °C")
    assert result.inputs["fluid_density"] == pytest.approx(998.2, abs=0.1)
    assert result.inputs["dynamic_viscosity"] == pytest.approx(1.0016e-3, rel=2e-3)
    row = result.as_json()["inputs"]["dynamic_viscosity"]
    assert row["from"] == "water at 20 °C, liquid"
    plain = gr.particles.terminal_velocity(**GRAIN, fluid_density=998.2, dynamic_viscosity=1.0016e-3)
    assert gr.particles.terminal_velocity(**GRAIN, fluid="water at 20 °C") == pytest.approx(plain, rel=3e-3)


def test_what_is_given_wins():
    result = gr.particles.terminal_velocity.evaluate(**GRAIN, fluid="water at 20 degC", fluid_density=1200.0)
    assert result.inputs["fluid_density"] == 1200.0
    assert "from" not in result.as_json()["inputs"]["fluid_density"]


@pytest.mark.parametrize(
    ("words", "liquid", "density"),
    [
        ("air at 20 degC", False, 1.204),
        ("water at 120 °C", False, 0.559),
        ("water at 120 °C, 5 bar", True, 943.1),
        ("eau à 20 °C", True, 998.2),
    ],
)
def test_phase_and_density(words, liquid, density):
    """Air and water of tables (steam at 120 °C and 1 atm as an ideal gas)."""
    state = StatedFluid.read(words)
    assert state.is_liquid is liquid
    assert float(state.density()) == pytest.approx(density, rel=3e-3)


@pytest.mark.parametrize("given", ["water", "water at", 20.0, "watr at 20 °C", ("water",), "water at 20 kg"])
def test_what_is_no_fluid_is_told(given):
    with pytest.raises(InputError):
        gr.particles.terminal_velocity(**GRAIN, fluid=given)


def test_a_card_without_a_fluid_refuses_one():
    with pytest.raises(InputError, match="asks for no property"):
        gr.drying.mass_efficiency(fluid="water at 20 °C")


def test_on_the_command_line():
    words = ["particle_diameter=85um", "particle_density=2630", "fluid=water at 20 degC"]
    done = subprocess.run(
        [sys.executable, "-m", "granum", "calc", "particles.terminal_velocity", *words, "--json"],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["inputs"]["fluid_density"]["from"].startswith("water at 20")


def test_a_lab_test_takes_a_fluid_and_says_so():
    """Water of 25 °C has 0.890 mPa s (IAPWS)."""
    leaf = {"time": [100.0, 250.0, 450.0, 700.0], "filtrate_volume": [1e-3, 2e-3, 3e-3, 4e-3]}
    conditions = {"area": "0.0439 m2", "pressure_drop": "338 kPa", "dry_cake_per_filtrate": 23.47}
    found = gr.filtration.LeafTest(**leaf, **conditions, fluid="water at 25 °C").fit()
    told = found.as_json()["from"]["dynamic_viscosity"]
    assert told["value"] == pytest.approx(0.890e-3, rel=2e-3)
    assert told["origin"].startswith("water at 25")
    alone = gr.filtration.LeafTest(**leaf, **conditions, dynamic_viscosity=told["value"]).fit()
    assert alone.values == found.values
    assert alone.as_json()["from"] == {}


def test_a_study_of_a_card_takes_a_fluid():
    words = {"particle_density": "2630", "fluid": "water at 20 degC"}
    (study,) = studies_of_text(
        study_text("particles.terminal_velocity", {**words, "particle_diameter": "50..200um"}, steps=2)
    ).values()
    outcome = study.run()
    whole = gr.particles.terminal_velocity("50 um", 2630.0, fluid="water at 20 °C")
    assert float(outcome.column("terminal_velocity")[0]) == pytest.approx(float(whole), rel=1e-12)


@pytest.mark.parametrize(
    ("words", "density", "viscosity"),
    [  # Melinder's secondary working fluids as CoolProp 8 has them (opened); viscosity in mPa s
        ("10 % sodium chloride at 20 °C", 1070.6, 1.193),
        ("brine 20 % at 0 °C", 1156.7, 2.696),
        ("chlorure de sodium à 20 % à 30 °C", 1142.9, 1.237),
        ("10 % CaCl2 brine at 20 °C", 1085.9, 1.298),
        ("calcium chloride 25 % at 20 °C", 1229.1, 2.502),
        ("200 g/kg calcium chloride in water at 30 °C", 1176.5, 1.550),
    ],
)
def test_brines_by_their_share(words, density, viscosity):
    state = StatedFluid.read(words)
    assert state.is_liquid
    assert float(state.density()) == pytest.approx(density, rel=5e-3)
    assert 1e3 * float(state.viscosity()) == pytest.approx(viscosity, rel=0.055)


def test_a_brine_boils_hotter_than_water_and_an_oil_does_not_boil():
    # 25 % of calcium chloride boils at some 109 °C (recalled)
    assert StatedFluid.read("25 % calcium chloride at 105 °C").is_liquid
    assert not StatedFluid.read("25 % calcium chloride at 115 °C").is_liquid
    assert StatedFluid.read("olive oil at 150 °C").is_liquid
    assert not StatedFluid.read("argon at 20 °C").is_liquid


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("brine at 20 °C", "share of the solution"),
        ("100 % sucrose at 20 °C", "below 100 %"),
        ("-5 % sucrose at 20 °C", "not possible of the 'fluid'"),
        ("10 % quartzy at 20 °C", "not known"),
    ],
)
def test_what_is_no_solution_is_told(words, message):
    with pytest.raises(InputError, match=message):
        StatedFluid.read(words)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("10 % sodium chloride at 20 °C", ""),
        ("water at 20 °C", ""),
        ("air at 20 °C", ""),
        ("30 % sodium chloride at 20 °C", "crystals would form"),
        ("20 % calcium chloride at -60 °C", "temperature"),
        ("olive oil at 500 °C", "temperature"),
    ],
)
def test_a_fluid_outside_its_data_is_told(words, told):
    found = gr.particles.terminal_velocity.evaluate("50 um", 2630.0, fluid=words)
    assert bool(found.flags.any()) == bool(told)
    assert any(told in notice["message"] for notice in found.notices) == bool(told)


@pytest.mark.parametrize(("words", "beyond"), [("water at 20 °C", False), ("olive oil at 500 °C", True)])
def test_a_fluid_outside_its_data_is_told_by_tests_and_studies_too(words, beyond):
    time, volume = np.arange(1.0, 7.0) * 60.0, np.sqrt(np.arange(1.0, 7.0)) * 2e-4
    found = gr.filtration.LeafTest(
        time, volume, area=5e-3, pressure_drop=8e4, fluid=words, dry_cake_per_filtrate=15.0
    ).fit()
    assert any("liquid viscosity" in row["message"] for row in found.flags) == beyond
    subject = FormulaSubject.of("particles.terminal_velocity", {"particle_density": 2630.0, "fluid": words})
    run = subject.traced(("particle_diameter",), ("terminal_velocity",))
    assert int(run(subject.numbers(), jnp.asarray([5e-5]))[1]) == (EXTRAPOLATED if beyond else FINE)


@pytest.mark.parametrize(
    ("short", "whole"),
    [
        ("water 60 °C", "water at 60 °C"),
        ("eau, 60 degC", "water at 60 °C"),
        ("air 100 °C, 2 bar", "air at 100 °C, 2 bar"),
        ("sodium chloride 10 % 20 °C", "10 % sodium chloride at 20 °C"),
        ("water 300 K", "water at 300 K"),
    ],
)
def test_a_temperature_needs_no_word_before_it(short, whole):
    found, meant = StatedFluid.read(short), StatedFluid.read(whole)
    assert found.label == meant.label
    assert found.density() == meant.density()


@pytest.mark.parametrize("words", ["water", "water 60", "water 1 kg/K", "60 °C"])
def test_what_has_no_temperature_is_refused(words):
    with pytest.raises(InputError, match=f"'fluid' = '{words}' is not understood"):
        StatedFluid.read(words)
