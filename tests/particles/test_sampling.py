"""Mixing index and sampling error against numbers printed by others."""

import numpy as np
import pytest

from granum.core.errors import ApplicabilityError
from granum.particles import (
    composition_deviation_random,
    mixing_index_lacey,
    sample_mass_gy,
    sampling_error_gy,
)

GALENA = {
    "liberation_size": "150 um",
    "mineral_fraction": 0.05 / 0.866,
    "mineral_density": "7.5 g/cm3",
    "gangue_density": "2.65 g/cm3",
}


def test_meat_and_fat_by_the_book():
    # Earle and Earle, chapter 12, problems 1 and 2 (opened): 5 g samples of 0.1 g particles, 15 % fat;
    # s² = 0.68e-2, s_r² = 0.256e-2 and an index of 0.966
    share = {"component_fraction": "15 %", "particles_per_sample": 50}
    assert composition_deviation_random(**share) ** 2 == pytest.approx(0.256e-2, rel=0.01)
    found = mixing_index_lacey(composition_deviation=np.sqrt(0.68e-2), **share)
    assert found == pytest.approx(0.966, abs=6e-4)


def test_ends_of_the_mixing_index():
    apart = mixing_index_lacey(np.sqrt(0.3 * 0.7), 0.3, 400.0)
    best = mixing_index_lacey(composition_deviation_random(0.3, 400.0), 0.3, 400.0)
    assert (apart, best) == (pytest.approx(0.0, abs=1e-12), pytest.approx(1.0))


@pytest.mark.parametrize(
    ("top_size", "printed"), [("2.5 cm", 1369.632), ("0.5 cm", 24.501), ("0.1 cm", 0.438), ("40 um", 0.00007)]
)
def test_lead_ore_by_the_sheet_of_the_book(top_size, printed):
    # JKTech's sheet to Wills' book (opened): 5 % Pb to 2 % of its value at 95 %, four stages that share the
    # variance, twice the mass of the formula; kg
    found = sample_mass_gy(sampling_error=0.02 / 1.96 / 2.0, passing_size_95=top_size, **GALENA)
    assert 2.0 * found == pytest.approx(printed, rel=2e-3 if printed > 0.01 else 0.05)


def test_mass_and_error_are_one_formula():
    ore = {"passing_size_95": "25 mm", "lot_mass": "1 t", **GALENA}
    mass = sample_mass_gy(sampling_error=0.01, **ore)
    assert mass < 178.0  # out of a small lot less is needed
    assert sampling_error_gy(sample_mass=mass, **ore) == pytest.approx(0.01, rel=1e-12)
    with pytest.raises(ApplicabilityError, match="smaller than its lot"):
        sampling_error_gy(sample_mass="2 t", **ore)
