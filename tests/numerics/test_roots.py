"""Roots: closed forms, derivatives, and the promise that none inside a bracket is lost."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from granum.numerics import find_root


def test_elements_with_their_own_brackets() -> None:
    a = jnp.array([[1.0], [8.0]])
    root = find_root(lambda x, a, n: x**n - a, 0.0, jnp.array([3.0, 9.0, 100.0]), a, 3.0)
    assert root.value.shape == (2, 3)
    np.testing.assert_allclose(root.value, jnp.broadcast_to(jnp.cbrt(a), (2, 3)), rtol=1e-14)
    assert root.converged.all()
    np.testing.assert_allclose(root.residual, 0.0, atol=1e-13)


def test_ends_and_missing_sign_changes() -> None:
    root = find_root(lambda x, a: x**2 - a, 0.0, 10.0, jnp.array([0.0, 100.0, 25.0, 101.0, -1.0, jnp.nan]))
    np.testing.assert_allclose(root.value, [0.0, 10.0, 5.0, np.nan, np.nan, np.nan])
    assert root.converged.tolist() == [True, True, True, False, False, False]


def test_infinite_function_at_an_end() -> None:
    root = find_root(lambda x: jnp.log(x) + 5.0, 0.0, 1.0)
    np.testing.assert_allclose(root.value, np.exp(-5.0), rtol=1e-12)


def test_infinite_slope_at_an_end() -> None:
    root = find_root(lambda x, a: jnp.sqrt(x) - a, 0.0, 1.0, jnp.array([1e-6, 0.3, 0.0]), start=0.0)
    np.testing.assert_allclose(root.value, [1e-12, 0.09, 0.0], rtol=1e-9)


def test_pole_is_not_a_root() -> None:
    assert not find_root(lambda x: 1.0 / (x - 0.3), -1.0, 2.0).converged


def test_running_out_of_steps_is_told() -> None:
    root = find_root(lambda x: jnp.exp(x) - 20.0, -50.0, 50.0, max_steps=2)
    assert not root.converged
    assert jnp.isfinite(root.value)


def test_a_newton_step_that_rounds_to_nothing_ends_the_search() -> None:
    """Newton's method may land on the root to the last digit from any start; then its next step says nothing
    of the other side.
    """
    starts = np.random.default_rng(5).uniform(1.0, 1000.0, 400)
    alone = jax.jit(
        lambda start: find_root(lambda x: x - 20.0 * jnp.log(x) - 3.0, 21.0, 1000.0, start=start).steps
    )
    assert max(int(alone(start)) for start in starts) < 20


@pytest.mark.parametrize("bracket", [(-1.0, 1.0), (-1.0, 1e3), (0.0, 1.0), (-1e-3, 1e9)])
def test_narrow_root_in_a_wide_bracket(bracket: tuple[float, float]) -> None:
    c = jnp.array([1e-200, 1e-30, 1e-9, 0.5])
    root = find_root(lambda x, c: jnp.tanh(1e3 * (x - c) / c), *bracket, c)
    assert root.converged.all()
    scale = np.maximum(c, min(abs(bracket[0]), abs(bracket[1])))
    assert (abs(root.value - c) <= 1e-9 * scale).all()


NASTY = {
    "flat": lambda s: s**9,
    "steep": lambda s: jnp.cbrt(s),
    "step": lambda s: jnp.sign(s),
    "kink": lambda s: jnp.where(s < 0, 1e-8 * s, 1e8 * s),
    "wave": lambda s: s * (1.1 + jnp.sin(50.0 * s)),
    "saturated": lambda s: jnp.tanh(1e5 * s),
    "exponential": lambda s: jnp.expm1(60.0 * s),
}


@given(
    st.sampled_from(sorted(NASTY)),
    st.floats(-1e3, 1e3),
    st.floats(1e-6, 1e3),
    st.floats(1e-6, 1e3),
    st.booleans(),
)
def test_no_root_is_lost(name: str, at: float, left: float, right: float, falling: bool) -> None:
    sign = -1.0 if falling else 1.0
    lower, upper = at - left, at + right
    root = solve_nasty[name](sign, at, lower, upper)
    assert root.converged
    assert lower <= root.value <= upper
    scale = max(abs(at), min(abs(lower), abs(upper)))
    assert abs(root.value - at) <= 2.5e-10 * scale


def test_a_small_newton_step_is_no_proof() -> None:
    # Far from its only root this function is so steep that Newton steps are tiny everywhere.
    a = jnp.array([0.5, 1e4, -3e5])
    root = find_root(lambda x, a: (x - a) * (1.1 + jnp.sin(50.0 * (x - a))), -1e8, 2e8, a)
    assert root.converged.all()
    np.testing.assert_allclose(root.value, a, atol=2e-2)


solve_nasty = {
    name: jax.jit(lambda sign, at, lower, upper, f=f: find_root(lambda x: sign * f(x - at), lower, upper))
    for name, f in NASTY.items()
}


@given(st.lists(st.floats(-10.0, 10.0), min_size=4, max_size=4))
def test_any_cubic_with_a_sign_change(coefficients: list[float]) -> None:
    c = jnp.array(coefficients)
    root = solve_cubic(c)
    ends = jnp.polyval(c, jnp.array([-2.0, 3.0]))
    if ends[0] * ends[1] < 0:
        assert root.converged
        assert -2.0 <= root.value <= 3.0
        steepest = jnp.polyval(jnp.polyder(abs(c)), abs(root.value) + 1e-9)
        assert abs(root.residual) <= 1e-9 * steepest + 1e-14 * jnp.polyval(abs(c), abs(root.value))
    elif ends[0] * ends[1] > 0:
        assert jnp.isnan(root.value)


solve_cubic = jax.jit(lambda c: find_root(lambda x: jnp.polyval(c, x), -2.0, 3.0))


def cube_root(a: jax.Array) -> jax.Array:
    return find_root(lambda x, a: x**3 - a, 0.0, 10.0, a).value


def cube_root_by_closure(a: jax.Array) -> jax.Array:
    return find_root(lambda x: x**3 - a, 0.0, 10.0).value


@pytest.mark.parametrize("solve", [cube_root, cube_root_by_closure])
def test_derivatives_of_any_order(solve) -> None:
    a = 5.0
    np.testing.assert_allclose(jax.grad(solve)(a), a ** (-2 / 3) / 3, rtol=1e-13)
    np.testing.assert_allclose(jax.jacfwd(solve)(a), a ** (-2 / 3) / 3, rtol=1e-13)
    second = -2 / 9 * a ** (-5 / 3)
    for derivative in (jax.grad(jax.grad(solve)), jax.jacfwd(jax.grad(solve)), jax.jacfwd(jax.jacfwd(solve))):
        np.testing.assert_allclose(jax.jit(derivative)(a), second, rtol=1e-12)
    many = jnp.array([1.0, 8.0, 27.0])
    np.testing.assert_allclose(jax.vmap(jax.grad(solve))(many), many ** (-2 / 3) / 3, rtol=1e-13)
    np.testing.assert_allclose(jax.jacrev(solve)(many), jnp.diag(many ** (-2 / 3) / 3), rtol=1e-13)


def test_pytree_arguments() -> None:
    def line(x, p):
        return p["slope"] * x - p["level"]

    gradient = jax.grad(lambda p: find_root(line, -9.0, 9.0, p).value)({"slope": 2.0, "level": 3.0})
    np.testing.assert_allclose(gradient["level"], 1 / 2)
    np.testing.assert_allclose(gradient["slope"], -3 / 4)


def test_gradients_stay_finite_where_there_is_no_root() -> None:
    a = jnp.array([4.0, -1.0, 1e6])
    gradient = jax.grad(lambda a: jnp.nansum(find_root(lambda x, a: x**2 - a, 0.0, 10.0, a).value))(a)
    np.testing.assert_allclose(gradient, [0.25, 0.0, 0.0])


def test_gradient_at_a_double_root_is_finite() -> None:
    gradient = jax.grad(lambda a: find_root(lambda x: (x - a) ** 3, -1.0, 2.0).value)(0.5)
    assert jnp.isfinite(gradient)


def test_jit_vmap_and_eager_agree() -> None:
    a = jnp.linspace(0.1, 900.0, 11)
    eager = cube_root(a)
    np.testing.assert_array_equal(jax.jit(cube_root)(a), eager)
    np.testing.assert_allclose(jax.vmap(cube_root)(a), eager, rtol=1e-15)
    np.testing.assert_allclose([cube_root(each) for each in a[:2]], eager[:2], rtol=1e-15)
