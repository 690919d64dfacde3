"""Which points a fit should not be believed with, and whether it shows anything at all: leverage, influence,
stray points, F test.

A stray point is one whose removal, alone or with one or two others, lowers the sum of squares by more than
chance allows (mean-shift F test, Bonferroni over all sets of that size). Where to look is told by the linear
algebra of the fit itself and by a robust fit beside it, so that one wild point neither hides another nor
itself by pulling a curve along; what is reported was refitted without the points. Scatter may be constant or
in proportion to what is measured: a point must be stray under both.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import scipy

from granum.estimation.losses import SoftL1
from granum.estimation.searches import JUDGING

if TYPE_CHECKING:
    from granum.estimation.least_squares import Problem

ERROR = 0.004
"""Chance of a false alarm of the test for one, two or three stray points each."""
MOST = 3
"""Points that are looked for at once."""
PROMISING = 0.2
"""Probability below which a set found by linear algebra is refitted."""
ONE_BY_ONE = 60
"""Points up to which each is left out in turn once something is stray."""
ROUNDS = 12
ROUND_OFF = 1e-8
"""Residuals below this part of the data are round-off, not scatter."""
SAME = 0.3
"""Part of the residuals by which two starts must differ to be tried both."""
UNEVEN, LEAST_SET = 3.0, 5
"""Ratio of the scatter of joint data sets from which each is measured by its own, and the points that this
takes.
"""
LITTLE, SCATTERED = 0.25, 0.15
SMALL = 0.05
"""Part of the mean size of the data below which a reading's scatter no longer falls with it."""


class Influence(NamedTuple):
    """What every point does to a fit, in the order of the points; NaN where a point was left out.

    Parameters
    ----------
    leverage: diagonal of the hat matrix. studentized: residual over its standard deviation from a fit without
        the point (linearized).
    dffits, cook: how far the point moves its own prediction, and all of them.
    """

    leverage: np.ndarray
    studentized: np.ndarray
    dffits: np.ndarray
    cook: np.ndarray


@dataclass(frozen=True)
class Diagnostics:
    """How far a fit is to be trusted.

    Parameters
    ----------
    influence: leverage, studentized residual, DFFITS and Cook's distance of every point.
    threshold: studentized residual beyond which a single point is stray (Student, Bonferroni over the
        points).
    stray: indices of the stray points, and ``deviations``: their distance from the fit without them in its
        standard deviations.
    without: parameters fitted without them, by name. robust: parameters of a robust fit (soft L1) to all
        points; both empty without stray points.
    probability: of data at least so well described by the model if they did not depend on it (F test against
        their mean).
    """

    influence: Influence
    threshold: float
    stray: tuple[int, ...]
    deviations: tuple[float, ...]
    without: Mapping[str, float]
    robust: Mapping[str, float]
    probability: float

    def as_json(self) -> dict[str, Any]:
        """Plain data: the stray points with their figures, and both other fits."""
        rows = [
            {
                "point": k + 1,
                "deviation": d,
                **{n: float(v[k]) for n, v in self.influence._asdict().items() if np.isfinite(v[k])},
            }
            for k, d in zip(self.stray, self.deviations, strict=True)
        ]
        return {
            "threshold": _finite(self.threshold),
            "stray": rows,
            "without_stray": dict(self.without),
            "robust": dict(self.robust),
            "probability_of_no_relation": _finite(self.probability),
        }


