"""What the worker processes can do: each task takes plain data and gives the bytes of an answer."""

from __future__ import annotations

import io
import json
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import tomli

from granum.app import exercises, studies
from granum.app.beside import described_curve, sheet, solved_input, typed_unit
from granum.app.case_forms import read_line
from granum.app.exercises import answers as worked_answers
from granum.app.exercises.marking import marked
from granum.app.forms import opening
from granum.app.spread import spread
from granum.app.telling import Tell
from granum.app.texts import described, plain_data
from granum.app.wording import noticed
from granum.cases.alone import case_text
from granum.cases.choosing import advice
from granum.cases.resizing import resized
from granum.core import kept, registry
from granum.core.cards import Card
from granum.core.conversion import Binder
from granum.core.documents import table_in
from granum.core.errors import GranumError, InputError, unknown_name
from granum.core.i18n import _, current_language
from granum.core.units import format_number, pretty_unit
from granum.flowsheet.watching import Watch
from granum.reports.quantities import (
    check_row,
    defaults_text,
    estimate_rows,
    found_rows,
    is_finding,
    origins_text,
    ranges_text,
    statistics_rows,
    value_text,
)
from granum.reports.sankey import diagrams
from granum.reports.streams import audit_text, stream_figures, stream_look, stream_sheet
from granum.reports.utilities import utility_table
from granum.streams.names import port_label
from granum.studies.intervals import intervals, split

LONGEST = 900.0  # s that a line may take


def packed(content: Any) -> bytes:
    """Whatever the package returns, as JSON."""
    return json.dumps(
        plain_data(content), ensure_ascii=False, allow_nan=False, separators=(",", ":")
    ).encode()


def evaluable(key: str, sorts: tuple[str, ...]) -> Any:
    """The declared thing of a key, refused when it is of another sort."""
    thing = registry.find(key)
    if thing.card.sort not in sorts:
        raise InputError(_("'{key}' ({sort}) cannot be used here.").format(key=key, sort=_(thing.card.sort)))
    return thing


def valued(key: str) -> Any:
    """A formula, a procedure or a law that needs no more than numbers."""
    thing = evaluable(key, ("formula", "procedure", "law"))
    if not hasattr(thing, "evaluate"):
        raise InputError(
            _("'{key}' is used inside equipment and has no value by itself.").format(key=thing.card.key)
        )
    return thing


def given_values(inputs: dict[str, Any]) -> dict[str, Any]:
    """Inputs as text, numbers or ``{"value", "unit"}``; empty ones are left out."""
    values: dict[str, Any] = {}
    for name, value in inputs.items():
        if isinstance(value, dict) and set(value) <= {"value", "unit"}:
            value = f"{value.get('value', '')} {value.get('unit', '')}".strip()
        if isinstance(value, str) and value.lstrip().startswith("{"):
            value = _law(name, value)
        if value not in ("", None):
            values[name] = value
    return values


def _law(name: str, text: str) -> Any:
    """A law with its parameters, written in a form or a link."""
    return table_in(text, name)


def inputs_for(card: Card, inputs: dict[str, Any]) -> dict[str, Any]:
    """The values for a card; what a page or a file cannot mean (a list for a law, nothing for a list) is
    refused here.
    """
    values = given_values(inputs)
    for p in card.inputs.values():
        value = values.get(p.name)
        listed = isinstance(value, (list, tuple))
        single = p.kind is not None and not p.series and card.sort != "formula"
        if value is None:
            continue
        if (
            (p.law and not isinstance(value, (str, dict)))
            or (listed and (single or not value or not p.kind))
            or (isinstance(value, dict) and not p.law and p.kind is None)
            or (isinstance(value, bool) and p.sort is not bool and p.kind is None)
        ):
            raise InputError(
                _("'{name}' cannot take this value: {value}.").format(name=p.name, value=str(value)[:60]),
                name=p.name,
            )
    return values


def calculate(payload: dict[str, Any], _tell: Tell) -> bytes:
    """Evaluate a formula, a procedure or a law that needs no more than numbers."""
    thing = valued(payload["key"])
    given, spreads = inputs_for(thing.card, payload["inputs"]), {}
    if thing.card.sort != "law":
        given, spreads = split(thing.card, given)
    result = thing.evaluate(**given)
    shown = described(result, given)
    for row in shown["inputs_shown"]:
        row["text"] = spreads[row["name"]].text if row["name"] in spreads else row["text"]
    found = {name: i._asdict() for name, i in intervals(thing, result, spreads).items()}
    return packed(shown | {"intervals": found})


