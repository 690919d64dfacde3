"""Initial-value problems against closed forms."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.numerics import integrate

TIMES = jnp.linspace(0.0, 2.0, 5)


@pytest.mark.parametrize("stiff", [False, True])
def test_decay_and_its_derivatives(stiff: bool) -> None:
    def path(k):
        return integrate(lambda t, y, k: -k * y, 2.0, TIMES, k, stiff=stiff)

    def everything(k):
        return path(k), jax.grad(lambda k: path(k).end_state)(k), jax.jacfwd(lambda k: path(k).end_state)(k)

    found, reverse, forward = jax.jit(everything)(1.5)
    assert found.converged
    assert not found.stopped
    np.testing.assert_allclose(found.states, 2.0 * np.exp(-1.5 * TIMES), rtol=1e-6)
    np.testing.assert_allclose(found.end_state, found.states[-1], rtol=1e-12)
    expected = -4.0 * np.exp(-3.0)
    np.testing.assert_allclose(reverse, expected, rtol=1e-5)
    np.testing.assert_allclose(forward, expected, rtol=1e-5)


def test_stiff_pair_follows_a_fast_transient() -> None:
    # y' = -k (y - cos t): after the transient y = (k^2 cos t + k sin t) / (k^2 + 1).
    k = 1e5
    found = integrate(lambda t, y, k: -k * (y - jnp.cos(t)), 0.0, TIMES, k, stiff=True)
    assert found.converged
    expected = (k**2 * np.cos(TIMES) + k * np.sin(TIMES)) / (k**2 + 1.0)
    np.testing.assert_allclose(found.states[1:], expected[1:], atol=1e-7)


def test_stop_condition() -> None:
    def fall(gravity):
        return integrate(
            lambda t, y, g: {"height": y["speed"], "speed": -g},
            {"height": 10.0, "speed": 0.0},
            jnp.linspace(0.0, 4.0, 5),
            gravity,
            until=lambda t, y, g: y["height"],
        )

    g = 9.81

    def everything(g):
        return fall(g), jax.grad(lambda g: fall(g).end_time)(g), jax.jacfwd(lambda g: fall(g).end_time)(g)

    found, reverse, forward = jax.jit(everything)(g)
    assert found.stopped
    assert found.converged
    np.testing.assert_allclose(found.end_time, np.sqrt(20.0 / g), rtol=1e-9)
    np.testing.assert_allclose(found.states["height"][:2], [10.0, 10.0 - g / 2], rtol=1e-9)
    np.testing.assert_allclose(found.states["speed"][2:], -np.sqrt(20.0 * g), rtol=1e-9)
    expected = -0.5 * np.sqrt(20.0) * g**-1.5
    np.testing.assert_allclose(reverse, expected, rtol=1e-8)
    np.testing.assert_allclose(forward, expected, rtol=1e-8)


def test_a_condition_never_met_does_not_stop() -> None:
    found = integrate(lambda t, y, _: -y, 1.0, TIMES, until=lambda t, y, _: y + 1.0)
    assert not found.stopped
    np.testing.assert_allclose(found.end_time, 2.0)


def test_running_out_of_steps_is_told() -> None:
    assert not integrate(lambda t, y, _: jnp.sin(1e4 * t) * y, 1.0, TIMES, max_steps=16).converged
    assert not integrate(lambda t, y, _: y**2, 1.0, TIMES, max_steps=200).converged


def test_batch() -> None:
    rates = jnp.array([0.5, 1.0, 2.0])
    ends = jax.vmap(lambda k: integrate(lambda t, y, k: -k * y, 1.0, TIMES, k).end_state)(rates)
    np.testing.assert_allclose(ends, np.exp(-2.0 * rates), rtol=1e-6)
