"""What dry air is made of, against what others state of the whole."""

from __future__ import annotations

import pytest

import granum as gr
from granum.app.finding import found
from granum.core.datasets import columns
from granum.core.errors import InputError
from granum.core.i18n import language
from granum.humid_gas.dry_air import STANDARD, air_composition


def test_its_molar_mass_is_that_of_the_standard_and_of_metrology() -> None:
    """28.9644 g/mol in the standard's text, 28.965 46 at 400 ppm of carbon dioxide in the formula CIPM-2007,
    which starts from newer amounts of argon and oxygen. The standard adds up shares whose sum is just below
    one.
    """
    listed = columns("humid_gas", "air_usstandard1976")["mole_fraction"].sum()
    assert air_composition().molar_mass_mean * listed * 1e3 == pytest.approx(28.9644, abs=5e-5)
    assert air_composition(400e-6).molar_mass_mean * 1e3 == pytest.approx(28.96546, abs=2e-4)


def test_by_mass_it_is_what_textbooks_state() -> None:
    """Wallace and Hobbs, table 1.1: 75.51 % of nitrogen, 23.14 of oxygen, 1.28 of argon."""
    for share, printed in zip(air_composition().mass_fraction, (0.7551, 0.2314, 0.0128), strict=False):
        assert share == pytest.approx(printed, abs=1.2e-4)


def test_shares_add_up_and_what_is_burned_takes_oxygen() -> None:
    plain, stale = air_composition(), air_composition(1e-3)
    for one in (plain, stale):
        assert one.mole_fraction.sum() == pytest.approx(1.0, abs=1e-15)
        assert one.mass_fraction.sum() == pytest.approx(1.0, abs=1e-15)
    oxygen, dioxide = plain.chemical_formula.index("O2"), plain.chemical_formula.index("CO2")
    grown = stale.mole_fraction - plain.mole_fraction
    assert grown[dioxide] == pytest.approx(1e-3 - STANDARD, rel=1e-4)
    assert grown[oxygen] == pytest.approx(-grown[dioxide], rel=1e-12)
    assert stale.molar_mass_mean > plain.molar_mass_mean
    with pytest.raises(InputError, match="carbon_dioxide_fraction"):
        air_composition(0.3)


def test_air_of_the_library_weighs_the_same() -> None:
    from granum.materials.library import fluid

    assert fluid("dry air").molar_mass == pytest.approx(air_composition().molar_mass_mean, rel=3e-4)


@pytest.mark.parametrize(
    ("asked", "code"), [("krypton", "en"), ("composition de l'air", "fr"), ("xénon", "fr")]
)
def test_it_is_found_by_its_gases(asked: str, code: str) -> None:
    with language(code):
        assert "humid_gas.air_composition" in [hit["key"] for hit in found(asked)][:3]


def test_gases_are_told_in_french() -> None:
    with language("fr"):
        assert gr.humid_gas.air_composition().gas[:2] == ("azote", "oxygène")
