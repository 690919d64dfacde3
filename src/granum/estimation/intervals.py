"""Intervals that do not lean on the linear approximation: profile likelihood and bootstrap."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import scipy

from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _

if TYPE_CHECKING:
    from granum.estimation.results import Fit


class Profile(NamedTuple):
    """Values of one parameter, the F ratio of the refitted sum of squares, and the 95 % profile-likelihood
    interval.
    """

    values: np.ndarray
    ratio: np.ndarray
    interval_95: tuple[float, float]


def profile(fit: Fit, name: str, points: int = 21) -> Profile:
    """Refit with one parameter held at values around its estimate; least squares only (Bates and Watts 1988,
    ch. 6).

    An end of the interval is a bound, or NaN, where the sum of squares never rises enough.
    """
    if name not in fit.parameters:
        raise unknown_name(_("Parameter"), name, fit.parameters)
    problem, estimate = fit.problem, fit.parameters[name]
    if problem.loss.robust:
        raise InputError(_("A profile needs a fit by least squares, not with a robust loss."))
    dof = fit.statistics["degrees_of_freedom"]
    best = np.array(list(fit.values.values())) / problem.scale
    least = float(np.sum(problem.residual(best) ** 2))
    critical = float(scipy.stats.f.ppf(0.95, 1, dof))
    step = (
        estimate.standard_error
        if np.isfinite(estimate.standard_error)
        else 0.1 * (abs(estimate.value) or 1.0)
    )

    def ratio(value: float) -> float:
        q, _out = problem.solve(best, fixed={name: value})
        return (float(np.sum(problem.residual(q) ** 2)) - least) * dof / max(least, 1e-300)

    ends = []
    for side, bound in zip((-1.0, 1.0), problem.bounds[name], strict=True):
        reach = 2.0 * step
        far = _inside(estimate.value + side * reach, bound, side)
        while ratio(far) < critical and reach < 1e3 * step and far != bound:
            reach *= 1.6
            far = _inside(estimate.value + side * reach, bound, side)
        if ratio(far) >= critical:
            ends.append(
                scipy.optimize.root_scalar(
                    lambda v: ratio(float(v)) - critical, bracket=(estimate.value, far), xtol=1e-12 * step
                ).root
            )
        else:
            ends.append(float(bound) if far == bound else np.nan)
    low, high = ends
    spread = np.nan_to_num(np.array([estimate.value - low, high - estimate.value]), nan=3.0 * step)
    values = np.linspace(estimate.value - 1.3 * spread[0], estimate.value + 1.3 * spread[1], points)
    values = np.clip(values, *problem.bounds[name])
    return Profile(values, np.array([ratio(float(v)) for v in values]), (low, high))


def _inside(value: float, bound: float, side: float) -> float:
    return max(value, bound) if side < 0 else min(value, bound)


def bootstrap(fit: Fit, count: int = 500, seed: int = 0) -> Mapping[str, np.ndarray]:
    """Parameters refitted to the model plus resampled residuals, widened to their unbiased size; one row a
    draw.
    """
    problem, rng = fit.problem, np.random.default_rng(seed)
    best = np.array(list(fit.values.values())) / problem.scale
    standard = -problem.residual(best)
    standard = (standard - standard.mean()) * np.sqrt(standard.size / fit.statistics["degrees_of_freedom"])
    center = problem.y - fit.residuals
    width = None if not problem.loss.robust else 1.4826 * float(np.median(np.abs(standard)))
    index = np.flatnonzero(problem.keep)
    rows = []
    for _draw in range(count):
        y = center.copy()
        y[index] += problem.sigma[index] * rng.choice(standard, standard.size)
        q, _out = problem.solve(best, y=y, width=width)
        rows.append(q * problem.scale)
    return dict(zip(problem.names, np.array(rows).T, strict=True))
