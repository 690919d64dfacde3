"""Chains of cells: systems in which each cell sees itself and its two neighbors, steady or in time, by block-tridiagonal elimination."""

from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jax import lax

GROWTH, CAUTION = 4.0, 0.2  # of the pseudo time step after a good and after a bad step
GAMMA = 1.0 + 0.5**0.5  # of the two-stage Rosenbrock method: L-stable, and never beyond the end of a jump in its first stage

Field = Callable[[jax.Array], jax.Array]


class ChainSolution(NamedTuple):
    """Outcome of `solve_chain`.

    state: shape ``(cells, unknowns)``; the last iterate where it did not converge.
    converged: True if the scaled residual is within the tolerance.
    steps: number of steps. residual: largest scaled residual.
    """

    state: jax.Array
    converged: jax.Array
    steps: jax.Array
    residual: jax.Array


def chain_blocks(function: Field, state: Any) -> tuple[jax.Array, jax.Array, jax.Array]:
    """Derivatives of each cell's equations by the cell before, by its own state and by the cell after, each ``(cells, equations, unknowns)``.

    Every third cell is disturbed at once, so that three directional derivatives for each unknown of a cell give the whole Jacobian.

    Example:
        >>> before, own, after = chain_blocks(lambda u: u - 0.5 * jnp.roll(u, 1, 0).at[0].set(0.0), jnp.zeros((4, 1)))
        >>> before[:, 0, 0]
        Array([ 0. , -0.5, -0.5, -0.5], dtype=float64)
    """
    _value, before, own, after = _linearized(function, state)
    return before, own, after


def _linearized(function: Field, state: Any) -> tuple[jax.Array, jax.Array, jax.Array, jax.Array]:
    """Value and blocks, with one trace of the function."""
    n, b = state.shape
    if n == 1:
        value, push = jax.linearize(function, state)
        own = jnp.moveaxis(jax.vmap(push)(jnp.eye(b)[:, None, :]), 0, -1)
        return value, jnp.zeros_like(own), own, jnp.zeros_like(own)
    color = jnp.arange(n) % 3
    seeds = (color[None, None, :, None] == jnp.arange(3)[:, None, None, None]) * jnp.eye(b)[None, :, None, :]
    value, push = jax.linearize(function, state)
    found = jax.vmap(push)(seeds.reshape(3 * b, n, b)).reshape(3, b, n, b)  # color, unknown, cell, equation
    found = jnp.moveaxis(found, 1, -1)
    cells = jnp.arange(n)
    own = found[color, cells]
    before = found[(color - 1) % 3, cells].at[0].set(0.0)
    return value, before, own, found[(color + 1) % 3, cells].at[-1].set(0.0)


def factor_chain(before: Any, own: Any, after: Any) -> tuple[jax.Array, jax.Array, jax.Array]:
    """Elimination of a block-tridiagonal matrix: what `solve_factored` needs."""
    b = own.shape[-1]

    def eliminate(upper: Any, row: tuple) -> tuple[Any, tuple]:
        low, mid, high = row
        inverse = jnp.linalg.inv(mid - low @ upper)
        return inverse @ high, (inverse, inverse @ high)

    _last, (inverses, uppers) = lax.scan(eliminate, jnp.zeros((b, b)), (before, own, after))
    return before, inverses, uppers


def solve_factored(factors: tuple, right: Any) -> jax.Array:
    """Solution of the factored system for a right-hand side of shape ``(cells, equations)``."""
    before, inverses, uppers = factors

    def forward(known: Any, row: tuple) -> tuple[Any, Any]:
        low, inverse, r = row
        x = inverse @ (r - low @ known)
        return x, x

    def backward(known: Any, row: tuple) -> tuple[Any, Any]:
        upper, x = row
        x = x - upper @ known
        return x, x

    zero = jnp.zeros(right.shape[-1])
    _last, partial = lax.scan(forward, zero, (before, inverses, right))
    _first, found = lax.scan(backward, zero, (uppers, partial), reverse=True)
    return found


