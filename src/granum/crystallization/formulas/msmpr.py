"""The ideal continuous crystallizer (mixed suspension, mixed product removal): its exponential size
distribution.
"""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import (
    Concentration,
    Density,
    Distance,
    Fraction,
    Length,
    NucleationRate,
    PopulationDensity,
    PositiveNumber,
    Ratio,
    Time,
)
from granum.crystallization.kinds import ForwardGrowthRate, SizeParameter
from granum.numerics.roots import find_root
from granum.numerics.smooth import exprel, safe_divide

NO_GROWTH = "Without growth, or without time for it, no crystal becomes larger."
RISING = "The sizes below which 16, 50 and 84 % lie rise in this order."

_GROWTH = {"growth_rate": (1e-8, 1e-7), "residence_time": (1800.0, 7200.0)}


@formula(
    source="randolph1988, ch. 4",
    equation=r"n = n_0 \exp\left(-\frac{L}{G\tau}\right)",
    typical=_GROWTH,
)
def population_density(
    crystal_size: Distance,
    nuclei_population_density: PopulationDensity,
    growth_rate: ForwardGrowthRate,
    residence_time: Time,
) -> PopulationDensity:
    """Population density of an ideal continuous crystallizer (MSMPR) with growth that does not depend on
    size.

    >>> n = population_density(
    ...     crystal_size="100 um", nuclei_population_density=1e14, growth_rate=1e-7, residence_time=1000
    ... )
    >>> round(n / 1e14, 5)
    0.36788
    """
    return nuclei_population_density * jnp.exp(-crystal_size / (growth_rate * residence_time))


@formula(
    source="randolph1988, ch. 4",
    title="Nucleation rate of an MSMPR crystallizer",
    equation=r"B_0 = n_0 G",
    family="nucleation_formula",
)
def nucleation_rate_msmpr(
    nuclei_population_density: PopulationDensity, growth_rate: ForwardGrowthRate
) -> NucleationRate:
    """Nucleation rate from the population density of nuclei and the growth rate.

    >>> round(nucleation_rate_msmpr(nuclei_population_density=1e14, growth_rate=1e-7), 6)
    10000000.0
    """
    return nuclei_population_density * growth_rate


@formula(
    source="randolph1988, ch. 4",
    title="Magma density",
    equation=r"M_T = 6 k_v \rho_c n_0 (G\tau)^4",
    typical=_GROWTH,
)
def magma_density(
    nuclei_population_density: PopulationDensity,
    growth_rate: ForwardGrowthRate,
    residence_time: Time,
    crystal_density: Density,
    volume_shape_factor: PositiveNumber,
) -> Concentration:
    """Magma density (crystals per suspension volume) of an ideal continuous crystallizer.

    >>> round(
    ...     magma_density(
    ...         nuclei_population_density=1e14,
    ...         growth_rate=1e-7,
    ...         residence_time=1000,
    ...         crystal_density=2000,
    ...         volume_shape_factor=0.5,
    ...     ),
    ...     3,
    ... )
    60.0
    """
    return (
        6.0
        * volume_shape_factor
        * crystal_density
        * nuclei_population_density
        * (growth_rate * residence_time) ** 4
    )


@formula(source="randolph1988, ch. 4", equation=r"n_0 = \frac{M_T}{6 k_v \rho_c (G\tau)^4}", typical=_GROWTH)
def nuclei_population_density(
    magma_density: Concentration,
    growth_rate: ForwardGrowthRate,
    residence_time: Time,
    crystal_density: Density,
    volume_shape_factor: PositiveNumber,
) -> PopulationDensity:
    """Population density of nuclei that an ideal continuous crystallizer needs for its magma density.

    >>> n = nuclei_population_density(
    ...     magma_density=60,
    ...     growth_rate=1e-7,
    ...     residence_time=1000,
    ...     crystal_density=2000,
    ...     volume_shape_factor=0.5,
    ... )
    >>> round(n / 1e14, 6)
    1.0
    """
    return magma_density / (6.0 * volume_shape_factor * crystal_density * (growth_rate * residence_time) ** 4)


@formula(source="randolph1988, ch. 4; mullin2001, ch. 9", equation=r"L_D = 3 G \tau", typical=_GROWTH)
def dominant_size(growth_rate: ForwardGrowthRate, residence_time: Time) -> Length:
    """Dominant size by mass of an ideal continuous crystallizer: the maximum of the mass density.

    >>> round(dominant_size(growth_rate="0.02 um/s", residence_time="90 min") * 1e6, 1)
    324.0
    """
    return 3.0 * growth_rate * residence_time


