"""Sources: the bibliography in ``granum/references/*.bib`` and how a citation is written out."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from typing import Any

from granum.core.errors import unknown_name

duplicates: list[str] = []
"""Keys that stand in more than one file; a contract test keeps this empty."""


@cache
def bibliography() -> dict[str, dict[str, str]]:
    """All entries by key."""
    from bibtexparser.entrypoint import parse_string
    from bibtexparser.middlewares import LatexDecodingMiddleware

    entries: dict[str, dict[str, str]] = {}
    for path in sorted((files("granum") / "references").iterdir(), key=lambda p: p.name):
        if path.name.endswith(".bib"):
            library = parse_string(
                path.read_text(encoding="utf-8"), append_middleware=[LatexDecodingMiddleware()]
            )
            if library.failed_blocks:
                raise ValueError(
                    f"bibliography: {path.name} has an entry that cannot be read: {library.failed_blocks[0]}"
                )
            for entry in library.entries:
                if entry.key in entries:
                    duplicates.append(f"{entry.key} (again in {path.name})")
                entries[entry.key] = {name: str(found.value) for name, found in entry.fields_dict.items()}
    return entries


def keys_of(source: str) -> list[str]:
    """The bibliography keys in a source text: ``"ergun1952, eq. 3; macdonald1979, p. 2"`` has two."""
    return [part.strip().split(",", 1)[0].strip() for part in source.split(";") if part.strip()]


def cite(source: str) -> str:
    """A source spelled out: authors, year, title, place, with the equation or page kept."""
    written = []
    for part in (p.strip() for p in source.split(";")):
        if not part:
            continue
        key, _, place = part.partition(",")
        entry: dict[str, Any] | None = bibliography().get(key.strip())
        if entry is None:
            raise unknown_name("source", key.strip(), bibliography())
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
        written.append(". ".join(b for b in bits if b) + (f" – {place.strip()}" if place.strip() else ""))
    return " · ".join(written)
