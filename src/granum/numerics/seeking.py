"""A fixed point and the parameters that make figures of it take wanted values, in one iteration."""

from __future__ import annotations

from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.numerics.fixed_points import Anderson, chosen, largest, within_rounding

PROBE = 0.02  # of the range, by which a parameter is moved to learn what it does
SETTLED_TO_PROBE = 1e-6
LOOSEST, SHARE = 1e-5, 1e-3  # to what a state settles before parameters move: a share of what figures miss
FARTHEST = 0.5  # of the range, in one move
MOST_HALVINGS = 8


class Sought(NamedTuple):
    """What is known of the parameters, all within 0 … 1.

    at, miss: where the figures were nearest, or last. slopes: how they change with the parameters. stage:
    moves made. below, above: of one parameter, where its figure was too low and too high (not a number until
    found). tried: whether it was at 0 and at 1. halvings: moves in a row that made it worse. lost: nothing is
    left to try.
    """

    at: jax.Array
    miss: jax.Array
    slopes: jax.Array
    stage: jax.Array
    below: jax.Array
    above: jax.Array
    tried: jax.Array
    halvings: jax.Array
    lost: jax.Array


class Seeking(eqx.Module):
    """A method for ``settle``: the last ``count`` unknowns are parameters within 0 … 1, and their residual is
    what figures miss, with the sign changed. The others are brought to rest by Anderson's method.

    Whenever these have settled well enough for what the figures still miss, the parameters move: one by
    secants within a bracket, several by Broyden's method. The others go on from where they are with what was
    learned.

    Parameters
    ----------
    count: number of parameters. settling: for the other unknowns. tolerance: to which all are brought.
    """

    count: int = eqx.field(static=True)
    settling: Anderson = Anderson()
    tolerance: float = eqx.field(static=True, default=1e-12)

    def begin(self, start: jax.Array) -> tuple:
        """As of ``Anderson``."""
        state, at = start[: -self.count], start[-self.count :]
        none, no = jnp.full((), jnp.nan), jnp.zeros((), bool)
        sought = Sought(
            at,
            jnp.zeros_like(at),
            jnp.zeros((self.count, self.count)),
            jnp.zeros((), int),
            none,
            none,
            jnp.zeros((2,), bool),
            jnp.zeros((), int),
            no,
        )
        best = (start, jnp.full((), jnp.inf, start.dtype))
        return start, best, self.settling.begin(state), sought, no, jnp.zeros_like(state), jnp.zeros((), int)

    def resumed(self, carry: tuple, tolerance: float) -> tuple:
        """As of ``Anderson``."""
        x, best, inner, *others = carry
        return x, best, self.settling.resumed(inner, tolerance), *others

    def hopes(self, carry: tuple) -> jax.Array:
        """As of ``Anderson``."""
        return ~carry[3].lost

    def moves(self, carry: tuple) -> jax.Array:
        """As of ``Anderson``."""
        return jnp.asarray(True)

    def proceed(self, carry: tuple, r: jax.Array) -> tuple:
        """As of ``Anderson``."""
        x, best, inner, sought, moved, last, number = carry
        state, at, rest, miss = x[: -self.count], x[-self.count :], r[: -self.count], -r[-self.count :]
        if state.size:
            inner = chosen(moved, _shifted(inner, state, rest - last), inner)
            inner = self.settling.proceed(inner, rest)
        settled = largest(rest) <= self._enough(sought, state, miss)
        # what a figure misses says something once the state has settled
        size = jnp.where(settled, largest(r), 1.0 + largest(r))
        best = chosen(size < best[1], (x, size), best)
        aim = _one if self.count == 1 else _several
        onward, following = aim(sought, at, miss)
        sought = chosen(settled, onward, sought)
        state = jnp.where(settled, state, inner[0]) if state.size else state
        x = jnp.concatenate([state, jnp.where(settled, following, at)])
        return x, best, inner, sought, settled, rest, number + 1

    def _enough(self, sought: Sought, state: jax.Array, miss: jax.Array) -> jax.Array:
        least = within_rounding(state, self.tolerance)
        loose = jnp.clip(SHARE * largest(miss), least, jnp.maximum(LOOSEST, least))
        return jnp.where(sought.stage <= self.count, jnp.maximum(SETTLED_TO_PROBE, least), loose)


