"""Secondary settler in layers: the benchmark plant, another solver of the equations, conservation."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from granum.cases.alone import alone
from granum.core.errors import GranumError, InputError
from granum.settling.charts import settler_layers_chart
from granum.settling.equipment.secondary_settler import SecondarySettler
from granum.settling.layers import settler_layers
from granum.settling.velocities import Takacs, Vesilind
from granum.streams.audit import closure
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import empty

DAY = 86400.0
# g/m³ from the top: the open-loop steady state of BSM1 that bsm2-python holds its settler to
BENCHMARK = [12.4969498996665, 18.1132132624131, 29.5402273766893, 68.9780506740299, 356.074706190146]
BENCHMARK += [356.074706190149, 356.074706190151, 356.074706190154, 356.074706190157, 6393.98442118288]
# its influent of 18446 m³/d and as much sludge returned enter, 18061 m³/d leave over the weir
FLOW, OVER = 36892.0, 18061.0
FEED = (BENCHMARK[0] * OVER + BENCHMARK[-1] * (FLOW - OVER)) / FLOW / 1000.0

SLUDGE = Mixture(
    solids=(Species("sludge", (("sludge", 1.0),), (1050.0,), (2000.0,)),),
    liquids=(Species("water", (("water", 1.0),), (1000.0,), (4180.0,)),),
    gases=(),
    size_edges=(1e-4, 2e-4, 4e-4),
    liquid_viscosity=lambda w, T: 1e-3,
)


def liquor(concentration=3.0, flow=0.4):
    solid = concentration * flow
    return empty(SLUDGE).replace(
        solid=jnp.array([[0.4 * solid, 0.6 * solid]]),
        liquid=jnp.array([1000.0 * (flow - solid / 1050.0)]),
    )


def benchmark(**changes):
    given = {"nonsettleable_share": 0.00228} | changes
    return settler_layers(FLOW / DAY, FEED, (FLOW - OVER) / DAY, 1500.0, 4.0, **given)


def test_layers_of_the_benchmark_plant():
    found = benchmark()
    np.testing.assert_allclose(found.layer_concentration, np.array(BENCHMARK) / 1000.0, rtol=2e-8)
    assert 0.4 < found.blanket_height < 0.6  # between the middles of the two lowest layers


def by_hand(t, C, q, under, feed, share):
    """The balances of Takács layer by layer, from the bottom, as the benchmark report numbers them."""
    h, m = 0.4, 5
    X = np.maximum(C - share * feed, 0.0)
    v = np.clip(474 / DAY * (np.exp(-0.576 * X) - np.exp(-2.86 * X)), 0.0, 250 / DAY)
    J = v * C
    up, down = q - under, under
    gains = np.zeros(10)
    for j in range(10):
        if j < m:
            into = min(J[j], J[j + 1]) + down * C[j + 1]
            gains[j] = into - down * C[j] - (min(J[j], J[j - 1]) if j else 0.0)
            continue
        fall = J[j] if j > m and C[j - 1] <= 3.0 else min(J[j], J[j - 1])
        come = 0.0
        if j < 9:
            come = J[j + 1] if C[j] <= 3.0 else min(J[j], J[j + 1])
        gains[j] = come - fall
        gains[j] += q * feed - (up + down) * C[j] if j == m else up * (C[j - 1] - C[j])
    return gains / h


@pytest.mark.parametrize(("more", "denser"), [(1.0, 1.0), (1.6, 1.0), (1.0, 1.4), (2.2, 0.7)])
def test_rest_is_where_another_solver_arrives_in_time(more, denser):
    q, under = more * FLOW / DAY / 1500.0, (FLOW - OVER) / DAY / 1500.0
    feed = denser * FEED
    followed = solve_ivp(
        by_hand, (0.0, 60 * DAY), np.full(10, 0.5), args=(q, under, feed, 0.00228), method="LSODA", rtol=1e-9
    ).y[::-1, -1]
    found = settler_layers(q, feed, under, 1.0, 4.0, nonsettleable_share=0.00228)
    np.testing.assert_allclose(found.layer_concentration, followed, rtol=2e-4)


@jax.jit
def operated(height, under, sinking, share, feed):
    made = SecondarySettler(1.0, height, under, Takacs(sinking), share).operate(feed=feed)
    masks = [record.mask for record in made.records if record.name == "iteration"]
    unsolved = jnp.any(jnp.stack([jnp.any(mask) for mask in masks]))
    return closure([feed], list(made.outlets)), made.inside.concentration, made.figures, unsolved


def test_a_hundred_ordinary_settlers_conserve_and_clear():
    rng = np.random.default_rng(5)
    for _case in range(100):
        flow = rng.uniform(0.3, 2.5) / 3600.0
        under, concentration = flow * rng.uniform(0.15, 0.7), rng.uniform(0.5, 6.0)
        settler = rng.uniform(2.5, 5.0), under, rng.uniform(150, 500) / DAY, rng.choice([0.0, 0.002])
        found, C, figures, unsolved = operated(*settler, liquor(concentration, flow))
        assert float(found.mass) < 1e-12
        assert float(found.energy) < 1e-12
        assert np.all(np.diff(C) >= -1e-9)  # denser downwards
        assert float(figures.overflow_concentration) == pytest.approx(float(C[0]), rel=1e-6)
        assert float(figures.underflow_concentration) == pytest.approx(float(C[-1]), rel=1e-6)
        assert not unsolved


def test_slopes_are_those_of_differences_and_more_area_clears_more():
    feed = liquor()

    def weir(area):
        return (
            SecondarySettler(area, 4.0, 0.18, nonsettleable_share=0.00228)
            .operate(feed=feed)
            .figures.overflow_concentration
        )

    slope = jax.grad(weir)(1200.0)
    assert float(slope) < 0
    assert float(slope) == pytest.approx(float(weir(1201.0) - weir(1199.0)) / 2.0, rel=1e-4)


def test_an_overloaded_settler_loses_its_sludge_and_says_so():
    made = SecondarySettler(250.0, 4.0, 0.12).operate(feed=liquor(4.0))
    assert float(made.figures.loading_ratio) > 1.0
    assert not made.checks[0].ok
    assert float(made.outlets.overflow.solid_flow) > 0.1 * 4.0 * 0.4


def test_water_alone_passes_as_it_came():
    made = SecondarySettler(500.0, 4.0, 0.1).operate(feed=liquor(0.0))
    assert float(made.outlets.underflow.slurry_volume_flow) == pytest.approx(0.1, rel=1e-9)
    assert float(made.figures.overflow_concentration) == float(made.figures.blanket_height) == 0.0


def test_what_cannot_be_is_refused():
    with pytest.raises(InputError, match="nonsettleable_share"):
        SecondarySettler(500.0, 4.0, 0.1, Vesilind("6 m/hour", 0.4), 0.002)
    with pytest.raises(InputError, match="run dry"):
        settler_layers(0.1, 3.0, 0.2, 1000.0, 4.0)
    with pytest.raises(GranumError, match="layers"):
        alone("settling.secondary_settler", layers=1)


def test_chart_has_one_step_for_each_layer():
    drawing = settler_layers_chart(FLOW / DAY, FEED, (FLOW - OVER) / DAY, 1500.0, 4.0)
    heights = np.asarray(drawing.data[0].y, dtype=float)
    np.testing.assert_allclose(np.unique(heights), np.linspace(0.0, 4.0, 11), atol=1e-12)


@pytest.mark.parametrize("key", ["settling.secondary_settler", "settling.clarifier_thickener"])
def test_more_underflow_than_feed_is_told(key):
    for asked, well in (("500 m3/h", True), ("5000 m3/h", False)):
        (unit,) = alone(key, underflow_volume_flow=asked).solve().units.values()
        assert {check.name: check.ok for check in unit.checks}["underflow asked for over the feed"] is well
