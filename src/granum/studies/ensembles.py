"""Studies that compute many cases: Monte Carlo, Sobol indices, sweeps, maps of two inputs, scenario tables."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from scipy.stats import rankdata

from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.core.parameters import convert
from granum.estimation import Fit
from granum.studies.distributions import Marginal, Source, distribution, from_fits
from granum.studies.engine import evaluate
from granum.studies.outcome import Limits, Outcome, meets, number, statistics, wilson
from granum.studies.sampling import inputs_at, unit_points
from granum.studies.subjects import FormulaSubject, Subject, subject_of

if TYPE_CHECKING:
    import plotly.graph_objects as go

MOST_CASES = 5_000_000


def sources_of(subject: Subject, uncertain: Mapping[str, Any]) -> list[Source]:
    """Independent sources of uncertainty from ``{input: distribution}``.

    A distribution is a table (see ``granum.studies.distributions.distribution``), a ``Fit`` (its estimate of the same
    name) or ``(fit, "name of the estimate")``.
    """
    marginals: list[Source] = []
    fits: dict[str, tuple[Fit, str]] = {}
    for path, declared in uncertain.items():
        variable = subject.input(path)
        if isinstance(declared, Fit):
            declared = (declared, path.rpartition(".")[2])
        if isinstance(declared, tuple) and len(declared) == 2 and isinstance(declared[0], Fit):
            fits[path] = declared
        elif isinstance(declared, Marginal):
            marginals.append(declared)
        elif isinstance(declared, Mapping):
            marginals.append(distribution(path, declared, variable.parameter))
        else:
            raise InputError(
                _(
                    "'{name}': write its uncertainty as a table such as {{distribution = \"normal\", mean = …, standard_deviation = …}}."
                ).format(name=path),
                name=path,
            )
    if not marginals and not fits:
        raise InputError(_("No input is uncertain: declare at least one under [uncertain]."))
    return marginals + from_fits(fits)


def prepare(subject: Subject, outputs: Sequence[str] | None, varied: tuple[str, ...]) -> tuple[Subject, tuple[str, ...]]:
    """The subject with expressions among the figures resolved, and the figures to compute."""
    if isinstance(outputs, str):
        outputs = [outputs]
    paths: list[str] = []
    for text in outputs or subject.outputs():
        subject, path = subject.figure(str(text))
        paths.append(path)
    if not paths:
        raise InputError(_("The study has no figures to compute: name some under 'outputs'."))
    if isinstance(subject, FormulaSubject):
        subject.complete(varied)
    return subject, tuple(dict.fromkeys(paths))


def limits_of(subject: Subject, declared: Mapping[str, Any], where: str) -> tuple[Subject, dict[str, tuple[float | None, float | None]]]:
    """Limits of figures from ``{figure: {lower, upper}}`` in any unit, SI."""
    found: dict[str, tuple[float | None, float | None]] = {}
    for text, table in declared.items():
        subject, path = subject.figure(text)
        if not isinstance(table, Mapping) or not table:
            raise InputError(
                _("{where} '{name}': give 'lower', 'upper' or both, as in {{upper = \"3 %\"}}.").format(where=where, name=text)
            )
        for key in table:
            if key not in ("lower", "upper"):
                raise unknown_name(_("Key"), key, ("lower", "upper"), f"{where} '{text}'")
        low, high = (si(subject.output(path).parameter, table[k], f"{where} '{text}'") if k in table else None for k in ("lower", "upper"))
        if low is not None and high is not None and low > high:
            raise InputError(_("{where} '{name}': 'lower' must be below 'upper'.").format(where=where, name=text))
        found[path] = (low, high)
    return subject, found


def si(parameter: Any, value: Any, where: str) -> float:
    """A number in any unit as SI; a figure without a kind takes plain numbers."""
    if parameter.kind is None:
        from granum.studies.expressions import plain_quantity

        return plain_quantity(value, where)
    return float(convert(value, parameter, f" {where}"))


def whole(value: Any, name: str, least: int, most: int) -> int:
    """A count inside its limits."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or value != int(value) or not least <= value <= most:
        raise InputError(
            _("'{name}' = {value} must be a whole number from {least} to {most}.").format(name=name, value=value, least=least, most=most)
        )
    return int(value)


