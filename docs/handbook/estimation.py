"""What the chapter on estimation states, calculated."""

from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np
from scipy import stats

import granum as gr
from granum.app.chapters import said
from granum.app.shipped import examples_folder
from granum.core.charts import DASHES, LINES, add_line, add_points, figure
from granum.estimation import Huber, fit, next_experiment

f = gr.filtration
TESTS = Path(examples_folder()) / "leaf-filter"
SHEET: dict[str, Any] = {
    "area": "0.0439 m2",
    "pressure_drop": "338 kPa",
    "dynamic_viscosity": "0.8937 cP",
    "dry_cake_per_filtrate": "23.47 g/L",
}

# ---- sheet
leaf = f.LeafTest.read(TESTS / "leaf_geankoplis.csv", **SHEET)
found = leaf.fit()
alpha, medium = found["cake_resistance"], found["medium_resistance"]
# ---- read
time, volume = np.asarray(leaf.time), np.asarray(leaf.filtrate_volume)
CAKE = leaf.dynamic_viscosity * leaf.dry_cake_per_filtrate / (2.0 * leaf.pressure_drop * leaf.area**2)
CLOTH = leaf.dynamic_viscosity / (leaf.pressure_drop * leaf.area)


# ---- direct
def clock(p, v):
    """Time to a volume."""
    return p["alpha"] * CAKE * v**2 + p["medium"] * CLOTH * v


def delayed(p, v):
    """The same, when filtrate comes a while after the watch was started."""
    return clock(p, v) + p["delay"]


start = {"alpha": 1e11, "medium": 1e11}
direct = fit(clock, start, volume, time)
late = fit(delayed, start | {"delay": 0.1}, volume, time)
as_plotted = fit(clock, start, volume, time, sigma=volume)
# ---- plotted
all_rows = f.LeafTest.read(TESTS / "leaf_geankoplis.csv", first_points_excluded=0, **SHEET).fit()


def half_width(estimate):
    """Half of the 95 % interval over the value."""
    return (estimate.interval_95[1] - estimate.value) / estimate.value


# ---- three ways from readings to resistances, many times
STEPS = np.arange(1.0, 11.0) * 0.5e-3
SLOPE, INTERCEPT = alpha.value * CAKE, medium.value * CLOTH
TIMES = SLOPE * STEPS**2 + INTERCEPT * STEPS
SEEDS, DRAWS = (1, 2, 3, 4, 5), 4000


class Tried(NamedTuple):
    """Mean relative error (root of the mean square) of cake and medium, and how often their 95 % intervals
    contain the truth.
    """

    cake: float
    medium: float
    cake_covered: float
    medium_covered: float


def line(x, y, weight):
    """Weighted lines through many sets of points: slope, intercept, their standard errors."""
    total = weight.sum(-1)
    x0, y0 = (weight * x).sum(-1) / total, (weight * y).sum(-1) / total
    dx = x - x0[..., None]
    width = (weight * dx**2).sum(-1)
    slope = (weight * dx * y).sum(-1) / width
    off = y - y0[..., None] - slope[..., None] * dx
    variance = (weight * off**2).sum(-1) / (y.shape[-1] - 2)
    return slope, y0 - slope * x0, np.sqrt(variance / width), np.sqrt(variance * (1 / total + x0**2 / width))


def by_plot(v, t):
    return line(v, t / v, np.ones_like(v))


def by_time(v, t):
    """Least squares of the times: t/V weighted by V²."""
    return line(v, t / v, v**2)


def by_steps(v, t):
    """dt/dV from one reading to the next against the volume between them: twice the slope."""
    zero = np.zeros((*v.shape[:-1], 1))
    v, t = np.concatenate([zero, v], -1), np.concatenate([zero, t], -1)
    a, b, da, db = line((v[..., 1:] + v[..., :-1]) / 2, np.diff(t) / np.diff(v), np.ones_like(v[..., 1:]))
    return a / 2, b, da / 2, db


