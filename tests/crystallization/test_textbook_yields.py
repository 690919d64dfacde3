"""Yields of published problems, entered as their statements give them; each answer was opened."""

from __future__ import annotations

import pytest

from granum.crystallization.formulas.balances import (
    crystallizer_balance,
    crystallizer_balance_library,
    evaporation_for_yield,
)


def test_soda_that_loses_water_as_it_cools() -> None:
    """An examination (chemicalengineeringexam.top, week 47 of 2025): 1000 kg of 30 % leave 700 kg of
    decahydrate and a liquor of 21.5 kg per 100 kg; 10.1 % of the water has evaporated.
    """
    anhydrous = 106.0 / 286.0
    gone = evaporation_for_yield(1000.0, 700.0 * anhydrous / 300.0, 0.3, 0.215, anhydrous)
    assert float(gone) / 700.0 == pytest.approx(0.101, abs=5e-4)


def test_epsom_salt_and_saltpeter_of_elementary_principles() -> None:
    """Felder and Rousseau, 6.77: 2150 kg/h of 35 % for 1000 kg/h of heptahydrate beside liquor of 23 %, 1150
    kg/h. 6.78: half saltpeter, cooled from 80 to 25 °C; 0.300 lb of crystals by a chart that has 40 g in
    100 g of water, where the handbook has 38.
    """
    made = crystallizer_balance(2150.0, 0.35, 0.23 / 0.77, 120.37 / 246.47)
    assert float(made.crystal_flow) == pytest.approx(1000.0, rel=3e-3)
    assert float(made.mother_liquor_flow) == pytest.approx(1150.0, rel=3e-3)
    by_chart = crystallizer_balance(1.0, 0.5, 0.4)
    assert float(by_chart.crystal_flow) == pytest.approx(0.300, abs=5e-4)
    assert float(by_chart.crystal_flow / by_chart.mother_liquor_flow) == pytest.approx(0.429, abs=5e-4)
    known = crystallizer_balance_library(1.0, 0.5, 298.15, 353.15, "potassium nitrate")
    assert float(known.crystal_flow) == pytest.approx(0.300, rel=0.04)
