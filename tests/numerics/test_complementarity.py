"""Complementarity against trying every choice of what is zero."""

from itertools import product

import jax
import jax.numpy as jnp
import numpy as np

from granum.numerics.complementarity import find_complementary


def by_trying(matrix, given):
    """The only x ≥ 0 with slack ≥ 0 of a positive definite matrix, by its definition."""
    for chosen in product((False, True), repeat=len(given)):
        held, x = np.array(chosen), np.zeros(len(given))
        if held.any():
            x[held] = np.linalg.solve(matrix[np.ix_(held, held)], -given[held])
        if x.min() >= 0.0 and (matrix @ x + given).min() >= -1e-12:
            return x
    raise AssertionError("no choice is right")


def test_it_finds_what_trying_finds_and_its_derivative():
    @jax.jit
    def found(matrix, given):
        return find_complementary(lambda x: matrix @ x + given, jnp.ones(4), lambda x: x + 1.0)

    rng = np.random.default_rng(2)
    for _try in range(40):
        half = rng.normal(size=(4, 4))
        matrix, given = half @ half.T + 0.1 * np.eye(4), rng.normal(size=4)
        made = found(matrix, given)
        np.testing.assert_allclose(made.value, by_trying(matrix, given), atol=1e-9)
        assert float(made.residual) < 1e-9
    slope = jax.jacfwd(lambda g: found(matrix, g).value)(jnp.asarray(given))
    step = 1e-6 * rng.normal(size=4)
    moved = np.asarray(found(matrix, given + step).value - found(matrix, given - step).value) / 2.0
    np.testing.assert_allclose(slope @ step, moved, atol=1e-10)
