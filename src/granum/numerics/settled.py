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

from granum.numerics.fixed_points import Anderson, as_real, solve_linear, within_rounding
from granum.numerics.implicit import converted
from granum.numerics.seeking import Seeking


class Settled(NamedTuple):
    """Outcome of `settle`: as for `fixed_point`, with what else the function made at the state."""

    state: jax.Array
    made: Any
    converged: jax.Array
    steps: jax.Array
    residual: jax.Array


def settle(
    function: Callable[[jax.Array], tuple[jax.Array, Any]],
    start: jax.Array,
    *,
    method: Anderson | Seeking = Anderson(),
    tolerance: float = 1e-10,
    max_steps: int = 200,
    watch: Callable[[jax.Array, jax.Array], jax.Array] | None = None,
) -> Settled:
    """Solve ``function(state)[0] == state`` for a vector scaled to about one; ``function`` makes further
    results on the way.

    The function is run once in Python and stands once in the compiled code, so that a large one compiles
    fast. Derivatives with respect to closed-over values follow from the implicit function theorem, forward
    and reverse, for the state and what is made.

    ``watch`` is called with the number of each pass and the best residual so far and says whether to stop. Of
    a function that never gives a number, what the first pass made is kept: it shows where the numbers were
    lost.

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

    def searched(given: Any, start: jax.Array) -> tuple:
        def advance(carry: tuple) -> tuple:
            iteration, kept, _ = carry
            image, made = traced(given, iteration[0])
            following = method.proceed(iteration, image - iteration[0])
            better = (following[1][1] < iteration[1][1]) | (iteration[-1] == 0)
            stop = jnp.asarray(False) if watch is None else watch(following[-1], following[1][1])
            return following, jnp.where(better, made, kept), stop

        def unfinished(carry: tuple) -> jax.Array:
            iteration, _, stop = carry
            x, size = iteration[1]
            unsettled = (size > within_rounding(x, tolerance)) & (iteration[-1] < max_steps)
            return unsettled & method.hopes(iteration) & ~stop

        blank = jnp.full((sum(math.prod(size) for size, _ in kinds),), jnp.nan, start.dtype)
        iteration, made, _ = lax.while_loop(
            unfinished, advance, (method.begin(start), blank, jnp.asarray(False))
        )
        (x, size), number = iteration[1], iteration[-1]
        return x, made, size, number.astype(x.dtype)

    # nothing may be closed over by what is differentiated later, when this call has returned
    sought, limits, _image = converted(searched, given, start)

    @jax.custom_jvp
    def search(given: Any, limits: Any, start: jax.Array) -> tuple:
        return sought(limits, given, start)

    @search.defjvp
    def _derivative(primals: tuple, tangents: tuple) -> tuple:
        given, limits, start = primals
        x, made, size, number = search(given, limits, start)
        _, pushed = jax.jvp(lambda g: traced(g, x), (given,), (tangents[0],))
        _, linear = jax.linearize(lambda x: traced(given, x), x)
        change = solve_linear(lambda v: v - linear(v)[0], pushed[0])
        along = pushed[1] + linear(change)[1]
        return (x, made, size, number), (change, along, jnp.zeros_like(size), jnp.zeros_like(number))

    x, packed, size, number = search(given, limits, start)
    parts = jnp.split(packed, list(accumulate(math.prod(size) for size, _ in kinds))[:-1])
    made = jax.tree.unflatten(
        tree, [part.reshape(size).astype(kind) for part, (size, kind) in zip(parts, kinds, strict=False)]
    )
    size = lax.stop_gradient(size)
    return Settled(x, made, size <= within_rounding(x, tolerance), number.astype(int), size)
