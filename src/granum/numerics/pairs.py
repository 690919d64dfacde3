"""Two unknowns of two equations whose signs alone say where the root lies, so that it cannot be lost."""

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jax import lax

TOLERANCE = 1e-15  # of the last step, relative to the ends
ROUNDING = 1e-12  # residual below which nothing is left to gain
MOST = 100
LATE = 60  # steps after which only halving is trusted
SETTLED = 1e-9  # residual of a root, relative to its scale
NEIGHBOR = 1e-7  # distance for slopes, relative to the box


class Pair(NamedTuple):
    """Outcome of `crossing_pair`: the root, what the function returned besides, whether it was found, steps,
    the residual.
    """

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
    """Solve ``function(x, help) = 0`` for two unknowns in a box, by Newton's method kept on course by the
    signs of the residuals.

    The first residual must rise with the first unknown and fall with the second, the second residual rise
    with both. Their zero lines then cross once, and wherever they are known both signs put the root on one
    side of one of the unknowns: residuals of one sign bound the first unknown, residuals of different signs
    the second. A Newton step that leaves the box so found, or that neither halves the step before nor lowers
    the residual, gives way to the middle of the box. The number of steps is bounded; ``converged`` judges the
    residual alone.

    Parameters
    ----------
    function: returns two residuals, scaled to about one; the next ``help``, with which its inner searches may
        start and which must not change the residuals; and anything else that is wanted at the root.
    lower, upper: corners of the box. start: first guess.
    help_: first ``help``.
    allowed: moves a point to where the function has the signs said above, by raising the second unknown
        alone; the root must be there.

    Returns
    -------
    A `Pair`. Nothing raises. Derivatives with respect to closed-over values follow from the implicit function
        theorem.

    Example:
        >>> found = crossing_pair(
        ...     lambda x, h: (jnp.stack([x[0] ** 3 - x[1], x[0] + x[1] - 2.0]), h, ()),
        ...     [0.0, 0.0],
        ...     [9.0, 9.0],
        ...     [8.0, 1.0],
        ...     None,
        ... )
        >>> [round(float(v), 9) for v in found.value]
        [1.0, 1.0]
    """
    lower, upper = (lax.stop_gradient(jnp.asarray(v, dtype=float)) for v in (lower, upper))
    start = jnp.clip(lax.stop_gradient(jnp.asarray(start, dtype=float)), lower, upper)
    start = jnp.where(jnp.isfinite(start), start, 0.5 * (lower + upper))
    help_ = lax.stop_gradient(help_)
    # Python runs the function once; what follows replays its trace
    traced, given = jax.closure_convert(function, start, help_)
    moved, allowing = jax.closure_convert(lambda x: allowed(x), start)  # a bound method cannot be hashed
    value, made, residual, number, _known = _crossing(
        traced, moved, most, given, lax.stop_gradient(allowing), lower, upper, start, help_
    )
    left = lax.stop_gradient(jnp.max(abs(residual)))
    return Pair(value, made, left <= SETTLED, lax.stop_gradient(number).astype(int), left)


@partial(jax.custom_jvp, nondiff_argnums=(0, 1, 2))
def _crossing(
    function: Any,
    allowed: Any,
    most: int,
    given: Any,
    allowing: Any,
    lower: Any,
    upper: Any,
    start: Any,
    help_: Any,
) -> tuple:
    """The best point evaluated, what was made there, the residuals, the number of steps, the help.

    The function stands in the compiled code once: the slopes are differences with neighbors that are
    evaluated together with the point.
    """
    size = upper - lower
    aside = NEIGHBOR * jnp.diag(jnp.stack([-size[0], size[1]]))  # as ``allowed`` moves

    def around(x: jax.Array, known: Any) -> tuple[jax.Array, jax.Array, Any, Any]:
        points = x + jnp.concatenate([jnp.zeros((1, 2)), aside])
        residuals, *others = jax.vmap(lambda x: function(x, known, *given))(points)
        known, made = jax.tree.map(lambda v: v[0], others)
        return residuals[0], (residuals[1:] - residuals[0]).T / jnp.diag(aside), known, made

    def step(carry: tuple) -> tuple:
        x, low, high, last, norm, number, known, best = carry
        residual, matrix, known, made = around(x, known)
        move = _divided(matrix, residual, jnp.nan)
        up = residual > 0
        same = up[0] == up[1]
        low = jnp.where(jnp.stack([same & ~up[0], ~same & up[0]]), x, low)
        high = jnp.where(jnp.stack([same & up[0], ~same & ~up[0]]), x, high)
        ahead = x - move
        length, left = jnp.max(abs(move) / size), jnp.max(abs(residual))
        left = jnp.where(jnp.isfinite(left), left, jnp.inf)
        inside = jnp.all((ahead >= low) & (ahead <= high))
        within = jnp.all((ahead >= lower) & (ahead <= upper))
        # where gas and solid are nearly in equilibrium both residuals are nearly one, and signs of the small
        # one may mislead
        good = (inside & (length <= 0.5 * last)) | (
            within & (left <= jnp.where(inside, 0.8, 0.3) * norm) & (number < LATE)
        )
        following = allowed(jnp.where(good, ahead, 0.5 * (low + high)), *allowing)
        length = jnp.where(good, length, jnp.max((high - low) / size))
        length = jnp.where(left <= ROUNDING, 0.0, length)
        better = left <= jnp.max(abs(best[2]))
        best = jax.tree.map(lambda new, old: jnp.where(better, new, old), (x, made, residual, known), best)
        return following, low, high, length, left, number + 1, known, best

    def unfinished(carry: tuple) -> Any:
        return (carry[3] > TOLERANCE) & (carry[5] < most)

    _residual, _next, made = jax.eval_shape(lambda x, h: function(x, h, *given), start, help_)
    nothing = jax.tree.map(lambda v: jnp.zeros(v.shape, v.dtype), made)
    first = allowed(start, *allowing)
    best = (first, nothing, jnp.full(2, jnp.inf), help_)
    carry = (first, lower, upper, jnp.asarray(jnp.inf), jnp.asarray(jnp.inf), jnp.zeros((), int), help_, best)
    *_rest, number, _known, (x, made, residual, known) = lax.while_loop(unfinished, step, carry)
    return x, made, residual, number.astype(x.dtype), known


@_crossing.defjvp
def _turned(function: Any, allowed: Any, most: int, primals: tuple, tangents: tuple) -> tuple:
    """Implicit function theorem."""
    found = _crossing(function, allowed, most, *primals)
    x, _made, residual, number, known = found
    given, turned = primals[0], tangents[0]

    def outcome(x: jax.Array, given: Any) -> tuple[jax.Array, Any]:
        residual, _help, made = function(x, lax.stop_gradient(known), *given)
        return residual, made

    push = jax.linearize(outcome, x, given)[1]
    still = jax.tree.map(jnp.zeros_like, turned)
    matrix = jax.vmap(lambda e: push(e, still)[0])(jnp.eye(2)).T
    move = -_divided(matrix, push(jnp.zeros(2), turned)[0], jnp.inf)
    flat = jax.tree.map(jnp.zeros_like, (residual, number, known))
    return found, (move, push(move, turned)[1], *flat)


def _divided(matrix: jax.Array, right: jax.Array, singular: float) -> jax.Array:
    (a, b), (c, d) = matrix
    det = a * d - b * c
    return jnp.stack([d * right[0] - b * right[1], a * right[1] - c * right[0]]) / jnp.where(
        det == 0, singular, det
    )
