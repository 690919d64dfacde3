"""What a line takes: sums of its units by hand, what other units give, energy per water."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

import granum as gr
from granum.cases.reading import read_text
from granum.core.errors import InputError
from granum.costs.formulas.emissions import emission_factor
from granum.flowsheet import Flowsheet
from granum.reports.sheets import table_rows
from granum.reports.utilities import utility_table
from granum.streams.equipment.basics import Heater
from granum.streams.equipment.movers import Fan, Pump
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

GAS = mixture_of(["water"], ["calcite"], ["dry air", "water"], [1e-6, 1e-5, 1e-4])
STARCH = EXAMPLES / "starch-drying" / "line.toml"


def air(flow: float = 1.0, temperature: float = 300.0):
    return empty(GAS, temperature).replace(gas=np.array([flow, 0.0]))


@pytest.fixture(scope="module")
def starch():
    return gr.read(STARCH).solve()


def test_the_line_is_the_sum_of_its_units(starch) -> None:
    told = json.loads(json.dumps(starch.as_json()))
    rows = [use for unit in told["units"].values() for use in unit["utilities"].values() if use["counted"]]
    heat = told["units"]["heater"]["results"]["heat_duty"]["value"]
    fans = sum(use["value"] for use in rows if use["carrier"] == "electricity")
    line = told["utilities"]
    assert line["heat_input"]["value"] == pytest.approx(heat, rel=1e-12)
    assert line["electric_power"]["value"] == pytest.approx(fans, rel=1e-12)
    water = told["units"]["dryer"]["results"]["evaporation_rate"]["value"]
    assert line["energy_per_water"]["value"] == pytest.approx((heat + fans) / water, rel=1e-12)
    assert line["product"] == "starch"
    made = told["streams"]["starch"]["mass_flow"]["value"]
    assert line["energy_per_product"]["value"] == pytest.approx((heat + fans) / made, rel=1e-12)
    gas = heat * emission_factor("medium_pressure_steam") + fans * emission_factor("electricity")
    assert line["greenhouse_gas_rate"]["value"] == pytest.approx(gas, rel=1e-9)


def test_what_is_taken_is_asked_for_by_the_names_that_studies_use(starch) -> None:
    told = starch.as_json()
    fan = told["units"]["dryer"]["utilities"]["electric_power_fan"]["value"]
    assert starch.figure("dryer.electric_power_fan") == pytest.approx(fan)
    assert starch.figure("utilities.energy_per_water") == starch.utilities.energy_per_water
    with pytest.raises(InputError, match=r"'utilities\.energy_per_watr'.*'utilities\.energy_per_water'"):
        starch.figure("utilities.energy_per_watr")
    with pytest.raises(InputError, match="'dryer' is not a result"):
        starch.figure("dryer")


def test_convective_drying_takes_what_the_notes_say(starch) -> None:
    """Table III.2 of the notes on drying: 3 300 to 6 500 kJ/kg, 1.5 to 3 times the heat of vaporization."""
    assert 3.3e6 < starch.utilities.energy_per_water < 6.5e6
    assert 1.5 < starch.utilities.energy_consumption_ratio < 3.0


def test_heat_of_the_heater_is_not_counted_again_in_the_dryer(starch) -> None:
    dryer = starch.units["dryer"]
    assert dryer.uses["heat_input_hot_gas"] > 0.0
    assert "heat_input_hot_gas" not in dryer.counted


def test_a_fan_in_the_line_pays_for_the_pressure_lost() -> None:
    line = gr.read(STARCH).sheet
    units = dict(line.units) | {"fan": Fan(pressure_rise=3000.0)}
    links = {k.name: (k.origin, k.target) for k in line.links if "." not in k.name}
    links["exhaust"] = ("cyclones.gas", "fan.feed")
    run = Flowsheet(units, line.feeds, links).solve()
    assert "electric_power_fan" not in run.units["dryer"].counted
    assert "electric_power_fan" not in run.units["cyclones"].counted
    fan = run.units["fan"]
    assert run.utilities.electric_power == pytest.approx(float(fan.uses["electric_power_drive"]), rel=1e-12)
    assert float(fan.uses["electric_power_drive"]) == pytest.approx(
        float(fan.values.shaft_power) / 0.9, rel=1e-12
    )


@pytest.mark.parametrize(
    ("temperature", "carrier"),
    [
        (400.0, "heat_input_low_pressure_steam"),
        (440.0, "heat_input_medium_pressure_steam"),
        (500.0, "heat_input_high_pressure_steam"),
        (600.0, "heat_input_fuel_gas"),
        (290.0, "cooling_input_chilled_water"),
        (270.0, "cooling_input_brine"),
        (240.0, "cooling_input_deep_cold"),
    ],
)
def test_a_temperature_chooses_its_carrier(temperature: float, carrier: str) -> None:
    run = Flowsheet({"h": Heater(temperature)}, {"air": air()}, {"air": ("", "h.feed")}).solve()
    uses = {name: float(x) for name, x in run.units["h"].uses.items() if float(x) > 0.0}
    assert list(uses) == [carrier]
    assert uses[carrier] == pytest.approx(abs(run.figure("h.heat_duty")), rel=1e-12)


def test_hot_gas_from_outside_counts() -> None:
    """Cooled from 500 K to 480 K: what it brought is not the heater's to count, its cold is."""
    run = Flowsheet({"h": Heater(480.0)}, {"air": air(temperature=500.0)}, {"air": ("", "h.feed")}).solve()
    assert run.utilities.heat_input == 0.0
    assert run.carriers["cooling_water"] == pytest.approx(-run.figure("h.heat_duty"))
    assert math.isnan(run.utilities.energy_per_water)
    assert "energy_per_water" not in run.as_json()["utilities"]


