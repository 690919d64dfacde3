"""A piece of equipment alone: a line of it with an ordinary feed, opened from its name, changed by words.

Words are those of ``granum study``: parameters (``area=12m2``), the streams at the inlets by port
(``feed.solid_flow=400kg/h``) and the substances under ``mixture`` (``mixture.solids=quartz``). What is not
said is as in the folder ``units``, one file a domain.
"""

from __future__ import annotations

import copy
import json
import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any

from granum.cases.reading import read_text
from granum.cases.schema import FeedTable
from granum.cases.worded import as_toml, put
from granum.core import registry
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.flowsheet.run import Line

PHASES = {"solids": "solid", "liquids": "liquid", "gases": "gas"}
ONE_WAY, OTHER_WAY = ("mass_flow", "solids_mass_fraction"), ("solid_flow", "liquid_flow")


@cache
def _written(domain: str) -> dict[str, Any]:
    place = files("granum") / "cases" / "units" / f"{domain}.toml"
    return tomllib.loads(place.read_text(encoding="utf-8")) if place.is_file() else {}


def ordinary(key: str) -> dict[str, Any]:
    """The parameters with which a piece of equipment opens alone.

    >>> ordinary("streams.pump")
    {'pressure_rise': '4 bar'}
    """
    domain, name = key.split(".", 1)
    own = _written(domain).get("unit", {}).get(name, {})
    return {word: copy.deepcopy(value) for word, value in own.items() if word != "in"}


def _equipment(key: str) -> Any:
    thing = registry.find(key)
    if thing.card.sort != "equipment":
        raise InputError(
            _("'{model}' is a {sort}, not equipment.").format(model=key, sort=_(thing.card.sort))
        )
    return thing


def tables(key: str, words: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """The tables of the case: ``title``, ``mixture``, ``feeds`` by port, ``units`` with the one unit.

    >>> tables("streams.heater", {"feed.temperature": "30 degC"})["feeds"]["feed"]["temperature"]
    '30 degC'
    """
    thing = _equipment(key)
    domain, name = key.split(".", 1)
    written = _written(domain)
    own = copy.deepcopy(written["unit"][name])
    inlets = own.pop("in")
    mixture = copy.deepcopy(written["mixtures"][inlets.pop("mixture")])
    feeds = {port: copy.deepcopy(written["feeds"][feed]) for port, feed in inlets.items()}
    found = {"title": thing.card.title, "mixture": mixture, "feeds": feeds, "units": {name: own}}
    for word, value in (words or {}).items():
        _say(thing, found, own, word, value)
    _drop_what_is_gone(mixture, feeds)
    for port, feed in feeds.items():
        feeds[port] = {"to": f"{name}.{port}"} | feed
    found["units"][name] = {"model": key} | own
    return found


def _say(thing: Any, found: dict[str, Any], own: dict[str, Any], word: str, value: Any) -> None:
    """One word put where it belongs."""
    head, dot, rest = word.partition(".")
    if isinstance(value, str) and value.lstrip().startswith(("{", "[")):
        try:
            value = json.loads(value)
        except ValueError:
            raise InputError(_("'{name}' is not valid JSON.").format(name=word), name=word) from None
    feeds = found["feeds"]
    if head in {p.name for p in thing.card.parameters}:
        if value == "" and not dot:
            own.pop(head, None)
        else:
            put(own, word, value)
    elif head == "mixture" and dot:
        listed = rest in PHASES and isinstance(value, str)
        put(found["mixture"], rest, [part.strip() for part in value.split(",")] if listed else value)
    elif not dot and head in thing.optional_inlets() and str(value) in ("no", _("no"), "False"):
        feeds.pop(head, None)
    elif dot and (head in feeds or head in (thing.inlet_names() or (head,))):
        field = rest.partition(".")[0]
        if field not in FeedTable.model_fields:
            raise unknown_name(_("Input"), word, [f"{head}.{n}" for n in FeedTable.model_fields], _for(thing))
        feed = feeds.setdefault(head, {})
        for these, others in ((ONE_WAY, OTHER_WAY), (OTHER_WAY, ONE_WAY)):
            if field in these:  # the flow said one way is not also said the other
                for other in others:
                    feed.pop(other, None)
        if value == "":
            feed.pop(rest, None)
        else:
            put(feed, rest, value)
    else:
        known = [p.name for p in thing.card.parameters]
        known += [f"{port}.{name}" for port in feeds for name in FeedTable.model_fields if name != "to"]
        raise unknown_name(_("Input"), word, known, _for(thing))


def _for(thing: Any) -> str:
    return _("for {owner}").format(owner=thing.card.key)


def _drop_what_is_gone(mixture: Mapping[str, Any], feeds: Mapping[str, dict[str, Any]]) -> None:
    """Shares of substances that are no longer there."""
    for phase, shares in PHASES.items():
        for feed in feeds.values():
            if set(feed.get(shares, {})) - set(mixture.get(phase, ())):
                del feed[shares]


def case_text(key: str, words: Mapping[str, Any] | None = None) -> str:
    """The case file of a piece of equipment alone."""
    found = tables(key, words)
    parts = [f"title = {as_toml(found['title'])}", _table("mixture", found["mixture"])]
    parts += [_table(f"feeds.{port}", feed) for port, feed in found["feeds"].items()]
    parts += [_table(f"units.{name}", unit) for name, unit in found["units"].items()]
    return "\n\n".join(parts) + "\n"


def _table(name: str, values: Mapping[str, Any]) -> str:
    rows = [f"{key} = {as_toml(value)}" for key, value in values.items()]
    return "\n".join([f"[{name}]", *rows])


def alone(key: str, **inputs: Any) -> Line:
    """A piece of equipment as a line that can be solved; the streams at its inlets as dictionaries.

    >>> line = alone("streams.heater", temperature="70 degC", feed={"liquid_flow": "2 t/h"})
    >>> round(line.solve().units["heater"].values.temperature - 273.15)
    70
    """
    thing = _equipment(key)
    parameters = {p.name for p in thing.card.parameters}
    words: dict[str, Any] = {}
    for name, value in inputs.items():
        nested = isinstance(value, Mapping) and name not in parameters
        words |= {f"{name}.{part}": v for part, v in value.items()} if nested else {name: value}
    return read_text(case_text(key, words), name=key)
