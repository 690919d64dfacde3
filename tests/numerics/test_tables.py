"""Quadrature and interpolation: exactness, order, monotonicity, derivatives."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator

from granum.numerics import (
    MonotoneCubic,
    cumulative_simpson,
    cumulative_trapezoid,
    gauss_legendre,
    interpolate_linear,
    moments,
    slopes_pchip,
    slopes_steffen,
)

SLOPES = [slopes_pchip, slopes_steffen]


def test_gauss_legendre_is_exact_for_polynomials() -> None:
    upper = jnp.array([[1.0, 2.0], [-1.0, 0.0]])
    n = jnp.array([7.0, 3.0])
    found = gauss_legendre(lambda x, n: x**n, 0.0, upper, n, order=4)
    np.testing.assert_allclose(found, upper ** (n + 1) / (n + 1), atol=1e-14)


def test_gauss_legendre_derivatives() -> None:
    def area(a, b):
        return gauss_legendre(lambda x: jnp.exp(a * x), 0.0, b)

    np.testing.assert_allclose(area(0.5, 2.0), 2.0 * np.expm1(1.0), rtol=1e-14)
    np.testing.assert_allclose(jax.grad(area, argnums=1)(0.5, 2.0), np.e, rtol=1e-13)
    np.testing.assert_allclose(jax.grad(area)(0.5, 2.0), 4.0, rtol=1e-13)
    np.testing.assert_allclose(gauss_legendre(lambda x: jnp.ones_like(x), 1.0, 4.0), 3.0, rtol=1e-14)


def test_cumulative_rules() -> None:
    x = jnp.array([0.0, 0.1, 0.5, 0.6, 1.3, 2.0])
    np.testing.assert_allclose(cumulative_trapezoid(3.0 * x + 1.0, x), 1.5 * x**2 + x, rtol=1e-14)
    np.testing.assert_allclose(cumulative_simpson(3.0 * x**2 - x, x), x**3 - 0.5 * x**2, atol=1e-14)
    table = jnp.stack([x, x**2], axis=1)
    found = cumulative_simpson(table, x, axis=0)
    np.testing.assert_allclose(found, jnp.stack([x**2 / 2, x**3 / 3], axis=1), atol=1e-14)


@pytest.mark.parametrize(("rule", "order"), [(cumulative_trapezoid, 2), (cumulative_simpson, 3.5)])
def test_cumulative_orders(rule, order: float) -> None:
    def error(n: int) -> float:
        x = jnp.linspace(0.0, 3.0, n + 1)
        return float(jnp.max(abs(rule(jnp.cos(x), x) - jnp.sin(x))))

    assert np.log2(error(50) / error(100)) > order - 0.1


def test_moments_of_an_exponential_density() -> None:
    edges = jnp.linspace(0.0, 40.0, 4001)
    densities = -jnp.diff(jnp.exp(-edges)) / jnp.diff(edges)
    found = moments(jnp.stack([densities, 2.0 * densities]), edges, jnp.array([0.0, 1.0, 2.0, 3.0]))
    np.testing.assert_allclose(found[0], [1.0, 1.0, 2.0, 6.0], rtol=2e-5)
    np.testing.assert_allclose(found[1], 2.0 * found[0], rtol=1e-14)
    np.testing.assert_allclose(
        moments(jnp.array([1.0]), jnp.array([1.0, 4.0]), jnp.array([-0.5])), [[2.0]][0]
    )


def test_linear_table() -> None:
    points, values = jnp.array([0.0, 1.0, 3.0]), jnp.array([0.0, 2.0, 0.0])
    value, inside = interpolate_linear(jnp.array([-1.0, 0.0, 0.5, 1.0, 2.0, 3.0, 4.0]), points, values)
    np.testing.assert_allclose(value, [-2.0, 0.0, 1.0, 2.0, 1.0, 0.0, -1.0])
    assert inside.tolist() == [False, True, True, True, True, True, False]
    gradient = jax.grad(lambda v: interpolate_linear(0.25, points, v)[0])(values)
    np.testing.assert_allclose(gradient, [0.75, 0.25, 0.0])


@pytest.mark.parametrize("slopes", SLOPES)
def test_cubic_converges_to_a_smooth_curve(slopes) -> None:
    def error(n: int) -> float:
        x = jnp.linspace(0.0, 1.0, n + 1)
        at = jnp.linspace(0.0, 1.0, 1001)
        return float(jnp.max(abs(MonotoneCubic.through(x, jnp.exp(x), slopes)(at)[0] - jnp.exp(at))))

    assert np.log2(error(20) / error(40)) > 2.7


def test_pchip_agrees_with_scipy() -> None:
    x = np.array([0.0, 0.4, 1.0, 1.5, 3.0, 3.1])
    y = np.array([0.0, 0.1, 2.0, 2.0, 1.0, 4.0])
    at = np.linspace(0.0, 3.1, 101)
    curve, other = MonotoneCubic.through(x, y), PchipInterpolator(x, y)
    np.testing.assert_allclose(curve(at)[0], other(at), atol=1e-13)
    np.testing.assert_allclose(curve.derivative(at), other(at, 1), atol=1e-11)


def test_steffen_slopes_of_his_rule() -> None:
    # Steffen (1990), eq. 11: parabola slope (s0 h1 + s1 h0) / (h0 + h1), at most twice the smaller secant.
    slopes = slopes_steffen(jnp.array([0.0, 1.0, 3.0, 4.0, 5.0]), jnp.array([0.0, 1.0, 5.0, 5.1, 2.0]))
    np.testing.assert_allclose(slopes[1:4], [(1.0 * 2.0 + 2.0 * 1.0) / 3.0, 0.2, 0.0])


# Subnormal steps are left out: compiled code rounds them to zero.
STEP = st.tuples(st.floats(1e-3, 10.0), st.floats(0.0, 10.0, allow_subnormal=False))
# Two lengths only: each is compiled.
STEPS = st.sampled_from([3, 8]).flatmap(lambda n: st.lists(STEP, min_size=n, max_size=n))


@pytest.mark.parametrize("slopes", SLOPES)
@given(steps=STEPS, falling=st.booleans())
def test_cubic_is_monotone_where_the_table_is(slopes, steps, falling: bool) -> None:
    width, rise = np.array(steps).T
    x = np.concatenate([[0.0], np.cumsum(width)])
    y = np.concatenate([[0.0], np.cumsum(rise)]) * (-1.0 if falling else 1.0)
    at = np.sort(np.concatenate([np.linspace(x[0], x[-1], 400), x]))
    curve = MonotoneCubic.through(x, y, slopes)
    value, inside = curve(at)
    assert inside.all()
    step = np.diff(value) * (-1.0 if falling else 1.0)
    assert step.min() >= -1e-13 * max(1.0, abs(y).max())
    np.testing.assert_array_equal(curve(x)[0], y)


def test_inverse_and_its_derivative() -> None:
    x = jnp.array([0.0, 1.0, 2.0, 4.0])
    for y in (jnp.array([0.0, 1.0, 8.0, 9.0]), jnp.array([9.0, 8.0, 1.0, -3.0])):
        curve = MonotoneCubic.through(x, y)
        at = jnp.linspace(0.0, 4.0, 41)
        back, inside = curve.inverse(curve(at)[0])
        assert inside.all()
        np.testing.assert_allclose(back, at, atol=1e-9)
        slope = jax.grad(lambda v, curve=curve: curve.inverse(v)[0])(curve(1.3)[0])
        np.testing.assert_allclose(slope, 1.0 / curve.derivative(1.3), rtol=1e-9)
        np.testing.assert_array_equal(curve.inverse(y)[0], x)
        beyond, inside = curve.inverse(jnp.array([-50.0, 50.0]))
        assert not inside.any()
        assert set(beyond.tolist()) == {0.0, 4.0}


def test_cubic_continues_straight_outside() -> None:
    curve = MonotoneCubic.through(jnp.array([0.0, 1.0, 2.0]), jnp.array([0.0, 1.0, 4.0]))
    value, inside = curve(jnp.array([-1.0, 3.0]))
    np.testing.assert_allclose(value, [0.0 - curve.slopes[0], 4.0 + curve.slopes[-1]])
    assert not inside.any()
    np.testing.assert_allclose(
        jax.vmap(jax.grad(lambda x: curve(x)[0]))(jnp.array([-1.0, 0.5, 3.0])),
        curve.derivative(jnp.array([-1.0, 0.5, 3.0])),
    )
