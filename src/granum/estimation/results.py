"""What a fit gives: estimates with intervals, covariance, statistics, bands, samples, and the stable JSON
shape.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import scipy
from jax.flatten_util import ravel_pytree

from granum.core import notebooks
from granum.core.errors import unknown_name
from granum.core.i18n import _

if TYPE_CHECKING:
    import pandas as pd

    from granum.estimation.diagnostics import Diagnostics
    from granum.estimation.intervals import Profile
    from granum.estimation.least_squares import Problem


@dataclass(frozen=True)
class Estimate:
    """One estimated quantity, SI: value, standard error and 95 % t-interval."""

    value: float
    unit: str = ""
    standard_error: float = np.nan
    interval_95: tuple[float, float] = (np.nan, np.nan)

    def within(self, standard_error: float, reach: float, logarithmic: bool = False) -> Estimate:
        """The same value with another standard error, and the interval of as many of them to either side, or
        of its logarithm.
        """
        value, half = self.value, reach * standard_error
        if logarithmic and value > 0.0:
            times = float(np.exp(half / value))
            return Estimate(value, self.unit, standard_error, (value / times, value * times))
        return Estimate(value, self.unit, standard_error, (value - half, value + half))

    def as_json(self) -> dict[str, Any]:
        """Plain data; what is not known is null."""
        low, high = map(_number, self.interval_95)
        return {
            "value": _number(self.value),
            "unit": self.unit,
            "standard_error": _number(self.standard_error),
            "interval_95": [low, high],
        }


class Parts(NamedTuple):
    """Of a fit whose data sets have scatters of their own: what each adds to the covariance, and the
    covariance of their variances, each over its variance.
    """

    covariances: np.ndarray
    variances: np.ndarray


class Band(NamedTuple):
    """Model values with the lower and upper edge of their band."""

    value: np.ndarray
    low: np.ndarray
    high: np.ndarray


def by_fit(wanted: Mapping[str, tuple[Fit, str]]) -> list[tuple[Fit, dict[str, str]]]:
    """Each fit once, with the inputs that take a number from it and its name there."""
    found: list[tuple[Fit, dict[str, str]]] = []
    for path, (fit, name) in wanted.items():
        given = next((given for known, given in found if known is fit), None)
        if given is None:
            found.append((fit, given := {}))
        given[path] = name
    return found


@dataclass(frozen=True)
class Fit:
    """The outcome of a fit.

    Parameters
    ----------
    parameters: estimates by name.
    covariance: of the parameters in that order; rows of parameters held at a bound are zero.
    residuals: measured less model, in the units of y (all points; see ``kept``).
    kept: which points were used.
    statistics: rmse, r_squared, aicc, degrees_of_freedom, points, condition, residual_standard_deviation …
    derived: quantities computed from the parameters, with intervals by the delta method.
    flags: records with a word and a sentence.
    held: parameters that ended on a bound.
    diagnostics: leverage and influence of every point, stray points, and whether there is a relation at all.
    defaults: conditions and choices that were not given, with the values taken, as plain data by name.
    ranges: lowest and highest value of each condition and column that the estimates hold for, by name.
    origins: conditions that a stated fluid gave, each with its value and what the fluid says of itself.
    parts: of the covariance, by data set, where each has a scatter of its own.
    """

    card: str
    parameters: dict[str, Estimate]
    covariance: np.ndarray
    residuals: np.ndarray
    kept: np.ndarray
    statistics: dict[str, float]
    derived: dict[str, Estimate]
    flags: list[dict[str, Any]]
    problem: Problem = field(repr=False)
    held: tuple[str, ...] = ()
    diagnostics: Diagnostics | None = field(default=None, repr=False)
    defaults: Mapping[str, Any] = field(default_factory=dict)
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    origins: Mapping[str, tuple[float, str]] = field(default_factory=dict)
    parts: Parts | None = field(default=None, repr=False)

    def __getitem__(self, name: str) -> Estimate:
        found = {**self.derived, **self.parameters}
        if name not in found:
            raise unknown_name(_("Estimate"), name, found)
        return found[name]

    @property
    def values(self) -> dict[str, float]:
        """Parameter values by name."""
        return {name: estimate.value for name, estimate in self.parameters.items()}

    @property
    def correlation(self) -> np.ndarray:
        """Correlation matrix of the parameters; NaN for one held at a bound."""
        deviation = np.sqrt(np.diag(self.covariance))
        with np.errstate(invalid="ignore", divide="ignore"):
            return self.covariance / np.outer(deviation, deviation)

    def predict(self, x: Any, *, level: float = 0.95, observation: bool = False) -> Band:
        """Model values at ``x`` with the band of the mean, or of a new observation (constant scatter)."""
        flat, unravel = ravel_pytree({n: float(v) for n, v in self.values.items()})
        order = _order(self.values)

        def model(vector: Any) -> Any:
            return ravel_pytree(self.problem.model(unravel(vector), x))[0]

        value, slope = model(flat), jax.jacfwd(model)(flat)
        variance = jnp.einsum("ij,jk,ik->i", slope, self.covariance[np.ix_(order, order)], slope)
        if observation:
            variance = variance + self.statistics["residual_standard_deviation"] ** 2
        reach = np.asarray(jnp.sqrt(variance)) * t_reach(level, self.degrees_of_freedom)
        return Band(np.asarray(value), np.asarray(value) - reach, np.asarray(value) + reach)

    def derive(
        self, function: Callable[[dict[str, Any]], Mapping[str, Any]], units: Mapping[str, str] | None = None
    ) -> dict[str, Estimate]:
        """Quantities computed from the parameters, with intervals by the delta method."""
        return derive(
            function, self.values, self.covariance, self.degrees_of_freedom, units or {}, self.parts
        )

    @property
    def degrees_of_freedom(self) -> float:
        """On which the covariance is known: of the least known parameter where data sets have scatters of
        their own.
        """
        spare = self.statistics["degrees_of_freedom"]
        rows = np.eye(len(self.parameters))
        return min((freedom(row, self.parts, spare) for row in rows), default=spare)

    def at_normal(self, normal: np.ndarray, shrink: np.ndarray) -> dict[str, np.ndarray]:
        """Parameters for standard normal numbers (n, parameters) and the square root of chi² per degree of
        freedom (n,).
        """
        drawn = (
            np.array(list(self.values.values())) + normal @ _square_root(self.covariance).T / shrink[:, None]
        )
        return dict(zip(self.values, drawn.T, strict=True))

    def derived_from(self, draws: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        """The derived quantities for many values of the parameters at once."""
        function = self.problem.derived
        if function is None:
            return {}
        found = jax.jit(jax.vmap(lambda p: dict(function(p))))({n: jnp.asarray(v) for n, v in draws.items()})
        return {n: np.asarray(v) for n, v in found.items()}

    def sample(self, count: int, seed: int = 0) -> dict[str, np.ndarray]:
        """Draws from the joint distribution of the parameters (multivariate t), kept inside their bounds."""
        rng = np.random.default_rng(seed)
        center = np.array(list(self.values.values()))
        dof = self.degrees_of_freedom
        low, high = (
            np.array(side) for side in zip(*(self.problem.bounds[n] for n in self.values), strict=True)
        )
        kept = np.empty((0, len(center)))
        for _round in range(100):
            normal = rng.standard_normal((count, len(center)))
            drawn = np.stack(
                list(self.at_normal(normal, np.sqrt(rng.chisquare(dof, count) / dof)).values()), axis=1
            )
            kept = np.concatenate([kept, drawn[((drawn >= low) & (drawn <= high)).all(axis=1)]])
            if len(kept) >= count:
                break
        return dict(zip(self.values, kept[:count].T, strict=True))

    def ellipse(
        self, one: str, other: str, level: float = 0.95, points: int = 100
    ) -> tuple[np.ndarray, np.ndarray]:
        """Outline of the joint confidence region of two parameters (linear approximation, F distribution)."""
        names = list(self.parameters)
        for name in (one, other):
            if name not in names:
                raise unknown_name(_("Parameter"), name, names)
        pair = [names.index(one), names.index(other)]
        angle = np.linspace(0.0, 2.0 * np.pi, points)
        reach = np.sqrt(2.0 * scipy.stats.f.ppf(level, 2, self.degrees_of_freedom))
        x, y = (
            reach
            * _square_root(self.covariance[np.ix_(pair, pair)])
            @ np.stack([np.cos(angle), np.sin(angle)])
        )
        return self[one].value + x, self[other].value + y

    def profile(self, name: str, points: int = 21) -> Profile:
        """Profile likelihood of one parameter; see ``granum.estimation.intervals.profile``."""
        from granum.estimation.intervals import profile

        return profile(self, name, points)

    def by_profile(self, name: str) -> Fit:
        """The same fit with the interval of one parameter from its profile, which follows the bend of the
        model; as before where that has no end.
        """
        estimate = self.parameters[name]
        if name in self.held or not np.isfinite(estimate.standard_error):
            return self
        ends = self.profile(name, points=2).interval_95
        kept = [new if np.isfinite(new) else old for new, old in zip(ends, estimate.interval_95, strict=True)]
        return replace(
            self, parameters=self.parameters | {name: replace(estimate, interval_95=(kept[0], kept[1]))}
        )

    def bootstrap(self, count: int = 500, seed: int = 0) -> Mapping[str, np.ndarray]:
        """Parameters refitted to resampled residuals; see ``granum.estimation.intervals.bootstrap``."""
        from granum.estimation.intervals import bootstrap

        return bootstrap(self, count, seed)

    def _repr_html_(self) -> str:
        return notebooks.shown("granum.reports.terminal:print_fit", self)

    def to_pandas(self) -> pd.DataFrame:
        """Parameters and what follows from them, one a row: value in SI, unit, standard error, ends of the
        95 % interval.
        """
        import pandas as pd

        groups = ((self.parameters, False), (self.derived, True))
        rows = [
            (n, e.value, e.unit, e.standard_error, *e.interval_95, derived)
            for found, derived in groups
            for n, e in found.items()
        ]
        return pd.DataFrame(
            rows, columns=["name", "value", "unit", "standard_error", "low", "high", "derived"]
        ).set_index("name")

    def as_json(self) -> dict[str, Any]:
        """The stable ``fit`` shape."""
        return {
            "card": self.card,
            "parameters": {name: e.as_json() for name, e in self.parameters.items()},
            "derived": {name: e.as_json() for name, e in self.derived.items()},
            "statistics": {name: _number(value) for name, value in self.statistics.items()},
            "flags": self.flags,
            "diagnostics": self.diagnostics.as_json() if self.diagnostics else None,
            "defaults": dict(self.defaults),
            "ranges": {name: [_number(low), _number(high)] for name, (low, high) in self.ranges.items()},
            "from": {
                name: {"value": _number(value), "origin": origin}
                for name, (value, origin) in self.origins.items()
            },
        }


def derive(
    function: Callable[[dict[str, Any]], Mapping[str, Any]],
    values: Mapping[str, float],
    covariance: np.ndarray,
    degrees_of_freedom: float,
    units: Mapping[str, str],
    parts: Parts | None = None,
) -> dict[str, Estimate]:
    """Delta method: value, standard error and t-interval of any function of the parameters."""
    names = list(values)
    vector = jnp.array([values[n] for n in names])

    slopes, out = (
        _derived_for_all(function, tuple(names), vector)
        if isinstance(function, eqx.Module)
        else jax.jit(partial(_derived, function, tuple(names)))(vector)
    )
    found = {}
    for name, value in out.items():
        row = np.asarray(slopes[name])
        error = float(np.sqrt(max(row @ covariance @ row, 0.0)))
        reach = t_reach(0.95, freedom(row, parts, degrees_of_freedom))
        found[name] = Estimate(float(value), units.get(name, "")).within(error, reach)
    return found


def freedom(row: np.ndarray, parts: Parts | None, otherwise: float) -> float:
    """Degrees of freedom of a linear combination of parameters whose variance is a sum of parts, none of them
    known exactly (Satterthwaite 1946; Kenward and Roger 1997).
    """
    if parts is None:
        return otherwise
    shares = np.einsum("i,gij,j->g", row, parts.covariances, row)
    return (
        float(2.0 * shares.sum() ** 2 / (shares @ parts.variances @ shares))
        if shares.sum() > 0
        else otherwise
    )


def _derived(function: Any, names: tuple[str, ...], vector: Any) -> tuple[Any, Any]:
    def flat(v: Any) -> tuple[dict[str, Any], dict[str, Any]]:
        found = dict(function(dict(zip(names, v, strict=True))))
        return found, found

    return jax.jacfwd(flat, has_aux=True)(vector)


_derived_for_all = eqx.filter_jit(_derived)  # of a module, with its numbers as arrays, compiled once


def t_reach(level: float, degrees_of_freedom: float) -> float:
    """How many standard errors a two-sided interval reaches (Student)."""
    return (
        float(scipy.stats.t.ppf(0.5 + level / 2.0, degrees_of_freedom)) if degrees_of_freedom >= 1 else np.nan
    )


def _order(values: Mapping[str, float]) -> list[int]:
    """Position in ``values`` of each entry of the ravelled dict (JAX sorts keys)."""
    names = list(values)
    return [names.index(name) for name in sorted(names)]


def _square_root(matrix: np.ndarray) -> np.ndarray:
    scale = np.sqrt(np.diag(matrix))
    safe = np.where(scale > 0, scale, 1.0)
    weights, vectors = np.linalg.eigh(matrix / np.outer(safe, safe))
    # The symmetric root: the sign of a single eigenvector is the machine's choice, and so would the draws be.
    return scale[:, None] * (vectors * np.sqrt(np.maximum(weights, 0.0))) @ vectors.T


def _number(value: float) -> float | None:
    return value if isinstance(value, int) else float(value) if np.isfinite(value) else None
