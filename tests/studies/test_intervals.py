"""Results as intervals from inputs as intervals."""

from __future__ import annotations

import json
import math

import pytest
from typer.testing import CliRunner

from granum.cli import app
from granum.core.errors import InputError
from granum.core.written import interval
from granum.studies.intervals import with_intervals

STOKES = "particles.terminal_velocity_stokes"
SPHERE = {"particle_density": "2650 kg/m^3", "fluid_density": "1000 kg/m^3", "dynamic_viscosity": "1 cP"}


@pytest.mark.parametrize("text", ["85 ± 5 um", "85um±5um", "85+-5um", "85 +/- 5 um", "85 um ± 5.88235294 %"])
def test_a_spread_enters_by_its_derivative(text: str) -> None:
    """v ~ d²: δv/v = 2 δd/d."""
    result, within = with_intervals(STOKES, particle_diameter=text, **SPHERE)
    half = 0.5 * (within["terminal_velocity"].high - within["terminal_velocity"].low)
    assert half / result.value == pytest.approx(2 * 5 / 85, rel=1e-6)


def test_independent_spreads_are_added_as_squares() -> None:
    """v ~ d² Δρ/η: relative shares 2 %·2, 50/1650 and 3 %."""
    spread = {**SPHERE, "particle_density": "2650 ± 50 kg/m^3", "dynamic_viscosity": "1 cP ± 3 %"}
    result, within = with_intervals(STOKES, particle_diameter="85 um ± 2 %", **spread)
    half = 0.5 * (within["terminal_velocity"].high - within["terminal_velocity"].low)
    assert half / result.value == pytest.approx(math.hypot(0.04, 50 / 1650, 0.03), rel=1e-9)
    assert "±" in within["terminal_velocity"].text
    assert "linear" in within["terminal_velocity"].how


def test_a_range_gives_the_least_and_the_greatest_also_between_its_ends() -> None:
    low, high = (9.80665 * 1650 * (d * 1e-6) ** 2 / 18e-3 for d in (80, 90))
    for text in ("80..90 um", "80–90 um", "80 – 90 um", "80 to 90 um"):
        _result, within = with_intervals(STOKES, particle_diameter=text, **SPHERE)
        assert within["terminal_velocity"][:2] == pytest.approx((low, high), rel=1e-9), text
    _result, within = with_intervals("materials.water_density", temperature="1..8 degC")
    assert within["liquid_density"].high == pytest.approx(999.975, abs=2e-3)  # at 4 °C (Kell)


def test_a_spread_of_a_temperature_is_a_difference() -> None:
    _result, within = with_intervals("materials.water_density", temperature="20 ± 2 degC")
    assert within["liquid_density"].high - within["liquid_density"].low == pytest.approx(4 * 0.207, rel=0.02)


@pytest.mark.parametrize("text", ["90..80 um", "85 ± 5 kg", "-1..2 um"])
def test_what_is_no_interval_is_refused(text: str) -> None:
    with pytest.raises(InputError):
        with_intervals(STOKES, particle_diameter=text, **SPHERE)


def test_plain_numbers_are_no_intervals() -> None:
    assert [interval(text) for text in ("85 um", "-5", "1e-3", "3-7", "0..", "..5", "± 5")] == [None] * 7
    assert with_intervals(STOKES, particle_diameter="85 um", **SPHERE)[1] == {}


def test_the_command_tells_the_interval() -> None:
    words = ["particle_diameter=85+-5um", *(f"{n}={v}" for n, v in SPHERE.items())]
    told = CliRunner().invoke(app, ["calc", STOKES, *words])
    assert "6.49 ± 0.76 mm/s" in " ".join(told.output.split()), told.output
    found = json.loads(CliRunner().invoke(app, ["calc", STOKES, *words, "--json"]).output)
    assert found["intervals"]["terminal_velocity"]["low"] < found["outputs"]["terminal_velocity"]["value"]
