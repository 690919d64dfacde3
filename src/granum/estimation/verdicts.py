"""What a fit says about itself in words: stray points, parameters that the data do not determine, data that
show no relation.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from granum.core.i18n import _
from granum.core.kinds import kind_of
from granum.core.parameters import Parameter
from granum.core.units import format_number, from_si, pretty_unit

if TYPE_CHECKING:
    from granum.estimation.diagnostics import Diagnostics
    from granum.estimation.least_squares import Problem
    from granum.estimation.results import Estimate, Fit

COLLINEAR = 100.0
"""Condition of the Jacobian with columns of unit length; 30 to 100 is strong collinearity (Belsley, Kuh and
Welsch 1980).
"""
LEAST_CHANCE, CHANCE = 1e-3, {1: 0.02, 2: 0.005}
"""Probability by chance above which data show no relation; with one or two points to spare not even a good
line reaches one in a thousand.
"""
LEAST_SHARE = 0.5
"""Part of the scatter that a law must explain to be called a relation."""
LEAST_EFFECT = 0.005
"""A stray point that moves no estimate by this part is not worth a sentence."""
SHOWN = 2


def note(word: str, message: str, card: str, name: str = "") -> dict[str, Any]:
    """One flag of a fit: a short word and a sentence."""
    return {"flag": word, "name": name, "card": card, "message": message}


@dataclass(frozen=True)
class Rows:
    """The rows of the data, so that a point can be named: ``index`` is the row of each point, ``columns``
    what was measured.

    A point of no row has the index -1 and is called ``elsewhere``.
    """

    columns: Sequence[tuple[Parameter, np.ndarray]] = ()
    index: np.ndarray | None = None
    elsewhere: str = ""

    def name(self, point: int) -> str:
        """A point in words: its row and what was measured there."""
        if self.index is None or not self.columns:
            return _("Point {number}").format(number=point + 1)
        row = int(self.index[point])
        if row < 0:
            return self.elsewhere
        cells = "; ".join(f"{p.label} {_shown(float(values[row]), p, values)}" for p, values in self.columns)
        return _("Row {number} ({cells})").format(number=row + 1, cells=cells)


def _shown(value: float, p: Parameter, values: Any) -> str:
    if p.kind is None:
        return format_number(value)
    unit = p.display_unit(values)
    return f"{format_number(float(from_si(value, unit, p.kind)))} {pretty_unit(unit)}".strip()


def stray_note(found: Diagnostics, fit: Fit, rows: Rows, least: float = LEAST_EFFECT) -> list[dict[str, Any]]:
    """Which points do not fit with the others, what they do to the estimates, and what to do."""
    if not found.stray:
        return []
    estimates = {**fit.derived, **fit.parameters}
    values = {n: estimates[n].value for n in found.without}
    parameters = {n: Parameter(n, kind_of(fit.problem.kinds.get(n))) for n in values}
    change = {n: _change(values[n], found.without[n]) for n in values}
    if not change or max(map(abs, change.values())) < least:
        return []
    told = sorted(change, key=lambda n: -abs(change[n]))[:SHOWN]

    def text(name: str, value: float) -> str:
        return _shown(value, parameters[name], value)

    effects = "; ".join(
        _("{label} would be {new} instead of {old} ({change} %)").format(
            label=parameters[n].label,
            new=text(n, found.without[n]),
            old=text(n, values[n]),
            change=_signed(100.0 * change[n]),
        )
        for n in told
    )
    robust = "; ".join(
        f"{parameters[n].label} = {text(n, found.robust[n])}" for n in told if n in found.robust
    )
    names = " · ".join(rows.name(k) for k in found.stray)
    far = ", ".join(format_number(abs(d), 2) for d in found.deviations)
    if len(found.stray) == 1:
        sentence = _(
            "{points} does not fit with the others: it lies {far} standard deviations off. Without it "
            "{effects}."
        )
    else:
        sentence = _(
            "{points} do not fit with the others: they lie {far} standard deviations off. Without them "
            "{effects}."
        )
    sentence = sentence.format(points=names, far=far, effects=effects)
    if robust:
        sentence += " " + _("A robust fit to all points gives {robust}.").format(robust=robust)
    sentence += " " + _("Check the reading; leave it out if it is wrong.")
    return [note("stray point", sentence, fit.card, told[0])]


def _change(old: float, new: float) -> float:
    return (new - old) / max(abs(old), 1e-300) if np.isfinite(new) else 0.0


def _signed(percent: float) -> str:
    return ("+" if percent > 0 else "−") + format_number(abs(percent), 2 if abs(percent) < 1000 else 1)


def no_relation_note(fit: Fit, probability: float, trials: int = 1) -> list[dict[str, Any]]:
    """Whether the data show the fitted relation at all; ``trials`` is the number of models from which this
    was chosen.
    """
    r_squared, chance = fit.statistics["r_squared"], min(trials * probability, 1.0)
    allowed = CHANCE.get(int(fit.statistics["degrees_of_freedom"]), LEAST_CHANCE)
    if not np.isfinite(probability) or (chance <= allowed and not r_squared < LEAST_SHARE):
        return []
    sentence = _(
        "These points hardly show the fitted relation: it explains {share} % of their scatter, and "
        "points without any relation do as well "
        "in {chance} % of cases. Do not use the estimates without more or better data."
    ).format(
        share=format_number(100.0 * r_squared if r_squared > 0.0 else 0.0, 2),
        chance=format_number(100.0 * chance, 2),
    )
    return [note("no relation", sentence, fit.card)]


def parameter_notes(
    estimates: Mapping[str, Estimate],
    covariance: np.ndarray,
    held: Mapping[str, float],
    condition: float,
    problem: Problem,
    card: str,
) -> list[dict[str, Any]]:
    """Parameters at a bound, hardly told apart, or no different from zero."""
    found = []
    known = {name: Parameter(name, kind_of(problem.kinds.get(name))) for name in (*estimates, *held)}
    for name, bound in held.items():
        sentence = (
            _("'{name}' ended on its lower bound, {value}: the data do not determine it.")
            if bound == problem.bounds[name][0]
            else _("'{name}' ended on its upper bound, {value}: the data do not determine it.")
        )
        found.append(
            note(
                "at bound",
                sentence.format(name=known[name].label, value=_shown(bound, known[name], bound)),
                card,
                name,
            )
        )
    if condition >= COLLINEAR:
        deviation = np.sqrt(np.diag(covariance))
        with np.errstate(invalid="ignore", divide="ignore"):
            correlation = np.abs(covariance / np.outer(deviation, deviation))
        correlation[~np.isfinite(correlation)] = -1.0
        np.fill_diagonal(correlation, -1.0)
        i, j = np.unravel_index(int(np.argmax(correlation)), correlation.shape)
        names = list(estimates)
        if correlation[i, j] >= 0.0:
            sentence = _(
                "'{one}' and '{other}' can hardly be told apart by these data (condition {condition})."
            ).format(one=known[names[i]].label, other=known[names[j]].label, condition=_condition(condition))
        else:
            sentence = _(
                "These data do not determine all of {names} (condition {condition}): their covariance "
                "cannot be calculated."
            ).format(names=", ".join(known[name].label for name in names), condition=_condition(condition))
        found.append(note("poorly identified", sentence, card, names[i]))
    for name, estimate in estimates.items():
        low, high = estimate.interval_95
        if name not in held and low < 0.0 < high:
            found.append(
                note(
                    "not significant",
                    _("'{name}' does not differ from zero at 95 %.").format(name=known[name].label),
                    card,
                    name,
                )
            )
    return found


def _condition(condition: float) -> str:
    return f"{condition:.0f}" if np.isfinite(condition) else "∞"
