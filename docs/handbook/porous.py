"""What the chapter on porous media states, calculated."""

from math import pi
from pathlib import Path

import numpy as np
from validation import porous_bed

import granum as gr
from granum.app.chapters import said
from granum.app.shipped import examples_folder
from granum.core import registry
from granum.core.charts import DASHES, LINES, add_line, axis_title, figure

po = gr.porous
WATER = {"fluid_density": 998.2, "dynamic_viscosity": "1.002 mPa s"}

# ---- mercury
pore = {bar: po.pore_diameter_washburn(f"{bar} bar") for bar in (1, 1000)}
mercury = po.MercuryPorosimetry.read(
    Path(examples_folder()) / "lab-tests" / "mercury_porosimetry_made.csv", solid_density="2650 kg/m3"
).fit()
median, pores = mercury["pore_diameter"], mercury["void_fraction"].value

# ---- sand
SAND = {"particle_diameter": "0.5 mm", "void_fraction": 0.40}
gradient = po.pressure_gradient_ergun("1 mm/s", **SAND, **WATER)
numbers = po.packed_bed_numbers("1 mm/s", **SAND, **WATER)
permeability = po.permeability_kozeny_carman(void_fraction=0.40, specific_surface=6 / 0.5e-3)
conductivity = po.hydraulic_conductivity(permeability, **WATER)
# ---- sand_more
share = {v: float(po.packed_bed_numbers(f"{v} mm/s", **SAND, **WATER).inertial_share) for v in (1, 10, 100)}
by_void = {
    e: float(po.permeability_kozeny_carman(void_fraction=e, specific_surface=6 / 0.5e-3))
    for e in (0.35, 0.40, 0.45)
}
looser = by_void[0.45] / by_void[0.35]
one_point = (0.41**3 / 0.59**2) / (0.40**3 / 0.60**2) - 1
cold = 1.518 / 1.002 - 1

# ---- column
FLUX = 0.358 / (pi / 4 * 0.61**2)
INLET = 1.10 * 101325.0
AIR = {"temperature": 311.0, "molar_mass": "28.97 g/mol", "dynamic_viscosity": 1.90e-5}
LAWS = ("ergun", "macdonald", "tallmadge", "carman", "erdim", "kta")


def lost(law, void=0.38):
    """What air loses in the column of Geankoplis by a law."""
    return INLET - float(
        po.pressure_outlet_gas_bed(
            mass_flux=FLUX,
            pressure_inlet=INLET,
            length=2.44,
            particle_diameter="12.7 mm",
            void_fraction=void,
            pressure_gradient=registry.find(f"porous.pressure_gradient_{law}"),
            **AIR,
        )
    )


drop = {law: lost(law) for law in LAWS}
# ---- column_more
reynolds = FLUX * 12.7e-3 / 1.90e-5
loose, tight = lost("ergun", 0.40), lost("ergun", 0.36)
printed = 4970.0
least = 1 - min(drop.values()) / drop["ergun"]

# ---- wide
surface = float(po.specific_surface_mixture([1e-3, 0.1e-3], [0.9, 0.1]))
harmonic = 6 / surface
arithmetic = 0.9 * 1e-3 + 0.1 * 0.1e-3
too_permeable = (arithmetic / harmonic) ** 2
denser = (0.40**3 / 0.60**2) / (0.30**3 / 0.70**2)

# ---- wall
void = {ratio: float(po.void_fraction_dixon(1 / ratio)) for ratio in (5, 10, 50)}
channels = {
    ratio: (e**3 / (1 - e) ** 2) / (void[50] ** 3 / (1 - void[50]) ** 2) - 1 for ratio, e in void.items()
}
slipped = float(po.permeability_klinkenberg(1e-15, "1 bar", "3 bar")) / 1e-15

# ---- liquids that do not follow Newton
thinned, thinned_fast = (
    float(po.dynamic_viscosity_bed_christopher_middleman(U, "1 mm", 0.5, 1.0, 0.5))
    for U in ("1 mm/s", "10 mm/s")
)
start = float(po.pressure_gradient_yield_bed("1 mm", 0.5, 2.0))
yielding = float(po.superficial_velocity_bed_bingham(2 * start, "1 mm", 0.5, 0.02, 2.0)) / float(
    po.superficial_velocity_bed_bingham(2 * start, "1 mm", 0.5, 0.02, 0.0)
)

