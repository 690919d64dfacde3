"""Many cases of one subject: in memory-bounded chunks, over threads or Dask workers, with progress,
cancelling and restart.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Generator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import jax
import numpy as np

from granum.core.errors import ConvergenceError, InputError
from granum.core.i18n import _
from granum.studies.chunks import CHUNKS, Evaluator, evaluator
from granum.studies.store import Part, Store
from granum.studies.subjects import EXTRAPOLATED, FINE, NOT_RUN, Subject
from granum.studies.workers import computed


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
        return self.texts.get(case) or self.reason_of(int(self.codes[case]))

    def reason_of(self, code: int) -> str:
        """What a code says; nothing of a case that has a result."""
        return "" if code <= FINE else self.subject.reason(code, self.inputs, self.outputs)

    def reasons(self) -> dict[str, int]:
        """How many cases failed for which reason."""
        counts: dict[str, int] = {}
        for case in np.flatnonzero(~self.fine):
            text = self.reason(int(case))
            counts[text] = counts.get(text, 0) + 1
        return counts


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
    return computed(subject.recipe, inputs, outputs, chunks, workers)
