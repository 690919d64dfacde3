"""Hoppers: Beverloo, Janssen, Jenike and the shear cell, against prints, an integration and geometry."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import granum as gr
from granum.core.errors import ApplicabilityError, GranumError

DEGREE = np.pi / 180.0
RHODES = ([1300.0, 1600.0, 2000.0, 2400.0], [780.0, 850.0, 910.0, 970.0])


def test_beverloo_in_his_units() -> None:
    """Beverloo and others (1961): 35 ρ √g (D − 1.4 d)^2.5 in g/min, g/cm³ and cm."""
    for width, grain in ((2.0, 0.1), (5.0, 0.3), (12.0, 0.5)):
        print_ = 35.0 * 0.8 * np.sqrt(980.665) * (width - 1.4 * grain) ** 2.5 / 60e3
        found = gr.conveying.mass_flow_beverloo(800.0, width / 100.0, grain / 100.0)
        assert found == pytest.approx(print_, rel=1e-3)


def test_grains_too_coarse_for_an_orifice_are_refused() -> None:
    with pytest.raises(ApplicabilityError, match="too narrow"):
        gr.conveying.mass_flow_beverloo(800.0, "5 mm", "4 mm")


def test_janssen_against_an_integration_and_two_limits() -> None:
    """A slice of the cylinder: dσ/dz = ρ g − 4 K tan φ σ/D."""
    d, rho, phi, k = 3.0, 750.0, 22.0 * DEGREE, 0.45
    run = solve_ivp(
        lambda _z, s: rho * 9.80665 - 4.0 * k * np.tan(phi) * s / d, (0.0, 12.0), [0.0], rtol=1e-10, atol=1e-9
    )
    found = gr.conveying.silo_stresses_janssen(12.0, d, rho, phi, k)
    assert found.stress_vertical == pytest.approx(run.y[0, -1], rel=1e-7)
    assert found.stress_wall_shear == pytest.approx(k * np.tan(phi) * run.y[0, -1], rel=1e-7)
    shallow = gr.conveying.silo_stresses_janssen(1e-3, d, rho, phi, k)
    assert shallow.stress_vertical == pytest.approx(rho * 9.80665e-3, rel=1e-3)


def test_jenike_of_two_worked_examples() -> None:
    """Read: Rhodes 30°, 19°: cone 30.5°, less 3°, ff 1.8, 0.16 m; a tutorial 16°, 32.5°, ff 1.5, 0.514 m
    from 1.82 kPa and 900 kg/m³. Theirs are read from charts, and H is 2 + θ/60°.
    """
    c = gr.conveying
    assert c.half_angle_mass_flow_cone(30 * DEGREE, 19 * DEGREE) / DEGREE == pytest.approx(30.5, abs=0.5)
    assert c.half_angle_mass_flow_cone(40 * DEGREE, 16 * DEGREE) / DEGREE == pytest.approx(32.5, abs=0.5)
    factor = c.flow_factor_hopper(30 * DEGREE, 19 * DEGREE, 27.5 * DEGREE)
    assert factor == pytest.approx(1.8, rel=0.08)
    assert c.flow_factor_hopper(40 * DEGREE, 16 * DEGREE, 29.5 * DEGREE) == pytest.approx(1.5, rel=0.01)
    fit = c.FlowFunction(*RHODES).fit()
    strength = c.critical_strength(fit["strength_intercept"].value, fit["strength_slope"].value, 1.8)
    assert strength == pytest.approx(830.0, rel=0.05)
    assert c.outlet_width_jenike(strength, 1300.0, 27.5 * DEGREE) == pytest.approx(0.16, abs=0.01)
    assert c.outlet_width_jenike(1820.0, 900.0, 29.5 * DEGREE) == pytest.approx(0.514, rel=0.02)
    # a slot may be half as wide as a cone, about
    slot = c.outlet_width_jenike(1820.0, 900.0, 29.5 * DEGREE, "wedge")
    assert slot == pytest.approx((1.0 + 29.5 / 180.0) * 1820.0 / (900.0 * 9.80665), rel=0.02)


def test_rough_walls_and_strong_powders_are_refused() -> None:
    c = gr.conveying
    with pytest.raises(ApplicabilityError, match="effective one"):
        c.half_angle_mass_flow_cone("30 degree", "35 degree")
    with pytest.raises(ApplicabilityError, match="no outlet is wide enough"):
        c.critical_strength(500.0, 0.7, 1.6)
    smooth, rough = (c.half_angle_mass_flow_cone("45 degree", w) for w in ("12 degree", "25 degree"))
    assert smooth > rough


@pytest.mark.parametrize(("cohesion", "angle", "tangent"), [(500.0, 30.0, 4000.0), (1200.0, 38.0, 9000.0)])
def test_yield_locus_by_geometry(cohesion: float, angle: float, tangent: float) -> None:
    """A circle that touches the line at a normal stress, and a point of it beyond as preshear."""
    slope, sine, cosine = np.tan(angle * DEGREE), np.sin(angle * DEGREE), np.cos(angle * DEGREE)
    center = tangent + (cohesion + slope * tangent) * slope
    radius = (cohesion + slope * tangent) / cosine
    turned = (90.0 + angle - 20.0) * DEGREE
    normal = np.array([0.3, 0.5, 0.7, 0.9]) * tangent
    test = gr.conveying.YieldLocus(
        stress_normal=normal,
        stress_shear=cohesion + slope * normal,
        preshear_normal=center + radius * np.cos(turned),
        preshear_shear=radius * np.sin(turned),
    )
    found = test.fit()
    assert found["cohesion"].value == pytest.approx(cohesion, rel=1e-6)
    assert found["internal_friction_angle"].value == pytest.approx(angle * DEGREE, rel=1e-6)
    assert found["unconfined_strength"].value == pytest.approx(2 * cohesion * cosine / (1 - sine), rel=1e-6)
    assert found["consolidation_stress"].value == pytest.approx(center + radius, rel=1e-5)
    assert np.sin(found["effective_friction_angle"].value) == pytest.approx(radius / center, rel=1e-5)


def test_intervals_hold_the_truth() -> None:
    seeds = np.random.default_rng(7)
    normal = np.linspace(1000.0, 4000.0, 6)
    kept = 0
    for _ in range(40):
        shear = 600.0 + np.tan(35.0 * DEGREE) * normal + seeds.normal(0.0, 40.0, 6)
        found = gr.conveying.YieldLocus(normal, shear, 5000.0, 3900.0).fit()
        truth = 2 * 600.0 * np.cos(35 * DEGREE) / (1 - np.sin(35 * DEGREE))
        low, high = found["unconfined_strength"].interval_95
        kept += low <= truth <= high
    assert 33 <= kept <= 40


def test_a_lone_point_is_no_locus() -> None:
    with pytest.raises(GranumError, match="at least"):
        gr.conveying.YieldLocus([1e3], [1e3], 2e3, 1.5e3)
    with pytest.raises(GranumError):
        gr.conveying.YieldLocus([1e3, 1e3, 1e3], [1e3, 1.1e3, 0.9e3], 2e3, 1.5e3).fit()


def test_strength_as_a_power_of_a_tutorial() -> None:
    """scribd.com 380917158, question 1, read: σ_y = σ_c^0.68 in kPa and a flow factor of 1.4 meet at 2.043
    kPa: a cone of 0.299 m with H = 2 + θ/60, a slot with H = 1 + θ/180, whose 1.1944·2043/(1800·9.81) m are
    printed as 0.2249.
    """
    met = float(gr.conveying.critical_strength(0.0, 1.0, 1.4, 0.68))
    assert met == pytest.approx(2043.0, rel=1e-3)
    assert float(gr.conveying.unconfined_strength(1.4 * met, 0.0, 1.0, 0.68)) == pytest.approx(met, rel=1e-9)
    at = 35.0 * np.pi / 180.0
    assert float(gr.conveying.outlet_width_jenike(met, 1800.0, at)) == pytest.approx(0.299, rel=0.02)
    slot = 1.1944 * 2043.0 / (1800.0 * 9.81)
    assert float(gr.conveying.outlet_width_jenike(met, 1800.0, at, "wedge")) == pytest.approx(slot, rel=0.02)


def test_powers_against_a_bisection_and_the_line_as_their_end() -> None:
    """Intercept, slope, flow factor and exponent at random; where the exponent nears one the line."""
    rng = np.random.default_rng(3)
    for _ in range(200):
        a, b, ff, n = rng.uniform((0, 0.05, 1.05, 0.2), (3000, 1.2, 2.5, 0.95))
        low, high = 0.0, 1e10
        for _step in range(200):
            s = 0.5 * (low + high)
            low, high = (s, high) if a + 1e3 * b * (ff * s / 1e3) ** n > s else (low, s)
        if low < 1e7:
            assert float(gr.conveying.critical_strength(a, b, ff, n)) == pytest.approx(low, rel=1e-9)
    line = float(gr.conveying.critical_strength(560.0, 0.17, 1.8))
    assert float(gr.conveying.critical_strength(560.0, 0.17, 1.8, 1.0 - 1e-9)) == pytest.approx(
        line, rel=1e-6
    )
    assert float(gr.conveying.critical_strength(560.0, 0.0, 1.8, 0.5)) == pytest.approx(560.0, rel=1e-6)
    with pytest.raises(GranumError, match="no outlet is wide enough"):
        gr.conveying.critical_strength(500.0, 2.0, 2.0, 0.97)
