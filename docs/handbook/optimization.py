"""What the chapter on optimization states, calculated."""

from functools import cache
from math import erf, log, pi, sqrt

import jax
import numpy as np

import granum as gr
from granum import studies
from granum.app.chapters import said
from granum.core.charts import DASHES, LINES, add_line, figure

f, p = gr.filtration, gr.conveying

# ---- cycle
SLURRY = {
    "dynamic_viscosity": "0.8937 cP",
    "cake_resistance": 1.86e11,
    "dry_cake_per_filtrate": 23.47,
}
CLOTH = 1.06e11
PRESS = {"area": "50 m2", "pressure_drop": "3.38 bar", **SLURRY, "medium_resistance": CLOTH}
best = f.filtration_cycle(dead_time="30 min", **PRESS)
searched = studies.optimize(
    "filtration.filtrate_volume_constant_pressure",
    {"time": ("2 min", "5 h")},
    maximize="filtrate_volume / (time + '30 min')",
    fixed=PRESS,
    starts=3,
)
dear = f.filtration_cycle(dead_time="30 min", dead_cost_ratio=4.0, **PRESS)


def lost(ratio):
    """Part of the output lost by filtering so many times as long as is best, without a medium."""
    return 1.0 - 2.0 * sqrt(ratio) / (1.0 + ratio)


def dearer(ratio):
    """Part by which a sum of p x and q/x exceeds its least, so many times too large."""
    return 0.5 * (ratio + 1.0 / ratio) - 1.0


# ---- pipe
FLOW = 50.0 / 3600.0
PIPE, POWER = 1.5, 0.12 / 3.6e6 * 8000.0 * 3600.0 / 0.6
"""Exponent of the price of pipe; USD a year per watt of friction, pump and motor at 60 %."""
WALL = 600.0 * 10.0**PIPE * 0.10
"""USD a year per metre of pipe of one metre: 600 USD/m at 100 mm, a tenth a year."""
OBJECTIVE = f"{WALL} * diameter**{PIPE} + {POWER * pi / 4} * pressure_gradient * velocity * diameter**2"


@cache
def piped(flow, widest=None):
    """Cheapest pipe for a flow of water, no wider than may be said."""
    narrow = {"diameter": {"upper": widest}} if widest else {}
    return studies.optimize(
        "conveying.pressure_gradient_pipe",
        {"velocity": ("0.2 m/s", "8 m/s"), "diameter": ("3 cm", "50 cm")},
        minimize=OBJECTIVE,
        limits={f"velocity * diameter**2 * {pi / 4}": {"lower": flow}} | narrow,
        outputs=["pressure_gradient"],
        fixed={"fluid_density": 998.0, "dynamic_viscosity": "1 cP"},
        starts=3,
    )


def velocity(flow):
    return piped(flow).values["velocity"]


def bore(flow):
    return piped(flow).values["diameter"]


def least(flow):
    """Yearly cost per metre."""
    return piped(flow).figures[piped(flow).objective]


def share(flow):
    """Friction over the charge of the pipe, at the optimum."""
    return least(flow) / (WALL * bore(flow) ** PIPE) - 1.0


price = piped(FLOW).active()[0]["price"]
price_again = (least(1.01 * FLOW) - least(0.99 * FLOW)) / (0.02 * FLOW)
price_of_cubic_meter = abs(price) / (8000.0 * 3600.0)


def cost_of_pipe(diameter):
    """Yearly cost per metre for the flow, USD."""
    speed = FLOW / (pi / 4 * diameter**2)
    drop = p.pressure_gradient_pipe.function(speed, diameter, 998.0, 1e-3, 5e-5)
    return WALL * diameter**PIPE + POWER * FLOW * drop


too_narrow = float(cost_of_pipe(0.8 * bore(FLOW))) / least(FLOW) - 1.0
too_wide = float(cost_of_pipe(1.25 * bore(FLOW))) / least(FLOW) - 1.0
in_stock = {
    name: float(cost_of_pipe(inside)) / least(FLOW) - 1.0 for name, inside in ((80, 0.0825), (100, 0.1071))
}
"""Part by which nominal sizes exceed the cheapest pipe."""

