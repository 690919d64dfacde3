"""Fixed points and roots of systems, for any pytree of unknowns, with implicit derivatives."""

from abc import abstractmethod
from collections.abc import Callable
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax
from jax.flatten_util import ravel_pytree

from granum.numerics.implicit import implicit_root

DENSE_LIMIT = 256
"""Up to this many unknowns linear systems are solved by a dense factorization, beyond by GMRES."""

Residual = Callable[[jax.Array], jax.Array]


class Solution(NamedTuple):
    """Outcome of `fixed_point` and `solve_system`.

    state: the solution, or the best iterate where it did not converge.
    converged: True only if the residual at `state` was measured within the tolerance.
    steps: number of iterations.
    residual: largest scaled residual at `state`.
    """

    state: Any
    converged: jax.Array
    steps: jax.Array
    residual: jax.Array


class AbstractMethod(eqx.Module):
    """A way to bring a residual vector to zero."""

    @abstractmethod
    def solve(
        self, residual: Residual, start: jax.Array, tolerance: float, max_steps: int
    ) -> tuple[jax.Array, jax.Array, jax.Array]:
        """The best iterate, shape ``(n,)``, its largest residual, and the number of steps.

        Unknowns and residuals, both shape ``(n,)``, are scaled to about one; ``residual`` is
        ``g(x) - x`` for a fixed point of ``g``.
        """


class Anderson(AbstractMethod):
    """Anderson acceleration: repeated substitution that learns from its last steps.

    No derivatives, one evaluation a step; best for recycles, which nearly contract. Where the
    residual more than doubles the best one, the step is taken back. Once, if it has not grown
    tenfold, a new one is tried with what it taught; otherwise, or where it is not finite, the past
    is forgotten and a plain step is tried, halved each time that this happens in a row.

    What the best residual was is forgotten every ``leniency`` steps: a recycle that fills often gets
    worse before it gets better, and steps held to one lucky point would never leave it. What a recycle
    does while it fills says little of what it does when it is full: the first steps may be ``plain``.

    Parameters
    ----------
    window: number of earlier points remembered.
    damping: part of each step taken, in (0, 1].
    leniency: steps after which a worse residual than the best is allowed once.
    plain: steps of repeated substitution before any is learned from.
    """

    window: int = eqx.field(static=True, default=5)
    damping: float = 1.0
    leniency: int = eqx.field(static=True, default=10)
    plain: Any = 0

    def begin(self, start: jax.Array) -> tuple:
        """The state of an iteration that has evaluated nothing yet; its first item is where to evaluate, its
        second the best so far.
        """
        history = jnp.zeros((min(self.window, start.size) + 1, start.size), start.dtype)
        zero = jnp.zeros((), int)
        infinite = jnp.full((), jnp.inf, start.dtype)
        still = jnp.zeros_like(start)
        return start, (start, infinite), (start, still), history, history, infinite, zero, zero

    def resumed(self, carry: tuple, tolerance: float) -> tuple:
        """The state to go on with. One that had come to rest begins to learn anew: what it knows of residuals
        is older than they are.
        """
        *others, least, rejected, number = carry
        rested = least <= tolerance  # told to ``proceed`` as fewer rejections than none
        return *others, jnp.where(rested, jnp.inf, least), jnp.where(rested, -1, rejected), number

    def hopes(self, carry: tuple) -> jax.Array:
        """Whether it makes sense to go on."""
        return jnp.asarray(True)

    def moves(self, carry: tuple) -> jax.Array:
        """Whether the state is a step toward rest, and not one that measures slopes."""
        return jnp.asarray(True)

    def proceed(self, carry: tuple, r: jax.Array) -> tuple:
        """The next state, given the residual at its first item."""
        x, best, base, points, residuals, least, rejected_before, number = carry
        slots = len(points)
        size = largest(r)
        least = jnp.where(number % self.leniency == 0, jnp.inf, least)
        filling = (number < self.plain) & jnp.isfinite(size)
        least = jnp.where(filling, size, least)
        # the start is often an empty stream, whose residual says little: the first step from it may look far
        # worse and be right
        second = (number == jnp.maximum(self.plain, 1)) & jnp.isfinite(size) & (size <= 100.0 * least)
        accepted = second | ((size <= 2.0 * least) & (jnp.isfinite(size) | (number == 0)))
        instructive = ~accepted & (size <= 10.0 * least) & (rejected_before == 0) & jnp.isfinite(size)
        least = jnp.where(second, size, jnp.minimum(size, least))
        best = chosen(second | (size < best[1]), (x, size), best)
        base = chosen(accepted, (x, r), base)
        rejected = jnp.where(accepted, 0, rejected_before + 1)
        slot = number % slots
        points, residuals = chosen(
            accepted | instructive,
            (points.at[slot].set(x), residuals.at[slot].set(r)),
            (jnp.broadcast_to(base[0], points.shape), jnp.broadcast_to(base[1], points.shape)),
        )
        forgets = filling | (number == 0) | (rejected_before < 0)
        points = jnp.where(forgets, x, points)
        residuals = jnp.where(forgets, r, residuals)
        moves, changes = points - base[0], residuals - base[1]
        move = self.damping * base[1]
        move = move - _fitted(changes, base[1]) @ (moves + self.damping * changes)
        length = jnp.where(instructive, 1.0, 0.5**rejected)
        return base[0] + length * move, best, base, points, residuals, least, rejected, number + 1

    def solve(
        self, residual: Residual, start: jax.Array, tolerance: float, max_steps: int
    ) -> tuple[jax.Array, jax.Array, jax.Array]:
        carry = lax.while_loop(
            lambda carry: (carry[1][1] > tolerance) & (carry[-1] < max_steps),
            lambda carry: self.proceed(carry, residual(carry[0])),
            self.begin(start),
        )
        (x, size), number = carry[1], carry[-1]
        return x, size, number


