"""Numbers as people read them, once for terminal, page and report: values, estimates, checks, the stream
table.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from granum.core.cards import Card
from granum.core.glossary import ending, quantity_in, term
from granum.core.i18n import _, current_language
from granum.core.kinds import KINDS, Kind, kind_of
from granum.core.limits import Limit
from granum.core.parameters import Parameter, default_as_json
from granum.core.sources import cite
from granum.core.units import (
    decimal,
    field_units,
    figures_of,
    format_number,
    from_si,
    pretty_unit,
    same_dimension,
    show,
    ten_to,
)

if TYPE_CHECKING:
    from granum.core.results import Result

AMBIGUOUS = ("dimensionless", "1/m")  # a percentage or a number; a surface per volume or a medium resistance
MOST_SHOWN = 8


def value_text(value: Any, parameter: Parameter) -> str:
    """One value with its unit; a short list for vectors; words for choices."""
    if value is None or (isinstance(value, str) and not value):
        return "—"
    if parameter.kind is None:
        return _word(value, parameter)
    array = np.asarray(value, dtype=float)
    unit = parameter.display_unit(array)
    if array.ndim == 0:
        return show(float(array), parameter.kind, unit)
    items = [format_number(float(x)) for x in np.ravel(from_si(array, unit, parameter.kind))[:MOST_SHOWN]]
    return f"{'; '.join(items)}{' …' if array.size > MOST_SHOWN else ''} {pretty_unit(unit)}".strip()


def in_units(value: Any, parameter: Parameter) -> list[dict[str, str]]:
    """One number in every unit that people write it in, the usual one first: as it is printed, and with all
    its digits. Empty for what is no single number.
    """
    if parameter.kind is None or value is None or np.ndim(value) or not np.isfinite(float(value)):
        return []
    usual = parameter.display_unit(value)
    offered = dict.fromkeys((usual, *field_units(parameter.kind), *parameter.units))
    fitting = [u for u in offered if same_dimension(u, parameter.kind.unit)]
    comma = current_language() == "fr"
    rows = []
    for unit in fitting:
        number = float(from_si(value, unit, parameter.kind))
        full = f"{number:.12g}".replace("e+", "e")
        rows.append(
            {
                "unit": unit,
                "label": pretty_unit(unit),
                "text": format_number(number, figures_of(number, unit, parameter.kind)),
                "full": full.replace(".", ",") if comma else full,
            }
        )
    return rows


class BesideRow(NamedTuple):
    """A number that a calculation went through, and where it lies in the range of its source."""

    name: str
    label: str
    symbol: str
    text: str
    place: str
    inside: bool


def beside_rows(result: Result) -> list[BesideRow]:
    """The numbers that a calculation went through, such as its Reynolds number, in words."""
    return [_beside(row) for row in result.beside]


def _beside(row: dict[str, Any]) -> BesideRow:
    from granum.core.notices import units_of  # takes JAX, which a card that is only shown does not

    shown, unit = units_of(row | {"worst": row["value"]})
    word = quantity_in(row["name"])
    value, low, high = row["value"], row["low"], row["high"]
    ends = ("−∞" if low is None else shown(low), "∞" if high is None else shown(high))
    return BesideRow(
        row["name"],
        label_of(row["name"]),
        term(word).symbol if word and word == row["name"] else "",
        shown(value) + unit,
        _place(value, low, high).format(low=ends[0], high=ends[1] + unit),
        (low is None or value >= low) and (high is None or value <= high),
    )


def _place(value: float, low: float | None, high: float | None) -> str:
    """Where a number lies in a range; within a factor of 1.5 of one end it is near it."""
    if low is not None and value < low:
        return _("below {low} … {high}")
    if high is not None and value > high:
        return _("above {low} … {high}")
    near_low = low is not None and 0.0 < low <= value <= 1.5 * low
    near_high = high is not None and value >= high / 1.5 > 0.0
    if near_low == near_high:
        return _("inside {low} … {high}")
    return (
        _("near the lower end of {low} … {high}") if near_low else _("near the upper end of {low} … {high}")
    )


def _word(value: Any, parameter: Parameter) -> str:
    if isinstance(value, bool):
        return _("yes") if value else _("no")
    if hasattr(value, "card"):
        return law_text(value)
    text = str(default_as_json(value))
    if value in parameter.choices:
        return _(text.replace("_", " "))
    if current_language() == "en" or not isinstance(value, str):
        return text
    from granum.materials.library import session  # takes a while to read

    return session().label(text)


def law_label(card: Card) -> str:
    """A law among others of its family: its author alone when the title is the family's name with the
    author.
    """
    _head, bracket, author = card.title.partition(" (")
    return (
        author.removesuffix(")")
        if bracket and card.sort == "formula" and card.name.startswith(card.family)
        else card.title
    )


def law_text(law: Any) -> str:
    """A law with the values of its parameters."""
    known = (
        ((p, getattr(law, p.name, None)) for p in law.card.parameters) if law.card.sort != "formula" else ()
    )
    given = "; ".join(f"{p.label} {value_text(value, p)}" for p, value in known if value is not None)
    return law_label(law.card) + (f" ({given})" if given else "")


@cache
def _kind_in(unit: str) -> Kind | None:
    """What is measured in an SI unit, with the units of every kind that is; None when that says too
    little.
    """
    # no limit and no estimate is an area of molecules
    found = [k for k in KINDS.values() if k.unit == unit and k.name != "molecular area"]
    if not found or unit in AMBIGUOUS:
        return None
    return replace(found[0], display=tuple(dict.fromkeys(u for k in found for u in k.display)))


def figure_named(name: str, unit: str, card: str = "") -> Parameter:
    """A figure of which the name and the SI unit are known, such as an estimate of a card."""
    from granum.core import registry

    thing = registry.known(card)
    declared = {p.name: p.kind for p in (*thing.card.parameters, *thing.card.outputs)} if thing else {}
    kinds = {n: kind_of(a) for n, a in getattr(thing, "estimates", {}).items()} | declared
    kind = kinds.get(name)
    return Parameter(
        name, kind if kind is not None and kind.unit == unit else _kind_in(unit) or Kind(unit, unit)
    )


def label_of(name: str) -> str:
    """The glossary's label of a result that is no declared output."""
    word = quantity_in(name)
    rest = name[len(word or "") :].strip("_")
    if not word:
        return _(rest.replace("_", " "))
    return f"{term(word).label} ({ending(rest)})" if rest else term(word).label