def diagnose(problem: Problem, q: np.ndarray, held: Collection[str]) -> Diagnostics:
    """Diagnostics of a solution at scaled parameters ``q``, with some held at their bounds."""
    chance = _no_relation(problem, q, problem.residual(q), len(problem.names) - len(held))
    problem, q = _evened(problem, q)
    residual, jacobian = problem.residual(q), problem.jacobian(q)
    free = np.array([n not in held for n in problem.names])
    floor = ROUND_OFF * np.sqrt(np.mean((problem.y / problem.sigma)[problem.keep] ** 2))
    basis = _basis(jacobian[:, free])
    local = _influence(residual, basis, floor)
    place = np.flatnonzero(problem.keep)

    def spread_out(values: np.ndarray) -> np.ndarray:
        whole = np.full(problem.keep.shape, np.nan)
        whole[place] = values
        return whole

    n, p = residual.size, len(problem.names)
    threshold = float(scipy.stats.t.isf(ERROR / (2.0 * n), n - p - 1)) if n - p > 1 else np.nan
    stray, deviations, at, robust = (
        _stray(problem, q, residual, jacobian, floor) if n - p > 1 else ((), (), q, q)
    )
    found = dict(zip(problem.names, (at * problem.scale).tolist(), strict=True)) if stray else {}
    beside = dict(zip(problem.names, (robust * problem.scale).tolist(), strict=True)) if stray else {}
    return Diagnostics(
        Influence(*map(spread_out, local)),
        threshold,
        tuple(int(place[k]) for k in stray),
        deviations,
        found,
        beside,
        chance,
    )


def _evened(problem: Problem, q: np.ndarray) -> tuple[Problem, np.ndarray]:
    """The problem with joint data sets brought to one scatter where theirs differ, solved again: what is far
    in one may be near in another.
    """
    size, group = np.abs(problem.residual(q)), problem.group[problem.keep]
    sets, counts = np.unique(group, return_counts=True)
    if len(sets) < 2 or counts.min() < LEAST_SET:
        return problem, q
    widths = np.array([np.median(size[group == g]) for g in sets])
    widths = np.maximum(widths, 1e-3 * widths.max())
    if widths.max() <= UNEVEN * widths.min():
        return problem, q
    factor = np.ones(int(group.max()) + 1)
    factor[sets] = widths / widths.max()
    problem = problem.variant(sigma=problem.sigma * factor[np.minimum(problem.group, group.max())])
    return problem, problem.solve(q)[0]


def _basis(jacobian: np.ndarray) -> np.ndarray:
    """Orthonormal columns that span those of the Jacobian: their squares summed by row are the leverage,
    without the n x n hat matrix.
    """
    lengths = np.linalg.norm(jacobian, axis=0)
    left, singular, _right = np.linalg.svd(
        jacobian / np.where(lengths > 0, lengths, 1.0), full_matrices=False
    )
    return left[:, singular > 1e-10 * max(singular[0], 1e-300)] if singular.size else left


def _influence(residual: np.ndarray, basis: np.ndarray, floor: float) -> Influence:
    n, p = residual.size, basis.shape[1]
    leverage = np.minimum(np.sum(basis**2, axis=1), 1.0)
    room = np.maximum(1.0 - leverage, 1e-12)
    squares = float(residual @ residual)
    variance = max(squares / max(n - p, 1), floor**2)
    left = np.maximum(squares - residual**2 / room, 0.0) / max(n - p - 1, 1)
    studentized = residual / np.sqrt(np.maximum(left, floor**2) * room + 1e-300)
    pull = leverage / room
    return Influence(
        leverage,
        -studentized,
        -studentized * np.sqrt(pull),
        residual**2 * pull / room / (max(p, 1) * variance + 1e-300),
    )


