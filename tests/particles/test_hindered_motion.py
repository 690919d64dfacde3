"""Hindered settling, suspensions, walls, slip, drops and bubbles."""

import jax
import numpy as np
import pytest

from granum.core.registry import everything
from granum.particles.formulas import bubbles, hindered, slip, suspension, wall


def family(name):
    return {key: thing for key, thing in everything(("particles",)).items() if thing.card.family == name}


def test_khan_richardson_wall_by_hand():
    # Re = 50: C_D 1.55 by Clift, Grace and Weber, so Ar = 0.75 · 1.55 · 2500 = 2906; d/D = 0.05: 1 − 1.24 ·
    # 0.05^0.27 = 0.4478
    alone, walled = 0.043 * 2906**0.57, 0.043 * 2906**0.57 * 0.4478
    n = hindered.settling_exponent_khan_richardson
    assert n(50.0) == pytest.approx((4.8 + 2.4 * alone) / (1 + alone), abs=0.02)
    assert n(50.0, 0.05) == pytest.approx((4.8 + 2.4 * walled) / (1 + walled), abs=0.02)
    # the wall raises the exponent as Richardson and Zaki measured: there from 3.01 to 3.62
    assert 0.3 < n(50.0, 0.05) - n(50.0) < 0.7


PHI = np.linspace(0.01, 0.5, 8)


def test_richardson_zaki_exponents_as_printed():
    n = hindered.settling_exponent_richardson_zaki
    # Richardson and Zaki 1954: 4.65 + 19.5 d/D below Re 0.2; 4.35 Re^-0.03; 4.45 Re^-0.1; 2.39 above 500
    assert n(0.1) == 4.65
    assert n(0.1, 0.05) == pytest.approx(4.65 + 0.975)
    assert n(0.5) == pytest.approx(4.35 * 0.5**-0.03)
    assert n(50.0) == pytest.approx(4.45 * 50**-0.1)
    assert n(50.0, 0.05) == pytest.approx((4.45 + 0.9) * 50**-0.1)
    assert n(1000.0) == 2.39
    for other in (
        hindered.settling_exponent_garside_al_dibouni,
        hindered.settling_exponent_rowe,
        hindered.settling_exponent_khan_richardson,
        hindered.settling_exponent_maude_whitmore,
    ):
        low, high = float(other(1e-4)), float(other(3e5))
        assert 4.5 < low < 5.15
        assert 2.3 < high < 2.75
        values = np.asarray(other(np.geomspace(0.31, 3e5, 40)))
        assert np.all(np.diff(values) <= 1e-12)


@pytest.mark.parametrize("key", family("hindrance"))
def test_every_hindrance_law_slows_more_as_the_crowd_thickens(key):
    thing = family("hindrance")[key]
    found = thing() if isinstance(thing, type) else thing
    f = np.asarray(found(PHI, np.full_like(PHI, 0.01)))
    assert np.all(np.diff(f) <= 0)
    assert np.all((f < 1) & (f >= 0))
    assert float(found(1e-12, 0.01)) == pytest.approx(1.0, abs=2e-4)
    assert np.isfinite(float(jax.grad(lambda p: found(p, 0.01))(0.2)))


def test_limits_and_worked_values():
    # Barnea and Mizrahi: creeping closed form, and the square root of the density ratio in turbulent flow
    phi = 0.2
    creeping = (1 - phi) / ((1 + phi ** (1 / 3)) * np.exp(5 * phi / (3 * (1 - phi))))
    assert hindered.hindrance_barnea_mizrahi(phi, 1e-10) == pytest.approx(creeping, rel=1e-4)
    assert hindered.hindrance_barnea_mizrahi(phi, 1e12) == pytest.approx(
        np.sqrt((1 - phi) / (1 + phi ** (1 / 3))), rel=1e-4
    )
    # Happel's cell for φ = 0.125 (γ = 0.5) by hand: (3 − 2.25 + 0.140625 − 0.046875)/3.0625
    assert hindered.hindrance_happel(0.125, 0.01) == pytest.approx(0.84375 / 3.0625)
    # Batchelor against the slope of dilute limits: Richardson–Zaki 4.65, below 6.55
    assert hindered.hindrance_batchelor(0.01, 0.01) == pytest.approx(0.9345)
    # Steinour's factor at ε = 0.7
    assert hindered.hindrance_steinour(0.3, 0.01) == pytest.approx(0.49 * 10 ** (-0.546))
    assert hindered.RichardsonZaki(exponent=4.65)(0.1, 5.0) == pytest.approx(0.9**4.65)
    assert hindered.RichardsonZaki()(0.1, 50.0) == pytest.approx(
        hindered.hindrance_richardson_zaki(0.1, 50.0)
    )


