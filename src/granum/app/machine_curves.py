"""A figure of a piece of equipment alone over one of its settings or over what enters, a solution a point."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from granum.app.telling import Tell
from granum.cases.alone import case_text
from granum.cases.reading import read_text
from granum.cases.sizing import duty
from granum.core.errors import GranumError, unknown_name
from granum.core.i18n import _
from granum.core.parameters import Parameter
from granum.flowsheet.run import Line, Run
from granum.flowsheet.specifications import varied
from granum.reports.sensitivity import Curve, places, window

PATIENCE = 4.0  # seconds after which a chart that can be read gets no more points
LONGEST = 20.0  # seconds in which it must have come so far
FEWEST, MOST = 9, 31  # points of a chart
ENTERING = ("mass_flow", "solid_flow", "temperature")
NUDGE = 1.03  # a setting times this shows whether it matters


class Machine:
    """A piece of equipment alone, as ``words`` have it, solved.

    Parameters
    ----------
    key: its card. words: as of ``granum.alone``.
    """

    def __init__(self, key: str, words: Mapping[str, Any]):
        self.key, self.name = key, key.split(".", 1)[1]
        self.line: Line = read_text(case_text(key, words), name=key)
        self.run = self.line.solve()
        self.settings = dict(self._settings())
        self.figures = {p.name: p for p, value in self._told(self.run) if np.isfinite(value)}

    def _told(self, run: Run) -> Iterator[tuple[Parameter, float]]:
        for p, value in run.units[self.name].figures():
            if p.kind is not None and not p.series and value is not None and np.ndim(value) == 0:
                yield p, float(value)

    def _settings(self) -> Iterator[tuple[str, Parameter]]:
        """What may run, by the word that says it: numbers of the machine, and of the streams that enter."""
        sheet = self.line.sheet
        for p in sheet.units[self.name].card.parameters:
            value = getattr(sheet.units[self.name], p.name)
            single = p.kind is not None and not (p.series or p.law or p.choices) and p.sort is not int
            if single and value is not None and np.ndim(value) == 0:
                yield p.name, p
        for feed, stream in sheet.feeds.items():
            for word in ENTERING:
                if float(getattr(stream, word)) > 0.0:
                    p = varied(sheet, f"{feed}.{word}")
                    yield f"{feed}.{word}", Parameter(f"{p.name}_{feed}", p.kind)

    def _path(self, word: str) -> str:
        return word if "." in word else f"{self.name}.{word}"

    def at(self, word: str) -> float:
        """The present value of a setting."""
        head, _dot, rest = self._path(word).partition(".")
        sheet = self.line.sheet
        return float(getattr(sheet.feeds.get(head, sheet.units.get(head)), rest))

    def solved(self, word: str, value: float) -> Run | None:
        """The machine with another value of one setting; None where it has no answer."""
        with contextlib.suppress(GranumError):
            return self.line.with_values(**{self._path(word): value}).solve()
        return None

    def chosen(self, against: str, output: str) -> tuple[str, str]:
        """What to draw over what: as wanted, else by what it is sized, else the first that matter."""
        for what, name, known in (
            (_("Input"), against, self.settings),
            (_("Figure"), output, self.figures),
        ):
            if name and name not in known:
                raise unknown_name(what, name, known, _("for {owner}").format(owner=self.key))
        if against and output:
            return against, output
        with contextlib.suppress(GranumError):
            sized = duty(self.key)
            against, output = against or sized.setting, output or sized.figure
        trials = [against] if against in self.settings else list(self.settings)
        for word in trials:
            moved = self.solved(word, NUDGE * self.at(word))
            now = dict(self._told(self.run))
            other = {} if moved is None else {p.name: value for p, value in self._told(moved)}
            for p, value in now.items():
                differs = not np.isclose(other.get(p.name, value), value, rtol=1e-7, atol=0.0)
                if differs and output in ("", p.name) and p.name in self.figures:
                    return word, p.name
        first = next(iter(self.figures))
        return trials[0], output if output in self.figures else first

    def curve(self, against: str, output: str, tell: Tell | None = None) -> Curve | None:
        """A figure over a setting, with as many points as there is time for; None where these are too few."""
        p, at = self.settings[against], self.at(against)
        low, high, logarithmic = window(p, at)
        x = places(low, high, at, logarithmic, MOST)
        y, trusted = np.full(x.shape, np.nan), np.zeros(x.shape, dtype=bool)
        done: list[int] = []
        began = time.perf_counter()
        for i in refining(x.size, int(np.searchsorted(x, at))):
            run = self.solved(against, float(x[i]))
            if run is not None:
                y[i] = {q.name: value for q, value in self._told(run)}.get(output, np.nan)
                trusted[i] = all(check.ok for check in run.units[self.name].checks) and not run.flags
            done.append(i)
            if time.perf_counter() - began > (PATIENCE if len(done) >= FEWEST else LONGEST):
                break
            if tell is not None:
                tell(len(done) / x.size, _("drawing"))
        if len(done) < FEWEST:
            return None
        here = sorted(done)
        return Curve(p, self.figures[output], at, x[here], y[here], trusted[here], logarithmic)


def refining(count: int, first: int) -> list[int]:
    """Places of an axis, the present one first, then a few over all of it, then those between.

    >>> refining(9, 3)
    [3, 0, 7, 8, 1, 5, 2, 4, 6]
    """

    def rank(i: int) -> int:
        away = abs(i - first)
        return 0 if away % 4 == 0 or i in (0, count - 1) else 1 if away % 2 == 0 else 2

    return sorted(range(count), key=lambda i: (rank(i), abs(i - first)))
