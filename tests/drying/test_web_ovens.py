"""Webs under jets, infrared and high frequency: Martin's best array, the wet bulb, the balance of heat."""

from __future__ import annotations

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import pytest
from tests.dust.test_collectors import alone

import granum as gr
from granum.core.errors import ConvergenceError, InputError
from granum.drying.equipment.web_ovens import ImpingementDryer, RadiantDryer
from granum.drying.formulas.assisted import drying_rate_assisted
from granum.drying.formulas.impingement import nusselt_number_impinging_slots
from granum.drying.radiant_heat import DielectricField, InfraredEmitter
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

MIXTURE = mixture_of(["water"], ["cellulose"], ["dry air", "water"], [1e-5, 5e-5])
FEED = empty(MIXTURE, 298.15).replace(solid=jnp.full((1, 1), 400 / 3600), liquid=jnp.array([280 / 3600]))
AIR = empty(MIXTURE, 293.15).replace(gas=jnp.array([0.83, 0.006]))
STENTER = {
    "width": 1.8,
    "length": 2.0,
    "dry_mass_per_area": 0.15,
    "temperature_air": 423.15,
    "gas_velocity": 20.0,
}


@eqx.filter_jit
def _operated(unit):
    run = unit.operate(feed=FEED, gas=AIR)
    return run.figures, run.outlets.heat_duty


def stenter(**change):
    given = STENTER | change
    return _operated(
        ImpingementDryer(**{k: jnp.asarray(v) if isinstance(v, float) else v for k, v in given.items()})
    )


def test_martins_best_array_of_slots() -> None:
    """For a given fan power per area and distance H Martin states slots of 0.1 H at a pitch of 1.4 H, that is
    f = 0.072: the maximum of h over width and pitch, with f u³ constant, lies there.
    """
    B, S = np.linspace(0.03, 0.3, 136)[:, None], np.linspace(0.6, 3.0, 121)[None, :]
    f = B / S
    nusselt = nusselt_number_impinging_slots.function(1e4 * 2 * B * f ** (-1 / 3), 0.7, f, 1.0 / (2 * B))
    h = np.asarray(nusselt) / (2 * B)
    i, j = np.unravel_index(h.argmax(), h.shape)
    assert B[i, 0] == pytest.approx(0.1, abs=0.004)
    assert S[0, j] == pytest.approx(1.4, abs=0.04)
    assert f[i, j] == pytest.approx(0.072, abs=0.003)


def test_a_wet_web_stands_at_the_wet_bulb() -> None:
    """Far from dry, web and flux are those of a wet surface with the same coefficient in the oven's air."""
    figures, _heat = stenter()
    wet = drying_rate_assisted(
        423.15, float(figures.humidity_ratio), float(figures.heat_transfer_coefficient)
    )
    assert float(figures.temperature_product) == pytest.approx(float(wet.surface_temperature), abs=1.5)
    flux = 2.0 * float(wet.drying_rate_constant)  # both sides; less what warming up takes
    assert 0.7 * flux < float(figures.evaporation_per_area) < 1.05 * flux


def test_what_the_heater_gives_is_heat_of_air_and_vapor() -> None:
    """Fresh air to 150 °C, water to vapor of 150 °C, the web warmed."""
    figures, heat = stenter()
    air = float(AIR.enthalpy_at(423.15) - AIR.enthalpy_flow)
    vapor = float(figures.evaporation_rate) * (2.501e6 + 1.87e3 * 150.0 - 4186.0 * 25.0)
    web = (400 * 1300.0 + 280 * 4186.0) / 3600 * (float(figures.temperature_product) - 298.15)
    assert float(heat) == pytest.approx(air + vapor + web, rel=0.05)
    assert float(figures.heat_duty_radiant) == 0.0


