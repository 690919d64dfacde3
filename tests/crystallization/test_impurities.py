"""Impurities: pinned steps against their derivation and published coefficients; purity by hand."""

from __future__ import annotations

import jax
import numpy as np
import pytest

from granum.cases.alone import case_text
from granum.cases.reading import read_text
from granum.core.constants import BOLTZMANN
from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.impurities import (
    ImpededGrowth,
    growth_ratio_kubota_mullin,
    pinning_supersaturation,
    undercooling_growth_start,
)
from granum.crystallization.formulas.purity import purity_of_crystals

LEAD_ON_SALT = 9.35e5, 1.57e5, 9.93e5  # L/mol: by the onset of growth, its uncertainty, by adsorption


def test_the_factor_is_the_mean_of_a_straight_and_of_a_bent_step():
    """Derived anew: v = v0 (1 − r_c/r), r between half the distance of the pins and infinity."""
    step, unit, spacing, T, s = 1.1e-11, 1.7e-19, 1.9e-8, 305.0, 0.06
    critical = step * unit / (BOLTZMANN * T * s)
    mean = 0.5 * (1.0 + 1.0 - critical / (spacing / 2.0))
    out = growth_ratio_kubota_mullin(s, 1e6, 1e6, pinning_supersaturation(step, unit, spacing, T))
    assert out.growth_ratio_impure == pytest.approx(mean, rel=1e-9)


def test_lead_on_sodium_chloride_gives_its_coefficient_back():
    """The reciprocal plot of the onset of growth; both printed coefficients agree within the error given."""
    printed, uncertain, other = LEAD_ON_SALT
    c = np.geomspace(1e-7, 1e-5, 9)  # mol/L
    onset = np.array([undercooling_growth_start(1e3 * x, printed / 1e3, 0.02, 5e-4) for x in c])
    slope, intercept = np.polyfit(1.0 / c, 1.0 / onset, 1)
    assert intercept / slope == pytest.approx(printed, rel=1e-6)
    assert abs(intercept / slope - other) < uncertain


@pytest.mark.parametrize(("alpha", "at_full_cover"), [(0.4, 0.6), (1.0, 0.0), (3.0, 0.0)])
def test_three_kinds_of_impurity(alpha, at_full_cover):
    full = growth_ratio_kubota_mullin(0.05, 1e12, 1.0, alpha * 0.05)
    assert full.growth_ratio_impure == pytest.approx(at_full_cover, abs=1e-9)
    stops = growth_ratio_kubota_mullin(0.05, 0.5, 1.0, alpha * 0.05)  # a third is covered
    assert (stops.growth_ratio_impure == 0.0) == (alpha >= 3.0)


def test_the_law_slows_growth_and_leaves_dissolution_and_a_pure_solution_alone():
    pure = PowerLawGrowth(growth_coefficient=1e-5, growth_order=1.5)
    pinned = ImpededGrowth(pure, 0.001, 935.0, 0.02)
    clean = ImpededGrowth(pure, 0.0, 935.0, 0.02)
    start = growth_ratio_kubota_mullin(0.05, 0.001, 935.0, 0.02).supersaturation_growth_start
    for s in (-0.1, 0.0, 0.005, 0.02, 0.1):
        C = 0.3 * (1.0 + s)
        assert clean(C, 0.3, 300.0) == pytest.approx(float(pure(C, 0.3, 300.0)), rel=1e-12)
        expected = pure(C, 0.3, 300.0) * (1.0 - start / s if s > start else float(s <= 0.0))
        assert pinned(C, 0.3, 300.0) == pytest.approx(float(expected), rel=1e-9, abs=1e-30)
        assert np.isfinite(jax.grad(lambda c: pinned(c, 0.3, 300.0))(C))


def test_a_continuous_crystallizer_needs_more_supersaturation_for_the_same_crystals():
    pure, impure = crystallized({}), crystallized({"growth": IMPURE})
    assert impure.relative_supersaturation > pure.relative_supersaturation
    assert impure.crystal_flow < pure.crystal_flow


IMPURE = {
    "law": "impeded_growth",
    "growth": {"law": "power_law_growth", "growth_coefficient": 1.161e-4, "growth_order": 1.32},
    "impurity_concentration": "1 umol/L",
    "adsorption_coefficient": "9.35e5 L/mol",
    "pinning_supersaturation": 0.004,
}


def crystallized(given):
    run = read_text(case_text("crystallization.msmpr", given)).solve()
    assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9
    return run.units["msmpr"].values


def test_purity_by_hand():
    """Lattice 0.05 × 0.02/0.4; inclusions of 1 % at 1200 and 2000 kg/m³; 0.1 kg of liquor, of which a wash
    leaves a fifth.
    """
    out = purity_of_crystals(0.02, 0.4, 0.05, 0.01, 0.1, 0.8, 2000.0, 1200.0)
    included, left = 0.01 * 1200.0 / (0.99 * 2000.0), 0.02
    product = 1.0 + 0.0025 + included + left * 0.42
    assert out.impurity_lattice == pytest.approx(0.0025 / product)
    assert out.impurity_inclusions == pytest.approx(included * 0.02 / product)
    assert out.impurity_adhering == pytest.approx(left * 0.02 / product)
    solute = 1.0 + (included + left) * 0.4
    impurity = 0.0025 + (included + left) * 0.02
    assert out.impurity_fraction_product == pytest.approx(impurity / product)
    assert out.purification_factor == pytest.approx((0.02 / 0.4) / (impurity / solute), rel=1e-9)


def test_washing_takes_off_only_what_adheres():
    washed = purity_of_crystals(0.02, 0.4, 0.05, 0.01, 0.1, 1.0, 2000.0, 1200.0)
    dirty = purity_of_crystals(0.02, 0.4, 0.05, 0.01, 0.1, 0.0, 2000.0, 1200.0)
    assert washed.impurity_adhering == 0.0 < washed.impurity_lattice
    assert washed.impurity_fraction_product < dirty.impurity_fraction_product
    nothing = purity_of_crystals(0.02, 0.4, 0.0, 0.0, 0.0, 0.0, 2000.0, 1200.0)
    assert nothing.impurity_fraction_product == 0.0
