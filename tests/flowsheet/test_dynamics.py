"""A line in time against closed forms and SciPy; start-up and disturbances from a case file; cycles of batch
units.
"""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.sharing.places import EXAMPLES
from tests.sharing.streams import WATER

import granum as gr
from granum.comminution.breakage import AustinBreakage, AustinSelection
from granum.comminution.equipment.mills import BallMill
from granum.comminution.equipment.screens import Screen
from granum.comminution.population import rate_matrix
from granum.core import flags
from granum.core.errors import ConvergenceError, GranumError
from granum.core.packing import compiled
from granum.flowsheet import Flowsheet, Line, Movement, Profile, march, solve_compiled
from granum.particles.partition import RosinRammlerPartition
from granum.streams.equipment.basics import Mixer, Single, Splitter, StirredTank
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream, empty
from granum.streams.units import Unit

SALT = Species("salt", (("salt", 1.0),), (1000.0,), (4000.0,), 0.0, 0.018)
BRINE = Mixture((), (WATER, SALT), (), (1e-6, 1e-3))
_march = eqx.filter_jit(march)


def tank_line(mass: float = 100.0) -> Flowsheet:
    feed = empty(BRINE, 330.0).replace(liquid=jnp.array([0.5, 0.5]))
    return Flowsheet({"tank": StirredTank(mass)}, {"f": feed}, {"f": ("", "tank"), "p": ("tank", "")})


def test_start_up_of_a_stirred_tank() -> None:
    """Salt rises as 1 - exp(-t/τ), temperature likewise from 25 °C: Levenspiel (1999)."""
    times = np.linspace(0.0, 300.0, 31)
    course = _march(tank_line(), times, start="empty")
    product = course.streams["p"]
    assert np.allclose(product.liquid[:, 1], 0.5 * -np.expm1(-times / 100.0), atol=1e-12)
    assert np.allclose(product.temperature, 298.15 + (330.0 - 298.15) * -np.expm1(-times / 100.0), atol=1e-8)
    assert float(course.balance) < 1e-10


def test_a_ramp_and_a_recycle_against_scipy() -> None:
    """A tank with a recycle around it; the salt of the feed ramps up. The recycle only turns the tank over
    faster.
    """
    feed = empty(BRINE, 300.0).replace(liquid=jnp.array([1.0, 0.0]))
    salt = empty(BRINE, 300.0).replace(liquid=jnp.array([0.0, 1.0]))
    units = {"mix": Mixer(), "tank": StirredTank(50.0), "split": Splitter(0.6)}
    links = {
        "f": ("", "mix.f"),
        "s": ("", "mix.s"),
        "m": ("mix", "tank"),
        "t": ("tank", "split"),
        "back": ("split.side", "mix.back"),
    }
    line = Flowsheet(units, {"f": feed, "s": salt}, links)
    ramp = Profile("s.mass_flow", [0.0, 20.0, 60.0], [0.1, 0.1, 0.5])
    times = np.linspace(0.0, 120.0, 481)
    course = _march(line, times, (ramp,))
    assert bool(course.converged.all())

    def slope(t: float, y: np.ndarray) -> np.ndarray:
        s = np.interp(t, [0.0, 20.0, 60.0], [0.1, 0.1, 0.5])
        return np.array([s - (1.0 + s) * y[0]]) / 50.0

    y, expected = np.array([0.1 / 1.1]), []
    for a, b in ((0.0, 20.0), (20.0, 60.0), (60.0, 120.0)):
        path = solve_ivp(slope, (a, b), y, rtol=1e-10, atol=1e-13, t_eval=times[(times >= a) & (times <= b)])
        expected.append(path.y[0] if a == 0 else path.y[0][1:])
        y = path.y[:, -1]
    product = np.asarray(course.streams["split.product"].liquid)
    share = product[:, 1] / product.sum(axis=1)
    assert np.abs(share - np.concatenate(expected)).max() < 1e-6
    assert float(course.balance) < 1e-6


