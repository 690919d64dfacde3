"""Charts of settling: curve with tangents and zones, flux diagram with state point, concentration over depth
and time.
"""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
import plotly.graph_objects as go

from granum.core import chart
from granum.core.charts import (
    ACCENT,
    CAUTION,
    GAS,
    INK,
    LIQUID,
    OUT,
    SOLID,
    add_label,
    add_line,
    add_points,
    axis_title,
    figure,
)
from granum.core.constants import HOUR, MINUTE
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Concentration,
    Distance,
    Fraction,
    Law,
    Length,
    Series,
    Time,
    VolumeFlow,
    Within,
)
from granum.core.units import format_number
from granum.settling.column import Suspension
from granum.settling.flux import settling_flux, state_point_clarifier
from granum.settling.lab_tests.batch_test import BatchTest, VelocityFunction
from granum.settling.layers import settler_layers
from granum.settling.simulations import batch_course

Settling = Annotated[Any, Law("settling_velocity")]
CM = 100.0  # in a meter


@chart(source="kynch1952; talmage1955", title="Settling curve with tangents and zones")
def settling_curve_chart(
    time: Annotated[Time, Series("points")],
    interface_height: Annotated[Distance, Series("points")],
    initial_concentration: Concentration,
    velocity_function: VelocityFunction = "vesilind",
) -> go.Figure:
    """Settling curve with its zones and Kynch's tangents, each marked with the concentration it stands
    for.

    >>> settling_curve_chart(
    ...     time="0 0.25 0.5 1 1.75 3 4.75 12 20 hour",
    ...     interface_height="36 32.4 28.6 21 14.7 12.3 11.55 9.8 8.8 cm",
    ...     initial_concentration="236 g/L",
    ... ).layout.xaxis.title.text
    'time <i>t</i> / min'
    """
    c = BatchTest(time, interface_height, initial_concentration, velocity_function=velocity_function).zones()
    drawing = figure(
        axis_title("time", "min"),
        axis_title("interface_height", "cm"),
        title=_("Settling curve with tangents and zones"),
    )
    lag = c.induction_time
    end = (c.time[-1] + lag) / MINUTE
    limits = [
        (0.0, _("induction")),
        (lag / MINUTE, _("A–B constant rate")),
        ((c.constant_rate_end + lag) / MINUTE, _("B–C falling rate")),
    ]
    if c.compression is not None:
        limits.append(((c.compression.time + lag) / MINUTE, _("C–D compression")))
    edges = [start for start, _name in limits] + [end]
    row = 0
    for (start, name), stop, shade in zip(limits, edges[1:], ("white", LIQUID, ACCENT, SOLID), strict=False):
        if stop > start:
            drawing.add_vrect(x0=start, x1=stop, fillcolor=shade, opacity=0.07, line_width=0)
            # One line below the other: short zones would write over each other.
            drawing.add_annotation(
                x=max(start, 0.12 * end),
                y=0.98 - 0.07 * row,
                yref="paper",
                text=name,
                showarrow=False,
                xanchor="left",
                yanchor="top",
            )
            drawing.add_shape(
                type="line",
                x0=start,
                x1=start,
                y0=0.0,
                y1=1.0,
                yref="paper",
                line={"color": shade, "width": 1},
            )
            row += 1
    found = c.convex.tangents
    chosen = np.unique(np.linspace(0, found.time.size - 1, min(4, found.time.size)).astype(int))
    for i in chosen:
        cut, v = found.intercept_height[i], found.settling_velocity[i]
        stop = min(cut / v, c.time[-1])
        density = float(initial_concentration * c.initial_height / cut)
        label = f"{format_number(density, 3)} g/L"
        add_line(
            drawing,
            [lag / MINUTE, (lag + stop) / MINUTE],
            [cut * CM, (cut - v * stop) * CM],
            _("tangent"),
            color=GAS,
            dash="dash",
            width=1,
            showlegend=bool(i == chosen[0]),
        )
        add_label(drawing, lag / MINUTE, float(cut * CM), label, color=GAS, xanchor="left", yanchor="bottom")
    add_line(drawing, (c.time + lag) / MINUTE, c.convex.height * CM, _("convex curve"))
    add_points(drawing, np.asarray(time) / MINUTE, np.asarray(interface_height) * CM, _("data"))
    if c.compression is not None:
        add_points(
            drawing,
            [(c.compression.time + lag) / MINUTE],
            [c.compression.height * CM],
            _("compression point"),
            color=OUT,
        )
    drawing.update_yaxes(rangemode="tozero")
    return drawing


