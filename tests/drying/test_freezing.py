"""Freezing times against printed examples, and freeze drying on trays against the vial, the slab and its own
energy balance.
"""

from __future__ import annotations

import jax
import pytest

import granum as gr
from granum.core.errors import ApplicabilityError, InputError
from granum.drying.equipment.freeze_trays import TrayFreezeDryer
from granum.drying.formulas.freeze_drying import freeze_drying_slab, primary_drying
from granum.drying.formulas.freeze_trays import freeze_drying_tray
from granum.drying.formulas.freezing import freezing_time_pham, freezing_time_plank
from granum.drying.formulas.vials import ICE_CONDUCTIVITY, ICE_DENSITY, SUBLIMATION_HEAT

BEEF = {
    "half_thickness": 0.035,
    "density": 1000.0,
    "temperature_freezer": 233.15,
    "heat_transfer_coefficient": 50.0,
    "thermal_conductivity": 1.2,
}
TRAY = {
    "temperature_shelf": 328.15,
    "pressure_chamber": 40.0,
    "thickness": 0.015,
    "thermal_conductivity_dry": 0.05,
    "vapor_permeability": 4e-8,
}


def test_singh_and_heldman_freeze_a_ball() -> None:
    """Their examples 7.1 and 7.2: 2.6e3 s by Plank, 3745 s by Pham (with the Biot number rounded to 1.46)."""
    plank = freezing_time_plank(
        **BEEF, heat_of_fusion=250e3, temperature_freezing=273.15 - 1.25, shape="sphere"
    )
    assert plank == pytest.approx(2.6e3, rel=0.005)
    pham = freezing_time_pham(
        **BEEF,
        heat_of_fusion=0.75 * 333.2e3,
        temperature_inlet=283.15,
        temperature_frozen=255.15,
        specific_heat_capacity=3600.0,
        specific_heat_capacity_frozen=1800.0,
        density_frozen=950.0,
        shape="sphere",
    )
    assert pham == pytest.approx(3745.06, rel=1e-3)


def test_a_public_calculator_freezes_a_carton() -> None:
    """10 cm between plates of air at −35 °C with 20 W/(m² K) and a wrap of 0.01 m² K/W, from 5 to −18 °C:
    about 11.5 h by Pham, as the tests of a cold-room program state.
    """
    carton = {
        "half_thickness": 0.05,
        "density": 1050.0,
        "temperature_freezer": 238.15,
        "heat_transfer_coefficient": 1.0 / (1.0 / 20.0 + 0.01),
        "thermal_conductivity": 1.4,
        "heat_of_fusion": 247e3,
    }
    pham = freezing_time_pham(
        **carton,
        temperature_inlet=278.15,
        temperature_frozen=255.15,
        specific_heat_capacity=3349.0,
        specific_heat_capacity_frozen=1800.0,
        density_frozen=1000.0,
    )
    assert pham / 3600 == pytest.approx(11.5, abs=0.06)


def test_plank_is_the_front_of_a_thin_shell_of_ice() -> None:
    """Without a resistance outside a plate needs ρ L a²/(2 λ ΔT); a ball a third of it, a cylinder half."""
    sharp = BEEF | {"heat_transfer_coefficient": 1e9}
    times = [
        freezing_time_plank(**sharp, heat_of_fusion=250e3, temperature_freezing=273.15, shape=s)
        for s in ("plate", "cylinder", "sphere")
    ]
    assert times[0] == pytest.approx(1000.0 * 250e3 * 0.035**2 / (2 * 1.2 * 40.0), rel=1e-6)
    assert times[0] / times[1] == pytest.approx(2.0)
    assert times[0] / times[2] == pytest.approx(3.0)


def test_a_freezer_that_is_too_warm_is_refused_in_words() -> None:
    with pytest.raises(ApplicabilityError, match="colder than the temperature at which the product freezes"):
        freezing_time_plank(
            **BEEF | {"temperature_freezer": 275.0}, heat_of_fusion=250e3, temperature_freezing=272.0
        )


