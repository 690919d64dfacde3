"""Optimization with exact derivatives: constraints, several starts, design under uncertainty."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from granum.core.errors import InputError
from granum.core.i18n import _
from granum.studies.declared import whole
from granum.studies.engine import Cancel, Progress, Report, evaluate
from granum.studies.outcome import Limits, Outcome, kind_in_words, meets, number, statistics, wilson
from granum.studies.problem import as_cases, constraints_of, search_of, starts_of
from granum.studies.sampling import inputs_at, unit_points
from granum.studies.search import FEASIBLE, Found, Point, Search, Span, Stopped, descend, multipliers
from granum.studies.subjects import FINE

if TYPE_CHECKING:
    import plotly.graph_objects as go


@dataclass(frozen=True)
class Optimum(Outcome):
    """The best point, what limits it, and where each start ended. ``cases`` holds the starts' end points, the
    best first.
    """

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
        """What holds the optimum back: limits of figures, with what a unit more of each would give, and
        limits of inputs.
        """
        rows: list[dict[str, Any]] = []
        for path, (low, high) in self.limits.items():
            for side, limit in (("lower", low), ("upper", high)):
                if limit is None or f"{path} {side}" not in self.prices:
                    continue
                rows.append(
                    {
                        "name": path,
                        "side": side,
                        "limit": limit,
                        "price": number(self.prices[f"{path} {side}"]),
                    }
                )
        for path, value in self.values.items():
            span = self.spans[path]
            for side, limit, place in (("lower", span.lower, 0.0), ("upper", span.upper, 1.0)):
                if abs(span.place(value) - place) <= 10 * FEASIBLE:
                    rows.append({"name": path, "side": side, "limit": limit, "price": None})
        return rows

    def findings(self) -> dict[str, Any]:
        return {
            "objective": {
                "name": self.objective,
                "sense": "maximize" if self.maximize else "minimize",
                "value": number(self.figures[self.objective]),
                "before": number(self.base.get(self.objective, np.nan)),
            },
            "feasible": self.feasible,
            "inputs": {
                p: {"value": number(v), "lower": self.spans[p].lower, "upper": self.spans[p].upper}
                for p, v in self.values.items()
            },
            "outputs": {
                p: {"value": number(v), "before": number(self.base.get(p, np.nan))}
                for p, v in self.figures.items()
            },
            "active": self.active(),
            "limits": {p: {"lower": low, "upper": high} for p, (low, high) in self.limits.items()},
            "stationarity": number(self.stationarity),
            "evaluations": self.evaluations,
            "starts": list(self.ends),
            "chance": self.chance,
        }

    def charts(self) -> dict[str, go.Figure]:
        from granum.studies import charts

        return charts.of_optimum(self)


def optimize(
    thing: Any,
    over: Mapping[str, Any],
    *,
    minimize: str | None = None,
    maximize: str | None = None,
    limits: Mapping[str, Any] | None = None,
    outputs: Sequence[str] | None = None,
    starts: int = 3,
    method: str = "slsqp",
    uncertain: Mapping[str, Any] | None = None,
    samples: int = 0,
    probability: float = 0.95,
    seed: int = 0,
    title: str = "",
    fixed: Mapping[str, Any] | None = None,
    progress: Report | None = None,
    cancel: Cancel | None = None,
    **how: Any,
) -> Optimum:
    """The best inputs inside their limits, with exact derivatives.

    Parameters
    ----------
    over: ``{input: (lower, upper)}`` or ``{input: {lower, upper, start}}``, any unit.
    minimize, maximize: one figure, quantity or expression.
    limits: ``{figure: {lower, upper}}``.
    starts: runs from different places (the first from the values of the case); the best feasible end counts.
    method: ``slsqp`` or ``trust_constr``.
    uncertain, samples, probability: with samples > 0 the mean of the objective is optimized and each limit
        kept with the probability wanted (robust design); the chance is then checked on four times as many
        fresh samples.

    >>> found = optimize(
    ...     "particles.richardson_zaki",
    ...     {"solids_volume_fraction": (0.01, 0.5)},
    ...     starts=1,
    ...     maximize="solids_volume_fraction * hindrance",
    ...     fixed={"exponent": 4.65, "reynolds": 0.01},
    ... )
    >>> round(found.values["solids_volume_fraction"], 3)  # the settling flux peaks at 1/(n + 1)
    0.177
    """
    began = time.perf_counter()
    search, objective, sign, kept, first = search_of(
        thing, over, minimize, maximize, limits, outputs, method, uncertain, samples, probability, seed, fixed
    )
    constraints = constraints_of(kept, search.outputs)

    def weight(point: Point) -> tuple[float, np.ndarray]:
        return sign * float(point.figures[0]), sign * point.slopes[0]

    total = whole(starts, "starts", 1, 1000)
    ends: list[Found] = []
    done = [0]

    def watch() -> None:
        if progress is not None:
            progress(
                Progress(
                    done[0],
                    total,
                    0,
                    _("start {number}, evaluation {count}").format(
                        number=done[0] + 1, count=search.evaluations + 1
                    ),
                )
            )
        if cancel is not None and cancel():
            raise Stopped

    search.watch = watch
    base: dict[str, float] = {}
    finished = True
    try:
        for place in starts_of(search.spans, first, total, seed):
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
    ends.sort(
        key=lambda e: (e.violation > FEASIBLE, e.violation if e.violation > FEASIBLE else 0.0, e.objective)
    )
    best = ends[0]
    if best.point.code != FINE:
        raise InputError(
            _("No start gave a result: {reason}. Change the starting values or the limits.").format(
                reason=best.message
            )
        )
    prices, rest = multipliers(best.point, weight, constraints, best.z)
    shadow = {
        f"{c.path} {'lower' if c.sign > 0 else 'upper'}": sign * c.sign * p / c.scale
        for c, p in zip(constraints, prices, strict=True)
        if c.value(best.point) <= 10 * FEASIBLE
    }
    size = float(np.linalg.norm(weight(best.point)[1]))
    cases = as_cases(search, ends)
    told = tuple(
        {
            "inputs": search.values(e.z),
            "objective": number(sign * e.objective),
            "feasible": e.violation <= FEASIBLE,
            "violation": number(e.violation),
            "converged": e.converged,
            "steps": e.steps,
            "message": e.message,
        }
        for e in ends
    )
    chance = _checked(search, best, kept, seed, samples, how) if search.samples is not None else None
    return Optimum(
        title or kind_in_words("optimize"),
        cases,
        objective,
        sign < 0,
        kept,
        search.spans,
        told,
        base,
        shadow,
        rest if size else 0.0,
        search.evaluations,
        chance,
        finished,
        elapsed=time.perf_counter() - began,
    )


def _checked(
    search: Search, best: Found, kept: Limits, seed: int, samples: int, how: Mapping[str, Any]
) -> dict[str, Any]:
    """The probability of keeping the limits at the optimum, on fresh samples."""
    sources = search.sources
    points = unit_points("latin_hypercube", 4 * samples, sum(s.dimensions for s in sources), seed + 1)
    drawn = inputs_at(sources, points)
    decided = np.tile(list(search.values(best.z).values()), (len(drawn), 1))
    cases = evaluate(
        search.subject,
        (*search.spans, *search.uncertain),
        search.outputs,
        np.hstack([decided, drawn]),
        even_none=True,
        **how,
    )
    together = cases.fine.copy()
    rows = {}
    for path, limit in kept.items():
        fine = meets(cases.y[:, search.outputs.index(path)], limit)
        together &= fine
        rows[path] = {
            "probability": float(fine.mean()),
            "interval_95": list(wilson(int(fine.sum()), len(fine))),
        }
    rows[""] = {
        "probability": float(together.mean()),
        "interval_95": list(wilson(int(together.sum()), len(together))),
    }
    return {
        "wanted": search.probability,
        "samples": len(drawn),
        "failed": int((~cases.fine).sum()),
        "limits": rows,
        "statistics": {p: statistics(cases.y[:, j]) for j, p in enumerate(search.outputs)},
    }
