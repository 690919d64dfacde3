"""What the chapter on drying states, calculated."""

import csv
from pathlib import Path

import numpy as np
from validation import drying_curve

import granum as gr
from granum.app.chapters import said
from granum.app.shipped import examples_folder
from granum.core.charts import DASHES, LINES, add_line, axis_title, figure

d, h = gr.drying, gr.humid_gas
TEST = Path(examples_folder()) / "drying-curve" / "foodstuff_geankoplis.csv"
MACHINES = Path(gr.__file__).parent / "drying" / "data" / "dryers_houdon2017.csv"
ZERO = 273.15

# ---- maize
maize = {
    "mass_flow_inlet": "100 kg/hour",
    "moisture_dry_basis_inlet": 0.54,
    "moisture_dry_basis_outlet": 0.18,
    "temperature_fresh": "25 degC",
    "relative_humidity_fresh": "50 %",
    "temperature_inlet": "50 degC",
}
best = d.dryer_balance(**maize, relative_humidity_outlet="100 %")
# ---- air
wet_before = d.moisture_wet_basis(0.54)
wet_after = d.moisture_wet_basis(0.18)
water_by_mistake = 100 * (0.54 - 0.18)
usual = d.dryer_balance(**maize, relative_humidity_outlet="60 %")
hot = h.state(temperature="50 degC", humidity_ratio=float(best.humidity_ratio_fresh))


def spent(inlet, outlet, **more):
    """Balance for air that is heated to a temperature and leaves with a relative humidity."""
    return d.dryer_balance(
        **maize | {"temperature_inlet": f"{inlet} degC"} | more, relative_humidity_outlet=outlet
    )


half = {t: spent(t, 0.5) for t in (50, 80, 120, 200)}
need = {
    t: [
        float(spent(t, 0.9).energy_per_water),
        float(x.energy_per_water),
        float(spent(t, 0.2).energy_per_water),
    ]
    for t, x in half.items()
}
winter = spent(80, 0.5, temperature_fresh="0 degC", relative_humidity_fresh="80 %")
summer = spent(80, 0.5, temperature_fresh="30 degC", relative_humidity_fresh="60 %")

# ---- equilibrium
limit = {t: float(d.moisture_for_storage(temperature=f"{t} degC", isotherm="maize")) for t in (10, 25, 40)}
limit_wet = {t: float(d.moisture_wet_basis(x)) for t, x in limit.items()}
activity = {
    x: float(d.water_activity(x, isotherm="maize", temperature=float(half[80].temperature_outlet)))
    for x in (0.18, 0.08)
}
stored = d.bin_aeration(
    mass="100 t",
    area=20.0,
    volume_flow="600 m^3/hour",
    temperature="30 degC",
    moisture_dry_basis=0.18,
    temperature_air="10 degC",
    relative_humidity=0.65,
)


def binned(hours):
    """The same bin, followed in layers, its fan on for some hours."""
    dry = 100e3 / 1.18
    line = gr.alone(
        "drying.grain_bin",
        area="20 m2",
        height=dry / 620.0 / 20.0,
        feed={
            "temperature": "30 degC",
            "solid_flow": dry / hours / 3600.0,
            "liquid_flow": 0.18 * dry / hours / 3600.0,
        },
        gas={
            "temperature": "10 degC",
            "gas_flow": float(stored.superficial_velocity) * 20.0 * 1.243,
            "relative_humidity": 0.65,
        },
    )
    (unit,) = line.solve().units.values()
    return unit


layered = {hours: binned(hours) for hours in (84, 126)}
top = {hours: float(unit.values.temperature_product_highest) for hours, unit in layered.items()}
(drips,) = [float(c.value) for c in layered[126].checks if "moistest" in c.name]
floor = d.equilibrium_moisture(float(hot.relative_humidity), isotherm="maize", temperature="50 degC")
net = {
    x: float(d.isosteric_heat(x, isotherm="maize", temperature="50 degC").isosteric_heat_net)
    for x in (0.10, 0.18)
}
bound_share = {x: q / float(gr.materials.water_heat_of_vaporization("50 degC")) for x, q in net.items()}

