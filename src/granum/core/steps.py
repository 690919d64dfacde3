"""Formulas as they are evaluated one after the other: the raw material of a calculation note."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, NamedTuple

import jax
import jax.extend
import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.core.conversion import is_tracer
from granum.core.notices import beside, describe
from granum.core.registry import find
from granum.core.results import Result


class Step(NamedTuple):
    """A formula evaluated once: its key, inputs by name, value and what was flagged. Travels through jit."""

    key: str
    inputs: dict[str, Any]
    value: Any
    records: list[flags.Record]

    def result(self) -> Result:
        """The same as a reader is told it."""
        card = find(self.key).card
        leaves = jax.tree.leaves(self.value)
        several = isinstance(self.value, tuple)
        shape = np.shape(leaves[0]) if several else np.broadcast_shapes(*map(np.shape, leaves))
        own = {p.name for p in (*card.parameters, *card.outputs)}
        return Result(
            card,
            self.inputs,
            floats(self.value),
            flags.bits(self.records, shape),
            describe(self.records),
            beside=[] if shape else beside(self.records, own),
        )


class _Recorder(NamedTuple):
    steps: list[Step]
    level: Any


_active: ContextVar[_Recorder | None] = ContextVar("granum_steps", default=None)


@contextmanager
def record_steps() -> Iterator[list[Step]]:
    """Keep every formula that is evaluated inside the block at this trace level."""
    recorder = _Recorder([], jax.extend.core.get_opaque_trace_state())
    token = _active.set(recorder)
    try:
        yield recorder.steps
    finally:
        _active.reset(token)


def recorded() -> list[Step] | None:
    """The list in which steps at this trace level are kept, if they are."""
    recorder = _active.get()
    if recorder is None or jax.extend.core.get_opaque_trace_state() != recorder.level:
        return None
    return recorder.steps


def floats(value: Any) -> Any:
    """Single numbers as Python's own."""
    if isinstance(value, tuple):
        return type(value)(*map(floats, value)) if hasattr(value, "_fields") else tuple(map(floats, value))
    single = getattr(value, "ndim", 1) == 0 and jnp.issubdtype(value.dtype, jnp.floating)
    # a call on constants inside an outer jit yields a tracer
    return value.item() if single and not is_tracer(value) else value
