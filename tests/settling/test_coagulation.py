"""Coagulant dose: a printed jar test, how often the intervals hold the truth, what a wrong dose costs."""

from __future__ import annotations

import numpy as np
import pytest
from tests.settling.test_flocculation import turbid

from granum.core.errors import InputError
from granum.settling.equipment.flocculator import Flocculator
from granum.settling.formulas.coagulation import (
    capture_efficiency_dose,
    residual_turbidity_neutralization,
    residual_turbidity_parabola,
)
from granum.settling.lab_tests.jar_test import SHAPES, JarTest

# Davis 2010, p. 6-18 and 6-19: second jar test at pH 6, raw water of 15 NTU, best dose "about 12.5 mg/L"
DOSES = np.array([5.0, 7.0, 10.0, 12.0, 15.0, 20.0]) * 1e-3
LEFT = np.array([14.0, 9.5, 5.0, 4.5, 6.0, 13.0])
RAW, LEAST, BEST, WIDTH = 60.0, 2.0, 25e-3, 12e-3


@pytest.mark.parametrize("law", sorted(SHAPES))
def test_the_printed_jar_test_has_its_best_dose(law):
    found = JarTest(DOSES, LEFT, 15.0, dose_response=law).fit()
    low, high = found["dose_optimum"].interval_95
    assert low < 12.5e-3 < high
    assert found["dose_optimum"].value == pytest.approx(12.5e-3, rel=0.03)


def test_both_laws_share_their_three_figures():
    for law in (residual_turbidity_neutralization, residual_turbidity_parabola):
        assert law(BEST, RAW, LEAST, BEST, WIDTH) == pytest.approx(LEAST)
        for dose in (BEST - WIDTH, BEST + WIDTH):
            assert law(dose, RAW, LEAST, BEST, WIDTH) == pytest.approx(0.5 * (RAW + LEAST))
    # no charge left at the best dose; as much of the other sign at twice the dose as without any
    assert capture_efficiency_dose(BEST, BEST, 7.0) == 1.0
    assert capture_efficiency_dose(2 * BEST, BEST, 7.0) == pytest.approx(
        float(capture_efficiency_dose(0.0, BEST, 7.0))
    )
    # far too much coagulant: raw water
    assert residual_turbidity_neutralization(4 * BEST, RAW, LEAST, BEST, WIDTH) == pytest.approx(
        RAW, rel=1e-3
    )


@pytest.mark.long
@pytest.mark.parametrize("law", sorted(SHAPES))
def test_intervals_hold_the_truth_as_often_as_they_say(law):
    """Of 200 repetitions with known scatter, 93 to 97 in a hundred hold the true best dose."""
    doses = np.linspace(5e-3, 45e-3, 12)
    exact = np.asarray(SHAPES[law](doses, RAW, LEAST, BEST, WIDTH))
    rng = np.random.default_rng(11)
    inside = {"dose_optimum": 0, "dose_half_width": 0}
    for _repetition in range(200):
        left = np.abs(exact + rng.normal(0.0, 1.0, doses.size))
        found = JarTest(doses, left, RAW, dose_response=law).fit()
        for name, truth in (("dose_optimum", BEST), ("dose_half_width", WIDTH)):
            low, high = found[name].interval_95
            inside[name] += low < truth < high
    for count in inside.values():
        assert 0.93 <= count / 200 <= 0.97


def test_the_lowest_dose_that_suffices():
    exact = np.asarray(SHAPES["neutralization"](DOSES * 2.4, RAW, LEAST, BEST, WIDTH))
    found = JarTest(DOSES * 2.4, exact, RAW, 6.0).fit()
    least = found["dose_least"].value
    assert least < BEST
    assert residual_turbidity_neutralization(least, RAW, LEAST, BEST, WIDTH) == pytest.approx(6.0, rel=1e-5)
    assert found["dose_restabilized"].value == pytest.approx(BEST + WIDTH, rel=1e-5)
    with pytest.raises(InputError, match="No dose reaches 1 NTU"):
        JarTest(DOSES * 2.4, exact, RAW, 1.0).fit()
    with pytest.raises(InputError, match="no coagulant is needed"):
        JarTest(DOSES * 2.4, exact, RAW, 70.0)
    with pytest.raises(InputError, match="No jar is clearer"):
        JarTest(DOSES, LEFT, 4.0).fit()
    with pytest.raises(InputError, match="at least four different doses"):
        JarTest([0.01, 0.01, 0.02, 0.02, 0.03], [5.0, 5.1, 2.0, 2.1, 3.0], 15.0).fit()


def test_jars_on_one_side_say_so():
    doses = np.linspace(4e-3, 16e-3, 7)
    short = np.asarray(SHAPES["neutralization"](doses, RAW, LEAST, BEST, WIDTH))
    said = " ".join(flag["message"] for flag in JarTest(doses, short, RAW).fit().flags)
    assert "lies outside the doses tested (4 to 16 mg/L)" in said
    doses = np.linspace(10e-3, 32e-3, 7)
    short = np.asarray(SHAPES["neutralization"](doses, RAW, LEAST, BEST, WIDTH))
    said = " ".join(flag["message"] for flag in JarTest(doses, short, RAW).fit().flags)
    assert "is extrapolated" in said


def test_a_wrong_dose_makes_smaller_flocs():
    def flocs(**given):
        return Flocculator(volume=90.0, velocity_gradient=40.0, aggregation_constant=3e-4, **given).operate(
            feed=turbid()
        )

    plain = flocs()
    jar = {"dose_optimum": 25e-3, "charge_sharpness": 7.0}
    best, little, much = (flocs(coagulant_dose=d, **jar) for d in (25e-3, 10e-3, 40e-3))
    assert float(best.figures.flocculation_ratio) == float(plain.figures.flocculation_ratio)
    assert float(little.figures.flocculation_ratio) < 0.5 * float(best.figures.flocculation_ratio)
    assert float(much.figures.flocculation_ratio) == pytest.approx(float(little.figures.flocculation_ratio))
    # 25 g in each cubic meter that flows through
    flow = float(turbid().slurry_volume_flow)
    assert float(best.uses["consumption_coagulant"]) == pytest.approx(25e-3 * flow)
    with pytest.raises(InputError, match="needs both"):
        Flocculator(volume=90.0, velocity_gradient=40.0, dose_optimum=25e-3)
