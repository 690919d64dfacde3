"""The Sankey diagrams of a line on the page: folded, one at a time, in the colors of the page."""

from __future__ import annotations

import os
from pathlib import Path
from urllib.parse import quote

import pytest
from selenium.webdriver.support.ui import Select
from tests.app.browsing import Page

CASE = "examples:spray-drying/line.toml"
PICTURES = os.environ.get("GRANUM_PICTURES")


@pytest.fixture
def page(browser, address) -> Page:
    return Page(browser, address)


@pytest.mark.parametrize(
    ("language", "theme", "width", "word", "subject"),
    [
        ("en", "light", 1400, "Energy counts from liquid water", "vapor"),
        ("fr", "dark", 390, "L’énergie se compte", "vapeur"),
    ],
)
def test_a_line_shows_its_flows(
    page: Page, language: str, theme: str, width: int, word: str, subject: str
) -> None:
    page.open(f"lines/{quote(CASE, safe='')}", language, width=width, theme=theme)
    fold = page.one("[data-sankey]")
    page.browser.execute_script("arguments[0].open = true", fold)
    page.one("[data-sankey] .sankey-node")
    assert len(page.all("[data-sankey] .sankey-link")) > 10
    picture(page, fold, f"mass-{language}-{theme}-{width}")
    Select(page.one("[data-sankey] select")).select_by_value("energy")
    page.until(lambda: word in fold.text and subject in fold.text)
    page.one("[data-sankey] .sankey-node")
    page.settle()
    picture(page, fold, f"energy-{language}-{theme}-{width}")
    page.check()


def picture(page: Page, fold, name: str) -> None:
    """Where somebody wants to look."""
    if PICTURES:
        page.browser.execute_script("arguments[0].scrollIntoView()", fold)
        page.settle()
        (Path(PICTURES) / f"{name}.png").write_bytes(page.browser.get_screenshot_as_png())
