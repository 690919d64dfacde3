"""Layers on hot shelves under vacuum: machines of a textbook, Neumann's solution, heat over the batch, a
hundred random machines.
"""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.optimize import root_scalar
from scipy.special import erf
from tests.dust.test_collectors import alone

from granum.core.errors import ConvergenceError
from granum.drying.equipment.vacuum_shelves import VacuumShelfDryer
from granum.drying.formulas.contact_layers import contact_layer_drying
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

MIXTURE = mixture_of(["water"], ["calcite"], ["dry air", "water"], [1e-6, 2e-5])
POUND_PER_SQUARE_FOOT, INCH = 4.8824, 0.0254


def paste(moisture: Any, flow: Any = 1.0 / 360.0, temperature: Any = 293.15) -> Stream:
    return empty(MIXTURE, temperature).replace(
        solid=jnp.reshape(jnp.asarray(flow), (1, 1)), liquid=jnp.reshape(flow * jnp.asarray(moisture), (1,))
    )


def machine(**more: Any) -> VacuumShelfDryer:
    given: dict[str, Any] = {
        "temperature_shelf": 343.15,
        "pressure_chamber": 6.8e3,
        "thickness": 0.05,
        "bulk_density_dry": 500.0,
        "moisture_outlet": 0.008,
    }
    return VacuumShelfDryer(**(given | more))


@pytest.mark.parametrize(
    ("depth", "wet", "dry", "load", "hottest", "absolute", "hours", "rate"),
    [
        (2.0, 0.493, 0.0075, 10.2, 70.0, 1.92, 36.0, 0.14),
        (1.0, 0.724, 0.0125, 6.1, 40.0, 0.42, 15.0, 0.293),
    ],
    ids=["paint pigment", "aspirin"],
)
def test_machines_of_walas_dry_with_the_conductivity_of_powders(
    depth, wet, dry, load, hottest, absolute, hours, rate
) -> None:
    """Table 9.6b, read: depth in, wet basis, lb wet per ft², °C, inches of mercury that are left, hours. The
    time printed asks for a conductivity between that of dry powder and of water in wet paste (0.43 and 0.80;
    the temperature printed may be that of the product, and then less); the rate printed follows from the rest
    of its row.
    """
    wet_load = load * POUND_PER_SQUARE_FOOT
    feed = paste(wet / (1.0 - wet))

    def made(k: float) -> Any:
        return machine(
            temperature_shelf=hottest + 273.15,
            pressure_chamber=absolute * 3386.0,
            thickness=depth * INCH,
            bulk_density_dry=wet_load * (1.0 - wet) / (depth * INCH),
            moisture_outlet=dry / (1.0 - dry),
            thermal_conductivity_dry=k,
        ).operate(feed=feed)

    conductivity = root_scalar(
        lambda k: float(made(k).figures.drying_time) / 3600.0 - hours, bracket=(0.05, 5.0), xtol=1e-3
    ).root
    assert 0.1 < conductivity < 1.0
    found = made(conductivity).figures
    printed = rate * POUND_PER_SQUARE_FOOT / 3600.0
    assert float(found.evaporation_per_area) == pytest.approx(printed, rel=0.02)


def test_without_contact_resistance_it_is_neumanns_solution() -> None:
    """√π λ exp(λ²) erf λ = Ste and z = 2 λ √(κt); the straight profile errs by less than a quarter of Ste."""
    k, density, capacity, X, latent, span, depth = 0.2, 500.0, 1000.0, 0.5, 2.4e6, 60.0, 0.03
    stefan = capacity * span / (X * latent)
    front = root_scalar(
        lambda x: np.sqrt(np.pi) * x * np.exp(x * x) * erf(x) - stefan, bracket=(1e-6, 3.0)
    ).root
    exact = (depth / (2.0 * front)) ** 2 * density * capacity / k
    found = contact_layer_drying(depth, density, X, 0.0, 370.0, 310.0, 1e7, k, latent, capacity)
    assert found.drying_time == pytest.approx(exact, rel=0.25 * stefan)