def circuit() -> tuple[Flowsheet, BallMill]:
    rock = Species("rock", (("rock", 1.0),), (2650.0,), (800.0,), 0.0, 0.06)
    mixture = Mixture((rock,), (), (), tuple(np.geomspace(1e-5, 1e-2, 13)), (("moisture", (0.0, 0.1, 0.2)),))
    shares = np.linspace(0.0, 1.0, 12)[:, None] * np.array([0.3, 0.7])
    feed = empty(mixture, 300.0).replace(solid=jnp.asarray(shares / shares.sum())[None])
    mill = BallMill(AustinSelection(0.02, 0.9), AustinBreakage(0.5, 0.8, 4.0), 800.0)
    units = {"mix": Mixer(), "mill": mill, "screen": Screen(RosinRammlerPartition(5e-4, 3.0))}
    links = {
        "f": ("", "mix.f"),
        "m": ("mix", "mill"),
        "g": ("mill", "screen"),
        "back": ("screen.oversize", "mix.back"),
        "p": ("screen.undersize", ""),
    }
    return Flowsheet(units, {"f": feed}, links), mill


@pytest.mark.long
def test_grinding_circuit_settles_and_follows_scipy() -> None:
    line, mill = circuit()
    steady = solve_compiled(line)
    still = _march(line, np.linspace(0.0, 100.0, 6))
    assert np.allclose(
        still.streams["p"].solid, np.asarray(steady.streams["p"].solid)[None], rtol=1e-6, atol=1e-9
    )
    times = np.linspace(0.0, 1200.0, 241)
    course = _march(line, times, start="empty")
    assert bool(course.converged.all())
    assert float(course.balance) < 1e-4
    edges = np.asarray(line.feeds["f"].mixture.edges)
    a, c = (
        np.asarray(rate_matrix(edges, mill.selection, mill.breakage)),
        np.asarray(line.units["screen"].separation.over(edges[:-1], edges[1:])),
    )
    fresh = np.asarray(line.feeds["f"].solid_by_size)

    def slope(_t: float, w: np.ndarray) -> np.ndarray:
        flow = 1.0 / (1.0 - c @ w)  # what the mill gives is what it gets
        return (fresh + flow * c * w - flow * w) / mill.holdup_mass + a @ w

    path = solve_ivp(slope, (0.0, 1200.0), np.eye(12)[0], "LSODA", times, rtol=1e-10, atol=1e-13)
    expected = ((1.0 - c)[:, None] * path.y / (1.0 - c @ path.y)).T
    found = np.asarray(course.streams["p"].solid).sum(axis=(1, 3))
    assert np.abs(found - expected).max() < 2e-3  # of a feed of 1 kg/s, from a mill full of the finest size
    assert np.abs(found[-40:] - expected[-40:]).max() < 1e-4
    # the moisture classes ride along: the second one, absent at the start, comes in as the mill is turned
    # over in 800 s
    assert float(course.streams["p"].solid[-1, 0, :, 1].sum()) == pytest.approx(
        0.7 * -np.expm1(-1200.0 / 800.0), rel=0.02
    )


def test_second_order_and_gradient() -> None:
    line, _mill = circuit()
    ramp = Profile("f.mass_flow", [0.0, 200.0], [1.0, 1.5])

    def fine(step: float, scale: Any = 1.0) -> jax.Array:
        course = march(
            line, jnp.arange(0.0, 200.1, step), (ramp._replace(values=jnp.array([1.0, 1.5 * scale])),)
        )
        return jnp.sum(course.streams["p"].solid[-1, 0, :6])

    along = compiled(lambda scale: jax.jvp(lambda x: fine(40.0, x), (scale,), (1.0,)))
    (coarse, slope), half, best = (
        along(jnp.asarray(1.0)),
        *(compiled(lambda _x, s=s: fine(s))(jnp.zeros(())) for s in (20.0, 5.0)),
    )
    assert abs(coarse - best) / abs(half - best) > 3.0
    h = 1e-5
    assert slope == pytest.approx(
        (along(jnp.asarray(1.0 + h))[0] - along(jnp.asarray(1.0 - h))[0]) / (2 * h), rel=1e-6
    )


