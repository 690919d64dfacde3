"""Grain in a bin over time: what extension services state, fronts of the balances, a hundred random bins."""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.dust.test_collectors import alone
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.core.errors import ConvergenceError
from granum.drying.equipment.grain_bin import GrainBin
from granum.drying.isotherms.products import PRODUCTS
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

MIXTURE = mixture_of(["water"], ["maize"], ["dry air", "water"], [6e-3, 10e-3])
CFM_PER_BUSHEL = 4.719e-4 / 25.4  # m³/s and kg of maize of the bushel of trade
DAY = 86400.0


def grain(moisture: Any, flow: Any, temperature: Any) -> Stream:
    return empty(MIXTURE, temperature).replace(
        solid=jnp.reshape(jnp.asarray(flow), (1, 1)), liquid=jnp.reshape(jnp.asarray(flow * moisture), (1,))
    )


def air(temperature: Any, relative_humidity: Any, dry: Any) -> Stream:
    """Humidity by Magnus."""
    vapor = relative_humidity * 611.2 * jnp.exp(17.62 * (temperature - 273.15) / (temperature - 30.03))
    humidity = 0.622 * vapor / (101325.0 - vapor)
    return empty(MIXTURE, temperature).replace(gas=jnp.stack([dry, dry * humidity]))


def wet_basis(X: Any) -> float:
    return float(X) / (1.0 + float(X))


def test_maize_dries_with_ambient_air_in_the_weeks_that_are_told() -> None:
    """Hellevang, read: from 20 % (wet basis) with air of 45 °F and 60 %, 1 cfm per bushel, 45 to 50 days, to
    14 to 14.5 %.
    """
    dryer = GrainBin(30.0, 4.0, layers=30)
    dry = float(dryer.extent() * dryer.bulk_density_dry)
    flow = CFM_PER_BUSHEL * dry * 1.25 * 1.24  # wet grain, density of the air
    made = gr.read(EXAMPLES / "dryers" / "grain-bin.toml").solve()  # 47.5 days
    assert float(made.streams["ambient_air"].gas_flow) == pytest.approx(flow, rel=0.01)
    assert wet_basis(made.figure("bin.moisture_dry_basis")) == pytest.approx(0.1425, abs=0.003)
    assert wet_basis(made.figure("bin.moisture_dry_basis_highest")) < 0.15
    early = dryer.operate(feed=grain(0.25, dry / (25.0 * DAY), 280.4), gas=air(280.4, 0.6, flow)).figures
    assert wet_basis(early.moisture_dry_basis_highest) > 0.18


@pytest.mark.long
def test_cold_air_carries_little_water_away() -> None:
    """100 000 lb of air of 47 °F and 70 % take up about 70 lb of water from maize of 21 % and bring it to
    16 % (Hellevang, read, of January 2020): a wet top still lies over what is dry.
    """
    isotherm = PRODUCTS["maize"]()
    assert wet_basis(isotherm.moisture(0.7, 281.5)) == pytest.approx(0.16, abs=0.006)
    dryer, X = GrainBin(30.0, 4.0), 0.21 / 0.79
    dry = float(dryer.extent() * dryer.bulk_density_dry)
    gas = air(281.5, 0.7, 2.0)
    made = dryer.operate(feed=grain(X, dry / (10.0 * DAY), 281.5), gas=gas).figures
    taken = float(made.evaporation_rate) / float(gas.gas_flow)
    assert taken == pytest.approx(70.0 / 1e5, rel=0.2)


def test_cooling_takes_the_hours_of_farms_and_the_water_of_farms() -> None:
    """At 0.1 cfm per bushel 100 to 200 h (extension services, read), and a quarter of a percent of moisture
    per 10 °F.
    """
    dryer = GrainBin(30.0, 5.0, layers=40)
    dry, X = float(dryer.extent() * dryer.bulk_density_dry), 0.17
    gas = air(288.15, 0.7, 0.1 * CFM_PER_BUSHEL * dry * (1.0 + X) * 1.22)

    def after(hours: float) -> Any:
        return dryer.operate(feed=grain(X, dry / (hours * 3600.0), 299.26), gas=gas)

    half, done = after(60.0), after(170.0)
    assert float(half.figures.temperature_product_highest) > 297.0
    assert float(done.figures.temperature_product_highest) < 290.0
    lost = wet_basis(X) - wet_basis(done.figures.moisture_dry_basis)
    fallen = 299.26 - float(done.figures.temperature_product)
    assert lost / fallen == pytest.approx(0.0025 / (10.0 / 1.8), rel=0.25)


