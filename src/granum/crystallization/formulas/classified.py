"""Continuous crystallizers that treat sizes differently: fines dissolved, product classified (R–Z model)."""

from __future__ import annotations

from typing import NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import (
    Concentration,
    Density,
    Distance,
    Length,
    NucleationRate,
    PopulationDensity,
    PositiveNumber,
    Time,
)
from granum.crystallization.formulas.msmpr import NO_GROWTH
from granum.crystallization.kinds import ForwardGrowthRate, ProductionRate


@formula(
    source="randolph1988, ch. 8",
    title="Population density with classified removal",
    equation=(
        r"n = n_0 \exp\left(-\frac{R\min(L,L_f) + \max(0,\min(L,L_p)-L_f) + " r"z\max(0,L-L_p)}{G\tau}\right)"
    ),
    output="population_density",
    typical={
        "crystal_size": (1e-5, 1e-3),
        "growth_rate": (2e-8, 1e-7),
        "residence_time": (1800.0, 7200.0),
        "fines_removal_ratio": (1.0, 5.0),
        "product_removal_ratio": (1.0, 5.0),
        "fines_cut_size": (5e-5, 1e-4),
        "product_cut_size": (3e-4, 5e-4),
    },
)
def population_density_classified(
    crystal_size: Distance,
    nuclei_population_density: PopulationDensity,
    growth_rate: ForwardGrowthRate,
    residence_time: Time,
    fines_removal_ratio: PositiveNumber,
    fines_cut_size: Length,
    product_removal_ratio: PositiveNumber,
    product_cut_size: Length,
) -> PopulationDensity:
    """Population density with fines removed R times and coarse product z times as fast as the mother liquor,
    ideal cuts.

    Fines removal (R above 1) makes fewer and larger crystals with a wider spread, classified product removal
    (z above 1) narrower and smaller ones. R = z = 1 is the ideal continuous crystallizer.

    >>> n = population_density_classified(
    ...     crystal_size=3e-4,
    ...     nuclei_population_density=1.0,
    ...     growth_rate=1e-7,
    ...     residence_time=1000,
    ...     fines_removal_ratio=3.0,
    ...     fines_cut_size=1e-4,
    ...     product_removal_ratio=2.0,
    ...     product_cut_size=2e-4,
    ... )
    >>> round(n, 6)
    0.002479
    """
    L, Lf, Lp = crystal_size, fines_cut_size, product_cut_size
    impossible(Lf > Lp, Lf, "fines_cut_size", 0.0, Lp)
    impossible(~(growth_rate * residence_time > 0.0), growth_rate, "growth_rate", reason=NO_GROWTH)
    path = (
        fines_removal_ratio * jnp.minimum(L, Lf)
        + jnp.clip(L - Lf, 0.0, Lp - Lf)
        + product_removal_ratio * jnp.maximum(L - Lp, 0.0)
    )
    return nuclei_population_density * jnp.exp(-path / (growth_rate * residence_time))


@formula(
    source="randolph1988, ch. 4",
    title="Population density in a second stage",
    equation=r"n_2 = n_0\,\frac{a}{a-b}\left(e^{-L/a} - e^{-L/b}\right),\; a = G_1\tau_1,\; b = G_2\tau_2",
    output="population_density",
    typical={
        "crystal_size": (1e-5, 1e-3),
        "growth_length_first": (1e-4, 1.4e-4),
        "growth_length_second": (4e-5, 8e-5),
    },
    symbols={"population_density": "n_2"},
)
def population_density_second_stage(
    crystal_size: Distance,
    nuclei_population_density: PopulationDensity,
    growth_length_first: Length,
    growth_length_second: Length,
) -> PopulationDensity:
    """Population density leaving a second stage in which the crystals of the first only grow, both mixed, at
    equal flow.

    The growth lengths are growth rate times residence time of each stage; the nuclei density is that of the
    first stage.

    >>> n = population_density_second_stage(
    ...     crystal_size=2e-4,
    ...     nuclei_population_density=1.0,
    ...     growth_length_first=1e-4,
    ...     growth_length_second=0.5e-4,
    ... )
    >>> round(n, 5)
    0.23404
    """
    a, b, L = growth_length_first, growth_length_second, crystal_size
    near = jnp.abs(a - b) < 1e-6 * a
    gap = jnp.where(near, a, a - b)
    apart = a * (jnp.exp(-L / a) - jnp.exp(-L / b)) / gap
    return nuclei_population_density * jnp.where(near, L / a * jnp.exp(-L / a), apart)


class ClassifyingProduction(NamedTuple):
    """What an ideal product-classifying crystallizer makes and needs."""

    production_per_volume: ProductionRate
    nucleation_rate: NucleationRate


@formula(
    source="mccabe2005, ch. 27",
    equation=r"\dot P = \frac{4 G M_T}{L_p},\quad B_0 = \frac{\dot P}{k_v \rho_c L_p^3}",
    title="Ideal product-classifying crystallizer",
    typical={"growth_rate": (2e-8, 2e-7)},
    symbols={"product_size": "L_p"},
)
def production_classifying(
    growth_rate: ForwardGrowthRate,
    product_size: Length,
    magma_density: Concentration,
    crystal_density: Density,
    volume_shape_factor: PositiveNumber = 1.0,
) -> ClassifyingProduction:
    """Production and births of a crystallizer in which every crystal leaves when it has reached the product
    size, and none before.

    Per volume of what the magma density refers to. Copper sulfate pentahydrate of McCabe: 1.4 mm at 0.2 µm/s,
    0.35 m³ of crystals of 2300 kg/m³ per m³ of mother liquor and shape factor 0.2 give 1656 kg/(m³ h).

    >>> out = production_classifying(
    ...     growth_rate="0.2 um/s",
    ...     product_size="1.4 mm",
    ...     magma_density=0.35 * 2300,
    ...     crystal_density=2300,
    ...     volume_shape_factor=0.2,
    ... )
    >>> round(out.production_per_volume * 3600), round(out.nucleation_rate * 3600 / 1e9, 2)
    (1656, 1.31)
    """
    made = 4.0 * growth_rate * magma_density / product_size
    return ClassifyingProduction(made, made / (volume_shape_factor * crystal_density * product_size**3))