def test_apparent_properties_and_the_courses_collective_velocity():
    assert suspension.suspension_density(2650, 1000, 0.1) == pytest.approx(1165)
    assert suspension.relative_viscosity_einstein(0.02) == pytest.approx(1.05)
    assert suspension.relative_viscosity_vand(0.1, 6.0) == pytest.approx(np.exp(0.6))
    # the course's last form, exp(4.2 β/(1 − β)): k = 4.2 and q → 1
    assert suspension.relative_viscosity_mooney(0.2, 4.2, 0.999999999) == pytest.approx(
        np.exp(4.2 * 0.2 / 0.8), rel=1e-6
    )
    for key, f in family("relative_viscosity").items():  # all laws share Einstein's slope
        assert float(jax.grad(lambda p, f=f: f(p))(1e-9)) == pytest.approx(2.5, abs=0.06), key
    # creeping, dilute: U_c/U = (1 − β) exp(−2.5 β/(1 − q β))
    beta = 0.05
    found = suspension.hindrance_apparent_medium(beta, 0.01)
    assert found == pytest.approx((1 - beta) * np.exp(-2.5 * beta / (1 - beta / 0.74)))
    # Newton: (U_c/U)² = (1 − β)/(ρ_a/ρ_c)
    assert suspension.hindrance_apparent_medium(0.1, 1e4, 0.0, 2.65) == pytest.approx(np.sqrt(0.9 / 1.165))
    tiny = {
        "particle_diameter": 5e-6,
        "particle_density": 2650,
        "fluid_density": 1000,
        "dynamic_viscosity": 1e-3,
    }
    single = 9.80665 * 25e-12 * 1650 / 18e-3
    assert suspension.terminal_velocity_collective(
        solids_volume_fraction=beta, **tiny
    ) / single == pytest.approx(found, rel=2e-3)


def test_dilution_form_is_stokes_in_the_apparent_medium():
    D, limit, nu = 3e-3, 3e-4, 1e-6
    found = suspension.diluted_suspension(2e-5, 2650, 1000, nu, D, limit, 9.81)
    assert found.density == pytest.approx((D * 1000 + 1) / (D + 1 / 2650))
    assert found.kinematic_viscosity == pytest.approx(nu * (D + 1 / 2650) / (D - limit))
    printed_but_for_the_bracket = 0.545 * 1650 * (D - limit) * 4e-10 / ((1 / D + 1000) * (D + 1 / 2650) * nu)
    assert found.terminal_velocity == pytest.approx(printed_but_for_the_bracket, rel=1e-3)
    # infinitely diluted: a single particle
    alone = suspension.diluted_suspension(2e-5, 2650, 1000, nu, 1e6, limit, 9.81).terminal_velocity
    assert alone == pytest.approx(9.81 * 4e-10 * 1.65 / (18 * nu), rel=1e-6)


def test_wall_factors_against_exact_theory():
    # Haberman and Sayre's exact drag factors, Happel and Brenner (1973) table 7-3.1
    exact = {0.1: 1.263, 0.2: 1.680, 0.3: 2.371, 0.4: 3.596, 0.5: 5.970}
    for ratio, drag in exact.items():
        assert wall.wall_factor_haberman_sayre(ratio) == pytest.approx(1 / drag, rel=0.02)
        assert wall.wall_factor_francis(ratio) == pytest.approx(1 / drag, rel=0.11)
    assert wall.wall_factor_faxen(0.1) == pytest.approx(1 / 1.263, rel=2e-3)
    assert wall.wall_factor_ladenburg(0.01) == pytest.approx(1 / 1.024)
    assert wall.wall_factor_francis_power(0.1) == pytest.approx(0.9**2.25)
    assert wall.wall_factor_munroe(0.25) == pytest.approx(1 - 0.125)
    assert wall.wall_factor_di_felice(0.2, 1e-9) == pytest.approx((0.8 / 0.934) ** 3.3)
    assert wall.wall_factor_di_felice(0.2, 1e9) == pytest.approx((0.8 / 0.934) ** 0.85)
    # Kehlenbeck and Di Felice: the two branches of p meet at Re = 35
    low, high = (wall.wall_factor_kehlenbeck_di_felice(0.4, Re) for Re in (34.999, 35.001))
    assert low == pytest.approx(high, rel=2e-3)
    for key, f in family("wall_factor").items():
        values = np.asarray(f(np.array([1e-6, 0.1, 0.3]), np.full(3, 0.1)))
        assert values[0] == pytest.approx(1.0, abs=1e-4), key
        assert np.all(np.diff(values) < 0), key


