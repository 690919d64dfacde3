"""Fixed points and systems: known answers, implicit derivatives, honest failures."""

from collections.abc import Callable

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.numerics import Anderson, Newton, fixed_point, settle, solve_system

METHODS = [Anderson(), Anderson(window=1), Anderson(damping=0.5), Anderson(plain=4), Newton()]


@pytest.mark.parametrize("method", METHODS)
def test_cosine(method) -> None:
    solution = fixed_point(lambda x, a: jnp.cos(a * x), 1.0, 1.0, method=method)
    assert solution.converged
    np.testing.assert_allclose(solution.state, 0.7390851332151607, rtol=1e-10)
    assert abs(jnp.cos(solution.state) - solution.state) <= 1e-10


@pytest.mark.parametrize("method", METHODS)
def test_linear_recycle_with_mixed_sizes(method) -> None:
    matrix = jnp.array([[0.5, 0.3], [0.2, 0.6]])

    def loop(state, feed):
        return {
            "mass": matrix @ state["mass"] + feed,
            "heat": 0.9 * state["heat"] + 30.0 + 1e3 * jnp.sum(state["mass"]),
        }

    feed = jnp.array([1e-3, 2e-3])
    solution = fixed_point(loop, {"mass": jnp.zeros(2), "heat": 290.0}, feed, method=method)
    mass = np.linalg.solve(np.eye(2) - matrix, feed)
    assert solution.converged
    np.testing.assert_allclose(solution.state["mass"], mass, rtol=1e-6)
    np.testing.assert_allclose(solution.state["heat"], 300.0 + 1e4 * mass.sum(), rtol=1e-6)


@pytest.mark.parametrize("method", [Anderson(), Newton()])
def test_derivatives_are_implicit(method) -> None:
    def solve(a):
        return fixed_point(lambda x, b: jnp.cos(a * x) + b, 1.0, 0.0, method=method).state

    a = 1.2
    x = float(solve(a))
    first = -x * np.sin(a * x) / (1.0 + a * np.sin(a * x))
    np.testing.assert_allclose(jax.grad(solve)(a), first, rtol=1e-8)
    np.testing.assert_allclose(jax.jit(jax.jacfwd(solve))(a), first, rtol=1e-8)
    s, c = np.sin(a * x), np.cos(a * x)
    dxs = c * (x + a * first)
    second = -((first * s + x * dxs) * (1.0 + a * s) - x * s * (s + a * dxs)) / (1.0 + a * s) ** 2
    np.testing.assert_allclose(jax.grad(jax.grad(solve))(a), second, rtol=1e-7)


@pytest.mark.parametrize("method", [Anderson(), Newton()])
def test_derivatives_do_not_depend_on_the_start(method) -> None:
    matrix = 0.4 * jnp.array([[1.0, -0.5], [0.25, 1.0]])

    def total(feed, start):
        return jnp.sum(fixed_point(lambda x, f: matrix @ x + f, start, feed, method=method).state)

    expected = np.linalg.solve(np.eye(2) - matrix.T, np.ones(2))
    exact = jnp.linalg.solve(jnp.eye(2) - matrix, jnp.ones(2))
    for start in (jnp.zeros(2), exact):
        np.testing.assert_allclose(jax.grad(total)(jnp.ones(2), start), expected, rtol=1e-12)
        np.testing.assert_allclose(jax.grad(total, argnums=1)(jnp.ones(2), start), 0.0)


def test_many_unknowns_go_by_krylov() -> None:
    n = 400
    shape = jnp.linspace(0.5, 1.5, n)

    def solve(a):
        def loop(x, a):
            return 0.4 * jnp.sin(x + jnp.roll(x, 1)) + a * shape

        return fixed_point(loop, jnp.zeros(n), a, method=Newton())

    def everything(a):
        return (
            solve(a),
            jax.jvp(lambda a: solve(a).state, (a,), (1.0,))[1],
            jax.grad(lambda a: solve(a).state.sum())(a),
        )

    solution, forward, reverse = jax.jit(everything)(1.0)
    assert solution.converged
    jacobian = jax.jacfwd(lambda x: 0.4 * jnp.sin(x + jnp.roll(x, 1)))(solution.state)
    expected = np.linalg.solve(np.eye(n) - jacobian, shape)
    np.testing.assert_allclose(forward, expected, rtol=1e-7)
    np.testing.assert_allclose(reverse, expected.sum(), rtol=1e-7)


@pytest.mark.parametrize("method", [Anderson(), Newton()])
@pytest.mark.parametrize(
    "loop",
    [lambda x, _: x + 1.0, lambda x, _: jnp.nan * x, lambda x, _: x**2 + 1.0],
    ids=["drift", "nan", "none"],
)
def test_no_fixed_point_is_never_reported_as_one(loop, method) -> None:
    solution = fixed_point(loop, 0.5, method=method, max_steps=60)
    assert not solution.converged
    assert jnp.isfinite(solution.state)
    assert not solution.residual <= 1e-10


