"""Capillary suction time, fouling indices and the filterability number: hand numbers, independent
integrations, and how often the intervals hold the truth.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import scipy
from tests.sharing.places import EXAMPLES

from granum.core.errors import ApplicabilityError, InputError
from granum.filtration.formulas.fouling_index import (
    filterability_number,
    modified_fouling_index,
    silt_density_index,
    silt_density_index_cake,
)
from granum.filtration.formulas.suction import (
    capillary_suction_time,
    filterability_constant,
    suction_constant_calibration,
)
from granum.filtration.lab_tests.capillary_suction import CapillarySuctionTest
from granum.filtration.lab_tests.leaf_test import FoulingIndexTest, LeafTest
from granum.filtration.lab_tests.starts import bad_start

PER_MINUTE = 6000.0  # of percent


def test_suction_between_the_rings_by_integration():
    """Darcy's law through a growing cake, integrated from ring to ring, against the constant of geometry."""
    opening, suction, eta, C, alpha = 2.5e-4, 9e3, 1e-3, 15.0, 4e12
    inner, outer = 4e-8, 9e-8  # m³ drawn when the spot reaches the rings
    time, _error = scipy.integrate.quad(
        lambda V: eta * alpha * C * V / (suction * opening**2), inner, outer, epsabs=0.0
    )
    constant = (outer**2 - inner**2) / (2.0 * opening**2 * suction)
    assert capillary_suction_time(alpha, C, eta, constant) == pytest.approx(time, rel=1e-9)
    whole = capillary_suction_time(alpha, C, eta, constant, 7.0)
    assert suction_constant_calibration(whole, 7.0, C, eta, alpha) == pytest.approx(constant)


def test_filterability_constant_frees_a_sludge_of_viscosity_and_solids():
    K, alpha = 5e-10, 3e13
    for eta, C in ((1e-3, 10.0), (1.4e-3, 30.0)):
        t = capillary_suction_time(alpha, C, eta, K)
        assert filterability_constant(t, C, eta) == pytest.approx(1.0 / (K * alpha))


SUCTION = {"liquid": 8.0, "per": 2.4}
STRENGTHS = np.repeat([0.0, 5.0, 10.0, 20.0], 3)


def suction_readings(rng, scatter=0.06):
    exact = SUCTION["liquid"] + SUCTION["per"] * STRENGTHS
    return exact * (1.0 + scatter * rng.standard_normal(exact.size))


@pytest.mark.long
def test_suction_intervals_hold_the_truth_as_often_as_they_say():
    """Of 200 repetitions with 6 % of scatter, 93 to 97 in a hundred hold the truth."""
    rng = np.random.default_rng(1)
    truth = {
        "suction_time_normalized": SUCTION["per"],
        "suction_time_liquid": SUCTION["liquid"],
        "capillary_suction_time": SUCTION["liquid"] + SUCTION["per"] * 35.0 / 3.0,
    }
    inside = dict.fromkeys(truth, 0)
    for _repetition in range(200):
        found = CapillarySuctionTest(suction_readings(rng), STRENGTHS).fit()
        for name, true in truth.items():
            low, high = found[name].interval_95
            inside[name] += low < true < high
    for count in inside.values():
        assert 0.93 <= count / 200 <= 0.97, inside


def test_suction_time_exact_and_with_a_known_liquid():
    exact = SUCTION["liquid"] + SUCTION["per"] * STRENGTHS
    found = CapillarySuctionTest(exact, STRENGTHS, suction_constant=5e-10).fit()
    assert found.values == pytest.approx(
        {"suction_time_normalized": 2.4, "suction_time_liquid": 8.0}, rel=1e-8
    )
    # by hand: 2.4 / (5e-10 · 1e-3) m/kg; mean of the sludges 11.667 g/L and 36 s
    assert found["cake_resistance"].value == pytest.approx(4.8e12)
    assert found["capillary_suction_time"].value == pytest.approx(36.0)
    assert found["filterability_constant"].value == pytest.approx(1e-3 * 35.0 / 3.0 / 36.0)
    one = CapillarySuctionTest([31.5, 32.5, 32.0], [10.0] * 3, suction_time_liquid=8.0).fit()
    middle = (31.5 * 32.5 * 32.0) ** (1 / 3)  # scatter in proportion to the time: the geometric mean
    assert one["suction_time_normalized"].value == pytest.approx((middle - 8.0) / 10.0, rel=1e-8)
    assert "suction_time_liquid" not in one.values


