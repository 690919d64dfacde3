"""Conversions that are asked for all the time, written down: Pint takes longer to get ready than a formula
to run.

They stand in ``granum/core/unit_table.csv``, which ``python -m granum.core.stubs`` writes from Pint and a
test compares. A unit that is not there is read by Pint.
"""

from __future__ import annotations

import csv
import io
from functools import cache
from importlib.resources import files
from typing import NamedTuple

BASE = "SI"
"""In place of the SI unit of a kind: that of the unit's own quantity."""


class Row(NamedTuple):
    """``SI = factor·value + offset`` for a unit as written and an SI unit of a kind, or ``BASE``; whether it
    counts angles.
    """

    factor: float
    offset: float
    angles: bool


@cache
def rows() -> dict[tuple[str, str], Row]:
    """All rows by unit and SI unit.

    >>> rows()["µm", "m"].factor
    1e-06
    """
    text = (files("granum") / "core" / "unit_table.csv").read_text(encoding="utf-8")
    return {
        (unit, si): Row(float(factor), float(offset), angles == "1")
        for unit, si, factor, offset, angles in csv.reader(io.StringIO(text))
    }


@cache
def counts_angles(unit: str) -> bool | None:
    """Whether a unit counts angles or turns by name; None where the table does not know it."""
    return next((row.angles for (written, _si), row in rows().items() if written == unit), None)
