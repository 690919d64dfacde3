"""One pass through the units of a line: what a steady solution, a run in time, a specification, a study and a
note all read.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from granum.core import flags
from granum.core.errors import GranumError
from granum.core.i18n import _
from granum.core.notices import describe
from granum.flowsheet.plan import Block
from granum.flowsheet.sheet import Flowsheet
from granum.streams.stream import Stream
from granum.streams.units import Operated, Sheet


class Made(NamedTuple):
    """What a pass gives, by stream and by unit; only arrays and words that are part of its structure, so that
    loops may carry it.
    """

    streams: dict[str, Stream]
    powers: dict[str, dict[str, Any]]
    records: dict[str, list[flags.Record]]
    sheets: dict[str, Sheet]


@contextmanager
def named(unit: str) -> Iterator[None]:
    """Whatever a unit refuses inside the block is told with its name."""
    try:
        yield
    except GranumError as problem:
        if "unit" not in problem.details:
            problem.message = _("Unit '{unit}': {problem}").format(unit=unit, problem=problem.message)
            problem.args, problem.details["unit"] = (problem.message,), unit
        raise


def is_known(stream: Stream) -> Any:
    """Whether a stream carries numbers."""
    return jnp.isfinite(stream.mass_flow + stream.temperature)


def where(condition: Any, stream: Stream, instead: Stream) -> Stream:
    """One stream or the other."""
    return jax.tree.map(lambda here, spare: jnp.where(condition, here, spare), stream, instead)


def known_or(stream: Stream, instead: Stream) -> Stream:
    """A stream, or another where it carries no numbers."""
    return where(is_known(stream), stream, instead)


def pass_through(
    line: Flowsheet,
    block: Block,
    streams: Mapping[str, Stream],
    operate: Callable[[str, dict[str, Stream]], Operated] | None = None,
    instead: Stream | None = None,
) -> Made:
    """One pass through the units of a block. Torn streams are read as given and made anew; ``instead`` goes
    on where a stream has no numbers.

    ``operate``: by name and inlets, where a unit is not asked for all it has to tell, or holds matter.
    """
    known = dict(streams)
    made = Made({}, {}, {}, {})
    for unit in block.units:
        thing, inlets = line.units[unit], line.inlets_of(unit, known)
        with named(unit), flags.collect():
            found = thing.operate(**inlets) if operate is None else operate(unit, inlets)
        new = {
            k.name: getattr(found.outlets, k.origin.partition(".")[2])
            for k in line.links
            if k.source_unit == unit
        }
        made.streams.update(new)
        made.powers[unit] = {
            name: getattr(found.outlets, name) for name in thing.power_names() if hasattr(found.outlets, name)
        }
        made.records[unit] = found.records
        if found.figures is not None:
            made.sheets[unit] = Sheet(found.figures, found.checks, found.uses)
        known |= {
            name: s if instead is None else known_or(s, instead)
            for name, s in new.items()
            if name not in block.tears
        }
    return jax.tree.map(jnp.asarray, made)


def told(records: Mapping[str, list[flags.Record]]) -> list[dict[str, Any]]:
    """What was flagged in each unit, one row a message, with the unit's name."""
    return [{"unit": unit, **row} for unit, kept in records.items() for row in describe(kept)]
