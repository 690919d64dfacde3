"""Costs: printed worked examples, interest tables, sums done by hand from the printed coefficients,
limits.
"""

from __future__ import annotations

import numpy as np
import pytest

from granum import costs
from granum.core.errors import ApplicabilityError, InputError
from granum.costs.tables import correlations, plant_cost_index

YEAR = 365.25 * 86400.0


def test_exchanger_of_the_textbook() -> None:
    """Turton et al. print 25 000 USD (2001) for a floating-head exchanger of 100 m² in carbon steel."""
    assert costs.purchased_cost_exchanger(area=100.0) == pytest.approx(25000.0, rel=0.02)


@pytest.mark.parametrize(
    ("call", "logarithm", "factor"),
    [
        # sums of the printed coefficients at a size of 10, where log10 = 1
        (
            lambda: costs.equipment_cost_by_area(area=10.0, equipment_by_area="plate_and_frame_filter"),
            4.2756 + 0.3520 + 0.0714,
            1.80,
        ),
        (
            lambda: costs.equipment_cost_by_area(area=10.0, equipment_by_area="disc_or_drum_filter"),
            4.8123 + 0.2858 + 0.0420,
            1.65,
        ),
        (
            lambda: costs.equipment_cost_by_area(area=10.0, equipment_by_area="rotary_dryer"),
            3.5645 + 1.1118 - 0.0777,
            1.25,
        ),
        (
            lambda: costs.equipment_cost_by_volume(volume=10.0, equipment_by_volume="batch_crystallizer"),
            4.5097 + 0.1731 + 0.1344,
            1.60,
        ),
        (
            lambda: costs.equipment_cost_by_diameter(diameter=1.0, centrifuge="solid_bowl_centrifuge"),
            4.9697,
            1.27,
        ),
    ],
)
def test_purchase_from_the_printed_coefficients(call, logarithm: float, factor: float) -> None:
    found = call()
    assert found.purchased_cost == pytest.approx(10.0**logarithm, rel=1e-12)
    assert found.bare_module_cost == pytest.approx(factor * 10.0**logarithm, rel=1e-12)


@pytest.mark.parametrize(
    ("call", "logarithm"),
    [
        (
            lambda: costs.purchased_cost_evaporator(area=100.0, evaporator="falling_film_evaporator"),
            3.9119 + 2 * 0.8627 - 4 * 0.0088,
        ),
        (
            lambda: costs.purchased_cost_fan(volume_flow="10 m3/s", fan="backward_curved_fan"),
            3.3471 - 0.0734 + 0.3090,
        ),
        (lambda: costs.purchased_cost_pump(power="100 kW"), 3.3892 + 2 * 0.0536 + 4 * 0.1538),
        (lambda: costs.equipment_cost_mixer(power="10 kW").purchased_cost, 3.8511 + 0.7009 - 0.0003),
    ],
)
def test_machines_from_the_printed_coefficients(call, logarithm: float) -> None:
    assert call() == pytest.approx(10.0**logarithm, rel=1e-12)


def test_sizes_outside_the_table_are_flagged() -> None:
    inside = costs.equipment_cost_by_area.evaluate(area=50.0)
    outside = costs.equipment_cost_by_area.evaluate(area=500.0)
    assert inside.notices == []
    assert [n["flag"] for n in outside.notices] == ["extrapolated"]
    assert outside.notices[0]["high"] == 80.0


def test_every_row_belongs_to_a_formula_and_costs_more_when_larger() -> None:
    choices = {
        c
        for card, name in (
            ("equipment_cost_by_area", "equipment_by_area"),
            ("equipment_cost_by_volume", "equipment_by_volume"),
            ("equipment_cost_by_diameter", "centrifuge"),
            ("purchased_cost_exchanger", "exchanger"),
            ("purchased_cost_evaporator", "evaporator"),
            ("purchased_cost_fan", "fan"),
            ("purchased_cost_pump", "pump"),
            ("equipment_cost_mixer", "mixer"),
        )
        for c in getattr(costs, card).card.parameter(name).choices
    }
    assert choices == set(correlations())
    for name, row in correlations().items():
        # some printed parabolas have a minimum below
        logs = np.log10(np.geomspace(np.sqrt(row.smallest * row.largest), row.largest, 50))
        rises = np.diff(row.k1 + row.k2 * logs + row.k3 * logs**2) > 0
        # the printed parabola of that one falls beyond 10**(1.0368/1.21) = 7.2 m²
        assert rises.all() or name == "stationary_screen", name


