"""Optimization against published optima and closed forms."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.formulas import own_formula

from granum import studies
from granum.core.errors import GranumError
from granum.core.kinds import Number
from granum.studies.engine import Progress


def hs71(x1: Number, x2: Number, x3: Number, x4: Number) -> Number:
    """Hock and Schittkowski's problem 71."""
    return x1 * x4 * (x1 + x2 + x3) + x3


def himmelblau(x1: Number, x2: Number) -> Number:
    """Himmelblau's function, with four minima of zero."""
    return (x1**2 + x2 - 11.0) ** 2 + (x1 + x2**2 - 7.0) ** 2


def broken(x1: Number) -> Number:
    """A parabola with its minimum at 1 that has no value below 0.5."""
    return (x1 - 1.0) ** 2 + 0.0 * jnp.sqrt(x1 - 0.5)


HS71, HIMMELBLAU, BROKEN = own_formula(hs71), own_formula(himmelblau), own_formula(broken)


@pytest.mark.parametrize("method", ["slsqp", "trust_constr"])
def test_problem_71_of_hock_and_schittkowski(method: str) -> None:
    """Printed: f = 17.0140173 at (1, 4.743, 3.8211, 1.3794)."""
    over = {
        name: {"lower": 1.0, "upper": 5.0, "start": s}
        for name, s in zip(("x1", "x2", "x3", "x4"), (1.0, 5.0, 5.0, 1.0), strict=True)
    }
    limits = {
        "x1 * x2 * x3 * x4": {"lower": 25.0},
        "x1**2 + x2**2 + x3**2 + x4**2": {"lower": 40.0, "upper": 40.0},
    }
    found = studies.optimize(HS71, over, minimize="ratio", limits=limits, starts=1, method=method)
    assert found.feasible
    assert found.figures["ratio"] == pytest.approx(17.0140173, rel=1e-5)
    assert list(found.values.values()) == pytest.approx([1.0, 4.743, 3.8211, 1.3794], abs=2e-3)
    active = {(row["name"], row["side"]) for row in found.active()}
    assert {("x1", "lower"), ("x1 * x2 * x3 * x4", "lower")} <= active
    # printed multiplier of the product, 0.5523: one more of it costs so much
    assert found.prices["x1 * x2 * x3 * x4 lower"] == pytest.approx(0.5523, abs=2e-3)
    assert found.stationarity < 1e-3


def test_several_starts_find_the_minima_of_himmelblau() -> None:
    found = studies.optimize(
        HIMMELBLAU, {"x1": (-6.0, 6.0), "x2": (-6.0, 6.0)}, minimize="ratio", starts=12, seed=2
    )
    assert found.figures["ratio"] == pytest.approx(0.0, abs=1e-6)
    ends = {
        (round(e["inputs"]["x1"], 2), round(e["inputs"]["x2"], 2))
        for e in found.ends
        if e["objective"] < 1e-5
    }
    assert len(ends) >= 3
    assert ends <= {(3.0, 2.0), (-2.81, 3.13), (-3.78, -3.28), (3.58, -1.85)}


def test_maximum_of_a_real_formula_by_hand() -> None:
    """Twice the diameter settles four times as fast: the upper limit of the speed gives the diameter."""
    slurry = {"particle_density": 2650.0, "fluid_density": 1000.0, "dynamic_viscosity": 1e-3}
    found = studies.optimize(
        "particles.terminal_velocity_stokes",
        {"particle_diameter": ("1 um", "200 um")},
        maximize="particle_diameter",
        limits={"terminal_velocity": {"upper": "1 mm/s"}},
        fixed=slurry,
        starts=2,
    )
    by_hand = np.sqrt(18 * 1e-3 * 1e-3 / (9.80665 * 1650.0))
    assert found.values["particle_diameter"] == pytest.approx(by_hand, rel=1e-6)
    # d is the root of the speed
    assert found.prices["terminal_velocity upper"] == pytest.approx(by_hand / 2e-3, rel=1e-4)
    assert found.base["terminal_velocity"] != found.figures["terminal_velocity"]


def test_places_without_a_value_do_not_stop_the_search() -> None:
    found = studies.optimize(
        BROKEN, {"x1": {"lower": 0.0, "upper": 10.0, "start": 9.0}}, minimize="ratio", starts=1
    )
    assert found.values["x1"] == pytest.approx(1.0, abs=1e-4)
    with pytest.raises(GranumError, match="No start gave a result"):
        studies.optimize(BROKEN, {"x1": {"lower": 0.0, "upper": 0.4}}, minimize="ratio", starts=2)


