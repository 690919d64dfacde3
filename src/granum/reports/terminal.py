"""Results as Rich tables: units in the header or beside the value, warnings last."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from granum.core.cards import Card
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter, default_as_json
from granum.core.results import Result
from granum.core.symbols import text_symbol
from granum.core.units import best_unit, field_units, format_number, from_si, pretty_unit, show

CAUTION, OUT, OK = "dark_orange3", "red3", "green4"


def _console() -> Console:
    return Console(highlight=False)


def _table(*columns: tuple[str, str]) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for title, justify in columns:
        table.add_column(title, justify=justify, overflow="fold")  # type: ignore[arg-type]
    return table


def value_text(value: Any, parameter: Parameter) -> str:
    """One value with its unit; a short list for vectors; words for choices."""
    if value is None:
        return "—"
    if parameter.kind is None:
        return str(default_as_json(value))
    array = np.asarray(value, dtype=float)
    if array.ndim == 0:
        preferred = parameter.units[0] if parameter.term and parameter.term.unit and not field_units(parameter.kind) else None
        number = float(array)
        if preferred and number and 0.05 <= abs(from_si(number, preferred, parameter.kind)) < 1e4:
            return show(number, parameter.kind, preferred)
        return show(number, parameter.kind)
    unit = best_unit(float(np.nanmedian(np.abs(array))) if array.size else 0.0, parameter.kind)
    items = [format_number(float(x)) for x in np.ravel(from_si(array, unit, parameter.kind))[:8]]
    return "; ".join(items) + (" …" if array.size > 8 else "") + (f" {pretty_unit(unit)}" if pretty_unit(unit) else "")


def _notices(console: Console, notices: Iterable[dict[str, Any]]) -> None:
    for notice in notices:
        style = CAUTION if notice["flag"] in ("extrapolated", "limit active") else OUT
        console.print(Text("! " + notice["message"], style=style))


def print_result(result: Result) -> None:
    """The outcome of ``granum calc``."""
    console = _console()
    console.print(Text(result.card.title, style="bold"), Text(f"  {result.card.key}", style="dim"))
    table = _table((_("quantity"), "left"), (_("symbol"), "left"), (_("value"), "right"))
    for p in result.card.parameters:
        if result.inputs[p.name] is None:
            continue  # not given
        table.add_row(p.label, text_symbol(p.term.symbol) if p.term else "", value_text(result.inputs[p.name], p), style="dim")
    for p in result.card.outputs:
        table.add_row(
            Text(p.label, style="bold"),
            text_symbol(p.term.symbol) if p.term else "",
            Text(value_text(result.outputs[p.name], p), style="bold"),
        )
    console.print(table)
    console.print(Text(result.card.citation, style="dim"))
    _notices(console, result.notices)


def _friendly(row: dict[str, Any]) -> tuple[list[str], str]:
    """Value, standard error and interval of an estimate in the unit people would choose."""
    numbers = [row["value"], row["standard_error"], *row["interval_95"]]
    kinds = {k for k in KINDS.values() if k.unit == row["unit"]}
    kind = kinds.pop() if len(kinds) == 1 else None  # 1/m may be a surface per volume or a medium resistance: left alone
    unit = row["unit"]
    if kind is not None and row["value"] is not None:
        unit = best_unit(row["value"], kind)
        zero = from_si(0.0, unit, kind)
        numbers = [None if x is None else from_si(x, unit, kind) - (zero if i == 1 else 0.0) for i, x in enumerate(numbers)]
    return [format_number(x) if x is not None else "—" for x in numbers], pretty_unit(unit)


def print_fit(found: Any, saved: Path | None = None) -> None:
    """The outcome of ``granum fit``: parameters ± standard error with 95 % interval."""
    console, data = _console(), found.as_json()
    console.print(Text(data["card"], style="bold"))
    table = _table(
        (_("parameter"), "left"), (_("value"), "right"), (_("standard error"), "right"), (_("95 % interval"), "right"), (_("unit"), "left")
    )
    for name, row in data["parameters"].items():
        numbers, unit = _friendly(row)
        table.add_row(_(name.replace("_", " ")), numbers[0], numbers[1], f"{numbers[2]} … {numbers[3]}", unit)
    for name, row in data.get("derived", {}).items():
        numbers, unit = _friendly(row)
        table.add_row(_(name.replace("_", " ")), numbers[0], "", "", unit, style="dim")
    console.print(table)
    console.print(
        Text("   ".join(f"{k} = {format_number(v)}" for k, v in data["statistics"].items() if isinstance(v, (int, float))), style="dim")
    )
    for flag in data["flags"]:
        console.print(Text("! " + (flag["message"] if isinstance(flag, dict) else str(flag)), style=CAUTION))
    if saved:
        console.print(_("saved to {path}").format(path=saved))


def print_next(told: dict[str, Any]) -> None:
    """Where the next measurement tells most."""
    place = "; ".join(f"{name} = {format_number(row['value'])} {pretty_unit(row['unit'])}".strip() for name, row in told["at"].items())
    errors = "; ".join(f"{name} ± {format_number(value, 3)}" for name, value in told["standard_errors"].items())
    console = _console()
    console.print(_("Next measurement: {place}. It shrinks the confidence region to {share} % of its size.").format(
        place=place, share=format_number(100 * told["shrinkage"], 3)))  # fmt: skip
    console.print(Text(_("Expected standard errors: {errors}").format(errors=errors), style="dim"))


def print_list(cards: Sequence[Card]) -> None:
    """The outcome of ``granum list``."""
    console = _console()
    table = _table((_("card"), "left"), (_("sort"), "left"), (_("title"), "left"))
    table.columns[0].no_wrap = True  # a key is copied from here
    for card in cards:
        table.add_row(card.key, _(card.sort), card.title)
    console.print(table)
    console.print(_("{count} cards").format(count=len(cards)))


def print_card(card: Card) -> None:
    """The outcome of ``granum show``."""
    console = _console()
    console.print(Text(card.title, style="bold"), Text(f"  {card.key} · {_(card.sort)}", style="dim"))
    console.print(card.summary)
    table = _table((_("input"), "left"), (_("quantity"), "left"), (_("units"), "left"), (_("allowed"), "left"), (_("default"), "left"))
    table.columns[0].no_wrap = True
    for p in card.parameters:
        allowed = ", ".join(map(str, p.choices)) if p.choices else (f"{_('law')}: {p.law}" if p.law else _bounds(p))
        default = _("required") if p.required else ("—" if p.default is None else value_text(p.default, p))
        table.add_row(p.name, p.label, ", ".join(map(pretty_unit, p.units[:3])), allowed, default)
    console.print(table)
    if card.outputs:
        table = _table((_("output"), "left"), (_("quantity"), "left"), (_("unit"), "left"))
        for p in card.outputs:
            table.add_row(p.name, p.label, pretty_unit(p.kind.unit) if p.kind else "")
        console.print(table)
    if card.equation:
        console.print(Text(card.equation, style="cyan"))
    console.print(Text(card.citation, style="dim"))


def _bounds(p: Parameter) -> str:
    if p.kind is None:
        return ""
    low = "−∞" if p.kind.lower == -np.inf else show(p.kind.lower, p.kind)
    high = "∞" if p.kind.upper == np.inf else show(p.kind.upper, p.kind)
    text = f"{low} … {high}"
    if p.fitted:
        text += " · " + _("fitted {low} … {high}").format(low=format_number(p.fitted[0]), high=format_number(p.fitted[1]))
    return text


def print_run(outcome: Any, saved: Sequence[Path] = ()) -> None:
    """The outcome of ``granum run``: streams, units with results and checks, audit, flags."""
    console = _console()
    console.print(Text(outcome.title, style="bold"))
    table = _table(
        (_("stream"), "left"),
        (_("solid kg/h"), "right"),
        (_("liquid kg/h"), "right"),
        (_("gas kg/h"), "right"),
        (_("T °C"), "right"),
        (_("d50 µm"), "right"),
    )
    for name, row in outcome.stream_rows().items():
        table.add_row(
            name, *(format_number(row[k]) if row[k] is not None else "" for k in ("solid", "liquid", "gas", "temperature", "median"))
        )
    console.print(table)
    table = _table((_("unit"), "left"), (_("result"), "left"), (_("value"), "right"))
    for unit, report in outcome.units.items():
        for i, (p, value) in enumerate(report.figures()):
            table.add_row(Text(unit, style="bold") if i == 0 else "", p.label, value_text(value, p))
        for check in report.checks:
            mark = Text("✓ ", style=OK) if check.ok else Text("✗ ", style=OUT)
            low = "" if check.low == -np.inf else f"{format_number(check.low)} ≤ "
            high = "" if check.high == np.inf else f" ≤ {format_number(check.high)}"
            table.add_row("", mark + Text(_(check.name)), f"{low}{format_number(float(check.value))}{high} {pretty_unit(check.unit)}")
    console.print(table)
    audit = outcome.audit
    closes = audit["mass_closure"] <= 1e-9 and audit["energy_closure"] <= 1e-9
    words = _("audit: mass closes to {mass}, energy to {energy}").format(
        mass=format_number(audit["mass_closure"], 2), energy=format_number(audit["energy_closure"], 2)
    )
    console.print(Text(words, style=OK if closes else OUT))
    _notices(console, outcome.flags)
    for path in saved:
        console.print(_("saved to {path}").format(path=path))
