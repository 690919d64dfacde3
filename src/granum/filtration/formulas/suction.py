"""Capillary suction: how fast dry filter paper draws liquid out of a sludge, and what that says of its
cake.
"""

from __future__ import annotations

from granum.core import formula
from granum.core.kinds import (
    CakeResistance,
    Concentration,
    DynamicViscosity,
    PositiveNumber,
    Time,
)
from granum.filtration.kinds import FilterabilityConstant, SuctionConstant

_SLUDGE = {
    "solids_concentration": (2.0, 50.0),
    "dynamic_viscosity": (8e-4, 2e-3),
    "cake_resistance": (1e11, 1e14),
}


@formula(
    source="baskerville1968; triton2018",
    title="Capillary suction time of a sludge",
    equation=r"t_{CST} = t_l + K_{CST}\,\eta\,C\,\alpha",
    typical=_SLUDGE,
)
def capillary_suction_time(
    cake_resistance: CakeResistance,
    solids_concentration: Concentration,
    dynamic_viscosity: DynamicViscosity,
    suction_constant: SuctionConstant,
    suction_time_liquid: Time = 0.0,
) -> Time:
    """Capillary suction time of a sludge from the resistance of its cake, on an apparatus whose constant is
    known.

    The paper sucks with a constant pressure, so that Ruth's parabola holds between the two rings and the time
    grows in proportion to viscosity, solids and resistance; to it comes the time of the clear liquid.
    With Ruth and a medium that does not resist the constant is (V₂² − V₁²)/(2 A² p), where V₁ and V₂ are the
    volumes that the paper has drawn when its wet spot reaches each ring, A is the opening of the funnel and p
    the suction. By hand: 8 s of the liquid and 5·10⁻¹⁰ · 10⁻³ · 20 · 10¹³ s of the cake.

    >>> round(capillary_suction_time(1e13, "20 g/L", "1 mPa*s", 5e-10, suction_time_liquid=8.0), 6)
    108.0
    """
    return suction_time_liquid + suction_constant * dynamic_viscosity * solids_concentration * cake_resistance


@formula(
    source="baskerville1968; triton2018; peng2011",
    title="Constant of a suction time apparatus",
    equation=r"K_{CST} = \frac{t_{CST} - t_l}{\eta\,C\,\alpha}",
    typical={**_SLUDGE, "capillary_suction_time": (15.0, 500.0), "suction_time_liquid": (5.0, 12.0)},
    output="suction_constant",
)
def suction_constant_calibration(
    capillary_suction_time: Time,
    suction_time_liquid: Time,
    solids_concentration: Concentration,
    dynamic_viscosity: DynamicViscosity,
    cake_resistance: CakeResistance,
) -> SuctionConstant:
    """Constant of funnel, paper and rings, from one sludge of which a leaf test has told the resistance.

    It belongs to one apparatus and one batch of paper. Over the sludges of seven works the suction time per
    solids explained 94.5 % of the variance of the resistance (Peng and others, abstract opened), so that a
    resistance told in this way ranks sludges and does not size a filter.

    >>> round(suction_constant_calibration(108.0, 8.0, "20 g/L", "1 mPa*s", 1e13) * 1e10, 6)
    5.0
    """
    gained = capillary_suction_time - suction_time_liquid
    return gained / (dynamic_viscosity * solids_concentration * cake_resistance)


@formula(
    source="vesilind1988",
    title="Filterability constant of a sludge",
    equation=r"\chi = \varphi\,\frac{\eta\,C}{t_{CST}}",
    typical={**_SLUDGE, "capillary_suction_time": (10.0, 500.0), "instrument_constant": (0.1, 1.0)},
)
def filterability_constant(
    capillary_suction_time: Time,
    solids_concentration: Concentration,
    dynamic_viscosity: DynamicViscosity,
    instrument_constant: PositiveNumber = 1.0,
) -> FilterabilityConstant:
    """Vesilind's measure of how readily a sludge gives its water, freed of viscosity and solids: large is
    good.

    The factor of the apparatus depends on the diameter of its funnel; 1 leaves the bare quotient, which
    compares sludges on one apparatus. The equation was not opened: it stands as it is usually quoted. By
    hand: 10⁻³ · 20 / 100.

    >>> round(filterability_constant("100 s", "20 g/L", "1 mPa*s"), 9)
    0.0002
    """
    return instrument_constant * dynamic_viscosity * solids_concentration / capillary_suction_time
