"""Grinding operators against the analytic solutions, and equipment with its balances."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.comminution import population
from granum.comminution.breakage import AustinBreakage, AustinSelection, BroadbentCallcottBreakage, WhitenClassification
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
    return population.rate_matrix(EDGES, SELECTION, BREAKAGE)


def test_fragments_keep_the_mass_and_never_grow() -> None:
    for law in (BREAKAGE, BroadbentCallcottBreakage()):
        b = np.asarray(population.fragments(EDGES, law))
        np.testing.assert_allclose(b[:, 1:].sum(axis=0), 1.0, atol=1e-14)
        assert np.all(np.tril(b) == 0.0)
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
    # all fragments of the second class fall into the first; of the third, B(y) = y with y = 1/2, so half each
    edges = jnp.array([0.0, 1e-3, 2e-3, 4e-3])
    a = population.rate_matrix(edges, AustinSelection(0.1, 1.0), AustinBreakage(1.0, 1.0, 4.0))
    s2, s3, t = 0.2, 0.4, 3.0
    m3 = np.exp(-s3 * t)
    m2 = 0.5 * s3 / (s2 - s3) * (np.exp(-s3 * t) - np.exp(-s2 * t))
    np.testing.assert_allclose(population.batch_operator(a, t)[:, 2], [1 - m2 - m3, m2, m3], rtol=1e-12)


def test_tanks_in_series_run_from_the_mixed_mill_to_plug_flow() -> None:
    tau = 120.0
    plug = population.PlugFlow().operator(matrix(), tau)
    one = population.TanksInSeries(1).operator(matrix(), tau)
    assert float(one[-1, -1]) == pytest.approx(1.0 / (1.0 + float(SELECTION(EDGES[-1])) * tau), rel=1e-12)
    far = [float(abs(population.TanksInSeries(n).operator(matrix(), tau) - plug).max()) for n in (1, 4, 16, 64)]
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
    for law in (population.TanksInSeries(1), population.TanksInSeries(4), population.LargeAndTwoSmall(0.7), population.PlugFlow()):
        w = np.asarray(law(tau, t))
        assert w[0] == pytest.approx(1.0)
        assert float(np.trapezoid(w, t)) == pytest.approx(tau, rel=1e-3)
        # linear kinetics of one class: the operator is the Laplace transform of the residence times
        k = 0.02
        a = jnp.array([[0.0, k], [0.0, -k]])
        assert float(law.operator(a, tau)[1, 1]) == pytest.approx(1.0 - k * float(np.trapezoid(w * np.exp(-k * t), t)), rel=1e-3)


def test_falloff_halves_the_rate_and_gradients_are_finite() -> None:
    law = AustinSelection(0.01, 1.0, falloff_size=5e-3, falloff_exponent=3.0)
    assert float(law(5e-3)) == pytest.approx(0.5 * 0.01 * 5.0)
    slope = jax.grad(
        lambda s: (population.batch_operator(population.rate_matrix(EDGES, AustinSelection(s, 0.9), BREAKAGE), 60.0) @ FEED)[3]
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


def test_grinding_kinetics_find_the_functions_that_made_noisy_data() -> None:
    sizes = 4e-3 * 2.0 ** (-0.5 * np.arange(12))[::-1]
    edges = np.concatenate([[0.0], sizes])
    a = np.asarray(population.rate_matrix(edges, AustinSelection(0.01, 0.9), AustinBreakage(0.55, 0.75, 4.2)))
    feed = np.zeros(12)
    feed[-2] = 1.0
    times = np.array([0.0, 30.0, 90.0, 240.0])
    # the data come from Reid's closed solution, the fit from the matrix exponential
    curves = np.array([np.cumsum(np.asarray(population.reid_solution(a, feed, t))) for t in times])
    rng = np.random.default_rng(2)
    noisy = np.clip(curves + rng.normal(0.0, 0.002, curves.shape) * (curves > 1e-6) * (curves < 1 - 1e-6), 0.0, 1.0)
    noisy = np.maximum.accumulate(noisy, axis=1)
    rows = [np.repeat(times, 12), np.tile(sizes, 4)]
    truth = {"selection_rate": 0.01, "selection_exponent": 0.9, "fines_share": 0.55, "fines_exponent": 0.75, "coarse_exponent": 4.2}
    fit = GrindingKinetics(*rows, noisy.ravel()).fit()
    for name, value in truth.items():
        assert abs(fit[name].value - value) < 4.0 * fit[name].standard_error
    assert len(GrindingKinetics(*rows, noisy.ravel()).chart().data) == 8
    with pytest.raises(InputError, match="same sieves"):
        GrindingKinetics(rows[0][:-1], rows[1][:-1], noisy.ravel()[:-1]).fit()
