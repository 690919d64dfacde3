"""What the chapter on centrifuges states, calculated."""

from math import sqrt

import numpy as np

import granum as gr
from granum.app.chapters import said
from granum.core.charts import DASHES, LINES, add_line, axis_title, figure

ce, p, f = gr.centrifuges, gr.particles, gr.filtration
CLAY = {"particle_density": 2650, "fluid_density": 998.2, "dynamic_viscosity": "1.002 mPa s"}

# ---- field
effect = {
    r: float(ce.centrifugal_effect(r, n))
    for r, n in ((0.05, "15000 rpm"), (0.25, "3000 rpm"), (0.6, "1000 rpm"))
}
rim = sqrt(250e6 / 7850)  # of a thin empty ring at 250 MPa
highest = {r: rim**2 / r / 9.80665 for r in (0.05, 0.25, 0.6)}
still = float(p.terminal_velocity_stokes("2 um", **CLAY))

# ---- machines
tubular = {
    "bowl_length": "0.75 m",
    "radius_inner": "25 mm",
    "radius_outer": "50 mm",
    "rotation_speed": "15000 rpm",
}
decanter = {
    "bowl_length": "1.0 m",
    "radius_inner": "150 mm",
    "radius_outer": "225 mm",
    "rotation_speed": "3000 rpm",
}
disc = {
    "disc_number": 100,
    "radius_inner": "60 mm",
    "radius_outer": "150 mm",
    "rotation_speed": "6000 rpm",
    "disc_angle": "40 degree",
}
sigma = {
    "tubular": float(ce.sigma_factor_tubular_half_thickness(**tubular)),
    "decanter": float(ce.sigma_factor_scroll(**decanter)),
    "disc": float(ce.sigma_factor_disc(**disc)),
}
real = {"tubular": 0.9, "decanter": 0.6, "disc": 0.55}
# ---- machines_more
FLOW = 5 / 3600
cut = {
    name: float(ce.cut_size_centrifuge(FLOW, s, **CLAY, flow_multiple=2.0, sigma_efficiency=real[name]))
    for name, s in sigma.items()
}
handles = {
    name: float(ce.volume_flow_centrifuge("1 um", s, **CLAY, flow_multiple=2.0, sigma_efficiency=real[name]))
    for name, s in sigma.items()
}
basin = float(p.terminal_velocity_stokes("1 um", **CLAY))
basin_area = FLOW / (2 * basin)

# ---- geankoplis
bowl = ce.sigma_factor_tubular_half_thickness(
    bowl_length="0.1970 m", radius_inner="7.16 mm", radius_outer="22.25 mm", rotation_speed="23000 rpm"
)

# ---- drive
power = ce.power_acceleration("5.2 t/hour", 0.225, "3000 rpm")
power_at_pond = ce.power_acceleration("5.2 t/hour", 0.150, "3000 rpm")
push = ce.liquid_pressure_bowl(0.225, 0.150, "3000 rpm", 1100)
wall = ce.hoop_stress_bowl(0.225, "10 mm", "3000 rpm", float(push))
wall_empty = ce.hoop_stress_bowl(0.225, "10 mm", "3000 rpm", 0.0)

# ---- liquids
DAMS = {"radius_light": "55 mm", "density_heavy": 1000, "density_light": 920}
interface = ce.radius_interface(radius_heavy="60 mm", **DAMS)
wider = ce.radius_interface(radius_heavy="61 mm", **DAMS)
shift = float(wider) - float(interface)
closer = ce.radius_interface(radius_heavy="60 mm", **DAMS | {"density_light": 940})

# ---- basket
BASKET = {
    "radius_outer": "0.5 m",
    "cake_radius": "0.42 m",
    "rotation_speed": "1200 rpm",
    "liquid_density": 1200,
    "dynamic_viscosity": "2 mPa s",
}
basket_effect = ce.centrifugal_effect(0.46, "1200 rpm")


def spun(size, time="60 s"):
    """Flow, residual and reached saturation of a cake of a size."""
    permeability = float(
        gr.porous.permeability_kozeny_carman(void_fraction=0.42, specific_surface=6 / (size * 1e-6))
    )
    final = float(ce.irreducible_saturation_spinning(f"{size} um", 0.42, 0.46, "1200 rpm", 1200, "0.07 N/m"))
    return {
        "flow": float(ce.filtrate_flow_critical("0.5 m", cake_permeability=permeability, **BASKET)),
        "final": final,
        "reached": float(
            ce.cake_saturation_spinning(
                time, f"{size} um", 0.42, "80 mm", 0.46, "1200 rpm", 1200, "2 mPa s", final
            )
        ),
    }


