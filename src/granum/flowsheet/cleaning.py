"""A train of dust collectors: what is caught of each size behind each of them."""

from __future__ import annotations

from typing import Any

import numpy as np

from granum.core.charts import DASHES, LINES, add_line, axis_title, figure
from granum.core.i18n import _

GAS, FEED = "gas", "feed"
RARE = 1e-9  # of a class in all that enters


def trains(sheet: Any) -> list[list[str]]:
    """Units that hand the gas that they have cleaned to the next one, through movers of gas if need be, in
    order; two or more.
    """
    target = {link.origin: link.target for link in sheet.links}
    parts = {name for name, unit in sheet.units.items() if _cleans(unit)}
    following = {name: _behind(sheet, target, f"{name}.{GAS}", parts) for name in parts}
    first = [name for name in sheet.order if name in parts and name not in following.values()]
    found = []
    for name in first:
        train, here = [name], following[name]
        while here is not None and here not in train:
            train.append(here)
            here = following[here]
        if len(train) > 1:
            found.append(train)
    return found


def _cleans(unit: Any) -> bool:
    outlets = type(unit).outlet_names()
    return len(outlets) > 1 and GAS in outlets and FEED in (type(unit).inlet_names() or ())


def _behind(sheet: Any, target: dict[str, str], port: str, parts: set[str]) -> str | None:
    """The next collector that a gas goes to; what has one outlet only is passed."""
    for _step in sheet.order:
        unit, _dot, _port = target.get(port, "").partition(".")
        if not unit or unit in parts:
            return unit or None
        outlets = type(sheet.units[unit]).outlet_names()
        if len(outlets) != 1:
            return None
        port = f"{unit}.{outlets[0]}"
    return None


def cleaning_chart(sheet: Any, streams: Any, train: list[str]) -> Any:
    """Share of each size that entered the first of a train which has been caught behind each; None where the
    classes differ or hardly any dust enters.
    """
    of = {link.origin: link.name for link in sheet.links} | {link.target: link.name for link in sheet.links}
    entered = streams[of[f"{train[0]}.{FEED}"]]
    fed = np.asarray(entered.solid_by_size, dtype=float)
    if fed.size < 2 or not fed.sum() > 0.0:
        return None
    some = fed > RARE * fed.sum()
    drawing = figure(
        axis_title("particle_diameter", "um"), axis_title("grade_efficiency", "percent"), x_log=True
    )
    sizes = np.asarray(entered.mixture.sizes, dtype=float) * 1e6
    for i, name in enumerate(train):
        left = np.asarray(streams[of[f"{name}.{GAS}"]].solid_by_size, dtype=float)
        if left.shape != fed.shape:
            return None
        caught = 100.0 * (1.0 - left[some] / fed[some])
        add_line(
            drawing,
            sizes[some],
            caught,
            _("behind {unit}").format(unit=name),
            color=LINES[i % len(LINES)],
            dash=DASHES[i % len(DASHES)],
        )
    drawing.update_yaxes(range=[0.0, 102.0])
    return drawing
