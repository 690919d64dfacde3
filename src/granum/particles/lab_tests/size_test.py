"""What the size analyses share: a measured distribution, its means, and a law fitted to its cumulative
curve.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import replace
from math import inf, log
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple

import numpy as np

from granum.core.kinds import (
    Fraction,
    Length,
    PositiveNumber,
    Ratio,
    SpecificSurface,
    SpecificSurfaceMass,
    kind_of,
)
from granum.estimation import Estimate, Fit, LabTest
from granum.particles.class_means import SizeSummary, summary_of
from granum.particles.distributions import SizeDistribution
from granum.particles.lab_tests.class_verdicts import judged_by_class
from granum.particles.size_laws import (
    GatesGaudinSchuhmann,
    GaudinMeloy,
    LogNormal,
    Mixture,
    Normal,
    RosinRammler,
    SizeLaw,
)

if TYPE_CHECKING:
    import plotly.graph_objects as go

SizeLawName = Literal[
    "rosin_rammler", "log_normal", "normal", "gates_gaudin_schuhmann", "gaudin_meloy", "mixture"
]


class Recipe(NamedTuple):
    """How a law is built from estimates, and where its fit starts on a measured distribution."""

    build: Callable[[dict[str, Any], str], SizeLaw]
    start: Callable[[SizeDistribution], dict[str, float]]
    bounds: Mapping[str, tuple[float, float]] = {}


def _percentile(d: SizeDistribution, part: float) -> float:
    return float(d.percentile(part))


def _spread(d: SizeDistribution) -> float:
    return max(log(_percentile(d, 0.9) / max(_percentile(d, 0.1), 1e-12)), 1e-3)


def _two_log_normals(p: dict[str, Any], basis: Any) -> SizeLaw:
    fine, coarse = (
        LogNormal(p[f"median_diameter_{n}"], p[f"geometric_standard_deviation_{n}"], basis)
        for n in ("fine", "coarse")
    )
    return Mixture(fine, coarse, p["first_share"])


RECIPES: dict[str, Recipe] = {
    "rosin_rammler": Recipe(
        lambda p, basis: RosinRammler(p["size_modulus"], p["distribution_exponent"], basis),
        lambda d: {"size_modulus": _percentile(d, 0.632), "distribution_exponent": 3.0844 / _spread(d)},
    ),
    "log_normal": Recipe(
        lambda p, basis: LogNormal(p["median_diameter"], p["geometric_standard_deviation"], basis),
        lambda d: {
            "median_diameter": _percentile(d, 0.5),
            "geometric_standard_deviation": float(np.exp(_spread(d) / 2.5631)),
        },
    ),
    "normal": Recipe(
        lambda p, basis: Normal(p["mean_diameter"], p["standard_deviation"], basis),
        lambda d: {
            "mean_diameter": _percentile(d, 0.5),
            "standard_deviation": (_percentile(d, 0.9) - _percentile(d, 0.1)) / 2.5631,
        },
    ),
    "gates_gaudin_schuhmann": Recipe(
        lambda p, basis: GatesGaudinSchuhmann(p["size_maximum"], p["distribution_exponent"], basis),
        lambda d: {"size_maximum": _percentile(d, 0.95), "distribution_exponent": 2.1972 / _spread(d)},
    ),
    "gaudin_meloy": Recipe(
        lambda p, basis: GaudinMeloy(p["size_maximum"], p["distribution_exponent"], basis),
        lambda d: {
            "size_maximum": 1.1 * _percentile(d, 1.0),
            "distribution_exponent": max(
                log(0.5) / log(1.0 - _percentile(d, 0.5) / (1.1 * _percentile(d, 1.0))), 1.1
            ),
        },
        {"distribution_exponent": (1.0, inf)},  # below 1 the density has a pole at the largest size
    ),
    "mixture": Recipe(
        _two_log_normals,
        lambda d: {
            "median_diameter_fine": _percentile(d, 0.2),
            "geometric_standard_deviation_fine": 1.5,
            "median_diameter_coarse": _percentile(d, 0.75),
            "geometric_standard_deviation_coarse": 1.5,
            "first_share": 0.5,
        },
    ),
}

_BOUNDS = {
    "first_share": (0.0, 1.0),
    "geometric_standard_deviation": (1.001, 1e3),
    "geometric_standard_deviation_fine": (1.001, 1e3),
    "geometric_standard_deviation_coarse": (1.001, 1e3),
}
FIGURES: dict[str, Any] = {
    "mean_diameter_surface_volume": Length,
    "mean_diameter_mass": Length,
    "mean_diameter_number_length": Length,
    "percentile_10": Length,
    "percentile_50": Length,
    "percentile_90": Length,
    "size_span": Ratio,
    "specific_surface": SpecificSurface,
    "unmeasured_fraction": Fraction,
}


class SizeTest(LabTest):
    """A size analysis: the measured distribution says the means and percentiles, the fitted law the
    parameters with intervals.
    """

    estimates: ClassVar = {
        "size_modulus": Length,
        "distribution_exponent": PositiveNumber,
        "median_diameter": Length,
        "geometric_standard_deviation": PositiveNumber,
        "mean_diameter": Length,
        "standard_deviation": Length,
        "size_maximum": Length,
        "median_diameter_fine": Length,
        "median_diameter_coarse": Length,
        "geometric_standard_deviation_fine": PositiveNumber,
        "geometric_standard_deviation_coarse": PositiveNumber,
        "first_share": Fraction,
        "specific_surface_mass": SpecificSurfaceMass,
        **FIGURES,
    }
    axes: ClassVar = {"particle_diameter": Length, "cumulative_fraction": Fraction}

    if TYPE_CHECKING:
        size_law: str
        solid_density: float

    @abstractmethod
    def distribution(self) -> SizeDistribution:
        """The measured classes."""

    @abstractmethod
    def points(self) -> tuple[Any, Any]:
        """Sizes and measured cumulative fractions to which the law is fitted."""

    def class_rows(self) -> np.ndarray | None:
        """Row of the data of each class: below the first point, between the points, above the last; -1 where
        there is none.

        None where a row is not a class, so that the points of the curve are judged themselves.
        """
        return None

    def notices(self) -> list[dict[str, Any]]:
        """Flags of the measurement."""
        return []

    def summary(self) -> SizeSummary:
        """Means, percentiles, span and specific surface of the measured classes, no law assumed."""
        return summary_of(self.distribution(), sphericity=getattr(self, "sphericity", 1.0))

    def law(self, fit: Fit | None = None) -> SizeLaw:
        """The fitted law."""
        return RECIPES[self.size_law].build((fit or self.fit()).values, self.distribution().basis)

    def fit(self) -> Fit:
        """The law by least squares on the cumulative curve; the figures of the measured classes stand under
        ``derived``.

        Neighboring points of a cumulative curve share their errors, so the intervals of the law are
        indicative.
        """
        recipe, measured = RECIPES[self.size_law], self.distribution()
        start = recipe.start(measured)
        sizes, below = self.points()
        bounds = {n: {**_BOUNDS, **recipe.bounds}.get(n, (start[n] * 1e-6, inf)) for n in start}
        by_class = self.class_rows()
        found = self.fitted(
            lambda p, x: recipe.build(p, measured.basis)(x),
            start,
            sizes,
            below,
            bounds=bounds,
            flags=self.notices(),
            judged=by_class is None,
        )
        if by_class is not None:
            found = judged_by_class(self, found, lambda p, x: recipe.build(p, measured.basis)(x), by_class)
        table = self.summary()._asdict()
        figures = {
            n: Estimate(float(table[n]), "" if (k := kind_of(kind)) is None else k.unit)
            for n, kind in FIGURES.items()
        }
        if getattr(self, "solid_density", None) is not None:
            figures["specific_surface_mass"] = Estimate(
                figures["specific_surface"].value / self.solid_density, "m^2/kg"
            )
        return replace(found, derived={**figures, **found.derived})

    def chart(self) -> go.Figure:
        """Histogram of the measured classes, cumulative points and the fitted law, over the logarithm of
        size.
        """
        from granum.particles.charts_sizes import distribution_figure

        return distribution_figure(self.distribution(), self.law())