def test_a_pump_and_a_fan_close_and_warm() -> None:
    slurry = empty(GAS, 300.0).replace(liquid=np.array([10.0]), solid=np.array([[0.5, 0.5]]))
    run = Flowsheet(
        {"p": Pump(5e5), "f": Fan(8e3)},
        {"slurry": slurry, "air": air()},
        {"slurry": ("", "p.feed"), "air": ("", "f.feed")},
    ).solve()
    assert run.audit["energy_closure"] <= 1e-9
    volume = float(slurry.slurry_volume_flow)
    assert run.figure("p.shaft_power") == pytest.approx(volume * 5e5 / 0.7, rel=1e-12)
    # an ideal gas at 300 K: T2/T1 = 1 + ((p2/p1)^0.2857 - 1)/0.65
    ideal = 300.0 * (1.0 + ((101325.0 + 8e3) / 101325.0) ** (1.0 / 3.5) / 0.65 - 1.0 / 0.65)
    assert run.figure("f.temperature") == pytest.approx(ideal, abs=0.1)


@pytest.mark.long
def test_studies_watch_what_is_taken() -> None:
    found = gr.studies.sweep(
        gr.read(STARCH),
        {"heater.temperature": [420.0, 428.15]},
        outputs=[
            "utilities.energy_per_water",
            "cyclones.electric_power_fan",
            "utilities.greenhouse_gas_rate",
        ],
    )
    run = gr.read(STARCH).solve()
    assert float(found.dataset["utilities.energy_per_water"].values[-1]) == pytest.approx(
        run.utilities.energy_per_water, rel=1e-6
    )
    assert float(found.dataset["cyclones.electric_power_fan"].values[-1]) == pytest.approx(
        float(run.units["cyclones"].uses["electric_power_fan"]), rel=1e-6
    )


def test_what_a_line_pays(starch) -> None:
    """By hand: heat at 30 USD/MWh, electricity at 0.10 USD/kWh; a price that is missing or of nothing is
    told.
    """
    prices = {"electricity": "0.10 USD/kWh", "medium_pressure_steam": "30 USD/MWh"}
    power, heat = starch.carriers["electricity"], starch.carriers["medium_pressure_steam"]
    by_hand = power * 0.10 / 3.6e6 + heat * 30.0 / 3.6e9
    assert starch.utility_cost(prices) == pytest.approx(by_hand, rel=1e-12)
    with pytest.raises(InputError, match="also takes medium_pressure_steam"):
        starch.utility_cost({"electricity": "0.10 USD/kWh"})
    with pytest.raises(InputError, match="steam"):
        starch.utility_cost(prices | {"steam": "1 USD/MWh"})


def test_the_costs_of_the_units_are_those_of_the_line() -> None:
    """By hand: 1 MW at 30 USD/MWh is 30 USD/h; what other units give costs nothing."""
    priced = '\n[prices]\nelectricity = "0.10 USD/kWh"\nmedium_pressure_steam = "30 USD/MWh"\n'
    run = read_text(STARCH.read_text(encoding="utf-8") + priced).solve()
    assert 3600.0 * run.paid("medium_pressure_steam", 1e6) == pytest.approx(30.0, rel=1e-12)
    found = utility_table(run)
    costs = [float(row.cost.split()[0]) for row in found.rows if row.cost]
    assert sum(costs) == pytest.approx(3600.0 * sum(run.costs.values()), rel=1e-2)
    assert not any(row.cost for row in found.rows if not row.counted)
    assert found.priced


