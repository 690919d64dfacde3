"""Studies for a page: what may vary and what may be watched, and an outcome as charts and tables with numbers
as people read them.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from granum.app.case_forms import read_line
from granum.app.telling import Cancelled, Tell, progress_text
from granum.app.texts import plain_data
from granum.core.conversion import convert
from granum.core.errors import GranumError, InputError, unknown_name
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.core.units import format_number, from_si
from granum.reports.quantities import value_text

MOST_CASES = 20_000
SHOWN_CASES = 2_000
FEED = ("mass_flow", "temperature")
WATCHED = ("mass_flow", "solid_flow", "temperature", "moisture_dry_basis", "median_size")


def subject(payload: Mapping[str, Any]) -> Any:
    """The line of a case, or a card with its fixed inputs."""
    from granum.studies import subject_of

    if payload.get("case"):
        return subject_of(read_line(payload))
    varied = set(payload.get("varied") or ())
    fixed = {name: value for name, value in (payload.get("inputs") or {}).items() if name not in varied}
    return subject_of(str(payload.get("card", "")), fixed)


def choices(payload: Mapping[str, Any]) -> dict[str, Any]:
    """Inputs with their present values, and figures, of a subject."""
    found = subject(payload)
    return {
        "title": found.title,
        "inputs": [row for path in _inputs(found) if (row := _input_row(found, path))],
        "figures": [
            {"name": v.path, "label": v.label, "quantity": v.parameter.as_json()} for v in _figures(found)
        ],
        "declared": _declared(payload),
    }


def _declared(payload: Mapping[str, Any]) -> list[dict[str, str]]:
    """The studies that the file of a line declares."""
    from granum.cases.reading import parsed

    tables = parsed(str(payload.get("case") or ""), "case").get("study")
    rows = (
        {name: table for name, table in tables.items() if isinstance(table, dict)}
        if isinstance(tables, dict)
        else {}
    )
    return [
        {
            "name": name,
            "title": str(table.get("title") or name.replace("_", " ")),
            "kind": str(table.get("kind", name)),
        }
        for name, table in rows.items()
    ]


def _inputs(found: Any) -> Iterator[str]:
    sheet = getattr(found, "sheet", None)
    if sheet is None:
        yield from (p.name for p in found.thing.card.parameters if p.kind is not None)
        return
    for name, unit in sheet.units.items():
        yield from (f"{name}.{p.name}" for p in type(unit).card.parameters if p.kind is not None)
    for feed in sheet.feeds:
        yield from (f"{feed}.{word}" for word in FEED)


def _input_row(found: Any, path: str) -> dict[str, Any] | None:
    try:
        v = found.input(path)
        value = float(found.nominal(path))
    except (GranumError, TypeError, ValueError):
        return None  # a list, a choice, or without a value: not for a form
    kind = v.parameter.kind
    spread = Parameter(v.parameter.name, KINDS["TemperatureDifference"]) if kind.unit == "K" else v.parameter
    unit = (
        (v.parameter.units or (kind.unit,))[0]
        if not np.isfinite(value) or value == 0.0
        else v.parameter.display_unit(value)
    )
    number = f"{float(from_si(value, unit, kind)):.5g}" if np.isfinite(value) else ""
    return {
        "name": path,
        "label": v.label,
        "value": number,
        "unit": "" if unit == "dimensionless" else unit,
        "shown": value_text(value, v.parameter),
        "quantity": v.parameter.as_json(),
        "spread": spread.as_json(),
    }


def _figures(found: Any) -> Iterator[Any]:
    yield from (found.output(path) for path in found.outputs())
    sheet = getattr(found, "sheet", None)
    if sheet is not None:
        yield from (found.output(path) for path in found.taken())
    for link in sheet.links if sheet is not None else ():
        for word in WATCHED:
            try:
                yield found.output(f"{link.name}.{word}")
            except GranumError:
                continue  # a stream without solid has no size


def _telling(tell: Tell) -> Callable[[Any], None]:
    """What a study calls with its progress: counts, and the time left as it went so far."""
    began: list[tuple[float, int]] = []

    def told(p: Any) -> None:
        now, left = time.monotonic(), None
        if not began:
            began.append((now, p.done))
        start, before = began[0]
        if before < p.done < p.total:
            left = (now - start) * (p.total - p.done) / (p.done - before)
        tell.say(p.done / max(p.total, 1), p.note or progress_text(p.done, p.total, p.failed, left))

    return told


def study(payload: Mapping[str, Any], tell: Tell) -> dict[str, Any]:
    """Run a declared study; ``tell`` hears how far it is. One that is stopped gives what it has computed."""
    from granum.studies import Study

    if payload.get("declared"):
        return _outcome(_declared_study(payload), payload, tell)
    table = payload.get("table")
    if not isinstance(table, dict):
        raise InputError(_("'{name}' is missing.").format(name="table"), name="table")
    tell(0.0, _("preparing the model"))
    _not_too_many(table)
    return _outcome(Study.of(str(table.get("kind", "")), table, subject(payload)), payload, tell)


def _declared_study(payload: Mapping[str, Any]) -> Any:
    """A study that the file of a line declares, as it stands there."""
    from granum.cases.studying import studies_of_text

    read_line(payload)  # refuses files outside the workspace
    folder = payload.get("folder")
    found = studies_of_text(str(payload["case"]), folder=Path(str(folder)) if folder else None)
    name = str(payload["declared"])
    if name not in found:
        raise unknown_name(_("Study"), name, found, quantities=False)
    _not_too_many(found[name].options)
    return found[name]


def _not_too_many(table: Mapping[str, Any]) -> None:
    for key in ("samples", "starts"):
        if isinstance(table.get(key), (int, float)) and table[key] > MOST_CASES:
            raise InputError(
                _("'{name}' may be at most {most} here.").format(name=key, most=MOST_CASES), name=key
            )
    over = table.get("over")
    if isinstance(over, dict) and all(isinstance(row, dict) for row in over.values()):
        cases = np.prod(
            [
                float(row["steps"]) if isinstance(row.get("steps"), (int, float)) else 1.0
                for row in over.values()
            ]
        )
        if cases > MOST_CASES:
            raise InputError(
                _("'{name}' may be at most {most} here.").format(name="steps", most=MOST_CASES), name="steps"
            )


def _outcome(declared: Any, payload: Mapping[str, Any], tell: Tell) -> dict[str, Any]:
    """Run it; finished chunks lie in the folder ``parts``, from which ``collect`` reads them without
    computing more, and leaves them there where the study ``goes_on`` meanwhile.
    """
    from granum.studies.report import warnings_of
    from granum.studies.store import forget

    parts = Path(str(payload["parts"])) if declared.kept_in_parts and payload.get("parts") else None
    outcome = declared.run(
        progress=_telling(tell), cancel=lambda: bool(payload.get("collect")) or tell.stopped(), folder=parts
    )
    goes_on = bool(payload.get("goes_on"))
    if parts is not None and not goes_on:
        forget(parts)
    if not outcome.complete and not outcome.counts()["run"]:
        raise Cancelled
    return plain_data(outcome.as_json(cases=SHOWN_CASES)) | {
        "model": _(outcome.cases.subject.title),
        "charts": [
            {"name": name, "figure": json.loads(figure.to_json())}
            for name, figure in outcome.charts().items()
        ],
        "tables": _tables(outcome, payload.get("inputs") or {}),
        "warnings": warnings_of(outcome, goes_on=goes_on),
        "goes_on": goes_on and not outcome.complete,
    }


def _text(value: Any, v: Any) -> str:
    return "—" if value is None or not np.isfinite(value) else value_text(float(value), v.parameter)


def _spread(value: Any, v: Any) -> str:
    """A standard deviation: a difference, so a temperature keeps its kelvins."""
    if value is None:
        return "—"
    return f"{format_number(value)} K" if v.unit == "K" else _text(value, v)


def _present(outcome: Any, path: str, given: Mapping[str, Any]) -> Any:
    """What an input was before it was varied."""
    v = outcome.cases.subject.input(path)
    return convert(given[path], v.parameter) if given.get(path) else outcome.cases.subject.nominal(path)


def _limit_text(v: Any, limit: Mapping[str, Any]) -> str:
    """A figure with the bounds that it should keep."""
    bounds = (("≥", limit["lower"]), ("≤", limit["upper"]))
    return f"{v.label} " + ", ".join(f"{sign} {_text(x, v)}" for sign, x in bounds if x is not None)


def _tables(outcome: Any, given: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The findings as tables of text; ``given`` are the inputs of a card before they were varied."""
    found = outcome.findings()
    figures = {v.path: v for v in outcome.outputs}
    inputs = {v.path: v for v in outcome.inputs}
    tables: list[dict[str, Any]] = []
    if outcome.kind == "monte_carlo":
        rows = [
            [
                figures[p].label,
                _text(s["mean"], figures[p]),
                _spread(s["standard_deviation"], figures[p]),
                *(_text(s[k], figures[p]) for k in ("p10", "p50", "p90")),
                str(s["failed"]),
            ]
            for p, s in found["statistics"].items()
        ]
        heads = [_("result"), _("mean"), _("standard deviation"), "P10", "P50", "P90", _("failed cases")]
        tables.append({"title": _("Spread of the results"), "columns": heads, "rows": rows})
        chances = [
            [
                _limit_text(figures[p], c) if p else _("all limits"),
                *(f"{format_number(100 * x, 3)} %" for x in (c["probability"], *c["interval_95"])),
            ]
            for p, c in found["limits"].items()
            if c["probability"] is not None
        ]
        if chances:
            heads = [_("limit"), _("chance"), _("at least (95 %)"), _("at most (95 %)")]
            tables.append({"title": _("Chance of keeping the limits"), "columns": heads, "rows": chances})
    if outcome.kind == "sobol":
        rows = [
            [
                figures[p].label,
                " + ".join(inputs[name].label if name in inputs else name for name in group.split(" + ")),
                *("—" if s[k] is None else format_number(s[k], 3) for k in ("first", "total")),
            ]
            for p, groups in found["indices"].items()
            for group, s in groups.items()
        ]
        tables.append(
            {
                "title": _("Shares of the variance"),
                "columns": [_("result"), _("input"), _("alone"), _("with interactions")],
                "rows": rows,
            }
        )
    if outcome.kind == "optimize":
        rows = [
            [inputs[p].label, _text(_present(outcome, p, given), inputs[p]), _text(row["value"], inputs[p])]
            for p, row in found["inputs"].items()
        ]
        rows += [
            [figures[p].label, _text(row["before"], figures[p]), _text(row["value"], figures[p])]
            for p, row in found["outputs"].items()
        ]
        tables.append(
            {"title": _("Optimum"), "columns": [_("quantity"), _("before"), _("best")], "rows": rows}
        )
        held = [
            [(figures | inputs)[row["name"]].label, _text(row["limit"], (figures | inputs)[row["name"]])]
            for row in found["active"]
        ]
        if held:
            tables.append(
                {
                    "title": _("What holds the optimum back"),
                    "columns": [_("quantity"), _("limit")],
                    "rows": held,
                }
            )
    if outcome.kind == "scenarios":
        named = [*found["scenarios"].items()]
        rows = [
            [v.label, *(_text(case[part].get(p), v) for _name, case in named)]
            for part, known in (("inputs", inputs), ("outputs", figures))
            for p, v in known.items()
        ]
        heads = [_("quantity"), *(name for name, _case in named)]
        tables.append({"title": _("Cases"), "columns": heads, "rows": rows})
    if outcome.kind in ("sweep", "pareto"):
        columns = {**inputs, **figures}
        rows = [
            [_text(outcome.column(p)[i], v) for p, v in columns.items()]
            for i in range(min(len(outcome.cases.codes), 60))
        ]
        tables.append({"title": _("Cases"), "columns": [v.label for v in columns.values()], "rows": rows})
    return tables