def test_index_and_updating() -> None:
    """The magazine's annual averages; 2001 to 2018 multiplies by 603.1/394.3 = 1.5295."""
    assert costs.cost_index_annual(year=2018.0) == 603.1
    assert costs.cost_index_annual(year=2008.5) == pytest.approx((575.4 + 521.9) / 2)
    updated = costs.cost_updated(cost=1000.0, cost_index_known=394.3, cost_index=603.1)
    assert updated == pytest.approx(1529.5, abs=0.1)
    assert np.all(np.diff(plant_cost_index()[0]) == 1)
    assert costs.cost_index_annual.evaluate(year=2025.0).notices[0]["flag"] == "extrapolated"


def test_six_tenths_rule() -> None:
    """Doubling the capacity costs 52 % more, quadrupling 2.30 times."""
    assert costs.purchased_cost_scaled(purchased_cost_known=1.0, capacity_ratio=2.0) == pytest.approx(
        1.52, abs=0.005
    )
    assert costs.purchased_cost_scaled(purchased_cost_known=1.0, capacity_ratio=4.0) == pytest.approx(
        2.297, abs=5e-4
    )


@pytest.mark.parametrize(
    ("rate", "years", "factor"),
    # capital recovery factors of interest tables
    [(0.08, 20, 0.10185), (0.10, 10, 0.16275), (0.12, 5, 0.27741), (0.05, 30, 0.06505)],
)
def test_annuity_of_interest_tables(rate: float, years: int, factor: float) -> None:
    charge = costs.annual_capital_charge(capital_cost=1.0, interest_rate=rate, lifetime=years * YEAR)
    assert charge * YEAR == pytest.approx(factor, abs=6e-6)


def test_annuity_without_interest_is_the_capital_over_its_life() -> None:
    for rate in (0.0, 1e-8):
        assert costs.annual_capital_charge(
            capital_cost=12.0, interest_rate=rate, lifetime=12 * YEAR
        ) * YEAR == pytest.approx(1.0, rel=1e-6)


def test_energy_material_payback() -> None:
    assert costs.energy_cost_rate(power="1 MW", energy_price="50 USD/MWh") * 3600 == pytest.approx(50.0)
    assert costs.material_cost_rate(
        mass_flow="2 tonne/hour", mass_price="30 USD/tonne", operating_fraction=0.5
    ) * 3600 == pytest.approx(30.0)
    assert costs.payback_time(capital_cost=2e6, annual_gain=0.5e6 / YEAR) / YEAR == pytest.approx(4.0)
    with pytest.raises(ApplicabilityError, match="Without a gain nothing is paid back"):
        costs.payback_time(capital_cost=2e6, annual_gain=0.0)
    assert costs.capital_cost_lang(purchased_cost=1e6, plant_type="fluids") == pytest.approx(4.74e6)


def test_years_given_as_seconds_and_percent_as_numbers_are_told() -> None:
    assert "in seconds" in costs.annual_capital_charge.evaluate(1e5, 0.07, 5.0).notices[0]["message"]
    assert "per second" in costs.payback_time.evaluate(1e5, 25000.0).notices[0]["message"]
    assert not costs.payback_time.evaluate(1e5, "25000 USD/year").notices
    with pytest.raises(InputError, match="7 %"):
        costs.annual_capital_charge(1e5, 7.0, "5 year")


@pytest.mark.parametrize(("area", "falls"), [(15.0, True), (21.0, True), (22.0, False), (900.0, False)])
def test_a_price_that_falls_with_size_is_told(area: float, falls: bool) -> None:
    """Table A.1, floating head: the slope 2 × 0.3187 log A − 0.8509 is zero at 21.6 m²."""
    result = costs.purchased_cost_exchanger.evaluate(area=area)
    assert any("falls here" in notice["message"] for notice in result.notices) == falls
