"""The one search: names before synonyms and symbols before authors before descriptions, in both languages at
once, forgiving of spelling and slips of the finger. Loads nothing that calculates.
"""

from __future__ import annotations

import bisect
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

import tomli

from granum.core.glossary import Term, glossary, quantity_in, term
from granum.core.i18n import LANGUAGES, current_language
from granum.core.index import Entry, entries
from granum.core.sources import authors_of
from granum.core.words import plain, root, tokens

TITLE, CALLED, NAME, SYMBOL, AUTHOR, GIVES, TEXT, DOMAIN = 10.0, 9.0, 8.0, 7.5, 5.0, 4.0, 2.0, 1.5
NAMES = SYMBOL  # a phrase of this weight or more is a name: the more of it was asked for, the better
EXACT, ALL_BUT_A_NAME, BEGINS, ROOT, SLIP = 1.0, 0.9, 0.8, 0.75, 0.55
LEAST_NAME = 4  # letters beyond which a name is looked for behind a slip
LEAST = 0.2  # of the score of the best: what fits worse is not told
SHORT_WORD, LONG_WORD = 4, 8  # letters from which one slip, and two, are forgiven
SORTS = {"equipment": 1.06, "procedure": 1.04, "lab test": 1.03, "chart": 1.0, "law": 0.85}
BARE = 1.05
_LATEX = re.compile(
    r"\\(?:mathrm|mathit|text|bar|dot|hat|tilde|overline|boldsymbol|,|max|min)|[\s{}_^,()\[\]]"
)
_ALPHABETIC = re.compile(r"[a-z]+")


@dataclass(frozen=True)
class Document:
    """Something that can be found.

    Parameters
    ----------
    kind, key: what it is and how it is called there.
    phrases: what can be said of it, each with its weight.
    worth: how much it is preferred to another that fits as well.
    """

    kind: str
    key: str
    phrases: Mapping[tuple[str, ...], float]
    worth: float = 1.0


def document(kind: str, key: str, said: Iterable[tuple[float, str]], worth: float = 1.0) -> Document:
    """A document from texts with their weights, the title first; other words for what its names say are
    added.
    """
    phrases: dict[tuple[str, ...], float] = {}
    for weight, text in said:
        if words := tokens(text):
            phrases[words] = max(weight, phrases.get(words, 0.0))
    long = min(len(next(iter(phrases), ())), 10)  # of several that fit alike the plainest comes first
    # a symbol is no word of a language: what is written r_h is no relative humidity
    names = [words for words, weight in phrases.items() if weight > SYMBOL]
    phrases = {words: NAME * (0.6 + 0.4 * share) for words, share in _same_as(names).items()} | phrases
    return Document(kind, key, phrases, worth * (1.0 - 0.01 * long))


@cache
def _synonyms() -> tuple[list[list[tuple[str, ...]]], dict[str, list[str]]]:
    """Groups of phrases that mean the same, and further names of single things."""
    text = (files("granum") / "core" / "synonyms.toml").read_text(encoding="utf-8")
    raw = tomli.loads(text)
    return [[tokens(phrase) for phrase in group] for group in raw["same"]], raw["names"]


@cache
def _sorts() -> dict[str, list[str]]:
    text = (files("granum") / "core" / "synonyms.toml").read_text(encoding="utf-8")
    return tomli.loads(text)["sorts"]


def sort_words(sort: str) -> Sequence[str]:
    """What people call a sort of things, in both languages, before what the thing itself is about."""
    return _sorts().get(sort, ())


@cache
def _groups_by_word() -> dict[str, list[tuple[tuple[str, ...], int]]]:
    """Phrases of the groups by their first word."""
    found: dict[str, list[tuple[tuple[str, ...], int]]] = {}
    for number, group in enumerate(_synonyms()[0]):
        for phrase in group:
            found.setdefault(phrase[0], []).append((phrase, number))
    return found


def _same_as(names: Sequence[tuple[str, ...]]) -> dict[tuple[str, ...], float]:
    """What else a thing of these names is called, with the share of a name for which that stands."""
    groups, known = _synonyms()[0], _groups_by_word()
    told: dict[tuple[str, ...], float] = {}
    for words in names:
        for place, word in enumerate(words):
            for phrase, number in known.get(word, ()):
                if words[place : place + len(phrase)] == phrase:
                    share = len(phrase) / len(words)
                    told |= {other: max(share, told.get(other, 0.0)) for other in groups[number]}
    return told


@dataclass(frozen=True)
class Hit:
    """Something found, and how well it fits."""

    kind: str
    key: str
    score: float


