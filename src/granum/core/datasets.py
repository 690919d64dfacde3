"""The tables that come with the package: ``granum/<domain>/data/<name>.csv``, each with a sidecar that says
where its numbers come from.
"""

from __future__ import annotations

import csv
from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np

from granum.core.unit_names import in_base_units
from granum.core.unit_table import BASE, rows


@cache
def dataset(domain: str, name: str) -> tuple[dict[str, Any], ...]:
    """The rows of a table by the words of its header.

    A column whose header names a unit, ``aperture [mm]``, holds numbers, which are given in SI (``[SI]``: in
    that of each row's own quantity), NaN where the cell is empty; every other column holds text.

    >>> dataset("particles", "sieves_iso565")[0]
    {'series': 'iso565_r20', 'designation': '125', 'aperture': 0.125}
    """
    text = (files("granum") / domain / "data" / f"{name}.csv").read_text(encoding="utf-8")
    return tuple(
        dict(_read(head, cell) for head, cell in row.items()) for row in csv.DictReader(text.splitlines())
    )


def columns(domain: str, name: str) -> dict[str, np.ndarray]:
    """The columns of a table, in SI."""
    table = dataset(domain, name)
    return {word: np.array([row[word] for row in table]) for word in table[0]}


def _read(head: str, cell: str) -> tuple[str, Any]:
    word, _dot, unit = head.removesuffix("]").partition(" [")
    if not unit:
        return word, cell
    number = float(cell or "nan")
    if unit == BASE:
        return word, number
    row = rows().get((unit, BASE))
    factor, offset = (row.factor, row.offset) if row is not None else in_base_units(unit)
    return word, factor * number + offset
