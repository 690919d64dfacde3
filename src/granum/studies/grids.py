"""Studies of chosen cases: sweeps along one input, maps over two, scenario tables."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.studies.declared import MOST_CASES, limits_of, prepare, si, whole
from granum.studies.engine import evaluate
from granum.studies.lines import subject_of
from granum.studies.outcome import Limits, Outcome, kind_in_words, meets, number
from granum.studies.subjects import Subject

if TYPE_CHECKING:
    import plotly.graph_objects as go


def values_of(subject: Subject, path: str, table: Any) -> np.ndarray:
    """The values of a swept input from ``{from, to, steps, spacing}`` or a list, in any unit, SI."""
    parameter = subject.input(path).parameter
    where = _("for '{name}'").format(name=path)
    if isinstance(table, (list, tuple, np.ndarray)):
        return np.array([si(parameter, v, where) for v in table])
    if not isinstance(table, Mapping):
        raise InputError(
            _("'{name}': give a list of values, or {{from, to, steps}}.").format(name=path), name=path
        )
    allowed = ("from", "to", "steps", "spacing")
    for key in table:
        if key not in allowed:
            raise unknown_name(_("Key"), key, allowed, where)
    for key in ("from", "to"):
        if key not in table:
            raise InputError(_("'{name}': '{key}' is missing.").format(name=path, key=key), name=path)
    low, high = (si(parameter, table[key], where) for key in ("from", "to"))
    steps = whole(table.get("steps", 21), "steps", 2, 100_000)
    spacing = table.get("spacing", "linear")
    if spacing not in ("linear", "log"):
        raise unknown_name(_("Spacing"), str(spacing), ("linear", "log"), where)
    if spacing == "log" and (low <= 0 or high <= 0):
        raise InputError(
            _("'{name}': logarithmic spacing needs limits above zero.").format(name=path), name=path
        )
    return np.geomspace(low, high, steps) if spacing == "log" else np.linspace(low, high, steps)


@dataclass(frozen=True)
class Sweep(Outcome):
    """Figures along one input."""

    kind: ClassVar[str] = "sweep"

    def findings(self) -> dict[str, Any]:
        paths = (*self.cases.inputs, *self.cases.outputs)
        return {"table": {p: [number(v) for v in self.column(p)] for p in paths}}

    def charts(self) -> dict[str, go.Figure]:
        from granum.studies import charts

        return charts.of_sweep(self)


def sweep(
    thing: Any,
    over: Mapping[str, Any],
    *,
    outputs: Sequence[str] | None = None,
    title: str = "",
    fixed: Mapping[str, Any] | None = None,
    **how: Any,
) -> Sweep:
    """Figures along one input: ``sweep(line, {"crystallizer.temperature": {"from": "20 degC", "to":
    "40 degC", "steps": 21}})``.
    """
    began = time.perf_counter()
    subject = subject_of(thing, fixed)
    if len(over) != 1:
        raise InputError(_("A sweep varies one input; for two use a map."))
    subject, paths = prepare(subject, outputs, tuple(over))
    (path, table), *_rest = over.items()
    x = values_of(subject, path, table)[:, None]
    return Sweep(
        title or kind_in_words("sweep"),
        evaluate(subject, (path,), paths, x, **how),
        elapsed=time.perf_counter() - began,
    )


@dataclass(frozen=True)
class Map(Outcome):
    """Figures over two inputs, row by row (first input slowest)."""

    shape: tuple[int, int]
    limits: Limits = field(default_factory=dict)
    kind: ClassVar[str] = "map"

    def grid(self, path: str) -> np.ndarray:
        """A figure as a matrix: first input down, second across."""
        return self.column(path).reshape(self.shape)

    @property
    def axes(self) -> tuple[np.ndarray, np.ndarray]:
        """Values of the two inputs."""
        first, second = (self.cases.x[:, i].reshape(self.shape) for i in (0, 1))
        return first[:, 0], second[0]

    def allowed(self) -> np.ndarray:
        """Where every limit is kept, as a matrix."""
        kept = self.cases.fine.copy()
        for path, limit in self.limits.items():
            kept &= meets(self.column(path), limit)
        return kept.reshape(self.shape)

    def findings(self) -> dict[str, Any]:
        first, second = self.axes
        return {
            "axes": {
                self.cases.inputs[0]: [number(v) for v in first],
                self.cases.inputs[1]: [number(v) for v in second],
            },
            "maps": {p: [[number(v) for v in row] for row in self.grid(p)] for p in self.cases.outputs},
            "limits": {p: {"lower": low, "upper": high} for p, (low, high) in self.limits.items()},
            "share_allowed": float(self.allowed().mean()),
        }

    def charts(self) -> dict[str, go.Figure]:
        from granum.studies import charts

        return charts.of_map(self)


def parameter_map(
    thing: Any,
    over: Mapping[str, Any],
    *,
    outputs: Sequence[str] | None = None,
    limits: Mapping[str, Any] | None = None,
    title: str = "",
    fixed: Mapping[str, Any] | None = None,
    **how: Any,
) -> Map:
    """Figures over two inputs, with the region where ``limits`` are kept."""
    began = time.perf_counter()
    subject = subject_of(thing, fixed)
    if len(over) != 2:
        raise InputError(_("A map varies two inputs; {count} were given.").format(count=len(over)))
    subject, kept = limits_of(subject, limits or {}, _("in 'limits' for"))
    subject, paths = prepare(subject, outputs, tuple(over))
    paths = tuple(dict.fromkeys((*paths, *kept)))
    first, second = (values_of(subject, path, table) for path, table in over.items())
    whole(len(first) * len(second), "steps", 4, MOST_CASES)
    x = np.stack([g.ravel() for g in np.meshgrid(first, second, indexing="ij")], axis=1)
    cases = evaluate(subject, tuple(over), paths, x, **how)
    return Map(
        title or kind_in_words("map"),
        cases,
        (len(first), len(second)),
        kept,
        elapsed=time.perf_counter() - began,
    )


@dataclass(frozen=True)
class Scenarios(Outcome):
    """Figures of named cases side by side."""

    names: tuple[str, ...]
    kind: ClassVar[str] = "scenarios"

    def findings(self) -> dict[str, Any]:
        rows = {}
        for i, name in enumerate(self.names):
            rows[name] = {
                "inputs": {p: number(v) for p, v in zip(self.cases.inputs, self.cases.x[i], strict=True)},
                "outputs": {p: number(v) for p, v in zip(self.cases.outputs, self.cases.y[i], strict=True)},
                "failed": self.cases.reason(i),
            }
        return {"scenarios": rows}

    def charts(self) -> dict[str, go.Figure]:
        return {}


def scenarios(
    thing: Any,
    cases: Mapping[str, Mapping[str, Any]],
    *,
    outputs: Sequence[str] | None = None,
    title: str = "",
    fixed: Mapping[str, Any] | None = None,
    **how: Any,
) -> Scenarios:
    """Figures of named cases: ``{"as built": {}, "cold": {"crystallizer.temperature": "20 degC"}}``; what is
    not named keeps its value.
    """
    began = time.perf_counter()
    subject = subject_of(thing, fixed)
    if not cases:
        raise InputError(_("A scenario table needs at least one case."))
    varied = tuple(dict.fromkeys(path for changes in cases.values() for path in changes))
    if not varied:
        raise InputError(_("The scenarios change nothing: name an input in at least one of them."))
    known = {path: subject.input(path) for path in varied}
    rows = []
    for name, changes in cases.items():
        where = _("in scenario '{name}'").format(name=name)
        row = {path: subject.nominal(path) for path in varied} | {
            p: si(known[p].parameter, v, where) for p, v in changes.items()
        }
        for path, value in row.items():
            if not np.isfinite(value):
                raise InputError(
                    _("{where}: '{name}' has no value.").format(where=where, name=path), name=path
                )
        rows.append([row[p] for p in varied])
    subject, paths = prepare(subject, outputs, varied)
    found = evaluate(subject, varied, paths, np.array(rows), **how)
    return Scenarios(
        title or kind_in_words("scenarios"), found, tuple(cases), elapsed=time.perf_counter() - began
    )
