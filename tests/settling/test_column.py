"""The settling-compression column: analytic shocks and fans, steady states, equilibrium bed, conservation,
derivatives.
"""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from granum.core.errors import ApplicabilityError
from granum.settling.column import (
    Cone,
    Operation,
    Simulation,
    Steps,
    Suspension,
    settle,
    simulate,
    steps_needed,
)
from granum.settling.compression import LogarithmicStress, PowerStress
from granum.settling.flux import steady_state
from granum.settling.velocities import RichardsonZakiConcentration, Takacs, Vesilind

QUADRATIC = Suspension(
    RichardsonZakiConcentration(1.0, 2.0, 1.0), solid_density=2.0, packed_concentration=1.0
)


def kynch_height(start: float, t: float) -> float:
    """Interface of φ(1 − φ)² settling from a uniform φ0 and unit height, solved by hand.

    The tangent from φ0 touches at 1 − φ0/2 (sum of the roots of the cubic); behind it a fan; mass under the
    interface gives t = φ0 / (2 φ²(1 − φ)) for the layer φ that reaches it.
    """

    def slope(p: float) -> float:
        return 1 - 4 * p + 3 * p * p

    touch = 1 - start / 2
    meeting = 1 / ((1 - start) ** 2 - slope(touch))
    if t <= meeting:
        return 1 - (1 - start) ** 2 * t
    layer = brentq(lambda p: start / (2 * p * p * (1 - p)) - t, max(touch, 2 / 3), 1 - 1e-12)
    return -slope(layer) * t


@pytest.mark.parametrize("start", [0.2, 0.45])
def test_kynch_shock_and_fan_with_first_order(start):
    times = np.linspace(0.0, 4.0, 9)
    exact = np.array([kynch_height(start, t) for t in times])
    errors = []
    for cells in (50, 100, 200, 400):
        course = settle(QUADRATIC, 1.0, start, times, cells=cells)
        assert float(course.mass_error) < 1e-13
        assert float(course.concentration.min()) >= 0.0
        assert float(course.concentration.max()) <= 1.0
        errors.append(np.abs(np.asarray(course.interface_height(0.5 * start)) - exact).mean())
    assert errors[-1] < 2e-3
    order = np.log2(errors[0] / errors[-1]) / 3
    assert 0.75 < order < 1.3, errors


def test_fan_profile_of_kynch():
    course = settle(QUADRATIC, 1.0, 0.3, np.array([0.0, 0.5]), cells=800)
    height = 1.0 - np.asarray(course.depths)
    touch = 0.85
    top = -(1 - 4 * touch + 3 * touch**2) * 0.5  # of the fan
    inside = (height > 0.01) & (height < 0.9 * top)
    fan = (2 + np.sqrt(np.maximum(1 - 3 * height / 0.5, 0.0))) / 3  # f'(φ) = −h/t
    error = np.abs(np.asarray(course.concentration[-1]) - fan)[inside]
    assert error.max() < 0.02
    assert error.mean() < 1e-2


@pytest.mark.parametrize("flow", [7.0e-4, 1.0e-3])
def test_continuous_unit_reaches_the_steady_state_of_flux_theory(flow):
    law, qu, feed = Vesilind(5 / 3600, 0.4), 3e-4, 3.5
    still = np.ones(12)
    operation = Operation(jnp.linspace(0, 12 * 86400.0, 13), flow * still, qu * still, feed * still)
    course = simulate(Suspension(law), 4.0, jnp.zeros(60), operation)
    _down, under, over, _where = steady_state(feed, flow, qu, law, 100.0)
    assert float(course.underflow_concentration[-1]) == pytest.approx(float(under), rel=1e-3)
    assert float(course.overflow_concentration[-1]) == pytest.approx(float(over), rel=1e-2, abs=1e-3)
    assert float(course.mass_error) < 1e-10


