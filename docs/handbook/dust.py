"""What the chapter on dust states, calculated."""

from math import sqrt

import numpy as np

import granum as gr
from granum.app.chapters import said
from granum.core.charts import DASHES, LINES, add_line, add_points, axis_title, figure

du, f = gr.dust, gr.filtration
DENSITY, VISCOSITY, FREE_PATH = 2000.0, 18e-6, 66e-9
FLOW = 10.0
"""m³/s of air at 20 °C with mineral dust, of all collectors of the chapter."""


# ---- sizes
def slip(size):
    """Cunningham's factor."""
    knudsen = 2 * FREE_PATH / np.asarray(size)
    return 1 + knudsen * (1.257 + 0.4 * np.exp(-1.1 / knudsen))


def falling(size):
    """Settling velocity, Stokes law with slip."""
    return DENSITY * 9.80665 * np.asarray(size) ** 2 * slip(size) / (18 * VISCOSITY)


speeds = {um: float(falling(um * 1e-6)) for um in (0.3, 1, 10, 100)}


# ---- collectors
def chamber(size, area=100.0):
    return np.asarray(du.grade_efficiency_chamber_turbulent(falling(size), area, FLOW))


WATER = 1e-3
"""m³ of water for a cubic meter of gas."""


def venturi(size, throat):
    drops = float(du.droplet_diameter_venturi(throat, WATER))
    psi = du.impaction_number(size, DENSITY, throat, VISCOSITY, drops, slip(size))
    return np.asarray(du.grade_efficiency_johnstone(psi, WATER))


def tower(size, height=10.0, drop=1e-3, fall=3.9, rise=1.0):
    """Spray tower with drops of a millimeter."""
    psi = du.impaction_number(size, DENSITY, fall, VISCOSITY, drop, slip(size))
    target = du.target_efficiency_drop(psi)
    return np.asarray(du.grade_efficiency_spray_tower(target, WATER, height, drop, fall, rise))


def drifting(size, field=3e5):
    """Drift in a precipitator at half of the theory, as plants find it."""
    charges = du.elementary_charges_field(size, field) + du.elementary_charges_diffusion(size)
    return 0.5 * np.asarray(du.migration_velocity(charges, field, size, VISCOSITY, slip(size)))


def precipitator(size, plates=1500.0):
    return np.asarray(du.grade_efficiency_deutsch(drifting(size), plates, FLOW))


def half(law, low=1e-8, high=1e-3):
    """Size that a law collects by half."""
    for _ in range(60):
        middle = sqrt(low * high)
        low, high = (middle, high) if float(law(middle)) < 0.5 else (low, middle)
    return middle


cuts = {
    "chamber": half(chamber),
    "tower": half(tower),
    60: half(lambda d: venturi(d, 60.0)),
    100: half(lambda d: venturi(d, 100.0)),
}
SIZES = np.geomspace(1e-7, 1e-4, 80)
least = precipitator(SIZES)
hardest, hardest_caught = float(SIZES[np.argmin(least)]), float(least.min())
wet_drop = {v: float(du.pressure_drop_venturi(v, WATER, 1000.0)) for v in (60, 100)}
wet_power = {v: FLOW * x / 0.6 for v, x in wet_drop.items()}
exam = sqrt(18 * 2.1e-5 * 0.2 * 2.0 / 12.0 / (9.81 * 2650.0))
twice = 1 - (1 - 0.99) ** 2

# ---- bags
DRAG, CAKE, LOAD = float(du.residual_drag_pulse_jet("6 bar")), 1e5, 10e-3
"""Cloth, Pa s/m; dust cake, 1/s; dust in the gas, kg/m³."""


def cloth(speed, minutes):
    """Pressure drop before the pulse, at meters a minute."""
    return float(f.pressure_drop_dust_cake(speed / 60.0, LOAD, 60.0 * minutes, DRAG, CAKE))


lost = {(v, t): cloth(v, t) for v in (1.0, 1.5, 2.0) for t in (5, 15)}
cloths = {v: FLOW / (v / 60.0) for v in (1.0, 2.0)}
sheet = float(
    f.pressure_drop_dust_cake(
        1e4 / 2132.55 * 0.3048 / 60.0,
        4.0 * 64.79891e-6 / 0.3048**3,
        600.0,
        float(du.residual_drag_pulse_jet("100 psi")),
        15.0 * 249.08891 / (0.3048 / 60.0) / (0.45359237 / 0.3048**2),
    )
)

# ---- stack
measured = 14e-6 * (273.15 + 140) / 273.15 / (1 - 0.15)
"""kg/m³ dry at 0 °C where an instrument finds 14 mg/m³ in wet gas of 140 °C with 15 % of vapor."""
corrected = measured * (20.95 - 11.0) / (20.95 - 16.0)

# ---- cloud
layer = {mm: 500.0 * mm * 1e-3 / 3.0 for mm in (0.2, 1.0)}
"""Cloud that a layer of 500 kg/m³ makes in the 3 m of air above it."""
thinnest = 0.06 * 3.0 / 500.0
breathed = 0.06 / 10e-6

