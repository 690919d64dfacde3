"""Elementary functions whose values and derivatives stay finite at the edge of their domain.

Each replaces its argument before the unsafe operation and selects afterwards, so that neither
branch of the selection can put a NaN into a gradient. A NaN given stays NaN.
"""

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp


def safe_where(
    condition: Any, function: Callable[[Any], Any], argument: Any, inside: Any, otherwise: Any
) -> jax.Array:
    """``function(argument)`` where the condition holds, ``otherwise`` elsewhere.

    Parameters
    ----------
    condition: boolean, True where the argument is in the domain of the function.
    function: elementwise, of one argument.
    argument: array that broadcasts with the condition.
    inside: any constant in the domain; the function is evaluated there instead.
    otherwise: value outside; its own derivative is kept.

    Example:
        >>> safe_where(jnp.array([True, False]), jnp.log, jnp.array([1.0, -1.0]), 1.0, 7.0)
        Array([0., 7.], dtype=float64)
    """
    return jnp.where(condition, function(jnp.where(condition, argument, inside)), otherwise)


def safe_divide(numerator: Any, denominator: Any, otherwise: Any = 0.0) -> jax.Array:
    """Quotient; ``otherwise`` where the denominator is zero.

    Example:
        >>> safe_divide(jnp.array([1.0, 1.0]), jnp.array([2.0, 0.0]))
        Array([0.5, 0. ], dtype=float64)
    """
    denominator = jnp.asarray(denominator, dtype=float)
    usable = denominator != 0
    return jnp.where(usable, numerator / jnp.where(usable, denominator, 1.0), otherwise)


def safe_log(x: Any, otherwise: Any = -jnp.inf) -> jax.Array:
    """Natural logarithm; ``otherwise``, with zero derivative, where ``x <= 0``.

    Example:
        >>> safe_log(jnp.array([1.0, 0.0]), otherwise=-700.0)
        Array([   0., -700.], dtype=float64)
    """
    x = jnp.asarray(x, dtype=float)
    return safe_where(~(x <= 0), jnp.log, x, 1.0, otherwise)


def safe_sqrt(x: Any) -> jax.Array:
    """Square root; zero, with zero derivative, where ``x <= 0``.

    Example:
        >>> safe_sqrt(jnp.array([4.0, 0.0, -1.0]))
        Array([2., 0., 0.], dtype=float64)
    """
    x = jnp.asarray(x, dtype=float)
    return safe_where(~(x <= 0), jnp.sqrt, x, 1.0, 0.0)


def safe_power(base: Any, exponent: Any) -> jax.Array:
    """Power of a non-negative base; at ``base <= 0`` its limit at zero, with zero derivative.

    The limit is 0, 1 or infinity for a positive, zero or negative exponent.

    Example:
        >>> safe_power(jnp.array([4.0, 0.0]), 0.5)
        Array([2., 0.], dtype=float64)
    """
    base, exponent = jnp.asarray(base, dtype=float), jnp.asarray(exponent, dtype=float)
    limit = jnp.where(exponent > 0, 0.0, jnp.where(exponent == 0, 1.0, jnp.inf))
    return safe_where(~(base <= 0), lambda b: b**exponent, base, 1.0, limit)


def positive_part(x: Any, width: Any = 0.0) -> jax.Array:
    """``max(x, 0)``, rounded over ``width`` where that is positive.

    The rounded form ``(x + sqrt(x**2 + width**2)) / 2`` is smooth, positive and never below
    ``max(x, 0)``; it exceeds it by ``width / 2`` at most, at zero.

    Example:
        >>> positive_part(jnp.array([-1.0, 3.0]))
        Array([0., 3.], dtype=float64)
    """
    x, width = jnp.asarray(x, dtype=float), jnp.asarray(width, dtype=float)
    root = safe_sqrt(x**2 + width**2)
    # Far below zero the plain form is a difference of nearly equal numbers.
    below = 0.5 * safe_divide(width**2, root - x)
    return jnp.where(width > 0, jnp.where(x < 0, below, 0.5 * (x + root)), jnp.maximum(x, 0.0))


def blend(x: Any, start: Any, end: Any, before: Any, after: Any) -> jax.Array:
    """``before`` up to ``start``, ``after`` from ``end``, twice differentiable in between.

    The weight is the quintic ``6 s^5 - 15 s^4 + 10 s^3`` of ``s = (x - start) / (end - start)``.
    Both values must be finite everywhere. Where ``start == end`` it is a step.

    Example:
        >>> blend(jnp.array([0.0, 1.5, 9.0]), 1.0, 2.0, 10.0, 20.0)
        Array([10., 15., 20.], dtype=float64)
    """
    x = jnp.asarray(x, dtype=float)
    step = jnp.where(x < start, 0.0, 1.0)
    s = jnp.clip(safe_divide(x - start, jnp.subtract(end, start), step), 0.0, 1.0)
    weight = s**3 * (s * (6.0 * s - 15.0) + 10.0)
    return before + weight * (after - before)


def exprel(x: Any) -> Any:
    """(eˣ − 1)/x, one at zero, with its derivative there.

    >>> bool(abs(exprel(1.0) - 1.718281828) < 1e-9), float(jax.grad(exprel)(0.0))
    (True, 0.5)
    """
    near = jnp.abs(x) < 1e-5
    return jnp.where(near, 1.0 + x / 2.0 + x**2 / 6.0, jnp.expm1(x) / jnp.where(near, 1.0, x))
