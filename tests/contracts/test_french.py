"""Every message of the program has its French; every catalog belongs to something."""

from __future__ import annotations

import re
import tomllib
from functools import cache
from pathlib import Path
from string import Formatter

import pytest
from babel.messages.extract import extract_from_dir
from tests.sharing.places import EXAMPLES

import granum
from granum.core.glossary import glossary
from granum.core.i18n import catalog, language
from granum.core.kinds import KINDS
from granum.core.registry import everything
from granum.core.sources import PARTS, cite
from granum.streams.units import Unit

SOURCE = Path(granum.__file__).parent


@cache
def messages() -> dict[str, set[str]]:
    """What the program says, by package; what belongs to none stands under its file."""
    found: dict[str, set[str]] = {}
    for file, _n, message, _c, _x in extract_from_dir(
        str(SOURCE), [("**.py", "python"), ("**.j2", "jinja2")], keywords={"_": None}, comment_tags=()
    ):
        if isinstance(message, str):
            found.setdefault(file.split("/")[0], set()).add(message)
    return found


def said() -> list[str]:
    """All of it, each once."""
    return sorted(set().union(*messages().values()))


def fields(text: str) -> set[str]:
    return {name for _t, name, _s, _c in Formatter().parse(text) if name}


@pytest.mark.parametrize(
    "package", sorted(p.name for p in SOURCE.iterdir() if p.is_dir() and not p.name.startswith("__"))
)
def test_messages_have_french(package: str) -> None:
    missing = sorted(messages().get(package, set()) - set(catalog("fr")))
    assert not missing, f"{len(missing)} messages without French: {missing}"


def test_titles_and_descriptions_of_the_examples_have_french() -> None:
    files = [p.read_text(encoding="utf-8") for p in EXAMPLES.rglob("*.toml")]
    cases = [tomllib.loads(text) for text in files if "[units." in text]
    for key in ("title", "description"):
        words = {case[key] for case in cases if key in case}
        assert len(words) > 30
        assert words - set(catalog("fr")) == set()


def test_french_keeps_the_placeholders() -> None:
    messages = set(said())
    wrong = [
        m for m, french in catalog("fr").items() if "{" in m and m in messages and fields(m) != fields(french)
    ]
    assert not wrong


def test_kinds_and_terms_have_french() -> None:
    assert [k.name for k in KINDS.values() if k.name not in catalog("fr")] == []
    assert [t.name for t in glossary().values() if not t.fr] == []


def test_endings_of_labels_and_words_of_choices_have_french() -> None:
    missing = set()
    for thing in everything().values():
        for p in (*thing.card.parameters, *thing.card.outputs):
            rest = p.name[len(p.term.name) :].strip("_") if p.term else p.name
            missing |= {
                word
                for w in (rest, *map(str, p.choices))
                if (word := w.replace("_", " ")) and word not in catalog("fr") and not word.isdigit()
            }
    assert not missing


def test_limits_have_french_and_a_known_source() -> None:
    limits = {limit for thing in everything().values() for limit in thing.card.limits}
    assert len(limits) > 60
    assert {limit.name for limit in limits} - set(catalog("fr")) == set()
    assert [limit for limit in limits if not cite(limit.source)] == []
    assert [
        limit
        for limit in limits
        if not isinstance(limit.low, str) and not isinstance(limit.high, str) and not limit.low <= limit.high
    ] == []


def test_every_port_has_its_french() -> None:
    units = [thing for thing in everything().values() if isinstance(thing, type) and issubclass(thing, Unit)]
    ports = {port for unit in units for port in (*unit.outlet_names(), *(unit.inlet_names() or ()))}
    assert not sorted(port for port in ports if port.replace("_", " ") not in catalog("fr"))


def test_the_place_in_a_source_is_told_in_french() -> None:
    """Beside numbers and the words before them, as in "eq. 3"."""
    cards = [thing.card for thing in everything().values()]
    sources = {card.source for card in cards} | {limit.source for card in cards for limit in card.limits}
    sources |= {use.utility.source for card in cards for use in getattr(card, "utilities", ())}
    parts = {part.strip() for source in sources for part in source.split(";")}
    own = {part for part in parts if " " in part.partition(",")[0]}
    places = {part.partition(",")[2].strip() for part in parts - own} - {""}
    assert len(places) > 150
    assert {part for part in own if part not in catalog("fr")} == set()
    words = {
        place: re.findall(r"\b[a-z]{2,}\b", PARTS.sub("", place)) for place in places - set(catalog("fr"))
    }
    assert {place: found for place, found in words.items() if found and "notes" not in found} == {}
    with language("fr"):
        assert cite("ergun1952, eq. 3 and 5").endswith(" – éq. 3 et 5")
