"""The utilities of a line on the page: folded, told in one figure, as the run tells them."""

from __future__ import annotations

from urllib.parse import quote

import pytest
from tests.app.browsing import Page

CASE = "examples:starch-drying/line.toml"


@pytest.fixture
def page(browser, address) -> Page:
    return Page(browser, address)


@pytest.mark.parametrize(
    ("language", "word", "heat"),
    [
        pytest.param("en", "Utilities", "heat supplied", marks=pytest.mark.long),
        ("fr", "Utilités", "chaleur fournie"),
    ],
)
def test_what_a_line_takes_is_folded_below_its_streams(
    page: Page, language: str, word: str, heat: str
) -> None:
    page.open(f"lines/{quote(CASE, safe='')}", language)
    fold = page.one("[data-utilities]")
    assert word in fold.text
    assert "kJ/kg" in fold.text, "the energy per water stands in the heading"
    assert heat not in fold.text, "folded"
    page.browser.execute_script("arguments[0].open = true", fold)
    page.settle()
    assert heat in fold.text
    assert "(443" in fold.text, "heat that the heater gives stands in brackets"
    page.check()
