"""Crystals from a melt: how much impurity a growing layer takes in, how it collects in what is left, how
sweating lets it out, and zone melting.
"""

from __future__ import annotations

from typing import Annotated, NamedTuple

import jax
import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import GAS_CONSTANT
from granum.core.kinds import (
    GrowthRate,
    MassTransferCoefficient,
    MolarMass,
    MoleFraction,
    PositiveNumber,
    Ratio,
    SpecificEnergy,
    Temperature,
    Within,
)
from granum.crystallization.kinds import DistributionCoefficient, OpenShare
from granum.numerics import find_root
from granum.numerics.smooth import safe_divide

BarLength = Annotated[PositiveNumber, Within(1.0, 100.0)]
ZonePosition = Annotated[Ratio, Within(0.0, 100.0)]


class Segregation(NamedTuple):
    """Impurity over that of the melt at the start: where the layer ends, in the whole layer, in the rest of
    the melt.
    """

    impurity_ratio_front: PositiveNumber
    impurity_ratio_layer: PositiveNumber
    impurity_ratio_melt: PositiveNumber


@formula(
    source="burton1953, eq. 11; jansens2000",
    title="Effective distribution coefficient (Burton, Prim and Slichter)",
    equation=r"k_{eff} = \frac{k}{k + (1-k)\,e^{-v/k_d}}",
    output="distribution_coefficient_effective",
    typical={"distribution_coefficient": (0.02, 0.3), "layer_growth_rate": (1e-7, 2e-6)},
)
def distribution_coefficient_effective(
    distribution_coefficient: DistributionCoefficient,
    layer_growth_rate: Annotated[GrowthRate, Within(0.0, 1e-3)],
    diffusion_coefficient: MassTransferCoefficient,
) -> PositiveNumber:
    """Impurity in a growing crystal over that in the bulk of the melt: the impurity that is pushed ahead
    collects in the boundary layer.

    The mass transfer coefficient of the melt stands for diffusivity over thickness of the boundary layer. A
    slow front keeps the equilibrium coefficient, a fast one takes the melt as it is.

    >>> round(distribution_coefficient_effective(0.1, 1e-6, 1e-6), 4)
    0.232
    """
    k = distribution_coefficient
    pushed = jnp.exp(-jnp.minimum(layer_growth_rate / diffusion_coefficient, 700.0))
    return k / (k + (1.0 - k) * pushed)


@formula(
    source="pfann1952, eq. 2; pfann1966, ch. 2",
    title="Impurity in a layer frozen from a melt",
    equation=(
        r"\frac{C_s}{C_0} = k\,(1-g)^{k-1},\quad \frac{\bar C_s}{C_0} = \frac{1-(1-g)^k}{g},\quad "
        r"\frac{C_l}{C_0} = (1-g)^{k-1}"
    ),
    output="segregation",
    typical={"distribution_coefficient": (0.02, 0.3), "frozen_fraction": (0.3, 0.8)},
)
def segregation_freezing(
    distribution_coefficient: DistributionCoefficient, frozen_fraction: OpenShare
) -> Segregation:
    """Impurity over that of the melt at the start when a share of it has frozen, the melt being mixed and the
    solid not (normal freezing, after Gulliver, Scheil and Pfann).

    With the effective coefficient of the front it describes a layer on a cooled wall. Mass balance: layer and
    melt together hold what there was.

    >>> [round(float(x), 4) for x in segregation_freezing(0.1, 0.5)]
    [0.1866, 0.1339, 1.8661]
    """
    k, g = distribution_coefficient, frozen_fraction
    left = jnp.log1p(-g)
    melt = jnp.exp((k - 1.0) * left)
    some = g > 1e-9
    mean = jnp.where(some, -jnp.expm1(k * left) / jnp.where(some, g, 1.0), k)
    return Segregation(k * melt, mean, melt)


