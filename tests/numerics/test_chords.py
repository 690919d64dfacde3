"""Slopes that are measured once take many neighbors to their fixed points."""

import jax.numpy as jnp
import numpy as np
import pytest

from granum.numerics import Anderson, Chords, settle
from granum.numerics.settled import again

SHARES = np.random.default_rng(0).dirichlet(np.ones(12), 12) * 0.98


def recycle(feed: float):
    """Twelve flows, nearly all of which come round, a little less the more there is."""
    return lambda x: jnp.asarray(SHARES) @ (x / (1.0 + 1e-3 * x)) + feed


def found(loop, start, method, known=None):
    return settle(
        lambda x: (loop(x), ()), start, method=method, tolerance=1e-12, max_steps=10_000, known=known
    )


def test_neighbors_take_few_passes() -> None:
    first = found(recycle(1.0), jnp.zeros(12), Chords())
    assert bool(first.converged)
    assert jnp.allclose(first.state, found(recycle(1.0), jnp.zeros(12), Anderson()).state, rtol=1e-9)
    known = again(Chords(), first.known, 12)
    for feed in (0.95, 1.0, 1.05):
        neighbor = found(recycle(feed), jnp.zeros(12), Chords(), known)
        plain = found(recycle(feed), first.state, Anderson())
        assert bool(neighbor.converged)
        assert jnp.allclose(neighbor.state, plain.state, rtol=1e-9)
        assert int(neighbor.steps) <= 8
        assert int(neighbor.steps) <= int(plain.steps)


def test_far_neighbor_has_its_slopes_measured_anew() -> None:
    known = again(Chords(), found(recycle(0.01), jnp.zeros(12), Chords()).known, 12)
    far = found(recycle(300.0), jnp.zeros(12), Chords(), known)
    assert bool(far.converged)
    assert jnp.allclose(far.state, recycle(300.0)(far.state), rtol=1e-10)


def aimed(wanted: float):
    """x = p x + 1 with p so that x is what is wanted: p = 1 - 1/x."""
    return lambda v: jnp.stack([v[1] * v[0] + 1.0, v[1] - 0.01 * (v[0] - wanted)])


def test_parameter_is_found_with_the_state() -> None:
    method = Chords(1)
    first = found(aimed(2.0), jnp.array([1.0, 0.1]), method)
    assert bool(first.converged)
    assert jnp.allclose(first.state, jnp.array([2.0, 0.5]), rtol=1e-9)
    near = found(aimed(2.2), jnp.array([1.0, 0.1]), method, again(method, first.known, 2))
    assert float(near.state[1]) == pytest.approx(1.0 - 1.0 / 2.2, rel=1e-9)
    beyond = found(aimed(0.5), jnp.array([1.0, 0.1]), method, again(method, first.known, 2))
    assert not bool(beyond.converged)
    assert 0.0 <= float(beyond.state[1]) <= 1.0


def test_unknown_without_an_answer_beside_the_point() -> None:
    """A unit that has no answer above its solution: what comes round is taken as it is."""
    found_ = found(
        lambda x: (
            jnp.where(x[1] > 1.0 + 1e-9, jnp.nan, 1.0) * jnp.stack([0.5 * x[0] + 1.0, 0.0 * x[1] + 1.0])
        ),
        jnp.zeros(2),
        Chords(),
    )
    assert bool(found_.converged)
    assert jnp.allclose(found_.state, jnp.array([2.0, 1.0]))
