"""Mean diameters of discrete sizes, as printed in textbooks, and the figures that percentiles give.

For classes with limits rather than sizes see ``class_means`` and ``SizeDistribution``.
"""

from __future__ import annotations

from math import pi
from typing import Annotated, Any, Literal

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import (
    Amount,
    Density,
    Fraction,
    Length,
    Number,
    NumberPerMass,
    PositiveNumber,
    Ratio,
    Series,
    Within,
)
from granum.particles.distributions import SUM_TOLERANCE, order_of

Sizes = Annotated[Length, Series("classes")]
Amounts = Annotated[Ratio, Series("classes")]
Masses = Annotated[Amount, Series("classes")]
Shares = Annotated[Fraction, Series("classes")]
NOTHING = "The amounts of all classes are zero: there is nothing to take a mean of."

WRONG_SUM = (
    "This is the sum of all classes, which must add up to 1: add the missing material (pan, oversize, "
    "losses)."
)


def shares(fractions: Any, name: str = "class_fractions") -> Any:
    """Class fractions divided by their sum, which must be one but for rounding; no value otherwise. Relative
    masses need no such sum.
    """
    total = jnp.sum(jnp.asarray(fractions), axis=-1, keepdims=True)
    wrong = ~(abs(total - 1.0) <= SUM_TOLERANCE)
    impossible(wrong[..., 0], total[..., 0], name, 1.0 - SUM_TOLERANCE, 1.0 + SUM_TOLERANCE, WRONG_SUM)
    return jnp.where(wrong, jnp.nan, fractions / jnp.where(wrong, 1.0, total))


def weighted(amounts: Any, values: Any, name: str) -> Any:
    """Mean of class values weighted by amounts, which are the input ``name``."""
    total = jnp.sum(amounts, axis=-1)
    impossible(~(total > 0), total, name, reason=NOTHING)
    return jnp.sum(amounts * values, axis=-1) / jnp.where(total > 0, total, jnp.nan)


def _ratio(x: Any, n: Any, p: float, q: float) -> Any:
    """Σ n x^p / Σ n x^q of numbers."""
    w = n * x**q
    return weighted(w, x ** (p - q), "class_numbers")


@formula(
    source="allen1997; iso9276-2",
    equation=r"X_{NL} = \frac{\sum X_i N_i}{\sum N_i} = D_{1,0}",
    title="Number–length mean X_NL = D[1,0]",
)
def mean_diameter_number_length(class_sizes: Sizes, class_numbers: Amounts) -> Length:
    """Arithmetic mean diameter by number.

    >>> round(
    ...     mean_diameter_number_length(
    ...         class_sizes="3 6 12 24 48 96 um", class_numbers=[2.7, 20.3, 50.8, 23.3, 2.7, 0.2]
    ...     )
    ...     * 1e6,
    ...     3,
    ... )
    14.475
    """
    return _ratio(class_sizes, class_numbers, 1, 0)


@formula(
    source="allen1997; iso9276-2",
    equation=r"X_{NS} = \sqrt{\frac{\sum N_i X_i^2}{\sum N_i}} = D_{2,0}",
    title="Number–surface mean X_NS = D[2,0]",
)
def mean_diameter_number_surface(class_sizes: Sizes, class_numbers: Amounts) -> Length:
    """Diameter of the particle that has the mean surface.

    >>> round(
    ...     mean_diameter_number_surface(
    ...         class_sizes="3 6 12 24 48 96 um", class_numbers=[2.7, 20.3, 50.8, 23.3, 2.7, 0.2]
    ...     )
    ...     * 1e6,
    ...     2,
    ... )
    17.19
    """
    return jnp.sqrt(_ratio(class_sizes, class_numbers, 2, 0))


@formula(
    source="allen1997; iso9276-2",
    equation=r"X_{NV} = \sqrt[3]{\frac{\sum N_i X_i^3}{\sum N_i}} = D_{3,0}",
    title="Number–volume mean X_NV = D[3,0]",
)
def mean_diameter_number_volume(class_sizes: Sizes, class_numbers: Amounts) -> Length:
    """Diameter of the particle that has the mean volume.

    >>> round((mean_diameter_number_volume("1 2 mm", class_numbers=[1.0, 1.0]) * 1e3) ** 3, 6)
    4.5
    """
    return _ratio(class_sizes, class_numbers, 3, 0) ** (1 / 3)


@formula(
    source="sauter1926; iso9276-2",
    equation=r"X_{SV} = \frac{\sum N_i X_i^3}{\sum N_i X_i^2} = D_{3,2}",
    title="Surface–volume (Sauter) mean X_SV = D[3,2]",
)
def mean_diameter_surface_volume(class_sizes: Sizes, class_numbers: Amounts) -> Length:
    """Sauter diameter: the size that has the specific surface of the whole.

    >>> round(mean_diameter_surface_volume("1 2 mm", class_numbers=[1.0, 1.0]) * 1e3, 6)
    1.8
    """
    return _ratio(class_sizes, class_numbers, 3, 2)


