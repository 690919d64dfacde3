"""Spheres in power-law, Bingham and Herschel–Bulkley liquids."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.optimize import brentq

import granum as gr
from granum.core.errors import ApplicabilityError, InputError

P = gr.particles
HANKS = (3.178, -0.7456, -0.04684, 0.05455, -0.01796, 2.4619e-3, -1.1418e-4)
N = np.array([0.6, 0.7, 0.8, 0.9, 1.2, 1.4])


def creeping(n: np.ndarray) -> np.ndarray:
    """Drag in creeping flow over Stokes' law at the shear rate v/d."""
    return np.asarray(P.drag_coefficient_renaud.function(1e-7, n)) * 1e-7 / 24.0


def stokes_field_in_a_power_law(n: np.ndarray) -> np.ndarray:
    """What a sphere would dissipate if the liquid moved as Newton's, over 3π: never less than it does, since
    the velocities of a power law make this least. A sphere of unit diameter and velocity.
    """
    x, w = np.polynomial.legendre.leggauss(200)
    inverse, a = (x + 1.0)[:, None] / 2.0, 0.5
    r, c = a / inverse, x[None, :]
    along = c * (1.5 * a / r**2 - 1.5 * a**3 / r**4)
    around = c / r * (-0.75 * a / r + 0.75 * a**3 / r**3)
    rate = 2.0 * (along**2 + 2.0 * around**2) + (1.5 * a**3 / r**4) ** 2 * (1.0 - c**2)
    volume = 2.0 * np.pi * r**2 * a / inverse**2 * w[:, None] / 2.0 * w[None, :]
    return np.array([(rate ** ((p + 1.0) / 2.0) * volume).sum() for p in n]) / (3.0 * np.pi)


def test_creeping_drag_lies_below_that_of_the_field_of_stokes() -> None:
    most = stokes_field_in_a_power_law(np.append(N, 1.0))
    assert most[-1] == pytest.approx(1.0, rel=1e-10)
    assert np.all(creeping(N) < most[:-1])


def test_thinning_adds_46_percent_at_most_to_stokes_drag() -> None:
    """Coulson and Richardson's Particle Technology says so below its table of this factor."""
    assert creeping(np.linspace(0.1, 1.0, 91)).max() == pytest.approx(1.46, abs=0.005)


def test_newton_is_the_standard_drag_curve() -> None:
    Re = np.geomspace(0.01, 1000.0, 50)
    found = P.drag_coefficient_renaud.function(Re, 1.0)
    np.testing.assert_allclose(found, P.drag_coefficient_brown_lawler.function(Re), rtol=0.1)


def test_creeping_fall_in_a_power_law_by_hand() -> None:
    """18 K X (v/d)ⁿ = g d Δρ, small enough that inertia is nothing."""
    d, excess, K = 1e-4, 1500.0, 2.0
    found = P.terminal_velocity_renaud.function(d, 1000.0 + excess, 1000.0, K, N)
    by_hand = d * (9.80665 * d * excess / (18.0 * K * creeping(N))) ** (1.0 / N)
    np.testing.assert_allclose(found, by_hand, rtol=5e-4)


def test_fall_is_the_balance_of_weight_and_drag_and_rises_alike() -> None:
    draws = np.random.default_rng(3).random((300, 5))
    d = 10.0 ** (-4.0 + 2.5 * draws[:, 0])
    rho = 800.0 + 700.0 * draws[:, 1]
    excess = 10.0 ** (1.0 + 2.8 * draws[:, 2])
    K, n = 10.0 ** (-3.0 + 4.0 * draws[:, 3]), 0.3 + 0.7 * draws[:, 4]
    fall = jax.jit(jax.vmap(P.terminal_velocity_renaud.function))
    v = np.asarray(fall(d, rho + excess, rho, K, n))
    C = P.drag_coefficient_renaud.function(rho * v ** (2.0 - n) * d**n / K, n)
    np.testing.assert_allclose(C * rho * v**2, 4.0 / 3.0 * 9.80665 * d * excess, rtol=1e-8)
    light = np.asarray(fall(d[:20], rho[:20] - 9.0, rho[:20], K[:20], n[:20]))
    np.testing.assert_allclose(light, -np.asarray(fall(d[:20], rho[:20] + 9.0, rho[:20], K[:20], n[:20])))


def hanks(q: np.ndarray) -> np.ndarray:
    """Drag of spheres in Bingham liquids, equations 166 to 168 of Hanks."""
    x = np.log(q)
    return np.where(q <= 1.0, 24.0 / q, np.exp(sum(c * x**i for i, c in enumerate(HANKS))))


