"""What the chapter on materials and solutions states, calculated."""

import csv
from pathlib import Path

import numpy as np

import granum as gr
from granum.app.chapters import said
from granum.core.charts import DASHES, LINES, add_line, add_points, axis_title, figure
from granum.materials.stated import StatedFluid

m = gr.materials
DATA = Path(__file__).parent.parent / "data"

# ---- water
thick = {t: float(m.water_viscosity(f"{t} degC")) for t in (5, 20, 60, 90)}
dense = {t: float(m.water_density(f"{t} degC")) for t in (5, 20, 60, 90)}
thinner = thick[20] / thick[60]
winter = thick[5] / thick[20]
air = {t: m.gas_properties(temperature=f"{t} degC") for t in (20, 300)}
air_thicker = float(air[300].dynamic_viscosity) / float(air[20].dynamic_viscosity)
air_lighter = float(air[20].gas_density) / float(air[300].gas_density)
# ---- liquids of trade
glycerol = {w: m.dynamic_viscosity_glycerol_water("20 degC", w) for w in (0.99, 1.0)}
cold = StatedFluid.read("20 % calcium chloride at 0 °C")
brine_density, brine_viscosity = float(cold.density()), 1e3 * float(cold.viscosity())
olive = {t: 1e3 * float(m.fluid("olive oil").liquid_viscosity(f"{t} degC")) for t in (20, 40)}
hydraulic = 1e3 * float(m.fluid("mineral oil VG 46").liquid_viscosity("20 degC"))
ocean = m.fluid("seawater")
sea = {"density": ocean.liquid_density("20 degC"), "viscosity": 1e3 * ocean.liquid_viscosity("20 degC")}
# ---- warm
per_kilogram = float(m.water_enthalpy("60 degC")) - float(m.water_enthalpy("20 degC"))
heater = 10e3 / 3600.0 * per_kilogram


# ---- solutions
def solution(system, share, celsius=20):
    return m.solution_properties(f"{celsius} degC", share, system=system)


brine, weak = solution("sodium chloride", 0.25), solution("sodium chloride", 0.05)
syrup = {x: float(solution("sucrose", x).dynamic_viscosity) for x in (0.20, 0.40, 0.60)}
saturated = float(m.saturated_solution("20 degC", system="sodium chloride").dynamic_viscosity)


# ---- solubility
def solubility(system, celsius):
    """Anhydrous solute for a mass of water."""
    return float(m.solubility(f"{celsius} degC", system=system).solubility_per_solvent)


NAMES = ("potassium nitrate", "sodium chloride", "potassium sulfate", "copper sulfate", "sucrose")
dissolved = {(n, t): solubility(n, t) for n in NAMES for t in (20, 80)}
cooled = {n: 1.0 - dissolved[n, 20] / dissolved[n, 80] for n in NAMES}
blue = m.solubility("20 degC", system="copper sulfate")
bound = float(blue.crystal_per_solute) - 1.0
hydrated = dissolved["copper sulfate", 20] * float(blue.crystal_per_solute)
water_left = 1.0 - dissolved["copper sulfate", 20] * bound
per_water = hydrated / water_left
share = dissolved["potassium nitrate", 20] / (1.0 + dissolved["potassium nitrate", 20])


def table():
    """Perry's solubilities, by name: temperatures and mass for a mass of water."""
    found = {}
    with (DATA / "solubility_perry2008.csv").open(encoding="utf-8") as file:
        for name, celsius, value in list(csv.reader(file))[1:]:
            found.setdefault(name, []).append((float(celsius), float(value) / 100.0))
    return {name: np.asarray(rows) for name, rows in found.items()}


apart = {
    name: max(abs(solubility(name, t) / value - 1.0) for t, value in rows if 0.0 < t < 100.0)
    for name, rows in table().items()
}
worst = max(apart.values())

# ---- sparing
calm = m.salt_saturation(1e-5, 1e-5, 0.0, "barium sulfate")
salty = m.salt_saturation(1e-5, 1e-5, 0.1, "barium sulfate")
barium_only = float(calm.solubility_product) ** 0.5
with_sulfate = float(calm.solubility_product) / 1e-3
fewer = barium_only / with_sulfate
screened = (float(calm.saturation_ratio) / float(salty.saturation_ratio)) ** 0.5


# ---- figures
def figure_viscosity():
    drawing = figure(axis_title("temperature", "degC"), axis_title("dynamic_viscosity", "mPa*s"), y_log=True)
    celsius = np.linspace(5.0, 90.0, 40)
    shown = (
        (lambda t: m.water_viscosity(t + 273.15), said("water", "eau")),
        (
            lambda t: m.solution_properties(t + 273.15, 0.25, system="sodium chloride").dynamic_viscosity,
            said("brine, 25%", "saumure, 25 %"),
        ),
        (
            lambda t: m.solution_properties(t + 273.15, 0.60, system="sucrose").dynamic_viscosity,
            said("sucrose, 60%", "saccharose, 60 %"),
        ),
    )
    for (law, words), color, dash in zip(shown, LINES, DASHES, strict=False):
        add_line(drawing, celsius, 1e3 * np.asarray(law(celsius)), words, color=color, dash=dash)
    return drawing


def figure_solubility():
    drawing = figure(axis_title("temperature", "degC"), axis_title("solubility_per_solvent"), y_log=True)
    french = {
        "potassium nitrate": "nitrate de potassium",
        "sodium chloride": "chlorure de sodium",
        "potassium sulfate": "sulfate de potassium",
        "copper sulfate": "sulfate de cuivre",
        "sucrose": "saccharose",
        "sodium sulfate": "sulfate de sodium",
    }
    known = {name: rows for name, rows in table().items() if name in french}
    for (name, rows), color in zip(known.items(), LINES, strict=False):
        fine = np.linspace(rows[0, 0], rows[-1, 0], 50)
        found = np.asarray(m.solute(name).solubility(fine + 273.15))
        add_line(drawing, fine, found, said(name, french[name]), color=color)
        add_points(drawing, rows[:, 0], rows[:, 1], said("Perry", "Perry"), color=color, showlegend=False)
    return drawing
