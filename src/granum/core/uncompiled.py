"""Traced programs run by NumPy, without compiling them: for what runs a few times, where the compiler would
take a thousand times as long as the numbers.

The program is JAX's own (``jax.make_jaxpr``). Its loops are the exception: one that has taken, or is bound to
take, about as long as compiling it would is compiled by itself and called from then on. What was compiled
once is compiled at once by the next process, when the program is kept for it (``granum.core.kept``).
"""

from __future__ import annotations

import threading
import weakref
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

import jax
import numpy as np
from jax.extend.core import ClosedJaxpr

from granum.core import lapack
from granum.core.operations import Step, of_numpy, operation
from granum.core.traces import Operation, Reader, Trace

Body = Callable[..., list[Any]]

RENT = 500
"""Steps run uncompiled that cost as much as compiling one operation."""
LENT = 220
"""The same for a loop that is kept compiled: the next process takes it ready."""
AGAIN = 10
"""How much longer a loop of a kept program that was not worth compiling runs uncompiled: to compile it now,
all is traced anew.
"""
MODERATE = 8000
"""Operations of a loop up to which this holds: to compile a whole line makes a first run long."""
LEAST = 100
"""Operations that compiling anything costs beforehand."""
PASSES = 8
"""Passes taken for a loop of unknown length when the work of a program is guessed."""
ELEMENTS = 500
"""So many elements of an array take as long as one more step."""
CALL = 50.0
"""Steps that a call of something compiled costs."""
THOROUGH = 2
"""Optimization asked of the compiler for a loop of arrays, whatever is asked for the rest: one of thirty
cells with thirty size classes is ready half as late again and runs four times as fast.
"""
WIDE = 1000
"""Elements of the largest array that a loop carries along from which on that is so; one of few numbers runs
as fast however it is compiled: of a cell with forty size classes, 360, a fifth slower, and is ready in two
thirds of the time.
"""

_taken = threading.local()
_written: weakref.WeakValueDictionary[tuple[bytes, str], Any] = weakref.WeakValueDictionary()
"""Compiled loops by how they are kept."""


class Outgrown(Exception):
    """A loop of a program that was kept needs the compiler, and what to compile was not kept with it."""


class Program:
    """A traced program, ready to run on NumPy values; ``options`` of ``jax.jit`` for its compiled loops.

    ``size`` counts its operations, each once; ``work`` guesses how many steps a run takes. A program that is
    ``kept`` remembers how its loops are compiled: ``loops``, for the next process.

    >>> program = Program(jax.make_jaxpr(lambda x: 3.0 * x + 1.0)(2.0))
    >>> program.size, program.run([2.0])
    (2.0, ([np.float64(7.0)], 2.004))
    """

    def __init__(
        self,
        program: ClosedJaxpr | Trace,
        loops: Sequence[bytes | None] | None = None,
        *,
        kept: bool = False,
        **options: Any,
    ):
        trace = program if isinstance(program, Trace) else Reader().read(program)
        maker = _Maker(options, loops, kept)
        self.size, self.work, self._body = maker.made(trace)
        self._takes = [shaped.dtype for shaped in trace.given]
        self._loops, self._numpy_does_all = maker.loops, maker.lasts
        # what is only run needs its steps, not the trace with JAX's own form of it
        self.trace = trace if kept else None

    @property
    def loops(self) -> list[bytes | None]:
        """Of each loop, in the order of the program, what was compiled, as the compiler is given it."""
        return [loop.written for loop in self._loops]

    @property
    def lasts(self) -> bool:
        """Whether it can be run by another process."""
        return self._numpy_does_all and not any(loop.is_lost for loop in self._loops)

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

    def __init__(self, options: dict[str, Any], written: Sequence[bytes | None] | None, kept: bool) -> None:
        self.options = options
        self.kept = kept
        self.written = iter(written or ())
        self.loops: list[_Loop] = []
        self.lasts = True
        self.runs = 1.0  # guessed, of what is being made
        self._known: dict[int, Made] = {}

    @contextmanager
    def repeated(self, times: float) -> Iterator[None]:
        """While the body of a loop is being made."""
        self.runs *= times
        yield
        self.runs /= times

    def made(self, trace: Trace) -> Made:
        found = self._known.get(id(trace))
        if found is not None:
            return found._replace(size=1.0)
        found = self._known[id(trace)] = self._make(trace)
        return found

    def step(self, op: Operation) -> Made:
        """One operation."""
        nested = NESTED.get(op.name)
        if nested:
            return nested(op, self)
        step = of_numpy(op)
        if step is None:
            self.lasts = False
            step = operation(op)
        return Made(1.0, 0.0, step)

    def _make(self, trace: Trace) -> Made:
        """Each value has a place in a list, each step knows its places."""
        known, inputs, outputs = trace.known, trace.takes, trace.gives
        steps, size, work, own = [], 0.0, 0.0, 0.0
        for op in trace.operations:
            weight = 1.0 + sum(shaped.size for shaped in op.made) / ELEMENTS
            inside = self.step(op)
            size, work, own = size + inside.size, work + inside.work + weight, own + weight
            steps.append((inside.run, op.ins, op.outs, len(op.outs) == 1))

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

    def __init__(self, op: Operation, maker: _Maker, size: float, work: float, body: Trace):
        self._whole, self._kept = op.whole, maker.kept
        wide = max((shaped.size for shaped in body.made), default=0) >= WIDE
        self._options = _thorough(maker.options) if wide else maker.options
        rent = LENT if self._kept and size <= MODERATE else RENT
        self.size, self.work = size, work
        self.written = next(maker.written, None)
        self._left = rent * (size + LEAST) * (AGAIN if op.whole is None and self.written is None else 1)
        self.is_lost = False
        self._compiled: Callable[..., Any] | None = None
        if self.written is not None or work * maker.runs > self._left:
            self._left, self.work = 0.0, CALL
        maker.loops.append(self)

    def is_due(self) -> bool:
        return self._left <= 0.0

    def took(self, steps: float) -> None:
        self._left -= steps

    def run(self, *values: Any) -> Any:
        """All of it, compiled, from these values on."""
        _taken.steps += CALL
        with jax.ensure_compile_time_eval():
            if self._compiled is None:
                if self._kept:
                    lapack.at_hand()
                self._compiled = self._ready(values)
            found = [np.asarray(x)[()] for x in self._compiled(*values)]
        return _alone(found)

    def _ready(self, values: tuple[Any, ...]) -> Callable[..., Any]:
        """Made ready for the compiler, once for all loops that are alike, as of several fans in a line."""
        found = self._alike()
        if found is None:
            function = self._function(values)
            found = self._alike()
            if found is None:
                found = jax.jit(function, **self._options)
                if self.written is not None:
                    _written[self.written, repr(self._options)] = found
        return found

    def _alike(self) -> Callable[..., Any] | None:
        return None if self.written is None else _written.get((self.written, repr(self._options)))

    def _function(self, values: tuple[Any, ...]) -> Callable[..., Any]:
        """What is compiled: through the form in which it is kept, so that the compiler's own cache knows it
        again.
        """
        if self.written is not None:
            from jax import export

            return export.deserialize(bytearray(self.written)).call
        if self._whole is None:
            raise Outgrown
        bind, params = self._whole.primitive.bind, self._whole.params

        def plain(*given: Any) -> Any:
            return bind(*given, **params)

        if not self._kept:
            return plain
        from jax import export

        try:
            exported = export.export(jax.jit(plain))(*values)
            self.written = bytes(exported.serialize())
            return exported.call
        except (
            ValueError,
            NotImplementedError,
            ImportError,
        ):  # it calls what is not the same in every version
            self.is_lost = True
            return plain