@formula(
    source="randolph1988, ch. 4; mullin2001, ch. 9",
    equation=r"W(L_{50}) = \tfrac12,\quad L_{50} = 3.672\,G\tau",
    typical=_GROWTH,
)
def mass_median_size(growth_rate: ForwardGrowthRate, residence_time: Time) -> Length:
    """Median size by mass of an ideal continuous crystallizer.

    >>> round(mass_median_size(growth_rate=1e-7, residence_time=1000) * 1e6, 1)
    367.2
    """
    return 3.672060748850897 * growth_rate * residence_time


@formula(
    source="randolph1988, ch. 4",
    equation=r"W = 1 - e^{-x}\left(1 + x + \frac{x^2}{2} + \frac{x^3}{6}\right),\; x = \frac{L}{G\tau}",
    typical=_GROWTH,
)
def undersize_mass_fraction(
    crystal_size: Distance, growth_rate: ForwardGrowthRate, residence_time: Time
) -> Fraction:
    """Mass fraction of the crystals of an ideal continuous crystallizer that is smaller than a size.

    >>> round(undersize_mass_fraction(crystal_size=3.672e-4, growth_rate=1e-7, residence_time=1000), 4)
    0.5
    """
    path = growth_rate * residence_time
    impossible(~(path > 0.0), growth_rate, "growth_rate", reason=NO_GROWTH)
    x = crystal_size / path
    return gamma_share(x)


def gamma_share(x):
    """Share of the third moment of ``exp(-x)`` below ``x``; series where the closed form would cancel."""
    x = jnp.asarray(x, dtype=float)
    small = x < 0.5
    y = jnp.where(small, x, 0.0)
    total = jnp.zeros_like(y)
    for k in range(16, 3, -1):  # e^-x times the tail of the exponential series from x⁴/24 on
        total = 1.0 + total * y / (k + 1.0)
    series = jnp.exp(-y) * y**4 / 24.0 * total
    z = jnp.where(small, 1.0, x)
    closed = 1.0 - jnp.exp(-z) * (1.0 + z * (1.0 + z * (0.5 + z / 6.0)))
    return jnp.where(small, series, closed)


@formula(
    source="abegg1968",
    fitted={"size_exponent": (0.0, 1.0)},
    equation=r"\varphi = (1 + \gamma L)^b",
    typical={"crystal_size": (1e-5, 1e-3)},
)
def size_factor(crystal_size: Distance, size_parameter: SizeParameter, size_exponent: Ratio) -> Ratio:
    """Growth rate of a crystal over that of a nucleus, after Abegg, Stevens and Larson.

    Exponents below 1, for which all moments of the distribution of a continuous crystallizer are finite.

    >>> round(size_factor(crystal_size=1e-4, size_parameter=1e4, size_exponent=0.5), 4)
    1.4142
    """
    return (1.0 + size_parameter * crystal_size) ** size_exponent


@formula(
    source="abegg1968",
    title="Population density with size-dependent growth",
    fitted={"size_exponent": (0.0, 1.0)},
    equation=r"n = n_0 (1+\gamma L)^{-b} \exp\left(\frac{1-(1+\gamma L)^{1-b}}{\gamma G_0\tau(1-b)}\right)",
    typical={"size_exponent": (0.1, 0.8), "crystal_size": (1e-5, 5e-4), **_GROWTH},
    symbols={"growth_rate": "G_0"},
)
def population_density_size_dependent(
    crystal_size: Distance,
    nuclei_population_density: PopulationDensity,
    growth_rate: ForwardGrowthRate,
    residence_time: Time,
    size_parameter: SizeParameter,
    size_exponent: Ratio,
) -> PopulationDensity:
    """Population density of a continuous crystallizer whose growth depends on size after Abegg, Stevens and
    Larson.

    The growth rate is that of nuclei. Abegg and others set the parameter to 1/(Gτ). Exponents below 1.

    >>> n = population_density_size_dependent(
    ...     crystal_size=1e-4,
    ...     nuclei_population_density=1.0,
    ...     growth_rate=1e-7,
    ...     residence_time=1000,
    ...     size_parameter=1e4,
    ...     size_exponent=0.5,
    ... )
    >>> round(n, 5)
    0.30882
    """
    b, g = size_exponent, size_parameter
    base = 1.0 + g * crystal_size
    path = g * growth_rate * residence_time
    impossible(~(path > 0.0), growth_rate, "growth_rate", reason=NO_GROWTH)
    u = (1.0 - b) * jnp.log(base)
    stretch = exprel(u)  # (base^(1-b) - 1)/(1-b) over ln base
    return nuclei_population_density * base**-b * jnp.exp(-jnp.log(base) * stretch / path)


