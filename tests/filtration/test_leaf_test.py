"""The leaf test on published data: α and R_s of the books, and what it says about bad data."""

from __future__ import annotations

import io

import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

from granum.core.errors import ApplicabilityError, InputError, UnitError
from granum.filtration.formulas.constant_pressure import filtration_time_constant_pressure
from granum.filtration.formulas.mass_balance import dry_cake_per_filtrate
from granum.filtration.formulas.readings import ruth_constants_readings
from granum.filtration.lab_tests.leaf_test import LeafTest

FOLDER = EXAMPLES / "leaf-filter"
GEANKOPLIS = {
    "area": "0.0439 m2",
    "pressure_drop": "338 kPa",
    "dynamic_viscosity": 8.937e-4,
    "dry_cake_per_filtrate": 23.47,
}


def test_geankoplis_example_14_2_1_leaves_out_the_first_point():
    found = LeafTest.read(FOLDER / "leaf_geankoplis.csv", **GEANKOPLIS).fit()
    # printed: slope 3.00e6 s/m6 and intercept 6400 s/m3 read from a drawn line, α = 1.863e11 m/kg, R =
    # 10.63e10 1/m
    assert found["cake_resistance"].value == pytest.approx(1.863e11, rel=0.005)
    assert found["medium_resistance"].value == pytest.approx(10.63e10, rel=0.005)
    assert found["line_slope"].value == pytest.approx(3.00e6, rel=0.005)
    assert found["line_intercept"].value == pytest.approx(6400, rel=0.005)
    low, high = found["cake_resistance"].interval_95
    assert low < 1.863e11 < high
    assert [f["flag"] for f in found.flags] == ["points excluded"]
    assert found.statistics["points_excluded"] == 1
    whole = LeafTest.read(FOLDER / "leaf_geankoplis.csv", **GEANKOPLIS, first_points_excluded="0").fit()
    # by numpy.polyfit over all ten points
    assert whole["cake_resistance"].value == pytest.approx(1.79e11, rel=0.005)
    figure = LeafTest.read(FOLDER / "leaf_geankoplis.csv", **GEANKOPLIS).chart()
    excluded = next(trace for trace in figure.data if trace.name == "excluded")
    assert len(excluded.x) == 1


def test_holdich_spreadsheet():
    # moisture ratio 1280/635 and 10 % solids give 125.24655 kg/m3; printed α = 5.215e11 m/kg, R = 2.861e12
    # 1/m, R² = 0.9943521
    W = dry_cake_per_filtrate(solids_mass_fraction=0.1, liquid_density=1000, wet_to_dry_mass_ratio=1280 / 635)
    assert pytest.approx(125.24655, rel=1e-7) == W
    test = LeafTest.read(
        FOLDER / "leaf_holdich.csv",
        area="2.72 m2",
        pressure_drop="3 bar",
        dynamic_viscosity="1 mPa*s",
        dry_cake_per_filtrate=W,
    )
    found = test.fit()
    assert found["cake_resistance"].value == pytest.approx(5.215e11, rel=1e-4)
    assert found["medium_resistance"].value == pytest.approx(2.861e12, rel=2e-4)
    assert found.statistics["r_squared"] == pytest.approx(0.9943521, abs=1e-7)
    assert found.flags == []


CONDITIONS = {"area": 0.5, "pressure_drop": 8e4, "dynamic_viscosity": 1.2e-3, "dry_cake_per_filtrate": 15.3}


def synthetic(alpha=1e11, Rm=5e10, points=15, noise=0.0, seed=0):
    V = np.linspace(0.02, 0.3, points)
    t = np.asarray(
        filtration_time_constant_pressure(V, **CONDITIONS, cake_resistance=alpha, medium_resistance=Rm)
    )
    return t * (1 + noise * np.random.default_rng(seed).standard_normal(points)), V


def test_exact_data_are_recovered_exactly():
    t, V = synthetic()
    found = LeafTest(time=t, filtrate_volume=V, **CONDITIONS).fit()
    assert found["cake_resistance"].value == pytest.approx(1e11, rel=1e-8)
    assert found["medium_resistance"].value == pytest.approx(5e10, rel=1e-7)
    assert found["ruth_volume"].value == pytest.approx(0.5 * 5e10 / (1e11 * 15.3), rel=1e-7)
    assert found.flags == []


def test_intervals_cover_the_truth_about_95_times_in_100():
    hits = 0
    for seed in range(40):
        t, V = synthetic(noise=0.01, seed=seed)
        low, high = (
            LeafTest(time=t, filtrate_volume=V, first_points_excluded=0, **CONDITIONS)
            .fit()["cake_resistance"]
            .interval_95
        )
        hits += low < 1e11 < high
    assert hits >= 34  # fewer has probability 1 in 400


@pytest.mark.parametrize("bad", [1, 2, 4])
def test_late_clock_at_the_start_is_found(bad):
    t, V = synthetic(noise=0.003, seed=3)
    t[:bad] *= 1.4
    found = LeafTest(time=t, filtrate_volume=V, **CONDITIONS).fit()
    assert found.statistics["points_excluded"] == bad
    assert found["cake_resistance"].value == pytest.approx(1e11, rel=0.02)


def test_flags_settling_and_negative_intercept():
    t, V = synthetic()
    settled = np.where(V > 0.15, t[7] + (t - t[7]) * 0.55, t)
    assert "bent line" in [
        f["flag"] for f in LeafTest(time=settled, filtrate_volume=V, **CONDITIONS).fit().flags
    ]
    early = LeafTest(time=1e3 * V**2 - 1.0 * V, filtrate_volume=V, **CONDITIONS).fit()
    assert "negative intercept" in [f["flag"] for f in early.flags]
    assert early["medium_resistance"].value == 0.0


def test_clear_messages():
    with pytest.raises(InputError, match="Did you mean 'pressure_drop'"):
        LeafTest.read(
            FOLDER / "leaf_holdich.csv",
            area=1,
            presure_drop=1e5,
            dynamic_viscosity=1e-3,
            dry_cake_per_filtrate=10,
        )
    with pytest.raises(UnitError, match="unit 's' does not fit"):
        LeafTest.read(
            FOLDER / "leaf_holdich.csv",
            area="3 s",
            pressure_drop=1e5,
            dynamic_viscosity=1e-3,
            dry_cake_per_filtrate=10,
        )
    with pytest.raises(InputError, match="'time' must increase"):
        LeafTest(time=[1, 3, 2], filtrate_volume=[1, 2, 3], **CONDITIONS).fit()
    with pytest.raises(InputError, match="too few"):
        LeafTest(time=[1, 2, 4, 7], filtrate_volume=[1, 2, 3, 4], first_points_excluded=2, **CONDITIONS).fit()
    with pytest.raises(InputError, match="no column 'filtrate_volume"):
        LeafTest.read(io.StringIO("time [s],mass [kg]\n1,2\n2,3\n3,4\n"), **CONDITIONS)


@pytest.mark.parametrize("readings", [("3 min", "5 L"), ("3 12 min", "5 5 L"), ("3 4 min", "5 10 L")])
def test_readings_without_a_cake_are_refused(readings) -> None:
    with pytest.raises(ApplicabilityError, match="rising line"):
        ruth_constants_readings(*readings)
