"""Best compromises between two figures: the Pareto front, point by point."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.studies.declared import whole
from granum.studies.engine import Cancel, Progress, Report
from granum.studies.outcome import Outcome, kind_in_words, number
from granum.studies.problem import as_cases, constraints_of, objective_of, search_of, starts_of
from granum.studies.search import FEASIBLE, Constraint, Found, Point, Stopped, descend
from granum.studies.subjects import FINE

if TYPE_CHECKING:
    import plotly.graph_objects as go


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
            {
                "inputs": {p: number(v) for p, v in zip(self.cases.inputs, x, strict=True)},
                "outputs": {p: number(v) for p, v in zip(self.cases.outputs, y, strict=True)},
            }
            for x, y in zip(self.cases.x, self.cases.y, strict=True)
        ]
        return {
            "objectives": [
                {"name": n, "sense": s} for n, s in zip(self.objectives, self.senses, strict=True)
            ],
            "front": rows,
            "dropped": self.dropped,
            "evaluations": self.evaluations,
        }

    def charts(self) -> dict[str, go.Figure]:
        from granum.studies import charts

        return charts.of_front(self)


def pareto(
    thing: Any,
    over: Mapping[str, Any],
    objectives: Sequence[Mapping[str, str]],
    *,
    limits: Mapping[str, Any] | None = None,
    outputs: Sequence[str] | None = None,
    points: int = 11,
    starts: int = 2,
    method: str = "slsqp",
    seed: int = 0,
    title: str = "",
    fixed: Mapping[str, Any] | None = None,
    progress: Report | None = None,
    cancel: Cancel | None = None,
) -> Front:
    """The front between two objectives, ``[{"minimize": "…"}, {"maximize": "…"}]``, by limits on the second
    one (epsilon-constraint).

    The ends are the optima of each alone; in between the first is optimized while the second keeps an evenly
    spaced limit. Points that another one beats in both are dropped and counted.
    """
    began = time.perf_counter()
    pairs = _pair(objectives)
    count = whole(points, "points", 3, 500)
    (one, sign_one), (two, sign_two) = pairs
    first_sense = {"minimize": one} if sign_one > 0 else {"maximize": one}
    search, one, _sign, kept, first = search_of(
        thing,
        over,
        first_sense.get("minimize"),
        first_sense.get("maximize"),
        limits,
        outputs,
        method,
        None,
        0,
        0.5,
        seed,
        fixed,
        two,
    )
    two = search.outputs[1] if len(search.outputs) > 1 else one
    if one == two:
        raise InputError(_("The two objectives must be different figures."))
    constraints = constraints_of(kept, search.outputs)
    done = [0]

    def watch() -> None:
        if progress is not None:
            progress(
                Progress(done[0], count, 0, _("evaluation {count}").format(count=search.evaluations + 1))
            )
        if cancel is not None and cancel():
            raise Stopped

    search.watch = watch

    def weighing(index: int, sign: float) -> Callable[[Point], tuple[float, np.ndarray]]:
        return lambda p: (sign * float(p.figures[index]), sign * p.slopes[index])

    def best(index: int, sign: float, extra: list[Constraint], places: Sequence[np.ndarray]) -> Found | None:
        ends = [
            descend(search, weighing(index, sign), [*constraints, *extra], place, method) for place in places
        ]
        ends = sorted(
            (e for e in ends if e.point.code == FINE and e.violation <= FEASIBLE), key=lambda e: e.objective
        )
        return ends[0] if ends else None

    places = starts_of(search.spans, first, whole(starts, "starts", 1, 100), seed)
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
                0,
                sign_one,
                [Constraint(two, 1, float(limit), -sign_two, scale)],
                [previous.z, between, right.z][: 1 + len(places)],
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
        if not front or sign_two * float(e.point.figures[1]) < sign_two * float(
            front[-1].point.figures[1]
        ) - 1e-9 * scale_of(front):
            front.append(e)
    senses = tuple("minimize" if s > 0 else "maximize" for s in (sign_one, sign_two))
    return Front(
        title or kind_in_words("pareto"),
        as_cases(search, front),
        (one, two),
        senses,  # type: ignore[arg-type]
        search.evaluations,
        len(found) - len(front),
        finished,
        elapsed=time.perf_counter() - began,
    )


def scale_of(front: Sequence[Found]) -> float:
    """Size of the second objective along a front."""
    return max(abs(float(e.point.figures[1])) for e in front) or 1.0


def _pair(objectives: Sequence[Mapping[str, str]]) -> list[tuple[str, float]]:
    if not isinstance(objectives, Sequence) or isinstance(objectives, str) or len(objectives) != 2:
        raise InputError(
            _('A Pareto front needs two objectives: [{{minimize = "…"}}, {{maximize = "…"}}].').format()
        )
    pairs = []
    for table in objectives:
        if not isinstance(table, Mapping):
            raise InputError(
                _('A Pareto front needs two objectives: [{{minimize = "…"}}, {{maximize = "…"}}].').format()
            )
        for key in table:
            if key not in ("minimize", "maximize"):
                raise unknown_name(_("Key"), key, ("minimize", "maximize"), _("in 'objectives'"))
        pairs.append(objective_of(table.get("minimize"), table.get("maximize")))
    return pairs
