"""What the chapter on crystallization states, calculated."""

from math import pi
from pathlib import Path

import jax.numpy as jnp
import numpy as np
from validation import crystallization_msmpr, materials_solubility

import granum as gr
from granum.app.chapters import said
from granum.app.shipped import examples_folder
from granum.cases.alone import alone
from granum.core.charts import DASHES, LINES, add_line, axis_title, figure
from granum.crystallization.equipment.boiling import Boiling
from granum.crystallization.formulas.solubility_laws import LibrarySolubility
from granum.materials import saturated_heats, solute
from granum.materials.library import session
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

c, m, tank = gr.crystallization, gr.materials, gr.streams

# ---- solubility
SALTS = ("potassium nitrate", "potassium chloride", "sodium sulfate", "sodium chloride")
at = {s: [m.solubility(f"{t} degC", s) for t in (20, 60)] for s in SALTS}
cooled = {
    s: c.crystallizer_balance_library(
        "1 kg/s", float(at[s][1].solute_mass_fraction), "20 degC", "60 degC", system=s
    )
    for s in SALTS
}
two_solubilities = 1 - float(at["sodium sulfate"][0].solubility_per_solvent) / float(
    at["sodium sulfate"][1].solubility_per_solvent
)
# ---- heat
heat = {s: -float(x.heat_duty) / float(x.crystal_flow) for s, x in cooled.items()}
water_per_salt = 1 / float(at["sodium chloride"][1].solubility_per_solvent)
heat_boiling = water_per_salt * float(m.water_heat_of_vaporization("60 degC"))

# ---- exchange
first_crystal = c.reciprocal_saturation("25 degC", 0.5, 0.5)
beside = c.solubility_beside_salt("25 degC", "200 g/kg")
bittern = c.brine_saturation("25 degC", "20 g/kg", "470 g/kg")
thinned = c.heat_of_dilution("25 degC", "359 g/kg", "0 g/kg")
bitter = c.heat_of_dilution("25 degC", "500 g/kg", "5 g/kg", first_salt="magnesium chloride")
thinned_bitter = -float(bitter.heat_of_dilution)
halite = c.heat_of_solution("25 degC", "359 g/kg")
bischofite = c.heat_of_solution("25 degC", "500 g/kg", first_salt="magnesium chloride")
nitrate = solute("potassium nitrate")
nitrate_strong, nitrate_dilute = nitrate.heat_of_crystallization("25 degC"), nitrate.branches[0].heat_dilute
magnesium = solute("magnesium chloride")
from_slope, _strong = saturated_heats.enthalpy_of_dissolution(magnesium, magnesium.branches[0], 298.15)
bischofite_slope = float(from_slope) / magnesium.molar_mass
dried_up = c.invariant_point("25 degC", "potassium chloride", "magnesium chloride")
glaserite = c.reciprocal_saturation("25 degC", 0.5, 0.5, "sodium sulfate", "potassium chloride")
parted = {w: c.extractive_crystallization(0.5, 0.7, w, 0.4, 0.01, 0.2, 0.5) for w in (0.5, 0.7)}
waxed_urea = c.agent_ratio_urea(16)
waxed = c.adductive_crystallization(0.2, "25 degC", "100 degC", "60 kJ/mol", waxed_urea)

# ---- barrier
KNO3 = {"crystal_density": "2110 kg/m^3", "molar_mass": "101.1 g/mol"}
needed = {
    g: c.supersaturation_ratio_nucleation(
        "1e6 1/(m^3*s)", f"{g} mN/m", **KNO3, nucleation_preexponential=1e33
    )
    for g in (5, 20, 60)
}
less = c.nucleation_rate_classical(
    0.95 * float(needed[20]), "20 mN/m", **KNO3, nucleation_preexponential=1e33
)
nucleus = c.critical_nucleus(float(needed[20]), "20 mN/m", **KNO3)
fall = 1e6 / float(less)

