"""How a page writes French."""

from __future__ import annotations

import re

from tests.app.browsing import Page


def test_french_is_printed_with_its_apostrophe(page: Page) -> None:
    page.open("home", "fr")
    for place in ("home", "studies", "lines", "calculate/particles.terminal_velocity"):
        page.visit(place)
        text = page.browser.execute_script("return document.body.innerText")
        assert not re.findall(r"\w+'\w+", text), place