class Finder:
    """Documents that can be asked for.

    What is said of several of them is compared once.
    """

    def __init__(self, documents: Iterable[Document]):
        self.documents = tuple(documents)
        self._said: list[tuple[tuple[str, ...], list[tuple[int, float]]]] = []
        self._places: dict[str, list[int]] = {}
        numbers: dict[tuple[str, ...], int] = {}
        for number, one in enumerate(self.documents):
            for phrase, weight in one.phrases.items():
                if phrase not in numbers:
                    numbers[phrase] = len(self._said)
                    self._said.append((phrase, []))
                    for word in dict.fromkeys(phrase):
                        self._places.setdefault(word, []).append(numbers[phrase])
                self._said[numbers[phrase]][1].append((number, weight))
        self._sorted = sorted(self._places)
        strong = (phrase for phrase, owners in self._said if max(w for _, w in owners) >= AUTHOR)
        self._named = {word for phrase in strong for word in phrase}  # in names, titles and by authors
        self._roots: dict[str, list[str]] = {}
        for word in self._sorted:
            self._roots.setdefault(root(word), []).append(word)

    def _known(self, word: str, typed: str) -> dict[str, float]:
        """Words of the documents that a word may mean, and how surely; as it was ``typed``, it may be all but
        a name that only looks like a plural (Stockes).
        """
        found = {other: ROOT for other in self._roots.get(root(word), ()) if len(word) > 3}
        begin = bisect.bisect_left(self._sorted, word) if len(word) > 2 else len(self._sorted)
        for other in self._sorted[begin : bisect.bisect_left(self._sorted, word + "\uffff")]:
            found[other] = max(BEGINS * (0.6 + 0.4 * len(word) / len(other)), found.get(other, 0.0))
        if word in self._places:
            found[word] = EXACT
        if self._named.isdisjoint(found):  # what stands in descriptions alone may be a slip for a name too
            slipped = self._slipped(word).items()
            found |= {other: sure for other, sure in slipped if not found or other in self._named}
        if typed not in self._places and word not in self._named:
            found |= dict.fromkeys(_all_but_a_name(typed) & self._places.keys(), ALL_BUT_A_NAME)
        return found

    def _slipped(self, word: str) -> dict[str, float]:
        """Words from which a slip or two of the finger make the typed one."""
        most = 0 if len(word) < SHORT_WORD else 1 if len(word) < LONG_WORD else 2
        if not most:
            return {}
        from rapidfuzz import process
        from rapidfuzz.distance import OSA

        near = process.extract(word, self._sorted, scorer=OSA.distance, score_cutoff=most, limit=40)
        return {
            other: SLIP ** float(slips) * (1.0 if other[0] == word[0] else 0.8) for other, slips, _ in near
        }

    def search(self, text: str, limit: int | None = None) -> list[Hit]:
        """What is meant by a text, the best first; where nothing has all its words, what has most of them."""
        typed = {tokens(word): word for word in text.lower().split()}
        known = [self._known(word, typed.get((word,), word)) for word in dict.fromkeys(tokens(text))]
        surely: dict[int, list[float]] = {}  # of each phrase that has one of the words, by word
        for place, words in enumerate(known):
            for word, sure in words.items():
                for number in self._places[word]:
                    row = surely.setdefault(number, [0.0] * len(known))
                    row[place] = max(row[place], sure)
        found: dict[int, tuple[list[float], list[tuple[float, list[float], float]]]] = {}
        all_words = {word for words in known for word in words}
        for number, row in surely.items():
            phrase, owners = self._said[number]
            said = sum(word in all_words for word in phrase) / len(phrase)
            for owner, weight in owners:
                each, told = found.setdefault(owner, ([0.0] * len(known), []))
                told.append((weight, row, said))
                for place, sure in enumerate(row):
                    each[place] = max(each[place], weight * sure)
        counts = [sum(each[place] > 0 for each, _told in found.values()) for place in range(len(known))]
        rare = [0.3 + math.log(1.0 + len(self.documents) / max(count, 1)) for count in counts]
        most = max((sum(x > 0 for x in each) for each, _told in found.values()), default=0)
        if 2 * most < len(known):
            return []
        least = most - (len(known) > 2)  # one word of many may be beside the point
        hits = [
            Hit(one.kind, one.key, one.worth * (_best(told, rare) + 0.5 * _weighed(each, rare)))
            for number, (each, told) in found.items()
            if sum(x > 0 for x in each) >= least
            for one in (self.documents[number],)
        ]
        hits.sort(key=lambda hit: (-hit.score, hit.key))
        return [hit for hit in hits if hit.score > LEAST * hits[0].score][:limit]


def _weighed(values: Sequence[float], weights: Sequence[float]) -> float:
    return sum(v * w for v, w in zip(values, weights, strict=True)) / sum(weights)