class Newton(AbstractMethod):
    """Newton's method with backtracking: few steps, each with all the derivatives.

    Up to `DENSE_LIMIT` unknowns the Jacobian is formed and factorized, beyond that the step is
    found by GMRES from directional derivatives alone.

    Parameters
    ----------
    halvings: how often a step may be halved until the residual shrinks.
    """

    halvings: int = eqx.field(static=True, default=20)

    def solve(
        self, residual: Residual, start: jax.Array, tolerance: float, max_steps: int
    ) -> tuple[jax.Array, jax.Array, jax.Array]:
        def step(carry: tuple) -> tuple:
            x, _, _, number = carry
            r, linear = jax.linearize(residual, x)
            direction = -solve_linear(linear, r)

            def shorten(trial: tuple) -> tuple:
                length = 0.5 * trial[0]
                ahead = x + length * direction
                return length, ahead, residual(ahead), trial[3] + 1

            def too_long(trial: tuple) -> jax.Array:
                length, _, r_ahead, count = trial
                enough = _norm(r_ahead) <= (1.0 - 1e-4 * length) * _norm(r)
                return ~enough & (count <= self.halvings)

            first = (jnp.full((), 2.0, x.dtype), x, jnp.full_like(r, jnp.inf), jnp.zeros((), int))
            _, ahead, r_ahead, _ = lax.while_loop(too_long, shorten, first)
            better = _norm(r_ahead) < _norm(r)
            x, r = chosen(better, (ahead, r_ahead), (x, r))
            return x, largest(r), ~better, number + 1

        def unfinished(carry: tuple) -> jax.Array:
            _, size, stuck, number = carry
            return (size > tolerance) & ~stuck & (number < max_steps)

        size = jnp.full((), jnp.inf, start.dtype)
        carry = (start, size, jnp.zeros((), bool), jnp.zeros((), int))
        x, size, _, number = lax.while_loop(unfinished, step, carry)
        return x, size, number


