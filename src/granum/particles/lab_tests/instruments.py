"""Laser, counter and image analyses."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any

import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Fraction, Law, Length, Ratio, Series
from granum.estimation import Estimate, Fit
from granum.estimation.verdicts import stray_note
from granum.particles.distributions import SUM_TOLERANCE, Basis, SizeDistribution
from granum.particles.in_class import UniformDensity
from granum.particles.lab_tests.class_verdicts import improbable_particles
from granum.particles.lab_tests.size_test import SizeLawName, SizeTest


@lab_test("laser_diffraction", source="iso13320; iso9276-1", title="Laser diffraction (cumulative curve)")
class LaserDiffraction(SizeTest):
    """Size distribution from a cumulative curve, as laser instruments and sedimentation give it.

    The last point must be 100 %. When the first is above 0 % the material below it has no measured lower
    limit and is flagged.

    >>> test = LaserDiffraction([1e-6, 10e-6, 100e-6], [0.0, 0.4, 1.0])
    >>> round(float(test.distribution().percentile(0.7)) * 1e6, 3)
    55.0
    """

    particle_diameter: Annotated[Length, Series("points")]
    cumulative_fraction: Annotated[Fraction, Series("points")]
    basis: Basis = "volume"
    smallest_size: Length | None = None
    size_law: SizeLawName = "log_normal"
    in_class: Annotated[Any, Law("in_class_rule")] = UniformDensity()

    def distribution(self) -> SizeDistribution:
        """Classes between the points."""
        self.increasing("particle_diameter")
        self.increasing("cumulative_fraction", strictly=False)
        sizes, below = np.asarray(self.particle_diameter), np.asarray(self.cumulative_fraction)
        if below[-1] < 1.0 - SUM_TOLERANCE:
            raise InputError(
                _("The curve ends at {last} %: add the size below which everything lies.").format(
                    last=f"{100 * below[-1]:.4g}"
                ),
                name="cumulative_fraction",
            )
        if below[0] > 0.0:
            sizes = np.concatenate([[0.0 if self.smallest_size is None else self.smallest_size], sizes])
            below = np.concatenate([[0.0], below])
        return SizeDistribution.from_amounts(sizes, np.diff(below), self.basis, self.in_class)

    def class_rows(self) -> np.ndarray:
        """The row that ends each class, and nothing above the last."""
        return np.concatenate([np.arange(len(np.asarray(self.particle_diameter))), [-1]])

    def points(self) -> tuple[Any, Any]:
        """The curve as measured."""
        return np.asarray(self.particle_diameter), np.asarray(self.cumulative_fraction)

    def notices(self) -> list[dict[str, Any]]:
        """Material below the first point."""
        first = float(np.asarray(self.cumulative_fraction)[0])
        if first == 0.0 or self.smallest_size is not None:
            return []
        text = _(
            "{share} % lies below the first point, whose smallest size was not measured: figures that "
            "depend on it are extrapolated."
        )
        return [self.note("extrapolated", text.format(share=f"{100 * first:.3g}"), "smallest_size")]


@lab_test("particle_counter", source="iso9276-2; iso13319", title="Particle counter (numbers by class)")
class ParticleCounter(SizeTest):
    """Size distribution from counts, one per class between neighboring limits; the class of a limit is the
    one below it.

    >>> test = ParticleCounter([2e-6, 4e-6, 8e-6, 16e-6], [0, 10, 30, 10])
    >>> [round(float(f), 2) for f in test.distribution().fractions]
    [0.2, 0.6, 0.2]
    """

    class_edges: Annotated[Length, Series("limits")]
    class_numbers: Annotated[Ratio, Series("limits")]
    size_law: SizeLawName = "log_normal"
    in_class: Annotated[Any, Law("in_class_rule")] = UniformDensity()

    def distribution(self) -> SizeDistribution:
        """Classes between the limits, by number."""
        edges, numbers = np.asarray(self.class_edges), np.asarray(self.class_numbers)
        if numbers[0] > 0.0:
            raise InputError(
                _(
                    "The first limit only opens the first class: its count must be 0. Add a smaller "
                    "limit below which nothing was counted."
                ),
                name="class_numbers",
                value=float(numbers[0]),
            )
        return SizeDistribution.from_amounts(edges, numbers[1:], "number", self.in_class)

    def class_rows(self) -> np.ndarray:
        """Each count from the second row on, and nothing above the last limit."""
        return np.concatenate([np.arange(1, len(np.asarray(self.class_edges))), [-1]])

    def points(self) -> tuple[Any, Any]:
        """Limits and the number fractions below them."""
        numbers = np.cumsum(np.asarray(self.class_numbers))
        return np.asarray(self.class_edges)[1:], numbers[1:] / numbers[-1]


@lab_test("image_analysis", source="iso13322-1; iso9276-2", title="Image analysis (one size per particle)")
class ImageAnalysis(SizeTest):
    """Means of particles measured one by one, with the intervals that the number of particles allows.

    The standard errors of the means follow from the scatter of the particles by the delta method, so they say
    whether enough particles were measured: a few coarse ones rule D[4,3].

    >>> test = ImageAnalysis([10e-6, 20e-6, 20e-6, 30e-6])
    >>> round(test.fit()["mean_diameter_number_length"].value * 1e6, 3)
    20.0
    """

    particle_diameter: Annotated[Length, Series("particles")]
    size_law: SizeLawName = "log_normal"

    def distribution(self) -> SizeDistribution:
        """Classes between neighboring sizes, by number: half of each particle on either side."""
        sizes, counts = np.unique(np.asarray(self.particle_diameter), return_counts=True)
        if sizes.size < 2:
            raise InputError(
                _("All particles have one size: there is no distribution to fit."), name="particle_diameter"
            )
        return SizeDistribution.from_amounts(sizes, 0.5 * (counts[1:] + counts[:-1]), "number")

    def points(self) -> tuple[Any, Any]:
        """Sorted sizes and the mean rank of each."""
        sizes = np.sort(np.asarray(self.particle_diameter))
        return sizes, (np.arange(sizes.size) + 0.5) / sizes.size

    def fit(self) -> Fit:
        """The law, and the moment-ratio means of the particles themselves with standard errors."""
        found = super().fit()
        x = np.asarray(self.particle_diameter)
        means = _means(x)
        surface = {"specific_surface": Estimate(6.0 / means["mean_diameter_surface_volume"].value, "1/m")}
        found = replace(found, derived={**found.derived, **means, **surface})
        found.flags.extend(self._stray(found, x))
        return found

    def _stray(self, found: Fit, x: np.ndarray) -> list[dict[str, Any]]:
        """Particles that the law of the others does not expect, with what they do to the means."""
        far = improbable_particles(x, np.asarray(self.law(found)(x)))
        if not far or found.diagnostics is None or x.size - len(far) < 2:
            return []
        without = {name: e.value for name, e in _means(np.delete(x, list(far))).items()}
        told = replace(
            found.diagnostics, stray=tuple(far), deviations=tuple(far.values()), without=without, robust={}
        )
        return stray_note(told, found, self.rows(x, x))


MEANS = {
    "mean_diameter_number_length": (1, 0),
    "mean_diameter_surface_volume": (3, 2),
    "mean_diameter_mass": (4, 3),
}


def _means(x: np.ndarray) -> dict[str, Estimate]:
    return {name: _mean_with_error(x, p, q) for name, (p, q) in MEANS.items()}


def _mean_with_error(x: np.ndarray, p: int, q: int) -> Estimate:
    """D[p,q] of single particles with its standard error."""
    from granum.estimation.results import t_reach

    high, low = x**p / np.mean(x**p), x**q / np.mean(x**q)
    value = float((np.mean(x**p) / np.mean(x**q)) ** (1.0 / (p - q)))
    error = value / (p - q) * float(np.std(high - low, ddof=1)) / np.sqrt(x.size)
    reach = t_reach(0.95, x.size - 1) * error
    return Estimate(value, "m", error, (value - reach, value + reach))
