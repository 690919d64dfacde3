"""Wash columns: a bed of crystals moves against pure melt, which freezes in part where it meets the cold."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import (
    HeatCapacity,
    Number,
    PositiveNumber,
    Ratio,
    SpecificEnergy,
    VoidFraction,
    Within,
)
from granum.crystallization.kinds import PositiveTemperatureDifference
from granum.numerics.smooth import safe_divide

STEEPEST = 600.0  # exponent beyond which no impurity is left


class WashFront(NamedTuple):
    """What passing the wash front does to a bed of crystals."""

    recrystallized_share: Ratio
    void_fraction_washed: VoidFraction


@formula(
    source="arkenbout1995; mullin2001, ch. 8",
    title="Wash front in a bed of cold crystals",
    equation=r"r = \frac{c_p\,\Delta T}{L_f},\quad 1-\varepsilon' = (1-\varepsilon)(1+r)",
    output="wash_front",
    typical={"specific_heat_capacity": (1000.0, 2200.0), "undercooling": (2.0, 20.0)},
)
def wash_front(
    undercooling: PositiveTemperatureDifference,
    specific_heat_capacity: HeatCapacity,
    heat_of_fusion: SpecificEnergy,
    void_fraction: VoidFraction,
) -> WashFront:
    """Pure melt that freezes onto crystals colder than its melting point, per mass of crystals, and the voids
    that it leaves.

    Below the front the bed is as cold as its mother liquor, above it as warm as pure melt. What freezes is
    not lost: it rises with the crystals. A bed without voids has frozen shut.

    >>> found = wash_front(5.0, 2100.0, 334e3, void_fraction=0.4)
    >>> round(float(found.recrystallized_share), 4), round(float(found.void_fraction_washed), 4)
    (0.0314, 0.3811)
    """
    share = specific_heat_capacity * undercooling / heat_of_fusion
    return WashFront(share, jnp.maximum(1.0 - (1.0 - void_fraction) * (1.0 + share), 0.0))


@formula(
    source="player1969; arkenbout1995",
    title="Impurity that a wash column leaves",
    equation=r"\frac{w_P}{w_m} = \frac{1 + s N m}{e^{y} + N m},\quad m = \frac{e^{y}-1}{y},\quad "
    r"y = R\,N,\quad N = \frac{\dot m_P\,H}{\rho\,\varepsilon A D_L}",
    output="impurity_ratio",
    typical={"wash_reflux": (0.0, 0.2), "wash_number": (10.0, 300.0), "carried_liquor": (0.0, 0.01)},
    symbols={"impurity_ratio": "w_P/w_m"},
)
def impurity_ratio_wash_column(
    wash_reflux: Annotated[Number, Within(-0.99, 1e6)],
    wash_number: Annotated[PositiveNumber, Within(1e-6, 1e6)],
    carried_liquor: Ratio = 0.0,
) -> PositiveNumber:
    """Impurity of the product over that of the mother liquor, when crystals rise through a washed height
    against melt that partly returns from above, and axial dispersion carries impurity upwards.

    The reflux is the net downward flow of liquid over the product; where it is negative, mother liquor rises
    with the crystals, and their share of the product is what a long column leaves. The liquid in the voids
    is mixed across. Liquor that the wash does not reach, in crystals or between them, is carried up whole, so
    much of it per product; once melted it returns in part with the wash: a long column leaves s/(1 + R).

    >>> round(impurity_ratio_wash_column(wash_reflux=0.05, wash_number=100.0) * 1e4, 2)
    3.23
    """
    y = wash_reflux * wash_number
    down = y >= 0.0
    size = jnp.where(down, y, -y)
    falling = jnp.exp(-jnp.minimum(size, STEEPEST))
    mean = wash_number * jnp.where(size > 1e-8, safe_divide(-jnp.expm1(-size), size, 1.0), 1.0 - 0.5 * size)
    carried = carried_liquor * mean
    return jnp.where(down, (falling + carried) / (1.0 + mean), (1.0 + carried) / (falling + mean))