def others(payload: dict[str, Any], _tell: Tell) -> bytes:
    """The same inputs by other laws."""
    thing = evaluable(payload["key"], ("formula",))
    given = split(thing.card, inputs_for(thing.card, payload["inputs"]))[0]
    return packed(spread(thing, Binder.of(thing.card.key, thing.card.parameters).resolved((), given)[0]))


def sensitivity(payload: dict[str, Any], tell: Tell) -> bytes:
    """The chart of one result over one input, with the choice of both; and what other laws give where that
    is wanted.
    """

    def drawn() -> bytes:
        return packed(described_curve(_valued_or_machine(payload["key"]), payload, tell))

    if payload.get("case") and _is_opening(payload["case"]):
        return _once(("sensitivity", json.dumps(payload, sort_keys=True)), drawn)
    return drawn()


def figure(payload: dict[str, Any], _tell: Tell) -> bytes:
    """A figure of the handbook with its sliders."""
    from granum.reports.moving_figures import moving_figure  # draws with many domains

    values = payload.get("values")
    if not isinstance(values, dict | None):
        raise InputError(_("'values' is a table of numbers by the name of their slider."))
    found = moving_figure(payload["name"])
    return packed({"sliders": found.told(), "figure": found.at(values)})


def chapter_figure(payload: dict[str, Any], tell: Tell) -> bytes:
    """A figure of a chapter of the handbook, in the language of the chapter."""
    from granum.app.chapters import chapter_figure as drawn  # draws with many domains
    from granum.app.shipped import written

    asked = payload["domain"], payload["name"], payload["code"]
    once = kept.Named(("figure of a chapter", asked, written()))
    text = once.found()
    if text is None:
        note = _("the calculations of the chapter are run")
        tell(0.0, note)
        text = str(drawn(*asked, lambda share: tell(0.9 * share, note)).to_json())
        once.put(lambda: text)
    return text.encode()


def solve(payload: dict[str, Any], _tell: Tell) -> bytes:
    """The input for which a result is the wanted one; of equipment a setting, for one of its figures."""
    return packed(solved_input(_valued_or_machine(payload["key"]), payload))


def _valued_or_machine(key: str) -> Any:
    thing = registry.find(key)
    return thing if thing.card.sort == "equipment" else valued(key)


def calculation(payload: dict[str, Any], _tell: Tell) -> bytes:
    """The sheet of a calculation, HTML."""
    return sheet(valued(payload["key"]), payload).encode()


def chart(payload: dict[str, Any], tell: Tell) -> bytes:
    """Draw a chart: Plotly JSON."""
    thing = evaluable(payload["key"], ("chart",))
    inputs = inputs_for(thing.card, payload["inputs"])

    def drawn() -> bytes:
        tell(0.2, _("drawing"))
        return thing(**inputs).to_json().encode()

    # the one with which its page opens is asked for again and again
    return _once(("chart", thing.card.key), drawn) if inputs == opening(thing.card.key) else drawn()


def _once(name: tuple[str, ...], work: Callable[[], bytes]) -> bytes:
    """An answer, kept for the next process that is asked for it."""
    once = kept.Named(name)
    answer = once.found()
    if answer is None:
        answer = work()
        once.put(lambda: answer)
    return answer


def fit(payload: dict[str, Any], tell: Tell) -> bytes:
    """Fit a lab test to a table."""
    tell(0.0, _("reading the data"))
    test_type = evaluable(payload["key"], ("lab test",))
    try:
        conditions = json.loads(payload["conditions"])
    except (ValueError, RecursionError):
        conditions = None
    if not isinstance(conditions, dict):
        raise InputError(_("'{name}' is not valid JSON.").format(name="conditions"))
    source = io.BytesIO(payload["content"])
    source.name = payload["name"]
    test = test_type.read(source, **inputs_for(test_type.card, conditions))
    tell(0.2, _("fitting"))
    found = test.fit()
    tell(0.8, _("drawing"))
    data = found.as_json() | {"residuals": found.residuals, "kept": found.kept, "flags": noticed(found.flags)}
    return packed(
        data
        | {
            "shown": [row._asdict() for row in estimate_rows(data)],
            "residual_unit": _residual_unit(test_type),
            "statistics_rows": statistics_rows(data),
            "remarks": [*filter(None, (text(data) for text in (origins_text, defaults_text, ranges_text)))],
            "chart": json.loads(test.chart().to_json()),
        }
    )


