"""Every kind of chart: none of its buttons sends anything anywhere; states of humid gas as a table."""

from __future__ import annotations

import csv
import json
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest
from selenium.webdriver.common.keys import Keys
from tests.app.browsing import Page, resize

INDEX = Path(str(files("granum") / "core" / "index.csv"))
CARDS = list(csv.DictReader(INDEX.read_text(encoding="utf-8").splitlines()))
CHARTS = [row["key"] for row in CARDS if row["sort"] == "chart"]
# names of laws as files have them, with and without the family before
LAWS = {
    word.replace("_", " ")
    for row in CARDS
    if row["sort"] == "law"
    for name in [row["key"].partition(".")[2]]
    for word in (name, name.removeprefix(f"{row['family']}_"))
}

ALSO_PICTURES = (
    "humid_gas.psychrometric_chart",
    "particles.drag_chart",
)  # the browser takes a moment to paint one


def asked(page: Page) -> list[str]:
    """Addresses that the page has asked for since this was called last."""
    found = []
    for entry in page.browser.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            found.append(message["params"]["request"]["url"])
    return found


@pytest.fixture(scope="module")
def visited(browser: Any, address: str) -> Page:
    """The page of charts, opened once."""
    found = Page(browser, address)
    found.open("home")
    return found


@pytest.mark.parametrize("chart", CHARTS)
def test_no_button_of_a_chart_sends_anything_anywhere(visited: Page, chart: str) -> None:
    page = visited
    page.browser.get_log("performance")
    page.visit(f"charts/{chart}")
    assert page.text("main h1")
    words = [e.text for e in page.all(".fields select.alone option:checked")]
    assert not [word for word in words if word in LAWS], "a law by its title"
    windows = len(page.browser.window_handles)
    if page.all(".plot"):  # some charts wait for a table of one's own
        buttons = page.until(lambda: page.all(".plot .modebar-btn"))
        titles = [b.get_attribute("data-title") or "" for b in buttons]
        assert not [t for t in titles if any(w in t.lower() for w in ("share", "cloud", "edit", "upload"))]
        for button in buttons:
            assert button.tag_name == "button", "reached by keyboard"
            page.browser.execute_script("arguments[0].click()", button)
        for name in ("SVG", "CSV", *(["PNG"] if chart in ALSO_PICTURES else [])):
            for button in page.all(".files button"):
                if button.text == name:
                    page.browser.execute_script(
                        "HTMLAnchorElement.prototype.click = () => {}; arguments[0].click()", button
                    )
        page.settle()
    outside = [url for url in asked(page) if not url.startswith((page.address, "data:", "blob:", "about:"))]
    assert not outside
    assert len(page.browser.window_handles) == windows


@pytest.mark.parametrize(
    ("language", "add"),
    [pytest.param("en", "Add a state", marks=pytest.mark.long), ("fr", "Ajouter un état")],
)
def test_states_of_humid_gas_are_a_table(page: Page, language: str, add: str) -> None:
    page.open(
        "charts/humid_gas.psychrometric_chart?temperature=20+60+degC&humidity_ratio=8+8+g%2Fkg", language
    )
    page.one(".plot .main-svg .scatterlayer .trace")
    page.until(lambda: len(page.all(".states tbody tr")) == 2)
    page.button(add).click()
    page.until(lambda: len(page.all(".states tbody tr")) == 3)
    page.settle()

    def cell(row: int, column: int) -> str:
        return f".states tbody tr:nth-child({row}) td:nth-child({column}) input"

    for column, typed in ((2, "35"), (4, "30")):  # temperature, then relative humidity
        field = page.one(cell(3, column))
        field.send_keys(Keys.CONTROL, "a")
        field.send_keys(typed)
        field.send_keys(Keys.ENTER)
        page.settle()
    # the course reads 10.5 g/kg for air at 35 °C and 30 %
    page.until(lambda: abs(float(page.one(cell(3, 3)).get_attribute("value").replace(",", ".")) - 10.5) < 0.2)
    page.until(lambda: "35+degC" in page.browser.current_url)
    page.all(".states tbody button")[0].click()
    page.until(lambda: len(page.all(".states tbody tr")) == 2)
    page.settle()
    heads = [th.get_attribute("textContent").strip() for th in page.all(".states th")]
    assert all(heads), "every column has a name for those who listen"
    regions = [e.get_attribute("aria-label") for e in page.all("section[aria-label], [role=region]")]
    assert len(set(regions)) == len(regions), "no two landmarks have one name"
    page.check()
    resize(page, 390)
    table = page.one("[role=region]:has(.states)")
    assert table.get_property("scrollWidth") <= table.get_property("clientWidth"), "on a phone they are lists"
    page.check()


def test_the_table_of_a_chart_is_one_of_the_page(page: Page) -> None:
    page.open(
        "charts/humid_gas.psychrometric_chart?temperature=68+140+degF&humidity_ratio=8+8+g%2Fkg", width=390
    )
    page.one(".plot .main-svg .scatterlayer .trace")
    assert len(page.all(".wide table tbody tr")) == 2, (
        "lists in other units stay lists, their states are told"
    )
    page.check()
