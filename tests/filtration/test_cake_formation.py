"""Standard cake formation time: a printed filtration, an independent integration, classes, coverage."""

from __future__ import annotations

import numpy as np
import pytest
import scipy

from granum.core.errors import ApplicabilityError, InputError
from granum.filtration.formulas.cake_growth import standard_cake_formation_time
from granum.filtration.lab_tests.cake_formation import CakeFormationTest
from granum.filtration.selection import filtering_class

STANDARD, MEDIUM = 180.0, 1.2e-3
TIMES = np.repeat([30.0, 60.0, 120.0, 240.0, 480.0], 3)


def grown(times=TIMES, standard=STANDARD, medium=MEDIUM):
    """Thickness by dZ/dt = G / (2 (Z + Z_m)), integrated."""
    growth = (1e-4 + 2e-2 * medium) / standard
    order = np.unique(times)
    found = scipy.integrate.solve_ivp(
        lambda _t, Z: 0.5 * growth / (Z + medium),
        (0.0, order[-1]),
        [0.0],
        t_eval=order,
        rtol=1e-11,
        atol=1e-16,
    )
    return np.interp(times, order, found.y[0])


def test_the_time_of_a_printed_press():
    """Geankoplis, example 14.2-2: 3.37 m³ on 17.46 m² in 269.7 s; for the centimeter its own cake."""
    loading = 23.47 * 3.37 / 17.46
    thick = loading / (0.5 * 2710.0)
    found = standard_cake_formation_time(
        1.863e11, 23.47, 0.5, 2710.0, 8.937e-4, 10.63e10, pressure_drop=338e3, cake_thickness=thick
    )
    assert found == pytest.approx(269.7, rel=0.003)


def test_a_thicker_slurry_more_pressure_and_an_opener_cake_are_quicker():
    rng = np.random.default_rng(2)
    for _setting in range(100):
        alpha, W, void = 10 ** rng.uniform(8, 12), rng.uniform(5, 400), rng.uniform(0.3, 0.8)
        density, eta, R = rng.uniform(1100, 5000), 10 ** rng.uniform(-3.5, -2), 10 ** rng.uniform(8, 11)
        time = standard_cake_formation_time(alpha, W, void, density, eta, R)
        assert time > 0.0
        assert standard_cake_formation_time(alpha, 1.1 * W, void, density, eta, R) < time
        assert standard_cake_formation_time(alpha, W, void, density, eta, R, 2e5) == pytest.approx(0.5 * time)
        assert standard_cake_formation_time(alpha, W, void + 0.05, density, eta, R) < time
        assert standard_cake_formation_time(alpha, W, void, density, eta, 2.0 * R) > time


def test_clear_liquid_forms_no_cake():
    with pytest.raises(ApplicabilityError, match="no cake"):
        standard_cake_formation_time(1e10, 0.0, 0.5, 3000.0, 1e-3)


def test_cakes_of_an_integration_give_the_truth_back():
    found = CakeFormationTest(TIMES, grown()).fit()
    assert found["standard_cake_formation_time"].value == pytest.approx(STANDARD, rel=1e-6)
    assert found["cake_thickness_medium"].value == pytest.approx(MEDIUM, rel=1e-5)
    assert found["growth_rate_cake"].value == pytest.approx(0.01 / STANDARD, rel=1e-6)


def test_another_pressure_by_compressibility():
    """Cakes of 4 bar, told at 1 bar: resistance to the power 0.5 halves the gain of pressure."""
    alpha, medium, W, mass = 1e10, 2e9, 100.0, 1500.0
    hard = alpha * 4.0**0.5
    growth, like = 2.0 * 4e5 * W / (1e-3 * hard * mass**2), medium / (hard * mass)
    standard = (1e-4 + 2e-2 * like) / growth
    found = CakeFormationTest(
        TIMES, grown(standard=standard, medium=like), pressure_drop="4 bar", compressibility=0.5
    ).fit()
    soft = standard_cake_formation_time(alpha, W, 0.5, 3000.0, 1e-3, medium)
    assert found["standard_cake_formation_time"].value == pytest.approx(float(soft), rel=1e-5)
    assert found["cake_thickness_medium"].value == pytest.approx(medium / (alpha * mass), rel=1e-4)


@pytest.mark.long
def test_intervals_hold_the_truth_as_often_as_they_say():
    """Of 200 repetitions with a ruler that errs by 0.3 mm, 93 to 97 in a hundred hold the truth."""
    rng = np.random.default_rng(1)
    truth = {
        "standard_cake_formation_time": STANDARD,
        "cake_thickness_medium": MEDIUM,
        "growth_rate_cake": 0.01 / STANDARD,
    }
    inside, exact = dict.fromkeys(truth, 0), grown()
    for _repetition in range(200):
        found = CakeFormationTest(TIMES, exact + 3e-4 * rng.standard_normal(exact.size)).fit()
        for name, true in truth.items():
            low, high = found[name].interval_95
            inside[name] += low < true < high
    for count in inside.values():
        assert 0.93 <= count / 200 <= 0.97, inside


def test_one_time_only_and_messages():
    one = CakeFormationTest([60.0] * 3, [4.9e-3, 5.0e-3, 5.1e-3], cake_thickness_medium=0.0).fit()
    assert one["standard_cake_formation_time"].value == pytest.approx(240.0, rel=1e-3)
    with pytest.raises(InputError, match="All cakes were formed for one time"):
        CakeFormationTest([60.0] * 3, [4.9e-3, 5.0e-3, 5.1e-3]).fit()
    with pytest.raises(InputError, match="do not slow down"):
        CakeFormationTest([60.0, 120.0, 180.0], [1e-3, 2.2e-3, 3.5e-3]).fit()
    thin = CakeFormationTest([30.0, 60.0, 120.0], [1e-3, 1.4e-3, 2e-3], cake_thickness_medium=0.0).fit()
    assert "thin cakes" in [flag["flag"] for flag in thin.flags]


def test_classes_of_the_rules_of_thumb():
    """0.1 cm per second, minute, hour; an eighth of an inch in five minutes (opened)."""
    quick_to_slow = [filtering_class(time).split(":")[0] for time in (1, 9, 11, 590, 610, 35000, 37000)]
    assert quick_to_slow == ["rapid", "rapid", "medium", "medium", "slow", "slow", "very slow"]
    eighth = 300.0 * (10.0 / 3.175) ** 2  # s, of the centimeter
    assert "hardly for continuous" in filtering_class(0.99 * eighth)
    assert "not for continuous" in filtering_class(1.01 * eighth)
