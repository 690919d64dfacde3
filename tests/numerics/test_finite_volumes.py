"""Transport: orders, exact shocks and fans, conservation to rounding, positivity."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from granum.core.errors import InputError
from granum.numerics import (
    FixedFlux,
    Godunov,
    Inflow,
    Outflow,
    Periodic,
    Upwind,
    Wall,
    advance,
    first_order,
    geometric_edges,
    koren,
    minmod,
    ssp_rk3,
    stationary_points,
    steps_for,
    superbee,
    transport_rate,
    uniform_edges,
    van_leer,
)

LIMITERS = [van_leer, koren, minmod, superbee, first_order]


def centers(edges: jax.Array) -> jax.Array:
    return 0.5 * (edges[1:] + edges[:-1])


def sine_means(edges: jax.Array, shift: float = 0.0) -> jax.Array:
    integral = -jnp.cos(2 * jnp.pi * (edges - shift)) / (2 * jnp.pi)
    return 1.0 + 0.5 * jnp.diff(integral) / jnp.diff(edges)


def test_order_in_time() -> None:
    def error(steps: int) -> float:
        end = ssp_rk3(lambda y, t: -y * jnp.cos(t), 1.0, steps=steps, dt=1.0 / steps).state
        return abs(float(end) - np.exp(-np.sin(1.0)))

    assert np.log2(error(20) / error(40)) == pytest.approx(3.0, abs=0.2)


@pytest.mark.parametrize(
    ("limiter", "order"), [(van_leer, 1.8), (koren, 2.0), (minmod, 1.5), (first_order, 0.8)]
)
def test_order_in_space_of_a_smooth_wave(limiter, order: float) -> None:
    def error(cells: int) -> float:
        edges = uniform_edges(0.0, 1.0, cells)
        steps = steps_for(1.0, edges, 1.0)
        moved = advance(
            sine_means(edges),
            edges,
            Upwind(1.0),
            steps=steps,
            dt=1.0 / steps,
            lower=Periodic(),
            upper=Periodic(),
            limiter=limiter,
        ).state
        return float(jnp.mean(abs(moved - sine_means(edges))))

    assert np.log2(error(64) / error(128)) > order


def test_order_on_geometric_cells() -> None:
    # du/dt + d(x u)/dx = 0 with u0(x) gives exp(-t) u0(x exp(-t)).
    def bump_integral(x: jax.Array) -> jax.Array:
        return 0.5 * jnp.sqrt(jnp.pi) * 0.5 * jax.scipy.special.erf(jnp.log(x / 0.3) / 0.5)

    def error(cells: int) -> float:
        edges = geometric_edges(0.01, 10.0, cells)
        steps = steps_for(1.0, edges, edges)
        start = jnp.diff(bump_integral(edges)) / jnp.diff(edges)
        end = jnp.diff(bump_integral(edges * jnp.exp(-1.0))) / jnp.diff(edges)
        moved = advance(start, edges, Upwind(edges), steps=steps, dt=1.0 / steps).state
        return float(jnp.sum(abs(moved - end) * jnp.diff(edges)))

    assert np.log2(error(100) / error(200)) > 1.7


def burgers(left: float, right: float, time: float) -> tuple[jax.Array, jax.Array]:
    edges = uniform_edges(-1.0, 1.0, 200)
    start = jnp.where(centers(edges) < 0.0, left, right)
    steps = steps_for(time, edges, 1.0)
    flux = Godunov(lambda u: 0.5 * u**2, (0.0,))
    return edges, advance(start, edges, flux, steps=steps, dt=time / steps).state


def test_shock_of_burgers_moves_at_half_its_height() -> None:
    edges, end = burgers(1.0, 0.0, 1.0)
    front = -1.0 + float(jnp.sum(end) * (edges[1] - edges[0]))
    assert front == pytest.approx(0.5, abs=1e-12)
    assert int(jnp.sum((end > 0.02) & (end < 0.98))) <= 4


def test_transonic_fan_of_burgers_opens() -> None:
    edges, end = burgers(-1.0, 1.0, 0.5)
    exact = jnp.clip(centers(edges) / 0.5, -1.0, 1.0)
    assert float(jnp.mean(abs(end - exact))) < 3e-3


def test_suspension_settles_as_kynch_says() -> None:
    # Flux u (1 - u)**2 towards the bottom at 1, from u = 0.1: the clear front falls at (1 - u)**2, and the
    # bed grows up behind a shock whose chord from u = 0.1 is tangent to the flux curve.
    def flux(u: jax.Array) -> jax.Array:
        return u * (1.0 - u) ** 2

    edges = uniform_edges(0.0, 1.0, 400)
    time = 0.5
    steps = steps_for(time, edges, 1.0)
    turning = stationary_points(flux, 0.0, 1.0)
    np.testing.assert_allclose(turning[0], 1.0 / 3.0, rtol=1e-9)
    start = jnp.full(400, 0.1)
    end = advance(
        start, edges, Godunov(flux, tuple(turning)), steps=steps, dt=time / steps, lower=Wall(), upper=Wall()
    ).state
    assert float(jnp.sum(end)) == pytest.approx(40.0, abs=1e-11)
    np.testing.assert_allclose(end[200:350], 0.1, atol=1e-6)
    clear = float(jnp.sum(end[:200] < 0.05)) / 400
    assert clear == pytest.approx(0.81 * time, abs=2.0 / 400)
    # The tangent from (0.1, f) touches where f'(u) (u - 0.1) = f(u) - f(0.1): 2 u**2 - 2.1 u + 0.19 = 0.
    touch = 0.95
    front = -float(jax.grad(flux)(touch)) * time
    bed = float(jnp.sum(end[200:] > 0.15)) / 400
    assert bed == pytest.approx(front, abs=3.0 / 400)


@pytest.mark.parametrize("limiter", LIMITERS)
@given(
    values=st.lists(st.floats(0.0, 1e3), min_size=12, max_size=12),
    velocity=st.floats(-2.0, 2.0),
    ratio=st.floats(1.0, 1e4),
)
def test_mass_is_kept_and_nothing_turns_negative(
    limiter, values: list[float], velocity: float, ratio: float
) -> None:
    edges = geometric_edges(1.0, 1.0 + ratio, 12)
    time = 0.45 * 20 * float(jnp.min(jnp.diff(edges))) / 2.0
    start = jnp.array(values)
    end, through = closed_and_open[limiter](start, edges, velocity, time / 20)
    h = np.diff(edges)
    mass = float(start @ h)
    assert abs(float(end @ h) - mass) <= 1e-13 * mass
    assert float(jnp.min(end)) >= -1e-14 * max(values)
    assert float(jnp.min(through)) >= -1e-14 * max(values)
    assert float(jnp.max(through)) <= max(values) * (1.0 + 1e-13)


def _both(limiter):
    def run(start, edges, velocity, dt):
        closed = advance(
            start, edges, Upwind(velocity), steps=20, dt=dt, lower=Wall(), upper=Wall(), limiter=limiter
        )
        through = advance(start, edges, Upwind(velocity), steps=20, dt=dt, limiter=limiter)
        return closed.state, through.state

    return jax.jit(run)


closed_and_open = {limiter: _both(limiter) for limiter in LIMITERS}


def test_what_enters_stays() -> None:
    edges = uniform_edges(0.0, 2.0, 50)
    run = advance(
        jnp.zeros(50),
        edges,
        Upwind(1.0),
        steps=100,
        dt=0.01,
        lower=FixedFlux(lambda t: 2.0 * t),
        upper=Wall(),
    )
    assert float(jnp.sum(run.state) * 0.04) == pytest.approx(1.0, rel=1e-13)


def test_inflow_reaches_every_cell() -> None:
    edges = uniform_edges(0.0, 1.0, 40)
    run = advance(jnp.zeros(40), edges, Upwind(1.0), steps=400, dt=0.01, lower=Inflow(3.0))
    np.testing.assert_allclose(run.state, 3.0, rtol=1e-10)
    falling = advance(
        jnp.zeros(40), edges, Upwind(lambda t: -1.0), steps=400, dt=0.01, upper=Inflow(lambda t: 3.0)
    )
    np.testing.assert_allclose(falling.state, 3.0, rtol=1e-10)


def test_source_and_transport_balance() -> None:
    # du/dx = -k u at steady state.
    edges = uniform_edges(0.0, 1.0, 100)
    run = advance(
        jnp.ones(100),
        edges,
        Upwind(1.0),
        steps=800,
        dt=0.004,
        lower=Inflow(1.0),
        source=lambda u, x, t: -2.0 * u,
    )
    assert float(jnp.mean(abs(run.state - np.exp(-2.0 * centers(edges))))) < 2e-4


def test_recorded_history_and_coupled_state() -> None:
    # Growing cells feed on a solute that falls as exp(-t); their mean moves by 1 - exp(-t).
    edges = uniform_edges(0.0, 2.0, 400)
    x = centers(edges)
    pulse = jnp.exp(-(((x - 0.4) / 0.05) ** 2))

    def rate(state, time):
        cells, solute = state
        return transport_rate(cells, edges, Upwind(solute), time=time), -solute

    def mean(state, time):
        return jnp.sum(x * state[0]) / jnp.sum(state[0])

    steps = steps_for(1.0, edges, 1.0)
    run = ssp_rk3(rate, (pulse, 1.0), steps=steps, dt=1.0 / steps, record=mean)
    times = np.arange(1, steps + 1) / steps
    np.testing.assert_allclose(run.record, 0.4 + 1.0 - np.exp(-times), atol=5e-4)
    np.testing.assert_allclose(run.state[1], np.exp(-1.0), rtol=1e-7)


def test_derivatives_and_batches() -> None:
    edges = uniform_edges(0.0, 1.0, 100)
    pulse = jnp.exp(-(((centers(edges) - 0.3) / 0.08) ** 2))

    def mean_place(velocity):
        end = advance(pulse, edges, Upwind(velocity), steps=80, dt=0.4 / 80, upper=Outflow()).state
        return jnp.sum(end * centers(edges)) / jnp.sum(end)

    np.testing.assert_allclose(jax.grad(mean_place)(0.9), 0.4, rtol=2e-3)
    np.testing.assert_allclose(jax.jacfwd(mean_place)(0.9), 0.4, rtol=2e-3)
    velocities = jnp.array([0.2, 0.9])
    np.testing.assert_allclose(
        jax.vmap(mean_place)(velocities), [mean_place(v) for v in velocities], rtol=1e-13
    )


def test_number_of_steps() -> None:
    edges = uniform_edges(0.0, 1.0, 100)
    assert steps_for(1.0, edges, 1.0, courant=0.5) == 200
    assert steps_for(1.0, edges, np.linspace(0.0, 1.0, 101), courant=0.5) == 200
    assert steps_for(1.0, edges, 0.0) == 1
    assert steps_for(1.0, edges, 0.0, sink_rate=9.0) == 20
    with pytest.raises(InputError, match="before jit"):
        jax.jit(lambda speed: steps_for(1.0, edges, speed))(1.0)
