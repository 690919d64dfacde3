"""What the chapter on cyclones and gas cleaning states, calculated."""

from math import log, sqrt
from pathlib import Path

import numpy as np

import granum as gr
from granum.app.chapters import said
from granum.app.shipped import examples_folder
from granum.core.charts import DASHES, LINES, add_line, add_points, axis_title, figure

c, p, du, m = gr.cyclones, gr.particles, gr.dust, gr.materials
AIR = {"fluid_density": 1.2, "dynamic_viscosity": "18 uPa s"}
SHAPE = c.StandardCyclone()

# ---- explosion
starch = du.dust_explosibility("wheat starch")
vent = float(
    du.vent_area_en14491(
        60.0,
        starch.deflagration_index,
        starch.explosion_pressure,
        reduced_pressure=4e4,
        activation_pressure=1e4,
    )
)
held = float(du.oxygen_permitted_nfpa69(starch.limiting_oxygen, True))
nitrogen_per_air = float(du.inert_gas_flow_steady(1.0, held))

# ---- field
radius, speed = 0.05, 20.0
gees = speed**2 / radius / 9.80665
drift = {um: float(p.terminal_velocity_stokes(f"{um} um", 2000, **AIR)) * gees for um in (1, 5)}

# ---- stairmand
TEST = {"volume_flow": "223 m^3/hour", "particle_density": 2000} | AIR
SMALL = SHAPE(0.203)._asdict()
heads = c.inlet_heads_stairmand(**SMALL)
entry = 223 / 3600 / (SMALL["inlet_height"] * SMALL["inlet_width"])
drop_small = float(heads) * 0.6 * entry**2


def half(law, **more):
    """The size that a law of grade efficiency collects by half."""
    low, high = 1e-8, 1e-4
    for _ in range(50):
        middle = sqrt(low * high)
        caught = float(law(middle, **TEST | more, **SMALL))
        low, high = (middle, high) if caught < 0.5 else (low, middle)
    return middle


cuts = {
    "barth": float(c.cut_size_barth(**TEST, **SMALL)),
    "muschelknautz": float(c.cut_size_muschelknautz(**TEST, **SMALL)),
    "leith_licht": half(c.cyclone_efficiency_leith_licht),
    "mothes_loffler": half(c.cyclone_efficiency_mothes_loffler),
    "lapple": half(c.cyclone_efficiency_lapple),
}
measured = 1.4e-6

# ---- duty
FLOW = 5000 / 3600
DUST = 10e-3  # kg/m³
QUANTILES = (np.arange(400) + 0.5) / 400
SIZES = 20e-6 * -np.log(1 - QUANTILES)  # Rosin–Rammler, modulus 20 µm, exponent 1


def option(number, diameter, loading=0.0):
    """Equal cyclones in parallel: inlet velocity, pressure drop, cut, share that escapes, and its sizes."""
    shape = SHAPE(diameter)._asdict()
    gas = {"volume_flow": FLOW / number, "particle_density": 2000} | AIR
    velocity = FLOW / number / (shape["inlet_height"] * shape["inlet_width"])
    caught = np.asarray(c.cyclone_efficiency_muschelknautz(SIZES, **gas, **shape, dust_loading=loading))
    return {
        "velocity": velocity,
        "drop": float(c.inlet_heads_stairmand(**shape)) * 0.6 * velocity**2,
        "cut": float(c.cut_size_muschelknautz(**gas, **shape)),
        "escapes": float(np.mean(1 - caught)),
        "fine": float(np.sum((1 - caught)[SIZES < 5e-6]) / np.sum(1 - caught)),
    }


options = {
    name: option(n, d)
    for name, n, d in (("one", 1, 0.96), ("narrow", 1, 0.75), ("four", 4, 0.48), ("many", 16, 0.24))
}
left = {name: DUST * x["escapes"] for name, x in options.items()}
power = {name: FLOW * x["drop"] / 0.6 for name, x in options.items()}
share_needed = 20e-6 / DUST
loading = DUST / 1.2
limit = float(c.limit_loading_muschelknautz(loading, options["four"]["cut"], 20e-6 * log(2)))
loaded = DUST * option(4, 0.48, loading)["escapes"] * min(1.0, limit / loading)

missed = loaded / 20e-6

