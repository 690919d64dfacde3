"""What the chapter on the dryers, one by one, states, calculated: one duty for each family."""

import csv
from functools import cache
from pathlib import Path

import jax.numpy as jnp
import numpy as np

import granum as gr
from granum.app.chapters import said
from granum.core.charts import DASHES, LINES, add_line, axis_title, figure
from granum.streams.feeding import feed
from granum.streams.from_materials import mixture_of

d = gr.drying
ZERO = 273.15
SHEETS = Path(gr.__file__).parent / "drying" / "data" / "dryers_houdon2017.csv"
with SHEETS.open(encoding="utf-8") as file:
    machines = {row["name"]: row for row in csv.DictReader(file)}


def sheet(machine, column):
    """A figure of the table of machines, in SI units."""
    found = next(name for name in machines[machine] if name.startswith(column))
    factor = {"kJ": 1000.0, "tonne/hour": 1 / 3.6, "/hour": 1 / 3600}
    value = float(machines[machine][found])
    if "degC" in found:
        return value + ZERO
    return value * next((f for unit, f in factor.items() if unit in found), 1.0)


@cache
def mixture(solid, *edges):
    """Water, one solid in classes between these sizes, humid air."""
    return mixture_of(["water"], [solid], ["dry air", "water"], list(edges))


def wet(mix, solid, moisture, celsius=20.0, sizes=(1.0,)):
    """So many t/h of dry solid with its moisture."""
    flow = {"solid_flow": f"{solid} t/h", "liquid_flow": f"{solid * moisture} t/h"}
    return feed(mix, temperature=f"{celsius} degC", sizes={"fractions": list(sizes)}, **flow)


def air(mix, flow, celsius, humidity=0.01):
    """So many t/h of air of 10 g/kg."""
    parts = {"dry air": 1.0 / (1.0 + humidity), "water": humidity / (1.0 + humidity)}
    return feed(mix, temperature=f"{celsius} degC", gas_flow=f"{flow} t/h", gas=parts)


def spent(run):
    """Heat in the hot gas and from walls per kilogram of water evaporated."""
    heat = run.uses["heat_input_hot_gas"] + run.figures.heat_duty
    return float(heat / run.figures.evaporation_rate)


def check(run, words):
    """What a check measured."""
    return float(next(c.value for c in run.checks if words in c.name))


# ---- drum
granules = mixture("cellulose", 1e-3, 3e-3)
drum = {"kinetics": d.SurfaceKinetics(critical_moisture=0.15), "rotation_speed": "3 rpm", "cells": 20}


shell = float(np.pi * 2.2 * 20.0)


@cache
def rotary(direction, slope, gas=20.0, celsius=300.0, tubes=0.0):
    """5 t/h of granules of 2 mm from 0.30 in a drum of 2.2 m by 20 m."""
    wall = 50.0 * tubes / (0.15 * shell)  # W/(m² K), of tubes with so many m², on 15 % of the shell
    given = {"drum_slope": jnp.asarray(slope), "wall_coefficient": jnp.asarray(wall)}
    unit = d.RotaryDryer("20 m", "2.2 m", gas_direction=direction, **drum, **given)
    return unit.operate(feed=wet(granules, 5.0, 0.30), gas=air(granules, gas, celsius))


with_gas, against = rotary("co-current", 0.01), rotary("counter-current", 0.03)
steep = rotary("co-current", 0.03)
# ---- drum_heat
TUBES = 250.0  # m²
steamed = rotary("counter-current", 0.03, 9.0, 120.0, TUBES)

# ---- belt
strands = mixture("cellulose", 4e-3, 6e-3)


@cache
def belt(turned):
    """0.5 t/h of strands from 1 kg/kg lost over 20 m², 10 cm deep, through four zones of 90 °C."""
    kinetics = d.SurfaceKinetics(critical_moisture=0.8)
    unit = d.BeltDryer(
        "20 m^2", "100 mm", 300.0, kinetics, zone_count=4, alternating=turned, layers=12, steps=30
    )
    return unit.operate(feed=wet(strands, 0.5, 2.0), gas=air(strands, 43.0, 90.0))


straight, alternated = belt(False), belt(True)

# ---- bed
grains = mixture("starch", 4e-4, 8e-4)


