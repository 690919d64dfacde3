"""Which experiment to do next: D-optimal, from the exact Jacobian of the model."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.core.errors import InputError
from granum.core.i18n import _

if TYPE_CHECKING:
    from granum.estimation.results import Fit

EXCHANGES = 100


class NextExperiment(NamedTuple):
    """What one more measurement at each candidate would bring.

    Parameters
    ----------
    best: index of the candidate that shrinks the joint confidence region most.
    shrinkage: volume of the region with that measurement over the volume without, for each candidate.
    standard_errors: expected standard errors with the best candidate, by parameter.
    """

    best: int
    shrinkage: np.ndarray
    standard_errors: dict[str, float]


def next_experiment(fit: Fit, candidates: Any, sigma: Any = None) -> NextExperiment:
    """Rank candidate conditions for the next measurement of a fitted model.

    The gain of a measurement with derivatives j and deviation σ is log(1 + jᵀ C j / σ²) in the logarithm of
    the determinant of the information.

    Parameters
    ----------
    candidates: ``x`` as the model takes it, one entry for each candidate.
    sigma: standard deviation of the new measurement, one or one for each candidate; by default that of the
        fit.
    """
    jacobian = _jacobian(fit.problem.model, fit.values, candidates)
    covariance = fit.covariance
    if not np.all(np.isfinite(covariance)):
        raise InputError(
            _(
                "The parameters are not determined at all by the data so far; plan a set of experiments "
                "instead."
            )
        )
    spread = fit.statistics["residual_standard_deviation"] if sigma is None else sigma
    spread = np.broadcast_to(np.asarray(spread, dtype=float), len(jacobian))
    reached = jacobian @ covariance
    gain = np.einsum("ij,ij->i", reached, jacobian) / spread**2
    gain = np.where(np.isfinite(gain), gain, 0.0)  # where a model has no value, nothing is learned
    best = int(np.argmax(gain))
    with_best = covariance - np.outer(reached[best], reached[best]) / (spread[best] ** 2 * (1.0 + gain[best]))
    errors = dict(zip(fit.values, np.sqrt(np.maximum(np.diag(with_best), 0.0)).tolist(), strict=True))
    return NextExperiment(best, 1.0 / np.sqrt(1.0 + gain), errors)


def optimal_design(
    model: Callable[[dict[str, Any], Any], Any], parameters: Mapping[str, float], candidates: Any, count: int
) -> np.ndarray:
    """Indices of ``count`` candidates (repeats allowed) that together determine the parameters best:
    D-optimal, by exchange (Fedorov 1972).

    Locally optimal: for the values of the parameters given.
    """
    jacobian = _jacobian(model, parameters, candidates)
    jacobian = jacobian / np.where(
        np.linalg.norm(jacobian, axis=0) > 0, np.linalg.norm(jacobian, axis=0), 1.0
    )
    if count < jacobian.shape[1]:
        raise InputError(
            _("{count} experiments cannot determine {parameters} parameters.").format(
                count=count, parameters=jacobian.shape[1]
            )
        )
    ridge = 1e-9 * np.eye(jacobian.shape[1])
    chosen: list[int] = []
    information = ridge.copy()
    for _point in range(count):  # greedy start
        gain = np.einsum("ij,ij->i", jacobian @ np.linalg.inv(information), jacobian)
        chosen.append(int(np.argmax(gain)))
        information = information + np.outer(jacobian[chosen[-1]], jacobian[chosen[-1]])
    for _exchange in range(EXCHANGES):
        best = (1e-9, -1, -1)
        now = float(np.linalg.slogdet(information)[1])
        for place, old in enumerate(chosen):
            without = information - np.outer(jacobian[old], jacobian[old])
            gain = np.linalg.slogdet(without + jacobian[:, :, None] * jacobian[:, None, :])[1] - now
            new = int(np.argmax(gain))
            if gain[new] > best[0]:
                best = (float(gain[new]), place, new)
        if best[1] < 0:
            break
        _gain, place, new = best
        information = (
            information
            + np.outer(jacobian[new], jacobian[new])
            - np.outer(jacobian[chosen[place]], jacobian[chosen[place]])
        )
        chosen[place] = new
    return np.sort(np.array(chosen))


def _jacobian(
    model: Callable[[dict[str, Any], Any], Any], parameters: Mapping[str, float], x: Any
) -> np.ndarray:
    names = list(parameters)

    def flat(vector: Any) -> Any:
        return jnp.ravel(jnp.asarray(model(dict(zip(names, vector, strict=True)), x)))

    found = np.asarray(jax.jacfwd(flat)(jnp.array([float(parameters[n]) for n in names])))
    if not np.all(np.isfinite(found)):
        raise InputError(_("The model has no derivative at some of the candidates."))
    return found
