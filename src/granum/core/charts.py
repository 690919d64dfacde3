"""The one look of every chart: template, colors of the phases, axis titles, log axes, points, lines and
bands. Uses Plotly.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import plotly.graph_objects as go

from granum.core.glossary import glossary
from granum.core.i18n import _, current_language
from granum.core.symbols import html_symbol
from granum.core.units import pretty_unit

INK, GRID, ACCENT = "#1c2430", "#e6e9ee", "#0b6e6e"
SOLID, LIQUID, GAS, HEAT = "#b7791f", "#2b6cb0", "#6b7f99", "#c2410c"
OK, CAUTION, OUT = "#2f855a", "#b45309", "#b91c1c"
OUTSIDE = "#8a94a3"  # of what lies outside a diagram
LINES = (ACCENT, SOLID, LIQUID, HEAT, "#6b46c1", GAS, OK, "#97266d", CAUTION, "#2c5282")
DASHES = ("solid", "dash", "dot", "dashdot", "longdash")

_AXIS = {
    "showline": True,
    "linecolor": INK,
    "linewidth": 1,
    "mirror": False,
    "gridcolor": GRID,
    "gridwidth": 1,
    "zeroline": False,
    "ticks": "outside",
    "ticklen": 4,
    "tickcolor": INK,
    "title": {"standoff": 8},
}


def template() -> go.layout.Template:
    """White plot, thin grid, no frame on top and right, system type, decimal comma in French."""
    separators = ",\u202f" if current_language() == "fr" else ".\u202f"
    return go.layout.Template(
        layout={
            "font": {
                "family": "system-ui, -apple-system, Segoe UI, Roboto, sans-serif",
                "size": 13,
                "color": INK,
            },
            "paper_bgcolor": "white",
            "plot_bgcolor": "white",
            "colorway": list(LINES),
            "xaxis": _AXIS,
            "yaxis": _AXIS,
            "margin": {"l": 70, "r": 25, "t": 45, "b": 60},
            "hovermode": "closest",
            "separators": separators,
            "legend": {"bgcolor": "rgba(255,255,255,0.8)", "borderwidth": 0},
            "title": {"font": {"size": 15}, "x": 0.0, "xanchor": "left"},
        }
    )


def axis_title(name: str, unit: str = "", label: str | None = None, symbol: str = "") -> str:
    """``quantity symbol / unit``: label and symbol from the glossary unless given, symbol in italics.

    >>> axis_title("particle_diameter", "um")
    'particle diameter <i>d<sub>p</sub></i> / µm'
    """
    term = glossary().get(name)
    text = label or (term.label if term else name)
    symbol = symbol or (term.symbol if term and label is None else "")
    marked = f" <i>{html_symbol(symbol)}</i>" if symbol else ""
    shown = pretty_unit(unit)
    return f"{text}{marked}" + (f" / {shown}" if shown else "")


def figure(
    x: str, y: str, *, title: str = "", x_log: bool = False, y_log: bool = False, **layout: Any
) -> go.Figure:
    """An empty figure in the house style; ``x`` and ``y`` are finished axis titles (see ``axis_title``)."""
    chart = go.Figure()
    chart.update_layout(template=template(), title=title or None, width=None, height=480, **layout)
    for update, text, log in ((chart.update_xaxes, x, x_log), (chart.update_yaxes, y, y_log)):
        update(
            title=text,
            type="log" if log else "linear",
            **({"dtick": 1, "exponentformat": "power"} if log else {}),
        )
    return chart


def _mark_short_decades(chart: go.Figure) -> None:
    """Marks within the decade on logarithmic axes whose data span little more than one, or among which there
    is one power of ten: it would have one mark or none.
    """
    for axis, coordinate in ((chart.layout.xaxis, "x"), (chart.layout.yaxis, "y")):
        if axis.type != "log":
            continue
        seen = np.concatenate(
            [np.asarray(getattr(trace, coordinate, None), dtype=float).ravel() for trace in chart.data]
        )
        seen = seen[np.isfinite(seen) & (seen > 0)]
        low, high = (float(seen.min()), float(seen.max())) if seen.size else (1.0, 100.0)
        decades = np.floor(np.log10(high)) - np.ceil(np.log10(low)) + 1  # powers of ten among the data
        short = (high < 20.0 * low or decades < 2) and low >= 1e-3 and high < 1e5
        steps = (1, 2, 5) if high > 6 * low else (1, 1.5, 2, 3, 4, 5, 6, 8)
        marks = [s * 10.0**k for k in range(-4, 5) for s in steps]
        axis.update(tickvals=marks, tickformat="~r", tickmode="array") if short else axis.update(
            tickvals=None, tickformat=None, tickmode="linear"
        )


def as_html(chart: go.Figure, *, plotly: bool = True, page: bool = False) -> str:
    """A chart as HTML, a part of a page or a page of its own; ``plotly`` puts the library in. Nothing offers
    to send its data anywhere.
    """
    config = {"displaylogo": False, "showSendToCloud": False, "plotlyServerURL": ""}
    return chart.to_html(full_html=page, include_plotlyjs=plotly, config=config)


def add_points(
    chart: go.Figure, x: Any, y: Any, name: str, *, color: str = INK, hollow: bool = False, **more: Any
) -> None:
    """Data points; hollow ones are excluded from a fit."""
    marker = {"color": "white" if hollow else color, "size": 7, "line": {"color": color, "width": 1.5}}
    chart.add_trace(go.Scatter(x=x, y=y, mode="markers", name=name, marker=marker, **more))
    _mark_short_decades(chart)


def add_line(
    chart: go.Figure,
    x: Any,
    y: Any,
    name: str,
    *,
    color: str = ACCENT,
    dash: str = "solid",
    width: float = 2,
    **more: Any,
) -> None:
    """A model line."""
    chart.add_trace(
        go.Scatter(
            x=x, y=y, mode="lines", name=name, line={"color": color, "dash": dash, "width": width}, **more
        )
    )
    _mark_short_decades(chart)


def add_right_axis(chart: go.Figure, title: str, **more: Any) -> None:
    """A second upright axis on the right, for lines with ``yaxis="y2"``; it has no grid of its own,
    but marks at round numbers.
    """
    axis = {"overlaying": "y", "side": "right", "showgrid": False, "tickmode": "auto", "title": title}
    chart.update_layout(yaxis2=axis | more)


def faded(color: str, opacity: float = 0.45) -> str:
    """A color that lets others shine through.

    >>> faded("#b7791f")
    'rgba(183,121,31,0.45)'
    """
    red, green, blue = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return f"rgba({red},{green},{blue},{opacity})"


def add_band(chart: go.Figure, x: Any, low: Any, high: Any, name: str, *, color: str = ACCENT) -> None:
    """A 95 % band between two curves."""
    fill = faded(color, 0.15)
    chart.add_trace(
        go.Scatter(x=x, y=high, mode="lines", line={"width": 0}, showlegend=False, hoverinfo="skip")
    )
    chart.add_trace(
        go.Scatter(
            x=x,
            y=low,
            mode="lines",
            line={"width": 0},
            fill="tonexty",
            fillcolor=fill,
            name=name,
            hoverinfo="skip",
        )
    )


def add_residuals(chart: go.Figure, x: Any, residuals: Any, kept: Any, unit: str) -> None:
    """What was measured less the model, under the points on the same axis; hollow where excluded."""
    marker = {
        "color": [INK if used else "white" for used in kept],
        "size": 6,
        "line": {"color": INK, "width": 1.5},
    }
    chart.add_scatter(
        x=x, y=residuals, yaxis="y2", mode="markers", marker=marker, name=_("residuals"), showlegend=False
    )
    title = _("measured − model") + (f" / {pretty_unit(unit)}" if pretty_unit(unit) else "")
    chart.update_layout(
        height=600,
        xaxis={"anchor": "y2"},
        yaxis={"domain": [0.34, 1.0]},
        yaxis2={
            **_AXIS,
            "domain": [0.0, 0.24],
            "anchor": "x",
            "title": {"text": title, "font": {"size": 11}},
            "zeroline": True,
            "zerolinecolor": INK,
            "nticks": 4,
        },
    )


def add_label(chart: go.Figure, x: float, y: float, text: str, *, color: str = INK, **more: Any) -> None:
    """A direct label on a line, in data coordinates (logarithms taken for log axes)."""
    import math

    px = math.log10(x) if chart.layout.xaxis.type == "log" else x
    py = math.log10(y) if chart.layout.yaxis.type == "log" else y
    chart.add_annotation(x=px, y=py, text=text, showarrow=False, font={"color": color, "size": 11}, **more)
