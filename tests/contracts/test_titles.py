"""Titles made of a quantity and its authors name authors that the card cites, spelled as they spell
themselves.
"""

from __future__ import annotations

import re

import pytest
from tests.sharing.samples import EVERYTHING

from granum.core.cards import Card
from granum.core.glossary import endings, parsed_ending, quantity_in
from granum.core.i18n import catalog, language
from granum.core.index import entries
from granum.core.sources import keys_of, reference
from granum.core.words import plain

BY_TRADITION = {
    "Alexander": "cited by Leith and Licht",
    "Dallavalle": "signs DallaValle on the title page",
    "Davidson": "two-phase theory, as Kunii and Levenspiel give it",
    "Harrison": "two-phase theory, as Kunii and Levenspiel give it",
    "Gibbs": "the Gibbs–Thomson relation of every textbook",
    "Thomson": "the Gibbs–Thomson relation of every textbook",
    "Kozeny": "the Kozeny–Carman relation, cited from Carman and others",
    "Leung": "his section of Perry's handbook",
    "Stairmand": "as Richardson and Harker give his model",
    "Stokes": "his law, wherever it is applied",
}


def derived(card: Card) -> list[str]:
    """Authors in a title that is made of the name of the card."""
    word = quantity_in(card.name)
    rest = card.name[len(word or "") :].strip("_")
    if card.given_title or not rest or rest.replace("_", " ") in catalog("fr"):
        return []
    return parsed_ending(rest)[0]


NAMED = {key: thing.card for key, thing in EVERYTHING.items() if derived(thing.card)}


@pytest.mark.parametrize("key", NAMED)
def test_a_title_names_authors_of_its_sources_alone(key: str) -> None:
    card = NAMED[key]
    cited = plain(" ".join(str(reference(source)) for source in keys_of(card.source)))
    strangers = [
        name
        for name in derived(card)
        if name not in BY_TRADITION
        and plain(name) not in cited
        and plain(name) not in cited.replace("-", " ")
    ]
    assert not strangers
    assert set(derived(card)) <= set(endings()["authors"].values())


def test_no_title_ends_in_a_bare_adjective_or_shows_a_key() -> None:
    known = {*endings()["authors"].values(), "API", "KTA", "Mohlman"}
    qualifiers = {q[code] for q in endings()["qualifiers"].values() for code in ("en", "fr")}
    for code in ("en", "fr"):
        with language(code):
            titles = {key: entry.title for key, entry in entries().items() if not entry.given_title}
        for key, title in titles.items():
            assert not re.search(r"[a-z]_[a-z]|\) \(", title), f"{key}: {title}"
            inside = re.findall(r"\(([^()]*)\)$", title)
            for part in re.split("–|, ", inside[0]) if inside else ():
                assert part in known | qualifiers, f"{key}: {title}"
