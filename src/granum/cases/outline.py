"""What a case file says of its line before anything is solved: units, streams, open ends, and what is still
missing, in words. Reads unfinished lines as well.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from granum.cases.reading import parsed
from granum.core import registry
from granum.core.errors import GranumError, InputError
from granum.core.i18n import _
from granum.core.stand_ins import given_by
from granum.flowsheet.plan import Block, Link, plan
from granum.streams.names import port_label, pretty


class Port(NamedTuple):
    """An inlet of a unit that nothing enters; some may stay so."""

    unit: str
    port: str
    needed: bool

    @property
    def name(self) -> str:
        """``unit.port``."""
        return f"{self.unit}.{self.port}"


@dataclass(frozen=True)
class Outline:
    """A line as far as it is written.

    Parameters
    ----------
    title: of the case. order: units as declared. units: name → type of equipment, None where it is not known.
    feeds: names. links: every stream, outlets that nothing takes included. open_inlets: what nothing enters.
    missing: what a line that can be solved still needs.
    """

    title: str
    order: tuple[str, ...]
    units: dict[str, Any]
    feeds: tuple[str, ...]
    links: tuple[Link, ...]
    open_inlets: tuple[Port, ...]
    missing: tuple[str, ...]
    raw: dict[str, Any] = field(repr=False)

    @property
    def blocks(self) -> tuple[Block, ...]:
        """Units in order of calculation, loops with their torn streams."""
        return plan(self.order, self.links)

    def link_at(self, end: str) -> Link | None:
        """The stream that leaves or enters ``unit.port``."""
        return next((k for k in self.links if end in (k.origin, k.target)), None)

    @property
    def names(self) -> set[str]:
        """Every name that is taken."""
        return {*self.order, *self.feeds, *(k.name for k in self.links if "." not in k.name)}

    def downstream(self, unit: str) -> set[str]:
        """Units that what leaves a unit reaches, itself included."""
        seen, ahead = {unit}, [unit]
        while ahead:
            one = ahead.pop()
            for k in self.links:
                if k.source_unit == one and k.target and k.target_unit not in seen:
                    seen.add(k.target_unit)
                    ahead.append(k.target_unit)
        return seen


def outline(case: str) -> Outline:
    """The outline of the text of a case file."""
    raw = parsed(case, "case")
    tables = {
        name: found if isinstance(found := raw.get(name), dict) else {}
        for name in ("feeds", "units", "streams")
    }
    units = {name: _model(table) for name, table in tables["units"].items() if isinstance(table, dict)}
    feeds = {name: table for name, table in tables["feeds"].items() if isinstance(table, dict)}
    missing: list[str] = []
    links = [
        Link(name, "", _end(units, str(table.get("to", "")), name, "in", missing))
        for name, table in feeds.items()
    ]
    for name, table in tables["streams"].items():
        origin, target = ends_of(table)
        start = _end(units, origin, name, "out", missing)
        if start:
            links.append(Link(name, start, _end(units, target, name, "in", missing)))
    taken = {k.origin for k in links}
    for unit, model in units.items():
        links += [
            Link(f"{unit}.{port}", f"{unit}.{port}", "")
            for port in _outlets(model)
            if f"{unit}.{port}" not in taken
        ]
    entered = {k.target for k in links}
    opened = []
    for unit, model in units.items():
        names = () if model is None else model.inlet_names()
        if names is None and not any(k.target_unit == unit for k in links):
            opened.append(Port(unit, "feed", True))
        optional = () if model is None else model.optional_inlets()
        opened += [
            Port(unit, port, port not in optional) for port in names or () if f"{unit}.{port}" not in entered
        ]
    missing += _missing(units, tables, links, opened)
    return Outline(
        str(raw.get("title", "")),
        tuple(units),
        units,
        tuple(feeds),
        tuple(links),
        tuple(opened),
        tuple(missing),
        raw,
    )


def ends_of(table: Any) -> tuple[str, str]:
    """Origin and target of a stream as it is written."""
    if isinstance(table, list):
        return (str(table[0]) if table else "", str(table[1]) if len(table) > 1 else "")
    if isinstance(table, dict):
        return str(table.get("from", "")), str(table.get("to", ""))
    return "", ""


def _model(table: Mapping[str, Any]) -> Any:
    try:
        thing = registry.find(str(table.get("model", "")))
    except GranumError:
        return None
    return thing if thing.card.sort == "equipment" else None


def _outlets(model: Any) -> tuple[str, ...]:
    return () if model is None else model.outlet_names()


def _end(units: Mapping[str, Any], end: str, stream: str, side: str, missing: list[str]) -> str:
    """An end of a stream as ``unit.port``; empty, and told of, where there is nothing of the name."""
    if not end:
        return ""
    unit, _dot, port = end.partition(".")
    if unit not in units:
        missing.append(
            _("{stream}: there is no equipment '{unit}'.").format(stream=pretty(stream), unit=unit)
        )
        return ""
    model = units[unit]
    if model is None:
        return f"{unit}.{port or stream}"
    names = model.outlet_names() if side == "out" else model.inlet_names()
    if names is None:
        return f"{unit}.{port or stream}"
    if not port and len(names) == 1:
        return f"{unit}.{names[0]}"
    if port not in names:
        missing.append(
            _("{stream}: {unit} has no port '{port}'; it has {ports}.").format(
                stream=pretty(stream), unit=pretty(unit), port=port, ports=", ".join(names)
            )
        )
        return ""
    return end


def _missing(
    units: Mapping[str, Any], tables: Mapping[str, Any], links: list[Link], opened: list[Port]
) -> list[str]:
    found = []
    if not units:
        found.append(_("The line has no equipment yet: add the first piece."))
    if not tables["feeds"]:
        found.append(_("The line has no feed yet: add one."))
    for name, model in units.items():
        table = tables["units"][name]
        if model is None:
            found.append(
                _("{unit}: there is no equipment '{model}'.").format(
                    unit=pretty(name), model=table.get("model", "")
                )
            )
            continue
        given = given_by(list(table), {p.name for p in model.card.parameters})
        for p in model.card.parameters:
            if p.required and p.name not in given:
                found.append(_("{unit}: {label} is missing.").format(unit=pretty(name), label=p.label))
    for port in opened:
        if port.needed:
            told = (
                _("{unit} has no feed yet.")
                if port.port == "feed"
                else _("{unit}: nothing comes into '{port}' yet.")
            )
            found.append(told.format(unit=pretty(port.unit), port=port_label(port.port)))
    if units:
        found += [
            _("{feed} goes nowhere yet.").format(feed=pretty(k.name))
            for k in links
            if not k.origin and not k.target
        ]
    return [text[:1].upper() + text[1:] for text in found]


def identifier(words: str) -> str:
    """Words as a name: ``Hot liquor`` is ``hot_liquor``.

    >>> identifier("Filtre à bande n° 2")
    'filtre_à_bande_n_2'
    """
    return re.sub(r"\W+", "_", words.strip().lower()).strip("_")


def free_name(found: Outline, words: str, exact: bool = False) -> str:
    """A name that nothing in the line has yet."""
    name = identifier(words)
    if not name:
        raise InputError(_("A name needs a letter or a digit."), name="name")
    if exact and name in found.names:
        raise InputError(
            _("There is already something called '{name}'.").format(name=pretty(name)), name="name"
        )
    return numbered(name, found.names)


def numbered(name: str, taken: set[str]) -> str:
    if name not in taken:
        return name
    return next(made for n in range(2, len(taken) + 3) if (made := f"{name}_{n}") not in taken)


def table_of(raw: Any, name: str) -> dict[str, Any]:
    found = raw.get(name) if isinstance(raw, dict) else None
    return found if isinstance(found, dict) else {}
