"""Roots of elementwise scalar equations, bracketed so that none is lost."""

from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jax import lax

from granum.numerics.implicit import implicit_root

FAST_STEPS = 16
GUARDED_STEPS = 56
OPEN = 2
LARGE = 4096
"""From this many elements on, a lean first stage saves memory traffic; below, one loop saves half the
compilation.
"""


class Root(NamedTuple):
    """Outcome of `find_root`; the arrays have the broadcast shape of the problem.

    value: the root; NaN where the bracket shows no sign change.
    converged: True where the root is known to the tolerance asked for.
    steps: number of passes over the whole array (scalar integer).
    residual: the function at `value`.
    """

    value: jax.Array
    converged: jax.Array
    steps: jax.Array
    residual: jax.Array


def find_root(
    function: Callable[..., Any],
    lower: Any,
    upper: Any,
    *args: Any,
    start: Any = None,
    tolerance: float = 1e-10,
    max_steps: int = 128,
) -> Root:
    """Solve ``function(x, *args) = 0`` for each element, within ``[lower, upper]``.

    Newton's method first, its result confirmed by a change of sign around it. Elements where a step
    leaves the bracket, or is not half the one before, go on with Newton's method in a shrinking
    bracket, bisecting instead of such steps. Those still open after 56 passes are finished by
    halving the set of floating-point numbers between the ends, which takes 66 passes at most: with
    the default ``max_steps`` a sign change is always found, however nasty the function.

    Parameters
    ----------
    function: elementwise; ``function(x, *args)[i]`` may depend on ``x[i]`` only. It may close
        over traced values.
    lower, upper: finite ends, any broadcastable shapes, in either order. The function may be
        infinite there, and a root exactly at an end is found.
    *args: pytrees of arrays that broadcast with the ends.
    start: first guess; the middle of the bracket where it is not given or lies outside.
    tolerance: the function changes sign within this distance of the root, relative to ``|x|``;
        in a bracket that contains zero, relative to its nearer end at least.
    max_steps: most passes over the array.

    Returns
    -------
    A `Root`. Nothing raises: without a sign change (or with a NaN function) the value is NaN
    and ``converged`` False; a sign change through a pole, and an element that ran out of
    passes, keep their last iterate with ``converged`` False.

    Derivatives with respect to the arguments and to closed-over values are exact at any order,
    forward and reverse (implicit function theorem). Where the slope of the function at the root is
    zero they are zero, as they are at NaN values. Compile the caller with `jax.jit`.

    Example:
        >>> root = find_root(lambda x, a: x**2 - a, 0.0, 10.0, jnp.array([4.0, 9.0]))
        >>> root.value
        Array([2., 3.], dtype=float64)
    """
    lower, upper = (lax.stop_gradient(jnp.asarray(end, dtype=float)) for end in (lower, upper))
    guess = lax.stop_gradient(jnp.asarray(jnp.nan if start is None else start, dtype=float))
    sizes = (lower.shape, upper.shape, guess.shape, *map(jnp.shape, jax.tree.leaves(args)))

    def equation(x: jax.Array) -> jax.Array:
        return jnp.asarray(function(x, *args), dtype=x.dtype)

    def search(f: Callable, initial: jax.Array) -> tuple[jax.Array, tuple]:
        return _search(f, lower, upper, initial, tolerance, max_steps)

    value, (status, steps), again = implicit_root(
        equation, jnp.broadcast_to(guess, jnp.broadcast_shapes(*sizes)), search, divide_by_slope
    )
    value = jnp.where(status >= 0, value, jnp.nan)
    return Root(value, status > 0, steps.astype(int), lax.stop_gradient(again(value)))


def divide_by_slope(linear: Callable, right: jax.Array) -> jax.Array:
    """Derivative of a root from that of its equation; zero where the equation has no slope."""
    slope = linear(jnp.ones_like(right))
    usable = jnp.isfinite(slope) & (slope != 0)
    return right / jnp.where(usable, slope, jnp.inf)


