"""Chunks of cases computed: figures and codes of any number of them, by code compiled once for chunks of one
size.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from granum.core.compiling import ahead
from granum.core.errors import GranumError
from granum.core.kinds import Kind
from granum.studies.store import Part
from granum.studies.subjects import (
    FINE,
    IMPOSSIBLE,
    LOST,
    NOT_CONVERGED,
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
        arrays = subject.numbers(among_many=sort == "line")
        one = subject.traced(inputs, outputs, among_many=sort == "line")
        # one after the other in compiled code beats side by side for a line on a processor: no case waits for
        # the slowest
        many = (
            _one_after_the_other(one)
            if sort == "line"
            else lambda a, x, _count: jax.vmap(one, in_axes=(None, 0))(a, x)
        )
        while True:
            like = arrays, jnp.zeros((size, len(inputs))), jnp.int32(size)
            compiled = ahead(many, *like) if sort == "line" else jax.jit(many).lower(*like).compile()
            memory = compiled.memory_analysis()
            if memory is None or memory.temp_size_in_bytes <= MEMORY or size == 1:
                serial = sort == "line"
                begun = _begun(subject, inputs, size, compiled, arrays) if serial else arrays
                return Evaluator(subject, inputs, outputs, size, compiled, begun, serial)
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
            for part in self.compiled(self.arrays, jnp.asarray(padded), jnp.int32(len(fine)))[:2]
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


def evaluator(subject: Subject, inputs: tuple[str, ...], outputs: tuple[str, ...], count: int) -> Evaluator:
    """The evaluator of a subject, which keeps the last few, compiled."""
    size = min(1 << max(count - 1, 0).bit_length(), max(CHUNKS.values()))
    return subject.kept(
        ("cases", inputs, outputs, size), lambda: Evaluator.of(subject, inputs, outputs, count)
    )


def _one_after_the_other(one: Any) -> Any:
    """As many of the cases as are wanted, in a loop of compiled code, and where the last of them ended."""

    def many(arrays: Any, x: Any, count: Any) -> Any:
        *told, end = jax.eval_shape(one, arrays, x[0])

        def step(i: Any, made: Any) -> Any:
            *parts, _end = made
            *found, end = one(arrays, x[i])
            return *(part.at[i].set(new) for part, new in zip(parts, found, strict=True)), end

        made = (jnp.zeros((len(x), *new.shape), new.dtype) for new in told)
        return jax.lax.fori_loop(
            0, count, step, (*made, jax.tree.map(lambda leaf: jnp.zeros(leaf.shape, leaf.dtype), end))
        )

    return many


def _begun(subject: Subject, inputs: tuple[str, ...], size: int, compiled: Any, arrays: Any) -> Any:
    """The numbers with which every case begins where the one that nothing changes ends, if that is solved:
    the same for all, so that no case depends on its neighbors.
    """
    nominal = [subject.nominal(path) for path in inputs]
    if not np.all(np.isfinite(nominal)):
        return arrays
    x = jnp.broadcast_to(jnp.asarray(nominal, dtype=float), (size, len(inputs)))
    _figures, codes, end = compiled(arrays, x, jnp.int32(1))
    return subject.numbers(end) if codes[0] <= FINE else arrays


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
