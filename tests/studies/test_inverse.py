"""An input found for a wanted result."""

from __future__ import annotations

import json

import numpy as np
import pytest
from typer.testing import CliRunner

from granum.cli import app
from granum.core.errors import ApplicabilityError, ConvergenceError, InputError
from granum.core.i18n import language
from granum.porous import pressure_gradient_ergun
from granum.studies.inverse import find_input

SPHERE = {"particle_density": 2650.0, "fluid_density": 1000.0, "dynamic_viscosity": 1e-3}


def test_the_diameter_for_a_velocity_is_that_of_stokes() -> None:
    """d = √(18 η v / (g Δρ)), by hand."""
    found = find_input(
        "particles.terminal_velocity_stokes", "particle_diameter", terminal_velocity="0.5 mm/s", **SPHERE
    )
    assert found.value == pytest.approx(np.sqrt(18e-3 * 5e-4 / (9.80665 * 1650.0)), rel=1e-10)
    assert found.result.value == pytest.approx(5e-4, rel=1e-10)


def test_iterated_laws_are_solved_too_and_a_fluid_gives_the_rest() -> None:
    found = find_input(
        "particles.terminal_velocity",
        "particle_diameter",
        terminal_velocity="5 cm/s",
        particle_density=2650.0,
        fluid="water at 20 degC",
    )
    assert found.result.value == pytest.approx(0.05, rel=1e-9)


def test_random_settings_come_back() -> None:
    rng = np.random.default_rng(7)
    for _case in range(40):
        given = {
            "superficial_velocity": 10.0 ** rng.uniform(-4, -1),
            "particle_diameter": 10.0 ** rng.uniform(-4, -2),
            "void_fraction": rng.uniform(0.3, 0.7),
            "fluid_density": 1000.0,
            "dynamic_viscosity": 1e-3,
        }
        wanted = pressure_gradient_ergun(**given)
        name = str(rng.choice(["superficial_velocity", "particle_diameter", "void_fraction"]))
        others = {n: v for n, v in given.items() if n != name}
        found = find_input("porous.pressure_gradient_ergun", name, pressure_gradient=wanted, **others)
        assert found.value == pytest.approx(given[name], rel=1e-8)


def test_what_is_not_reached_is_refused_with_what_is() -> None:
    with pytest.raises(
        ConvergenceError, match=r"not reached at any value of particle diameter from 0 .* between 0"
    ):
        find_input("particles.terminal_velocity", "particle_diameter", terminal_velocity=-1e-3, **SPHERE)


def test_the_greatest_value_is_reached_without_being_passed() -> None:
    """Vesilind's flux v₀ C exp(−k C) is greatest at C = 1/k: v₀/(e k)."""
    law = {"law": "vesilind", "vesilind_velocity": "5 m/hour", "vesilind_coefficient": 0.5}
    found = find_input(
        "settling.solids_flux_settling",
        "solids_concentration",
        settling=law,
        solids_flux=5.0 / 3600.0 / (0.5 * np.e),
    )
    assert found.value == pytest.approx(2.0, rel=1e-2)


def test_several_solutions_are_named() -> None:
    """Water is densest at 4 °C (999.975 kg/m³, Kell): 999.9 kg/m³ stands on both sides."""
    with pytest.raises(
        ApplicabilityError, match=r"several values of temperature: [01]\.\d+ °C, [78]\.\d+ °C"
    ):
        find_input("materials.water_density", "temperature", liquid_density=999.9)


def test_what_cannot_be_meant_is_said() -> None:
    with pytest.raises(InputError, match=r"give one result of particles.terminal_velocity"):
        find_input("particles.terminal_velocity", "particle_diameter", **SPHERE)
    with pytest.raises(InputError, match="no single quantity"):
        find_input("particles.terminal_velocity", "drag", terminal_velocity=1e-3, **SPHERE)
    with pytest.raises(ApplicabilityError, match="does not depend on"):
        find_input(
            "porous.pressure_gradient_kozeny_carman",
            "fluid_density",
            pressure_gradient=1e5,
            superficial_velocity=1e-3,
            particle_diameter=1e-4,
            void_fraction=0.4,
            dynamic_viscosity=1e-3,
        )


def test_the_command_finds_an_input() -> None:
    words = [
        "particle_density=2650",
        "fluid_density=1000",
        "dynamic_viscosity=1cP",
        "terminal_velocity=0.5mm/s",
    ]
    key = "particles.terminal_velocity_stokes"
    told = CliRunner().invoke(app, ["calc", key, *words, "--solve", "particle_diameter", "--json"])
    assert told.exit_code == 0, told.output
    assert json.loads(told.output)["inputs"]["particle_diameter"]["value"] == pytest.approx(
        2.3585e-5, rel=1e-4
    )
    with language("fr"):
        words[-1] = "terminal_velocity=-1mm/s"
        told = CliRunner().invoke(app, ["calc", key, *words, "--solve", "particle_diameter", "--lang", "fr"])
    assert told.exit_code == 3
    assert "n’est atteint pour aucune valeur" in told.output
