"""Roots of functions about which something is known, found with less work than by ``find_root``.

``find_root`` serves every function and pays for it with three stages and both ends evaluated. Where a
function is known to fall through zero between two ends (``falling_root``), to be steep and smooth near a
start (``newton_root``), nearly always so (``likely_root``) or nearly straight (``straight_root``), one Newton
loop compiles three times faster and halves the work.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
from jax import lax

from granum.numerics.implicit import implicit_root
from granum.numerics.roots import divide_by_slope, find_root

TOLERANCE = 1e-7  # of the last Newton step, relative to the unknown: its square, some 1e-13, is what is left
MOST = 120


def falling_root(
    balance: Callable[..., Any],
    lower: Any,
    upper: Any,
    *arguments: Any,
    start: Any = None,
    rough_slope: Callable[[Any], Any] | None = None,
    size: Any = 0.0,
) -> Any:
    """The root of an elementwise function that is positive at ``lower`` and negative at ``upper``, both
    greater than zero unless ``size`` gives the size of an unknown near zero.

    Newton's step where it stays inside the shrinking bracket and at least halves the one before, bisection
    otherwise. Derivatives are exact (implicit function theorem). With ``rough_slope``, a cheap approximate
    derivative, secants take the place of tangents: better for functions that cost much, whose derivative
    would cost as much again.
    """
    lower, upper = (lax.stop_gradient(jnp.asarray(x, dtype=float)) for x in (lower, upper))
    shape = jnp.broadcast_shapes(lower.shape, upper.shape, *(jnp.shape(a) for a in arguments))
    lower, upper = jnp.broadcast_to(lower, shape), jnp.broadcast_to(upper, shape)
    least = lax.stop_gradient(TOLERANCE * jnp.asarray(size, dtype=float))
    guess = 0.5 * (lower + upper)
    if start is not None:
        start = lax.stop_gradient(jnp.broadcast_to(start, shape))
        guess = jnp.where(jnp.isfinite(start), jnp.clip(start, lower, upper), guess)

    def search(f: Callable[..., Any], first: Any) -> Any:
        if rough_slope is not None:
            return _secant(f, rough_slope, first, lower, upper), ()
        return nearly_falling_root(f, lower, upper, first, least), ()

    return implicit_root(lambda x: balance(x, *arguments), guess, search, divide_by_slope)[0]


def nearly_falling_root(f: Callable[[Any], Any], lower: Any, upper: Any, start: Any, least: Any = 0.0) -> Any:
    """The root of ``falling_root`` without derivatives and short of its last Newton step, for those who add
    one themselves; ``least`` is the step that counts as none where the root is near zero.
    """

    def advance(carry: tuple) -> tuple:
        x, low, high, size, count = carry
        value, slope = jax.jvp(f, (x,), (jnp.ones_like(x),))
        low, high = jnp.where(value > 0, x, low), jnp.where(value < 0, x, high)
        ahead = x - value / jnp.where(slope == 0, -1e-300, slope)
        fits = (ahead >= low) & (ahead <= high) & (jnp.abs(ahead - x) <= 0.5 * jnp.abs(size))
        following = jnp.where(fits, ahead, 0.5 * (low + high))
        # bisection leaves its whole interval, so it has to go on until that is a thousand times smaller
        next_size = jnp.where(fits, ahead - x, 1e3 * (high - low))
        moving = jnp.abs(size) > TOLERANCE * jnp.abs(x) + least
        return jnp.where(moving, following, x), low, high, jnp.where(moving, next_size, size), count + 1

    def unfinished(carry: tuple) -> Any:
        x, _low, _high, size, count = carry
        return jnp.any(jnp.abs(size) > TOLERANCE * jnp.abs(x) + least) & (count < MOST)

    return lax.while_loop(unfinished, advance, (start, lower, upper, 4.0 * (upper - lower), 0))[0]


def straight_root(
    function: Callable[[Any], Any], start: Any, steps: int, within: tuple[float, float] | None = None
) -> Any:
    """The root of an elementwise function that is nearly a straight line, by so many Newton steps, kept
    ``within`` two ends. The last step alone carries derivatives.
    """

    def step(x: Any) -> Any:
        value, slope = jax.jvp(function, (x,), (jnp.ones_like(x),))
        ahead = x - value / slope
        return ahead if within is None else jnp.clip(ahead, *within)

    close = lax.fori_loop(
        0, steps - 1, lambda _i, x: lax.stop_gradient(step(x)), lax.stop_gradient(jnp.asarray(start))
    )
    return step(close)


def _secant(
    f: Callable[..., Any], rough_slope: Callable[[Any], Any], first: Any, lower: Any, upper: Any
) -> Any:
    def advance(carry: tuple) -> tuple:
        x, low, high, size, slope, last, before, count = carry
        value = f(x)
        chord = (value - before) / jnp.where(last == 0, 1.0, last)
        # a chord that rises, or none yet, says nothing: keep the last slope
        slope = jnp.where((count > 0) & (chord < 0), chord, slope)
        low, high = jnp.where(value > 0, x, low), jnp.where(value < 0, x, high)
        ahead = x - value / slope
        fits = (ahead >= low) & (ahead <= high) & (jnp.abs(ahead - x) <= 0.5 * jnp.abs(size))
        following = jnp.where(fits, ahead, 0.5 * (low + high))
        next_size = jnp.where(fits, ahead - x, 1e3 * (high - low))
        moving = jnp.abs(size) > TOLERANCE * x
        keep = lambda new, old: jnp.where(moving, new, old)  # noqa: E731
        return (
            keep(following, x),
            low,
            high,
            keep(next_size, size),
            slope,
            keep(following - x, last),
            keep(value, before),
            count + 1,
        )

    def unfinished(carry: tuple) -> Any:
        return jnp.any(jnp.abs(carry[3]) > TOLERANCE * carry[0]) & (carry[7] < MOST)

    zero = jnp.zeros_like(first)
    start = (first, lower, upper, 4.0 * (upper - lower), rough_slope(first), zero, zero, 0)
    return lax.while_loop(unfinished, advance, start)[0]


def newton_root(
    function: Callable[..., Any],
    first: Any,
    passes: int,
    least_slope: float | None = None,
    within: Any = None,
) -> Any:
    """Newton steps on a function known to be smooth and steep near its root, until they are small; implicit
    derivatives.

    ``least_slope`` keeps a slope from falling below it; None for functions that fall. The last step is below
    ``within``, by default a relative 1e-5; what is left is its square times half the ratio of curvature to
    slope.
    """
    if within is not None:
        within = lax.stop_gradient(within)

    def solve(f: Callable[..., Any], first: Any) -> Any:
        def step(carry: tuple) -> tuple:
            x, _largest, count = carry
            value, slope = jax.jvp(f, (x,), (jnp.ones_like(x),))
            move = value / (slope if least_slope is None else jnp.maximum(slope, least_slope))
            allowed = 1e-5 * (jnp.abs(x) + 1e-2) if within is None else within
            return x - move, jnp.max(jnp.abs(move) / allowed), count + 1

        def unfinished(carry: tuple) -> Any:
            return (carry[1] > 1.0) & (carry[2] < passes)

        return lax.while_loop(unfinished, step, (first, jnp.inf, 0))[0], ()

    return implicit_root(function, first, solve, divide_by_slope)[0]


LIKELY_STEPS = 3
SETTLED = 1e-6  # a last Newton step this small leaves an error of its square


def likely_root(equation: Callable[[Any], Any], start: Any, near: float, far: float) -> tuple[Any, Any]:
    """Root of an elementwise rising function from a good start, and whether it was found; exact
    derivatives.

    Three Newton steps serve smooth functions to the last digit. Where one element does not settle, all those
    that did not are bracketed within ``near`` of the start, or within ``far`` where the function has no
    change of sign there.
    """

    def search(f: Callable[[Any], Any], x: Any) -> tuple[Any, Any]:
        guess, step = x, jnp.inf
        for _pass in range(LIKELY_STEPS):
            value, slope = jax.jvp(f, (x,), (jnp.ones_like(x),))
            step = value / slope
            x = x - step
        settled = abs(step) < SETTLED
        return lax.cond(
            jnp.all(settled),
            lambda: (x, jnp.ones_like(x)),
            lambda: _bracketed(f, guess, x, settled, near, far),
        )

    value, found, _equation = implicit_root(equation, start, search, divide_by_slope)
    return value, found > 0.0


def _bracketed(
    f: Callable[[Any], Any], guess: Any, reached: Any, settled: Any, near: float, far: float
) -> tuple[Any, Any]:
    low, high = guess - near, guess + near
    low = jnp.where(f(low) < 0.0, low, guess - far)
    high = jnp.where(f(high) > 0.0, high, guess + far)
    root = find_root(f, low, high, start=guess)
    return jnp.where(settled, reached, root.value), jnp.where(settled | root.converged, 1.0, 0.0)
