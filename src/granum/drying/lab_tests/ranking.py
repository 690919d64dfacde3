"""Fitting many models to one data set and ranking them by the corrected Akaike criterion, equal curves
counted once.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from granum.core.errors import GranumError, InputError
from granum.core.i18n import _
from granum.estimation import Fit


@dataclass(frozen=True)
class Ranked:
    """One model of a ranking.

    Parameters
    ----------
    name: registry name of the model.
    fit: its fit.
    delta: AICc above the best; beyond 10 the model has no support (Burnham and Anderson).
    weight: Akaike weight among different curves.
    same_curve_as: better-placed model that draws the same curve, if any: it is no independent support.
    residual_runs: probability of so few sign changes of the residuals by chance; small means a systematic
        misfit.
    """

    name: str
    fit: Fit
    delta: float
    weight: float
    same_curve_as: str | None
    residual_runs: float

    def as_json(self) -> dict[str, Any]:
        """Plain data for tables."""
        return {
            "model": self.name,
            "aicc": self.fit.statistics["aicc"],
            "delta": self.delta,
            "weight": self.weight,
            "same_curve_as": self.same_curve_as,
            "residual_runs": self.residual_runs,
            "rmse": self.fit.statistics["rmse"],
            "parameters": {n: e.value for n, e in self.fit.parameters.items()},
        }


def rank(models: Mapping[str, type], fit_one: Callable[[type], Fit]) -> tuple[list[Ranked], dict[str, str]]:
    """All models that could be fitted, best first, and why the others could not."""
    fits: dict[str, Fit] = {}
    failed: dict[str, str] = {}
    for name, cls in models.items():
        try:
            found = fit_one(cls)
        except GranumError as problem:
            failed[name] = problem.message
            continue
        if np.isfinite(found.statistics["aicc"]) or found.statistics["aicc"] == -np.inf:
            fits[name] = found
        else:
            failed[name] = _("{points} points are too few for {count} parameters.").format(
                points=found.statistics["points"], count=len(found.parameters)
            )
    if not fits:
        reasons = "; ".join(f"{name}: {reason}" for name, reason in list(failed.items())[:2])
        raise InputError(
            _("None of the models can be fitted to these points ({reasons}).").format(reasons=reasons)
        )
    order = sorted(fits, key=lambda n: (fits[n].statistics["aicc"], n))
    leaders: dict[str, str] = {}
    best = fits[order[0]].statistics["aicc"]
    rows = []
    for name in order:
        curve = models[name].curve  # type: ignore[attr-defined]
        # free letters beside the curve itself (a temperature, a thickness) do not make a model another one
        same = leaders.setdefault(curve, name)
        delta = fits[name].statistics["aicc"] - best if np.isfinite(best) else 0.0
        rows.append((name, float(delta), None if same == name else same))
    total = sum(np.exp(-0.5 * delta) for _name, delta, same in rows if same is None)
    ranked = [
        Ranked(
            name,
            fits[name],
            delta,
            0.0 if same else float(np.exp(-0.5 * delta) / total),
            same,
            residual_runs(fits[name].residuals),
        )
        for name, delta, same in rows
    ]
    return ranked, failed


def residual_runs(residuals: np.ndarray) -> float:
    """Probability of at most so many runs of equal sign if the residuals were independent (Wald–Wolfowitz,
    normal approximation).
    """
    from scipy.stats import norm

    signs = residuals[residuals != 0] > 0
    plus, minus = int(signs.sum()), int((~signs).sum())
    if min(plus, minus) < 2:
        return 1.0
    n = plus + minus
    runs = 1 + int(np.sum(signs[1:] != signs[:-1]))
    mean = 1.0 + 2.0 * plus * minus / n
    variance = 2.0 * plus * minus * (2.0 * plus * minus - n) / (n**2 * (n - 1.0))
    return float(norm.cdf((runs + 0.5 - mean) / np.sqrt(variance)))
