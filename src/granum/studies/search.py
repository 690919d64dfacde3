"""The search for an optimum: figures with exact derivatives at any place, one descent from one start,
multipliers.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
import scipy

from granum.studies.distributions import Source
from granum.studies.subjects import FINE, Subject

METHODS = ("slsqp", "trust_constr")
FEASIBLE = 1e-6
"""Largest violation of a scaled constraint, and largest distance from a limit that counts as active."""


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
    """Figures at one place, their derivatives with respect to the places, the code of the outcome, whether a
    correlation left its range.
    """

    figures: np.ndarray
    slopes: np.ndarray
    code: int
    extrapolated: bool = False


class Stopped(Exception):
    """The study was cancelled."""


def _compiled(
    subject: Subject, inputs: tuple[str, ...], outputs: tuple[str, ...], logs: tuple[bool, ...], sampled: bool
) -> Any:
    """Figures, exact derivatives and code at a place, compiled; the subject keeps the last few, so that other
    limits or ranges start at once.
    """

    def build() -> Any:
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

        return jax.jit(many if sampled else one)

    return subject.kept(("search", inputs, outputs, logs, sampled), build)


@dataclass
class Search:
    """A subject with its decisions: figures and exact derivatives at any place, computed together and
    remembered.
    """

    subject: Subject
    spans: dict[str, Span]
    outputs: tuple[str, ...]
    uncertain: tuple[str, ...] = ()
    samples: np.ndarray | None = None
    probability: float = 0.95
    objectives: int = 1
    sources: Sequence[Source] = ()
    signs: np.ndarray = field(default_factory=lambda: np.ones(0))
    """+1 where a figure is best small or kept below a limit, −1 where it is best large, 0 where neither
    tells.
    """
    watch: Callable[[], None] = lambda: None
    evaluations: int = 0

    def __post_init__(self) -> None:
        logs = tuple(span.logarithmic for span in self.spans.values())
        self._compiled = _compiled(
            self.subject, (*self.spans, *self.uncertain), self.outputs, logs, self.samples is not None
        )
        self._arguments = (
            self.subject.numbers(),
            jnp.array([s.lower for s in self.spans.values()]),
            jnp.array([s.upper for s in self.spans.values()]),
            jnp.zeros(0) if self.samples is None else jnp.asarray(self.samples),
        )
        self._known: dict[bytes, Point] = {}

    def values(self, z: np.ndarray) -> dict[str, float]:
        """The decisions at a place, SI."""
        return {path: float(span.at(z[i])) for i, (path, span) in enumerate(self.spans.items())}

    def at(self, z: np.ndarray) -> Point:
        """Figures and derivatives; under uncertainty the mean of objectives and the wanted quantile of the
        others.
        """
        z = np.clip(np.asarray(z, dtype=float), 0.0, 1.0)
        key = z.tobytes()
        if key not in self._known:
            self.watch()
            found, slopes, codes = (
                np.asarray(part) for part in self._compiled(jnp.asarray(z), *self._arguments)
            )
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


def descend(
    search: Search,
    weight: Callable[[Point], tuple[float, np.ndarray]],
    constraints: Sequence[Constraint],
    start: np.ndarray,
    method: str,
    tolerance: float = 1e-9,
    steps: int = 200,
) -> Found:
    """One run of SLSQP or trust-constr; places where the model fails are made unattractive rather than
    fatal.
    """
    first = search.at(start)
    if first.code != FINE:
        return Found(
            start,
            first,
            np.inf,
            np.inf,
            False,
            search.subject.reason(first.code, tuple(search.spans), search.outputs),
            0,
        )
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
        ended = scipy.optimize.minimize(
            objective,
            start,
            jac=True,
            bounds=bounds,
            constraints=limits,
            method="SLSQP",
            options={"maxiter": steps, "ftol": tolerance},
        )
    else:
        limits = (
            [
                scipy.optimize.NonlinearConstraint(
                    slack,
                    0.0,
                    np.inf,
                    jac=slack_slope,  # type: ignore[arg-type]
                    hess=scipy.optimize.BFGS(),
                )
            ]
            if constraints
            else []
        )
        ended = scipy.optimize.minimize(
            objective,
            start,
            jac=True,
            hess=scipy.optimize.BFGS(),
            bounds=bounds,
            constraints=limits,
            method="trust-constr",
            options={"maxiter": 5 * steps, "gtol": tolerance, "xtol": 1e-12},
        )
    z = np.clip(ended.x, 0.0, 1.0)
    final = search.at(z)
    if final.code != FINE:
        return Found(
            z,
            final,
            np.inf,
            np.inf,
            False,
            search.subject.reason(final.code, tuple(search.spans), search.outputs),
            int(ended.nit),
        )
    violation = max((-c.value(final) for c in constraints), default=0.0)
    fine = (
        bool(ended.success)
        or (method == "trust_constr" and ended.status in (1, 2))
        or _stationary(final, weight, constraints, z) < 1e-4
    )
    return Found(z, final, weight(final)[0], max(violation, 0.0), fine, str(ended.message), int(ended.nit))


def _stationary(
    point: Point,
    weight: Callable[[Point], tuple[float, np.ndarray]],
    constraints: Sequence[Constraint],
    z: np.ndarray,
) -> float:
    """How far the derivatives are from those of an optimum, relative to that of the objective."""
    return multipliers(point, weight, constraints, z)[1]


def multipliers(
    point: Point,
    weight: Callable[[Point], tuple[float, np.ndarray]],
    constraints: Sequence[Constraint],
    z: np.ndarray,
) -> tuple[np.ndarray, float]:
    """Multipliers of the constraints (zero where not active) and the part of the objective's slope that they
    do not explain.
    """
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
    parts, rest = scipy.optimize.nnls(np.stack(columns, axis=1), slope / size)
    found[active] = parts[: len(active)] * size
    return found, float(rest)
