"""Finding things on the page: the search of every page by keys, the folded list, the start, equipment alone,
reading.
"""

from __future__ import annotations

from typing import Any

import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from tests.app.browsing import MOSTLY_FRENCH, Page

WIDTHS = (390, 1100, 1440, 1920)


def keys(page: Page, *pressed: str) -> None:
    """Keys for whatever has the focus, one after the other."""
    for key in pressed:
        ActionChains(page.browser).send_keys(key).perform()


def focused(page: Page) -> Any:
    return page.browser.switch_to.active_element


def heading(page: Page) -> str:
    return page.browser.execute_script("return document.querySelector('h1')?.textContent || ''")


def hits(page: Page) -> list[str]:
    return told(page, "#hits .title")


def told(page: Page, selector: str) -> list[str]:
    """Texts, read at once: answers replace one another while somebody types."""
    script = "return [...document.querySelectorAll(arguments[0])].map((e) => e.textContent)"
    return page.browser.execute_script(script, selector)


@pytest.mark.parametrize(
    ("language", "typed", "title"),
    [("en", "settling speed", "Terminal velocity"), ("fr", "essoreuse", "Essoreuse à poussoir")],
)
def test_slash_opens_the_search_and_enter_what_was_found(
    page: Page, language: str, typed: str, title: str
) -> None:
    page.open("calculate/porous.pressure_gradient_ergun", language)
    keys(page, "/", *typed)
    assert focused(page).get_attribute("id") == "seek"
    page.until(lambda: title in hits(page))

    def on_it() -> bool:
        """One more step where another is chosen: an answer may still change the list."""
        chosen = page.one("#hits [aria-selected=true]")
        told_of = page.one("#seek").get_attribute("aria-activedescendant") == chosen.get_attribute("id")
        if not (chosen.find_element(By.CSS_SELECTOR, ".title").text == title and told_of):
            keys(page, Keys.ARROW_DOWN)
            return False
        return True

    page.until(on_it)
    keys(page, Keys.ENTER)
    page.until(lambda: heading(page) == title)
    assert not page.one("#hits").is_displayed()


def test_enter_goes_where_the_answer_leads_that_comes_after_it(page: Page) -> None:
    page.open("calculate/porous.pressure_gradient_ergun")
    keys(page, "/")
    page.one("#seek").send_keys("hydrocyclone", Keys.ENTER)
    page.until(lambda: heading(page) == "Hydrocyclone")
    assert not page.one("#hits").is_displayed()


def test_a_slash_in_a_field_is_a_slash_and_escape_leaves(page: Page) -> None:
    page.open("calculate/particles.terminal_velocity")
    page.one("#field-particle_density").click()
    keys(page, "/")
    assert focused(page).get_attribute("id") == "field-particle_density"
    page.open("home")
    keys(page, "/", *"drag")
    page.until(lambda: hits(page))
    keys(page, Keys.ESCAPE)
    page.until(lambda: not page.one("#hits").is_displayed())


def test_everything_is_found_grouped_with_where_it_leads(page: Page) -> None:
    page.open("home")
    keys(page, "/", *"vacuum filter")
    page.until(lambda: hits(page))
    page.until(lambda: "Equipment" in told(page, "#hits .kind"))
    groups = told(page, "#hits .kind")
    assert "Equipment" in groups
    assert len(groups) == len(set(groups))
    assert all(told(page, "#hits .where"))
    page.one("#seek").send_keys(Keys.CONTROL, "a")
    keys(page, *"qqqqzzzz")
    page.until(lambda: "Nothing found for “qqqqzzzz”" in "".join(told(page, ".seek .none")))


@pytest.mark.parametrize("language", ["en", "fr"])
def test_on_a_phone_the_search_is_a_sheet(page: Page, language: str) -> None:
    page.open("calculate/particles.terminal_velocity", language, width=390)
    assert not page.one("#seek").is_displayed()
    page.one(".seek .opener").click()
    page.until(lambda: focused(page).get_attribute("id") == "seek")
    keys(page, *"hydrocyclone")
    page.until(lambda: hits(page)[:1] == ["Hydrocyclone"])
    assert page.one(".seek .sheet").size["width"] > 370  # but for a scroll bar
    assert page.browser.execute_script("return document.documentElement.scrollWidth") <= 390
    page.check()
    page.one("#hits a").click()
    page.until(lambda: heading(page) == "Hydrocyclone")


def test_at_a_middle_width_all_pages_stand_in_a_row_and_the_search_opens_over_them(page: Page) -> None:
    page.open("home", "fr", width=1100)
    rows = "return [...document.querySelectorAll('nav a')].map((e) => e.getBoundingClientRect().top)"
    assert len(set(page.browser.execute_script(rows))) == 1
    asked = "return [...document.querySelectorAll('.tile strong')].map((e) => e.textContent)"
    questions = [text for text in page.browser.execute_script(asked) if text.endswith("?")]
    assert questions
    assert all(text.endswith("\u00a0?") for text in questions), "a line does not begin with its mark"
    keys(page, "/", *"hydrocyclone")
    page.until(lambda: hits(page)[:1] == ["Hydrocyclone"])
    page.check()
    keys(page, Keys.ENTER)
    page.until(lambda: heading(page) == "Hydrocyclone")


