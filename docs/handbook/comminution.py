"""What the chapter on comminution and screening states, calculated."""

import numpy as np

import granum as gr
from granum.app.chapters import said
from granum.core.charts import DASHES, LINES, add_line, add_points, axis_title, figure

co = gr.comminution
KWH = 3600.0  # J/kg in a kilowatt-hour per tonne

# ---- laws
bond = {
    um: float(co.specific_energy_bond("20 mm", f"{um} um", "13 kWh/tonne"))
    for um in (2000, 200, 150, 75, 40, 10)
}
kick_constant = bond[2000] / np.log(20e-3 / 2e-3)
rittinger_constant = bond[2000] / (1 / 2e-3 - 1 / 20e-3)
kick = {um: float(co.specific_energy_kick("20 mm", f"{um} um", kick_constant)) for um in bond}
rittinger = {um: float(co.specific_energy_rittinger("20 mm", f"{um} um", rittinger_constant)) for um in bond}
halved = bond[75] / bond[150] - 1
# ---- surface
made = 6 / 75e-6 / 2650 - 6 / 20e-3 / 2650  # m²/kg, spheres of one size
needed = made * 1.0  # at one joule for each square meter
efficiency = needed / bond[75]

# ---- books
rods = co.specific_energy_bond("18 mm", "1.2 mm", "13.2 kWh/tonne")
balls = co.specific_energy_bond("1.2 mm", "175 um", "11.7 kWh/tonne")
morrell = co.specific_energy_morrell("750 um", "106 um", "18.8 kWh/tonne")

# ---- mill
mill = co.mill_power_bond("100 t/hour", "2 mm", "75 um", "13 kWh/tonne", mill_diameter="4 m")
coarser = co.mill_power_bond("100 t/hour", "2 mm", "150 um", "13 kWh/tonne", mill_diameter="4 m")
opened = co.mill_power_bond(
    "100 t/hour", "2 mm", "75 um", "13 kWh/tonne", mill_diameter="4 m", circuit="open"
)
spared = float(mill.shaft_power) - float(coarser.shaft_power)
a_year = spared * 8000 * 3600  # J
extra_open = float(opened.shaft_power) / float(mill.shaft_power) - 1
critical = float(co.rotation_speed_critical("4 m", "80 mm"))
ball = co.ball_diameter_bond("2 mm", 2650, "13 kWh/tonne", "4 m")

# ---- population
EDGES = 1e-3 * 2.0 ** np.arange(-7, 1.51, 0.5)  # 8 µm to 2.8 mm
FEED = np.zeros(len(EDGES) - 1)
FEED[-5:] = 0.2
LAWS = (
    {"law": "austin_selection", "selection_rate": "0.5 1/min", "selection_exponent": 0.8},
    {"law": "austin_breakage", "fines_share": 0.4, "fines_exponent": 0.8, "coarse_exponent": 4.0},
)
minute = np.column_stack(
    [np.asarray(co.ground_fractions(EDGES, one, "1 min", *LAWS).class_fractions) for one in np.eye(len(FEED))]
)
# ---- population_more
LIMIT = int(np.argmin(abs(EDGES - 125e-6)))  # classes below 125 µm
SLIME = int(np.argmin(abs(EDGES - 16e-6)))


def after(minutes):
    """What a batch does to every class in whole minutes."""
    return np.linalg.matrix_power(minute, minutes)


def size_80(shares):
    """Size that 80 % pass."""
    return float(np.interp(0.8, np.cumsum(shares) / shares.sum(), EDGES[1:]))


def closed(minutes):
    """Product, and load returned, of a mill closed by an ideal screen at the limit."""
    mill_, coarse = after(minutes), np.diag(np.arange(len(FEED)) >= LIMIT).astype(float)
    fed = np.linalg.solve(np.eye(len(FEED)) - coarse @ mill_, FEED)
    return mill_ @ fed - coarse @ mill_ @ fed, float((coarse @ mill_ @ fed).sum())


