"""What the chapter on uncertainty states, calculated."""

from functools import cache
from math import exp, log, sqrt
from pathlib import Path

import numpy as np
from scipy.special import ndtr, ndtri

import granum as gr
from granum import studies
from granum.app.chapters import said
from granum.app.shipped import examples_folder
from granum.cases import read_text
from granum.core.charts import DASHES, LINES, add_line, figure
from granum.studies.intervals import with_intervals
from granum.studies.outcome import wilson
from granum.studies.sampling import unit_points

c, f = gr.costs, gr.filtration
Z90 = float(ndtri(0.9))
YEAR = 365.25 * 86400.0

# ---- grain
BRINE = {"particle_density": 2630.0, "fluid_density": 1020.0, "dynamic_viscosity": "1.2 mPa*s"}
LEAST = 1.5 / 600.0
"""m/s: 1.5 m in ten minutes."""
GRAIN = studies.subject_of("particles.terminal_velocity", BRINE)


@cache
def straight(spread):
    """Terminal velocity of 85 µm with a relative standard deviation, propagated by the derivative."""
    _result, found = with_intervals(
        "particles.terminal_velocity", particle_diameter=f"85 +- {85 * spread} um", **BRINE
    )
    return found["terminal_velocity"]


def middle(spread):
    return 0.5 * (straight(spread).low + straight(spread).high)


def half(spread):
    return 0.5 * (straight(spread).high - straight(spread).low)


def straight_chance(spread):
    """Chance to be too slow for a normal distribution with the propagated half width."""
    return float(ndtr((LEAST - middle(spread)) / half(spread)))


@cache
def drawn(spread, law="lognormal"):
    """The same by ten thousand draws."""
    table = {"distribution": law, "mean": "85 um", "relative_standard_deviation": spread}
    return studies.monte_carlo(
        GRAIN,
        {"particle_diameter": table},
        samples=10_000,
        outputs=["terminal_velocity"],
        limits={"terminal_velocity": {"lower": LEAST}},
    )


def velocity(spread, key):
    return drawn(spread).findings()["statistics"]["terminal_velocity"][key]


def slow(spread):
    """Chance to be too slow."""
    return 1.0 - drawn(spread).findings()["limits"]["terminal_velocity"]["probability"]


impossible = drawn(0.4, "normal").counts()["failed"] / 1e4

# ---- leaf
leaf = f.LeafTest.read(
    Path(examples_folder()) / "leaf-filter" / "leaf_geankoplis.csv",
    area="0.0439 m2",
    pressure_drop="338 kPa",
    dynamic_viscosity="0.8937 cP",
    dry_cake_per_filtrate="23.47 g/L",
)
fit = leaf.fit()
alpha, medium = fit["cake_resistance"], fit["medium_resistance"]
errors = np.array([alpha.standard_error / alpha.value, medium.standard_error / medium.value])
tied = fit.covariance[0, 1] / (alpha.standard_error * medium.standard_error)


def shares(volume):
    """Filtering time of a volume of filtrate per area, that of the cake and that of the cloth."""
    setting = (1.0, "338 kPa", "0.8937 cP")
    cake = f.filtration_time_constant_pressure(volume, *setting, alpha.value, 23.47, 0.0)
    whole = f.filtration_time_constant_pressure(volume, *setting, alpha.value, 23.47, medium.value)
    return np.array([cake, whole - cake])


def apart(volume):
    """Relative standard error of the filtering time, resistances taken as independent."""
    return float(np.sqrt(np.sum((shares(volume) * errors) ** 2)) / shares(volume).sum())


def together(volume):
    """The same with their correlation."""
    parts = shares(volume) * errors
    square = np.sum(parts**2) + 2.0 * tied * parts.prod()
    return float(np.sqrt(square) / shares(volume).sum())


ratio_apart = float(np.sqrt(np.sum(errors**2)))
ratio_together = float(np.sqrt(np.sum(errors**2) - 2.0 * tied * errors.prod()))

# ---- evaporator
CASE = """
title = "Evaporator"
[mixture]
liquids = ["water", "sucrose"]
gases = ["water"]
sizes = {{ smallest = "10 um", largest = "4 mm", classes = 3 }}
[feeds.juice]
to = "evaporator.feed"
temperature = "60 degC"
liquid_flow = "12.5 t/h"
liquid = {{ water = "90 %", sucrose = "10 %" }}
[units.evaporator]
model = "evaporation.evaporator"
area = "60 m2"
pressure = "0.2 bar"
pressure_steam = "2 bar"
heat_transfer_coefficient = "1700 W/(m2*K)"
[streams]
syrup = ["evaporator.product"]
vapor = ["evaporator.vapor"]
[specifications.strong]
vary = "evaporator.area"
so_that = "evaporator.solute_mass_fraction"
equals = "50 %"
lower = "5 m2"
upper = "{} m2"
"""
COEFFICIENT, FLOW, STEAM = (
    "evaporator.heat_transfer_coefficient",
    "juice.liquid_flow",
    "evaporator.pressure_steam",
)
DOUBTS = {
    COEFFICIENT: {
        "distribution": "lognormal",
        "median": "1700 W/(m2*K)",
        "geometric_standard_deviation": 1.2,
    },
    FLOW: {"distribution": "normal", "mean": "12.5 t/h", "relative_standard_deviation": 0.05},
    STEAM: {"distribution": "normal", "mean": "2 bar", "standard_deviation": "0.1 bar"},
}
LIMITS = {"evaporator.area": {"upper": "75 m2"}, "evaporator.steam_flow": {"upper": "11 t/h"}}
SAMPLES = 400


