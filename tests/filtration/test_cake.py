"""Cake filtration formulas against the notes' exercise, printed examples and the differential equations they
integrate.
"""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from granum.filtration.formulas import constant_pressure as cp
from granum.filtration.formulas import constant_rate as cr
from granum.filtration.formulas import mass_balance as mb
from granum.filtration.formulas import resistance as rs


def test_exercise_of_the_notes_iv_8_4_b():
    eps = mb.void_fraction_cake(dry_cake_mass=0.236, cake_volume="145 cm^3", solid_density=2630)
    assert eps == pytest.approx(0.38, abs=0.005)
    alpha = rs.cake_resistance_kozeny_carman(
        particle_diameter="85 um", void_fraction=0.38, solid_density=2630
    )
    assert alpha == pytest.approx(1.07e8, rel=0.001)
    m = mb.wet_to_dry_mass_ratio(void_fraction=0.38, liquid_density=1020, solid_density=2630)
    assert m == pytest.approx(1.24, abs=0.005)
    W = mb.dry_cake_per_filtrate(solids_mass_fraction=0.015, liquid_density=1020)
    assert pytest.approx(15.3, abs=1e-9) == W
    V = cp.filtrate_volume_constant_pressure(
        time=300,
        area=0.5,
        pressure_drop="0.8 bar",
        dynamic_viscosity="1.2 cP",
        cake_resistance=alpha,
        dry_cake_per_filtrate=W,
    )
    # printed 2.4 m3 and 37 kg, from 0.14·√300 with the factor rounded down; 4.5 cm
    assert pytest.approx(2.4, rel=0.04) == V
    assert pytest.approx(37, rel=0.04) == W * V
    Z = mb.cake_thickness(
        filtrate_volume=2.4, area=0.5, dry_cake_per_filtrate=W, void_fraction=0.38, solid_density=2630
    )
    assert pytest.approx(0.045, abs=0.0005) == Z


def test_geankoplis_examples_14_2_2_to_4():
    press = {
        "area": 17.46,
        "pressure_drop": 338e3,
        "dynamic_viscosity": 8.937e-4,
        "cake_resistance": 1.863e11,
        "dry_cake_per_filtrate": 23.47,
        "medium_resistance": 10.63e10,
    }
    assert cp.filtration_time_constant_pressure(3.37, **press) == pytest.approx(269.7, rel=0.002)
    wash = cp.filtrate_flow_washing(3.37, **press, wash_rate_ratio=0.25)
    assert wash == pytest.approx(1.737e-3, rel=0.002)
    assert 0.337 / wash == pytest.approx(194.0, rel=0.002)
    W = mb.dry_cake_per_filtrate(0.191, 996.9, 2.0)
    assert pytest.approx(308.1, abs=0.1) == W
    alpha = rs.cake_resistance_power_law(67.0e3, 4.37e9, 0.3)
    assert alpha == pytest.approx(1.225e11, rel=5e-4)
    # drum: each element filters for a third of the 250 s cycle; 4.823e-4 m3/s of filtrate: printed 6.60 m2,
    # its own figures give 6.66
    per_area = cp.filtrate_volume_constant_pressure(0.33 * 250, 1.0, 67.0e3, 0.8937e-3, alpha, W)
    assert 4.823e-4 / (per_area / 250) == pytest.approx(6.60, rel=0.01)


positive = st.floats(0.1, 10.0)


@given(positive, positive, positive, positive, st.floats(0.0, 10.0))
def test_volume_and_time_are_inverse_and_ruth_holds(t, A, dp, alpha, Rm):
    case = {
        "area": A,
        "pressure_drop": 1e5 * dp,
        "dynamic_viscosity": 1e-3,
        "cake_resistance": 1e10 * alpha,
        "dry_cake_per_filtrate": 20.0,
        "medium_resistance": 1e10 * Rm,
    }
    V = cp.filtrate_volume_constant_pressure(100 * t, **case)
    assert cp.filtration_time_constant_pressure(V, **case) == pytest.approx(100 * t, rel=1e-9)
    a, V0, t0 = cp.ruth_constants(**case)
    assert pytest.approx(a * (100 * t + t0), rel=1e-9) == (V + V0) ** 2