def readings(error, seed):
    """Readings of many tests with a watch good to 0.5 s, or with a vessel good to 20 mL."""
    off = np.random.default_rng(seed).standard_normal((DRAWS, STEPS.size))
    v, t = np.broadcast_to(STEPS, off.shape), np.broadcast_to(TIMES, off.shape)
    return (v, t + 0.5 * off) if error == "watch" else (v + 0.02e-3 * off, t)


@cache
def tried(way, error, seed=None):
    """How a way does; over all seeds where none is named."""
    if seed is None:
        return Tried(*np.mean([tried(way, error, s) for s in SEEDS], axis=0))
    a, b, da, db = {"plot": by_plot, "time": by_time, "steps": by_steps}[way](*readings(error, seed))
    reach = stats.t.ppf(0.975, STEPS.size - 2)
    return Tried(
        float(np.sqrt(np.mean((a / SLOPE - 1) ** 2))),
        float(np.sqrt(np.mean((b / INTERCEPT - 1) ** 2))),
        float(np.mean(np.abs(a - SLOPE) < reach * da)),
        float(np.mean(np.abs(b - INTERCEPT) < reach * db)),
    )


# ---- a disturbance that lasts
def covered_in_a_row(count, memory, seed=None):
    """How often the interval of the slope holds the truth when each of many readings remembers the last."""
    if seed is None:
        return float(np.mean([covered_in_a_row(count, memory, s) for s in SEEDS]))
    rng = np.random.default_rng(seed)
    off = rng.standard_normal((1000, count))
    for k in range(1, count):
        off[:, k] = memory * off[:, k - 1] + np.sqrt(1 - memory**2) * off[:, k]
    x = np.broadcast_to(np.linspace(0.0, 1.0, count), off.shape)
    slope, _start, error, _other = line(x, off, np.ones_like(x))
    return float(np.mean(np.abs(slope) < stats.t.ppf(0.975, count - 2) * error))


# ---- together
correlation = float(found.correlation[0, 1])
late_half = np.linspace(2.5, 5.0, 6)
correlation_late = -late_half.mean() / np.sqrt(np.mean(late_half**2))
ten_liters = found.derive(
    lambda p: {"time": 1e-4 * CAKE * p["cake_resistance"] + 1e-2 * CLOTH * p["medium_resistance"]}
)["time"]
apart = float(np.hypot(alpha.standard_error * CAKE * 1e-4, medium.standard_error * CLOTH * 1e-2))
"""Its standard error if the two resistances were independent."""
ten_liters_late = float(delayed(late.values, 10e-3))
# ---- next
candidates = np.array([0.25, 2.5, 5.0, 10.0]) * 1e-3
more = next_experiment(late, candidates)
kept = dict(zip((0.25, 2.5, 5.0, 10.0), more.shrinkage.tolist(), strict=True))
# ---- product
product = fit(
    lambda p, v: p["alpha"] * p["dry_cake"] * v + p["intercept"],
    {"alpha": 1e11, "dry_cake": 20.0, "intercept": 6e3},
    volume[1:],
    (time / volume)[1:],
)
# ---- water
water = {t: float(gr.materials.water_viscosity(t)) for t in ("22 degC", "25 degC")}
colder = water["22 degC"] / water["25 degC"] - 1.0

# ---- five tests
rows = np.loadtxt(TESTS / "pressures_mccabe.csv", delimiter=",", skiprows=2)


@cache
def tests():
    """The five tests of Ruth one by one: pressure in psi and the fit."""
    return {
        p: f.LeafTest(
            time=rows[rows[:, 0] == p, 2],
            filtrate_volume=rows[rows[:, 0] == p, 1] * 1e-3,
            area="440 cm2",
            pressure_drop=f"{p} psi",
            dynamic_viscosity="0.8937 cP",
            dry_cake_per_filtrate="23.5 g/L",
        ).fit()
        for p in np.unique(rows[:, 0])
    }


