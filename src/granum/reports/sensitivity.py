"""One result of a card against one of its inputs, over a range about the present value: numbers and chart."""

from __future__ import annotations

import contextlib
import math
import re
import time
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from granum.core import charts
from granum.core.errors import GranumError
from granum.core.flags import EXTRAPOLATED
from granum.core.i18n import _
from granum.core.kinds import Kind
from granum.core.parameters import Parameter
from granum.core.results import Result
from granum.core.units import format_number, from_si, pretty_unit

POINTS = 81
MOST_TRIED = 4  # results that are tried for a chart that says something
SINGLE = 31  # points of a card that takes one set of inputs at a time
QUICK = 0.02  # seconds that such a card may take for one of them
AROUND = 10.0  # times smaller and larger, where a quantity has no customary range
NARROW = 20.0  # ratio of the ends of a range up to which it is drawn on a linear axis
WIDE = 8.0  # ratio from which on it is drawn on a logarithmic one where the result is
STEEP = 30.0  # ratio of results from which on theirs is a logarithmic axis
TALL = 26  # characters that fit beside the height of the chart
COVERED = "rgba(11,110,110,0.08)"


class TooLong(Exception):
    """A calculation that is too long to be repeated for a chart."""


@dataclass(frozen=True)
class Curve:
    """A result over one input, in SI: ``y`` is NaN where there is none, ``trusted`` where every source covers
    what was calculated.
    """

    against: Parameter
    output: Parameter
    at: float
    x: np.ndarray
    y: np.ndarray
    trusted: np.ndarray
    logarithmic: bool

    @property
    def steep(self) -> bool:
        """Whether the result spans so much that its axis is logarithmic; that of a share never is."""
        good = self.y[np.isfinite(self.y)]
        bounded = self.output.kind is not None and self.output.kind.upper < math.inf
        return bool(not bounded and good.size and good.min() > 0.0 and good.max() > STEEP * good.min())

    @property
    def point(self) -> float:
        """The result for the present value."""
        return float(self.y[np.searchsorted(self.x, self.at)])

    def units(self, wanted: tuple[str, str]) -> tuple[str, str]:
        """Units for input and result: those wanted, else those that suit the present values."""
        return wanted[0] or self.against.display_unit(self.at), wanted[1] or self.output.display_unit(
            self.point
        )

    @property
    def idle(self) -> bool:
        """Whether it says nothing: the input does not matter, or is the result."""
        good = np.isfinite(self.y)
        if not good.any() or np.ptp(self.y[good]) <= 1e-9 * np.abs(self.y[good]).max():
            return True
        return self.against.kind == self.output.kind and bool(
            np.allclose(self.y[good], self.x[good], rtol=1e-9)
        )


def variable(result: Result) -> list[Parameter]:
    """The inputs that a chart can run over: single given numbers."""
    return [
        p
        for p in result.card.parameters
        if p.kind is not None
        and not p.series
        and not p.law
        and p.sort is not int
        and not p.choices
        and result.inputs[p.name] is not None
        and np.ndim(result.inputs[p.name]) == 0
    ]


def measured(result: Result) -> list[Parameter]:
    """The results that are single numbers."""
    return [p for p in result.card.outputs if p.kind is not None and np.ndim(result.outputs[p.name]) == 0]


def curve(thing: Any, result: Result, against: str = "", output: str = "") -> Curve | None:
    """A result over one of its inputs; without names the first pair that says something. None where there is
    nothing to draw, or where it would take long.
    """
    inputs, outputs = variable(result), measured(result)
    over = [p for p in inputs if p.name == against] or sorted(inputs, key=lambda p: not p.required)
    found = None
    with contextlib.suppress(TooLong):
        for wanted in [p for p in outputs if p.name == output] or outputs[:MOST_TRIED]:
            for p in over:
                tried = _over(thing, result, p, wanted)
                if tried is not None and (not tried.idle or (output and against)):
                    return tried
                found = found or tried
    return found


def _over(thing: Any, result: Result, p: Parameter, output: Parameter) -> Curve | None:
    at, count = float(result.inputs[p.name]), POINTS if takes_arrays(thing) else SINGLE
    given = {name: value for name, value in result.inputs.items() if value is not None}
    low, high, logarithmic = window(p, at)
    try:
        for ratios in (logarithmic, True):
            x = places(low, high, at, ratios, count)
            y, trusted = values_at(thing, given, p.name, x, output.name)
            found = Curve(p, output, at, x, y, trusted, ratios)
            if ratios or not (found.steep and high > WIDE * low > 0.0):
                break
    except GranumError:
        return None
    return found if np.isfinite(y).any() else None


def takes_arrays(thing: Any) -> bool:
    """Whether a card gives many results in one call; beside a series an array would be taken for another
    series.
    """
    return thing.card.sort == "formula" and not any(p.series for p in thing.card.parameters)


def values_at(
    thing: Any, given: dict[str, Any], name: str, x: np.ndarray, output: str
) -> tuple[np.ndarray, np.ndarray]:
    """A result for many values of one input, and where it is not extrapolated: in one call where the card
    takes arrays, else one by one while that is quick.
    """
    if takes_arrays(thing):
        with contextlib.suppress(TypeError):  # a card with points of its own takes one at a time
            found = thing.evaluate(**{**given, name: x})
            y = np.asarray(found.outputs[output], dtype=float)
            bits = np.broadcast_to(found.flags, x.shape)
            return np.broadcast_to(y, x.shape), (bits & EXTRAPOLATED) == 0
    y, trusted = np.full(x.shape, np.nan), np.zeros(x.shape, dtype=bool)
    start = time.perf_counter()
    for i, value in enumerate(x):
        with contextlib.suppress(GranumError):  # no value here: a gap
            one = thing.evaluate(**{**given, name: float(value)})
            y[i] = float(np.asarray(one.outputs[output], dtype=float))
            trusted[i] = not any(n["flag"] == "extrapolated" for n in one.notices)
        if time.perf_counter() - start > QUICK * SINGLE:
            raise TooLong
    return y, trusted


