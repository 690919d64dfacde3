"""What the chapter on lines states, calculated."""

from dataclasses import replace
from functools import cache
from math import ceil, log

import numpy as np
from validation import EXAMPLES

import granum as gr
from granum.app.chapters import said
from granum.core.charts import DASHES, LINES, add_line, axis_title, figure
from granum.flowsheet.specifications import Target

LINE = gr.read(EXAMPLES / "potassium-nitrate" / "line.toml")
PURGES = (0.05, 0.1, 0.24, 0.5, 0.9)


@cache
def purged(share):
    """The potassium nitrate line with another purge."""
    return LINE.with_values(**{"purge.side_fraction": share}).solve()


def flow(share, stream):
    return float(purged(share).streams[stream].mass_flow)


def grown(share):
    """All crystals that leave, coarse and fine."""
    streams = purged(share).streams
    return float(streams["crystals"].solid_flow + streams["fines"].solid_flow)


def suspended(share):
    magma = purged(share).streams["magma"]
    return float(magma.solid_flow / magma.mass_flow)


# ---- whole
FED = LINE.sheet.feeds["hot_liquor"]
salt_fed = float(FED.liquid[1])
water_fed = float(FED.liquid[0] + LINE.sheet.feeds["wash_water"].liquid_flow)
left = purged(0.24).streams["purged"].liquid
water_purged, salt_purged = float(left[0]), float(left[1])
dried = water_fed - water_purged
holds = salt_purged / water_purged
by_hand = salt_fed - holds * water_purged
gain = grown(0.9) / grown(0.05) - 1

# ---- impurity
fed_with = 0.002 * float(FED.mass_flow)  # an impurity that no crystal takes up
in_purge = {share: fed_with / flow(share, "purged") for share in PURGES}

# ---- cold
cold = {share: -float(purged(share).units["crystallizer"].values.heat_duty) for share in PURGES}
heat_gain = cold[0.9] / cold[0.05] - 1

# ---- passes
passes = {returned: ceil(log(1e-10) / log(returned)) for returned in (0.5, 0.76, 0.95)}

# ---- wanted
wanted = replace(
    LINE, targets=(Target("purge.side_fraction", "magma.solids_mass_fraction", 0.15, 0.02, 0.98),)
).solve()
found = {name: float(value) for name, _parameter, value in wanted.sought()}["purge.side_fraction"]
pumped = float(wanted.streams["recycle"].mass_flow)
reach = [float(purged(share).streams["crystals"].solid_flow) for share in (0.02, 0.98)]


def figure_purge():
    drawing = figure(axis_title("side_fraction", "percent"), said("share, %", "part, %"))
    shares = np.linspace(0.04, 0.96, 14)
    add_line(
        drawing,
        100 * shares,
        [100 * grown(float(s)) / salt_fed for s in shares],
        said("salt fed that leaves as crystals", "sel alimenté qui sort en cristaux"),
        color=LINES[0],
    )
    add_line(
        drawing,
        100 * shares,
        [100 * suspended(float(s)) for s in shares],
        said("crystals in the magma", "cristaux dans le magma"),
        color=LINES[1],
        dash=DASHES[1],
    )
    return drawing


def figure_passes():
    drawing = figure(said("passes", "passages"), said("distance from rest", "écart au repos"))
    drawing.update_yaxes(type="log", range=[-10.5, 0.2])
    count = np.arange(0, 121)
    for color, returned in zip(LINES, (0.5, 0.76, 0.95), strict=False):
        name = said(f"{100 * returned:.0f}% return", f"{100 * returned:.0f} % reviennent")
        add_line(drawing, count, returned**count, name, color=color)
    return drawing