# -- Monte Carlo -----------------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class Ensemble(Outcome):
    """Figures under uncertainty: percentiles, probability of keeping limits, which input matters."""

    sources: tuple[Source, ...]
    limits: Limits = field(default_factory=dict)
    kind: ClassVar[str] = "monte_carlo"

    def chances(self) -> dict[str, dict[str, Any]]:
        """Probability of keeping each limit and all of them; a case that failed keeps none."""
        run = self.cases.codes != 4
        found = {}
        together = run.copy()
        for path, limit in self.limits.items():
            kept = meets(self.column(path), limit) & run
            together &= kept
            found[path] = {"lower": limit[0], "upper": limit[1], **_chance(kept, run)}
        if len(self.limits) > 1:
            found[""] = {"lower": None, "upper": None, **_chance(together, run)}
        return found

    def rank_correlations(self) -> dict[str, dict[str, float | None]]:
        """Spearman's rank correlation of each figure with each uncertain input."""
        good = self.cases.fine
        if good.sum() < 3:
            return {}
        ranks = np.apply_along_axis(rankdata, 0, self.cases.x[good])
        found = {}
        for j, path in enumerate(self.cases.outputs):
            y = rankdata(self.cases.y[good, j])
            with np.errstate(invalid="ignore", divide="ignore"):
                rho = [
                    float(np.corrcoef(ranks[:, i], y)[0, 1]) if np.ptp(y) and np.ptp(ranks[:, i]) else np.nan for i in range(ranks.shape[1])
                ]
            found[path] = {name: number(r) for name, r in zip(self.cases.inputs, rho, strict=True)}
        return found

    def findings(self) -> dict[str, Any]:
        return {
            "uncertain": [s.as_json() for s in self.sources],
            "statistics": {path: statistics(self.column(path)) for path in self.cases.outputs},
            "limits": self.chances(),
            "rank_correlation": self.rank_correlations(),
        }

    def charts(self) -> dict[str, go.Figure]:
        from granum.studies import charts

        return charts.of_ensemble(self)


def _chance(kept: np.ndarray, run: np.ndarray) -> dict[str, Any]:
    of = int(run.sum())
    met = int(kept.sum())
    return {"probability": met / of if of else None, "interval_95": list(wilson(met, of)) if of else [None, None]}


def monte_carlo(thing: Any, uncertain: Mapping[str, Any], *, samples: int = 1000, outputs: Sequence[str] | None = None,
                limits: Mapping[str, Any] | None = None, method: str = "latin_hypercube", seed: int = 0, title: str = "",
                fixed: Mapping[str, Any] | None = None, **how: Any) -> Ensemble:  # fmt: skip
    """Figures of a line or a formula when inputs are uncertain.

    Parameters
    ----------
    thing: a line (``granum.read``), a formula or its key, with ``fixed`` inputs.
    uncertain: distributions by input, see ``sources_of``.
    samples: cases. method: ``latin_hypercube``, ``random`` or ``sobol_sequence``.
    limits: ``{figure: {lower, upper}}``; the probability of keeping them is found.
    how: ``progress``, ``cancel``, ``folder``, ``workers`` of ``granum.studies.engine.evaluate``.

    >>> from granum.core.units import from_si
    >>> found = monte_carlo("particles.terminal_velocity", {"particle_diameter": {"distribution": "normal", "mean": "85 um",
    ...     "standard_deviation": "5 um"}}, fixed={"particle_density": 2630, "fluid_density": 1020, "dynamic_viscosity": "1.2 cP"})
    >>> found.counts()["failed"]
    0
    """
    began = time.perf_counter()
    subject = subject_of(thing, fixed)
    sources = sources_of(subject, uncertain)
    names = tuple(n for s in sources for n in s.names)
    subject, kept = limits_of(subject, limits or {}, _("in 'limits' for"))
    subject, paths = prepare(subject, outputs, names)
    paths = tuple(dict.fromkeys((*paths, *kept)))
    count = whole(samples, "samples", 1, MOST_CASES)
    x = inputs_at(sources, unit_points(method, count, sum(s.dimensions for s in sources), whole(seed, "seed", 0, 2**31)))
    cases = evaluate(subject, names, paths, x, **how)
    return Ensemble(title or _("Monte Carlo"), cases, tuple(sources), kept, elapsed=time.perf_counter() - began)