@pytest.mark.long
def test_the_layers_end_where_the_fronts_end() -> None:
    """Behind both fronts the grain is at the temperature and moisture of the air; after half the time of the
    cooling front half of the bin is cold.
    """
    dryer = GrainBin(30.0, 5.0, layers=60, steps=80)
    dry = float(dryer.extent() * dryer.bulk_density_dry)
    gas = air(285.0, 0.6, 2.0)

    def after(time: float) -> Any:
        return dryer.operate(feed=grain(0.18, dry / time, 300.0), gas=gas)

    front = float(after(DAY).figures.time_cooling)
    assert float(after(0.5 * front).figures.temperature_product) == pytest.approx(
        0.5 * (300.0 + float(after(2.0 * front).figures.temperature_product)), abs=0.35
    )
    dried = after(3.0 * float(after(DAY).figures.time_drying)).figures
    assert float(dried.moisture_dry_basis) == pytest.approx(float(dried.moisture_dry_basis_highest), rel=1e-3)
    assert float(dried.temperature_product) == pytest.approx(285.0, abs=1e-3)
    assert float(dried.moisture_dry_basis) == pytest.approx(
        float(PRODUCTS["maize"]().moisture(0.6, 285.0)), rel=5e-3
    )


@pytest.mark.long
def test_a_hundred_bins_keep_their_books() -> None:
    """Water and heat close, more air brings the grain no farther from that of the air, and the water activity
    stays one.
    """
    x = np.random.default_rng(8).uniform(size=(100, 8))

    @jax.jit
    @jax.vmap
    def run(u: Any) -> Any:
        dryer = GrainBin(20.0 + 180.0 * u[0], 2.0 + 10.0 * u[1], layers=10, steps=25)
        time = DAY * (1.0 + 40.0 * u[2])
        T = 278.0 + 27.0 * u[3]
        feed = grain(0.11 + 0.17 * u[4], dryer.extent() * dryer.bulk_density_dry / time, T)
        Ta = 274.0 + 26.0 * u[5]
        gas = air(Ta, 0.3 + 0.55 * u[6], dryer.extent() * 3e-4 * 60.0 ** u[7] * 1.2)

        def made(more: Any) -> Any:
            blown = gas.replace(gas=gas.gas * more)
            inside = dryer.inside(feed, blown)
            outlets = dryer.outlets(inside, feed, blown)
            return blown, outlets, dryer.figures(inside, outlets, feed, blown)

        blown, outlets, figures = made(1.0)
        product, exhaust, duty = outlets
        water = product.liquid_flow + exhaust.gas[1] + exhaust.liquid_flow - feed.liquid_flow - blown.gas[1]
        heat = product.enthalpy_flow + exhaust.enthalpy_flow - feed.enthalpy_flow - blown.enthalpy_flow - duty
        low, high = figures.moisture_dry_basis_lowest, figures.moisture_dry_basis_highest
        mean = figures.moisture_dry_basis
        nearer = abs(made(1.3)[2].temperature_product - T) - abs(figures.temperature_product - T)
        return (
            water / feed.liquid_flow,
            heat / (abs(feed.enthalpy_flow) + abs(blown.enthalpy_flow) + feed.solid_flow * 1e4),
            (low <= mean + 1e-9) & (mean <= high + 1e-9),
            nearer,
            figures.water_activity_highest,
        )

    water, heat, ordered, nearer, activity = run(x)
    assert np.abs(water).max() < 1e-9
    assert np.abs(heat).max() < 1e-9
    assert np.all(ordered)
    assert np.all(np.isfinite(nearer))
    assert np.all((activity > 0.0) & (activity <= 1.0))


def test_a_bin_from_a_time_and_a_pressure() -> None:
    feed, gas = grain(0.15, 0.17, 293.15), air(285.15, 0.6, 0.6)
    sized = GrainBin.size(6.0 * DAY, feed, gas, 200.0)
    made = sized.operate(feed=feed, gas=gas).figures
    assert float(made.time_aeration) == pytest.approx(6.0 * DAY, rel=1e-9)
    assert float(made.pressure_drop) == pytest.approx(200.0, rel=1e-6)


def test_damp_air_on_cold_grain_and_steam_are_told() -> None:
    dryer = GrainBin(30.0, 5.0)
    warm = dryer.operate(feed=grain(0.15, 0.17, 278.0), gas=air(295.0, 0.8, 0.6))
    checks = {c.name: c.ok for c in warm.checks}
    assert not checks["dew point of the air above the grain's temperature"]
    assert not checks["water activity of the wettest grain"]
    cold = dryer.operate(feed=grain(0.2, 0.17, 300.0), gas=air(278.0, 0.6, 0.6))
    assert not {c.name: c.ok for c in cold.checks}["dew point of the moistest exhaust above the outside air"]
    with pytest.raises(ConvergenceError, match="not blown with steam"):
        alone(
            dryer,
            feed=grain(0.15, 0.17, 293.0),
            gas=empty(MIXTURE, 400.0).replace(gas=jnp.asarray([0.0, 0.6])),
        )
