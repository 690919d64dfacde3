"""``Line``: a process line as read from a case file. ``Run``: the same, solved and audited."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from granum.cases.schema import Case
from granum.core import flags, record_steps
from granum.core.errors import ConvergenceError, InputError
from granum.core.formulas import Result
from granum.core.i18n import _
from granum.core.parameters import Parameter
from granum.core.results import plain, quantity_json
from granum.estimation.results import Fit
from granum.flowsheet import Flowsheet, Solution, closures, solve
from granum.flowsheet.dynamics import Course, Profile, march
from granum.flowsheet.packing import compiled
from granum.flowsheet.schedule import Schedule, schedule
from granum.flowsheet.specifications import Designed, Target, design, figure
from granum.numerics import Anderson, Newton
from granum.streams.stream import Stream, median_size
from granum.streams.units import Check


@compiled
def _solved(sheet: Flowsheet, targets: tuple[Target, ...]) -> Designed:
    """The line with its specifications, figures and checks: one compilation."""
    return design(sheet, targets, sheets=True)


def _traced(tree: Any) -> Any:
    """Numbers as arrays, so that a compiled line is reused when only values change."""
    return jax.tree.map(lambda x: np.asarray(x) if isinstance(x, float) else x, tree)


@compiled
def _solved_patiently(sheet: Flowsheet, targets: tuple[Target, ...], start: dict[str, Stream]) -> Designed:
    return design(sheet, targets, sheets=True, method=Anderson(window=10, damping=0.4), max_steps=2000)


@compiled
def _solved_by_newton(sheet: Flowsheet, targets: tuple[Target, ...], start: dict[str, Stream]) -> Designed:
    return design(sheet, targets, sheets=True, start=start, method=Newton(), max_steps=50)


@compiled
def _marched(sheet: Flowsheet, times: Any, profiles: tuple[Profile, ...], start: str | dict[str, str]) -> Course:
    return march(sheet, times, profiles, start=start)


@compiled
def _figure(sheet: Flowsheet, path: str) -> tuple[Any, Any]:
    solution = solve(sheet)
    return figure(sheet, solution, path), solution.converged


@dataclass(frozen=True)
class Line:
    """A process line: flowsheet, design specifications and the case they came from."""

    title: str
    sheet: Flowsheet
    targets: tuple[Target, ...] = ()
    case: Case | None = None
    text: str = ""
    fits: Mapping[str, tuple[Fit, str]] = field(default_factory=dict)

    def solve(self) -> Run:
        """Solve, check and audit. Raises ``ConvergenceError`` (with the last iterate) rather than return an unconverged line."""
        found = _solved(_traced(self.sheet), self.targets)
        run = Run(self, found.line, found.solution, {k: float(v) for k, v in found.values.items()})
        bad = [name for name, s in found.solution.streams.items() if not np.isfinite(float(s.mass_flow + s.temperature))]
        if bool(found.converged) and not bad:
            return run
        for again in (_solved_patiently, _solved_by_newton) if self._loops_fail(found, bad) else ():
            torn = {n: found.solution.streams[n] for block in self.sheet.blocks for n in block.tears}
            found = again(_traced(self.sheet), self.targets, torn)
            run = Run(self, found.line, found.solution, {k: float(v) for k, v in found.values.items()})
            if bool(found.converged):
                return run
        raise ConvergenceError(_failure(found, bad, self.targets, self._reach), last=run, **_place(found, bad))

    def _loops_fail(self, found: Designed, bad: list[str]) -> bool:
        """Whether it is a loop that does not come to rest, rather than a specification that is out of reach."""
        if not bad:
            return not bool(found.solution.converged)
        return any(not np.isfinite(sum(self._reach(t))) for t in self.targets)

    def _reach(self, target: Target) -> tuple[float, float]:
        """What the result of a specification is at both ends of the varied parameter, the other specifications left out."""
        ends = (_figure(_traced(self.sheet.with_values({target.vary: x})), target.so_that) for x in (target.lower, target.upper))
        low, high = (float(value) if bool(good) else float("nan") for value, good in ends)
        return low, high

    def march(self) -> Course:
        """The line in time, as its ``[dynamic]`` table says. Raises where a loop does not converge at some instant."""
        from granum.cases.reading import movement

        if self.case is None:
            raise InputError(_("Only a line read from a case file knows how it runs in time; call granum.flowsheet.march."))
        times, profiles, start = movement(self.case, self.sheet)
        course = _marched(_traced(self.sheet), times, profiles, start)
        bad = np.flatnonzero(~np.asarray(course.converged))
        if bad.size:
            raise ConvergenceError(
                _("A loop did not converge at {time} s ({count} of {all} times): take a smaller step.").format(
                    time=f"{times[bad[0]]:.6g}", count=bad.size, all=len(times)
                ),
                last=course,
            )
        return course

    def with_values(self, **values: Any) -> Line:
        """The same line with other parameters: ``line.with_values(**{"crystallizer.temperature": 283.15})``, SI."""
        return Line(self.title, self.sheet.with_values(values), self.targets, self.case, self.text, self.fits)


def _place(found: Any, bad: list[str]) -> dict[str, Any]:
    links = {k.name: k for k in found.line.links}
    if bad:
        first = bad[0]
        return {"stream": first, "unit": links[first].source_unit or None}
    loops = [b for b in found.line.blocks if b.tears]
    worst = max(range(len(loops)), key=lambda i: float(found.solution.residual[i]), default=None)
    if worst is None:
        return {}
    tear = loops[worst].tears[0]
    return {"stream": tear, "unit": links[tear].source_unit, "residual": float(found.solution.residual[worst])}


def _failure(found: Any, bad: list[str], targets: tuple[Target, ...], reach: Callable[[Target], tuple[float, float]]) -> str:
    place = _place(found, bad)
    unmet = any(not np.isfinite(float(v)) for v in found.values.values())
    if bad and not unmet:
        return _(
            "Stream '{stream}' from unit '{unit}' is not a finite number: check the inputs of that unit and of those before it."
        ).format(**place)
    if not bool(found.solution.converged) and not unmet:
        return _(
            "The loop through stream '{stream}' (from unit '{unit}') did not converge: scaled residual {residual}. Does the recycle have a way out, such as a purge?"
        ).format(stream=place["stream"], unit=place["unit"], residual=f"{place['residual']:.2g}")
    for t in targets:
        low, high = reach(t)
        if np.isfinite(low) and np.isclose(low, high, rtol=1e-9):
            return _(
                "{result} does not depend on {vary}: it is {value} at both ends of the range (SI units). Vary another parameter."
            ).format(result=t.so_that, vary=t.vary, value=f"{low:.6g}")
        if np.isfinite(low + high) and not min(low, high) <= t.equals <= max(low, high):
            return _(
                "{result} = {wanted} is out of reach: it is {low} at {vary} = {lower} and {high} at {upper} (SI units). Widen the limits, ask for a value between, or vary another parameter."
            ).format(
                result=t.so_that,
                wanted=f"{t.equals:.6g}",
                low=f"{low:.6g}",
                high=f"{high:.6g}",
                vary=t.vary,
                lower=f"{t.lower:.6g}",
                upper=f"{t.upper:.6g}",
            )
    wanted = "; ".join(f"{t.so_that} = {t.equals:.6g} ({t.vary} {t.lower:.6g} … {t.upper:.6g})" for t in targets)
    return _("No value of the varied parameters meets the specifications: {wanted}. Widen the limits or change the wanted value.").format(
        wanted=wanted
    )


@dataclass(frozen=True)
class UnitReport:
    """One unit of a solved line: model, figures, checks."""

    name: str
    model: Any
    values: Any
    checks: tuple[Check, ...]

    def figures(self) -> Iterator[tuple[Parameter, Any]]:
        """Each figure with its declaration."""
        yield from zip(self.model.card.outputs, self.values, strict=True)

    def parameters(self) -> Iterator[tuple[Parameter, Any]]:
        """Each parameter of the unit with its value."""
        for p in self.model.card.parameters:
            yield p, getattr(self.model, p.name)

    def as_json(self) -> dict[str, Any]:
        """The stable ``run`` shape of one unit."""
        return {
            "model": self.model.card.key,
            "results": {p.name: quantity_json(value, p) for p, value in self.figures()},
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
    def units(self) -> dict[str, UnitReport]:
        """Every unit's figures and checks."""
        return {name: UnitReport(name, self.sheet.units[name], *self.solution.sheets[name]) for name in self.sheet.order}

    @cached_property
    def notes(self) -> dict[str, tuple[Result, ...]]:
        """The formulas each unit evaluates, with their numbers: the calculation note."""
        notes: dict[str, tuple[Result, ...]] = {}
        for name in self.sheet.order:
            unit, inlets = self.sheet.units[name], jax.tree.map(jnp.asarray, self.sheet.inlets_of(name, self.streams))
            with record_steps() as steps:
                unit.results(inlets, unit(**inlets))
            notes[name] = tuple(steps)
        return notes

    @cached_property
    def audit(self) -> dict[str, Any]:
        """Closure of the whole line and the worst unit: largest of both, relative."""
        found, whole = closures(self.sheet, self.solution)
        units = {name: (float(c.mass), float(c.energy)) for name, c in found.items()}
        return {
            "mass_closure": max(float(whole.mass), *(m for m, _e in units.values())),
            "energy_closure": max(float(whole.energy), *(e for _m, e in units.values())),
            "units": {name: {"mass": m, "energy": e} for name, (m, e) in units.items()},
        }

    @cached_property
    def flags(self) -> list[dict[str, Any]]:
        """What the formulas of each unit flagged, with the unit's name."""
        return [{"unit": unit, **row} for unit, records in self.solution.records.items() for row in flags.describe(records)]

    def schedule(self) -> Schedule:
        """The cycles of the batch units, with a Gantt chart."""
        return schedule({name: (u.model, u.values) for name, u in self.units.items()})

    def figure(self, path: str) -> float:
        """One result, ``unit.result``, SI."""
        unit, _dot, name = path.partition(".")
        if unit not in self.units or not hasattr(self.units[unit].values, name):
            raise InputError(_("'{path}' is not a result of this line.").format(path=path), path=path)
        return float(getattr(self.units[unit].values, name))

    def as_json(self) -> dict[str, Any]:
        """The stable ``run`` shape."""
        return {
            "title": self.title,
            "streams": {name: stream_json(s) for name, s in self.streams.items()},
            "units": {name: report.as_json() for name, report in self.units.items()},
            "specifications": self.found,
            "audit": self.audit,
            "converged": bool(self.solution.converged),
            "iterations": [int(n) for n in self.solution.steps],
            "flags": self.flags,
            **({"dynamic": course_json(self.line.march())} if self.line.case is not None and self.line.case.dynamic else {}),
        }

    def report(self, path: str | Path) -> None:
        """Write the self-contained HTML report."""
        from granum.core.files import write_atomic
        from granum.reports.html import line_report

        write_atomic(path, line_report(self))

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
            name: {"solid": flow(s.solid), "liquid": flow(s.liquid), "gas": flow(s.gas), "temperature": plain(s.temperature)}
            for name, s in course.streams.items()
        },
        "units": {"flow": "kg/s", "temperature": "K"},
        "mass_balance": plain(course.balance),
    }


def stream_json(s: Stream) -> dict[str, Any]:
    """A stream as plain data, SI."""
    m = s.mixture

    def named(phase: str, flows: Any) -> dict[str, float | None]:
        return {species.name: plain(x) for species, x in zip(getattr(m, phase), np.asarray(flows), strict=True)}

    return {
        "mass_flow": {"value": plain(s.mass_flow), "unit": "kg/s"},
        "temperature": {"value": plain(s.temperature), "unit": "K"},
        "pressure": {"value": plain(s.pressure), "unit": "Pa"},
        "liquid": named("liquids", s.liquid),
        "gas": named("gases", s.gas),
        "solid": named("solids", s.solid_by_species),
        "size": {"boundaries": list(m.size_edges), "mass_fractions": plain(s.size_fractions), "median": median_size(s)}
        if m.solids
        else None,
    }
