"""What stands in a form is what is calculated, also where the page is opened again from its link; a press of
a button is heard; French is printed as French.
"""

from __future__ import annotations

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from tests.app.browsing import Page

from granum.app.alone_forms import alone_form
from granum.app.forms import offered_unit
from granum.core import registry
from granum.core.i18n import language

CYCLONE = "calculate/cyclones.gas_cyclone"
DRUM = "calculate/filtration.rotary_vacuum_drum"
HARDNESS, SALT = "#field-wall_hardness", r"#field-feed\.liquid\.sodium-chloride"
OPENED = "document.querySelectorAll('details').forEach((d) => (d.open = true))"


def test_a_field_that_was_emptied_is_empty_where_the_link_is_opened(page: Page) -> None:
    page.open(CYCLONE)
    page.one("[data-figure=wear_velocity]")
    page.browser.execute_script(OPENED)
    assert page.one(HARDNESS).get_attribute("value"), "the example says how hard the wall is"
    example = page.text("[data-figure=wear_velocity]")
    page.type(HARDNESS, "").send_keys(Keys.TAB)
    page.until(lambda: page.text("[data-figure=wear_velocity]") != example)
    page.settle()
    seen = page.text("[data-figure=wear_velocity]")
    page.browser.refresh()
    page.settle()
    assert page.one(HARDNESS).get_attribute("value") == ""
    page.reads("[data-figure=wear_velocity]", seen)


def test_a_button_is_pressed_where_it_stood_though_a_field_is_left_by_it(page: Page) -> None:
    page.open(DRUM, "fr")
    page.one("[data-figure]")
    page.browser.execute_script(OPENED)
    field = page.type(SALT, "3,8")
    field.send_keys(Keys.TAB)
    page.settle()
    bounds = page.all(".field:focus-within .bounds")
    assert bounds, "the limits of a field are in sight while it has the focus"
    assert bounds[0].is_displayed()
    button = page.button("Annuler")
    hand = ActionChains(page.browser).move_to_element(button).click_and_hold()
    hand.pause(0.2).release().perform()  # as long as a finger presses
    page.until(lambda: page.one(SALT).get_attribute("value") == "3")
    page.until(lambda: not page.all(".field.held"))


def test_a_text_without_a_number_has_a_usual_unit_when_it_is_drawn_again(page: Page) -> None:
    page.open(CYCLONE)
    page.one("[data-figure]")
    page.browser.execute_script(OPENED)
    unit = f"{HARDNESS} ~ select"
    page.type(HARDNESS, "-").send_keys(Keys.TAB)
    page.settle()
    page.browser.refresh()
    page.settle()
    assert page.one(HARDNESS).get_attribute("value") == "-"
    assert page.one(unit).get_attribute("value") != "Pa", "SI is what a number alone has"


def test_the_unit_of_an_example_is_one_of_those_offered() -> None:
    form = alone_form("comminution.bond_mill", {})
    row = next(p for p in form["parameters"] if p["name"] == "work_index")
    assert form["values"]["work_index"].split()[1] in [u["unit"] for u in row["units"]]


def test_a_unit_of_another_name_keeps_its_number() -> None:
    p = registry.find("comminution.bond_mill").card.parameter("work_index")
    assert offered_unit("12.50 kW*hour/tonne", p) == "12.50 kWh/tonne"
    assert offered_unit("12 kWh/tonne", p) == "12 kWh/tonne"
    assert offered_unit("12 furlong", p) == "12 furlong"
    assert offered_unit("twelve", p) == "twelve"


def test_marks_of_french_never_begin_a_line(page: Page) -> None:
    page.open(DRUM, "fr")
    page.one("[data-figure]")
    page.browser.execute_script(OPENED)
    page.type(SALT, "-3,8").send_keys(Keys.TAB)
    page.settle()
    found = page.browser.execute_script(
        """
        const walk = document.createTreeWalker(document.querySelector('main'), NodeFilter.SHOW_TEXT);
        const texts = [];
        while (walk.nextNode())
          if (!walk.currentNode.parentElement.closest('pre, code, textarea, [lang=en]'))
            texts.push(walk.currentNode.data);
        return texts;
        """
    )
    assert any("\u00a0:" in text for text in found), "some of them have a colon"
    begun = [text for text in found if any(f"\u0020{mark}" in text for mark in ":;?!»%")]
    assert not [text for text in begun if text != " / %"], "a unit in a heading is no word"


def test_code_keeps_its_spaces_in_french() -> None:
    with language("fr"):
        assert "\u00a0" not in alone_form("comminution.bond_mill", {})["python"]


def test_a_machine_on_paper_has_all_that_was_calculated_with(page: Page) -> None:
    page.open("calculate/drying.spray_dryer", "fr")
    page.one("[data-figure]")
    page.browser.execute_script("dispatchEvent(new Event('beforeprint'))")
    inlets = page.all("details.inlet")
    assert len(inlets) > 1
    assert all(inlet.get_attribute("open") for inlet in inlets)
    page.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    page.browser.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": 690, "height": 900, "deviceScaleFactor": 1, "mobile": False},  # A4 within its margins
    )
    cut = page.browser.execute_script(
        "return [...document.querySelectorAll('form select.alone')].filter((e) => e.offsetParent)"
        ".filter((e) => e.getBoundingClientRect().width + 1 < e.scrollWidth).map((e) => e.id)"
    )
    page.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    assert not cut
    page.browser.execute_script("dispatchEvent(new Event('afterprint'))")
    assert [bool(inlet.get_attribute("open")) for inlet in inlets] == [i == 0 for i in range(len(inlets))]


def test_a_substance_is_found_without_its_last_letter_and_another_word_stays(page: Page) -> None:
    page.open("lines", "fr")
    page.button("Nouvelle ligne").click()
    page.one("input[name=enters][value=suspension]").click()
    page.type("#new-solid", "Granit").send_keys(Keys.TAB)
    page.until(lambda: page.one("#new-solid").get_attribute("value").casefold() == "granite")
    page.type("#new-solid", "granulat").send_keys(Keys.TAB)
    page.settle()
    assert page.one("#new-solid").get_attribute("value") == "granulat"
