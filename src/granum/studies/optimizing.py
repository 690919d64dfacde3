"""Optimization with exact derivatives: constraints, several starts, uncertainty, and fronts between two objectives."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from scipy import optimize as scipy_optimize
from scipy.stats import qmc

from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.studies.distributions import Source
from granum.studies.engine import Cancel, Cases, Progress, Report, evaluate
from granum.studies.ensembles import limits_of, prepare, si, sources_of, whole
from granum.studies.outcome import Limits, Outcome, meets, number, statistics, wilson
from granum.studies.sampling import inputs_at, unit_points
from granum.studies.subjects import EXTRAPOLATED, FINE, FormulaSubject, Subject, subject_of

if TYPE_CHECKING:
    import plotly.graph_objects as go

METHODS = ("slsqp", "trust_constr")
FEASIBLE = 1e-6
"""Largest violation of a scaled constraint, and largest distance from a limit that counts as active."""
WIDE = 100.0
"""A range of positive values that spans more than this is searched on a logarithmic scale."""


class Span(NamedTuple):
    """Range of a decision, SI, and whether it is searched on a logarithmic scale."""

    lower: float
    upper: float
    logarithmic: bool

    def at(self, z: Any) -> Any:
        """Value for a place from 0 to 1."""
        if self.logarithmic:
            return self.lower * (self.upper / self.lower) ** z
        return self.lower + (self.upper - self.lower) * z

    def place(self, value: float) -> float:
        """Place from 0 to 1 of a value."""
        if self.logarithmic:
            return float(np.log(value / self.lower) / np.log(self.upper / self.lower))
        return (value - self.lower) / (self.upper - self.lower)


class Point(NamedTuple):
    """Figures at one place, their derivatives with respect to the places, the code of the outcome, whether a correlation left its range."""

    figures: np.ndarray
    slopes: np.ndarray
    code: int
    extrapolated: bool = False


class Stopped(Exception):
    """The study was cancelled."""


_functions: OrderedDict[tuple[Any, ...], Any] = OrderedDict()


def _compiled(subject: Subject, inputs: tuple[str, ...], outputs: tuple[str, ...], logs: tuple[bool, ...], sampled: bool) -> Any:
    """Figures, exact derivatives and code at a place, compiled; the last few are kept, so that other limits or ranges start at once."""
    key = (id(subject), inputs, outputs, logs, sampled)
    if key not in _functions:
        run = subject.traced(inputs, outputs)

        def one(z: Any, numbers: Any, low: Any, high: Any, extra: Any) -> Any:
            def figures(z: Any) -> Any:
                values = [Span(low[i], high[i], log).at(z[i]) for i, log in enumerate(logs)]
                found, code = run(numbers, jnp.concatenate([jnp.stack(values), extra]))
                return found, (found, code)

            slopes, (found, code) = jax.jacfwd(figures, has_aux=True)(z)
            return found, slopes, code

        def many(z: Any, numbers: Any, low: Any, high: Any, samples: Any) -> Any:
            if subject.batched or jax.default_backend() != "cpu":
                return jax.vmap(lambda extra: one(z, numbers, low, high, extra))(samples)
            return jax.lax.map(lambda extra: one(z, numbers, low, high, extra), samples)

        _functions[key] = (jax.jit(many if sampled else one), subject)  # the subject is kept, so that its identity stays its own
        while len(_functions) > 8:
            _functions.popitem(last=False)
    _functions.move_to_end(key)
    return _functions[key][0]


@dataclass
class Search:
    """A subject with its decisions: figures and exact derivatives at any place, computed together and remembered."""

    subject: Subject
    spans: dict[str, Span]
    outputs: tuple[str, ...]
    uncertain: tuple[str, ...] = ()
    samples: np.ndarray | None = None
    probability: float = 0.95
    objectives: int = 1
    sources: Sequence[Source] = ()
    signs: np.ndarray = field(default_factory=lambda: np.ones(0))
    """+1 where a figure is best small or kept below a limit, −1 where it is best large, 0 where neither tells."""
    watch: Callable[[], None] = lambda: None
    evaluations: int = 0

    def __post_init__(self) -> None:
        logs = tuple(span.logarithmic for span in self.spans.values())
        self._compiled = _compiled(self.subject, (*self.spans, *self.uncertain), self.outputs, logs, self.samples is not None)
        self._arguments = (
            self.subject.numbers(), jnp.array([s.lower for s in self.spans.values()]), jnp.array([s.upper for s in self.spans.values()]),
            jnp.zeros(0) if self.samples is None else jnp.asarray(self.samples),
        )  # fmt: skip
        self._known: dict[bytes, Point] = {}

    def values(self, z: np.ndarray) -> dict[str, float]:
        """The decisions at a place, SI."""
        return {path: float(span.at(z[i])) for i, (path, span) in enumerate(self.spans.items())}

    def at(self, z: np.ndarray) -> Point:
        """Figures and derivatives; under uncertainty the mean of objectives and the wanted quantile of the others."""
        z = np.clip(np.asarray(z, dtype=float), 0.0, 1.0)
        key = z.tobytes()
        if key not in self._known:
            self.watch()
            found, slopes, codes = (np.asarray(part) for part in self._compiled(jnp.asarray(z), *self._arguments))
            self.evaluations += 1
            self._known[key] = (
                Point(found, slopes, max(int(codes), FINE), int(codes) < FINE)
                if self.samples is None
                else self._condensed(found, slopes, codes)
            )
        return self._known[key]

    def _condensed(self, found: np.ndarray, slopes: np.ndarray, codes: np.ndarray) -> Point:
        good = codes <= FINE
        if good.mean() < 0.5:
            return Point(np.full(found.shape[1], np.nan), np.zeros(slopes.shape[1:]), int(codes[~good][0]))
        found, slopes = found[good], slopes[good]
        figures, derivatives = found.mean(axis=0), slopes.mean(axis=0)
        for j in range(self.objectives, found.shape[1]):
            if self.signs[j]:
                # the quantile counts failed samples as not meeting the limit
                share = min(1.0, self.probability * len(good) / good.sum())
                order = np.argsort(self.signs[j] * found[:, j])
                place = share * (len(order) - 1)
                low, part = int(place), place - int(place)
                high = min(low + 1, len(order) - 1)
                figures[j] = (1 - part) * found[order[low], j] + part * found[order[high], j]
                derivatives[j] = (1 - part) * slopes[order[low], j] + part * slopes[order[high], j]
        return Point(figures, derivatives, FINE, bool(np.any(codes < FINE)))


class Constraint(NamedTuple):
    """``sign · (figure − limit) ≥ 0``, scaled."""

    path: str
    index: int
    limit: float
    sign: float
    scale: float

    def value(self, point: Point) -> float:
        """Scaled slack; negative when violated."""
        return self.sign * (float(point.figures[self.index]) - self.limit) / self.scale

    def slope(self, point: Point) -> np.ndarray:
        """Its derivative with respect to the places."""
        return self.sign * point.slopes[self.index] / self.scale


class Found(NamedTuple):
    """Where one start ended."""

    z: np.ndarray
    point: Point
    objective: float
    violation: float
    converged: bool
    message: str
    steps: int


def descend(search: Search, weight: Callable[[Point], tuple[float, np.ndarray]], constraints: Sequence[Constraint], start: np.ndarray,
             method: str, tolerance: float = 1e-9, steps: int = 200) -> Found:  # fmt: skip
    """One run of SLSQP or trust-constr; places where the model fails are made unattractive rather than fatal."""
    first = search.at(start)
    if first.code != FINE:
        return Found(start, first, np.inf, np.inf, False, search.subject.reason(first.code, tuple(search.spans), search.outputs), 0)
    value0, slope0 = weight(first)
    scale = max(abs(value0), float(np.max(np.abs(slope0), initial=0.0)), 1e-300)
    last = [first]

    def point(z: np.ndarray) -> tuple[Point, float]:
        found = search.at(z)
        if found.code == FINE and np.all(np.isfinite(found.figures)) and np.all(np.isfinite(found.slopes)):
            last[0] = found
            return found, 0.0
        return last[0], 1.0  # a penalty: the line search turns back

    def objective(z: np.ndarray) -> tuple[float, np.ndarray]:
        found, penalty = point(z)
        value, slope = weight(found)
        return value / scale + penalty * (1.0 + abs(value) / scale), slope / scale

    def slack(z: np.ndarray) -> np.ndarray:
        found, penalty = point(z)
        return np.array([c.value(found) - penalty for c in constraints])

    def slack_slope(z: np.ndarray) -> np.ndarray:
        found, _penalty = point(z)
        return np.stack([c.slope(found) for c in constraints])

    bounds = [(0.0, 1.0)] * len(start)
    if method == "slsqp":
        limits: Any = [{"type": "ineq", "fun": slack, "jac": slack_slope}] if constraints else []
        ended = scipy_optimize.minimize(objective, start, jac=True, bounds=bounds, constraints=limits, method="SLSQP",
                                        options={"maxiter": steps, "ftol": tolerance})  # fmt: skip
    else:
        limits = (
            [scipy_optimize.NonlinearConstraint(slack, 0.0, np.inf, jac=slack_slope, hess=scipy_optimize.BFGS())]  # type: ignore[arg-type]
            if constraints
            else []
        )
        ended = scipy_optimize.minimize(objective, start, jac=True, hess=scipy_optimize.BFGS(), bounds=bounds, constraints=limits,
                                        method="trust-constr", options={"maxiter": 5 * steps, "gtol": tolerance, "xtol": 1e-12})  # fmt: skip
    z = np.clip(ended.x, 0.0, 1.0)
    final = search.at(z)
    if final.code != FINE:
        return Found(
            z, final, np.inf, np.inf, False, search.subject.reason(final.code, tuple(search.spans), search.outputs), int(ended.nit)
        )
    violation = max((-c.value(final) for c in constraints), default=0.0)
    fine = bool(ended.success) or (method == "trust_constr" and ended.status in (1, 2)) or _stationary(final, weight, constraints, z) < 1e-4
    return Found(z, final, weight(final)[0], max(violation, 0.0), fine, str(ended.message), int(ended.nit))


def _stationary(
    point: Point, weight: Callable[[Point], tuple[float, np.ndarray]], constraints: Sequence[Constraint], z: np.ndarray
) -> float:
    """How far the derivatives are from those of an optimum, relative to that of the objective."""
    return _multipliers(point, weight, constraints, z)[1]


def _multipliers(point: Point, weight: Callable[[Point], tuple[float, np.ndarray]], constraints: Sequence[Constraint],
                 z: np.ndarray) -> tuple[np.ndarray, float]:  # fmt: skip
    """Multipliers of the constraints (zero where not active) and the part of the objective's slope that they do not explain."""
    _value, slope = weight(point)
    active = [i for i, c in enumerate(constraints) if c.value(point) <= 10 * FEASIBLE]
    columns = [constraints[i].slope(point) for i in active]
    for i, place in enumerate(z):
        unit = np.eye(len(z))[i]
        if place <= FEASIBLE:
            columns.append(unit)
        if place >= 1.0 - FEASIBLE:
            columns.append(-unit)
    found = np.zeros(len(constraints))
    if not columns:
        return found, float(np.linalg.norm(slope))
    size = np.linalg.norm(slope) or 1.0
    parts, rest = scipy_optimize.nnls(np.stack(columns, axis=1), slope / size)
    found[active] = parts[: len(active)] * size
    return found, float(rest)


