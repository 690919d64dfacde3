"""Grinding operators against the analytic solutions, and equipment with its balances."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from granum.comminution import population
from granum.comminution.breakage import (
    AustinBreakage,
    AustinSelection,
    BroadbentCallcottBreakage,
    WhitenClassification,
)
from granum.comminution.lab_tests.batch_grinding import BatchGrinding
from granum.comminution.lab_tests.grinding_kinetics import GrindingKinetics
from granum.comminution.lab_tests.partition_test import PartitionTest
from granum.core.errors import InputError
from granum.particles.partition import LogisticPartition

EDGES = np.concatenate([[0.0], 1e-3 * 2.0 ** (0.5 * np.arange(-9, 5))])
SELECTION, BREAKAGE = AustinSelection(0.01, 0.9), AustinBreakage(0.5, 0.8, 4.0)
FEED = np.zeros(EDGES.size - 1)
FEED[-1], FEED[-2] = 0.7, 0.3


def matrix():
    return population.rate_matrix(EDGES, SELECTION, BREAKAGE, "root_two")


def test_fragments_keep_the_mass_and_never_grow() -> None:
    for law in (BREAKAGE, BroadbentCallcottBreakage()):
        for convention in ("continuous", "root_two"):
            b = np.asarray(population.fragments(EDGES, law, convention))
            np.testing.assert_allclose(b[:, 1:].sum(axis=0), 1.0, atol=1e-14)
            assert np.all(np.tril(b, -1) == 0.0)
            assert np.all((np.diag(b)[1:] > 0.0) == (convention == "continuous"))
            assert np.all(b >= 0.0)
    np.testing.assert_allclose(matrix().sum(axis=0), 0.0, atol=1e-16)


def test_matrix_exponential_equals_reids_solution() -> None:
    for time in (0.0, 10.0, 300.0):
        product = population.batch_operator(matrix(), time) @ FEED
        np.testing.assert_allclose(product, population.reid_solution(matrix(), FEED, time), atol=1e-12)
        assert float(product.sum()) == pytest.approx(1.0, abs=1e-12)
        assert float(product.min()) >= -1e-15
    # top class alone: first-order decay
    assert float((population.batch_operator(matrix(), 50.0) @ FEED)[-1]) == pytest.approx(
        0.7 * np.exp(-float(SELECTION(EDGES[-1])) * 50.0), rel=1e-12
    )


def test_two_classes_against_the_solution_on_paper() -> None:
    # Austin's convention: all fragments of the second class fall into the first; of the third, B(y) = y² with
    # y = 1/√2, so half each
    edges = 1e-3 * np.array([0.0, 1.0, np.sqrt(2.0), 2.0])
    a = population.rate_matrix(edges, AustinSelection(0.1, 2.0), AustinBreakage(1.0, 2.0, 4.0), "root_two")
    s2, s3, t = 0.2, 0.4, 3.0
    m3 = np.exp(-s3 * t)
    m2 = 0.5 * s3 / (s2 - s3) * (np.exp(-s3 * t) - np.exp(-s2 * t))
    np.testing.assert_allclose(population.batch_operator(a, t)[:, 2], [1 - m2 - m3, m2, m3], rtol=1e-12)


@pytest.mark.parametrize("edges", [[0.0, 0.3, 0.5, 0.55, 1.3, 2.0, 7.0], [0.1, 0.4, 4.0]])
def test_power_laws_are_exact_at_every_limit_of_any_grid(edges: list[float]) -> None:
    """With S = k x^a and B = (x/y)^a the oversize obeys dR/dt = -k x^a R (Kapur): R(x, t) = R(x, 0) exp(-k
    x^a t).
    """
    limits, feed, k, a, t = 1e-3 * np.array(edges), np.linspace(1.0, 3.0, len(edges) - 1), 0.004, 1.3, 150.0
    mass = (
        population.batch_operator(
            population.rate_matrix(limits, AustinSelection(k, a), AustinBreakage(1.0, a, 4.0)), t
        )
        @ feed
    )
    over = np.cumsum(feed[::-1])[::-1]
    over[1:] *= np.exp(-k * np.array(edges[1:-1]) ** a * t)
    np.testing.assert_allclose(np.cumsum(np.asarray(mass)[::-1])[::-1], over, rtol=1e-11)


def test_batch_converges_with_the_square_of_the_class_width_to_the_continuous_solution() -> None:
    """1 to 1.41 mm for 5 min, share below 0.3 mm: against the continuous equation integrated by SciPy on
    240 fine classes.
    """

    def share(below_top: int, split: int) -> float:
        limits = 3e-4 * (10.0 / 3.0 * np.sqrt(2.0)) ** (np.arange(-below_top, split + 1) / split)
        edges, feed = np.concatenate([[0.0], limits]), np.zeros(limits.size)
        spread = np.clip(np.log(limits[1:] / 1e-3), 0.0, None) / np.log(np.sqrt(2.0))
        feed[1:] = np.diff(spread, prepend=0.0)
        ground = expm(300.0 * np.asarray(population.rate_matrix(edges, SELECTION, BREAKAGE))) @ feed
        return float(ground[: below_top + 1].sum())

    n = 240
    step = np.log(10.0 / 3.0 * np.sqrt(2.0)) / n
    x = 3e-4 * np.exp((np.arange(n) + 0.5) * step)  # what is finer than 0.3 mm does not come back
    rate = 0.01 * (x / 1e-3) ** 0.9
    upper, lower = np.exp(step / 2), np.exp(-step / 2)
    cumulative = lambda y: np.where(  # noqa: E731
        y >= 1.0, 1.0, 0.5 * np.minimum(y, 1.0) ** 0.8 + 0.5 * np.minimum(y, 1.0) ** 4.0
    )
    ratio = x[:, None] / x[None, :]
    gain = np.triu(cumulative(ratio * upper) - cumulative(ratio * lower)) * rate
    start = np.clip(np.log(x * upper / 1e-3) / step, 0.0, 1.0)
    path = solve_ivp(
        lambda _t, m: gain @ m - rate * m, (0.0, 300.0), start / start.sum(), rtol=1e-9, atol=1e-14
    )
    expected = 1.0 - path.y[:, -1].sum()
    # the figure of an independent solution of the same equation
    assert expected == pytest.approx(0.463, abs=5e-4)
    errors = [share(2 * k, 4 * k) - expected for k in (1, 2, 4)]
    assert abs(errors[0]) < 0.02
    assert 3.0 < errors[0] / errors[1] < 5.5
    assert 2.5 < errors[1] / errors[2] < 6.0


def test_tanks_in_series_run_from_the_mixed_mill_to_plug_flow() -> None:
    tau = 120.0
    plug = population.PlugFlow().operator(matrix(), tau)
    one = population.TanksInSeries(1).operator(matrix(), tau)
    assert float(one[-1, -1]) == pytest.approx(1.0 / (1.0 + float(SELECTION(EDGES[-1])) * tau), rel=1e-12)
    far = [
        float(abs(population.TanksInSeries(n).operator(matrix(), tau) - plug).max()) for n in (1, 4, 16, 64)
    ]
    assert far[0] > far[1] > far[2] > far[3]
    assert far[3] < 0.01
    for law in (population.PlugFlow(), population.TanksInSeries(3), population.LargeAndTwoSmall()):
        operator = np.asarray(law.operator(matrix(), tau))
        np.testing.assert_allclose(operator.sum(axis=0), 1.0, atol=1e-12)
        assert operator.min() >= -1e-15
    with pytest.raises(InputError, match="whole number from 1 to"):
        population.TanksInSeries(0)


def test_washout_curves_have_the_mean_residence_time() -> None:
    tau, t = 100.0, np.linspace(0.0, 4000.0, 400_001)
    for law in (
        population.TanksInSeries(1),
        population.TanksInSeries(4),
        population.LargeAndTwoSmall(0.7),
        population.PlugFlow(),
    ):
        w = np.asarray(law(tau, t))
        assert w[0] == pytest.approx(1.0)
        assert float(np.trapezoid(w, t)) == pytest.approx(tau, rel=1e-3)
        # linear kinetics of one class: the operator is the Laplace transform of the residence times
        k = 0.02
        a = jnp.array([[0.0, k], [0.0, -k]])
        assert float(law.operator(a, tau)[1, 1]) == pytest.approx(
            1.0 - k * float(np.trapezoid(w * np.exp(-k * t), t)), rel=1e-3
        )


def test_falloff_halves_the_rate_and_gradients_are_finite() -> None:
    law = AustinSelection(0.01, 1.0, falloff_size=5e-3, falloff_exponent=3.0)
    assert float(law(5e-3)) == pytest.approx(0.5 * 0.01 * 5.0)
    slope = jax.grad(
        lambda s: (
            population.batch_operator(population.rate_matrix(EDGES, AustinSelection(s, 0.9), BREAKAGE), 60.0)
            @ FEED
        )[3]
    )(0.01)
    assert np.isfinite(slope)
    assert slope > 0


def test_crusher_classification_over_classes() -> None:
    law = WhitenClassification(1e-2, 3e-2, 2.3)
    x = np.linspace(5e-3, 3.5e-2, 300_001)
    assert float(law.over(5e-3, 3.5e-2)) == pytest.approx(float(np.mean(law(x))), rel=1e-5)


def test_partition_test_gives_back_its_curve() -> None:
    sizes = np.geomspace(2e-5, 8e-4, 10)
    truth = LogisticPartition(1.2e-4, 2.8)
    part = 0.15 + 0.85 * np.asarray(truth(sizes))
    total = np.linspace(1.0, 3.0, 10)
    fit = PartitionTest(sizes, total * part, total * (1 - part), with_bypass=True).fit()
    assert fit["cut_size"].value == pytest.approx(1.2e-4, rel=1e-6)
    assert fit["sharpness"].value == pytest.approx(2.8, rel=1e-6)
    assert fit["bypass_fraction"].value == pytest.approx(0.15, rel=1e-6)
    assert fit["sharpness_index"].value == pytest.approx(9 ** (-1 / 2.8), rel=1e-6)
    assert len(PartitionTest(sizes, total * part, total * (1 - part), with_bypass=True).chart().data) == 2
    with pytest.raises(InputError, match="other side of 50"):
        PartitionTest([1e-4, 2e-4, 3e-4], [8.0, 9.0, 9.5], [1.0, 1.0, 0.5]).fit()


def test_batch_grinding_rate() -> None:
    t = np.array([0.0, 30.0, 60.0, 120.0, 240.0])
    fit = BatchGrinding(t, 0.96 * np.exp(-0.008 * t)).fit()
    assert fit["selection_function"].value == pytest.approx(0.008, rel=1e-9)
    assert fit["remaining_fraction_start"].value == pytest.approx(0.96, rel=1e-9)


@pytest.mark.long
def test_grinding_kinetics_find_the_functions_that_made_noisy_data() -> None:
    sizes = 4e-3 * 2.0 ** (-0.5 * np.arange(12))[::-1]
    edges = np.concatenate([[0.0], sizes])
    laws = AustinSelection(0.01, 0.9), AustinBreakage(0.55, 0.75, 4.2)
    a = np.asarray(population.rate_matrix(edges, *laws, "root_two"))
    feed = np.zeros(12)
    feed[-2] = 1.0
    times = np.array([0.0, 30.0, 90.0, 240.0])
    # the data come from Reid's closed solution, the fit from the matrix exponential
    curves = np.array([np.cumsum(np.asarray(population.reid_solution(a, feed, t))) for t in times])
    rng = np.random.default_rng(2)
    noisy = np.clip(
        curves + rng.normal(0.0, 0.002, curves.shape) * (curves > 1e-6) * (curves < 1 - 1e-6), 0.0, 1.0
    )
    noisy = np.maximum.accumulate(noisy, axis=1)
    rows = [np.repeat(times, 12), np.tile(sizes, 4)]
    truth = {
        "selection_rate": 0.01,
        "selection_exponent": 0.9,
        "fines_share": 0.55,
        "fines_exponent": 0.75,
        "coarse_exponent": 4.2,
    }
    fit = GrindingKinetics(*rows, noisy.ravel(), breakage_convention="root_two").fit()
    for name, value in truth.items():
        assert abs(fit[name].value - value) < 4.0 * fit[name].standard_error
    assert len(GrindingKinetics(*rows, noisy.ravel()).chart().data) == 8
    single = GrindingKinetics(
        *rows, noisy.ravel()
    ).fit()  # as laws of single sizes: faster, and fragments closer to their parent
    assert single["selection_rate"].value > 1.2 * fit["selection_rate"].value
    keep = rows[1] != sizes[4]
    gap = GrindingKinetics(*(r[keep] for r in rows), noisy.ravel()[keep], breakage_convention="root_two")
    with pytest.raises(InputError, match=r"ratio 1\.414"):
        gap.fit()
    with pytest.raises(InputError, match="same sieves"):
        GrindingKinetics(rows[0][:-1], rows[1][:-1], noisy.ravel()[:-1]).fit()
