"""How far accepted correlations differ: the same inputs by every other law that could stand in the same
place.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from granum.app.forms import options
from granum.core import registry
from granum.core.errors import GranumError
from granum.core.results import Result
from granum.reports.quantities import law_label, value_text

MOST = 40


def spread(thing: Any, given: Mapping[str, Any]) -> list[dict[str, Any]]:
    """One row per law: of the card's own family when its inputs suffice, and for each law among its
    inputs.
    """
    rows = []
    for key, other in registry.family(thing.card.family).items():
        if key != thing.card.key and other.card.sort == "formula" and _suffices(other, given):
            rows += _row(
                other,
                {p.name: given[p.name] for p in other.card.parameters if p.name in given},
                law_label(other.card),
                {},
            )
    for p in thing.card.parameters:
        for option in (o for o in options(p) if p.law and "table" not in o):
            rows += _row(
                thing, {**given, p.name: option["value"]}, option["label"], {p.name: option["value"]}
            )
    return rows[:MOST]


def _suffices(other: Any, given: Mapping[str, Any]) -> bool:
    names = {p.name for p in other.card.parameters}
    return all(p.name in given for p in other.card.parameters if p.required) and not (set(given) - names)


def _row(thing: Any, given: dict[str, Any], label: str, changed: dict[str, str]) -> list[dict[str, Any]]:
    """The row of one law; none when it cannot be evaluated here (outside its hard bounds, other shape of
    result).
    """
    try:
        result: Result = thing.evaluate(**given)
    except GranumError:
        return []
    p = result.card.outputs[0]
    text = value_text(result.outputs[p.name], p)
    return [
        {
            "card": thing.card.key,
            "label": label,
            "changed": changed,
            "text": text,
            "notices": [n["message"] for n in result.notices],
        }
    ]
