"""The examples of crystallization, run as a user would, against numbers that do not come from this
package.
"""

from __future__ import annotations

import numpy as np
import pytest
from tests.sharing.crystallization import by_scipy
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.cases.studying import read_studies
from granum.crystallization.recipes import optimal_cooling

BATCH = EXAMPLES / "seeded-crystallizer" / "batch.toml"


def test_seeded_batch_as_a_line():
    """Size and crop of the moment equations by LSODA, for 100 kg/h of water."""
    exact, ratio = by_scipy()
    run = gr.read(BATCH).solve()
    assert run.audit["mass_closure"] < 1e-12
    size = run.figure("crystallizer.mean_diameter_mass")
    assert size == pytest.approx(exact[4] / exact[3], rel=1e-3)  # the library's crystal is 0.2 % lighter
    grown = float(run.streams["suspension"].solid_flow) * 3600 / 100
    assert grown == pytest.approx(0.4929904 - ratio, rel=1e-3)


@pytest.mark.long
def test_study_and_recipe_find_the_same_profile():
    """Two optimizers, one engine: the least share of nuclei with five intervals."""
    found = read_studies(EXAMPLES / "cooling-profile" / "study.toml")["profile"].run().as_json()
    unit = gr.read(BATCH).sheet.units["crystallizer"]
    best = optimal_cooling(
        solute_per_solvent=0.4929904,
        solubility=unit.solubility,
        growth=unit.growth,
        nucleation=unit.nucleation,
        temperature_start=305.15,
        temperature_end=301.15,
        duration=4800.0,
        crystal_density=2105.0,
        seed_mass_per_solvent=5e-4,
        seed_size=1e-4,
        seed_width=2e-5,
        intervals=5,
        steps=300,
    )
    least = found["findings"]["objective"]["value"]
    assert least == pytest.approx(best.nuclei_mass_fraction, rel=2e-3)
    assert np.all(np.diff(best.temperature) <= 1e-9)


@pytest.mark.parametrize("case", ["vacuum", "jacketed"])
def test_driven_batches_end_at_the_printed_solubility(case):
    """CRC: 27.7 % at 25 °C, 31.3 % at 30 °C and 38.6 % at 40 °C; between these by logarithms of the ratio."""
    run = gr.read(EXAMPLES / "seeded-crystallizer" / f"{case}.toml").solve()
    assert run.audit["mass_closure"] < 1e-12
    end = run.streams["suspension"]
    water, salt = (float(v) for v in end.liquid)
    printed = np.log(np.array([27.7, 31.3, 38.6]) / (100.0 - np.array([27.7, 31.3, 38.6])))
    saturated = np.exp(np.interp(float(end.temperature) - 273.15, [25.0, 30.0, 40.0], printed))
    assert salt / water == pytest.approx(saturated, rel=0.015)
    failed = [c.name for c in run.units["crystallizer"].checks if not c.ok]
    assert failed == (["undercooling at the cooled wall"] if case == "jacketed" else [])
