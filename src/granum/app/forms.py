"""What a page needs to make a form of a card: choices with labels, ranges and values in the units people
write.
"""

from __future__ import annotations

import ast
import doctest
import json
import math
import operator
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from granum.app.closed_lists import listed, suggested, word_label
from granum.app.exercises import with_card
from granum.app.wording import summary_words
from granum.core import registry
from granum.core.cards import Card
from granum.core.conversion import convert
from granum.core.errors import InputError, UnitError
from granum.core.glossary import quantity_in
from granum.core.i18n import _
from granum.core.index import entries
from granum.core.kinds import KINDS, Kind
from granum.core.parameters import Parameter
from granum.core.units import (
    display_unit,
    field_units,
    format_number,
    from_si,
    in_unit_of,
    of_normal_gas,
    parse_unit,
    pretty_unit,
    show,
    to_si,
)
from granum.core.written import interval, read_number
from granum.estimation.tables import heading_names
from granum.materials.stated import asked_of_a_fluid
from granum.reports.mathml import equation_lines, mathml
from granum.reports.quantities import law_label, limit_rows
from granum.studies.intervals import spread_of


def whole(card: Card) -> Card:
    """A card as a form asks for it: of a law also what it is called with."""
    return replace(card, parameters=tuple(card.inputs.values()), arguments=()) if card.arguments else card


def card_form(key: str) -> dict[str, Any]:
    """One card with everything a form needs."""
    card = whole(registry.find(key).card)
    asked = registry.find(key).card.arguments
    data: dict[str, Any] = card.as_json() | {"equation_shown": equation_lines(card.equation)}
    data["summary"] = summary_words(card.summary)
    data["exercises"] = with_card(key)
    data["limits_shown"] = [row._asdict() for row in limit_rows(card)]
    data["fluid"] = fluid_field(card)
    examples = opening_values(card)
    for row, p in zip(data["parameters"], card.parameters, strict=True):
        row |= _field(p)
        row["options"] = options(p, key)
        row["suggested"] = suggested(p)
        row |= laws_of(p)
        row["headings"] = heading_names(p) if p.series else ()
        row["several"] = bool(p.kind) and card.sort == "formula"
        row["interval"] = bool(p.kind) and not p.series and card.sort in ("formula", "procedure")
        row["example"] = example(p, {} if p in asked and p.name not in examples else examples)
        row["units"] += _unit_of(row["example"], p.kind, row["units"])
    return data


def fields_of(p: Parameter) -> dict[str, Any]:
    """A field for a parameter that no card declares."""
    row = p.as_json() | _field(p) | {"options": options(p)} | laws_of(p)
    return row | {"several": False, "example": None}


def fluid_field(card: Card) -> dict[str, Any] | None:
    """The field of a fluid said in words, and the inputs it stands for; None where the card asks for no
    property of one.
    """
    gives = asked_of_a_fluid(card.parameters) if card.sort in ("formula", "procedure", "lab test") else ()
    hint = _("such as {example}, in place of: {names}").format(
        example=_("water at 20 °C"), names=", ".join(p.label for p in card.parameters if p.name in gives)
    )
    return (
        {"name": "fluid", "label": _("fluid"), "required": False, "gives": list(gives), "allowed": hint}
        if gives
        else None
    )


def _field(p: Parameter) -> dict[str, Any]:
    """What stands around a field: symbol, bounds, range, units, default."""
    return {
        "symbol_shown": mathml(p.symbol),
        "allowed": "" if _goes_without_saying(p) else bounds_text(p),
        "source_range": range_text(p, p.fitted) if p.fitted else "",
        "units": _units_of(p.kind, p.as_json()["units"]) if p.kind else [],
        "default_shown": None if p.required or p.default is None else entry(p, p.default),
    }


def _units_of(kind: Kind, rows: list[dict[str, str]]) -> list[dict[str, str]]:
    """Units to choose from, customary ones first when they are wanted."""
    wanted = [{"unit": u, "label": pretty_unit(u)} for u in field_units(kind)]
    fitting = wanted + [u for u in rows if same_dimension(u["unit"], kind)]
    return list({u["label"]: u for u in reversed(fitting)}.values())[::-1]  # K is there once


