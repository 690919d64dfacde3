"""Polymorphs from their melting data, and the anion of a weak acid: published figures and closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from granum import materials
from granum.crystallization.formulas.polymorphs import (
    supersaturation_ratio_polymorphs,
    temperature_transition_polymorphs,
)
from granum.materials.formulas.precipitation import deprotonated_fraction

CARBAMAZEPINE = (26.4e3, 462.15, 29.3e3, 447.15)  # forms I and III, Behme and Brooke (1991)


def test_carbamazepine_changes_form_where_its_solubilities_say():
    """73 °C by solubility, 71 °C by fusion in the paper; form I is the more soluble one at room
    temperature.
    """
    T = temperature_transition_polymorphs(*CARBAMAZEPINE)
    assert pytest.approx(72.0, abs=2.0) == T - 273.15
    assert supersaturation_ratio_polymorphs(*CARBAMAZEPINE, temperature=T) == pytest.approx(1.0, abs=1e-9)
    assert 1.1 < supersaturation_ratio_polymorphs(*CARBAMAZEPINE, temperature=299.15) < 1.3
    assert supersaturation_ratio_polymorphs(*CARBAMAZEPINE, temperature=370.0) < 1.0


def test_two_drugs_have_both_forms():
    """Form II in ethanol by Zhong (2017) as read in BigSolDB 2.0; heats and temperatures of transition of
    Legendre (2007) and Pinto (2006).
    """
    printed = {
        # temperatures, mole fractions and their scatter
        "theophylline": (
            [288.01, 297.95, 308.01, 318.11, 328.09],
            [0.0008, 0.00116, 0.00173, 0.002541, 0.003192],
            0.06,
        ),
        "caffeine": (
            [288.01, 298.11, 308.09, 318.11, 328.15],
            [0.00078, 0.00132, 0.00204, 0.00322, 0.00469],
            0.02,
        ),
    }
    # 414 K from memory, not opened
    transitions = {"theophylline": (1990.0, 90.0, 536.8, 2.2), "caffeine": (2040.0, 250.0, 414.0, 2.0)}
    for drug, (T, x, scatter) in printed.items():
        two, one = (materials.solute(f"{drug}{form} in ethanol").branches[0] for form in ("", " I"))
        np.testing.assert_allclose(two.law.value(np.array(T)), x, rtol=scatter)
        heat, heat_error, crossing, error = transitions[drug]
        ratio = [
            float(np.log(one.law.value(t) / two.law.value(t)))
            for t in (crossing - error, 298.1, 298.2, crossing + error)
        ]
        assert ratio[0] > 0 > ratio[-1]  # equally soluble at the transition, form I more soluble below it
        assert (ratio[1] - ratio[2]) / (1 / 298.1 - 1 / 298.2) * 8.314462618 == pytest.approx(
            heat, abs=heat_error
        )
        assert 1.2 < np.exp(ratio[1]) < 1.6


def test_anion_of_a_weak_acid():
    """One step: Henderson and Hasselbalch; carbonate at pH 8.3 (6.35, 10.33): 0.9 %, from the textbook's
    distribution diagram.
    """
    assert float(deprotonated_fraction(5.0, [4.76])) == pytest.approx(1 / (1 + 10 ** (4.76 - 5.0)))
    assert float(deprotonated_fraction(8.3, [6.35, 10.33])) == pytest.approx(
        10**-10.33 / (10**-8.3 + 10**-10.33 + 10 ** (-16.6 + 6.35)), rel=1e-9
    )
    shares = np.asarray(deprotonated_fraction(np.array([2.0, 7.0, 12.0]), [2.15, 7.20, 12.35]))
    assert np.all(np.diff(shares) > 0)
    assert float(deprotonated_fraction(20.0, [2.15, 7.20, 12.35])) == pytest.approx(1.0, abs=1e-6)
