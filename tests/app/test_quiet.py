"""What a page keeps to itself, and how it writes French."""

from __future__ import annotations

import json
import re

import pytest
from tests.app.browsing import Page

LOCAL = ("http://127.0.0.1", "blob:", "data:")


def requests(page: Page) -> list[str]:
    """Addresses asked for since the last look."""
    messages = [json.loads(e["message"])["message"] for e in page.browser.get_log("performance")]
    return [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]


@pytest.mark.parametrize("place", ["charts/humid_gas.psychrometric_chart", "charts/particles.drag_chart"])
def test_no_button_of_a_chart_sends_anything_anywhere(page: Page, place: str) -> None:
    page.open(place)
    page.until(lambda: page.all(".modebar-btn"))
    windows = page.browser.window_handles
    requests(page)
    names = [b.get_attribute("data-title") for b in page.all(".modebar-btn")]
    assert len(names) >= 4
    assert not [name for name in names if re.search(r"share|cloud|upload|edit", name, re.IGNORECASE)]
    for at in range(len(names)):
        page.browser.execute_script("document.querySelectorAll('.modebar-btn')[arguments[0]].click()", at)
    for text in ("SVG", "PNG", "CSV"):
        page.button(text).click()
    page.settle()
    assert not [url for url in requests(page) if not url.startswith(LOCAL)]
    assert page.browser.window_handles == windows
    page.check()


@pytest.mark.parametrize("place", ["home", "studies", "lines", "calculate/particles.terminal_velocity"])
def test_french_is_printed_with_its_apostrophe(page: Page, place: str) -> None:
    page.open(place, "fr")
    text = page.browser.execute_script("return document.body.innerText")
    assert not re.findall(r"\w+'\w+", text)
