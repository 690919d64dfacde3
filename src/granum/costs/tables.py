"""The tables behind the cost formulas, read once."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np

from granum.core.datasets import columns, dataset


class Correlation(NamedTuple):
    """Coefficients of a purchase correlation, its limits (SI) and the installed over the purchased cost (NaN:
    not tabulated).
    """

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
    return {
        row["equipment"]: Correlation(*list(row.values())[1:])
        for row in dataset("costs", "purchase_turton2018")
    }


class Emission(NamedTuple):
    """Greenhouse gas per energy of a carrier itself, kg/J, and the electricity that goes with it, J/J."""

    factor: float
    electricity: float
    year: int
    source: str


@cache
def emissions() -> dict[str, Emission]:
    """Emission factors by carrier."""
    return {
        str(row["carrier"]): Emission(
            float(np.nan_to_num(row["emission_factor"])),
            float(np.nan_to_num(row["electricity"])),
            int(row["year"]),
            str(row["source"]),
        )
        for row in dataset("costs", "emissions_epa2022")
    }


def plant_cost_index() -> tuple[np.ndarray, np.ndarray]:
    """Years and annual averages of the plant cost index."""
    found = columns("costs", "cepci_chemicalengineering")
    return found["year"], found["cost_index"]
