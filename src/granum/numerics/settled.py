"""Fixed points of large functions that make further results on the way, such as one pass through a
flowsheet.
"""

import math
from collections.abc import Callable
from itertools import accumulate
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jax import lax

from granum.numerics.chords import Chords
from granum.numerics.continuation import Continuation
from granum.numerics.fixed_points import Anderson, as_real, chosen, solve_linear, within_rounding
from granum.numerics.implicit import converted
from granum.numerics.seeking import Seeking

Method = Anderson | Seeking | Continuation | Chords


class Settled(NamedTuple):
    """Outcome of `settle`: as for `fixed_point`, with what else the function made at the state, and all that
    the iteration knows, to go on from there.
    """

    state: jax.Array
    made: Any
    converged: jax.Array
    steps: jax.Array
    residual: jax.Array
    known: jax.Array | None = None


class Turns(NamedTuple):
    """What may change the state between two passes of an iteration, as when a switch in it is thrown.

    begin: what is remembered of a start, a tree of arrays. watched: which array of what a pass makes is
    looked at. after: from what is remembered, and the state of the last pass with its residual and that
    array: what is remembered from now on, whether to turn, and the state from which the iteration then begins
    anew. Passes that only measure slopes are not told.
    """

    begin: Callable[[jax.Array], Any]
    watched: Callable[[Any], Any]
    after: Callable[[Any, jax.Array, jax.Array, jax.Array], tuple[Any, jax.Array, jax.Array]]


def settle(
    function: Callable[[jax.Array], tuple[jax.Array, Any]],
    start: jax.Array,
    *,
    method: Method = Anderson(),
    tolerance: float = 1e-10,
    max_steps: int = 200,
    known: jax.Array | None = None,
    turns: Turns | None = None,
) -> Settled:
    """Solve ``function(state)[0] == state`` for a vector scaled to about one; ``function`` makes further
    results on the way.

    The function is run once in Python and stands once in the compiled code, so that a large one compiles
    fast; with ``Continuation`` its derivative stands there too. Derivatives with respect to closed-over
    values follow from the implicit function theorem, forward and reverse, for the state and what is made.

    ``known``, of an earlier outcome, goes on where that was left, ``max_steps`` counting from the beginning;
    zeros (``knowledge`` says how many) begin. Of a function that never gives a number, what the first pass
    made is kept: it shows where the numbers were lost. ``turns`` may change the state on the way.

    Example:
        >>> found = settle(lambda x: (jnp.cos(x), {"sine": jnp.sin(x)}), jnp.array([1.0]))
        >>> found.state, found.made["sine"]
        (Array([0.73908513], dtype=float64), Array([0.67361203], dtype=float64))
    """
    start = lax.stop_gradient(as_real(start))
    shape: list[Any] = []

    def flat(state: jax.Array) -> tuple[jax.Array, jax.Array]:
        image, made = function(state)
        leaves, tree = jax.tree.flatten(made)
        leaves = [jnp.asarray(leaf) for leaf in leaves]
        shape[:] = [tree, [(leaf.shape, leaf.dtype) for leaf in leaves]]
        # One vector: each array that a loop carries costs as much compilation as a formula.
        return image, jnp.concatenate(
            [jnp.ravel(leaf).astype(start.dtype) for leaf in leaves] or [jnp.zeros((0,), start.dtype)]
        )

    traced, given, _image = converted(flat, start)
    tree, kinds = shape

    ends = list(accumulate(math.prod(size) for size, _ in kinds))
    # of all that is made one array: each that is opened costs an operation in every pass
    seen: int = 0 if turns is None else turns.watched(jax.tree.unflatten(tree, range(len(kinds))))

    def searched(given: Any, start: jax.Array) -> tuple:
        def advance(carry: tuple) -> tuple:
            iteration, turning, kept = carry
            x = iteration[0]
            if isinstance(method, Continuation):
                image, linear, made = jax.linearize(lambda x: traced(given, x), x, has_aux=True)
                following = method.proceed(iteration, image - x, lambda v: linear(v) - v)
            else:
                image, made = traced(given, x)
                following = method.proceed(iteration, image - x)
            better = (following[1][1] < iteration[1][1]) | (iteration[-1] == 0)
            kept = jnp.where(better, made, kept)
            if turns is None:
                return following, turning, kept
            memory, before = turning
            plain = method.moves(iteration)
            watched = made[ends[seen] - math.prod(kinds[seen][0]) : ends[seen]].reshape(kinds[seen][0])
            onward = turns.after(memory, x, image - x, watched)
            memory, turned, onward = chosen(plain, onward[0], memory), plain & onward[1], onward[2]
            before = before + jnp.where(turned, following[-1], 0)
            return chosen(turned, method.begin(onward), following), (memory, before), kept

        def unfinished(carry: tuple) -> jax.Array:
            iteration, turning, _ = carry
            x, size = iteration[1]
            unsettled = (size > within_rounding(x, tolerance)) & (_passes(iteration, turning) < max_steps)
            return unsettled & method.hopes(iteration)

        blank = jnp.full((sum(math.prod(size) for size, _ in kinds),), jnp.nan, start.dtype)
        begun = method.begin(start), _turning(turns, start)
        iteration, turning, made = lax.while_loop(
            unfinished, advance, (*_resumed(begun, known, method, tolerance), blank)
        )
        (x, size), number = iteration[1], _passes(iteration, turning)
        return x, made, size, number.astype(x.dtype), _packed((iteration, turning))

    # nothing may be closed over by what is differentiated later, when this call has returned
    sought, limits, _image = converted(searched, given, start)

    @jax.custom_jvp
    def search(given: Any, limits: Any, start: jax.Array) -> tuple:
        return sought(limits, given, start)

    @search.defjvp
    def _derivative(primals: tuple, tangents: tuple) -> tuple:
        given, limits, start = primals
        x, made, *numbers = search(given, limits, start)
        _, pushed = jax.jvp(lambda g: traced(g, x), (given,), (tangents[0],))
        _, linear = jax.linearize(lambda x: traced(given, x), x)
        change = solve_linear(lambda v: v - linear(v)[0], pushed[0])
        along = pushed[1] + linear(change)[1]
        return (x, made, *numbers), (change, along, *map(jnp.zeros_like, numbers))

    x, packed, size, number, left = search(given, limits, start)
    leaves = [
        part.reshape(size).astype(kind)
        for part, (size, kind) in zip(jnp.split(packed, ends[:-1]), kinds, strict=False)
    ]
    made = jax.tree.unflatten(tree, leaves)
    size = lax.stop_gradient(size)
    converged = size <= within_rounding(x, tolerance)
    return Settled(x, made, converged, number.astype(int), size, lax.stop_gradient(left))


