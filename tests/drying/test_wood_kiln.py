"""Boards in a kiln: what a specialist states for red oak, a scheme of its own, Crank's plate, a hundred
random charges.
"""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.optimize import root_scalar
from tests.dust.test_collectors import alone
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.core.errors import ConvergenceError
from granum.drying.boards import Board, followed, reached
from granum.drying.equipment.wood_kiln import WoodKiln
from granum.drying.formulas.wood import schedule_of
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

MIXTURE = mixture_of(["water"], ["cellulose"], ["dry air", "water"], [2e-2, 4e-2])
DAY, OAK = 86400.0, schedule_of("T4", "D", "2")


def boards(moisture: Any, flow: Any = 4.4e-3, temperature: Any = 288.15) -> Stream:
    return empty(MIXTURE, temperature).replace(
        solid=jnp.reshape(jnp.asarray(flow), (1, 1)), liquid=jnp.reshape(jnp.asarray(flow * moisture), (1,))
    )


def air(flow: Any = 0.145, humidity: Any = 0.006, temperature: Any = 288.15) -> Stream:
    return empty(MIXTURE, temperature).replace(gas=jnp.stack([flow, flow * humidity]))


def test_green_red_oak_takes_the_weeks_and_the_daily_loss_that_are_told() -> None:
    """Wengert, read: 4/4 red oak of 80 % takes around 45 days, which another operator calls ten days above
    the average; 3.8 % a day at most while wet, 3.0 % on average from 75 to 6.8 %, which is 23 days.
    """
    green = WoodKiln(0.0286, 0.07).operate(feed=boards(0.8), gas=air()).figures
    assert 33.0 < float(green.drying_time) / DAY < 46.0
    usual = gr.read(EXAMPLES / "dryers" / "wood-kiln.toml").solve().units["kiln"].values
    assert float(usual.drying_time) / DAY == pytest.approx(0.682 / 0.03, rel=0.2)
    assert float(usual.daily_loss) == pytest.approx(0.038, rel=0.1)


def test_the_first_step_is_humid_and_later_ones_are_not() -> None:
    """110 and 106 °F are 87 % of relative humidity in psychrometric tables; each drier load has air no less
    hot and no moister.
    """
    first = gr.drying.kiln_air(0.6)
    assert float(first.relative_humidity) == pytest.approx(0.87, abs=0.01)
    found = [gr.drying.kiln_air(x) for x in (0.6, 0.45, 0.37, 0.32, 0.27, 0.22, 0.17, 0.1)]
    dry = np.array([float(a.temperature) for a in found])
    apart = dry - np.array([float(a.wet_bulb_temperature) for a in found])
    assert np.all(np.diff(dry) >= 0.0)
    assert np.all(np.diff(apart) >= -1e-9)


def test_below_saturation_it_is_cranks_plate() -> None:
    """One step of the schedule (82.2 °C, 3.63 %), one diffusivity, no film."""
    D = 19.2e-4 * np.exp(-5280.0 / 355.372)
    board = Board(0.0127, 560.0, 1e7, (19.2e-4, 5280.0 * 8.31446, 0.0))
    low = float(gr.drying.kiln_air(0.1).moisture_dry_basis_equilibrium)
    found = followed(board, OAK, 0.14, 0.06, 101325.0)
    ratio = (0.06 - low) / (0.14 - low)
    fourier = root_scalar(
        lambda fo: float(gr.drying.moisture_ratio_plate(fo, half_thickness=1.0, diffusivity=1.0)) - ratio,
        bracket=(0.01, 3.0),
    ).root
    assert float(reached(found, 0.14, 0.06)[0]) == pytest.approx(fourier * 0.0127**2 / D, rel=0.01)


def explicit(first: float, last: float, thickness: float, h: float, cells: int = 16) -> float:
    """Time by small explicit steps, with constants and psychrometry of their own."""
    pressure = lambda T: 611.2 * np.exp(17.62 * (T - 273.15) / (T - 30.03))  # noqa: E731
    width = 0.5 * thickness / cells
    X, time = np.full(cells, first), 0.0
    kelvin = lambda f: (f + 459.67) / 1.8  # noqa: E731
    while X.mean() > last:
        m = X.mean()
        T = kelvin((110, 120, 130, 140, 180)[sum(m < b for b in (0.3, 0.25, 0.2, 0.15))])
        wet = T - (4, 5, 8, 14, 30, 50)[sum(m < b for b in (0.5, 0.4, 0.35, 0.3, 0.25))] / 1.8
        phi = (pressure(wet) - 66.0 * (T - wet)) / pressure(T)
        low = float(gr.drying.equilibrium_moisture(phi, isotherm="isotherm_hailwood_horrobin", temperature=T))
        full = 0.3 - 1e-3 * (T - 293.15)
        P = np.minimum(X, full)
        conducted = 560.0 * 19.2e-4 * np.exp(-5280.0 / T) * np.exp(1.15 * P) / width
        film = h * (T - wet) / 2.4e6 / (full - low)
        flow = np.append(
            2.0 / (1.0 / conducted[1:] + 1.0 / conducted[:-1]) * -np.diff(P),
            (P[-1] - low) / (1.0 / film + 0.5 / conducted[-1]),
        )
        step = 0.2 * 560.0 * width / conducted.max()
        X = X - step * np.diff(flow, prepend=0.0) / (560.0 * width)
        time += step
    return time


