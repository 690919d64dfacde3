"""Power-law liquids through beds: the capillaries of Blake and Kozeny, by quadrature."""

from __future__ import annotations

import jax
import numpy as np
import pytest
from scipy.integrate import quad

import granum as gr

viscosity = gr.porous.dynamic_viscosity_bed_christopher_middleman


def capillaries(velocity: float, diameter: float, void: float, consistency: float, n: float) -> float:
    """Pressure gradient of a bundle of tubes of the hydraulic diameter, 25/12 of the bed in length, from the
    stress of a power law: the flow of a tube is the integral of r² times its shear rate.
    """
    tube = 2.0 * void * diameter / (3.0 * (1.0 - void))
    # mean velocity for a wall stress of K: 4 v/(π D³) of the radial integral, then scaled by τ^(1/n)
    share, _error = quad(lambda x: x**2 * x ** (1.0 / n), 0.0, 1.0)
    unit = tube / 2.0 * share
    wall = consistency * (velocity / void / unit) ** n
    return 25.0 / 12.0 * 4.0 * wall / tube


@pytest.mark.parametrize("n", [0.3, 0.6, 1.0, 1.4])
def test_bundle_of_capillaries(n: float) -> None:
    U, d, e, K = 2e-3, 8e-4, 0.42, 0.7
    eta = viscosity(U, d, e, K, n)
    gradient = gr.porous.pressure_gradient_blake_kozeny(U, d, e, 1000.0, eta)
    assert gradient == pytest.approx(capillaries(U, d, e, K, n), rel=1e-9)


def test_newton_whatever_the_bed() -> None:
    draws = np.random.default_rng(2).random((100, 3))
    given = (10.0 ** (-5.0 + 3.0 * draws[:, 0]), 10.0 ** (-5.0 + 3.0 * draws[:, 1]), 0.2 + 0.6 * draws[:, 2])
    found = jax.jit(jax.vmap(lambda U, d, e: viscosity.function(U, d, e, 0.3, 1.0)))(*given)
    np.testing.assert_allclose(found, 0.3, rtol=1e-12)


def test_gradient_grows_with_the_power_of_the_velocity() -> None:
    slow, fast = (
        gr.porous.pressure_gradient_blake_kozeny(U, 1e-3, 0.4, 1000.0, viscosity(U, 1e-3, 0.4, 1.0, 0.5))
        for U in (1e-3, 4e-3)
    )
    assert fast / slow == pytest.approx(2.0)


def test_another_reference_rate_tells_the_same_liquid() -> None:
    """1 Pa s at 1 s⁻¹ with n = 0.5 is 0.1 Pa s at 100 s⁻¹."""
    one = viscosity(1e-3, 1e-3, 0.4, 1.0, 0.5)
    assert viscosity(1e-3, 1e-3, 0.4, 0.1, 0.5, reference_shear_rate=100.0) == pytest.approx(one)


def bingham_capillaries(gradient: float, d: float, e: float, plastic: float, tau: float) -> float:
    """Velocity of a Bingham liquid in the same tubes, from the integral of its shear rate over the radius."""
    tube = 2.0 * e * d / (3.0 * (1.0 - e))
    wall = gradient / (25.0 / 12.0) * tube / 4.0
    integral, _error = quad(lambda x: x**2 * (x * wall - tau), tau / wall, 1.0)
    return e * tube / 2.0 * integral / plastic


@pytest.mark.parametrize("times", [1.01, 2.0, 30.0])
def test_bundle_of_capillaries_with_a_yield_stress(times: float) -> None:
    d, e, plastic, tau = 8e-4, 0.42, 0.03, 3.0
    gradient = times * gr.porous.pressure_gradient_yield_bed(d, e, tau)
    velocity = gr.porous.superficial_velocity_bed_bingham(gradient, d, e, plastic, tau)
    assert velocity == pytest.approx(bingham_capillaries(gradient, d, e, plastic, tau), rel=1e-7)


def test_a_yield_stress_stops_the_liquid_and_none_is_darcy() -> None:
    at = {"particle_diameter": 1e-3, "void_fraction": 0.4, "plastic_viscosity": 0.02}
    least = gr.porous.pressure_gradient_yield_bed(1e-3, 0.4, 2.0)
    assert gr.porous.superficial_velocity_bed_bingham(0.999 * least, yield_stress=2.0, **at) == 0.0
    free = gr.porous.superficial_velocity_bed_bingham(1e5, yield_stress=0.0, **at)
    assert gr.porous.pressure_gradient_blake_kozeny(free, 1e-3, 0.4, 1000.0, 0.02) == pytest.approx(1e5)
    assert gr.porous.superficial_velocity_bed_bingham(-1e5, yield_stress=0.0, **at) == pytest.approx(-free)


@pytest.mark.parametrize("n", [0.4, 1.0, 1.3])
def test_a_known_permeability_tells_the_same_as_the_grains(n: float) -> None:
    permeability = gr.porous.permeability_blake_kozeny(5e-4, 0.45)
    known = gr.porous.dynamic_viscosity_permeable_christopher_middleman(3e-4, permeability, 0.45, 0.8, n)
    assert known == pytest.approx(viscosity(3e-4, 5e-4, 0.45, 0.8, n), rel=1e-12)
