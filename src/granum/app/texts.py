"""A result as a page shows it: labels, numbers, equation, the Python and the command that repeat it."""

from __future__ import annotations

import math
import shlex
from typing import Any

import numpy as np

from granum.app.forms import as_typed
from granum.app.wording import noticed
from granum.core.cards import Card
from granum.core.i18n import _
from granum.core.parameters import Parameter, default_as_json
from granum.core.results import Result
from granum.core.units import format_number, from_si, pretty_unit
from granum.reports.html import note_step
from granum.reports.mathml import equation_wrapped, mathml
from granum.reports.numbers import numbered
from granum.reports.quantities import MOST_SHOWN, beside_rows, in_units, law_label, value_text


def plain_data(value: Any) -> Any:
    """Whatever the package returns as JSON can carry it: arrays as lists, numbers that are not finite as
    None.
    """
    if isinstance(value, dict):
        return {str(name): plain_data(item) for name, item in value.items()}
    if hasattr(value, "_asdict"):
        return plain_data(value._asdict())
    if isinstance(value, (list, tuple, set)):
        return [plain_data(item) for item in value]
    if value is None or isinstance(value, (bool, int, str)):
        return value
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if hasattr(value, "__array__"):
        return plain_data(np.asarray(value).tolist())
    return default_as_json(value)


def python_line(card: Card, given: dict[str, Any]) -> str:
    """The Python that repeats a calculation."""
    arguments = ", ".join(f"{name}={value!r}" for name, value in given.items())
    return f"import granum as gr\n\ngr.{card.key}({arguments})"


def command_line(card: Card, given: dict[str, Any]) -> str:
    """The command that repeats a calculation."""
    return " ".join(
        [
            "granum",
            "calc",
            card.key,
            *(shlex.quote(f"{name}={_typed(value)}") for name, value in given.items()),
        ]
    )


def _typed(value: Any) -> str:
    return " ".join(map(_typed, value)) if isinstance(value, (list, tuple)) else str(default_as_json(value))


def _input_text(value: Any, text: str, origin: str, typed: str) -> str:
    if origin:
        return f"{text} ({origin})"
    if typed:
        return typed
    if isinstance(value, bool):
        return _("yes") if value else _("no")
    return law_label(value.card) if hasattr(value, "card") else text


def ranking(result: Result) -> dict[str, Any] | None:
    """Outputs that run side by side, such as names, marks and reasons of a choice, as one table; None when
    there are none.
    """
    ranked = result.ranking
    if ranked is None:
        return None
    columns = [{"name": p.name, "label": p.label, "number": p.kind is not None} for p in ranked[0]]
    return {
        "columns": columns,
        "rows": [[value_text(x, p) for p, x in zip(ranked[0], row, strict=True)] for row in ranked[1]],
    }


def series_tables(result: Result) -> list[dict[str, Any]]:
    """Outputs that run along the same axis as tables, all rows, each column in one unit; given series of that
    axis come first.

    A lone short series stays in the line of the other results.
    """
    listed = {c["name"] for c in (ranking(result) or {"columns": []})["columns"]}
    produced = {p.name for p in result.card.outputs}
    candidates = [(p, result.inputs[p.name], False) for p in result.card.parameters if p.name not in produced]
    along: dict[str, list[tuple[Parameter, np.ndarray, bool]]] = {}
    for p, values, own in candidates + [(p, result.outputs[p.name], True) for p in result.card.outputs]:
        if p.series and p.kind is not None and p.name not in listed and np.ndim(values) == 1:
            along.setdefault(p.series, []).append((p, np.asarray(values, dtype=float), own))
    found = []
    for columns in along.values():
        lengths = [x.size for _p, x, own in columns if own]
        if lengths and lengths[0] > (MOST_SHOWN if len(lengths) == 1 else 1):
            found.append([_column(p, x) for p, x, _own in columns if x.size == lengths[0]])
    return [
        {
            "columns": columns,
            "rows": [list(row) for row in zip(*(c.pop("texts") for c in columns), strict=True)],
        }
        for columns in found
    ]


def _column(p: Parameter, values: np.ndarray) -> dict[str, Any]:
    assert p.kind is not None  # only quantities become columns
    unit = p.display_unit(values)
    shown = [float(x) for x in from_si(values, unit, p.kind)]
    head = {
        "name": p.name,
        "label": p.label,
        "unit": pretty_unit(unit),
        "file_unit": "" if unit == "dimensionless" else unit,
    }
    return head | {"values": shown, "texts": [format_number(x) for x in shown]}


def described(result: Result, given: dict[str, Any]) -> dict[str, Any]:
    """The stable calc shape, with what a page shows beside it."""
    step = note_step(result)
    rows = [
        {
            "name": p.name,
            "label": p.label,
            "text": value_text(result.outputs[p.name], p),
            "symbol": row["symbol"],
            "units": in_units(result.outputs[p.name], p),
        }
        for p, row in zip(result.card.outputs, step["outputs"], strict=True)
    ]
    table, series = ranking(result), series_tables(result)
    tabled = {c["name"] for found in (*([table] if table else []), *series) for c in found["columns"]}
    used = [p for p in result.card.parameters if result.inputs[p.name] is not None]
    typed = as_typed(result.card, given)
    inputs = [
        row
        | {
            "name": p.name,
            "text": _input_text(
                result.inputs[p.name],
                row["text"],
                result.origins.get(p.name, ""),
                typed.get(p.name, ""),
            ),
        }
        for p, row in zip(used, step["inputs"], strict=True)
    ]
    return result.as_json() | {
        "flags": noticed(result.notices),
        "shown": [row for row in rows if row["name"] not in tabled],
        "beside_shown": [row._asdict() | {"symbol": mathml(row.symbol)} for row in beside_rows(result)],
        "table": table,
        "series": series,
        "inputs_shown": inputs,
        "equation": step["equation"] if result.card.equation else "",
        "equation_numbers": equation_wrapped(numbered(result)),
        "citation": step["source"],
        "python": python_line(result.card, given),
        "command": command_line(result.card, given),
    }