def statistics_rows(data: dict[str, Any]) -> list[tuple[str, str]]:
    """The statistics of the JSON of a fit, in words with their numbers."""
    labels: dict[str, str] = {
        "rmse": _("root mean square of the residuals"),
        "r_squared": "R²",
        "aicc": "AICc",
        "degrees_of_freedom": _("degrees of freedom"),
        "points": _("points"),
        "points_excluded": _("points excluded"),
        "residual_standard_deviation": _("residual standard deviation"),
        "condition": _("condition of the normal equations"),
        "smoothing_points": _("points smoothed over"),
    }
    numbers = ((str(name), x) for name, x in data["statistics"].items() if isinstance(x, (int, float)))
    return [(labels.get(name, name.replace("_", " ")), format_number(x)) for name, x in numbers]


def statistics_text(data: dict[str, Any]) -> str:
    """The statistics of the JSON of a fit in one line."""
    return " · ".join(f"{label} = {text}" for label, text in statistics_rows(data))


def defaults_text(data: dict[str, Any]) -> str:
    """What a fit took because it was not given, in one line; empty where nothing was."""
    from granum.core import registry

    thing = registry.known(data["card"])
    declared = {p.name: p for p in thing.card.parameters} if thing else {}
    shown = [
        f"{declared[n].label} = {value_text(value, declared[n])}"
        for n, value in data.get("defaults", {}).items()
        if n in declared
    ]
    return _("Taken by default: {conditions}.").format(conditions="; ".join(shown)) if shown else ""


def origins_text(data: dict[str, Any]) -> str:
    """Which conditions of a fit a stated fluid gave, in one line; empty where none was stated."""
    from granum.core import registry

    thing = registry.known(data["card"])
    declared = {p.name: p for p in thing.card.parameters} if thing else {}
    given = {n: found for n, found in data.get("from", {}).items() if n in declared}
    shown = [f"{declared[n].label} = {value_text(found['value'], declared[n])}" for n, found in given.items()]
    fluids = "; ".join(dict.fromkeys(found["origin"] for found in given.values()))
    return _("From {fluid}: {conditions}.").format(fluid=fluids, conditions="; ".join(shown)) if shown else ""


