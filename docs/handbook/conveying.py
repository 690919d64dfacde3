"""What the chapter on conveying and hoppers states, calculated."""

from math import pi

import numpy as np

import granum as gr
from granum.app.chapters import said
from granum.app.shipped import examples_folder
from granum.core.charts import DASHES, LINES, add_line, add_points, axis_title, figure
from granum.streams.cakes import solid_diameter

c, p = gr.conveying, gr.particles
AIR, VISCOSITY = 1.2, 18e-6
DEGREE = pi / 180.0
BORE = 0.1
SECTION = pi / 4.0 * BORE**2

# ---- line
LINE = gr.read(examples_folder() / "conveying" / "line.toml").solve()
flown = LINE.units["line"].values
margin = float(flown.gas_velocity_inlet) / float(flown.saltation_velocity)
per_tonne = LINE.carriers["electricity"] / (2.8 / 3.6)


# ---- saltation
def falling(size, density=1500.0):
    return float(p.terminal_velocity(size, density, AIR, VISCOSITY))


def saltation(flux, size, density=1500.0, bore=BORE):
    """Four laws for the same line, m/s."""
    fall = falling(size, density)
    return {
        "rizk": float(c.saltation_velocity_rizk(flux, size, AIR, bore)),
        "matsumoto": float(c.saltation_velocity_matsumoto(flux, size, density, AIR, fall, bore)),
        "schade": float(c.saltation_velocity_schade(flux, size, density, AIR, bore)),
        "weber": float(c.saltation_velocity_weber(flux, size, AIR, fall, bore)),
    }


SOLID = 2000.0 / 3600.0 / SECTION
"""2 t/h in a bore of 100 mm, kg/(m² s)."""
powder, granules = saltation(SOLID, 100e-6), saltation(SOLID, 2e-3)
spread = {"powder": max(powder.values()) / min(powder.values())}
rising = float(c.choking_punwani(SOLID, 1500.0, AIR, falling(2e-3), BORE).choking_velocity)
wider = saltation(SOLID / 4.0, 2e-3, bore=2 * BORE)["rizk"]
more = saltation(1.5 * SOLID, 2e-3)["rizk"]
kept = {2: 20.0 / granules["rizk"], 3: 20.0 / more}
rhodes = float(c.saltation_velocity_rizk(0.25 / (pi / 4 * 0.078**2), 100e-6, AIR, 0.078))


# ---- state
def gradient(velocity, size=2e-3, tons=2.0):
    """Pressure lost per meter of level pipe, gas and solid."""
    gas = float(c.pressure_gradient_pipe(velocity, BORE, AIR, VISCOSITY))
    return gas + float(c.pressure_gradient_solid_konno_saito(tons / 3.6 / SECTION, BORE))


friction = {v: gradient(v) for v in (15.0, 25.0, 35.0)}
bend = {v: float(c.pressure_drop_bend(v, AIR, 2.0 / 3.6 / (AIR * v * SECTION))) for v in (15.0, 25.0, 35.0)}
start = {v: SOLID * 0.8 * v for v in (15.0, 25.0, 35.0)}
wear = (35.0 / 15.0) ** 2.6

# ---- slurry
SAND = {"particle_density": 2650.0, "liquid_density": 1000.0}
PIPE, SHARE = 0.2, 0.15


def slurry(velocity, size):
    return float(
        c.pressure_gradient_slurry_wilson(velocity, PIPE, size, SHARE, dynamic_viscosity=1e-3, **SAND)
    )


def durand(velocity, size):
    fall = float(p.terminal_velocity(size, 2650.0, 1000.0, 1e-3))
    drag = 4.0 * 9.80665 * size * 1.65 / (3.0 * fall**2)
    return float(
        c.pressure_gradient_slurry_durand(
            velocity, PIPE, SHARE, dynamic_viscosity=1e-3, drag_coefficient=drag, **SAND
        )
    )


def water(velocity):
    return float(c.pressure_gradient_pipe(velocity, PIPE, 1000.0, 1e-3))


deposit = {
    "durand": float(c.deposition_velocity_durand(PIPE, **SAND)),
    "wilson": float(c.deposition_velocity_wilson(PIPE, 0.5e-3, **SAND)),
    "wasp": float(c.deposition_velocity_wasp(PIPE, 0.5e-3, SHARE, **SAND)),
}
lost = {v: (water(v), slurry(v, 0.5e-3), durand(v, 0.5e-3)) for v in (3.0, 4.0, 5.0)}
twice_bore = float(c.deposition_velocity_durand(2 * PIPE, **SAND)) / deposit["durand"]


