"""``LabTest``: the base of every lab test; reads its data, checks it, fits and charts."""

from __future__ import annotations

import abc
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Self

import equinox as eqx
import numpy as np

from granum.core.cards import Card
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.estimation.least_squares import fit, note
from granum.estimation.results import Fit
from granum.estimation.tables import Source, read_table

if TYPE_CHECKING:
    import plotly.graph_objects as go


class LabTest(eqx.Module):
    """A laboratory test: columns measured under conditions, from which parameters are estimated.

    Class variables: ``estimates`` (kinds of the parameters by name), ``least_points``, and ``axes`` (kinds of what is fitted
    against what, by glossary word, for the chart).
    """

    card: ClassVar[Card]
    estimates: ClassVar[Mapping[str, Any]]
    axes: ClassVar[Mapping[str, Any]]
    least_points: ClassVar[int] = 3

    @classmethod
    def read(cls, path: Source, **conditions: Any) -> Self:
        """The test from a data file (CSV, TSV, XLSX) and its conditions, both in any unit.

        The header of the file names columns with units in any order: ``time [min],filtrate_volume [L]``.
        """
        columns = [p for p in cls.card.parameters if p.series]
        return cls(**read_table(path, columns), **conditions)

    def __check_init__(self) -> None:
        card = type(self).card
        lengths = {p.name: len(value) for p in card.parameters if p.series and (value := getattr(self, p.name)) is not None}
        if len(set(lengths.values())) > 1:
            shown = ", ".join(f"{name} ({count})" for name, count in lengths.items())
            raise InputError(_("The columns have unequal lengths: {columns}.").format(columns=shown))
        if lengths and min(lengths.values()) < self.least_points:
            raise InputError(
                _("{card} needs at least {least} points; {given} were given.").format(
                    card=card.key, least=self.least_points, given=min(lengths.values())
                )
            )

    @abc.abstractmethod
    def fit(self) -> Fit:
        """Estimate the parameters."""

    def fitted(self, model: Callable[[dict[str, Any], Any], Any], start: Mapping[str, float], x: Any, y: Any, *,
               kinds: Mapping[str, Any] | None = None, **options: Any) -> Fit:  # fmt: skip
        """``granum.estimation.fit`` with the card and the kinds of this class filled in."""
        return fit(model, start, x, y, card=type(self).card.key, kinds={**self.estimates, **(kinds or {})}, **options)

    def note(self, word: str, message: str, name: str = "") -> dict[str, Any]:
        """A flag of this test: a short word and a sentence in the current language."""
        return note(word, message, type(self).card.key, name)

    def increasing(self, name: str, *, strictly: bool = True) -> None:
        """Raise one clear error when a column does not increase from point to point."""
        values = np.asarray(getattr(self, name))
        step = np.diff(values)
        bad = step <= 0 if strictly else step < 0
        if bad.any():
            at = int(np.argmax(bad))
            raise InputError(
                _("'{name}' must increase from point to point: point {number} has {value} after {before}.").format(
                    name=name, number=at + 2, value=f"{values[at + 1]:g}", before=f"{values[at]:g}"
                ),
                name=name,
            )

    def chart(self) -> go.Figure:
        """The points, hollow where excluded, with the fitted line and its 95 % band."""
        from granum.core.charts import add_band, add_line, add_points, axis_title, figure
        from granum.core.kinds import kind_of
        from granum.core.units import best_unit, from_si

        found = self.fit()
        x, y, kept = np.asarray(found.problem.x), found.problem.y, found.kept
        grid = np.linspace(min(0.0, x.min()), 1.03 * x.max(), 200)
        band = found.predict(grid)
        titles, show = [], []
        for values, (name, annotation) in zip((x, y), self.axes.items(), strict=True):
            kind = kind_of(annotation)
            assert kind is not None
            unit = best_unit(float(np.median(np.abs(values))), kind)
            titles.append(axis_title(name, unit))
            show.append(lambda v, unit=unit, kind=kind: from_si(np.asarray(v), unit, kind))
        across, upward = show
        drawing = figure(*titles, title=type(self).card.title)
        add_band(drawing, across(grid), upward(band.low), upward(band.high), _("95 % band"))
        add_line(drawing, across(grid), upward(band.value), _("model"))
        add_points(drawing, across(x[kept]), upward(y[kept]), _("data"))
        if not kept.all():
            add_points(drawing, across(x[~kept]), upward(y[~kept]), _("excluded"), hollow=True)
        return drawing
