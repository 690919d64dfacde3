"""The glossary: one word, symbol, unit and label (English, French) for every public quantity name."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

import tomli

from granum.core.errors import unknown_name
from granum.core.i18n import _, catalog, current_language, typographic


@dataclass(frozen=True)
class Term:
    """One entry of the glossary.

    Parameters
    ----------
    name: the public argument name.
    symbol: LaTeX symbol.
    en, fr: labels.
    typical: a range, SI units, in which values usually lie (tests and forms draw from it).
    unit: the unit people usually write it in, when it differs from the first one of its kind.
    also: other names by which people look for it, in either language.
    """

    name: str
    symbol: str
    en: str
    fr: str
    typical: tuple[float, float]
    unit: str | None = None
    also: tuple[str, ...] = ()

    @property
    def label(self) -> str:
        """The label in the current language."""
        return self.fr if current_language() == "fr" else self.en


duplicates: list[str] = []
"""Names that stand in more than one file; a contract test keeps this empty."""


@cache
def glossary() -> dict[str, Term]:
    """All terms by name, read from the TOML files of ``granum/core/terms``."""
    terms: dict[str, Term] = {}
    for path in sorted((files("granum") / "core" / "terms").iterdir(), key=lambda p: p.name):
        if not path.name.endswith(".toml"):
            continue
        for name, row in tomli.loads(path.read_text(encoding="utf-8")).items():
            if name in terms:
                duplicates.append(f"{name} (again in {path.name})")
                continue
            low, high = row["typical"]
            terms[name] = Term(
                name,
                row["symbol"],
                row["en"],
                typographic(row["fr"]),
                (float(low), float(high)),
                row.get("unit"),
                tuple(row.get("also", ())),
            )
    return terms


def term(name: str) -> Term:
    """The entry of a name; a trailing author or index never belongs here."""
    found = glossary().get(name)
    if found is None:
        raise unknown_name("glossary term", name, glossary())
    return found


def quantity_in(name: str) -> str | None:
    """The longest glossary word that a name starts with: ``drag_coefficient_allen`` →
    ``drag_coefficient``.
    """
    words = name.split("_")
    for count in range(len(words), 0, -1):
        candidate = "_".join(words[:count])
        if candidate in glossary():
            return candidate
    return None


@cache
def endings() -> dict[str, dict[str, Any]]:
    """Authors by the words of keys, and qualifiers in both languages, read from
    ``granum/core/endings.toml``.
    """
    return tomli.loads((files("granum") / "core" / "endings.toml").read_text(encoding="utf-8"))


def ending(rest: str) -> str:
    """What follows the glossary word in a name: words that have a translation, or the authors of a
    correlation and what qualifies it.

    >>> ending("di_felice"), ending("retained_stairmand"), ending("turbulent")
    ('Di Felice', 'Stairmand, retained', 'turbulent')
    """
    phrase = rest.replace("_", " ")
    french = catalog("fr").get(phrase, "")
    if french.isupper():
        return french
    if french[:1].islower():
        return _(phrase)
    authors, qualifiers = parsed_ending(rest)
    language = "fr" if current_language() == "fr" else "en"
    return ", ".join(filter(None, ("–".join(authors), *(found[language] for found in qualifiers))))


def parsed_ending(rest: str) -> tuple[list[str], list[dict[str, str]]]:
    """Authors and qualifiers of an ending; a word that is neither stands as it is among the authors."""
    known, words = endings(), rest.split("_")
    authors: list[str] = []
    qualifiers: list[dict[str, str]] = []
    while words:
        count = next((n for n in (2, 1) if any("_".join(words[:n]) in table for table in known.values())), 1)
        word, words = "_".join(words[:count]), words[count:]
        if word in known["qualifiers"]:
            qualifiers.append(known["qualifiers"][word])
        else:
            authors.append(known["authors"].get(word, word))
    return authors, qualifiers
