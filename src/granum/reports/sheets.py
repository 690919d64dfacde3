"""Streams and results as tables: CSV or Excel."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import Any

from granum.core.errors import InputError
from granum.core.files import write_atomic
from granum.core.i18n import _


def table_rows(run: Any) -> dict[str, list[list[Any]]]:
    """The tables of a solved line, SI units: streams, unit results, utilities."""
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
            *(f"{p}: {n} [kg/s]" for p, n in species),
        ]
    ]
    for name, s in data["streams"].items():
        streams.append(
            [
                name,
                *(s[k]["value"] for k in ("mass_flow", "temperature", "pressure")),
                *(s[p][n] for p, n in species),
            ]
        )
    results: list[list[Any]] = [["unit", "model", "result", "value", "unit of value"]]
    for unit, row in data["units"].items():
        for name, figure in row["results"].items():
            results.append([unit, row["model"], name, figure["value"], figure["unit"]])
    taken: list[list[Any]] = [["unit", "utility", "carrier", "value", "unit of value", "counted"]]
    for unit, row in data["units"].items():
        for name, use in row["utilities"].items():
            taken.append([unit, name, use["carrier"], use["value"], use["unit"], use["counted"]])
    for name, total in data["utilities"].items():
        if isinstance(total, dict) and "value" in total:
            taken.append(["", name, "", total["value"], total["unit"], ""])
    return {"streams": streams, "results": results, "utilities": taken}


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
        writer = csv.writer(text)
        for rows in found.values():
            writer.writerows(rows)
            writer.writerow([])
        return text.getvalue().encode()
    from openpyxl import Workbook

    book = Workbook()
    for title, rows in found.items():
        sheet = book.create_sheet(title)
        for row in rows:
            sheet.append(row)
        sheet.freeze_panes = "B2"
    del book["Sheet"]  # the empty one a new book starts with
    data = io.BytesIO()
    book.save(data)
    return data.getvalue()
