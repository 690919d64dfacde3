"""Guarded functions: the plain value inside, a finite gradient everywhere, NaN kept."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from granum.numerics import blend, positive_part, safe_divide, safe_log, safe_power, safe_sqrt, safe_where

ONE_ARGUMENT = {
    "divide": (lambda x: safe_divide(1.0, x), lambda x: 1.0 / x),
    "log": (lambda x: safe_log(x, otherwise=-700.0), jnp.log),
    "sqrt": (safe_sqrt, jnp.sqrt),
    "power": (lambda x: safe_power(x, 0.681), lambda x: x**0.681),
    "inverse power": (lambda x: safe_power(x, -0.5), lambda x: x**-0.5),
}


@pytest.mark.parametrize("name", ONE_ARGUMENT)
def test_inside_and_at_the_edge(name: str) -> None:
    safe, plain = ONE_ARGUMENT[name]
    x = jnp.array([1e-9, 0.3, 7.0])
    np.testing.assert_allclose(safe(x), plain(x), rtol=1e-15)
    np.testing.assert_allclose(jax.vmap(jax.grad(safe))(x), jax.vmap(jax.grad(plain))(x), rtol=1e-14)
    for edge in (0.0, -1.0):
        assert jnp.isfinite(jax.grad(safe)(edge))
        assert jnp.isfinite(jax.grad(jax.grad(safe))(edge))
    assert jnp.isnan(safe(jnp.nan))


def test_limits_at_zero() -> None:
    np.testing.assert_array_equal(safe_power(0.0, jnp.array([0.5, 0.0, -1.0])), [0.0, 1.0, jnp.inf])
    np.testing.assert_array_equal(safe_divide(jnp.array([1.0, 0.0]), 0.0, jnp.inf), [jnp.inf, jnp.inf])
    np.testing.assert_array_equal(safe_log(0.0), -jnp.inf)
    np.testing.assert_array_equal(
        safe_where(jnp.array([True, False]), jnp.arccos, jnp.array([1.0, 3.0]), 0.0, 5.0), [0.0, 5.0]
    )


@given(st.floats(-1e6, 1e6), st.floats(1e-6, 1e3))
def test_rounded_positive_part(x: float, width: float) -> None:
    value = float(positive_part(x, width))
    assert value >= max(x, 0.0)
    assert value <= max(x, 0.0) + 0.5 * width * (1.0 + 1e-12)
    assert jnp.isfinite(jax.grad(positive_part)(x, width))


def test_positive_part() -> None:
    np.testing.assert_array_equal(positive_part(jnp.array([-2.0, 0.0, 3.0])), [0.0, 0.0, 3.0])
    assert jnp.isfinite(jax.grad(positive_part)(0.0))
    np.testing.assert_allclose(jax.grad(positive_part)(0.0, 1e-3), 0.5)
    np.testing.assert_allclose(positive_part(-1e6, 1.0), 0.25e-6, rtol=1e-9)


def test_blend_is_twice_differentiable() -> None:
    def mixed(x):
        return blend(x, 1.0, 2.0, x, x**2)

    np.testing.assert_allclose(mixed(jnp.array([0.5, 1.0, 2.0, 3.0])), [0.5, 1.0, 4.0, 9.0])
    for derivative in (jax.grad(mixed), jax.grad(jax.grad(mixed))):
        for edge in (1.0, 2.0):
            np.testing.assert_allclose(derivative(edge - 1e-9), derivative(edge + 1e-9), atol=1e-6)
    np.testing.assert_array_equal(blend(jnp.array([0.9, 1.0]), 1.0, 1.0, 3.0, 4.0), [3.0, 4.0])
    assert jnp.isfinite(jax.grad(lambda x: blend(x, 1.0, 1.0, 3.0, 4.0))(1.0))