def _unit_of(
    shown: dict[str, str] | None, kind: Kind | None, offered: list[dict[str, str]]
) -> list[dict[str, str]]:
    """The unit of an example where none of those offered is it."""
    found = read_number(shown["number"]) if shown and kind else None
    unit = found[1] if found else ""
    if not kind or not unit or not _known(unit, kind) or any(_alike(unit, u["unit"], kind) for u in offered):
        return []
    return [{"unit": unit, "label": pretty_unit(unit)}]


def same_dimension(unit: str, kind: Kind) -> bool:
    """Whether a kind can be written in a unit; a word of the glossary may be used with another kind than its
    usual one.
    """
    return parse_unit(unit).dimensionality == parse_unit(kind.unit).dimensionality


def entry(p: Parameter, value: Any) -> dict[str, str]:
    """A value as a form holds it: number and unit, both text; words and laws without unit."""
    if isinstance(value, dict):  # a law with its parameters
        return {"number": json.dumps(value, ensure_ascii=False), "unit": ""}
    if isinstance(value, bool):
        return {"number": "yes" if value else "no", "unit": ""}
    if p.kind is None or isinstance(value, str):
        return {"number": getattr(getattr(value, "card", None), "name", None) or str(value), "unit": ""}
    # each with its own unit
    if isinstance(value, (list, tuple)) and any(isinstance(item, str) for item in value):
        value = convert(value, p)
    array = np.atleast_1d(np.asarray(value, dtype=float))
    unit = p.display_unit(array)
    if p.kind.unit == "s" and not _brief(array, unit, p.kind):  # 1000 s, which is 16.6667 min
        unit = next((u for u in p.units if _brief(array, u, p.kind)), unit)
    shown = (typed(float(x)) for x in np.atleast_1d(from_si(array, unit, p.kind)))
    return {"number": " ".join(shown), "unit": "" if unit == "dimensionless" else unit}


def _brief(values: np.ndarray, unit: str, kind: Kind) -> bool:
    """Whether values are ordinary numbers of four figures at most in a unit."""
    found = np.abs(np.atleast_1d(from_si(values, unit, kind)))
    return all(x == 0.0 or (0.1 <= x < LONGEST_TYPED and math.isclose(float(f"{x:.4g}"), x)) for x in found)


LONGEST_TYPED = 1e4  # from here on an example is not written out in another unit
LONG = 1e7  # from here on a number of few figures is written as a power of ten


def typed(number: float, figures: int = 6) -> str:
    """A number as somebody would type it.

    >>> typed(1.07e8, 12), typed(85.0), typed(2e-12)
    ('1.07e8', '85', '2e-12')
    """
    short = f"{number:.6g}"
    written = short if abs(number) >= LONG and float(short) == number else f"{number:.{figures}g}"
    digits, _e, power = written.partition("e")
    return f"{digits}e{int(power)}" if power else digits


def read_entry(asked: Mapping[str, Any]) -> dict[str, Any]:
    """What is typed in a field means: ``{"number", "unit"}`` beside what a form knows of its parameter.

    Gives the quantity in words and, where all its values share one unit, its number and that unit: one of the
    offered ones that means the same as the one typed (microns: um), else as it was typed.
    """
    p = _asked_parameter(asked)
    assert p.kind is not None
    written = str(asked.get("unit_typed", ""))
    within = interval(f"{asked.get('number', '')} {written}".strip()) if asked.get("interval") else None
    if within is not None:
        return _read_interval(within, p)
    text = f"{asked.get('number', '')} {written}".strip()
    other = KINDS.get(str(asked.get("or_kind", "")))
    if other is not None and (found := _of_other(text, other, asked)):
        return found
    array = _converted(text, p, bool(asked.get("several")))
    if array.size == 1 and (one := read_number(text)) is not None:
        written = one[1]  # behind a power of ten: 1.2·10⁻³ Pa s
    unit = written or p.kind.unit
    if not _known(unit, p.kind):  # "2 mm, 850 um": each value keeps its own
        shown = display_unit(array, p.kind)
        return {"shown": _listed(array, shown, p.kind)}
    offered = (str(u) for u in asked.get("units") or ())
    unit = next((u for u in offered if _known(u, p.kind) and _alike(u, unit, p.kind)), unit)
    between = " " if p.series else "; "  # beside one number a blank sets thousands apart
    numbers = between.join(typed(float(x), 12) for x in from_si(array, unit, p.kind))
    return {
        "shown": _listed(array, unit, p.kind),
        "number": numbers,
        "unit": "" if unit == "dimensionless" else unit,
    }


