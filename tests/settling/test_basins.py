"""Ideal basins, scour, lamella, API separator: printed worked examples and limits."""

from __future__ import annotations

import numpy as np
import pytest

from granum.settling.equipment.api_separator import ApiSeparator
from granum.settling.formulas import api, basins, lamella


def test_area_of_davis_example_10_4():
    # Davis (2010), example 10-4: 43 200 m³/d at 32.5 m/d needs 1 329.23 m².
    assert basins.basin_area("43200 m^3/day", "32.5 m/day") == pytest.approx(1329.23, rel=1e-5)
    assert basins.overflow_rate_basin("43200 m^3/day", 1329.23) * 86400 == pytest.approx(32.5, rel=1e-5)


def test_scour_velocity_of_metcalf_and_eddy():
    # Metcalf & Eddy, primary sedimentation example: 100 µm, specific gravity 1.25, k = 0.05, f = 0.025 give
    # 0.063 m/s.
    assert basins.scour_velocity_camp("100 um", 1250, 1000, 0.05, 0.025) == pytest.approx(0.063, abs=5e-4)


def test_removal_between_one_tank_and_plug_flow():
    ratio = np.array([0.1, 0.5, 1.0, 3.0])
    ideal = np.asarray(basins.removal_efficiency_camp(ratio * 1e-3, 1e-3))
    many = np.asarray(basins.removal_efficiency_hazen(ratio * 1e-3, 1e-3, 1e7))
    np.testing.assert_allclose(many, 1 - np.exp(-ratio), rtol=1e-6)
    # Hazen's one tank: 1/(1 + v0/v), worked by hand.
    np.testing.assert_allclose(
        basins.removal_efficiency_hazen(ratio * 1e-3, 1e-3, 1.0), ratio / (1 + ratio), rtol=1e-12
    )
    assert np.all(many <= ideal)


def test_class_removal_is_the_classical_integral():
    # 1 − x0 + (1/v0) ∫ v dx on a linear velocity distribution from 0 to 2 v0: ½ + ¼.
    edges = np.linspace(0, 2e-3, 4001)
    middle = 0.5 * (edges[1:] + edges[:-1])
    assert basins.removal_efficiency_classes(middle, np.full(4000, 1 / 4000), 1e-3) == pytest.approx(
        0.75, rel=1e-6
    )


def test_api_separator_of_a_published_sheet():
    # Oil–water separator sheet after API 421: 224.79 m³/h, 880/1000 kg/m³, 1 cP. Printed: rise 5.30 m/h,
    # horizontal 54.86 m/h
    # (3 ft/min, below 15 × 5.30 = 79.46), section 4.10 m², depth 1.13 m, width 3.63 m, ratio 10.36, F 1.53,
    # lengths 17.86 and 18.13 m.
    rise = api.rise_velocity_api(1000.0, 880.0, 1e-3)
    assert rise * 3600 == pytest.approx(5.30, abs=5e-3)
    assert 15 * rise * 3600 == pytest.approx(79.46, abs=0.05)
    horizontal = api.horizontal_velocity_api(rise)
    assert horizontal * 3600 == pytest.approx(54.864, rel=1e-9)
    assert horizontal / rise == pytest.approx(10.36, abs=0.01)
    assert api.turbulence_factor_api(10.36) == pytest.approx(1.53, abs=5e-3)
    assert api.basin_length_api(horizontal, rise, 1.13) == pytest.approx(17.86, rel=3e-3)
    sized = ApiSeparator.size(224.79 / 3600, 1000.0, 880.0, 1e-3, depth_over_width=0.311)
    assert sized.width * sized.height == pytest.approx(4.10, abs=0.01)
    assert (sized.height, sized.width, sized.length) == pytest.approx((1.13, 3.63, 18.13), rel=3e-3)


@pytest.mark.parametrize(("ratio", "factor"), [(3, 1.28), (6, 1.37), (10, 1.52), (15, 1.64), (20, 1.74)])
def test_turbulence_factor_goes_through_the_points_of_the_figure(ratio, factor):
    assert api.turbulence_factor_api(float(ratio)) == pytest.approx(factor, rel=1e-12)


def test_tube_settler_of_aguaclara():
    # AguaClara textbook: 3 mm/s in 2.54 cm tubes at 60° with a capture velocity of 0.2 mm/s need 72 cm (ideal
    # plates, S = 1).
    critical = lamella.critical_velocity_countercurrent("3 mm/s", "72 cm", "2.54 cm", "60 degree")
    assert critical * 1e3 == pytest.approx(0.2, rel=5e-3)


def test_lamella_limits():
    common = ("3 mm/s", "1.2 m", "5 cm")
    up, across, down = (
        f(*common, "60 degree")
        for f in (
            lamella.critical_velocity_countercurrent,
            lamella.critical_velocity_crosscurrent,
            lamella.critical_velocity_cocurrent,
        )
    )
    assert up < across < down
    # Horizontal plates: overflow rate over the plate length, whatever the direction.
    assert lamella.critical_velocity_countercurrent(*common, 0.0) == pytest.approx(
        3e-3 * 0.05 / 1.2, rel=1e-12
    )
    # Long plates: velocity through the gap over the projected length, the projected-area rule.
    long = lamella.critical_velocity_countercurrent("3 mm/s", 500.0, "5 cm", "60 degree")
    assert long == pytest.approx(3e-3 * 0.05 / (500.0 * 0.5), rel=2e-3)