# ---- hot
HOT = m.gas_properties(fluid="dry air", temperature="300 degC")
coarser = sqrt(float(HOT.dynamic_viscosity) / 18e-6) - 1
lighter = 1 - float(HOT.gas_density) / 1.2

# ---- bag
CLOTH = 1.0 / 60  # m³ of gas per m² and second: a meter in a minute
bag_area = FLOW / CLOTH
RESIDUAL = float(du.residual_drag_pulse_jet("6 bar"))
BEHIND = left["four"]
bag_drop = RESIDUAL * CLOTH + 6e4 * BEHIND * CLOTH**2 * 600 / 2
bag_drop_raw = RESIDUAL * CLOTH + 6e4 * DUST * CLOTH**2 * 600 / 2
bag_power = FLOW * 1500 / 0.6


# ---- scrubber
def venturi(throat, micrometer, liquid=1e-3):
    """Share that a venturi lets pass."""
    drops = float(du.droplet_diameter_venturi(throat, liquid))
    slip = 1 + 2.52 * 66e-9 / (micrometer * 1e-6)
    psi = float(du.impaction_number(micrometer * 1e-6, 2000, throat, 18e-6, drops, slip))
    return 1 - float(du.grade_efficiency_johnstone(psi, liquid))


passing = {(v, um): venturi(v, um) for v in (60, 100) for um in (0.5, 1, 2)}
wet_drop = {v: float(du.pressure_drop_venturi(v, 1e-3, 1000)) for v in (60, 100)}
wet_power = {v: FLOW * x / 0.6 for v, x in wet_drop.items()}
charges = float(du.elementary_charges_field("1 um", 4e5))
wander = 0.5 * float(du.migration_velocity(charges, 3e5, "1 um", 18e-6, 1 + 2.52 * 0.066))
plates = FLOW / wander * log(1000)

# ---- water
pulp = c.hydrocyclone_sizing(
    volume_flow="50 m^3/hour",
    cut_size="15 um",
    pressure_drop="1.5 bar",
    underflow_share=0.1,
    particle_density=2650,
    solids_volume_fraction=0.05,
)
network = gr.read(Path(examples_folder()) / "hydrocyclone-network" / "line.toml").solve()
sharper = np.ravel(network.streams["clean_sand"].solid) / np.ravel(network.streams["raw_sand"].solid)
bypassed = 100 * float(sharper[0])
bypass_single = 100 * network.figure("rougher.underflow_share")
roughers = network.found["rougher.parallel_number"]


def figure_grade():
    drawing = figure(axis_title("particle_diameter", "um"), axis_title("cyclone_efficiency", "%"), x_log=True)
    sizes = np.geomspace(0.3e-6, 10e-6, 60)
    laws = (
        ("Muschelknautz", c.cyclone_efficiency_muschelknautz),
        ("Barth", c.cyclone_efficiency_barth),
        ("Leith–Licht", c.cyclone_efficiency_leith_licht),
        ("Mothes–Löffler", c.cyclone_efficiency_mothes_loffler),
        ("Lapple", c.cyclone_efficiency_lapple),
    )
    for (name, law), color, dash in zip(laws, LINES, DASHES, strict=False):
        caught = [100 * float(law(s, **TEST, **SMALL)) for s in sizes]
        add_line(drawing, 1e6 * sizes, caught, name, color=color, dash=dash)
    add_points(drawing, [1.4], [50.0], said("Stairmand, measured", "Stairmand, mesuré"))
    return drawing


def figure_escape():
    drawing = figure(
        axis_title("pressure_drop", "kPa"),
        said("dust behind the cyclones / g/m³", "poussière après les cyclones / g/m³"),
        x_log=True,
        y_log=True,
    )
    for number, color, dash in zip((1, 4, 16), LINES, DASHES, strict=False):
        found = [option(number, sqrt(FLOW / number / (0.1 * v))) for v in (6, 8, 10, 13, 16, 20, 25)]
        name = (
            said("{} in parallel", "{} en parallèle").format(number) if number > 1 else said("one", "un seul")
        )
        add_line(
            drawing,
            [x["drop"] / 1e3 for x in found],
            [1e3 * DUST * x["escapes"] for x in found],
            name,
            color=color,
            dash=dash,
        )
    return drawing