@formula(
    source="allen1997; iso9276-2",
    equation=r"X_{LS} = \frac{\sum N_i X_i^2}{\sum N_i X_i} = D_{2,1}",
    title="Length–surface mean X_LS = D[2,1]",
)
def mean_diameter_length_surface(class_sizes: Sizes, class_numbers: Amounts) -> Length:
    """Mean diameter weighted by length.

    >>> round(mean_diameter_length_surface("1 2 mm", class_numbers=[1.0, 1.0]) * 1e3, 6)
    1.666667
    """
    return _ratio(class_sizes, class_numbers, 2, 1)


@formula(
    source="allen1997; iso9276-2",
    equation=r"X_{LV} = \sqrt{\frac{\sum N_i X_i^3}{\sum N_i X_i}} = D_{3,1}",
    title="Length–volume mean X_LV = D[3,1]",
)
def mean_diameter_length_volume(class_sizes: Sizes, class_numbers: Amounts) -> Length:
    """Root of the volume over the length of the whole.

    >>> round(mean_diameter_length_volume("1 2 mm", class_numbers=[1.0, 1.0]) * 1e3, 6)
    1.732051
    """
    return jnp.sqrt(_ratio(class_sizes, class_numbers, 3, 1))


@formula(
    source="allen1997; iso9276-2",
    equation=r"D_{4,3} = \sum x_i\,d_i \Big/ \sum x_i",
    title="Mass mean D[4,3]",
    symbols={"class_sizes": "d_i", "class_masses": "x_i"},
)
def mean_diameter_mass(class_sizes: Sizes, class_masses: Masses) -> Length:
    """Arithmetic mean diameter by mass (or volume).

    >>> round(mean_diameter_mass("1 2 mm", class_masses=[3.0, 1.0]) * 1e3, 6)
    1.25
    """
    return weighted(class_masses, class_sizes, "class_masses")


@formula(
    source="allen1997; iso9276-2",
    equation=r"\bar d = \frac{1}{\sum x_i/d_i}",
    title="Harmonic mean by mass",
    symbols={"class_sizes": "d_i", "class_masses": "x_i", "mean_diameter": r"\bar d"},
)
def mean_diameter_harmonic(class_sizes: Sizes, class_masses: Masses) -> Length:
    """Harmonic mean diameter by mass: the Sauter diameter of a mass analysis.

    >>> round(mean_diameter_harmonic("1 2 mm", class_masses=[0.5, 0.5]) * 1e3, 6)
    1.333333
    """
    return 1.0 / weighted(class_masses, 1.0 / class_sizes, "class_masses")


@formula(source="mccabe2005, ch. 28", equation=r"n = \frac{1}{k_v\,\rho_p}\,\frac{\sum m_i/X_i^3}{\sum m_i}")
def number_per_mass(
    class_sizes: Sizes,
    class_masses: Masses,
    particle_density: Density,
    volume_shape_factor: PositiveNumber = pi / 6,
) -> NumberPerMass:
    """Number of particles in a unit of mass of a sieved powder.

    The volume of a particle of size X is k_v X³, π/6 for spheres.

    >>> round(
    ...     number_per_mass("1 2 mm", class_masses=[1.0, 1.0], particle_density=2250, volume_shape_factor=1.0)
    ... )
    250000
    """
    return weighted(class_masses, class_sizes**-3.0, "class_masses") / (
        volume_shape_factor * particle_density
    )


@formula(source="astm_c125", equation=r"\mathrm{FM} = \sum_i R_i")
def fineness_modulus(cumulative_retained: Annotated[Fraction, Series("classes")]) -> Number:
    """Fineness modulus of a sieve analysis: sum of the cumulative fractions retained on the sieves of a set.

    Each sieve opens half as wide as the one above it; the pan does not count.

    >>> round(fineness_modulus(cumulative_retained=[0.0, 0.12, 0.28, 0.48, 0.68, 0.84, 0.96]), 6)
    3.36
    """
    return jnp.sum(cumulative_retained, axis=-1)


@formula(
    source="iso9276-2",
    equation=r"D_{p,q} = \left(\frac{\sum N_i X_i^p}{\sum N_i X_i^q}\right)^{1/(p-q)},\quad "
    r"D_{p,p} = \exp\frac{\sum N_i X_i^p \ln X_i}{\sum N_i X_i^p}",
    title="Mean diameter D[p,q]",
)
def mean_diameter_moment_ratio(
    class_sizes: Sizes,
    class_amounts: Masses,
    moment_order_upper: Number = 3.0,
    moment_order_lower: Number = 2.0,
    basis: Literal["number", "length", "surface", "volume", "mass"] = "number",
) -> Length:
    """Any moment-ratio mean of discrete sizes, from amounts on any basis; geometric for p = q.

    >>> round(mean_diameter_moment_ratio("1 2 mm", class_amounts=[1.0, 8.0], basis="volume") * 1e3, 6)
    1.8
    """
    p, q = moment_order_upper - order_of(basis), moment_order_lower - order_of(basis)
    same = p == q
    high, low = (jnp.sum(class_amounts * class_sizes**k, axis=-1) for k in (p, q))
    geometric = jnp.sum(class_amounts * class_sizes**p * jnp.log(class_sizes), axis=-1) / high
    return jnp.exp(jnp.where(same, geometric, jnp.log(high / low) / jnp.where(same, 1.0, p - q)))