def _shifted(inner: tuple, state: jax.Array, jump: jax.Array) -> tuple:
    """What Anderson's method has learned, after the residuals have jumped with the parameters."""
    _x, _best, base, points, residuals, _least, rejected, number = inner
    infinite = jnp.full((), jnp.inf, state.dtype)
    base, residuals, rejected = (base[0], base[1] + jump), residuals + jump, jnp.zeros_like(rejected)
    return state, (state, infinite), base, points, residuals, infinite, rejected, number


def _toward_middle(at: jax.Array) -> jax.Array:
    return jnp.where(at < 0.5, PROBE, -PROBE)


def _one(known: Sought, at: jax.Array, miss: jax.Array) -> tuple[Sought, jax.Array]:
    """Secants, kept within a bracket once there is one; the ends of the range before giving up."""
    x, m = at[0], miss[0]
    tried = known.tried | jnp.stack([x <= 0.0, x >= 1.0])
    below, above = jnp.where(m < 0, x, known.below), jnp.where(m > 0, x, known.above)
    slope = (m - known.miss[0]) / (x - known.at[0])
    ahead = x - m / slope
    bracketed = jnp.isfinite(below + above)
    inside = (ahead - below) * (ahead - above) < 0
    fast = inside & ((abs(m) <= 0.5 * abs(known.miss[0])) | (known.stage <= 2))
    between = jnp.where(fast, ahead, 0.5 * (below + above))
    free = jnp.clip(jnp.clip(ahead, x - FARTHEST, x + FARTHEST), 0.0, 1.0)
    far = jnp.where(x < 0.5, 1.0, 0.0)
    free = jnp.where(jnp.isfinite(ahead) & (free != x), free, far)
    free = jnp.where((free <= 0.0) & tried[0], 1.0, jnp.where((free >= 1.0) & tried[1], 0.0, free))
    following = jnp.where(bracketed, between, free)
    first = known.stage == 0
    following = jnp.where(first, x + _toward_middle(x), following)
    lost = ~first & jnp.where(bracketed, following == x, jnp.all(tried))
    onward = known._replace(
        at=at, miss=miss, stage=known.stage + 1, below=below, above=above, tried=tried, lost=lost
    )
    return onward, following[None]


def _several(known: Sought, at: jax.Array, miss: jax.Array) -> tuple[Sought, jax.Array]:
    """Each moved a little by itself; then Broyden's method, a move that makes it worse being halved."""
    count, stage = at.size, known.stage
    probing = stage <= count
    moved, changed = at - known.at, miss - known.miss
    column = jnp.arange(count) == stage - 1
    probed = jnp.where(column, changed[:, None] / jnp.where(column, moved, 1.0), known.slopes)
    length = jnp.sum(moved**2)
    learned = known.slopes + jnp.outer(changed - known.slopes @ moved, moved) / jnp.where(
        length > 0, length, 1.0
    )
    slopes = jnp.where(stage == 0, known.slopes, jnp.where(probing, probed, learned))
    better = (stage == 0) | (~probing & (largest(miss) <= largest(known.miss)))
    place, left = jnp.where(better, at, known.at), jnp.where(better, miss, known.miss)
    halvings = jnp.where(probing | better, 0, known.halvings + 1)
    regular = slopes + 1e-300 * jnp.eye(count)
    move = -jnp.linalg.solve(regular, left) * 0.5**halvings
    move = move * jnp.minimum(1.0, FARTHEST / jnp.maximum(largest(move), 1e-300))
    goal = jnp.clip(place + jnp.where(jnp.isfinite(move), move, 0.0), 0.0, 1.0)
    aside = place + jnp.where(jnp.arange(count) == stage, _toward_middle(place), 0.0)
    following = jnp.where(stage < count, aside, goal)
    lost = (stage >= count) & (jnp.all(following == place) | (halvings > MOST_HALVINGS))
    onward = known._replace(at=place, miss=left, slopes=slopes, stage=stage + 1, halvings=halvings, lost=lost)
    return onward, following
