"""The size laws and partition curves as plain formulas, for one value at a time."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

from granum.core import formula, procedure
from granum.core.kinds import Distance, Fraction, Law, Length, PositiveNumber, Ratio, SpecificSurface, Within
from granum.particles.partition import (
    LogisticPartition,
    MolerusHoffmannPartition,
    RosinRammlerPartition,
    WhitenPartition,
)
from granum.particles.size_laws import GatesGaudinSchuhmann, GaudinMeloy, LogNormal, Normal, RosinRammler

_SPREAD = Annotated[PositiveNumber, Within(1.0000001)]


@formula(
    source="rosin1933",
    equation=r"Q = 1 - \exp\left[-(x/x')^n\right]",
    typical={"particle_diameter": (1e-5, 1e-4)},
    symbols={"particle_diameter": "x"},
)
def cumulative_fraction_rosin_rammler(
    particle_diameter: Distance, size_modulus: Length, distribution_exponent: PositiveNumber
) -> Fraction:
    """Fraction below a size by the Rosin–Rammler law.

    >>> round(cumulative_fraction_rosin_rammler("100 um", "100 um", 1.2), 4)
    0.6321
    """
    return RosinRammler(size_modulus, distribution_exponent)(particle_diameter)


@formula(
    source="hatch1929",
    title="Cumulative fraction of a log-normal law",
    equation=r"Q = \Phi\left(\frac{\ln(x/d_{50})}{\ln \sigma_g}\right)",
    typical={"particle_diameter": (1e-5, 1e-3)},
    symbols={"particle_diameter": "x"},
)
def cumulative_fraction_log_normal(
    particle_diameter: Distance, median_diameter: Length, geometric_standard_deviation: _SPREAD
) -> Fraction:
    """Fraction below a size by the log-normal law.

    >>> round(cumulative_fraction_log_normal("20 um", "10 um", 2.0), 4)
    0.8413
    """
    return LogNormal(median_diameter, geometric_standard_deviation)(particle_diameter)


@formula(
    source="iso9276-3",
    title="Cumulative fraction of a normal law",
    equation=r"Q = \Phi\left(\frac{x - \bar x}{\sigma}\right)\ \text{cut at } 0",
    typical={
        "particle_diameter": (1e-4, 3e-4),
        "mean_diameter": (2e-4, 3e-4),
        "standard_deviation": (2e-5, 6e-5),
    },
    symbols={"particle_diameter": "x", "mean_diameter": r"\bar x"},
)
def cumulative_fraction_normal(
    particle_diameter: Distance, mean_diameter: Length, standard_deviation: Length
) -> Fraction:
    """Fraction below a size by the normal law, cut off at 0.

    >>> round(cumulative_fraction_normal("110 um", "100 um", "10 um"), 4)
    0.8413
    """
    return Normal(mean_diameter, standard_deviation)(particle_diameter)


@formula(
    source="schuhmann1940",
    equation=r"Q = (x/x_{\max})^n",
    typical={"particle_diameter": (1e-5, 1e-4), "size_maximum": (2e-4, 1e-3)},
    symbols={"particle_diameter": "x"},
)
def cumulative_fraction_gates_gaudin_schuhmann(
    particle_diameter: Distance, size_maximum: Length, distribution_exponent: PositiveNumber
) -> Fraction:
    """Fraction below a size by the Gates–Gaudin–Schuhmann law; 1 above the largest size.

    >>> cumulative_fraction_gates_gaudin_schuhmann("0.25 mm", "1 mm", 0.5)
    0.5
    """
    return GatesGaudinSchuhmann(size_maximum, distribution_exponent)(particle_diameter)


@formula(
    source="gaudin1962",
    equation=r"Q = 1 - (1 - x/x_{\max})^n",
    typical={"particle_diameter": (1e-5, 1e-4), "size_maximum": (2e-4, 1e-3)},
    symbols={"particle_diameter": "x"},
)
def cumulative_fraction_gaudin_meloy(
    particle_diameter: Distance, size_maximum: Length, distribution_exponent: PositiveNumber
) -> Fraction:
    """Fraction below a size by the Gaudin–Meloy law; 1 above the largest size.

    >>> cumulative_fraction_gaudin_meloy("0.5 mm", "1 mm", 2.0)
    0.75
    """
    return GaudinMeloy(size_maximum, distribution_exponent)(particle_diameter)


@formula(
    source="lynch1977; tromp1937",
    title="Partition number of a logistic curve",
    equation=r"G = \frac{1}{1 + (d_{50}/x)^n}",
    symbols={"particle_diameter": "x"},
)
def partition_number_logistic(
    particle_diameter: Distance, cut_size: Length, sharpness: PositiveNumber
) -> Fraction:
    """Part of a size that goes to the coarse product, logistic curve.

    >>> round(partition_number_logistic("200 um", "100 um", 3.0), 4)
    0.8889
    """
    return LogisticPartition(cut_size, sharpness)(particle_diameter)


@formula(
    source="plitt1976",
    equation=r"G = 1 - \exp\left[-\ln 2\,(x/d_{50})^n\right]",
    typical={"particle_diameter": (5e-5, 1e-4), "cut_size": (5e-5, 1e-4), "sharpness": (1.0, 2.5)},
    symbols={"particle_diameter": "x"},
)
def partition_number_rosin_rammler(
    particle_diameter: Distance, cut_size: Length, sharpness: PositiveNumber
) -> Fraction:
    """Part of a size that goes to the coarse product, Rosin–Rammler (Plitt) curve.

    >>> round(partition_number_rosin_rammler("200 um", "100 um", 2.0), 4)
    0.9375
    """
    return RosinRammlerPartition(cut_size, sharpness)(particle_diameter)


@formula(
    source="napiermunn1996",
    equation=r"G = 1 - \frac{e^n - 1}{e^{n x/d_{50}} + e^n - 2}",
    typical={"particle_diameter": (5e-5, 2e-4), "cut_size": (5e-5, 2e-4)},
    symbols={"particle_diameter": "x"},
)
def partition_number_whiten(
    particle_diameter: Distance, cut_size: Length, sharpness: PositiveNumber
) -> Fraction:
    """Part of a size that goes to the coarse product, Whiten's curve without fish-hook.

    >>> round(partition_number_whiten("100 um", "100 um", 4.0), 6)
    0.5
    """
    return WhitenPartition(cut_size, sharpness)(particle_diameter)


@formula(
    source="molerus1969",
    equation=r"G = \left\{1 + (d_{50}/x)^2 \exp\left[n\left(1 - (x/d_{50})^2\right)\right]\right\}^{-1}",
    typical={"particle_diameter": (5e-5, 2e-4), "cut_size": (5e-5, 2e-4)},
    symbols={"particle_diameter": "x"},
)
def partition_number_molerus_hoffmann(
    particle_diameter: Distance, cut_size: Length, sharpness: Ratio
) -> Fraction:
    """Part of a size that goes to the coarse product, Molerus–Hoffmann curve.

    >>> partition_number_molerus_hoffmann("100 um", "100 um", 1.0)
    0.5
    """
    return MolerusHoffmannPartition(cut_size, sharpness)(particle_diameter)


class LawSummary(NamedTuple):
    """What a size law says about a powder."""

    mean_diameter_surface_volume: Length
    mean_diameter_mass: Length
    mean_diameter_number_length: Length
    percentile_10: Length
    percentile_50: Length
    percentile_90: Length
    size_span: Ratio
    specific_surface: SpecificSurface


@procedure(source="iso9276-2; iso9276-3", title="Size summary of a law")
def size_law_summary(size_law: Annotated[Any, Law("size_distribution")]) -> LawSummary:
    """Means, percentiles (on the basis of the law), span and specific surface of a size law; a mean whose
    moments are infinite is not a number.

    >>> round(float(size_law_summary(LogNormal("100 um", 1.5)).percentile_50) * 1e6, 2)
    100.0
    >>> round(float(size_law_summary(RosinRammler("100 um", 1.5)).percentile_50) * 1e6, 2)
    78.32
    """
    d32, d43, d10 = size_law.mean(3, 2), size_law.mean(4, 3), size_law.mean(1, 0)
    low, middle, high = (size_law.percentile(p) for p in (0.1, 0.5, 0.9))
    return LawSummary(d32, d43, d10, low, middle, high, (high - low) / middle, 6.0 / d32)