def ranges_text(data: dict[str, Any]) -> str:
    """What the estimates of a fit hold for, in one line; empty where nothing is known."""
    from granum.core import registry

    thing = registry.known(data["card"])
    declared = {p.name: p for p in thing.card.parameters} if thing else {}
    shown = [
        f"{declared[n].label} {range_text(ends[0], ends[1], declared[n])}"
        for n, ends in data.get("ranges", {}).items()
        if n in declared
    ]
    return _("Measured at: {conditions}.").format(conditions="; ".join(shown)) if shown else ""


def range_text(low: float, high: float, p: Parameter) -> str:
    """Two ends of a range, or the one value that they are."""
    return value_text(low, p) if low == high else f"{value_text(low, p)} … {value_text(high, p)}"


class EstimateRow(NamedTuple):
    """An estimate in its display unit, each number to the second figure of the standard error.

    ``together`` is value ± error and ``between`` the interval, both with one power of ten.
    """

    name: str
    label: str
    value: str
    error: str
    interval: str
    unit: str
    derived: bool
    together: str = ""
    between: str = ""


def estimate_rows(data: dict[str, Any]) -> list[EstimateRow]:
    """The estimates of the JSON of a fit."""
    groups = [(data["parameters"], False), (data.get("derived", {}), True)]
    return [
        _estimate(data["card"], name, row, derived) for rows, derived in groups for name, row in rows.items()
    ]


def _estimate(card: str, name: str, row: dict[str, Any], derived: bool) -> EstimateRow:
    figure = figure_named(name, row["unit"], card)
    numbers = [row["value"], row["standard_error"], *row["interval_95"]]
    unit = row["unit"]
    if figure.kind is not None and row["value"] is not None:
        unit = figure.display_unit(row["value"])
        zero = from_si(0.0, unit, figure.kind)
        numbers = [
            None if x is None else float(from_si(x, unit, figure.kind) - (zero if i == 1 else 0.0))
            for i, x in enumerate(numbers)
        ]
    value, error, low, high = (_to_figure_of(x, numbers[1]) for x in numbers)
    interval = "" if numbers[2] is None and numbers[3] is None else f"{low} … {high}"
    return EstimateRow(
        name, label_of(name), value, error, interval, pretty_unit(unit), derived, *_in_one_power(numbers)
    )


def _in_one_power(numbers: Sequence[float | None]) -> tuple[str, str]:
    """Value ± error, and the interval, each with the power of ten of the value taken out where it is far from
    one.
    """
    value, error, low, high = numbers
    if value is None:
        return "—", ""
    size = math.floor(math.log10(abs(value))) if value else 0
    power = size if not -3 <= size < 5 else 0
    fine = error if error and math.isfinite(error) else None
    figure = math.floor(math.log10(fine / 10.0**power)) - 1 if fine else size - power - 3
    decimals = max(-figure, 0)

    def written(x: float | None) -> str:
        return "—" if x is None else decimal(f"{x / 10.0**power:.{decimals}f}")

    def times(text: str, several: bool) -> str:
        return text if not power else f"({text}) {ten_to(power)}" if several else f"{text} {ten_to(power)}"

    together = times(f"{written(value)} ± {written(error)}", True) if fine else times(written(value), False)
    return together, "" if low is None and high is None else times(f"{written(low)} … {written(high)}", True)


def _to_figure_of(value: float | None, error: float | None) -> str:
    """A number printed to the second figure of its standard error; four figures where there is none."""
    if value is None:
        return "—"
    if not error or not value or not math.isfinite(error):
        return format_number(value)
    digits = math.floor(math.log10(abs(value))) - math.floor(math.log10(error)) + 2
    return format_number(value, min(max(digits, 2), 7))


ROUNDING = 1e-9
SLACK = 1e-6  # below zero, what a balance that is solved leaves of a difference


class CheckRow(NamedTuple):
    """A check of a unit: its value and what is allowed, in one unit."""

    name: str
    ok: bool
    text: str
    allowed: str