def _decisions(subject: Subject, over: Mapping[str, Any]) -> tuple[dict[str, Span], dict[str, float]]:
    if not over:
        raise InputError(_("The optimization has nothing to vary: name inputs with their limits under 'over'."))
    spans, starts = {}, {}
    for path, declared in over.items():
        parameter = subject.input(path).parameter
        where = _("in 'over' for '{name}'").format(name=path)
        table: Any = dict(zip(("lower", "upper"), declared, strict=False)) if isinstance(declared, (list, tuple)) else declared
        if not isinstance(table, Mapping) or "lower" not in table or "upper" not in table:
            raise InputError(_("{where}: give its limits as {{lower = …, upper = …}}.").format(where=where), name=path)
        for key in table:
            if key not in ("lower", "upper", "start"):
                raise unknown_name(_("Key"), key, ("lower", "upper", "start"), where)
        low, high = (si(parameter, table[key], where) for key in ("lower", "upper"))
        if not low < high:
            raise InputError(_("{where}: 'lower' must be below 'upper'.").format(where=where), name=path)
        spans[path] = Span(low, high, low > 0 and high / low > WIDE)
        start = si(parameter, table["start"], where) if "start" in table else subject.nominal(path)
        starts[path] = min(max(start, low), high) if np.isfinite(start) else spans[path].at(0.5)
    return spans, starts


