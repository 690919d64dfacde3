"""Outputs against the hard bounds of their own kinds: a figure outside them is not a value."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.core.errors import ApplicabilityError
from granum.core.notices import describe
from granum.core.parameters import Parameter

# by which rounding may carry a number beyond its bound, relative to bounds and ordinary size
ROUNDING = 1e-12
SOLVED = 1e-6  # of the largest figure of a series that was solved for step by step
CONTRADICTION = "The values given contradict one another, or lie beyond what this holds for."


def limits(parameter: Parameter) -> tuple[float, float]:
    """Bounds that a computed value keeps: those of its kind, widened by what rounding does to numbers of
    ordinary size.
    """
    kind = parameter.kind
    assert kind is not None
    ends = (kind.lower, kind.upper, *parameter.ordinary())
    slack = ROUNDING * max(abs(x) for x in ends if np.isfinite(x))
    return kind.lower - slack, kind.upper + slack


def figures(outputs: Iterable[Parameter], out: Any) -> Iterator[tuple[Parameter, Any]]:
    """The outputs that are quantities, each with its value."""
    for p, value in zip(outputs, out if isinstance(out, tuple) else (out,), strict=True):
        if p.kind is not None and value is not None:
            yield p, value


def concerned(mask: Any, value: Any, whole: bool) -> Any:
    """The elements of a value that a check concerns; ``whole`` where a check over another axis concerns all
    of it.
    """
    shape = jnp.shape(value)
    mask = flags.within(mask, shape)
    fits = all(n in (1, m) for n, m in zip(mask.shape[::-1], shape[::-1], strict=False))
    return mask if fits else jnp.any(mask) if whole else jnp.asarray(False)


def record_outside(outputs: Iterable[Parameter], out: Any, card: str, source: str, start: int) -> None:
    """Record the finite outputs outside their own bounds, where no record made since ``start`` has said so of
    the inputs.
    """
    told = [found.mask for found in flags.kept()[start:] if found.bit == flags.OUTSIDE_DOMAIN]
    for p, value in figures(outputs, out):
        low, high = limits(p)
        if (low, high) == (-np.inf, np.inf):
            continue
        value = jnp.asarray(value)
        beyond = jnp.isfinite(value) & ((value < low) | (value > high))
        for mask in told:
            beyond = beyond & ~concerned(mask, beyond, False)
        assert p.kind is not None
        flags.record(
            flags.OUTSIDE_DOMAIN,
            beyond,
            value,
            p.name,
            card,
            p.kind.lower,
            p.kind.upper,
            source,
            CONTRADICTION,
        )


def without_impossible(
    outputs: Iterable[Parameter], out: Any, records: Iterable[flags.Record], whole: bool
) -> Any:
    """Outputs with NaN where a record says that no value exists, and where one of them is infinite."""
    masks = [found.mask for found in records if found.bit == flags.OUTSIDE_DOMAIN]
    masks += [
        jnp.isinf(value)
        for _p, value in figures(outputs, out)
        if jnp.issubdtype(jnp.result_type(value), jnp.floating)
    ]

    def kept(value: Any) -> Any:
        if jnp.issubdtype(jnp.result_type(value), jnp.floating):
            for mask in masks:
                value = jnp.where(concerned(mask, value, whole), jnp.nan, value)
        return value

    return jax.tree.map(kept, out)


def refuse_outside(outputs: Iterable[Parameter], out: Any, card: str) -> None:
    """Raise where a result of concrete numbers, solved to within ``SOLVED``, lies outside the bounds of its
    own kind.
    """
    if not isinstance(out, (tuple, float, np.ndarray, jax.Array)):
        return
    for p, value in figures(outputs, out):
        array = np.asarray(value, dtype=float)
        found = array[np.isfinite(array)]
        slack = SOLVED * np.max(np.abs(found), initial=0.0)
        low, high = limits(p)
        beyond = found[(found < low - slack) | (found > high + slack)]
        if beyond.size:
            assert p.kind is not None
            record = flags.Record(
                np.asarray(True),
                beyond[0],
                flags.OUTSIDE_DOMAIN,
                p.name,
                card,
                p.kind.lower,
                p.kind.upper,
                "",
                CONTRADICTION,
            )
            raise ApplicabilityError(describe([record])[0]["message"], name=p.name)


def judged(outputs: Iterable[Parameter], out: Any, card: str, source: str) -> Any:
    """What a law called on concrete numbers gives: one outside the bounds of its kind raises, elements of an
    array become NaN.
    """
    outputs = tuple(outputs)
    if all(np.all(kept_inside(p, value)) for p, value in figures(outputs, out)):
        return out
    with flags.collect(flags.OUTSIDE_DOMAIN) as records:
        record_outside(outputs, out, card, source, 0)
    told = describe(records)
    if told and all(np.ndim(value) == 0 for _p, value in figures(outputs, out)):
        raise ApplicabilityError(told[0]["message"])
    return without_impossible(outputs, out, records, False)


def kept_inside(parameter: Parameter, value: Any) -> np.ndarray:
    """Which elements of a computed value are finite and inside its bounds, or no number at all."""
    low, high = limits(parameter)
    array = np.asarray(value, dtype=float)
    return np.isnan(array) | np.isfinite(array) & (array >= low) & (array <= high)
