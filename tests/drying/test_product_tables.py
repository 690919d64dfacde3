"""The tables a student starts from: applications of dryers, water contents and activities of foods."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from granum.app.finding import found
from granum.core.errors import InputError
from granum.core.i18n import language
from granum.drying.isotherms.products import PRODUCTS
from granum.drying.product_tables import applications, food_moistures, foods
from granum.drying.selection import choose


def test_maize_is_that_of_the_notes_exercise():
    """The exercise dries 100 kg from 35 kg of water on 65 kg of solid to 11.7 kg: 23.3 kg off 76.7 kg."""
    table = applications()
    at = table.product.index("maize")
    x1, x2 = table.moisture_wet_basis_inlet_low[at], table.moisture_wet_basis_outlet_low[at]
    assert x1 / (1 - x1) == pytest.approx(0.54, abs=0.005)
    assert x2 / (1 - x2) == pytest.approx(0.18, abs=0.005)
    assert table.evaporation_per_product[at] == pytest.approx(23.3 / 76.7, rel=0.02)


def test_every_application_dries_in_a_dryer_that_can_be_chosen():
    table = applications()
    assert len(table.product) == 44  # 49 of the notes less five that have no figure anywhere
    assert set(table.dryer) <= set(choose("powder", 1.0, 0.3, 0.02).dryer)
    assert np.all(table.moisture_wet_basis_inlet_low <= table.moisture_wet_basis_inlet_high)
    assert np.all(table.moisture_wet_basis_outlet_low <= table.moisture_wet_basis_outlet_high)
    assert np.all(table.moisture_wet_basis_outlet_high < table.moisture_wet_basis_inlet_high)
    assert np.all(table.evaporation_per_product > 0)


@pytest.mark.parametrize(
    ("product", "per_dry_in", "per_dry_out"),
    [
        ("mushrooms", 8.09, 0.05 / 0.95),  # 809 % on the dry basis, a drying study
        ("whey", 49.0 / 51.0, 0.05 / 0.95),  # 42 to 60 % of solids
        ("peas", 0.185 / 0.815, 0.14 / 0.86),
    ],
)
def test_what_the_notes_leave_open_is_filled(product, per_dry_in, per_dry_out):
    """Water evaporated per dried product, from moistures per dry solid by hand."""
    table = applications()
    at = table.product.index(product)
    by_hand = (per_dry_in - per_dry_out) / (1.0 + per_dry_out)
    assert table.evaporation_per_product[at] == pytest.approx(by_hand, rel=0.02)


def test_each_dryer_has_its_share_of_the_table():
    table = applications()
    names: Any = set(table.dryer)
    shares = {name: applications(name).product for name in names}
    assert sum(map(len, shares.values())) == len(table.product)
    assert all(shares.values())


@pytest.mark.parametrize(("grain", "food", "wet"), [("rice", "rice", 0.12), ("wheat", "wheat", 0.12)])
def test_isotherms_measured_elsewhere_agree_with_the_activity_of_dry_grain(grain, food, wet):
    """Grain of 12 % water, by the isotherms of the grain standard, and the range of Beuchat."""
    table = foods()
    at = table.food.index(food)
    law = PRODUCTS[grain]()
    dry = wet / (1 - wet)
    low, high = (law(end[at], 298.15) for end in (table.water_activity_low, table.water_activity_high))
    assert low - 0.01 < dry < high + 0.01


def test_the_drier_the_food_the_less_grows():
    table = foods()
    counts = [0 if words == "nothing" else len(words.split(",")) for words in table.grows]
    assert np.all(np.diff(table.water_activity_high) <= 0)
    assert np.all(np.diff(counts) <= 0)
    assert all(words == "nothing" for words in foods(0.6).grows)


def test_few_foods_keep_and_none_is_below_the_driest():
    assert set(foods(0.5).food) < set(foods(0.8).food) < set(foods().food)
    with pytest.raises(InputError, match=r"0\.2"):
        foods(0.1)
    with pytest.raises(InputError, match="95 %"):
        food_moistures(0.97)


def test_water_contents_fall_down_the_table_and_agree_with_the_activity():
    """What holds more water lies higher in activity: fruit above jam, jam above flour, flour above milk
    powder, in both tables, which come from different authors.
    """
    wet, active = food_moistures(), foods()
    assert np.all(wet.moisture_dry_basis_low <= wet.moisture_dry_basis_high)
    named = [
        ("apples", "fresh fruit"),
        ("jam", "jam"),
        ("flour", "flour"),
        ("milk powder", "whole milk powder"),
    ]
    for one, two in pairwise(named):
        assert (
            wet.moisture_wet_basis_low[wet.food.index(one[0])]
            > wet.moisture_wet_basis_high[wet.food.index(two[0])]
        )
        assert (
            active.water_activity_low[active.food.index(one[1])]
            >= active.water_activity_high[active.food.index(two[1])]
        )


@pytest.mark.parametrize(
    ("asked", "code", "card"),
    [
        ("marzipan", "en", "drying.foods"),
        ("pâte d'amande", "fr", "drying.foods"),
        ("NPK fertilizer", "en", "drying.applications"),
        ("pulpe de betterave", "fr", "drying.applications"),
        ("avocados", "en", "drying.food_moistures"),
    ],
)
def test_a_row_is_found_by_its_name(asked, code, card):
    with language(code):
        assert card in [hit["key"] for hit in found(asked)][:3]


def test_rows_are_told_in_french():
    with language("fr"):
        for english, french in (
            (applications().product, "boues de peinture hydrosoluble"),
            (foods().food, "poudre d’œuf entier"),
            (food_moistures().food, "pommes de terre"),
        ):
            assert french in english
