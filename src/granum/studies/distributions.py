"""Uncertain inputs: distributions, and the joint uncertainty of a fit. Each turns numbers between 0 and
1 into SI values.

Every source takes its own columns of the unit cube, so that random, Latin-hypercube and Sobol points all
serve alike.
"""

from __future__ import annotations

import abc
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy

from granum.core.conversion import convert
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.core.kinds import KINDS, Kind
from granum.core.parameters import Parameter
from granum.estimation import Fit
from granum.estimation.results import by_fit

EDGE = 1e-12
"""Numbers are kept this far from 0 and 1, where a normal distribution is infinite."""


class Source(abc.ABC):
    """One independent source of uncertainty, giving values to one or several inputs."""

    names: tuple[str, ...]

    @property
    def dimensions(self) -> int:
        """How many columns of the unit cube it takes."""
        return 1

    @abc.abstractmethod
    def values(self, u: np.ndarray) -> np.ndarray:
        """Values (n, names) for points (n, dimensions) of the unit cube."""

    @abc.abstractmethod
    def centers(self) -> np.ndarray:
        """The value of each input in the middle: median or estimate."""

    @abc.abstractmethod
    def as_json(self) -> dict[str, Any]:
        """Plain data."""


@dataclass(frozen=True)
class Marginal(Source):
    """One input with a distribution of its own, a frozen one of SciPy, that may be cut at both ends."""

    name: str
    law: str
    numbers: dict[str, float]
    frozen: Any
    lower: float = -np.inf
    upper: float = np.inf

    @property
    def names(self) -> tuple[str, ...]:  # type: ignore[override]
        """The input it gives."""
        return (self.name,)

    def values(self, u: np.ndarray) -> np.ndarray:
        u = np.clip(u, EDGE, 1.0 - EDGE)
        low, high = self.frozen.cdf([self.lower, self.upper])
        return self.frozen.ppf(low + u * (high - low))

    def centers(self) -> np.ndarray:
        return self.values(np.array([[0.5]]))[0]

    def as_json(self) -> dict[str, Any]:
        limits = {k: v for k, v in (("lower", self.lower), ("upper", self.upper)) if np.isfinite(v)}
        return {"inputs": [self.name], "distribution": self.law, **self.numbers, **limits}


@dataclass(frozen=True)
class FromFit(Source):
    """The joint uncertainty of the parameters of a fit (multivariate Student t), and of what is derived from
    them.
    """

    names: tuple[str, ...]
    estimates: tuple[str, ...]
    fit: Fit

    @property
    def dimensions(self) -> int:
        """One number for each parameter and one for the spread that is itself estimated."""
        return len(self.fit.values) + 1

    def values(self, u: np.ndarray) -> np.ndarray:
        u = np.clip(u, EDGE, 1.0 - EDGE)
        dof = self.fit.degrees_of_freedom
        drawn = self.fit.at_normal(
            scipy.special.ndtri(u[:, :-1]), np.sqrt(scipy.stats.chi2.ppf(u[:, -1], dof) / dof)
        )
        known = {**drawn, **self.fit.derived_from(drawn)}
        return np.stack([known[n] for n in self.estimates], axis=1)

    def centers(self) -> np.ndarray:
        return np.array([self.fit[n].value for n in self.estimates])

    def as_json(self) -> dict[str, Any]:
        return {
            "inputs": list(self.names),
            "distribution": "fit",
            "card": self.fit.card,
            "estimates": list(self.estimates),
        }


def from_fits(wanted: Mapping[str, tuple[Fit, str]]) -> list[Source]:
    """Sources for inputs that come from fits; those of one fit stay together, so that their correlation is
    kept.
    """
    sources: list[Source] = []
    for found, mine in by_fit(wanted):
        for name in mine.values():
            estimate = found[name]
            if not np.isfinite(estimate.standard_error):
                raise InputError(
                    _(
                        "'{name}' of the fit {card} has no standard error: the data do not determine it."
                    ).format(name=name, card=found.card)
                )
        sources.append(FromFit(tuple(mine), tuple(mine.values()), found))
    return sources


LAWS = {
    "normal": {"mean", "standard_deviation", "relative_standard_deviation", "lower", "upper"},
    "lognormal": {
        "median",
        "geometric_standard_deviation",
        "mean",
        "standard_deviation",
        "relative_standard_deviation",
        "lower",
        "upper",
    },
    "uniform": {"lower", "upper"},
    "loguniform": {"lower", "upper"},
    "triangular": {"lower", "mode", "upper"},
}


