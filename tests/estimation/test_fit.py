"""``fit`` against the certified results of NIST's Statistical Reference Datasets and closed forms of linear
regression.
"""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest
from scipy import stats

from granum.core.errors import InputError
from granum.estimation import Huber, SoftL1, fit

# NIST StRD, https://www.itl.nist.gov/div898/strd/nls: data, certified values and standard deviations
MISRA = np.array(
    [
        [77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0],
        [10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78],
    ]
)
BOXBOD = np.array([[1.0, 2.0, 3.0, 5.0, 7.0, 10.0], [109.0, 149.0, 149.0, 191.0, 213.0, 224.0]])


def saturating(p, x):
    return p["b1"] * (1.0 - jnp.exp(-p["b2"] * x))


@pytest.mark.parametrize(
    ("data", "start", "values", "errors", "deviation"),
    [
        (
            MISRA,
            (500.0, 1e-4),
            (2.3894212918e02, 5.5015643181e-04),
            (2.7070075241, 7.2668688436e-06),
            1.0187876330e-01,
        ),
        (
            MISRA,
            (250.0, 5e-4),
            (2.3894212918e02, 5.5015643181e-04),
            (2.7070075241, 7.2668688436e-06),
            1.0187876330e-01,
        ),
        (
            BOXBOD,
            (100.0, 0.75),
            (2.1380940889e02, 5.4723748542e-01),
            (1.2354515176e01, 1.0455993237e-01),
            1.7088072423e01,
        ),
    ],
)
def test_nist_certified_values(data, start, values, errors, deviation):
    found = fit(saturating, {"b1": start[0], "b2": start[1]}, *data)
    np.testing.assert_allclose(list(found.values.values()), values, rtol=1e-8)
    np.testing.assert_allclose([e.standard_error for e in found.parameters.values()], errors, rtol=1e-7)
    assert found.statistics["residual_standard_deviation"] == pytest.approx(deviation, rel=1e-9)


X = np.array([1.0, 2.0, 3.0, 4.0, 6.0, 7.0, 9.0, 10.0])
Y = np.array([3.1, 4.9, 7.2, 8.8, 13.1, 15.2, 18.7, 21.3])


def line(p, x):
    return p["slope"] * x + p["start"]


def test_straight_line_is_ordinary_regression():
    found = fit(
        line,
        {"start": 1.0, "slope": 1.0},
        X,
        Y,
        derived=lambda p: {"double": 2.0 * p["slope"], "ratio": p["start"] / p["slope"]},
    )
    known = stats.linregress(X, Y)
    assert found["slope"].value == pytest.approx(known.slope, rel=1e-12)
    assert found["slope"].standard_error == pytest.approx(known.stderr, rel=1e-10)
    assert found["start"].standard_error == pytest.approx(known.intercept_stderr, rel=1e-10)
    assert found.statistics["r_squared"] == pytest.approx(known.rvalue**2, rel=1e-12)
    reach = stats.t.ppf(0.975, 6) * known.stderr
    assert found["slope"].interval_95 == pytest.approx((known.slope - reach, known.slope + reach), rel=1e-10)
    assert found["double"].standard_error == pytest.approx(2.0 * known.stderr, rel=1e-10)
    band = found.predict(np.array([5.0]))
    by_hand = found.statistics["residual_standard_deviation"] * np.sqrt(
        1 / 8 + (5.0 - X.mean()) ** 2 / np.sum((X - X.mean()) ** 2)
    )
    assert band.high[0] - band.value[0] == pytest.approx(stats.t.ppf(0.975, 6) * by_hand, rel=1e-9)
    # the profile of a parameter that enters linearly is its t-interval
    assert found.profile("slope").interval_95 == pytest.approx(found["slope"].interval_95, rel=1e-6)
    assert found.sample(20000)["slope"].mean() == pytest.approx(known.slope, rel=2e-3)


def test_weights_joint_data_and_excluded_points():
    # two data sets with a common slope = one regression with a shift for the second set
    joint = fit(
        lambda p, x: (line(p, x[0]), line(p, x[1]) + p["shift"]),
        {"slope": 1.0, "start": 0.5, "shift": 0.1},
        (X[:5], X[5:]),
        (Y[:5], Y[5:] + 4.0),
        sigma=(0.1, 0.1),
    )
    design = np.stack([X, np.ones(8), X > 6.5], axis=1).astype(float)
    known, *_ = np.linalg.lstsq(design, Y + 4.0 * (X > 6.5), rcond=None)
    np.testing.assert_allclose([joint[n].value for n in ("slope", "start", "shift")], known, rtol=1e-9)
    sigma = 0.1 * X
    weighted = fit(line, {"slope": 1.0, "start": 1.0}, X, Y, sigma=sigma)
    slope, start = np.polyfit(X, Y, 1, w=1 / sigma)
    assert weighted.values == pytest.approx({"slope": slope, "start": start}, rel=1e-9)
    spoiled = Y.copy()
    spoiled[0] = 99.0
    kept = fit(line, {"slope": 1.0, "start": 1.0}, X, spoiled, keep=np.arange(8) > 0)
    assert kept.values["slope"] == pytest.approx(np.polyfit(X[1:], Y[1:], 1)[0], rel=1e-9)
    assert kept.statistics["points_excluded"] == 1


@pytest.mark.parametrize("loss", [Huber(), SoftL1()])
def test_robust_losses_ignore_a_stray_point(loss):
    spoiled = Y.copy()
    spoiled[3] += 30.0
    found = fit(line, {"slope": 1.0, "start": 1.0}, X, spoiled, loss=loss)
    assert abs(found["slope"].value - 2.0) < 0.15 < abs(found["start"].standard_error + 0.15)
    assert np.isfinite(found["slope"].standard_error)
    clean = fit(line, {"slope": 1.0, "start": 1.0}, X, Y, loss=loss)
    assert clean["slope"].value == pytest.approx(stats.linregress(X, Y).slope, rel=0.02)


def test_flags_bounds_and_messages():
    bounded = fit(line, {"slope": 1.0, "start": 5.0}, X, Y, bounds={"start": (2.0, 10.0)})
    assert [f["flag"] for f in bounded.flags] == ["at bound"]
    assert bounded["start"].value == 2.0
    assert bounded["slope"].value == pytest.approx(np.sum(X * (Y - 2.0)) / np.sum(X * X), rel=1e-9)
    assert bounded.as_json()["parameters"]["start"]["standard_error"] is None
    twins = fit(lambda p, x: (p["a"] + p["b"]) * x, {"a": 1.0, "b": 1.0}, X, Y)
    assert "poorly identified" in [f["flag"] for f in twins.flags]
    with pytest.raises(InputError, match="too few"):
        fit(line, {"slope": 1.0, "start": 1.0}, X[:2], Y[:2])
    with pytest.raises(InputError, match="start values"):
        fit(lambda p, x: jnp.log(p["a"]) * x, {"a": -1.0}, X, Y)


def test_bootstrap_agrees_with_the_standard_error():
    found = fit(line, {"slope": 1.0, "start": 1.0}, X, Y)
    drawn = found.bootstrap(300)
    assert np.std(drawn["slope"]) == pytest.approx(found["slope"].standard_error, rel=0.2)