def _of_other(text: str, kind: Kind, asked: Mapping[str, Any]) -> dict[str, Any] | None:
    """What is typed as the other kind of quantity that a field takes, such as a flow as a volume; None where
    it is not that.
    """
    name = str(asked.get("name", ""))
    normal = of_normal_gas(text) if name.endswith("gas_flow") else None
    one = read_number(text)
    if one is None or not in_unit_of(normal or text, kind.unit):
        return None
    convert(normal or text, Parameter(_quantity(name), kind))
    number, unit = one
    if normal is None:
        unit = next((u for u in kind.units if _alike(u, unit, kind)), unit)
    return {
        "shown": f"{format_number(number, 9)} {pretty_unit(unit)}",
        "number": typed(number, 12),
        "unit": unit,
    }


def _read_interval(within: tuple[str, str, str], p: Parameter) -> dict[str, Any]:
    """What ``85 ± 5 um`` or ``80..90 um`` means, in the unit in which it was typed."""
    assert p.kind is not None
    spread = spread_of(p, *within)
    unit = (read_number(within[0]) or (0.0, ""))[1] or p.kind.unit
    if not _known(unit, p.kind):
        unit = p.kind.unit
    low, middle, high = (float(from_si(x, unit, p.kind)) for x in (spread.low, spread.middle, spread.high))
    ends, mark = ((middle, middle - low), "±") if spread.about else ((low, high), "…")
    shown = f" {mark} ".join(format_number(x, 9) for x in ends)
    number = f" {mark} ".join(typed(x, 9) for x in ends)
    return {
        "shown": f"{shown} {pretty_unit(unit)}".strip(),
        "number": number,
        "unit": "" if unit == "dimensionless" else unit,
    }


def _converted(text: str, p: Parameter, several: bool) -> np.ndarray:
    """The values of a text: one, or those of a series; several of a single input only where it cannot be read
    as one.
    """
    try:
        return np.atleast_1d(np.asarray(convert(text, p), dtype=float))
    except InputError:
        values = _several(text, p) if several else None
        if values is None:
            raise
        return values


def _several(text: str, p: Parameter) -> np.ndarray | None:
    try:
        values = np.atleast_1d(np.asarray(convert(text, p, several=True), dtype=float))
    except InputError:
        return None
    return values if values.size > 1 else None


def _asked_kind(asked: Mapping[str, Any]) -> Kind:
    """The kind of a field by its name and unit; one that only its card declares as the form says it: to look
    for the card would import the whole house while somebody types.
    """
    name, unit = str(asked.get("kind")), asked.get("unit")
    known = next((k for k in KINDS.values() if k.name == name and k.unit == unit), None)
    if known is not None:
        return known
    offered = asked.get("units")
    if not isinstance(unit, str) or not isinstance(offered, list):
        raise InputError(_("'{name}' is missing.").format(name="kind"), name="kind")
    found = Kind(name, unit)
    return replace(found, display=tuple(str(u) for u in offered[:20] if _known(str(u), found)))


def _asked_parameter(asked: Mapping[str, Any]) -> Parameter:
    kind = _asked_kind(asked)
    edges = {end: asked.get(end) for end in ("lower", "upper")}
    if any(not isinstance(x, (int, float)) for x in edges.values() if x is not None):
        raise InputError(
            _("'{name}' cannot take this value: {value}.").format(name="lower", value=str(edges)[:60]),
            name="lower",
        )
    bounds = {
        end: x if x is not None else (-math.inf if end == "lower" else math.inf) for end, x in edges.items()
    }
    bounds |= {end: bool(asked.get(end)) for end in ("open_lower", "open_upper")}
    return Parameter(
        _quantity(str(asked.get("name", ""))),
        replace(kind, **bounds),
        series="points" if asked.get("series") else None,
    )


def _quantity(name: str) -> str:
    """What the field of a stream asks for: ``gas.relative_humidity``, or the share ``feed.liquid.water``."""
    last = name.rpartition(".")[2]
    return last if last == name or quantity_in(last) else "mass_fraction"


