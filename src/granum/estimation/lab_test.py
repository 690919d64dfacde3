"""``LabTest``: the base of every lab test; reads its data, checks it, fits and charts."""

from __future__ import annotations

import abc
import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, ClassVar, Self

import equinox as eqx
import jax
import numpy as np

from granum.core.cards import Card
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import kind_of
from granum.core.parameters import default_as_json
from granum.estimation.design import next_experiment
from granum.estimation.least_squares import fit, judge
from granum.estimation.results import Fit
from granum.estimation.tables import Source, read_table
from granum.estimation.verdicts import Rows, note

if TYPE_CHECKING:
    import plotly.graph_objects as go


class LabTest(eqx.Module):
    """A laboratory test: columns measured under conditions, from which parameters are estimated.

    Class variables: ``estimates`` (kinds of the parameters by name), ``least_points``, ``for_two_points``,
    ``axes`` (kinds of what is fitted against what, by glossary word, for the chart), and ``holds_for``:
    columns and conditions outside whose range the estimates are extrapolated.
    """

    card: ClassVar[Card]
    estimates: ClassVar[Mapping[str, Any]]
    axes: ClassVar[Mapping[str, Any]]
    least_points: ClassVar[int] = 3
    for_two_points: ClassVar[str] = ""  # key of the formula for a test of two readings
    rest: ClassVar[tuple[str, str, str] | None] = None  # of `read_table`
    holds_for: ClassVar[tuple[str, ...]] = ()
    origins: tuple[tuple[str, str], ...] = eqx.field(
        default=(), init=False, static=True, repr=False, kw_only=True
    )
    """Conditions that a stated ``fluid`` gave, each with what it says of itself."""
    of_fluid: tuple[str, ...] = eqx.field(default=(), init=False, static=True, repr=False, kw_only=True)
    """What was flagged of a stated ``fluid``, such as a temperature outside its data, as JSON."""

    @classmethod
    def read(cls, path: Source, **conditions: Any) -> Self:
        """The test from a data file (CSV, TSV, XLSX) and its conditions, both in any unit.

        The header of the file names columns with units in any order: ``time [min],filtrate_volume [L]``.
        """
        columns = [p for p in cls.card.parameters if p.series]
        return cls(**{**read_table(path, columns, cls.rest), **conditions})

    def __check_init__(self) -> None:
        card = type(self).card
        lengths = {
            p.name: len(value)
            for p in card.parameters
            if p.series and (value := getattr(self, p.name)) is not None
        }
        if lengths and min(lengths.values()) < self.least_points:
            message = _("{card} needs at least {least} points; {given} were given.").format(
                card=card.key, least=self.least_points, given=min(lengths.values())
            )
            if min(lengths.values()) == 2 and self.for_two_points:
                message += " " + _("Two readings lie on one line: '{card}' gives it.").format(
                    card=self.for_two_points
                )
            raise InputError(message)
        for name in lengths:
            values = np.asarray(getattr(self, name), dtype=float)
            if not np.all(np.isfinite(values)):
                raise self.bad_row(
                    name,
                    ~np.isfinite(values),
                    _("'{name}' must be a number in every row: row {number} has {value}."),
                )

    @abc.abstractmethod
    def fit(self) -> Fit:
        """Estimate the parameters."""

    def fitted(
        self,
        model: Callable[[dict[str, Any], Any], Any],
        start: Mapping[str, float],
        x: Any,
        y: Any,
        *,
        kinds: Mapping[str, Any] | None = None,
        index: Any = None,
        **options: Any,
    ) -> Fit:
        """``granum.estimation.fit`` with the card, the kinds, the rows and the defaults of this class filled
        in.

        ``index`` is the row of the data from which each point was computed, needed where some rows gave none
        or points are in another order.
        """
        kinds = {**self.estimates, **(kinds or {})}
        found = fit(
            model, start, x, y, card=type(self).card.key, kinds=kinds, rows=self.rows(x, y, index), **options
        )
        return replace(
            found,
            defaults=self.defaults(),
            ranges=self.ranges(),
            origins=self.stated(),
            flags=[*map(json.loads, self.of_fluid), *found.flags],
        )

    def next_measurement(self, found: Fit, steps: int = 41) -> dict[str, Any]:
        """Where in the measured range one more reading tells most, SI: ``{"at", "shrinkage",
        "standard_errors"}``. Of a series of tests that is the next test.
        """
        name, kind = next(iter(self.axes.items()))
        problem, given = found.problem, getattr(self, name, None)
        several = InputError(
            _(
                "Where the next measurement tells most is known of tests whose readings stand over one "
                "column; '{card}' computes its places from several."
            ).format(card=type(self).card.key)
        )
        measured = np.empty(0) if given is None else np.asarray(given, dtype=float)
        plain = np.ndim(problem.x) == 1 and np.shape(problem.x) == np.shape(measured)
        if not plain or not np.allclose(np.sort(problem.x), np.sort(measured), rtol=1e-9):
            raise several
        order = np.argsort(problem.x)
        grid, unit = np.linspace(np.min(measured), np.max(measured), steps), kind_of(kind)
        # readings scatter there as those around it
        scatter = np.interp(
            grid, np.asarray(problem.x)[order], np.asarray(problem.sigma)[: len(order)][order]
        )
        try:
            told = next_experiment(found, grid, found.statistics["residual_standard_deviation"] * scatter)
        except (TypeError, ValueError) as problem_of_shapes:  # a model that holds other columns of each row
            raise several from problem_of_shapes
        return {
            "at": {name: {"value": float(grid[told.best]), "unit": unit.unit if unit else ""}},
            "shrinkage": float(told.shrinkage[told.best]),
            "standard_errors": told.standard_errors,
        }

    def judged(self, found: Fit, trials: int) -> Fit:
        """The best of several models with its diagnostics (fit them with ``judged=False``)."""
        return judge(found, self.rows(found.problem.x, found.problem.y), trials)

    def rows(self, x: Any, y: Any, index: Any = None) -> Rows:
        """The rows of the data behind the points of a fit: as given, or one for one where nothing speaks
        against it.
        """
        columns = [
            (p, np.asarray(value))
            for p in type(self).card.parameters
            if p.series and (value := getattr(self, p.name)) is not None
        ]
        count, points = len(columns[0][1]), sum(np.size(part) for part in jax.tree.leaves(y))
        if index is not None:
            return Rows(columns, np.resize(np.asarray(index), points))
        if points % count or (
            np.size(x) == count and not any(_same_order(np.ravel(x), values) for _p, values in columns)
        ):
            return Rows()
        return Rows(columns, np.arange(points) % count)

    def defaults(self) -> dict[str, Any]:
        """Conditions and choices that stand at their defaults, as plain data."""
        found = {}
        for p in type(self).card.parameters:
            if not (p.series or p.required or p.default is None):
                value = default_as_json(getattr(self, p.name))
                if value == default_as_json(p.default):
                    found[p.name] = value
        return found

    def stated(self) -> dict[str, tuple[float, str]]:
        """Conditions that a fluid gave, SI, and which fluid it was."""
        return {name: (float(getattr(self, name)), origin) for name, origin in self.origins}

    def ranges(self) -> dict[str, tuple[float, float]]:
        """What the estimates hold for: lowest and highest value of the columns and conditions that matter."""
        given = {
            n: np.asarray(value, dtype=float)
            for n in self.holds_for
            if (value := getattr(self, n)) is not None
        }
        return {n: (float(values.min()), float(values.max())) for n, values in given.items()}

    def note(self, word: str, message: str, name: str = "") -> dict[str, Any]:
        """A flag of this test: a short word and a sentence in the current language."""
        return note(word, message, type(self).card.key, name)

    def bad_row(self, name: str, bad: Any, sentence: str) -> InputError:
        """The error of the first bad row of a column; the sentence has room for its name, row and value."""
        at = int(np.argmax(bad))
        value = float(np.asarray(getattr(self, name), dtype=float)[at])
        return InputError(
            sentence.format(name=name, number=at + 1, value=f"{value:g}"), name=name, row=at + 1
        )

    def above_zero(self, *names: str) -> None:
        """Raise one clear error when a column holds a zero or less: it enters a logarithm or a quotient."""
        for name in names:
            bad = np.asarray(getattr(self, name), dtype=float) <= 0.0
            if bad.any():
                raise self.bad_row(
                    name,
                    bad,
                    _(
                        "'{name}' must be greater than zero in every row: row {number} has {value}; "
                        "leave such rows out."
                    ),
                )

    def increasing(self, name: str, *, strictly: bool = True) -> None:
        """Raise one clear error when a column does not increase from point to point."""
        values = np.asarray(getattr(self, name))
        step = np.diff(values)
        bad = step <= 0 if strictly else step < 0
        if bad.any():
            at = int(np.argmax(bad))
            raise InputError(
                _(
                    "'{name}' must increase from point to point: point {number} has {value} after {before}."
                ).format(name=name, number=at + 2, value=f"{values[at + 1]:g}", before=f"{values[at]:g}"),
                name=name,
            )

    def chart(self) -> go.Figure:
        """The points, hollow where excluded, with the fitted line and its 95 % band; residuals under
        them.
        """
        from granum.core.charts import (
            add_band,
            add_line,
            add_points,
            add_residuals,
            axis_title,
            figure,
        )
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
        add_residuals(drawing, across(x), upward(found.residuals) - upward(0.0), kept, unit)
        return drawing


def _same_order(one: np.ndarray, other: np.ndarray) -> bool:
    return bool(np.array_equal(np.argsort(one, kind="stable"), np.argsort(other, kind="stable")))
