"""Interpolation in tables: straight lines, and cubics that keep the table's monotonicity.

Outside the table the end is continued as a straight line and the returned boolean is False.
"""

from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.core.at_once import at_once
from granum.numerics.roots import find_root
from granum.numerics.smooth import safe_divide


def interpolate_linear(x: Any, points: Any, values: Any) -> tuple[jax.Array, jax.Array]:
    """Piecewise linear interpolation.

    Parameters
    ----------
    x: where to interpolate, any shape.
    points: increasing abscissae, shape ``(n,)``, at least two.
    values: ordinates, shape ``(n,)``.

    Returns
    -------
    The values, and a boolean that is True inside the table; both of the shape of ``x``.

    Example:
        >>> interpolate_linear(1.5, jnp.array([1.0, 2.0]), jnp.array([10.0, 20.0]))[0]
        Array(15., dtype=float64)
    """
    x, points, values = (jnp.asarray(a, dtype=float) for a in (x, points, values))
    i = _interval(x, points)
    slope = (values[i + 1] - values[i]) / (points[i + 1] - points[i])
    return values[i] + slope * (x - points[i]), (points[0] <= x) & (x <= points[-1])


@at_once()
def slopes_pchip(points: jax.Array, values: jax.Array) -> jax.Array:
    """Slopes at the points by Fritsch and Butland (1984), as in PCHIP: weighted harmonic mean.

    Shapes ``(n,)``, at least three points. Zero at local extrema of the table, so the cubic has no
    others.
    """
    h, d = _steps(points, values)
    before, after = 2.0 * h[1:] + h[:-1], h[1:] + 2.0 * h[:-1]
    same = d[1:] * d[:-1] > 0
    left, right = jnp.where(same, d[:-1], 1.0), jnp.where(same, d[1:], 1.0)
    inner = jnp.where(same, (before + after) / (before / left + after / right), 0.0)
    return _with_ends(inner, h, d, 3.0)


@at_once()
def slopes_steffen(points: jax.Array, values: jax.Array) -> jax.Array:
    """Slopes at the points by Steffen (1990): the parabola's, limited to twice either secant.

    Shapes ``(n,)``, at least three points. Smoother than `slopes_pchip` and local too.
    """
    h, d = _steps(points, values)
    parabola = (d[:-1] * h[1:] + d[1:] * h[:-1]) / (h[:-1] + h[1:])
    smallest = jnp.minimum(jnp.minimum(abs(d[:-1]), abs(d[1:])), 0.5 * abs(parabola))
    return _with_ends((jnp.sign(d[:-1]) + jnp.sign(d[1:])) * smallest, h, d, 2.0)


