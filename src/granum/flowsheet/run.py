"""``Line``: a flowsheet with its specifications and what is told of it. ``Run``: the same, solved and
audited.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import flags, notebooks, record_steps
from granum.core.conversion import convert
from granum.core.errors import ConvergenceError, InputError, nearest, without_value
from granum.core.formulas import Result
from granum.core.i18n import _
from granum.core.packing import as_arrays, compiled
from granum.core.parameters import Parameter
from granum.core.results import plain, quantity_json
from granum.core.utilities import carrier
from granum.costs.formulas.emissions import CARRIERS
from granum.estimation.results import Fit
from granum.flowsheet.cleaning import cleaning_chart, trains
from granum.flowsheet.drawing import draw
from granum.flowsheet.dynamics import Course, Profile, march
from granum.flowsheet.findings import Findings, fault_in_time
from granum.flowsheet.fitted import fit_notices
from granum.flowsheet.idle import idle
from granum.flowsheet.labelled import attributes, stream_dataset, stream_frame
from granum.flowsheet.ladder import climb
from granum.flowsheet.passing import told
from granum.flowsheet.rounding import thresholds, without_noise
from granum.flowsheet.schedule import Schedule, schedule
from granum.flowsheet.sheet import Flowsheet
from granum.flowsheet.solving import Solution
from granum.flowsheet.specifications import Target, varied
from granum.flowsheet.stream_figures import changed
from granum.flowsheet.utilities import (
    FIGURES,
    UTILITIES,
    WATER,
    Totals,
    by_carrier,
    cost_rate,
    counted,
    main_product,
    totals,
)
from granum.flowsheet.watching import Watch
from granum.streams.inside_charts import drawn_shares
from granum.streams.stream import Stream, median_size
from granum.streams.units import Check, Sheet, Unit

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


@compiled
def _marched(
    sheet: Flowsheet, times: Any, profiles: tuple[Profile, ...], start: str | dict[str, str]
) -> Course:
    return march(sheet, times, profiles, start=start)


class Movement(NamedTuple):
    """How a line runs in time: instants in s, disturbances, and how the units that hold matter start."""

    times: Any
    profiles: tuple[Profile, ...] = ()
    start: str | Mapping[str, str] = "steady"


@dataclass(frozen=True)
class Line:
    """A process line.

    Parameters
    ----------
    title: for reports. sheet: units, feeds and links. targets: design specifications. movement: how it runs
        in time, if it does.
    text: the case file it came from. fits: parameter → the fit it was taken from and its name there.
    told: ``description``, ``project``, ``author`` and ``date`` for the report.
    prices: of carriers and materials, SI.
    """

    title: str
    sheet: Flowsheet
    targets: tuple[Target, ...] = ()
    movement: Movement | None = None
    text: str = ""
    fits: Mapping[str, tuple[Fit, str]] = field(default_factory=dict)
    told: Mapping[str, str] = field(default_factory=dict)
    prices: Mapping[str, float] = field(default_factory=dict)

    def solve(self, watch: Watch | None = None) -> Run:
        """Solve, check and audit. Raises ``ConvergenceError`` (``last`` keeps the last iterate) for whatever
        is not a solution.

        ``watch`` is told of each pass through a loop, and may limit the time or stop.
        """
        found, wrong = climb(self.sheet, self.targets, watch)
        designed = found.designed
        run = Run(
            self,
            designed.line,
            designed.solution,
            found.findings,
            {k: float(v) for k, v in designed.values.items()},
        )
        if wrong:
            first, rest = wrong[0], wrong[1:]
            raise ConvergenceError(
                first.message,
                last=run,
                unit=first.unit or None,
                stream=first.stream or None,
                kind=first.kind,
                also=[fault.message for fault in rest] or None,
            )
        return run

    def march(self) -> Course:
        """The line in time. Raises where a loop does not converge at some instant."""
        if self.movement is None:
            raise InputError(
                _(
                    "This line does not say how it runs in time: give its case a [dynamic] table, or it "
                    "a 'movement'."
                )
            )
        times, profiles, start = self.movement
        course = _marched(as_arrays(self.sheet), times, profiles, start)
        bad = np.flatnonzero(~np.asarray(course.converged))
        if bad.size:
            raise ConvergenceError(
                _(
                    "A loop did not converge at {time} s ({count} of {all} times): take a smaller step."
                ).format(time=f"{times[bad[0]]:.6g}", count=bad.size, all=len(times)),
                last=course,
            )
        wrong = fault_in_time(self.sheet, course.streams, times, course.records)
        if wrong is not None:
            at, fault = wrong
            told = _("At {time} s: {fault}").format(time=f"{at:.6g}", fault=fault.message)
            raise ConvergenceError(
                told, last=course, unit=fault.unit or None, stream=fault.stream, kind=fault.kind
            )
        return course

    def with_values(self, **values: Any) -> Line:
        """The same line with other parameters of units and other figures of feeds, SI or text with a unit:
        ``line.with_values(**{"crystallizer.temperature": "10 degC", "brine.liquid_flow": 0.7})``.
        """
        given = {
            path: convert(value, varied(self.sheet, path)) if isinstance(value, str) else value
            for path, value in values.items()
        }
        figures = {path: value for path, value in given.items() if self._is_figure(path)}
        own = {path: value for path, value in given.items() if path not in figures}
        return replace(self, sheet=changed(self.sheet.with_values(own), figures))

    def _is_figure(self, path: str) -> bool:
        """Whether a path means what a feed amounts to, in place of an array that it holds."""
        head, _dot, word = path.partition(".")
        if head not in self.sheet.feeds or word in (f.name for f in fields(Stream)):
            return False
        varied(self.sheet, path)  # refuses what is none
        return True


@dataclass(frozen=True)
class UnitReport:
    """One unit of a solved line: model, figures, checks, what it takes of each utility, and which of these
    the line counts.
    """

    name: str
    model: Any
    values: Any
    checks: tuple[Check, ...]
    uses: Mapping[str, Any]
    counted: tuple[str, ...]

    def figures(self) -> Iterator[tuple[Parameter, Any]]:
        """Each figure with its declaration."""
        yield from zip(self.model.card.outputs, self.values, strict=True)

    def utilities(self) -> Iterator[tuple[Parameter, Any]]:
        """Each utility with its declaration."""
        told = (use.parameter for use in self.model.card.utilities if use.parameter.name in self.uses)
        yield from ((p, self.uses[p.name]) for p in told)

    def parameters(self) -> Iterator[tuple[Parameter, Any]]:
        """Each parameter of the unit with its value."""
        for p in self.model.card.parameters:
            yield p, getattr(self.model, p.name)

    def as_json(self) -> dict[str, Any]:
        """The stable ``run`` shape of one unit."""
        return {
            "model": self.model.card.key,
            "results": {p.name: quantity_json(value, p) for p, value in self.figures()},
            "utilities": {
                p.name: quantity_json(value, p)
                | {"carrier": carrier(p.name), "counted": p.name in self.counted}
                for p, value in self.utilities()
            },
            "checks": [
                {
                    "name": _(c.name),
                    "value": plain(c.value),
                    "low": plain(c.low),
                    "high": plain(c.high),
                    "unit": c.unit,
                    "ok": c.ok,
                    "source": c.source,
                }
                for c in self.checks
            ],
        }


@dataclass(frozen=True)
class Run:
    """A solved line: streams, unit reports, audit, flags; writes itself as JSON, tables and report."""

    line: Line
    sheet: Flowsheet
    solution: Solution
    findings: Findings
    found: dict[str, float]

    @property
    def title(self) -> str:
        """Title of the case; that of a shipped example in the current language."""
        return _(self.line.title)

    @property
    def streams(self) -> dict[str, Stream]:
        """Every stream by name, feeds first, then in the order of the case."""
        return {k.name: self.solution.streams[k.name] for k in self.sheet.links}

    @cached_property
    def sheets(self) -> dict[str, Sheet]:
        """What every unit says of itself, without what is only rounding."""
        least = thresholds(self.streams.values())
        return {
            name: without_noise(self.sheet.units[name], self.solution.sheets[name], least)
            for name in self.sheet.order
        }

    @cached_property
    def units(self) -> dict[str, UnitReport]:
        """Every unit's figures, checks and utilities."""
        counts, sheets = counted(self.sheet), self.sheets
        return {
            name: UnitReport(
                name,
                self.sheet.units[name],
                sheets[name].figures,
                tuple(check for check in sheets[name].checks if check.told),
                sheets[name].uses,
                counts[name],
            )
            for name in self.sheet.order
        }

    @cached_property
    def utilities(self) -> Totals:
        """What the line takes in all: power, heat and cold, energy per product and per water removed,
        greenhouse gas.
        """
        uses = {name: sheet.uses for name, sheet in self.sheets.items()}
        figures = {name: sheet.figures for name, sheet in self.sheets.items()}
        found = compiled(totals)(*as_arrays((self.sheet, uses, figures, self.streams)))
        return Totals(*(float(x) for x in found))

    @cached_property
    def carriers(self) -> dict[str, float]:
        """What the line takes of every carrier (W) and material (kg/s)."""
        uses = {name: sheet.uses for name, sheet in self.sheets.items()}
        return {name: float(x) for name, x in by_carrier(self.sheet, uses).items()}

    def utility_cost(self, prices: Mapping[str, Any]) -> float:
        """What the line pays for its utilities, USD/s, at prices by carrier.

        As in ``{"electricity": "0.10 USD/kWh", "low_pressure_steam": "30 USD/MWh"}``; a material, such as
        ``filter_aid``, has one per mass, hot gas one where it comes from outside.
        """
        return cost_rate(self.carriers, prices)

    @cached_property
    def costs(self) -> dict[str, float]:
        """What the line pays for each carrier and material that has a price, USD/s."""
        return {n: self.paid(n, x) for n, x in self.carriers.items() if n in self.line.prices}

    def paid(self, name: str, value: float) -> float:
        """What a flow of one carrier (W) or material (kg/s) costs at its price of the case, USD/s."""
        return cost_rate({name: value}, {name: self.line.prices[name]})

    @cached_property
    def product(self) -> str:
        """Name of the main product: the stream leaving with most solid times its share of solid; without
        solid that with most of what is dissolved, of those that a unit calls its product if there are any,
        then of liquid, then of mass.
        """
        place = compiled(main_product)(*as_arrays((self.sheet, self.streams)))
        return self.sheet.products[int(place)]

    def totals(self) -> Iterator[tuple[Parameter, float]]:
        """The line's totals with their declaration; those per water only where water is removed."""
        for p in FIGURES.values():
            if p.name not in WATER or self.utilities.evaporation_rate > 0.0:
                yield p, getattr(self.utilities, p.name)

    @cached_property
    def notes(self) -> dict[str, tuple[Result, ...]]:
        """The formulas each unit evaluates, with their numbers: the calculation note. Each unit is calculated
        once more.
        """
        written = {}
        for name in self.sheet.order:
            with record_steps() as steps:
                self.sheet.units[name].operate(**self._inlets(name))
            written[name] = tuple(step.result() for step in steps)
        return written

    def charts(self) -> dict[str, Any]:
        """Pictures of what happens inside the units, by unit and heading: what each draws of itself, and
        where each size goes if it parts sizes.
        """
        found: dict[str, Any] = {}
        named = {link.origin: link.name for link in self.sheet.links}
        for train in trains(self.sheet):
            caught = cleaning_chart(self.sheet, self.streams, train)
            if caught is not None:
                found[f"{', '.join(train)} · {_('What the collectors catch together')}"] = caught
        for name, unit in self.sheet.units.items():
            inlets = self._inlets(name)
            if type(unit).charts is not Unit.charts:
                with flags.collect():  # nobody hears them here
                    made = unit.operate(**inlets)
                drawn = unit.charts(made, inlets)
                found |= {f"{name} · {heading}": figure for heading, figure in drawn.items()}
            ports = {port: named.get(f"{name}.{port}", "") for port in type(unit).outlet_names()}
            leaving = {port: self.streams[there] for port, there in ports.items() if there in self.streams}
            parted = drawn_shares(inlets, leaving)
            if parted is not None:
                found[f"{name} · {_('Where each size goes')}"] = parted
        return found

    def _inlets(self, name: str) -> dict[str, Stream]:
        """What enters a unit, as arrays that its formulas calculate with."""
        return jax.tree.map(jnp.asarray, self.sheet.inlets_of(name, self.streams))

    @cached_property
    def audit(self) -> dict[str, Any]:
        """Closure of the whole line and the worst unit: largest of both, relative."""
        mass, energy = ([float(x) for x in side] for side in (self.findings.mass, self.findings.energy))
        return {
            "mass_closure": max(mass),
            "energy_closure": max(energy),
            "units": {
                name: {"mass": m, "energy": e}
                for name, m, e in zip(self.sheet.order, mass, energy, strict=False)
            },
        }

    @cached_property
    def flags(self) -> list[dict[str, Any]]:
        """What the formulas of each unit flagged, and the fits that it takes numbers from, with the unit's
        name.
        """
        in_vain = idle(self.sheet, self.streams)
        return told(self.solution.records) + fit_notices(self.line.fits, self.sheet) + in_vain

    @cached_property
    def course(self) -> Course | None:
        """The line in time, where it moves."""
        return None if self.line.movement is None else self.line.march()

    def drawing(self) -> str:
        """The flow diagram with its streams as SVG."""
        return draw(self.sheet, self.streams)

    def sankey(self, of: str = "mass") -> Any:
        """Sankey diagram of the streams as a Plotly figure: of ``mass`` by phase, of ``energy`` with heat and
        work, or of one component by its name.
        """
        from granum.reports.sankey import sankey

        return sankey(self, of)

    def schedule(self) -> Schedule:
        """The cycles of the batch units, with a Gantt chart."""
        return schedule({name: (u.model, u.values) for name, u in self.units.items()})

    def figure(self, path: str) -> float:
        """One result, SI: ``unit.result``, what a unit takes of a utility, as ``unit.electric_power_fan``, or
        a total of the line, as ``utilities.energy_per_water``.
        """
        known: dict[str, Any] = {}
        for unit, report in self.units.items():
            told = report.uses | report.values._asdict()
            known |= {f"{unit}.{name}": value for name, value in told.items()}
        if path.startswith(f"{UTILITIES}."):
            known |= {f"{UTILITIES}.{p.name}": value for p, value in self.totals()}
        if path not in known:
            message = _("'{path}' is not a result of this line.").format(path=path)
            if close := nearest(path, known):
                message += " " + _("Did you mean '{close}'?").format(close=close)
            raise InputError(message, path=path)
        if known[path] is None:
            raise without_value(path)
        return float(known[path])

    def sought(self) -> Iterator[tuple[str, Parameter, float]]:
        """What design specifications found: its path, what it is, its value."""
        for path, value in self.found.items():
            yield path, varied(self.line.sheet, path), value

    def as_json(self) -> dict[str, Any]:
        """The stable ``run`` shape."""
        return {
            "title": self.title,
            "streams": {name: stream_json(s) for name, s in self.streams.items()},
            "units": {name: report.as_json() for name, report in self.units.items()},
            "utilities": {
                "product": self.product,
                "carriers": {
                    name: {"value": value, "unit": "W" if name in CARRIERS else "kg/s"}
                    for name, value in self.carriers.items()
                },
                **{p.name: quantity_json(value, p) for p, value in self.totals()},
                "costs": {name: {"value": x, "unit": "USD/s"} for name, x in self.costs.items()},
            },
            "specifications": {name: plain(value) for name, value in self.found.items()},
            "audit": {
                **{side: plain(self.audit[side]) for side in ("mass_closure", "energy_closure")},
                "units": {
                    unit: {side: plain(x) for side, x in row.items()}
                    for unit, row in self.audit["units"].items()
                },
            },
            "converged": bool(self.solution.converged),
            "iterations": [int(n) for n in self.solution.steps],
            "flags": self.flags,
            **({"dynamic": course_json(self.course)} if self.course is not None else {}),
        }

    def _repr_html_(self) -> str:
        return notebooks.shown("granum.reports.terminal_run:print_run", self)

    def to_pandas(self) -> pd.DataFrame:
        """Every stream a row, SI: temperature, pressure, flow of every species (``solid.quartz``), median
        size.
        """
        return stream_frame(self.streams)

    def to_xarray(self) -> xr.Dataset:
        """Streams by species and size class, and the figures of the units (``unit.figure``), SI with their
        units as attributes.
        """
        figures = {
            f"{name}.{p.name}": (p, value)
            for name, unit in self.units.items()
            for p, value in (*unit.figures(), *unit.utilities())
        }
        return stream_dataset(self.streams).assign(
            {
                name: ((), value, attributes(p))
                for name, (p, value) in figures.items()
                if np.ndim(value) == 0 and value is not None
            }
        )

    def report(self, path: str | Path, advice: Mapping[str, str] | None = None) -> None:
        """Write the self-contained HTML report; ``advice`` is what is to be said of units whose checks fail,
        by unit (the command and the page give what ``granum.cases.choosing`` finds).
        """
        from granum.core.files import write_atomic
        from granum.reports.html import line_report

        write_atomic(path, line_report(self, advice))

    def tables(self, path: str | Path) -> None:
        """Write streams and results as ``.csv`` or ``.xlsx``."""
        from granum.reports.sheets import write_tables

        write_tables(self, Path(path))