def test_suction_messages():
    with pytest.raises(InputError, match="All readings have one concentration"):
        CapillarySuctionTest([31.5, 32.5, 32.0], [10.0] * 3).fit()
    with pytest.raises(InputError, match="No reading has solids"):
        CapillarySuctionTest([8.0, 8.1, 8.2], [0.0] * 3).fit()
    with pytest.raises(InputError, match="does not grow with the solids"):
        CapillarySuctionTest([9.0, 9.1, 8.0, 7.9], [0.0, 0.0, 10.0, 10.0]).fit()
    with pytest.raises(InputError, match="greater than zero in every row: row 2"):
        CapillarySuctionTest([9.0, 0.0, 8.0, 7.9], [0.0, 0.0, 10.0, 10.0]).fit()
    quick = CapillarySuctionTest([8.0, 8.1, 10.0, 10.1], [0.0, 0.0, 10.0, 10.0]).fit()
    assert "paper" in [flag["flag"] for flag in quick.flags]


def test_printed_slope_is_a_fouling_index():
    """Geankoplis's line, slope 3.00e6 s/m⁶ and α W of 1.863e11 · 23.47 1/m², as if it were a fouling test."""
    test = FoulingIndexTest.read(
        EXAMPLES / "leaf-filter" / "leaf_geankoplis.csv",
        area="0.0439 m2",
        pressure_drop="338 kPa",
        dynamic_viscosity=8.937e-4,
    )
    found = test.fit()
    assert found["line_slope"].value == pytest.approx(3.00e6, rel=0.005)
    assert found["fouling_potential"].value == pytest.approx(1.863e11 * 23.47, rel=0.005)
    assert found["medium_resistance"].value == pytest.approx(10.63e10, rel=0.005)
    agreed = 3.00e6 * (1.002 / 0.8937) * (338 / 200) * (0.0439 / 13.8e-4) ** 2
    assert found["modified_fouling_index"].value == pytest.approx(agreed, rel=0.005)
    assert [flag["flag"] for flag in found.flags] == ["pressure", "points excluded", "dirty"]


def test_silt_density_index_of_public_examples_and_its_bounds():
    # two public calculators that follow ASTM D4189: 30 and 60 s, or 5 and 10 min, at 15 min
    assert silt_density_index("30 s", "60 s") * PER_MINUTE == pytest.approx(3.33, abs=0.005)
    assert silt_density_index("5 min", "10 min", "15 min") * PER_MINUTE == pytest.approx(3.333, abs=5e-4)
    assert silt_density_index(30.0, 30.0) == 0.0
    assert silt_density_index(1e-2, 1e9) * PER_MINUTE == pytest.approx(100 / 15, rel=1e-6)
    with pytest.raises(ApplicabilityError, match="cannot run faster than the first"):
        silt_density_index(60.0, 30.0)