# ---- test
test = d.DryingCurve.read(
    TEST,
    dry_solid_mass="3.765 kg",
    area="0.186 m2",
    equilibrium_moisture=0.190 / 3.765,
    warm_up_time="0.4 h",
)
fit = test.fit()
rate, critical = fit["drying_rate_constant"], fit["critical_moisture"]
# ---- trays
load = 3.765 / 0.186
balance = 0.190 / 3.765


def tray(depth, end=0.06, start=0.29):
    """Time of a tray that carries a multiple of the tested load."""
    return d.drying_time(load * depth, "1 m^2", rate.value, start, end, critical.value, balance)


to_8, to_6, to_55 = tray(1, 0.08), tray(1, 0.06), tray(1, 0.055)
moisture = np.asarray(test.mass) / 3.765 - 1
when = [float(np.interp(-x, -moisture, np.asarray(test.time))) for x in (0.29, 0.06)]
measured_6 = when[1] - when[0]
served = 0.5 * 3600  # emptying and filling
per_day = {k: 86400 * k * load / (float(tray(k).drying_time) + served) for k in (0.5, 1)}
thin = tray(0.5)
per_day_diffusion = (
    86400
    * 0.5
    * load
    / (float(thin.drying_time_constant_rate) + 0.5 * float(thin.drying_time_falling_rate) + served)
)
gain_thin = per_day_diffusion / per_day[1] - 1
loss_thin = 1 - per_day[0.5] / per_day[1]

# ---- surface
transfer = d.heat_transfer_coefficient_parallel("3 kg/(m^2*s)")
air = h.state(temperature="60 degC", relative_humidity="10 %")
flux = d.drying_rate_constant(transfer, "60 degC", float(air.wet_bulb_temperature))
gain_speed = float(d.heat_transfer_coefficient_parallel("6 kg/(m^2*s)")) / float(transfer)
warmer = h.state(temperature="80 degC", humidity_ratio=float(air.humidity_ratio))
flux_warmer = d.drying_rate_constant(transfer, "80 degC", float(warmer.wet_bulb_temperature))
gain_warmer = float(flux_warmer) / float(flux)

# ---- inside
sliced = {mm: float(d.drying_time_diffusion(0.1, f"{mm / 2} mm", "3e-10 m^2/s")) for mm in (2.5, 5, 10)}
cubes = {mm: float(d.drying_time_diffusion(0.1 ** (1 / 3), f"{mm / 2} mm", "3e-10 m^2/s")) for mm in (5, 10)}
drop = float(d.drying_time_diffusion(0.1, "50 um", "3e-10 m^2/s", shape="sphere"))


def vial(shelf, pressure):
    """A fill of 7 mm in primary drying, at °C and Pa, in the vial of Shivkumar and others."""
    per_volume = float(d.frozen_height("1 mL", "3.14 cm^2", "0.05 g/mL"))
    return d.primary_drying(
        pressure,
        shelf + ZERO,
        "3.8 cm^2",
        "3.14 cm^2",
        1e-6 * 7e-3 / per_volume,
        "0.05 g/mL",
        "2.75e-4 cal/(s*K*cm^2)",
        "8.93e-4 cal/(s*K*cm^2*torr)",
        "1.4 cm^2*hour*torr/g",
        "16 cm*hour*torr/g",
        vial_coefficient_saturation="0.46 1/torr",
    )


# ---- savings
exhaust = spent(80, 0.2)
again = spent(80, 0.5, recirculated_fraction=0.7)
won = d.exhaust_heat_recovery(
    float(exhaust.temperature_outlet),
    float(exhaust.humidity_ratio_outlet),
    "25 degC",
    float(exhaust.humidity_ratio_fresh),
    effectiveness=0.6,
)
pump = d.heat_pump_dryer("60 degC", "60 %", "20 degC")
steam = d.superheated_steam_drying("160 degC", "110 degC")
# ---- savings_more
recovered = float(exhaust.energy_per_water) * (1 - float(won.recovered_share))
pump_fuel = float(pump.energy_per_water) / 0.4

# ---- press
ways = d.water_removal_choice("1 t", 5.0, 0.1)
pressed_share = float(ways.mass_water[0]) / float(ways.mass_water[2])
together = sum(float(ways.mass_water[i]) * float(ways.energy_per_water[i]) for i in (0, 1)) / float(
    ways.mass_water[2]
)