def _stray(
    problem: Problem, q: np.ndarray, residual: np.ndarray, jacobian: np.ndarray, floor: float
) -> tuple[tuple[int, ...], tuple[float, ...], np.ndarray, np.ndarray]:
    """Stray points (indices among the kept), their deviations, the solution without them and the robust
    one.
    """
    n, p = residual.size, len(problem.names)
    most = min(MOST, n - p - 1)
    robust = _robust(problem, q, floor)
    beside = problem.residual(robust)
    whole = float(residual @ residual)
    sets: dict[tuple[int, ...], float] = {}
    for r, J in ((residual, jacobian), (beside, problem.jacobian(robust))):
        sets |= _peeled(r, J, most, p, floor)
        if most > 1 and n <= ONE_BY_ONE:
            sets |= _best_pair(r, J, p, floor)
    order = np.argsort(-np.abs(beside), kind="stable")
    for m in range(1, most + 1):
        key = tuple(sorted(order[:m].tolist()))
        rest = np.setdiff1d(np.arange(n), key)
        sets.setdefault(key, _chance(whole, float(beside[rest] @ beside[rest]), n, m, p, floor))
    nothing = ((), (), q, robust)

    def refitted(key: tuple[int, ...]) -> tuple[float, tuple[int, ...], np.ndarray]:
        at = _without(problem, (q, robust), key)
        left = np.delete(problem.residual(at), key)
        return _chance(whole, float(left @ left), n, len(key), p, floor), key, at

    tried = [refitted(key) for key, guess in sets.items() if guess < PROMISING]
    if not any(chance < ERROR for chance, _key, _at in tried):
        return nothing
    # something is wrong: which point it is, no linear algebra about a spoiled solution may decide
    if n <= ONE_BY_ONE:
        tried += [refitted((k,)) for k in range(n) if sets.get((k,), 1.0) >= PROMISING]
    _least, suspects, at = min(tried, key=lambda item: item[0])
    while suspects:
        # of a set only those are stray that the others, refitted without the set, reject one by one, whatever
        # the law of their scatter
        deviations = _deviations(problem, at, suspects, floor)
        even = _in_proportion(problem, at)
        relative = _deviations(even, even.solve(at, without=suspects, search=JUDGING)[0], suspects, floor)
        limit = scipy.stats.t.isf(ERROR / (2.0 * n), n - len(suspects) - p)
        far = tuple(
            k for k, d, r in zip(suspects, deviations, relative, strict=True) if min(abs(d), abs(r)) > limit
        )
        if far == suspects:
            return far, tuple(deviations), problem.solve(at, without=far)[0], robust
        suspects, at = far, _without(problem, (at, q, robust), far)
    return nothing


def _in_proportion(problem: Problem, at: np.ndarray) -> Problem:
    """The problem with scatter in proportion to the model (Carroll and Ruppert 1988): readings good to a
    percent look wild under one constant scatter.
    """
    size, group = np.abs(problem.prediction(at)), problem.group
    mean = np.sqrt(np.bincount(group, size**2) / np.maximum(np.bincount(group), 1))[group]
    return problem.variant(sigma=problem.sigma * np.maximum(size / np.where(mean > 0, mean, 1.0), SMALL))


def _robust(problem: Problem, q: np.ndarray, floor: float) -> np.ndarray:
    """A fit in which stray points pull little, its scale found with it."""
    width = 0.0
    for _round in range(ROUNDS):
        size = np.abs(problem.residual(q))
        new = max(1.4826 * float(np.median(size)), 1e-6 * float(np.max(size)), floor, 1e-100)
        if abs(new - width) <= 1e-3 * new:
            break
        width = new
        q, _outcome = problem.solve(q, width=width, loss=SoftL1(), search=JUDGING)
    return q


def _peeled(
    residual: np.ndarray, jacobian: np.ndarray, most: int, p: int, floor: float
) -> dict[tuple[int, ...], float]:
    """Sets of one, two … points, each the last one and the point that then stands out most, with their
    chance: all by linear algebra.
    """
    n = residual.size
    rest, gone, found = np.arange(n), [], {}
    total = None
    for m in range(most + 1):
        basis = _basis(jacobian[rest])
        left = residual[rest] - basis @ (basis.T @ residual[rest])
        squares = float(left @ left)
        if total is None:
            total = squares
        else:
            found[tuple(sorted(gone))] = _chance(total, squares, n, m, p, floor)
        out = int(np.argmax(np.abs(_influence(left, basis, floor).studentized)))
        gone.append(int(rest[out]))
        rest = np.delete(rest, out)
    return found


