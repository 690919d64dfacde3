"""Charts of studies: histogram with cumulative curve, bars of influence, sweeps, maps, starts and fronts, in
the house style.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import plotly.graph_objects as go

from granum.core import charts
from granum.core.i18n import _
from granum.core.parameters import Parameter
from granum.core.symbols import html_symbol
from granum.core.units import format_number, from_si, pretty_unit
from granum.studies.outcome import meets
from granum.studies.subjects import Variable

if TYPE_CHECKING:
    from granum.studies.ensembles import Ensemble, Sensitivity
    from granum.studies.fronts import Front
    from granum.studies.grids import Map, Sweep
    from granum.studies.optimizing import Optimum

SHOWN = 12
"""Most figures and most bars that are drawn."""


def shown(p: Parameter, values: Any, unit: str) -> np.ndarray:
    """SI values in a display unit."""
    array = np.asarray(values, dtype=float)
    return array if p.kind is None else np.asarray(from_si(array, unit, p.kind))


def _axis(v: Variable, unit: str) -> str:
    latex = "" if v.named else v.parameter.symbol
    symbol = f" <i>{html_symbol(latex)}</i>" if latex else ""
    label = pretty_unit(unit)
    return f"{v.label}{symbol}" + (f" / {label}" if label else "")


def _scaled(v: Variable, values: Any) -> tuple[np.ndarray, str]:
    unit = v.parameter.display_unit(values)
    return shown(v.parameter, values, unit), _axis(v, unit)


def distribution_chart(outcome: Ensemble, v: Variable) -> go.Figure:
    """Histogram (left) and cumulative curve (right) with P10, P50 and P90; limits in red."""
    values = outcome.column(v.path)
    good = values[np.isfinite(values)]
    x, title = _scaled(v, good)
    unit = v.parameter.display_unit(good)
    figure = charts.figure(title, _("share of cases / %"), title=v.label)
    counts, edges = np.histogram(x, bins=min(60, max(8, int(np.sqrt(len(x))))))
    figure.add_bar(
        x=(edges[1:] + edges[:-1]) / 2,
        y=100 * counts / len(x),
        width=np.diff(edges),
        name=_("share"),
        opacity=0.45,
        marker_color=charts.ACCENT,
    )
    order = np.sort(x)
    keep = np.unique(np.linspace(0, len(order) - 1, min(len(order), 400)).astype(int))
    figure.add_scatter(
        x=order[keep],
        y=100 * (keep + 0.5) / len(order),
        mode="lines",
        name=_("cumulative"),
        yaxis="y2",
        line={"color": charts.INK, "width": 2},
    )
    # room above the curve and the bars for the names of the lines
    charts.add_right_axis(figure, _("cumulative / %"), range=[0, 114], tickmode="linear", dtick=25)
    figure.update_layout(
        yaxis_range=[0, 1.15 * 100 * counts.max() / len(x)],
        bargap=0,
        showlegend=False,
        margin={"r": 70},
    )
    for name, share, side, drop in (
        ("P10", 10, "top left", 0),
        ("P50", 50, "top right", 0),
        ("P90", 90, "top right", -16),
    ):
        place = float(np.percentile(x, share))
        line = {"color": charts.GAS, "width": 1, "dash": "dot"}
        text = f"{name} {format_number(place, 3)}"
        figure.add_vline(
            x=place,
            line=line,
            annotation_text=text,
            annotation_font_size=11,
            annotation_position=side,
            annotation_yshift=drop,
        )
    for limit in outcome.limits.get(v.path, (None, None)):
        if limit is not None:
            figure.add_vline(x=float(shown(v.parameter, limit, unit)), line={"color": charts.OUT, "width": 2})
    return figure


def _height(bars: int) -> int:
    """Height of a chart of bars that lie: no thicker for being few."""
    return 150 + 44 * max(bars, 2)


def _bars(
    figure: go.Figure,
    names: list[str],
    values: list[float],
    spread: list[float] | None,
    name: str,
    color: str,
) -> None:
    error = {"type": "data", "array": spread, "color": charts.INK, "thickness": 1} if spread else None
    figure.update_layout(height=_height(len(names)))
    figure.add_bar(y=names, x=values, orientation="h", name=name, marker_color=color, error_x=error)


def of_ensemble(outcome: Ensemble) -> dict[str, go.Figure]:
    """A histogram and a tornado of rank correlations for each figure."""
    made = {}
    ranks = outcome.rank_correlations()
    labels = {v.path: v.label for v in outcome.inputs}
    for v in outcome.outputs[:SHOWN]:
        good = outcome.column(v.path)[np.isfinite(outcome.column(v.path))]
        if len(good) < 2 or np.ptp(good) <= 1e-9 * np.max(np.abs(good)):
            continue
        made[v.path] = distribution_chart(outcome, v)
        rows = [(labels[n], r) for n, r in ranks.get(v.path, {}).items() if r is not None]
        if len(rows) > 1:
            rows = sorted(rows, key=lambda row: abs(row[1]))[-SHOWN:]
            figure = charts.figure(
                _("rank correlation"), "", title=_("What moves {figure}").format(figure=v.label)
            )
            _bars(
                figure,
                [n for n, _r in rows],
                [r for _n, r in rows],
                None,
                _("rank correlation"),
                charts.ACCENT,
            )
            figure.update_layout(
                xaxis_range=[-1, 1], yaxis_type="category", showlegend=False, margin={"l": 220}
            )
            made[f"{v.path} tornado"] = figure
    return made


def of_sensitivity(outcome: Sensitivity) -> dict[str, go.Figure]:
    """First-order and total index of each input, a chart for each figure."""
    made = {}
    labels = {v.path: v.label for v in outcome.inputs}
    for v in outcome.outputs[:SHOWN]:
        rows = [(labels.get(g, g), s) for g, s in outcome.indices()[v.path].items() if s["total"] is not None]
        if not rows:
            continue
        rows = sorted(rows, key=lambda row: row[1]["total"] or 0.0)[-SHOWN:]
        figure = charts.figure(
            _("share of the variance"), "", title=_("What moves {figure}").format(figure=v.label)
        )
        for key, name, color in (
            ("first", _("alone"), charts.ACCENT),
            ("total", _("with interactions"), charts.GAS),
        ):
            spread = [float(s[f"{key}_interval"] or 0.0) for _n, s in rows]
            _bars(
                figure, [n for n, _s in rows], [float(s[key] or 0.0) for _n, s in rows], spread, name, color
            )
        figure.update_layout(
            barmode="group",
            yaxis_type="category",
            margin={"l": 220},
            legend={"orientation": "h", "y": 1.02, "yanchor": "bottom"},
        )
        made[v.path] = figure
    return made


def of_sweep(outcome: Sweep) -> dict[str, go.Figure]:
    """Each figure along the input."""
    (across,) = outcome.inputs
    x, title = _scaled(across, outcome.column(across.path))
    log = (
        len(x) > 2
        and x.min() > 0
        and abs(x[1] / x[0] - x[-1] / x[-2]) < 1e-6 * x[1] / x[0]
        and x[-1] / x[0] > 10
    )
    made = {}
    for v in outcome.outputs[:SHOWN]:
        y, upward = _scaled(v, outcome.column(v.path))
        made[v.path] = charts.figure(title, upward, title=v.label, x_log=bool(log))
        charts.add_line(made[v.path], x, y, v.label, showlegend=False)
    return made


def of_map(outcome: Map) -> dict[str, go.Figure]:
    """Contours over the two inputs; what the limits forbid is hatched."""
    down, across = outcome.inputs
    first, second = outcome.axes
    (y, upward), (x, title) = _scaled(down, first), _scaled(across, second)
    logs = [
        len(a) > 2 and a.min() > 0 and a[-1] / a[0] > 10 and abs(a[1] * a[1] / (a[0] * a[2]) - 1) < 1e-6
        for a in (x, y)
    ]
    made = {}
    for v in outcome.outputs[:SHOWN]:
        z, named = _scaled(v, outcome.grid(v.path))
        figure = charts.figure(title, upward, title=v.label, x_log=bool(logs[0]), y_log=bool(logs[1]))
        figure.add_contour(
            x=x,
            y=y,
            z=z,
            colorscale="Teal",
            contours={"showlabels": True},
            colorbar={"title": {"text": named, "side": "right"}},
            name=v.label,
        )
        for path, limit in outcome.limits.items():
            _forbid(figure, outcome, path, limit, x, y)
        figure.update_layout(
            legend={"orientation": "h", "y": 1.02, "yanchor": "bottom", "x": 1.0, "xanchor": "right"}
        )
        made[v.path] = figure
    return made


def _forbid(
    figure: go.Figure, outcome: Map, path: str, limit: tuple[float | None, float | None], x: Any, y: Any
) -> None:
    """Shade where a limit is not kept (a constraint contour fills the side that breaks it)."""
    values = outcome.grid(path)
    v = outcome.cases.subject.output(path)
    for bound, operation, sign in zip(limit, (">=", "<="), ("≥", "≤"), strict=True):
        if bound is None or not np.any(~meets(values, limit) & np.isfinite(values)):
            continue
        unit = v.parameter.display_unit(bound)
        edge = float(shown(v.parameter, bound, unit))
        figure.add_contour(
            x=x,
            y=y,
            z=shown(v.parameter, values, unit),
            showscale=False,
            hoverinfo="skip",
            showlegend=True,
            name=_("outside {limit}").format(
                limit=f"{v.label} {sign} {format_number(edge)} {pretty_unit(unit)}"
            ),
            contours={"type": "constraint", "operation": operation, "value": edge},
            line={"color": charts.OUT, "width": 2},
            fillcolor="rgba(185,28,28,0.25)",
        )


def of_optimum(outcome: Optimum) -> dict[str, go.Figure]:
    """Where in their ranges the best inputs lie."""
    names = [v.label for v in outcome.inputs]
    places = [100 * outcome.spans[p].place(value) for p, value in outcome.values.items()]
    figure = charts.figure(_("place within its limits / %"), "", title=_("Best inputs"))
    figure.add_bar(
        y=names,
        x=[100.0] * len(names),
        orientation="h",
        marker_color=charts.GRID,
        hoverinfo="skip",
        showlegend=False,
    )
    texts = []
    for v in outcome.inputs:
        unit = v.parameter.display_unit(outcome.values[v.path])
        texts.append(
            f"{format_number(float(shown(v.parameter, outcome.values[v.path], unit)))} {pretty_unit(unit)}"
        )
    figure.add_scatter(
        y=names,
        x=places,
        mode="markers+text",
        text=texts,
        textposition="top center",
        name=_("optimum"),
        marker={"color": charts.ACCENT, "size": 12},
        showlegend=False,
    )
    figure.update_layout(
        barmode="overlay",
        xaxis_range=[-18, 118],
        yaxis_type="category",
        margin={"l": 220},
        height=_height(len(names)) + 40,
    )
    return {"optimum": figure}


def of_front(outcome: Front) -> dict[str, go.Figure]:
    """The front, and the inputs along it."""
    one, two = (outcome.cases.subject.output(p) for p in outcome.objectives)
    (x, title), (y, upward) = _scaled(one, outcome.column(one.path)), _scaled(two, outcome.column(two.path))
    figure = charts.figure(title, upward, title=_("Best compromises"))
    figure.add_scatter(
        x=x,
        y=y,
        mode="lines+markers",
        line={"color": charts.ACCENT, "width": 2},
        marker={"size": 8},
        showlegend=False,
    )
    made = {"front": figure}
    for v in outcome.inputs[:SHOWN]:
        along, upward = _scaled(v, outcome.column(v.path))
        made[v.path] = charts.figure(title, upward, title=v.label)
        made[v.path].add_scatter(
            x=x, y=along, mode="lines+markers", line={"color": charts.ACCENT}, showlegend=False
        )
    return made
