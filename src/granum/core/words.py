"""Words as a search compares them: without accents, hyphens, plurals and national spellings."""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache

_ELIDED = re.compile(r"\b(?:[cdjlmnst]|qu)['’](?=\w)")
_INDICES = re.compile(
    r"(?<=\b[a-z])(?:_[\[({]?|\s?[\[({])(\d+|max|min|mf|ms|[a-z]{1,2}\b)(?:[,.](\d))?[\])}]?"
)
_MOMENTS = re.compile(r"\b([a-z]\d)[,.](\d)\b")  # d3,2
_WORD = re.compile(r"[a-z0-9α-ω]+")
_SPELLINGS = (
    # the letters of Great Britain, and the French words that share them
    (re.compile(r"([a-z]{3})is(ation|ations|e|ed|es|er|ers|ing|ant|eur|eurs)$"), r"\1iz\2"),
    (re.compile(r"yse(d?)$"), r"yze\1"),
    (re.compile(r"(?<=[a-z]{2})our(s?)$"), r"or\1"),
    (re.compile(r"([bt])re(s?)$"), r"\1er\2"),
    (re.compile(r"lling$"), "ling"),
    (re.compile(r"lled$"), "led"),
    (re.compile(r"^sulph"), "sulf"),
    (re.compile(r"grey"), "gray"),
    (re.compile(r"alumini"), "alumin"),
    (re.compile(r"^coloris"), "coloriz"),
    (re.compile(r"ae(?=[a-z]{3})|oe(?=[a-z]{3})"), "e"),
)
_ENDINGS = """
ings ing ers er ors or eurs eur euses euse ages age ements ement ments ment ations ation ions ion ables able
ities ity ites ite ures ure ees ee es e s x
"""
_LONGEST_FIRST = sorted(_ENDINGS.split(), key=len, reverse=True)
_SMALL_WORDS = """
a an and are as at be by can do does for from go has have how i in is it its my of on or out that the their
there this to what when why will with you your
au aux avec ce ces cette comment dans de des du en est et il je la le les leur ma mon on ou par pour quoi sa
se ses son sont sur un une vous
"""
STOP = frozenset(_SMALL_WORDS.split())


ALIKE = str.maketrans({"œ": "oe", "æ": "ae", "’": "'"})


def plain(text: str) -> str:
    """Small letters without accents, apostrophes straight, by which texts are compared in a search."""
    apart = unicodedata.normalize("NFD", text.lower().translate(ALIKE))
    return "".join(letter for letter in apart if not unicodedata.combining(letter))


@lru_cache(maxsize=50_000)
def _spelled(word: str) -> str:
    for pattern, instead in _SPELLINGS:
        word = pattern.sub(instead, word)
    if word.endswith(("ies", "aux")) and len(word) > 4:
        return f"{word[:-3]}y" if word.endswith("ies") else word.removesuffix("x")
    return word[:-1] if len(word) > 3 and word[-1] == "s" and word[-2] not in "suix" else word


@lru_cache(maxsize=50_000)
def root(word: str) -> str:
    """A word without its ending, three letters at least.

    >>> root("drying"), root("dryer"), root("essorage"), root("essoreuse")
    ('dry', 'dry', 'essor', 'essor')
    """
    for end in _LONGEST_FIRST:
        if word.endswith(end) and len(word) - len(end) >= 3:
            return word[: -len(end)]
    return word


@lru_cache(maxsize=50_000)
def tokens(text: str) -> tuple[str, ...]:
    """The words of a text that count, one spelling for each.

    >>> tokens("The Fluidisation of a filtre-presse, d'après D[3,2] and u_mf")
    ('fluidization', 'filter', 'presse', 'apre', 'd32', 'umf')
    """
    clean = _ELIDED.sub("", plain(text))
    clean = _INDICES.sub(lambda m: m[1] + (m[2] or ""), clean)
    clean = _MOMENTS.sub(r"\1\2", clean)
    found = (_spelled(word) for word in _WORD.findall(clean) if word not in STOP)
    return tuple(word for word in found if word)