def check_row(check: Any, figures: Iterable[tuple[Parameter, Any]] = ()) -> CheckRow:
    """A check as people read it; in the unit of the figure it looks at, where it is one of ``figures``. One
    that holds or not, measured as 1 or 0, is told as yes or no.
    """
    if check.low == check.high == 1.0 and check.unit == "dimensionless" and float(check.value) in (0.0, 1.0):
        return CheckRow(_(check.name), check.ok, _("yes") if check.ok else _("no"), f"= {_('yes')}")
    value, (low, high) = float(check.value), _ruled(float(check.low), float(check.high), check.unit)
    looked_at = next(((p, x) for p, x in figures if _same_quantity(p, x, check)), None)
    if looked_at is None or looked_at[0].kind is None:
        tail, (value, low, high) = _shown(check.unit, value or _end(low, high), value, low, high)
        digits = 4
    else:
        kind, unit = looked_at[0].kind, looked_at[0].display_unit(np.asarray(looked_at[1], dtype=float))
        value, low, high = (float(from_si(number, unit, kind)) for number in (value, low, high))
        tail, digits = f" {pretty_unit(unit)}".rstrip(), figures_of(value, unit, kind)
    far = 1e3 * max(abs(value), 1.0)  # a limit that only says that there is none
    low, high = -math.inf if low <= -far else low, math.inf if high >= far else high
    return CheckRow(_(check.name), check.ok, format_number(value, digits) + tail, _between(low, high) + tail)


def _same_quantity(p: Parameter, value: Any, check: Any) -> bool:
    """Whether a figure is what a check measured."""
    if p.kind is None or np.ndim(value) or value is None or p.kind.unit != check.unit:
        return False
    return math.isclose(float(value), float(check.value), rel_tol=1e-9)


class LimitRow(NamedTuple):
    """A practical limit of a unit before anything is calculated: what is allowed, and its source spelled
    out.
    """

    name: str
    allowed: str
    source: str


def limit_rows(card: Card) -> list[LimitRow]:
    """The practical limits of a piece of equipment as people read them."""
    return [LimitRow(_(limit.name), _allowed(limit, card), cite(limit.source)) for limit in card.limits]


def _allowed(limit: Limit, card: Card) -> str:
    words = [
        f"{sign} {card.parameter(end).label}"
        for sign, end in (("≥", limit.low), ("≤", limit.high))
        if isinstance(end, str)
    ]
    low, high = _ruled(
        -math.inf if isinstance(limit.low, str) else limit.low,
        math.inf if isinstance(limit.high, str) else limit.high,
        limit.unit,
    )
    if math.isfinite(low) or math.isfinite(high):
        tail, (low, high) = _shown(limit.unit, _end(low, high), low, high)
        words.append(_between(low, high) + tail)
    return ", ".join(words)


def _ruled(low: float, high: float, unit: str) -> tuple[float, float]:
    """The ends of a limit without what they leave to rounding; 0.1 mdarcy is none."""
    if low == -high and 0.0 < high <= SLACK:  # as specified
        return 0.0, 0.0
    most = ROUNDING if unit == "dimensionless" else 0.0
    return 0.0 if -SLACK <= low <= most else low, 0.0 if -SLACK <= high <= most else high


def _end(low: float, high: float) -> float:
    return next((x for x in (high, low) if math.isfinite(x)), 0.0)


def _shown(unit: str, sized: float, *numbers: float) -> tuple[str, tuple[float, ...]]:
    """The unit in which a number of this size is read, after a space, and numbers in it."""
    kind = _kind_in(unit)
    usual = kind is not None and (not kind.display or unit in kind.display)  # nobody counts in rad/s
    if kind is not None and (
        kind.unit == "K" or field_units(kind) or not usual or not 0.05 <= abs(sized) < 1e4
    ):
        unit = Parameter("", kind).display_unit(sized)
        numbers = tuple(float(from_si(x, unit, kind)) for x in numbers)
    return f" {pretty_unit(unit)}".rstrip(), numbers


def _between(low: float, high: float) -> str:
    if math.isfinite(low) and low == high:
        return f"= {format_number(low)}"
    if math.isfinite(low) and math.isfinite(high):
        return f"{format_number(low)} … {format_number(high)}"
    return f"≤ {format_number(high)}" if math.isfinite(high) else f"≥ {format_number(low)}"


FINDINGS = ("area", "volume", "power", "diameter")
"""Quantities that say how large a machine is and what it takes."""


def is_finding(p: Parameter) -> bool:
    """Whether a figure of a unit is what one looks for first: a size or a duty."""
    return p.kind is not None and not p.series and p.kind.name in FINDINGS


def found_rows(run: Any) -> list[dict[str, str]]:
    """What design specifications found: the input and its value."""
    rows = []
    for path, p, value in run.sought():
        unit, _dot, name = path.partition(".")
        rows.append({"unit": unit, "name": name, "label": p.label, "text": value_text(value, p)})
    return rows
