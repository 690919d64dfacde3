"""What a page prints reads as people write: labels for names, no unit where there is none to choose."""

from __future__ import annotations

import httpx
import pytest
from selenium.webdriver.common.keys import Keys
from tests.app.browsing import Page

from granum.app.building import palette
from granum.app.finding import _told
from granum.app.forms import card_form
from granum.app.wording import page_words, summary_words
from granum.core.i18n import language
from granum.core.index import entries
from granum.filtration import separator_choice
from granum.reports.quantities import check_row
from granum.streams.units import Check

THICKENING = "filtration.thickening_filter"


@pytest.mark.parametrize(
    ("code", "called"), [("en", "every ‘filtration time’"), ("fr", "à chaque « durée de filtration »")]
)
def test_a_summary_calls_parameters_by_their_labels(code: str, called: str) -> None:
    with language(code):
        assert not [key for key, card in entries().items() if "`" in summary_words(card.summary)]
        assert called in card_form(THICKENING)["summary"]
        assert called in _told("card", THICKENING)["summary"]
        assert called in next(m for m in palette() if m["model"] == THICKENING)["summary"]
        steam = card_form("materials.steam_enthalpy")["summary"]
        assert entries()["materials.water_enthalpy"].title in steam


@pytest.mark.parametrize(
    ("code", "message", "read"),
    [
        (
            "en",
            "Stream 'dryer.gas_2' from unit 'hot_liquor' is not there.",
            "Stream 'dryer · gas 2' from unit 'hot liquor' is not there.",
        ),
        (
            "fr",
            "Le courant « sel.vapor » de l’appareil « mon_filtre »",
            "Le courant « sel · vapeur » de l’appareil « mon filtre »",
        ),
    ],
)
def test_streams_and_units_of_a_message_are_called_as_in_the_drawing(
    code: str, message: str, read: str
) -> None:
    with language(code):
        assert page_words(message) == read


@pytest.mark.parametrize(
    ("message", "read"),
    [
        (
            "It needs 'reduced_pressure' (reduced explosion pressure, gauge, bar), 'volume' (volume, m^3).",
            "It needs reduced explosion pressure, gauge (bar), volume (m³).",
        ),
        (
            "It needs 'wash_ratio' (wash ratio (wash over void volume)).",
            "It needs wash ratio (wash over void volume).",
        ),
        ("It needs 'permeability' (permeability, millidarcy).", "It needs permeability (mD)."),
        ("'diameter' (of the inlet) is wrong.", "Diameter (of the inlet) is wrong."),
    ],
)
def test_a_label_stands_once_whatever_marks_are_in_it(message: str, read: str) -> None:
    assert page_words(message) == read


def test_a_law_alone_asks_for_what_it_is_called_with(address: str) -> None:
    """A vent has no dust to ask: the card opens with values, and says which are missing where they are
    emptied.
    """
    form = card_form("dust.explosion_vent")
    needed = [row["name"] for row in form["parameters"] if row["required"]]
    values = {row["name"]: row["example"] for row in form["parameters"] if row["name"] in needed}
    inputs = {name: f"{row['number']} {row['unit']}".strip() for name, row in values.items()}
    opened = httpx.post(f"{address}/api/calc/dust.explosion_vent", json=inputs, timeout=240)
    assert opened.status_code == 200, opened.text
    # EN 14491 by hand: 10 m³, 100 bar m/s, 9 bar, 0.5 bar, 0.1 bar
    by_hand = 3.264e-5 * 9.0 * 100.0 * 0.5**-0.569 * 10.0**0.753
    assert opened.json()["outputs"]["explosion_vent"]["value"] == pytest.approx(by_hand, rel=1e-3)
    del inputs["deflagration_index"]
    refused = httpx.post(f"{address}/api/calc/dust.explosion_vent", json=inputs, timeout=240)
    assert refused.status_code == 422
    assert "needs dust explosion constant (bar·m/s)" in refused.json()["error"]["message"]


def test_a_limit_of_one_value_is_no_range() -> None:
    assert check_row(Check("number of stages", 2.0, 2.0, 2.0, "dimensionless", "")).allowed == "= 2"


@pytest.mark.parametrize(("language_code", "words"), [("en", ("yes", "no")), ("fr", ("oui", "non"))])
def test_what_holds_or_not_is_told_as_yes_or_no(language_code: str, words: tuple[str, str]) -> None:
    with language(language_code):
        rows = [check_row(Check("crystals form", x, 1.0, 1.0, "dimensionless", "")) for x in (1.0, 0.0)]
    assert [(row.ok, row.text, row.allowed) for row in rows] == [
        (True, words[0], f"= {words[0]}"),
        (False, words[1], f"= {words[0]}"),
    ]


@pytest.mark.parametrize(
    ("size", "told"), [("300 um", "less than a second"), ("20 um", "2 s"), ("2 um", "3.4 min")]
)
def test_a_cake_that_forms_at_once_is_not_timed_in_millionths(size: str, told: str) -> None:
    found = separator_choice(size, 1100, 0.1, "20 m^3/hour")
    place = found.separator.index("rotary vacuum drum")
    reasons = f"{found.speaks_for[place]}; {found.speaks_against[place]}"
    assert told in next(text for text in reasons.split("; ") if "of cake" in text)


def test_a_ratio_asks_for_no_unit_and_takes_a_percentage_all_the_same(page: Page) -> None:
    page.open(f"calculate/{THICKENING}", "fr")
    assert not [e.text for e in page.all(".pairs option") if e.text == "1"]
    assert "–" in [e.text for e in page.all("#field-void_fraction ~ select option")]
    assert not page.all("#field-compressibility ~ select")
    page.type("#field-compressibility", "50 %").send_keys(Keys.TAB)
    page.settle()
    menu = page.one("#field-compressibility ~ select")
    assert menu.get_attribute("value") in ("%", "percent")
    assert page.one("#field-compressibility").get_attribute("value") == "50"
    page.check()