# ---- catalyst
HOT = {"temperature": "200 degC", "molar_mass": "28.97 g/mol", "dynamic_viscosity": "25.8 uPa s"}


def through(millimeter, diameter, depth):
    """What 1 kg/s of air at 5 bar loses in a column of catalyst."""
    return 5e5 - float(
        po.pressure_outlet_gas_bed(
            mass_flux=1.0 / (pi / 4 * diameter**2),
            pressure_inlet=5e5,
            length=depth,
            particle_diameter=f"{millimeter} mm",
            void_fraction=0.40,
            **HOT,
        )
    )


SHAPES = {"slim": (0.6, 2.0), "middle": (0.8, 2.0 * 0.5625), "flat": (1.0, 0.72)}  # of equal volume
columns = {(name, mm): through(mm, *shape) for name, shape in SHAPES.items() for mm in (2, 4)}
# ---- catalyst_more
flow = 1.0 / (5e5 * 0.02897 / (8.314462618 * 473.15))
blower = {key: x * flow / 0.6 for key, x in columns.items()}
slim_to_flat = columns["slim", 2] / columns["flat", 2]
smaller = columns["slim", 2] / columns["slim", 4]

# ---- drain
seep = float(conductivity) * 0.01 * 86400  # m/day at a head of one percent


def figure_regimes():
    drawing = figure(
        axis_title("superficial_velocity", "mm/s"),
        axis_title("pressure_gradient", "kPa/m"),
        x_log=True,
        y_log=True,
    )
    velocity = np.geomspace(0.1e-3, 1.0, 60)
    for law, name, color, dash in zip(
        ("ergun", "blake_kozeny", "burke_plummer"),
        ("Ergun", "Blake–Kozeny", "Burke–Plummer"),
        LINES,
        DASHES,
        strict=False,
    ):
        card = registry.find(f"porous.pressure_gradient_{law}")
        given = {k: v for k, v in (SAND | WATER).items() if k in {q.name for q in card.card.parameters}}
        found = np.asarray(card(superficial_velocity=velocity, **given))
        add_line(drawing, 1e3 * velocity, found / 1e3, name, color=color, dash=dash)
    return drawing


def figure_laws():
    drawing = figure(
        axis_title("reynolds_bed"),
        said("pressure gradient over Ergun’s", "gradient rapporté à celui d’Ergun"),
        x_log=True,
    )
    reynolds_ = np.geomspace(0.1, 1e5, 80)
    velocity = reynolds_ * 0.6 * 1e-3 / (998.2 * 0.01)
    names = {
        "macdonald": "Macdonald",
        "tallmadge": "Tallmadge",
        "carman": "Carman",
        "erdim": "Erdim",
        "kta": "KTA 3102.3",
        "brauer": "Brauer",
    }
    bed = {
        "particle_diameter": "10 mm",
        "void_fraction": 0.40,
        "fluid_density": 998.2,
        "dynamic_viscosity": 1e-3,
    }
    ergun = np.asarray(po.pressure_gradient_ergun(velocity, **bed))
    for (law, name), color, dash in zip(names.items(), LINES, (*DASHES, "solid"), strict=False):
        found = np.asarray(registry.find(f"porous.pressure_gradient_{law}")(velocity, **bed))
        add_line(drawing, reynolds_, found / ergun, name, color=color, dash=dash)
    return drawing


def figure_voids():
    drawing = figure(axis_title("void_fraction"), axis_title("permeability", "um^2"), y_log=True)
    share_ = np.linspace(0.25, 0.60, 60)
    for size, color, dash in zip((0.1, 0.2, 0.5), LINES, DASHES, strict=False):
        found = po.permeability_kozeny_carman(share_, 6 / (size * 1e-3))
        add_line(
            drawing,
            share_,
            1e12 * np.asarray(found),
            f"{size:g} mm".replace(".", said(".", ",")),
            color=color,
            dash=dash,
        )
    return drawing


def figure_test():
    return porous_bed().figure
