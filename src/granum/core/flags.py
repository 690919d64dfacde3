"""Flags: what happened inside an array computation that a reader must know, as bits and as records.

While a collector is open, every formula that runs, however deep, records where it left its fitted range. A
record made inside an inner transformation (a loop body, an inner ``vmap``) is dropped: the caller records the
final value again.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from typing import Any

import jax
import jax.extend
import jax.numpy as jnp
import numpy as np

EXTRAPOLATED, OUTSIDE_DOMAIN, NOT_FINITE, NOT_CONVERGED, LIMIT_ACTIVE = 1, 2, 4, 8, 16
WORDS = {
    EXTRAPOLATED: "extrapolated",
    OUTSIDE_DOMAIN: "outside domain",
    NOT_FINITE: "not finite",
    NOT_CONVERGED: "not converged",
    LIMIT_ACTIVE: "limit active",
}


@jax.tree_util.register_dataclass
@dataclass(frozen=True)
class Record:
    """One check: where ``mask`` is true, ``value`` is outside ``[low, high]``. Travels through jit."""

    mask: Any
    value: Any
    bit: int = field(metadata={"static": True})
    name: str = field(metadata={"static": True})
    card: str = field(metadata={"static": True})
    low: float = field(metadata={"static": True})
    high: float = field(metadata={"static": True})
    source: str = field(metadata={"static": True})
    reason: str = field(default="", metadata={"static": True})
    # limits that depend on the other inputs, in place of low and high
    computed: tuple[Any, Any] | None = None
    # outputs that have no value for this reason
    without: tuple[str, ...] = field(default=(), metadata={"static": True})


class _Collector:
    def __init__(self, only: int) -> None:
        self.records: list[Record] = []
        self.only = only
        self.level = jax.extend.core.get_opaque_trace_state()

    def accepts(self) -> bool:
        return jax.extend.core.get_opaque_trace_state() == self.level


_OUTERMOST = jax.extend.core.get_opaque_trace_state()
_active: ContextVar[_Collector | None] = ContextVar("granum_flags", default=None)
_current: ContextVar[Any] = ContextVar("granum_formula", default=None)


@contextmanager
def collect(only: int = 0) -> Iterator[list[Record]]:
    """Open a collector; the list fills with records (``only`` those of one bit) while formulas run at this
    trace level.
    """
    collector = _Collector(only)
    token = _active.set(collector)
    try:
        yield collector.records
    finally:
        _active.reset(token)


def is_inner() -> bool:
    """Whether this runs while JAX traces, even if all numbers at hand are known."""
    return jax.extend.core.get_opaque_trace_state() != _OUTERMOST


def listening() -> bool:
    """Whether a record made now would be told to somebody: limits that cost much to compute are worth it only
    then.
    """
    collector = _active.get()
    return collector is not None and not collector.only and collector.accepts()


def kept() -> list[Record]:
    """What the collector at this trace level has kept so far; empty where none listens."""
    collector = _active.get()
    return collector.records if collector is not None and collector.accepts() else []


@contextmanager
def inside(formula: Any) -> Iterator[None]:
    """Marks which formula is running, so that ``watch`` knows whose ranges apply."""
    token = _current.set(formula)
    try:
        yield
    finally:
        _current.reset(token)


def record(
    bit: int,
    mask: Any,
    value: Any,
    name: str,
    card: str,
    low: float = -np.inf,
    high: float = np.inf,
    source: str = "",
    reason: str = "",
    computed: tuple[Any, Any] | None = None,
    without: tuple[str, ...] = (),
) -> None:
    """Add a record if a collector listens at this trace level."""
    collector = _active.get()
    if collector is not None and collector.only in (0, bit) and collector.accepts():
        # of plain numbers, as in an inner call with constants, "~(a < b)" is the integer -1 or -2, whose last
        # bit is what was meant
        mask = jnp.asarray(bool(mask & 1) if type(mask) is int else mask)
        if computed is not None:
            computed = (jnp.broadcast_to(computed[0], mask.shape), jnp.broadcast_to(computed[1], mask.shape))
        collector.records.append(
            Record(mask, jnp.asarray(value), bit, name, card, low, high, source, reason, computed, without)
        )


def hand_on(records: list[Record]) -> None:
    """Tell what another collector kept to the one that listens at this trace level, if any."""
    collector = _active.get()
    if collector is not None and collector.accepts():
        collector.records += [r for r in records if collector.only in (0, r.bit)]


def nested() -> bool:
    """Whether a formula is running, so that a call made now stands inside another one."""
    return _current.get() is not None


def watch(**values: Any) -> None:
    """Inside a formula body: check a derived number against the range the card declares for that name.

    ``@formula(fitted={"reynolds": (1e-4, 2e5)})`` with ``watch(reynolds=Re)`` in the body flags the
    extrapolation.
    """
    formula = _current.get()
    if formula is not None:
        ranged(formula, values)


def ranged(card: Any, values: Mapping[str, Any]) -> None:
    """Check numbers against the ranges that a card, or whoever has its key, source and ranges, declares for
    them.
    """
    if not listening():
        return
    for name, value in values.items():
        low, high = card.fitted[name]
        record(EXTRAPOLATED, (value < low) | (value > high), value, name, card.key, low, high, card.source)


def unconverged(converged: Any, name: str = "iteration") -> None:
    """Inside a formula body: record the elements whose inner iteration did not converge."""
    formula = _current.get()
    if formula is not None:
        record(
            NOT_CONVERGED, ~jnp.asarray(converged), jnp.zeros(()), name, formula.key, source=formula.source
        )


def unsolved(converged: Any, card: Any, name: str = "iteration", reason: str = "") -> None:
    """Inside a unit: record that its inner solution was not found. ``card`` is the unit's; ``reason`` as for
    ``limit_active``.
    """
    record(
        NOT_CONVERGED,
        ~jnp.asarray(converged),
        jnp.zeros(()),
        name,
        card.key,
        source=card.source,
        reason=reason,
    )


def beyond(
    mask: Any, value: Any, name: str, card: Any, low: Any = -np.inf, high: Any = np.inf, reason: str = ""
) -> None:
    """Inside a unit: record that a setting, such as its area, lies beyond what the other inputs allow;
    ``card`` and ``reason`` as for ``unsolved``, limits as for ``impossible``.
    """
    record(
        OUTSIDE_DOMAIN, mask, value, name, card.key, source=card.source, reason=reason, computed=(low, high)
    )


def extrapolated(
    mask: Any, value: Any, name: str, low: Any = -np.inf, high: Any = np.inf, reason: str = ""
) -> None:
    """Inside a formula body: record the elements beyond limits that depend on the other inputs; ``reason`` as
    for ``impossible``.
    """
    formula = _current.get()
    if formula is not None:
        record(
            EXTRAPOLATED,
            mask,
            value,
            name,
            formula.key,
            source=formula.source,
            reason=reason,
            computed=(low, high),
        )


def impossible(
    mask: Any, value: Any, name: str, low: Any = -np.inf, high: Any = np.inf, reason: str = ""
) -> None:
    """Inside a formula body: record the elements for which the inputs contradict one another, so that no
    value exists.

    The outermost call on concrete values gives none there; a body whose number would look plausible says NaN
    itself, for its callers. Of several records the first one is what a reader is told; ``reason`` as for
    ``limit_active``, after the limits where there are any. These may be computed: they are told for the
    element that lies farthest out.
    """
    formula = _current.get()
    if formula is not None:
        record(
            OUTSIDE_DOMAIN,
            mask,
            value,
            name,
            formula.key,
            source=formula.source,
            reason=reason,
            computed=(low, high),
        )


def limit_active(mask: Any, value: Any, name: str, reason: str, without: tuple[str, ...] = ()) -> None:
    """Inside a formula body: record where a physical limit cut the result.

    ``reason`` is an English sentence with a French translation: which limit, why, and what is given in place.
    The elements concerned are told after it. ``without`` names outputs that are not a number there, for this
    reason, while the others stand.
    """
    formula = _current.get()
    if formula is not None:
        record(
            LIMIT_ACTIVE,
            mask,
            value,
            name,
            formula.key,
            source=formula.source,
            reason=reason,
            without=without,
        )


def within(mask: Any, shape: tuple[int, ...]) -> Any:
    """A mask without the leading axes that a result of this shape does not have: what concerns any of them
    concerns the element.
    """
    return mask.any(axis=tuple(range(max(mask.ndim - len(shape), 0))))


def bits(records: list[Record], shape: tuple[int, ...]) -> np.ndarray:
    """All records as one int32 flag array of the result's shape."""
    flags = np.zeros(shape, dtype=np.int32)
    for found in records:
        mask = within(np.asarray(found.mask), shape)
        try:
            flags |= np.where(np.broadcast_to(mask, shape), np.int32(found.bit), np.int32(0))
        except ValueError:  # a check over another axis than the result's: it concerns the result as a whole
            flags |= np.int32(found.bit) if mask.any() else np.int32(0)
    return flags
