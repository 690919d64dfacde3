"""Newton's method with slopes measured once and used for many neighbors: for fixed points that are sought
again and again at other values.
"""

from __future__ import annotations

from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.numerics.fixed_points import Anderson, chosen, largest, within_rounding

NEAR = 1e-4  # to what substitution brings the state before slopes are measured
SETTLED = 1e-6  # below, what a figure misses says something
PROBE = 1e-7
LONG = 80  # passes of substitution after which nothing is to be hoped of it
PATIENCE = 15  # passes along the same slopes
MOST = 3  # times that slopes are measured again
SUBSTITUTING, ALONG = -2, -1


class Course(NamedTuple):
    """Where an iteration is: ``SUBSTITUTING``, moving ``ALONG`` slopes, or measuring those of one unknown
    after the other, counted from the point itself, 0.

    at, residual: the point where slopes are measured. slopes: one row an unknown. nearest: the best point,
    and its residual. since: passes in this mode. times: that slopes were measured. fresh: whether they have
    still to be measured at a solution. lost: a parameter would have to leave its limits.
    """

    mode: jax.Array
    at: jax.Array
    residual: jax.Array
    slopes: jax.Array
    nearest: tuple[jax.Array, jax.Array]
    since: jax.Array
    times: jax.Array
    fresh: jax.Array
    lost: jax.Array