def _known(unit: str, kind: Kind) -> bool:
    try:
        to_si(1.0, unit, kind)
    except UnitError:
        return False
    return True


def _alike(one: str, other: str, kind: Kind) -> bool:
    """Whether two units read the same number as the same quantity."""
    return all(math.isclose(to_si(x, one, kind), to_si(x, other, kind), rel_tol=1e-12) for x in (0.0, 1.0))


@cache
def opening(key: str) -> dict[str, str]:
    """The values with which the page of a card opens."""
    shown = {p["name"]: p["example"] for p in card_form(key)["parameters"] if p.get("example")}
    return {name: f"{one['number']} {one['unit']}".strip() for name, one in shown.items()}


def as_typed(card: Card, given: Mapping[str, Any]) -> dict[str, str]:
    """The single numbers of some inputs in the units in which they were typed."""
    told = {}
    for p in card.parameters:
        text = given.get(p.name)
        found = read_number(text) if isinstance(text, str) and p.kind and not p.series else None
        if p.kind and found is not None and found[1] and _known(found[1], p.kind):
            number, unit = found
            told[p.name] = f"{format_number(number, 9)} {pretty_unit(_offered(unit, p))}".strip()
    return told


def offered_unit(text: str, p: Parameter) -> str:
    """A quantity in the unit that its field offers, where it is written in another name of that unit: 12
    kW*hour/tonne as 12 kWh/tonne.
    """
    found = read_number(text) if p.kind and not p.series else None
    if p.kind is None or found is None or not found[1] or not text.endswith(found[1]):
        return text
    unit = _offered(found[1], p)
    return text if unit == found[1] else f"{text.removesuffix(found[1]).strip()} {unit}"


def _offered(unit: str, p: Parameter) -> str:
    """The unit that a parameter offers in place of one that is the same."""
    if p.kind is None or not _known(unit, p.kind):
        return unit
    return next((u for u in p.units if _known(u, p.kind) and _alike(u, unit, p.kind)), unit)


def _listed(values: np.ndarray, unit: str, kind: Kind) -> str:
    """Values in one unit as people read them: ``85 µm``, ``2 · 4 · 8 µm``."""
    return (
        f"{' · '.join(format_number(float(x), 9) for x in from_si(values, unit, kind))} {pretty_unit(unit)}"
    ).strip()


def example(p: Parameter, given: dict[str, Any]) -> dict[str, str] | None:
    """The value of the docstring's example, else the middle of the ordinary range; None for what may stay
    empty.
    """
    if p.name in given:
        return entry(p, given[p.name])
    asked = p.required and not given
    if not (asked or _default_beyond(p)) or p.kind is None or p.series:
        return None
    low, high = p.ordinary()
    middle = math.sqrt(low * high) if low > 0 else (low + high) / 2
    unit = p.display_unit(middle)
    number = float(from_si(middle, unit, p.kind))
    return {"number": typed(float(f"{number:.2g}")), "unit": "" if unit == "dimensionless" else unit}


def _default_beyond(p: Parameter) -> bool:
    """Whether what stands where nothing is typed lies outside the range of the source."""
    return (
        isinstance(p.default, float) and p.fitted is not None and not p.fitted[0] <= p.default <= p.fitted[1]
    )


def docstring_values(card: Card, called_with: bool = False) -> dict[str, Any]:
    """Arguments of the first call in the docstring's examples, as far as they can be read; empty when one can
    not. Of a law its parameters, and what it is ``called_with``.
    """
    known: dict[str, Any] = {}
    called, declared = {card.name}, card.parameters
    inputs: tuple[Parameter, ...] = ()
    if card.sort == "law":  # by its class; what it is called with afterwards beside it
        own = registry.find(card.key).card
        called, declared, inputs = {entries()[card.key].attribute}, own.parameters, own.arguments
    for item in doctest.DocTestParser().get_examples(card.doc):
        tree = ast.parse(item.source)
        outer: list[ast.expr] = []
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Call):  # FickSimplified(…)(1000.0)
                outer = node.args
            if (
                isinstance(node, ast.Call)
                and isinstance(node.func, ast.Name)
                and node.func.id in called
                and len(node.args) <= len(declared)
                and (node.args or node.keywords)
            ):
                try:
                    found = {p.name: _read(arg, known) for p, arg in zip(declared, node.args, strict=False)}
                    for word in node.keywords:
                        value = _read(word.value, known)
                        found |= {word.arg: value} if word.arg else value
                    if called_with and len(outer) == len(inputs):
                        found |= {p.name: _read(arg, known) for p, arg in zip(inputs, outer, strict=True)}
                    return found
                except ValueError:
                    break
        for node in tree.body:
            if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
                try:
                    known[node.targets[0].id] = _read(node.value, known)
                except ValueError:
                    continue
    return {}