def test_settled_bed_stands_in_equilibrium():
    # At rest the effective stress carries the buoyant weight: dσ/dx = g Δρ C/ρs downwards from C_c at the
    # surface.
    stress, mass, gap = PowerStress(200.0, 50.0, 4.0), 0.3 * 150.0, 9.80665 * (2600 - 1000) / 2600
    suspension = Suspension(RichardsonZakiConcentration(1e-3, 4.65, 2600.0), stress, 2600.0, 1000.0)
    course = settle(suspension, 0.3, 150.0, np.array([0.0, 2e4]), cells=60)

    def below(_x, y):
        return [gap * y[0] / (50.0 * 4.0 / 200.0 * (y[0] / 200.0) ** 3), y[0]]

    reached = solve_ivp(
        below,
        (0, 0.3),
        [200.0, 0.0],
        events=lambda _x, y: y[1] - mass,
        rtol=1e-10,
        atol=1e-10,
        dense_output=True,
    )
    thick = reached.t_events[0][0]
    bottom = reached.y_events[0][0][0]
    assert float(course.interface_height(100.0)[-1]) == pytest.approx(thick, abs=0.6 * 0.3 / 60)
    assert float(course.concentration[-1, -1]) == pytest.approx(bottom, rel=0.02)


def test_varying_feed_is_conserved_and_bounded():
    rng = np.random.default_rng(4)
    hours = 48
    operation = Operation(
        jnp.arange(hours + 1) * 3600.0,
        rng.uniform(2e-4, 1.2e-3, hours),
        rng.uniform(1e-4, 2e-4, hours),
        rng.uniform(1.0, 5.0, hours),
    )
    suspension = Suspension(Takacs(), LogarithmicStress(6.0, 4.0, 4.0), packed_concentration=30.0)
    course = simulate(suspension, 4.0, jnp.linspace(0.0, 30.0, 50), operation, feed_depth=0.4)
    assert float(course.mass_error) < 1e-10
    assert float(course.concentration.min()) >= 0.0
    assert float(course.concentration.max()) <= 30.0 + 1e-9


def test_derivatives_of_the_underflow():
    operation = Operation(jnp.linspace(0, 6 * 3600.0, 4), *(x * jnp.ones(3) for x in (6e-4, 2e-4, 3.0)))

    def underflow(v0, feed, steps):
        suspension = Suspension(Vesilind(v0, 0.4), LogarithmicStress(6.0, 4.0, 4.0))
        given = operation._replace(feed_concentration=feed * jnp.ones(3))
        return simulate(suspension, 4.0, jnp.full(30, 2.0), given, steps=steps).underflow_concentration[-1]

    need = steps_needed(
        Suspension(Vesilind(1.6e-3, 0.4), LogarithmicStress(6.0, 4.0, 4.0)), 4.0, 30, operation
    )
    exact = [
        jax.jvp(lambda v, f: underflow(v, f, None), (1.5e-3, 3.0), d)[1] for d in ((1.0, 0.0), (0.0, 1.0))
    ]
    by_difference = [
        (underflow(1.5e-3 + 1e-7, 3.0, need) - underflow(1.5e-3 - 1e-7, 3.0, need)) / 2e-7,
        (underflow(1.5e-3, 3.0 + 1e-4, need) - underflow(1.5e-3, 3.0 - 1e-4, need)) / 2e-4,
    ]
    np.testing.assert_allclose(exact, by_difference, rtol=2e-2)
    assert exact[1] > 0


def test_a_bed_at_rest_does_not_depend_on_the_time_step():
    """What lies above the critical concentration, taken once a step, lets the top of the bed come and go for
    ever.
    """
    suspension = Suspension(
        Vesilind(1.3313e-3, 0.3832), LogarithmicStress(7.8595, 0.49161, 4.0), 1050.0, 998.0
    )
    times = np.linspace(0.0, 24 * 3600.0, 3)
    still = np.zeros(2)
    need = steps_needed(suspension, 0.5, 60, Operation(times, still, still, still))
    coarse, fine = (
        settle(suspension, 0.5, 3.0, times, cells=60, steps=Steps(n * need.steps, need.compression))
        for n in (1, 2)
    )
    np.testing.assert_allclose(coarse.concentration[-1], fine.concentration[-1], rtol=1e-6, atol=1e-9)


