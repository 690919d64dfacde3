"""Class tables in one call: every mean, percentile and the specific surface, or the same table on another
basis.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

from granum.core import procedure
from granum.core.kinds import (
    Distance,
    Fraction,
    Law,
    Length,
    Number,
    Ratio,
    Series,
    SpecificSurface,
    Sphericity,
)
from granum.particles.distributions import Basis, SizeDistribution
from granum.particles.in_class import UniformDensity

Edges = Annotated[Distance, Series("limits")]
Fractions = Annotated[Fraction, Series("classes")]
Rule = Annotated[Any, Law("in_class_rule")]
_UNIFORM = UniformDensity()


class SizeSummary(NamedTuple):
    """What a class table says about a powder."""

    mean_diameter_number_length: Length
    mean_diameter_number_surface: Length
    mean_diameter_number_volume: Length
    mean_diameter_surface_volume: Length
    mean_diameter_length_surface: Length
    mean_diameter_length_volume: Length
    mean_diameter_mass: Length
    percentile_10: Length
    percentile_50: Length
    percentile_90: Length
    size_span: Ratio
    specific_surface: SpecificSurface
    unmeasured_fraction: Fraction


def summary_of(
    distribution: SizeDistribution, basis: str | None = None, sphericity: float = 1.0
) -> SizeSummary:
    """The means of a distribution, its percentiles on a basis (its own by default), its surface."""
    on = distribution if basis is None else distribution.to_basis(basis)
    means = [distribution.mean(p, q) for p, q in ((1, 0), (2, 0), (3, 0), (3, 2), (2, 1), (3, 1), (4, 3))]
    d10, d50, d90 = (on.percentile(part) for part in (0.1, 0.5, 0.9))
    open_end = distribution.fractions[..., 0] * (distribution.edges[0] == 0.0)
    return SizeSummary._make(
        [*means, d10, d50, d90, (d90 - d10) / d50, distribution.specific_surface(sphericity), open_end]
    )


@procedure(source="iso9276-2; astm_e799", title="Size summary of a class table")
def size_summary(
    class_edges: Edges,
    class_fractions: Fractions,
    basis: Basis = "volume",
    wanted_basis: Basis | None = None,
    in_class: Rule = _UNIFORM,
    sphericity: Sphericity = 1.0,
) -> SizeSummary:
    """All means, the percentiles on a wanted basis (by default that of the table), the span and the specific
    surface of a class table.

    The last figure is the fraction that lies in a first class starting at 0: percentiles inside it are
    interpolated, and where a mean has no finite value there that class counts at its middle.

    >>> s = size_summary(
    ...     "2, 4, 8, 16, 32, 64, 128 um",
    ...     "2.7, 20.3, 50.8, 23.3, 2.7, 0.2 %",
    ...     basis="number",
    ...     in_class="midpoint",
    ... )
    >>> [round(float(x) * 1e6, 2) for x in s[:6]]
    [14.47, 17.19, 20.72, 30.11, 20.42, 24.79]
    """
    return summary_of(
        SizeDistribution(class_edges, class_fractions, basis, in_class), wanted_basis, sphericity
    )


@procedure(source="iso9276-2", title="Mean diameter D[p,q] of a class table")
def mean_diameter_classes(
    class_edges: Edges,
    class_fractions: Fractions,
    moment_order_upper: Number = 3.0,
    moment_order_lower: Number = 2.0,
    basis: Basis = "volume",
    in_class: Rule = _UNIFORM,
) -> Length:
    """Moment-ratio mean of a class table on any basis.

    >>> round(float(mean_diameter_classes("1, 101 um", "100 %") * 1e6), 2)
    21.67
    """
    return SizeDistribution(class_edges, class_fractions, basis, in_class).mean(
        moment_order_upper, moment_order_lower
    )


@procedure(source="iso9276-1", title="Percentile of a class table")
def percentile_diameter(
    class_edges: Edges,
    class_fractions: Fractions,
    cumulative_fraction: Fraction = 0.5,
    basis: Basis = "volume",
    wanted_basis: Basis | None = None,
    in_class: Rule = _UNIFORM,
) -> Length:
    """Size below which a fraction lies, on a wanted basis (by default that of the table); it always exists.

    >>> round(float(percentile_diameter("0, 100, 200 um", "25, 75 %") * 1e6), 2)
    133.33
    """
    return (
        SizeDistribution(class_edges, class_fractions, basis, in_class)
        .to_basis(wanted_basis or basis)
        .percentile(cumulative_fraction)
    )


@procedure(source="iso9276-1", title="Cumulative fraction of a class table")
def cumulative_fraction_classes(
    class_edges: Edges,
    class_fractions: Fractions,
    particle_diameter: Distance,
    basis: Basis = "volume",
    wanted_basis: Basis | None = None,
    in_class: Rule = _UNIFORM,
) -> Fraction:
    """Fraction below a size, on a wanted basis (by default that of the table).

    >>> round(float(cumulative_fraction_classes("0, 100, 200 um", "25, 75 %", "150 um")), 4)
    0.625
    """
    return (
        SizeDistribution(class_edges, class_fractions, basis, in_class)
        .to_basis(wanted_basis or basis)
        .cumulative(particle_diameter)
    )


@procedure(source="iso9276-2", title="Class fractions on another basis")
def class_fractions_converted(
    class_edges: Edges,
    class_fractions: Fractions,
    basis: Basis = "volume",
    wanted_basis: Basis = "number",
    in_class: Rule = _UNIFORM,
) -> Fractions:
    """The same table counted by number, length, surface or volume; exact under the rule inside a class.

    >>> [round(float(x), 4) for x in class_fractions_converted("1, 2, 4 um", "50, 50 %", in_class="midpoint")]
    [0.8889, 0.1111]
    """
    return SizeDistribution(class_edges, class_fractions, basis, in_class).to_basis(wanted_basis).fractions
