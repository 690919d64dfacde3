"""Powers of ten in a field: typed in every manner, printed as in a book, still a text that one edits."""

from __future__ import annotations

import pytest
from tests.app.browsing import MOSTLY_FRENCH, Page

CARD = "calculate/particles.terminal_velocity_stokes?particle_diameter=85+um&particle_density=2630+kg%2Fm%5E3&fluid_density=1020+kg%2Fm%5E3&dynamic_viscosity=1.2+cP"  # noqa: E501
FIELD = "#field-dynamic_viscosity"


@pytest.mark.parametrize("language", MOSTLY_FRENCH)
def test_a_power_of_ten_is_typed_with_its_unit_and_printed(page: Page, language: str) -> None:
    page.open(CARD, language)
    comma = "," if language == "fr" else "."
    for text in ("1.2e-3 Pa.s", "1.2·10^-3 Pa s", "1.2 × 10⁻³ Pa·s", "1.2x10^-3 Pa s"):
        field = page.type(FIELD, text.replace(".2", comma + "2"))
        number, unit = page.leave(field)
        assert (number, unit) == (f"0{comma}0012", "Pa*s"), text
    number, unit = page.leave(page.type(FIELD, "1.2e-8 Pa s".replace(".2", comma + "2")))
    assert (number, unit) == (f"1{comma}2 × 10⁻⁸", "Pa*s")
    field = page.one(FIELD)
    field.send_keys("\ue010", "\ue003", "9")  # End, Backspace: the power is text to edit
    number, _unit = page.leave(field)
    assert number.startswith(f"1{comma}2")
    page.settle()
    page.check()