def test_silt_density_index_of_a_cake_by_integration():
    potential, membrane, eta, dp, A = 3e11, 2e10, 1.1e-3, 2.07e5, 13.8e-4

    def rate(_t, V):
        return [A * dp / (eta * (potential * V[0] / A + membrane))]

    def reaches(volume):
        event = lambda _t, V: V[0] - volume  # noqa: E731
        event.terminal = True
        return scipy.integrate.solve_ivp(
            rate, (0.0, 1e6), [0.0], events=event, rtol=1e-11, atol=1e-16
        ).t_events[0][0]

    first = reaches(5e-4)
    passed = scipy.integrate.solve_ivp(rate, (0.0, 900.0), [0.0], rtol=1e-11, atol=1e-16).y[0, -1]
    last = reaches(passed + 5e-4) - 900.0
    by_hand = (1.0 - first / last) / 900.0
    assert silt_density_index_cake(potential, membrane, dp, eta) == pytest.approx(by_hand, rel=1e-6)
    # clean water fouls nothing, and the index never passes its bound
    assert silt_density_index_cake(1.0, membrane) * PER_MINUTE == pytest.approx(0.0, abs=1e-6)
    rng = np.random.default_rng(3)
    for _setting in range(100):
        R = 10 ** rng.uniform(9.5, 11)
        I = R * 10 ** rng.uniform(-3, -0.5)  # the first sample meets a membrane still nearly clean
        index = silt_density_index_cake(I, R) * PER_MINUTE
        assert 0.0 <= index < 100 / 15
        # more matter, warmer water, more pressure, an opener membrane: a higher index (Alhadidi and others)
        assert silt_density_index_cake(1.2 * I, R) * PER_MINUTE > index
        assert silt_density_index_cake(I, R, dynamic_viscosity=8e-4) * PER_MINUTE > index
        assert silt_density_index_cake(I, R, 3e5) * PER_MINUTE > index
        assert silt_density_index_cake(I, 0.8 * R) * PER_MINUTE > index
        assert modified_fouling_index(2.0 * I) == pytest.approx(2.0 * float(modified_fouling_index(I)))


def test_a_water_too_dirty_for_the_index_says_so():
    with pytest.raises(ApplicabilityError, match="too dirty for this index"):
        silt_density_index_cake(1e14, 1e10)
    t, V = fouled()
    found = FoulingIndexTest(3e3 * t, V, **STATE).fit()
    assert "dirty" in [flag["flag"] for flag in found.flags]


def fouled(rng=None, scatter=2e-3):
    V = np.linspace(0.1, 1.6, 16) * 1e-3
    slope, intercept = modified_fouling_index(5e10), 1.002e-3 * 2e10 / (2e5 * 13.8e-4)
    ratio = float(slope) * V + intercept
    if rng is not None:
        ratio = ratio + scatter * ratio.mean() * rng.standard_normal(V.size)
    return ratio * V, V


STATE: dict[str, Any] = {"area": 13.8e-4, "pressure_drop": 2e5, "dynamic_viscosity": 1.002e-3}


@pytest.mark.long
def test_fouling_intervals_hold_the_truth_as_often_as_they_say():
    """Of 200 repetitions with scatter of t/V, 93 to 97 in a hundred hold the truth."""
    rng = np.random.default_rng(4)
    truth = {
        "fouling_potential": 5e10,
        "medium_resistance": 2e10,
        "modified_fouling_index": float(modified_fouling_index(5e10)),
        "silt_density_index": float(silt_density_index_cake(5e10, 2e10)),
    }
    inside = dict.fromkeys(truth, 0)
    for _repetition in range(200):
        t, V = fouled(rng)
        found = FoulingIndexTest(t, V, **STATE, first_points_excluded=0).fit()
        for name, true in truth.items():
            low, high = found[name].interval_95
            inside[name] += low < true < high
    for count in inside.values():
        assert 0.93 <= count / 200 <= 0.97, inside


def test_the_fouling_test_is_the_leaf_test_without_the_mass_of_the_cake():
    t, V = fouled()
    assert bad_start(V, t / V) == 0
    found = FoulingIndexTest(t, V, **STATE).fit()
    leaf = LeafTest(t, V, **STATE, dry_cake_per_filtrate=2.0).fit()
    assert found["fouling_potential"].value == pytest.approx(2.0 * leaf["cake_resistance"].value)
    assert found["medium_resistance"].value == pytest.approx(leaf["medium_resistance"].value)
    assert found["modified_fouling_index"].value == pytest.approx(found["line_slope"].value)


def test_filterability_number():
    # by hand: 0.3 · 0.05 / (2e-3 · 1800)
    assert filterability_number(0.3, 5e-4, 1e-2, 2e-3, 1800.0) == pytest.approx(0.3 * 0.05 / 3.6)
    assert filterability_number(0.3, 0.0, 1e-2, 2e-3, 1800.0) == 0.0
    # the same whatever unit tells the concentrations
    assert filterability_number(0.3, 0.5, 10.0, 2e-3, 1800.0) == pytest.approx(
        float(filterability_number(0.3, 5e-4, 1e-2, 2e-3, 1800.0))
    )
