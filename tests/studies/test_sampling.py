"""Distributions and sampling against known quantiles, moments and a fit's own covariance."""

from __future__ import annotations

import numpy as np
import pytest

from granum.core.errors import GranumError
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.estimation import fit
from granum.studies.distributions import distribution, from_fits
from granum.studies.sampling import METHODS, inputs_at, unit_points

LENGTH, TEMPERATURE = (
    Parameter("particle_diameter", KINDS["Length"]),
    Parameter("temperature", KINDS["Temperature"]),
)


@pytest.mark.parametrize(
    ("table", "u", "wanted"),
    [
        # tables of the normal distribution: 1.959964 standard deviations at 97.5 %
        ({"distribution": "normal", "mean": "10 mm", "standard_deviation": "1 mm"}, 0.975, 0.011959964),
        (
            {"distribution": "lognormal", "median": "10 um", "geometric_standard_deviation": 2.0},
            0.8413447460685429,
            20e-6,
        ),
        ({"distribution": "uniform", "lower": "1 mm", "upper": "3 mm"}, 0.25, 1.5e-3),
        ({"distribution": "loguniform", "lower": "1 um", "upper": "1 mm"}, 1 / 3, 1e-5),
        # triangle 0-1-4 mm: F(1) = 1/4, and F(x) = 1 - (4-x)²/12 beyond: 3/4 at 4 - √3
        (
            {"distribution": "triangular", "lower": 1e-9, "mode": "1 mm", "upper": "4 mm"},
            0.75,
            (4 - np.sqrt(3)) * 1e-3,
        ),
    ],
)
def test_quantiles(table: dict, u: float, wanted: float) -> None:
    assert distribution("x", table, LENGTH).values(np.array([[u]]))[0, 0] == pytest.approx(wanted, rel=1e-6)


def test_temperatures_spread_in_kelvin_and_lognormal_keeps_its_mean() -> None:
    warm = distribution(
        "t", {"distribution": "normal", "mean": "20 degC", "standard_deviation": "2 K"}, TEMPERATURE
    )
    assert warm.values(np.array([[0.5], [0.8413447460685429]])).ravel() == pytest.approx([293.15, 295.15])
    skew = distribution("x", {"distribution": "lognormal", "mean": 2.0, "standard_deviation": 1.0}, LENGTH)
    drawn = skew.values(unit_points("latin_hypercube", 20000, 1, 0))
    assert (drawn.mean(), drawn.std()) == pytest.approx((2.0, 1.0), rel=0.02)


def test_cut_distributions_stay_inside() -> None:
    cut = distribution(
        "x",
        {"distribution": "normal", "mean": 1.0, "standard_deviation": 1.0, "lower": 0.5, "upper": 1.5},
        LENGTH,
    )
    drawn = cut.values(unit_points("random", 2000, 1, 0))
    assert 0.5 <= drawn.min() < 0.52
    assert 1.48 < drawn.max() <= 1.5


@pytest.mark.parametrize("method", METHODS)
def test_points_fill_the_cube_and_repeat(method: str) -> None:
    points = unit_points(method, 1000, 3, 7)
    assert points.shape == (1000, 3)
    assert points.mean(axis=0) == pytest.approx([0.5] * 3, abs=0.04)
    assert np.array_equal(points, unit_points(method, 1000, 3, 7))
    if method == "latin_hypercube":  # one point in each of a thousand slices
        assert np.array_equal(
            np.sort((points * 1000).astype(int), axis=0), np.tile(np.arange(1000)[:, None], 3)
        )


def test_fit_keeps_its_covariance() -> None:
    x = np.linspace(0.0, 1.0, 40)
    rng = np.random.default_rng(3)
    line = fit(
        lambda p, x: p["slope"] * x + p["start"],
        {"slope": 1.0, "start": 1.0},
        x,
        2.0 * x + 1.0 + 0.1 * rng.standard_normal(40),
        derived=lambda p: {"end": p["slope"] + p["start"]},
    )
    (source,) = from_fits({"a": (line, "slope"), "b": (line, "start"), "c": (line, "end")})
    drawn = inputs_at([source], unit_points("sobol_sequence", 8192, source.dimensions, 0))
    dof = line.statistics["degrees_of_freedom"]
    # variance of Student's t
    assert np.cov(drawn[:, :2].T) == pytest.approx(line.covariance * dof / (dof - 2), rel=0.05)
    assert drawn[:, 2] == pytest.approx(drawn[:, 0] + drawn[:, 1], abs=1e-12)
    assert drawn.mean(axis=0) == pytest.approx(
        [line["slope"].value, line["start"].value, line["end"].value], rel=1e-3
    )


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ({"distribution": "norml", "mean": 1.0}, "Did you mean 'normal'?"),
        ({"distribution": "normal", "mean": 1.0}, "needs 'standard_deviation'"),
        (
            {"distribution": "normal", "mean": 1.0, "standart_deviation": 1.0},
            "Did you mean 'standard_deviation'?",
        ),
        ({"distribution": "normal", "mean": "1 kg", "standard_deviation": 1.0}, "unit 'kg' does not fit"),
        ({"distribution": "uniform", "lower": 2.0, "upper": 1.0}, "'lower' must be below 'upper'"),
        ({"distribution": "triangular", "lower": 1.0, "mode": 3.0, "upper": 2.0}, "'mode' must lie between"),
        ({"distribution": "normal", "mean": 1.0, "standard_deviation": -1.0}, "must be"),
        ({"distribution": "loguniform", "lower": 0.0, "upper": 1.0}, "greater than 0"),
    ],
)
def test_bad_distributions(table: dict, message: str) -> None:
    with pytest.raises(GranumError, match=message.replace("?", r"\?")):
        distribution("x", table, LENGTH)
