"""Charts of what happens inside equipment: curves along it or over its time, and where each size goes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from typing import Any, Literal, NamedTuple

import numpy as np

from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.streams.stream import Stream

NARROW = 0.17  # of the axis across, below which a name runs into the next one
LETTER = 0.014  # of the axis, what a letter of a name takes at most
LINE = 0.075  # of the height of a chart
EVEN = 1e-3  # difference of shares below which a machine parts nothing by size
RARE = 1e-6  # share of the solid below which a class tells nothing


class Axis(NamedTuple):
    """What an axis shows: a word of the glossary, its kind, its unit (None: one that suits), and what it is
    called where the word says too much; whether it begins at nothing, and counts powers of ten.
    """

    word: str
    kind: str
    unit: str | None = None
    label: str | None = None
    zero: bool = True
    log: bool = False


class Mark(NamedTuple):
    """A place on the axis across and on the left one by its name, in SI: where a machine works."""

    name: str
    x: Any
    y: Any


class Curve(NamedTuple):
    """A line by its name, in SI; its color that of the charts for a phase."""

    name: str
    values: Any
    color: Literal["SOLID", "LIQUID", "GAS", "HEAT", "ACCENT"]
    dash: str = "solid"


def shade(drawing: Any, clock: Sequence[float], names: Iterable[str]) -> float:
    """Stages shaded and named between the edges ``clock``; the height that the upright axis needs over that
    of its curves so that the names stand above them.
    """
    from granum.core.charts import ACCENT, INK, LIQUID, SOLID

    called, row = tuple(names), 0
    narrow = any(
        stop - start < max(NARROW, LETTER * len(name)) * clock[-1]
        for (start, stop), name in zip(pairwise(clock), called, strict=True)
    )
    rows = len(called) if narrow else 1
    for i, ((start, stop), name) in enumerate(zip(pairwise(clock), called, strict=True)):
        color = (SOLID, LIQUID, ACCENT, INK)[i % 4]
        drawing.add_vrect(x0=start, x1=stop, fillcolor=color, opacity=0.06, line_width=0)
        late = start > 0.4 * clock[-1]
        drawing.add_annotation(
            x=stop if late else start,
            y=0.99 - LINE * row,
            yref="paper",
            text=name,
            showarrow=False,
            xanchor="right" if late else "left",
            yanchor="top",
            font={"size": 11},
        )
        row += narrow
    return 1.0 / (1.0 - LINE * rows - 0.03)


def drawn_along(
    across: Axis,
    x: Any,
    left: tuple[Axis, Sequence[Curve]],
    right: tuple[Axis, Sequence[Curve]] | None = None,
    stages: tuple[Sequence[float], Sequence[str]] | None = None,
    marks: Sequence[Mark] = (),
    **look: Any,
) -> Any:
    """Curves over ``x`` with one or two upright axes; ``stages`` are edges (SI) and names. ``look`` is that
    of the lines.
    """
    from granum.core import charts
    from granum.core.glossary import glossary
    from granum.core.units import best_unit, from_si

    def unit(axis: Axis, values: Any) -> str:
        if axis.unit is not None:
            return axis.unit
        kind, usual = KINDS[axis.kind], glossary()[axis.word].unit if axis.word in glossary() else None
        if usual and usual not in kind.units:  # of this quantity alone, as the flux of a membrane has one
            return usual
        sizes = np.abs(np.asarray(values, dtype=float))
        return best_unit(float((np.nanmedian if axis.log else np.nanmax)(sizes)), kind)

    def shown(axis: Axis, values: Any, in_unit: str) -> np.ndarray:
        return np.asarray(from_si(np.asarray(values, dtype=float), in_unit, KINDS[axis.kind]))

    def titled(axis: Axis, in_unit: str) -> str:
        return charts.axis_title(axis.word, in_unit, axis.label)

    x_unit = unit(across, x)
    over = shown(across, x, x_unit)
    sides = [
        (axis, curves, unit(axis, np.concatenate([np.ravel(c.values) for c in curves])))
        for axis, curves in (left, *(() if right is None else (right,)))
    ]
    drawing = charts.figure(titled(across, x_unit), titled(sides[0][0], sides[0][2]), x_log=across.log)
    room = 1.05 if stages is None else shade(drawing, list(shown(across, stages[0], x_unit)), stages[1])
    for number, (axis, curves, in_unit) in enumerate(sides):
        most, least = -np.inf, np.inf
        for curve in curves:
            y = shown(axis, curve.values, in_unit)
            most, least = max(most, float(np.nanmax(y))), min(least, float(np.nanmin(y)))
            charts.add_line(drawing, over, y, curve.name, color=getattr(charts, curve.color), dash=curve.dash)
            drawing.data[-1].update(look | ({"yaxis": "y2"} if number else {}))
        if axis.zero:
            reach = [0.0, (most or 1.0) * room]
        else:
            spread = most - least or 1.0
            reach = [least - 0.05 * spread, least + spread * room + 0.05 * spread]
        if number:
            charts.add_right_axis(drawing, titled(axis, in_unit), range=reach)
        else:
            drawing.update_yaxes(range=reach)
    for number, mark in enumerate(marks):
        at = float(shown(across, mark.x, x_unit)), float(shown(left[0], mark.y, sides[0][2]))
        charts.add_points(drawing, [at[0]], [at[1]], mark.name, color=charts.INK, hollow=number > 0)
    drawing.update_layout(
        legend={"orientation": "h", "y": -0.2, "x": 0.0}, margin={"r": 25 if right is None else 75, "b": 100}
    )
    return drawing


def drawn_grade(sizes: Any, share: Any, marks: Sequence[Mark] = (), across: str = "particle_diameter") -> Any:
    """Share of each size that a machine catches, over the size."""
    drawing = drawn_along(
        Axis(across, "Length", log=True),
        sizes,
        (
            Axis("grade_efficiency", "Fraction", "percent", _("share by mass")),
            [Curve(_("caught of each size"), share, "SOLID")],
        ),
        marks=marks,
    )
    drawing.update_yaxes(range=[0.0, 102.0])
    return drawing


def shares_by_size(
    inlets: Mapping[str, Stream], outlets: Mapping[str, Stream]
) -> dict[str, np.ndarray] | None:
    """Share of each size class of what enters that leaves by each outlet (no number where hardly any enters);
    None where one outlet takes the solid, sizes change inside, or every size is parted alike.
    """
    entering = [s for s in inlets.values() if float(s.solid_flow) > 0.0]
    if not entering or len(entering[0].mixture.sizes) < 2:
        return None
    fed = np.sum([np.asarray(s.solid_by_size, dtype=float) for s in entering], axis=0)
    leaving = {n: np.asarray(s.solid_by_size, dtype=float) for n, s in outlets.items()}
    if any(by.shape != fed.shape for by in leaving.values()):
        return None
    kept = np.abs(np.sum(list(leaving.values()), axis=0) - fed) <= RARE * fed.sum()
    some = fed > RARE * fed.sum()
    if not np.all(kept) or np.count_nonzero(some) < 2:
        return None
    found = {n: np.where(some, by / np.where(some, fed, 1.0), np.nan) for n, by in leaving.items()}
    found = {n: share for n, share in found.items() if np.nanmax(share) > EVEN}
    spread = max((float(np.nanmax(x) - np.nanmin(x)) for x in found.values()), default=0.0)
    return found if len(found) > 1 and spread > EVEN else None


def drawn_shares(inlets: Mapping[str, Stream], outlets: Mapping[str, Stream]) -> Any:
    """Where each size goes: the share that leaves by each outlet, over the size; None where sizes do not
    part.
    """
    from granum.core.charts import LINES, add_line, axis_title, figure
    from granum.core.units import best_unit, from_si
    from granum.streams.names import port_label

    shares = shares_by_size(inlets, outlets)
    if shares is None:
        return None
    mixture = next(iter(outlets.values())).mixture
    some = np.isfinite(next(iter(shares.values())))
    sizes = mixture.sizes[some]
    unit = best_unit(float(np.median(sizes)), KINDS["Length"])
    drawing = figure(axis_title("particle_diameter", unit), _("share of each size / %"), x_log=True)
    for color, (name, share) in zip(LINES, shares.items(), strict=False):
        across = np.asarray(from_si(sizes, unit, KINDS["Length"]))
        add_line(drawing, across, 100.0 * share[some], port_label(name), color=color)
    drawing.update_yaxes(range=[0.0, 102.0])
    drawing.update_layout(legend={"orientation": "h", "y": -0.2, "x": 0.0}, margin={"b": 100})
    return drawing
