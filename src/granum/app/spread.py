"""How far accepted correlations differ: the same inputs by every other law that could stand in the same
place.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from granum.app.forms import options
from granum.app.wording import noticed
from granum.core import registry
from granum.core.errors import GranumError
from granum.core.i18n import _
from granum.core.parameters import Parameter
from granum.core.units import format_number, from_si, pretty_unit
from granum.reports.quantities import law_label
from granum.reports.sensitivity import Curve, values_at

MOST = 40
FAR = 3.5  # robust standard deviations from the median, beyond which a law stands apart
CLOSE = 0.1  # of the median, within which none does


@dataclass(frozen=True)
class Alternative:
    """Another law in the place of the one that was used: what to evaluate, and which inputs choose it."""

    thing: Any
    given: dict[str, Any]
    label: str
    group: str
    changed: dict[str, str]


def alternatives(thing: Any, given: Mapping[str, Any]) -> list[Alternative]:
    """The other formulas of the card's family that these inputs suffice for, and the other laws among its
    inputs.
    """
    found = []
    for key, other in registry.family(thing.card.family).items():
        if key != thing.card.key and other.card.sort == "formula" and _suffices(other, given):
            own = {p.name: given[p.name] for p in other.card.parameters if p.name in given}
            found.append(Alternative(other, own, law_label(other.card), _("formula"), {}))
    for p in thing.card.parameters:
        now = _name_of(given.get(p.name, p.default))
        for option in (o for o in options(p) if p.law and "table" not in o and o["value"] != now):
            chosen = {p.name: option["value"]}
            found.append(Alternative(thing, {**given, **chosen}, option["label"], p.label, chosen))
    return found[:MOST]


def _name_of(law: Any) -> Any:
    return law if isinstance(law, str) else getattr(getattr(law, "card", None), "name", None)


def _suffices(other: Any, given: Mapping[str, Any]) -> bool:
    names = {p.name for p in other.card.parameters}
    return all(p.name in given for p in other.card.parameters if p.required) and not (set(given) - names)


def spread(thing: Any, given: Mapping[str, Any]) -> dict[str, Any]:
    """What the laws give, least first, with the law that was used among them, and in a sentence how far they
    agree.
    """
    own = Alternative(thing, dict(given), _("this one"), "", {})
    rows = [row for law in (own, *alternatives(thing, given)) if (row := _row(law, own))]
    if len(rows) < 2 or rows[0]["group"]:
        return {"rows": [], "summary": None}
    p = thing.card.outputs[0]
    rows.sort(key=lambda row: row["value"])
    values = np.asarray([row["value"] for row in rows])
    middle = float(np.median(values))
    apart = FAR * 1.4826 * float(np.median(np.abs(values - middle)))
    inside = np.abs(values - middle) <= max(apart, CLOSE * abs(middle))
    unit = p.display_unit(middle)

    def text(value: float, digits: int = 4) -> str:
        return f"{format_number(float(from_si(value, unit, p.kind)), digits)} {pretty_unit(unit)}".strip()

    for row, within in zip(rows, inside, strict=True):
        row |= {"text": text(row["value"]), "apart": not within}
    kept = values[inside]
    sentence = _("{inside} of {total} laws: {low} … {high}, median {median}").format(
        inside=kept.size,
        total=values.size,
        low=text(kept[0], 3).removesuffix(pretty_unit(unit)).strip(),
        high=text(kept[-1], 3),
        median=text(middle, 3),
    )
    return {"rows": rows, "summary": {"sentence": sentence, "median": middle, "inside": int(kept.size)}}


def _row(law: Alternative, own: Alternative) -> dict[str, Any] | None:
    """The row of one law; None when it cannot be evaluated here (outside its hard bounds, other shape of
    result).
    """
    try:
        result = law.thing.evaluate(**law.given)
    except GranumError:
        return None
    value = result.outputs[result.card.outputs[0].name]
    if np.ndim(value) or value is None or not np.isfinite(value):
        return None
    return {
        "card": law.thing.card.key,
        "label": law.label,
        "group": law.group,
        "changed": law.changed,
        "own": law is own,
        "value": float(value),
        "notices": [n["message"] for n in noticed(result.notices)],
    }


def curves(thing: Any, given: Mapping[str, Any], found: Curve) -> Iterator[tuple[str, np.ndarray]]:
    """What the other laws give over the places of a curve."""
    for law in alternatives(thing, given):
        other: Parameter = law.thing.card.outputs[0]
        fits = other.kind is not None and found.output.kind is not None
        if not fits or found.against.name not in law.given or other.kind.unit != found.output.kind.unit:  # type: ignore[union-attr]
            continue
        try:
            y, _trusted = values_at(law.thing, law.given, found.against.name, found.x, other.name)
        except GranumError:
            continue
        if np.isfinite(y).any():
            yield law.label, y
