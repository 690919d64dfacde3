"""Chains of cells with lanes: each lane sees its own cell and the one before, all lanes of a cell meet in the
unknowns they share.

Such is solid in many size classes that flows through cells and meets one gas in each. A lane's few unknowns
are eliminated by themselves, so that work grows with the number of lanes only in proportion; the shared
unknowns, which see both neighbors, form a small tridiagonal system.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jax import lax

from granum.numerics.implicit import implicit_root

GROWTH, CAUTION = 4.0, 0.2  # of the pseudo time step after a good and after a bad step
LATE = 1e8  # first steps that make a step as good as infinite
LEAST = 1e-15  # of the first step: a step so short that there is no way on
PATIENCE = 7  # steps in which Newton's method may go to and fro before the path in time is taken
BOLD = 60  # steps after which that path is taken again with every step in time examined
SHARE = 0.8  # of the largest change allowed, which the next step aims at
# correction of a step in time, over that step, which the next step aims at; twice as much and the step is
# taken back
BEND = 0.5
REST = 0.02  # of the largest change: what is too little to count as bent
WARY, TRUST = 0.3, 1.5  # of a step taken back, which the next may not exceed; by how much more the one after
CONFIDENCE = 1.2  # by how much more again each one after that, up to the growth of a good step
LEASH = 300  # steps for one stage in time; none any more after a stage that was not solved
GAMMA = 1.0 - 0.5**0.5  # of the two implicit stages in time


class Cells(NamedTuple):
    """A state of the chain, or rates of it: lanes ``(cells, lanes, unknowns)`` and what they share, ``(cells,
    shared unknowns)``.
    """

    lanes: Any
    shared: Any


class Rates(NamedTuple):
    """Rates of change of the lanes; what each lane gives to the shared unknowns, ``(cells, lanes, shared
    unknowns)``; and the rest of these.
    """

    lanes: Any
    parts: Any
    shared: Any


Field = Callable[[Cells], Rates]


class ChainSolution(NamedTuple):
    """Outcome of `solve_chain`.

    state: the last iterate where it did not converge.
    converged: True if the change that a whole Newton step would still make is within the tolerance.
    steps: number of steps. residual: that change, relative to the unknowns or one.
    """

    state: Cells
    converged: jax.Array
    steps: jax.Array
    residual: jax.Array


class Blocks(NamedTuple):
    """Derivatives of the rates of each cell: of a lane by the lane before, itself and the shared; of its part
    by the same; of the shared by those before, of the cell and after.
    """

    before: Any
    own: Any
    by_shared: Any
    part_before: Any
    part: Any
    part_by_shared: Any
    low: Any
    mid: Any
    high: Any

    def shifted(self, scale: Any, diagonal: Cells) -> "Blocks":
        """All times a scale, and a diagonal added."""
        scaled = jax.tree.map(lambda block: scale * block, self)
        own = scaled.own + diagonal.lanes[..., None] * jnp.eye(self.own.shape[-1])
        return scaled._replace(
            own=own, mid=scaled.mid + diagonal.shared[..., None] * jnp.eye(self.mid.shape[-1])
        )


def _all(values: Any) -> Any:
    return jnp.all(jnp.stack([jnp.all(v) for v in jax.tree.leaves(values)]))


def _summed(rates: Rates) -> Cells:
    return Cells(rates.lanes, rates.shared + jnp.sum(rates.parts, axis=1))


def chain_blocks(push: Callable[[Cells], Rates], like: Cells) -> Blocks:
    """Blocks of a linear function. Of the lanes every second cell is disturbed at once, of the shared
    unknowns every third.

    Example:
        >>> def flow(u):
        ...     before = jnp.concatenate([jnp.zeros((1, 2, 1)), u.lanes[:-1]])
        ...     return Rates(before - 3.0 * u.lanes, u.lanes, u.shared)
        >>> chain_blocks(flow, Cells(jnp.zeros((3, 2, 1)), jnp.zeros((3, 1)))).before[:, 0, 0, 0]
        Array([0., 1., 1.], dtype=float64)
    """
    n, m, a = like.lanes.shape
    g = like.shared.shape[1]
    p, q = min(n, 2), min(n, 3)
    cells = jnp.arange(n)
    # color, unknown, cell, 1, a
    chosen_lanes = (cells % p == jnp.arange(p)[:, None])[:, None, :, None, None] * jnp.eye(a)[
        :, None, None, :
    ]
    chosen_shared = (cells % q == jnp.arange(q)[:, None])[:, None, :, None] * jnp.eye(g)[:, None, :]
    seeds = Cells(
        jnp.concatenate(
            [
                jnp.broadcast_to(chosen_lanes, (p, a, n, m, a)).reshape(-1, n, m, a),
                jnp.zeros((q * g, n, m, a)),
            ]
        ),
        jnp.concatenate([jnp.zeros((p * a, n, g)), chosen_shared.reshape(-1, n, g)]),
    )
    found = jax.vmap(push)(seeds)

    def unpacked(values: Any, colors: int, unknowns: int) -> Any:
        """Color, cell, …, equation, unknown."""
        return jnp.moveaxis(values.reshape(colors, unknowns, *values.shape[1:]), 1, -1)

    lanes, parts = (unpacked(v[: p * a], p, a) for v in (found.lanes, found.parts))
    by_shared, part_by_shared, shared = (
        unpacked(v[p * a :], q, g) for v in (found.lanes, found.parts, found.shared)
    )
    before = lanes[(cells - 1) % p, cells].at[0].set(0.0)
    return Blocks(
        before,
        lanes[cells % p, cells],
        jnp.sum(by_shared, axis=0),
        parts[(cells - 1) % p, cells].at[0].set(0.0),
        parts[cells % p, cells],
        jnp.sum(part_by_shared, axis=0),
        shared[(cells - 1) % q, cells].at[0].set(0.0),
        shared[cells % q, cells],
        shared[(cells + 1) % q, cells].at[-1].set(0.0),
    )


def _inverse(matrix: Any) -> Any:
    """Of small matrices in closed form; of larger ones by elimination."""
    size = matrix.shape[-1]
    if size == 1:
        return 1.0 / matrix
    if size == 2:
        (a, b), (c, d) = (tuple(jnp.moveaxis(row, -1, 0)) for row in jnp.moveaxis(matrix, -2, 0))
        det = a * d - b * c
        return jnp.stack([jnp.stack([d, -b], -1), jnp.stack([-c, a], -1)], -2) / det[..., None, None]
    if size == 3:
        x, y, z = jnp.moveaxis(matrix, -2, 0)
        columns = jnp.stack([jnp.cross(y, z), jnp.cross(z, x), jnp.cross(x, y)], -1)
        return columns / jnp.sum(x * columns[..., 0], -1)[..., None, None]
    return jnp.linalg.inv(matrix)


class Factors(NamedTuple):
    """What `solve_factored` needs."""

    before: Any
    inverse: Any
    by_shared: Any  # of the eliminated lanes
    part_before: Any
    part: Any
    low: Any
    shared: Any  # inverse of the shared block of each cell, all before it eliminated
    upper: Any


def factor_chain(blocks: Blocks) -> Factors:
    """Elimination, cell after cell: the lanes of a cell by themselves, then what they share."""
    inverse = _inverse(blocks.own)
    mid = blocks.mid + jnp.sum(blocks.part_by_shared, axis=1)

    def eliminate(carry: tuple, row: tuple) -> tuple[tuple, tuple]:
        lanes, shared = carry  # answer of the cell before to the shared unknowns of this one
        before, inverse, by_shared, part_before, part, low, mid, high = row
        answer = inverse @ (by_shared - before @ lanes)
        closed = _inverse(mid - low @ shared - jnp.sum(part @ answer + part_before @ lanes, axis=0))
        upper = closed @ high
        return (-answer @ upper, upper), (answer, closed, upper)

    rows = (
        blocks.before,
        inverse,
        blocks.by_shared,
        blocks.part_before,
        blocks.part,
        blocks.low,
        mid,
        blocks.high,
    )
    first = (jnp.zeros_like(blocks.by_shared[0]), jnp.zeros_like(mid[0]))
    _last, (answer, closed, upper) = _scan(eliminate, first, rows)
    return Factors(blocks.before, inverse, answer, blocks.part_before, blocks.part, blocks.low, closed, upper)


def _no_factors(like: Cells) -> Factors:
    """Zeros in the shapes of the factors of a chain, without tracing it for them."""
    (n, m, a), g = like.lanes.shape, like.shared.shape[1]
    lanes, given, taken, shared = (n, m, a, a), (n, m, a, g), (n, m, g, a), (n, g, g)
    return Factors(*map(jnp.zeros, (lanes, lanes, given, taken, taken, shared, shared, shared)))


def solve_factored(factors: Factors, right: Cells) -> Cells:
    """Solution of the factored system."""

    def forward(carry: tuple, row: tuple) -> tuple[tuple, tuple]:
        lanes, shared = carry
        before, inverse, answer, part_before, part, low, closed, r, rs = row
        own = jnp.einsum("mij,mj->mi", inverse, r - jnp.einsum("mij,mj->mi", before, lanes))
        given = jnp.einsum("mij,mj->i", part, own) + jnp.einsum("mij,mj->i", part_before, lanes)
        s = closed @ (rs - low @ shared - given)
        x = own - answer @ s
        return (x, s), (x, s)

    rows = (*factors[:-1], right.lanes, right.shared)
    zero = (jnp.zeros_like(right.lanes[0]), jnp.zeros_like(right.shared[0]))
    _last, (lanes, shared) = _scan(forward, zero, rows)
    if right.shared.shape[0] == 1:
        return Cells(lanes, shared)

    def backward(known: Any, row: tuple) -> tuple[Any, Any]:
        upper, s = row
        return s - upper @ known, upper @ known

    _first, taken = lax.scan(backward, zero[1], (factors.upper, shared), reverse=True)
    return Cells(lanes + jnp.einsum("nmij,nj->nmi", factors.by_shared, taken), shared - taken)


def _scan(function: Callable, first: Any, rows: Any) -> tuple[Any, Any]:
    """Over the cells; without a loop when there is one."""
    if jax.tree.leaves(rows)[0].shape[0] > 1:
        return lax.scan(function, first, rows)
    last, found = function(first, jax.tree.map(lambda leaf: leaf[0], rows))
    return last, jax.tree.map(lambda leaf: leaf[None], found)


def solve_chain(
    function: Field,
    start: Cells,
    capacity: Cells,
    *,
    first_step: Any = 1.0,
    largest_change: Cells | None = None,
    tolerance: float = 1e-12,
    max_steps: Any = 2000,
) -> ChainSolution:
    """Solve for the state at which all rates vanish: by Newton's method, or where that leads astray along the
    path the system takes in time.

    The path is first taken in steps as long as the largest change allows. Where these do not arrive, for fast
    lanes bend within them, it is taken once more with each step compared with the rates at its end, and taken
    back where they disagree.

    Parameters
    ----------
    function: rates of change of what the cells hold. A lane, and what it gives, may depend on itself, on the
        same lane of the cell before and on the shared unknowns of its cell, the shared rest on those of the
        neighbors. It may close over traced values.
    start: first guess, unknowns scaled to about one.
    capacity: what a cell holds per unknown, so that ``capacity · du/dt = rates``; zero for an equation
        without memory, any broadcastable shapes.
    first_step: first step in time; it grows fourfold while steps are good.
    largest_change: change of an unknown in one step above which the step is repeated shorter, broadcastable
        to a state.
    tolerance: on the change that a whole Newton step would still make, relative to the unknowns or one.

    Returns
    -------
    A `ChainSolution`. Nothing raises. Derivatives with respect to closed-over values follow from the implicit
        function theorem.

    Example:
        >>> def flow(u):
        ...     before = jnp.concatenate([jnp.ones((1, 1, 1)), u.lanes[:-1]])
        ...     return Rates(before - u.lanes - u.lanes**2, u.lanes, -u.shared)
        >>> found = solve_chain(flow, Cells(jnp.ones((2, 1, 1)), jnp.ones((2, 1))), Cells(1.0, 1.0)).state
        >>> round(float(found.lanes[0, 0, 0]), 6), round(float(found.shared[0, 0]), 6)
        (0.618034, 0.618034)
    """
    start = Cells(*(jnp.asarray(v, dtype=float) for v in start))
    capacity = _like(start, capacity)
    size = _like(start, Cells(jnp.inf, jnp.inf) if largest_change is None else largest_change)
    rest = Cells(REST * size.lanes, REST * jnp.minimum(size.shared, 1.0))
    first_step = lax.stop_gradient(jnp.asarray(first_step, dtype=float))

    def search(balance: Callable[[Rates], Rates], guess: Rates) -> tuple[Rates, tuple]:
        def f(u: Cells) -> Rates:
            return balance(Rates(u.lanes, jnp.zeros_like(guess.parts), u.shared))

        origin = Cells(guess.lanes, guess.shared)

        def factored(push: Callable[[Cells], Rates], u: Cells, h: Any) -> Factors:
            return factor_chain(chain_blocks(push, u).shifted(1.0, jax.tree.map(lambda c: -c / h, capacity)))

        def step(carry: tuple) -> tuple:
            u, safe, h, before, last, _next, damping, way, number, taken, most, trust, then = carry
            trial, careful = way == 0, way == 2
            value, push = jax.linearize(f, u)
            r = _summed(value)
            factors = factored(push, u, h)
            # to the step in time that led here
            missing = jax.tree.map(lambda v, c, d: v + c * d / taken, r, capacity, before)
            change = solve_factored(factors, r)
            correction = lax.cond(
                careful, lambda: solve_factored(then, missing), lambda: jax.tree.map(jnp.zeros_like, before)
            )
            far = jnp.maximum(*(jnp.max(abs(d) / s) for d, s in zip(change, size, strict=True)))
            bent = jnp.maximum(
                *(
                    jnp.max(abs(c) / jnp.maximum(abs(d), s))
                    for c, d, s in zip(correction, before, rest, strict=True)
                )
            )
            bent = jnp.where(jnp.isfinite(taken) & careful, bent, 0.0)
            straight = bent <= 2.0 * BEND
            good = (far <= 1.0) & straight & _all(jax.tree.map(jnp.isfinite, change))
            relative = jnp.maximum(
                *(jnp.max(abs(d) / jnp.maximum(abs(v), 1.0)) for d, v in zip(change, u, strict=True))
            )
            turned = jax.tree.map(lambda d, b: jnp.sum(d * b, axis=-1, keepdims=True) < 0, change, before)
            astray = (h >= LATE * first_step) & (relative > 0.5 * last) & (relative > 1e-7)
            # a lane that goes to and fro over a bend takes less of its steps
            damping = jax.tree.map(
                lambda t, f: jnp.where(
                    careful, 1.0, jnp.where(t & astray, 0.5 * f, jnp.minimum(1.3 * f, 1.0))
                ),
                turned,
                damping,
            )
            # the step before went astray: back to its start
            lost = ~(jnp.isfinite(far) & straight & _all(jax.tree.map(jnp.isfinite, r)))
            # Newton's method from the guess is given up when it goes astray, the path without examination
            # when it takes too long
            stuck = h <= LEAST * first_step
            given_up = trial & (~good | (astray & (number >= PATIENCE)))
            failed = given_up | (~careful & (stuck | (number >= BOLD)))
            late = good & (h >= LATE * first_step) & ~failed  # only then is a change that of a Newton step
            whole = jnp.minimum(jnp.min(damping.lanes), jnp.min(damping.shared)) >= 1.0
            # Newton's method is quadratic
            ratio = jnp.where(whole & (relative < 1e-6) & jnp.isfinite(last), relative / last, 1.0)
            # changes are nearly proportional to a step: the next is to come close to the largest allowed
            growth = GROWTH ** jnp.where(relative < 0.05, 3.0, 1.0)
            began = jnp.where(jnp.isfinite(taken), taken, h)
            shorter = began * jnp.where(bent > BEND, jnp.clip(BEND / bent, CAUTION**2, 1.0), CAUTION)
            most = jnp.where(
                careful,
                jnp.where(lost, WARY * began, jnp.minimum(trust * most, 1e4 * LATE * first_step)),
                most,
            )
            trust = jnp.where(lost, TRUST, jnp.minimum(CONFIDENCE * trust, GROWTH))
            fitting = jnp.minimum(
                h * jnp.clip(jnp.minimum(SHARE / far, BEND / bent), CAUTION**2, growth), most
            )
            used, h = h, jnp.where(failed, first_step, jnp.where(lost, shorter, fitting))
            back = jax.tree.map(lambda s, v: jnp.where(lost, s, v), safe, u)
            new = jax.tree.map(
                lambda g, b, v, d, f: jnp.where(failed, g, jnp.where(good, v - f * d, b)),
                origin,
                back,
                u,
                change,
                damping,
            )
            known = jax.tree.map(lambda d: jnp.where(good & ~failed, d, 0.0), change)
            last = jnp.where(good & ~failed, relative, jnp.inf)
            left = jnp.where(late, relative * ratio**2, jnp.inf)
            taken = jnp.where(good & ~failed, used, jnp.inf)
            return (
                new,
                back,
                h,
                known,
                last,
                left,
                damping,
                way + failed,
                number + 1,
                taken,
                most,
                trust,
                factors,
            )

        def unfinished(carry: tuple) -> Any:
            stuck = (carry[7] == 2) & (carry[2] <= LEAST * first_step)
            return (carry[5] > tolerance) & (carry[8] < max_steps) & ~stuck

        none = jnp.asarray(jnp.inf)
        first = (
            origin,
            origin,
            LATE * first_step,
            jax.tree.map(jnp.zeros_like, origin),
            none,
            none,
            jax.tree.map(lambda v: jnp.ones_like(v[..., :1]), origin),
            jnp.zeros((), int),
            jnp.zeros((), int),
            none,
            1e4 * LATE * first_step,
            jnp.asarray(TRUST),
            _no_factors(origin),
        )
        found = lax.while_loop(unfinished, step, first)
        u, left, number = found[0], found[5], found[8]
        found = Rates(u.lanes, f(u).parts, u.shared)
        return found, (left, number)

    def balanced(v: Rates) -> Rates:
        """All rates, with the parts as unknowns too, so that the lanes of its linear form can be told
        apart.
        """
        rates = function(Cells(v.lanes, v.shared))
        return Rates(rates.lanes, rates.parts - v.parts, rates.shared + jnp.sum(v.parts, axis=1))

    def tangent(linear: Callable[[Rates], Rates], right: Rates) -> Rates:
        like = Cells(right.lanes, right.shared)

        def push(u: Cells) -> Rates:
            return linear(Rates(u.lanes, jnp.zeros_like(right.parts), u.shared))

        u = solve_factored(
            factor_chain(chain_blocks(push, like)),
            Cells(right.lanes, right.shared + jnp.sum(right.parts, axis=1)),
        )
        return Rates(u.lanes, push(u).parts - right.parts, u.shared)

    guess = Rates(start.lanes, jnp.zeros((*start.lanes.shape[:2], start.shared.shape[1])), start.shared)
    found, (left, number), _balanced = implicit_root(balanced, guess, search, tangent)
    return ChainSolution(Cells(found.lanes, found.shared), left <= tolerance, number.astype(int), left)


def _like(start: Cells, given: Cells) -> Cells:
    return Cells(
        *(
            jnp.broadcast_to(lax.stop_gradient(jnp.asarray(v, dtype=float)), s.shape)
            for v, s in zip(given, start, strict=True)
        )
    )


class History(NamedTuple):
    """Outcome of `advance_chain`: states after each step, the integral of the outflow up to there, whether
    every step was solved.
    """

    states: Cells
    outflow: jax.Array
    converged: jax.Array


def advance_chain(
    function: Callable[[Cells, Any], Rates],
    start: Cells,
    capacity: Cells,
    step: Any,
    inputs: Any,
    outflow: Callable[[Cells, Any], jax.Array] | None = None,
    reach: Callable[[Cells, Cells], Any] | None = None,
    largest_change: Cells | None = None,
) -> History:
    """States of a chain of cells over time by Alexander's two implicit stages: second order, L-stable, given
    steps of any length.

    The second stage starts from a straight line through the first. Where this would lead beyond what is
    possible, such as to less than nothing, it starts earlier, up to a whole step of the implicit method of
    Euler. What is linear in the unknowns and conserved by ``function`` is conserved to the tolerance of the
    stages.

    Parameters
    ----------
    function: ``capacity · du/dt = function(u, input)``, coupled as in `solve_chain`.
    start: first state.
    capacity: zero for an equation without memory, broadcastable to a state.
    step: length of the steps, or of each of them.
    inputs: pytree whose leaves have a leading axis of steps; constant within a step.
    outflow: ``outflow(u, input)``, linear in u: flows (any vector) whose time integral is wanted.
    reach: ``reach(u, change)``: how many times a change may be added to a state. Without it, as often as one
        likes.
    largest_change: as in `solve_chain`.

    Example:
        >>> fall = lambda u, i: Rates(i - u.lanes, jnp.zeros((1, 1, 1)), u.lanes[:, 0] - u.shared)
        >>> found = advance_chain(
        ...     fall, Cells(jnp.zeros((1, 1, 1)), jnp.zeros((1, 1))), Cells(1.0, 0.0), 0.01, jnp.ones(100)
        ... )
        >>> round(float(found.states.lanes[-1, 0, 0, 0]), 4)  # 1 − 1/e = 0.6321
        0.6321
    """
    start = Cells(*(jnp.asarray(v, dtype=float) for v in start))
    capacity = _like(start, capacity)
    count = outflow or (lambda u, _input: jnp.zeros((0,)))
    bound = reach or (lambda _u, _change: jnp.inf)

    def stage(base: Cells, guess: Cells, length: Any, given: Any, steps: Any) -> tuple[Cells, Any]:
        def rates(v: Cells) -> Rates:
            r = function(v, given)
            d = jax.tree.map(lambda c, new, old: c * (new - old) / length, capacity, v, base)
            return Rates(r.lanes - d.lanes, r.parts, r.shared - d.shared)

        brake = jax.tree.map(lambda c: jnp.where(c > 0, c, 1e-2 * length), capacity)
        found = solve_chain(
            rates, guess, brake, first_step=1e-2 * length, largest_change=largest_change, max_steps=steps
        )
        return found.state, found.converged

    def half(carry: tuple, row: tuple) -> tuple[tuple, tuple]:
        (u, before, total, taken, well), (given, step, second) = carry, row
        change = jax.tree.map(jnp.subtract, before, u)
        most = bound(u, change)
        on = jnp.where(second, jnp.minimum((1.0 - GAMMA) / GAMMA, most), 0.0)
        base = jax.tree.map(lambda v, d: v + on * d, u, change)
        share = jnp.where(second, 1.0 - GAMMA * on, GAMMA)  # of the step, taken implicitly
        guess = Cells(u.lanes + jnp.minimum(on + 1.0, most) * change.lanes, before.shared)
        new, solved = stage(base, guess, share * step, given, jnp.where(well, LEASH, 0))
        taken = on * taken + share * step * count(new, given)  # so far in this step
        total = jnp.where(second, total + taken, total)
        old = jax.tree.map(lambda a, b: jnp.where(second, b, a), u, new)
        return (old, new, total, taken, well & solved), (new, total)

    number = jax.tree.leaves(inputs)[0].shape[0]
    lengths = jnp.broadcast_to(jnp.asarray(step, dtype=float), (number,))
    twice = jax.tree.map(lambda leaf: jnp.repeat(leaf, 2, axis=0), (inputs, lengths))
    nothing = jnp.zeros_like(count(start, jax.tree.map(lambda leaf: leaf[0], inputs)))
    begin = (start, start, nothing, nothing, jnp.asarray(True))
    end, (states, totals) = lax.scan(half, begin, (*twice, jnp.arange(2 * number) % 2 == 1))
    return History(jax.tree.map(lambda leaf: leaf[1::2], states), totals[1::2], end[-1])