@chart(
    source="keinath1985; yoshioka1957",
    title="Flux diagram with state point",
    typical={
        "volume_flow": (0.1, 0.3),
        "feed_concentration": (2.0, 4.0),
        "underflow_volume_flow": (0.04, 0.09),
        "area": (500.0, 1500.0),
    },
)
def flux_diagram(
    volume_flow: VolumeFlow,
    feed_concentration: Concentration,
    underflow_volume_flow: VolumeFlow,
    area: Area,
    settling: Settling = "takacs",
) -> go.Figure:
    """Settling flux against concentration with overflow line, underflow operating line and the state point
    where they cross.
    """
    state = state_point_clarifier(
        volume_flow, feed_concentration, underflow_volume_flow, area, settling=settling
    )
    over, under = (volume_flow - underflow_volume_flow) / area, underflow_volume_flow / area
    top = 1.25 * max(state.underflow_concentration, state.applied_flux / under, 2.0 * feed_concentration)
    C = np.linspace(0.0, top, 400)
    f = np.asarray(settling_flux(C, settling))
    drawing = figure(
        axis_title("solids_concentration", "g/L"),
        axis_title("solids_flux", "kg/(m^2*hour)"),
        title=_("Flux diagram with state point"),
    )
    add_line(drawing, C, f * HOUR, _("settling flux"))
    add_line(drawing, C, over * C * HOUR, _("overflow line"), color=LIQUID, dash="dash")
    line = state.applied_flux - under * C
    add_line(drawing, C[line >= 0], line[line >= 0] * HOUR, _("underflow line"), color=SOLID)
    limit = state.limiting_flux - under * C
    add_line(
        drawing,
        C[limit >= 0],
        limit[limit >= 0] * HOUR,
        _("limiting flux"),
        color=CAUTION,
        dash="dot",
        width=1,
    )
    add_points(drawing, [feed_concentration], [over * feed_concentration * HOUR], _("state point"), color=INK)
    verdict = _("overloaded") if state.loading_ratio > 1 else _("underloaded")
    add_label(
        drawing,
        feed_concentration,
        over * feed_concentration * HOUR,
        f"{verdict} ({format_number(float(state.loading_ratio), 2)})",
        xanchor="left",
        yanchor="bottom",
        yshift=6,
        bgcolor="rgba(255,255,255,0.8)",
    )
    drawing.update_yaxes(range=[0.0, 1.15 * HOUR * max(f.max(), state.applied_flux)])
    return drawing


@chart(
    source="burger2011",
    title="Concentration over depth and time",
    typical={"time": (0.0, 7200.0), "initial_concentration": (2.0, 6.0), "initial_height": (0.3, 1.0)},
)
def settling_course_chart(
    initial_concentration: Concentration,
    initial_height: Length,
    time: Annotated[Time, Series("times")],
    settling: Settling = "takacs",
    compression: Annotated[Any, Law("solids_stress")] | None = None,
    packed_concentration: Concentration | None = None,
    cells: Annotated[int, Within(5, 5000)] = 80,
) -> go.Figure:
    """Concentration in a settling cylinder over height, played through time.

    >>> len(
    ...     settling_course_chart(
    ...         initial_concentration="3.5 g/L", initial_height="55 cm", time="0 5 10 20 30 45 60 min"
    ...     ).frames
    ... )
    7
    """
    course = batch_course(
        initial_concentration,
        initial_height,
        time,
        Suspension(settling, compression, packed_concentration=packed_concentration),
        cells,
    )
    return animated(
        np.asarray(course.times),
        float(initial_height) - np.asarray(course.depths),
        np.asarray(course.concentration),
    )


