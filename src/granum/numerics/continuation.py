"""Newton's method that begins as a march in time: for fixed points to which repeated substitution does not
come, or only by chance.
"""

from __future__ import annotations

from collections.abc import Callable

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.numerics.fixed_points import largest, solve_linear

NEAR = 1e-2  # below, a residual that shrinks is trusted to shrink by Newton's method
WORSE = 2.0  # a step after which the residual has grown more than so many times is taken back
NEWTON = 100.0  # after so long a while the residual may not grow at all
FARTHEST = 0.5  # of the range of a parameter, in one step
SHORTEST = 1e-6
LONGEST = 1e12


class Continuation(eqx.Module):
    """A method for ``settle``: pseudo-transient continuation (Kelley and Keyes 1998). Each step solves
    ``x' = g(x) - x`` for a while, implicitly and with exact derivatives: a short while is a damped
    substitution, a long one Newton's step. Newton's is tried first; where it fails the while is
    short, and grows as the residual shrinks.

    Unknowns that are not negative stay so. The last ``count`` are parameters within 0 … 1 for whose residual
    the state is steered on the way; all are found together.

    Parameters
    ----------
    count: number of parameters.
    """

    count: int = eqx.field(static=True, default=0)

    def begin(self, start: jax.Array) -> tuple:
        """As of ``Anderson``."""
        infinite = jnp.full((), jnp.inf, start.dtype)
        forever = jnp.full((), LONGEST, start.dtype)
        return start, (start, infinite), start, infinite, forever, jnp.zeros((), bool), jnp.zeros((), int)

    def resumed(self, carry: tuple, tolerance: float) -> tuple:
        """As of ``Anderson``."""
        return carry

    def hopes(self, carry: tuple) -> jax.Array:
        """As of ``Anderson``."""
        return carry[4] > SHORTEST

    def moves(self, carry: tuple) -> jax.Array:
        """As of ``Anderson``."""
        return jnp.asarray(True)

    def proceed(self, carry: tuple, r: jax.Array, derivative: Callable[[jax.Array], jax.Array]) -> tuple:
        """As of ``Anderson``, given the derivative of the residual as well, a linear function."""
        x, best, base, norm, during, again, number = carry
        size = largest(r)
        here = jnp.where(jnp.isfinite(size), jnp.sqrt(jnp.sum(r**2)), jnp.inf)
        much = jnp.where(during > NEWTON, 1.0, WORSE)
        accepted = (number == 0) | (jnp.isfinite(here) & (here <= much * norm))
        smaller = size < best[1]
        best = (jnp.where(smaller, x, best[0]), jnp.where(smaller, size, best[1]))
        growth = jnp.where(here > 0.0, jnp.clip(norm / here, 0.2, 10.0), 10.0)
        growth = jnp.where((here < NEAR) & (here < norm), 100.0, growth)
        growth = jnp.where(again | (number == 0), 1.0, growth)
        during = jnp.where(accepted, jnp.minimum(LONGEST, during * growth), jnp.minimum(1.0, 0.25 * during))
        is_state = jnp.arange(x.size) < x.size - self.count
        # a figure that its parameter moves through the state alone is reached in small parts
        wanted = jnp.where(is_state, 1.0, (during / (1.0 + during)) ** 2) * r
        move = solve_linear(lambda v: jnp.where(is_state, v / during, 0.0) - derivative(v), wanted)
        # where nothing flows yet a derivative may be missing, but a pass through is never wrong
        move = jnp.where(jnp.all(jnp.isfinite(move)), move, jnp.where(is_state, r, 0.0))
        turned = jnp.max(abs(jnp.where(is_state, 0.0, move)), initial=0.0)
        move = move * jnp.minimum(1.0, FARTHEST / jnp.maximum(turned, FARTHEST))
        ahead = x + move
        ahead = jnp.where((ahead < 0.0) & (x >= 0.0), 0.0, ahead)
        ahead = jnp.where(is_state, ahead, jnp.clip(ahead, 0.0, 1.0))
        return (
            jnp.where(accepted, ahead, base),
            best,
            jnp.where(accepted, x, base),
            jnp.where(accepted, here, norm),
            during,
            ~accepted,
            number + 1,
        )
