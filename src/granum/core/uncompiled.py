"""Traced programs run by NumPy, without compiling them: for what runs a few times, where the compiler would
take a thousand times as long as the numbers.

The program is JAX's own (``jax.make_jaxpr``). Its loops are the exception: one that has taken, or is bound to
take, about as long as compiling it would is compiled by itself and called from then on.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

import jax
import numpy as np
from jax.extend.core import ClosedJaxpr, Literal

from granum.core.operations import Step, operation

Body = Callable[..., list[Any]]

RENT = 500
"""Steps run uncompiled that cost as much as compiling one operation."""
LEAST = 100
"""Operations that compiling anything costs beforehand."""
PASSES = 8
"""Passes taken for a loop of unknown length when the work of a program is guessed."""
ELEMENTS = 500
"""So many elements of an array take as long as one more step."""
CALL = 50.0
"""Steps that a call of something compiled costs."""

_taken = threading.local()


class Program:
    """A traced program, ready to run on NumPy values; ``options`` of ``jax.jit`` for its compiled loops.

    ``size`` counts its operations, each once; ``work`` guesses how many steps a run takes.

    >>> program = Program(jax.make_jaxpr(lambda x: 3.0 * x + 1.0)(2.0))
    >>> program.size, program.run([2.0])
    (2.0, ([np.float64(7.0)], 2.004))
    """

    def __init__(self, closed: ClosedJaxpr, **options: Any):
        self.size, self.work, self._body = _Maker(options).made(closed)
        self._takes = [v.aval.dtype for v in closed.jaxpr.invars]

    def run(self, values: Sequence[Any]) -> tuple[list[Any], float]:
        """The results for a flat list of values, and the steps taken."""
        given = [np.asarray(v, dtype)[()] for v, dtype in zip(values, self._takes, strict=True)]
        outer, _taken.steps = getattr(_taken, "steps", 0.0), 0.0
        try:
            with np.errstate(all="ignore"):
                return self._body(*given), _taken.steps
        finally:
            _taken.steps += outer


class Made(NamedTuple):
    """A program with what is known of it: operations, guessed work of a run, and a function of its inputs."""

    size: float
    work: float
    run: Body


class _Maker:
    """Makes programs ready, each inner one once however often it is called."""

    def __init__(self, options: dict[str, Any]) -> None:
        self.options = options
        self.runs = 1.0  # guessed, of what is being made
        self._known: dict[int, Made] = {}

    @contextmanager
    def repeated(self, times: float) -> Iterator[None]:
        """While the body of a loop is being made."""
        self.runs *= times
        yield
        self.runs /= times

    def made(self, closed: ClosedJaxpr) -> Made:
        found = self._known.get(id(closed.jaxpr)) if not closed.consts else None
        if found is not None:
            return found._replace(size=1.0)
        found = self._make(closed)
        if not closed.consts:
            self._known[id(closed.jaxpr)] = found
        return found

    def _make(self, closed: ClosedJaxpr) -> Made:
        """Each value has a place in a list, each step knows its places."""
        jaxpr, places, known = closed.jaxpr, {}, []

        def place(atom: Any) -> int:
            if isinstance(atom, Literal):
                known.append(np.asarray(atom.val, atom.aval.dtype)[()])
                return len(known) - 1
            if atom not in places:
                places[atom] = len(known)
                known.append(None)
            return places[atom]

        for variable, constant in zip(jaxpr.constvars, closed.consts, strict=True):
            known[place(variable)] = np.asarray(constant)[()]
        inputs = [place(v) for v in jaxpr.invars]
        steps, size, work, own = [], 0.0, 0.0, 0.0
        for eqn in jaxpr.eqns:
            weight = 1.0 + sum(v.aval.size for v in eqn.outvars) / ELEMENTS
            nested = NESTED.get(eqn.primitive.name)
            inside = nested(eqn, self) if nested else Made(1.0, 0.0, operation(eqn))
            size, work, own = size + inside.size, work + inside.work + weight, own + weight
            ins, outs = [place(v) for v in eqn.invars], [place(v) for v in eqn.outvars]
            steps.append((inside.run, ins, outs, len(outs) == 1))
        outputs = [place(v) for v in jaxpr.outvars]

        def run(*values: Any) -> list[Any]:
            _taken.steps += own
            at = known.copy()
            for i, value in zip(inputs, values, strict=True):
                at[i] = value
            for step, ins, outs, single in steps:
                found = step(*[at[i] for i in ins])
                if single:
                    at[outs[0]] = found
                else:
                    for i, value in zip(outs, found, strict=True):
                        at[i] = value
            return [at[i] for i in outputs]

        return Made(size, work, run)


class _Loop:
    """A loop, and whether it is time to compile it."""

    def __init__(self, eqn: Any, maker: _Maker, size: float, work: float):
        self._eqn, self._options = eqn, maker.options
        self._left = RENT * (size + LEAST)
        self.size, self.work = size, work
        self._compiled: Callable[..., Any] | None = None
        if work * maker.runs > self._left:
            self._left, self.work = 0.0, CALL

    def is_due(self) -> bool:
        return self._left <= 0.0

    def took(self, steps: float) -> None:
        self._left -= steps

    def run(self, *values: Any) -> Any:
        """All of it, compiled, from these values on."""
        _taken.steps += CALL
        with jax.ensure_compile_time_eval():
            if self._compiled is None:
                bind, params = self._eqn.primitive.bind, self._eqn.params
                self._compiled = jax.jit(lambda *given: bind(*given, **params), **self._options)
            found = [np.asarray(x)[()] for x in self._compiled(*values)]
        return _alone(found)


def _alone(found: list[Any]) -> Any:
    return found[0] if len(found) == 1 else found


def _called(name: str) -> Callable[[Any, _Maker], Made]:
    def made(eqn: Any, maker: _Maker) -> Made:
        inner = eqn.params[name]
        body = maker.made(inner if isinstance(inner, ClosedJaxpr) else ClosedJaxpr(inner, ()))
        run = body.run
        return body._replace(run=lambda *values: _alone(run(*values)))

    return made


def _while(eqn: Any, maker: _Maker) -> Made:
    params = eqn.params
    with maker.repeated(PASSES):
        judge, body = maker.made(params["cond_jaxpr"]), maker.made(params["body_jaxpr"])
    loop = _Loop(eqn, maker, judge.size + body.size, PASSES * (judge.work + body.work))
    first, second = params["cond_nconsts"], params["cond_nconsts"] + params["body_nconsts"]
    several = bool(params["cond_jaxpr"].jaxpr.outvars[0].aval.shape)

    def step(*values: Any) -> Any:
        judged_by, made_of, carry = values[:first], values[first:second], list(values[second:])
        while not loop.is_due():
            before = _taken.steps
            if not np.any(goes_on := judge.run(*judged_by, *carry)[0]):
                return _alone(carry)
            found = body.run(*made_of, *carry)
            # of loops that a batch runs together, those that have ended stay
            carry = list(map(_stay(goes_on), found, carry)) if several else found
            loop.took(_taken.steps - before)
        return loop.run(*judged_by, *made_of, *carry)

    return Made(loop.size, loop.work, step)


def _stay(goes_on: Any) -> Step:
    shape = goes_on.shape
    return lambda new, old: np.where(np.reshape(goes_on, shape + (1,) * (new.ndim - len(shape))), new, old)


def _cond(eqn: Any, maker: _Maker) -> Made:
    branches = [maker.made(branch) for branch in eqn.params["branches"]]

    def step(which: Any, *values: Any) -> Any:
        return _alone(branches[min(max(int(which), 0), len(branches) - 1)].run(*values))

    return Made(sum(b.size for b in branches), max(b.work for b in branches), step)


def _scan(eqn: Any, maker: _Maker) -> Made:
    params = eqn.params
    length, carried = params["length"], params["num_carry"]
    with maker.repeated(length):
        body = maker.made(params["jaxpr"])
    loop = _Loop(eqn, maker, body.size, length * body.work)
    first, second = params["num_consts"], params["num_consts"] + carried
    shapes = [(v.aval.shape, v.aval.dtype) for v in params["jaxpr"].jaxpr.outvars[carried:]]

    def step(*values: Any) -> Any:
        if loop.is_due():
            return loop.run(*values)
        before = _taken.steps
        fixed, carry, rows = values[:first], list(values[first:second]), values[second:]
        made = [np.empty((length, *shape), dtype) for shape, dtype in shapes]
        for i in range(length)[:: -1 if params["reverse"] else 1]:
            found = body.run(*fixed, *carry, *(row[i] for row in rows))
            carry = found[:carried]
            for whole, part in zip(made, found[carried:], strict=True):
                whole[i] = part
        loop.took(_taken.steps - before)
        return _alone([*carry, *made])

    return Made(loop.size, loop.work, step)


def _linear_solve(eqn: Any, maker: _Maker) -> Made:
    body, counts = maker.made(eqn.params["jaxprs"].solve), eqn.params["const_lengths"]
    before = counts.matvec + counts.vecmat
    after = before + counts.solve + counts.transpose_solve

    def step(*values: Any) -> Any:
        return _alone(body.run(*values[before : before + counts.solve], *values[after:]))

    return body._replace(run=step)


NESTED: dict[str, Callable[[Any, _Maker], Made]] = {
    "jit": _called("jaxpr"),
    "pjit": _called("jaxpr"),
    "closed_call": _called("call_jaxpr"),
    "custom_jvp_call": _called("call_jaxpr"),
    "custom_vjp_call": _called("call_jaxpr"),
    "while": _while,
    "cond": _cond,
    "scan": _scan,
    "custom_linear_solve": _linear_solve,
}