@dataclass(frozen=True)
class Optimum(Outcome):
    """The best point, what limits it, and where each start ended. ``cases`` holds the starts' end points, the best first."""

    objective: str
    maximize: bool
    limits: Limits
    spans: Mapping[str, Span]
    ends: tuple[dict[str, Any], ...]
    base: dict[str, float]
    prices: Mapping[str, float]
    stationarity: float
    evaluations: int
    chance: Mapping[str, Any] | None = None
    finished: bool = True
    kind: ClassVar[str] = "optimize"

    @property
    def complete(self) -> bool:
        return self.finished

    @property
    def feasible(self) -> bool:
        """Whether the best point keeps every limit."""
        return bool(self.ends) and self.ends[0]["feasible"]

    @property
    def values(self) -> dict[str, float]:
        """The best inputs, SI."""
        return dict(zip(self.cases.inputs, map(float, self.cases.x[0]), strict=True))

    @property
    def figures(self) -> dict[str, float]:
        """Figures at the best inputs, SI."""
        return dict(zip(self.cases.outputs, map(float, self.cases.y[0]), strict=True))

    def active(self) -> list[dict[str, Any]]:
        """What holds the optimum back: limits of figures, with what a unit more of each would give, and limits of inputs."""
        rows: list[dict[str, Any]] = []
        for path, (low, high) in self.limits.items():
            for side, limit in (("lower", low), ("upper", high)):
                if limit is None or f"{path} {side}" not in self.prices:
                    continue
                rows.append({"name": path, "side": side, "limit": limit, "price": number(self.prices[f"{path} {side}"])})
        for path, value in self.values.items():
            span = self.spans[path]
            for side, limit, place in (("lower", span.lower, 0.0), ("upper", span.upper, 1.0)):
                if abs(span.place(value) - place) <= 10 * FEASIBLE:
                    rows.append({"name": path, "side": side, "limit": limit, "price": None})
        return rows

    def findings(self) -> dict[str, Any]:
        return {
            "objective": {"name": self.objective, "sense": "maximize" if self.maximize else "minimize",
                          "value": number(self.figures[self.objective]), "before": number(self.base.get(self.objective, np.nan))},
            "feasible": self.feasible,
            "inputs": {p: {"value": number(v), "lower": self.spans[p].lower, "upper": self.spans[p].upper} for p, v in self.values.items()},
            "outputs": {p: {"value": number(v), "before": number(self.base.get(p, np.nan))} for p, v in self.figures.items()},
            "active": self.active(),
            "limits": {p: {"lower": low, "upper": high} for p, (low, high) in self.limits.items()},
            "stationarity": number(self.stationarity),
            "evaluations": self.evaluations,
            "starts": list(self.ends),
            "chance": self.chance,
        }  # fmt: skip

    def charts(self) -> dict[str, go.Figure]:
        from granum.studies import charts

        return charts.of_optimum(self)


