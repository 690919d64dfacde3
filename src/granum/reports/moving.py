"""Figures with sliders. One is declared once, by its sliders and the function that draws it; the
documentation draws it at every position beforehand, the app where a slider stands.
"""

from __future__ import annotations

import re
from base64 import b64decode
from collections.abc import Callable, Mapping
from itertools import product
from math import isfinite
from typing import Any, NamedTuple

import numpy as np
import plotly.graph_objects as go

from granum.core.charts import axis_title
from granum.core.errors import InputError
from granum.core.glossary import glossary
from granum.core.i18n import _, current_language
from granum.core.parameters import Parameter
from granum.core.units import format_number

DIGITS = 4  # of a coordinate
JUMP, LEAST = 2.0, 0.02  # a step of a line, over those before and after it, and over its height


class Slider(NamedTuple):
    """An input that slides: a word of the glossary, its unit, its range in that unit and where it starts."""

    name: str
    unit: str
    low: float
    high: float
    start: float
    steps: int = 15
    log: bool = False

    @property
    def label(self) -> str:
        """What stands before it."""
        known = self.name in glossary()  # otherwise a word with an ending, as temperature_inlet
        return axis_title(self.name, self.unit, None if known else Parameter(self.name).label)

    def positions(self) -> list[float]:
        """Where it stops, with the start in place of the stop that is nearest to it."""
        stops = (np.geomspace if self.log else np.linspace)(self.low, self.high, self.steps)
        found = [float(f"{stop:.3g}") for stop in stops]
        nearest = min(range(self.steps), key=lambda i: abs(stops[i] - self.start))
        found[nearest] = self.start
        return found

    def checked(self, value: Any) -> float:
        """A value asked for, if it lies in the range."""
        number = float(value) if isinstance(value, int | float) else float("nan")
        if isfinite(number) and self.low <= number <= self.high:
            return number
        raise InputError(
            _("{name} = {value}: this figure is drawn for numbers from {low} to {high}.").format(
                name=re.sub("<.*?>", "", self.label),
                value=value,
                low=format_number(self.low),
                high=format_number(self.high),
            )
        )


class MovingFigure(NamedTuple):
    """The sliders, and what draws the figure from their values, each a text with its unit."""

    sliders: tuple[Slider, ...]
    draw: Callable[..., go.Figure]

    def at(self, values: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """The figure at some values, as Plotly takes it; what is not given stands at its start."""
        given = dict(values or {})
        if odd := set(given) - {slider.name for slider in self.sliders}:
            raise InputError(
                _("'{name}' does not slide in this figure; these do: {known}.").format(
                    name=min(odd), known=", ".join(slider.name for slider in self.sliders)
                )
            )
        texts = {
            s.name: f"{s.checked(given.get(s.name, s.start)):.6g} {s.unit}".strip() for s in self.sliders
        }
        drawn = self.draw(**texts)
        drawn.update_layout(title=None)
        if current_language() == "fr":
            drawn.update_layout(separators=",\u202f")
        return _plain(drawn.to_plotly_json())

    def told(self) -> list[dict[str, Any]]:
        """The sliders for a page."""
        return [
            {"name": s.name, "label": s.label, "positions": s.positions(), "at": s.positions().index(s.start)}
            | {"low": s.low, "high": s.high, "start": s.start, "log": s.log}
            | {"shown": [format_number(x, 3) for x in s.positions()]}
            for s in self.sliders
        ]

    def frames(self) -> dict[str, Any]:
        """The figure at the start, and what differs from it at each combination of positions, the last slider
        fastest.
        """
        first = self.at()
        stops = [slider.positions() for slider in self.sliders]
        names = [slider.name for slider in self.sliders]
        drawn = (self.at(dict(zip(names, chosen, strict=True))) for chosen in product(*stops))
        return first | {"sliders": self.told(), "frames": [_difference(first, other) for other in drawn]}


def thin(drawn: go.Figure, points: int) -> None:
    """Lines with fewer points, even on their axis: a page carries them many times. Their ends stay, and both
    sides of a jump.
    """
    spaced = np.geomspace if drawn.layout.xaxis.type == "log" else np.linspace
    for trace in drawn.data:
        if trace.mode == "lines" and len(trace.x) > points:
            x, y = np.asarray(trace.x), np.asarray(trace.y)
            kept = np.abs(x[:, None] - spaced(x[0], x[-1], points)).argmin(axis=0)
            step = np.pad(np.abs(np.diff(y)), 1)
            at, around = step[1:-1], np.maximum(step[:-2], step[2:])
            jumps = np.flatnonzero((at > JUMP * around) & (at > LEAST * np.ptp(y)))
            kept = np.unique(np.concatenate([kept, jumps, jumps + 1]))
            trace.x, trace.y = x[kept], y[kept]


def _plain(part: Any) -> Any:
    """A figure in lists and rounded numbers; JSON has no number for what is not finite."""
    if isinstance(part, dict) and "bdata" in part:  # as Plotly packs an array
        return _plain(np.frombuffer(b64decode(part["bdata"]), dtype=part["dtype"]))
    if isinstance(part, dict):
        return {key: _plain(value) for key, value in part.items()}
    if isinstance(part, np.ndarray | list | tuple):
        return [_plain(value) for value in part]
    if isinstance(part, float | np.floating):
        return float(f"{part:.{DIGITS}g}") if isfinite(part) else None
    return int(part) if isinstance(part, np.integer) else part


def _difference(first: dict[str, Any], other: dict[str, Any]) -> dict[str, Any]:
    """What of the traces, by number, and of the layout is not as at the start."""
    if len(first["data"]) != len(other["data"]):
        raise ValueError("a figure that moves keeps its number of traces")
    changed = {
        i: {key: value for key, value in after.items() if before.get(key) != value}
        for i, (before, after) in enumerate(zip(first["data"], other["data"], strict=True))
    }
    layout = {key: value for key, value in other["layout"].items() if first["layout"].get(key) != value}
    return {"data": {i: part for i, part in changed.items() if part}, "layout": layout}