def _residual_unit(test_type: Any) -> str:
    """SI unit of what a test fits; empty where it fits several things."""
    from granum.core.kinds import kind_of

    kinds = [kind_of(annotation) for annotation in getattr(test_type, "axes", {}).values()]
    return pretty_unit(kinds[1].unit) if len(kinds) == 2 and kinds[1] is not None else ""


def table(payload: dict[str, Any], _tell: Tell) -> bytes:
    """The text of a data file, whatever it was, so that a page can show it and name its columns."""
    from granum.estimation.tables import as_csv, sheets_of

    source = io.BytesIO(payload["content"])
    source.name = payload["name"]
    text = as_csv(source, payload.get("sheet", ""))
    return packed({"text": text, "sheets": sheets_of(payload["content"])})


@dataclass
class _Kept:
    """A line with its solution, kept for the report and for the next edit."""

    line: Any
    outcome: Any = None


@lru_cache(maxsize=4)
def _read(case: str, folder: str, root: str, _language: str) -> _Kept:
    return _Kept(read_line({"case": case, "folder": folder, "root": root}))


def _outcome(payload: dict[str, Any], tell: Tell) -> Any:
    tell(0.0, _("reading the case"))
    found = _read(payload["case"], payload.get("folder", ""), payload.get("root", ""), current_language())
    if found.outcome is None:
        tell(0.2, _("compiling and solving"))
        found.outcome = found.line.solve(_watch(tell))
    return found.outcome


def _watch(tell: Tell) -> Watch:
    """Tells the page of each pass through a loop, and stops when nobody waits for the line any more."""

    def seen(loop: str, number: int, residual: float) -> None:
        told = _("loop through '{stream}': pass {number}, residual {residual}")
        tell.say(0.5, told.format(stream=loop, number=number, residual=format_number(residual, 2)))
        if tell.stopped():
            watch.stop()

    watch = Watch(seen, seconds=LONGEST)
    return watch


def _is_opening(case: Any) -> bool:
    """Whether a case is a piece of equipment alone as its page opens."""
    try:
        units = tomli.loads(case)["units"].values()
        return [case] == [case_text(unit["model"], {}) for unit in units]
    except (ValueError, LookupError, TypeError, AttributeError, GranumError):
        return False  # what is wrong with it is told where it is read


def run(payload: dict[str, Any], tell: Tell) -> bytes:
    """Solve the text of a case file."""
    if _is_opening(payload["case"]):
        return _once(("run", payload["case"]), lambda: _run(payload, tell))
    return _run(payload, tell)


def _run(payload: dict[str, Any], tell: Tell) -> bytes:
    outcome = _outcome(payload, tell)
    tell(0.8, _("drawing"))
    data = outcome.as_json()
    data["audit"]["text"] = audit_text(outcome.audit)
    for name, report in outcome.units.items():
        data["units"][name]["title"] = report.model.card.title
        for p, value in report.figures():
            data["units"][name]["results"][p.name] |= {
                "label": p.label,
                "text": value_text(value, p),
                "finding": is_finding(p),
            }
        data["units"][name]["checks"] = [
            row | check_row(c, report.figures())._asdict()
            for row, c in zip(data["units"][name]["checks"], report.checks, strict=True)
        ]
    for name, stream in outcome.streams.items():
        data["streams"][name] |= {"shown": stream_figures(stream), **stream_look(stream)}
    return packed(
        data
        | {
            "flags": noticed(data["flags"]),
            "diagram": outcome.drawing(),
            "stream_table": stream_sheet(outcome),
            "utility_table": utility_table(outcome),
            "sankey": diagrams(outcome) if len(outcome.units) > 1 else [],
            "found": found_rows(outcome),
            "advice": {name: one.as_json() for name, one in advice(outcome).items()},
        }
    )


def inside(payload: dict[str, Any], tell: Tell) -> bytes:
    """What there is to look at in a piece of equipment alone: sizes of its streams, called after its ports,
    unless all leave as they came; and what it draws of itself.
    """
    if _is_opening(payload["case"]):
        return _once(("inside", payload["case"]), lambda: _inside(payload, tell))
    return _inside(payload, tell)