@cache
def bed(cells, coils=0.0, gas=11.0):
    """1.2 t/h of grains of 0.6 mm from 0.30, fifty minutes in air of 130 °C."""
    unit = d.FluidBedDryer(
        "3.5 m^2", "1 tonne", d.DiffusionKinetics(8e-12, 3e-4), cells=cells, coil_duty=jnp.asarray(coils)
    )
    return unit.operate(feed=wet(grains, 1.2, 0.30), gas=air(grains, gas, 130.0))


mixed, tanks = bed(1), bed(6)
coiled = bed(6, coils=1e5, gas=7.0)
ages = mixed.inside.profile
too_wet = float(np.interp(-0.10, -np.asarray(ages.moisture)[:, 0], np.asarray(ages.place)))

# ---- spouted
wheat = mixture("wheat", 3e-3, 4.2e-3)
kernel = d.DiffusionKinetics("7e-11 m^2/s", "1.75 mm", isotherm="wheat")
sprung = d.SpoutedBedDryer("60 cm", "8 cm", "360 kg", kernel, parallel_number=4.0).operate(
    feed=wet(wheat, 0.8, 0.25, 15.0), gas=air(wheat, 2.5, 150.0)
)
multiple = sprung.figures.superficial_velocity / sprung.figures.minimum_spouting_velocity

# ---- vibrated
salt = mixture("sodium chloride", 4e-4, 8e-4)


@cache
def shaken(weir):
    """10 t/h of salt from 0.03 on a floor of 9 m², 12 t/h of air of 130 °C."""
    unit = d.VibratedBedDryer(
        "6 m", "1.5 m", d.SurfaceKinetics(critical_moisture=0.01), weir_height=jnp.asarray(weir), cells=8
    )
    return unit.operate(feed=wet(salt, 10.0, 0.03), gas=air(salt, 12.0, 130.0))


low, high = shaken(0.03), shaken(0.04)

# ---- flash
flour = mixture("starch", *np.geomspace(40e-6, 300e-6, 5))


@cache
def flash():
    """10 t/h of wet starch with 42 % of water in a duct of 1.4 m by 25 m (course notes, table IV.13)."""
    unit = d.FlashDryer(
        "25 m",
        "1.4 m",
        d.SurfaceKinetics(critical_moisture=0.35),
        feed_velocity="3 m/s",
        cells=30,
        entrainment=True,
    )
    shares = (0.15, 0.35, 0.35, 0.15)
    return unit.operate(feed=wet(flour, 5.8, 42 / 58, 25.0, shares), gas=air(flour, 88.0, 185.0))


def along_duct():
    """Place in the duct, m, and the moisture of the classes there."""
    found = flash().inside.profile
    return 25.0 * np.asarray(found.place), np.asarray(found.moisture)


place, moist = along_duct()
mean_moist = moist @ np.asarray(flash().inside.profile.shares)
first_half = float(np.interp(-0.5 * (42 / 58 + mean_moist[-1]), -mean_moist, place))
flash_sizes = np.asarray(flour.sizes)

# ---- spray
milk = mixture("lactose monohydrate", *np.geomspace(10e-6, 300e-6, 7))
chamber = {"cells": 30, "entrainment": True}


@cache
def spray(gas):
    """2 t/h of concentrate with 45 % of solids in a chamber of 5 m by 12 m and air of 176 °C."""
    unit = d.SprayDryer(
        "12 m", "5 m", d.PressureNozzle("20 MPa"), d.ReactionKinetics(isotherm="skim_milk"), **chamber
    )
    shares = (0.1, 0.2, 0.2, 0.2, 0.2, 0.1)
    return unit.operate(feed=wet(milk, 0.89775, 55 / 45, 26.0, shares), gas=air(milk, gas, 176.0, 0.0092))


def flown(gas):
    """Share of the powder that leaves with the exhaust."""
    made = spray(gas).outlets
    return float(made.exhaust.solid_flow / (made.exhaust.solid_flow + made.product.solid_flow))


def above_glass(gas):
    """By how much the powder is warmer than its glass transition: amorphous lactose, 101 °C dry."""
    found = spray(gas).figures
    glass = d.glass_transition_temperature(float(found.moisture_dry_basis), "101 degC", 7.4)
    return float(found.temperature_product) - float(glass)


