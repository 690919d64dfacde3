"""Humidity over saturated solutions, at which crystals begin to draw water: both the solubility and the
activity of water must be right for it.
"""

import math

import numpy as np
import pytest

import granum as gr
from granum.core.flags import collect

# Wexler, Constant humidity solutions, CRC Handbook of Chemistry and Physics, sec. 15, p. 33 (opened at
# zanotowane.pl/1007/6826): relative humidity in percent is A exp(B/T), "generally accurate to 2 %".
TABLE = {  # °C, °C, A, B
    "sodium hydroxide": (15, 60, 5.48, 27),
    "calcium chloride": (15, 25, 0.11, 1653),
    "magnesium chloride": (5, 45, 29.26, 34),
    "sodium iodide": (5, 45, 3.62, 702),
    "sodium bromide": (0, 35, 20.49, 308),
    "ammonium nitrate": (10, 40, 3.54, 853),
    "potassium iodide": (5, 30, 29.35, 254),
    "sodium nitrate": (10, 40, 26.94, 302),
    "sodium chloride": (10, 40, 69.20, 25),
    "ammonium chloride": (10, 40, 35.67, 235),
    "potassium bromide": (5, 25, 40.98, 203),
    "ammonium sulfate": (10, 40, 62.06, 79),
    "potassium chloride": (5, 25, 49.38, 159),
    "strontium nitrate": (5, 25, 28.34, 328),
    "barium chloride": (5, 25, 69.99, 75),
    "cesium iodide": (5, 25, 70.77, 75),
    "potassium nitrate": (0, 50, 43.22, 225),
    "potassium sulfate": (10, 50, 86.75, 34),
}
STRONGER = {"sodium iodide", "ammonium nitrate"}  # than any solution behind the equation


@pytest.mark.parametrize("name", TABLE)
def test_the_humidity_of_the_table_or_a_flag(name):
    low, high, A, B = TABLE[name]
    system = gr.materials.solute(name)
    for celsius in np.linspace(low, high, 4):
        T = 273.15 + float(celsius)
        with collect() as records:
            found = float(system.solvent_activity(T, system.solubility(T)))
        told = any(np.any(np.asarray(record.mask)) for record in records)
        expected = 0.01 * A * math.exp(B / T)
        assert told or found == pytest.approx(expected, abs=0.03), celsius
        assert told or name not in STRONGER, celsius


def test_most_of_the_table_is_met_within_two_percent():
    """What the table itself claims, in the middle of its range, but for calcium chloride, whose line there
    is far steeper than that of Greenspan's compilation (32 % at 20 °C, recalled), and for caustic soda, 5.6
    where the table has 6.0 % of humidity.
    """
    off = {}
    for name, (low, high, A, B) in TABLE.items():
        system, T = gr.materials.solute(name), 273.15 + 0.5 * (low + high)
        expected = 0.01 * A * math.exp(B / T)
        off[name] = abs(float(system.solvent_activity(T, system.solubility(T))) / expected - 1.0)
    worse = {name for name, share in off.items() if share > 0.02}
    assert worse <= STRONGER | {"calcium chloride", "magnesium chloride", "sodium hydroxide"}
