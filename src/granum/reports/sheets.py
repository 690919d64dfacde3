"""Streams and results as tables: CSV or Excel."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import Any

import numpy as np

from granum.core.csv_form import csv_form
from granum.core.errors import InputError
from granum.core.files import write_atomic
from granum.core.i18n import _
from granum.core.parameters import Parameter
from granum.core.units import from_si

NUMBER_WIDTH = 10  # characters
_READ = ("as read", "unit as read")


def table_rows(run: Any) -> dict[str, list[list[Any]]]:
    """The tables of a solved line: streams, their sizes, unit results, what specifications found, checks,
    utilities.

    SI units; beside a single value the same in the unit in which it is read.
    """
    data = run.as_json()
    species = [
        (phase, name)
        for phase in ("solid", "liquid", "gas")
        for name in next(iter(data["streams"].values()))[phase]
    ]
    streams: list[list[Any]] = [
        [
            "stream",
            "mass_flow [kg/s]",
            "temperature [K]",
            "pressure [Pa]",
            "median size [m]",
            *(f"{p}: {n} [kg/s]" for p, n in species),
        ]
    ]
    for name, s in data["streams"].items():
        streams.append(
            [
                name,
                *(s[k]["value"] for k in ("mass_flow", "temperature", "pressure")),
                s["size"] and s["size"]["median"],
                *(s[p][n] for p, n in species),
            ]
        )
    sized = {name: s["size"] for name, s in data["streams"].items() if s["size"] and s["size"]["median"]}
    sizes: list[list[Any]] = [["from [m]", "to [m]", *(f"{name}: mass fraction" for name in sized)]]
    if sized:
        limits = next(iter(sized.values()))["boundaries"]
        shares = (size["mass_fractions"] for size in sized.values())
        sizes.extend(map(list, zip(limits[:-1], limits[1:], *shares, strict=True)))
    results: list[list[Any]] = [["unit", "model", "result", "value", "unit of value", *_READ]]
    for unit, report in run.units.items():
        shown = {p.name: _as_read(value, p) for p, value in report.figures()}
        for name, figure in data["units"][unit]["results"].items():
            read = shown.get(name, ("", ""))
            results.append([unit, data["units"][unit]["model"], name, figure["value"], figure["unit"], *read])
    specified: list[list[Any]] = [["unit", "input", "value", "unit of value", *_READ]]
    for path, p, value in run.sought():
        unit, _dot, name = path.partition(".")
        specified.append([unit, name, value, p.kind.unit if p.kind else "", *_as_read(value, p)])
    checks: list[list[Any]] = [["unit", "check", "value", "low", "high", "unit of value", "kept"]]
    for unit, row in data["units"].items():
        for check in row["checks"]:
            told = (check[k] for k in ("name", "value", "low", "high", "unit", "ok"))
            checks.append([unit, *told])
    taken: list[list[Any]] = [["unit", "utility", "carrier", "value", "unit of value", "counted"]]
    for unit, row in data["units"].items():
        for name, use in ((n, use) for n, use in row["utilities"].items() if use["value"]):
            taken.append([unit, name, use["carrier"], use["value"], use["unit"], use["counted"]])
    for name, total in data["utilities"].items():
        if isinstance(total, dict) and total.get("value"):
            taken.append(["", name, "", total["value"], total["unit"], ""])
    return {
        "streams": streams,
        "sizes": sizes,
        "results": results,
        "specifications": specified,
        "checks": checks,
        "utilities": taken,
    }


def _as_read(value: Any, p: Parameter) -> tuple[Any, str]:
    """A single value in the unit in which it is read, and that unit; empty for what has none."""
    if p.kind is None or value is None or np.ndim(value):
        return "", ""
    unit = p.display_unit(float(value))
    return float(from_si(float(value), unit, p.kind)), unit


def write_tables(run: Any, path: Path) -> None:
    """Write ``.csv`` (the tables one under the other) or ``.xlsx`` (a sheet each)."""
    form = path.suffix.removeprefix(".")
    if form not in ("csv", "xlsx"):
        raise InputError(
            _("'{path}': tables are written as .csv or .xlsx.").format(path=path), path=str(path)
        )
    write_atomic(path, table_file(run, form))


def table_file(run: Any, form: str) -> bytes:
    """The content of a ``csv`` or ``xlsx`` file of the tables."""
    found = table_rows(run)
    if form == "csv":
        text = io.StringIO()
        form_of = csv_form()
        writer = csv.writer(text, delimiter=form_of.separator)
        for rows in found.values():
            writer.writerows([[form_of.cell(cell) for cell in row] for row in rows])
            writer.writerow([])
        return text.getvalue().encode(form_of.encoding)
    from openpyxl import Workbook
    from openpyxl.utils import get_column_letter

    book = Workbook()
    for title, rows in found.items():
        sheet = book.create_sheet(title)
        for row in rows:
            sheet.append(row)
        sheet.freeze_panes = "B2"
        for number, column in enumerate(zip(*rows, strict=True), 1):
            words = max(len(cell) for cell in column if isinstance(cell, str))
            sheet.column_dimensions[get_column_letter(number)].width = max(words, NUMBER_WIDTH) + 2
    del book["Sheet"]  # the empty one a new book starts with
    data = io.BytesIO()
    book.save(data)
    return data.getvalue()
