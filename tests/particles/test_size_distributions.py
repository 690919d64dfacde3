"""Class distributions: means, bases, percentiles, errors."""

from __future__ import annotations

from itertools import pairwise
from math import log

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from granum.core.errors import InputError
from granum.particles.class_means import size_summary
from granum.particles.distributions import SizeDistribution
from granum.particles.in_class import ArithmeticMidpoint, GeometricMidpoint, LogUniformDensity, UniformDensity

RULES = (UniformDensity(), LogUniformDensity(), ArithmeticMidpoint(), GeometricMidpoint())
TABLE_EDGES = np.array([2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0]) * 1e-6
TABLE_NUMBERS = np.array([2.7, 20.3, 50.8, 23.3, 2.7, 0.2]) / 100.0


def test_table_of_the_course_notes_worked_to_every_mean_by_hand() -> None:
    # sums of N X^k with X = 3, 6, 12, 24, 48, 96 um (class middles), worked on paper from the printed
    # percentages
    m1 = 0.081 + 1.218 + 6.096 + 5.592 + 1.296 + 0.192
    m2 = 0.243 + 7.308 + 73.152 + 134.208 + 62.208 + 18.432
    m3 = 0.729 + 43.848 + 877.824 + 3220.992 + 2985.984 + 1769.472
    d = SizeDistribution(TABLE_EDGES, TABLE_NUMBERS, "number", ArithmeticMidpoint())
    expected = {
        (1, 0): m1,
        (2, 0): m2**0.5,
        (3, 0): m3 ** (1 / 3),
        (3, 2): m3 / m2,
        (2, 1): m2 / m1,
        (3, 1): (m3 / m1) ** 0.5,
    }
    for (p, q), value in expected.items():
        assert float(d.mean(p, q)) * 1e6 == pytest.approx(value, rel=1e-12)
    # cumulative numbers: 2.7, 23.0, 73.8 % at 4, 8, 16 um (the print has 2.3 % for the first)
    assert float(d.percentile(0.5)) * 1e6 == pytest.approx(8.0 + 8.0 * (50.0 - 23.0) / 50.8, rel=1e-12)
    # printed dN/dX
    np.testing.assert_allclose(d.density() * 1e-6 * 100, [1.35, 5.08, 6.35, 1.46, 0.08, 0.00], atol=6e-3)


def test_straight_mass_line_from_1_to_101_micrometers() -> None:
    # Coulson & Richardson vol. 2, problem 1.1: 0 % by mass at 1 um to 100 % at 101 um in a straight line;
    # surface mean 21.7 um
    d = SizeDistribution([1e-6, 101e-6], [1.0], "mass")
    assert float(d.mean(3, 2)) * 1e6 == pytest.approx(100.0 / log(101.0), rel=1e-12)
    assert float(d.mean(3, 2)) * 1e6 == pytest.approx(21.7, abs=0.05)


def test_same_means_as_a_peer_on_the_spray_of_astm_e799() -> None:
    from fluids.particle_size_distribution import ParticleSizeDistribution

    edges = (
        np.array([240, 360, 450, 562.5, 703, 878, 1097, 1371, 1713, 2141, 2676, 3345, 4181, 5226, 6532])
        * 1e-6
    )
    numbers = np.array([65, 119, 232, 410, 629, 849, 990, 981, 825, 579, 297, 111, 21, 1], dtype=float)
    peer = ParticleSizeDistribution(ds=edges, fractions=numbers.tolist(), order=0)
    ours = SizeDistribution.from_amounts(edges, numbers, "number")
    for p, q in ((1, 0), (2, 0), (3, 0), (2, 1), (3, 1), (3, 2), (4, 3)):
        assert float(ours.mean(p, q)) == pytest.approx(peer.mean_size(p, q), rel=1e-9)


@pytest.mark.parametrize("rule", RULES)
@settings(max_examples=6)
@given(
    amounts=st.lists(st.floats(0.0, 1.0), min_size=5, max_size=5).filter(lambda a: sum(a) > 0.1),
    start=st.sampled_from([0.0, 3.0]),
)
def test_conversion_is_exact_and_order_of_means_holds(rule, amounts, start) -> None:
    edges = np.array([start, 5.0, 11.0, 20.0, 47.0, 90.0]) * 1e-6
    d = SizeDistribution.from_amounts(edges, amounts, "volume", rule)
    for basis in ("number", "length", "surface"):
        other = d.to_basis(basis)
        np.testing.assert_allclose(other.to_basis("volume").fractions, d.fractions, atol=1e-12)
        assert float(other.mean(3, 2)) == pytest.approx(float(d.mean(3, 2)), rel=1e-9)
        assert float(other.moment(1.0, "volume")) == pytest.approx(float(d.moment(1.0)), rel=1e-9)
    means = [float(d.mean(p, q)) for p, q in ((1, 0), (2, 0), (3, 0), (3, 1), (3, 2), (4, 3))]
    assert all(a <= b * (1 + 1e-9) for a, b in pairwise(means))
    parts = jnp.linspace(0.0, 1.0, 21)
    sizes = d.percentile(parts)
    assert bool(jnp.all(jnp.isfinite(sizes)) & jnp.all(jnp.diff(sizes) >= -1e-18))
    assert float(sizes.min()) >= edges[0] * (1 - 1e-12)
    assert float(sizes.max()) <= edges[-1] * (1 + 1e-12)