CASE = """
title = "Tank"
[mixture]
liquids = ["water", "sodium chloride"]
[feeds.brine]
to = "tank"
liquid_flow = "3600 kg/h"
liquid = { water = 0.9, "sodium chloride" = 0.1 }
[units.tank]
model = "streams.stirred_tank"
mass = "600 kg"
[streams]
product = ["tank"]
[dynamic]
duration = "1 hour"
step = "1 min"
start = "empty"
[dynamic.disturbances.more]
vary = "brine.mass_flow"
times = "0, 30, 31 min"
values = "3600, 3600, 7200 kg/h"
"""


class Thirsty(Unit):
    """Passes its feed, and has no solution below a flow."""

    def outlets(self, inside: None, feed: Stream) -> Single:
        flags.unsolved(feed.mass_flow >= 1.5, StirredTank.card, reason="Too little comes.")
        return Single(feed)

    def figures(self, inside: None, outlets: Single, feed: Stream) -> tuple:
        return ()


def test_a_unit_without_solution_at_some_instant_is_told_with_the_time() -> None:
    feed = empty(BRINE, 330.0).replace(liquid=jnp.array([2.0, 0.0]))
    line = Flowsheet({"pass": Thirsty()}, {"f": feed}, {"f": ("", "pass")})
    fading = Profile("f.mass_flow", [0.0, 10.0], [2.0, 1.0])
    moving = Line("fading", line, movement=Movement(np.linspace(0.0, 10.0, 11), (fading,)))
    with pytest.raises(
        ConvergenceError, match=r"At 6 s: Unit 'pass' has no solution: Too little comes\."
    ) as caught:
        moving.march()
    assert caught.value.exit_code == 3


def test_case_file_in_time() -> None:
    course = gr.cases.read_text(CASE).march()
    salt, flow = (
        np.asarray(course.streams["product"].liquid[:, 1]),
        np.asarray(course.streams["product"].liquid.sum(axis=1)),
    )
    assert salt[30] / flow[30] == pytest.approx(0.1 * -np.expm1(-1800.0 / 600.0), rel=1e-6)
    assert flow[-1] == pytest.approx(2.0, rel=1e-9)
    # half an hour at twice the flow: 1800 s at 2 kg/s less the ramp's minute at 1.5
    assert salt[-1] / flow[-1] == pytest.approx(
        0.1 * -np.expm1(-(1800.0 + 90.0 + 2 * 1740.0) / 600.0), rel=1e-5
    )


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('step = "1 min"', 'step = "2 hour"', "'step' must be above zero"),
        ('step = "1 min"', 'step = "1 us"', "at most"),
        ('start = "empty"', 'start = "emty"', "Did you mean 'empty'"),
        ('start = "empty"', 'start = { tnk = "empty" }', "Did you mean 'tank'"),
        ('"brine.mass_flow"', '"tank.mas"', "Did you mean 'mass'"),
        ('"0, 30, 31 min"', '"0, 31, 30 min"', "times that increase"),
    ],
)
def test_wrong_dynamics_say_what(old: str, new: str, message: str) -> None:
    with pytest.raises(GranumError, match=message):
        gr.cases.read_text(CASE.replace(old, new))


def test_cycles_of_batch_units() -> None:
    run = gr.read(EXAMPLES / "batch-pharma" / "line.toml").solve()
    plan = run.schedule()
    assert list(plan.cycles) == ["crystallizer", "filter", "oven"]
    assert plan.cycles["crystallizer"].length == pytest.approx(7200.0)
    for cycle in plan.cycles.values():
        assert sum(p.duration for p in cycle.phases) == pytest.approx(cycle.length)
    chart = plan.chart()
    assert chart.layout.yaxis.type == "category"  # on an axis of numbers bars with names are not drawn
    assert all(len(bar.y) for bar in chart.data)
    assert len(chart.data) >= 4