def _search(
    f: Callable, lower: jax.Array, upper: jax.Array, guess: jax.Array, tolerance: float, most: int
) -> tuple[jax.Array, tuple]:
    """Roots, with status 1 found, 0 kept but not found, -1 no root; and the number of passes."""
    width = (tolerance, jnp.minimum(abs(lower), abs(upper)))
    lower, upper = jnp.broadcast_to(lower, guess.shape), jnp.broadcast_to(upper, guess.shape)
    # the ends are the first two passes of the one loop, so that the function is compiled once
    if guess.size < LARGE:
        nothing = jnp.zeros_like(guess)
        carry = (
            lower,
            lower,
            upper,
            nothing,
            nothing,
            jnp.full(guess.shape, OPEN, jnp.int8),
            jnp.zeros((), guess.dtype),
        )
        x, status, steps = _safe(f, lower, upper, guess, carry, width, most)
        return x, (status.astype(x.dtype), steps)
    ends = jax.vmap(f)(jnp.stack([lower, upper]))
    x, status, below, above = _bracketed(lower, upper, ends[0], ends[1], guess)
    crossing = status == OPEN
    x, lost, steps = _newton(f, lower, upper, x, crossing, width, min(FAST_STEPS, most))
    slack = _slack(x, width)
    # A small step is no proof: the function may turn away within it.
    low, high = jnp.minimum(lower, upper), jnp.maximum(lower, upper)
    around = jnp.sign(jax.vmap(f)(jnp.clip(jnp.stack([x - slack, x + slack]), low, high)))
    failed = lost | (crossing & ~(around[0] * around[1] <= 0))
    status = jnp.where(failed, OPEN, jnp.where(crossing, 1, status)).astype(jnp.int8)
    ceiling = jnp.maximum(abs(ends[0]), abs(ends[1]))

    def again(x: jax.Array, status: jax.Array, steps: jax.Array) -> tuple:
        return _safe(
            f,
            lower,
            upper,
            guess,
            (x, below, above, ceiling, abs(upper - lower), status, steps + 2),
            width,
            most,
        )

    x, status, steps = lax.cond(jnp.any(failed), again, lambda *found: found, *(x, status, steps))
    return x, (status.astype(x.dtype), steps)


def _bracketed(
    lower: jax.Array, upper: jax.Array, first: jax.Array, second: jax.Array, guess: jax.Array
) -> tuple:
    """Where to start, the status so far, and the ends where the function is below and above zero."""
    at_lower, at_upper = first == 0, second == 0
    # A product of the two would underflow to zero.
    crossing = jnp.where(first < 0, second > 0, (first > 0) & (second < 0))
    crossing = crossing & jnp.isfinite(lower) & jnp.isfinite(upper)
    inside = (guess - lower) * (guess - upper) < 0
    x = jnp.where(inside, guess, _middle(lower, upper))
    x = jnp.where(at_lower, lower, jnp.where(at_upper, upper, x))
    status = jnp.where(at_lower | at_upper, 1, jnp.where(crossing, OPEN, -1)).astype(jnp.int8)
    return x, status, jnp.where(first < 0, lower, upper), jnp.where(first < 0, upper, lower)


def _newton(f, lower, upper, x, wanted, width, most) -> tuple:
    """Newton's method while its steps halve and stay between the ends; which elements it lost.

    It carries only the unknown and its last step (0 when done, infinite when lost), because on
    large arrays moving memory costs more than the function.
    """

    def advance(carry: tuple) -> tuple:
        x, size, steps = carry
        y, slope = jax.jvp(f, (x,), (jnp.ones_like(x),))
        ahead = x - y / slope
        step = abs(ahead - x)
        halved = (step <= 0.5 * size) & (abs(slope) < jnp.inf)
        good = halved & ((ahead - lower) * (ahead - upper) <= 0)
        next_size = jnp.where(good, jnp.where(step <= _slack(ahead, width), 0.0, step), jnp.inf)
        moving = (size > 0) & (size < jnp.inf)
        return (
            jnp.where(moving & good, ahead, x),
            jnp.where(moving, next_size, size),
            steps + 1,
        )

    def unfinished(carry: tuple) -> jax.Array:
        _, size, steps = carry
        return jnp.any((size > 0) & (size < jnp.inf)) & (steps < most)

    size = jnp.where(wanted, abs(upper - lower), 0.0)
    x, size, steps = lax.while_loop(unfinished, advance, (x, size, jnp.zeros((), x.dtype)))
    return x, size > 0, steps