def course_json(course: Course) -> dict[str, Any]:
    """A run in time as plain data, SI: flow of each phase and temperature of every stream."""

    def flow(array: Any) -> Any:
        return plain(np.asarray(array).reshape(len(course.times), -1).sum(axis=1))

    return {
        "time": {"value": plain(course.times), "unit": "s"},
        "streams": {
            name: {
                "solid": flow(s.solid),
                "liquid": flow(s.liquid),
                "gas": flow(s.gas),
                "temperature": plain(s.temperature),
            }
            for name, s in course.streams.items()
        },
        "units": {"flow": "kg/s", "temperature": "K"},
        "mass_balance": plain(course.balance),
        "flags": course.flags,
    }


def stream_json(s: Stream) -> dict[str, Any]:
    """A stream as plain data, SI."""
    m = s.mixture

    def named(phase: str, flows: Any) -> dict[str, float | None]:
        return {
            species.name: plain(x) for species, x in zip(getattr(m, phase), np.asarray(flows), strict=True)
        }

    return {
        "mass_flow": {"value": plain(s.mass_flow), "unit": "kg/s"},
        "temperature": {"value": plain(s.temperature), "unit": "K"},
        "pressure": {"value": plain(s.pressure), "unit": "Pa"},
        "liquid": named("liquids", s.liquid),
        "gas": named("gases", s.gas),
        "solid": named("solids", s.solid_by_species),
        "size": {
            "boundaries": list(m.size_edges),
            "mass_fractions": plain(s.size_fractions),
            "median": median_size(s),
        }
        if m.solids
        else None,
    }