class MonotoneCubic(eqx.Module):
    """Cubic through a table, once differentiable, monotone wherever the table is.

    Parameters
    ----------
    points: increasing abscissae, shape ``(n,)``, at least three.
    values: ordinates, shape ``(n,)``.
    slopes: how the slopes at the points are chosen, `slopes_pchip` or `slopes_steffen`.

    Example:
        >>> curve = MonotoneCubic.through(jnp.array([0.0, 1.0, 2.0]), jnp.array([0.0, 1.0, 8.0]))
        >>> value, inside = curve(0.5)
    """

    points: jax.Array
    values: jax.Array
    slopes: jax.Array

    @classmethod
    def through(
        cls, points: Any, values: Any, slopes: Callable[..., jax.Array] = slopes_pchip
    ) -> "MonotoneCubic":
        """The cubic through a table."""
        points, values = jnp.asarray(points, dtype=float), jnp.asarray(values, dtype=float)
        return cls(points, values, slopes(points, values))

    @at_once()
    def __call__(self, x: Any) -> tuple[jax.Array, jax.Array]:
        """Value, and whether ``x`` lies in the table; shapes of ``x``."""
        x = jnp.asarray(x, dtype=float)
        first, last = self.points[0], self.points[-1]
        inner = jnp.clip(x, first, last)
        i = _interval(inner, self.points)
        t = (inner - self.points[i]) / (self.points[i + 1] - self.points[i])
        beyond = jnp.minimum(x - first, 0.0) * self.slopes[0]
        beyond = beyond + jnp.maximum(x - last, 0.0) * self.slopes[-1]
        return self._cubic(t, i) + beyond, (first <= x) & (x <= last)

    @at_once()
    def derivative(self, x: Any) -> jax.Array:
        """Slope at ``x``, same shape; that of the end outside the table."""
        x = jnp.clip(jnp.asarray(x, dtype=float), self.points[0], self.points[-1])
        i = _interval(x, self.points)
        h = self.points[i + 1] - self.points[i]
        t = (x - self.points[i]) / h
        rise = (self.values[i + 1] - self.values[i]) / h
        a, b = self.slopes[i], self.slopes[i + 1]
        return a + t * (2.0 * (3.0 * rise - 2.0 * a - b) + 3.0 * t * (a + b - 2.0 * rise))

    @at_once()
    def inverse(self, y: Any) -> tuple[jax.Array, jax.Array]:
        """Abscissa of the value ``y``, and whether the table reaches it; shapes of ``y``.

        The table must rise or fall strictly. Outside it the abscissa is that of the nearer end.
        """
        y = jnp.asarray(y, dtype=float)
        sign = jnp.where(self.values[-1] >= self.values[0], 1.0, -1.0)
        ends = jnp.sort(jnp.stack([self.values[0], self.values[-1]]))
        inside = (ends[0] <= y) & (y <= ends[1])
        y = jnp.clip(y, ends[0], ends[1])
        i = _interval(sign * y, sign * self.values)
        secant = safe_divide(y - self.values[i], self.values[i + 1] - self.values[i], 0.5)
        t = find_root(lambda t: self._cubic(t, i) - y, 0.0, 1.0, start=secant).value
        return self.points[i] + t * (self.points[i + 1] - self.points[i]), inside

    def _cubic(self, t: jax.Array, i: jax.Array) -> jax.Array:
        # Exact at both ends of the interval, so that `inverse` always sees a change of sign.
        h = self.points[i + 1] - self.points[i]
        a, b = h * self.slopes[i], h * self.slopes[i + 1]
        w = t * t * (3.0 - 2.0 * t)
        ends = (1.0 - w) * self.values[i] + w * self.values[i + 1]
        return ends + t * (1.0 - t) * (a * (1.0 - t) - b * t)


def _interval(x: jax.Array, points: jax.Array) -> jax.Array:
    return jnp.clip(jnp.searchsorted(points, x, side="right") - 1, 0, points.shape[0] - 2)


def _steps(points: jax.Array, values: jax.Array) -> tuple[jax.Array, jax.Array]:
    h = jnp.diff(points)
    return h, jnp.diff(values) / h


def _with_ends(inner: jax.Array, h: jax.Array, d: jax.Array, most: float) -> jax.Array:
    """Adds the end slopes: the parabola's, of the sign of the end secant and limited by it."""

    def end(h0: jax.Array, h1: jax.Array, d0: jax.Array, d1: jax.Array) -> jax.Array:
        parabola = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1)
        size = jnp.minimum(abs(parabola), most * abs(d0))
        return jnp.where(parabola * d0 > 0, jnp.sign(d0) * size, 0.0)

    first = end(h[0], h[1], d[0], d[1])
    last = end(h[-1], h[-2], d[-1], d[-2])
    return jnp.concatenate([first[None], inner, last[None]])


def falling(at: Any, x: Any, y: Any) -> Any:
    """What was measured at points in any order, straight from one to the next: before the first that of the
    first, beyond the last falling on as between the last two, or level.

    >>> [float(falling(at, [4.0, 2.0], [1.0, 3.0])) for at in (1.0, 3.0, 5.0)]
    [3.0, 2.0, 0.0]
    """
    x, y = jnp.asarray(x, dtype=float), jnp.asarray(y, dtype=float)
    order = jnp.argsort(x)
    x, y = x[order], y[order]
    slope = jnp.minimum(safe_divide(y[-1] - y[-2], x[-1] - x[-2], 0.0), 0.0) if x.size > 1 else 0.0
    return jnp.interp(at, x, y) + slope * jnp.maximum(at - x[-1], 0.0)
