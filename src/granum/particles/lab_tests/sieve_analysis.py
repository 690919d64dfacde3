"""Sieve analysis: masses retained on a stack, with the pan, the losses and what lies above the top sieve."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import numpy as np

from granum.core import lab_test
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Density, Fraction, Law, Length, Mass, Series, Sphericity, Within
from granum.core.units import format_number
from granum.particles.distributions import SizeDistribution
from granum.particles.in_class import UniformDensity
from granum.particles.lab_tests.size_test import SizeLawName, SizeTest


@lab_test("sieve_analysis", source="iso2591-1; iso9276-2; iso9276-3", title="Sieve analysis")
class SieveAnalysis(SizeTest):
    """Size distribution from the mass retained on each sieve of a stack.

    Sieves are given from coarse to fine or from fine to coarse. Material in the pan has no measured lower
    limit: give the smallest size, or it counts from 0 and is flagged. Material on the top sieve ends at the
    largest size; without one, the class above is taken as wide as the one below it, by ratio, and flagged.
    The loss is the sample mass less all that was found; in wet sieving (``washed``) it went through the
    finest sieve and counts as pan.

    >>> test = SieveAnalysis([500e-6, 250e-6, 125e-6], [0.0, 0.06, 0.03], pan_mass=0.01)
    >>> [round(float(f), 3) for f in test.distribution().fractions]
    [0.1, 0.3, 0.6]
    """

    rest: ClassVar = ("aperture", "retained_mass", "pan_mass")

    aperture: Annotated[Length, Series("sieves")]
    retained_mass: Annotated[Mass, Series("sieves")]
    pan_mass: Mass = 0.0
    sample_mass: Mass | None = None
    largest_size: Length | None = None
    smallest_size: Length | None = None
    washed: bool = False
    solid_density: Density | None = None
    sphericity: Sphericity = 1.0
    loss_allowed: Annotated[Fraction, Within(0.0, 1.0)] = 0.02
    size_law: SizeLawName = "rosin_rammler"
    in_class: Annotated[Any, Law("in_class_rule")] = UniformDensity()

    def _sorted(self) -> tuple[np.ndarray, np.ndarray]:
        aperture, mass = np.asarray(self.aperture), np.asarray(self.retained_mass)
        step = np.diff(aperture)
        if not (np.all(step > 0) or np.all(step < 0)):
            raise InputError(
                _(
                    "Sieves must run from coarse to fine or from fine to coarse, each aperture once; "
                    "check sieve {place}."
                ).format(place=int(np.argmax(np.sign(step) != np.sign(step[0]))) + 2),
                name="aperture",
            )
        order = np.argsort(aperture)
        return aperture[order], mass[order]

    @property
    def fine_mass(self) -> float:
        """What passed the finest sieve, kg: the pan, and in wet sieving what was washed away."""
        if not self.washed:
            return self.pan_mass
        if self.sample_mass is None:
            raise InputError(
                _("Wet sieving needs the dry mass of the sample: what was washed away follows from it."),
                name="sample_mass",
            )
        return max(self.sample_mass - float(np.sum(self.retained_mass)), self.pan_mass)

    @property
    def found_mass(self) -> float:
        """All that is accounted for after sieving, kg."""
        return float(np.sum(self.retained_mass)) + self.fine_mass

    @property
    def loss_fraction(self) -> float:
        """Part of the sample that was not found again; 0 without a sample mass."""
        return 0.0 if self.sample_mass is None else 1.0 - self.found_mass / self.sample_mass

    def distribution(self) -> SizeDistribution:
        """Classes between the sieves, with the pan below and the top class above where they hold material."""
        aperture, mass = self._sorted()
        edges, amounts = aperture, mass[:-1]
        if self.fine_mass > 0.0:
            edges = np.concatenate([[self._smallest(aperture[0])], edges])
            amounts = np.concatenate([[self.fine_mass], amounts])
        if mass[-1] > 0.0:
            edges, amounts = (
                np.concatenate([edges, [self._largest(aperture)]]),
                np.concatenate([amounts, mass[-1:]]),
            )
        return SizeDistribution.from_amounts(edges, amounts, "mass", self.in_class)

    def _smallest(self, finest: float) -> float:
        size = 0.0 if self.smallest_size is None else self.smallest_size
        if size >= finest:
            raise InputError(
                _("The smallest size must lie below the finest sieve."), name="smallest_size", value=size
            )
        return size

    def _largest(self, aperture: np.ndarray) -> float:
        if self.largest_size is None:
            return float(aperture[-1] ** 2 / aperture[-2])
        if self.largest_size <= aperture[-1]:
            raise InputError(
                _("The largest size must lie above the coarsest sieve."),
                name="largest_size",
                value=self.largest_size,
            )
        return self.largest_size

    def class_rows(self) -> np.ndarray:
        """The pan, which is no row, then what lies on each sieve from fine to coarse."""
        return np.concatenate([[-1], np.argsort(np.asarray(self.aperture))])

    def points(self) -> tuple[Any, Any]:
        """Apertures and the mass fractions that pass them."""
        aperture, mass = self._sorted()
        below = self.fine_mass + np.concatenate([[0.0], np.cumsum(mass[:-1])])
        # a sum may exceed the whole by its rounding
        return aperture, np.minimum(below / self.found_mass, 1.0)

    def notices(self) -> list[dict[str, Any]]:
        """Pan without a lower limit, top class without an upper one, loss above what is allowed."""
        found = []
        top = self._sorted()[1][-1]
        if self.fine_mass > 0.0 and self.smallest_size is None:
            share = format_number(100.0 * self.fine_mass / self.found_mass)
            text = _(
                "{share} % lies in the pan, whose smallest size was not measured: figures that depend "
                "on it are extrapolated."
            )
            found.append(self.note("extrapolated", text.format(share=share), "pan_mass"))
        if top > 0.0 and self.largest_size is None:
            share = format_number(100.0 * top / self.found_mass)
            text = _(
                "{share} % stays on the top sieve; its largest size was not given and is assumed by the "
                "ratio of the class below."
            )
            found.append(self.note("extrapolated", text.format(share=share), "largest_size"))
        if abs(self.loss_fraction) > self.loss_allowed:
            text = _(
                "The masses found differ from the sample by {loss} %, more than the {allowed} % "
                "allowed: repeat the test."
            )
            loss, allowed = (format_number(100.0 * x) for x in (self.loss_fraction, self.loss_allowed))
            found.append(self.note("limit active", text.format(loss=loss, allowed=allowed), "sample_mass"))
        return found
