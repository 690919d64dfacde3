"""Hydroxides: standards of pH, textbook beginnings of precipitation, the vessel against its charges."""

from __future__ import annotations

import numpy as np
import pytest

import granum as gr
from granum.cases import read_text
from granum.core.errors import ConvergenceError, GranumError
from granum.materials.formulas.precipitation import hydroxide_molality

cz = gr.crystallization


def test_the_ion_product_of_water():
    """Exponents of the CRC handbook: 14.95, 13.99, 13.27 and 12.26 at 0, 25, 50 and 100 °C."""
    found = gr.materials.ionization_exponent_water(temperature=np.array([273.15, 298.15, 323.15, 373.15]))
    np.testing.assert_allclose(found, [14.95, 13.995, 13.275, 12.26], atol=0.01)


def test_charges_balance_on_both_sides_of_neutral():
    net = np.array([-1e-3, -1e-9, 0.0, 1e-9, 1e-3])
    hydroxide = np.asarray(hydroxide_molality(net, 1.0, 298.15))
    np.testing.assert_allclose(hydroxide - 10**-13.9995307 / hydroxide, net, rtol=1e-6, atol=1e-13)


def test_limewater_is_a_standard_of_ph():
    """Bates, Bower and Smith (1956): saturated calcium hydroxide has pH 12.45 at 25 °C, of 0.0203 mol/L with
    its complexes.
    """
    lime = cz.ph_saturated_hydroxide(5.02e-6)
    assert lime.ph_value == pytest.approx(12.45, abs=0.05)
    assert 0.015 < lime.cation_molality < 0.0203


def test_water_decides_over_iron():
    iron = cz.ph_saturated_hydroxide(2.79e-39, 3.0)
    assert iron.ph_value == pytest.approx(7.0, abs=0.001)


def test_beginnings_of_precipitation():
    """Textbook exercises: magnesium 1 mmol/L of 1e-11 begins at pH 10; nickel 0.1 mol/L of 2e-15 at 7.15;
    iron(III) of 4e-38 has fallen to 1e-6 mol/L at 3.53.
    """
    start = cz.ph_precipitation_hydroxide(np.array([1e-3, 0.1]), np.array([1e-11, 2e-15])).ph_value_start
    np.testing.assert_allclose(start, [10.0, 7.15], atol=0.005)
    iron = cz.ph_precipitation_hydroxide(1e-3, 4e-38, 3.0, residual_fraction=1e-3)
    assert iron.ph_value_end == pytest.approx(3.53, abs=0.01)
    assert cz.ph_precipitation_hydroxide(1e-3, 1e-11, ionic_strength=0.1).ph_value_start > 10.0


@pytest.fixture(scope="module")
def vessel():
    return gr.alone("crystallization.hydroxide_precipitator").solve()


def test_the_ph_is_that_of_the_ions_left(vessel):
    """Recomputed from the liquor that leaves: sodium and chlorine balance all but magnesium and hydroxide."""
    v = vessel.units["hydroxide_precipitator"].values
    liquid = vessel.streams["hydroxide_precipitator.product"].liquid
    magnesium, lye = liquid[1] / 0.0952104 / liquid[0], liquid[2] / 0.0399971 / liquid[0]
    assert float(v.cation_molality) == pytest.approx(float(magnesium), rel=1e-4)
    strength = float(v.ionic_strength)
    root = np.sqrt(strength)
    activity = 10 ** (-0.509 * (root / (1 + root) - 0.3 * strength))
    assert float(v.ph_value) == pytest.approx(14.0 + np.log10(activity * float(lye)), abs=0.01)
    product = 10 ** (-0.509 * 4 * (root / (1 + root) - 0.3 * strength)) * magnesium * (activity * lye) ** 2
    assert float(v.supersaturation_ratio) == pytest.approx(float(product / 5.61e-12) ** (1 / 3), rel=0.01)
    assert vessel.audit["mass_closure"] < 1e-9


def test_each_precipitator_names_the_other():
    salt = {
        "mixture": {
            "liquids": "water,magnesium chloride,sodium hydroxide,sodium chloride",
            "solids": "magnesium hydroxide",
        },
        "feed": {"liquid.water": 0.99, "liquid.magnesium chloride": 0.01},
        "reagent": {"liquid.water": 0.99, "liquid.sodium hydroxide": 0.01},
    }
    with pytest.raises(GranumError, match="hydroxide_precipitator"):
        gr.alone("crystallization.precipitator", **salt).solve()


COPPER = """
title = "Copper by lye"
[solid."copper(II) hydroxide"]
formula = "Cu(OH)2"
molar_mass = 0.09756
density = {{ value = 3360.0, source = "haynes2014, sec. 4" }}
heat_capacity = {{ value = 900.0, source = "assumed" }}
[mixture]
liquids = ["water", "copper sulfate", "sodium hydroxide", "sodium sulfate"]
solids = ["copper(II) hydroxide"]
sizes = {{ smallest = "0.1 um", largest = "200 um", classes = 40 }}
[feeds.metal]
to = "vessel.feed"
liquid_flow = "2 t/h"
liquid = {{ water = 0.99, "copper sulfate" = 0.01 }}
[feeds.lye]
to = "vessel.reagent"
liquid_flow = "1 t/h"
liquid = {{ water = {water}, "sodium hydroxide" = {lye} }}
[units.vessel]
model = "crystallization.hydroxide_precipitator"
temperature = "25 degC"
volume = "1 m3"
rotation_speed = "200 rpm"
growth = {{ law = "power_law_growth", growth_coefficient = 1e-11, growth_order = 1.5 }}
[units.vessel.nucleation]
law = "secondary_nucleation"
nucleation_coefficient = 1e7
nucleation_order = 1.8
magma_order = 0
"""


def copper(lye: float):
    return read_text(COPPER.format(lye=lye, water=1.0 - lye)).solve()


def test_copper_takes_its_share_of_the_lye():
    """Two hydroxides for each copper by hand; what is left of the lye, with Davies, is the pH."""
    v = copper(0.02).units["vessel"].values
    copper_fed, lye_fed = 20.0 / 0.159609, 20.0 / 0.0399971  # mol/h
    water = 1980.0 + 980.0
    assert float(v.yield_fraction) == pytest.approx(1.0, abs=1e-6)
    sodium, sulfate = lye_fed / water, copper_fed / water
    left = (lye_fed - 2.0 * copper_fed) / water
    root = np.sqrt(0.5 * (sodium + 4.0 * sulfate + left))
    activity = 10 ** (-0.509 * (root / (1 + root) - 0.3 * root**2))
    assert float(v.ph_value) == pytest.approx(14.0 + np.log10(activity * left), abs=0.005)


@pytest.mark.parametrize("lye", [0.0, 0.005])
def test_a_metal_that_would_leave_an_acid_is_refused(lye: float):
    with pytest.raises(ConvergenceError, match="leaves an acid"):
        copper(lye)