def fixed_point(
    function: Callable[[Any, Any], Any],
    start: Any,
    args: Any = None,
    *,
    method: AbstractMethod = Anderson(),
    tolerance: float = 1e-10,
    max_steps: int = 200,
    scale: Any = None,
) -> Solution:
    """Solve ``function(state, args) == state``.

    Parameters
    ----------
    function: returns a pytree like the state; it may close over traced values.
    start: first guess, a pytree of real arrays.
    args: handed to the function.
    method: `Anderson` or `Newton`.
    tolerance: on the largest change of any unknown by the function, relative to its scale.
    max_steps: most iterations.
    scale: typical sizes, a pytree like the state or a prefix of it; for each leaf by default
        its largest magnitude in the start or its image, or 1 if both are zero. A state that
        grew so far beyond its scale that rounding exceeds the tolerance is not accepted.

    Returns
    -------
    A `Solution`. Nothing raises; without convergence ``state`` is the best iterate.

    Derivatives with respect to ``args`` and closed-over values follow from the implicit function
    theorem, forward and reverse, at any order and whatever the number of iterations. They are
    meaningless where ``converged`` is False.

    Example:
        >>> solution = fixed_point(lambda x, a: jnp.cos(a * x), jnp.array(1.0), 1.0)
        >>> solution.state
        Array(0.73908513, dtype=float64)
    """
    start = as_real(start)
    if scale is None:
        image = lax.stop_gradient(function(start, args))
        scale = jax.tree.map(_typical, start, image)

    def residual(state: Any) -> Any:
        return jax.tree.map(jnp.subtract, function(state, args), state)

    found, scaled = _solve(residual, start, scale, scale, method, tolerance, max_steps)
    # A change smaller than the rounding of a state that ran away proves nothing.
    rounding = jnp.finfo(scaled.dtype).eps * largest(scaled)
    return found._replace(
        converged=found.converged & (rounding <= tolerance), residual=jnp.maximum(found.residual, rounding)
    )


def solve_system(
    function: Callable[[Any, Any], Any],
    start: Any,
    args: Any = None,
    *,
    method: AbstractMethod = Newton(),
    tolerance: float = 1e-10,
    max_steps: int = 50,
    scale: Any = None,
    residual_scale: Any = None,
) -> Solution:
    """Solve ``function(state, args) == 0``, as many equations as unknowns.

    Parameters
    ----------
    function: returns a pytree with as many numbers as the state.
    start, args, method, tolerance, max_steps: as for `fixed_point`.
    scale: typical sizes of the unknowns; by default the magnitude of each leaf of the start,
        or 1 if that is zero.
    residual_scale: sizes below which, times the tolerance, equations count as solved, a pytree
        like the result of the function or a prefix; by default its largest magnitude at the
        start for each leaf, or 1 if that is zero.

    Returns
    -------
    A `Solution`, with derivatives as for `fixed_point`.

    Example:
        >>> solve_system(lambda x, a: x**2 - a, jnp.array([1.0, 1.0]), jnp.array([4.0, 9.0])).state
        Array([2., 3.], dtype=float64)
    """
    start = as_real(start)
    if scale is None:
        scale = jax.tree.map(_typical, start, start)
    if residual_scale is None:
        first = lax.stop_gradient(function(start, args))
        residual_scale = jax.tree.map(_typical, first, first)
    found, _ = _solve(
        lambda state: function(state, args),
        start,
        scale,
        residual_scale,
        method,
        tolerance,
        max_steps,
    )
    return found


