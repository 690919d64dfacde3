"""Streams of a line that is built: what is connected, divided, led around, renamed and taken out. Text of
a case file in, text out.
"""

from __future__ import annotations

import re
from typing import Any

from granum.cases.outline import (
    Outline,
    ends_of,
    free_name,
    identifier,
    numbered,
    outline,
    port_label,
    table_of,
)
from granum.cases.sections import (
    checked,
    key,
    renamed_table,
    sections,
    with_table,
    with_value,
    without_table,
    without_value,
)
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.flowsheet.plan import Link
from granum.streams.names import pretty

MIXER, SPLITTER = "streams.mixer", "streams.splitter"
PURGE = "20 %"
CIRCULATING = ("filtrate", "washings", "overflow", "exhaust", "liquid", "water", "drain", "condensate")
"""Outlets whose fluid builds up where all of it goes around: they are purged when they close a loop."""


def connect(case: str, origin: str, target: str) -> str:
    """A stream from a feed or ``unit.outlet`` to ``unit.inlet``.

    What leads elsewhere already is divided, an inlet that is taken gets a mixer, and a loop of liquid or gas
    gets a purge, so that what does not leave with a product does not build up.
    """
    found = outline(case)
    link = _leaving(found, origin)
    unit, _dot, port = target.partition(".")
    if unit not in found.order:
        raise unknown_name(_("Unit"), unit, found.order)
    model = found.units[unit]
    ports = model.inlet_names() if model is not None else None
    if ports is not None:
        port = port or ports[0]
        if port not in ports:
            raise unknown_name(_("Inlet"), port, ports, _("of '{owner}'").format(owner=unit))
    if link is not None and link.source_unit == unit and link.origin:
        raise InputError(_("{unit} cannot feed itself directly.").format(unit=pretty(unit)))
    if link is not None and link.target == f"{unit}.{port}":
        return case
    purged = (
        link is not None
        and bool(link.origin)
        and unit in _upstream(found, link.source_unit)
        and _circulates(found, link.origin)
    )
    if link is not None and link.target:
        case, origin = _divided(case, found, link)
        found = outline(case)
    elif purged:
        case, origin = _through_splitter(case, origin, _("purge"), PURGE)
        found = outline(case)
    if ports is None:
        port = port if port and not found.link_at(f"{unit}.{port}") else _port(found, unit, origin)
    elif (occupied := next((k for k in found.links if k.target == f"{unit}.{port}"), None)) is not None:
        case, unit, port = _joined(case, found, occupied, f"{unit}.{port}", origin)
        found = outline(case)
    return checked(_led(case, found, origin, f"{unit}.{port}"))


def _leaving(found: Outline, origin: str) -> Any:
    """The stream of that name or of that outlet."""
    link = next((k for k in found.links if origin in (k.origin, k.name)), None)
    if link is None:
        raise unknown_name(_("Feed or outlet"), origin, [k.origin or k.name for k in found.links])
    return link


def _upstream(found: Outline, unit: str) -> set[str]:
    """Units whose products reach a unit, itself included."""
    return {one for one in found.order if unit in found.downstream(one)}


def _circulates(found: Outline, origin: str, seen: frozenset[str] = frozenset()) -> bool:
    unit, _dot, port = origin.partition(".")
    if port in CIRCULATING:
        return True
    model = found.units.get(unit)
    if (
        unit in seen
        or model is None
        or model.card.key not in (MIXER, "streams.heater", "streams.humid_mixer")
    ):
        return False
    return any(
        _circulates(found, k.origin, seen | {unit}) for k in found.links if k.target_unit == unit and k.origin
    )


def _through_splitter(case: str, origin: str, word: str, share: str) -> tuple[str, str]:
    """A splitter behind an outlet; gives the end that goes on."""
    name = free_name(outline(case), word)
    case = with_table(case, ("units", name), {"model": SPLITTER, "side_fraction": share})
    return _led(case, outline(case), origin, f"{name}.feed"), f"{name}.product"


def _divided(case: str, found: Outline, link: Any) -> tuple[str, str]:
    """A stream that leads somewhere divided in two; gives the end of the second part."""
    name = free_name(found, _("divider"))
    case = with_table(case, ("units", name), {"model": SPLITTER, "side_fraction": "50 %"})
    case = _leading(case, found, link.name, f"{name}.feed")
    case = with_value(
        case,
        ("streams",),
        _free_stream(outline(case), f"{name}_{link.target_unit}"),
        [f"{name}.product", link.target],
    )
    return case, f"{name}.side"


