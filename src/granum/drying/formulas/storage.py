"""Water activity and keeping: what can grow, and how dry a product must be."""

from __future__ import annotations

from typing import Literal, NamedTuple

from granum.core import formula
from granum.core.kinds import MoistureDryBasis, Number, Temperature, WaterActivity
from granum.drying.formulas.moisture import POTATO, IsothermLaw

# Lowest water activities of growth: Beuchat's table, but for molds the notes' (D II, table II.1), which is
# 0.1 lower and so on the safe side
LIMITS = {
    "bacteria": 0.91,
    "yeasts": 0.87,
    "molds": 0.70,
    "xerophilic molds": 0.65,
    "osmophilic yeasts": 0.60,
}


class GrowthMargin(NamedTuple):
    """Water activity below the limit of growth; negative where the organisms grow."""

    water_activity_margin_bacteria: Number
    water_activity_margin_yeasts: Number
    water_activity_margin_molds: Number
    water_activity_margin_xerophilic_molds: Number
    water_activity_margin_osmophilic_yeasts: Number


@formula(
    source="beuchat1981",
    equation=r"\Delta a_w = a_{w,\Delta a_win} - a_w",
    title="Margin to the growth of microorganisms",
)
def water_activity_margin(water_activity: WaterActivity) -> GrowthMargin:
    """How far a product lies below the water activity that each group of microorganisms needs.

    Bacteria 0.91, yeasts 0.87, xerophilic molds 0.65, osmophilic yeasts 0.60; nothing grows below 0.60. Molds
    0.70, as in the notes (table II.1). Differs from the print: Beuchat's table has 0.80 for most molds and
    0.75 for the mycotoxigenic aspergilli. Single species go lower than their group: Staphylococcus aureus to
    0.86, halophilic bacteria to 0.75. Oxidation of fat is slowest at 0.25 to 0.35, browning fastest at 0.5 to
    0.8.

    >>> round(water_activity_margin(water_activity=0.65).water_activity_margin_molds, 2)
    0.05
    """
    return GrowthMargin(*(limit - water_activity for limit in LIMITS.values()))


@formula(
    source="beuchat1981; keey1978",
    equation=r"X_{max} = X(a_{w,min}, T)",
    title="Highest moisture for keeping",
    output="moisture_dry_basis",
    typical={"temperature": (283.0, 303.0)},
    symbols={"moisture_dry_basis": "X_{max}"},
)
def moisture_for_storage(
    temperature: Temperature = 298.15,
    isotherm: IsothermLaw = POTATO,
    organism: Literal["bacteria", "yeasts", "molds", "xerophilic molds", "osmophilic yeasts"] = "molds",
) -> MoistureDryBasis:
    """Moisture of a product in equilibrium with the water activity below which a group of microorganisms no
    longer grows.

    Maize at 25 °C against molds: 16.3 % dry basis, 14 % wet basis, the usual limit of trade.

    >>> from granum.drying.isotherms.products import PRODUCTS
    >>> round(moisture_for_storage(temperature="25 degC", isotherm=PRODUCTS["maize"](), organism="molds"), 3)
    0.163
    """
    return isotherm(LIMITS[organism], temperature) + 0.0 * temperature