# -- Sobol indices ---------------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class Sensitivity(Outcome):
    """First-order and total Sobol indices with 95 % intervals; inputs from one fit count as one group."""

    sources: tuple[Source, ...]
    groups: tuple[str, ...]
    seed: int
    kind: ClassVar[str] = "sobol"

    @property
    def blocks(self) -> np.ndarray:
        """Which blocks of cases are whole: the estimator needs all of a block, so one failed case discards its block."""
        return np.all(self.cases.fine.reshape(-1, len(self.groups) + 2), axis=1)

    def indices(self) -> dict[str, dict[str, dict[str, float | None]]]:
        """``{figure: {input or group: {first, first_interval, total, total_interval}}}``; intervals are half widths at 95 %."""
        from SALib.analyze import sobol

        kept = np.repeat(self.blocks, len(self.groups) + 2)
        problem = {"num_vars": len(self.groups), "names": list(self.groups), "bounds": [[0.0, 1.0]] * len(self.groups)}
        found = {}
        for path in self.cases.outputs:
            y = self.column(path)[kept]
            if len(y) < 4 * (len(self.groups) + 2) or np.ptp(y) <= 1e-12 * np.max(np.abs(y)):
                found[path] = {g: dict.fromkeys(("first", "first_interval", "total", "total_interval")) for g in self.groups}
                continue
            s = sobol.analyze(problem, y, calc_second_order=False, conf_level=0.95, seed=self.seed, print_to_console=False)
            found[path] = {
                g: {"first": number(s["S1"][i]), "first_interval": number(s["S1_conf"][i]),
                    "total": number(s["ST"][i]), "total_interval": number(s["ST_conf"][i])}
                for i, g in enumerate(self.groups)
            }  # fmt: skip
        return found

    def findings(self) -> dict[str, Any]:
        return {
            "uncertain": [s.as_json() for s in self.sources],
            "statistics": {path: statistics(self.column(path)) for path in self.cases.outputs},
            "indices": self.indices() if self.complete else {},
            "blocks": len(self.blocks),
            "blocks_used": int(self.blocks.sum()),
        }

    def charts(self) -> dict[str, go.Figure]:
        from granum.studies import charts

        return charts.of_sensitivity(self)


def sobol(thing: Any, uncertain: Mapping[str, Any], *, samples: int = 512, outputs: Sequence[str] | None = None, seed: int = 0,
          title: str = "", fixed: Mapping[str, Any] | None = None, **how: Any) -> Sensitivity:  # fmt: skip
    """How much of the variance of each figure comes from each uncertain input (Saltelli's design, SALib).

    ``samples`` is the base number, made a power of two; (inputs + 2) times as many cases are computed. The parameters of one fit are one
    group, because indices are defined for independent inputs.
    """
    from SALib.sample import sobol as design

    began = time.perf_counter()
    subject = subject_of(thing, fixed)
    sources = sources_of(subject, uncertain)
    names = tuple(n for s in sources for n in s.names)
    subject, paths = prepare(subject, outputs, names)
    groups = tuple(s.names[0] if len(s.names) == 1 else " + ".join(s.names) for s in sources)
    labels = [g for g, s in zip(groups, sources, strict=True) for _dimension in range(s.dimensions)]
    base = 1 << (whole(samples, "samples", 4, MOST_CASES) - 1).bit_length()
    problem = {
        "num_vars": len(labels),
        "names": [f"{n}#{i}" for i, n in enumerate(labels)],
        "groups": labels,
        "bounds": [[0.0, 1.0]] * len(labels),
    }
    points = design.sample(problem, base, calc_second_order=False, scramble=True, seed=whole(seed, "seed", 0, 2**31))
    cases = evaluate(subject, names, paths, inputs_at(sources, points), **how)
    return Sensitivity(title or _("Sobol indices"), cases, tuple(sources), groups, seed, elapsed=time.perf_counter() - began)