# ---- urea
test = c.MsmprAnalysis.read(
    Path(examples_folder()) / "msmpr-analysis" / "urea_bennett1969.csv",
    residence_time="3.38 hour",
    crystal_density=1335,
)
fit = test.fit()
growth, births = fit["growth_rate"], fit["nucleation_rate"]
# ---- larger
longer = {i: float(c.dominant_size_changed(1.0, 2.0, 1.0, i)) for i in (1, 2, 3)}
length = float(growth.value) * 3.38 * 3600
median = c.mass_median_size(growth.value, "3.38 hour")
small = c.undersize_mass_fraction(0.5 * float(median), growth.value, "3.38 hour")
volume_for_half = 1.5**5  # the inverse of τ to the power 1/5
spared = 0.1  # of the nuclei, when fines are dissolved
with_fines_dissolved = spared ** (-1 / (2 + 3))

CLASSIFIED = "crystallization.classified_crystallizer"
LEG = {"elutriation_flow": "3 m3/h", "leg_diameter": "20 cm"}
baffled = {
    area: alone(CLASSIFIED, settling_area=f"{area} m2", **LEG).solve().units["classified_crystallizer"].values
    for area in (0.5, 1.5)
}
MIXED = "crystallization.msmpr"
SHEAR = {"law": "turbulent_kernel", "shear_rate": "200 1/s"}
CHIPS = {"law": "attrition", "breakage_frequency": "1e-5 1/s", "reference_size": "500 um"}
joined = {
    share: alone(MIXED, agglomeration_kernel=SHEAR | {"capture_efficiency": share})
    .solve()
    .units["msmpr"]
    .values
    for share in (0.0, 2e-6, 4e-6)
}
chipped = alone(MIXED, breakage_law=CHIPS).solve().units["msmpr"].values
volume_instead = float(c.dominant_size_changed(1.0, 10.0, 1.0, 2))
density_line = fit["magma_density"]