def test_the_list_is_one_tab_stop_with_arrow_keys_and_shows_the_open_card(page: Page) -> None:
    page.open("calculate/particles.drag_coefficient_stokes")
    current = page.one(".find [aria-current]")
    assert current.is_displayed()
    box, inside = page.one(".find .scroll").rect, current.rect
    assert box["y"] <= inside["y"] <= box["y"] + box["height"]
    assert [e.get_attribute("aria-current") for e in page.all(".find .scroll [tabindex='0']")] == ["page"]
    family = current.find_element(By.XPATH, "ancestor::details[1]/summary")
    assert "laws" in family.text
    page.one(".find input").click()
    keys(page, Keys.TAB)
    assert focused(page) == current
    keys(page, Keys.ARROW_LEFT)
    assert focused(page) == family
    keys(page, Keys.ARROW_LEFT)
    assert not current.is_displayed()
    keys(page, Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
    assert focused(page).get_attribute("href")
    keys(page, Keys.TAB)
    assert "chapter" in focused(page).get_attribute("class")
    keys(page, Keys.TAB)
    assert focused(page).find_elements(By.XPATH, "ancestor::form"), focused(page).get_attribute("outerHTML")


@pytest.mark.parametrize("language", ["en", "fr"])
def test_the_start_leads_to_tasks_domains_and_what_was_open(page: Page, language: str) -> None:
    page.open("", language)
    assert len(page.all(".home .tiles:not(.small) a")) >= 12
    assert not page.all("[data-recent]")
    page.check()
    page.one(".home .tiles a").click()
    page.until(lambda: page.all("#field-particle_diameter"))
    page.settle()
    page.one("header .brand").click()
    page.until(lambda: page.all("[data-recent] a"))
    recent = page.one("[data-recent] a")
    assert "particles.terminal_velocity" in recent.get_attribute("href")
    assert recent.text == ("Terminal velocity" if language == "en" else "Vitesse terminale de chute")
    page.until(lambda: len(page.all(".home .tiles.small a")) >= 14)
    page.one(".home .tiles.small a[href*='home/settling']").click()
    page.until(lambda: page.all("ul.several"))
    assert any("settling.thickener" in a.get_attribute("href") for a in page.all("main a"))


def test_every_task_of_the_start_leads_to_a_page_that_opens(page: Page) -> None:
    page.open("home")
    places = [a.get_attribute("href").split("#/", 1)[1] for a in page.all(".home .tiles:not(.small) a")]
    for place in places:
        page.visit(place)
        page.until(lambda: page.text("h1"))
        assert not page.all(".message.out"), place


@pytest.mark.parametrize("language", MOSTLY_FRENCH)
def test_equipment_is_calculated_alone_and_put_in_a_line(page: Page, language: str) -> None:
    page.open("calculate/filtration.rotary_vacuum_drum", language)
    page.until(lambda: page.all("[data-belief=ok]"))
    page.check()
    before = page.text("[data-figure=capacity_use]")
    page.type("#field-area", "18 m2")
    page.until(lambda: page.text("[data-figure=capacity_use]") != before)
    assert "area=18" in page.browser.current_url
    assert "granum calc filtration.rotary_vacuum_drum" in page.one("main").get_attribute("textContent")
    page.one("a.button[href*='lines']").click()
    page.until(lambda: "lines" in page.browser.current_url and page.all("#case"))
    page.until(lambda: 'area = "18 m' in page.one("#case").get_property("value"))


def test_a_link_to_equipment_opens_with_its_values_and_a_wrong_one_is_told(page: Page) -> None:
    page.open("calculate/streams.heater?temperature=70%20degC&feed.liquid_flow=2%20t%2Fh")
    page.until(lambda: page.all("[data-figure=heat_duty]"))
    page.reads("[data-figure=temperature]", "70 °C")
    page.open("calculate/streams.heater?temperature=-300%20degC")
    page.until(lambda: page.all(".message.out"))
    page.says(".field .out", "Temperature = −300 °C is not possible")  # once, where it is mended
    page.says(".message.out", "Nothing is calculated before this is mended: temperature")


def test_the_search_field_has_its_width_on_every_page(page: Page) -> None:
    page.open("lines")
    for place in ("lines", "exercises", "charts/drying.dryer_energy_chart"):
        page.visit(place)
        field, key = page.one("#seek").rect, page.one(".seek kbd").rect
        assert field["width"] > 200, place
        assert field["x"] < key["x"] < field["x"] + field["width"]


def test_a_page_of_the_documentation_is_read_in_the_app(page: Page) -> None:
    page.open("read/handbook%2Fcyclones")
    page.reads("h1", "Cyclones and gas cleaning")
    page.check()
    page.one("article a[href*='find/cyclones']").click()
    page.until(lambda: "calculate/cyclones" in page.browser.current_url)
    page.open("read/no-such-page")
    page.until(lambda: page.text(".message.out"))


@pytest.mark.parametrize(
    ("language", "card", "title"),
    [
        ("en", "particles.terminal_velocity", "Particles"),
        ("fr", "evaporation.evaporator", "Évaporation"),
        ("fr", "filtration.leaf_test", "Filtration"),
    ],
)
def test_a_card_leads_to_the_chapter_of_its_domain(page: Page, language: str, card: str, title: str) -> None:
    page.open(f"find/{card}", language)
    page.one("a.chapter").click()
    page.until(lambda: title in heading(page))


@pytest.mark.parametrize(
    "place", ["home", "home/filtration", "calculate/cyclones.gas_cyclone", "read/guides%2Ffirst-hour"]
)
def test_nothing_is_cut_at_any_width_and_axe_is_content(page: Page, place: str) -> None:
    page.open(place, "fr", WIDTHS[0])
    for theme in ("light", "dark"):
        for width in WIDTHS:
            page.turn(width, theme)
            assert page.browser.execute_script("return document.documentElement.scrollWidth") <= width
        page.check()
