"""What the chapter on evaporation states, calculated."""

from functools import cache

import numpy as np

import granum as gr
from granum.app.chapters import said
from granum.core.charts import DASHES, LINES, add_line, add_points, axis_title, figure
from granum.streams.feeding import feed
from granum.streams.from_materials import mixture_of

m = gr.materials
ATMOSPHERE, VACUUM = 101325.0, 1e4
ZERO, GRAVITY = 273.15, 9.80665


# ---- boiling
def pure(pressure):
    """Temperature at which water boils, K."""
    return float(m.water_boiling_temperature(pressure))


def elevation(solute, share, pressure=ATMOSPHERE):
    """By how much hotter a solution boils than water."""
    share = np.asarray(share)
    return np.asarray(m.solute(solute).boiling_point_elevation(pressure, share / (1 - share)))


def elevations(solute, *shares):
    """Elevations at 1 atm by mass fraction."""
    return dict(zip(shares, elevation(solute, shares).tolist(), strict=True))


SALT = elevations("sodium chloride", 0.035, 0.10, 0.20, 0.282)
SUGAR = elevations("sucrose", 0.10, 0.30, 0.50, 0.70, 0.80)
salt_in_vacuum, sugar_in_vacuum = (
    float(elevation(name, share, VACUUM)) for name, share in (("sodium chloride", 0.282), ("sucrose", 0.70))
)
together = gr.crystallization.invariant_point("76 degC", "sodium chloride", "sodium sulfate")
saltpeter = float(elevation("potassium nitrate", 0.77))
molality = {name: 0.1 / 0.9 / m.solute(name).molar_mass for name in ("sodium chloride", "sucrose")}


def sea_water(percent, celsius=100.0):
    """Elevation that Hakuta, Goto and Ishizaka (1974) fitted to their measurements on sea water."""
    x, t = percent, celsius
    linear = 0.0528764 + 0.82603e-3 * t - 0.315082e-7 * t**2
    return linear * x + (0.320553e-2 - 0.144367e-4 * t + 0.184416e-6 * t**2) * x**2


sea = sea_water(3.5)


# ---- column
def deeper(pressure, depth, density=1000.0):
    """By how much hotter water boils at a depth."""
    return pure(pressure + density * GRAVITY * depth) - pure(pressure)


column = {p: deeper(p, 1.0) for p in (ATMOSPHERE, VACUUM)}  # half of a column of 2 m
# ---- single
JUICE = mixture_of(["water", "sucrose"], [], ["water"], np.geomspace(1e-5, 4e-3, 3))
BRINE = mixture_of(["water", "sodium chloride"], ["sodium chloride"], ["water"], np.geomspace(1e-5, 4e-3, 31))


def juice(share=0.10, celsius=60.0, flow="19 t/h"):
    parts = {"water": 1 - share, "sucrose": share}
    return feed(JUICE, temperature=f"{celsius} degC", liquid_flow=flow, liquid=parts)


def brine(celsius=60.0, flow="40 t/h"):
    parts = {"water": 0.75, "sodium chloride": 0.25}
    return feed(BRINE, temperature=f"{celsius} degC", liquid_flow=flow, liquid=parts)


COUNTS = (1, 3, 6)
FLOWS = {"sugar": dict.fromkeys(COUNTS, 19.0), "salt": {1: 23.0, 3: 17.0, 6: 10.0}}
"""Feeds, t/h, in proportion to what boils off, so that the products are alike."""
FEEDS = {
    "sugar": lambda n: juice(flow=f"{FLOWS['sugar'][n]} t/h"),
    "salt": lambda n: brine(flow=f"{FLOWS['salt'][n]} t/h"),
}
U = {"heat_transfer_coefficient_first": 1800.0, "heat_transfer_coefficient_last": 1800.0}


@cache
def effects(what, count):
    """Effects of 60 m² each, from steam of 3 bar down to 0.1 bar, fed in parallel."""
    if count == 1:
        unit = gr.evaporation.Evaporator("60 m^2", "0.1 bar", "3 bar", heat_transfer_coefficient=1800.0)
    else:
        unit = gr.evaporation.MultipleEffectEvaporator(
            "60 m^2", "0.1 bar", "3 bar", feeding="parallel", effect_count=str(count), **U
        )
    return unit.operate(feed=FEEDS[what](count))


