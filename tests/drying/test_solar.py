"""Sun and wind: limits and an independent solution of each formula, a hundred random ordinary settings."""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.dust.test_collectors import alone
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.cases.reading import read_text
from granum.core.errors import ConvergenceError
from granum.drying.equipment.solar import SolarDryer
from granum.drying.gas_solid.kinetics import VanMeelKinetics
from granum.drying.isotherms.products import PRODUCTS
from granum.materials.formulas.steam import water_heat_of_vaporization
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

MIXTURE = mixture_of(["water"], ["sucrose"], ["dry air", "water"], [8e-3, 12e-3])
FRUIT = VanMeelKinetics(1.5, isotherm=PRODUCTS["potato"]())
GAMMA_WIND = 67.4 * 6.43e6 / 86400.0 / 1e3  # W/(m² K): heat transfer that belongs to Penman's wind


def test_the_collector_of_duffie_and_its_ends() -> None:
    """F_R = 0.797 (their example, remembered); with endless flow the efficiency factor itself; without any
    the plate at which gain and loss are equal.
    """
    given = {
        "irradiance": 800.0,
        "area_collector": 2.0,
        "temperature_inlet": 293.15,
        "temperature_air": 293.15,
    }
    more = {
        "transmittance_absorptance": 0.8,
        "heat_loss_coefficient": 8.0,
        "collector_efficiency_factor": 0.841,
    }
    found = gr.drying.solar_collector(**given, **more, mass_flow=0.03, specific_heat_capacity=4190.0)
    assert float(found.heat_removal_factor) == pytest.approx(0.797, abs=1e-3)
    much = gr.drying.solar_collector(**given, **more, mass_flow=1e4)
    assert float(much.heat_removal_factor) == pytest.approx(0.841, rel=1e-5)
    little = gr.drying.solar_collector(**given, **more, mass_flow=1e-5)
    assert float(little.temperature_outlet) == pytest.approx(293.15 + 0.8 * 800.0 / 8.0, rel=1e-6)


def test_the_collector_is_that_of_small_pieces() -> None:
    """Air warmed strip by strip, each losing by the temperature of its own air, in a hundred settings."""
    x = np.random.default_rng(12).uniform(size=(100, 6))
    G, A, m = 200.0 + 800.0 * x[:, 0], 1.0 + 20.0 * x[:, 1], 0.02 + 0.5 * x[:, 2]
    loss, factor, inlet = 3.0 + 6.0 * x[:, 3], 0.6 + 0.3 * x[:, 4], 290.0 + 20.0 * x[:, 5]
    found = gr.drying.solar_collector(
        G, A, m, inlet, 295.0, heat_loss_coefficient=loss, collector_efficiency_factor=factor
    )
    T, n = inlet.copy(), 4000
    for _strip in range(n):
        T += A / n * factor * (0.8 * G - loss * (T - 295.0)) / (m * 1007.0)
    assert np.asarray(found.temperature_outlet) == pytest.approx(T, abs=2e-2)
    assert np.asarray(found.heat_duty) == pytest.approx(
        m * 1007.0 * (np.asarray(found.temperature_outlet) - inlet), rel=1e-9
    )


def test_penman_is_the_wet_surface_within_its_straight_line() -> None:
    """Balances of heat and mass of the surface without Penman's straight line, with the heat transfer that
    belongs to his wind: within 6 % where the surface is within four kelvin of the air.
    """
    u = np.random.default_rng(13).uniform(size=(4, 100))
    wind, T, phi, net = 0.5 + 5.0 * u[0], 283.0 + 25.0 * u[1], 0.3 + 0.6 * u[2], 20.0 + 250.0 * u[3]
    exact = gr.drying.drying_rate_assisted(
        temperature=T,
        humidity_ratio=gr.humid_gas.state(temperature=T, relative_humidity=phi).humidity_ratio,
        heat_transfer_coefficient=GAMMA_WIND * (1.0 + 0.536 * wind),
        radiated_heat=net,
    )
    near = np.abs(np.asarray(exact.surface_temperature) - T) < 4.0
    flux = np.asarray(gr.drying.drying_flux_penman(net, wind, T, phi))
    assert near.sum() > 20
    assert flux[near] == pytest.approx(np.asarray(exact.drying_rate_constant)[near], rel=0.06)


