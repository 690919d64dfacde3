"""Smallest values of elementwise functions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
from jax import lax

SAMPLES, GOLDEN_STEPS = 400, 40
GOLDEN = 0.6180339887498949


def golden_section(function: Callable[[Any], Any], lower: Any, upper: Any, steps: int) -> tuple[Any, Any]:
    """Ends between which a function with one minimum in the interval has it, by so many golden sections."""

    def narrow(_i: Any, ends: tuple[Any, Any]) -> tuple[Any, Any]:
        a, b = ends
        c, d = b - GOLDEN * (b - a), a + GOLDEN * (b - a)
        left = function(c) < function(d)
        return jnp.where(left, a, c), jnp.where(left, d, b)

    return lax.fori_loop(0, steps, narrow, (lower, upper))


def least(function: Callable[[Any], Any], lower: Any, upper: Any) -> tuple[Any, Any]:
    """Smallest value of an elementwise function on ``[lower, upper]`` and where it is, the best of a fine
    scan refined.

    The last Newton step on the slope is the one that carries derivatives: value and place have exact first
    derivatives.

    >>> value, place = least(lambda x: (x - 2.0) ** 2 + 1.0, 0.0, 5.0)
    >>> round(float(value), 12), round(float(place), 12)
    (1.0, 2.0)
    """
    low, high = jnp.asarray(lower, dtype=float), jnp.asarray(upper, dtype=float)
    share = jnp.linspace(0.0, 1.0, SAMPLES).reshape((SAMPLES,) + (1,) * jnp.ndim(low + high))
    points = low + share * (high - low)
    values = function(points)
    best = jnp.argmin(values, axis=0)

    def pick(shift: int) -> Any:
        index = jnp.clip(best + shift, 0, SAMPLES - 1)
        return jnp.take_along_axis(points, index[None], axis=0)[0]

    a, b = pick(-1), pick(1)
    a, b = golden_section(function, lax.stop_gradient(a), lax.stop_gradient(b), GOLDEN_STEPS)
    middle = 0.5 * (a + b)

    def slope(x: Any) -> Any:
        return jax.jvp(function, (x,), (jnp.ones_like(x),))[1]

    curvature = lax.stop_gradient(jax.jvp(slope, (middle,), (jnp.ones_like(middle),))[1])
    step = slope(middle) / jnp.where(curvature > 0, curvature, jnp.inf)
    middle = jnp.clip(middle - jnp.where(jnp.abs(step) < 1e-3 * (high - low), step, 0.0), low, high)
    # The ends belong to the interval, and the best of a scan may lie on one; there the end itself moves with
    # its own derivative.
    candidates = jnp.stack(
        [jnp.broadcast_to(low, middle.shape), middle, jnp.broadcast_to(high, middle.shape)]
    )
    found = function(candidates)
    which = jnp.argmin(found, axis=0)[None]
    return jnp.take_along_axis(found, which, axis=0)[0], jnp.take_along_axis(candidates, which, axis=0)[0]
