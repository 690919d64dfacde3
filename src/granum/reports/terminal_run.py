"""A solved line on the terminal."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from rich.text import Text

from granum.core.i18n import _
from granum.reports.quantities import check_row, found_rows, value_text
from granum.reports.streams import audit_text, stream_table
from granum.reports.terminal import OK, OUT, _console, _notices, _table
from granum.reports.utilities import utility_table


def print_run(outcome: Any, saved: Sequence[Path] = (), partial: bool = False) -> None:
    """The outcome of ``granum run``: streams, units with results and checks, audit, flags; ``partial`` says
    that it is no solution.
    """
    console = _console()
    console.print(Text(outcome.title, style="bold"))
    if partial:
        console.print(Text(_("Last iterate, not a solution: these figures are no results."), style=OUT))
    streams = stream_table(outcome)
    table = _table((_("stream"), "left"), *((head, "right") for head in streams.heads))
    for name, cells in streams.rows:
        table.add_row(name, *cells)
    console.print(table)
    table = _table((_("unit"), "left"), (_("result"), "left"), (_("value"), "right"))
    for unit, report in outcome.units.items():
        for i, (p, value) in enumerate(report.figures()):
            table.add_row(Text(unit, style="bold") if i == 0 else "", p.label, value_text(value, p))
        for check in report.checks:
            row = check_row(check, report.figures())
            mark = Text("✓ ", style=OK) if row.ok else Text("✗ ", style=OUT)
            table.add_row("", mark + Text(row.name), f"{row.text} ({row.allowed})")
    console.print(table)
    if sought := found_rows(outcome):
        heads = (_("unit"), "left"), (_("found by a specification"), "left"), (_("value"), "right")
        table = _table(*heads)
        for row in sought:
            table.add_row(Text(row["unit"], style="bold"), row["label"], row["text"])
        console.print(table)
    _print_utilities(console, outcome)
    audit = outcome.audit
    closes = audit["mass_closure"] <= 1e-9 and audit["energy_closure"] <= 1e-9
    words = _("audit: {closures}").format(closures=audit_text(audit))
    console.print(Text(words, style=OK if closes else OUT))
    _notices(console, outcome.flags)
    for path in saved:
        console.print(_("saved to {path}").format(path=path))


def _print_utilities(console: Any, outcome: Any) -> None:
    found = utility_table(outcome)
    if not (found.rows or found.carriers or found.totals):
        return
    table = _table((_("unit"), "left"), (_("utility"), "left"), (_("value"), "right"))
    last = ""
    for row in found.rows:
        name = "" if row.unit == last else row.unit
        text = row.text if row.counted else f"({row.text})"
        table.add_row(Text(name, style="bold"), row.label, text, style=None if row.counted else "dim")
        last = row.unit
    for i, (label, text) in enumerate((*found.carriers, *found.totals)):
        table.add_row(Text(_("whole line") if i == 0 else "", style="bold"), label, text)
    console.print(table)
    if not all(row.counted for row in found.rows):
        console.print(Text(_("In brackets: given by another unit of the line."), style="dim"))
