"""Roots of functions about which something is known."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.numerics.blocks import BLOCK, blockwise
from granum.numerics.quick_roots import falling_root, likely_root, newton_root, straight_root


def test_falling_root_finds_roots_of_any_slope() -> None:
    a = jnp.geomspace(1e-3, 1e3, 50)
    np.testing.assert_allclose(falling_root(lambda x, a: a - x**3, 1e-6, 1e6, a), np.cbrt(a), rtol=1e-12)
    # a step so flat that tangents point outside: bisection takes over
    np.testing.assert_allclose(
        falling_root(lambda x, a: -jnp.tanh(50.0 * (x - a)), 1e-3, 2e3, a), a, rtol=1e-6
    )
    # a start outside the ends, or not a number, does no harm
    for start in (1e9, np.nan):
        np.testing.assert_allclose(
            falling_root(lambda x, a: a - x**3, 1e-6, 1e6, a, start=start), np.cbrt(a), rtol=1e-12
        )
    secant = falling_root(
        lambda x, a: a - x**3, 1e-6, 1e6, a, start=1.1 * jnp.cbrt(a), rough_slope=lambda x: -2.0 * x**2
    )
    np.testing.assert_allclose(secant, np.cbrt(a), rtol=1e-10)


def test_derivatives_are_those_of_the_root() -> None:
    def cube(a):
        return falling_root(lambda x, a: a - x**3, 0.1, 10.0, a)

    assert jax.grad(cube)(8.0) == pytest.approx(1 / 12)
    assert jax.grad(jax.grad(cube))(8.0) == pytest.approx(-2 / 9 * 8.0 ** (-5 / 3))
    assert jax.jacfwd(lambda a: likely_root(lambda x: jnp.exp(x) - a, 0.5, 3.0, 60.0)[0])(
        2.0
    ) == pytest.approx(0.5)
    assert jax.grad(lambda a: newton_root(lambda x: x * x - a, 1.5, 8, 0.1))(2.0) == pytest.approx(
        0.5 / np.sqrt(2.0)
    )


def test_likely_root_falls_back_on_a_bracket_where_newton_jumps() -> None:
    a = jnp.array([-20.0, 0.3, 1e-9, 25.0])
    # arctan throws Newton's method out from |x| > 1.39
    value, found = likely_root(lambda x: jnp.arctan(x - a), jnp.zeros(4), 3.0, 60.0)
    np.testing.assert_allclose(value, a, atol=1e-8)
    assert bool(found.all())
    _value, lost = likely_root(lambda x: x**2 + 1.0 + 0.0 * a, jnp.ones(4), 3.0, 60.0)
    assert not bool(lost.any())


def test_blocks_change_nothing() -> None:
    x = jnp.linspace(0.0, 1.0, 2 * BLOCK + 77)
    np.testing.assert_array_equal(blockwise(lambda x, k: k * x**2, x, 3.0), 3.0 * x**2)
    table = jnp.reshape(x[: 2 * BLOCK + 76], (4, -1))
    np.testing.assert_array_equal(
        blockwise(lambda x, k: k + x, table, jnp.arange(4.0)[:, None]), table + jnp.arange(4.0)[:, None]
    )


def test_a_nearly_straight_function_needs_few_steps() -> None:
    """``x + 0.01 x² = a`` has the root ``50 (√(1 + 0.04 a) − 1)``, of slope ``1/√(1 + 0.04 a)``."""

    def root(a: jax.Array) -> jax.Array:
        return straight_root(lambda x: x + 0.01 * x**2 - a, a, 5)

    a = jnp.array([0.5, 2.0, 5.0])
    found, slope = jax.jvp(root, (a,), (jnp.ones_like(a),))
    assert np.allclose(found, 50.0 * (np.sqrt(1.0 + 0.04 * a) - 1.0), rtol=1e-14)
    assert np.allclose(slope, 1.0 / np.sqrt(1.0 + 0.04 * a), rtol=1e-9)
