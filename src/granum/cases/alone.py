"""A piece of equipment alone: a line of it with an ordinary feed, opened from its name, changed by words.

Words are those of ``granum study``: parameters (``area=12m2``), the streams at the inlets by port
(``feed.solid_flow=400kg/h``), the substances under ``mixture`` (``mixture.solids=quartz``) and those of one's
own under ``solid``, ``fluid`` and ``solute`` (``solid.PVC.density=1400kg/m3``). What is not said is as in the
folder ``units``, one file a domain.
"""

from __future__ import annotations

import copy
import json
from collections.abc import Iterable, Mapping, Set
from functools import cache
from importlib.resources import files
from typing import Any

import tomli

from granum.cases.flows import BY_PHASE, BY_TOTAL, MOISTURES, in_phases, in_totals
from granum.cases.reading import read_text
from granum.cases.schema import OWN, FeedTable
from granum.cases.tables import as_toml, put
from granum.cases.widening import widen
from granum.core import registry
from granum.core.conversion import convert
from granum.core.documents import table_in
from granum.core.errors import GranumError, InputError, unknown_name
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.core.stand_ins import stands_for
from granum.core.words import plain
from granum.flowsheet.run import Line
from granum.materials.library import session
from granum.streams.feeding import HUMIDITIES, PHASES

NOTHING = Parameter("nothing")
FLOWS = ("mass_flow", "solid_flow", "liquid_flow", "gas_flow")
FIELDS = [name for name in FeedTable.model_fields if name != "to"]


@cache
def _written(domain: str) -> dict[str, Any]:
    place = files("granum") / "cases" / "units" / f"{domain}.toml"
    return tomli.loads(place.read_text(encoding="utf-8")) if place.is_file() else {}


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
    before = _present(mixture)
    described: dict[str, Any] = {}
    names = {
        w.split(".")[1].strip('"') for w in words or {} if w.partition(".")[0] in OWN and w.count(".") > 1
    }
    for word in sorted(words or {}, key=_laws_first):
        value = (words or {})[word]
        if word.partition(".")[0] in OWN and word.count(".") > 1:
            put(described, word, _read(word, value))
        else:
            _say(thing, found, own, word, _read(word, value), names)
    for word, displaced in thing.instead.items():
        if (words or {}).get(word, "") != "" and displaced not in (words or {}):
            own.pop(displaced, None)
    for port, feed in feeds.items():  # a moisture that was typed stands for the liquid of the example
        if any(f"{port}.{moisture}" in (words or {}) for moisture in MOISTURES):
            for word in ("liquid_flow", "solids_mass_fraction"):
                if f"{port}.{word}" not in (words or {}):
                    feed.pop(word, None)
    _moisten(mixture, feeds, words or {})
    _one_gas(key, written["unit"][name]["in"], written["feeds"], words or {})
    _not_empty(thing, feeds)
    _drop_what_is_gone(mixture, feeds, words or {})
    widen(mixture, feeds, words or {})
    _fill_up(mixture, feeds, words or {})
    _drop_laws_of({name for _phase, name in before - _present(mixture)}, own, words or {})
    for port, feed in feeds.items():
        feeds[port] = {"to": f"{name}.{port}"} | feed
    found["units"][name] = {"model": key} | own
    return found | described


def _laws_first(word: str) -> tuple[bool, int]:
    """A law is chosen before its parameters are told, the outer one before the inner."""
    return not word.endswith(".law"), word.count(".")


def _read(word: str, value: Any) -> Any:
    """A value as typed, or the table or list that its text holds."""
    if isinstance(value, str) and value.lstrip().startswith(("{", "[")):
        return table_in(value, word)
    return value


def _say(
    thing: Any, found: dict[str, Any], own: dict[str, Any], word: str, value: Any, described: Set[str]
) -> None:
    """One word put where it belongs; substances that are described keep the names they are described by."""
    head, dot, rest = word.partition(".")
    feeds = found["feeds"]
    wanted = stands_for(word, {p.name for p in thing.card.parameters})
    if wanted is not None:  # a diameter in place of the radius that the example has
        own.pop(wanted, None)
        put(own, word, value)
    elif head in {p.name for p in thing.card.parameters}:
        if value == "" and not dot:
            own.pop(head, None)
        else:
            put(own, word, value)
    elif head == "mixture" and dot:
        listed = rest in PHASES and isinstance(value, str)
        parts = library_names(rest, map(str.strip, value.split(",")), described) if listed else value
        put(found["mixture"], rest, parts)
    elif not dot and head in thing.optional_inlets() and str(value) in ("no", _("no"), "False"):
        feeds.pop(head, None)
    elif dot and (head in feeds or head in (thing.inlet_names() or (head,))):
        field = rest.partition(".")[0]
        if field not in FeedTable.model_fields:
            there = [f"{head}.{n}" for n in FIELDS]
            raise unknown_name(_("Input"), word, there, _for(thing), strict=True)
        feed = feeds.setdefault(head, {})
        for these, others, said in ((BY_TOTAL, BY_PHASE, in_totals), (BY_PHASE, BY_TOTAL, in_phases)):
            if field in these and value != "" and any(other in feed for other in others):
                # the flow of the example said this way, so that what is not said stays
                feed |= said({other: feed.pop(other) for other in (*others, *MOISTURES) if other in feed})
        if value == "":
            feed.pop(rest, None)
        else:
            put(feed, rest, value)
    elif dot and rest.partition(".")[0] in FIELDS:
        raise InputError(
            _("Nothing enters {owner} by '{port}'. Known names: {names}.").format(
                owner=thing.card.key, port=head, names=", ".join(f"{port}.{rest}" for port in feeds)
            ),
            name=word,
        )
    else:
        if word in {p.name for p in thing.card.outputs}:
            raise InputError(
                _(
                    "'{name}' is what {owner} answers, not an input. To have a value of it, size for it: "
                    "'granum calc' with '--solve size', 'granum.size' in Python, in a case file a table "
                    "[specifications.NAME] with 'vary', 'so_that' and 'equals'."
                ).format(name=word, owner=thing.card.key),
                name=word,
            )
        known = [p.name for p in thing.card.parameters]
        known += [f"{port}.{name}" for port in feeds for name in FIELDS]
        raise unknown_name(_("Input"), word, known, _for(thing), meant=_called(thing, word))


