"""Worked examples of textbooks through the public surface: inputs as text in the book's units."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from granum.core import registry
from granum.filtration.lab_tests.leaf_test import LeafTest

TABLE = Path(__file__).parent.parent / "references" / "worked_examples_opened2026.csv"
ROWS: dict[str, list[dict[str, str]]] = {}
with TABLE.open(encoding="utf-8") as file:
    for row in csv.DictReader(file):
        ROWS.setdefault(row["card"].split(".")[0], []).append(row)


@pytest.mark.parametrize("domain", ROWS)
def test_worked_examples(domain: str) -> None:
    wrong = []
    for row in ROWS[domain]:
        found = registry.find(row["card"])(**dict(item.split("=", 1) for item in row["inputs"].split("; ")))
        value = getattr(found, row["output"]) if row["output"] else found
        expected, tolerance = float(row["expected [SI]"]), float(row["relative tolerance"])
        if not abs(float(value) / expected - 1.0) <= tolerance:
            wrong.append(f"{row['source']}: {row['card']} {value}, not {expected}")
    assert not wrong, "\n".join(wrong)


def test_mccabes_leaf_tests() -> None:
    # McCabe, Smith and Harriott, example 30.2: 440 cm², 23.5 g/L; slopes and intercepts read from a chart
    # there
    runs = (
        (965.0, [17.3, 41.3, 72, 108.3, 152.1, 201.7], 1.121e11, 6.49e10),
        (7070.0, [4.4, 9.5, 16.3, 24.6, 34.7, 46.1, 59, 73.6, 89.4, 107.3], 1.887e11, 1.07e11),
    )
    for pressure, times, resistance, medium in runs:
        test = LeafTest(
            np.array(times),
            5e-4 * np.arange(1, len(times) + 1),
            area="440 cm^2",
            pressure_drop=f"{pressure} lbf/ft^2",
            dynamic_viscosity="5.95e-4 lb/ft/s",
            dry_cake_per_filtrate="23.5 g/L",
        )
        found = test.fit().values
        assert found["cake_resistance"] == pytest.approx(resistance, rel=0.01)
        assert found["medium_resistance"] == pytest.approx(medium, rel=0.02)