def _objective(minimize_: str | None, maximize_: str | None) -> tuple[str, float]:
    if bool(minimize_) == bool(maximize_):
        raise InputError(_("Give either 'minimize' or 'maximize'."))
    return (str(minimize_), 1.0) if minimize_ else (str(maximize_), -1.0)


def _constraints(limits: Limits, outputs: tuple[str, ...]) -> list[Constraint]:
    made = []
    for path, (low, high) in limits.items():
        scale = max(abs(low or 0.0), abs(high or 0.0)) or 1.0
        for limit, sign in ((low, 1.0), (high, -1.0)):
            if limit is not None:
                made.append(Constraint(path, outputs.index(path), limit, sign, scale))
    return made


def _starts(spans: Mapping[str, Span], first: Mapping[str, float], count: int, seed: int) -> list[np.ndarray]:
    places = [np.array([spans[p].place(v) for p, v in first.items()])]
    if count > 1:
        places += list(qmc.LatinHypercube(len(spans), rng=np.random.default_rng(seed)).random(count - 1))
    return places


def optimize(thing: Any, over: Mapping[str, Any], *, minimize: str | None = None, maximize: str | None = None,
             limits: Mapping[str, Any] | None = None, outputs: Sequence[str] | None = None, starts: int = 3, method: str = "slsqp",
             uncertain: Mapping[str, Any] | None = None, samples: int = 0, probability: float = 0.95, seed: int = 0, title: str = "",
             fixed: Mapping[str, Any] | None = None, progress: Report | None = None, cancel: Cancel | None = None,
             **how: Any) -> Optimum:  # fmt: skip
    """The best inputs inside their limits, with exact derivatives.

    Parameters
    ----------
    over: ``{input: (lower, upper)}`` or ``{input: {lower, upper, start}}``, any unit.
    minimize, maximize: one figure, quantity or expression.
    limits: ``{figure: {lower, upper}}``.
    starts: runs from different places (the first from the values of the case); the best feasible end counts.
    method: ``slsqp`` or ``trust_constr``.
    uncertain, samples, probability: with samples > 0 the mean of the objective is optimized and each limit kept with
        the probability wanted (robust design); the chance is then checked on four times as many fresh samples.

    >>> found = optimize("particles.richardson_zaki", {"solids_volume_fraction": (0.01, 0.5)}, starts=1,
    ...     maximize="solids_volume_fraction * hindrance", fixed={"exponent": 4.65, "reynolds": 0.01})
    >>> round(found.values["solids_volume_fraction"], 3)  # the settling flux peaks at 1/(n + 1)
    0.177
    """
    began = time.perf_counter()
    search, objective, sign, kept, first = _search(
        thing, over, minimize, maximize, limits, outputs, method, uncertain, samples, probability, seed, fixed
    )
    constraints = _constraints(kept, search.outputs)

    def weight(point: Point) -> tuple[float, np.ndarray]:
        return sign * float(point.figures[0]), sign * point.slopes[0]

    total = whole(starts, "starts", 1, 1000)
    ends: list[Found] = []
    done = [0]

    def watch() -> None:
        if progress is not None:
            progress(
                Progress(
                    done[0], total, 0, _("start {number}, evaluation {count}").format(number=done[0] + 1, count=search.evaluations + 1)
                )
            )
        if cancel is not None and cancel():
            raise Stopped

    search.watch = watch
    base: dict[str, float] = {}
    finished = True
    try:
        for place in _starts(search.spans, first, total, seed):
            ends.append(descend(search, weight, constraints, place, method))
            if not base and ends[0].point.code == FINE:
                base = dict(zip(search.outputs, map(float, search.at(place).figures), strict=True))
            done[0] += 1
        if progress is not None:
            progress(Progress(total, total, sum(e.point.code != FINE for e in ends)))
    except Stopped:
        finished = False
    if not ends:
        raise InputError(_("The study was stopped before the first start ended."))
    ends.sort(key=lambda e: (e.violation > FEASIBLE, e.violation if e.violation > FEASIBLE else 0.0, e.objective))
    best = ends[0]
    if best.point.code != FINE:
        raise InputError(_("No start gave a result: {reason}. Change the starting values or the limits.").format(reason=best.message))
    prices, rest = _multipliers(best.point, weight, constraints, best.z)
    shadow = {f"{c.path} {'lower' if c.sign > 0 else 'upper'}": sign * c.sign * p / c.scale
              for c, p in zip(constraints, prices, strict=True) if c.value(best.point) <= 10 * FEASIBLE}  # fmt: skip
    size = float(np.linalg.norm(weight(best.point)[1]))
    cases = _as_cases(search, ends)
    told = tuple({"inputs": search.values(e.z), "objective": number(sign * e.objective), "feasible": e.violation <= FEASIBLE,
                  "violation": number(e.violation), "converged": e.converged, "steps": e.steps, "message": e.message} for e in ends)  # fmt: skip
    chance = _checked(search, best, kept, seed, samples, how) if search.samples is not None else None
    return Optimum(title or _("Optimization"), cases, objective, sign < 0, kept, search.spans, told, base, shadow,
                   rest if size else 0.0, search.evaluations, chance, finished, elapsed=time.perf_counter() - began)  # fmt: skip


