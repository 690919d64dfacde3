"""Exact derivatives of what a search finds, by the implicit function theorem; traced only where somebody asks
for them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
from jax import lax
from jax.extend.core import ClosedJaxpr, jaxpr_as_fun
from jax.interpreters.partial_eval import dce_jaxpr

Equation = Callable[[Any], Any]


def implicit_root(
    equation: Equation,
    start: Any,
    search: Callable[[Equation, Any], tuple[Any, Any]],
    tangent: Callable[[Equation, Any], Any],
) -> tuple[Any, Any, Equation]:
    """The ``x`` with ``equation(x) = 0`` that a search finds from a start, what else it gives (as floats,
    without derivatives), and the equation made cheap to trace again.

    Parameters
    ----------
    equation: of a pytree like the start; it may close over traced values, and runs in Python once.
    start: pytree of real arrays; one that the equation broadcasts is broadcast first.
    search: given the equation and the start, the root and a pytree of arrays.
    tangent: given the derivative of the equation along ``x``, a linear function, and a right-hand side, the
        change that gives it.

    Derivatives with respect to closed-over values are exact at any order, forward and reverse.

    >>> root, _more, _equation = implicit_root(
    ...     lambda x: x * x - 4.0, jnp.ones(()), lambda f, x: (x + 1.0, ()), lambda linear, right: right
    ... )
    >>> root
    Array(2., dtype=float64)
    """
    start = lax.stop_gradient(start)
    balance, given, image = converted(equation, start)
    if isinstance(start, jax.Array) and image.shape != start.shape:
        start = jnp.broadcast_to(start, jnp.broadcast_shapes(start.shape, image.shape))
        balance, given, image = converted(equation, start)

    def searched(given: list[Any], start: Any) -> tuple[Any, Any]:
        root, more = search(lambda x: balance(given, x), start)
        # counts and flags have no derivatives, and derivatives are handed on for floats alone
        return root, jax.tree.map(lambda leaf: jnp.asarray(leaf).astype(float), more)

    # nothing may be closed over by what is differentiated later, when this call has returned
    sought, limits, _image = converted(searched, given, start)

    @jax.custom_jvp
    def found(given: list[Any], limits: list[Any], start: Any) -> tuple[Any, Any]:
        return sought(limits, given, start)

    @found.defjvp
    def _derivative(primals: Any, tangents: Any) -> Any:
        given, limits, start = primals
        root, more = found(given, limits, start)
        _value, pushed = jax.jvp(lambda g: balance(g, root), (given,), (tangents[0],))
        _value, linear = jax.linearize(lambda x: balance(given, x), root)
        right = jax.tree.map(jnp.negative, pushed)
        return (root, more), (tangent(linear, right), jax.tree.map(jnp.zeros_like, more))

    root, more = found(given, limits, start)
    return root, lax.stop_gradient(more), lambda x: balance(given, x)


def converted(function: Callable[..., Any], *like: Any) -> tuple[Callable[..., Any], list[Any], Any]:
    """The function, traced, with all it closes over as its first argument; that; and the shapes of its
    result.
    """
    closed, image = jax.make_jaxpr(function, return_shape=True)(*like)
    # what nobody asks for would be differentiated all the same
    jaxpr, tree = dce_jaxpr(closed.jaxpr, True, True)[0], jax.tree.structure(image)

    @jax.jit
    def replayed(closed_over: list[Any], *given: Any) -> Any:
        leaves = jaxpr_as_fun(ClosedJaxpr(jaxpr, closed_over))(*jax.tree.leaves(given))
        return jax.tree.unflatten(tree, leaves)

    return replayed, closed.consts, image
