"""Pipe flow of power-law, Bingham and Herschel–Bulkley liquids: printed solutions, integrals, limits."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

import granum as gr

c = gr.conveying


def velocity_of(gradient, diameter, consistency, flow_index, yield_stress):
    """Mean velocity by integrating the shear rate over the section (Rabinowitsch)."""
    wall, radius = gradient * diameter / 4.0, diameter / 2.0

    def rate(r):
        over = max(wall * r / radius - yield_stress, 0.0)
        return (over / consistency) ** (1.0 / flow_index)

    core = radius * min(yield_stress / wall, 1.0)
    return quad(lambda r: r**2 * rate(r), core, radius, epsrel=1e-12)[0] / radius**2


@pytest.mark.parametrize("flow_index", [0.2, 0.45, 1.0, 1.6])
@pytest.mark.parametrize("yield_stress", [0.0, 0.3, 12.0, 400.0])
def test_laminar_flow_is_the_integral_over_the_section(flow_index, yield_stress):
    for velocity in (1e-3, 0.2, 4.0):
        gradient = float(c.pressure_gradient_herschel_bulkley(velocity, 0.08, 0.9, flow_index, yield_stress))
        assert velocity_of(gradient, 0.08, 0.9, flow_index, yield_stress) == pytest.approx(velocity, rel=1e-5)


def test_doubled_flow_of_a_power_law_liquid():
    # Coulson and Richardson, solutions to volume 1, problem 3.40: doubling the flow in a pipe of 70 mm raises
    # the pressure drop by half, so that n = 0.585
    single, double = (float(c.pressure_gradient_herschel_bulkley(v, 0.07, 3.0, 0.585)) for v in (0.5, 1.0))
    assert double / single == pytest.approx(1.5, abs=1e-3)


def test_the_paste_that_just_runs_out_of_an_upright_tube():
    # Coulson and Richardson, solutions to volume 1, problem 3.30: 2000 kg/m³ and 300 mm ask for 1472 N/m²
    held = float(c.pressure_gradient_herschel_bulkley(0.0, 0.3, 1.0, 1.0, 1472.0))
    assert held == pytest.approx(2000.0 * 9.81, rel=5e-4)


def test_buckingham_and_reiner_within_the_general_law():
    gradient = float(c.pressure_gradient_herschel_bulkley(0.6, 0.05, 0.03, 1.0, 9.0))
    x = 9.0 / (gradient * 0.05 / 4.0)
    by_hand = gradient * 0.05**2 / (32.0 * 0.03) * (1.0 - 4.0 * x / 3.0 + x**4 / 3.0)
    assert by_hand == pytest.approx(0.6, rel=1e-9)


def test_metzner_and_reed_make_laminar_flow_one_line():
    for n in (0.3, 0.7, 1.0, 1.4):
        re = float(c.reynolds_metzner_reed(0.4, 0.05, 1100.0, 2.0, n))
        gradient = float(c.pressure_gradient_herschel_bulkley(0.4, 0.05, 2.0, n))
        assert gradient * 2.0 * 0.05 / (1100.0 * 0.4**2) == pytest.approx(64.0 / re, rel=1e-9)
    # the same liquid, its viscosity told at another shear rate
    there = 2.0 * 10.0 ** (0.7 - 1.0)
    told = float(c.reynolds_metzner_reed(0.4, 0.05, 1100.0, there, 0.7, 10.0))
    assert told == pytest.approx(float(c.reynolds_metzner_reed(0.4, 0.05, 1100.0, 2.0, 0.7)), rel=1e-12)


def test_laminar_flow_ends_where_ryan_and_johnson_say():
    assert float(c.reynolds_critical_ryan_johnson(1.0)) == pytest.approx(2100.0, rel=1e-3)
    # 808 by the profile: the greatest of R ρ u (−du/dr)/τ_w, with u/V = (3n+1)/(n+1)(1 − s^(1+1/n))
    n = 0.6
    s = np.linspace(0.0, 1.0, 200001)
    u, slope = (3 * n + 1) / (n + 1) * (1 - s ** (1 + 1 / n)), (3 * n + 1) / n * s ** (1 / n)
    greatest = np.max(u * slope)
    # with τ_w = 8 ρ V²/Re that is Re·greatest/8
    assert float(c.reynolds_critical_ryan_johnson(n)) == pytest.approx(808.0 * 8.0 / greatest, rel=1e-3)


def test_turbulent_power_law():
    # n = 1: the smooth pipe of Nikuradse, f = 0.0180 at 1e5 (0.0045 after Fanning)
    assert float(c.friction_factor_dodge_metzner(1e5, 1.0)) == pytest.approx(0.0180, abs=5e-5)
    # recalled of Steffe and Singh's fourth case: 0.0051 after Fanning at 6736.6 with n = 0.45
    assert float(c.friction_factor_dodge_metzner(6736.6, 0.45)) / 4.0 == pytest.approx(0.0051, abs=1e-4)
    for re, n in ((3e3, 0.4), (1e4, 0.8), (5e4, 1.3)):
        fanning = brentq(
            lambda f, re=re, n=n: (
                f**-0.5 - 4.0 / n**0.75 * np.log10(re * f ** (1.0 - n / 2.0)) + 0.4 / n**1.2
            ),
            1e-5,
            0.5,
            xtol=1e-14,
        )
        assert float(c.friction_factor_dodge_metzner(re, n)) == pytest.approx(4.0 * fanning, rel=1e-8)
    thinner = [float(c.friction_factor_dodge_metzner(1e4, n)) for n in (0.4, 0.6, 0.8, 1.0)]
    assert thinner == sorted(thinner)


def test_bingham_by_another_program():
    # a public implementation of Darby's equations gives 0.01905007708620241 for 254 mm, 2.3 m/s, 1300 kg/m³,
    # 6 Pa and 20 mPa·s
    re, he = 0.254 * 2.3 * 1300.0 / 0.02, float(c.hedstrom_number(0.254, 1300.0, 6.0, 0.02))
    assert float(c.friction_factor_darby_melson(re, he)) == pytest.approx(0.01905007708620241, rel=1e-7)
    # laminar: Buckingham and Reiner, and far below the yield stress alone, f = 8 τ_y/(ρ v²)
    assert float(c.friction_factor_darby_melson(100.0, 0.0)) == pytest.approx(0.64, rel=1e-9)
    slow = float(c.pressure_gradient_bingham(1e-6, 0.1, 1200.0, 30.0, 0.02))
    assert slow == pytest.approx(4.0 * 30.0 / 0.1, rel=1e-2)
    faster = [float(c.pressure_gradient_bingham(v, 0.1, 1200.0, 30.0, 0.02)) for v in (0.1, 1.0, 3.0, 8.0)]
    assert faster == sorted(faster)


def test_pressure_of_a_power_law_liquid_turns_turbulent():
    def gradient(v):
        return float(c.pressure_gradient_power_law(v, 0.1, 1000.0, 0.05, 0.7))

    def reynolds(v):
        return float(c.reynolds_metzner_reed(v, 0.1, 1000.0, 0.05, 0.7))

    critical = float(c.reynolds_critical_ryan_johnson(0.7))
    turn = brentq(lambda v: reynolds(v) - critical, 0.01, 10.0)
    below, above = gradient(0.999 * turn), gradient(1.001 * turn)
    assert below == pytest.approx(64.0 / critical * 1000.0 * turn**2 / 0.2, rel=1e-2)
    assert above > 1.2 * below