# ---- batch
BATCH = {
    "solute_per_solvent": 0.4929904,
    "solubility": {"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]},
    "growth": {"law": "power_law_growth", "growth_coefficient": "6967 um/min", "growth_order": 1.32},
    "nucleation": {
        "law": "secondary_nucleation",
        "nucleation_coefficient": 2.78e-5 * 1e18 / 60 / 2110,
        "nucleation_order": 1.78,
    },
    "duration": "80 min",
    "crystal_density": 2110,
    "seed_size": "100 um",
    "seed_width": "20 um",
}
HOW = {"natural": 0.4, "linear": 1.0, "cubic": 3.0}
seeded = {
    (how, seed): c.batch(
        **BATCH,
        temperature_program=c.PowerCooling("32 degC", "28 degC", "80 min", power),
        seed_mass_per_solvent=f"{seed} g/kg",
    )
    for how, power in HOW.items()
    for seed in (0.25, 0.5, 1, 2, 4, 8)
}
# ---- seeds
grown = {seed: seeded["linear", seed] for seed in (0.5, 2, 8)}
expected = {
    seed: 100e-6
    * (1 + 1000 * float(x.crystals_per_solvent[-1] - x.crystals_per_solvent[0]) / seed) ** (1 / 3)
    for seed, x in grown.items()
}
peak = {how: float(np.max(seeded[how, 0.5].relative_supersaturation)) for how in HOW}
crop = float(grown[2].crystals_per_solvent[-1] - grown[2].crystals_per_solvent[0])
loading = float(c.seed_loading_critical("100 um"))
seed_kubota = loading * crop

# ---- feedback
SPARE = {**BATCH, "seed_mass_per_solvent": "0.5 g/kg"}
ENDS = {"temperature_start": "32 degC", "temperature_end": "28 degC", "cooling_rate_maximum": "20 K/h"}
kept = {
    (held, error): c.controlled_batch(
        **SPARE, **ENDS, supersaturation_kept=f"{held} %", concentration_deviation=f"{error} %"
    )
    for held, error in ((0.5, 0), (0.4, 0), (0.4, 0.2))
}
cooled_after = {
    held: float(run.time[np.argmax(run.temperature < 301.15 + 0.04)]) for (held, _e), run in kept.items()
}
left = float(kept[0.4, 0].temperature[-1]) - 301.15
cycled = c.batch(
    **SPARE,
    temperature_program=c.CycledCooling("32 degC", "28 degC", "80 min", 3, 1, 0.25),
    dissolution={"law": "power_law_dissolution", "dissolution_coefficient": "1 mm/s"},
)

UNSEEDED = {k: v for k, v in BATCH.items() if not k.startswith(("seed", "nucleation", "duration"))}
PRIMARY = {
    much: {
        "law": "secondary_nucleation",
        "nucleation_coefficient": k,
        "nucleation_order": 6,
        "magma_order": 0,
    }
    for much, k in (("as found", 1e15), ("tenfold", 1e16))
}
straight = {
    much: c.batch(
        **UNSEEDED,
        nucleation=law,
        duration="5 hour",
        temperature_program=c.PowerCooling("34 degC", "28 degC", "5 hour", 1.0),
    )
    for much, law in PRIMARY.items()
}
counted = {
    much: c.nucleation_controlled_batch(
        **UNSEEDED,
        nucleation=law,
        dissolution={"law": "power_law_dissolution", "dissolution_coefficient": "1 mm/s"},
        crystal_number_lower="30 1/cm^3",
        crystal_number_upper="100 1/cm^3",
        temperature_start="34 degC",
        temperature_end="28 degC",
        duration="5 hour",
        cooling_rate="2 K/h",
        heating_rate="4 K/h",
        steps=1000,
    )
    for much, law in PRIMARY.items()
}

# ---- dosing
dosed = {
    power: alone(
        "crystallization.antisolvent_batch_crystallizer",
        addition_exponent=power,
        seed_mass_per_solvent="20 g/kg",
    )
    .solve()
    .units["antisolvent_batch_crystallizer"]
    .values
    for power in (0.5, 1, 2, 3)
}

# ---- tube
tube = alone("crystallization.baffled_tube_crystallizer").solve().units["baffled_tube_crystallizer"].values
turbulent = 4000
long = 45 * turbulent / float(tube.reynolds)  # m, for the same stay
hasty = c.oscillatory_loss("3 1/s", "10 mm", 45 / float(tube.residence_time), 1200, "45 m", "26 mm")

SLUGS = "crystallization.slug_flow_crystallizer"
slug, gassed = (
    alone(SLUGS, gas_volume_flow=gas).solve().units["slug_flow_crystallizer"].values
    for gas in ("8 mL/min", "24 mL/min")
)

# ---- needles
NEEDLES = (
    "{{law='power_cooling', temperature_start='50 degC', temperature_end='30 degC', duration='{0}', "
    "cooling_exponent=1.5}}"
)
needles = {
    time: alone(
        "crystallization.needle_batch_crystallizer", duration=time, temperature_program=NEEDLES.format(time)
    )
    .solve()
    .units["needle_batch_crystallizer"]
    .values
    for time in ("6 hour", "30 min")
}
stout, slender = needles["6 hour"], needles["30 min"]
steady = alone("crystallization.needle_crystallizer").solve().units["needle_crystallizer"].values

# ---- wall
rate = 1000 / 3600
duty = heat["potassium nitrate"] * rate
least = float(c.temperature_difference_encrustation("5 delta_degC", "500 W/(m^2*K)", "1000 W/(m^2*K)"))
jacket = duty / (500 * least)
across = (4 * 10 / pi) ** (1 / 3)  # of a vessel of 10 m³ as high as wide
offered = 1.25 * pi * across**2

# ---- vacuum
slope = {
    s: float(
        np.log(
            m.solubility("80 degC", s).solubility_per_solvent
            / m.solubility("20 degC", s).solubility_per_solvent
        )
        / 60
    )
    for s in ("potassium nitrate", "copper sulfate", "sodium chloride")
}
water = session().fluid("water")
brine_boils = float(
    Boiling(
        water,
        LibrarySolubility("sodium chloride"),
        session().solute("sodium chloride").activity_law,
        None,
    ).temperature(1e4, c.VacuumCrystallizer.card)
)
water_boils = float(water.boiling_temperature(1e4))
elevation = brine_boils - water_boils
lift = float(water.vapor_pressure.value(308.15) / water.vapor_pressure.value(293.15))

# ---- purity
pure = {
    wash: c.purity_of_crystals(
        "1 %", float(at["potassium nitrate"][0].solute_mass_fraction), 0.01, "0.5 %", 0.1, wash, 2110, 1190
    )
    for wash in (0, 0.8, 0.98)
}
per_salt = float(at["potassium nitrate"][0].solubility_per_solvent)
over = 1190 * (1.01 * per_salt / (1 + 1.01 * per_salt) - per_salt / (1 + per_salt))
clear = c.growth_rate_clear_carlson("0.5 mm", "5 cm/s", over, 2110, 1.5e-9, "0.8 mm^2/s")
hindered = c.growth_ratio_kubota_mullin("1 %", "2 mmol/L", 1 / 3, "2 %")

# ---- melt
layers = alone("crystallization.layer_melt_crystallizer").solve().units["layer_melt_crystallizer"].values
washed = {
    w: alone("crystallization.suspension_melt_crystallizer", wash_ratio=w)
    .solve()
    .units["suspension_melt_crystallizer"]
    .values
    for w in (0.0, 0.5, 0.7, 0.8, 1.05)
}
frozen_layers = float(layers.layer_flow / layers.product_mass_flow)

# ---- two forms
alpha_fed = 4.0 / 97.7
forms = {
    hours: alone("crystallization.polymorph_crystallizer", duration=f"{hours} hour")
    .solve()
    .units["polymorph_crystallizer"]
    .values
    for hours in (1, 3, 5, 10)
}

# ---- mirror images
mandelic = c.eutectic_racemate("24.5 kJ/mol", 404.75, "25.6 kJ/mol", 391.95)
mandelic_stability = c.gibbs_energy_racemate("24.5 kJ/mol", 404.75, "25.6 kJ/mol", 391.95, temperature=391.95)
THREONINE = LibrarySolubility("L-threonine")
racemic_liquor = float(THREONINE(313.15))
mirrored = {
    (seed, share): c.preferential_crystallization(
        racemic_liquor,
        racemic_liquor,
        THREONINE,
        {"law": "power_law_growth", "growth_coefficient": "0.3 um/s", "growth_order": 1.0},
        {
            "law": "power_cooling",
            "temperature_start": "33 degC",
            "temperature_end": "33 degC",
            "duration": "1 hour",
        },
        "6 hour",
        1461,
        nucleation={
            "law": "secondary_nucleation",
            "nucleation_coefficient": "1e7 1/(m^3*s)",
            "nucleation_order": 2.0,
        },
        counter_nucleation=share,
        seed_mass_per_solvent=f"{seed} g/kg",
        seed_size="250 um",
    )
    for seed, share in ((1, 0.01), (3, 0.01), (10, 0.01), (3, 0.1))
}
in_turn = c.crop_alternating_seeds(float(THREONINE(306.15)), racemic_liquor / float(THREONINE(306.15)), 1.02)

# ---- vapor
NAPHTHALENE, NITROGEN = session().solid("naphthalene"), session().fluid("nitrogen")
naphthalene_at = {t: float(NAPHTHALENE.sublimation_pressure(f"{t} degC")) for t in (20, 40, 75)}
heat_naphthalene = float(NAPHTHALENE.heat_of_sublimation("25 degC"))
carried = {
    t: c.entrainer_balance(
        naphthalene_at[75], naphthalene_at[t], "1 atm", "1 atm", NAPHTHALENE.molar_mass, NITROGEN.molar_mass
    )
    for t in (20, 40)
}

# ---- stirrer
impeller_wide = across / 3
stirred_speed = tank.rotation_speed_zwietering(
    impeller_wide, "400 um", "2110 kg/m^3", "1180 kg/m^3", "0.9 mPa s", 4.0
)
stirring = tank.stirring(stirred_speed, impeller_wide, "10 m^3", "1290 kg/m^3", "0.9 mPa s")
film = tank.heat_transfer_coefficient_stirred(
    stirred_speed, impeller_wide, across, "1290 kg/m^3", "0.9 mPa s", "3100 J/(kg*K)", "0.58 W/(m*K)"
)
scaled = tank.scale_up_stirrer("500 rpm", "0.035 m", "0.35 m")

# ---- choice
HOT_COLD = ("60 degC", "20 degC", "1 t/h")
nitrate = c.choose({"law": "library_solubility", "solute": "potassium nitrate"}, *HOT_COLD)
salt = c.choose({"law": "library_solubility", "solute": "sodium chloride"}, *HOT_COLD)

# ---- precipitation
exchanged = mixture_of(
    ["water", "barium chloride", "sodium sulfate", "sodium chloride"],
    ["barium sulfate"],
    [],
    np.geomspace(1e-7, 2e-4, 41),
)
barium, sulfate = (
    empty(exchanged, 298.15).replace(liquid=2000 / 3600 * jnp.array(shares))
    for shares in ([0.98, 0.02, 0.0, 0.0], [0.986, 0.0, 0.014, 0.0])
)
slower = 120
precipitated, slow = (
    c.Precipitator(
        temperature="25 degC",
        volume="2 m^3",
        rotation_speed=f"{speed} rpm",
        growth={"law": "power_law_growth", "growth_coefficient": 4e-14, "growth_order": 2},
        nucleation={
            "law": "secondary_nucleation",
            "nucleation_coefficient": 1e7,
            "nucleation_order": 1.8,
            "magma_order": 0,
        },
    )
    .operate(feed=barium, reagent=sulfate)
    .figures
    for speed in (200, slower)
)


FRENCH = {
    "potassium nitrate": "nitrate de potassium",
    "sodium sulfate": "sulfate de sodium",
    "copper sulfate": "sulfate de cuivre",
    "sodium chloride": "chlorure de sodium",
}


def figure_solubility():
    drawing = materials_solubility().figure
    drawing.update_yaxes(title=said("solubility / g per 100 g of water", "solubilité / g pour 100 g d’eau"))
    for trace in drawing.data:
        trace.name = said(trace.name, FRENCH.get(trace.name, trace.name))
    return drawing


def figure_nucleation():
    drawing = figure(
        axis_title("supersaturation_ratio"),
        axis_title("nucleation_rate", "1/(m^3*s)"),
        x_log=True,
        y_log=True,
    )
    ratio = np.geomspace(1.02, 100, 300)
    for tension, color, dash in zip(needed, LINES, DASHES, strict=False):
        rates = c.nucleation_rate_classical(ratio, f"{tension} mN/m", **KNO3, nucleation_preexponential=1e33)
        seen = np.asarray(rates) > 1e-2
        add_line(drawing, ratio[seen], np.asarray(rates)[seen], f"{tension} mJ/m²", color=color, dash=dash)
    drawing.update_yaxes(range=[-2, 34], dtick=6)
    return drawing


def figure_urea():
    return crystallization_msmpr().figure


def figure_cooling():
    drawing = figure(axis_title("time", "min"), axis_title("relative_supersaturation", "%"))
    words = (
        said("fast first (t to the power 0.4)", "rapide d’abord (t puissance 0,4)"),
        said("linear", "linéaire"),
        said("slow first (cubic)", "lent d’abord (cubique)"),
    )
    for how, name, color, dash in zip(HOW, words, LINES, DASHES, strict=False):
        run = seeded[how, 0.5]
        add_line(
            drawing,
            np.asarray(run.time) / 60,
            100 * np.asarray(run.relative_supersaturation),
            name,
            color=color,
            dash=dash,
        )
    run = kept[0.5, 0]
    add_line(
        drawing,
        np.asarray(run.time) / 60,
        100 * np.asarray(run.relative_supersaturation),
        said("kept at 0.5 %", "maintenue à 0,5 %"),
        color=LINES[len(HOW)],
        dash=DASHES[len(HOW)],
    )
    return drawing


def figure_seeds():
    drawing = figure(
        said("seeds / g per kg of water", "semence / g par kg d’eau"),
        said("mass from nuclei / %", "masse issue des germes / %"),
        x_log=True,
        y_log=True,
    )
    words = (
        said("fast first", "rapide d’abord"),
        said("linear", "linéaire"),
        said("slow first", "lent d’abord"),
    )
    for how, name, color, dash in zip(HOW, words, LINES, DASHES, strict=False):
        seeds = [seed for way, seed in seeded if way == how]
        share = [100 * float(seeded[how, seed].nuclei_mass_fraction) for seed in seeds]
        add_line(drawing, seeds, share, name, color=color, dash=dash)
    return drawing