def places(low: float, high: float, at: float, ratios: bool, count: int) -> np.ndarray:
    """Where an input is looked at; the present value is one of the places."""
    spaced = np.geomspace if ratios else np.linspace
    return np.unique(np.append(spaced(low, high, count - 1), at))


def window(p: Parameter, at: float) -> tuple[float, float, bool]:
    """The ends of an axis about a value, and whether it is logarithmic."""
    kind = p.kind
    assert kind is not None
    low, high = p.ordinary()
    least, most = _inner_bounds(p, kind)
    ordinary = low <= at <= high and math.isfinite(low) and math.isfinite(high) and low < high
    positive = kind.lower >= 0.0 and at > 0.0 and kind.name != "temperature"
    if positive and not (ordinary and (low <= 0.0 or high <= NARROW * low)) and kind.upper == math.inf:
        return max(at / AROUND, least), min(at * AROUND, most), True
    if not ordinary:
        half = 40.0 if kind.name == "temperature" else max(abs(at) / 2.0, 0.1 * (high - low))
        low, high = at - half, at + half
    return max(low, least), min(high, most), False


def _inner_bounds(p: Parameter, kind: Kind) -> tuple[float, float]:
    """The hard bounds of an input, a little inside where they do not belong to it."""
    least = np.nextafter(kind.lower, math.inf) if kind.open_lower else kind.lower
    most = np.nextafter(kind.upper, -math.inf) if kind.open_upper else kind.upper
    return max(float(least), p.coldest if p.coldest is not None else -math.inf), float(most)


def chart(found: Curve, units: tuple[str, str] = ("", "")) -> Any:
    """The chart of a curve with its point, in units for input and result (those that suit where none are
    given).
    """
    against, output = found.against, found.output
    assert against.kind is not None
    assert output.kind is not None
    across, upward = found.units(units)
    steep = found.steep
    figure = charts.figure(
        _axis(against, across),
        _folded(_axis(output, upward)),
        x_log=found.logarithmic and from_si(found.x[0], across, against.kind) > 0.0,
        y_log=steep,
        showlegend=False,
    )
    figure.update_layout(height=300, margin={"l": 70, "r": 15, "t": 10, "b": 50})
    figure.update_yaxes(automargin=True)
    x = from_si(found.x, across, against.kind)
    for low, high in covered(found):
        figure.add_vrect(x0=float(x[low]), x1=float(x[high]), fillcolor=COVERED, line_width=0, layer="below")
    place = f"%{{x:.4~g}} {pretty_unit(across)}, %{{y:.4~g}} {pretty_unit(upward)}"
    hover = f"{place}<extra>%{{fullData.name}}</extra>"
    charts.add_line(figure, x, seen(found.y, output, upward, steep), output.label, hovertemplate=hover)
    if math.isfinite(found.point):
        charts.add_points(
            figure,
            [float(from_si(found.at, across, against.kind))],
            seen(np.asarray([found.point]), output, upward, steep),
            _("now"),
            color=charts.ACCENT,
            hovertemplate=hover,
            marker_size=11,
        )
    return figure


def _axis(p: Parameter, unit: str) -> str:
    known = p.term is not None and p.term.name == p.name
    return charts.axis_title(p.name, unit, None if known else p.label, p.own_symbol)


def _folded(title: str) -> str:
    """The title of an axis as high as a chart that stands beside a result, in two lines where it is long."""
    words = title.split(" ")
    if len(re.sub("<[^>]*>", "", title)) <= TALL:
        return title
    cut = max(i for i in range(1, len(words)) if len(" ".join(words[:i])) <= TALL or i == 1)
    return f"{' '.join(words[:cut])}<br>{' '.join(words[cut:])}"


def seen(y: np.ndarray, output: Parameter, unit: str, steep: bool) -> list[float | None]:
    """Results in a unit; a gap where there is none, or none that a logarithmic axis shows."""
    assert output.kind is not None
    shown = from_si(np.asarray(y, dtype=float), unit, output.kind)
    return [float(v) if math.isfinite(v) and (v > 0.0 or not steep) else None for v in shown]


def covered(found: Curve) -> Iterator[tuple[int, int]]:
    """First and last places of what the sources cover; none where they cover all of it or nothing."""
    inside = found.trusted & np.isfinite(found.y)
    if found.trusted.all() or not inside.any():
        return
    edges = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]]).astype(int)))
    yield from ((int(a), int(b) - 1) for a, b in edges.reshape(-1, 2))


def spoken(found: Curve, units: tuple[str, str] = ("", "")) -> str:
    """The chart in a sentence, for who cannot see it."""
    across, upward = found.units(units)

    def text(value: float, unit: str, p: Parameter) -> str:
        assert p.kind is not None
        return f"{format_number(float(from_si(value, unit, p.kind)))} {pretty_unit(unit)}".strip()

    good = np.flatnonzero(np.isfinite(found.y))
    low, high, at = (text(v, across, found.against) for v in (*map(float, found.x[good[[0, -1]]]), found.at))
    first, last, point = (
        text(v, upward, found.output) for v in (*map(float, found.y[good[[0, -1]]]), found.point)
    )
    return _("{output} from {first} at {low} to {last} at {high}; now {point} at {at}.").format(
        output=found.output.label, first=first, low=low, last=last, high=high, point=point, at=at
    )
