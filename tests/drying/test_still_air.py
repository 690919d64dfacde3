"""Racks in still air: pools of Shah, the wet bulb, a cold plate by hand, heat over the batch,
random rooms, and what is refused.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import quad

import granum as gr
from granum.core.errors import GranumError
from granum.drying.equipment.still_air import StillAirDryer
from granum.drying.formulas.still_air import nusselt_number_plate_unstable, view_factor_rack
from granum.drying.isotherms.products import PRODUCTS
from granum.streams.equilibrium import HumidMixture
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

MIXTURE = mixture_of(["water"], ["sucrose"], ["dry air", "water"], [8e-3, 1.2e-2])
HUMID = HumidMixture(MIXTURE)
HOUR = 3600.0
SHAH = [  # Shah (2014), water, air, kg/(m² h) in air of 50 %; read from a program that carries his table
    (28.0, 28.0, 0.1360),
    (28.0, 29.0, 0.1171),
    (28.0, 30.0, 0.0968),
    (29.0, 28.0, 0.1651),
    (29.0, 29.0, 0.1463),
    (29.0, 30.0, 0.1268),
    (30.0, 28.0, 0.1959),
    (30.0, 30.0, 0.1575),
]


def air(celsius: Any, humidity: Any, flow: Any = 1.0) -> Stream:
    """Moist air at a relative humidity."""
    T = celsius + 273.15
    dry = empty(MIXTURE, T)
    y = humidity * HUMID.pair.saturated_fraction(jnp.asarray(T), 101325.0, False)
    w = HUMID.pair.humidity_ratio(y)
    place = [g.name for g in MIXTURE.gases].index("dry air")
    share = jnp.zeros(2).at[place].set(1.0 / (1.0 + w)).at[1 - place].set(w / (1.0 + w))
    return dry.replace(gas=flow * share, pressure=jnp.asarray(101325.0))


def herbs(moisture: Any = 4.0, flow: Any = 1.0 / HOUR) -> Stream:
    return empty(MIXTURE, 293.15).replace(
        solid=jnp.reshape(jnp.asarray(flow), (1, 1)), liquid=jnp.reshape(flow * jnp.asarray(moisture), (1,))
    )


def racks(**more: Any) -> StillAirDryer:
    given: dict[str, Any] = {
        "dry_mass_per_area": 1.0,
        "moisture_outlet": 0.2,
        "critical_moisture": 1.5,
        "tray_length": 2.0,
        "tray_width": 1.0,
    }
    return StillAirDryer(**(given | more))


@jax.jit
def wet(unit: StillAirDryer, room: Stream) -> Any:
    return unit.wet(HUMID, room, 275.0)


def shah(water: float, room: float, humidity: float) -> float:
    """His equation, kg/(m² h): 35 ρ (ρ_r − ρ)^⅓ (W − W_r) with the densities of the dry air alone, and
    Magnus's vapor pressure.
    """

    def state(celsius: float, phi: float) -> tuple[float, float]:
        vapor = phi * 611.2 * np.exp(17.62 * celsius / (243.12 + celsius))
        return (101325.0 - vapor) / (287.05 * (celsius + 273.15)), 0.622 * vapor / (101325.0 - vapor)

    (dense, wet_air), (quiet, room_air) = state(water, 1.0), state(room, humidity)
    return 35.0 * dense * np.cbrt(quiet - dense) * (wet_air - room_air)


def pool(water: float, room: float) -> float:
    """The same by natural convection, kg/(m² h)."""
    over = racks(tray_length=25.0, tray_width=10.0, gas_velocity=0.0).over_trays(HUMID, air(room, 0.5))
    above, _below = over.heat_transfer(water + 273.15)
    return float(over.evaporated(water + 273.15, above)) * HOUR


@pytest.mark.parametrize(("water", "room", "flux"), SHAH)
def test_the_equation_of_shah_gives_his_table(water: float, room: float, flux: float) -> None:
    assert shah(water, room, 0.5) == pytest.approx(flux, rel=0.02)


@pytest.mark.parametrize("water", [32.0, 40.0, 50.0, 60.0])
def test_warm_water_evaporates_into_quiet_air_as_shah_tells(water: float) -> None:
    """His mean deviation from the pools of eleven sources is 18 %."""
    assert pool(water, 25.0) == pytest.approx(shah(water, 25.0, 0.5), rel=0.18)


@pytest.mark.parametrize(("water", "room", "flux"), [row for row in SHAH if row[0] >= row[1]])
def test_where_the_air_barely_rises_pools_lose_more(water: float, room: float, flux: float) -> None:
    """A real hall has drafts: up to 30 % less are reckoned."""
    assert 0.7 * flux < pool(water, room) < flux


@pytest.mark.parametrize(("celsius", "humidity", "bulb"), [(20.0, 0.5, 13.8), (30.0, 0.3, 17.9)])
def test_what_sees_no_wall_lies_at_the_wet_bulb(celsius: float, humidity: float, bulb: float) -> None:
    """Wet bulbs of the psychrometric chart, °C."""
    found = wet(racks(emissivity=0.0), air(celsius, humidity))
    assert float(found.surface_temperature) - 273.15 == pytest.approx(bulb, abs=0.3)


def test_a_cold_tray_by_hand() -> None:
    """20 °C and 50 %, wet bulb 13.8 °C, 2 m by 1 m, no draft and no walls: the air at the surface is 1.9 %
    denser, Ra = 9.81 · 0.019 · (1/3)³/(1.51e-5 · 2.12e-5) = 2.2e7, Nu = 0.27 Ra^¼ = 18.4, h = 1.42 W/(m² K)
    above; below, 0.15 Ra^⅓ = 42 and 3.2. Both evaporate 4.6 · 6.2/2.47e6 = 11.6 mg/(m² s).
    """
    found = wet(racks(emissivity=0.0, gas_velocity=0.0, sides=2.0), air(20.0, 0.5))
    assert float(found.heat_transfer) == pytest.approx(4.6, rel=0.05)
    assert float(found.flux) == pytest.approx(11.6e-6, rel=0.06)


def test_the_time_is_that_of_the_rate_over_the_moisture() -> None:
    """Flux straight down to equilibrium below the critical moisture, integrated here."""
    unit = racks(equilibrium_moisture=0.05)
    made = unit.operate(feed=herbs(), gas=air(28.0, 0.4))
    flux = float(made.figures.drying_rate_constant)

    def slowness(X: float) -> float:
        return 1.0 / (flux * min(1.0, (X - 0.05) / 1.45))

    time = quad(slowness, 0.2, 1.5)[0] + quad(slowness, 1.5, 4.0)[0]
    assert float(made.figures.drying_time) == pytest.approx(time, rel=1e-6)
    assert float(made.figures.area) == pytest.approx(float(made.figures.cycle_time) / HOUR)


def test_an_unheated_room_cools_until_the_air_brings_the_heat() -> None:
    """Evaporation takes as much as the air gives, 4.2 K of 1 kg/s that takes up 1.7 g/s, by hand
    2.44e6 · 1.7e-3/1.0e3 less what feed and vapor bring.
    """
    feed, gas = herbs(flow=1.7e-3 / 3.8), air(28.0, 0.4)
    made = racks().operate(feed=feed, gas=gas)
    assert 28.0 + 273.15 - float(made.figures.temperature_room) == pytest.approx(4.1, abs=0.15)
    assert float(made.figures.heat_duty) == 0.0


def test_a_kept_room_takes_the_heat_of_evaporation() -> None:
    made = racks(temperature_room=301.15).operate(feed=herbs(), gas=air(28.0, 0.4))
    per_water = float(made.figures.heat_duty / made.figures.evaporation_rate)
    assert per_water == pytest.approx(2.43e6, rel=0.03)


def time_of(room: Stream | None = None, **more: Any) -> float:
    made = racks(**({"temperature_room": 301.15} | more)).operate(feed=herbs(), gas=room or air(28.0, 0.4))
    return float(made.figures.drying_time)


def test_what_makes_drying_faster() -> None:
    plain = time_of()
    assert time_of(air(28.0, 0.2)) < plain < time_of(air(28.0, 0.6))
    assert time_of(sides=2.0) < 0.6 * plain
    assert time_of(tray_gap=0.1) > time_of(tray_gap=0.3) > plain  # less is seen of the room
    assert time_of(gas_velocity=0.4) < plain
    assert time_of(temperature_room=313.15) < plain
    assert time_of(dry_mass_per_area=2.0) == pytest.approx(2.0 * plain)
    assert time_of(tray_length=20.0, tray_width=10.0, gas_velocity=0.0) > time_of(gas_velocity=0.0)


@pytest.mark.parametrize("room", [301.15, None])
def test_ventilation_keeps_the_room_at_its_limit(room: float | None) -> None:
    """With the air that is asked for the room has the humidity that it may have, heated or not."""
    unit = racks(temperature_room=room, relative_humidity_limit=0.6)
    asked = float(unit.operate(feed=herbs(), gas=air(20.0, 0.4)).figures.gas_flow_vented)
    again = unit.operate(feed=herbs(), gas=air(20.0, 0.4, asked)).figures
    assert float(again.relative_humidity) == pytest.approx(0.6, rel=1e-6)


def test_a_rack_sees_the_room_past_the_next_tray() -> None:
    assert float(view_factor_rack(1e3, 1.0)) == pytest.approx(1.0, abs=1e-3)
    assert float(view_factor_rack(1e-3, 1.0)) == pytest.approx(1e-3, rel=1e-2)
    # two nearly touching faces of the law for plates leave no jump where its lines cross
    near = 4.746e6
    below, above = (float(nusselt_number_plate_unstable(near * x)) for x in (0.999, 1.001))
    assert above == pytest.approx(below, rel=1e-3)


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"gas.gas_flow": "20 kg/h"}, "would be foggy"),
        ({"equilibrium_moisture": "25 %"}, "equilibrium moisture lies above"),
        ({"gas.temperature": "3 degC"}, "would freeze"),
        ({"temperature_room": "105 degC"}, "as hot as the liquid boils"),
    ],
)
def test_what_it_cannot_do_is_said(given: dict[str, str], says: str) -> None:
    with pytest.raises(GranumError, match=says):
        gr.alone("drying.still_air_dryer", **given).solve()


def test_an_isotherm_takes_the_humidity_of_the_room() -> None:
    """The driest that potato gets is what its isotherm has at the humidity and temperature of the room."""
    run = gr.alone("drying.still_air_dryer", isotherm="isotherm_potato", temperature_room="35 degC").solve()
    (unit,) = run.units.values()
    found = unit.values
    told = PRODUCTS["potato"]()(found.relative_humidity, found.temperature_room)
    assert found.equilibrium_moisture == pytest.approx(float(told), rel=1e-6)


def test_random_rooms_close_and_stay_between_wet_bulb_and_room() -> None:
    rng = np.random.default_rng(21)
    flows = 10.0 ** rng.uniform(0.0, 1.0, 25)
    for flow in flows:
        outside = rng.uniform(2.0, 30.0)
        unit = racks(
            temperature_room=273.15 + max(20.0, outside + 5.0) + rng.uniform(0.0, 15.0),
            sides=rng.uniform(1.0, 2.0),
            tray_length=rng.uniform(0.3, 20.0),
            tray_width=rng.uniform(0.3, 5.0),
            tray_gap=rng.uniform(0.05, 1.0),
            emissivity=rng.uniform(0.0, 1.0),
            gas_velocity=rng.choice([0.0, 0.05, 0.3]),
        )
        feed, gas = herbs(rng.uniform(0.3, 9.0)), air(outside, rng.uniform(0.1, 0.7), flow)
        made = unit.operate(feed=feed, gas=gas)
        out = made.outlets
        assert float(out.product.mass_flow + out.exhaust.mass_flow) == pytest.approx(
            float(feed.mass_flow + gas.mass_flow), rel=1e-12
        )
        found = made.figures
        assert float(found.surface_temperature) < float(found.temperature_room)
        assert float(found.drying_rate_constant) > 0.0
        still = wet(replace(unit, emissivity=0.0), made.inside.air)
        assert float(found.surface_temperature) >= float(still.surface_temperature) - 1e-6


def test_hotter_air_makes_it_faster_by_its_derivative() -> None:
    def flux(T: Any) -> Any:
        return wet(racks(), air(28.0, 0.3).replace(temperature=T)).flux

    slope = float(jax.grad(flux)(301.15))
    step = (float(flux(301.25)) - float(flux(301.05))) / 0.2
    assert slope == pytest.approx(step, rel=1e-4)
    assert slope > 0.0
