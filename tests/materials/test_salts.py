"""Sparingly soluble salts against textbook figures."""

from __future__ import annotations

import math

import pytest

from granum import materials as m
from granum.core.errors import InputError
from granum.core.sources import bibliography, keys_of


def test_activity_coefficients() -> None:
    """Harned and Owen: mean coefficient of NaCl 0.778 at 0.1 mol/kg and 25 °C; Debye–Hückel constant
    0.509.
    """
    assert m.activity_coefficient_davies(1.0, 0.1) == pytest.approx(0.778, rel=0.01)
    assert m.activity_coefficient_davies(-2.0, 0.01) == pytest.approx(
        10 ** (-0.509 * 4 * (0.1 / 1.1 - 0.003)), rel=4e-3
    )
    assert m.activity_coefficient_davies(3.0, 0.0) == pytest.approx(1.0, abs=1e-6)
    assert m.activity_coefficient_davies(2.0, 0.1) < m.activity_coefficient_davies(1.0, 0.1) < 1.0


WATEQ4F = {
    "barium carbonate": -8.562,
    "barium sulfate": -9.97,
    "cadmium carbonate": -12.1,
    "cadmium hydroxide": 13.65 - 28,
    "calcium carbonate": -8.48,
    "calcium fluoride": -10.6,
    "calcium hydroxide": 22.8 - 28,
    "copper(I) chloride": -6.76,
    "copper(I) iodide": -11.89,
    "gypsum": -4.58,
    "iron(II) carbonate": -10.45,
    "lead bromide": -5.18,
    "lead carbonate": -13.13,
    "lead chloride": -4.77,
    "lead iodide": -8.07,
    "lead sulfate": -7.79,
    "magnesium hydroxide": 16.84 - 28,
    "manganese carbonate": -10.39,
    "nickel carbonate": -6.84,
    "silver bromide": -12.27,
    "silver carbonate": -11.07,
    "silver chloride": -9.75,
    "silver iodide": -16.07,
    "silver sulfate": -4.92,
    "strontium carbonate": -9.271,
    "strontium fluoride": -8.54,
    "strontium sulfate": -6.63,
    "zinc carbonate": -10.0,
    "zinc hydroxide": 11.5 - 28,
}


def test_products_against_the_wateq4f_database() -> None:
    """Decimal logarithms of Ball and Nordstrom (1991), hydroxides from their dissolution by acid; 0.4 is what
    evaluations differ by.
    """
    for name, log in WATEQ4F.items():
        assert math.log10(m.salt(name).solubility_product) == pytest.approx(log, abs=0.4), name


NOTES = {  # course notes, table 1: temperature, product
    "barium sulfate": ("18 degC", 0.87e-10),
    "wurtzite": ("18 degC", 1.2e-23),
    "silver chloride": ("25 degC", 1.56e-10),
    "silver carbonate": ("25 degC", 6.15e-12),
}


def test_products_at_the_temperatures_of_the_course_notes() -> None:
    """The table of the notes at 18 and 25 °C; 0.15 in the logarithm is what evaluations differ by. What it
    prints for copper sulfate, 2e-47 at 16 to 18 °C, is nearer copper(I) sulfide than any other sulfide or
    sulfate.
    """
    for name, (temperature, product) in NOTES.items():
        found = m.salt_saturation(1e-6, 1e-6, 0.0, name, temperature).solubility_product
        assert math.log10(found) == pytest.approx(math.log10(product), abs=0.15), name
    misses = {n: abs(math.log10(float(m.salt(n).product_at(290.15)) / 2e-47)) for n in m.names("salt")}
    assert min(misses, key=lambda name: misses[name]) == "copper(I) sulfide"


def test_a_product_without_a_heat_stays_that_of_room_temperature_and_says_so() -> None:
    cold = m.salt_saturation.evaluate(
        cation_molality=1e-4, anion_molality=1e-4, ionic_strength=0.0, salt="lead fluoride", temperature=283.0
    )
    assert cold.outputs["solubility_product"] == pytest.approx(3.3e-8)
    assert any("heat of dissolution" in notice["message"] for notice in cold.notices)


def test_saturated_molalities() -> None:
    """Barium sulfate 2.4 mg/L, silver chloride 1.9 mg/L (haynes2014); lead chloride from its product, ideal,
    16 mmol/kg.
    """
    assert m.salt("BaSO4").saturated_molality() * 233.39 * 1e3 == pytest.approx(2.4, rel=0.03)
    assert m.salt("silver chloride").saturated_molality() * 143.32 * 1e3 == pytest.approx(1.9, rel=0.02)
    lead = m.salt("lead chloride")
    assert lead.saturated_molality() == pytest.approx((1.70e-5 / 4) ** (1 / 3))
    assert float(lead.saturation_index(0.0162, 0.0324, 0.0)) == pytest.approx(0.0, abs=0.01)
    # lead chloride dissolves 1.07 % by mass at 25 °C: more than its product allows ideally, because the ions
    # shield each other
    measured = m.solute("lead chloride").solubility("25 degC") / 0.2781
    assert float(lead.saturation_index(measured, 2 * measured, 3 * measured)) == pytest.approx(0.0, abs=0.5)


def test_every_salt_is_neutral_and_sourced() -> None:
    assert len(m.names("salt")) >= 50
    for name in m.names("salt"):
        s = m.salt(name)
        assert s.cation_count * s.cation_charge + s.anion_count * s.anion_charge == 0
        assert all(key in bibliography() for key in keys_of(s.source))
        assert 1e-50 < s.solubility_product < 1e-2
    with pytest.raises(InputError, match="barium sulfate"):
        m.salt_saturation(1e-4, 1e-4, 0.01, salt="barium sulfat")
    assert m.salt_saturation(1e-4, 1e-4, 0.01, "barium sulfate").saturation_ratio > 1.0