@formula(
    source="hatch1929",
    equation=r"D_{p,q} = d_{50,r}\,\exp\!\left(\tfrac{p + q - 2r}{2}\,\ln^2\sigma_g\right)",
    title="Mean diameter of a log-normal powder (Hatch–Choate)",
    typical={"moment_order_upper": (3.1, 4.0), "moment_order_lower": (1.0, 2.0)},
    symbols={"median_diameter": "d_{50,r}"},
)
def mean_diameter_hatch_choate(
    median_diameter: Length,
    geometric_standard_deviation: Annotated[PositiveNumber, Within(1.0)],
    moment_order_upper: Number = 3.0,
    moment_order_lower: Number = 2.0,
    basis: Literal["number", "length", "surface", "volume", "mass"] = "volume",
) -> Length:
    """Moment-ratio mean of a log-normal distribution from its median on one basis and its geometric standard
    deviation.

    >>> round(
    ...     mean_diameter_hatch_choate(
    ...         median_diameter=10.0,
    ...         geometric_standard_deviation=2.718281828,
    ...         moment_order_upper=3.0,
    ...         moment_order_lower=2.0,
    ...     ),
    ...     4,
    ... )
    6.0653
    """
    s = jnp.log(geometric_standard_deviation)
    return median_diameter * jnp.exp(
        0.5 * (moment_order_upper + moment_order_lower - 2.0 * order_of(basis)) * s**2
    )


@formula(
    source="hatch1929",
    equation=r"d_{50,s} = d_{50,r}\,\exp\!\left((s - r)\ln^2\sigma_g\right)",
    title="Median on another basis, log-normal (Hatch–Choate)",
    symbols={"median_diameter": "d_{50,s}"},
)
def median_diameter_hatch_choate(
    median_diameter_known: Length,
    geometric_standard_deviation: Annotated[PositiveNumber, Within(1.0)],
    basis: Literal["number", "length", "surface", "volume", "mass"] = "number",
    wanted_basis: Literal["number", "length", "surface", "volume", "mass"] = "volume",
) -> Length:
    """Median of a log-normal distribution on another basis; the geometric standard deviation stays the same.

    >>> round(median_diameter_hatch_choate(median_diameter_known=1.0, geometric_standard_deviation=2.0), 4)
    4.2264
    """
    s = jnp.log(geometric_standard_deviation)
    return median_diameter_known * jnp.exp((order_of(wanted_basis) - order_of(basis)) * s**2)


@formula(source="iso9276-2; allen1997", equation=r"\mathrm{span} = \frac{d_{90} - d_{10}}{d_{50}}")
def size_span(percentile_10: Length, percentile_50: Length, percentile_90: Length) -> Number:
    """Relative width of a distribution.

    >>> size_span(percentile_10=10.0, percentile_50=20.0, percentile_90=40.0)
    1.5
    """
    return (percentile_90 - percentile_10) / percentile_50


@formula(source="hazen1892", equation=r"C_u = \frac{d_{60}}{d_{10}}")
def uniformity_coefficient(percentile_60: Length, percentile_10: Length) -> PositiveNumber:
    """Hazen's uniformity coefficient; the 10 % size is his effective size.

    >>> uniformity_coefficient(percentile_60=3.0, percentile_10=1.5)
    2.0
    """
    return percentile_60 / percentile_10


@formula(source="astm_d2487", equation=r"C_c = \frac{d_{30}^2}{d_{10}\,d_{60}}")
def curvature_coefficient(
    percentile_30: Length, percentile_60: Length, percentile_10: Length
) -> PositiveNumber:
    """Coefficient of curvature of a grading; 1 to 3 for well-graded soils.

    >>> curvature_coefficient(percentile_30=2.0, percentile_60=4.0, percentile_10=1.0)
    1.0
    """
    return percentile_30**2 / (percentile_10 * percentile_60)


@formula(
    source="hatch1929",
    equation=r"\sigma_g = \sqrt{\frac{d_{84.13}}{d_{15.87}}}",
    title="Geometric standard deviation from percentiles",
    symbols={"percentile_84": "d_{84.13}", "percentile_16": "d_{15.87}"},
)
def geometric_standard_deviation(percentile_84: Length, percentile_16: Length) -> PositiveNumber:
    """Geometric standard deviation from the sizes one standard deviation either side of the median.

    >>> geometric_standard_deviation(percentile_84=4.0, percentile_16=1.0)
    2.0
    """
    return jnp.sqrt(percentile_84 / percentile_16)
