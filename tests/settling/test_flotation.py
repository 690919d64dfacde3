"""Dissolved-air flotation: air in water, the recycle of a printed example, bubbles and what rises."""

from __future__ import annotations

import pytest

import granum as gr


def test_air_in_water() -> None:
    """Benson and Krause 1984 have 9.09 g/m³ of oxygen and Weiss 1970 14.9 g/m³ of nitrogen in fresh water
    under moist air of 1 atm at 20 °C; with argon 24.5 (from memory), and 2.3 % less than under dry air.
    """
    moist = gr.settling.air_solubility("20 degC", 101325.0 - 2339.0)
    assert 1e3 * moist == pytest.approx(24.5, rel=0.04)
    assert gr.settling.air_solubility("5 degC") > 1.2 * gr.settling.air_solubility("20 degC")


def test_recycle_of_the_handbook() -> None:
    """Metcalf and Eddy 2003, example 5-11 (from memory): 400 m³/d of 3 g/L at A/S = 0.008, half saturated at
    275 kPa above the atmosphere, need 462 m³/d of recycle.
    """
    ratio = 461.9 / 400.0
    air = gr.settling.air_released(275e3 + 101325.0, ratio, saturator_efficiency=0.5, temperature="20 degC")
    found = gr.settling.air_to_solids_ratio(air, ratio, "3 g/L")
    assert found == pytest.approx(0.008, rel=0.06)


def test_no_air_below_the_pressure_that_water_holds_anyway() -> None:
    assert gr.settling.air_released("1.2 bar", 0.1, saturator_efficiency=0.8) == 0.0


def test_bubbles_meet_least_of_the_particles_around_a_micrometer() -> None:
    """Edzwald 2010, figure: the sum of diffusion and interception has its least value near 1 µm."""
    sizes = (1e-7, 1e-6, 2e-5)
    small, middle, large = (gr.settling.collector_efficiency_bubble(d, 60e-6, 1010.0) for d in sizes)
    assert middle < small
    assert middle < large
    assert 1e-4 < middle < 5e-3


def flotation(**inputs: object):
    run = gr.alone("settling.dissolved_air_flotation", **inputs).solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    return run


def test_white_water_of_waterworks() -> None:
    """Edzwald 2010 (from memory): 8 to 12 % of recycle at 4 to 6 bar give 5 to 9 mL of bubbles per liter."""
    run = flotation(recycle_ratio="10 %")
    assert 5e-3 < run.figure("dissolved_air_flotation.bubble_volume_fraction") < 9e-3


def test_more_air_more_time_and_more_area_float_more() -> None:
    base = flotation(recycle_ratio="8 %").figure("dissolved_air_flotation.removal_efficiency")
    more: tuple[dict[str, str], ...] = (
        {"recycle_ratio": "15 %"},
        {"recycle_ratio": "8 %", "contact_time": "4 min"},
        {"recycle_ratio": "8 %", "area": "80 m2"},
    )
    for better in more:
        assert flotation(**better).figure("dissolved_air_flotation.removal_efficiency") > base
    none = flotation(saturator_efficiency=0.1)
    assert none.figure("dissolved_air_flotation.removal_efficiency") == 0.0
    assert not all(c.ok for c in none.units["dissolved_air_flotation"].checks)


def test_the_recycle_takes_the_pump_and_the_compressor() -> None:
    run = flotation()
    recycle = run.figure("dissolved_air_flotation.recycle_flow")
    shaft = run.figure("dissolved_air_flotation.shaft_power")
    assert shaft == pytest.approx(recycle * (5.5e5 - 101325.0) / 0.7)
    # waterworks count 20 to 60 Wh/m³ for flotation (from memory)
    per_volume = shaft / 0.9 / (recycle / 0.15) / 3600.0
    assert 20.0 < per_volume < 60.0