@cache
def walled(most):
    """The line with a largest wall that may be sought."""
    return studies.subject_of(read_text(CASE.format(most)))


@cache
def line(most=500):
    return studies.monte_carlo(walled(most), DOUBTS, samples=SAMPLES, limits=LIMITS, outputs=list(LIMITS))


def wall(key, most=500):
    """A statistic of the wall that is needed."""
    return line(most).findings()["statistics"]["evaporator.area"][key]


def kept(limit="", most=500, key="probability"):
    return line(most).findings()["limits"][limit][key]


def ranked(name):
    return line().rank_correlations()["evaporator.area"][name]


@cache
def indices():
    return studies.sobol(walled(500), DOUBTS, samples=512, outputs=list(LIMITS)).indices()["evaporator.area"]


def share(name, key="total"):
    return indices()[name][key]


plain = read_text(CASE.format(500)).solve()
figures = plain.units["evaporator"].values
lift = figures.temperature_steam - figures.boiling_temperature
per_pressure = 8.314 * figures.temperature_steam**2 / (18.015e-3 * figures.heat_duty / figures.steam_flow)
"""K per relative change of the pressure, Clausius and Clapeyron."""
steepness = per_pressure / lift
BY_HAND = {COEFFICIENT: log(1.2), FLOW: 0.05, STEAM: 0.05 * steepness}
sigma = sqrt(sum(s**2 for s in BY_HAND.values()))
median = float(plain.sheet.value("evaporator.area"))
hand_p90 = median * exp(Z90 * sigma)


def by_hand(name):
    """Share of the variance."""
    return (BY_HAND[name] / sigma) ** 2


# ---- samples
def error_of_percentile(p, count):
    """Standard error of a percentile of a normal distribution, in standard deviations."""
    z = float(ndtri(p))
    return sqrt(p * (1.0 - p) / count) / (exp(-0.5 * z * z) / sqrt(2.0 * np.pi))


SEEDS = 300


@cache
def scatter(method, count, spreads, p=90):
    """Relative scatter of a percentile of exp(sum of normals) over many seeds."""
    found = [
        np.percentile(ndtri(unit_points(method, count, len(spreads), seed)) @ np.array(spreads), p)
        for seed in range(SEEDS)
    ]
    return float(np.std(found, ddof=1))


EVAPORATOR = tuple(BY_HAND.values())
FIVE = (sigma / sqrt(5.0),) * 5
least_runs = log(0.05) / log(0.95)
few = wilson(90, 100)


# ---- margin
def factor(p, spread):
    """Factor on the median that keeps a probability, for a geometric standard deviation."""
    return exp(float(ndtri(p)) * log(spread))


def enough(factor_, spread):
    """Probability that a factor is enough."""
    return float(ndtr(log(factor_) / log(spread)))


stacked = factor(0.9, 1.1) ** 4
joint = exp(Z90 * 2.0 * log(1.1))
stacked_chance = float(ndtr(log(stacked) / (2.0 * log(1.1))))

INDEX = c.cost_index_annual(year=2023.0)
CHARGE = c.annual_capital_charge(1.0, 0.10, 10.0 * YEAR) * YEAR
TONNES = 2.5 * 8000.0
NORMAL = ndtri((np.arange(2000) + 0.5) / 2000.0)


def charge(area):
    """Yearly charge of a falling film evaporator with all that belongs to it, USD."""
    bought = c.purchased_cost_evaporator(area, "falling_film_evaporator", INDEX)
    return CHARGE * c.capital_cost_lang(bought, "fluids")


def lost(size, margin, spread):
    """Yearly loss of product that a wall of `size` times the median is too small for, USD."""
    needed = np.exp(NORMAL * spread)
    return TONNES * margin * float(np.mean(np.maximum(0.0, 1.0 - size / needed)))


def yearly(size, margin=100.0, spread=sigma):
    return charge(size * median) + lost(size, margin, spread)


@cache
def best(margin=100.0, spread=sigma):
    """The factor of least expected cost."""
    tried = np.arange(0.80, 2.2001, 0.01)
    return float(tried[np.argmin([yearly(s, margin, spread) for s in tried])])


tested = sqrt(log(1.05) ** 2 + BY_HAND[FLOW] ** 2 + BY_HAND[STEAM] ** 2)
worth_of_test = yearly(best()) - yearly(best(100.0, tested), 100.0, tested)
per_area = (charge(median * 1.005) - charge(median * 0.995)) / (0.01 * median)
short_area = TONNES * 100.0 / median


def figure_margin():
    drawing = figure(
        said("wall bought over the median", "paroi achetée sur la médiane"),
        said("yearly cost, thousand USD", "coût annuel, milliers USD"),
    )
    drawing.update_yaxes(rangemode="tozero")
    sizes = np.linspace(0.8, 1.8, 51)
    curves = (
        (said("charge of the capital", "charge du capital"), lambda s: charge(s * median)),
        (said("product not made", "produit manquant"), lambda s: lost(s, 100.0, sigma)),
        (said("together", "ensemble"), yearly),
        (said("together, tested before", "ensemble, essai préalable"), lambda s: yearly(s, 100.0, tested)),
    )
    for place, (name, cost) in enumerate(curves):
        add_line(
            drawing,
            sizes,
            [cost(s) / 1e3 for s in sizes],
            name,
            color=LINES[place],
            dash=DASHES[place % len(DASHES)],
        )
    return drawing