def test_what_sun_and_wind_do_apart() -> None:
    """At saturation Δ/(Δ + γ) of the radiation, 0.145/(0.145 + 0.067) at 20 °C (FAO's tables, remembered);
    without radiation 30 °C, 40 % and 3 m/s take 0.067/0.310 · 6.43 · 2.608/2.43 · 2.546 = 3.81 mm a day.
    """
    latent = float(water_heat_of_vaporization(293.15))
    share = float(gr.drying.drying_flux_penman(300.0, 3.0, 293.15, 1.0)) * latent / 300.0
    assert share == pytest.approx(0.145 / 0.212, abs=0.005)
    windy = float(gr.drying.drying_flux_penman(0.0, 3.0, 303.15, 0.4)) * 86400.0
    assert windy == pytest.approx(3.81, rel=0.01)
    dry, moist = (float(gr.drying.drying_flux_penman(200.0, 2.0, 300.0, phi)) for phi in (0.3, 0.8))
    assert dry > moist


def test_a_chimney_draws_by_the_weight_of_its_air() -> None:
    warm = gr.drying.chimney_draft(5.0, "45 degC", "25 degC")
    assert float(warm.pressure_drop) == pytest.approx(9.81 * 5.0 * (1.184 - 1.110), rel=0.01)
    assert float(warm.velocity) ** 2 * 5.0 * 0.5 * 1.110 == pytest.approx(float(warm.pressure_drop), rel=2e-3)
    cold = gr.drying.chimney_draft(5.0, "20 degC", "25 degC")
    assert float(cold.pressure_drop) == 0.0
    assert float(cold.velocity) == 0.0


def slices(moisture: Any = 4.0, flow: Any = 5.2e-5, temperature: Any = 300.0) -> Stream:
    return empty(MIXTURE, temperature).replace(
        solid=jnp.reshape(jnp.asarray(flow), (1, 1)), liquid=jnp.reshape(jnp.asarray(flow * moisture), (1,))
    )


def outside(flow: Any = 0.1, humidity: Any = 0.011, temperature: Any = 304.0) -> Stream:
    return empty(MIXTURE, temperature).replace(gas=jnp.stack([flow, flow * humidity]))


@pytest.mark.long
def test_the_sun_of_a_dryer_is_that_of_its_collector() -> None:
    """With air that enters as it is outside the efficiency is F_R τα all day: half a sine has 2/π of its top.
    The hottest air is that of the collector in the middle of the day.
    """
    made = SolarDryer(10.0, 0.03, 120.0, FRUIT, intervals=16).operate(feed=slices(), gas=outside()).figures
    noon = gr.drying.solar_collector(900.0, 10.0, 0.2022, 304.0, 304.0, specific_heat_capacity=1018.0)
    assert float(made.solar_efficiency) == pytest.approx(float(noon.heat_removal_factor) * 0.8, rel=3e-3)
    assert float(made.temperature_air_highest) == pytest.approx(float(noon.temperature_outlet), abs=0.2)
    sunshine = 10.0 * 900.0 * 2.0 / np.pi * 0.5
    assert float(made.heat_duty) == pytest.approx(float(made.solar_efficiency) * sunshine, rel=1e-9)
    assert 0.05 < float(made.drying_efficiency) < 0.35


def test_without_sun_it_is_air_through_a_layer() -> None:
    """No heat; the product of two long days in much air comes to the equilibrium of that air."""
    dark = SolarDryer(10.0, 0.02, 120.0, FRUIT, days=4, irradiance=0.0)
    made = dark.operate(feed=slices(1.0, 1e-5), gas=outside(0.3))
    assert float(made.figures.heat_duty) == pytest.approx(0.0, abs=1e-6)
    low = float(PRODUCTS["potato"]().moisture(0.391, 304.0))
    assert float(made.figures.moisture_dry_basis) == pytest.approx(low, rel=0.05)