def animated(times: np.ndarray, heights: np.ndarray, concentration: np.ndarray) -> go.Figure:
    """Profiles over height, one frame a time, with a slider and a play button."""
    drawing = figure(
        axis_title("solids_concentration", "g/L"),
        axis_title("height", "m"),
        title=_("Concentration over depth and time"),
    )
    add_line(drawing, concentration[0], heights, _("concentration"), color=SOLID)
    # every profile keeps its points, so that frames follow each other one to one
    drawing.update_traces(line={"simplify": False})
    names = [f"{t / MINUTE:.3g} min" for t in times]
    drawing.frames = [
        go.Frame(
            data=[
                go.Scatter(
                    x=row, y=heights, mode="lines", line={"color": SOLID, "width": 2, "simplify": False}
                )
            ],
            name=name,
        )
        for row, name in zip(concentration, names, strict=True)
    ]
    still = {"duration": 0}  # profiles jump: a tween between two of them would be no profile
    steps = [
        {
            "label": n,
            "method": "animate",
            "args": [
                [n],
                {"mode": "immediate", "frame": {"duration": 0, "redraw": False}, "transition": still},
            ],
        }
        for n in names
    ]
    play = {
        "label": "▶",
        "method": "animate",
        "args": [
            None,
            {"frame": {"duration": 120, "redraw": False}, "fromcurrent": True, "transition": still},
        ],
    }
    drawing.update_layout(
        sliders=[{"steps": steps, "pad": {"t": 40}, "x": 0.1, "len": 0.9}],
        updatemenus=[
            {
                "type": "buttons",
                "buttons": [play],
                "x": 0.0,
                "xanchor": "left",
                "y": 0.0,
                "yanchor": "top",
                "pad": {"t": 60},
            }
        ],
    )
    drawing.update_xaxes(range=[0.0, 1.05 * float(concentration.max())])
    return drawing


@chart(
    source="takacs1991; alex2008",
    title="Layers of a secondary settler",
    typical={
        "volume_flow": (0.2, 0.5),
        "feed_concentration": (2.5, 3.5),
        "underflow_volume_flow": (0.15, 0.2),
        "area": (1400.0, 1600.0),
        "height": (3.5, 4.5),
    },
)
def settler_layers_chart(
    volume_flow: VolumeFlow,
    feed_concentration: Concentration,
    underflow_volume_flow: VolumeFlow,
    area: Area,
    height: Length,
    settling: Settling = "takacs",
    nonsettleable_share: Fraction = 0.0,
    layers: Annotated[int, Within(3, 200)] = 10,
) -> go.Figure:
    """Concentration of the layers of a secondary settler at rest over its height.

    >>> settler_layers_chart(
    ...     "36892 m^3/day", 3.27, "18831 m^3/day", 1500, 4, nonsettleable_share=0.00228
    ... ).layout.xaxis.type
    'log'
    """
    rest = settler_layers(
        volume_flow,
        feed_concentration,
        underflow_volume_flow,
        area,
        height,
        settling=settling,
        nonsettleable_share=nonsettleable_share,
        layers=layers,
    )
    return layered(rest.layer_concentration, height, _("Layers of a secondary settler"))


def operating_line(
    feed_concentration: float,
    underflow_concentration: float,
    applied_flux: float,
    limiting_flux: float,
    limiting_concentration: float,
    settling: Any,
) -> go.Figure:
    """Settling flux over concentration, with the line from the load of a thickener to its underflow, and that
    of the greatest load, which touches the curve (Yoshioka).
    """

    def settled(concentration: Any) -> np.ndarray:
        return np.asarray(settling_flux(np.asarray(concentration, dtype=float), settling)) * HOUR

    C = np.linspace(0.0, 1.1 * underflow_concentration, 300)
    most, load, ends = HOUR * limiting_flux, HOUR * applied_flux, [0.0, underflow_concentration]
    drawing = figure(axis_title("solids_concentration", "g/L"), axis_title("solids_flux", "kg/(m^2*hour)"))
    add_line(drawing, C, settled(C), _("settling flux"))
    add_line(drawing, ends, [most, 0.0], _("limiting flux"), color=CAUTION, dash="dash")
    add_line(drawing, ends, [load, 0.0], _("load"), color=SOLID)
    for at, color, name in (
        (limiting_concentration, CAUTION, _("limiting layer")),
        (feed_concentration, INK, _("feed")),
    ):
        add_points(drawing, [at], settled([at]), name, color=color)
    drawing.update_yaxes(range=[0.0, 1.08 * max(float(settled(C).max()), most, load)])
    return drawing


def layered(concentration: Any, height: Any, title: str = "") -> go.Figure:
    """Even layers from the top, as steps over the height."""
    C = np.asarray(concentration, dtype=float)
    edges = float(height) * np.linspace(1.0, 0.0, C.size + 1)
    drawing = figure(
        axis_title("solids_concentration", "g/L"),
        axis_title("height", "m"),
        title=title,
    )
    drawn = np.maximum(C, 1e-6 * max(float(C.max()), 1e-9))  # an axis of powers of ten has no zero
    add_line(drawing, np.repeat(drawn, 2), np.repeat(edges, 2)[1:-1], _("concentration"), color=SOLID)
    drawing.update_traces(line={"simplify": False})
    drawing.update_xaxes(type="log", exponentformat="power")
    return drawing