def paste(velocity):
    """A Bingham paste of 1300 kg/m³, 10 Pa and 20 mPa s in the same pipe."""
    return float(c.pressure_gradient_bingham(velocity, PIPE, 1300.0, 10.0, 0.02))


thick = {v: paste(v) for v in (0.2, 1.0, 3.0)}
at_rest = 4.0 * 10.0 / PIPE

# ---- outflow
grain = {mm: float(c.mass_flow_beverloo(750.0, mm / 1e3, 3e-3)) for mm in (50, 100, 200)}

# ---- silo
deep = {
    z: float(c.silo_stresses_janssen(z, 3.0, 750.0, 22 * DEGREE).stress_vertical) for z in (3.0, 10.0, 20.0)
}
as_water = {z: 750.0 * 9.80665 * z for z in deep}
grip = float(c.silo_stresses_janssen(20.0, 3.0, 750.0, 22 * DEGREE).stress_wall_shear)

# ---- shear
CONSOLIDATION, STRENGTH = [1300.0, 1600.0, 2000.0, 2400.0], [780.0, 850.0, 910.0, 970.0]
"""Rhodes's example, Pa."""
fit = c.FlowFunction(CONSOLIDATION, STRENGTH).fit()
# ---- hopper
steepest = float(c.half_angle_mass_flow_cone(30 * DEGREE, 19 * DEGREE)) / DEGREE
rough = float(c.half_angle_mass_flow_cone(30 * DEGREE, 24 * DEGREE)) / DEGREE
angle = (steepest - 3.0) * DEGREE
factor = float(c.flow_factor_hopper(30 * DEGREE, 19 * DEGREE, angle))
strength = float(c.critical_strength(fit["strength_intercept"].value, fit["strength_slope"].value, factor))
outlet = float(c.outlet_width_jenike(strength, 1300.0, angle))
slot = float(c.outlet_width_jenike(strength, 1300.0, angle, "wedge"))
# ---- silo
SILO = LINE.sheet.units["silo"]
stored = LINE.units["silo"].values
breathing = c.outlet_velocity_carleton(
    0.4, 16 * DEGREE, float(solid_diameter(LINE.streams["caught_starch"])), 1500.0, AIR, VISCOSITY
)
pressed = SILO.strength_intercept + SILO.strength_slope * float(stored.stress_vertical)
hole = float(c.rathole_diameter_jenike(pressed, SILO.bulk_density, SILO.effective_friction_angle))


# ---- figures
def figure_saltation():
    drawing = figure(
        axis_title("particle_diameter", "um"), axis_title("saltation_velocity", "m/s"), x_log=True
    )
    sizes = np.geomspace(50e-6, 4e-3, 40)
    found = [saltation(SOLID, float(d)) for d in sizes]
    names = {"rizk": "Rizk", "matsumoto": "Matsumoto", "schade": "Schade", "weber": "Weber"}
    for (law, name), color, dash in zip(names.items(), LINES, DASHES, strict=False):
        add_line(drawing, 1e6 * sizes, [x[law] for x in found], name, color=color, dash=dash)
    return drawing


def figure_slurry():
    drawing = figure(axis_title("velocity", "m/s"), axis_title("pressure_gradient", "kPa/m"))
    speeds = np.linspace(1.5, 6.0, 40)
    laws = (
        (water, said("water", "eau")),
        (lambda v: slurry(v, 0.5e-3), said("sand of 0.5 mm, Wilson", "sable de 0,5 mm, Wilson")),
        (lambda v: durand(v, 0.5e-3), said("sand of 0.5 mm, Durand", "sable de 0,5 mm, Durand")),
        (paste, said("paste of 10 Pa", "pâte de 10 Pa")),
    )
    for (law, words), color, dash in zip(laws, LINES, DASHES, strict=False):
        add_line(drawing, speeds, [law(float(v)) / 1e3 for v in speeds], words, color=color, dash=dash)
    drawing.update_yaxes(range=[0, 3])
    return drawing


def figure_flow_function():
    drawing = figure(axis_title("consolidation_stress", "kPa"), axis_title("unconfined_strength", "kPa"))
    add_points(
        drawing,
        np.asarray(CONSOLIDATION) / 1e3,
        np.asarray(STRENGTH) / 1e3,
        said("measured (Rhodes)", "mesuré (Rhodes)"),
    )
    stress = np.linspace(0.0, 3000.0, 30)
    line = fit["strength_intercept"].value + fit["strength_slope"].value * stress
    add_line(drawing, stress / 1e3, line / 1e3, said("flow function", "fonction d'écoulement"))
    add_line(
        drawing,
        stress / 1e3,
        stress / factor / 1e3,
        said("stress in an arch", "contrainte dans une voûte"),
        color=LINES[1],
        dash=DASHES[1],
    )
    return drawing