SPIN = (0.46, "1200 rpm", 1200, "0.07 N/m")
leung = {
    size: float(ce.irreducible_saturation_leung(f"{size} um", 0.42, "80 mm", *SPIN))
    for size in (20, 100, 300)
}
cakes = {size: spun(size) for size in (20, 100, 300)}
moisture = {
    size: float(
        f.moisture_dry_basis_cake(x["reached"], void_fraction=0.42, liquid_density=1200, solid_density=2160)
    )
    for size, x in cakes.items()
}

threshold = {size: float(f.threshold_pressure_cake(f"{size} um", 0.42, "0.07 N/m")) for size in cakes}
column = 1200 * basket_effect * 9.80665 * 0.08

moisture_leung = {
    size: float(f.moisture_dry_basis_cake(x, void_fraction=0.42, liquid_density=1200, solid_density=2160))
    for size, x in leung.items()
}

saved = 1000 * 0.01
energy = saved * 4e6
energy_five = 5 * energy

# ---- bottle
spin = ce.sigma_factor_bottle("15 mL", "100 mm", "160 mm", "3000 rpm")
loading = 15e-6 / 180 / float(spin)  # clear after three minutes
wanted = FLOW / loading
used = {name: wanted / (real[name] * s) for name, s in sigma.items()}
doubtful = FLOW / (15e-6 / 300 / float(spin)) / (real["decanter"] * sigma["decanter"])  # after five

# ---- sludge
# sludge of half solids by volume, from feeds of 5 % and 0.1 % of solids, in a bowl that holds 5 L of it
interval = {share: float(ce.discharge_interval("5 L", FLOW * share / 0.5)) for share in (0.05, 0.001)}


# ---- figures
def figure_grade():
    drawing = figure(axis_title("particle_diameter", "um"), axis_title("grade_efficiency", "%"), x_log=True)
    sizes = np.geomspace(0.2e-6, 5e-6, 80)
    velocity = np.asarray(p.terminal_velocity_stokes(sizes, **CLAY))
    for flow, color, dash in zip((1, 5, 20), LINES, DASHES, strict=False):
        caught = ce.grade_efficiency_tubular(velocity, flow / 3600, **tubular)
        add_line(drawing, 1e6 * sizes, 100 * np.asarray(caught), f"{flow} m³/h", color=color, dash=dash)
    return drawing


def figure_cut():
    drawing = figure(
        axis_title("volume_flow", "m^3/hour"), axis_title("cut_size_centrifuge", "um"), x_log=True, y_log=True
    )
    words = (
        ("tubular", said("tubular bowl", "bol tubulaire")),
        ("decanter", said("scroll decanter", "décanteuse à vis")),
        ("disc", said("disc stack", "assiettes")),
    )
    flows = np.geomspace(0.3, 100, 40)
    for (name, label), color, dash in zip(words, LINES, DASHES, strict=False):
        cuts_ = ce.cut_size_centrifuge(
            flows / 3600, sigma[name], **CLAY, flow_multiple=2.0, sigma_efficiency=real[name]
        )
        add_line(drawing, flows, 1e6 * np.asarray(cuts_), label, color=color, dash=dash)
    return drawing


def figure_interface():
    drawing = figure(
        said("radius of the dam for the heavy liquid / mm", "rayon du déversoir du liquide lourd / mm"),
        axis_title("radius_interface", "mm"),
    )
    dams = np.linspace(56, 63, 60)
    for light, color, dash in zip((900, 920, 940), LINES, DASHES, strict=False):
        found = [1e3 * float(ce.radius_interface(d / 1e3, "55 mm", 1000, light)) for d in dams]
        add_line(drawing, dams, found, f"{light} kg/m³", color=color, dash=dash)
    drawing.update_yaxes(range=[50, 130])
    return drawing


def figure_spinning():
    drawing = figure(axis_title("time", "s"), axis_title("cake_saturation", "%"), x_log=True)
    times = np.geomspace(3, 600, 60)
    for size, color, dash in zip(cakes, LINES, DASHES, strict=False):
        reached = [
            100
            * float(
                ce.cake_saturation_spinning(
                    t, f"{size} um", 0.42, "80 mm", 0.46, "1200 rpm", 1200, "2 mPa s", cakes[size]["final"]
                )
            )
            for t in times
        ]
        add_line(drawing, times, reached, f"{size} µm", color=color, dash=dash)
    return drawing