def test_energy_per_mass_is_told_as_heat_and_as_electricity_are(starch) -> None:
    """3.6 kJ/kg are 1 kWh/t."""
    told = [text.split(" = ") for _label, text in utility_table(starch).totals if "kWh/t" in text]
    assert told
    for heat, electricity in told:
        assert float(heat.split()[0]) == pytest.approx(3.6 * float(electricity.split()[0]), rel=2e-3)


JUICE = """
title = "Juice"
[mixture]
liquids = ["water", "sucrose"]
gases = ["water"]
sizes = { smallest = "10 um", largest = "4 mm", classes = 3 }
[feeds.juice]
to = "evaporator.feed"
temperature = "60 degC"
liquid_flow = "12.5 t/h"
liquid = { water = "90 %", sucrose = "10 %" }
[units.evaporator]
model = "evaporation.evaporator"
area = "60 m2"
pressure = "0.2 bar"
pressure_steam = "2 bar"
heat_transfer_coefficient = "1700 W/(m2*K)"
[streams]
vapor = ["evaporator.vapor"]
syrup = ["evaporator.product"]
"""


def test_without_solids_the_product_is_what_holds_the_dissolved() -> None:
    line = read_text(JUICE).solve()
    flows = {name: float(line.streams[name].mass_flow) for name in ("syrup", "vapor")}
    assert flows["syrup"] < flows["vapor"]
    assert line.product == "syrup"
    each = line.utilities.energy_per_product
    taken = line.utilities
    assert each * flows["syrup"] == pytest.approx(
        taken.heat_input + taken.electric_power + taken.refrigeration_power
    )


def test_cold_costs_the_electricity_of_a_machine_with_half_of_carnots_coefficient() -> None:
    """By hand: deep cold is made at 223.15 K and given off at 308.15 K; the energy of the line counts it."""
    line = gr.read(EXAMPLES / "freeze-dried-food" / "line.toml").solve()
    taken = line.utilities
    made = taken.cooling_input * 2.0 * (308.15 - 223.15) / 223.15
    assert taken.refrigeration_power == pytest.approx(made, rel=1e-4)
    whole = taken.electric_power + taken.heat_input + taken.refrigeration_power
    assert taken.energy_per_water * taken.evaporation_rate == pytest.approx(whole, rel=1e-12)
    assert taken.refrigeration_power > 0.5 * taken.heat_input


def test_rounding_is_no_heat_and_what_is_not_taken_is_in_no_table() -> None:
    """An adiabatic flash has no heat, and takes no steam; a fan of a microwatt keeps its own."""
    flash = gr.alone("crystallization.vacuum_crystallizer").solve()
    (unit,) = flash.units.values()
    assert float(unit.values.heat_duty) == 0.0
    assert float(unit.values.condenser_duty) > 1e5
    assert flash.carriers["low_pressure_steam"] == 0.0
    taken = {row[1]: row[3] for row in table_rows(flash)["utilities"][1:]}
    assert all(taken.values())
    assert taken["electric_power_agitator"] > 0.0
    assert not any(name.startswith("heat_input") for name in taken)
    little = Flowsheet({"f": Fan(1.0)}, {"air": air(1e-6)}, {"air": ("", "f.feed")}).solve()
    assert little.figure("f.shaft_power") == pytest.approx(1e-6 / 1.18 / 0.65, rel=0.01)


def test_air_leaks_in_by_the_chart_of_the_institute() -> None:
    """scribd.com 482975963, read: k of 0.947, 0.713, 0.403, 0.248 and 0.124 kg/h per m³ to the power 2/3
    above 90, 20, 3 and 1 torr and below; nothing without a vacuum.
    """
    for torr, k in ((100.0, 0.947), (50.0, 0.713), (10.0, 0.403), (2.0, 0.248), (0.5, 0.124)):
        leaked = gr.streams.mass_flow_leakage_hei(27.0, 133.322368 * torr)
        assert float(leaked) * 3600.0 == pytest.approx(9.0 * k, rel=1e-9)
    assert float(gr.streams.mass_flow_leakage_hei(27.0, 101325.0)) == 0.0