def test_heat_from_below_alone_is_a_vial() -> None:
    """A vial as wide inside as outside, whose cake has the resistance x/b: Pikal's model, checked against
    LyoPRONTO elsewhere.
    """
    height, b, contact = 0.01, 2e-8, 15.0
    vial = primary_drying(
        pressure_chamber=20.0,
        temperature_shelf=283.15,
        area_vial=1e-3,
        area_product=1e-3,
        volume_fill=height * 1e-3 * ICE_DENSITY / 1000.0,
        concentration=0.0,
        vial_coefficient_contact=contact,
        vial_coefficient_gas=0.0,
        vapor_resistance=1.0,
        vapor_resistance_slope=1.0 / b,
        temperature_shelf_start=283.15,
    )
    tray = freeze_drying_tray(283.15, 20.0, height, ICE_DENSITY, 0.05, b, ICE_CONDUCTIVITY, 0.0, contact)
    assert tray.drying_time == pytest.approx(vial.drying_time, rel=1e-4)
    assert tray.temperature_bottom == pytest.approx(vial.temperature_product, abs=0.01)


def test_heat_from_above_alone_tends_to_kings_slab() -> None:
    """The deeper the layer, the less the radiation to its surface counts: Plank's correction
    1 + 2 λ/(h_r L) with h_r = 4 ε σ T³ of the mean temperature leaves a percent.
    """
    for L in (0.1, 1.0):
        slab = freeze_drying_slab(303.15, 12.93, 0.035, 2.63e-8, L, 250.0, 2.0)
        tray = freeze_drying_tray(
            303.15, 12.93, L, 500.0, 0.035, 2.63e-8, emissivity=1.0, conduction_coefficient=0.0
        )
        h = 4.0 * 5.670374e-8 * 300.0**3
        assert tray.drying_time == pytest.approx(slab.drying_time * (1.0 + 2.0 * 0.035 / (h * L)), rel=0.01)


def test_more_heat_dries_faster_and_warmer_and_thicker_layers_take_longer() -> None:
    def made(**change):
        return freeze_drying_tray(**TRAY | {"ice_concentration": 500.0} | change)

    base, hot, thick, held = (
        made(),
        made(temperature_shelf=343.15),
        made(thickness=0.03),
        made(emissivity=0.5),
    )
    assert hot.drying_time < base.drying_time < held.drying_time
    assert hot.temperature_front > base.temperature_front
    assert 2.0 < thick.drying_time / base.drying_time < 4.0
    slope = jax.grad(
        lambda P: freeze_drying_tray.function(328.15, P, 0.015, 500.0, 0.05, 4e-8).temperature_front
    )(40.0)
    assert slope > 0.0


def test_the_machine_closes_and_its_shelves_pay_for_sublimation() -> None:
    """King: the heat to the product is that of sublimation and little else; table IV.20 of the notes
    has 10 to 72 h and 5 to 18 kg/m².
    """
    run = gr.alone("drying.tray_freeze_dryer").solve()
    values = run.units["tray_freeze_dryer"].values._asdict()
    assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9
    assert values["heat_duty_shelf"] / values["evaporation_rate"] == pytest.approx(SUBLIMATION_HEAT, rel=0.05)
    assert values["heat_duty_condenser"] < 0 < values["heat_duty_defrost"]
    assert 36000 < values["drying_time_primary"] + values["drying_time_secondary"] < 259200
    assert values["area"] == pytest.approx(100 / 3600 * values["cycle_time"] / 9.0)
    uses = run.as_json()["utilities"]["carriers"]
    cold = uses["deep_cold"]["value"] + uses["brine"]["value"]
    assert cold == pytest.approx(-values["heat_duty_condenser"] - values["heat_duty_freezing"])


def test_sized_shelves_take_the_surface_to_its_limit() -> None:
    sized = TrayFreezeDryer.size(
        temperature_limit=313.15,
        load_per_area=9.0,
        moisture_outlet=0.05,
        **{k: v for k, v in TRAY.items() if k != "temperature_shelf"},
    )
    made = freeze_drying_tray(
        **TRAY | {"temperature_shelf": sized.temperature_shelf, "ice_concentration": 500.0}
    )
    assert sized.temperature_shelf > 313.15
    assert made.surface_temperature == pytest.approx(313.15, abs=1e-6)
    with pytest.raises(InputError, match="Ice does not sublime"):
        TrayFreezeDryer.size(
            temperature_limit=240.0,
            load_per_area=9.0,
            moisture_outlet=0.05,
            **{k: v for k, v in TRAY.items() if k != "temperature_shelf"},
        )
