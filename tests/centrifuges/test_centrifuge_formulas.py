"""Centrifuge formulas against printed examples, the notes' constants and numerical solutions."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from granum.centrifuges.formulas import clarifying as cl
from granum.centrifuges.formulas import field as fi
from granum.centrifuges.formulas import laboratory as la
from granum.centrifuges.formulas import mechanics
from granum.centrifuges.formulas import spinning as sp
from granum.core.constants import STANDARD_GRAVITY as g
from granum.particles.formulas.drag import (
    drag_coefficient_allen,
    drag_coefficient_newton,
    drag_coefficient_stokes,
)
from granum.particles.formulas.terminal import terminal_velocity


def test_customary_constants_of_the_field():
    # 1.118e-5 r[cm] N², 0.011 m r N², K = (2πN/60)² D/2g
    assert fi.centrifugal_effect("10 cm", "3000 rpm") == pytest.approx(1.118e-5 * 10 * 3000**2, rel=5e-4)
    assert fi.centrifugal_force(2.0, 0.3, "1500 rpm", 2000.0, 1e-9) == pytest.approx(
        0.011 * 2 * 0.3 * 1500**2, rel=5e-3
    )
    assert fi.centrifugal_force(1.0, 0.1, 100.0, 2500.0, 1000.0) == pytest.approx(0.6 * 1000)
    assert fi.centrifugal_force(1.0, 0.1, 100.0, 800.0, 1000.0) < 0
    w = fi.rotation_speed_for_effect(1000.0, 0.25)
    assert fi.centrifugal_effect(0.25, w) == pytest.approx(1000.0)
    # slope of the paraboloid is the effect
    h = 1e-6
    slope = (fi.surface_height_rotating(0.2 + h, 12.0) - fi.surface_height_rotating(0.2 - h, 12.0)) / (2 * h)
    assert slope == pytest.approx(fi.centrifugal_effect(0.2, 12.0), rel=1e-7)
    head = fi.liquid_pressure_bowl(0.5, 0.4, 100.0, 1000.0)
    assert head == pytest.approx(quad(lambda r: 1000.0 * 100.0**2 * r, 0.4, 0.5)[0])


@pytest.mark.parametrize(
    ("drag", "rule"),
    [
        (
            drag_coefficient_stokes,
            lambda v, K: fi.settling_velocity_centrifugal_stokes(v, K, 1e-6, 1000.0, 1e-3),
        ),
        (drag_coefficient_allen, fi.settling_velocity_centrifugal_allen),
        (drag_coefficient_newton, fi.settling_velocity_centrifugal_newton),
    ],
)
def test_three_regimes_follow_from_their_drag_laws(drag, rule):
    case = {
        "particle_diameter": 1e-4,
        "particle_density": 2500.0,
        "fluid_density": 1000.0,
        "dynamic_viscosity": 1e-3,
    }
    still = terminal_velocity(**case, drag=drag)
    spun = fi.settling_velocity_centrifugal(**case, radius=0.2, rotation_speed=150.0, drag=drag)
    assert rule(still, fi.centrifugal_effect(0.2, 150.0)) == pytest.approx(spun, rel=1e-8)


def test_laboratory_rotors():
    # customary k = 2.53e5 ln(rmax/rmin)/(N/1000)², N = 40 000
    assert la.clearing_factor(0.05, 0.10, "40000 rpm") == pytest.approx(2.53e5 * np.log(2) / 40**2, rel=2e-3)
    hours = la.pelleting_time(0.05, 0.10, "40000 rpm", "80 svedberg") / 3600
    assert hours == pytest.approx(la.clearing_factor(0.05, 0.10, "40000 rpm") / 80)
    assert la.pelleting_time_other_rotor(3600, 50, 125) == pytest.approx(9000)
    s = la.sedimentation_coefficient_stokes(2e-7, 1200.0, 1000.0, 1e-3)
    assert s == pytest.approx(4e-14 * 200 / 18e-3)
    speed = fi.settling_velocity_centrifugal(2e-7, 1200.0, 1000.0, 1e-3, 0.08, 500.0, drag_coefficient_stokes)
    assert la.sedimentation_coefficient(speed, 0.08, 500.0) == pytest.approx(s, rel=1e-8)
    # a particle starting at r reaches r e^(s ω² t)
    t = 300.0
    path = solve_ivp(lambda _t, r: s * 500.0**2 * r, (0, t), [0.05], rtol=1e-10)
    assert path.y[0, -1] == pytest.approx(0.05 * np.exp(s * 500.0**2 * t), rel=1e-8)
    assert la.pelleted_fraction(s, t, 500.0, 0.05, 0.1) == pytest.approx(
        (0.1 - 0.1 * np.exp(-s * 250000 * t)) / 0.05
    )
    whole = la.pelleting_time(0.05, 0.1, 500.0, s)
    assert la.pelleted_fraction(s, whole * 1.0001, 500.0, 0.05, 0.1) == pytest.approx(1.0)
    # Svedberg's equation for hemoglobin: about 6.0 to 6.8e4 g/mol by its own s, D and v
    assert la.molar_mass_svedberg(4.31e-13, 6.9e-11, 0.749e-3, 998.2) == pytest.approx(63, rel=0.07)
    assert la.sedimentation_coefficient_standard(4e-13, 0.73e-3, 1010.0, 1.2e-3) > 4e-13


def test_geankoplis_examples_of_section_14_4():
    # 14.4-1: 23 000 rpm, 100 cP, 0.002832 m3/h: printed Σ = 196.3 m2, critical diameter 0.746 µm
    sigma = cl.sigma_factor_tubular_half_thickness(0.1970, 0.00716, 0.02225, "23000 rpm")
    assert sigma == pytest.approx(196.3, rel=0.002)
    d = cl.cut_size_centrifuge("0.002832 m^3/hour", sigma, 1461, 801, "100 cP", flow_multiple=2.0)
    assert d == pytest.approx(0.746e-6, rel=0.002)
    # 14.4-2: oil 919.5 and water phase 980.3 kg/m3, overflow radii 10.160 and 10.414 mm: printed interface at
    # 13.75 mm
    assert cl.radius_interface(10.414e-3, 10.160e-3, 980.3, 919.5) == pytest.approx(13.75e-3, rel=0.005)


def test_scale_up_keeps_the_cut():
    # crystals of 2 µm, 0.0104 m3/s in a bowl turning at 60 000 rpm (Brasch and Whyman, example 13.4); another
    # machine at the same cut
    bowl = cl.sigma_factor_tubular(0.5, "12 mm", "50.5 mm", "60000 rpm")
    mud = {"particle_density": 1455.0, "fluid_density": 998.0, "dynamic_viscosity": 1.013e-3}
    flow = cl.volume_flow_centrifuge(2e-6, bowl, **mud)
    assert flow == pytest.approx(0.0104, rel=5e-3)
    stack = cl.volume_flow_other_centrifuge(flow, bowl, 3e4, sigma_efficiency=1.0, sigma_efficiency_other=0.5)
    assert cl.cut_size_centrifuge(stack, 3e4, **mud, sigma_efficiency=0.5) == pytest.approx(2e-6)
    assert cl.volume_flow_centrifuge(2e-6, bowl, 900.0, 998.0, 1e-3) == 0.0


def test_neutral_zone_balances_the_pressures():
    rH, rL, heavy, light, w = 0.06, 0.05, 1050.0, 900.0, 300.0
    ri = cl.radius_interface(rH, rL, heavy, light)
    assert fi.liquid_pressure_bowl(ri, rH, w, heavy) == pytest.approx(
        fi.liquid_pressure_bowl(ri, rL, w, light), rel=1e-10
    )
    assert cl.radius_heavy_dam(ri, rL, heavy, light) == pytest.approx(rH, rel=1e-12)


def test_sigma_conventions_agree_with_particle_paths():
    L, r1, r2, w, Q, eta, excess = 0.8, 0.05, 0.12, 400.0, 2e-3, 1e-3, 600.0
    tau = np.pi * L * (r2**2 - r1**2) / Q

    def critical(start):  # diameter that travels from start to the wall during the stay
        return np.sqrt(18 * eta * np.log(r2 / start) / (excess * w**2 * tau))

    for sigma, start, multiple in (
        (cl.sigma_factor_tubular, r1, 1.0),
        (cl.sigma_factor_tubular_half_thickness, (r1 + r2) / 2, 2.0),
        (cl.sigma_factor_tubular_half_area, np.sqrt((r1**2 + r2**2) / 2), 2.0),
    ):
        found = cl.cut_size_centrifuge(
            Q, sigma(L, r1, r2, w), 1000 + excess, 1000.0, eta, flow_multiple=multiple
        )
        assert found == pytest.approx(critical(start), rel=1e-10)
    half = critical(np.sqrt((r1**2 + r2**2) / 2))
    vg = half**2 * excess * g / (18 * eta)
    assert cl.grade_efficiency_tubular(vg, Q, L, r1, r2, w) == pytest.approx(0.5, rel=1e-10)
    full = critical(r1) ** 2 * excess * g / (18 * eta)
    assert cl.grade_efficiency_tubular(full * 1.0001, Q, L, r1, r2, w) == 1.0
    # thin layer: all conventions meet, and the linear law with them
    thin = cl.sigma_factor_tubular(L, 0.1199, 0.12, w)
    assert thin == pytest.approx(2 * np.pi * L * 0.12**2 * w**2 / g, rel=2e-3)
    assert cl.sigma_factor_scroll(L, 0.1199, 0.12, w) == pytest.approx(thin, rel=2e-3)
    # one disc gap: projected area times the local effect, integrated over the cone
    cone, _e = quad(lambda r: 2 * np.pi * r / np.tan(0.7) * w**2 * r / g, 0.05, 0.15)
    assert cl.sigma_factor_disc(1, 0.05, 0.15, w, 0.7) == pytest.approx(cone, rel=1e-10)
    assert cl.sigma_factor_scroll(L, 0.1, 0.2, w, 0.3) > cl.sigma_factor_scroll(L, 0.1, 0.2, w)


BASKET = {
    "radius_outer": 0.5,
    "cake_radius": 0.42,
    "rotation_speed": 110.0,
    "liquid_density": 1050.0,
    "dynamic_viscosity": 1.3e-3,
    "cake_permeability": 4e-13,
    "medium_resistance": 3e10,
}


def test_basket_flow_loading_and_spin_off():
    h, ri = 0.4, 0.36
    Q = sp.filtrate_flow_basket(basket_height=h, radius_inner=ri, **BASKET)
    # McCabe: Q = ρω²(r2² - r1²)/(2μ(α m/(A_L A_a) + R/A2)) with α = 1/(k(1-ε)ρs): the mass cancels
    ro, rc = 0.5, 0.42
    volume = np.pi * (ro**2 - rc**2) * h
    log_mean, mean = 2 * np.pi * h * (ro - rc) / np.log(ro / rc), np.pi * h * (ro + rc)
    by_mccabe = (
        1050
        * 110**2
        * (ro**2 - ri**2)
        / (2 * 1.3e-3 * (volume / 4e-13 / (log_mean * mean) + 3e10 / (2 * np.pi * ro * h)))
    )
    assert pytest.approx(by_mccabe, rel=1e-12) == Q
    critical = sp.filtrate_flow_critical(basket_height=h, **BASKET)
    faster = sp.filtrate_flow_critical(basket_height=h, **{**BASKET, "rotation_speed": 220.0})
    assert faster == pytest.approx(4 * critical)
    assert critical < Q
    # loading and spin-off against the differential equations
    v = 0.12

    def grow(_t, y):
        flow = sp.filtrate_flow_basket(
            basket_height=h, radius_inner=ri, **{**BASKET, "cake_radius": float(np.sqrt(y[0]))}
        )
        return [-v * flow / (np.pi * h)]

    t = sp.loading_time_basket(radius_inner=ri, cake_volume_per_filtrate=v, **BASKET)
    out = solve_ivp(grow, (0, t), [ro**2 * (1 - 1e-12)], rtol=1e-8, atol=1e-12)
    assert np.sqrt(out.y[0, -1]) == pytest.approx(rc, rel=1e-6)

    def fall(_t, y):
        return [
            sp.filtrate_flow_basket(basket_height=h, radius_inner=float(np.sqrt(y[0])), **BASKET)
            / (np.pi * h)
        ]

    shallow = 0.41  # short of the cake, into which trial steps of the integration would reach
    t = sp.spin_off_time(radius_inner=ri, **BASKET) - sp.spin_off_time(radius_inner=shallow, **BASKET)
    out = solve_ivp(fall, (0, t), [ri**2], rtol=1e-9, max_step=t / 50)
    assert np.sqrt(out.y[0, -1]) == pytest.approx(shallow, rel=1e-7)


def test_drainage_by_hand_and_limits():
    # 200 µm, ε = 0.4, r = 0.4 m, 130 rad/s, 1100 kg/m3, 0.072 N/m: N_cap = 0.7344
    assert sp.irreducible_saturation_spinning(2e-4, 0.4, 0.4, 130.0, 1100.0, 0.072) == pytest.approx(
        0.0139 * 0.734420**-0.86, rel=1e-5
    )
    t = np.geomspace(1e-4, 1e4, 50)
    S = np.asarray(sp.cake_saturation_spinning(t, 2e-4, 0.4, 0.05, 0.4, 130.0, 1100.0, 1e-3, 0.1))
    assert S[0] == 1.0
    assert np.all(np.diff(S) <= 0)
    assert S[-1] == pytest.approx(0.1, abs=0.01)
    assert mechanics.hoop_stress_bowl(0.3, 0.01, 300.0, 0.0) == pytest.approx(7850 * 90**2)
    assert cl.sigma_factor_bottle(1e-4, 0.08, 0.12, 300.0) == pytest.approx(
        1e-4 * 9e4 / (2 * g * np.log(1.2))
    )


def test_contact_liquid_by_hand():
    # d_h = 2·0.42·2e-4/(3·0.58) = 9.655e-5 m, field 1050·167.5²·0.23 = 6.7756e6, N_c = 0.877, rise
    # 4·0.072/(6.7756e6·9.655e-5·0.04)
    S = sp.irreducible_saturation_leung(2e-4, 0.42, 0.04, 0.23, 167.5, 1050.0, 0.072)
    rise = 0.288 / (6.77559e6 * 9.6552e-5 * 0.04)
    assert pytest.approx(rise + 0.075 * (1 - rise), rel=1e-4) == S
    coarse = sp.irreducible_saturation_leung(1e-3, 0.42, 0.04, 0.23, 167.5, 1050.0, 0.072)
    assert coarse < S