def _joined(case: str, found: Outline, occupied: Any, target: str, origin: str) -> tuple[str, str, str]:
    """Room at an inlet that is taken: the mixer before it, or a new one; gives unit and port for what comes
    in addition.
    """
    before = found.units.get(occupied.source_unit) if occupied.origin else None
    if before is not None and before.card.key == MIXER:
        return case, occupied.source_unit, _port(found, occupied.source_unit, origin)
    name = free_name(found, _("mixer"))
    case = with_table(case, ("units", name), {"model": MIXER})
    case = _leading(case, found, occupied.name, f"{name}.{occupied.name.replace('.', '_')}")
    case = with_value(
        case,
        ("streams",),
        _free_stream(outline(case), f"{name}_{target.partition('.')[0]}"),
        [f"{name}.product", target],
    )
    return case, name, _port(outline(case), name, origin)


def _port(found: Outline, unit: str, origin: str) -> str:
    """A free port of a mixer, named after what enters."""
    taken = {k.target.partition(".")[2] for k in found.links if k.target_unit == unit}
    return numbered(identifier(origin.replace(".", "_")), taken)


def _led(case: str, found: Outline, origin: str, target: str) -> str:
    """A feed or an open outlet led to an inlet."""
    link = _leaving(found, origin)
    if not link.origin or "." not in link.name:
        return _leading(case, found, link.name, target)
    name = _free_stream(found, _named_after(link.origin))
    return with_value(case, ("streams",), name, [link.origin, target])


def _named_after(origin: str) -> str:
    """The name of a connection after the outlet it comes from, in words of the user's language."""
    unit, _dot, port = origin.partition(".")
    return identifier(f"{unit} {port_label(port)}")


def _free_stream(found: Outline, wanted: str) -> str:
    return numbered(identifier(wanted), found.names)


def _leading(case: str, found: Outline, stream: str, target: str) -> str:
    """A stream or feed that is written led elsewhere, to nowhere where ``target`` is empty."""
    if stream in found.feeds and not next(k for k in found.links if k.name == stream).origin:
        return with_value(case, ("feeds", stream), "to", target)
    table = table_of(found.raw, "streams").get(stream)
    if isinstance(table, dict):
        return with_value(case, ("streams", stream), "to", target)
    origin, _old = ends_of(table)
    if not target and stream.startswith((origin.replace(".", "_"), _named_after(origin))):
        return without_value(case, ("streams",), stream)  # a name that was only made for the connection
    return with_value(case, ("streams",), stream, [origin, target] if target else [origin])


def _without_stream(case: str, found: Outline, stream: str) -> str:
    return without_value(case, ("streams",), stream) if stream in table_of(found.raw, "streams") else case


def disconnect(case: str, end: str) -> str:
    """What enters ``unit.inlet``, or leaves a feed or ``unit.outlet``, ends open."""
    found = outline(case)
    link = next((k for k in found.links if end in (k.target, k.origin, k.name)), None)
    if link is None:
        raise unknown_name(_("Inlet or outlet"), end, [k.target for k in found.links if k.target])
    return checked(_leading(case, found, link.name, "")) if link.target else case


def lead(case: str, origin: str, target: str) -> str:
    """What leaves a feed or ``unit.outlet`` led to another inlet than so far."""
    return connect(disconnect(case, origin), origin, target)


def replace(case: str, origin: str, target: str) -> str:
    """What enters an inlet replaced by another stream; the one before ends open."""
    return connect(disconnect(case, target), origin, target)


def bypass(case: str, unit: str, inlet: str = "", outlet: str = "", share: str = "10 %") -> str:
    """A share of what enters a unit led around it, to what leaves it."""
    found = outline(case)
    if unit not in found.order:
        raise unknown_name(_("Unit"), unit, found.order)
    model = found.units[unit]
    inlets, outlets = (model.inlet_names() or (), model.outlet_names()) if model is not None else ((), ())
    into = next(
        (k for k in found.links if k.target == f"{unit}.{inlet or (inlets[0] if inlets else '')}"), None
    )
    out = found.link_at(f"{unit}.{outlet or (outlets[0] if outlets else '')}")
    if into is None or out is None:
        raise InputError(
            _("{unit} needs a stream at its inlet before it can be bypassed.").format(unit=pretty(unit))
        )
    splitter = free_name(found, _("bypass"))
    case = with_table(case, ("units", splitter), {"model": SPLITTER, "side_fraction": share})
    case = _leading(case, found, into.name, f"{splitter}.feed")
    case = with_value(
        case,
        ("streams",),
        _free_stream(outline(case), f"{splitter}_{unit}"),
        [f"{splitter}.product", into.target],
    )
    now = outline(case)
    mixer = free_name(now, _("mixer"))
    case = with_table(case, ("units", mixer), {"model": MIXER})
    if out.target:
        case = _leading(case, outline(case), out.name, f"{mixer}.{identifier(out.origin.replace('.', '_'))}")
        case = with_value(
            case,
            ("streams",),
            _free_stream(outline(case), f"{mixer}_{out.target_unit}"),
            [f"{mixer}.product", out.target],
        )
    else:
        case = _led(case, outline(case), out.origin, f"{mixer}.{identifier(out.origin.replace('.', '_'))}")
    return checked(
        with_value(
            case,
            ("streams",),
            _free_stream(outline(case), _named_after(f"{splitter}.side")),
            [f"{splitter}.side", f"{mixer}.bypass"],
        )
    )


