"""What a line built on the page is asked for: figures of its streams, prices, names, further solids."""

from __future__ import annotations

import pytest
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select
from tests.app.browsing import MOSTLY_FRENCH, Page, resize
from tests.app.test_builder import case_of, pick, press, solved

WORDS = {
    "en": {
        "new": "New line",
        "create": "Create the line",
        "search": "Search equipment",
        "heater": "heater or cooler",
        "feed": "suspension",
        "unit": "heater",
        "spec": "Add the specification",
        "rename": "Rename",
        "solid": "Calcite",
        "share": "10 %",
        "price": "0.05 USD/kWh",
        "folded": "carries nothing",
    },
    "fr": {
        "new": "Nouvelle ligne",
        "create": "Créer la ligne",
        "search": "Chercher un appareil",
        "heater": "réchauffeur",
        "feed": "suspension",
        "unit": "réchauffeur",
        "spec": "Ajouter la spécification",
        "rename": "Renommer",
        "solid": "Calcite",
        "share": "10 %",
        "price": "0,05 USD/kWh",
        "folded": "vide",
    },
}


def begun(page: Page, language: str) -> dict[str, str]:
    """A suspension that is heated."""
    w = WORDS[language]
    page.open("lines", language)
    page.button(w["new"]).click()
    page.type("#new-title", "Boue")
    page.one("input[value=suspension]").click()
    page.button(w["create"]).click()
    pick(page, w["heater"], w["search"])
    solved(page)
    return w


@pytest.mark.parametrize("language", MOSTLY_FRENCH)
def test_the_water_is_found_for_the_solids_of_a_stream(page: Page, language: str) -> None:
    w = begun(page, language)
    (feed,), (unit,) = case_of(page)["feeds"], case_of(page)["units"]
    page.browser.execute_script("document.querySelector('[data-specifications]').open = true")
    Select(page.one("#spec-vary")).select_by_value(f"{feed}.liquid_flow")
    Select(page.one("#spec-of")).select_by_value(f"{unit}.product")
    Select(page.one("#spec-figure")).select_by_value("solids_mass_fraction")
    for name, value in (("equals", w["share"]), ("lower", "100 kg/h"), ("upper", "5 t/h")):
        page.leave(page.type(f"#spec-{name}", value))
    page.button(w["spec"]).click()
    written = page.text("[data-specification]")
    assert f"{w['share']} (100 kg/h … 5 t/h)" in written, "amounts as people write them"
    solved(page)
    page.says(".findings", "1800 kg/h")  # 200 kg/h of solid are a tenth of 2000 kg/h
    page.check()


def test_a_stream_is_renamed_and_its_specification_follows(page: Page) -> None:
    w = begun(page, "fr")
    (unit,) = case_of(page)["units"]
    press(page, f".diagram [data-stream='{unit}.product']")
    page.one(f"[data-panel='{unit}.product']")
    page.type("#rename", "Boue chaude")
    page.button(w["rename"]).click()
    page.one("[data-panel='boue_chaude']")
    assert case_of(page)["streams"] == {"boue_chaude": [f"{unit}.product"]}
    solved(page)
    page.says("[data-streams]", "boue chaude")


@pytest.mark.parametrize("language", MOSTLY_FRENCH)
def test_prices_are_typed_and_the_costs_stand_in_the_table(page: Page, language: str) -> None:
    w = begun(page, language)
    (unit,) = case_of(page)["units"]
    field = page.type(f"[data-panel='{unit}'] input[id$='-temperature']", "80")
    page.leave(field)
    solved(page)
    page.browser.execute_script("document.querySelector('[data-utilities]').open = true")
    field = page.type("#price-low_pressure_steam", w["price"])
    page.leave(field)
    page.until(lambda: case_of(page).get("prices") == {"low_pressure_steam": "0.05 USD/kWh"})
    solved(page)
    page.browser.execute_script("document.querySelector('[data-utilities]').open = true")
    table = page.text("[data-utilities]")
    assert "USD/h" in table
    assert [cell.text for cell in page.all(f"[data-cost='{unit}']") if "USD/h" in cell.text], (
        "what the unit pays"
    )
    assert "USD/t" in table
    page.check()


