"""The tables behind the cost formulas, read once."""

from __future__ import annotations

import csv
from functools import cache
from importlib.resources import files
from typing import NamedTuple

import numpy as np


class Correlation(NamedTuple):
    """Coefficients of a purchase correlation, its limits (SI) and the installed over the purchased cost (NaN: not tabulated)."""

    measure: str
    k1: float
    k2: float
    k3: float
    smallest: float
    largest: float
    bare_module_factor: float


@cache
def correlations() -> dict[str, Correlation]:
    """Purchase correlations by equipment."""
    text = (files("granum.costs") / "data" / "purchase_turton2018.csv").read_text(encoding="utf-8")
    found = {}
    for row in list(csv.reader(text.splitlines()))[1:]:
        found[row[0]] = Correlation(row[1], *(float(cell) if cell else np.nan for cell in row[2:]))
    return found


@cache
def plant_cost_index() -> tuple[np.ndarray, np.ndarray]:
    """Years and annual averages of the plant cost index."""
    text = (files("granum.costs") / "data" / "cepci_chemicalengineering.csv").read_text(encoding="utf-8")
    rows = np.array([[float(cell) for cell in row] for row in list(csv.reader(text.splitlines()))[1:]])
    return rows[:, 0], rows[:, 1]