def _inside(payload: dict[str, Any], tell: Tell) -> bytes:
    from granum.reports.html import size_chart

    outcome = _outcome(payload, tell)
    tell(0.8, _("drawing"))
    solids = [np.asarray(s.size_fractions) for s in outcome.streams.values() if float(s.solid_flow) > 0.0]
    changed = len(solids) == 1 or not all(np.allclose(one, solids[0], atol=1e-4) for one in solids)
    sizes = size_chart(outcome, lambda name: port_label(name.rpartition(".")[2])) if changed else None
    found = {_("Particle sizes"): sizes} | outcome.charts()
    drawn = {heading.rpartition(" · ")[2]: figure for heading, figure in found.items() if figure is not None}
    for figure in drawn.values():
        figure.update_layout(title_text="", margin_t=30)
    return packed({"charts": [{"heading": h, "figure": f.to_plotly_json()} for h, f in drawn.items()]})


def resize(payload: dict[str, Any], tell: Tell) -> bytes:
    """A piece of equipment of a case sized for what enters it: the setting with its new text, and the reason
    in words.
    """
    outcome = _outcome(payload, tell)
    name = payload["unit"]
    if name not in outcome.sheet.units:
        raise unknown_name(_("Unit"), name, outcome.sheet.units)
    tell(0.4, _("seeking the size"))
    found = resized(outcome, name, payload["wanted"])
    table = tomli.loads(payload["case"])["units"][name]
    unit = typed_unit(table.get(found.setting.name), found.setting)
    return packed({"key": found.setting.name, "text": found.text(unit), "told": found.told()})


def report(payload: dict[str, Any], tell: Tell) -> bytes:
    """The report of the text of a case file."""
    from granum.reports.html import line_report

    outcome = _outcome(payload, tell)
    tell(0.5, _("writing the report"))
    told = {name: one.told for name, one in advice(outcome).items()}
    return line_report(outcome, told).encode()


def tables(payload: dict[str, Any], tell: Tell) -> bytes:
    """Streams and results of the text of a case file, as a table file."""
    from granum.reports.sheets import table_file

    return table_file(_outcome(payload, tell), payload["form"])


def study_choices(payload: dict[str, Any], _tell: Tell) -> bytes:
    """What a study of a line or a card may vary and watch."""
    return packed(studies.choices(payload))


def study(payload: dict[str, Any], tell: Tell) -> bytes:
    """Run a study."""
    return packed(studies.study(payload, tell))


def exercise(payload: dict[str, Any], _tell: Tell) -> bytes:
    """An exercise with its numbers."""
    return packed(exercises.worked(payload["name"], payload["seed"]))


def answers(payload: dict[str, Any], _tell: Tell) -> bytes:
    """What is right at every step of an exercise."""
    return packed({"answers": worked_answers.answers(payload["name"], payload["seed"])})


def answer_sheet(payload: dict[str, Any], _tell: Tell) -> bytes:
    """The answers of many students as CSV."""
    return worked_answers.sheet(payload["name"], payload["first"], payload["last"]).encode()


def mark(payload: dict[str, Any], _tell: Tell) -> bytes:
    """The verdict on the answer to a step of an exercise."""
    return packed(marked(payload["name"], payload["step"], payload["seed"], payload["answer"]))


def warm_up(_payload: Any, tell: Tell) -> bytes:
    """Solve and draw a small machine: what every line needs from JAX is then there for the first."""
    payload = {"case": case_text("settling.thickener", {})}
    _run(payload, tell)
    return _inside(payload, tell)


def rest(payload: dict[str, Any], tell: Tell) -> bytes:
    """Do nothing for a while, ready to be cancelled: shows that a worker process is there."""
    until = time.monotonic() + float(payload["seconds"])
    while time.monotonic() < until:
        time.sleep(0.05)
        tell(0.0)
    return b"{}"


def fill(payload: dict[str, Any], _tell: Tell) -> bytes:
    """Take memory and give it back: shows the limit of a worker process."""
    return str(len(bytearray(int(payload["bytes"])))).encode()


TASKS: dict[str, Callable[[dict[str, Any], Tell], bytes]] = {
    task.__name__: task
    for task in (
        calculate,
        others,
        sensitivity,
        figure,
        chapter_figure,
        solve,
        calculation,
        chart,
        fit,
        table,
        run,
        inside,
        resize,
        report,
        tables,
        study_choices,
        study,
        exercise,
        answers,
        answer_sheet,
        mark,
        warm_up,
        rest,
        fill,
    )
}
