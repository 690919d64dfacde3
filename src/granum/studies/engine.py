"""Many cases of one subject: in memory-bounded chunks, over threads or Dask workers, with progress,
cancelling and restart.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Generator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.core.errors import ConvergenceError, GranumError, InputError
from granum.core.i18n import _
from granum.core.kinds import Kind
from granum.studies.store import Part, Store
from granum.studies.subjects import (
    EXTRAPOLATED,
    FINE,
    IMPOSSIBLE,
    LOST,
    NOT_CONVERGED,
    NOT_RUN,
    OUTSIDE,
    RAISED,
    UNMET,
    FormulaSubject,
    Subject,
)

MEMORY = 512 * 2**20
"""Bytes of working memory that one chunk may take."""
SLICE = 0.5
"""Seconds of a slow line after which a study looks around: progress is shown, it can be stopped, and little
is lost.
"""
CHUNKS = {"batched": 16384, "line": 64, "accelerator": 2048, "python": 64}


class Progress(NamedTuple):
    """How far a study is: cases (or steps) done of how many, how many failed, and what is being done."""

    done: int
    total: int
    failed: int
    note: str = ""


Report = Callable[[Progress], Any]
Cancel = Callable[[], bool]


@dataclass(frozen=True)
class Cases:
    """Inputs and figures of many cases, SI, with a code each (0 = fine) and texts of refusals; ``notes`` tell
    what else a reader must know.
    """

    subject: Subject
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    x: np.ndarray
    y: np.ndarray
    codes: np.ndarray
    texts: dict[int, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    rungs: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int8))
    """Which solver each took, from 0, where there is more than one."""

    @property
    def fine(self) -> np.ndarray:
        """Which cases gave a result."""
        return self.codes <= FINE

    @property
    def extrapolated(self) -> np.ndarray:
        """Which cases gave a result for which some correlation was used outside its range."""
        return self.codes == EXTRAPOLATED

    @property
    def complete(self) -> bool:
        """Whether every case was run."""
        return not np.any(self.codes == NOT_RUN)

    def reason(self, case: int) -> str:
        """Why a case failed; empty when it did not."""
        code = int(self.codes[case])
        return self.texts.get(case) or (
            "" if code <= FINE else self.subject.reason(code, self.inputs, self.outputs)
        )

    def reasons(self) -> dict[str, int]:
        """How many cases failed for which reason."""
        counts: dict[str, int] = {}
        for case in np.flatnonzero(~self.fine):
            text = self.reason(int(case))
            counts[text] = counts.get(text, 0) + 1
        return counts


@dataclass(frozen=True)
class Evaluator:
    """Computes one chunk of a fixed size; compiled once."""

    subject: Subject
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    size: int
    compiled: Any
    arrays: Any
    serial: bool = False

    @staticmethod
    def of(subject: Subject, inputs: tuple[str, ...], outputs: tuple[str, ...], count: int) -> Evaluator:
        """An evaluator for chunks of up to ``count`` cases, as large as memory allows."""
        if isinstance(subject, FormulaSubject) and not subject.pure:
            return Evaluator(subject, inputs, outputs, min(count, CHUNKS["python"]), None, None)
        accelerator = jax.default_backend() != "cpu"
        sort = (
            "accelerator" if accelerator and not subject.batched else "batched" if subject.batched else "line"
        )
        size = min(CHUNKS[sort], 1 << max(count - 1, 0).bit_length())
        arrays = subject.numbers()
        one = subject.traced(inputs, outputs)
        # one after the other in compiled code beats side by side for a line on a processor: no case waits for
        # the slowest
        many = (
            _one_after_the_other(one)
            if sort == "line"
            else lambda a, x, _count: jax.vmap(one, in_axes=(None, 0))(a, x)
        )
        while True:
            compiled = jax.jit(many).lower(arrays, jnp.zeros((size, len(inputs))), jnp.int32(size)).compile()
            memory = compiled.memory_analysis()
            if memory is None or memory.temp_size_in_bytes <= MEMORY or size == 1:
                return Evaluator(subject, inputs, outputs, size, compiled, arrays, sort == "line")
            size = max(1, int(size * 0.9 * MEMORY / memory.temp_size_in_bytes))

    def chunk(self, x: np.ndarray) -> int:
        """How many cases to compute before the next look around: all at once, or as many slow lines as take
        about ``SLICE``.
        """
        if not self.serial:
            return self.size
        began = time.perf_counter()
        self._some(x[:1])
        return max(1, min(self.size, int(SLICE / (time.perf_counter() - began))))

    def __call__(self, x: np.ndarray) -> Part:
        """Figures, codes and texts of any number of cases."""
        made = [self._some(x[start : start + self.size]) for start in range(0, len(x), self.size)]
        texts = {k + i * self.size: text for i, part in enumerate(made) for k, text in part.texts.items()}
        y, codes = np.concatenate([part.y for part in made]), np.concatenate([part.codes for part in made])
        for j, path in enumerate(self.outputs):
            impossible = (codes <= FINE) & ~_possible(y[:, j], self.subject.output(path).parameter.kind)
            codes[impossible], y[impossible] = IMPOSSIBLE + j, np.nan
        return Part(y, codes, texts, np.concatenate([part.rungs for part in made]))

    def _some(self, x: np.ndarray) -> Part:
        """Those of up to ``size`` cases."""
        codes = np.zeros(len(x), np.int32)
        for i, path in enumerate(self.inputs):
            kind = self.subject.input(path).parameter.kind
            if kind is not None:
                codes[(codes == FINE) & ~np.asarray(kind.contains(x[:, i]) & np.isfinite(x[:, i]))] = (
                    OUTSIDE + i
                )
        fine = np.flatnonzero(codes == FINE)
        y, rungs = np.full((len(x), len(self.outputs)), np.nan), np.zeros(len(x), np.int8)
        if not len(fine):
            return Part(y, codes, {}, rungs)
        if self.compiled is None:
            return self._one_by_one(x, y, codes, fine)
        # a chunk that is not full is filled up with a possible case: one shape, one compilation
        padded = np.repeat(x[fine[:1]], self.size, axis=0)
        padded[: len(fine)] = x[fine]
        figures, found = (
            np.asarray(part)[: len(fine)]
            for part in self.compiled(self.arrays, jnp.asarray(padded), jnp.int32(len(fine)))
        )
        codes[fine], y[fine] = found, figures
        y[codes > FINE] = np.nan
        harder = self.subject.harder
        lost = np.flatnonzero((codes == NOT_CONVERGED) | (codes == UNMET) | (codes >= LOST))
        if harder is not None and len(lost):
            again = evaluator(harder, self.inputs, self.outputs, self.size)._some(x[lost])
            solved = again.codes <= FINE
            found = lost[solved]
            y[found], codes[found], rungs[found] = (
                again.y[solved],
                again.codes[solved],
                again.rungs[solved] + 1,
            )
        return Part(y, codes, {}, rungs)

    def _one_by_one(self, x: np.ndarray, y: np.ndarray, codes: np.ndarray, fine: np.ndarray) -> Part:
        texts: dict[int, str] = {}
        run = self.subject.traced(self.inputs, self.outputs)
        for case in fine:
            try:
                figures, code = run(self.subject.numbers(), [float(v) for v in x[case]])
                codes[case] = int(code)
                y[case] = np.asarray(figures) if int(code) <= FINE else np.nan
            except GranumError as problem:
                codes[case], texts[int(case)] = RAISED, problem.message
        return Part(y, codes, texts, np.zeros(len(x), np.int8))


def _one_after_the_other(one: Any) -> Any:
    """As many of the cases as are wanted, in a loop of compiled code."""

    def many(arrays: Any, x: Any, count: Any) -> Any:
        figures, code = jax.eval_shape(one, arrays, x[0])

        def step(i: Any, made: Any) -> Any:
            return tuple(part.at[i].set(new) for part, new in zip(made, one(arrays, x[i]), strict=True))

        return jax.lax.fori_loop(
            0, count, step, tuple(jnp.zeros((len(x), *new.shape), new.dtype) for new in (figures, code))
        )

    return many


def _possible(y: np.ndarray, kind: Kind | None) -> np.ndarray:
    """Which figures lie inside the bounds of their kind, but for rounding."""
    if kind is None:
        return np.isfinite(y)
    good = np.isfinite(y)
    usual = float(np.median(np.abs(y[good]))) if good.any() else 0.0
    slack = 1e-12 + 1e-9 * max(
        usual, *(abs(bound) for bound in (kind.lower, kind.upper) if np.isfinite(bound)), 0.0
    )
    return good & (y >= kind.lower - slack) & (y <= kind.upper + slack)


def evaluator(subject: Subject, inputs: tuple[str, ...], outputs: tuple[str, ...], count: int) -> Evaluator:
    """The evaluator of a subject, which keeps the last few, compiled."""
    size = min(1 << max(count - 1, 0).bit_length(), max(CHUNKS.values()))
    return subject.kept(
        ("cases", inputs, outputs, size), lambda: Evaluator.of(subject, inputs, outputs, count)
    )


def evaluate(
    subject: Subject,
    inputs: tuple[str, ...],
    outputs: tuple[str, ...],
    x: np.ndarray,
    *,
    progress: Report | None = None,
    cancel: Cancel | None = None,
    folder: str | Path | None = None,
    workers: Any = None,
    even_none: bool = False,
) -> Cases:
    """Compute all cases ``x`` (cases × inputs, SI). Raises ``ConvergenceError`` (with the cases as ``last``)
    when none gives a result.

    Parameters
    ----------
    progress: called with a ``Progress`` after every chunk.
    cancel: asked after every chunk; True stops, what is not done is marked so.
    folder: where finished chunks are kept; the same call continues there.
    workers: number of local Dask workers, or the address of a Dask scheduler; None computes here on all
        cores.
    even_none: give the cases back even when none has a result.
    """
    x = np.atleast_2d(np.asarray(x, dtype=float))
    for path in inputs:
        subject.input(path)
    cases = Cases(
        subject,
        inputs,
        outputs,
        x,
        np.full((len(x), len(outputs)), np.nan),
        np.full(len(x), NOT_RUN, np.int32),
        rungs=np.zeros(len(x), np.int8),
    )
    store = Store(Path(folder)) if folder is not None else None
    size = store.open(subject.fingerprint(), (inputs, outputs), x) if store is not None else None
    if size is None:
        size = (
            _chunk(subject, len(x))
            if workers is not None
            else evaluator(subject, inputs, outputs, len(x)).chunk(x)
        )
        if store is not None:
            store.begin(size)
    todo = [start for start in range(0, len(x), size) if not _kept(store, cases, start)]

    def report() -> bool:
        if progress is not None:
            run = cases.codes != NOT_RUN
            progress(Progress(int(run.sum()), len(x), int((run & ~cases.fine).sum())))
        return cancel is not None and bool(cancel())

    if report() or not todo:
        return _some_fine(cases, even_none)
    chunks = [(start, x[start : start + size]) for start in todo]
    made = (
        _remote(subject, inputs, outputs, chunks, workers)
        if workers is not None
        else _local(evaluator(subject, inputs, outputs, len(x)), chunks)
    )
    with closing(made):
        for start, found in made:
            _fill(cases, start, found)
            if store is not None:
                _keep(store, cases, start, found)
            if report():
                break
    return _some_fine(cases, even_none)


def _some_fine(cases: Cases, even_none: bool) -> Cases:
    if even_none or not cases.complete or cases.fine.any():
        return cases
    told = [
        f"{count} × {reason}" for reason, count in sorted(cases.reasons().items(), key=lambda row: -row[1])
    ]
    raise ConvergenceError(
        _("None of the {count} cases has a result: {reasons}.").format(
            count=len(cases.codes), reasons="; ".join(told[:3])
        ),
        last=cases,
    )


def _kept(store: Store | None, cases: Cases, start: int) -> bool:
    """Whether a chunk was computed before and is here now; one that is not what it should be is named."""
    if store is None:
        return False
    try:
        part = store.load(start)
    except ValueError:
        name = store.path(start).name
        cases.notes.append(
            _("'{file}' was damaged or belongs to another study: its cases were computed again.").format(
                file=name
            )
        )
        return False
    if part is not None:
        _fill(cases, start, part)
    return part is not None


def _keep(store: Store, cases: Cases, start: int, part: Part) -> None:
    """Write a chunk; when the disk is full or gone, what was written before stays, and the message says
    so.
    """
    try:
        store.save(start, part)
    except InputError as problem:
        done = int((cases.codes != NOT_RUN).sum()) - len(part.codes)
        told = _(
            "{done} of {total} cases are kept; the same command continues there once it can be written."
        ).format(done=done, total=len(cases.codes))
        raise InputError(f"{problem.message} {told}", **problem.details) from None


def _chunk(subject: Subject, count: int) -> int:
    """Chunks for workers: small enough to share out, a quarter of what one process takes at once."""
    most = CHUNKS["batched"] // 4 if subject.batched else CHUNKS["line"]
    return max(1, min(most, -(-count // 8)))


def _fill(cases: Cases, start: int, part: Part) -> None:
    cases.y[start : start + len(part.y)] = part.y
    cases.codes[start : start + len(part.y)] = part.codes
    cases.rungs[start : start + len(part.y)] = part.rungs
    cases.texts.update({start + k: v for k, v in part.texts.items()})


Made = Generator[tuple[int, Part], None, None]


def _local(compute: Evaluator, chunks: list[tuple[int, np.ndarray]]) -> Made:
    """Chunks computed by threads (compiled code leaves the interpreter free), a few ahead, as they finish."""
    threads = (
        1
        if compute.compiled is None or jax.default_backend() != "cpu"
        else max(1, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)
    )
    with ThreadPoolExecutor(threads) as pool:
        waiting = list(reversed(chunks))
        running: dict[Future[Any], int] = {}
        try:
            while waiting or running:
                while waiting and len(running) < threads + 1:
                    start, part = waiting.pop()
                    running[pool.submit(compute, part)] = start
                done, _pending = wait(running, return_when=FIRST_COMPLETED)
                for one in done:
                    yield running.pop(one), one.result()
        finally:
            for one in running:
                one.cancel()


def _remote(
    subject: Subject,
    inputs: tuple[str, ...],
    outputs: tuple[str, ...],
    chunks: list[tuple[int, np.ndarray]],
    workers: Any,
) -> Made:
    if subject.recipe is None:
        raise InputError(
            _(
                "Workers build the model themselves: they need a study read from a file or a table, not "
                "a model made in Python."
            )
        )
    from granum.studies.workers import computed

    return computed(subject.recipe, inputs, outputs, chunks, workers)