@formula(
    source="schroder1893; jansens2000",
    title="Freezing point of an ideal melt (Schröder and van Laar)",
    equation=r"\frac{1}{T} = \frac{1}{T_m} - \frac{R\,\ln x}{M L_f}",
    output="temperature",
    typical={
        "mole_fraction": (0.3, 0.99),
        "melting_temperature": (280.0, 400.0),
        "heat_of_fusion": (1e5, 2e5),
        "molar_mass": (0.06, 0.15),
    },
)
def freezing_temperature_ideal(
    mole_fraction: Annotated[MoleFraction, Within(1e-6, 1.0)],
    melting_temperature: Temperature,
    heat_of_fusion: SpecificEnergy,
    molar_mass: MolarMass,
) -> Temperature:
    """Temperature at which a pure substance begins to freeze out of a melt that mixes ideally, as isomers
    nearly do.

    The heat of fusion is taken as constant, which overstates the fall where it is large. Below the eutectic
    another substance freezes first, which this does not know.

    >>> round(freezing_temperature_ideal(0.5, 286.4, 161e3, 0.106165) - 273.15, 2)
    -11.97
    """
    L = heat_of_fusion * molar_mass
    return 1.0 / (1.0 / melting_temperature - GAS_CONSTANT * jnp.log(mole_fraction) / L)


@formula(
    source="gilbert1991; jansens2000",
    title="Impurity left in a layer after sweating",
    equation=r"\frac{C}{C_0} = (1-s)^{1/k_s - 1}",
    output="impurity_ratio",
    typical={"sweating_coefficient": (0.1, 0.4), "sweated_fraction": (0.05, 0.3)},
    symbols={"impurity_ratio": r"C/C_0"},
)
def impurity_ratio_sweating(
    sweating_coefficient: DistributionCoefficient, sweated_fraction: OpenShare
) -> PositiveNumber:
    """Impurity of a layer over that before sweating, when warming has let a share of it run off as melt.

    The melt that drains holds 1/k_s times the impurity of what is left, k_s being measured: Rayleigh's
    equation. A coefficient of 1 tells that sweating does nothing.

    >>> round(impurity_ratio_sweating(sweating_coefficient=0.25, sweated_fraction=0.1), 4)
    0.729
    """
    return jnp.exp(jnp.log1p(-sweated_fraction) * (1.0 / sweating_coefficient - 1.0))


@formula(
    source="pfann1952, eq. 5",
    title="Impurity after one pass of a zone",
    equation=r"\frac{C}{C_0} = 1 - (1-k)\,e^{-k z}",
    output="impurity_ratio",
    typical={"distribution_coefficient": (0.02, 0.9), "zone_position": (0.0, 9.0)},
    symbols={"impurity_ratio": r"C/C_0"},
)
def impurity_ratio_zone(
    distribution_coefficient: DistributionCoefficient, zone_position: ZonePosition
) -> PositiveNumber:
    """Impurity along a bar over that before, after one molten zone has passed; the position counts in lengths
    of the zone.

    Holds up to one length before the end of the bar, where the zone freezes as a whole.

    >>> round(impurity_ratio_zone(distribution_coefficient=0.1, zone_position=0.0), 3)
    0.1
    """
    k = distribution_coefficient
    return k - (1.0 - k) * jnp.expm1(-k * zone_position)


@formula(
    source="pfann1952, eq. 7 to 9; pfann1966, ch. 3",
    title="Impurity after very many passes of a zone",
    equation=r"\frac{C}{C_0} = \frac{b N}{e^{b N} - 1}\,e^{b z},\quad k = \frac{b}{e^b - 1}",
    output="impurity_ratio",
    typical={
        "distribution_coefficient": (0.1, 0.9),
        "zone_position": (0.0, 5.0),
        "bar_length_in_zones": (5.0, 10.0),
    },
    symbols={"impurity_ratio": r"C/C_0"},
)
def impurity_ratio_zone_ultimate(
    distribution_coefficient: Annotated[DistributionCoefficient, Within(1e-6, 0.9999)],
    zone_position: ZonePosition,
    bar_length_in_zones: BarLength,
) -> PositiveNumber:
    """Impurity along a bar over that at the start, when further passes no longer change it.

    The steepest distribution that zone melting can reach; the end of the last zone is left out of it. A
    coefficient of 0.5 has b = 1.256: at the beginning of a bar of ten zones 4.4e-5 is left.

    >>> round(float(impurity_ratio_zone_ultimate(0.5, 0.0, 10.0)) * 1e5, 1)
    4.4
    """
    k, n = distribution_coefficient, bar_length_in_zones

    def misses(b: jax.Array) -> jax.Array:
        return jnp.log(safe_divide(b, jnp.expm1(b), 1.0)) - jnp.log(k)

    b = find_root(misses, 1e-9 + 0.0 * k, 40.0 + 0.0 * k).value
    return b * n * jnp.exp(b * zone_position - b * n) / -jnp.expm1(-b * n)