def test_slip_and_brownian_motion_of_hinds_tables():
    # Hinds 1999, table A11, unit density in air at 293 K: Cc, settling velocity and diffusivity
    table = {
        1e-7: (2.93, 8.8e-7, 6.94e-10),
        1e-6: (1.155, 3.48e-5, 2.74e-11),
        1e-5: (1.015, 3.06e-3, 2.41e-12),
    }
    for d, (factor, velocity, diffusivity) in table.items():
        knudsen = 2 * 66e-9 / d
        # Hinds' own fit is 1 + (15.60 + 7.00 exp(−0.059 P d))/(P d), P in kPa and d in µm; Davies' constants
        # are nearest to it
        Pd = 101.3 * d * 1e6
        assert factor == pytest.approx(1 + (15.60 + 7.00 * np.exp(-0.059 * Pd)) / Pd, rel=5e-3)
        assert slip.slip_factor_davies(knudsen) == pytest.approx(factor, rel=0.02)
        # other materials: 2.5 and 3.2 % less at 0.1 µm
        for slip_law in (slip.slip_factor_allen_raabe, slip.slip_factor_kim):
            assert slip_law(knudsen) == pytest.approx(factor, rel=0.035 if d < 5e-7 else 0.015)
        v = slip.terminal_velocity_slip(d, 1000.0, 1.2, 1.81e-5, 66e-9)
        assert v == pytest.approx(velocity, rel=0.03)
        assert slip.brownian_diffusivity(
            d, 293.15, 1.81e-5, slip.slip_factor_davies(knudsen)
        ) == pytest.approx(diffusivity, rel=0.03)
    assert slip.mean_free_path(293.15, 101325.0, 1.81e-5, 0.02896) == pytest.approx(66e-9, rel=0.03)
    # at the limit diameter the two displacements are equal by definition
    d = slip.brownian_diameter(293.15, 2650.0, 998.0, 1e-3, 60.0)
    settled = 9.80665 * 1652 * d**2 / 18e-3 * 60.0
    assert slip.brownian_displacement(slip.brownian_diffusivity(d, 293.15, 1e-3), 60.0) == pytest.approx(
        settled
    )


def test_hadamard_factor_of_mist_and_bubbles():
    assert bubbles.hadamard_factor(dispersed_viscosity=1e-3, dynamic_viscosity=1.8e-5) == pytest.approx(
        1.0, abs=0.01
    )
    assert bubbles.hadamard_factor(dispersed_viscosity=1.8e-5, dynamic_viscosity=1e-3) == pytest.approx(
        1.5, abs=0.015
    )
    assert bubbles.hadamard_factor(dispersed_viscosity=1e-3, dynamic_viscosity=1e-3) == pytest.approx(6 / 5)
    v = bubbles.terminal_velocity_hadamard_rybczynski(5e-5, 1.2, 998.0, 1e-3, 1e-12)
    assert v == pytest.approx(-9.80665 * 996.8 * 2.5e-9 / 12e-3)  # g Δρ d²/(12 η) of an inviscid bubble


def test_bubbles_and_drops():
    air = {"particle_density": 1.2, "fluid_density": 998.0, "surface_tension": 0.0728}
    # tap water: 20 to 25 cm/s between 2 and 8 mm (Clift, Grace and Weber, figure 7.3)
    for d in (3e-3, 5e-3, 8e-3):
        assert (
            0.18 < -bubbles.terminal_velocity_grace(d, dynamic_viscosity=1e-3, **air).terminal_velocity < 0.27
        )
    # Mendelson's minimum lies at d = 2 √(σ/(g ρ)) = 5.45 mm with 0.231 m/s
    at = 2 * np.sqrt(0.0728 / (9.80665 * 998))
    slope = jax.grad(lambda d: bubbles.terminal_velocity_mendelson(d, **{**air, "particle_density": 1e-9}))(
        at
    )
    assert abs(slope) < 1e-9
    # Davies and Taylor: (2/3)√(g R) of a cap whose volume-equivalent diameter fits; 20 mm rises at 31 cm/s
    assert bubbles.terminal_velocity_davies_taylor(2e-2, 1.2, 998.0) == pytest.approx(-0.315, abs=0.002)
    # Clift: water drops in air break up near 10 mm; the air–water sphere ends between 1 and 2 mm (course:
    # about 1 mm)
    assert 0.9e-2 < bubbles.stable_diameter_limit(998.0, 1.2, 0.0728) < 1.2e-2
    limit = bubbles.spherical_diameter_limit(1.2, 998.0, 0.0728)
    assert 1e-3 < limit < 2e-3
    assert bubbles.eotvos_number(limit, **air) == pytest.approx(0.4)
    # water at 20 °C: M = 2.5e-11 (Clift, Grace and Weber, p. 27)
    assert bubbles.morton_number(dynamic_viscosity=1e-3, **air) == pytest.approx(2.5e-11, rel=0.03)
    # the two branches of J meet at H = 59.3
    assert pytest.approx(3.42 * 59.3**0.441, rel=3e-3) == 0.94 * 59.3**0.757
