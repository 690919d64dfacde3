"""What stands beside a result: its chart over one input, in the units of the page."""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping
from typing import Any

from granum.app.forms import as_typed, typed
from granum.app.machine_curves import Machine
from granum.app.spread import curves
from granum.app.telling import Tell
from granum.cases.reading import read_text
from granum.cases.sizing import doubts, sought
from granum.core.conversion import Binder
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.parameters import Parameter
from granum.core.unit_names import fits
from granum.core.units import from_si
from granum.core.written import read_number
from granum.reports.calculation import calculation_sheet
from granum.reports.quantities import value_text
from granum.reports.sensitivity import (
    Curve,
    chart,
    covered,
    curve,
    measured,
    seen,
    spoken,
    takes_arrays,
    variable,
)
from granum.studies.intervals import intervals, split
from granum.studies.inverse import find_input

LONG = 0.5  # seconds of the processor for one calculation, beyond which it is not repeated for a chart
NO_CURVE: dict[str, Any] = {"figure": None, "inputs": [], "outputs": []}
THIN = {"color": "#8a94a3", "width": 0.8}


def described_curve(thing: Any, asked: Mapping[str, Any], tell: Tell | None = None) -> dict[str, Any]:
    """The chart of a result with what may be chosen for it; ``figure`` is None where there is none.

    ``asked`` holds the inputs as typed, which of them to run ``against``, which ``output`` in which ``unit``,
    and whether other ``laws`` are wanted too.
    """
    from granum.app.tasks import inputs_for

    if thing.card.sort == "equipment":
        return _machine_curve(thing.card.key, asked, tell)
    given = split(thing.card, inputs_for(thing.card, _mapping(asked.get("inputs"))))[0]
    start = time.thread_time()
    result = thing.evaluate(**given)
    repeatable = takes_arrays(thing) or time.thread_time() - start < LONG
    found = repeatable and curve(thing, result, str(asked.get("against", "")), str(asked.get("output", "")))
    if not found:
        return NO_CURVE
    units = _units(found, given, asked)
    told = _told(found, units) | {
        "against": found.against.name,
        "output": found.output.name,
        "inputs": _choices((p.name, p) for p in variable(result)),
        "outputs": _choices((p.name, p) for p in measured(result)),
    }
    if asked.get("laws"):
        told["figure"]["data"] = [*_others(thing, given, found, units), *told["figure"]["data"]]
    return told


def _machine_curve(key: str, asked: Mapping[str, Any], tell: Tell | None) -> dict[str, Any]:
    """The same of a piece of equipment alone; shaded is where it keeps its practical limits."""
    words = _mapping(asked.get("inputs"))
    machine = Machine(key, words)
    if not machine.figures:
        return NO_CURVE
    against, output = machine.chosen(str(asked.get("against", "")), str(asked.get("output", "")))
    found = machine.curve(against, output, tell)
    choice = {
        "against": against,
        "output": output,
        "inputs": _choices(machine.settings.items()),
        "outputs": _choices(machine.figures.items()),
    }
    if found is None:
        note = _("No chart: one calculation takes too long to be repeated here. A study runs many.")
        return choice | {"figure": None, "note": note}
    units = typed_unit(words.get(against), found.against), _known(asked.get("unit"), found.output)
    return _told(found, units) | choice


def _choices(named: Iterable[tuple[str, Parameter]]) -> list[dict[str, str]]:
    return [{"name": name, "label": p.label} for name, p in named]


def _told(found: Curve, units: tuple[str, str]) -> dict[str, Any]:
    return {
        "figure": chart(found, units).to_plotly_json(),
        "spoken": spoken(found, units),
        "covered": any(True for _span in covered(found)),
    }


def sheet(thing: Any, asked: Mapping[str, Any]) -> str:
    """The calculation as a sheet, with the chart that stands on the page; ``link`` leads back to it."""
    from granum.app.tasks import inputs_for

    given, spreads = split(thing.card, inputs_for(thing.card, _mapping(asked.get("inputs"))))
    result = thing.evaluate(**given)
    found = curve(thing, result, str(asked.get("against", "")), str(asked.get("output", "")))
    units = _units(found, given, asked) if found is not None else ("", "")
    within = {name: (i.text, i.how) for name, i in intervals(thing, result, spreads).items()}
    link = str(asked.get("link", ""))
    safe = link if link.startswith(("http://", "https://")) else ""
    stated = as_typed(thing.card, given) | {name: s.text for name, s in spreads.items()}
    return calculation_sheet(thing, result, found=found, units=units, within=within, stated=stated, link=safe)


def _units(found: Curve, given: Mapping[str, Any], asked: Mapping[str, Any]) -> tuple[str, str]:
    """The units of a chart: as the input was typed, and as the result is shown."""
    return typed_unit(given.get(found.against.name), found.against), _known(asked.get("unit"), found.output)


def solved_input(thing: Any, asked: Mapping[str, Any]) -> dict[str, Any]:
    """The value of the input to ``find`` for which the result ``output`` is the ``wanted`` one, as text of a
    form.
    """
    from granum.app.tasks import inputs_for

    inputs = _mapping(asked.get("inputs"))
    name, output = str(asked.get("find", "")), str(asked.get("output", ""))
    before = inputs.get(name)
    wanted = {output: asked.get("wanted", "")}
    if thing.card.sort == "equipment":
        case = sought(thing.card.key, inputs | wanted, name)
        run = read_text(case.text, name=thing.card.key).solve()
        p, value, against = thing.card.parameter(name), run.found[case.path], doubts(run)
    else:
        given = split(thing.card, inputs_for(thing.card, {n: v for n, v in inputs.items() if n != name}))[0]
        p, value, _result = find_input(thing, name, **given, **wanted)
        against = ""
    unit = typed_unit(before, p) or p.display_unit(value)
    assert p.kind is not None  # what is found is a quantity
    number = typed(float(from_si(value, unit, p.kind)), 9)
    return {
        "name": name,
        "text": number if unit == "dimensionless" else f"{number} {unit}",
        "shown": f"{p.label} = {value_text(value, p)}" + (f". {against}" if against else ""),
    }


def _mapping(inputs: Any) -> dict[str, Any]:
    if not isinstance(inputs, dict):
        raise InputError(_("'{name}' is missing.").format(name="inputs"), name="inputs")
    return inputs


def typed_unit(text: Any, p: Parameter) -> str:
    """The unit in which an input was typed; empty where it was not, or is no unit of it."""
    number = read_number(text) if isinstance(text, str) else None
    return _known(number[1] if number else "", p)


def _known(unit: Any, p: Parameter) -> str:
    good = isinstance(unit, str) and unit and p.kind is not None and fits(unit, p.kind.unit)
    return str(unit) if good else ""


def _others(thing: Any, given: dict[str, Any], found: Curve, units: tuple[str, str]) -> list[dict[str, Any]]:
    """What other laws give, as thin lines of a chart."""
    against, output = found.against, found.output
    resolved = Binder.of(thing.card.key, thing.card.parameters).resolved((), given)[0]
    across, upward = found.units(units)
    assert against.kind is not None  # as what a curve runs over
    x = from_si(found.x, across, against.kind)
    return [
        {
            "type": "scatter",
            "mode": "lines",
            "name": label,
            "x": x,
            "y": seen(y, output, upward, found.steep),
            "line": THIN,
            "hovertemplate": "%{x:.4~g}, %{y:.4~g}<extra>%{fullData.name}</extra>",
        }
        for label, y in curves(thing, resolved, found)
    ]