clothes = np.array([x["medium_resistance"].value for x in tests().values()])
cloth_errors = np.array([x["medium_resistance"].standard_error for x in tests().values()])
between = float(clothes.std(ddof=1))
within = float(np.sqrt(np.mean(cloth_errors**2)))
mean_half = float(stats.t.ppf(0.975, 4) * between / np.sqrt(5) / clothes.mean())

# ---- a curve that was stopped early
RATES = np.geomspace(0.02, 8.0, 800)
"""Rates among which the best is sought."""
CLOCK = np.linspace(0.0, 1.0, 13)


class Dried(NamedTuple):
    """The interval of the end of drying: its usual half width, how often it and that of the profile hold the
    truth, and the part of the runs whose profile has no lower end.
    """

    half_width: float
    linear: float
    profile: float
    open: float


def projected(columns, y):
    """Least sum of squares of many y for each set of columns."""
    basis = np.linalg.qr(columns)[0]
    return (y**2).sum(-1)[None] - ((y @ basis) ** 2).sum(-1)


@cache
def stopped(length, seed=None):
    """Drying to a plateau of 0.2 followed for so many times 1/k, 13 readings with a scatter of 0.01."""
    if seed is None:
        return Dried(*np.mean([stopped(length, s) for s in SEEDS], axis=0))
    y = 0.2 + 0.8 * np.exp(-length * CLOCK)
    y = y + 0.01 * np.random.default_rng(seed).standard_normal((600, CLOCK.size))
    decay = np.exp(-length * RATES[:, None] * CLOCK)
    one = np.ones_like(decay)
    free = projected(np.stack([one, decay], -1), y)
    best = free.argmin(0)
    reach, dof = stats.t.ppf(0.975, CLOCK.size - 3), CLOCK.size - 3
    inside, halves = 0, []
    for k, row in enumerate(y):
        rate, fall = length * RATES[best[k]], decay[best[k]]
        end, size = np.linalg.lstsq(np.stack([one[0], fall], -1), row, rcond=None)[0]
        slopes = np.stack([one[0], fall, -size * rate * CLOCK * fall], -1)
        variance = free[best[k], k] / dof * np.linalg.pinv(slopes.T @ slopes)[0, 0]
        halves.append(reach * np.sqrt(variance))
        inside += abs(end - 0.2) < halves[-1]
    least, limit = free.min(0), 1 + reach**2 / dof
    held = projected(decay[..., None], y - 0.2).min(0)
    straight = projected(np.stack([one[:1], np.broadcast_to(CLOCK, (1, CLOCK.size))], -1), y)[0]
    return Dried(
        float(np.median(halves)),
        inside / len(y),
        float(np.mean(held < limit * least)),
        float(np.mean(straight < limit * least)),
    )


def drying(p, t):
    return p["end"] + p["fall"] * jnp.exp(-p["rate"] * t)


@cache
def one_run(length):
    """One such run, the time counted in 1/k, and the profile of its end."""
    t = length * CLOCK
    y = 0.2 + 0.8 * np.exp(-t) + 0.01 * np.random.default_rng(1).standard_normal(t.size)
    run = fit(drying, {"end": 0.2, "fall": 0.8, "rate": 1.0}, t, y)
    return run, run.profile("end")


# ---- clarke
CLARKE = np.array([3.183, 3.059, 2.871, 2.622, 2.541, 2.184, 2.110, 2.075, 2.018, 1.903, 1.770, 1.762, 1.550])
"""Data of Clarke (1987) as the guide of SAS/STAT prints them, at 1, 2 … 13."""
clarke = fit(drying, {"end": 0.8, "fall": 2.0, "rate": 0.15}, np.arange(1.0, 14.0), CLARKE)
clarke_ends = clarke.profile("end", 3).interval_95
# ---- one wrong reading
wrong = time.copy()
wrong[4] = 37.4
"""34.7 s with two digits exchanged."""
spoiled = f.LeafTest(time=wrong, filtrate_volume=volume, **SHEET, first_points_excluded=1).fit()
robust = fit(clock, start, volume[1:], wrong[1:], sigma=volume[1:], loss=Huber())
without = spoiled.diagnostics.without if spoiled.diagnostics else {}