EXTRAORDINARY = 900.0  # times more or less than the ordinary range: numbers chosen for the arithmetic


def opening_values(card: Card) -> dict[str, Any]:
    """What a form opens with: the docstring's example, unless a number in it is none that anybody meets; on
    Earth.
    """
    values = {
        name: value for name, value in docstring_values(card, called_with=True).items() if name != "gravity"
    }
    return {} if any(_extraordinary(p, values.get(p.name)) for p in card.parameters) else values


def _extraordinary(p: Parameter, value: Any) -> bool:
    if value is None or p.kind is None or p.kind.unit in ("K", "dimensionless"):
        return False
    sizes = np.abs(np.atleast_1d(np.asarray(convert(value, p), dtype=float)))
    middle = float(np.median(sizes[sizes > 0.0])) if np.any(sizes > 0.0) else 0.0
    low, high = sorted(map(abs, p.ordinary()))
    if p.kind.unit == "kg/m^3":
        low = min(low, 1.0)  # a gas where the glossary thinks of liquids
    return middle > EXTRAORDINARY * high or 0.0 < middle < low / EXTRAORDINARY


_ARITHMETIC: dict[type, Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}


def _read(node: ast.expr, known: Mapping[str, Any]) -> Any:
    """The value of an expression of an example: literals, names given before, arithmetic, ``dict(…)``, laws.

    >>> _read(ast.parse("[0.1 / 4, dict(a=size)]", mode="eval").body, {"size": "2 um"})
    [0.025, {'a': '2 um'}]
    """
    if isinstance(node, ast.Name) and node.id in known:
        return known[node.id]
    if isinstance(node, (ast.List, ast.Tuple)):
        return [_read(item, known) for item in node.elts]
    if isinstance(node, ast.Dict) and None not in node.keys:
        return {
            ast.literal_eval(key): _read(value, known)
            for key, value in zip(node.keys, node.values, strict=True)
            if key is not None
        }
    if isinstance(node, ast.BinOp) and type(node.op) in _ARITHMETIC:
        return _ARITHMETIC[type(node.op)](_read(node.left, known), _read(node.right, known))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        words = {word.arg: _read(word.value, known) for word in node.keywords if word.arg}
        if node.func.id == "dict":
            return words
        law = next((e for e in entries().values() if e.sort == "law" and e.attribute == node.func.id), None)
        if law is not None:
            names = [p.name for p in registry.find(law.key).card.parameters]
            given = dict(zip(names, (_read(arg, known) for arg in node.args), strict=False))
            return {"law": law.name} | given | words
    return ast.literal_eval(node)


def options(p: Parameter, card: str = "") -> list[dict[str, str]]:
    """Words, names or laws that may be chosen for an input of a card, with labels."""
    if p.choices:
        return [{"value": str(word), "label": word_label(str(word))} for word in p.choices]
    if p.sort is bool:
        return [{"value": "yes", "label": _("yes")}, {"value": "no", "label": _("no")}]
    if not p.law:
        return listed(p, card)
    found = [
        option for thing in registry.family(p.law).values() if (option := _law_option(thing.card)) is not None
    ]
    return sorted(found, key=lambda o: o["label"])


def _law_option(card: Card) -> dict[str, str] | None:
    """A law that may be chosen; one that needs parameters starts from those of its own example and from
    ordinary ones, or is left to case files.
    """
    if card.sort != "law" or not any(q.required for q in card.parameters):
        return {"value": card.name, "label": law_label(card)}
    given = docstring_values(card)
    for q in card.parameters:
        if q.required and q.name not in given:
            given[q.name] = _usual(q)
    if any(value is None for value in given.values()):
        return None
    return {
        "value": card.name,
        "label": law_label(card),
        "table": json.dumps({"law": card.name} | given, ensure_ascii=False),
    }