def _search(thing: Any, over: Mapping[str, Any], minimize: str | None, maximize: str | None, limits: Mapping[str, Any] | None,
            outputs: Sequence[str] | None, method: str, uncertain: Mapping[str, Any] | None, samples: int, probability: float, seed: int,
            fixed: Mapping[str, Any] | None, second: str = "") -> tuple[Search, str, float, Limits, dict[str, float]]:  # fmt: skip
    if method not in METHODS:
        raise unknown_name(_("Method"), method, METHODS)
    if not 0.0 < probability < 1.0:
        raise InputError(_("'probability' = {value} must lie between 0 and 1.").format(value=probability))
    subject = subject_of(thing, fixed)
    if isinstance(subject, FormulaSubject) and not subject.pure:
        raise InputError(
            _("'{key}' is a {sort}: it has no derivatives and cannot be optimized.").format(key=subject.thing.card.key, sort=_("procedure"))
        )
    name, sign = _objective(minimize, maximize)
    subject, name = subject.figure(name)
    if second:
        subject, second = subject.figure(second)
    subject, kept = limits_of(subject, limits or {}, _("in 'limits' for"))
    spans, first = _decisions(subject, over)
    sources: list[Source] = []
    if samples:
        wanted = {k: v for k, v in (uncertain or {}).items() if k not in spans}
        sources = sources_of(subject, wanted)
    doubtful = tuple(n for s in sources for n in s.names)
    subject, shown = prepare(subject, outputs or [name], (*spans, *doubtful))
    paths = tuple(dict.fromkeys((name, *((second,) if second else ()), *kept, *shown)))
    drawn = None
    if samples:
        count = whole(samples, "samples", 10, 100_000)
        drawn = inputs_at(sources, unit_points("latin_hypercube", count, sum(s.dimensions for s in sources), seed))
    signs = np.zeros(len(paths))
    for path, (low, high) in kept.items():
        if samples and low is not None and high is not None:
            raise InputError(_("'{name}': under uncertainty a figure takes one limit, 'lower' or 'upper'.").format(name=path), name=path)
        signs[paths.index(path)] = -1.0 if high is None else 1.0
    search = Search(subject, spans, paths, doubtful, drawn, probability, 2 if second else 1, sources, signs)

    return search, name, sign, kept, first