span = pure(3e5) - pure(VACUUM)
boiled = {(w, n): float(effects(w, n).figures.evaporation_rate) for w in FEEDS for n in COUNTS}
bought = {(w, n): float(effects(w, n).figures.steam_flow) for w in FEEDS for n in COUNTS}
strong = {
    (w, n): float(effects(w, n).outlets.product.liquid[1] / effects(w, n).outlets.product.liquid_flow)
    for w in FEEDS
    for n in COUNTS
}
economy = {(w, n): float(effects(w, n).figures.steam_economy) for w in FEEDS for n in COUNTS}
lost = {
    (w, n): float(effects(w, n).figures.boiling_point_elevation) / span
    if n == 1
    else float(effects(w, n).figures.temperature_difference_lost)
    for w in FEEDS
    for n in COUNTS
}


# ---- feeding
@cache
def train(feeding, celsius):
    """Three effects of 60 m² on sugar solution that enters at a temperature."""
    unit = gr.evaporation.MultipleEffectEvaporator(
        "60 m^2",
        "0.1 bar",
        "3 bar",
        feeding=feeding,
        effect_count="3",
        heat_transfer_coefficient_first=2500.0,
        heat_transfer_coefficient_last=1200.0,
    )
    return unit.operate(feed=juice(0.15, celsius, "25 t/h")).figures


ways = {(f, t): train(f, t) for f in ("forward", "backward") for t in (20.0, 90.0)}


# ---- compressor
@cache
def compressed(what, warmer):
    """An evaporator at 1 atm whose vapor is compressed until it condenses so much warmer than water boils."""
    pressure = float(m.water_vapor_pressure(pure(ATMOSPHERE) + warmer))
    unit = gr.evaporation.RecompressionEvaporator(
        "600 m^2", "1 atm", f"{pressure} Pa", heat_transfer_coefficient=1800.0
    )
    entering = juice(0.30, 100.0, "80 t/h") if what == "sugar" else brine(100.0)
    return unit.operate(feed=entering)


def per_water(what, warmer):
    made = compressed(what, warmer)
    return float(made.outlets.shaft_power) / float(made.figures.evaporation_rate)


def wall(what, warmer):
    """Square meters of wall for a tonne of water an hour."""
    return 600.0 / (3.6 * float(compressed(what, warmer).figures.evaporation_rate))


LIFTS = {"sugar": (6.0, 12.0), "salt": (12.0,)}
work = {(w, t): per_water(w, t) for w in LIFTS for t in LIFTS[w]}
area = {(w, t): wall(w, t) for w in LIFTS for t in LIFTS[w]}
latent = float(m.water_heat_of_vaporization(pure(ATMOSPHERE)))
by_hand = latent * 12.0 / pure(ATMOSPHERE) / 0.75

# ---- jet
TWO = {
    "effect_count": "2",
    "heat_transfer_coefficient_first": 3000.0,
    "heat_transfer_coefficient_last": 700.0,
    "elevation_linear": 0.0,
}
LEAN = juice(0.08, 75.0, "15 t/h")
jet_ratio = float(
    gr.evaporation.motive_steam_ratio_el_dessouky("687 kPa", "64.3 kPa", "108.4 kPa", "87.7 degC")
)
jet_with = (
    gr.evaporation.SteamJetEvaporator("60 m2", "13.5 kPa", "108.4 kPa", pressure_motive="687 kPa", **TWO)
    .operate(feed=LEAN)
    .figures
)
jet_without = (
    gr.evaporation.MultipleEffectEvaporator("60 m2", "13.5 kPa", "108.4 kPa", **TWO)
    .operate(feed=LEAN)
    .figures
)
# ---- scale
CLEAN, GROWTH, STOP = 1800.0, 1e-4 / 86400.0, 6 * 3600.0
"""Clean coefficient, growth of the layer's resistance each second, time that a boil-out takes."""


def fallen(time):
    """The coefficient over the clean one."""
    return 1.0 / (1.0 + CLEAN * GROWTH * time)


def mean(time):
    """The mean of the coefficient over run and boil-out, over the clean one."""
    return np.log1p(CLEAN * GROWTH * time) / (CLEAN * GROWTH) / (time + STOP)


TIMES = np.linspace(3600.0, 20 * 86400.0, 20000)
best_time = float(TIMES[np.argmax(mean(TIMES))])
best_mean, best_fallen = float(mean(best_time)), float(fallen(best_time))
weekly = float(mean(7 * 86400.0))
dirty = {r: 1.0 / (1.0 + CLEAN * r) for r in (1e-4, 3e-4)}