def _called(thing: Any, word: str) -> str | None:
    """The parameter that the glossary calls so, in either language."""
    said = plain(word.replace("_", " "))
    for p in thing.card.parameters:
        if p.term is not None and said in map(plain, (p.term.en, p.term.fr, *p.term.also)):
            return p.name
    return None


def _for(thing: Any) -> str:
    return _("for {owner}").format(owner=thing.card.key)


def _one_gas(
    key: str, inlets: Mapping[str, str], ordinary_feeds: Mapping[str, Any], said: Mapping[str, Any]
) -> None:
    """Refuses gas said of what a machine works on where its gas has an inlet of its own: it would leave with
    the exhaust and do nothing.
    """
    if "gas" not in inlets:
        return
    for port, feed in inlets.items():
        word = f"{port}.gas_flow"
        if port not in ("gas", "mixture") and "gas_flow" not in ordinary_feeds[feed] and said.get(word):
            raise InputError(
                _(
                    "The gas of {owner} enters at 'gas': say 'gas.gas_flow'. With '{word}' it would come "
                    "with what is treated and leave at once, without effect."
                ).format(owner=key, word=word),
                name=word,
            )


def _not_empty(thing: Any, feeds: Mapping[str, Mapping[str, Any]]) -> None:
    """Refuses a stream that the equipment can do without and that is said to be nothing."""
    for port in set(feeds) & set(thing.optional_inlets()):
        flows = [value for name, value in feeds[port].items() if name in FLOWS]
        if flows and all(str(flow).split()[:1] and _zero(str(flow).split()[0]) for flow in flows):
            raise InputError(
                _("Nothing flows in at '{port}'. To run without this stream say {port}=\"no\".").format(
                    port=port
                ),
                name=port,
            )


def _zero(number: str) -> bool:
    try:
        return float(number.replace(",", ".")) == 0.0
    except ValueError:
        return False


def _moisten(
    mixture: Mapping[str, Any], feeds: Mapping[str, dict[str, Any]], said: Mapping[str, Any]
) -> None:
    """A humidity that was said stands for that of the example and for the share of its vapor."""
    for port, feed in feeds.items():
        own = [word for word in HUMIDITIES if said.get(f"{port}.{word}", "") != ""]
        if not own:
            continue
        for word in set(HUMIDITIES) - set(own):
            feed.pop(word, None)
        if isinstance(feed.get("gas"), dict) and not any(
            word == f"{port}.gas" or word.startswith(f"{port}.gas.") for word in said
        ):
            dry = {n: v for n, v in feed.pop("gas").items() if n not in mixture.get("liquids", ())}
            if len(dry) > 1:
                shares = {n: float(convert(v, Parameter(n, KINDS["MassFraction"]))) for n, v in dry.items()}
                feed["gas"] = {n: share / sum(shares.values()) for n, share in shares.items()}


def _drop_what_is_gone(
    mixture: Mapping[str, Any], feeds: Mapping[str, dict[str, Any]], said: Mapping[str, Any]
) -> None:
    """Shares of substances that are no longer there; with them those of the example that remain, unless
    somebody said some. A gas that takes the place of another has its share.
    """
    for phase, shares in PHASES.items():
        for port, feed in feeds.items():
            own = {word for word in said if word.startswith(f"{port}.{shares}.")}
            there, wanted = feed.get(shares, {}), mixture.get(phase, ())
            gone, new = set(there) - set(wanted), [name for name in wanted if name not in there]
            if phase == "gases" and len(gone) == len(new) == 1 and not own and f"{port}.{shares}" not in said:
                feed[shares] = {new[0] if name in gone else name: share for name, share in there.items()}
            elif gone and own:
                kept = {
                    n: v for n, v in feed[shares].items() if n not in gone or f"{port}.{shares}.{n}" in own
                }
                feed[shares] = kept
            elif gone and f"{port}.{shares}" not in said:
                del feed[shares]


