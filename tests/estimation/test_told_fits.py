"""What a fit took without being told, how far it holds, and that all of it reaches whoever uses the
numbers.
"""

from __future__ import annotations

import io
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from tests.sharing.lab_data import data
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.estimation import CardData, fit
from granum.estimation.diagnostics import diagnose
from granum.estimation.verdicts import parameter_notes
from granum.filtration.lab_tests.rate_tests import VariablePressureTest
from granum.flowsheet.fitted import fit_notices
from granum.settling import kynch
from granum.settling.lab_tests import batch_test


def test_false_alarms_are_rare_where_scatter_is_in_proportion() -> None:
    """A decay to a tenth, read to a percent: the first readings scatter ten times more than the last."""
    x, rng = np.linspace(0.0, 1.0, 13), np.random.default_rng(2)
    clean = np.exp(-2.4 * x)
    problem = fit(
        lambda p, x: p["start"] * np.e ** (-p["rate"] * x), {"start": 1.0, "rate": 2.0}, x, clean
    ).problem
    alarms, named = 0, 0
    for trial in range(80):
        y = clean * (1.0 + 0.01 * rng.standard_normal(x.size))
        made = problem.variant(y=y)
        alarms += bool(diagnose(made, made.solve(np.ones(2))[0], ()).stray)
        if trial >= 20:
            continue
        wild = y.copy()
        wild[4] *= 3.0
        made = problem.variant(y=wild)
        named += diagnose(made, made.solve(np.ones(2))[0], ()).stray == (4,)
    assert alarms <= 4
    assert named == 20


def test_a_second_settling_curve_of_the_same_length_is_not_compiled_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    made = data("settling.batch_test")
    first = batch_test.BatchTest(**made.columns, **made.conditions).fit()
    calls = []
    monkeypatch.setattr(
        batch_test, "kynch_height", lambda *args: calls.append(1) or kynch.kynch_height(*args)
    )
    higher = {**made.columns, "interface_height": 1.01 * made.columns["interface_height"]}
    second = batch_test.BatchTest(**higher, **{**made.conditions, "initial_concentration": 3.05}).fit()
    assert not calls
    # all heights and velocities are scaled alike, concentrations by 3.05/3
    assert second["vesilind_velocity"].value == pytest.approx(
        1.01 * first["vesilind_velocity"].value, rel=1e-3
    )
    assert second["vesilind_coefficient"].value == pytest.approx(
        first["vesilind_coefficient"].value * 3.0 / 3.05, rel=1e-3
    )


def filtered(pressures: np.ndarray, volumes: np.ndarray) -> VariablePressureTest:
    """Readings of a rigid cake (1e11 m/kg, medium 5e10 1/m) at 0.01 m², exact between many small intervals;
    only every 40th is read.
    """
    per_volume = 1e-3 / 0.01 * (1e11 * 20.0 * volumes / 0.01 + 5e10) / pressures
    time = np.concatenate([[0.0], np.cumsum(0.5 * (per_volume[1:] + per_volume[:-1]) * np.diff(volumes))])
    return VariablePressureTest(
        time=time[::40],
        filtrate_volume=volumes[::40],
        pressure_drop=pressures[::40],
        area=0.01,
        dynamic_viscosity=1e-3,
        dry_cake_per_filtrate=20.0,
    )


def test_jumps_of_pressure_that_the_readings_do_not_show_are_told() -> None:
    volumes = np.linspace(0.0, 1e-3, 401)
    ramp = filtered(1e5 * (1.0 + volumes / 1e-3), volumes).fit()
    assert not ramp.flags
    assert ramp["cake_resistance"].value == pytest.approx(1e11, rel=0.01)
    jump = filtered(np.where(volumes < 0.31e-3, 5e4, 3e5), volumes).fit()
    told = [f["message"] for f in jump.flags if f["flag"] == "coarse pressure"]
    assert told
    assert "just before and just after" in told[0]


def test_a_line_says_what_its_fit_says_and_where_it_extrapolates() -> None:
    line = gr.read(EXAMPLES / "lab-to-plant" / "line.toml")
    own = fit_notices(line.fits, line.sheet)
    assert {(f["unit"], f["flag"]) for f in own} == {("press", "points excluded")}
    pressed = line.with_values(**{"press.pressure_drop": 6e5})
    (told,) = [f for f in fit_notices(pressed.fits, pressed.sheet) if f["flag"] == "extrapolated"]
    assert told["unit"] == "press"
    assert "6 bar" in told["message"]
    assert "3.38 bar" in told["message"]


def test_a_fitted_formula_says_its_defaults_and_its_range() -> None:
    rows = "\n".join(f"{p},{1e10 * p**0.4:.9g}" for p in (1e4, 3e4, 1e5, 3e5, 1e6))
    file = io.StringIO(f"pressure_drop [Pa],cake_resistance [m/kg]\n{rows}\n")
    found = CardData.read(
        "filtration.cake_resistance_power_law",
        file,
        estimate=["cake_resistance_reference", "compressibility"],
    ).fit()
    assert found.ranges == {"pressure_drop": (1e4, 1e6)}
    assert found.defaults == {"reference_pressure": 1.0}


@pytest.mark.parametrize("known", [0.0, 1.0])
def test_a_covariance_that_is_no_number_does_not_name_a_parameter_twice(known: float) -> None:
    """With nothing known all parameters are named once; two of three that are known are the pair."""
    covariance = np.full((3, 3), np.nan)
    if known:
        covariance[1:, 1:] = [[1.0, 0.99], [0.99, 1.0]]
    unknown = SimpleNamespace(interval_95=(np.nan, np.nan))
    estimates: Any = dict.fromkeys(("share", "rate_1", "rate_2"), unknown)
    problem: Any = SimpleNamespace(kinds={})
    (told,) = parameter_notes(estimates, covariance, {}, np.inf, problem, "card")
    counts = [told["message"].count(n.replace("_", " ")) for n in estimates]
    assert counts == ([0, 1, 1] if known else [1, 1, 1])