def _best_pair(
    residual: np.ndarray, jacobian: np.ndarray, p: int, floor: float
) -> dict[tuple[int, ...], float]:
    """The two points whose common removal lowers the sum of squares most; they may each look ordinary while
    the other is there.
    """
    basis = _basis(jacobian)
    left = residual - basis @ (basis.T @ residual)
    room = np.eye(residual.size) - basis @ basis.T
    own = np.diag(room)
    determinant = np.outer(own, own) - room**2
    lowered = (
        left[:, None] ** 2 * own[None, :]
        - 2.0 * np.outer(left, left) * room
        + left[None, :] ** 2 * own[:, None]
    )
    usable = np.triu(determinant > 1e-9, 1)
    if not usable.any():
        return {}
    lowered = np.where(usable, lowered / np.where(usable, determinant, 1.0), -1.0)
    i, j = (int(k) for k in np.unravel_index(int(np.argmax(lowered)), lowered.shape))
    squares = float(left @ left)
    return {(i, j): _chance(squares, max(squares - float(lowered[i, j]), 0.0), residual.size, 2, p, floor)}


def _chance(before: Any, after: Any, n: int, m: int, p: int, floor: float) -> float:
    """Probability that leaving out the best m of n points lowers the sum of squares as much by chance
    (Bonferroni over all sets).
    """
    dof = n - m - p
    after = max(after, dof * floor**2, 1e-300)
    return float(
        min(math.comb(n, m) * scipy.stats.f.sf(max(before - after, 0.0) / m / (after / dof), m, dof), 1.0)
    )


def _without(problem: Problem, starts: tuple[np.ndarray, ...], key: tuple[int, ...]) -> np.ndarray:
    """The best of the refits without some points from several starts, of those that the data tell apart."""

    def squares(at: np.ndarray) -> float:
        left = np.delete(problem.residual(at), key)
        return float(left @ left)

    apart: list[np.ndarray] = []
    for start in starts:
        here = problem.residual(start)
        if all(
            np.linalg.norm(here - problem.residual(other)) > SAME * np.linalg.norm(here) for other in apart
        ):
            apart.append(start)
    return min((problem.solve(start, without=key, search=JUDGING)[0] for start in apart), key=squares)


def _deviations(problem: Problem, at: np.ndarray, key: tuple[int, ...], floor: float) -> list[float]:
    """Distance of some points from the fit without them, in standard deviations of a prediction."""
    residual, jacobian = problem.residual(at), problem.jacobian(at)
    rest = np.setdiff1d(np.arange(residual.size), key)
    lengths = np.linalg.norm(jacobian[rest], axis=0)
    scaled = jacobian / np.where(lengths > 0, lengths, 1.0)
    inverse = np.linalg.pinv(scaled[rest].T @ scaled[rest], rcond=1e-12, hermitian=True)
    variance = max(float(residual[rest] @ residual[rest]) / max(rest.size - len(problem.names), 1), floor**2)
    return [
        float(-residual[k] / np.sqrt(variance * (1.0 + scaled[k] @ inverse @ scaled[k]) + 1e-300))
        for k in key
    ]


def _no_relation(problem: Problem, q: np.ndarray, residual: np.ndarray, count: int) -> float:
    """Probability of so good a description by chance: F test of the model against the mean of each data set;
    NaN where it does not apply.
    """
    spread, sets = problem.spread(problem.y), len(np.unique(problem.group[problem.keep]))
    squares, dof = float(residual @ residual), residual.size - count
    size = float(np.sum((problem.y / problem.sigma)[problem.keep] ** 2))
    if dof < 1:
        return np.nan
    if spread <= 1e-20 * size:  # one value measured again and again
        return 1.0 if count > sets else np.nan
    if count <= sets and problem.spread(problem.prediction(q)) < LITTLE * squares:
        # a law with one constant, measured where it hardly varies: the points can only agree on the constant
        return 1.0 if squares / dof > SCATTERED**2 * size / residual.size else np.nan
    freedom = max(count - sets, 1)
    return float(
        scipy.stats.f.sf(max(spread - squares, 0.0) / freedom / (max(squares, 1e-300) / dof), freedom, dof)
    )


def _finite(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None
