"""Rows as tables of the documentation, between ``<!-- benchmarks: KIND -->`` and ``<!-- /benchmarks -->``."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from benchmarks.rows import Row, against, cell, number, spelled

HEADINGS = {"start": ("command", "processor"), "line": ("line", "processor"), "recycle": ("case", "")}
"""First column and the column of seconds, where they are not ``question`` and ``Granum``."""

MARKED = re.compile(r"(<!-- benchmarks: (\w+) -->\n).*?(<!-- /benchmarks -->)", re.DOTALL)


def table(rows: Sequence[Row]) -> str:
    """The rows of one kind in Markdown; a column that none of them fills is left out."""
    first, seconds = HEADINGS.get(rows[0].kind, ("question", "Granum"))
    several = len({row.script for row in rows}) > 1
    columns: dict[str, Callable[[Row], str]] = {
        first: lambda row: row.question,
        "script": lambda row: f"`{row.script}.py`" if several else "",
        seconds: lambda row: "" if row.seconds is None else spelled(row.seconds),
        "peer": lambda row: against(row) if row.peer else "",
        "ratio": lambda row: "" if row.ratio is None else number(row.ratio),
    }
    for name in dict.fromkeys(name for row in rows for name in row.figures):
        columns[name] = lambda row, name=name: cell(row.figures.get(name, ""))
    columns["the two agree within"] = lambda row: row.agreement
    filled = {name: texts for name, of in columns.items() if any(texts := [of(row) for row in rows])}
    ruler = ["---" if name in (first, "script") else "--:" for name in filled]
    body = zip(*filled.values(), strict=True)
    return "\n".join(f"| {' | '.join(line)} |" for line in [list(filled), ruler, *body])


def rewritten(text: str, tables: dict[str, str]) -> str:
    """The page with every marked table made anew; the tables of other kinds stay as they are."""

    def anew(found: re.Match[str]) -> str:
        opening, kind, closing = found.groups()
        return f"{opening}\n{tables[kind]}\n\n{closing}" if kind in tables else found[0]

    return MARKED.sub(anew, text)