@pytest.mark.long
def test_a_hundred_solar_dryers_keep_their_books() -> None:
    """Water and heat close; a larger collector leaves the product no wetter."""
    x = np.random.default_rng(14).uniform(size=(100, 8))

    @jax.jit
    @jax.vmap
    def run(u: Any) -> Any:
        area = 5.0 + 45.0 * u[0]
        feed = slices(1.0 + 5.0 * u[1], area * 2e-6 * 8.0 ** u[2], 285.0 + 20.0 * u[3])
        gas = outside(area * 0.004 * 6.0 ** u[4], 0.004 + 0.01 * u[5], 293.0 + 15.0 * u[6])

        def made(larger: Any) -> Any:
            dryer = SolarDryer(
                area * larger,
                0.02 + 0.05 * u[7],
                120.0,
                FRUIT,
                days=2,
                irradiance=500.0 + 500.0 * u[3],
                layers=4,
                steps=4,
                intervals=4,
            )
            inside = dryer.inside(feed, gas)
            outlets = dryer.outlets(inside, feed, gas)
            return outlets, dryer.figures(inside, outlets, feed, gas)

        outlets, figures = made(1.0)
        product, exhaust, duty = outlets
        water = product.liquid_flow + exhaust.gas[1] - feed.liquid_flow - gas.gas[1]
        heat = product.enthalpy_flow + exhaust.enthalpy_flow - feed.enthalpy_flow - gas.enthalpy_flow - duty
        wetter = made(1.2)[1].moisture_dry_basis - figures.moisture_dry_basis
        return water / feed.liquid_flow, heat / duty, wetter

    water, heat, wetter = run(x)
    assert np.abs(water).max() < 1e-9
    assert np.abs(heat).max() < 1e-9
    assert np.all(wetter < 1e-9)


@pytest.mark.long
def test_steam_is_refused_and_scorched_product_is_told() -> None:
    with pytest.raises(ConvergenceError, match="not blown with steam"):
        alone(
            SolarDryer(10.0, 0.03, 120.0, FRUIT),
            feed=slices(),
            gas=empty(MIXTURE, 400.0).replace(gas=jnp.asarray([0.0, 0.1])),
        )
    hot = SolarDryer(40.0, 0.03, 120.0, FRUIT, temperature_limit=333.15)
    checks = {c.name: c.ok for c in hot.operate(feed=slices(), gas=outside()).checks}
    assert not checks["product temperature over its limit"]


def test_no_chimney_draws_what_is_colder_than_the_air_outside() -> None:
    (unit,) = gr.alone("drying.solar_dryer", area_collector="1 m2").solve().units.values()
    assert float(unit.values.temperature_exhaust) < 273.15 + 33.0
    assert float(unit.values.height_chimney) == 0.0


def test_fruit_of_two_days_and_a_fan_before_it() -> None:
    """The example: a tenth to a third of the sunshine evaporates water, as is said of dryers with a fan (Leon
    et al. 2002, remembered); with a fan drawn into the line its own is not counted.
    """
    text = (EXAMPLES / "dryers" / "solar.toml").read_text(encoding="utf-8")
    run = gr.read(EXAMPLES / "dryers" / "solar.toml").solve()
    assert all(c.ok for c in run.units["dryer"].checks)
    assert 0.1 < run.figure("dryer.drying_efficiency") < 0.35
    wet = float(run.streams["slices"].mass_flow) * 2.0 * 86400.0
    assert wet == pytest.approx(44.0, rel=1e-9)
    blown = text.replace('to = "dryer.gas"', 'to = "fan.feed"').replace(
        "[streams]",
        '[units.fan]\nmodel = "streams.fan"\npressure_rise = "50 Pa"\n\n[streams]\n'
        'blown = ["fan.product", "dryer.gas"]',
    )
    other = read_text(blown).solve()
    assert max(other.audit["mass_closure"], other.audit["energy_closure"]) < 1e-9
    assert "electric_power_fan" not in other.units["dryer"].counted
    assert other.figure("dryer.temperature_air_highest") > run.figure("dryer.temperature_air_highest")