def test_bingham_fall_meets_the_drag_curve_of_hanks() -> None:
    d, rho, eta, tau = 5e-3, 1200.0, np.geomspace(0.01, 1.0, 12), np.linspace(0.1, 10.0, 12)
    v = np.asarray(P.terminal_velocity_ansley_smith.function(d, 7850.0, rho, eta, tau))
    Re, He = rho * v * d / eta, rho * d**2 * tau / eta**2
    Q = Re**2 / (Re + 7.0 * np.pi / 24.0 * He)
    assert Q.min() < 3.0
    assert Q.max() > 300.0
    needed = 4.0 * 9.80665 * d * (7850.0 - rho) / (3.0 * rho * v**2)
    np.testing.assert_allclose(needed, hanks(Q), rtol=0.18)  # the default drag is that of Newton's liquids


def test_bingham_fall_with_the_drag_curve_of_hanks_is_that_of_his_equations() -> None:
    """Equation 165 says with which number to enter his curve."""
    d, rho, eta, tau = 5e-3, 1200.0, 0.05, 5.0

    def curve(q):
        return jnp.where(q <= 1.0, 24.0 / q, jnp.exp(sum(c * jnp.log(q) ** i for i, c in enumerate(HANKS))))

    v = float(P.terminal_velocity_ansley_smith.function(d, 7850.0, rho, eta, tau, drag=curve))
    by_hand = brentq(
        lambda v: (
            4.0 * 9.80665 * d * 6650.0 / (3.0 * rho * v**2)
            - hanks(rho * v**2 / (eta * v / d + 7.0 * np.pi / 24.0 * tau))
        ),
        0.01,
        5.0,
        xtol=1e-14,
    )
    assert v == pytest.approx(by_hand, rel=1e-9)


def test_held_where_the_yield_stress_carries_the_weight() -> None:
    """Beris and others: no fall from 2 π R² τ = 0.143 F on; Ansley and Smith: from 4/(21 π) g d Δρ."""
    tau = P.yield_stress_beris("5 mm", 2650.0, 1000.0)
    weight = 4.0 / 3.0 * np.pi * 2.5e-3**3 * 1650.0 * 9.80665
    assert 2.0 * np.pi * 2.5e-3**2 * tau == pytest.approx(0.143 * weight)
    least = 4.0 / (21.0 * np.pi) * 9.80665 * 5e-3 * 1650.0
    fall = P.terminal_velocity_ansley_smith.function
    v = np.asarray(fall(5e-3, 2650.0, 1000.0, 0.02, least * np.array([0.0, 0.5, 0.9, 0.999, 1.001, 2.0])))
    assert np.all(np.diff(v[:5]) < 0.0)
    assert np.all(v[4:] == 0.0)
    found = P.terminal_velocity_ansley_smith.evaluate("5 mm", 2650.0, 1000.0, "20 cP", 1.001 * least)
    assert "holds the particle" in found.as_json()["flags"][0]["message"]


def test_without_yield_stress_it_is_newtons_fall_and_rising_drops_are_held_too() -> None:
    fall = P.terminal_velocity_ansley_smith
    newton = P.terminal_velocity("2 mm", 2650.0, 1000.0, "20 cP")
    assert fall("2 mm", 2650.0, 1000.0, "20 cP", 0.0) == pytest.approx(newton, rel=1e-9)
    assert fall("2 mm", 900.0, 1000.0, "20 cP", 0.02) < 0.0
    assert fall("2 mm", 900.0, 1000.0, "20 cP", 0.2) == 0.0


def test_another_reference_rate_tells_the_same_liquid() -> None:
    """1 Pa s at 1 s⁻¹ with n = 0.5 is 0.1 Pa s at 100 s⁻¹."""
    one, other = ({"consistency": 1.0}, {"consistency": 0.1, "reference_shear_rate": 100.0})
    at = {"particle_diameter": 3e-3, "fluid_density": 1000.0, "flow_index": 0.5}
    for card, more in (
        (P.reynolds_number_power_law, {"velocity": 0.02}),
        (P.terminal_velocity_renaud, {"particle_density": 2650.0}),
        (P.terminal_velocity_ansley_smith, {"particle_density": 2650.0, "yield_stress": 0.5}),
    ):
        assert card(**at, **more, **one) == pytest.approx(card(**at, **more, **other), rel=1e-9)


@pytest.mark.parametrize(
    ("name", "value"), [("flow_index", 0.0), ("consistency", -1.0), ("yield_stress", -2)]
)
def test_what_is_no_liquid_is_refused(name: str, value: float) -> None:
    given = {"consistency": 1.0, "flow_index": 0.7, "yield_stress": 0.1} | {name: value}
    with pytest.raises((InputError, ApplicabilityError), match=name.split("_")[0]):
        P.terminal_velocity_ansley_smith("3 mm", 2650.0, 1000.0, **given)
