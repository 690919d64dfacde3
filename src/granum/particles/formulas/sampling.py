"""Mixtures of grains and samples of them: how well mixed, and how much to take."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import Density, Fraction, Length, Mass, Number, PositiveNumber, Within
from granum.numerics import safe_sqrt

Share = Annotated[Fraction, Within(1e-9, 1.0 - 1e-9)]
Grains = Annotated[PositiveNumber, Within(2.0)]
SampleMass = Annotated[Mass, Within(1e-9)]
LARGER_THAN_THE_LOT = "A sample is smaller than its lot."


@formula(
    source="lacey1954, p. 259; earle2004, eq. 12.3",
    title="Deviation between samples of a random mixture",
    equation=r"s = \sqrt{\frac{p(1-p)}{n}}",
)
def composition_deviation_random(component_fraction: Share, particles_per_sample: Grains) -> Fraction:
    """Standard deviation of the composition between samples of a mixture that is as random as it can be.

    Grains of equal size; no mixer does better. Unmixed, with n = 1, it is the square root of p(1 − p).

    >>> composition_deviation_random(component_fraction=0.5, particles_per_sample=2500)
    0.01
    """
    p = component_fraction
    return safe_sqrt(p * (1.0 - p) / particles_per_sample)


@formula(
    source="lacey1954, p. 259; earle2004, eq. 12.4",
    equation=r"M = \frac{\sigma_0^2 - s^2}{\sigma_0^2 - \sigma_r^2},\quad \sigma_0^2 = p(1-p),\quad"
    r" \sigma_r^2 = \frac{p(1-p)}{n}",
)
def mixing_index_lacey(
    composition_deviation: Fraction, component_fraction: Share, particles_per_sample: Grains
) -> Number:
    """Mixing index by Lacey: 0 for components apart, 1 for a random mixture of grains of equal size.

    Mixers in use reach 0.75 to 1. Scatter of few samples may put it above 1; one below 0 says that the
    samples differ more than pure components do, so that the share is another.

    >>> round(
    ...     mixing_index_lacey(
    ...         composition_deviation=0.08246, component_fraction=0.15, particles_per_sample=50
    ...     ),
    ...     3,
    ... )
    0.966
    """
    apart = component_fraction * (1.0 - component_fraction)
    return (apart - composition_deviation**2) / (apart - apart / particles_per_sample)


@formula(
    source="gy1979, ch. 19; wills2016, ch. 3",
    equation=r"c = \frac{1-a}{a}\left[(1-a)\rho_m + a\rho_g\right]",
)
def mineral_factor_gy(mineral_fraction: Share, mineral_density: Density, gangue_density: Density) -> Density:
    """Mineralogical factor of Gy's formula: how much a grain of pure mineral weighs in the error of a sample.

    >>> round(mineral_factor_gy(mineral_fraction=0.5, mineral_density=5000, gangue_density=2600), 6)
    3800.0
    """
    a = mineral_fraction
    return (1.0 - a) / a * ((1.0 - a) * mineral_density + a * gangue_density)


def _constant(d, free, a, mineral, gangue, f, g):
    """Variance of a sample of unit mass out of an endless lot, kg."""
    liberation = safe_sqrt(jnp.minimum(free / d, 1.0))
    return f * g * liberation * mineral_factor_gy(a, mineral, gangue) * d**3


_FACTORS = (
    r",\quad C = f g \sqrt{\frac{d_l}{d}}\,c\,d^3,\quad c = \frac{1-a}{a}\left[(1-a)\rho_m + a\rho_g\right]"
)
_MASS = r"m = \frac{1}{\frac{s_{FSE}^2}{C} + \frac{1}{m_L}}" + _FACTORS
_EQUATION = r"s_{FSE}^2 = C\left(\frac1m - \frac1{m_L}\right)" + _FACTORS


@formula(source="gy1979, ch. 19; wills2016, ch. 3", equation=_EQUATION)
def sampling_error_gy(
    sample_mass: SampleMass,
    passing_size_95: Length,
    liberation_size: Length,
    mineral_fraction: Share,
    mineral_density: Density,
    gangue_density: Density,
    lot_mass: SampleMass | None = None,
    grain_shape_factor: Fraction = 0.5,
    size_range_factor: Fraction = 0.25,
) -> PositiveNumber:
    """Relative standard deviation of an assay from the sample alone, by Gy: the fundamental error, the least
    that correct sampling leaves.

    Half the width of an interval of 95 % is 1.96 times it. Below the size of liberation d_l/d counts as one.
    The shape factor is 0.5 for ordinary grains and 0.2 for gold, the size range factor 0.25 for unsized
    material and 0.5 to 0.75 between sieves. Left out, the lot is far larger than the sample.

    >>> round(
    ...     sampling_error_gy(
    ...         sample_mass="178.3 kg",
    ...         passing_size_95="25 mm",
    ...         liberation_size="150 um",
    ...         mineral_fraction=0.05 / 0.866,
    ...         mineral_density=7500,
    ...         gangue_density=2650,
    ...     ),
    ...     3,
    ... )
    0.01
    """
    C = _constant(
        passing_size_95, liberation_size, mineral_fraction, mineral_density, gangue_density,
        grain_shape_factor, size_range_factor,
    )  # fmt: skip
    if lot_mass is None:
        return safe_sqrt(C / sample_mass)
    impossible(~(sample_mass < lot_mass), sample_mass, "sample_mass", 0.0, lot_mass, LARGER_THAN_THE_LOT)
    return safe_sqrt(C * jnp.maximum(1.0 / sample_mass - 1.0 / lot_mass, 0.0))


@formula(source="gy1979, ch. 19; wills2016, ch. 3", equation=_MASS)
def sample_mass_gy(
    sampling_error: PositiveNumber,
    passing_size_95: Length,
    liberation_size: Length,
    mineral_fraction: Share,
    mineral_density: Density,
    gangue_density: Density,
    lot_mass: SampleMass | None = None,
    grain_shape_factor: Fraction = 0.5,
    size_range_factor: Fraction = 0.25,
) -> Mass:
    """Mass of a sample that keeps the relative standard deviation of an assay within a limit, by Gy's
    fundamental error.

    Plants take twice as much. Crush before parting: the mass falls with the third power of the size.

    >>> round(
    ...     sample_mass_gy(
    ...         sampling_error=0.01,
    ...         passing_size_95="25 mm",
    ...         liberation_size="150 um",
    ...         mineral_fraction=0.05 / 0.866,
    ...         mineral_density=7500,
    ...         gangue_density=2650,
    ...     )
    ... )
    178
    """
    C = _constant(
        passing_size_95, liberation_size, mineral_fraction, mineral_density, gangue_density,
        grain_shape_factor, size_range_factor,
    )  # fmt: skip
    endless = C / sampling_error**2
    return endless if lot_mass is None else endless / (1.0 + endless / lot_mass)