def test_infeasible_is_said() -> None:
    found = studies.optimize(
        HIMMELBLAU,
        {"x1": (0.0, 1.0), "x2": (0.0, 1.0)},
        minimize="ratio",
        limits={"x1 + x2": {"lower": 3.0}},
        starts=2,
    )
    assert not found.feasible
    assert found.ends[0]["violation"] > 0.1
    from granum.studies.report import warnings_of

    assert any("not a solution" in line for line in warnings_of(found))


def test_robust_design_keeps_the_probability() -> None:
    """The largest x with P(x + N(0, 1) ≤ 5) ≥ 95 % is 5 − 1.6449; checked on fresh samples."""
    found = studies.optimize(
        HIMMELBLAU,
        {"x1": (0.0, 6.0)},
        maximize="x1",
        limits={"x1 + x2": {"upper": 5.0}},
        starts=1,
        uncertain={"x2": {"distribution": "normal", "mean": 0.0, "standard_deviation": 1.0}},
        samples=1000,
    )
    assert found.values["x1"] == pytest.approx(5.0 - 1.6449, abs=0.02)
    assert found.chance is not None
    assert found.chance["limits"]["x1 + x2"]["probability"] == pytest.approx(0.95, abs=0.01)
    assert found.chance["samples"] == 4000


def test_front_of_schaffer() -> None:
    """x² and (x − 2)²: the front is f2 = (√f1 − 2)², x from 0 to 2."""
    found = studies.pareto(
        HIMMELBLAU,
        {"x1": (-5.0, 5.0)},
        [{"minimize": "x1**2"}, {"minimize": "(x1 - 2)**2"}],
        points=7,
        fixed={"x2": 0.0},
    )
    one, two = found.column("x1**2"), found.column("(x1 - 2)**2")
    assert len(one) == 7
    assert two == pytest.approx((np.sqrt(one) - 2.0) ** 2, abs=1e-5)
    assert np.all(np.diff(one) > 0)
    assert np.all(np.diff(two) < 0)
    assert [one[0], two[-1]] == pytest.approx([0.0, 0.0], abs=1e-6)


def test_cancel_returns_the_best_so_far() -> None:
    seen: list[Progress] = []
    found = studies.optimize(
        HIMMELBLAU,
        {"x1": (-6.0, 6.0), "x2": (-6.0, 6.0)},
        minimize="ratio",
        starts=50,
        progress=seen.append,
        cancel=lambda: seen[-1].done >= 2,
    )
    assert not found.complete
    assert len(found.ends) == 2


@pytest.mark.parametrize(
    ("run", "message"),
    [
        (lambda: studies.optimize(HIMMELBLAU, {}, minimize="ratio"), "nothing to vary"),
        (
            lambda: studies.optimize(HIMMELBLAU, {"x1": (0.0, 1.0), "x2": (0.0, 1.0)}),
            "either 'minimize' or 'maximize'",
        ),
        (lambda: studies.optimize(HIMMELBLAU, {"x1": (1.0, 0.0)}, minimize="ratio"), "'lower' must be below"),
        (lambda: studies.optimize(HIMMELBLAU, {"x1": {"lower": 0.0}}, minimize="ratio"), "give its limits"),
        (lambda: studies.optimize(HIMMELBLAU, {"x1": (0.0, 1.0)}, minimize="ratio"), "needs 'x2'"),
        (
            lambda: studies.optimize(HIMMELBLAU, {"x1": (0.0, 1.0), "x2": (0.0, 1.0)}, minimize="ration"),
            "Did you mean 'ratio'",
        ),
        (
            lambda: studies.optimize(HIMMELBLAU, {"x1": (0.0, 1.0)}, minimize="ratio", method="newton"),
            "Method 'newton'",
        ),
        (
            lambda: studies.optimize(
                HIMMELBLAU, {"x1": (0.0, 1.0)}, minimize="ratio", fixed={"x2": 0.0}, samples=100
            ),
            "No input is uncertain",
        ),
        (
            lambda: studies.pareto(
                HIMMELBLAU, {"x1": (0.0, 1.0)}, [{"minimize": "ratio"}], fixed={"x2": 0.0}
            ),
            "two objectives",
        ),
        (
            lambda: studies.pareto(
                HIMMELBLAU, {"x1": (0.0, 1.0)}, [{"minimize": "x1"}, {"maximize": "x1"}], fixed={"x2": 0.0}
            ),
            "different figures",
        ),
    ],
)
def test_bad_input_gets_one_clear_message(run, message: str) -> None:
    with pytest.raises(GranumError) as caught:
        run()
    assert message in caught.value.message