def test_faster_jets_hotter_air_and_a_booster_dry_further() -> None:
    base = float(stenter()[0].moisture_dry_basis)
    assert float(stenter(gas_velocity=30.0)[0].moisture_dry_basis) < base
    assert float(stenter(temperature_air=453.15)[0].moisture_dry_basis) < base
    field = DielectricField(2.712e7, 2e4, 1e-3)
    boosted, _heat = stenter(radiant_heat=field)
    assert float(boosted.moisture_dry_basis) < base
    assert float(boosted.heat_duty_radiant) > 0.0


def test_a_field_alone_evaporates_what_it_gives() -> None:
    """In still air at the web's temperature, all heat of the field makes vapor once the web is warm."""
    oven = RadiantDryer(
        width=1.8,
        length=4.0,
        dry_mass_per_area=0.15,
        radiant_heat=DielectricField(2.712e7, 2e4, 1e-3, loss_factor_dry=2.0, loss_factor_slope=0.0),
        heat_transfer_coefficient=1.0,
        temperature_air=330.0,
    )
    figures, _heat = _operated(oven)
    warm = (400 * 1300.0 + 280 * 4186.0) / 3600 * (float(figures.temperature_product) - 298.15)
    vapor = float(figures.evaporation_rate) * 2.34e6
    assert float(figures.heat_duty_radiant) == pytest.approx(warm + vapor, rel=0.06)
    by_hand = 0.556e-10 * 2.712e7 * 2.0 * 2e4**2 * 1e-3 * 1.8 * 4.0  # Metaxas and Meredith, W
    assert float(figures.heat_duty_radiant) == pytest.approx(by_hand, rel=0.01)


def test_emitters_on_two_sides_give_twice_and_microwaves_decay() -> None:
    one, two = (InfraredEmitter(1000.0, sides=n) for n in (1.0, 2.0))
    assert float(two(0.5, 350.0)) == pytest.approx(2.0 * float(one(0.5, 350.0)))
    thin, thick = (
        DielectricField(2.45e9, 1e4, L, loss_factor_dry=10.0, dielectric_constant=50.0) for L in (1e-4, 1.0)
    )
    power = 2.0 * np.pi * 2.45e9 * 8.8541878128e-12 * 10.0 * 1e8
    assert float(thin(0.0, 300.0)) == pytest.approx(power * 1e-4, rel=0.01)
    assert float(thick(0.0, 300.0)) < 0.02 * power  # of a meter: the depth is 14 mm


def test_a_web_that_would_burn_is_refused() -> None:
    """Dry under emitters of 900 °C it was followed past the critical point of water, to 1700 °C: hotter than
    what heats it.
    """
    emitter = InfraredEmitter(1173.15, view_factor=0.7)
    oven = RadiantDryer(width=1.8, length=3.0, dry_mass_per_area=0.15, radiant_heat=emitter)
    with pytest.raises(ConvergenceError, match="dry and heats on"):
        alone(oven, feed=FEED, gas=AIR)


@pytest.mark.long
def test_sized_length_reaches_its_moisture() -> None:
    given = {k: v for k, v in STENTER.items() if k != "length"}
    unit = ImpingementDryer.size(0.07, FEED, AIR, **given)
    assert float(stenter(length=float(unit.length))[0].moisture_dry_basis) == pytest.approx(0.07, abs=1e-4)
    with pytest.raises(InputError, match="This oven dries"):
        ImpingementDryer.size(3.0, FEED, AIR, **given)


def test_a_stenter_with_too_much_fresh_air_is_told() -> None:
    """BREF for textiles, § 4.8.1: 0.1 to 0.15 kg of water per kg of dry air; 0.05 is air wasted."""

    def told(**more: str) -> tuple[float, bool]:
        oven = gr.alone("drying.impingement_dryer", **more).solve().units["impingement_dryer"]
        (check,) = [c for c in oven.checks if c.name == "water vapor per dry air in the exhaust"]
        return float(check.value), bool(check.ok)

    assert told() == (pytest.approx(0.09, abs=0.01), True)
    wasted, ok = told(**{"gas.gas_flow": "9 t/h"})
    assert wasted < 0.05
    assert not ok