def _solve(
    residual: Callable[[Any], Any],
    start: Any,
    scale: Any,
    residual_scale: Any,
    method: AbstractMethod,
    tolerance: float,
    max_steps: int,
) -> tuple[Solution, jax.Array]:
    """The solution, and its unknowns in units of their scales, shape ``(n,)``."""
    flat, unflatten = ravel_pytree(lax.stop_gradient(start))
    unit = _spread(scale, start)
    weight = 1.0 / _spread(residual_scale, jax.eval_shape(residual, start))

    def scaled(u: jax.Array) -> jax.Array:
        return weight * ravel_pytree(residual(unflatten(unit * u)))[0]

    def search(f: Residual, first: jax.Array) -> tuple[jax.Array, tuple]:
        u, size, steps = method.solve(f, first, tolerance, max_steps)
        return u, (size, steps)

    u, (size, steps), _equation = implicit_root(scaled, flat / unit, search, solve_linear)
    return Solution(unflatten(unit * u), size <= tolerance, steps.astype(int), size), lax.stop_gradient(u)


def solve_linear(linear: Callable[[jax.Array], jax.Array], right: jax.Array) -> jax.Array:
    """The vector that a linear function turns into ``right``."""
    n = right.size
    if n <= DENSE_LIMIT:
        matrix = jax.vmap(linear, out_axes=1)(jnp.eye(n, dtype=right.dtype))
        return jnp.linalg.solve(matrix, right)
    import lineax as lx

    operator = lx.FunctionLinearOperator(linear, jax.eval_shape(lambda: right))
    solver = lx.GMRES(rtol=1e-10, atol=1e-12, restart=min(n, 50))
    return lx.linear_solve(operator, right, solver, throw=False).value


def _fitted(changes: jax.Array, r: jax.Array) -> jax.Array:
    """Least-squares weights of the changes, shape ``(m, n)``, that make up ``r``."""
    sizes = jnp.sqrt(jnp.sum(changes**2, axis=1))
    sizes = jnp.where(sizes > 0, sizes, 1.0)
    m = len(sizes)
    # The small identity keeps empty slots and parallel changes solvable.
    tall = jnp.concatenate([(changes / sizes[:, None]).T, 1e-10 * jnp.eye(m, dtype=r.dtype)])
    q, triangle = jnp.linalg.qr(tall)
    weights = jax.scipy.linalg.solve_triangular(triangle, r @ q[: r.size])
    return weights / sizes


def chosen(condition: jax.Array, new: Any, old: Any) -> Any:
    """One pytree or the other, whole."""
    return jax.tree.map(lambda a, b: jnp.where(condition, a, b), new, old)


def largest(r: jax.Array) -> jax.Array:
    """The largest magnitude; infinite where one is not a number."""
    size = jnp.max(abs(r), initial=0.0)
    return jnp.where(jnp.isnan(size), jnp.inf, size)


def _norm(r: jax.Array) -> jax.Array:
    norm = jnp.sqrt(jnp.sum(r**2))
    return jnp.where(jnp.isnan(norm), jnp.inf, norm)


def as_real(tree: Any) -> Any:
    """A pytree of arrays of floats."""
    return jax.tree.map(lambda leaf: jnp.asarray(leaf, dtype=float), tree)


def _typical(leaf: Any, other: Any) -> jax.Array:
    size = jnp.maximum(jnp.max(abs(leaf), initial=0.0), jnp.max(abs(other), initial=0.0))
    return jnp.where((size > 0) & jnp.isfinite(size), size, 1.0)


def _spread(prefix: Any, tree: Any) -> jax.Array:
    """The sizes as a vector with one entry for each number in the tree."""
    full = jax.tree.map(
        lambda size, part: jax.tree.map(lambda leaf: jnp.broadcast_to(size, leaf.shape), part),
        prefix,
        tree,
    )
    return lax.stop_gradient(ravel_pytree(full)[0].astype(float))


def within_rounding(x: jax.Array, tolerance: float) -> jax.Array:
    """The tolerance, or what rounding leaves of a state far larger than one; never more than a thousand
    tolerances.
    """
    rounding = 32.0 * jnp.finfo(x.dtype).eps * largest(lax.stop_gradient(x))
    return jnp.where(rounding <= 1e3 * tolerance, jnp.maximum(rounding, tolerance), -1.0)