class Chords(eqx.Module):
    """A method for ``settle``: Newton's, its slopes measured by small changes of one unknown after the other,
    and kept as long as they serve; Anderson's method corrects what they miss.

    From nothing the state is first brought near to rest by substitution. At the solution slopes are measured
    once more, so that what this outcome knows, handed on by ``again``, takes a neighbor there in a few
    passes. The last ``count`` unknowns are parameters within 0 … 1 whose residual is what figures miss, all
    found together. For up to a few hundred unknowns, and for one case at a time: side by side each would wait
    for the one that measures.

    Parameters
    ----------
    count: number of parameters. tolerance: to which all are brought.
    """

    count: int = eqx.field(static=True, default=0)
    tolerance: float = eqx.field(static=True, default=1e-12)
    settling: Anderson = Anderson()

    def begin(self, start: jax.Array) -> tuple:
        """As of ``Anderson``."""
        mode = jnp.asarray(SUBSTITUTING if start.size > self.count else 0)
        return self._begun(start, jnp.eye(start.size, dtype=start.dtype), mode, jnp.ones((), bool))

    def again(self, carry: tuple) -> tuple:
        """The beginning for a neighbor of what was found."""
        (x, _size), inverse = carry[1], carry[2]
        return self._begun(x, inverse, jnp.asarray(ALONG), jnp.zeros((), bool))

    def _begun(self, x: jax.Array, inverse: jax.Array, mode: jax.Array, fresh: jax.Array) -> tuple:
        far, zero, no = (x, jnp.full((), jnp.inf, x.dtype)), jnp.zeros((), int), jnp.zeros((), bool)
        course = Course(mode, x, jnp.zeros_like(x), jnp.zeros_like(inverse), far, zero, zero, fresh, no)
        return x, far, inverse, self.settling.begin(x), course, zero

    def resumed(self, carry: tuple, tolerance: float) -> tuple:
        """As of ``Anderson``."""
        return carry

    def hopes(self, carry: tuple) -> jax.Array:
        """As of ``Anderson``."""
        course = carry[4]
        stuck = (course.mode == ALONG) & (course.since > PATIENCE) & (course.times >= MOST)
        return ~course.lost & ~stuck & ~((course.mode == SUBSTITUTING) & (course.since > LONG))

    def moves(self, carry: tuple) -> jax.Array:
        """As of ``Anderson``."""
        return carry[4].mode < 0

    def proceed(self, carry: tuple, r: jax.Array) -> tuple:
        """As of ``Anderson``."""
        x, best, inverse, inner, course, number = carry
        is_state = jnp.arange(x.size) < x.size - self.count
        state = jnp.where(is_state, r, 0.0)
        substituting, along = course.mode == SUBSTITUTING, course.mode == ALONG
        settled = largest(state) <= SETTLED
        size = jnp.where(substituting, largest(state), jnp.where(settled, largest(r), 1.0 + largest(r)))
        nearest = chosen((substituting | along) & (size < course.nearest[1]), (x, size), course.nearest)
        done = along & (size <= within_rounding(x, self.tolerance))
        best = chosen(along & ~course.fresh & (size < best[1]), (x, size), best)

        move, held = self._held(x, inverse, inverse @ r)
        inner = self.settling.proceed(inner, jnp.where(substituting, state, move))
        onward = _within(inner[0], x, is_state)
        inner = (onward, *inner[1:])

        begins = (substituting & (size <= NEAR)) | (done & course.fresh)
        begins = begins | (along & ~done & (course.since >= PATIENCE) & (course.times < MOST))
        measured = self._measured(course, r)
        last = course.mode == x.size
        inverse = jax.lax.cond(last, _inverse, lambda _slopes: inverse, measured.slopes)
        probing = measured._replace(mode=jnp.where(last, ALONG, course.mode + 1))
        started = course._replace(
            mode=jnp.zeros_like(course.mode),
            at=nearest[0],
            nearest=nearest,
            since=jnp.zeros_like(course.since),
            times=course.times + ~(done & course.fresh),
            fresh=course.fresh & ~done,
        )
        lost = along & held & settled & ~done
        moving = course._replace(nearest=nearest, since=course.since + 1, lost=lost)
        following = chosen(begins, started, chosen(course.mode >= 0, probing, moving))
        at = following.at
        probe = at + jnp.where(jnp.arange(x.size) == following.mode - 1, self._step(at), 0.0)
        # what Anderson's method has learned of other slopes is forgotten with them
        inner = chosen(last, self.settling.begin(at), inner)
        ahead = jnp.where(following.mode >= 0, probe, jnp.where(last, at, onward))
        return ahead, best, inverse, inner, following, number + 1

    def _held(self, x: jax.Array, inverse: jax.Array, move: jax.Array) -> tuple[jax.Array, jax.Array]:
        """The move, parameters that would leave their limits kept there; and whether there are any."""
        if not self.count:
            return move, jnp.zeros((), bool)
        at, moves = x[-self.count :], move[-self.count :]
        out = ((at <= 0.0) & (moves < 0.0)) | ((at >= 1.0) & (moves > 0.0))
        both = out[:, None] & out[None, :]
        corner = jnp.where(both, inverse[-self.count :, -self.count :], jnp.eye(self.count))
        against = jnp.linalg.solve(corner, jnp.where(out, -moves, 0.0))
        return move + inverse[:, -self.count :] @ against, jnp.any(out)

    def _step(self, at: jax.Array) -> jax.Array:
        """By how much each unknown is changed: up, but for parameters in the upper half of their range."""
        is_state = jnp.arange(at.size) < at.size - self.count
        return jnp.where(is_state | (at < 0.5), 1.0, -1.0) * PROBE * (1.0 + abs(at))

    def _measured(self, course: Course, r: jax.Array) -> Course:
        k = jnp.clip(course.mode - 1, 0, r.size - 1)
        row = (r - course.residual) / self._step(course.at)[k]
        # where a unit has no answer beside the point, repeated substitution is the best guess
        row = jnp.where(jnp.all(jnp.isfinite(row)), row, jnp.where(jnp.arange(r.size) == k, -1.0, 0.0))
        slopes = course.slopes.at[k].set(jnp.where(course.mode >= 1, row, course.slopes[k]))
        return course._replace(slopes=slopes, residual=jnp.where(course.mode == 0, r, course.residual))


def _inverse(slopes: jax.Array) -> jax.Array:
    found = -jnp.linalg.inv(slopes.T)
    return jnp.where(jnp.all(jnp.isfinite(found)), found, jnp.eye(len(slopes)))


def _within(ahead: jax.Array, x: jax.Array, is_state: jax.Array) -> jax.Array:
    """What was not negative stays so, and a parameter within its limits."""
    ahead = jnp.where((ahead < 0.0) & (x >= 0.0), 0.0, ahead)
    return jnp.where(is_state, ahead, jnp.clip(ahead, 0.0, 1.0))