def test_a_scheme_of_small_steps_takes_as_long() -> None:
    made = WoodKiln(0.0254, 0.08).operate(feed=boards(0.6), gas=air()).figures
    time = explicit(0.6, 0.08, 0.0254, float(made.heat_transfer_coefficient))
    assert float(made.drying_time) == pytest.approx(time, rel=0.03)


def test_thick_boards_take_nearly_the_square_and_hot_schedules_less() -> None:
    def days(**more: Any) -> float:
        given: dict[str, Any] = {"thickness": 0.0254, "moisture_outlet": 0.08}
        return (
            float(WoodKiln(**(given | more)).operate(feed=boards(0.7), gas=air()).figures.drying_time) / DAY
        )

    assert 3.5 < days(thickness=0.0508) / days() < 4.05
    assert days(temperature_schedule="T8", depression_schedule="3") < 0.8 * days()
    assert days(diffusivity_preexponential=2.0 * 19.2e-4) < 0.6 * days()


@pytest.mark.long
def test_a_hundred_charges_keep_their_books() -> None:
    """Water and heat close; wetter and thicker boards take longer; the core ends no drier than the mean,
    nor the surface wetter.
    """
    x = np.random.default_rng(11).uniform(size=(100, 8))

    @jax.jit
    @jax.vmap
    def run(u: Any) -> Any:
        first, last = 0.3 + 0.9 * u[0], 0.06 + 0.12 * u[1]
        gas = air(0.05 * 10.0 ** u[3], 0.002 + 0.012 * u[4], 275.0 + 25.0 * u[5])

        def made(thicker: Any, wetter: Any) -> Any:
            kiln = WoodKiln(
                (0.019 + 0.04 * u[2]) * thicker,
                last,
                350.0 + 350.0 * u[6],
                diffusivity_preexponential=19.2e-4 * 6.0 ** u[7],
            )
            feed = boards(first * wetter, 3e-3)
            inside = kiln.inside(feed, gas)
            outlets = kiln.outlets(inside, feed, gas)
            return feed, outlets, kiln.figures(inside, outlets, feed, gas)

        feed, outlets, figures = made(1.0, 1.0)
        product, exhaust, duty = outlets
        water = product.liquid_flow + exhaust.gas[1] - feed.liquid_flow - gas.gas[1]
        heat = product.enthalpy_flow + exhaust.enthalpy_flow - feed.enthalpy_flow - gas.enthalpy_flow - duty
        time = figures.drying_time
        return (
            water / feed.liquid_flow,
            heat / abs(duty),
            made(1.1, 1.0)[2].drying_time / time,
            made(1.0, 1.1)[2].drying_time / time,
            (figures.moisture_dry_basis_center >= last - 1e-6)
            & (figures.moisture_dry_basis_surface <= last + 1e-6),
        )

    water, heat, thicker, wetter, ordered = run(x)
    assert np.abs(water).max() < 1e-9
    assert np.abs(heat).max() < 1e-9
    assert np.all((thicker > 1.08) & (thicker < 1.22))
    assert np.all(wetter > 1.0)
    assert np.all(ordered)


def test_what_the_schedule_does_not_reach_is_told_and_little_air_fails() -> None:
    with pytest.raises(ConvergenceError, match="do not reach that moisture by the schedule"):
        alone(WoodKiln(0.0254, 0.03), feed=boards(0.6), gas=air())
    made = WoodKiln(0.0254, 0.08).operate(feed=boards(0.6), gas=air(0.02))
    assert not {c.name: c.ok for c in made.checks}["fresh air over what the schedule asks for"]


def test_boards_that_are_dry_already_ask_for_no_air_and_say_so() -> None:
    (unit,) = gr.alone("drying.wood_kiln", moisture_outlet=0.9).solve().units.values()
    assert float(unit.values.gas_flow_vented) == 0.0
    assert float(unit.values.drying_time) == 0.0
    failed = {check.name for check in unit.checks if not check.ok}
    assert failed == {"drying time of a charge", "moisture of the product against the specification"}
