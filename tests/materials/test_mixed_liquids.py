"""Glycerol and seawater against tables of others."""

import pytest

from granum.core.errors import ApplicabilityError
from granum.materials import (
    dynamic_viscosity_glycerol_water,
    fluid,
    kinematic_viscosity_walther,
    seawater_conductivity,
    seawater_density,
    seawater_heat_capacity,
    seawater_vapor_pressure,
    seawater_viscosity,
)
from granum.particles import terminal_velocity_stokes


@pytest.mark.parametrize(
    ("share", "printed"),
    [(0.2, 1.76), (0.4, 3.72), (0.5, 6.00), (0.6, 10.8), (0.8, 60.1), (0.9, 219), (1, 1410)],
)
def test_glycerol_with_water_by_the_makers_table(share, printed):
    # Glycerine Producers' Association (1963), Physical Properties of Glycerine and Its Solutions, 20 °C, cP
    # (recalled)
    found = 1e3 * dynamic_viscosity_glycerol_water("20 degC", share)
    assert found == pytest.approx(printed, rel=0.025)


def test_glycerol_by_the_handbook():
    # CRC Handbook (transcribed in the package chemicals, opened): 1.2613 g/cm³ at 20 °C, 218.9 J/(mol K) and
    # boiling at 290 °C; density at 100 °C by the VDI equation of the same package 1208.2
    glycerol = fluid("glycerine")
    assert glycerol.liquid_density("20 degC") == pytest.approx(1261.3, rel=5e-4)
    assert glycerol.liquid_density("100 degC") == pytest.approx(1208.2, rel=5e-3)
    assert glycerol.liquid_heat_capacity("25 degC") * glycerol.molar_mass == pytest.approx(218.9, rel=5e-3)
    assert glycerol.boiling_temperature() == pytest.approx(563.15, abs=4.0)


def test_seawater_by_the_oceanographers():
    # UNESCO's equation of state at 25 °C and 35 g/kg: 1023.343 kg/m³ (recalled); a public table of liquids by
    # Sharqawy and others: specific gravity 1.023 and 0.959 mPa s at 25 °C (opened)
    sea = fluid("sea water")
    assert sea.liquid_density("25 degC") == pytest.approx(1023.343, rel=5e-4)
    assert 1e3 * sea.liquid_viscosity("25 degC") == pytest.approx(0.959, abs=1e-3)
    # without salt they are those of water, by the formulation of 1997 and its viscosity of 2008
    water = fluid("water")
    assert seawater_density("60 degC", 0.0) == pytest.approx(water.liquid_density("60 degC"), rel=1e-3)
    assert seawater_viscosity("60 degC", 0.0) == pytest.approx(water.liquid_viscosity("60 degC"), rel=0.01)
    assert sea.boiling_temperature() > water.boiling_temperature()
    assert sea.liquid_heat_capacity("20 degC") < water.liquid_heat_capacity("20 degC")


def test_seawater_carries_heat_and_evaporates_as_measured():
    """At 25 °C and 35 g/kg, all recalled: 3993 J/(kg K) by UNESCO's equation, 0.60 W/(m K) of encyclopedias,
    and Robinson's vapor pressure over that of water, 0.9814.
    """
    assert seawater_heat_capacity("25 degC") == pytest.approx(3993.0, rel=4e-3)
    assert seawater_conductivity("25 degC") == pytest.approx(0.60, rel=0.03)
    ratio = seawater_vapor_pressure("25 degC") / seawater_vapor_pressure("25 degC", 0.0)
    assert ratio == pytest.approx(0.9814, abs=2.5e-3)


def test_a_grain_falls_in_a_named_liquid():
    grain = {"particle_diameter": "50 um", "particle_density": 2650}
    assert terminal_velocity_stokes(**grain, fluid="glycerol at 20 °C") < terminal_velocity_stokes(
        **grain, fluid="seawater at 20 °C"
    )


@pytest.mark.parametrize(
    ("oil", "celsius", "printed", "within"),
    [
        # mm²/s, opened: a table of pump makers, measurements of others in a public table (see oils.toml)
        ("olive oil", 20, 91.5, 0.08),
        ("sunflower oil", 20, 65, 0.05),
        ("sunflower oil", 40, 31, 0.03),
        ("rapeseed oil", 25, 63, 0.04),
        ("rapeseed oil", 4, 178.9, 0.04),
        ("soybean oil", 0, 184.9, 0.03),
        ("soybean oil", 25, 55, 0.04),
        ("soybean oil", 100, 7.5, 0.07),
        ("palm oil", 60, 20, 0.06),
    ],
)
def test_oils_at_temperatures_between_and_beyond_their_two(oil, celsius, printed, within):
    known = fluid(oil)
    T = f"{celsius} degC"
    assert 1e6 * known.liquid_viscosity(T) / known.liquid_density(T) == pytest.approx(printed, rel=within)


@pytest.mark.parametrize(
    ("oil", "low", "high"),  # relative density at 20 °C by the Codex (recalled), of water
    [("olive oil", 0.910, 0.916), ("sunflower oil", 0.918, 0.923), ("soybean oil", 0.919, 0.925)],
)
def test_oils_are_as_dense_as_their_standard_allows(oil, low, high):
    assert low < fluid(oil).liquid_density("20 degC") / fluid("water").liquid_density("20 degC") < high


@pytest.mark.parametrize(
    ("cold", "middle", "hot"),
    [(153, 34, 9.1), (250, 50.5, 12.6), (18.6, 6.3, 2.4), (107, 23.3, 6.4), (171, 31, 7.5), (310, 44.2, 9.4)],
)
def test_mineral_oils_lie_on_the_line_of_the_chart(cold, middle, hot):
    # Engineering Tribology (2011), table 2.3, opened: mPa s at 30, 60 and 100 °C; densities of a usual oil
    rho = {t: 0.89 - 0.00065 * t for t in (30, 60, 100)}
    nu = kinematic_viscosity_walther(
        "60 degC", "30 degC", f"{cold / rho[30]} cSt", "100 degC", f"{hot / rho[100]} cSt"
    )
    assert 1e6 * nu * rho[60] == pytest.approx(middle, rel=0.025)


def test_mineral_oil_of_a_grade():
    oil = fluid("mineral oil")
    nu = [oil.liquid_viscosity(f"{t} degC") / oil.liquid_density(f"{t} degC") for t in (0, 20, 40, 100)]
    assert nu == sorted(nu, reverse=True)
    assert 1e6 * nu[2] == pytest.approx(46.0, rel=1e-6)
    with pytest.raises(ApplicabilityError, match="above the lower"):
        kinematic_viscosity_walther("20 degC", "40 degC", "46 cSt", "40 degC", "6.8 cSt")
    with pytest.raises(ApplicabilityError, match="thinner at the upper"):
        kinematic_viscosity_walther("20 degC", "40 degC", "6.8 cSt", "100 degC", "46 cSt")