# -- sweeps, maps, scenarios -----------------------------------------------------------------------------------------------
def values_of(subject: Subject, path: str, table: Any) -> np.ndarray:
    """The values of a swept input from ``{from, to, steps, spacing}`` or a list, in any unit, SI."""
    parameter = subject.input(path).parameter
    where = _("for '{name}'").format(name=path)
    if isinstance(table, (list, tuple, np.ndarray)):
        return np.array([si(parameter, v, where) for v in table])
    if not isinstance(table, Mapping):
        raise InputError(_("'{name}': give a list of values, or {{from, to, steps}}.").format(name=path), name=path)
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
        raise InputError(_("'{name}': logarithmic spacing needs limits above zero.").format(name=path), name=path)
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


def sweep(thing: Any, over: Mapping[str, Any], *, outputs: Sequence[str] | None = None, title: str = "",
          fixed: Mapping[str, Any] | None = None, **how: Any) -> Sweep:  # fmt: skip
    """Figures along one input: ``sweep(line, {"crystallizer.temperature": {"from": "20 degC", "to": "40 degC", "steps": 21}})``."""
    began = time.perf_counter()
    subject = subject_of(thing, fixed)
    if len(over) != 1:
        raise InputError(_("A sweep varies one input; for two use a map."))
    subject, paths = prepare(subject, outputs, tuple(over))
    (path, table), *_rest = over.items()
    x = values_of(subject, path, table)[:, None]
    return Sweep(title or _("Sweep"), evaluate(subject, (path,), paths, x, **how), elapsed=time.perf_counter() - began)


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
            "axes": {self.cases.inputs[0]: [number(v) for v in first], self.cases.inputs[1]: [number(v) for v in second]},
            "maps": {p: [[number(v) for v in row] for row in self.grid(p)] for p in self.cases.outputs},
            "limits": {p: {"lower": low, "upper": high} for p, (low, high) in self.limits.items()},
            "share_allowed": float(self.allowed().mean()),
        }

    def charts(self) -> dict[str, go.Figure]:
        from granum.studies import charts

        return charts.of_map(self)


def parameter_map(thing: Any, over: Mapping[str, Any], *, outputs: Sequence[str] | None = None, limits: Mapping[str, Any] | None = None,
                  title: str = "", fixed: Mapping[str, Any] | None = None, **how: Any) -> Map:  # fmt: skip
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
    return Map(title or _("Map"), cases, (len(first), len(second)), kept, elapsed=time.perf_counter() - began)


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


def scenarios(thing: Any, cases: Mapping[str, Mapping[str, Any]], *, outputs: Sequence[str] | None = None, title: str = "",
              fixed: Mapping[str, Any] | None = None, **how: Any) -> Scenarios:  # fmt: skip
    """Figures of named cases: ``{"as built": {}, "cold": {"crystallizer.temperature": "20 degC"}}``; what is not named keeps its value."""
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
        row = {path: subject.nominal(path) for path in varied} | {p: si(known[p].parameter, v, where) for p, v in changes.items()}
        for path, value in row.items():
            if not np.isfinite(value):
                raise InputError(_("{where}: '{name}' has no value.").format(where=where, name=path), name=path)
        rows.append([row[p] for p in varied])
    subject, paths = prepare(subject, outputs, varied)
    found = evaluate(subject, varied, paths, np.array(rows), **how)
    return Scenarios(title or _("Scenarios"), found, tuple(cases), elapsed=time.perf_counter() - began)
