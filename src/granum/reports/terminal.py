"""Results as Rich tables: units in the header or beside the value, warnings last."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextvars import ContextVar
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from granum.core.cards import Card
from granum.core.glossary import glossary, term
from granum.core.i18n import _
from granum.core.kinds import Kind
from granum.core.parameters import Parameter
from granum.core.symbols import text_symbol
from granum.core.units import format_number, pretty_unit, show
from granum.reports.quantities import (
    beside_rows,
    defaults_text,
    estimate_rows,
    figure_named,
    label_of,
    limit_rows,
    origins_text,
    ranges_text,
    statistics_text,
    value_text,
)
from granum.reports.utilities import utility_rows

if TYPE_CHECKING:
    from granum.core.results import Result

CAUTION, OUT, OK = "dark_orange3", "red3", "green4"
NOTEBOOK = 110  # characters across


_recording: ContextVar[Console | None] = ContextVar("granum_recording", default=None)
_PAGE = (
    '<pre style="white-space:pre;overflow-x:auto;line-height:normal;'
    "font-family:Menlo,'DejaVu Sans Mono',Consolas,'Courier New',monospace\">{code}</pre>"
)


def _console() -> Console:
    """Texts are printed as they are: ``[mm/s]`` is a unit, not a style."""
    return _recording.get() or Console(highlight=False, markup=False, emoji=False)


def as_html(printer: Callable[[Any], None], thing: Any) -> str:
    """What a printer of this module or of the studies prints, as HTML."""
    console = Console(
        highlight=False, markup=False, emoji=False, record=True, width=NOTEBOOK, file=StringIO()
    )
    token = _recording.set(console)
    try:
        printer(thing)
    finally:
        _recording.reset(token)
    return console.export_html(inline_styles=True, code_format=_PAGE)


def _table(*columns: tuple[str, str], close: bool = False) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, collapse_padding=close)
    for title, justify in columns:
        table.add_column(title, justify=justify, overflow="fold")  # type: ignore[arg-type]
    return table


def _notices(console: Console, notices: Iterable[dict[str, Any]]) -> None:
    for notice in notices:
        style = CAUTION if notice["flag"] in ("extrapolated", "limit active") else OUT
        told = notice["message"]
        if notice.get("unit"):
            told = _("{unit}: {message}").format(unit=notice["unit"], message=told)
        console.print(Text("! " + told, style=style))


def print_result(result: Result, within: Mapping[str, str] | None = None) -> None:
    """The outcome of ``granum calc``; ``within`` tells results as intervals."""
    console = _console()
    console.print(Text(result.card.title, style="bold"), Text(f"  {result.card.key}", style="dim"))
    table = _table((_("quantity"), "left"), (_("symbol"), "left"), (_("value"), "right"))
    for p in result.card.parameters:
        if result.inputs[p.name] is None:
            continue  # not given
        origin = _("default") if p.name in result.defaults else result.origins.get(p.name)
        label = f"{p.label} ({origin})" if origin else p.label
        table.add_row(
            label,
            text_symbol(p.symbol),
            value_text(result.inputs[p.name], p),
            style="dim",
        )
    columns, rows = result.ranking or ([], [])
    for p in result.card.outputs:
        if p not in columns:
            table.add_row(
                Text(p.label, style="bold"),
                text_symbol(p.symbol),
                Text(value_text(result.outputs[p.name], p), style="bold"),
            )
    console.print(table)
    for p in result.card.outputs:
        if within and p.name in within:
            console.print(Text(f"{p.label} = {within[p.name]}"))
    for row in beside_rows(result):
        console.print(Text(f"{row.label} = {row.text}, {row.place}", style="dim"))
    if columns:
        ranked = _table(*((p.label, "right" if p.kind else "left") for p in columns))
        for row in rows:
            name, *rest = (value_text(x, p) for p, x in zip(columns, row, strict=True))
            ranked.add_row(Text(name, style="bold"), *rest)
        console.print(ranked)
    console.print(Text(result.card.citation, style="dim"))
    _notices(console, result.notices)


def print_fit(found: Any, saved: Path | None = None) -> None:
    """The outcome of ``granum fit``: parameters ± standard error with 95 % interval."""
    console, data = _console(), found.as_json()
    console.print(Text(data["card"], style="bold"))
    table = _table(
        (_("parameter"), "left"),
        (_("value"), "right"),
        (_("standard error"), "right"),
        (_("95 % interval"), "right"),
        (_("unit"), "left"),
    )
    for row in estimate_rows(data):
        table.add_row(
            row.label, row.value, row.error, row.interval, row.unit, style="dim" if row.derived else None
        )
    console.print(table)
    for line in filter(
        None, (statistics_text(data), origins_text(data), defaults_text(data), ranges_text(data))
    ):
        console.print(Text(line, style="dim"))
    for flag in data["flags"]:
        console.print(Text("! " + (flag["message"] if isinstance(flag, dict) else str(flag)), style=CAUTION))
    if saved:
        console.print(_("saved to {path}").format(path=saved))


def _error_text(value: float, figure: Parameter) -> str:
    """A standard error: a difference, so a temperature keeps its kelvins."""
    return (
        f"{format_number(value, 3)} K"
        if figure.kind and figure.kind.unit == "K"
        else value_text(value, figure)
    )


def print_next(told: dict[str, Any], found: Any) -> None:
    """Where the next measurement tells most."""
    place = "; ".join(
        f"{label_of(name)} = {value_text(row['value'], figure_named(name, row['unit']))}"
        for name, row in told["at"].items()
    )
    units = {name: estimate.unit for name, estimate in found.parameters.items()}
    errors = "; ".join(
        f"{label_of(name)} ± {_error_text(value, figure_named(name, units[name]))}"
        for name, value in told["standard_errors"].items()
    )
    console = _console()
    console.print(
        _("Next measurement: {place}. It shrinks the confidence region to {share} % of its size.").format(
            place=place, share=format_number(100 * told["shrinkage"], 3)
        )
    )
    console.print(Text(_("Expected standard errors: {errors}").format(errors=errors), style="dim"))


def print_card(card: Card) -> None:
    """The outcome of ``granum show``."""
    console = _console()
    console.print(Text(card.title, style="bold"), Text(f"  {card.key} · {_(card.sort)}", style="dim"))
    console.print(card.summary)
    table = _table((_("input"), "left"), (_("quantity, units, allowed values, default"), "left"))
    table.columns[0].no_wrap = True
    for p in card.inputs.values():
        allowed = (
            ", ".join(map(str, p.choices)) if p.choices else (f"{_('law')}: {p.law}" if p.law else _bounds(p))
        )
        default = (
            _("required")
            if p.required
            else ("" if p.default is None else f"{_('default')} {value_text(p.default, p)}")
        )
        default += " · " + _("or 'none'") if p.may_be_none else ""
        table.add_row(
            p.name,
            " · ".join(
                filter(
                    None, (p.label, ", ".join(filter(None, map(pretty_unit, p.units[:3]))), allowed, default)
                )
            ),
        )
    console.print(table)
    if card.outputs:
        table = _table((_("output"), "left"), (_("quantity, unit"), "left"))
        for p in card.outputs:
            table.add_row(
                p.name, " · ".join(filter(None, (p.label, pretty_unit(p.kind.unit) if p.kind else "")))
            )
        console.print(table)
    for name, ends in card.fitted.items():
        if name not in card.inputs:  # of a result, or of a number worked out on the way
            kind = next((p.kind for p in card.outputs if p.name == name), None)
            console.print(f"{term(name).label if name in glossary() else name} · {_fitted(ends, kind)}")
    if card.limits:
        table = _table((_("practical limit"), "left"), (_("allowed"), "left"), (_("source"), "left"))
        for row in limit_rows(card):
            table.add_row(*row)
        console.print(table)
    if card.utilities:
        table = _table((_("utility"), "left"), (_("source"), "left"))
        for cells in utility_rows(card):
            table.add_row(*cells)
        console.print(table)
    if card.equation:
        console.print(Text(card.equation, style="cyan"))
    console.print(Text(card.citation, style="dim"))


def _bounds(p: Parameter) -> str:
    if p.within:
        return f"{p.within.lower:.0f} … {p.within.upper:.0f}"
    if p.kind is None:
        return ""
    low = "−∞" if p.kind.lower == -np.inf else show(p.kind.lower, p.kind)
    high = "∞" if p.kind.upper == np.inf else show(p.kind.upper, p.kind)
    text = f"{low} … {high}"
    if p.fitted:
        text += " · " + _fitted(p.fitted, p.kind)
    return text


def _fitted(ends: tuple[float, float], kind: Kind | None) -> str:
    low, high = (
        "−∞" if x == -np.inf else "∞" if x == np.inf else show(x, kind) if kind else format_number(x)
        for x in ends
    )
    return _("fitted {low} … {high}").format(low=low, high=high)
