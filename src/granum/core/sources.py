"""Sources: the bibliography in ``granum/references/*.bib`` and how a citation is written out."""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

from granum.core.errors import unknown_name
from granum.core.i18n import _

if TYPE_CHECKING:
    from bibtexparser.model import Entry

PARTS = re.compile(
    r"\b(ch\.|chapter|sec\.|app\.|appendix|section|eq\.|tables?|ex\.|no\.|page|method|and|to)(?= )"
)
"""Words before the number of a part of a source, and between two."""

duplicates: list[str] = []
"""Keys that stand in more than one file; a contract test keeps this empty."""


@cache
def _texts() -> dict[str, str]:
    """The files of the bibliography by name."""
    folder = files("granum") / "references"
    return {
        path.name: path.read_text(encoding="utf-8")
        for path in sorted(folder.iterdir(), key=lambda p: p.name)
        if path.name.endswith(".bib")
    }


def _parsed(text: str, name: str) -> list[Entry]:
    from bibtexparser.entrypoint import parse_string

    library = parse_string(text)
    if library.failed_blocks:
        raise ValueError(f"bibliography: {name} has an entry that cannot be read: {library.failed_blocks[0]}")
    return library.entries


@cache
def bibliography() -> dict[str, Entry]:
    """All entries by key, as they stand in the files."""
    entries: dict[str, Entry] = {}
    for name, text in _texts().items():
        for entry in _parsed(text, name):
            if entry.key in entries:
                duplicates.append(f"{entry.key} (again in {name})")
            entries[entry.key] = entry
    return entries


def _found(key: str) -> Entry:
    """One entry, without reading the others where each begins a line of its own, as they do."""
    begins = re.compile(rf"^@\w+\{{{re.escape(key)},.*?(?=^@|\Z)", re.MULTILINE | re.DOTALL)
    for name, text in _texts().items():
        if (block := begins.search(text)) is not None:
            return _parsed(block[0], name)[0]
    raise unknown_name("source", key, bibliography())


@cache
def reference(key: str) -> dict[str, str]:
    """The fields of one entry, with the letters that LaTeX writes by commands."""
    from bibtexparser.library import Library
    from bibtexparser.middlewares import LatexDecodingMiddleware

    decoder = LatexDecodingMiddleware(allow_inplace_modification=False)
    (decoded,) = decoder.transform(Library([_found(key)])).entries
    return {name: str(field.value) for name, field in decoded.fields_dict.items()}


@cache
def _named() -> dict[str, str]:
    """Authors by key, read from the lines of the files: what a search needs, in a hundredth of the time."""
    begins = re.compile(r"^@\w+\{([^,]+),", re.MULTILINE)
    named = re.compile(r"\b(?:author|editor)\s*=\s*\{((?:[^{}]|\{[^{}]*\})*)\}", re.IGNORECASE)
    found: dict[str, str] = {}
    for text in _texts().values():
        heads = list(begins.finditer(text))
        ends = [*(head.start() for head in heads[1:]), len(text)]
        for head, end in zip(heads, ends, strict=True):
            line = named.search(text, head.end(), end)
            found[head[1]] = re.sub(r"\\\W\s?|[{}]|\band\b|\b\w\.", " ", line[1]) if line else ""
    return found


def authors_of(source: str) -> str:
    """The names in a source, without initials."""
    return " ".join(_named().get(key, "") for key in keys_of(source))


def keys_of(source: str) -> list[str]:
    """The bibliography keys in a source text: ``"ergun1952, eq. 3; macdonald1979, p. 2"`` has two."""
    return [part.strip().split(",", 1)[0].strip() for part in source.split(";") if part.strip()]


def placed(place: str) -> str:
    """Where in a source, in the language in use: in words of its own, else part by part.

    >>> placed("eq. 5.23 and 5.25")
    'eq. 5.23 and 5.25'
    """
    told = _(place)
    return told if told != place else PARTS.sub(_before_number, place)


def _before_number(part: re.Match[str]) -> str:
    word = f"{part[0]} …"
    return _(word).removesuffix(" …")


def cite(source: str) -> str:
    """A source spelled out: authors, year, title, and the place in it. One in words, as of somebody's own
    formula, stands as it is.

    >>> cite("our report 17, figure 4")
    'our report 17, figure 4'
    """
    written = []
    for part in (p.strip() for p in source.split(";")):
        if not part:
            continue
        key, _comma, place = part.partition(",")
        if " " in key.strip():
            written.append(_(part))
            continue
        entry = reference(key.strip())
        authors = (
            entry.get("author", entry.get("organization", entry.get("editor", "")))
            .replace("\n", " ")
            .replace(" and ", "; ")
        )
        authors = authors.replace("{", "").replace("}", "")
        host = (
            entry.get("journal")
            or entry.get("booktitle")
            or entry.get("publisher")
            or entry.get("institution", "")
        )
        title = entry.get("title", "").replace("{", "").replace("}", "")
        if entry.get("volume"):
            host += f" {entry['volume']}" + (
                f", {entry['pages'].replace('--', '–')}" if entry.get("pages") else ""
            )
        bits = [
            f"{authors} ({entry.get('year', 's.d.')})",
            title,
            host,
            f"doi:{entry['doi']}" if entry.get("doi") else "",
        ]
        written.append(
            ". ".join(b for b in bits if b) + (f" – {placed(place.strip())}" if place.strip() else "")
        )
    return " · ".join(written)
