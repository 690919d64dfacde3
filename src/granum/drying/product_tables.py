"""Where products start and end: what dries in which dryer, and the water activity of foods."""

from __future__ import annotations

from typing import Annotated, Any, Literal, NamedTuple

import numpy as np

from granum.core import procedure
from granum.core.datasets import dataset
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import MassRatio, MoistureDryBasis, MoistureWetBasis, Series, WaterActivity
from granum.core.units import format_number
from granum.drying.formulas.storage import LIMITS


class Applications(NamedTuple):
    """Products and the dryers they are commonly dried in."""

    product: Annotated[str, Series("applications")]
    dryer: Annotated[str, Series("applications")]
    moisture_wet_basis_inlet_low: Annotated[MoistureWetBasis, Series("applications")]
    moisture_wet_basis_inlet_high: Annotated[MoistureWetBasis, Series("applications")]
    moisture_wet_basis_outlet_low: Annotated[MoistureWetBasis, Series("applications")]
    moisture_wet_basis_outlet_high: Annotated[MoistureWetBasis, Series("applications")]
    evaporation_per_product: Annotated[MassRatio, Series("applications")]


@procedure(source="houdon2017", title="What is dried in which dryer, from which moisture to which")
def applications(
    dryer: Literal[
        "any",
        "spray dryer",
        "drum dryer",
        "rotary drum dryer",
        "tunnel dryer",
        "belt dryer",
        "silo dryer",
        "flash dryer",
        "fluidized-bed dryer",
        "tray oven",
        "freeze dryer",
        "paddle or screw dryer",
    ] = "any",
) -> Applications:
    """Products of industry, each with its dryer and its moisture before and after, to start a
    calculation from.

    Moistures are common ranges on the wet basis; ``evaporation_per_product`` is the water evaporated per
    mass of dried product, at the middle of the ranges. The course notes' tables IV.1 to IV.21, which take
    them from the brochure of ADEME and CETIAT (source not opened); for whey, peas, mushrooms and strawberries
    one of the two figures comes from elsewhere, as the file of the table says.

    >>> found = applications("silo dryer")
    >>> found.product[0], round(float(found.evaporation_per_product[0]), 3)
    ('maize', 0.308)
    """
    rows = [row for row in dataset("drying", "applications_houdon2017") if dryer in ("any", row["dryer"])]
    x1, x2 = (
        np.array([(row[f"{end}_low"] + row[f"{end}_high"]) / 2.0 for row in rows])
        for end in ("inlet", "outlet")
    )
    words = (tuple(_(row[word]) for row in rows) for word in ("product", "dryer"))
    limits = (
        np.array([row[f"{end}_{side}"] for row in rows])
        for end in ("inlet", "outlet")
        for side in ("low", "high")
    )
    columns: Any = (*words, *limits, (x1 - x2) / (1.0 - x1))
    return Applications(*columns)


class Foods(NamedTuple):
    """Foods, the moistest first."""

    food: Annotated[str, Series("foods")]
    water_activity_low: Annotated[WaterActivity, Series("foods")]
    water_activity_high: Annotated[WaterActivity, Series("foods")]
    grows: Annotated[str, Series("foods")]


@procedure(source="beuchat1981", title="Water activity of foods, and what grows on them")
def foods(
    water_activity_limit: WaterActivity = 1.0,
) -> Foods:
    """Common foods with the range of their water activity and the groups of microorganisms that can grow on
    them.

    Only foods that may lie below ``water_activity_limit`` are listed. A group is named where it grows at
    the upper end of the range. The limits of growth are those of `drying.water_activity_margin`. Ranges are
    those of Beuchat's table in a reprint (source not opened).

    >>> foods().food[-1]
    'corn starch'
    """
    rows = [
        row for row in dataset("drying", "foods_beuchat1981") if row["activity_low"] < water_activity_limit
    ]
    if not rows:
        least = min(row["activity_low"] for row in dataset("drying", "foods_beuchat1981"))
        raise InputError(
            _(
                "No food of the table lies below a water activity of {given}; the driest begin at {least}."
            ).format(given=format_number(water_activity_limit, 3), least=format_number(least, 3)),
            name="water_activity_limit",
        )
    grows: Any = tuple(
        ", ".join(_(name) for name, limit in LIMITS.items() if row["activity_high"] > limit) or _("nothing")
        for row in rows
    )
    names: Any = tuple(_(row["food"]) for row in rows)
    return Foods(
        names,
        np.array([row["activity_low"] for row in rows]),
        np.array([row["activity_high"] for row in rows]),
        grows,
    )


class FoodMoistures(NamedTuple):
    """Water contents of foods, the moistest first."""

    food: Annotated[str, Series("foods")]
    moisture_wet_basis_low: Annotated[MoistureWetBasis, Series("foods")]
    moisture_wet_basis_high: Annotated[MoistureWetBasis, Series("foods")]
    moisture_dry_basis_low: Annotated[MoistureDryBasis, Series("foods")]
    moisture_dry_basis_high: Annotated[MoistureDryBasis, Series("foods")]


@procedure(source="makhlouf2020", title="Water content of foods")
def food_moistures(moisture_wet_basis_limit: MoistureWetBasis = 0.0) -> FoodMoistures:
    """Water content of foods as they are bought, on both bases.

    Only foods that reach ``moisture_wet_basis_limit`` are listed. The course notes' table II.2 (its
    source not opened), without the lentils that it prints beside lettuce.

    >>> found = food_moistures()
    >>> found.food[-1], float(found.moisture_wet_basis_high[-1])
    ('milk powder', 0.04)
    """
    rows = [
        row
        for row in dataset("drying", "food_moistures_makhlouf2020")
        if row["high"] >= moisture_wet_basis_limit
    ]
    if not rows:
        most = max(row["high"] for row in dataset("drying", "food_moistures_makhlouf2020"))
        raise InputError(
            _("No food of the table holds {given} % of water; the moistest reach {most} %.").format(
                given=format_number(100.0 * moisture_wet_basis_limit, 3), most=format_number(100.0 * most, 3)
            ),
            name="moisture_wet_basis_limit",
        )
    low, high = (np.array([row[end] for row in rows]) for end in ("low", "high"))
    names: Any = tuple(_(row["food"]) for row in rows)
    return FoodMoistures(names, low, high, low / (1.0 - low), high / (1.0 - high))
