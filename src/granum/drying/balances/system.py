"""A small equation system that is solved from any consistent set of knowns.

Which quantities are known is fixed before tracing, so the order of solution is found once, in Python, and the
numbers run through it as plain array code. Relations are used one after the other wherever they fix
something; where that stops, one quantity is guessed, the rest follows, and the relation left over decides the
guess by a bracketed root.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from granum.core.errors import InputError
from granum.core.i18n import _
from granum.numerics import find_root

Values = dict[str, Any]


class Relation(NamedTuple):
    """Quantities tied together by ``fixes`` equations.

    ``solve(values, unknown)`` gives the unknown ones; ``residual`` is zero when it holds. ``extra`` marks a
    consequence of the others, which only shortens the search.
    """

    variables: tuple[str, ...]
    fixes: int
    solve: Callable[[Values, tuple[str, ...]], Values]
    residual: Callable[[Values], Any] | None = None
    extra: bool = False


def linear(variables: tuple[str, ...], residual: Callable[[Values], Any], extra: bool = False) -> Relation:
    """A relation whose residual is linear in each quantity taken alone."""

    def solve(values: Values, unknown: tuple[str, ...]) -> Values:
        (name,) = unknown

        def at(x: Any) -> Any:
            return residual({**values, name: x})

        at_zero, slope = jax.jvp(at, (jnp.zeros(()),), (jnp.ones(()),))
        return {name: -at_zero / jnp.where(slope == 0, jnp.nan, slope)}

    return Relation(variables, 1, solve, residual, extra)


class Step(NamedTuple):
    """One relation used for some unknowns."""

    relation: int
    unknown: tuple[str, ...]


class Plan(NamedTuple):
    """Order of solution: steps before the guess, the guessed quantity, steps that follow from it, the
    relation that decides it.
    """

    before: tuple[Step, ...]
    guess: str | None = None
    after: tuple[Step, ...] = ()
    decides: int = -1


PIECES, TRIED = 64, 4


def _only_root(mismatch: Callable[[Any], Any], low: Any, high: Any) -> Any:
    root = find_root(mismatch, low, high, tolerance=1e-14)
    return jnp.where(root.converged, root.value, jnp.nan)


def _first_root(mismatch: Callable[[Any], Any], low: Any, high: Any) -> Any:
    """The first root between the ends, where the mismatch may have poles or gaps: looked for piece by
    piece.
    """
    shape = jax.eval_shape(
        mismatch, jnp.asarray(low, dtype=float) + 0.0 * jnp.asarray(high, dtype=float)
    ).shape
    share = jnp.linspace(0.0, 1.0, PIECES + 1).reshape((-1,) + (1,) * len(shape))
    grid = low + (high - low) * share + jnp.zeros(shape)
    signs = jnp.sign(mismatch(grid))
    change = (signs[:-1] * signs[1:] <= 0) & jnp.isfinite(signs[:-1]) & jnp.isfinite(signs[1:])
    first = jnp.argsort(~change, axis=0, stable=True)[:TRIED]
    ends = (jnp.take_along_axis(grid[:-1], first, 0), jnp.take_along_axis(grid[1:], first, 0))
    root = find_root(mismatch, *jax.lax.stop_gradient(ends), tolerance=1e-14)
    good = root.converged & jnp.isfinite(root.value)
    best = jnp.argmax(good, axis=0)[None]
    return jnp.where(jnp.any(good, axis=0), jnp.take_along_axis(root.value, best, 0)[0], jnp.nan)


class System:
    """Relations between named quantities, and how to search each of them: ``pole`` names one that grows
    without limit, and what vanishes there.

    ``bracket`` gives the ends between which a quantity is guessed, and whether the mismatch changes its sign
    only once in between.
    """

    def __init__(
        self,
        relations: tuple[Relation, ...],
        guesses: tuple[str, ...],
        bracket: Callable[[str, Values], tuple[Any, Any, bool]],
        pole: tuple[str, Callable[[Values], Any]],
        free: tuple[str, ...] = (),
    ):
        self.relations, self.guesses, self.bracket, self.pole, self.free = (
            relations,
            guesses,
            bracket,
            pole,
            free,
        )
        self.variables = tuple(dict.fromkeys(name for r in relations for name in r.variables))
        self.plan = lru_cache(maxsize=256)(self._plan)

    @property
    def freedom(self) -> int:
        """How many independent values fix everything."""
        return len(self.variables) - sum(r.fixes for r in self.relations if not r.extra)

    def completed(self, given: frozenset[str], sought: str) -> frozenset[str]:
        """The knowns together with those quantities that are zero unless given or sought."""
        return given.union(name for name in self.free if name != sought)

    def solve(self, given: Mapping[str, Any], constants: Mapping[str, Any]) -> Values:
        """Every quantity from the given ones (those of ``completed``); constants are what no relation is
        solved for.
        """
        plan = self.plan(frozenset(given))
        values = self._run(plan.before, {**given, **constants})
        if plan.guess is None:
            return values
        name, known = plan.guess, values

        def mismatch(x: Any) -> Any:
            found = self._run(plan.after, {**known, name: x})
            residual = self.relations[plan.decides].residual
            assert residual is not None
            return residual(found) if self.pole[0] in known else residual(found) * self.pole[1](found)

        low, high, monotone = self.bracket(name, known)
        found = _only_root(mismatch, low, high) if monotone else _first_root(mismatch, low, high)
        return self._run(plan.after, {**known, name: found})

    def _run(self, steps: tuple[Step, ...], values: Values) -> Values:
        for step in steps:
            values |= self.relations[step.relation].solve(values, step.unknown)
        return values

    def _propagate(
        self, known: frozenset[str], used: frozenset[int] = frozenset()
    ) -> tuple[tuple[Step, ...], frozenset[str], list[int]]:
        """Steps that follow from the knowns, what is known then, and the relations left with nothing to
        find.
        """
        steps: list[Step] = []
        spare: list[int] = []
        left = [i for i in range(len(self.relations)) if i not in used]
        moving = True
        while moving:
            moving = False
            for i in list(left):
                r = self.relations[i]
                unknown = tuple(n for n in r.variables if n not in known)
                if len(unknown) > r.fixes:
                    continue
                left.remove(i)
                if not unknown:
                    if not r.extra:
                        spare.append(i)
                    continue
                if len(unknown) < r.fixes:
                    spare.append(i)
                steps.append(Step(i, unknown))
                known, moving = known.union(unknown), True
                break
        return tuple(steps), known, spare

    def _plan(self, given: frozenset[str]) -> Plan:
        redundant, missing = self._structure(given)
        if redundant or missing:
            raise self._complaint(given, redundant, missing)
        before, known, _spare = self._propagate(given)
        used = frozenset(step.relation for step in before)
        if known.issuperset(self.variables):
            return Plan(before)
        for name in self.guesses:
            if name in known:
                continue
            after, found, spare = self._propagate(known | {name}, used)
            if (
                found.issuperset(self.variables)
                and len(spare) == 1
                and self.relations[spare[0]].residual is not None
            ):
                return Plan(before, name, after, spare[0])
        raise InputError(
            _(
                "These values do not fix the dryer: some of them say the same thing. Given: {names}. "
                "Replace one by another of: {others}."
            ).format(
                names=", ".join(sorted(given - set(self.free))),
                others=", ".join(n for n in self.variables if n not in known),
            )
        )

    def _structure(self, given: frozenset[str]) -> tuple[list[str], list[str]]:
        """Knowns of which one is too many, and quantities of which one more must be given (Dulmage and
        Mendelsohn's decomposition).
        """
        import rustworkx as rx

        equations = [(i, k) for i, r in enumerate(self.relations) if not r.extra for k in range(r.fixes)]
        unknown = [name for name in self.variables if name not in given]
        place = {node: i for i, node in enumerate([*equations, *unknown])}
        held = [
            (place[e], place[name])
            for e in equations
            for name in self.relations[e[0]].variables
            if name not in given
        ]
        graph = rx.PyGraph()
        graph.add_nodes_from(place)
        graph.add_edges_from_no_data(held)
        pairs = [sorted(pair) for pair in rx.max_weight_matching(graph, max_cardinality=True)]
        matched = {i for pair in pairs for i in pair}
        # from an equation to what it holds, and from a quantity to the equation that gives it
        order = rx.PyDiGraph()
        order.add_nodes_from(place)
        order.add_edges_from_no_data(held + [(name, equation) for equation, name in pairs])
        over = {place[e] for e in equations} - matched
        tied = over.union(*(rx.descendants(order, e) for e in over))
        redundant = {
            name
            for e in equations
            if place[e] in tied
            for name in self.relations[e[0]].variables
            if name in given
        }
        loose = {place[name] for name in unknown} - matched
        open_ = loose.union(*(rx.ancestors(order, name) for name in loose))
        return sorted(redundant), [name for name in unknown if place[name] in open_]

    def _complaint(self, given: frozenset[str], redundant: list[str], missing: list[str]) -> InputError:
        own, zero = sorted(given - set(self.free)), set(self.free) & given
        text = _(
            "{count} values fix this balance (its degrees of freedom); {given} of them are given or "
            "zero by default."
        ).format(count=self.freedom, given=len(given))
        if redundant:
            text += " " + _(
                "Too many: one of {names} follows from the others; leave one out, or name what is to be "
                "found instead in 'quantity_sought'."
            ).format(names=", ".join(n for n in redundant if n not in zero))
        if missing:
            text += " " + _("Not fixed: give one more of {names}.").format(names=", ".join(missing))
        return InputError(text, given=own, redundant=redundant or None, missing=missing or None)
