"""Fixed points to which substitution does not come, and parameters found with them."""

import jax
import jax.numpy as jnp
import pytest

from granum.numerics import Continuation, settle


def found(loop, start, method, steps=60):
    return settle(lambda x: (loop(x), ()), jnp.asarray(start), method=method, max_steps=steps)


def test_linear_loop_that_hardly_contracts_takes_one_step() -> None:
    """x = 0.9999 x + 1: by hand 10 000."""
    solution = found(lambda x: 0.9999 * x + 1.0, [0.0], Continuation())
    assert bool(solution.converged)
    assert int(solution.steps) <= 3
    assert float(solution.state[0]) == pytest.approx(1e4, rel=1e-9)


def test_loop_on_which_newton_alone_runs_away() -> None:
    """x' = -arctan(4 x): from 5, Newton's steps double each time; the answer is 0."""
    solution = found(lambda x: x - jnp.arctan(4.0 * (x - 9.0)), [14.0], Continuation())
    assert bool(solution.converged)
    assert float(solution.state[0]) == pytest.approx(9.0, abs=1e-10)


def test_parameter_is_found_with_the_state() -> None:
    """x = p x + 1 so that x is 2: p is one half; x is never below one."""

    def loop(wanted):
        return lambda v: jnp.stack([v[1] * v[0] + 1.0, v[1] - 0.01 * (v[0] - wanted)])

    solution = found(loop(2.0), [1.0, 0.1], Continuation(1))
    assert bool(solution.converged)
    assert jnp.allclose(solution.state, jnp.array([2.0, 0.5]), rtol=1e-10)
    beyond = found(loop(0.5), [1.0, 0.1], Continuation(1))
    assert not bool(beyond.converged)
    assert 0.0 <= float(beyond.state[1]) <= 1.0


def test_derivative_of_what_is_found() -> None:
    """x = a x + 1: dx/da = 1 / (1 - a)²."""
    slope = jax.grad(lambda a: found(lambda x: a * x + 1.0, [0.0], Continuation()).state[0])(0.9)
    assert float(slope) == pytest.approx(100.0, rel=1e-9)


def test_goes_on_from_a_point_that_is_exactly_at_rest() -> None:
    """x = x / 2 + 1 from 2: nothing is left of the residual, call after call."""

    def again(known):
        return settle(
            lambda x: (0.5 * x + 1.0, x), jnp.array([2.0]), method=Continuation(), max_steps=60, known=known
        )

    known = None
    for _ in range(4):
        solution = again(known)
        assert bool(solution.converged)
        assert float(solution.made[0]) == 2.0
        known = solution.known