def distribution(name: str, table: Mapping[str, Any], parameter: Parameter) -> Marginal:
    """The distribution a table declares for one input, such as ``{distribution = "normal", mean = "28 degC",
    standard_deviation = "0.5 K"}``.

    ``normal``: mean and standard_deviation (or relative_standard_deviation), optionally cut at lower and
        upper.
    ``lognormal``: median and geometric_standard_deviation, or mean and standard_deviation. ``uniform``,
        ``loguniform``:
    lower, upper. ``triangular``: lower, mode, upper.
    """
    where = _("in [uncertain] for '{name}'").format(name=name)
    given = dict(table)
    law = given.pop("distribution", None)
    if law not in LAWS:
        raise unknown_name(_("Distribution"), str(law or ""), LAWS, where)
    for key in given:
        if key not in LAWS[law]:
            raise unknown_name(_("Key"), key, LAWS[law], where)
    read = {key: _number(key, value, parameter, where) for key, value in given.items()}
    if "lower" in read and "upper" in read and not read["lower"] < read["upper"]:
        raise InputError(_("{where}: 'lower' must be below 'upper'.").format(where=where), name=name)
    try:
        return _MAKERS[law](name, read, where)
    except KeyError as missing:
        raise InputError(
            _("{where}: a {law} distribution needs '{key}'.").format(
                where=where, law=law, key=missing.args[0]
            ),
            name=name,
        ) from None


def _number(key: str, value: Any, parameter: Parameter, where: str) -> float:
    kind = parameter.kind or KINDS["Number"]
    if key in ("relative_standard_deviation", "geometric_standard_deviation"):
        kind = KINDS["PositiveNumber"]
    elif key == "standard_deviation":
        kind = (
            KINDS["TemperatureDifference"]
            if kind.unit == "K"
            else Kind(kind.name, kind.unit, 0.0, open_lower=True, display=kind.display)
        )
    return float(
        convert(
            value,
            Parameter(f"{parameter.name} ({key})" if key == "standard_deviation" else parameter.name, kind),
            " " + where,
        )
    )


def _spread(read: dict[str, float], where: str) -> float:
    if "relative_standard_deviation" in read:
        return abs(read["mean"]) * read["relative_standard_deviation"]
    if read["standard_deviation"] <= 0:
        raise InputError(_("{where}: 'standard_deviation' must be greater than zero.").format(where=where))
    return read["standard_deviation"]


def _limits(read: dict[str, float]) -> dict[str, float]:
    return {key: read[key] for key in ("lower", "upper") if key in read}


def _normal(name: str, read: dict[str, float], where: str) -> Marginal:
    mean, spread = read["mean"], _spread(read, where)
    return Marginal(
        name,
        "normal",
        {"mean": mean, "standard_deviation": spread},
        scipy.stats.norm(mean, spread),
        **_limits(read),
    )


def _lognormal(name: str, read: dict[str, float], where: str) -> Marginal:
    if "mean" in read:
        variance = np.log1p((_spread(read, where) / read["mean"]) ** 2)
        median, sigma = read["mean"] * np.exp(-variance / 2.0), float(np.sqrt(variance))
    else:
        median, sigma = read["median"], float(np.log(read["geometric_standard_deviation"]))
    if median <= 0 or sigma <= 0:
        raise InputError(
            _(
                "{where}: a lognormal distribution needs a positive value and a geometric standard "
                "deviation above 1."
            ).format(where=where)
        )
    numbers = {"median": float(median), "geometric_standard_deviation": float(np.exp(sigma))}
    return Marginal(name, "lognormal", numbers, scipy.stats.lognorm(sigma, scale=median), **_limits(read))


def _uniform(name: str, read: dict[str, float], where: str) -> Marginal:
    low, high = read["lower"], read["upper"]
    return Marginal(name, "uniform", {"lower": low, "upper": high}, scipy.stats.uniform(low, high - low))


def _loguniform(name: str, read: dict[str, float], where: str) -> Marginal:
    low, high = read["lower"], read["upper"]
    if low <= 0:
        raise InputError(
            _("{where}: 'lower' of a loguniform distribution must be greater than zero.").format(where=where)
        )
    return Marginal(name, "loguniform", {"lower": low, "upper": high}, scipy.stats.loguniform(low, high))


def _triangular(name: str, read: dict[str, float], where: str) -> Marginal:
    low, mode, high = read["lower"], read["mode"], read["upper"]
    if not low <= mode <= high:
        raise InputError(_("{where}: 'mode' must lie between 'lower' and 'upper'.").format(where=where))
    numbers = {"lower": low, "mode": mode, "upper": high}
    return Marginal(
        name, "triangular", numbers, scipy.stats.triang((mode - low) / (high - low), low, high - low)
    )


_MAKERS = {
    "normal": _normal,
    "lognormal": _lognormal,
    "uniform": _uniform,
    "loguniform": _loguniform,
    "triangular": _triangular,
}