def remove(case: str, name: str) -> str:
    """A unit or a feed taken out. What went straight through a unit of one inlet and one main outlet goes on
    to where that led; the other streams end open. Specifications and fits of the unit go with it.
    """
    found = outline(case)
    if name in found.feeds and name not in found.order:
        return checked(without_table(case, ("feeds", name)))
    if name not in found.order:
        raise unknown_name(_("Unit or feed"), name, found.names)
    into = [k for k in found.links if k.target_unit == name and k.target]
    out = [k for k in found.links if k.source_unit == name and k.origin]
    model = found.units[name]
    through = model is not None and _domain(model) == "streams" and len(into) == 1
    main = next((k for k in out if k.target and k.origin.endswith(".product")), None) if through else None
    for k in out:
        case = _without_stream(case, found, k.name)
    for k in into:
        case = _leading(case, found, k.name, main.target if main else "")
    gone = {name, *(k.name for k in out)}
    for table, text in (("specifications", ("vary", "so_that")), ("fits", ())):
        for title, spec in table_of(found.raw, table).items():
            if isinstance(spec, dict) and (
                any(str(spec.get(word, "")).split(".")[0] in gone for word in text)
                or any(str(path).split(".")[0] == name for path in table_of(spec, "gives"))
            ):
                case = without_table(case, (table, title))
    for path in table_of(found.raw, "uncertain"):
        if path.split(".")[0] == name:
            case = without_value(case, ("uncertain",), path)
    return checked(without_table(case, ("units", name)))


def _domain(model: Any) -> str:
    return model.card.key.partition(".")[0]


def rename(case: str, old: str, new: str) -> str:
    """A unit, a feed or a stream under another name, wherever the case speaks of it."""
    found = outline(case)
    stream = next((k for k in found.links if k.name == old and k.origin), None)
    if old not in found.order and old not in found.feeds and stream is None:
        raise unknown_name(_("Unit, feed or stream"), old, found.names)
    if identifier(new) == old:
        return case
    name = free_name(found, new, exact=True)
    if stream is not None and old not in found.order:
        return checked(_stream_renamed(case, stream, name))
    table = "units" if old in found.order else "feeds"
    case = renamed_table(case, (table, old), name)
    if table == "feeds" and old in found.order:
        return checked(case)
    return checked(_respelled(case, old, name))


def _stream_renamed(case: str, stream: Link, name: str) -> str:
    """A stream under another name; one that only its outlet named so far gets one of its own."""
    if "." in stream.name:
        return with_value(case, ("streams",), name, [stream.origin])
    if any(s.path == ("streams", stream.name) for s in sections(case)):
        return _respelled(renamed_table(case, ("streams", stream.name), name), stream.name, name)
    lines = case.split("\n")
    written = re.compile(rf"^(\s*)([\"']?){re.escape(stream.name)}\2(?=\s*=)")
    for s in sections(case):
        if s.path == ("streams",):
            for i in range(s.first + 1, s.last):
                lines[i] = written.sub(lambda m: m[1] + key(name), lines[i])
    return _respelled("\n".join(lines), stream.name, name)


def _respelled(case: str, old: str, new: str) -> str:
    """Names of inputs and figures of a renamed unit or feed: ``old.figure`` in keys and texts outside the
    tables that describe the line.
    """
    word = re.compile(rf"(?<![\w.-]){re.escape(old)}(?=\.\w)")
    alone = re.compile(rf"(?P<q>[\"']){re.escape(old)}(?P=q)")
    lines = case.split("\n")
    inside = ""
    starts = {s.first: s.path for s in sections(case)}
    for i, line in enumerate(lines):
        if i in starts:
            inside = starts[i][0]
            if inside in ("uncertain", "dynamic"):
                lines[i] = word.sub(new, line)
            continue
        code, hash_, comment = _split_comment(line)
        if inside in ("streams", "feeds") and (inside == "streams" or re.match(r"\s*to\s*=", code)):
            head, equals, tail = code.partition("=")
            code = head + equals + alone.sub(lambda m: f"{m['q']}{new}{m['q']}", word.sub(new, tail))
        elif inside in ("specifications", "fits", "uncertain", "quantities", "study", "dynamic"):
            code = word.sub(new, code)
            if inside == "dynamic" and re.match(rf"\s*[\"']?{re.escape(old)}[\"']?\s*=", code):
                code = re.sub(rf"[\"']?{re.escape(old)}[\"']?(\s*=)", rf"{new}\1", code, count=1)
        lines[i] = code + hash_ + comment
    return "\n".join(lines)


def _split_comment(line: str) -> tuple[str, str, str]:
    """A line before and after the sign of its comment."""
    quote = ""
    for i, letter in enumerate(line):
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "\"'":
            quote = letter
        elif letter == "#":
            return line[:i], "#", line[i + 1 :]
    return line, "", ""
