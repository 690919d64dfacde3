"""Unsteady fall and trajectories against SciPy, closed forms and conservation."""

import jax
import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from granum.core.errors import ApplicabilityError
from granum.particles.formulas import drag, drag_modern
from granum.particles.formulas.trajectories import (
    settling_distance,
    settling_distance_stokes,
    trajectory,
    trajectory_stokes,
)
from granum.particles.formulas.unsteady import (
    approach_to_terminal,
    fall_newton,
    fall_stokes,
    relaxation_time,
    stopping_distance,
)

G = 9.80665


def brown_lawler(Re):
    return 24 / Re * (1 + 0.150 * Re**0.681) + 0.407 / (1 + 8710 / Re)


def reference(d, rp, rf, eta, times, vx, vy, u, added):
    """The equations of motion written again and solved by SciPy."""

    def rates(_t, s):
        w = np.array([s[2] - u, s[3]])
        speed = max(np.hypot(*w), 1e-14)
        k = 0.75 * rf / ((rp + added * rf) * d) * brown_lawler(speed * d * rf / eta) * speed
        return [s[2], s[3], -k * w[0], (rp - rf) / (rp + added * rf) * G - k * w[1]]

    return solve_ivp(
        rates, (0, times[-1]), [0, 0, vx, vy], method="LSODA", t_eval=times, rtol=1e-10, atol=1e-13
    ).y.T


@pytest.mark.parametrize(
    "case",
    [
        (1e-3, 2650.0, 1000.0, 1e-3, 0.3, 1.0, -0.5, 0.1, 0.5),
        (1e-2, 2650.0, 1.2, 1.8e-5, 4.0, 20.0, -20.0, 0.0, 0.0),
        (1e-2, 500.0, 1000.0, 1e-3, 1.0, 1.0, 0.0, 0.0, 0.5),
        (2e-5, 2650.0, 1.2, 1.8e-5, 0.05, 5.0, 0.0, 1.0, 0.0),
    ],
)
def test_trajectory_against_scipy(case):
    d, rp, rf, eta, end, vx, vy, u, added = case
    times = np.linspace(0, end, 7)
    path = trajectory(d, rp, rf, eta, times, vx, vy, u, added_mass_coefficient=added)
    expected = reference(d, rp, rf, eta, times, vx, vy, u, added)
    assert np.all(abs(np.asarray(path).T - expected) <= 1e-5 * abs(expected).max(0))


def test_closed_form_of_the_course():
    # course IV-6: x = U_x (1 − e^−At)/A, y = B t/A + U_l/A − B/A² + (B/A² − U_l/A) e^−At with A = 18η/(ρ d²),
    # B = g(1 − ρ_c/ρ_D)
    d, rho, eta, U_x, U_l, t = 4e-5, 2500.0, 1.8e-5, 2.0, 0.3, 0.02
    A, B = 18 * eta / (rho * d**2), G * (1 - 1.2 / rho)
    path = trajectory_stokes(d, rho, 1.2, eta, np.array([0.0, t]), U_x, U_l)
    assert path.horizontal_position[1] == pytest.approx(U_x / A * (1 - np.exp(-A * t)))
    assert path.depth[1] == pytest.approx(
        B / A * t + U_l / A - B / A**2 + (B / A**2 - U_l / A) * np.exp(-A * t)
    )
    assert path.depth[0] == 0.0
    general = trajectory(d, rho, 1.2, eta, np.array([0.0, t]), U_x, U_l, drag=drag.drag_coefficient_stokes)
    np.testing.assert_allclose(np.asarray(general)[:, 1], np.asarray(path)[:, 1], rtol=1e-9)


@pytest.mark.long
def test_settling_distance():
    fine = {
        "particle_diameter": 1e-5,
        "particle_density": 2650.0,
        "fluid_density": 1000.0,
        "dynamic_viscosity": 1e-3,
    }
    v = G * 1650 * 1e-10 / 18e-3
    # course V-1: L = U_x h/U_t
    found = settling_distance_stokes(
        **fine, height=2.0, stream_velocity=0.01, initial_horizontal_velocity=0.01
    )
    assert found.settling_distance == pytest.approx(0.01 * 2.0 / v, rel=1e-4)
    general = settling_distance(
        **fine,
        height=2.0,
        stream_velocity=0.01,
        initial_horizontal_velocity=0.01,
        drag=drag.drag_coefficient_stokes,
    )
    assert general.settling_distance == pytest.approx(found.settling_distance, rel=1e-8)
    heights = np.array([0.02, 0.2, 2.0])
    sand = {**fine, "particle_diameter": 1e-3}
    several = settling_distance(**sand, height=heights, initial_horizontal_velocity=0.5)
    for h, x, t in zip(heights, *several, strict=True):
        path = reference(1e-3, 2650.0, 1000.0, 1e-3, np.array([0.0, float(t)]), 0.5, 0.0, 0.0, 0.0)
        assert path[-1, 1] == pytest.approx(h, rel=1e-5)
        assert path[-1, 0] == pytest.approx(float(x), rel=1e-4)
    rising = settling_distance(**{**sand, "particle_density": 500.0}, height=0.5, stream_velocity=0.1)
    assert rising.time > 0
    with pytest.raises(ApplicabilityError, match="same density"):
        settling_distance(**{**sand, "particle_density": 1000.0}, height=0.5)
    thrown_up = settling_distance(**sand, height=0.1, initial_vertical_velocity=-1.0)
    assert thrown_up.time > several.time[0]
    slope = jax.grad(
        lambda d: settling_distance(**{**sand, "particle_diameter": d}, height=0.5, stream_velocity=0.1)[0]
    )(1e-3)
    up, down = (
        settling_distance(**{**sand, "particle_diameter": d}, height=0.5, stream_velocity=0.1)[0]
        for d in (1.0001e-3, 0.9999e-3)
    )
    assert slope == pytest.approx((up - down) / 2e-7, rel=1e-4)


