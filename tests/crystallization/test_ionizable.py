"""Weak acids and bases against pH: printed values, closed forms and another formula of the package."""

from __future__ import annotations

import jax
import numpy as np
import pytest

from granum.crystallization.charts_ionizable import ph_solubility_chart
from granum.crystallization.formulas.ionizable import (
    SolubilityAtPh,
    ph_limit_salt,
    solubility_ampholyte,
    solubility_weak_acid,
    solubility_weak_base,
)
from granum.crystallization.formulas.solubility_laws import PolynomialSolubility
from granum.materials.formulas.precipitation import deprotonated_fraction


def test_phenobarbital_of_a_worked_example():
    """0.005 mol/L, exponent 7.4: 0.00625 mol/L at pH 6.8, the example rounding 10**-0.6 to 0.25."""
    assert solubility_weak_acid(6.8, 7.4, 5.0).solubility_total == pytest.approx(6.25, rel=2e-3)


@pytest.mark.parametrize(("pH", "unionized"), [(5.0, 0.0307), (7.0, 0.00032)])
def test_acetylsalicylic_acid_is_ionized_as_printed(pH, unionized):
    """Exponent 3.5; 3.07 % un-ionized at pH 5 and 0.032 % at pH 7."""
    found = solubility_weak_acid(pH, 3.5, 20.0)
    assert 1.0 - found.ionized_fraction == pytest.approx(unionized, rel=2e-2)
    assert found.ionized_fraction == pytest.approx(float(deprotonated_fraction(pH, np.array([3.5]))))


def slope(function, pH):
    return float(jax.grad(lambda p: jax.numpy.log10(function(p).solubility_total))(pH))


def test_the_slopes_of_indomethacin_and_miconazole():
    """Flat, half a decade per unit at the exponent, then one; a base is the mirror image (Avdeef, § 6.1)."""
    S0 = 1000.0 * 10.0**-5.58
    acid = [slope(lambda p: solubility_weak_acid(p, 4.42, S0), p) for p in (0.0, 4.42, 9.0)]
    assert acid == pytest.approx([0.0, 0.5, 1.0], abs=1e-4)
    S0 = 1000.0 * 10.0**-5.85
    base = [slope(lambda p: solubility_weak_base(p, 6.07, S0), p) for p in (1.0, 6.07, 11.0)]
    assert base == pytest.approx([-1.0, -0.5, 0.0], abs=1e-4)


def test_ciprofloxacin_dissolves_least_between_its_exponents():
    assert slope(lambda p: solubility_ampholyte(p, 8.62, 6.16, 0.19), 7.39) == pytest.approx(0.0, abs=1e-9)
    alone = solubility_weak_acid(10.0, 8.62, 0.19).solubility_total
    assert solubility_ampholyte(10.0, 8.62, -10.0, 0.19).solubility_total == pytest.approx(alone, rel=1e-9)


@pytest.mark.parametrize(("group", "sign"), [("acid", 1.0), ("base", -1.0)])
def test_the_curves_of_acid_and_salt_cross_at_the_limit(group, sign):
    limit = ph_limit_salt(6.0, 0.02, 30.0, ionizable_group=group)
    ions = 10.0 ** (sign * (limit - 6.0))
    assert 0.02 * (1.0 + ions) == pytest.approx(30.0 * (1.0 + 1.0 / ions), rel=1e-12)
    drawn = ph_solubility_chart(6.0, 0.02, 30.0, ionizable_group=group).data
    highest = max(np.nanmax(np.asarray(line.y, dtype=float)) for line in drawn)
    assert highest == pytest.approx(30.02e-3, rel=1e-9)


def test_the_law_holds_for_acids_and_bases():
    plain = PolynomialSolubility(coefficients=np.array([2e-3, 5e-5]))
    acid = SolubilityAtPh(plain, 5.2, 4.2)
    base = SolubilityAtPh(plain, 5.2, 6.2, ionizable_group="base")
    assert acid(300.0) == pytest.approx(11.0 * float(plain(300.0)))
    assert base(300.0) == pytest.approx(11.0 * float(plain(300.0)))