def test_closed_forms_satisfy_the_differential_equation():
    A, dp, eta, alpha, W, Rm, q = 0.8, 1.5e5, 1.1e-3, 3e10, 25.0, 4e10, 2e-4

    def rate(t, V):
        return dp * A / (eta * (alpha * W * V / A + Rm))

    out = solve_ivp(rate, (0, 2000), [0.0], rtol=1e-11, atol=1e-15)
    assert cp.filtrate_volume_constant_pressure(2000, A, dp, eta, alpha, W, Rm) == pytest.approx(
        out.y[0, -1], rel=1e-8
    )
    at = (dp * A / (eta * q) - Rm) * A / (alpha * W)
    # from where the pump reaches the pressure
    limited = solve_ivp(rate, (at / q, 3000), [at], rtol=1e-11, atol=1e-15)
    assert cr.filtration_time_rate_then_pressure(
        limited.y[0, -1], q, A, dp, eta, alpha, W, Rm
    ) == pytest.approx(3000, rel=1e-8)
    assert cr.filtration_time_rate_then_pressure(0.5 * at, q, A, dp, eta, alpha, W, Rm) == pytest.approx(
        0.5 * at / q, rel=1e-12
    )


def test_constant_rate_thickness_and_compressible_limit():
    A, eta, alpha, W, Rm, q, t = 0.8, 1.1e-3, 3e10, 25.0, 4e10, 2e-4, 300.0
    dp = cr.pressure_drop_constant_rate(t, q, A, eta, alpha, W, Rm)
    Z = cr.cake_thickness_constant_rate(t, dp, eta, alpha, W, 0.4, 2500, Rm)
    assert pytest.approx(mb.cake_thickness(q * t, A, W, 0.4, 2500), rel=1e-10) == Z
    assert cr.pressure_drop_constant_rate_compressible(t, q, A, eta, alpha, 0.0, W, Rm) == pytest.approx(
        dp, rel=1e-12
    )
    n, a0 = 0.4, 5e8
    soft = cr.pressure_drop_constant_rate_compressible(t, q, A, eta, a0, n, W)
    assert soft == pytest.approx(cr.pressure_drop_constant_rate(t, q, A, eta, a0 * soft**n, W), rel=1e-10)
    assert cp.filtrate_flow_washing(0.1, A, 1e5, eta, alpha, W, Rm) == pytest.approx(
        A * cp.filtrate_flux(0.1, A, 1e5, eta, alpha, W, Rm)
    )


def test_slurry_fractions_agree():
    rho, rhos, M = 1000.0, 2500.0, 0.3
    s = mb.solids_mass_fraction_mixed(M, 1e-3, rho)
    assert s == pytest.approx(mb.solids_mass_fraction_weighed(M, 1e-3 * rho + M), rel=1e-12)
    assert s == pytest.approx(mb.solids_mass_fraction_sampled(M, 1e-3 + M / rhos, rho, rhos), rel=1e-12)
    eps = 0.45
    # W from the balance of a slurry of 1 kg: solid s, filtrate = liquid less what the cake keeps
    m = mb.wet_to_dry_mass_ratio(eps, rho, rhos)
    filtrate = (1 - s - s * eps * rho / ((1 - eps) * rhos)) / rho
    assert mb.dry_cake_per_filtrate(s, rho, m) == pytest.approx(s / filtrate, rel=1e-12)
    assert rs.cake_permeability(1e10, eps, rhos) * 1e10 * (1 - eps) * rhos == pytest.approx(1.0)
    assert rs.cake_resistance_threshold(1e4, 1e10, 0.5, 2e4) == 1e10
