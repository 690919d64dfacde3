"""Programs run by NumPy give what the compiler's give, operation by operation and in whole formulas."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jax import lax
from jax.scipy.linalg import solve_triangular

from granum.core.compiling import begun, once
from granum.core.uncompiled import Program

X = np.array([[-2.5, -1.0, 0.0, 0.4], [0.9, 1.5, 3.0, 7.25], [-0.0, 2.5, 11.0, 0.05]])
V = np.array([0.3, -1.2, 2.0, 0.3])
ODD = np.array([np.nan, np.inf, -np.inf, 0.0, -0.0, 1e300, -1e19, 2.5, -3.0])
WHOLE = np.array([3, 0, 2, 2, -7, 9])

ONE_BY_ONE: tuple[Callable[[Any], Any], ...] = (
    jnp.abs, jnp.sign, jnp.floor, jnp.ceil, jnp.round, jnp.sqrt, lax.rsqrt, jnp.cbrt, jnp.square, jnp.exp,
    jnp.exp2, jnp.expm1, jnp.log, jnp.log1p, jnp.sin, jnp.cos, jnp.tan, jnp.arcsin, jnp.arccos, jnp.arctan,
    jnp.sinh, jnp.cosh, jnp.tanh, jnp.arcsinh, jnp.arccosh, jnp.arctanh, jnp.isfinite,
    jax.scipy.special.erf, jax.scipy.special.erfc,
    lambda x: jax.scipy.special.gammaln(abs(x)), lambda x: x**3, lambda x: x**-2, lambda x: x**0.7,
    lambda x: -x, lambda x: lax.convert_element_type(x, int), lambda x: jnp.arctan2(x, 0.5),
    lambda x: jnp.fmod(x, 0.7),
    lambda x: jnp.clip(x, -1.0, 2.0), lambda x: jnp.where(x > 0.0, x, 1.0), lambda x: (x < 1.0) ^ (x != 0.0),
    lambda x: jnp.nextafter(x, 1.0), lambda x: jnp.maximum(x, 0.1) - jnp.minimum(x, 0.1), jnp.nan_to_num,
)  # fmt: skip

OF_ARRAYS: dict[str, Callable[[Any, Any], Any]] = {
    "sums": lambda x, _v: (x.sum(), x.sum(0), jnp.prod(x, 1), x.max(1), x.min(), jnp.all(x > 0), jnp.any(x)),
    "places": lambda x, _v: (jnp.argmax(x, 1), jnp.argmin(x), jnp.searchsorted(x[1], x)),
    "running": lambda x, _v: (
        jnp.cumsum(x, 1), jnp.cumprod(x, 0), lax.cummax(x, 1), lax.cummin(x, 0, reverse=True),
        lax.cumsum(x, 1, reverse=True),
    ),
    "products": lambda x, v: (x @ v, x @ x.T, jnp.vdot(v, v), jnp.einsum("ij,ij->i", x, x)),
    "shapes": lambda x, v: (
        x.T, x[::-1, 1:3], x.reshape(2, 6), jnp.squeeze(x[:, :1]), jnp.stack([v, v]), jnp.roll(v, 1),
        jnp.concatenate([x, x]), jnp.pad(x, 1), jnp.broadcast_to(v, (3, 4)), jnp.arange(4) * v, v[:, None],
        jnp.split(v, 2), jnp.diff(x), jnp.flip(v), jnp.tile(v, 2), jnp.tile(x, (2, 3)), jnp.eye(4)[1] * v,
    ),
    "picked": lambda x, v: (
        x[jnp.array([0, 2, 5]), 1], x[:, jnp.array([3, 0])], jnp.take(v, jnp.array([1, 9])), v[WHOLE],
        jnp.take(v, WHOLE, mode="clip"), x.at[1].get(), jnp.take_along_axis(x, jnp.argsort(x), 1),
    ),
    "changed": lambda x, v: (
        x.at[1].set(v), x.at[:, 2].add(1.0), v.at[jnp.array([0, 0, 3, 7])].add(2.0), v.at[0].multiply(3.0),
        x.at[1:, 1:3].set(0.0), v.at[jnp.array([1, 2])].multiply(0.0), x.at[jnp.array([0, 2])].set(v),
    ),
    "windows": lambda x, v: (
        lax.dynamic_slice(v, (2,), (3,)), lax.dynamic_update_slice(v, jnp.ones(3), (-1,)),
        lax.dynamic_slice(x, (1, 9), (2, 2)),
        jax.vmap(lambda i: lax.dynamic_slice(v, (i,), (2,)))(jnp.array([0, 1, 9, -5])),
        jax.vmap(lambda i: lax.dynamic_slice(x, (1, i), (2, 3)))(jnp.array([[0, 2], [1, 5]]).ravel()),
        jax.vmap(lambda i: lax.dynamic_slice(x, (i, 1), (1, 3))[0], out_axes=1)(jnp.array([0, 7])),
    ),
    "sorted": lambda x, v: (
        jnp.sort(v), jnp.argsort(x, 0), jnp.median(x), jnp.unique(v, size=4), jnp.sort(x, 0),
        lax.sort((x > 1.0, x), dimension=1), lax.sort((x > 1.0, x), dimension=0, num_keys=2),
    ),
    "interpolated": lambda x, v: (jnp.interp(x, jnp.sort(v), v), jnp.polyval(v, x)),
    "solved": lambda x, v: (
        lax.linalg.lu(x[:, :3]), jnp.linalg.solve(x[:, :3] + 9.0 * jnp.eye(3), v[:3]),
        jnp.linalg.lstsq(x[:, :2], v[:3])[0],
        jnp.linalg.qr(x[:, :2]), jnp.max(x[:0], initial=1.0),
        solve_triangular(x[:, :3] + 9.0 * jnp.eye(3), v[:3], trans=1),
        solve_triangular(x[:, :3], x, lower=True, unit_diagonal=True),
        lax.custom_linear_solve(lambda y: 2.0 * y, v, solve=lambda _f, b: b / 2.0),
    ),
    "loops": lambda x, v: (
        lax.while_loop(lambda c: c[0] < 5, lambda c: (c[0] + 1, c[1] * 1.1), (0, v)),
        lax.fori_loop(0, 4, lambda i, y: y + i * v, v),
        lax.scan(lambda c, row: (c + row, c * row.sum()), v, x),
        lax.scan(lambda c, row: (c + row, c), v, x, reverse=True),
        lax.map(lambda row: row @ v, x),
    ),
    "several at once": lambda x, v: (
        jax.vmap(lambda y: lax.while_loop(lambda z: z < 10.0, lambda z: z * z + 1.0, y))(v),
        jax.vmap(lambda y, i: lax.dynamic_slice(y, (i,), (2,)))(x, jnp.array([0, 2, 9])),
        jax.vmap(lambda y, i: y[i])(x, jnp.array([3, 9, 1])),
        jax.vmap(lambda y, i: y[i])(x, WHOLE.reshape(3, 2)),
        jax.vmap(lambda y, i: y[:, i])(jnp.stack([x, 2 * x, 3 * x]), jnp.array([3, 0, 1])),
        jax.vmap(lambda y, i: y.at[i].set(5.0))(x, jnp.array([0, 2, 3])),
    ),
    "choices": lambda x, v: (
        lax.cond(v[0] > 0, lambda: x.sum(), lambda: v.sum()),
        lax.switch(jnp.int32(7), [lambda: v, lambda: 2 * v, lambda: 3 * v]),
        lax.select_n(jnp.array([0, 2, 1, 1]), v, 2 * v, 3 * v), lax.reduce_max(x[:0], (0, 1)),
        lax.select_n(jnp.int32(2), v, 2 * v, 3 * v),
    ),
    "derivatives": lambda x, v: (
        jax.grad(lambda y: jnp.sum(jnp.tanh(x @ y)))(v),
        jax.jacfwd(lambda y: jnp.where(y > 0, y**2, jnp.exp(y)))(v),
        jax.jvp(lambda y: jnp.sort(y) * jnp.logaddexp(y, 0.0), (v,), (2 * v,)),
    ),
}  # fmt: skip


def same(function: Callable[..., Any], *given: Any) -> None:
    compiled, uncompiled = jax.jit(function)(*given), once(function, *given)
    for one, other in zip(jax.tree.leaves(compiled), jax.tree.leaves(uncompiled), strict=True):
        assert np.shape(one) == np.shape(other)
        assert np.asarray(one).dtype == np.asarray(other).dtype
        np.testing.assert_allclose(other, one, rtol=1e-13, atol=1e-13)


@pytest.mark.parametrize("which", range(len(ONE_BY_ONE)))
def test_operations_on_numbers(which: int) -> None:
    same(ONE_BY_ONE[which], X)
    same(ONE_BY_ONE[which], 0.7)
    same(ONE_BY_ONE[which], ODD)


@pytest.mark.parametrize("which", OF_ARRAYS)
def test_operations_on_arrays(which: str) -> None:
    same(OF_ARRAYS[which], X, V)


def test_numbers_of_indices_and_bits() -> None:
    same(lambda n: (n // 2, n % 3, n << 1, n >> 1, ~n, n & 6, n.astype(float) / 7, n.max(), -n), WHOLE)
    same(lambda x: lax.bitcast_convert_type(x, jnp.int64), X)
    same(lambda n: jnp.asarray(n).at[jnp.array([4, 0])].get(mode="promise_in_bounds"), WHOLE)
    same(lambda x: lax.sort(x), np.array([0.0, -0.0, np.inf, -1.0, np.nan, -np.inf]))


def test_a_program_may_run_while_another_is_traced() -> None:
    """A material is built when a formula that is being traced first asks for it."""

    def outer(x: Any) -> Any:
        return x * float(once(lambda y: jnp.searchsorted(jnp.arange(3.0), jnp.sort(y))[0], V[:1]))

    assert jax.jit(outer)(2.0) == 2.0


def test_a_long_loop_goes_on_compiled_from_where_it_is() -> None:
    def function(x: Any) -> Any:
        return lax.while_loop(lambda y: y < 1e6, lambda y: y + 1.0, x)

    found, steps = Program(jax.make_jaxpr(function)(0.5)).run([0.5])
    assert found == [1e6 + 0.5]
    assert steps < 1e5


def test_a_loop_bound_to_be_long_is_compiled_at_once() -> None:
    def function(x: Any) -> Any:
        return lax.scan(lambda c, _n: (jnp.sin(c) + 1.0, c), x, length=200_000)

    found, steps = Program(jax.make_jaxpr(function)(0.5)).run([0.5])
    assert steps < 1000
    np.testing.assert_allclose(found[1], jax.jit(function)(0.5)[1], rtol=1e-12)


def test_what_is_called_often_is_compiled() -> None:
    ready = begun(lambda x: {"cube": x**3})
    values = [ready(0.1 * k)["cube"] for k in range(1000)]
    np.testing.assert_allclose(values, (0.1 * np.arange(1000)) ** 3, rtol=1e-14)
    assert isinstance(values[0], np.floating)
    assert isinstance(values[-1], jax.Array)


def test_what_has_begun_is_still_a_function_of_jax() -> None:
    ready = begun(lambda x: jnp.sin(x).sum())
    assert float(jax.grad(ready)(V)[1]) == pytest.approx(np.cos(-1.2))
    np.testing.assert_allclose(jax.vmap(ready)(X), np.sin(X).sum(1))
    assert float(ready(X)) == pytest.approx(np.sin(X).sum())
