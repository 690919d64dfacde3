"""What a page needs to make a form of a card: choices with labels, ranges and values in the units people write."""

from __future__ import annotations

import ast
import doctest
import json
import math
from typing import Any

import numpy as np

from granum.core import registry
from granum.core.cards import Card
from granum.core.i18n import _
from granum.core.kinds import Kind
from granum.core.parameters import Parameter, convert
from granum.core.units import field_units, format_number, from_si, parse_unit, pretty_unit, show
from granum.reports.mathml import mathml
from granum.reports.quantities import law_label


def card_form(key: str) -> dict[str, Any]:
    """One card with everything a form needs."""
    card = registry.find(key).card
    data = card.as_json() | {"equation_shown": mathml(card.equation, display=True) if card.equation else ""}
    examples = docstring_values(card)
    for row, p in zip(data["parameters"], card.parameters, strict=True):
        row["symbol_shown"] = mathml(p.term.symbol) if p.term and p.term.symbol else ""
        row["allowed"] = bounds_text(p)
        row["source_range"] = range_text(p, p.fitted) if p.fitted else ""
        row["options"] = options(p)
        row["laws"] = law_labels(p)
        if p.kind:
            row["units"] = _units_of(p.kind, row["units"])
        row["default_shown"] = None if p.required or p.default is None else entry(p, p.default)
        row["example"] = example(p, examples)
    return data


def _units_of(kind: Kind, rows: list[dict[str, str]]) -> list[dict[str, str]]:
    """Units to choose from, customary ones first when they are wanted."""
    wanted = [{"unit": u, "label": pretty_unit(u)} for u in field_units(kind)]
    return wanted + [u for u in rows if same_dimension(u["unit"], kind) and u not in wanted]


def same_dimension(unit: str, kind: Kind) -> bool:
    """Whether a kind can be written in a unit; a word of the glossary may be used with another kind than its usual one."""
    return parse_unit(unit).dimensionality == parse_unit(kind.unit).dimensionality


def entry(p: Parameter, value: Any) -> dict[str, str]:
    """A value as a form holds it: number and unit, both text; words and laws without unit."""
    if isinstance(value, dict):  # a law with its parameters
        return {"number": json.dumps(value, ensure_ascii=False), "unit": ""}
    if isinstance(value, bool):
        return {"number": "yes" if value else "no", "unit": ""}
    if p.kind is None or isinstance(value, str):
        return {"number": getattr(getattr(value, "card", None), "name", None) or str(value), "unit": ""}
    if isinstance(value, (list, tuple)) and any(isinstance(item, str) for item in value):  # each with its own unit
        value = convert(value, p)
    array = np.atleast_1d(np.asarray(value, dtype=float))
    unit = p.display_unit(array)
    shown = (f"{float(x):.6g}" for x in np.atleast_1d(from_si(array, unit, p.kind)))
    return {"number": " ".join(shown), "unit": "" if unit == "dimensionless" else unit}


def example(p: Parameter, given: dict[str, Any]) -> dict[str, str] | None:
    """The value of the docstring's example, else the middle of the ordinary range; None for what may stay empty."""
    if p.name in given:
        return entry(p, given[p.name])
    if given or not p.required or p.kind is None or p.series:
        return None
    low, high = p.ordinary()
    middle = math.sqrt(low * high) if low > 0 else (low + high) / 2
    unit = p.display_unit(middle)
    number = float(from_si(middle, unit, p.kind))
    return {"number": f"{float(f'{number:.2g}'):.6g}", "unit": "" if unit == "dimensionless" else unit}


def docstring_values(card: Card) -> dict[str, Any]:
    """Arguments of the call in the docstring's example, as far as they are literals; empty when one is not."""
    for item in doctest.DocTestParser().get_examples(card.doc):
        for node in ast.walk(ast.parse(item.source)):
            if (
                isinstance(node, ast.Call)
                and isinstance(node.func, ast.Name)
                and node.func.id == card.name
                and len(node.args) <= len(card.parameters)
            ):
                words = [(p.name, arg) for p, arg in zip(card.parameters, node.args, strict=False)]
                words += [(word.arg, word.value) for word in node.keywords if word.arg]
                try:
                    if words:
                        return {name: ast.literal_eval(value) for name, value in words}
                except ValueError:
                    break
    return {}


def options(p: Parameter) -> list[dict[str, str]]:
    """Words or laws that may be chosen, with labels."""
    if p.choices:
        return [{"value": str(word), "label": _(str(word).replace("_", " "))} for word in p.choices]
    if p.sort is bool:
        return [{"value": "yes", "label": _("yes")}, {"value": "no", "label": _("no")}]
    if not p.law:
        return []
    found = [option for thing in registry.family(p.law).values() if (option := _law_option(thing.card)) is not None]
    return sorted(found, key=lambda o: o["label"])


def _law_option(card: Card) -> dict[str, str] | None:
    """A law that may be chosen; one that needs parameters starts from those of its own example, or is left to case files."""
    if card.sort != "law" or not any(q.required for q in card.parameters):
        return {"value": card.name, "label": law_label(card)}
    example = docstring_values(card)
    if any(q.required and q.name not in example for q in card.parameters):
        return None
    return {"value": card.name, "label": law_label(card), "table": json.dumps({"law": card.name} | example, ensure_ascii=False)}


def law_labels(p: Parameter) -> dict[str, dict[str, str]]:
    """Labels of the laws with parameters that may stand for a parameter, by the names under which a case or a link calls them."""
    found: dict[str, dict[str, str]] = {}
    for thing in registry.family(p.law).values() if p.law else ():
        if thing.card.sort == "law":
            words = {"law": thing.card.title} | {q.name: q.label for q in thing.card.parameters}
            found |= {thing.card.name: words, thing.card.name.removeprefix(p.law or "").strip("_"): words}
    return found


def _edge(value: float, kind: Kind) -> str:
    return "0" if value == 0.0 and kind.unit != "K" else show(value, kind)


def bounds_text(p: Parameter) -> str:
    """The allowed range of a parameter as people read it."""
    kind = p.kind
    if p.within:
        return f"{p.within.lower:.0f} … {p.within.upper:.0f}"
    if kind is None or (kind.lower == -math.inf and kind.upper == math.inf):
        return ""
    if kind.upper == math.inf:
        return f"{'>' if kind.open_lower else '≥'} {_edge(kind.lower, kind)}"
    if kind.lower == -math.inf:
        return f"{'<' if kind.open_upper else '≤'} {_edge(kind.upper, kind)}"
    return f"{_edge(kind.lower, kind)} … {_edge(kind.upper, kind)}"


def range_text(p: Parameter, limits: tuple[float, float]) -> str:
    """A range in one unit: ``10 … 800 µm``."""
    if p.kind is None:
        return " … ".join("∞" if abs(x) == math.inf else format_number(x) for x in limits)
    return " … ".join(("−∞" if x < 0 else "∞") if abs(x) == math.inf else _edge(x, p.kind) for x in limits)