def _thorough(options: dict[str, Any]) -> dict[str, Any]:
    """Options of ``jax.jit`` for what takes long; those of a compiler that is not told any stay its own."""
    told = options.get("compiler_options")
    more = {"compiler_options": told | {"xla_backend_optimization_level": THOROUGH}} if told else {}
    return options | more


def _alone(found: list[Any]) -> Any:
    return found[0] if len(found) == 1 else found


def _called(name: str) -> Callable[[Operation, _Maker], Made]:
    def made(op: Operation, maker: _Maker) -> Made:
        body = maker.made(op.params[name])
        run = body.run
        return body._replace(run=lambda *values: _alone(run(*values)))

    return made


def _while(op: Operation, maker: _Maker) -> Made:
    params = op.params
    with maker.repeated(PASSES):
        judge, body = maker.made(params["cond_jaxpr"]), maker.made(params["body_jaxpr"])
    loop = _Loop(op, maker, judge.size + body.size, PASSES * (judge.work + body.work), params["body_jaxpr"])
    first, second = params["cond_nconsts"], params["cond_nconsts"] + params["body_nconsts"]
    several = bool(params["cond_jaxpr"].made[0].shape)

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


def _cond(op: Operation, maker: _Maker) -> Made:
    branches = [maker.made(branch) for branch in op.params["branches"]]

    def step(which: Any, *values: Any) -> Any:
        return _alone(branches[min(max(int(which), 0), len(branches) - 1)].run(*values))

    return Made(sum(b.size for b in branches), max(b.work for b in branches), step)


def _scan(op: Operation, maker: _Maker) -> Made:
    params = op.params
    length, carried = params["length"], params["num_carry"]
    with maker.repeated(length):
        body = maker.made(params["jaxpr"])
    loop = _Loop(op, maker, body.size, length * body.work, params["jaxpr"])
    first, second = params["num_consts"], params["num_consts"] + carried
    shapes, backward = params["jaxpr"].made[carried:], params["reverse"]

    def step(*values: Any) -> Any:
        if loop.is_due():
            return loop.run(*values)
        before = _taken.steps
        fixed, carry, rows = values[:first], list(values[first:second]), values[second:]
        made = [np.empty((length, *shape), dtype) for shape, dtype in shapes]
        for i in range(length)[:: -1 if backward else 1]:
            found = body.run(*fixed, *carry, *(row[i] for row in rows))
            carry = found[:carried]
            for whole, part in zip(made, found[carried:], strict=True):
                whole[i] = part
        loop.took(_taken.steps - before)
        return _alone([*carry, *made])

    return Made(loop.size, loop.work, step)


def _linear_solve(op: Operation, maker: _Maker) -> Made:
    params = op.params
    body, before, after = maker.made(params["solve"]), params["before"], params["after"]
    constants = slice(before, before + params["constants"])

    def step(*values: Any) -> Any:
        return _alone(body.run(*values[constants], *values[after:]))

    return body._replace(run=step)


NESTED: dict[str, Callable[[Operation, _Maker], Made]] = {
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
