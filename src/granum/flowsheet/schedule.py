"""Batch units of a continuous line in time: their cycles side by side, and the tanks between them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from granum.core.i18n import _

# Figures or parameters that are phases of a cycle, in their order, with what a chart calls them.
PHASES = {
    "duration": "batch",
    "formation_time": "filling",
    "squeezing_time": "squeezing",
    "wash_time": "washing",
    "deliquoring_time": "draining",
    "freezing_time": "freezing",
    "drying_time_primary": "primary drying",
    "drying_time_secondary": "secondary drying",
    "drying_time": "drying",
    "dead_time": "emptying and cleaning",
}
MOST_CYCLES = 60


class Phase(NamedTuple):
    """One phase of a cycle, s."""

    name: str
    duration: float


class Cycle(NamedTuple):
    """The cycle of one batch unit: its phases and its length, s. ``use`` is the share of its capacity that
    the line needs, if it says so.
    """

    phases: tuple[Phase, ...]
    length: float
    use: float


class Schedule(NamedTuple):
    """Cycles by unit, in the order of the line. Units whose cycles differ need a tank between them that holds
    a batch.
    """

    cycles: dict[str, Cycle]

    def chart(self, span: float | None = None) -> Any:
        """Gantt chart over a span (three of the longest cycles by default), each unit starting as the one
        before it ends its first.
        """
        from granum.core.charts import figure

        longest = max((c.length for c in self.cycles.values()), default=1.0)
        span = span or 3.0 * longest
        chart = figure(_("time, h"), "", title=_("Cycles of the batch units"), barmode="overlay")
        start, rows = 0.0, {name: cycle for name, cycle in self.cycles.items() if cycle.length > 0}
        for phase in dict.fromkeys(p.name for c in rows.values() for p in c.phases):
            chart.add_bar(y=[], x=[], base=[], name=_(phase), orientation="h", legendgroup=phase)
        bars = {bar.legendgroup: ([], [], []) for bar in chart.data}
        for name, cycle in rows.items():
            for turn in range(min(math.ceil(span / cycle.length), MOST_CYCLES)):
                at = start + turn * cycle.length
                for phase in cycle.phases:
                    for column, value in zip(
                        bars[phase.name], (name, phase.duration / 3600.0, at / 3600.0), strict=True
                    ):
                        column.append(value)
                    at += phase.duration
            start += cycle.length
        for bar in chart.data:
            bar.y, bar.x, bar.base = bars[bar.legendgroup]
        chart.update_yaxes(type="category", autorange="reversed", automargin=True)
        return chart


def schedule(units: Mapping[str, tuple[Any, Any]]) -> Schedule:
    """The cycles of the units that have a dead time, from their parameters and figures: ``{name: (unit,
    figures)}``.
    """
    cycles = {}
    for name, (unit, figures) in units.items():
        if not hasattr(unit, "dead_time"):
            continue
        phases = []
        for field, word in PHASES.items():
            value = getattr(figures, field, getattr(unit, field, None))
            if value is not None and float(value) > 0.0:
                phases.append(Phase(word, float(value)))
        length = float(getattr(figures, "cycle_time", sum(p.duration for p in phases)))
        cycles[name] = Cycle(tuple(phases), length, float(getattr(figures, "capacity_use", float("nan"))))
    return Schedule(cycles)