@formula(source="randolph1988, ch. 4; garside1980", equation=r"i = b/g")
def relative_nucleation_order(
    nucleation_order: PositiveNumber, growth_order: PositiveNumber
) -> PositiveNumber:
    """Relative nucleation order: nucleation as a power of growth, both driven by one supersaturation.

    >>> round(relative_nucleation_order(nucleation_order=1.78, growth_order=1.32), 3)
    1.348
    """
    return nucleation_order / growth_order


@formula(
    source="randolph1988, ch. 4",
    title="Dominant size after a change of operation",
    equation=(
        r"\frac{L_{D,2}}{L_{D,1}} = \left(\frac{\tau_2}{\tau_1}\right)^{\frac{i-1}{i+3}} "
        r"\left(\frac{M_{T,2}}{M_{T,1}}\right)^{\frac{1-j}{i+3}}"
    ),
    output="dominant_size",
    typical={"residence_time_ratio": (0.25, 4.0), "magma_density_ratio": (0.3, 3.0)},
    symbols={"dominant_size": "L_{D,1}", "=dominant_size": "L_{D,2}"},
)
def dominant_size_changed(
    dominant_size: Length,
    residence_time_ratio: PositiveNumber,
    magma_density_ratio: PositiveNumber,
    relative_nucleation_order: PositiveNumber,
    magma_order: Ratio = 1.0,
) -> Length:
    """Dominant size of an ideal continuous crystallizer after residence time and magma density have
    changed.

    With a relative order of 1 the residence time has no effect: longer time, less supersaturation, fewer
    nuclei.

    >>> round(
    ...     dominant_size_changed(
    ...         dominant_size=500e-6,
    ...         residence_time_ratio=2.0,
    ...         magma_density_ratio=1.0,
    ...         relative_nucleation_order=3.0,
    ...     )
    ...     * 1e6,
    ...     1,
    ... )
    630.0
    """
    i, j = relative_nucleation_order, magma_order
    return (
        dominant_size
        * residence_time_ratio ** ((i - 1.0) / (i + 3.0))
        * magma_density_ratio ** ((1.0 - j) / (i + 3.0))
    )


@formula(
    source="randolph1988, ch. 4",
    title="Crystal size at a given undersize",
    equation=r"L = x\,G\,\tau,\quad 1 - e^{-x}\left(1 + x + \frac{x^2}{2} + \frac{x^3}{6}\right) = W",
    output="crystal_size",
    typical={"undersize_mass_fraction": (0.05, 0.95), **_GROWTH},
    symbols={"undersize_mass_fraction": "W"},
)
def crystal_size_at_undersize(
    undersize_mass_fraction: Fraction, growth_rate: ForwardGrowthRate, residence_time: Time
) -> Distance:
    """Size below which a given mass fraction of the crystals of an ideal continuous crystallizer lies.

    >>> round(
    ...     crystal_size_at_undersize(undersize_mass_fraction=0.5, growth_rate=1e-7, residence_time=1000)
    ...     * 1e6,
    ...     1,
    ... )
    367.2
    """
    root = find_root(lambda x: gamma_share(x) - undersize_mass_fraction, 0.0, 60.0, start=3.672)
    return root.value * growth_rate * residence_time


@formula(
    source="randolph1988, ch. 4",
    equation=r"\mathrm{CV} = \frac{L_{84} - L_{16}}{2 L_{50}}",
    output="coefficient_of_variation",
    typical={"percentile_16": (1e-4, 2e-4), "percentile_50": (3e-4, 4e-4), "percentile_84": (5e-4, 7e-4)},
    symbols={"percentile_16": "L_{16}", "percentile_50": "L_{50}", "percentile_84": "L_{84}"},
)
def coefficient_of_variation(percentile_16: Length, percentile_50: Length, percentile_84: Length) -> Ratio:
    """Coefficient of variation of a size distribution by mass, from its 16 %, 50 % and 84 % sizes.

    About 0.52 for an ideal continuous crystallizer, whatever its kinetics.

    >>> round(
    ...     coefficient_of_variation(percentile_16=186.0e-6, percentile_50=367.2e-6, percentile_84=568.0e-6),
    ...     3,
    ... )
    0.52
    """
    impossible(percentile_16 > percentile_50, percentile_16, "percentile_16", 0.0, percentile_50, RISING)
    impossible(percentile_84 < percentile_50, percentile_84, "percentile_84", percentile_50, jnp.inf, RISING)
    return safe_divide(percentile_84 - percentile_16, 2.0 * percentile_50)
