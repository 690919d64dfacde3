"""What becomes of a cake from its first layer to its discharge, stage by stage, and its chart."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.streams.inside_charts import shade

POINTS = 41  # of a curve


class Stage(NamedTuple):
    """A stretch of the life of a cake: its name, times from its beginning (s), thickness of the cake (m) and
    share of its voids that holds liquid at them.
    """

    name: str
    time: Any
    thickness: Any
    saturation: Any


def still(name: str, duration: Any, thickness: Any, saturation: Any = 1.0) -> Stage:
    """A stage in which the thickness stays; the saturation may be a function of the time."""
    time = float(duration) * np.linspace(0.0, 1.0, POINTS) ** 2  # what drains does most of it at first
    wet = saturation(time) if callable(saturation) else saturation
    return Stage(
        name, time, np.full(POINTS, float(thickness)), np.broadcast_to(np.asarray(wet, float), POINTS)
    )


def drawn_course(stages: Iterable[Stage]) -> Any:
    """Thickness and saturation of a cake over time, the stages shaded; None where no time passes."""
    from granum.core.charts import LIQUID, SOLID, add_line, add_right_axis, axis_title, figure
    from granum.core.units import best_unit, from_si

    taken = [stage for stage in stages if float(stage.time[-1]) > 0.0]
    if not taken:
        return None
    edges = np.concatenate([[0.0], np.cumsum([float(stage.time[-1]) for stage in taken])])
    t = np.concatenate([start + np.asarray(s.time) for start, s in zip(edges, taken, strict=False)])
    thick, wet = (
        np.concatenate([np.asarray(v, dtype=float) for v in pair])
        for pair in zip(*(s[2:] for s in taken), strict=True)
    )
    t_unit, z_unit = (
        best_unit(edges[-1], KINDS["Time"]),
        best_unit(float(np.nanmax(thick)), KINDS["Distance"]),
    )
    clock = from_si(edges, t_unit, KINDS["Time"])
    drawing = figure(axis_title("time", t_unit), axis_title("cake_thickness", z_unit))
    room = shade(drawing, list(clock), [stage.name for stage in taken])
    share = 100.0 * wet
    add_line(
        drawing,
        from_si(t, t_unit, KINDS["Time"]),
        from_si(thick, z_unit, KINDS["Distance"]),
        _("thickness"),
        color=SOLID,
    )
    if np.nanmin(share) < 99.99:
        add_line(
            drawing,
            from_si(t, t_unit, KINDS["Time"]),
            share,
            _("saturation"),
            color=LIQUID,
            dash="dash",
            yaxis="y2",
        )
        add_right_axis(
            drawing,
            axis_title("cake_saturation", "%"),
            range=[0.0, 100.0 * room],
            tickmode="array",
            tickvals=[0, 20, 40, 60, 80, 100],
        )
    top = float(from_si(np.nanmax(thick), z_unit, KINDS["Distance"]))
    drawing.update_layout(
        legend={"orientation": "h", "y": -0.2, "x": 0.0},
        margin={"r": 75, "b": 100},
        xaxis={"range": [0.0, clock[-1]]},
        yaxis={"range": [0.0, top * room]},
    )
    return drawing