soap = mixture("sodium sulfate anhydrous", *np.geomspace(50e-6, 1.2e-3, 7))
detergent = d.SprayDryer(
    "12 m",
    "6 m",
    d.GivenDrops("400 um", "40 m/s"),
    d.VanMeelKinetics(0.25),
    gas_direction="counter-current",
    dry_density=700.0,
    gas_dispersion=3.0,
    cells=24,
).operate(
    feed=wet(soap, 6.0, 0.5, 80.0, (0.1, 0.2, 0.2, 0.2, 0.2, 0.1)),
    gas=air(soap, 37.0, 300.0, 1.0 / 99.0),
)
detergent_dust = float(detergent.outlets.exhaust.solid_flow * 3.6 / 6.0)

# ---- contact
mash = wet(mixture("starch", 1e-4, 1e-3), 0.06, 4.0, 60.0)
film = d.DrumDryer(
    "1 m", "1.93 m", "3.4 rpm", "5 bar", heat_transfer_coefficient="780 W/(m^2*K)", critical_moisture=0.5
).operate(feed=mash)
sludge = wet(mixture("calcite", 5e-4, 2e-3), 0.06, 7 / 3)


@cache
def paddle(pressure, speed):
    """A sludge of 70 % of water to 3.2 % (course notes, table IV.21), walls of 130 °C."""
    return d.PaddleDryer("130 degC", "3.3 %", pressure, "1 mm", speed, "0.6 m", pasty_moisture=1.0).operate(
        feed=sludge
    )


paddles = {"slow": paddle("1 atm", "15 rpm"), "fast": paddle("1 atm", "30 rpm")} | {
    "vacuum": paddle("0.1 bar", "15 rpm")
}
shelves = d.VacuumShelfDryer(
    "70 degC", "68 mbar", "25 mm", 500.0, 0.008, thermal_conductivity_dry=0.43
).operate(feed=wet(mixture("calcite", 1e-6, 2e-5), 0.01, 0.97))
fibers = mixture("cellulose", 1e-5, 5e-5)
paper = d.PaperMachine("5 m", "60 g/m^2", "3 bar", pressure_steam_first="1.2 bar").operate(
    feed=wet(fibers, 12.0, 4 / 3, 45.0), gas=air(fibers, 110.0, 50.0)
)

# ---- batch
gravel = mixture("quartz", 1e-3, 2e-3)


@cache
def oven(fresh):
    """100 kg/h of a granular solid from 0.28 to 0.005 on trays, 35 kg/m², air of 120 °C at 4.5 m/s."""
    unit = d.TrayDryer("120 degC", "4.5 m/s", "35 kg/m^2", 0.005, 0.12, tray_length="1.2 m")
    return unit.operate(feed=wet(gravel, 0.1, 0.28, 25.0), gas=air(gravel, fresh, 25.0))


vials = d.FreezeDryer(
    "150 mtorr",
    "20 degC",
    "3.8 cm^2",
    "3.14 cm^2",
    "2 mL",
    "2.75e-4 cal/(s*K*cm^2)",
    "8.93e-4 cal/(s*K*cm^2*torr)",
    "1.4 cm^2*hour*torr/g",
    "16 cm*hour*torr/g",
    vial_coefficient_saturation="0.46 1/torr",
    temperature_limit="-5 degC",
    duct_diameter="200 mm",
).operate(feed=wet(mixture("starch", 1e-6, 1e-5), 5e-5, 0.9669 / 0.05))
berries = wet(mixture("sucrose", 4e-3, 12e-3), 0.009, 91 / 9, 10.0)


@cache
def fruit(thickness, load):
    """100 kg/h of strawberries on trays between shelves of 55 °C at 40 Pa."""
    limits = {"temperature_limit_frozen": "-15 degC", "temperature_limit": "50 degC"}
    return d.TrayFreezeDryer(
        "55 degC", "40 Pa", load, thickness, "5 %", "0.05 W/(m*K)", "4e-8 kg/(m*s*Pa)", **limits
    ).operate(feed=berries)


thin, thick = fruit("15 mm", "9 kg/m^2"), fruit("30 mm", "18 kg/m^2")
cold = float(-thin.figures.heat_duty_condenser / thin.figures.evaporation_rate)
cold_power = cold / (0.5 * 228.15 / (303.15 - 228.15))  # half of what Carnot permits from −45 to 30 °C

