"""Leverage, influence and stray points of a fit against their definitions, and in words in every lab test."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats
from tests.sharing.lab_data import data, keys

from granum.core import registry
from granum.core.errors import ConvergenceError, InputError
from granum.core.i18n import language
from granum.estimation import fit
from granum.estimation.diagnostics import diagnose
from granum.filtration.lab_tests.leaf_test import LeafTest

X = np.array([1.0, 2.0, 3.0, 4.0, 6.0, 7.0, 9.0, 10.0, 12.0, 15.0])
NOISE = np.array([0.3, -0.5, 0.4, 0.1, -0.6, 0.2, 0.5, -0.3, -0.2, 0.1])
DEAR = {
    "crystallization.batch_kinetics",
    "settling.compression_test",
    "comminution.grinding_kinetics",
    "drying.thin_layer_test",
}
"""Lab tests that simulate a whole process at every trial, or fit 22 models."""
CAUTIONS = {"no relation", "not significant", "at bound", "poorly identified"}


def line(p, x):
    return p["slope"] * x + p["start"]


def fitted(y, **options):
    return fit(line, {"slope": 1.0, "start": 1.0}, X, y, **options)


def test_influence_is_what_leaving_out_each_point_does():
    y = 2.0 * X + 1.0 + NOISE
    y[4] += 2.0
    found = fitted(y).diagnostics.influence
    design = np.stack([X, np.ones_like(X)], axis=1)
    whole, squares, *_ = np.linalg.lstsq(design, y, rcond=None)
    variance = squares[0] / 8
    for k in range(X.size):
        rest = np.arange(X.size) != k
        without, left, *_ = np.linalg.lstsq(design[rest], y[rest], rcond=None)
        inverse = np.linalg.inv(design[rest].T @ design[rest])
        spread = np.sqrt(left[0] / 7 * (1.0 + design[k] @ inverse @ design[k]))
        assert found.studentized[k] == pytest.approx((y[k] - design[k] @ without) / spread, rel=1e-8)
        assert found.leverage[k] == pytest.approx(
            design[k] @ np.linalg.inv(design.T @ design) @ design[k], rel=1e-10
        )
        moved = design @ (whole - without)
        assert found.cook[k] == pytest.approx(moved @ moved / (2 * variance), rel=1e-8)
        own = np.sqrt(left[0] / 7 * found.leverage[k])
        assert found.dffits[k] == pytest.approx(moved[k] / own, rel=1e-8)


def test_two_stray_points_do_not_hide_each_other():
    y = 2.0 * X + 1.0 + NOISE
    y[8], y[9] = y[8] * 3.0, y[9] * 3.0
    found = fitted(y)
    assert sorted(found.diagnostics.stray) == [8, 9]
    clean = np.polyfit(X[:8], y[:8], 1)
    assert found.diagnostics.without["slope"] == pytest.approx(clean[0], rel=1e-6)
    assert abs(found.diagnostics.robust["slope"] - 2.0) < abs(found["slope"].value - 2.0)
    assert [f["flag"] for f in found.flags].count("stray point") == 1


def test_false_alarms_on_clean_data_are_rare():
    problem, rng = fitted(2.0 * X + NOISE).problem, np.random.default_rng(1)
    alarms = 0
    for _trial in range(400):
        made = problem.variant(y=2.0 * X + 1.0 + rng.standard_normal(X.size))
        alarms += bool(diagnose(made, made.solve(np.ones(2))[0], ()).stray)
    assert alarms <= 8  # 2 %


def test_the_chance_of_no_relation_is_the_f_test_of_regression():
    y = np.array([3.0, 1.0, 4.0, 1.0, 5.0, 9.0, 2.0, 6.0, 5.0, 3.0])
    found = fitted(y)
    assert found.diagnostics.probability == pytest.approx(stats.linregress(X, y).pvalue, rel=1e-6)
    assert "no relation" in [f["flag"] for f in found.flags]
    assert "no relation" not in [f["flag"] for f in fitted(2.0 * X + NOISE).flags]


def leaf(volume_factor: float = 1.0) -> LeafTest:
    made = data("filtration.leaf_test")
    V = made.columns["filtrate_volume"] * (1 + 2e-3 * np.resize(NOISE, 12))
    V[6] *= volume_factor
    return LeafTest(
        time=np.append(0.0, made.columns["time"]), filtrate_volume=np.append(0.0, V), **made.conditions
    )


def test_a_stray_point_is_named_with_what_it_does():
    found = leaf(0.93).fit()
    (flag,) = [f for f in found.flags if f["flag"] == "stray point"]
    volume = leaf(0.93).filtrate_volume[7] * 1e3
    # the first row, at time zero, is no point
    assert flag["message"].startswith("Row 8 (time 35 min; filtrate volume ")
    assert f"{volume:.4g}"[:4] in flag["message"] or f"{volume:.3g}" in flag["message"]
    without = found.diagnostics.without["cake_resistance"]
    assert without == pytest.approx(leaf().fit()["cake_resistance"].value, rel=0.01)
    assert found.as_json()["diagnostics"]["stray"][0]["point"] == 7
    assert not [f for f in leaf().fit().flags if f["flag"] == "stray point"]
    with language("fr"):
        (french,) = [f for f in leaf(0.93).fit().flags if f["flag"] == "stray point"]
    assert french["message"].startswith("Ligne 8 (")
    assert "ne s’accorde pas" in french["message"]


def test_a_bound_is_named_with_its_value():
    found = fitted(2.0 * X - 5.0 + NOISE, bounds={"start": (0.0, np.inf)})
    assert [f["message"] for f in found.flags if f["flag"] == "at bound"] == [
        "'start' ended on its lower bound, 0: the data do not determine it."
    ]


def flags_of(key: str, values: np.ndarray) -> set[str]:
    """Words of the flags of a lab test with other values in its measured column; one word where it is
    refused.
    """
    made = data(key)
    try:
        test = registry.find(key)(**{**made.columns, made.measured: values}, **made.conditions)
        found = test.fit()
    except (InputError, ConvergenceError):
        return {"refused"}
    # whatever the test does to its fit
    assert (found.defaults, found.ranges) == (test.defaults(), test.ranges())
    return {f["flag"] for f in found.flags}


@pytest.mark.parametrize("key", [k for k in keys() if k not in DEAR])
def test_a_wild_point_never_passes_without_a_word(key):
    made, rng = data(key), np.random.default_rng(3)
    values = made.columns[made.measured] * (
        1.0 + made.scatter * rng.standard_normal(made.columns[made.measured].size)
    )
    values = np.clip(values, 0.0, 1.0) if made.columns[made.measured].max() <= 1.0 else values
    values[values.size // 2] *= 0.1
    assert flags_of(key, values) & (
        {"refused", "stray point", "made falling", "overshoot", "points excluded"} | CAUTIONS
    )


@pytest.mark.parametrize("key", [k for k in keys() if k not in DEAR | {"particles.image_analysis"}])
def test_pure_noise_is_told(key):
    """Any sample of particles is a size distribution; everything else must show its relation."""
    made, rng = data(key), np.random.default_rng(11)
    values = made.columns[made.measured]
    noise = rng.uniform(0.02 * values.max(), values.max(), values.size)
    noise = (
        np.append(0.0, np.append(np.sort(noise)[1:-1], 1.0))
        if made.measured == "cumulative_fraction"
        else noise
    )
    assert flags_of(key, noise) & (CAUTIONS | {"refused"})