# ---- choice
apples = d.choose(
    product_form="pieces",
    mass_flow="1 t/h",
    moisture_dry_basis_inlet=4.0,
    moisture_dry_basis_outlet=0.1,
    temperature_limit="60 degC",
)
# ---- sheets
apple_water = 1000 / 5.0 * 3.9 / 3600
with MACHINES.open(encoding="utf-8") as file:
    machines = {row["name"]: row for row in csv.DictReader(file)}


def sheet(machine, column):
    """A figure of the table of machines, in SI units."""
    found = next(name for name in machines[machine] if name.startswith(column))
    factor = 1000 if "kJ" in found else 1 / 3600 if "hour" in found else 1
    return factor * float(machines[machine][found])


belt_area = [apple_water / sheet("belt dryer", f"capacity_{end}") for end in ("high", "low")]


def figure_path():
    drawing = d.dryer_air_path("25 degC", "50 %", "50 degC", relative_humidity_outlet="60 %")
    drawing.data = [trace for trace in drawing.data if trace.type != "table"]
    drawing.update_layout(width=None, height=560, title=None)
    drawing.update_yaxes(domain=[0, 1])
    return drawing


def figure_energy():
    drawing = figure(
        axis_title("temperature", "degC", said("air heated to", "air chauffé à")),
        axis_title("energy_per_water", "MJ/kg"),
    )
    inlet = np.linspace(45, 200, 40)
    for outlet, color, dash in zip((0.2, 0.5, 0.9), LINES, DASHES, strict=False):
        energy = [float(spent(t, outlet).energy_per_water) / 1e6 for t in inlet]
        words = said("exhaust at {:.0f} %", "air de sortie à {:.0f} %").format(100 * outlet)
        add_line(drawing, inlet, energy, words, color=color, dash=dash)
    drawing.update_yaxes(range=[2, 8])
    return drawing


def figure_isotherms():
    drawing = figure(axis_title("water_activity"), axis_title("moisture_dry_basis", "kg/kg"))
    activity_ = np.linspace(0.2, 0.9, 60)
    shown = (
        ("maize", 25, said("maize, 25 °C", "maïs, 25 °C")),
        ("maize", 50, said("maize, 50 °C", "maïs, 50 °C")),
        ("potato", 30, said("potato, 30 °C", "pomme de terre, 30 °C")),
        (
            "microcrystalline_cellulose",
            25,
            said("microcrystalline cellulose, 25 °C", "cellulose microcristalline, 25 °C"),
        ),
    )
    for (name, celsius, words), color, dash in zip(shown, LINES, DASHES, strict=False):
        moisture = d.equilibrium_moisture(activity_, isotherm=name, temperature=celsius + ZERO)
        add_line(drawing, activity_, np.asarray(moisture), words, color=color, dash=dash)
    return drawing


epsom = gr.materials.solubility("25 degC", system="magnesium sulfate")
bound_by_epsom = epsom.solubility_per_solvent * (epsom.crystal_per_solute - 1.0)


def figure_curve():
    return drying_curve().figure


def figure_thickness():
    drawing = figure(axis_title("drying_time", "hour"), axis_title("moisture_ratio"), y_log=True)
    hours = np.linspace(0.02, 12, 120)
    for thickness, color, dash in zip((2.5, 5, 10), LINES, DASHES, strict=False):
        ratio = d.moisture_ratio_plate(3600 * hours, f"{thickness / 2} mm", "3e-10 m^2/s")
        add_line(
            drawing,
            hours,
            np.asarray(ratio),
            said("{} mm", "{} mm").format(str(thickness).replace(".", said(".", ","))),
            color=color,
            dash=dash,
        )
    drawing.update_yaxes(range=[-2, 0])
    return drawing


# ---- shelves
layer = {
    f"{mm} mm": d.contact_layer_drying(
        thickness=f"{mm} mm",
        bulk_density_dry=500.0,
        moisture_dry_basis_inlet=0.97,
        moisture_outlet=0.008,
        wall_temperature="70 degC",
        temperature_bed="38.5 degC",
        heat_transfer_coefficient=80.0,
        thermal_conductivity_dry=0.43,
        heat_of_vaporization="2408 kJ/kg",
    ).drying_time
    for mm in (25, 50)
}
