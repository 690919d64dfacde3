"""The report of a solved line: one HTML file that opens anywhere and prints well."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

import granum
from granum.core import charts
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.core.registry import find
from granum.core.results import Result
from granum.core.sources import cite
from granum.core.units import format_number, from_si
from granum.estimation.results import by_fit
from granum.reports.dates import date_text
from granum.reports.mathml import equation_lines, mathml
from granum.reports.quantities import (
    check_row,
    defaults_text,
    estimate_rows,
    label_of,
    origins_text,
    ranges_text,
    statistics_text,
    value_text,
)
from granum.reports.sankey import ENERGY, sankey
from granum.reports.streams import audit_text, stream_table
from granum.reports.templating import page
from granum.reports.utilities import utility_table
from granum.streams.names import pretty
from granum.streams.stream import main_phase

LEAST = 0.01  # percent of the mass that a chart of sizes may leave out at either end


def _row(p: Parameter, value: Any, origin: str = "") -> dict[str, str]:
    label = f"{p.label} ({origin})" if origin else p.label
    return {
        "label": label,
        "symbol": mathml(p.symbol) if p.symbol else "",
        "text": value_text(value, p),
    }


def note_step(step: Result) -> dict[str, Any]:
    """One step of a calculation note: formula, numbers, result, source."""
    return {
        "title": step.card.title,
        "key": step.card.key,
        "equation": equation_lines(step.card.equation),
        "inputs": [
            _row(p, step.inputs[p.name], step.origins.get(p.name, ""))
            for p in step.card.parameters
            if step.inputs[p.name] is not None
        ],
        "outputs": [_row(p, step.outputs[p.name]) for p in step.card.outputs],
        "source": step.card.citation,
        "notices": [n["message"] for n in step.notices],
    }


def note_steps(steps: Iterable[Result]) -> list[dict[str, Any]]:
    """The steps of a note; one that was taken again with the same numbers stands once."""
    found: dict[str, dict[str, Any]] = {}
    for step in map(note_step, steps):
        found.setdefault(str((step["key"], step["inputs"], step["outputs"])), step)
    return list(found.values())


def nomenclature(steps: Iterable[Result]) -> list[tuple[str, str]]:
    """The symbols of a calculation note with what they mean."""
    words = {
        (p.symbol, p.term.label)
        for step in steps
        for p in (*step.card.parameters, *step.card.outputs)
        if p.term and p.symbol
    }
    return sorted(((mathml(symbol), label) for symbol, label in words), key=lambda row: row[1])


def _unit_sheet(run: Any, name: str) -> dict[str, Any]:
    report = run.units[name]
    return {
        "name": name,
        "title": report.model.card.title,
        "summary": report.model.card.summary,
        "parameters": [
            _row(p, value) for p, value in report.parameters() if value is not None and str(value)
        ],
        "figures": [_row(p, value) for p, value in report.figures()],
        "checks": [
            check_row(c, report.figures())._asdict() | {"source": cite(c.source)} for c in report.checks
        ],
        "steps": note_steps(run.notes[name]),
    }


def _fit_sheets(run: Any) -> list[dict[str, Any]]:
    """The lab tests from which parameters of the line were estimated, each once, with what it gave to which
    unit.
    """
    sheets = []
    for fit, given in by_fit(run.line.fits):
        paths = [f"{path} = {label_of(name)}" for path, name in given.items()]
        data, card = fit.as_json(), find(fit.card).card
        sheets.append(
            {
                "title": card.title,
                "gives": "; ".join(paths),
                "rows": estimate_rows(data),
                "statistics": " · ".join(
                    filter(
                        None,
                        (statistics_text(data), origins_text(data), defaults_text(data), ranges_text(data)),
                    )
                ),
                "source": card.citation,
                "notices": [f["message"] if isinstance(f, dict) else str(f) for f in data["flags"]],
            }
        )
    return sheets


def size_chart(run: Any, called: Callable[[str], str] = pretty) -> Any:
    """Cumulative size distributions of the streams that carry solid, each ``called`` after its name, over
    the sizes that occur; None where there is one size.
    """
    if all(len(stream.mixture.sizes) < 2 for stream in run.streams.values()):
        return None
    figure = charts.figure(charts.axis_title("particle_diameter", "um"), _("cumulative mass / %"), x_log=True)
    drawn = 0
    for name, stream in run.streams.items():
        if float(stream.solid_flow) > 1e-9 * float(stream.mass_flow) and main_phase(stream) != "gas":
            edges = np.maximum(stream.mixture.edges, 1e-9) * 1e6
            cumulative = 100 * np.concatenate([[0.0], np.cumsum(np.asarray(stream.size_fractions))])
            color, dash = (
                charts.LINES[drawn % len(charts.LINES)],
                charts.DASHES[drawn // len(charts.LINES) % len(charts.DASHES)],
            )
            within = _occurring(cumulative)
            charts.add_line(figure, edges[within], cumulative[within], called(name), color=color, dash=dash)
            drawn += 1
    return figure if drawn else None


def _occurring(cumulative: np.ndarray) -> slice:
    """From the last edge below which there is nothing to the first above which there is nothing."""
    first = int(np.flatnonzero(cumulative <= LEAST).max(initial=0))
    last = int(np.flatnonzero(cumulative >= 100.0 - LEAST).min(initial=cumulative.size - 1))
    return slice(first, last + 1)


def course_chart(run: Any) -> Any:
    """Mass flow of every stream over the time of a run; None for a line that only stands."""
    course = run.course
    if course is None:
        return None
    flows = {
        name: sum(
            np.asarray(x).reshape(len(course.times), -1).sum(axis=1) for x in (s.solid, s.liquid, s.gas)
        )
        for name, s in course.streams.items()
    }
    axes = (Parameter("time", KINDS["Time"]), Parameter("mass_flow", KINDS["MassFlow"]))
    columns = (np.asarray(course.times), np.concatenate([*flows.values()]))
    across, upward = (p.display_unit(values) for p, values in zip(axes, columns, strict=True))
    figure = charts.figure(charts.axis_title("time", across), charts.axis_title("mass_flow", upward))
    for i, (name, flow) in enumerate(flows.items()):
        color, dash = (
            charts.LINES[i % len(charts.LINES)],
            charts.DASHES[i // len(charts.LINES) % len(charts.DASHES)],
        )
        charts.add_line(
            figure,
            from_si(columns[0], across, KINDS["Time"]),
            from_si(flow, upward, KINDS["MassFlow"]),
            pretty(name),
            color=color,
            dash=dash,
        )
    return figure


def _charts(run: Any) -> list[tuple[str, str]]:
    """Headings and charts of a report; the first carries Plotly."""
    cycles = run.schedule()
    found = {
        _("Flow of mass"): sankey(run),
        _("Flow of energy"): sankey(run, ENERGY),
        _("Particle sizes"): size_chart(run),
        _("Run in time"): course_chart(run),
        _("Schedule of the batches"): cycles.chart() if cycles.cycles else None,
    }
    for heading, figure in run.charts().items():
        unit, dot, inside = heading.partition(" · ")
        found[f"{pretty(unit)}{dot}{inside}"] = figure
    drawn = [(heading, figure) for heading, figure in found.items() if figure is not None]
    for _heading, figure in drawn:
        figure.update_layout(title_text="", margin_t=30)
    return [(heading, charts.as_html(figure, plotly=i == 0)) for i, (heading, figure) in enumerate(drawn)]


def line_report(run: Any, advice: Mapping[str, str] | None = None) -> str:
    """HTML of the report; ``advice`` is what is to be said of units whose checks fail, by unit."""
    told = run.line.told
    described = told.get("description")
    units = [_unit_sheet(run, name) for name in run.sheet.order]
    keys = {
        p
        for name in run.sheet.order
        for p in (run.units[name].model.card.source, *(c.source for c in run.units[name].checks))
    }
    taken = utility_table(run)
    keys |= {u.source for name in run.sheet.order for u in run.units[name].model.utilities.values()}
    keys |= {step.card.source for steps in run.notes.values() for step in steps}
    block = [
        (_("Project"), told.get("project", "")),
        (_("Author"), told.get("author", "")),
        (_("Date"), told.get("date") or date_text()),
        (_("Program"), f"Granum {granum.__version__}"),
        (_("Inputs"), "sha256 " + hashlib.sha256(run.line.text.encode()).hexdigest()[:12]),
    ]
    audit = run.audit
    numbers = {k: format_number(audit[f"{k}_closure"], 2) for k in ("mass", "energy")} | {
        "text": audit_text(audit)
    }
    return page(
        "line.html.j2",
        run=run,
        description=_(described) if described else "",
        title_block=[(label, value) for label, value in block if value],
        units=units,
        checks=sum(len(u["checks"]) for u in units),
        failed=[
            (u["name"], f"{c['name']}{_(': ')}{c['text']} ({c['allowed']})")
            for u in units
            for c in u["checks"]
            if not c["ok"]
        ],
        advice=dict(advice or {}),
        flags=run.flags,
        closes=max(audit["mass_closure"], audit["energy_closure"]) <= 1e-9,
        audit=numbers
        | {
            "units": [
                (n, format_number(c["mass"], 2), format_number(c["energy"], 2))
                for n, c in audit["units"].items()
            ]
        },
        diagram=run.drawing(),
        streams=stream_table(run),
        utilities=taken,
        fits=_fit_sheets(run),
        symbols=nomenclature(step for steps in run.notes.values() for step in steps),
        charts=_charts(run),
        sources=sorted({cite(part) for key in keys for part in key.split(";") if part.strip()}),
        case_text=run.line.text,
    )