def test_unsteady_fall_closed_forms():
    tau = relaxation_time(1e-5, 2650.0, 1000.0, 1e-3)
    assert tau == pytest.approx(2650 * 1e-10 / 18e-3)
    assert relaxation_time(1e-5, 2650.0, 1000.0, 1e-3, 0.5) == pytest.approx(3150 * 1e-10 / 18e-3)
    v = G * 1650 * 1e-10 / 18e-3
    state = fall_stokes(1e-5, 2650.0, 1000.0, 1e-3, 3 * tau)
    assert state.velocity == pytest.approx(v * (1 - np.exp(-3)))
    assert state.fall_distance == pytest.approx(v * tau * (3 - 1 + np.exp(-3)))
    ball = fall_newton(2e-2, 2650.0, 1000.0, 0.2)
    vt = np.sqrt(4 * G * 1650 * 2e-2 / (3 * 0.44 * 1000))
    rate = G * 1650 / 2650 / vt
    assert ball.velocity == pytest.approx(vt * np.tanh(0.2 * rate))
    assert ball.fall_distance == pytest.approx(vt / rate * np.log(np.cosh(0.2 * rate)))
    assert fall_newton(2e-2, 500.0, 1000.0, 0.2).velocity < 0


def test_approach_to_terminal_is_the_integral_of_motion():
    # Newton's drag: t = τ_N artanh f, z = −(v_t τ_N/2) ln(1 − f²)
    f = 0.95
    found = approach_to_terminal(2e-2, 2650.0, 1000.0, 1e-3, f, drag=drag.drag_coefficient_newton)
    vt = np.sqrt(4 * G * 1650 * 2e-2 / (3 * 0.44 * 1000))
    tau = vt * 2650 / (G * 1650)
    assert found.time == pytest.approx(tau * np.arctanh(f), rel=1e-10)
    assert found.fall_distance == pytest.approx(-vt * tau / 2 * np.log(1 - f**2), rel=1e-10)
    general = approach_to_terminal(1e-3, 2650.0, 1000.0, 1e-3, f)
    Re = general.velocity / f * 1e-3 * 1000 / 1e-3
    v_t, start = general.velocity / f, G * 1650 / 2650
    time = quad(
        lambda s: v_t / start / (1 - s * s * brown_lawler(s * Re) / brown_lawler(Re)),
        1e-12,
        f,
        epsabs=0,
        epsrel=1e-10,
    )[0]
    assert general.time == pytest.approx(time, rel=1e-7)


@pytest.mark.parametrize("many", [3, 48])  # 48: as many as the rule of the integral has nodes
def test_approach_to_terminal_of_many_particles_is_that_of_each(many):
    sizes = np.geomspace(2e-5, 2e-3, many)
    found = approach_to_terminal(sizes, 2650.0, 1000.0, 1e-3, drag=drag.drag_coefficient_newton)
    vt = np.sqrt(4 * G * 1650 * sizes / (3 * 0.44 * 1000))  # Newton's drag: t = τ_N artanh f
    np.testing.assert_allclose(found.time, vt * 2650 / (G * 1650) * np.arctanh(0.99), rtol=1e-8)
    general = approach_to_terminal(sizes, 2650.0, 1000.0, 1e-3)
    for place in (0, many // 2, many - 1):
        alone = approach_to_terminal(float(sizes[place]), 2650.0, 1000.0, 1e-3)
        assert general.time[place] == pytest.approx(float(alone.time), rel=1e-9)


def test_stopping_distance():
    # Hinds 1999, table 5.1 (approx.): 10 µm unit density at 10 m/s stops in 2.3 mm with drag beyond Stokes, τ
    # v₀ = 3.1 mm
    assert stopping_distance(1e-5, 1000.0, 1.2, 1.81e-5, 10.0) == pytest.approx(2.3e-3, rel=0.08)
    assert stopping_distance(1e-6, 1000.0, 1.2, 1.81e-5, 1e-3) == pytest.approx(
        1000 * 1e-12 / (18 * 1.81e-5) * 1e-3, rel=1e-3
    )
    exact = 4 * 2650 * 1e-3 / 3000 * quad(lambda r: 1 / (r * brown_lawler(r)), 1e-9, 1000, limit=200)[0]
    assert stopping_distance(1e-3, 2650.0, 1000.0, 1e-3, 1.0) == pytest.approx(exact, rel=1e-6)
    assert drag_modern.drag_coefficient_brown_lawler(10.0) == pytest.approx(brown_lawler(10.0))