# ---- which law
LAWS = ("complete", "standard", "intermediate", "cake")
PARTS = np.linspace(0.1, 1.0, 10)


@cache
def shapes(law):
    """Volume at ten times, the last 1, for many blocking times, with a first flow of one."""
    return np.array(
        [np.asarray(f.filtrate_volume_blocking(PARTS, 1.0, b, law)) for b in np.geomspace(0.05, 200.0, 1500)]
    )


@cache
def named(law, left, seed=None):
    """How often the least scatter names a law, the true one being intermediate blocking, when so much of the
    flow is left; readings good to 1 % of the last volume.
    """
    if seed is None:
        return float(np.mean([named(law, left, s) for s in SEEDS]))
    return float(np.mean(least_scatter(left, seed) == LAWS.index(law)))


@cache
def least_scatter(left, seed):
    true = np.asarray(f.filtrate_volume_blocking(PARTS, 1.0, left / (1.0 - left), "intermediate"))
    y = true + 0.01 * true[-1] * np.random.default_rng(seed).standard_normal((2000, PARTS.size))
    return np.argmin([projected(shapes(law)[..., None], y).min(0) for law in LAWS], axis=0)


def figure_sheet():
    """The ten rows as they are plotted, with the line through nine and the direct fit with a delay."""
    drawing = figure(said("filtrate / L", "filtrat / L"), said("t/V / (s/L)", "t/V / (s/L)"))
    add_points(drawing, volume * 1e3, time / volume * 1e-3, said("readings", "lectures"))
    v = np.linspace(0.3e-3, 5.1e-3, 60)
    lines = (
        (
            said("line, first row left out", "droite, première ligne écartée"),
            found["line_slope"].value * v + found["line_intercept"].value,
        ),
        (said("direct, with a delay", "direct, avec un retard"), np.asarray(delayed(late.values, v)) / v),
    )
    for place, (name, y) in enumerate(lines):
        add_line(drawing, v * 1e3, y * 1e-3, name, color=LINES[place], dash=DASHES[place])
    return drawing


def figure_regions():
    """Joint 95 % regions of both resistances, by three evaluations of the same ten rows."""
    drawing = figure(said("α / (10¹¹ m/kg)", "α / (10¹¹ m/kg)"), said("R / (10¹¹ 1/m)", "R / (10¹¹ 1/m)"))
    regions = (
        (
            said("line, nine rows", "droite, neuf lignes"),
            found.ellipse("cake_resistance", "medium_resistance"),
        ),
        (said("direct, ten rows", "direct, dix lignes"), direct.ellipse("alpha", "medium")),
        (said("direct, with a delay", "direct, avec un retard"), late.ellipse("alpha", "medium")),
    )
    for place, (name, (x, y)) in enumerate(regions):
        add_line(drawing, x / 1e11, y / 1e11, name, color=LINES[place], dash=DASHES[place])
    return drawing


def figure_profiles():
    """How much worse the fit becomes when the end of drying is held elsewhere."""
    drawing = figure(
        said("end of drying held at", "fin de séchage imposée"),
        said("rise of the squares", "hausse des carrés"),
    )
    for place, length in enumerate((1.0, 2.0)):
        run = one_run(length)[0]
        many = run.profile("end", 41)
        name = said(f"stopped at {length:g}/k", f"arrêté à {length:g}/k")
        add_line(drawing, many.values, many.ratio, name, color=LINES[place], dash=DASHES[place])
    limit = float(stats.f.ppf(0.95, 1, CLOCK.size - 3))
    add_line(
        drawing,
        np.array([-0.1, 0.35]),
        np.array([limit, limit]),
        said("limit at 95%", "seuil à 95 %"),
        color=LINES[2],
        dash=DASHES[2],
    )
    return drawing