def _as_cases(search: Search, ends: Sequence[Found]) -> Cases:
    x = np.array([list(search.values(e.z).values()) for e in ends])
    codes = [EXTRAPOLATED if e.point.extrapolated else e.point.code for e in ends]
    return Cases(
        search.subject, tuple(search.spans), search.outputs, x, np.array([e.point.figures for e in ends]), np.array(codes, np.int32)
    )


def _checked(search: Search, best: Found, kept: Limits, seed: int, samples: int, how: Mapping[str, Any]) -> dict[str, Any]:
    """The probability of keeping the limits at the optimum, on fresh samples."""
    sources = search.sources
    points = unit_points("latin_hypercube", 4 * samples, sum(s.dimensions for s in sources), seed + 1)
    drawn = inputs_at(sources, points)
    decided = np.tile(list(search.values(best.z).values()), (len(drawn), 1))
    cases = evaluate(search.subject, (*search.spans, *search.uncertain), search.outputs, np.hstack([decided, drawn]), **how)
    together = cases.fine.copy()
    rows = {}
    for path, limit in kept.items():
        fine = meets(cases.y[:, search.outputs.index(path)], limit)
        together &= fine
        rows[path] = {"probability": float(fine.mean()), "interval_95": list(wilson(int(fine.sum()), len(fine)))}
    rows[""] = {"probability": float(together.mean()), "interval_95": list(wilson(int(together.sum()), len(together)))}
    return {
        "wanted": search.probability,
        "samples": len(drawn),
        "failed": int((~cases.fine).sum()),
        "limits": rows,
        "statistics": {p: statistics(cases.y[:, j]) for j, p in enumerate(search.outputs)},
    }