@pytest.mark.parametrize(
    ("loop", "start", "answer"),
    [
        (lambda x, _: 3.0 * x - 1.0, 0.0, 0.5),
        (lambda x, _: x**-3.0, 5.0, 1.0),
        (lambda x, _: jnp.sqrt(x - 1.0) + 1.2, 1.01, 1.7 + np.sqrt(0.45)),
    ],
    ids=["repelling", "oscillating", "edge of domain"],
)
def test_anderson_recovers_from_bad_steps(loop, start: float, answer: float) -> None:
    solution = fixed_point(loop, start)
    assert solution.converged
    np.testing.assert_allclose(solution.state, answer, rtol=1e-9)


def test_first_steps_may_be_repeated_substitution() -> None:
    def fills(x: jax.Array, _: None) -> jax.Array:
        return 0.9 * x + jnp.array([1.0, 2.0])

    method = Anderson(plain=4)
    filled = fixed_point(fills, jnp.zeros(2), method=method, scale=1.0, max_steps=4)
    np.testing.assert_allclose(filled.state, [2.71, 5.42])  # 1 + 0.9 + 0.81, and twice as much
    full = fixed_point(fills, jnp.zeros(2), method=method, scale=1.0, max_steps=8)
    assert full.converged
    np.testing.assert_allclose(full.state, [10.0, 20.0])


def test_a_recycle_without_numbers_while_it_fills_is_filled_more_slowly() -> None:
    def overflows(x: jax.Array, _: None) -> jax.Array:
        return 4.6 - x**2 + jnp.sqrt(5.0 - x)  # 6.8 from an empty start, where the next has no number

    found = fixed_point(overflows, 0.0, method=Anderson(plain=4), scale=1.0)
    assert found.converged
    np.testing.assert_allclose(overflows(found.state, None), found.state)


def test_what_had_come_to_rest_goes_on_where_its_neighbor_moved_a_little() -> None:
    """Residuals that jump from nothing to 1e-9, as behind a loop that settles later."""

    def loop(given: float) -> Callable[[jax.Array], tuple[jax.Array, tuple[()]]]:
        return lambda x: (0.5 * x + given, ())

    first = settle(loop(1.0), jnp.zeros(3), tolerance=1e-12)
    assert first.converged
    assert first.residual == 0.0
    after = int(first.steps) + 4
    again = settle(loop(1.0 + 1e-9), jnp.zeros(3), tolerance=1e-12, known=first.known, max_steps=after)
    assert again.converged
    np.testing.assert_allclose(again.state, 2.0 + 2e-9, rtol=1e-12)


def test_running_out_of_steps_keeps_the_last_iterate() -> None:
    solution = fixed_point(
        lambda x, _: 0.99 * x + 1.0, jnp.zeros(3), method=Anderson(damping=0.1), max_steps=1
    )
    assert not solution.converged
    assert int(solution.steps) == 1
    np.testing.assert_allclose(solution.state, 0.0)


@pytest.mark.parametrize("method", [Anderson(), Newton()])
def test_batches(method) -> None:
    a = jnp.linspace(0.1, 1.2, 5)
    batch = jax.jit(jax.vmap(lambda a: fixed_point(lambda x, a: jnp.cos(a * x), 1.0, a, method=method)))(a)
    assert batch.converged.all()
    np.testing.assert_allclose(batch.state, jnp.cos(a * batch.state), rtol=1e-9)


def test_system_from_a_poor_start() -> None:
    # Powell's badly scaled function, solution from More, Garbow and Hillstrom (1981), problem 3.
    def powell(x, _):
        return jnp.array([1e4 * x[0] * x[1] - 1.0, jnp.exp(-x[0]) + jnp.exp(-x[1]) - 1.0001])

    solution = solve_system(powell, jnp.array([0.0, 1.0]), max_steps=100)
    assert solution.converged
    np.testing.assert_allclose(solution.state, [1.098e-5, 9.106], rtol=1e-3)


def test_system_derivatives() -> None:
    def solve(p):
        return solve_system(
            lambda x, p: jnp.array([x[0] * x[1] - p[0], x[0] - p[1] * x[1]]), jnp.array([1.0, 1.0]), p
        ).state

    p = jnp.array([6.0, 1.5])
    x = jnp.sqrt(p[0] * p[1])
    y = jnp.sqrt(p[0] / p[1])
    expected = [[0.5 * x / p[0], 0.5 * x / p[1]], [0.5 * y / p[0], -0.5 * y / p[1]]]
    np.testing.assert_allclose(solve(p), [x, y], rtol=1e-9)
    np.testing.assert_allclose(jax.jacfwd(solve)(p), expected, rtol=1e-8)
    np.testing.assert_allclose(jax.jacrev(solve)(p), expected, rtol=1e-8)
