"""Integrals: of functions between limits, of tables, and moments of distributions on grids."""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np


def gauss_legendre(
    function: Callable[..., Any], lower: Any, upper: Any, *args: Any, order: int = 16
) -> jax.Array:
    """Integral of ``function(x, *args)`` over ``[lower, upper]`` for every element.

    Exact for polynomials up to degree ``2 * order - 1``. The function is called once with ``x`` of
    shape ``(order, *shape)``, where ``shape`` is that of the limits, so args of that shape
    broadcast. Derivatives with respect to limits, arguments and closed-over values are right.

    Example:
        >>> gauss_legendre(lambda x: x**2, 0.0, jnp.array([1.0, 3.0]))
        Array([0.33333333, 9.        ], dtype=float64)
    """
    lower, upper = jnp.broadcast_arrays(*(jnp.asarray(a, dtype=float) for a in (lower, upper)))
    nodes, weights = _gauss_legendre_rule(order)
    column = (order,) + (1,) * lower.ndim
    half = 0.5 * (upper - lower)
    x = 0.5 * (upper + lower) + half * nodes.reshape(column)
    return half * jnp.tensordot(weights, jnp.asarray(function(x, *args)), axes=1)


@lru_cache
def _gauss_legendre_rule(order: int) -> tuple[np.ndarray, np.ndarray]:
    return np.polynomial.legendre.leggauss(order)


def cumulative_trapezoid(values: Any, points: Any, axis: int = -1) -> jax.Array:
    """Integral from the first point to every point of a table, linear between points.

    Parameters
    ----------
    values: table, any shape.
    points: increasing abscissae; one-dimensional along ``axis``, or of the shape of values.
    axis: axis of the table.

    Returns
    -------
    Array of the shape of ``values``; zero at the first point.

    Example:
        >>> cumulative_trapezoid(jnp.array([0.0, 1.0, 2.0]), jnp.array([0.0, 1.0, 2.0]))
        Array([0. , 0.5, 2. ], dtype=float64)
    """
    y, x = _along_last(values, points, axis)
    parts = 0.5 * (y[..., 1:] + y[..., :-1]) * jnp.diff(x)
    return jnp.moveaxis(_running_sum(parts), -1, axis)


def cumulative_simpson(values: Any, points: Any, axis: int = -1) -> jax.Array:
    """Integral from the first point to every point of a table, parabolas through three points.

    Each interval takes the mean of the parabolas that share it (the end intervals have one), so
    parabolas are integrated exactly on any spacing, and cubics too on a uniform one, except in the
    end intervals. Arguments and result as for `cumulative_trapezoid`; at least three points.

    Example:
        >>> cumulative_simpson(jnp.array([0.0, 1.0, 4.0]), jnp.array([0.0, 1.0, 2.0]))
        Array([0.        , 0.33333333, 2.66666667], dtype=float64)
    """
    y, x = _along_last(values, points, axis)
    h = jnp.diff(x)
    slope = jnp.diff(y) / h
    curvature = jnp.diff(slope) / (h[..., 1:] + h[..., :-1])
    first, last = curvature[..., :1], curvature[..., -1:]
    mean = 0.5 * (jnp.concatenate([first, curvature], axis=-1) + jnp.concatenate([curvature, last], axis=-1))
    parts = 0.5 * (y[..., 1:] + y[..., :-1]) * h - mean * h**3 / 6.0
    return jnp.moveaxis(_running_sum(parts), -1, axis)


def moments(densities: Any, edges: Any, orders: Any) -> jax.Array:
    """Moments ``integral of x**k n(x) dx`` of a density that is constant in each cell.

    Parameters
    ----------
    densities: cell means, shape ``(..., n)``.
    edges: increasing cell edges, shape ``(n + 1,)``; non-negative unless the orders are whole.
    orders: the exponents ``k``, any real numbers but -1, shape ``(m,)``.

    Returns
    -------
    Moments, shape ``(..., m)``.

    Example:
        >>> moments(jnp.array([1.0, 1.0]), jnp.array([0.0, 1.0, 2.0]), jnp.array([0, 1, 2]))
        Array([2.        , 2.        , 2.66666667], dtype=float64)
    """
    power = jnp.asarray(orders, dtype=float)[:, None] + 1.0
    weights = jnp.diff(jnp.asarray(edges, dtype=float) ** power) / power
    return jnp.asarray(densities, dtype=float) @ weights.T


def _along_last(values: Any, points: Any, axis: int) -> tuple[jax.Array, jax.Array]:
    y = jnp.moveaxis(jnp.asarray(values, dtype=float), axis, -1)
    x = jnp.asarray(points, dtype=float)
    return y, x if x.ndim == 1 else jnp.moveaxis(x, axis, -1)


def _running_sum(parts: jax.Array) -> jax.Array:
    start = jnp.zeros_like(parts[..., :1])
    return jnp.concatenate([start, jnp.cumsum(parts, axis=-1)], axis=-1)