# ---- slope
AT = 0.08
exact = float(jax.grad(cost_of_pipe)(AT))
price_of_bore = next(row["price"] for row in piped(FLOW, AT).active() if row["name"] == "diameter")


def forward(step):
    h = AT * step
    return abs((float(cost_of_pipe(AT + h)) - float(cost_of_pipe(AT))) / h / exact - 1.0)


def central(step):
    h = AT * step
    return abs((float(cost_of_pipe(AT + h)) - float(cost_of_pipe(AT - h))) / (2 * h) / exact - 1.0)


# ---- screen
screens = studies.optimize(
    "costs.equipment_cost_by_area",
    {"area": ("5 m2", "11 m2")},
    minimize="purchased_cost",
    fixed={"equipment_by_area": "stationary_screen"},
    starts=8,
)
places = sorted({round(end["inputs"]["area"], 3) for end in screens.ends})


def screen(area):
    return gr.costs.equipment_cost_by_area(area, "stationary_screen").purchased_cost


# ---- doubt
NEED = 0.001


@cache
def sized(samples=0, seed=0, probability=0.95):
    """Least press for a mean flow, its cake as resistant as it may be."""
    return studies.optimize(
        "filtration.filtration_cycle",
        {"area": ("1 m2", "300 m2")},
        minimize="area",
        limits={"mean_filtrate_flow": {"lower": NEED}},
        fixed={k: v for k, v in PRESS.items() if k not in ("area", "medium_resistance")}
        | {"dead_time": "30 min"},
        uncertain={
            "cake_resistance": {
                "distribution": "lognormal",
                "median": 1.86e11,
                "geometric_standard_deviation": 1.5,
            }
        }
        if samples
        else None,
        samples=samples,
        probability=probability,
        seed=seed,
        starts=1,
    )


def area(samples=0, seed=0):
    return sized(samples, seed).values["area"]


def kept_on_fresh(seed):
    """Part of fresh samples in which the press of 400 samples keeps the flow."""
    chance = sized(400, seed).chance
    assert chance is not None
    return chance["limits"]["mean_filtrate_flow"]["probability"]


robust = [area(400, seed) for seed in range(5)]
kept = [kept_on_fresh(seed) for seed in range(5)]
by_hand = 1.5 ** (1.6449 / 2.0)


def truly_kept(wall):
    """Probability that a press keeps the flow; the area needed goes as the root of the resistance."""
    return 0.5 * (1.0 + erf(2.0 * log(wall / area()) / log(1.5) / sqrt(2.0)))


few = [area(20, seed) for seed in range(20)]
kept_by_few = [truly_kept(wall) for wall in few]


def press_cost(wall):
    return gr.costs.equipment_cost_by_area(wall, "plate_and_frame_filter").purchased_cost


dearer_press = press_cost(area(400)) / press_cost(area()) - 1.0


def figure_pipe():
    drawing = figure(said("bore, mm", "diamètre intérieur, mm"), said("USD a year", "USD par an"))
    drawing.update_yaxes(range=[0.0, 130.0])
    bores = np.linspace(0.06, 0.16, 41)
    pipe = [WALL * float(d) ** PIPE for d in bores]
    whole = [float(cost_of_pipe(float(d))) for d in bores]
    lines = (
        (said("pipe", "tuyau"), pipe),
        (said("friction", "frottement"), [a - b for a, b in zip(whole, pipe, strict=True)]),
        (said("together", "ensemble"), whole),
    )
    for place, (name, cost) in enumerate(lines):
        add_line(drawing, 1e3 * bores, cost, name, color=LINES[place], dash=DASHES[place])
    return drawing


def figure_slope():
    drawing = figure(
        said("step over diameter", "pas sur diamètre"), said("error of the slope", "erreur de la pente")
    )
    drawing.update_xaxes(type="log", exponentformat="power", dtick=2)
    drawing.update_yaxes(type="log", exponentformat="power", dtick=2)
    steps = np.logspace(-13.0, -1.0, 37)
    for place, (name, error) in enumerate(
        ((said("forward", "avant"), forward), (said("central", "centrée"), central))
    ):
        add_line(
            drawing,
            steps,
            [max(error(float(step)), 1e-13) for step in steps],
            name,
            color=LINES[place],
            dash=DASHES[place],
        )
    return drawing
