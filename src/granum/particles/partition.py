"""Partition curves: the part of the material of a size that goes to the coarse product of a screen, a cyclone
or a classifier.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING, Annotated, Any

import equinox as eqx
import jax.numpy as jnp

from granum.core import formula, impossible, law
from granum.core.kinds import Fraction, Law, Length, Number, PositiveNumber, Ratio, Within
from granum.numerics.quadrature import gauss_legendre
from granum.numerics.roots import find_root

_LN2, _LN3 = 0.6931471805599453, 1.0986122886681098
_LARGE = 500.0
ORDER = "The coarser of two sizes goes to the coarse product with the greater share."


class PartitionCurve(eqx.Module):
    """What every partition curve can do: its value, and the size at which it takes a value."""

    if TYPE_CHECKING:  # a field of most subclasses, not declared here because a dataclass would put it first

        @property
        def cut_size(self) -> Any: ...

    @abstractmethod
    def __call__(self, particle_diameter: Length) -> Fraction:
        """Part of a size that reports to the coarse product."""

    def over(self, lower: Any, upper: Any) -> Any:
        """Mean over size classes, their material spread evenly over size."""
        return gauss_legendre(self, lower, upper, order=8) / (jnp.asarray(upper) - jnp.asarray(lower))

    def size_at(self, part: Any) -> Any:
        """Size of which a part reports to the coarse product, m."""
        d = self.cut_size
        return d * jnp.exp(find_root(lambda u: self(d * jnp.exp(u)) - part, -12.0, 12.0, start=0.0).value)


def _ratio(particle_diameter: Any, cut_size: Any) -> tuple[Any, Any]:
    x = jnp.asarray(particle_diameter, dtype=float)
    return x > 0, jnp.where(x > 0, x, cut_size) / cut_size


@law(
    "partition_curve",
    name="logistic",
    source="lynch1977; tromp1937",
    title="Logistic partition curve",
    equation=r"G(x) = \frac{1}{1 + (d_{50}/x)^{n}}",
    symbols={"particle_diameter": "x"},
)
class LogisticPartition(PartitionCurve):
    """S-shaped curve over the logarithm of size; its sharpness index is 9 to the power -1/n.

    >>> round(float(LogisticPartition(cut_size="100 um", sharpness=3.0)(200e-6)), 4)
    0.8889
    """

    cut_size: Length
    sharpness: PositiveNumber

    def __call__(self, particle_diameter: Length) -> Fraction:
        """Part of a size that reports to the coarse product."""
        inside, t = _ratio(particle_diameter, self.cut_size)
        return jnp.where(inside, 1.0 / (1.0 + t ** (-self.sharpness)), 0.0)

    def size_at(self, part: Any) -> Any:
        """Size of which a part reports to the coarse product, m."""
        part = jnp.asarray(part, dtype=float)
        return self.cut_size * (part / (1.0 - part)) ** (1.0 / self.sharpness)

    @classmethod
    def from_sharpness_index(cls, cut_size: Any, sharpness_index: Any) -> LogisticPartition:
        """From d25/d75."""
        return cls(cut_size, -2.0 * _LN3 / jnp.log(sharpness_index))


@law(
    "partition_curve",
    name="rosin_rammler_partition",
    source="plitt1976",
    title="Rosin–Rammler (Plitt) partition curve",
    equation=r"G(x) = 1 - \exp\!\left[-\ln 2\,(x/d_{50})^{n}\right]",
    symbols={"particle_diameter": "x"},
)
class RosinRammlerPartition(PartitionCurve):
    """Corrected efficiency curve of hydrocyclones and screens.

    >>> round(float(RosinRammlerPartition(cut_size="100 um", sharpness=2.0)(200e-6)), 4)
    0.9375
    """

    cut_size: Length
    sharpness: PositiveNumber

    def __call__(self, particle_diameter: Length) -> Fraction:
        """Part of a size that reports to the coarse product."""
        inside, t = _ratio(particle_diameter, self.cut_size)
        return jnp.where(inside, -jnp.expm1(-_LN2 * t**self.sharpness), 0.0)

    def size_at(self, part: Any) -> Any:
        """Size of which a part reports to the coarse product, m."""
        return self.cut_size * (-jnp.log1p(-jnp.asarray(part, dtype=float)) / _LN2) ** (1.0 / self.sharpness)


@law(
    "partition_curve",
    name="whiten",
    source="napiermunn1996",
    title="Whiten partition curve",
    equation=(
        r"G(x) = 1 - (1 - R_f)\frac{(1 + \beta \beta^* t)(e^{n} - 1)}{e^{n \beta^* t} + e^{n} - 2},\ t = "
        r"x/d_{50}"
    ),
    symbols={"particle_diameter": "x"},
)
class WhitenPartition(PartitionCurve):
    """Whiten's efficiency curve, with an optional fish-hook; the factor beta* keeps the half value at the cut
    size.

    The cut size is the corrected one: without the bypass half of that size goes either way. A strong
    fish-hook without a bypass would send less than nothing to the coarse product; such values are cut at 0.

    >>> round(float(WhitenPartition(cut_size="100 um", sharpness=4.0)(100e-6)), 6)
    0.5
    """

    cut_size: Length
    sharpness: PositiveNumber
    fishhook_parameter: Ratio = 0.0
    bypass_fraction: Annotated[Fraction, Within(0.0, 0.999)] = 0.0

    def __call__(self, particle_diameter: Length) -> Fraction:
        """Part of a size that reports to the coarse product."""
        a, b = jnp.asarray(self.sharpness, dtype=float), self.fishhook_parameter

        def to_fine(t: Any, star: Any) -> Any:
            # divided through by exp(a): no overflow for a sharp cut
            return (
                (1.0 + b * star * t)
                * -jnp.expm1(-a)
                / (jnp.exp(jnp.minimum(a * (star * t - 1.0), _LARGE)) + 1.0 - 2.0 * jnp.exp(-a))
            )

        star = (
            find_root(lambda s: to_fine(1.0, s) - 0.5, 0.9, 50.0 + 50.0 * jnp.sqrt(b), start=1.0).value
            if _has_hook(b)
            else 1.0
        )
        t = jnp.maximum(jnp.asarray(particle_diameter, dtype=float), 0.0) / self.cut_size
        return jnp.clip(1.0 - (1.0 - self.bypass_fraction) * to_fine(t, star), 0.0, 1.0)


def _has_hook(parameter: Any) -> bool:
    return not (isinstance(parameter, float) and parameter == 0.0)


@law(
    "partition_curve",
    name="molerus_hoffmann",
    source="molerus1969",
    title="Molerus–Hoffmann partition curve",
    equation=r"G(x) = \left\{1 + (d_{50}/x)^2 \exp\left[n\left(1 - (x/d_{50})^2\right)\right]\right\}^{-1}",
    symbols={"particle_diameter": "x"},
)
class MolerusHoffmannPartition(PartitionCurve):
    """Partition curve of air classifiers.

    >>> round(float(MolerusHoffmannPartition(cut_size="100 um", sharpness=1.0)(100e-6)), 4)
    0.5
    """

    cut_size: Length
    sharpness: Ratio

    def __call__(self, particle_diameter: Length) -> Fraction:
        """Part of a size that reports to the coarse product."""
        inside, t = _ratio(particle_diameter, self.cut_size)
        exponent = jnp.clip(self.sharpness * (1.0 - t**2) - 2.0 * jnp.log(t), -_LARGE, _LARGE)
        return jnp.where(inside, 1.0 / (1.0 + jnp.exp(exponent)), 0.0)


@law(
    "partition_curve",
    name="ideal",
    source="tromp1937",
    title="Ideal partition",
    equation=r"G(x) = 0\ (x < d_{50}),\ 1\ (x \ge d_{50})",
    symbols={"particle_diameter": "x"},
)
class IdealPartition(PartitionCurve):
    """Everything below the cut size passes, everything above stays.

    >>> [float(g) for g in IdealPartition(cut_size="1 mm")(jnp.array([0.5e-3, 2e-3]))]
    [0.0, 1.0]
    """

    cut_size: Length

    def __call__(self, particle_diameter: Length) -> Fraction:
        """Part of a size that reports to the coarse product."""
        return jnp.where(jnp.asarray(particle_diameter) >= self.cut_size, 1.0, 0.0)

    def over(self, lower: Any, upper: Any) -> Any:
        """Part of each class above the cut size."""
        return jnp.clip((upper - self.cut_size) / (jnp.asarray(upper) - jnp.asarray(lower)), 0.0, 1.0)

    def size_at(self, part: Any) -> Any:
        """The cut size, whatever the part."""
        return self.cut_size * jnp.ones_like(jnp.asarray(part, dtype=float))


@law(
    "partition_curve",
    name="bypassed",
    source="kelsall1953; lynch1977",
    title="Partition with a bypass",
    equation=r"G(x) = R_f + (1 - R_f)\,G_c(x)",
    symbols={"particle_diameter": "x"},
)
class BypassedPartition(PartitionCurve):
    """A corrected curve with a part of every size, usually the water split, carried to the coarse product
    unclassified.

    >>> curve = LogisticPartition(cut_size="100 um", sharpness=3.0)
    >>> round(float(BypassedPartition(separation=curve, bypass_fraction=0.2)(100e-6)), 3)
    0.6
    """

    separation: Annotated[Any, Law("partition_curve")]
    bypass_fraction: Annotated[Fraction, Within(0.0, 0.999)]

    @property
    def cut_size(self) -> Any:  # type: ignore[override]
        """The corrected cut size: that of the curve without the bypass."""
        return self.separation.cut_size

    def __call__(self, particle_diameter: Length) -> Fraction:
        """Part of a size that reports to the coarse product."""
        return self.bypass_fraction + (1.0 - self.bypass_fraction) * self.separation(particle_diameter)

    def over(self, lower: Any, upper: Any) -> Any:
        """Mean over size classes."""
        return self.bypass_fraction + (1.0 - self.bypass_fraction) * self.separation.over(lower, upper)


@formula(source="tromp1937; wills2016", title="Probable error", equation=r"E_p = \tfrac12 (d_{75} - d_{25})")
def probable_error(percentile_75: Length, percentile_25: Length) -> Length:
    """Half the distance between the sizes that go to the coarse product for 75 % and 25 %.

    >>> probable_error(percentile_75=3.0, percentile_25=1.0)
    1.0
    """
    impossible(percentile_75 < percentile_25, percentile_75, "percentile_75", percentile_25, jnp.inf, ORDER)
    return 0.5 * (percentile_75 - percentile_25)


@formula(source="wills2016", equation=r"I = \frac{d_{75} - d_{25}}{2\,d_{50}}")
def imperfection(percentile_75: Length, percentile_25: Length, cut_size: Length) -> Ratio:
    """Probable error over the cut size; 0 for an ideal separation.

    >>> imperfection(percentile_75=3.0, percentile_25=1.0, cut_size=2.0)
    0.5
    """
    impossible(percentile_75 < percentile_25, percentile_75, "percentile_75", percentile_25, jnp.inf, ORDER)
    return (percentile_75 - percentile_25) / (2.0 * cut_size)


@formula(source="eder1961", equation=r"\kappa = \frac{d_{25}}{d_{75}}")
def sharpness_index(percentile_25: Length, percentile_75: Length) -> Ratio:
    """Eder's sharpness of cut; 1 is ideal, 0.3 to 0.6 usual, above 0.8 very sharp.

    >>> sharpness_index(percentile_25=1.0, percentile_75=2.0)
    0.5
    """
    return percentile_25 / percentile_75


@formula(
    source="svarovsky2001; kelsall1953",
    equation=r"G' = \frac{G - R_f}{1 - R_f}",
    title="Reduced (corrected) partition number",
    symbols={"=partition_number": "G'"},
)
def partition_number_reduced(
    partition_number: Fraction, bypass_fraction: Annotated[Fraction, Within(0.0, 0.999)]
) -> Number:
    """Partition number without the part of each size that only follows the liquid into the coarse product;
    below 0 for fines that avoid it.

    It reduces the total efficiency of a hydrocyclone by its underflow share in the same way.

    >>> round(partition_number_reduced(0.8, 0.2), 6)
    0.75
    """
    return (partition_number - bypass_fraction) / (1.0 - bypass_fraction)
