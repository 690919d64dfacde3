"""The steady composition of a mixed vessel whose crystals meet: liquor and population found together."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np
from jax import lax

from granum.numerics.fixed_points import Anderson, chosen, solve_linear
from granum.numerics.implicit import implicit_root

METHOD = Anderson(window=10, plain=5)
BOLD, ROUNDS, MOST = 60, 250, 80
LESS = 1e-9
CLOSE, ROUGH, NEAR, CLOSED = 1e-11, 1e-8, 1e-9, 1e-6
TRYING, NARROWING, ALONE, DONE = range(4)
LEAST, FAR = 1e-14, 30.0
# shares of the supersaturation at which a change of sign is sought, close where steady states crowd
TRIALS = np.concatenate(
    [np.geomspace(1e-7, 0.1, 14), np.linspace(0.2, 0.8, 4), 1.0 - np.geomspace(0.1, 1e-6, 6)]
)

State = tuple[Any, Any]


class Crowded(NamedTuple):
    """Share of the supersaturation that is left, numbers and cubes by class, whether crystals form, and
    whether all that was found.
    """

    share: Any
    state: State
    crystallizes: Any
    converged: Any


def steady_crowd(
    following: Callable[[Any, Any, State, Any], State],
    excess: Callable[[Any, State], Any],
    size: Callable[[Any], State],
    count: int,
    possible: Any,
    otherwise: Any,
) -> Crowded:
    """The first share of the supersaturation at which the crystals made are those that the balance leaves.

    Parameters
    ----------
    following: the population that follows on one, given share and whether crystals are born (1 or 0); and
    whether steps are cautious, which a steady one does not depend on.
    excess: logarithm of the crystals made over those left. size: typical numbers and cubes at a share.
    count: of classes. possible: whether the liquor is supersaturated at all. otherwise: share where nothing
    crystallizes, with crystals that came.

    One loop solves the population at one share after another, each from the one before: at trial shares from
    the lowest until the excess changes sign, then by false position between the two in the logarithm of the
    share, which is nearly straight, and at last as closely as it goes.
    """

    def population(share: Any, born: Any, start: State, tolerance: Any) -> tuple[State, Any]:
        unit = size(share)

        def residual(u: Any, cautious: Any) -> Any:
            state = (u[:count] * unit[0], u[count:] * unit[1])
            there = (jnp.maximum(state[0], 0.0), jnp.maximum(state[1], 0.0))
            made = following(share, born, there, cautious)
            return jnp.concatenate([(made[0] - state[0]) / unit[0], (made[1] - state[1]) / unit[1]])

        first = jnp.concatenate([start[0] / unit[0], start[1] / unit[1]])

        def settled(carry: tuple) -> Any:
            return carry[1][1] <= tolerance

        def step(state: tuple) -> tuple:
            carry, cautious = state
            carry = METHOD.proceed(carry, residual(carry[0], cautious))
            # the steady one that is found may be one of fewer crystals than none
            astray = ~cautious & ((settled(carry) & (jnp.min(carry[1][0]) < -LESS)) | (carry[-1] > BOLD))
            return chosen(astray, METHOD.begin(first), carry), cautious | astray

        carry, _cautious = lax.while_loop(
            lambda state: ~settled(state[0]) & (state[0][-1] < ROUNDS),
            step,
            (METHOD.begin(first), jnp.asarray(False)),
        )
        u, error = carry[1]
        return (u[:count] * unit[0], u[count:] * unit[1]), error

    def search(_equation: Any, _first: Any) -> tuple[Any, Any]:
        def step(carry: tuple) -> tuple:
            number, phase, share, state, below, above, last, _error, _value = carry
            born = jnp.where(phase == ALONE, 0.0, 1.0)
            tolerance = jnp.where(phase == TRYING, ROUGH, CLOSE)
            state, error = population(share, born, state, tolerance)
            narrowing = phase == NARROWING
            # where fragments outgrow their losses no population is steady, and a linear balance answers with
            # one below nothing: far too many crystals
            slack = 0.01 * jnp.max(jnp.abs(state[1])) + 10.0 * tolerance * size(share)[1]
            steady = jnp.min(state[1]) >= -slack
            value = jnp.where(steady, excess(share, state), FAR)
            here, lacking = jnp.stack([jnp.log(share), value]), value < 0.0
            # the end of false position that stays twice counts half (Illinois), lest it stay for good
            side = jnp.where(narrowing, jnp.where(lacking, -1, 1), 0)
            half = jnp.where((side == last) & narrowing, jnp.array([1.0, 0.5]), 1.0)
            lower, upper = jnp.where(lacking, here, half * below), jnp.where(lacking, half * above, here)
            lower, upper = jnp.where(phase == ALONE, below, lower), jnp.where(phase == ALONE, above, upper)
            found = jnp.isfinite(upper[0])
            between = lower[0] - lower[1] * (upper[0] - lower[0]) / jnp.where(found, upper[1] - lower[1], 1.0)
            closed = (jnp.abs(value) < NEAR) | (upper[0] - lower[0] < NEAR) | (number > MOST)
            tried = jnp.where(found, NARROWING, jnp.where(number + 1 < len(TRIALS), TRYING, ALONE))
            narrowed = jnp.where(closed, DONE, NARROWING)
            ahead = jnp.where(phase == TRYING, tried, jnp.where(narrowing, narrowed, DONE))
            trial = jnp.asarray(TRIALS)[jnp.minimum(number + 1, len(TRIALS) - 1)]
            share = jnp.where(ahead == DONE, share, jnp.where(ahead == NARROWING, jnp.exp(between), trial))
            share = jnp.where(ahead == ALONE, otherwise, share)
            return number + 1, ahead, share, state, lower, upper, side, error, value

        begin = (
            0,
            jnp.where(possible, TRYING, ALONE),
            jnp.where(possible, TRIALS[0], otherwise),
            (jnp.zeros(count), jnp.zeros(count)),
            jnp.array([math.log(LEAST), -1.0]),
            jnp.array([jnp.inf, 1.0]),
            0,
            jnp.asarray(jnp.inf),
            jnp.asarray(jnp.inf),
        )
        *_rest, share, state, _lower, upper, _side, error, value = lax.while_loop(
            lambda c: c[1] != DONE, step, begin
        )
        some = possible & jnp.isfinite(upper[0])
        good = (error <= CLOSE) & (~some | (jnp.abs(value) < CLOSED))
        return jnp.concatenate([share[None], *state]), (some, good)

    def equation(u: Any) -> Any:
        share, state = u[0], (u[1 : 1 + count], u[1 + count :])
        value = excess(share, state)
        some = possible & (jnp.abs(lax.stop_gradient(value)) < CLOSED)
        made = following(share, jnp.where(some, 1.0, 0.0), state, jnp.asarray(False))
        miss = jnp.where(some, value, share - otherwise)
        return jnp.concatenate([miss[None], made[0] - state[0], made[1] - state[1]])

    u, (some, good), _equation = implicit_root(equation, jnp.zeros(1 + 2 * count), search, solve_linear)
    return Crowded(u[0], (u[1 : 1 + count], u[1 + count :]), some > 0.0, good > 0.0)