# ---- silo
maize = mixture("maize", 7e-3, 9e-3)
grain = wet(maize, 6.5, 3.5 / 6.5, 15.0)
column = d.SiloDryer(
    "55 m^3",
    "0.3 m",
    600.0,
    d.ThinLayerKinetics(d.Page(0.0025, 0.66), 3.5 / 6.5, isotherm="maize"),
    layers=10,
    steps=25,
).operate(feed=grain, gas=air(maize, 120.0, 90.0, 0.008), cooling=air(maize, 25.0, 15.0, 0.007))
across = np.asarray(column.inside.profile.moisture)[-1]
hottest = np.asarray(column.inside.profile.temperature).max(axis=0)


def fan(depth, hourly):
    """Pressure that maize of a depth takes from air, per cubic meter of grain and hour."""
    return depth * float(d.pressure_gradient_shedd(hourly * depth / 3600.0))


deep = fan(6.0, 30.0) / fan(3.0, 30.0)

# ---- boosters
state = gr.humid_gas.state(temperature="60 degC", relative_humidity="10 %")
bare, boosted = (
    d.drying_rate_assisted(
        "60 degC", float(state.humidity_ratio), "35 W/(m^2*K)", radiated_heat=f"{kw} kW/m^2"
    )
    for kw in (0, 3)
)
gained = boosted.drying_rate_constant / bare.drying_rate_constant
depths = {
    what: float(d.penetration_depth(hertz, 60.0, 12.0))
    for what, hertz in (("microwave", "2.45e9 1/s"), ("nine", "9.15e8 1/s"))
}


def figure_drum():
    drawing = figure(
        axis_title(
            "place", label=said("way of the solid through the drum", "parcours du solide dans le tambour")
        ),
        axis_title("temperature", "degC"),
    )
    shown = (
        (with_gas, said("co-current", "co-courant")),
        (against, said("counter-current", "contre-courant")),
    )
    for (run, words), color in zip(shown, LINES, strict=False):
        found = run.inside.profile
        x = np.asarray(found.place)
        for T, what, dash in (
            (found.gas_temperature, said("gas", "gaz"), "solid"),
            (np.asarray(found.temperature)[:, 0], said("solid", "solide"), "dash"),
        ):
            add_line(drawing, x, np.asarray(T) - ZERO, f"{what}, {words}", color=color, dash=dash)
    return drawing


def figure_belt():
    drawing = figure(
        axis_title(
            "depth",
            label=said(
                "place in the layer, from the side of the first air",
                "place dans la couche, depuis le côté du premier air",
            ),
        ),
        axis_title("moisture_dry_basis", "kg/kg"),
    )
    shown = (
        (straight, said("air always from one side", "air toujours du même côté")),
        (alternated, said("every second zone from the other", "une zone sur deux de l'autre côté")),
    )
    for (run, words), color, dash in zip(shown, LINES, DASHES, strict=False):
        last = np.asarray(run.inside.profile.moisture)[-1]
        add_line(drawing, (np.arange(12) + 0.5) / 12, last, words, color=color, dash=dash)
    return drawing


def figure_flash():
    drawing = figure(
        axis_title("length", "m", said("way up the duct", "parcours dans la gaine")),
        axis_title("moisture_dry_basis", "kg/kg"),
    )
    for k, (color, dash) in enumerate(zip(LINES, DASHES, strict=False)):
        if k == len(flash_sizes):
            break
        add_line(drawing, place, moist[:, k], f"{1e6 * flash_sizes[k]:.0f} µm", color=color, dash=dash)
    return drawing


# ---- kiln and sun
def charge(thickness):
    """Green red oak in a kiln by T4-D2, mm."""
    (unit,) = gr.alone("drying.wood_kiln", thickness=f"{thickness} mm").solve().units.values()
    return unit.values


kiln = {mm: charge(mm) for mm in (28.6, 57.2)}
green = d.kiln_air(0.6)


(sunny,) = (unit.values for unit in gr.alone("drying.solar_dryer").solve().units.values())
spread = {net: float(d.drying_flux_penman(net, 2.0, 306.15, 0.4)) * 12 * 3600.0 for net in (0.0, 350.0)}


@cache
def barn(**settings):
    """5 kg/h of herbs on nets in a barn: the example of the card with other settings."""
    (unit,) = gr.alone("drying.still_air_dryer", **settings).solve().units.values()
    return unit.values


barns = {
    "plain": barn(),
    "solid": barn(sides=1),
    "airy": barn(**{"gas.gas_flow": "10000 kg/h"}),
    "heated": barn(temperature_room="35 degC"),
}