def test_percentile_inverts_cumulative_on_every_basis() -> None:
    d = SizeDistribution([1e-6, 2e-6, 5e-6, 9e-6], [0.2, 0.5, 0.3])
    for basis in ("number", "length", "surface", "volume"):
        on = d.to_basis(basis)
        for part in (0.05, 0.4, 0.93):
            assert float(on.cumulative(on.percentile(part))) == pytest.approx(part, rel=1e-12)


def test_number_median_of_sieve_data_lies_inside_the_data() -> None:
    # a peer puts 44 % of the number below a 75 um class that holds none of it; here nothing lies outside the
    # classes
    d = SizeDistribution(
        np.array([0, 75, 150, 300, 600, 1180]) * 1e-6,
        [0.02, 0.08, 0.3, 0.4, 0.2],
        in_class=ArithmeticMidpoint(),
    )
    n = d.to_basis("number")
    assert float(n.cumulative(0.0)) == 0.0
    assert 0.0 < float(n.percentile(0.1)) < 75e-6
    assert not bool(n.is_measured(0.1))
    assert bool(d.is_measured(0.1))


def test_geometric_mean_is_the_limit_of_moment_ratios() -> None:
    d = SizeDistribution(TABLE_EDGES, TABLE_NUMBERS, "number", ArithmeticMidpoint())
    by_hand = np.exp(np.sum(TABLE_NUMBERS * np.log(np.array([3, 6, 12, 24, 48, 96]) * 1e-6)))
    assert float(d.mean(0, 0)) == pytest.approx(by_hand, rel=1e-12)
    assert float(d.mean(1e-6, -1e-6)) == pytest.approx(by_hand, rel=1e-9)


def test_a_stack_of_analyses_equals_one_by_one() -> None:
    rng = np.random.default_rng(0)
    edges = 45e-6 * 2.0 ** (0.5 * np.arange(15))
    stack = rng.uniform(0.0, 1.0, (1000, 14))

    @jax.jit
    def figures(a):
        d = SizeDistribution(edges, a / a.sum(axis=1, keepdims=True))
        return d.mean(3, 2), d.mean(4, 3), d.percentile(jnp.array([0.1, 0.5, 0.9]))

    whole = figures(stack)
    one = SizeDistribution.from_amounts(edges, stack[7])
    assert float(whole[0][7]) == pytest.approx(float(one.mean(3, 2)), rel=1e-12)
    np.testing.assert_allclose(whole[2][7], one.percentile(jnp.array([0.1, 0.5, 0.9])), rtol=1e-12)


def test_gradients_of_percentiles_and_means_are_finite() -> None:
    def f(a):
        d = SizeDistribution(TABLE_EDGES, a / a.sum(), "number")
        return d.mean(3, 2) + d.percentile(0.5) + d.to_basis("volume").percentile(0.1)

    a = jnp.asarray(TABLE_NUMBERS)
    g = jax.grad(f)(a)
    h = 1e-6
    difference = (f(a.at[2].add(h)) - f(a.at[2].add(-h))) / (2 * h)
    assert bool(jnp.all(jnp.isfinite(g)))
    assert float(g[2]) == pytest.approx(float(difference), rel=1e-5)


@pytest.mark.parametrize(
    ("edges", "fractions", "hint"),
    [
        ([1e-6, 3e-6, 2e-6], [0.5, 0.5], "must increase"),
        ([1e-6, 2e-6, 3e-6], [1.2, -0.2], "less than nothing"),
        ([1e-6, 2e-6, 3e-6], [0.5, 0.3], "add up to 0.8"),
        ([1e-6, 2e-6, 3e-6], [50.0, 50.0], "percentages"),
        ([1e-6, 2e-6, 3e-6], [0.5, 0.25, 0.25], "n \\+ 1 limits"),
        ([-1e-6, 2e-6, 3e-6], [0.5, 0.5], "not negative"),
        ([1e-6, 2e-6, np.nan], [0.5, 0.5], "finite"),
        ([1e-6, 2e-6, 3e-6], [np.nan, 0.5], "Class 1"),
    ],
)
def test_bad_tables_raise_one_clear_error(edges, fractions, hint) -> None:
    with pytest.raises(InputError, match=hint):
        SizeDistribution(edges, fractions)


def test_other_errors() -> None:
    with pytest.raises(InputError, match="all empty"):
        SizeDistribution.from_amounts([1e-6, 2e-6], [0.0])
    with pytest.raises(InputError, match="volume"):
        SizeDistribution([1e-6, 2e-6], [1.0], "volum")
    with pytest.raises(InputError, match="0 to 1"):
        SizeDistribution.from_cumulative([1e-6, 2e-6], [0.0, 0.9])
    with pytest.raises(InputError, match="span"):
        SizeDistribution([1e-6, 2e-6], [1.0]).regrouped([1.5e-6, 2e-6])


def test_regrouping_keeps_the_material_and_the_cumulative_curve() -> None:
    d = SizeDistribution([1e-6, 2e-6, 5e-6], [0.3, 0.7])
    finer = d.regrouped([0.5e-6, 1e-6, 1.5e-6, 2e-6, 3e-6, 5e-6, 7e-6])
    np.testing.assert_allclose(finer.fractions, [0, 0.15, 0.15, 0.7 / 3, 1.4 / 3, 0], atol=1e-12)


def test_summary_card_says_what_was_not_measured() -> None:
    s = size_summary("0, 100, 200 um", "10, 90 %")
    assert float(s.unmeasured_fraction) == pytest.approx(0.1)
    assert float(s.mean_diameter_mass) == pytest.approx(0.1 * 50e-6 + 0.9 * 150e-6)
