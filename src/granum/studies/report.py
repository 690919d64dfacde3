"""A study as terminal tables and as an HTML report; both from the same rows."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from rich.text import Text

import granum
from granum.core.i18n import _
from granum.core.units import format_number, from_si, pretty_unit
from granum.reports.dates import date_text
from granum.reports.templating import page
from granum.reports.terminal import CAUTION, OK, OUT, _console, _table
from granum.studies.outcome import Outcome, kind_in_words
from granum.studies.subjects import NOT_RUN, Variable

ROWS = 40
LEADING = 4


class Rows(NamedTuple):
    """One table: title, heads with their alignment, cells."""

    title: str
    heads: list[tuple[str, str]]
    cells: list[list[str]]


def _cell(v: Variable, value: Any, unit: str | None = None) -> str:
    if value is None or not np.isfinite(value):
        return "—"
    unit = v.parameter.display_unit(value) if unit is None else unit
    number = float(value) if v.parameter.kind is None else float(from_si(value, unit, v.parameter.kind))
    return format_number(number)


def _with_unit(v: Variable, value: Any) -> str:
    if value is None or not np.isfinite(value):
        return "—"
    unit = v.parameter.display_unit(value)
    return f"{_cell(v, value, unit)} {pretty_unit(unit)}".strip()


def _percent(value: Any) -> str:
    return "—" if value is None else f"{format_number(100 * value, 3)} %"


def _known(outcome: Outcome) -> dict[str, Variable]:
    return {v.path: v for v in (*outcome.inputs, *outcome.outputs)}


def _labels(outcome: Outcome) -> dict[str, str]:
    """The quantities in words by path; the unit they belong to only where there are several."""
    known = _known(outcome)
    owners = {v.path.partition(".")[0] if "." in v.path and not v.named else "" for v in known.values()}
    alone = len(owners) == 1 and "" not in owners
    return {path: v.parameter.label if alone else v.label for path, v in known.items()}


def _statistics(outcome: Outcome, found: dict[str, Any]) -> Rows:
    heads = [
        (_("figure"), "left"),
        ("P10", "right"),
        ("P50", "right"),
        ("P90", "right"),
        (_("mean"), "right"),
        (_("unit"), "left"),
        (_("failed cases"), "right"),
    ]
    cells, labels = [], _labels(outcome)
    for v in outcome.outputs:
        row = found["statistics"][v.path]
        unit = v.parameter.display_unit(row["p50"] if row["p50"] is not None else 0.0)
        cells.append(
            [
                labels[v.path],
                *(_cell(v, row[k], unit) for k in ("p10", "p50", "p90", "mean")),
                pretty_unit(unit),
                str(row["failed"]),
            ]
        )
    return Rows(_("Figures"), heads, cells)


def _limit_text(label: str, v: Variable | None, low: float | None, high: float | None) -> str:
    if v is None:
        return _("all limits together")
    parts = [label]
    if low is not None:
        parts.insert(0, f"{_with_unit(v, low)} ≤")
    if high is not None:
        parts.append(f"≤ {_with_unit(v, high)}")
    return " ".join(parts)


def _chances(outcome: Outcome, rows: dict[str, Any], limits: dict[str, Any]) -> Rows:
    known, labels = _known(outcome), _labels(outcome)
    cells = []
    for path, row in rows.items():
        low, high = (limits.get(path, {}).get(k) for k in ("lower", "upper"))
        span = " … ".join(_percent(x) for x in row["interval_95"])
        cells.append(
            [
                _limit_text(labels.get(path, ""), known.get(path), low, high),
                _percent(row["probability"]),
                span,
            ]
        )
    return Rows(
        _("Probability of keeping the limits"),
        [(_("limit"), "left"), (_("probability"), "right"), (_("95 % interval"), "right")],
        cells,
    )


def _monte_carlo(outcome: Any, found: dict[str, Any]) -> list[Rows]:
    tables = [_statistics(outcome, found)]
    if found["limits"]:
        tables.append(_chances(outcome, found["limits"], found["limits"]))
    if len(outcome.cases.inputs) > 1 and found["rank_correlation"]:
        cells, labels = [], _labels(outcome)
        for path, row in found["rank_correlation"].items():
            known = sorted(((n, r) for n, r in row.items() if r is not None), key=lambda pair: -abs(pair[1]))
            for i, (name, r) in enumerate(known[:LEADING]):
                cells.append([labels[path] if i == 0 else "", labels.get(name, name), format_number(r, 2)])
        heads = [(_("figure"), "left"), (_("input"), "left"), (_("rank correlation"), "right")]
        tables.append(Rows(_("What moves the figures most"), heads, cells))
    return tables


def _sobol(outcome: Any, found: dict[str, Any]) -> list[Rows]:
    heads = [
        (_("figure"), "left"),
        (_("input"), "left"),
        (_("alone"), "right"),
        ("±", "right"),
        (_("with interactions"), "right"),
        ("±", "right"),
    ]
    cells, labels = [], _labels(outcome)
    for path, rows in found["indices"].items():
        ranked = sorted(rows.items(), key=lambda row: -(row[1]["total"] or 0.0))
        for i, (group, s) in enumerate(ranked):
            keys = ("first", "first_interval", "total", "total_interval")
            names = " + ".join(labels.get(name) or name for name in group.split(" + "))
            shares = ("—" if s[k] is None else format_number(s[k], 3) for k in keys)
            cells.append([labels[path] if i == 0 else "", names, *shares])
    return [_statistics(outcome, found), Rows(_("Share of the variance (Sobol indices)"), heads, cells)]


def _columns(outcome: Any, rows: Sequence[int], names: Sequence[str] = ()) -> Rows:
    """Inputs and figures of some cases, one case a row, units in the heads."""
    heads, columns = ([(_("case"), "left")], [list(names)]) if names else ([], [])
    labels = _labels(outcome)
    for v in (*outcome.inputs, *(v for v in outcome.outputs if v.path not in outcome.cases.inputs)):
        values = outcome.column(v.path)
        unit = v.parameter.display_unit(values)
        name, label = labels[v.path], pretty_unit(unit)
        heads.append((f"{name} / {label}" if label else name, "right"))
        columns.append([_cell(v, values[i], unit) for i in rows])
    return Rows("", heads, [list(row) for row in zip(*columns, strict=True)])


def _map(outcome: Any, found: dict[str, Any]) -> list[Rows]:
    cells, labels = [], _labels(outcome)
    for v in outcome.outputs:
        values = outcome.column(v.path)
        if not np.isfinite(values).any():
            continue
        for word, place in ((_("least"), int(np.nanargmin(values))), (_("most"), int(np.nanargmax(values)))):
            at = "; ".join(
                f"{labels[u.path]} = {_with_unit(u, outcome.cases.x[place, i])}"
                for i, u in enumerate(outcome.inputs)
            )
            cells.append([labels[v.path], word, _with_unit(v, values[place]), at])
    tables = [
        Rows(
            _("Extremes of the map"),
            [(_("figure"), "left"), ("", "left"), (_("value"), "right"), (_("where"), "left")],
            cells,
        )
    ]
    if found["limits"]:
        tables.append(
            Rows(
                "",
                [(_("share of the map that keeps all limits"), "left")],
                [[_percent(found["share_allowed"])]],
            )
        )
    return tables


def _price(price: float, goal: Variable, found: dict[str, Any], v: Variable, limit: float) -> str:
    """What one unit more of a limit does to the objective, both in the units people use."""
    shown = []
    for variable, value in ((goal, found["objective"]["value"]), (v, limit)):
        unit = variable.parameter.display_unit(value)
        kind = variable.parameter.kind
        size = 1.0 if kind is None else float(from_si(1.0, unit, kind) - from_si(0.0, unit, kind))
        label = "K" if unit in ("degC", "degF") else pretty_unit(unit)
        shown.append((size, label))
    (up, above), (down, below) = shown
    return f"{format_number(price * up / down)} {above or '1'}" + (f" / {below}" if below else "")


def _optimum(outcome: Any, found: dict[str, Any]) -> list[Rows]:
    known, labels = _known(outcome), _labels(outcome)
    inputs = [
        [
            labels[p],
            _with_unit(known[p], row["value"]),
            f"{_with_unit(known[p], row['lower'])} … {_with_unit(known[p], row['upper'])}",
        ]
        for p, row in found["inputs"].items()
    ]
    figures = [
        [labels[p], _with_unit(known[p], row["value"]), _with_unit(known[p], row["before"])]
        for p, row in found["outputs"].items()
    ]
    active = []
    for row in found["active"]:
        v = known[row["name"]]
        sign = "≥" if row["side"] == "lower" else "≤"
        price = (
            "—"
            if row["price"] is None
            else _price(row["price"], known[found["objective"]["name"]], found, v, row["limit"])
        )
        active.append([f"{labels[row['name']]} {sign} {_with_unit(v, row['limit'])}", price])
    tables = [
        Rows(_("Best inputs"), [(_("input"), "left"), (_("value"), "right"), (_("allowed"), "left")], inputs),
        Rows(
            _("Figures at the optimum"),
            [(_("figure"), "left"), (_("value"), "right"), (_("before"), "right")],
            figures,
        ),
    ]
    if active:
        tables.append(
            Rows(
                _("Active limits"),
                [(_("limit"), "left"), (_("change of the objective per unit of the limit"), "right")],
                active,
            )
        )
    if found["chance"]:
        tables.append(_chances(outcome, found["chance"]["limits"], found["limits"]))
    return tables


def tables_of(outcome: Outcome) -> list[Rows]:
    """The tables of any study."""
    found, kind = outcome.findings(), outcome.kind
    if kind == "monte_carlo":
        return _monte_carlo(outcome, found)
    if kind == "sobol":
        return _sobol(outcome, found)
    if kind == "map":
        return _map(outcome, found)
    if kind == "optimize":
        return _optimum(outcome, found)
    count = len(outcome.cases.codes)
    picked = np.unique(np.linspace(0, count - 1, min(count, ROWS)).astype(int)).tolist()
    return [_columns(outcome, picked, getattr(outcome, "names", ()))]


def warnings_of(outcome: Outcome, *, goes_on: bool = False) -> list[str]:
    """What a reader must know: failed cases with their reasons, a study that was stopped or still
    ``goes_on``, an infeasible end.
    """
    counts = outcome.counts()
    rows = list(outcome.cases.notes)
    if counts["failed"]:
        rows.append(
            _(
                "{failed} of {run} cases failed; they are kept with their reason and left out of the figures."
            ).format(**counts)
        )
    left = outcome.cases.reason_of(NOT_RUN)  # told below, with how many there are
    rows += [
        f"{count} × {reason}"
        for reason, count in sorted(counts["reasons"].items(), key=lambda row: -row[1])
        if reason != left
    ]
    if counts["patient"]:
        rows.append(
            _("{patient} of {run} cases were solved by a more patient solver than the first.").format(
                **counts
            )
        )
    if counts["extrapolated"]:
        rows.append(
            _("In {extrapolated} of {run} cases some correlation is used outside its range.").format(**counts)
        )
    if not outcome.complete:
        told = (
            _("So far {run} of {cases} cases were run; the study goes on.")
            if goes_on
            else _("The study was stopped: {run} of {cases} cases were run.")
        )
        rows.append(told.format(**counts))
    found = outcome.findings()
    if outcome.kind == "optimize" and not found["feasible"]:
        rows.append(_("No start keeps every limit: this is the least violation found, not a solution."))
    if (
        outcome.kind == "optimize"
        and found["feasible"]
        and not any(s["converged"] and s["feasible"] for s in found["starts"])
    ):
        rows.append(_("No start converged: the best point found may not be the optimum."))
    if outcome.kind == "sobol" and found["blocks_used"] < found["blocks"]:
        rows.append(
            _("{blocks_used} of {blocks} blocks of cases are whole and were used for the indices.").format(
                **found
            )
        )
    if outcome.kind == "pareto" and found["dropped"]:
        rows.append(_("{dropped} points that others beat in both objectives were dropped.").format(**found))
    return rows


@contextmanager
def stoppable(parts: Path | None) -> Iterator[None]:
    """Ctrl+C during a study says where its cases are and how to go on."""
    try:
        yield
    except KeyboardInterrupt:
        kept = _(
            "Stopped. The cases computed so far are kept in '{folder}': the same command continues there."
        ).format(folder=parts)
        print(
            kept
            if parts is not None
            else _("Stopped. With --out FILE a study that is stopped can be continued."),
            file=sys.stderr,
        )
        raise


def print_study(outcome: Outcome, saved: Sequence[Path] = ()) -> None:
    """The outcome of ``granum study``."""
    console = _console()
    told = " · ".join(dict.fromkeys((outcome.title, kind_in_words(outcome.kind))))
    console.print(Text(told, style="bold"), Text(f"  {outcome.cases.subject.title}", style="dim"))
    for rows in tables_of(outcome):
        if rows.title:
            console.print(Text(rows.title, style="bold"))
        table = _table(*rows.heads, close=True)  # type: ignore[arg-type]
        for cells in rows.cells:
            table.add_row(*cells)
        console.print(table)
    if outcome.kind == "optimize":
        found = outcome.findings()
        sense = _("smallest") if found["objective"]["sense"] == "minimize" else _("largest")
        name = found["objective"]["name"]
        goal = _known(outcome)[name]
        console.print(
            Text(
                _(
                    "{sense} {name}: {value} (before: {before}); {evaluations} evaluations from "
                    "{starts} starts"
                ).format(
                    sense=sense,
                    name=_labels(outcome)[name],
                    value=_with_unit(goal, found["objective"]["value"]),
                    before=_with_unit(goal, found["objective"]["before"]),
                    evaluations=found["evaluations"],
                    starts=len(found["starts"]),
                ),
                style=OK if found["feasible"] else OUT,
            )
        )
    counts = outcome.counts()
    words = _("{run} cases in {seconds} s").format(
        run=counts["run"], seconds=format_number(outcome.elapsed, 3)
    )
    console.print(Text(words, style="dim"))
    for line in warnings_of(outcome):
        console.print(Text("! " + line, style=CAUTION))
    for path in saved:
        console.print(_("saved to {path}").format(path=path))


def study_report(outcomes: Sequence[Outcome], text: str = "", title: str = "") -> str:
    """HTML of the report of one or several studies of one file."""
    from granum.core.charts import as_html

    sections, first = [], True
    for outcome in outcomes:
        drawn = []
        for figure in outcome.charts().values():
            drawn.append(as_html(figure, plotly=first))
            first = False
        counts = outcome.counts()
        sections.append(
            {
                "title": outcome.title,
                "kind": kind_in_words(outcome.kind),
                "tables": tables_of(outcome),
                "warnings": warnings_of(outcome),
                "charts": drawn,
                "cases": _("{run} cases in {seconds} s").format(
                    run=counts["run"], seconds=format_number(outcome.elapsed, 3)
                ),
            }
        )
    block = [
        (_("Model"), outcomes[0].cases.subject.title),
        (_("Date"), date_text()),
        (_("Program"), f"Granum {granum.__version__}"),
    ]
    return page(
        "study.html.j2",
        title=title or outcomes[0].title,
        title_block=block,
        sections=sections,
        case_text=text,
    )