def _fill_up(
    mixture: Mapping[str, Any], feeds: Mapping[str, dict[str, Any]], said: Mapping[str, Any]
) -> None:
    """The shares of a phase that were not said fill up those that were, in the proportions of the example; a
    single substance that the example lacks takes what is left.
    """
    for port, feed in feeds.items():
        for phase, shares in PHASES.items():
            there = feed.get(shares)
            if isinstance(there, dict) and any(f"{port}.{shares}.{name}" in said for name in there):
                missing = [name for name in mixture.get(phase, ()) if name not in there]
                there |= dict.fromkeys(missing, 1.0) if len(missing) == 1 else {}
            own = {name for name in there or () if f"{port}.{shares}.{name}" in said}
            if not own or f"{port}.{shares}" in said or not isinstance(there, dict) or own == set(there):
                continue
            try:
                numbers = {
                    n: float(convert(v, Parameter(n, KINDS["MassFraction"]))) for n, v in there.items()
                }
            except GranumError:  # told where the feed is read
                continue
            left = 1.0 - sum(numbers[name] for name in own)
            rest = sum(number for name, number in numbers.items() if name not in own)
            if left >= 0.0 and rest > 0.0:
                filled = {n: float(f"{numbers[n] * left / rest:.12g}") for n in numbers if n not in own}
                feed[shares] = {n: filled.get(n, v) for n, v in there.items()}


def library_names(phase: str, words: Iterable[str], described: Set[str] = frozenset()) -> list[str]:
    """What the library calls substances; what it does not know stays as it is, to be refused in words, as do
    the names of those that are ``described``.
    """
    sorts = {"liquids": ("fluid", "solute"), "solids": ("solid",), "gases": ("fluid",)}[phase]
    return [
        word if word in described else (session().called(word, *sorts) or word).partition(" in ")[0]
        for word in words
    ]


def _present(mixture: Mapping[str, Any]) -> set[tuple[str, str]]:
    return {(phase, name) for phase in PHASES for name in mixture.get(phase, ())}


def _drop_laws_of(gone: set[str], own: dict[str, Any], said: Mapping[str, Any]) -> None:
    """Parameters of the example, not said by anybody, that name a substance which is no longer there."""
    kept = {word.partition(".")[0] for word in said}
    for name, value in list(own.items()):
        named = value.values() if isinstance(value, Mapping) else [value]
        if name not in kept and any(isinstance(v, str) and v in gone for v in named):
            del own[name]


def assumed(key: str, words: Mapping[str, Any] | None = None) -> dict[str, str]:
    """What was not said and is as in the ordinary example, in the words that would change it.

    >>> assumed("streams.heater", {"temperature": "70 degC"})["mixture.liquids"]
    'water'
    """
    found = tables(key, words)
    (unit,) = found["units"].values()
    given = {name: value for name, value in unit.items() if name != "model"} | {
        "mixture": {name: found["mixture"][name] for name in PHASES if found["mixture"].get(name)}
    }
    given |= {port: {n: v for n, v in feed.items() if n != "to"} for port, feed in found["feeds"].items()}
    said = tuple(words or {})
    return {
        word: text
        for word, text in _flat(given)
        if not any(word == name or word.startswith(f"{name}.") for name in said)
    }


def _flat(given: Mapping[str, Any], before: str = "") -> list[tuple[str, str]]:
    rows: list[tuple[str, str]] = []
    for name, value in given.items():
        if isinstance(value, Mapping):
            rows += _flat(value, f"{before}{name}.")
        else:
            rows.append(
                (f"{before}{name}", ",".join(map(str, value)) if isinstance(value, list) else str(value))
            )
    return rows


def case_text(key: str, words: Mapping[str, Any] | None = None) -> str:
    """The case file of a piece of equipment alone."""
    found = tables(key, words)
    parts = [f"title = {as_toml(found['title'])}", _table("mixture", found["mixture"])]
    parts += [
        _table(f"{sort}.{json.dumps(name)}", values)
        for sort in OWN
        for name, values in found.get(sort, {}).items()
    ]
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
    return read_text(case_text(key, as_words(key, inputs)), name=key)


def as_words(key: str, inputs: Mapping[str, Any]) -> dict[str, Any]:
    """Inputs as Python says them, in words: those of streams one by one.

    >>> as_words("streams.heater", {"feed": {"liquid_flow": "2 t/h"}})
    {'feed.liquid_flow': '2 t/h'}
    """
    parameters = {p.name: p for p in _equipment(key).card.parameters}
    words: dict[str, Any] = {}
    for name, value in inputs.items():
        if name in parameters and parameters[name].may_be_none and value in ("", None):
            convert(value, parameters[name])  # an empty text says neither, and is refused
        value = ("none" if parameters.get(name, NOTHING).may_be_none else "") if value is None else value
        nested = isinstance(value, Mapping) and name not in parameters
        words |= {f"{name}.{part}": v for part, v in value.items()} if nested else {name: value}
    return words
