"""One search over everything the app holds: cards, example lines, exercises and pages to read."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from functools import cache

from granum.app import exercises
from granum.app.reading import page
from granum.app.shipped import description_of, examples, pages, title_of, translations
from granum.app.wording import summary_words
from granum.core.datasets import dataset
from granum.core.i18n import LANGUAGES, _, current_language, language
from granum.core.index import entries
from granum.core.search import (
    DOMAIN,
    GIVES,
    NAME,
    TEXT,
    TITLE,
    Document,
    Finder,
    card_documents,
    document,
    sort_words,
    usual,
)
from granum.core.words import tokens

SHOWN = 40  # hits
USUAL = 3  # of the most usual equipment, before what a search finds for an everyday word
BEHIND = 0.9  # what is not a card itself
FOREIGN = 0.75  # a page that is there in the other language only
LISTS = {  # tables shown by a card, with the column that names a row
    "drying.applications": ("drying", "applications_houdon2017", "product"),
    "drying.foods": ("drying", "foods_beuchat1981", "food"),
    "drying.food_moistures": ("drying", "food_moistures_makhlouf2020", "food"),
    "dust.dust_explosibility": ("streams", "dusts_nfpa68", "name"),
    "humid_gas.air_composition": ("humid_gas", "air_usstandard1976", "gas"),
}
TAUGHT = 1.05  # of several laws for one thing, one that is learnt


def _sort_words(sort: str) -> Iterator[tuple[float, str]]:
    """Each word by itself: whoever types one of them means no other."""
    for word in sort_words(sort):
        yield DOMAIN, word


def _of_a_sort(card: Document) -> Document:
    """A card of tests or charts is found by that word too, which many of their titles lack."""
    said = dict(card.phrases)
    for weight, word in _sort_words(entries()[card.key].sort):
        said.setdefault(tokens(word), weight)
    return replace(card, phrases=said)


def _lines() -> Iterator[Document]:
    for name in examples():
        said: list[tuple[float, str]] = []
        for code in LANGUAGES:
            with language(code):
                said += [(TITLE, title_of(name)), (TEXT, description_of(name))]
        said += [(NAME, name.replace("/", " ").removesuffix(".toml")), *_sort_words("line")]
        yield document("line", name, said, BEHIND)


def _exercises() -> Iterator[Document]:
    for one in exercises.declared()["exercise"]:
        said = [(TITLE, text) for text in one["title"].values()]
        said += [(NAME, text) for step in one["steps"] for text in step["ask"].values()]
        said += [(TEXT, text) for text in one["statement"].values()]
        said += [(GIVES, text) for step in one["steps"] if "card" in step for text in _named(step["card"])]
        said += [(DOMAIN, text) for text in _domain(one["domain"])]
        yield document("exercise", one["id"], [*said, *_sort_words("exercise")], BEHIND)


def _named(key: str) -> tuple[str, str, str]:
    """What the card of a step is called."""
    card = entries()[key]
    return card.english_title or card.title, card.french_title, card.name.replace("_", " ")


@cache
def _domain(name: str) -> tuple[str, ...]:
    """What a domain of the course is called, in every language."""
    found = []
    for code in LANGUAGES:
        with language(code):
            found.append(exercises.domain_labels()[name])
    return tuple(found)


def _pages(code: str) -> Iterator[Document]:
    """Pages in the language of the reader, found by the words of both; those that have no other, too."""
    for name in pages():
        found, other = page(name), translations().get(name)
        if found.language != code and other:
            continue
        worth = BEHIND if found.language == code else BEHIND * FOREIGN
        said = [(TITLE, found.title), *_sort_words("page")]
        for one in (found, *([page(other)] if other else [])):
            said += [
                (TITLE, one.title),
                *((NAME, heading) for heading in one.headings),
                (TEXT, one.text[:2000]),
            ]
        yield document("page", name, said, worth)


def _taught() -> set[str]:
    """Cards of several for one thing that an exercise asks for."""
    families = Counter(card.family for card in entries().values() if card.family)
    asked = {
        step["card"] for one in exercises.declared()["exercise"] for step in one["steps"] if "card" in step
    }
    return {key for key in asked if families[entries()[key].family] > 1}


def _listed(card: Document) -> Document:
    """A card that shows a table is found by the names of its rows too, in every language."""
    if card.key not in LISTS:
        return card
    domain, name, column = LISTS[card.key]
    said = dict(card.phrases)
    for code in LANGUAGES:
        with language(code):
            for row in dataset(domain, name):
                said.setdefault(tokens(_(row[column])), GIVES)
    return replace(card, phrases=said)


@cache
def _finder(code: str) -> Finder:
    taught = _taught()
    cards = (
        _of_a_sort(replace(one, worth=one.worth * TAUGHT) if one.key in taught else _listed(one))
        for one in card_documents()
    )
    return Finder([*cards, *_lines(), *_exercises(), *_pages(code)])


def _told(kind: str, key: str) -> dict[str, str]:
    """What a hit shows: title, one line, and what sort of thing it is."""
    if kind == "card":
        card = entries()[key]
        told = summary_words(card.summary)
        return {"sort": card.sort, "domain": card.domain, "title": card.title, "summary": told}
    if kind == "line":
        return {"sort": "line", "domain": "", "title": title_of(key), "summary": description_of(key)}
    if kind == "exercise":
        one = next(e for e in exercises.declared()["exercise"] if e["id"] == key)
        code = current_language()
        return {"sort": "exercise", "domain": "", "title": one["title"][code], "summary": one["source"]}
    return {
        "sort": "page",
        "domain": "",
        "title": page(key).title,
        "summary": " · ".join(page(key).headings[:4]),
    }


def found(text: str, limit: int = SHOWN) -> list[dict[str, str]]:
    """What a text means, the best first: ``{"sort", "key", "domain", "title", "summary"}``.

    >>> found("vacuum drum")[0]["key"]
    'filtration.rotary_vacuum_drum'
    """
    first = [("card", key) for key in usual(text[:200])[:USUAL]]
    hits = [(hit.kind, hit.key) for hit in _finder(current_language()).search(text[:200], limit)]
    rows = [*first, *(hit for hit in hits if hit not in first)]
    return [{"key": key} | _told(kind, key) for kind, key in rows[:limit]]