def knowledge(method: Method, size: int, turns: Turns | None = None) -> int:
    """How many numbers an iteration over so many unknowns knows."""
    shapes = jax.eval_shape(
        lambda start: (method.begin(start), _turning(turns, start)), jax.ShapeDtypeStruct((size,), float)
    )
    return 1 + sum(leaf.size for leaf in jax.tree.leaves(shapes))


def again(method: Chords, known: jax.Array, size: int, turns: Turns | None = None) -> jax.Array:
    """What ``known`` of one outcome is to begin a neighbor with."""
    begun = method.begin(jnp.zeros((size,))), _turning(turns, jnp.zeros((size,)))
    iteration, _turned = _resumed(begun, known, method, 0.0)
    return _packed((method.again(iteration), _turning(turns, iteration[1][0])))


def _turning(turns: Turns | None, start: jax.Array) -> tuple:
    """What is remembered between turns, and the passes before the last one."""
    return () if turns is None else (turns.begin(start), jnp.zeros((), int))


def _passes(iteration: tuple, turning: tuple) -> jax.Array:
    return iteration[-1] + (turning[1] if turning else 0)


def _packed(known: tuple) -> jax.Array:
    leaves = (jnp.ravel(leaf).astype(float) for leaf in jax.tree.leaves(known))
    return jnp.concatenate([jnp.ones((1,)), *leaves])


def _resumed(begun: tuple, known: jax.Array | None, method: Method, tolerance: float) -> tuple:
    """The iteration as it was left, but for what its best point made, which the next one makes anew. One that
    had come to rest is not held to that: upstream of it something may have moved a little.
    """
    if known is None:
        return begun
    leaves, tree = jax.tree.flatten(begun)
    ends = list(accumulate(leaf.size for leaf in leaves))
    parts = jnp.split(known[1:], ends[:-1])
    left = [part.reshape(leaf.shape).astype(leaf.dtype) for part, leaf in zip(parts, leaves, strict=True)]
    (x, (best, _size), *others), turning = jax.tree.unflatten(tree, left)
    again = method.resumed((x, (best, jnp.full_like(_size, jnp.inf)), *others), tolerance), turning
    return jax.tree.map(lambda old, new: jnp.where(known[0] > 0, old, new), again, begun)
