"""Equations of which each holds, or the quantity that it is for is zero."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jax import lax

from granum.numerics.implicit import implicit_root

STEPS, POLISHING = 80, 4
CLOSE = 1e-14  # where the path is left for the equations that hold
SHORT = 0.9  # of the way to where something would become zero
CENTER = 0.2  # of the complementarity that is there, which the next step aims at


class Complementary(NamedTuple):
    """Outcome of `find_complementary`.

    value: the quantities, none below zero.
    slack: by how much each equation is not filled; zero where the quantity is not.
    residual: the larger of both deviations from these.
    """

    value: jax.Array
    slack: jax.Array
    residual: jax.Array


def _stepped(x: Any, change: Any) -> Any:
    """The longest step that keeps positive quantities positive."""
    room = jnp.where(change < 0.0, -x / jnp.where(change < 0.0, change, -1.0), jnp.inf)
    return jnp.min(room, initial=jnp.inf)


def find_complementary(
    slack: Callable[[Any], Any], start: Any, positive: Callable[[Any], Any]
) -> Complementary:
    """The vector ``x ≥ 0`` with ``slack(x) ≥ 0`` where of each pair one is zero, as of phases that are there
    or not.

    A primal–dual path is followed to where it is clear which of each pair is zero (Wright, 1997, chapter 1,
    for equations that need not be linear), then Newton's method solves what is left.

    Parameters
    ----------
    slack: of a vector like the start; it may close over traced values.
    start: positive, and ``positive(start)`` too.
    positive: a vector of what must stay above zero on the way, where the slack is not defined otherwise.

    Derivatives with respect to closed-over values are those of the equations that hold.

    >>> import jax.numpy as jnp
    >>> found = find_complementary(lambda x: x - jnp.array([2.0, -1.0]), jnp.ones(2), lambda x: x + 1.0)
    >>> [round(float(v), 9) for v in found.value]
    [2.0, 0.0]
    """
    start = jnp.asarray(start, dtype=float)

    def one_of_each(x: Any) -> Any:
        return jnp.minimum(x, slack(x))

    def search(_equation: Any, begun: Any) -> tuple[Any, Any]:
        def open_(state: Any) -> Any:
            *_x, passes, last = state
            return (passes < STEPS) & (last < POLISHING)

        def step(state: Any) -> Any:
            x, z, passes, last = state
            here, slope = slack(x), jax.jacfwd(slack)(x)
            clear = jnp.max(jnp.maximum(x * z, jnp.abs(here - z)), initial=0.0) < CLOSE
            settled, holds = clear | (last > 0), x > z
            # no product is to grow again: what hardly can be there is held down by other than its own sign
            aim = CENTER * jnp.minimum(jnp.mean(x * z), x * z)
            path, end = x[:, None] * slope + jnp.diag(z), jnp.where(holds[:, None], slope, jnp.eye(len(x)))
            right = jnp.where(settled, -jnp.where(holds, here, x), aim - x * here)
            dx = jnp.linalg.solve(jnp.where(settled, end, path), right)
            dz = here - z + slope @ dx
            share = SHORT * _stepped(positive(x), jax.jvp(positive, (x,), (dx,))[1])
            short = jnp.minimum(share, SHORT * jnp.minimum(_stepped(x, dx), _stepped(z, dz)))
            share = jnp.minimum(1.0, jnp.where(settled, share, short))
            z = jnp.where(settled, z, z + share * dz)
            x = x + share * dx
            # which of each pair is zero stays as it was when the path was left
            x = jnp.where(settled, jnp.where(holds, jnp.maximum(x, 2.0 * z), 0.0), x)
            return x, z, passes + 1, last + settled

        begun = begun, jnp.maximum(slack(begun), 0.1), 0, 0
        x, z, *_passes = lax.while_loop(open_, step, begun)
        return jnp.where(x > z, x, 0.0), ()

    def tangent(linear: Any, right: Any) -> Any:
        matrix = jax.vmap(linear)(jnp.eye(start.shape[0])).T
        return jnp.linalg.solve(matrix, right)

    value, _more, _equation = implicit_root(one_of_each, start, search, tangent)
    left = slack(value)
    return Complementary(
        value, left, lax.stop_gradient(jnp.max(jnp.abs(jnp.minimum(value, left)), initial=0.0))
    )