def test_the_shelves_give_what_passes_the_contact() -> None:
    """Heat of a batch by the streams, and by the flux through contact and dry part as the front rises."""
    dryer, feed = machine(), paste(0.97)
    made = dryer.operate(feed=feed)
    figures, boiling = made.figures, float(made.figures.boiling_temperature)
    by_streams = float(figures.heat_duty_shelf * figures.cycle_time / figures.area)
    span, r = 343.15 - boiling, 1.0 / dryer.heat_transfer_coefficient
    depth = np.linspace(0.0, 0.05 * (1.0 - 0.008 / 0.97), 20001)
    resistance = r + depth / dryer.thermal_conductivity_dry
    latent, capacity = 2.4077e6, 830.0  # water at 38.5 °C, calcite
    held = 500.0 * depth * (0.97 * latent + 0.5 * capacity * span * (1.0 - r / resistance))
    time = np.sum(np.diff(held) * 0.5 * (resistance[1:] + resistance[:-1]) / span)
    assert float(figures.drying_time) == pytest.approx(time, rel=2e-3)
    warming = 25.0 * (capacity + 0.97 * 4180.0) * (boiling - 293.15)
    assert by_streams == pytest.approx(held[-1] + warming, rel=5e-3)


def test_a_hundred_machines_keep_their_books() -> None:
    """Water and heat close, what is hotter or thinner is quicker, all by one compilation."""
    x = np.random.default_rng(5).uniform(size=(100, 7))

    @jax.jit
    @jax.vmap
    def run(u: Any) -> Any:
        feed = paste(0.1 + 2.0 * u[0], 10.0 ** (-4.0 + 3.0 * u[1]), 278.0 + 25.0 * u[2])

        def made(hotter: Any, thinner: Any) -> Any:
            dryer = machine(
                temperature_shelf=335.0 + 60.0 * u[3] + hotter,
                pressure_chamber=2e3 * 5.0 ** u[4],
                thickness=(0.01 + 0.05 * u[5]) * thinner,
                moisture_outlet=0.09 * u[6],
            )
            inside = dryer.inside(feed)
            outlets = dryer.outlets(inside, feed)
            return outlets, dryer.figures(inside, outlets, feed)

        outlets, figures = made(0.0, 1.0)
        product, condensate, duty = outlets
        water = product.liquid_flow + condensate.liquid_flow - feed.liquid_flow
        heat = product.enthalpy_flow + condensate.enthalpy_flow - feed.enthalpy_flow - duty
        spared = figures.drying_time - made(5.0, 1.0)[1].drying_time
        thin = figures.drying_time - made(0.0, 0.9)[1].drying_time
        between = (figures.temperature_product > figures.boiling_temperature) & (
            figures.temperature_bottom < 335.0 + 60.0 * u[3]
        )
        return water / feed.liquid_flow, heat / abs(duty), spared, thin, between, figures.heat_duty_shelf

    water, heat, spared, thin, between, shelf = run(x)
    assert np.abs(water).max() < 1e-12
    assert np.nanmax(np.abs(heat)) < 1e-9
    assert np.all(np.isfinite(heat))
    assert np.all(spared > 0.0)
    assert np.all(thin > 0.0)
    assert np.all(between)
    assert np.all(shelf > 0.0)


def test_shelves_that_do_not_boil_are_told_and_warm_water_does_not_condense() -> None:
    with pytest.raises(ConvergenceError, match="no hotter than the moisture boils"):
        alone(machine(temperature_shelf=305.0), feed=paste(0.97))
    checks = {c.name: c for c in machine(temperature_condenser=311.0).operate(feed=paste(0.97)).checks}
    assert not checks["vapor pressure at the condenser per chamber pressure"].ok
    idle = machine().operate(feed=paste(0.005))
    assert float(idle.figures.evaporation_rate) == 0.0
    assert float(idle.figures.drying_time) == 0.0
