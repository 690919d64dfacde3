"""``fit``: non-linear least squares with exact derivatives, bounds, robust losses and honest uncertainty."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import scipy
from jax.flatten_util import ravel_pytree

from granum.core.errors import ConvergenceError, InputError
from granum.core.i18n import _
from granum.core.kinds import kind_of
from granum.estimation.diagnostics import diagnose
from granum.estimation.evaluation import Evaluated
from granum.estimation.losses import LeastSquares, Loss
from granum.estimation.results import Estimate, Fit, Parts, derive, freedom, t_reach
from granum.estimation.searches import EXACT, Search
from granum.estimation.verdicts import Rows, no_relation_note, parameter_notes, stray_note

SCALE_ROUNDS = 50
LEAST_SCATTER = 1e-9
"""Of a data set that an equation has made, in the units of y; or a thousandth of the largest beside it."""


@dataclass(frozen=True)
class Problem:
    """A model, data and bounds: everything needed to fit again (profiles, bootstrap)."""

    model: Callable[[dict[str, Any], Any], Any]
    x: Any
    y: np.ndarray
    sigma: np.ndarray
    keep: np.ndarray
    names: tuple[str, ...]
    scale: np.ndarray
    bounds: dict[str, tuple[float, float]]
    loss: Loss
    group: np.ndarray
    kinds: Mapping[str, Any]
    derived: Callable[[dict[str, Any]], Mapping[str, Any]] | None = None
    apart: bool = False
    logarithmic: tuple[str, ...] = ()

    @cached_property
    def _evaluated(self) -> Evaluated:
        return Evaluated(self.model, self.names, self.scale, self.x)

    def prediction(self, q: np.ndarray) -> np.ndarray:
        """Model values at all points, at scaled parameters."""
        return self._evaluated(q)[0]

    def residual(self, q: np.ndarray, y: np.ndarray | None = None) -> np.ndarray:
        """Weighted residuals (model less measured) of the kept points at scaled parameters."""
        return (self._evaluated(q)[0] - (self.y if y is None else y))[self.keep] / self.sigma[self.keep]

    def jacobian(self, q: np.ndarray) -> np.ndarray:
        """Their derivatives with respect to the scaled parameters."""
        return self._evaluated(q)[1][self.keep] / self.sigma[self.keep][:, None]

    def variant(self, **changes: Any) -> Problem:
        """The same model with other data ``y`` or standard deviations ``sigma``; nothing is compiled
        again.
        """
        other = replace(self, **changes)
        other.__dict__["_evaluated"] = self._evaluated
        return other

    def spread(self, values: np.ndarray) -> float:
        """Weighted sum of squares of values at the kept points about the mean of each data set."""
        weight, group, kept = 1.0 / self.sigma[self.keep] ** 2, self.group[self.keep], values[self.keep]
        sums = np.bincount(group, weight)
        means = np.bincount(group, weight * kept) / np.where(sums > 0, sums, 1.0)
        return float(np.sum(weight * (kept - means[group]) ** 2))

    def solve(
        self,
        q: np.ndarray,
        *,
        y: np.ndarray | None = None,
        fixed: Mapping[str, float] | None = None,
        width: float | None = None,
        loss: Loss | None = None,
        without: Sequence[int] = (),
        search: Search = EXACT,
    ) -> tuple[np.ndarray, Any]:
        """Scaled solution and SciPy's outcome, some parameters held, some of the kept points left out.

        ``width`` is the scale of a robust loss, that of the problem unless another is given (None: plain
        squares). ``search``: when to stop, early where the start is near the solution and the answer only
        judges a point.
        """
        held = fixed or {}
        loss = loss or self.loss
        weight = np.ones(int(self.keep.sum()))
        weight[list(without)] = 0.0
        free = np.array([n not in held for n in self.names])
        template = np.array([held.get(n, 0.0) for n in self.names]) / self.scale
        low, high = (np.array([self.bounds[n][side] for n in self.names]) / self.scale for side in (0, 1))

        def whole(part: np.ndarray) -> np.ndarray:
            full = template.copy()
            full[free] = part
            return full

        if not free.any():
            return template, None
        robust = {} if width is None else {"loss": loss.rho, "f_scale": loss.threshold * width}

        def slopes(part: np.ndarray) -> np.ndarray:
            found = weight[:, None] * self.jacobian(whole(part))[:, free]
            if not np.all(np.isfinite(found)):
                last = {n: float(v) for n, v in zip(self.names, whole(part) * self.scale, strict=True)}
                raise ConvergenceError(
                    _("The fit came to values at which the model has no slope: {last}.").format(last=last),
                    last=last,
                )
            return found

        # a trial step may leave what the model can compute; SciPy then takes a shorter one
        with np.errstate(all="ignore"):
            outcome = scipy.optimize.least_squares(
                lambda part: weight * self.residual(whole(part), y),
                np.clip(q, low, high)[free],
                jac=slopes,  # type: ignore[arg-type]
                bounds=(low[free], high[free]),
                **search._asdict(),
                **robust,
            )
        return whole(outcome.x), outcome


def fit(
    model: Callable[[dict[str, Any], Any], Any],
    start: Mapping[str, float],
    x: Any,
    y: Any,
    *,
    sigma: Any = None,
    keep: Any = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    scale: Mapping[str, float] | None = None,
    loss: Loss | None = None,
    kinds: Mapping[str, Any] | None = None,
    derived: Callable[[dict[str, Any]], Mapping[str, Any]] | None = None,
    apart: bool = False,
    logarithmic: tuple[str, ...] = (),
    card: str = "",
    flags: list[dict[str, Any]] | None = None,
    rows: Rows | None = None,
    judged: bool = True,
) -> Fit:
    """Fit ``model(parameters, x)`` to ``y``.

    Parameters
    ----------
    start: first values by name; their size is the scale of each parameter unless ``scale`` gives it.
    x, y: data; ``y`` (and what the model returns) may be a tuple of arrays, one for each joint data set.
    sigma: standard deviation of y, one number, an array or a tuple like y: weights the points and makes joint
        data sets comparable. Its overall size is estimated, not believed.
    keep: True for the points to use, in the order of the ravelled y.
    bounds: lowest and highest value by name; a parameter that ends on its bound is flagged and gets no
        interval.
    loss: ``LeastSquares()``, ``Huber()`` or ``SoftL1()``.
    kinds: kinds of parameters and derived quantities by name, for their units.
    derived: function of the parameters whose results get intervals too.
    apart: whether each data set of a tuple ``y`` has a scatter of its own, found with the fit by restricted
        maximum likelihood (Patterson and Thompson 1971); ``sigma`` then weighs inside each set and starts.
    logarithmic: parameters above zero whose interval is that of their logarithm, where the model bends less
        in it (Bates and Watts 1988, ch. 6).
    rows: the rows of the data behind the points, to name a stray one.
    judged: whether to look for stray points and for a relation; of many models fitted to be ranked only the
        best needs it (``judge``).
    """
    names = tuple(start)
    measured = np.asarray(ravel_pytree(jax.tree.map(lambda v: jnp.asarray(v, dtype=float), y))[0])
    problem = Problem(
        model=model,
        x=x,
        y=measured,
        sigma=_spread(sigma, y),
        names=names,
        loss=loss or LeastSquares(),
        keep=np.ones(measured.shape, bool) if keep is None else np.asarray(ravel_pytree(keep)[0], bool),
        scale=np.array([abs((scale or {}).get(n, 0.0) or start[n]) or 1.0 for n in names]),
        bounds={n: (bounds or {}).get(n, (-np.inf, np.inf)) for n in names},
        derived=derived,
        group=_groups(y),
        kinds=kinds or {},
        apart=apart,
        logarithmic=logarithmic,
    )
    first = np.array([start[n] for n in names]) / problem.scale
    _check(problem, first)
    found = solved(problem, first, card, list(flags or []))
    return judge(found, rows or Rows()) if judged else found


def solved(
    problem: Problem, first: np.ndarray, card: str = "", flags: list[dict[str, Any]] | None = None
) -> Fit:
    """The fit of a problem from scaled first values, without diagnostics: of a ``variant`` with other data
    nothing is compiled again.
    """
    q, width, held = _settle(problem, first)
    if problem.apart:
        problem, q, width, held = _weighed(problem, q, width, held)
    return _conclude(problem, q, width, held, card, flags or [])


def judge(found: Fit, rows: Rows, trials: int = 1) -> Fit:
    """A fit with its diagnostics, and in its flags what they mean; ``trials`` is the number of models among
    which it was chosen.
    """
    problem = found.problem
    diagnostics = diagnose(problem, np.array(list(found.values.values())) / problem.scale, found.held)
    flags = stray_note(diagnostics, found, rows) + no_relation_note(found, diagnostics.probability, trials)
    return replace(found, diagnostics=diagnostics, flags=found.flags + flags)


def _groups(y: Any) -> np.ndarray:
    """Number of the data set of each point."""
    parts = [np.size(part) for part in jax.tree.leaves(y)]
    return np.repeat(np.arange(len(parts)), parts) if max(parts) > 1 else np.zeros(len(parts), int)


def _spread(sigma: Any, y: Any) -> np.ndarray:
    like = jax.tree.map(lambda v: jnp.ones(jnp.shape(v)), y)
    if sigma is None:
        spread = like
    elif jax.tree.structure(sigma) == jax.tree.structure(y):
        spread = jax.tree.map(lambda s, ones: s * ones, sigma, like)
    else:
        spread = jax.tree.map(lambda ones: sigma * ones, like)
    found = np.asarray(ravel_pytree(spread)[0])
    if not np.all(found > 0):
        raise InputError(_("Standard deviations of the data must be greater than zero."))
    return found


def _check(problem: Problem, first: np.ndarray) -> None:
    used, count = int(problem.keep.sum()), len(problem.names)
    if used <= count:
        raise InputError(
            _("{used} usable points are too few to fit {count} parameters: give at least {least}.").format(
                used=used, count=count, least=count + 1
            )
        )
    for name, (low, high) in problem.bounds.items():
        if not low < high:
            raise InputError(
                _("The points leave no room for '{name}', which would lie between {low} and {high}.").format(
                    name=name, low=f"{low:g}", high=f"{high:g}"
                ),
                name=name,
            )
    if not np.all(np.isfinite(problem.y)):
        raise InputError(_("The data contain values that are not finite numbers."))
    if not (np.all(np.isfinite(first)) and np.all(np.isfinite(problem.residual(first)))):
        start = {n: float(v) for n, v in zip(problem.names, first * problem.scale, strict=True)}
        raise InputError(_("The model has no finite value at the start values {start}.").format(start=start))


def _settle(problem: Problem, q: np.ndarray) -> tuple[np.ndarray, float | None, dict[str, float]]:
    """Scaled solution, scale of the residuals of a robust loss, and parameters that ended on a bound."""
    held: dict[str, float] = {}
    width: float | None = None
    while True:
        q, width = _solve(problem, q, held)
        reached = {}
        for name, value, size in zip(problem.names, q, problem.scale, strict=True):
            for bound in problem.bounds[name]:
                if (
                    name not in held
                    and np.isfinite(bound)
                    and abs(value - bound / size) <= 1e-7 * max(1.0, abs(bound / size))
                ):
                    reached[name] = bound
        if not reached or len(held) + len(reached) >= len(problem.names):
            return q, width, held | reached
        held |= reached


def _weighed(
    problem: Problem, q: np.ndarray, width: float | None, held: dict[str, float]
) -> tuple[Problem, np.ndarray, float | None, dict[str, float]]:
    """The problem with the scatter of each data set as the fit leaves it, and its solution."""
    for _round in range(SCALE_ROUNDS):
        group, spare = problem.group[problem.keep], _spare(problem, q, held)
        squares = np.bincount(group, problem.residual(q) ** 2, len(spare))
        sizes = np.sqrt(squares / np.maximum(spare, 0.5))
        # residuals are in units of sigma; the floor is in those of y
        unit = np.array([np.mean(problem.sigma[problem.group == g]) for g in range(len(spare))])
        least = max(LEAST_SCATTER, 1e-3 * float(np.max(sizes * unit)))
        sizes = np.maximum(sizes, least / unit)
        problem = problem.variant(sigma=problem.sigma * sizes[problem.group])
        q, width, held = _settle(problem, q)
        if np.all(np.abs(sizes - 1.0) < 1e-3):
            break
    return problem, q, width, held


def _spare(problem: Problem, q: np.ndarray, held: Mapping[str, float]) -> np.ndarray:
    """Points of each data set less what the free parameters take of it: the trace of its leverages."""
    group = problem.group[problem.keep]
    free = np.array([n not in held for n in problem.names])
    basis = np.linalg.svd(problem.jacobian(q)[:, free], full_matrices=False)[0]
    return np.bincount(group) - np.bincount(group, np.sum(basis**2, axis=1))


def _solve(problem: Problem, q: np.ndarray, held: Mapping[str, float]) -> tuple[np.ndarray, float | None]:
    q, outcome = problem.solve(q, fixed=held)
    width = None
    if problem.loss.robust:
        for _round in range(SCALE_ROUNDS):
            size = np.abs(problem.residual(q))
            new = max(1.4826 * float(np.median(size)), 1e-12 * float(np.max(size)), 1e-100)
            settled = width is not None and abs(new - width) <= 1e-8 * new
            width = new
            if settled:
                break
            q, outcome = problem.solve(q, fixed=held, width=width)
    if outcome is None or not outcome.success:
        last = {n: float(v) for n, v in zip(problem.names, q * problem.scale, strict=True)}
        raise ConvergenceError(
            _("The fit did not converge; last values {last}.").format(last=last), last=last
        )
    return q, width


def _conclude(
    problem: Problem,
    q: np.ndarray,
    width: float | None,
    held: Mapping[str, float],
    card: str,
    flags: list[dict[str, Any]],
) -> Fit:
    names, scale, kinds = problem.names, problem.scale, problem.kinds
    values = {n: float(held.get(n, v)) for n, v in zip(names, q * scale, strict=True)}
    residual, jacobian = problem.residual(q), problem.jacobian(q)
    free = np.array([n not in held for n in names])
    used, dof = residual.size, residual.size - int(free.sum())
    lengths = np.linalg.norm(jacobian, axis=0)
    lengths = np.where(lengths > 0.0, lengths, 1.0)
    _u, singular, rotation = np.linalg.svd(jacobian[:, free] / lengths[free], full_matrices=False)
    condition = float(singular[0] / singular[-1]) if singular.size and singular[-1] > 0 else np.inf
    squares = float(residual @ residual)
    variance = (
        squares / dof if width is None else _robust_variance(problem.loss, residual, width, int(free.sum()))
    )
    covariance = np.zeros((len(names), len(names)))
    if condition < 1e12:
        inverse = (rotation.T / singular**2) @ rotation
        covariance[np.ix_(free, free)] = (
            variance * inverse * np.outer((scale / lengths)[free], (scale / lengths)[free])
        )
    else:
        covariance[np.ix_(free, free)] = np.nan
    parts = None
    if problem.apart and condition < 1e12:
        parts, more = _parts(problem, q, held, covariance)
        covariance = covariance + more
    units = {n: kind.unit for n, annotation in kinds.items() if (kind := kind_of(annotation))}
    parameters = {}
    for i, n in enumerate(names):
        reach = t_reach(0.95, freedom(np.eye(len(names))[i], parts, dof))
        error = np.nan if n in held else float(np.sqrt(covariance[i, i]))
        parameters[n] = Estimate(values[n], units.get(n, ""), error).within(
            error, reach, n in problem.logarithmic
        )
    whole = problem.prediction(q)
    spread = problem.spread(problem.y)
    count = int(free.sum()) + 1
    correction = 2.0 * count * (count + 1) / (used - count - 1) if used > count + 1 else np.inf
    statistics = {
        "rmse": float(np.sqrt(np.mean((residual * problem.sigma[problem.keep]) ** 2))),
        "r_squared": 1.0 - squares / spread if spread > 0 else np.nan,
        "aicc": used * float(np.log(squares / used)) + 2 * count + correction if squares > 0 else -np.inf,
        "degrees_of_freedom": dof,
        "points": used,
        "points_excluded": int((~problem.keep).sum()),
        "residual_standard_deviation": float(np.sqrt(variance)),
        "condition": condition,
    }
    flags += parameter_notes(parameters, covariance, held, condition, problem, card)
    found = {} if problem.derived is None else derive(problem.derived, values, covariance, dof, units, parts)
    return Fit(
        card,
        parameters,
        covariance,
        problem.y - whole,
        problem.keep,
        statistics,
        found,
        flags,
        problem,
        tuple(held),
        parts=parts,
    )


def _parts(
    problem: Problem, q: np.ndarray, held: Mapping[str, float], covariance: np.ndarray
) -> tuple[Parts, np.ndarray]:
    """What the scatter of each data set adds to the covariance, and how much more there is because weights
    were made of scatters that are not known exactly (Kenward and Roger 1997, eq. 3 to 5).
    """
    group = problem.group[problem.keep]
    slopes = problem.jacobian(q) / problem.scale * np.array([n not in held for n in problem.names])
    weights = np.stack([slopes[group == g].T @ slopes[group == g] for g in range(group.max() + 1)])
    taken = covariance @ weights
    both = np.einsum("gij,hji->gh", taken, taken)
    own = np.bincount(group) - 2.0 * np.trace(taken, axis1=1, axis2=2)
    variances = 2.0 * np.linalg.inv(both + np.diag(own))
    lost = np.einsum("gg,gij->ij", variances, weights) - np.einsum(
        "gh,gij,hjk->ik", variances, weights, covariance @ weights
    )
    parts = Parts(taken @ covariance, variances)
    return parts, 2.0 * covariance @ lost @ covariance


def _robust_variance(loss: Loss, residual: np.ndarray, width: float, count: int) -> float:
    """Huber's estimate of the variance that takes the place of s² in the covariance (Huber 1981, § 7.6)."""
    psi, slope = loss.influence(residual / width)
    mean = float(np.mean(slope))
    correction = 1.0 + count / residual.size * float(np.var(slope)) / mean**2
    return correction**2 * width**2 * float(psi @ psi) / (residual.size - count) / mean**2