# -- two objectives --------------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class Front(Outcome):
    """Best compromises between two figures. ``cases`` holds the points of the front in order."""

    objectives: tuple[str, str]
    senses: tuple[str, str]
    evaluations: int
    dropped: int
    finished: bool = True
    kind: ClassVar[str] = "pareto"

    @property
    def complete(self) -> bool:
        return self.finished

    def findings(self) -> dict[str, Any]:
        rows = [
            {"inputs": {p: number(v) for p, v in zip(self.cases.inputs, x, strict=True)},
             "outputs": {p: number(v) for p, v in zip(self.cases.outputs, y, strict=True)}}
            for x, y in zip(self.cases.x, self.cases.y, strict=True)
        ]  # fmt: skip
        return {
            "objectives": [{"name": n, "sense": s} for n, s in zip(self.objectives, self.senses, strict=True)],
            "front": rows, "dropped": self.dropped, "evaluations": self.evaluations,
        }  # fmt: skip

    def charts(self) -> dict[str, go.Figure]:
        from granum.studies import charts

        return charts.of_front(self)


def pareto(thing: Any, over: Mapping[str, Any], objectives: Sequence[Mapping[str, str]], *, limits: Mapping[str, Any] | None = None,
           outputs: Sequence[str] | None = None, points: int = 11, starts: int = 2, method: str = "slsqp", seed: int = 0, title: str = "",
           fixed: Mapping[str, Any] | None = None, progress: Report | None = None, cancel: Cancel | None = None) -> Front:  # fmt: skip
    """The front between two objectives, ``[{"minimize": "…"}, {"maximize": "…"}]``, by limits on the second one (epsilon-constraint).

    The ends are the optima of each alone; in between the first is optimized while the second keeps an evenly spaced limit. Points
    that another one beats in both are dropped and counted.
    """
    began = time.perf_counter()
    pairs = _pair(objectives)
    count = whole(points, "points", 3, 500)
    (one, sign_one), (two, sign_two) = pairs
    first_sense = {"minimize": one} if sign_one > 0 else {"maximize": one}
    search, one, _sign, kept, first = _search(thing, over, first_sense.get("minimize"), first_sense.get("maximize"), limits, outputs, method,
                                              None, 0, 0.5, seed, fixed, two)  # fmt: skip
    two = search.outputs[1] if len(search.outputs) > 1 else one
    if one == two:
        raise InputError(_("The two objectives must be different figures."))
    constraints = _constraints(kept, search.outputs)
    done = [0]

    def watch() -> None:
        if progress is not None:
            progress(Progress(done[0], count, 0, _("evaluation {count}").format(count=search.evaluations + 1)))
        if cancel is not None and cancel():
            raise Stopped

    search.watch = watch

    def weighing(index: int, sign: float) -> Callable[[Point], tuple[float, np.ndarray]]:
        return lambda p: (sign * float(p.figures[index]), sign * p.slopes[index])

    def best(index: int, sign: float, extra: list[Constraint], places: Sequence[np.ndarray]) -> Found | None:
        ends = [descend(search, weighing(index, sign), [*constraints, *extra], place, method) for place in places]
        ends = sorted((e for e in ends if e.point.code == FINE and e.violation <= FEASIBLE), key=lambda e: e.objective)
        return ends[0] if ends else None

    places = _starts(search.spans, first, whole(starts, "starts", 1, 100), seed)
    found: list[Found] = []
    finished = True
    try:
        left, right = best(0, sign_one, [], places), best(1, sign_two, [], places)
        if left is None or right is None:
            raise InputError(_("No point keeps all limits: widen them or the ranges of the inputs."))
        found = [left, right]
        ends = [float(e.point.figures[1]) for e in found]
        scale = abs(ends[1] - ends[0]) or 1.0
        previous = left
        for k, limit in enumerate(np.linspace(ends[0], ends[1], count)[1:-1]):
            done[0] = k + 2
            share = (k + 1) / (count - 1)
            between = (1 - share) * left.z + share * right.z
            step = best(
                0, sign_one, [Constraint(two, 1, float(limit), -sign_two, scale)], [previous.z, between, right.z][: 1 + len(places)]
            )
            if step is not None:
                found.append(step)
                previous = step
        if progress is not None:
            progress(Progress(count, count, count - len(found)))
    except Stopped:
        finished = False
    if not found:
        raise InputError(_("The study was stopped before the first start ended."))
    order = sorted(found, key=lambda e: sign_one * float(e.point.figures[0]))
    front: list[Found] = []
    for e in order:  # sorted by the first: a point stays when it is better in the second than all before it
        if not front or sign_two * float(e.point.figures[1]) < sign_two * float(front[-1].point.figures[1]) - 1e-9 * scale_of(front):
            front.append(e)
    senses = tuple("minimize" if s > 0 else "maximize" for s in (sign_one, sign_two))
    return Front(title or _("Pareto front"), _as_cases(search, front), (one, two), senses, search.evaluations, len(found) - len(front),  # type: ignore[arg-type]
                 finished, elapsed=time.perf_counter() - began)  # fmt: skip


def scale_of(front: Sequence[Found]) -> float:
    """Size of the second objective along a front."""
    return max(abs(float(e.point.figures[1])) for e in front) or 1.0


def _pair(objectives: Sequence[Mapping[str, str]]) -> list[tuple[str, float]]:
    if not isinstance(objectives, Sequence) or isinstance(objectives, str) or len(objectives) != 2:
        raise InputError(_('A Pareto front needs two objectives: [{{minimize = "…"}}, {{maximize = "…"}}].').format())
    pairs = []
    for table in objectives:
        if not isinstance(table, Mapping):
            raise InputError(_('A Pareto front needs two objectives: [{{minimize = "…"}}, {{maximize = "…"}}].').format())
        for key in table:
            if key not in ("minimize", "maximize"):
                raise unknown_name(_("Key"), key, ("minimize", "maximize"), _("in 'objectives'"))
        pairs.append(_objective(table.get("minimize"), table.get("maximize")))
    return pairs
