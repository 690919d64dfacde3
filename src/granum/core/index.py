"""The index of all cards: what finding one needs, without importing what declares it.

It stands in ``granum/core/index.csv``, which ``python -m granum.core.stubs`` writes and a test compares.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from granum.core.glossary import ending, quantity_in, term
from granum.core.i18n import _, current_language


@dataclass(frozen=True)
class Entry:
    """A line of the index: what can be said of a card by its names alone.

    Parameters
    ----------
    key: ``domain.name``, as typed on the command line.
    sort, family: as on the card.
    given_title, english_summary: its texts.
    gives: names of its outputs, with spaces between.
    module, attribute: where it is declared.
    source: as on the card.
    english_title, french_title, french_summary: written down, because they take the French words.
    """

    key: str
    sort: str
    family: str
    given_title: str
    english_summary: str
    gives: str
    module: str
    attribute: str
    source: str = ""
    english_title: str = ""
    french_title: str = ""
    french_summary: str = ""

    @property
    def domain(self) -> str:
        """First part of the key."""
        return self.key.split(".", 1)[0]

    @property
    def name(self) -> str:
        """Second part of the key."""
        return self.key.split(".", 1)[1]

    @property
    def title(self) -> str:
        """Title in the current language: as declared, else the glossary label with the author of the
        correlation.
        """
        written = self.french_title if current_language() == "fr" else self.english_title
        if written:
            return written
        if self.given_title:
            return _(self.given_title)
        word = quantity_in(self.name)
        if word is None:
            title = ending(self.name)
            return title[:1].upper() + title[1:]
        label = term(word).label
        rest = self.name[len(word) :].strip("_")
        label = label[0].upper() + label[1:]
        return f"{label} ({ending(rest)})" if rest else label

    @property
    def summary(self) -> str:
        """First sentence of the docstring, in the current language."""
        return (self.french_summary if current_language() == "fr" else "") or _(self.english_summary)


@cache
def entries() -> dict[str, Entry]:
    """All cards of the package by key.

    >>> entries()["particles.reynolds_number"].module
    'granum.particles.formulas.numbers'
    """
    text = (files("granum") / "core" / "index.csv").read_text(encoding="utf-8")
    return {row["key"]: Entry(**row) for row in csv.DictReader(text.splitlines())}
