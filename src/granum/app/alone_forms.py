"""A piece of equipment alone as a form: its parameters, and what enters at each inlet."""

from __future__ import annotations

import json
import shlex
from collections.abc import Mapping
from typing import Any

from granum.app.case_forms import FEED_KINDS, by_volume, case_value
from granum.app.closed_lists import choose_within, materials
from granum.app.forms import card_form, fields_of, offered_unit
from granum.cases.alone import PHASES, case_text, tables
from granum.cases.sizing import duty
from granum.core import registry
from granum.core.errors import ApplicabilityError
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.core.sources import cite
from granum.materials.library import session
from granum.streams.feeding import HUMIDITIES
from granum.streams.names import port_label

LABELS = {"solid_flow": "solid flow", "liquid_flow": "liquid flow", "gas_flow": "gas flow"}
AIRS = {"cooling": "cooling air", "outdoor": "outdoor air", "exhaust": "exhaust air"}


def alone_form(key: str, words: Mapping[str, Any]) -> dict[str, Any]:
    """The form, what stands in its fields, and the case file that it means.

    Names of fields are the words by which command line and Python say the same.
    """
    given = {name: value for name, value in words.items() if value is not None}
    found = tables(key, given)
    name = key.split(".", 1)[1]
    form = card_form(key)
    unit = found["units"][name]
    values = {
        p.name: offered_unit(case_value(unit[p.name]), p)
        for p in registry.find(key).card.parameters
        if p.name in unit
    }
    choose_within(form["parameters"], found["mixture"])
    groups = []
    for port, feed in found["feeds"].items():
        rows, stand = _feed(port, feed, found["mixture"])
        groups.append({"name": port, "title": _port(port), "parameters": rows})
        values |= stand
    rows, stand = _substances(found["mixture"])
    values |= stand
    for row in (*rows, *(row for group in groups for row in group["parameters"])):
        row["required"] = row["name"] in values
    thing = registry.find(key)
    spare = [port for port in thing.optional_inlets() if port not in found["feeds"]]
    return {
        "card": key,
        "title": form["title"],
        "summary": form["summary"],
        "doc": form["doc"],
        "citation": cite(thing.card.source),
        "parameters": form["parameters"],
        "outputs": form["outputs"],
        "groups": [*groups, {"name": "mixture", "title": _("Substances"), "parameters": rows}],
        "without": spare,
        "ports": {port: port_label(port) for port in (*(thing.inlet_names() or ()), *thing.outlet_names())},
        "values": values,
        "case": case_text(key, given),
        **_sized(key),
        "command": " ".join(["granum calc", key, *(shlex.quote(f"{n}={v}") for n, v in given.items())]),
        "python": _python(key, given, {p.name for p in thing.card.parameters}),
    }


def _sized(key: str) -> dict[str, Any]:
    """By what it is sized, or why it has no size."""
    try:
        return {"duty": duty(key)._asdict(), "no_size": ""}
    except ApplicabilityError as reason:
        return {"duty": None, "no_size": reason.message}


def _port(port: str) -> str:
    text = _(AIRS[port]) if port in AIRS else port_label(port)
    return text[0].upper() + text[1:]


def _row(name: str, p: Parameter, label: str = "") -> dict[str, Any]:
    """A field that may stay empty."""
    row = fields_of(p) | {"name": name}
    return row | ({"label": label} if label else {})


def _feed(
    port: str, feed: Mapping[str, Any], mixture: Mapping[str, Any]
) -> tuple[list[dict[str, Any]], dict[str, str]]:
    """Fields of a stream that enters: what it is said by now, and its state."""
    rows, values = [], {}
    moist = "gas_flow" in feed and set(mixture.get("gases", ())) & set(mixture.get("liquids", ()))
    offered = {"temperature", "pressure", *(HUMIDITIES if moist else ())}
    for name, kind in FEED_KINDS.items():
        if name in feed or name in offered:
            usual = {"temperature": 298.15, "pressure": 101325.0}.get(name, "")
            p = Parameter(name, KINDS[kind], default=usual or None)
            row = _row(f"{port}.{name}", p, _(LABELS[name]) if name in LABELS else "")
            rows.append(row | by_volume(name, row["units"]))
            if name in feed:
                values[f"{port}.{name}"] = case_value(feed[name])
    for phase, shares in PHASES.items():
        listed = mixture.get(phase, ())
        if len(listed) > 1 and feed.get(shares):
            for species in listed:
                path = f"{port}.{shares}.{species}"
                label = _("share of {species}").format(species=session().label(species))
                share = Parameter("mass_fraction", KINDS["MassFraction"], default=None)
                rows.append(_row(path, share, label))
                values[path] = case_value(feed[shares].get(species, 0))
    sizes = feed.get("sizes")
    if isinstance(sizes, Mapping) and sizes.get("law"):
        rows.append(
            _row(f"{port}.sizes", Parameter("size_distribution", default=None, law="size_distribution"))
        )
        values[f"{port}.sizes"] = json.dumps(sizes, ensure_ascii=False)
    return rows, values


def _substances(mixture: Mapping[str, Any]) -> tuple[list[dict[str, Any]], dict[str, str]]:
    """What the streams are made of; one solid is chosen from the library, several are written."""
    rows, values = [], {}
    for phase, label in (("solids", _("solids")), ("liquids", _("liquids")), ("gases", _("gases"))):
        listed = mixture.get(phase)
        if not listed:
            continue
        row = _row(f"mixture.{phase}", Parameter(phase, default=None), label)
        if phase == "solids" and len(listed) == 1:
            row["options"] = materials(session().names("solid"))
        rows.append(row)
        said = listed if row["options"] else map(session().label, listed)
        values[f"mixture.{phase}"] = ", ".join(said)
    return rows, values


def _python(key: str, given: Mapping[str, Any], parameters: set[str]) -> str:
    """The call that says the same."""
    own = {n: v for n, v in given.items() if n.partition(".")[0] in parameters}
    streams: dict[str, dict[str, Any]] = {}
    for name, value in given.items():
        if name not in own:
            head, _dot, rest = name.partition(".")
            streams.setdefault(head, {})[rest] = value
    inputs = [f"{n}={v!r}" for n, v in own.items()] + [f"{n}={v!r}" for n, v in streams.items()]
    return f"import granum as gr\n\nrun = gr.alone({', '.join([repr(key), *inputs])}).solve()"