def _safe(f, lower, upper, guess, carry, width, most) -> tuple:
    """Newton or bisection in a shrinking bracket; in the end, bisection of the numbers themselves.

    Passes 0 and 1 evaluate the ends; a carry that knows them starts at 2. It ends only when the bracket
    itself is narrow. Newton's method comes from one side and would leave the other end where it is, so its
    small steps go a little too far on purpose.
    """

    def advance(carry: tuple) -> tuple:
        x = carry[0]
        y, slope = jax.jvp(f, (x,), (jnp.ones_like(x),))
        return _moved(carry, y, slope, (lower, upper, guess), width)

    def unfinished(carry: tuple) -> jax.Array:
        return jnp.any(carry[5] == OPEN) & (carry[6] < most + 2)

    x, _, _, _, _, status, steps = lax.while_loop(unfinished, advance, carry)
    return x, jnp.where(status == OPEN, 0, status).astype(jnp.int8), steps - 2


@jax.jit
def _moved(carry: tuple, y: Any, slope: Any, given: tuple, width: tuple) -> tuple:
    """A carry of `_safe` one pass on: apart, so that it is traced once for all equations of a shape."""
    lower, upper, guess = given
    x, below, above, ceiling, size, status, steps = carry
    low, high = jnp.where(y < 0, x, below), jnp.where(y > 0, x, above)
    ahead = x - y / slope
    slack = _slack(ahead, width)
    within = ((ahead - low) * (ahead - high) <= 0) & (abs(slope) < jnp.inf)
    late = steps >= GUARDED_STEPS + 2
    middle = jnp.where(late, _middle_number(low, high), _middle(low, high))
    narrow = abs(high - low) <= 2.0 * _slack(middle, width)
    fast = within & (narrow | ((abs(ahead - x) <= 0.5 * size) & ~late))
    step = ahead - x
    # a step may round to nothing, so its own sign is not asked
    across = jnp.sign(jnp.where(y < 0, high, low) - x)
    beyond = ahead + across * 0.5 * slack
    overshoot = ~narrow & (abs(step) <= slack) & ((beyond - low) * (beyond - high) < 0)
    following = jnp.where(fast, jnp.where(overshoot, beyond, ahead), middle)
    exhausted = ~fast & ((middle == low) | (middle == high))
    result = _judged(y, narrow | exhausted, ceiling)
    going = status == OPEN
    onward = (
        jnp.where(going & (y != 0), following, x),
        jnp.where(going, low, below),
        jnp.where(going, high, above),
        ceiling,
        abs(following - x),
        jnp.where(going, result, status),
    )
    # At the first end `ceiling` keeps the value there for the second.
    start, begun, under, over = _bracketed(lower, upper, ceiling, y, guess)
    first_end = (upper, below, above, y, size, status)
    second_end = (start, under, over, jnp.maximum(abs(ceiling), abs(y)), abs(upper - lower), begun)
    chosen = tuple(
        jnp.where(steps == 0, a, jnp.where(steps == 1, b, c))
        for a, b, c in zip(first_end, second_end, onward, strict=True)
    )
    return *chosen, steps + 1


def _slack(x: jax.Array, width: tuple) -> jax.Array:
    tolerance, floor = width
    return tolerance * jnp.maximum(abs(x), floor)


def _judged(y: jax.Array, small: jax.Array, ceiling: jax.Array) -> jax.Array:
    # A pole changes sign too, but the function grows towards it.
    closed = jnp.where(abs(y) <= ceiling, 1, 0)
    result = jnp.where(y == 0, 1, jnp.where(small, closed, OPEN))
    return jnp.where(jnp.isnan(y), -1, result).astype(jnp.int8)


def _middle(first: jax.Array, second: jax.Array) -> jax.Array:
    """Arithmetic mean, or geometric where both ends have one sign and differ eightfold."""
    small, large = jnp.minimum(abs(first), abs(second)), jnp.maximum(abs(first), abs(second))
    wide = (first * second > 0) & (large > 8 * small)
    mean = jnp.sign(first) * jnp.sqrt(small) * jnp.sqrt(large)
    return jnp.where(wide, mean, 0.5 * first + 0.5 * second)


def _middle_number(first: jax.Array, second: jax.Array) -> jax.Array:
    """The number with as many floating-point numbers on one side as on the other.

    The bit patterns of numbers of one sign are ordered as the numbers are; zero splits the signs.
    """
    sign = jnp.where(first == 0, second, first)
    integer = jnp.int64 if first.dtype == jnp.float64 else jnp.int32
    a, b = (lax.bitcast_convert_type(jnp.copysign(end, sign), integer) for end in (first, second))
    between = lax.bitcast_convert_type(a + (b - a) // 2, first.dtype)
    return jnp.where(jnp.sign(first) * jnp.sign(second) < 0, 0.0, between)
