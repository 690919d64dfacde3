"""A machine that fails its checks leads to the ranked list of those that suit what enters it."""

from __future__ import annotations

import pytest
from tests.app.browsing import MOSTLY_FRENCH, Page

THIN = "calculate/centrifuges.pusher?feed.liquid_flow=200 t%2Fh&feed.solid_flow=1 t%2Fh"
COMPARE = {"en": "Compare all", "fr": "Tout comparer"}


@pytest.mark.parametrize("language", MOSTLY_FRENCH)
def test_a_thin_slurry_on_a_pusher_leads_to_other_machines(page: Page, language: str) -> None:
    page.open(THIN, language)
    told = page.one("[data-advice]")
    link = told.find_element("tag name", "a")
    assert link.text == COMPARE[language]
    page.check()
    link.click()
    page.one("[data-ranking]")
    page.settle()
    assert "separator_choice" in page.browser.current_url
    # one part of solid in two hundred and one by mass is below a percent by volume
    share = page.one("#field-solids_volume_fraction").get_attribute("value").replace(",", ".")
    assert 0.0 < float(share) < 1.0
    assert not page.all("[aria-invalid=true]")
    page.check()