def _usual(p: Parameter) -> Any:
    """What a parameter of a law starts from: an ordinary value, or a law that hangs on no other; None where
    nobody can know.
    """
    if p.choices:
        return p.choices[0]
    if p.law:
        inner = [x.card for x in registry.family(p.law).values() if not any(q.law for q in x.card.parameters)]
        inner.sort(key=lambda card: not docstring_values(card))  # those with an example of their own first
        found = next(filter(None, map(_law_option, inner)), None)
        return None if found is None else json.loads(found["table"]) if "table" in found else found["value"]
    shown = example(p, {})
    return None if shown is None else f"{shown['number']} {shown['unit']}".strip()


def laws_with_parameters(p: Parameter) -> dict[str, dict[str, Any]]:
    """Titles and parameters of the laws that may stand for a parameter, by the names under which a case or a
    link calls them.
    """
    found: dict[str, dict[str, Any]] = {}
    for thing in registry.family(p.law).values() if p.law else ():
        if thing.card.sort == "law":
            law = {
                "title": thing.card.title,
                "parameters": {
                    q.name: q.as_json() | _field(q) | ({} if q.law else {"options": options(q)})
                    for q in thing.card.parameters
                },
            }
            found |= {thing.card.name: law, thing.card.name.removeprefix(p.law or "").strip("_"): law}
    return found


def laws_of(p: Parameter) -> dict[str, Any]:
    """The laws that may stand for a parameter, and those that stand in these: each family once."""
    laws = laws_with_parameters(p)
    families: dict[str, dict[str, Any]] = {}
    waiting = [laws]
    while waiting:
        inner = {q["law"] for law in waiting.pop().values() for q in law["parameters"].values() if "law" in q}
        for name in sorted(inner - families.keys()):
            within = Parameter(name, law=name)
            families[name] = {"options": options(within), "laws": laws_with_parameters(within)}
            waiting.append(families[name]["laws"])
    return {"laws": laws, "families": families}


def _edge(value: float, p: Parameter) -> str:
    """An end of a range, in percent where the field is."""
    assert p.kind is not None
    if value == 0.0 and p.kind.unit != "K":
        return "0"
    return show(value, p.kind, "percent" if p.units[0] == "percent" else None)


def _goes_without_saying(p: Parameter) -> bool:
    """Whether all that is asked is what nobody would get wrong: a length above zero, a temperature above
    absolute zero.
    """
    kind = p.kind
    return p.within is None and kind is not None and kind.upper == math.inf and kind.lower in (0.0, -math.inf)


def bounds_text(p: Parameter) -> str:
    """The allowed range of a parameter as people read it."""
    kind = p.kind
    if p.within:
        return f"{p.within.lower:.0f} … {p.within.upper:.0f}"
    if kind is None or (kind.lower == -math.inf and kind.upper == math.inf):
        return ""
    if kind.upper == math.inf:
        return f"{'>' if kind.open_lower else '≥'} {_edge(kind.lower, p)}"
    if kind.lower == -math.inf:
        return f"{'<' if kind.open_upper else '≤'} {_edge(kind.upper, p)}"
    return range_text(p, (kind.lower, kind.upper))


def range_text(p: Parameter, limits: tuple[float, float]) -> str:
    """A range in the unit of its larger end, ``10 … 800 µm``, where the other end is no row of zeros."""
    ends = ["−∞" if x < 0 else "∞" for x in limits]
    if p.kind is None:
        return " … ".join(
            end if abs(x) == math.inf else format_number(x) for end, x in zip(ends, limits, strict=True)
        )
    sizes = [abs(x) for x in limits if math.isfinite(x)]
    unit = "percent" if p.units[0] == "percent" else p.display_unit(max(sizes, default=0.0))
    found = [float(from_si(x, unit, p.kind)) for x in limits]
    if p.kind.unit != "K" and any(0.0 < abs(x) < 0.01 for x in found):
        return " … ".join(
            end if abs(x) == math.inf else _edge(x, p) for end, x in zip(ends, limits, strict=True)
        )
    if not all(map(math.isfinite, limits)):
        return " … ".join(
            end if abs(x) == math.inf else show(x, p.kind, unit) for end, x in zip(ends, limits, strict=True)
        )
    return f"{' … '.join(map(format_number, found))} {pretty_unit(unit)}".strip()