def _best(told: Iterable[tuple[float, list[float], float]], rare: Sequence[float]) -> float:
    """How well the phrase fits that says it best; of a name, the more the more of it was asked for."""
    return max(
        weight * _weighed(row, rare) * (0.55 + 0.45 * said if weight >= NAMES else 1.0)
        for weight, row, said in told
    )


@cache
def _names_like_plurals() -> dict[str, str]:
    """Names of authors that end like plurals, with the word by which they are compared."""
    names = {
        name for entry in entries().values() for name in _ALPHABETIC.findall(plain(authors_of(entry.source)))
    }
    words = {name: tokens(name) for name in names if len(name) > LEAST_NAME}
    return {name: said[0] for name, said in words.items() if said and said[0] != name}


def _all_but_a_name(typed: str) -> set[str]:
    """Words of the names from which one slip of the finger makes what was typed."""
    from rapidfuzz import process
    from rapidfuzz.distance import OSA

    known = _names_like_plurals()
    return {
        known[name]
        for name, _slips, _ in process.extract(typed, known.keys(), scorer=OSA.distance, score_cutoff=1)
    }


# -- the cards
# -----------------------------------------------------------------------------------------------
def symbol_words(symbol: str) -> str:
    r"""A symbol as people type it.

    >>> symbol_words(r"U_{mf}"), symbol_words(r"\rho_p"), symbol_words(r"\mathrm{Re}")
    ('Umf', 'rhop', 'Re')
    """
    return _LATEX.sub("", symbol).replace("\\", "")


def _said_of(entry: Entry) -> Iterable[tuple[float, str]]:
    """What can be said of a card."""
    yield TITLE, entry.english_title or entry.title
    yield TITLE, entry.french_title
    yield NAME, entry.name.replace("_", " ")
    for name in _synonyms()[1].get(entry.key, ()):
        yield CALLED, name
    about = quantity_in(entry.name) or quantity_in(entry.family)
    if about:
        yield from _of_term(term(about), NAME)
    if entry.family and entry.family in glossary():
        yield from _of_term(term(entry.family), GIVES)
    for word in entry.gives.split():
        if (found := quantity_in(word)) and found != about:
            yield from _of_term(term(found), GIVES)
    yield AUTHOR, authors_of(entry.source)
    yield TEXT, entry.english_summary
    yield TEXT, entry.french_summary
    yield DOMAIN, entry.domain.replace("_", " ")


def _of_term(word: Term, weight: float) -> Iterable[tuple[float, str]]:
    strong = weight >= NAMES
    yield min(weight, NAME), word.en
    yield min(weight, NAME), word.fr
    yield (SYMBOL if strong else GIVES), symbol_words(word.symbol)
    for name in word.also:
        yield weight, name


def _worth(entry: Entry) -> float:
    """How much likelier a card is meant than another that is said as well: that of the bare quantity sooner
    than one with an author or a condition.
    """
    return SORTS.get(entry.sort, 1.0) * (BARE if entry.name in glossary() else 1.0)


@cache
def card_documents() -> tuple[Document, ...]:
    """All cards as documents."""
    return tuple(document("card", entry.key, _said_of(entry), _worth(entry)) for entry in entries().values())


@cache
def _cards() -> Finder:
    return Finder(card_documents())


@cache
def _usual() -> dict[str, dict[tuple[str, ...], tuple[str, ...]]]:
    """What everyday words mean first, by language."""
    text = (files("granum") / "core" / "usual.toml").read_text(encoding="utf-8")
    rows = tomli.loads(text)["meant"]
    return {
        code: {tokens(word): tuple(row["cards"]) for row in rows for word in row[code]} for code in LANGUAGES
    }


def usual(text: str) -> tuple[str, ...]:
    """The most usual cards of an everyday word, such as the name of a task; none for what is not that.

    >>> usual("dryers")[0]
    'drying.rotary_dryer'
    """
    own = current_language()
    known = [_usual()[code] for code in sorted(LANGUAGES, key=lambda code: code != own)]
    return next((words[tokens(text)] for words in known if tokens(text) in words), ())


def search(text: str, limit: int | None = None) -> list[Entry]:
    """The cards that a text means, the best first: the usual ones of an everyday word, and all those of a
    domain where it is named, before others.

    >>> search("terminal velcity", limit=1)[0].key
    'particles.terminal_velocity'
    """
    known: dict[str, Any] = entries()
    found = [known[hit.key] for hit in _cards().search(text)]
    named = "_".join(text.lower().split())
    own = [entry for entry in known.values() if entry.domain == named]
    if own:
        place = {entry.key: number for number, entry in enumerate(found)}
        own.sort(key=lambda entry: place.get(entry.key, len(found)))
        found = own + [entry for entry in found if entry.domain != named]
    first = [known[key] for key in usual(text)]
    return [*first, *(entry for entry in found if entry not in first)][:limit]