# ---- drops
condensate = {share: 1e-4 * share for share in (0.10, 0.50)}
"""Solute in the condensate, by mass, where 0.1 g of drops go with a kilogram of vapor."""

# ---- dryer
BY_DRYER, BY_EFFECTS = 4.5e6, 0.93e6
"""J per kilogram of water: a spray dryer, three effects."""


def whole(start, between):
    """Water boiled off and dried for a kilogram of dry matter, and the energy of both."""
    boiled_off = (1 - start) / start - (1 - between) / between
    dried = (1 - between) / between
    return boiled_off, dried, boiled_off * BY_EFFECTS + dried * BY_DRYER


paths = {w: whole(0.10, w) for w in (0.10, 0.20, 0.30, 0.40, 0.50)}
next_step = paths[0.40][2] - paths[0.50][2]


# ---- figures
def figure_elevation():
    drawing = figure(
        said("solute in the solution / %", "soluté dans la solution / %"),
        axis_title("boiling_point_elevation"),
    )
    for (name, words, most), color, dash in zip(
        (
            ("sodium chloride", said("sodium chloride", "chlorure de sodium"), 0.282),
            ("potassium chloride", said("potassium chloride", "chlorure de potassium"), 0.36),
            ("sucrose", said("sucrose", "saccharose"), 0.80),
        ),
        LINES,
        DASHES,
        strict=False,
    ):
        shares = np.linspace(0.005, most, 40)
        add_line(drawing, 100 * shares, elevation(name, shares), words, color=color, dash=dash)
    add_points(drawing, [28.2], [8.5], said("Buchanan, brine over salt", "Buchanan, saumure sur sel"))
    percent = np.arange(2.0, 11.0, 2.0)
    add_points(
        drawing,
        percent,
        sea_water(percent),
        said("sea water (Hakuta and others)", "eau de mer (Hakuta et al.)"),
        color=LINES[3],
    )
    return drawing


def steps(what, count):
    """Temperatures on both sides of the wall and of the vapor behind it, effect by effect."""
    made = effects(what, count).inside
    found = [float(made.chest)]
    for effect in made.effects:
        found += [float(effect.temperature), float(effect.pure)]
    return np.asarray(found) - ZERO


def figure_stairs():
    drawing = figure(
        said("way of the heat through the effects", "chemin de la chaleur à travers les effets"),
        axis_title("temperature", "degC"),
    )
    names = {"sugar": said("sugar solution", "solution de sucre"), "salt": said("brine", "saumure")}
    for what, color, dash in zip(names, LINES, DASHES, strict=False):
        levels = steps(what, 3)
        place = np.arange(len(levels)) / 2.0  # through a wall, then from solution to vapor
        add_line(drawing, place, levels, names[what], color=color, dash=dash)
    return drawing


def figure_economy():
    drawing = figure(
        said("number of effects", "nombre d'effets"),
        said("of the single effect", "rapporté à l'effet unique"),
    )
    for (what, words), color in zip(
        (("sugar", said("sugar", "sucre")), ("salt", said("salt", "sel"))), LINES, strict=False
    ):
        for found, of, dash in (
            (boiled, said("water boiled off, {}", "eau évaporée, {}"), DASHES[0]),
            (bought, said("steam, {}", "vapeur, {}"), DASHES[1]),
        ):
            shown = [found[what, n] / found[what, 1] for n in COUNTS]
            add_line(drawing, COUNTS, shown, of.format(words), color=color, dash=dash)
    return drawing


def figure_scale():
    drawing = figure(
        said("time since the last boil-out / day", "temps depuis le dernier lavage / jour"),
        said("coefficient over the clean one", "coefficient rapporté au propre"),
    )
    time = np.linspace(0.05, 10, 100) * 86400.0
    names = (
        said("now", "à l'instant"),
        said("mean, boil-out counted", "moyenne, lavage compris"),
    )
    for law, words, color, dash in zip((fallen, mean), names, LINES, DASHES, strict=False):
        add_line(drawing, time / 86400.0, law(time), words, color=color, dash=dash)
    add_points(drawing, [best_time / 86400.0], [best_mean], said("best time", "meilleur temps"))
    return drawing
