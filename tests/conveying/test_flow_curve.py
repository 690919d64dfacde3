"""Flow curve of a viscometer: parameters found again, honest intervals, refusals."""

from __future__ import annotations

import numpy as np
import pytest

from granum.conveying.lab_tests.flow_curve import FlowCurveTest
from granum.core.errors import InputError

RATE = np.geomspace(5.0, 600.0, 12)
TRUE = {"consistency": 0.9, "flow_index": 0.55, "yield_stress": 7.0}


def stress(consistency, flow_index=1.0, yield_stress=0.0):
    return yield_stress + consistency * RATE**flow_index


@pytest.mark.parametrize(
    ("curve", "names"),
    [
        ("bingham", ("consistency", "yield_stress")),
        ("power_law", ("consistency", "flow_index")),
        ("herschel_bulkley", ("consistency", "flow_index", "yield_stress")),
    ],
)
def test_what_made_the_curve_is_found_again(curve, names):
    true = {name: TRUE[name] for name in names}
    found = FlowCurveTest(RATE, stress(**true), curve).fit()
    assert {name: found[name].value for name in names} == pytest.approx(true, rel=1e-5)


def test_consistency_at_another_shear_rate_is_the_viscosity_there():
    true = {"consistency": 0.9, "flow_index": 0.55}
    found = FlowCurveTest(RATE, stress(**true), "power_law", 100.0).fit()
    assert found["consistency"].value == pytest.approx(0.9 * 100.0 ** (0.55 - 1.0), rel=1e-5)
    assert found["flow_index"].value == pytest.approx(0.55, rel=1e-5)


@pytest.mark.parametrize("curve", [pytest.param("bingham", marks=pytest.mark.long), "power_law"])
def test_intervals_cover_the_truth_as_often_as_they_say(curve):
    names = {"bingham": ("consistency", "yield_stress"), "power_law": ("consistency", "flow_index")}[curve]
    true = {name: TRUE[name] for name in names}
    clean, rng, inside = stress(**true), np.random.default_rng(12), dict.fromkeys(names, 0)
    for _repetition in range(200):
        found = FlowCurveTest(RATE, clean + rng.normal(0.0, 0.5, RATE.size), curve).fit()
        for name in names:
            low, high = found[name].interval_95
            inside[name] += low <= true[name] <= high
    # 190 of 200 are due; three standard deviations of such a count are 9
    assert all(181 <= count <= 199 for count in inside.values()), inside


def test_what_cannot_be_told_is_refused():
    with pytest.raises(InputError, match="shear rates"):
        FlowCurveTest([10.0, 20.0, 40.0], [3.0, 4.0, 5.0], "herschel_bulkley").fit()
    with pytest.raises(InputError, match="shear_stress"):
        FlowCurveTest([10.0, 20.0, 40.0], [3.0, 0.0, 5.0]).fit()