def test_flux_with_two_humps_is_refused():
    with pytest.raises(ApplicabilityError, match="more than once"):
        settle(
            Suspension(lambda C: 1e-3 * (1.1 + jnp.sin(C)), packed_concentration=40.0),
            1.0,
            5.0,
            np.array([0.0, 60.0]),
            cells=10,
        )


def test_front_is_placed_by_the_solids_around_it():
    """A front in the middle of a cell, and one smeared over three cells: placed where an even layer would
    hold the same solids.
    """
    depths = jnp.arange(20) * 0.1 + 0.05
    rows = np.zeros((2, 20))
    rows[0, 8:], rows[0, 7] = 4.0, 1.0  # a quarter of the cell from 0.7 to 0.8 m is full: front at 0.775 m
    rows[1, 9:], rows[1, 6:9] = 4.0, [0.5, 2.0, 3.5]  # 6 kg/m² cells of 4: front 1.5 cells above 0.9 m
    none = jnp.zeros(2)
    course = Simulation(none, depths, jnp.asarray(rows), none, none, none, none, none, jnp.ones(20))
    np.testing.assert_allclose(course.interface_height(2.0), [2.0 - 0.775, 2.0 - 0.75], rtol=1e-12)


@pytest.mark.parametrize("cells", [25, 50, 100])
def test_bed_of_sludge_stands_without_bias(cells):
    """Logarithmic stress: thickness of the bed at rest from its own differential equation, to half a cell on
    any grid.
    """
    stress, gap = LogarithmicStress(8.0, 0.5, 4.0), 9.80665 * 52.0 / 1050.0
    course = settle(Suspension(Vesilind(1.4e-3, 0.4), stress), 0.5, 3.0, np.array([0.0, 2e5]), cells=cells)
    reached = solve_ivp(
        lambda _x, y: [gap * y[0] * (4.0 + y[0] - 8.0) / 0.5, y[0]],
        (0, 1.0),
        [8.0, 0.0],
        events=lambda _x, y: y[1] - 1.5,
        rtol=1e-10,
        atol=1e-12,
    )
    assert float(course.interface_height(1.5)[-1]) == pytest.approx(
        reached.t_events[0][0], abs=0.6 * 0.5 / cells
    )


def test_cone_holds_its_volume_and_lets_the_same_through():
    """Volume of a truncated cone by its formula; the steady underflow is that of the cylinder, the sludge
    held is less.
    """
    cone = Cone(0.25, 0.04)
    faces, areas = cone.areas(40)
    assert float(jnp.mean(areas)) == pytest.approx(0.75 + 0.25 * (1 + 0.2 + 0.04) / 3, rel=1e-12)
    assert float(faces[-1]) == pytest.approx(0.04)
    still = np.ones(8)
    operation = Operation(jnp.linspace(0, 8 * 86400.0, 9), 7e-4 * still, 3e-4 * still, 2.5 * still)
    suspension = Suspension(Vesilind(5 / 3600, 0.4), LogarithmicStress(6.0, 4.0, 4.0))
    straight, narrow = (simulate(suspension, 4.0, jnp.zeros(40), operation, cone=c) for c in (None, cone))
    assert float(narrow.mass_error) < 1e-10
    assert float(narrow.concentration.min()) >= 0.0
    assert float(narrow.underflow_concentration[-1]) == pytest.approx(
        float(straight.underflow_concentration[-1]), rel=1e-4
    )
    assert float(narrow.held[-1]) < 0.9 * float(straight.held[-1])


def test_closed_cone_keeps_its_solids():
    still = np.zeros(4)
    operation = Operation(jnp.linspace(0, 7200.0, 5), still, still, still)
    course = simulate(
        Suspension(Vesilind(5 / 3600, 0.4), packed_concentration=60.0),
        1.0,
        jnp.full(60, 3.0),
        operation,
        cone=Cone(1.0, 0.01),
    )
    np.testing.assert_allclose(course.held, course.held[0], rtol=1e-13)
    assert float(course.concentration.max()) <= 60.0
    assert float(course.concentration.min()) >= 0.0