# ---- vents
dusts = {name: du.dust_explosibility(name) for name in ("lactose", "wheat starch", "sugar", "aluminum")}


def vent(name, reduced="0.4 bar", volume="10 m^3", slender=1.0):
    """Area that a vessel needs, m²."""
    of = dusts[name]
    return float(
        du.vent_area_en14491(
            volume, of.deflagration_index, of.explosion_pressure, reduced, "0.1 bar", slender
        )
    )


def vent_nfpa(name, reduced="0.4 bar", volume="10 m^3"):
    of = dusts[name]
    return float(
        du.vent_area_nfpa68(volume, of.deflagration_index, of.explosion_pressure, reduced, "0.1 bar")
    )


vents = {(n, r): vent(n, f"{r} bar") for n in ("lactose", "wheat starch", "sugar") for r in (0.2, 0.4, 1.0)}
slender = vent("wheat starch", slender=4.0) / vent("wheat starch")
bigger = vent("wheat starch", volume="80 m^3") / vent("wheat starch")
other = vent_nfpa("wheat starch") / vent("wheat starch") - 1
receiver = vent("wheat starch", volume="3 m^3", slender=2.0)
rate = float(dusts["wheat starch"].deflagration_index) / 3.0 ** (1 / 3)

# ---- nitrogen
LEAK = 20.0 / 3600.0
nitrogen = {x: float(du.inert_gas_flow_steady(LEAK, x)) for x in (0.10, 0.08, 0.05)}
conveying_air = 1150.0 / 1.2 / 3600.0
through = float(du.inert_gas_flow_steady(conveying_air, 0.08))


# ---- figures
def figure_grades():
    drawing = figure(axis_title("particle_diameter", "um"), said("collected / %", "retenu / %"), x_log=True)
    shown = (
        (chamber, said("settling chamber, 100 m²", "chambre, 100 m²")),
        (tower, said("spray tower, 10 m", "tour de lavage, 10 m")),
        (lambda d: venturi(d, 60.0), said("venturi, 60 m/s", "venturi, 60 m/s")),
        (lambda d: venturi(d, 100.0), said("venturi, 100 m/s", "venturi, 100 m/s")),
        (precipitator, said("precipitator, 1500 m²", "électrofiltre, 1500 m²")),
    )
    for (law, words), color, dash in zip(shown, LINES, DASHES, strict=False):
        add_line(drawing, 1e6 * SIZES, 100 * law(SIZES), words, color=color, dash=dash)
    return drawing


def figure_paid():
    drawing = figure(
        axis_title("pressure_drop", "kPa"),
        said("size caught by half / µm", "taille retenue à moitié / µm"),
        x_log=True,
        y_log=True,
    )
    throats = np.linspace(25.0, 140.0, 24)
    for water, color, dash in zip((0.5e-3, 1e-3, 2e-3), LINES, DASHES, strict=False):
        found = []
        for throat in throats:
            drops = float(du.droplet_diameter_venturi(throat, water))

            def caught(size, throat=throat, water=water, drops=drops):
                psi = du.impaction_number(size, DENSITY, throat, VISCOSITY, drops, slip(size))
                return du.grade_efficiency_johnstone(psi, water)

            found.append(1e6 * half(caught))
        paid = [float(du.pressure_drop_venturi(v, water, 1000.0)) / 1e3 for v in throats]
        words = said("{} L/m³", "{} L/m³").format(str(1e3 * water).replace(".", said(".", ",")))
        add_line(drawing, paid, found, words, color=color, dash=dash)
    return drawing


fine_fiber = {
    d: gr.filtration.fiber_efficiency_lee_liu(
        f"{d} um", "3 um", 0.03, "9 cm/s", 1.8e-5, "20 degC", 1000, slip_factor=slips
    )
    for d, slips in ((0.03, 7.7), (0.3, 1.57), (3, 1.06))
}


def figure_vents():
    drawing = figure(
        axis_title("reduced_pressure", "bar"), axis_title("vent_area", "m^2"), x_log=True, y_log=True
    )
    names = {
        "lactose": said("lactose", "lactose"),
        "wheat starch": said("wheat starch", "amidon de blé"),
        "sugar": said("sugar", "sucre"),
        "aluminum": said("aluminum", "aluminium"),
    }
    reduced = np.linspace(0.15, 2.0, 40)
    for (name, words), color, dash in zip(names.items(), LINES, DASHES, strict=False):
        add_line(drawing, reduced, [vent(name, f"{r} bar") for r in reduced], words, color=color, dash=dash)
    points = [0.2, 0.4, 0.8, 1.6]
    found = [vent_nfpa("wheat starch", f"{r} bar") for r in points]
    add_points(drawing, points, found, said("wheat starch, NFPA 68", "amidon de blé, NFPA 68"))
    return drawing