def test_a_second_solid_is_given_a_share_in_a_feed_that_has_none_of_it(page: Page) -> None:
    w = begun(page, "fr")
    page.browser.execute_script("document.querySelector('[data-substances]').open = true")
    page.type("#add-solids", w["solid"]).send_keys(Keys.TAB)
    page.until(lambda: len(case_of(page)["mixture"]["solids"]) == 2)
    (feed,) = case_of(page)["feeds"]
    assert case_of(page)["feeds"][feed]["solid"] == {"quartz": "100 %"}
    solved(page)
    share = page.type("[data-form] input[id*='solid.']", "25 %")
    page.leave(share)
    page.until(lambda: case_of(page)["feeds"][feed]["solid"]["quartz"] == "75 %")
    solved(page)
    page.check()


@pytest.mark.parametrize("widths", [(1100, 1900), (1440, 390, 1900)])
def test_no_column_of_the_streams_is_out_of_sight_and_what_is_empty_is_folded(
    page: Page, widths: tuple[int, ...]
) -> None:
    language = "fr" if widths[0] == 1100 else "en"
    page.open("lines/examples%3Apotassium-nitrate%2Fline.toml", language, width=widths[0])
    page.one("[data-streams]")
    page.settle()
    wide = """return [document.documentElement, document.querySelector('[data-streams]')]
        .map((e) => e.scrollWidth - e.clientWidth)"""
    assert max(page.browser.execute_script(wide)) <= 0
    streams = """return [...document.querySelector('[data-streams] table').querySelectorAll('tbody th .name')]
        .map((e) => e.textContent)"""
    heads = "return [...document.querySelectorAll('[data-streams] thead .n')].map((e) => e.textContent)"
    first, columns = page.browser.execute_script(streams), page.browser.execute_script(heads)
    assert len(columns) == 11, columns
    page.browser.execute_script("document.querySelector('[data-empty]').click()")
    page.until(lambda: len(page.browser.execute_script(streams)) == len(first) + 2)  # vapor and skimmings
    assert max(page.browser.execute_script(wide)) <= 0
    for width in widths[1:]:
        resize(page, width)
        page.until(lambda: max(page.browser.execute_script(wide)) <= 0)
        assert page.browser.execute_script(heads) == columns
    page.until(lambda: len(page.all("[data-streams] table")) == 1)
    assert page.browser.execute_script(heads) == columns, "a wide window has them in one table"
    page.check()


def test_equipment_of_a_line_is_sized_for_what_enters_it_and_undo_takes_it_back(page: Page) -> None:
    w = WORDS["fr"]
    page.open("lines", "fr")
    page.button(w["new"]).click()
    page.type("#new-title", "Boue")
    page.one("input[value=suspension]").click()
    page.button(w["create"]).click()
    pick(page, "clarificateur", w["search"])
    solved(page)
    (unit,) = case_of(page)["units"]
    before = case_of(page)["units"][unit]["area"]
    page.type("[data-size] input", "90 %")
    page.button("Dimensionner pour ce qui entre").click()
    page.says("[data-sized]", "pour que")
    solved(page)
    after = case_of(page)["units"][unit]["area"]
    assert after != before
    assert after.split()[1:] == before.split()[1:], "in the unit of the case"
    page.says(f"[data-figure='{unit}.removal_efficiency']", "90")
    page.check()
    page.one("[data-sized] button").click()
    page.until(lambda: case_of(page)["units"][unit]["area"] == before)


def test_to_dry_and_enter_puts_in_the_most_usual_dryer(page: Page) -> None:
    w = begun(page, "fr")
    page.button("Ajouter un appareil").click()
    pick(page, "sécher", w["search"])
    page.until(lambda: len(case_of(page)["units"]) > 1)
    models = {unit["model"] for unit in case_of(page)["units"].values()}
    assert "drying.rotary_dryer" in models
