"""Two unknowns of two equations whose signs alone say where the root lies, so that it cannot be lost."""

from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jax import lax

TOLERANCE = 1e-15  # of the last step, relative to the ends
ROUNDING = 1e-12  # residual below which nothing is left to gain
MOST = 100
LATE = 60  # steps after which only halving is trusted
SETTLED = 1e-9  # residual of a root, relative to its scale


class Pair(NamedTuple):
    """Outcome of `crossing_pair`: the root, what the function returned besides, whether it was found, steps, the residual."""

    value: jax.Array
    made: Any
    converged: jax.Array
    steps: jax.Array
    residual: jax.Array


def crossing_pair(
    function: Callable[[jax.Array, Any], tuple[jax.Array, Any, Any]],
    lower: Any,
    upper: Any,
    start: Any,
    help_: Any,
    allowed: Callable[[jax.Array], jax.Array] = lambda x: x,
    most: int = MOST,
) -> Pair:
    """Solve ``function(x, help) = 0`` for two unknowns in a box, by Newton's method kept on course by the signs of the residuals.

    The first residual must rise with the first unknown and fall with the second, the second residual rise with both. Their zero lines
    then cross once, and wherever they are known both signs put the root on one side of one of the unknowns: residuals of one sign bound
    the first unknown, residuals of different signs the second. A Newton step that leaves the box so found, or that neither halves the step before
    nor lowers the residual, gives way to the middle of the box. The number of steps is bounded; ``converged`` judges the residual alone.

    Args:
        function: returns two residuals, scaled to about one; the next ``help``, with which its inner searches may start and which must
            not change the residuals; and anything else that is wanted at the root.
        lower, upper: corners of the box. start: first guess.
        help_: first ``help``.
        allowed: moves a point to where the function has the signs said above, by raising the second unknown alone; the root must be there.

    Returns:
        A `Pair`. Nothing raises. Derivatives with respect to closed-over values follow from the implicit function theorem.

    Example:
        >>> found = crossing_pair(lambda x, h: (jnp.stack([x[0] ** 3 - x[1], x[0] + x[1] - 2.0]), h, ()), [0.0, 0.0], [9.0, 9.0], [8.0, 1.0], None)
        >>> [round(float(v), 9) for v in found.value]
        [1.0, 1.0]
    """
    lower, upper = (lax.stop_gradient(jnp.asarray(v, dtype=float)) for v in (lower, upper))
    size = upper - lower
    start = jnp.clip(lax.stop_gradient(jnp.asarray(start, dtype=float)), lower, upper)
    start = jnp.where(jnp.isfinite(start), start, 0.5 * (lower + upper))
    help_ = lax.stop_gradient(help_)

    traced, given = jax.closure_convert(function, start, help_)  # Python runs the function once; what follows replays its trace

    def lacks(x: jax.Array, known: Any) -> tuple[jax.Array, Any]:
        return traced(x, known, *given)[:2]

    def search(_f: Any, first: jax.Array) -> tuple[jax.Array, Any]:
        def step(carry: tuple) -> tuple:
            x, low, high, last, norm, number, known = carry
            residual, push, known = jax.linearize(lambda x: lacks(x, known), x, has_aux=True)
            (a, b), (c, d) = jax.vmap(push)(jnp.eye(2)).T
            det = a * d - b * c
            move = jnp.stack([d * residual[0] - b * residual[1], a * residual[1] - c * residual[0]]) / jnp.where(det == 0, jnp.nan, det)
            up = residual > 0
            same = up[0] == up[1]
            low = jnp.where(jnp.stack([same & ~up[0], ~same & up[0]]), x, low)
            high = jnp.where(jnp.stack([same & up[0], ~same & ~up[0]]), x, high)
            ahead = x - move
            length, left = jnp.max(abs(move) / size), jnp.max(abs(residual))
            inside = jnp.all((ahead >= low) & (ahead <= high))
            within = jnp.all((ahead >= lower) & (ahead <= upper))
            # where gas and solid are nearly in equilibrium both residuals are nearly one, and signs of the small one may mislead
            good = (inside & (length <= 0.5 * last)) | (within & (left <= jnp.where(inside, 0.8, 0.3) * norm) & (number < LATE))
            following = jnp.where(left <= ROUNDING, x, allowed(jnp.where(good, ahead, 0.5 * (low + high))))
            length = jnp.where(good, length, jnp.max((high - low) / size))
            length = jnp.where(left <= ROUNDING, 0.0, length)
            return following, low, high, length, jnp.where(jnp.isfinite(left), left, jnp.inf), number + 1, known

        def unfinished(carry: tuple) -> Any:
            return (carry[3] > TOLERANCE) & (carry[5] < most)

        first_carry = (allowed(first), lower, upper, jnp.asarray(jnp.inf), jnp.asarray(jnp.inf), jnp.zeros((), int), help_)
        x, _low, _high, _length, _norm, number, known = lax.while_loop(unfinished, step, first_carry)
        return x, (number.astype(x.dtype), known)

    def tangent(linear: Callable[[jax.Array], jax.Array], right: jax.Array) -> jax.Array:
        (a, b), (c, d) = jax.vmap(linear)(jnp.eye(2)).T
        det = a * d - b * c
        return jnp.stack([d * right[0] - b * right[1], a * right[1] - c * right[0]]) / jnp.where(det == 0, jnp.inf, det)

    value, (number, known) = lax.custom_root(lambda x: lacks(x, help_)[0], start, search, tangent, has_aux=True)
    residual, _help, made = traced(value, lax.stop_gradient(known), *given)
    left = lax.stop_gradient(jnp.max(abs(residual)))
    return Pair(value, made, left <= SETTLED, number.astype(int), left)
