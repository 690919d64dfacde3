"""Cycle optimum, pump curve and cake profiles against independent numerical solutions; depth, gas and
membrane filters by hand.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq, minimize_scalar

from granum.filtration.formulas import compressible as co
from granum.filtration.formulas import cycle as cy
from granum.filtration.formulas import depth as de
from granum.filtration.formulas import gas_filters as ga
from granum.filtration.formulas import membranes as me
from granum.filtration.formulas.constant_pressure import filtration_time_constant_pressure

CASE = {
    "area": 12.0,
    "pressure_drop": 3e5,
    "dynamic_viscosity": 1e-3,
    "cake_resistance": 5e10,
    "dry_cake_per_filtrate": 30.0,
    "medium_resistance": 8e10,
}


@pytest.mark.parametrize(("wash", "cost"), [(0.0, 1.0), (0.8, 1.0), (0.8, 2.5)])
def test_best_cycle_is_the_best_of_all(wash, cost):
    best = cy.filtration_cycle(**CASE, dead_time=1500, wash_time_ratio=wash, dead_cost_ratio=cost)
    bare = {**CASE, "medium_resistance": 0.0}

    def price(V):
        running = float(filtration_time_constant_pressure(V, **CASE)) + wash * float(
            filtration_time_constant_pressure(V, **bare)
        )
        return (running + cost * 1500) / V

    found = minimize_scalar(price, bounds=(0.1, 50), method="bounded", options={"xatol": 1e-9})
    assert best.filtrate_volume == pytest.approx(found.x, rel=1e-6)
    assert best.cycle_time == pytest.approx(best.filtration_time + best.wash_time + 1500)
    assert best.dry_cake_mass == pytest.approx(30 * best.filtrate_volume)


def test_v_opt_of_the_notes_and_equal_times_without_medium():
    case = {**CASE, "medium_resistance": 0.0}
    a = 2 * 3e5 * 144 / (1e-3 * 5e10 * 30)
    best = cy.filtration_cycle(**case, dead_time=900)
    assert best.filtrate_volume == pytest.approx(np.sqrt(a * 900), rel=1e-12)
    assert cy.filtrate_volume_optimum(a, 900) == pytest.approx(best.filtrate_volume, rel=1e-12)
    assert best.filtration_time == pytest.approx(900, rel=1e-12)


def test_many_cycles_at_once_are_those_of_one_by_one():
    dead = np.linspace(100, 5000, 1000)
    flows = np.asarray(cy.filtration_cycle(**CASE, dead_time=dead).mean_filtrate_flow)
    assert flows[17] == pytest.approx(
        cy.filtration_cycle(**CASE, dead_time=float(dead[17])).mean_filtrate_flow, rel=1e-12
    )
    assert np.all(np.diff(flows) < 0)  # time lost is filtrate lost


def test_pump_curve_against_quadrature():
    pm, qm, A, eta, alpha, W, R = 4e5, 5e-3, 8.0, 1.2e-3, 6e10, 25.0, 9e10

    def slowness(V):
        r = eta / A * (alpha * W * V / A + R)
        return 1.0 / brentq(lambda q: pm * (1 - (q / qm) ** 2) - r * q, 0, qm, xtol=1e-18, rtol=1e-14)

    expected, _err = quad(slowness, 0, 3.0, epsrel=1e-11)
    assert cy.filtration_time_pump(3.0, A, pm, qm, eta, alpha, W, R) == pytest.approx(expected, rel=1e-9)
    # a very large pump holds its shutoff pressure
    wide = cy.filtration_time_pump(3.0, A, pm, 1e4, eta, alpha, W, R)
    assert wide == pytest.approx(filtration_time_constant_pressure(3.0, A, pm, eta, alpha, W, R), rel=1e-6)


@pytest.mark.parametrize(("n", "b"), [(0.4, 0.05), (0.95, 0.05), (1.0, 0.0), (1.3, 0.1)])
def test_compressible_cake_against_quadrature(n, b):
    P, pa, a0, e0 = 4e5, 1.2e4, 3e10, 0.75
    flow, _e = quad(lambda p: 1 / (a0 * (1 + p / pa) ** n), 0, P, epsrel=1e-12)
    height, _e = quad(lambda p: 1 / (a0 * (1 - e0) * (1 + p / pa) ** (n + b)), 0, P, epsrel=1e-12)
    assert co.cake_resistance_tiller(P, a0, n, pa) == pytest.approx(P / flow, rel=1e-6)
    assert co.void_fraction_mean_tiller(P, e0, n, b, pa) == pytest.approx(1 - flow / height, rel=1e-6)
    z = np.array([0.0, 0.2, 0.5, 0.9, 1.0])
    profile = co.cake_profile(z, P, a0, e0, n, b, pa)
    for zi, pg in zip(z, np.asarray(profile.solids_pressure), strict=True):
        below, _e = quad(lambda p: 1 / (a0 * (1 - e0) * (1 + p / pa) ** (n + b)), 0, pg, epsrel=1e-12)
        assert 1 - below / height == pytest.approx(zi, abs=2e-6)
    np.testing.assert_allclose(np.asarray(profile.liquid_pressure) + np.asarray(profile.solids_pressure), P)
    assert np.all(np.diff(np.asarray(profile.void_fraction_local)) >= 0)


def test_power_law_cake_is_the_far_limit_of_tillers():
    n = 0.5
    power = co.cake_resistance_local_power(4e5, 1e10, n, 1e5)
    assert power == pytest.approx(4e5 / quad(lambda p: 1 / (1e10 * (p / 1e5) ** n), 0, 4e5)[0], rel=1e-8)
    assert co.cake_resistance_tiller(4e5, 1e10 * 1e-6**n, n, 1e-1) == pytest.approx(power, rel=2e-3)
    assert co.cake_resistance_tiller(4e5, 1e10, 0.0, 1e4) == pytest.approx(1e10)


def test_deep_bed_balances():
    c0, lam, L, u, t = 0.02, 6.0, 1.0, 2e-3, 5e4
    held, _e = quad(lambda z: float(de.specific_deposit_iwasaki(c0, lam, z, u, t)), 0, L)
    passed = u * t * de.concentration_iwasaki(c0, lam, L)
    assert held + passed == pytest.approx(u * t * c0, rel=1e-9)
    K, H0 = 0.6, 0.4
    assert de.head_loss_deep_bed(H0, K, c0, lam, L, u, t) == pytest.approx(H0 + K * held, rel=1e-9)
    run = de.run_time_deep_bed(2.0, H0, K, c0, lam, L, u)
    assert de.head_loss_deep_bed(H0, K, c0, lam, L, u, run) == pytest.approx(2.0)
    # Carman-Kozeny head of 1 m of sand: 180 η u (1-ε)² / (ρ g d² ε³)
    assert de.head_loss_clean_bed(1.0, 6e-4, 2e-3, 0.4, 1e-3, 1000.0) == pytest.approx(
        180e-6 * 2 * 0.36 / (9806.65 * 36e-8 * 0.064), rel=1e-9
    )


def test_single_collector_has_its_minimum_near_a_micrometer():
    d = np.geomspace(1e-8, 2e-5, 60)
    eta = np.asarray(de.collector_efficiency_tufenkji(d, 5e-4, 1e-3, 0.38, 1050, 998, 1e-3))
    assert 3e-7 < d[np.argmin(eta)] < 3e-6
    # dimensionless groups worked out one by one for 1 µm on 0.6 mm at 2 mm/s and 20 °C: 3.492e-4 + 1.808e-4 +
    # 4.4e-6
    assert de.collector_efficiency_tufenkji(
        "1 um", "0.6 mm", "2 mm/s", 0.4, 1050, 998, 1e-3
    ) == pytest.approx(5.344e-4, rel=1e-3)
    assert de.filter_coefficient(5.344e-4, 6e-4, 0.4) == pytest.approx(1.5 * 0.6 * 5.344e-4 / 6e-4)


def test_gas_filters_and_membranes_by_hand():
    assert ga.pressure_drop_fibers(1e-3, 2e-6, 0.05, 0.05, 1.8e-5) == pytest.approx(162.12, rel=1e-4)
    two, one = (ga.penetration_fibers(x, 2e-6, 0.05, 0.1) for x in (2e-3, 1e-3))
    assert two == pytest.approx(one**2)
    assert ga.pressure_drop_dust_cake(0.02, 0.01, 0.0, 2e4, 6e4) == pytest.approx(400)
    assert me.filtrate_flux_membrane(1e5, 1e-3, 2e12, osmotic_pressure=2e4) == pytest.approx(4e-5)
    assert me.filtrate_flux_membrane(1e4, 1e-3, 2e12, osmotic_pressure=2e4) == 0.0
    assert me.filtrate_flux_limiting(1e-5, 300, 300) == 0.0
    # batch: c V = loss through the membrane: dc/dV = -R c/V
    assert me.concentration_retentate_batch(10, 5, 0.8) == pytest.approx(10 * 5**0.8)
    assert me.filtration_area_membrane(1e-3, 2e-5) == pytest.approx(50)
    # solution and diffusion: solute carried off by the permeate, J c_p, is what diffuses through, B (c - c_p)
    flux = me.filtrate_flux_permeance(3e6, 1e-11, me.osmotic_pressure(100.0, 2.0, 300.0))
    assert flux == pytest.approx(1e-11 * (3e6 - 2 * 100.0 * 8.314462618 * 300.0))
    passed = 1.0 - me.rejection_solution_diffusion(flux, 1e-6)
    assert flux * passed == pytest.approx(1e-6 * (1.0 - passed))


def test_a_pressure_below_the_osmotic_one_is_told():
    found = me.filtrate_flux_permeance.evaluate(5e5, 5e-12, 30e5)
    assert found.value == 0.0
    assert "osmotic" in found.notices[0]["message"]
