"""How much seed of which size."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import (
    Density,
    Distance,
    Fraction,
    Length,
    Mass,
    NumberPerMass,
    PositiveNumber,
    Ratio,
    Series,
    SpecificSurfaceMass,
    Time,
)
from granum.crystallization.formulas.msmpr import NO_GROWTH
from granum.crystallization.kinds import ForwardGrowthRate
from granum.numerics import find_root
from granum.particles.formulas.means import Shares, shares


@formula(
    source="mullin2001, ch. 9",
    title="Product size from the seed",
    equation=r"L_p = L_s\left(\frac{M_p}{M_s}\right)^{1/3}",
    output="product_size",
    typical={"seed_mass": (0.1, 1.0), "product_mass": (10.0, 100.0)},
    symbols={"product_size": "L_p"},
)
def product_size_from_seed(seed_size: Length, seed_mass: Mass, product_mass: Mass) -> Length:
    """Size of the product when everything that crystallizes grows on the seeds, none being born.

    >>> round(product_size_from_seed(seed_size="100 um", seed_mass=1.0, product_mass=125.0) * 1e6, 6)
    500.0
    """
    impossible(product_mass < seed_mass, product_mass, "product_mass", seed_mass, jnp.inf)
    return seed_size * (product_mass / seed_mass) ** (1.0 / 3.0)


@formula(
    source="mullin2001, ch. 9",
    title="Seed for a product size",
    equation=r"M_s = M_p \left(\frac{L_s}{L_p}\right)^3",
    output="seed_mass",
    typical={"seed_size": (5e-5, 1e-4), "product_size": (3e-4, 8e-4), "product_mass": (10.0, 100.0)},
    symbols={"product_size": "L_p"},
)
def seed_mass_for_product(seed_size: Length, product_size: Length, product_mass: Mass) -> Mass:
    """Mass of seed of a given size for a product of a given size and mass, none being born.

    >>> round(seed_mass_for_product(seed_size="100 um", product_size="500 um", product_mass=125.0), 6)
    1.0
    """
    impossible(product_size < seed_size, product_size, "product_size", seed_size, jnp.inf)
    return product_mass * (seed_size / product_size) ** 3


@formula(
    source="kubota2001",
    title="Critical seed loading",
    equation=r"C_s^* = 2.17\times10^{-6}\,L_s^2\ (L_s\text{ in }\mathrm{\mu m})",
    output="seed_loading",
    typical={"seed_size": (3e-5, 5e-4)},
)
def seed_loading_critical(seed_size: Length) -> Ratio:
    """Critical seed loading (mass of seed over the theoretical crop) above which secondary nucleation is
    practically suppressed.

    An empirical line through several inorganic and organic systems with natural cooling, after Kubota, Doki
    and others: use it as a first guess.

    >>> round(seed_loading_critical(seed_size="100 um"), 4)
    0.0217
    """
    return 2.17e-6 * (seed_size * 1e6) ** 2


class SeedChart(NamedTuple):
    """Ideal growth ratio and seed numbers."""

    growth_ratio: PositiveNumber
    seeds_per_mass: NumberPerMass
    seed_surface: SpecificSurfaceMass


@formula(
    source="kubota2001; mullin2001, ch. 9",
    equation=(
        r"\frac{L_p}{L_s} = \left(\frac{1 + C_s}{C_s}\right)^{1/3},\quad N_s = "
        r"\frac{1}{k_v\,\rho_c\,L_s^3},\ a_s = \frac{k_a}{k_v\,\rho_c\,L_s}"
    ),
    title="Seeding: ideal growth line",
    typical={"seed_loading": (0.005, 0.3)},
)
def seed_chart(
    seed_loading: PositiveNumber,
    seed_size: Length,
    crystal_density: Density,
    volume_shape_factor: PositiveNumber = 1.0,
    surface_shape_factor: PositiveNumber = 6.0,
) -> SeedChart:
    """Ideal growth line of the seed chart: product over seed size for a seed loading, with number and surface
    of the seeds.

    The loading is the mass of seed over the theoretical crop (which does not include the seed).

    >>> round(seed_chart(seed_loading=1 / 7, seed_size=1e-4, crystal_density=2000).growth_ratio, 6)
    2.0
    """
    mass = crystal_density * volume_shape_factor * seed_size**3
    ratio = ((1.0 + seed_loading) / seed_loading) ** (1.0 / 3.0)
    return SeedChart(ratio, 1.0 / mass, surface_shape_factor * seed_size**2 / mass)


@formula(
    source="mullin2001, ch. 9; jones1974",
    title="Time to grow to a size",
    equation=r"t_f = \frac{L_p - L_s}{G}",
    output="duration",
    typical={"seed_size": (5e-5, 1e-4), "product_size": (3e-4, 8e-4), "growth_rate": (1e-8, 2e-7)},
    symbols={"product_size": "L_p"},
)
def duration_for_growth(seed_size: Length, product_size: Length, growth_rate: ForwardGrowthRate) -> Time:
    """Time that seeds need to reach the product size at a constant growth rate in m/s.

    >>> round(duration_for_growth(seed_size="100 um", product_size="500 um", growth_rate=1e-7))
    4000
    """
    impossible(product_size < seed_size, product_size, "product_size", seed_size, jnp.inf)
    impossible(~(growth_rate > 0.0), growth_rate, "growth_rate", reason=NO_GROWTH)
    return (product_size - seed_size) / growth_rate


class GrownSeed(NamedTuple):
    """Seed classes after growth: what each has gained in size, its size and its share of the product."""

    size_increase: Distance
    class_sizes_product: Annotated[Distance, Series("classes")]
    class_fractions_product: Annotated[Fraction, Series("classes")]


@formula(
    source="mccabe1929; mccabe2005, ch. 27",
    equation=(
        r"\frac{M_p}{M_s} = \sum_i w_i\left(1 + \frac{\Delta L}{L_i}\right)^3,\quad L_i' = L_i + \Delta "
        r"L"
    ),
    title="Product of a seed with a size distribution (ΔL law)",
    typical={"seed_mass": (0.1, 1.0), "product_mass": (10.0, 100.0)},
    symbols={
        "class_sizes": "L_i",
        "class_fractions": "w_i",
        "class_sizes_product": "L_i'",
        "class_fractions_product": "w_i'",
    },
)
def grown_seed(
    class_sizes: Annotated[Length, Series("classes")],
    class_fractions: Shares,
    seed_mass: Mass,
    product_mass: Mass,
) -> GrownSeed:
    """Size gained by all seed crystals alike, and the product's distribution by mass, after McCabe's ΔL law:
    no nuclei, growth the same at any size.

    Fractions of the seed are by mass. The product must weigh no less than the seed.

    >>> out = grown_seed(
    ...     class_sizes=[100e-6, 200e-6], class_fractions=[0.5, 0.5], seed_mass=1.0, product_mass=17.5
    ... )
    >>> round(out.size_increase * 1e6, 6), [round(float(w), 4) for w in out.class_fractions_product]
    (200.0, [0.7714, 0.2286])
    """
    L, w = jnp.asarray(class_sizes), shares(class_fractions)
    R = jnp.asarray(product_mass / seed_mass)
    grows = R >= 1.0
    impossible(~grows, product_mass, "product_mass", seed_mass, jnp.inf)
    R = jnp.where(grows, R, 1.0)

    def excess(gain, ratio):
        return jnp.sum(w * (1.0 + gain[..., None] / L) ** 3, axis=-1) / ratio - 1.0

    gain = find_root(excess, 0.0 * R, (R ** (1.0 / 3.0) - 1.0) * jnp.max(L) * (1.0 + 1e-9), R).value
    gain = jnp.where(grows, gain, jnp.nan)
    return GrownSeed(gain, L + gain[..., None], w * (1.0 + gain[..., None] / L) ** 3 / R[..., None])