open_times = np.arange(1, 61)
open_runs = [after(int(t)) @ FEED for t in open_times]
open_sizes = [size_80(x) for x in open_runs]


def in_one_pass(size):
    """Minutes in one pass, and share below 16 µm, for the size that 80 % shall pass."""
    time = float(np.interp(-size, [-x for x in open_sizes], open_times))
    fines = [x[:SLIME].sum() for x in open_runs]
    return time, float(np.interp(time, open_times, fines))


loops = {}
for minutes in (4, 8, 16):
    product, load = closed(minutes)
    single, slime = in_one_pass(size_80(product))
    loops[minutes] = {
        "load": load,
        "time": minutes * (1 + load),
        "size": size_80(product),
        "slimes": float(product[:SLIME].sum()),
        "one_pass": single,
        "one_pass_slimes": slime,
        "saved": 1 - minutes * (1 + load) / single,
    }

# ---- screen
seen = co.screening_effectiveness(0.47, 0.85, 0.195)
through = co.product_yield(0.47, 0.85, 0.195)
capacity = co.screening_capacity_karra("10 mm", 0.3, 0.4, 0.15)
screen_area = co.screen_area_karra("70 t/hour", float(capacity))
blinded = co.screening_capacity_karra("10 mm", 0.3, 0.4, 0.45)
near = float(co.screen_area_karra("70 t/hour", float(blinded))) / float(screen_area)


def figure_laws():
    drawing = figure(
        axis_title("product_size", "um"), said("energy / kWh/t", "énergie / kWh/t"), x_log=True, y_log=True
    )
    sizes = np.geomspace(10e-6, 10e-3, 60)
    for name, found, color, dash in (
        ("Rittinger", co.specific_energy_rittinger("20 mm", sizes, rittinger_constant), LINES[0], DASHES[0]),
        ("Bond", co.specific_energy_bond("20 mm", sizes, "13 kWh/tonne"), LINES[1], DASHES[1]),
        ("Kick", co.specific_energy_kick("20 mm", sizes, kick_constant), LINES[2], DASHES[2]),
    ):
        add_line(drawing, 1e6 * sizes, np.asarray(found) / KWH, name, color=color, dash=dash)
    return drawing


def figure_mills():
    drawing = figure(
        axis_title("product_size", "um"), said("energy / kWh/t", "énergie / kWh/t"), x_log=True, y_log=True
    )
    for feed, index, product, printed, name, color in (
        (
            "18 mm",
            13.2,
            1.2e-3,
            2.83,
            said("rod mill, 18 mm, 13.2 kWh/t", "barres, 18 mm, 13,2 kWh/t"),
            LINES[0],
        ),
        (
            "1.2 mm",
            11.7,
            175e-6,
            5.46,
            said("ball mill, 1.2 mm, 11.7 kWh/t", "boulets, 1,2 mm, 11,7 kWh/t"),
            LINES[1],
        ),
    ):
        sizes = np.geomspace(product / 3, product * 4, 40)
        found = np.asarray(co.specific_energy_bond(feed, sizes, f"{index} kWh/tonne"))
        add_line(drawing, 1e6 * sizes, found / KWH, name, color=color)
        add_points(
            drawing, [1e6 * product], [printed], said("printed", "imprimé"), color=color, showlegend=False
        )
    return drawing


def figure_circuit():
    drawing = figure(
        axis_title("particle_diameter", "um"), said("mass below / %", "masse passante / %"), x_log=True
    )
    product, _load = closed(8)
    alone = after(round(loops[8]["one_pass"])) @ FEED
    for name, shares, color, dash in (
        (said("closed, 8 minutes each pass", "fermé, 8 minutes par passage"), product, LINES[0], DASHES[0]),
        (said("one pass", "un seul passage"), alone, LINES[1], DASHES[1]),
        (said("feed", "alimentation"), FEED, LINES[2], DASHES[2]),
    ):
        add_line(drawing, 1e6 * EDGES[1:], 100 * np.cumsum(shares), name, color=color, dash=dash)
    return drawing