def solve_chain(
    function: Field,
    start: Any,
    capacity: Any,
    *,
    first_step: Any = 1.0,
    largest_change: Any = jnp.inf,
    tolerance: float = 1e-12,
    max_steps: int = 150,
) -> ChainSolution:
    """Solve ``function(state) = 0`` for a chain of cells, along the path the system would take in time until Newton's method takes over.

    Args:
        function: rates of change of what the cells hold, ``(cells, unknowns)``; row i may depend on rows i − 1, i and i + 1 only. It may
            close over traced values.
        start: first guess, ``(cells, unknowns)``, unknowns scaled to about one.
        capacity: what a cell holds per unknown, so that ``capacity · du/dt = function(u)``; zero for an equation without
            memory, any broadcastable shape.
        first_step: first step in time; it grows fourfold while steps are good.
        largest_change: change of an unknown in one step above which the step is repeated shorter, broadcastable to a state.
        tolerance: on the change that a whole Newton step would still make, relative to the unknowns or one.

    Returns:
        A `ChainSolution`. Nothing raises. Derivatives with respect to closed-over values follow from the implicit function theorem.

    Example:
        >>> flow = lambda u: jnp.concatenate([jnp.ones((1, 1)), u[:-1]]) - u - u**2
        >>> round(float(solve_chain(flow, jnp.ones((2, 1)), 1.0).state[0, 0]), 6)
        0.618034
    """
    start = jnp.asarray(start, dtype=float)
    capacity = jnp.broadcast_to(lax.stop_gradient(jnp.asarray(capacity, dtype=float)), start.shape)
    size = jnp.broadcast_to(jnp.asarray(largest_change, dtype=float), start.shape)

    def search(f: Field, guess: Any) -> tuple[Any, Any]:
        eye = jnp.eye(start.shape[1])

        def step(carry: tuple) -> tuple:
            u, safe, h, last, haste, number = carry
            r, before, own, after = _linearized(f, u)
            shifted = own - capacity[:, :, None] / h * eye
            du = -solve_factored(factor_chain(before, shifted, after), r)
            good = jnp.all(jnp.isfinite(du)) & jnp.all(abs(du) <= size)
            relative = jnp.max(abs(du) / jnp.maximum(abs(u), 1.0))
            # a change is that of a Newton step only when the step in time is long
            late = good & (h >= 1e8 * first_step)
            change = jnp.where(late, relative, jnp.inf)
            stuck = late & (relative > 0.7 * last) & (relative > 1e-7)  # to and fro over a kink: again from short steps, slower
            haste = jnp.where(stuck, 0.5 * haste, haste)
            longer = jnp.minimum(h * GROWTH ** jnp.where(relative < 0.05, 3.0 * haste, haste), 1e12 * first_step)
            longer = jnp.where(stuck, 10.0 * first_step, longer)
            lost = ~jnp.all(jnp.isfinite(r))  # the step before went astray: back to where it started
            return (
                jnp.where(good, u + du, jnp.where(lost, safe, u)),
                jnp.where(lost, safe, u),
                jnp.where(good, longer, h * CAUTION),
                change,
                haste,
                number + 1,
            )

        def unfinished(carry: tuple) -> Any:
            return (carry[3] > tolerance) & (carry[5] < max_steps)

        first = (guess, guess, jnp.asarray(first_step, dtype=float), jnp.asarray(jnp.inf), jnp.asarray(1.0), jnp.zeros((), int))
        u, _safe, _h, change, _haste, number = lax.while_loop(unfinished, step, first)
        return u, (change, number.astype(u.dtype))

    def tangent(linear: Field, right: Any) -> Any:
        return solve_factored(factor_chain(*chain_blocks(linear, jnp.zeros_like(right))), right)

    first_step = lax.stop_gradient(jnp.asarray(first_step, dtype=float))
    state, (change, number) = lax.custom_root(function, start, search, tangent, has_aux=True)
    return ChainSolution(state, change <= tolerance, number.astype(int), change)


def advance_chain(
    function: Callable[[jax.Array, Any], jax.Array],
    start: Any,
    capacity: Any,
    step: Any,
    inputs: Any,
    outflow: Callable[[jax.Array, Any], jax.Array] | None = None,
) -> tuple[jax.Array, jax.Array]:
    """States of a chain of cells over time by Verwer's two-stage Rosenbrock method: second order, L-stable, given steps.

    What is linear in the unknowns and conserved by ``function`` is conserved to rounding.

    Args:
        function: ``capacity · du/dt = function(u, input)``, rows coupled to their neighbors only.
        start: ``(cells, unknowns)``.
        capacity: zero for an equation without memory, broadcastable to a state.
        step: length of the steps, or of each of them.
        inputs: pytree whose leaves have a leading axis of steps; constant within a step.
        outflow: ``outflow(u, input)``, linear in u: flows (any vector) whose time integral is wanted.

    Returns:
        States after each step, ``(steps, cells, unknowns)``, and the integral of the outflow up to there, ``(steps, flows)``.

    Example:
        >>> states, _ = advance_chain(lambda u, i: i - u, jnp.zeros((1, 1)), 1.0, 0.01, jnp.ones(100))
        >>> round(float(states[-1, 0, 0]), 3)  # 1 − 1/e = 0.632
        0.632
    """
    start = jnp.asarray(start, dtype=float)
    capacity = jnp.broadcast_to(jnp.asarray(capacity, dtype=float), start.shape)
    eye = jnp.eye(start.shape[1])
    count = outflow or (lambda u, _input: jnp.zeros((0,)))

    def one(carry: tuple, row: tuple) -> tuple[tuple, tuple]:
        (u, total), (given, step) = carry, row
        now, before, own, after = _linearized(lambda v: function(v, given), u)
        scale = GAMMA * step
        factors = factor_chain(-scale * before, capacity[:, :, None] * eye - scale * own, -scale * after)
        k1 = solve_factored(factors, now)
        k2 = solve_factored(factors, function(u + step * k1, given) - 2.0 * capacity * k1)
        # the same two stages for a row that only integrates: its derivative by the state is the linear outflow itself
        base = count(jnp.zeros_like(u), given)
        q1 = count(u, given) + scale * (count(k1, given) - base)
        q2 = count(u + step * k1, given) - 2.0 * q1 + scale * (count(k2, given) - base)
        u = u + step * (1.5 * k1 + 0.5 * k2)
        total = total + step * (1.5 * q1 + 0.5 * q2)
        return (u, total), (u, total)

    first = jax.tree.map(lambda leaf: leaf[0], inputs)
    number = jax.tree.leaves(inputs)[0].shape[0]
    lengths = jnp.broadcast_to(jnp.asarray(step, dtype=float), (number,))
    _end, (states, totals) = lax.scan(one, (start, jnp.zeros_like(count(start, first))), (inputs, lengths))
    return states, totals
