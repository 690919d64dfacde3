"""A line is built on the page by somebody who never saw TOML: from nothing to a report, key by key, in both
languages.
"""

from __future__ import annotations

import base64
import csv
import io
import tomllib
import zlib
from typing import Any
from urllib.parse import quote

import httpx
import openpyxl
import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select
from tests.app.browsing import MOSTLY_FRENCH, Page

from granum.cases import building

WORDS = {
    "en": {
        "new": "New line",
        "create": "Create the line",
        "search": "Search equipment",
        "solid": "Potassium nitrate",
        "crystallizer": "msmpr",
        "filter": "horizontal belt",
        "dryer": "well mixed",
        "names": ("solution", "crystallizer", "filter", "dryer", "purge"),
        "undo": "Undo",
        "redo": "Redo",
        "report": "Report",
        "delete": "Delete",
        "add": "Add the specification",
        "rename": "Rename",
    },
    "fr": {
        "new": "Nouvelle ligne",
        "create": "Créer la ligne",
        "search": "Chercher un appareil",
        "solid": "Nitrate de potassium",
        "crystallizer": "cristallisoir continu parfaitement",
        "filter": "filtre à bande horizontale",
        "dryer": "séchoir parfaitement mélangé",
        "names": ("solution", "cristallisoir", "filtre", "séchoir", "purge"),
        "undo": "Annuler",
        "redo": "Rétablir",
        "report": "Rapport",
        "delete": "Supprimer",
        "add": "Ajouter la spécification",
        "rename": "Renommer",
    },
}
TAKEN = """
    URL.createObjectURL = (blob) => { blob.text().then((text) => { window.taken = text; }); return '#'; };
"""


def text_of(page: Page) -> str:
    return page.one("#case").get_attribute("value")


def case_of(page: Page) -> dict[str, Any]:
    return tomllib.loads(text_of(page))


def solved(page: Page) -> None:
    """Wait until what stands there is the outcome of the present text."""
    waited = "setTimeout(arguments[0], 700)"  # a step is solved a moment after it
    page.browser.execute_async_script(waited)
    page.settle()
    page.until(lambda: page.all(".findings") and not page.all(".stale") and not page.all("[data-missing]"))


def pick(page: Page, words: str, label: str) -> None:
    page.one("[data-palette]")
    page.type(f"[aria-label='{label}']", words).send_keys(Keys.ENTER)
    page.until(lambda: not page.all("[data-palette]"))


def press(page: Page, selector: str) -> None:
    """Reached with the keyboard and pressed."""
    thing = page.one(selector)
    page.browser.execute_script("arguments[0].focus()", thing)
    thing.send_keys(Keys.ENTER)


def build(page: Page, language: str) -> None:
    """Crystallizer, filter and dryer with the liquor going back, with the keyboard alone."""
    w = WORDS[language]
    _feed, crystallizer, filter_, _dryer, _purge = w["names"]
    page.open("lines", language)
    page.button(w["new"]).click()
    page.type("#new-title", "Sel n° 1")
    field = page.type("#new-solute", w["solid"].lower())
    field.send_keys(Keys.TAB)
    page.button(w["create"]).click()
    pick(page, w["crystallizer"], w["search"])
    page.one(f"[data-panel='{crystallizer}']")
    solved(page)
    press(page, f"[data-outlet='{crystallizer}.product']")
    pick(page, w["filter"], w["search"])
    page.one(f"[data-panel='{filter_}']")
    press(page, f"[data-outlet='{filter_}.cake']")
    pick(page, w["dryer"], w["search"])
    solved(page)
    press(page, f"[data-unit='{crystallizer}']")
    menu = Select(page.one(f"[data-panel='{crystallizer}'] [data-port=feed] select"))
    menu.select_by_value(f"{_feed}")  # as it is
    press(page, f"[data-unit='{filter_}']")
    goes = Select(page.one(f"[id='goes-{filter_}-filtrate']"))
    goes.select_by_value(f"{crystallizer}.feed")
    page.until(lambda: page.all("[data-unit=purge]"))
    solved(page)


@pytest.mark.parametrize("language", MOSTLY_FRENCH)
def test_a_line_is_built_from_nothing_to_a_report(page: Page, language: str) -> None:
    build(page, language)
    w = WORDS[language]
    _feed, crystallizer, filter_, dryer, purge = w["names"]
    case = case_of(page)
    assert set(case["units"]) >= {crystallizer, filter_, dryer, purge}
    assert case["feeds"]["solution"]["to"].startswith("m")  # a mixer takes feed and liquor
    page.check()
    field = page.type(f"[data-panel='{filter_}'] input[id$='-area']", "0,8" if language == "fr" else "0.8")
    page.leave(field)
    page.until(lambda: "0.8 m" in text_of(page).replace(",", "."))
    solved(page)
    page.button(w["undo"]).click()
    page.until(lambda: case_of(page) == case)
    page.button(w["redo"]).click()
    page.until(lambda: case_of(page) != case)
    solved(page)
    shared = page.until(lambda: "case=" in page.browser.current_url and page.browser.current_url)
    page.browser.execute_script(TAKEN)
    page.button(w["report"]).click()
    report = page.until(lambda: page.browser.execute_script("return window.taken"))
    assert "<svg" in report
    assert "Sel n° 1" in report
    page.browser.execute_script("localStorage.clear(); sessionStorage.clear()")
    page.browser.get("about:blank")
    page.browser.get(shared)  # as another person opens it
    page.until(lambda: page.all(f"[data-unit='{dryer}']"))
    page.settle()
    page.check()


def carried(text: str) -> str:
    """The place of a line that its link carries."""
    squeeze = zlib.compressobj(wbits=-15)
    packed = base64.urlsafe_b64encode(squeeze.compress(text.encode()) + squeeze.flush()).decode().rstrip("=")
    return f"lines/computer%3Amud.toml?case={packed}"


def test_units_are_renamed_bypassed_and_deleted_from_their_panel_and_specified(page: Page) -> None:
    text = building.begin("Mud", "suspension")
    text = building.add_unit(text, "streams.heater", origin="suspension")
    text = building.add_unit(text, "filtration.horizontal_belt_filter", origin="heater.product")
    page.open(carried(building.lead(text, "filter.filtrate", "heater.feed")))
    page.until(lambda: page.all("[data-unit=purge]"))
    solved(page)
    press(page, "[data-unit=heater]")
    page.type("#rename", "Séchoir final")
    page.button("Rename").click()
    page.one("[data-panel='séchoir_final']")
    assert "séchoir_final" in case_of(page)["units"]
    page.button("Bypass").click()
    page.until(lambda: "bypass" in case_of(page)["units"])
    solved(page)
    goes = Select(page.one("[id='goes-séchoir_final-product']"))
    assert goes.first_selected_option.text == "mixer 2", "a mixer is named, whichever of its inlets is meant"
    page.browser.execute_script("document.querySelector('[data-specifications]').open = true")
    Select(page.one("#spec-vary")).select_by_value("purge.side_fraction")
    Select(page.one("#spec-of")).select_by_value("purge")
    Select(page.one("#spec-figure")).select_by_value("mass_flow")
    for name, value in (("equals", "2000 kg/h"), ("lower", "5 %"), ("upper", "90 %")):
        page.leave(page.type(f"#spec-{name}", value))
    page.button("Add the specification").click()
    page.one("[data-specification]")
    solved(page)
    page.says(".findings", "found")
    press(page, "[data-unit=purge]")
    page.button("Delete").click()
    page.until(lambda: "purge" not in case_of(page)["units"])
    assert "specifications" not in case_of(page)
    page.says("[data-removed]", "purge")
    page.browser.refresh()  # what was deleted comes back even then
    page.settle()
    page.until(lambda: page.button("Undo").is_enabled())
    field = page.type("#seek", "salt")
    field.send_keys(Keys.CONTROL, "z")  # the undo of the text itself
    assert "purge" not in case_of(page)["units"]
    page.browser.execute_script("document.activeElement.blur()")
    page.browser.find_element("css selector", "body").send_keys(Keys.CONTROL, "z")
    page.until(lambda: "purge" in case_of(page)["units"])
    assert case_of(page)["specifications"]
    page.browser.find_element("css selector", "body").send_keys(Keys.CONTROL, "y")
    page.until(lambda: "purge" not in case_of(page)["units"])
    page.button("Undo").click()
    page.until(lambda: "purge" in case_of(page)["units"])


def test_an_open_end_is_dragged_to_an_inlet(page: Page) -> None:
    page.open("lines", "en")
    page.button("New line").click()
    page.type("#new-title", "Wash")
    page.button("Create the line").click()
    pick(page, "msmpr", "Search equipment")
    solved(page)
    page.button("Add equipment").click()
    pick(page, "nutsche", "Search equipment")
    assert page.until(lambda: "Filter has no feed yet." in page.text("[data-missing]"))
    page.one("[data-panel=filter]")
    page.until(lambda: page.all("[data-inlet='filter.feed']"))
    start = page.one("[data-outlet='crystallizer.product'] .sign")
    end = page.one("[data-inlet='filter.feed'] .reach")
    page.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", start)
    ActionChains(page.browser).click_and_hold(start).move_to_element(end).perform()
    assert page.one(".aimed").get_attribute("data-inlet") == "filter.feed"
    before = case_of(page)
    ActionChains(page.browser).send_keys(Keys.ESCAPE).release().perform()
    assert not page.one(".rubber").is_displayed()
    assert not page.all(".aimed")
    assert case_of(page) == before
    ActionChains(page.browser).click_and_hold(start).move_to_element(end).release().perform()
    page.until(lambda: "crystallizer_product" in case_of(page).get("streams", {}))
    solved(page)
    assert case_of(page)["streams"]["crystallizer_product"] == ["crystallizer.product", "filter.feed"]


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_text_of_a_diagram_is_legible_at_every_width(page: Page, theme: str) -> None:
    place = quote("examples:potassium-nitrate/line.toml", safe="")
    page.open(f"lines/{place}", "fr" if theme == "dark" else "en", width=390, theme=theme)
    for width in (390, 1100, 1440, 1920):
        page.turn(width, theme)
        page.one(".diagram svg")
        sizes = page.browser.execute_script(
            "return [...document.querySelectorAll('.diagram text')].map((e) => "
            "parseFloat(getComputedStyle(e).fontSize) * "
            "e.ownerSVGElement.getBoundingClientRect().width / e.ownerSVGElement.viewBox.baseVal.width)"
        )
        assert min(sizes) >= 10.99, width
        hit = page.browser.execute_script(
            "return [...document.querySelectorAll('.diagram .stream .reach')].map((e) => "
            "parseFloat(getComputedStyle(e).strokeWidth))"
        )
        assert min(hit) >= 14, width
        page.check()


def test_the_diagram_is_zoomed_with_buttons_and_keys(page: Page) -> None:
    page.open(f"lines/{quote('examples:grinding-circuit/circuit.toml', safe='')}")
    page.one(".diagram svg")
    page.settle()
    wide = "return document.querySelector('.diagram svg').getBoundingClientRect().width"
    before = page.browser.execute_script(wide)
    page.one("[aria-label='Zoom in']").click()
    page.until(lambda: page.browser.execute_script(wide) > 1.2 * before)
    frame = page.one(".diagram")
    page.browser.execute_script("arguments[0].focus()", frame)
    frame.send_keys("0")
    page.until(lambda: abs(page.browser.execute_script(wide) - before) < 1)


def test_the_case_file_stays_open_while_it_is_written(page: Page) -> None:
    page.open(f"lines/{quote('examples:grinding-circuit/circuit.toml', safe='')}")
    page.one(".diagram svg")
    page.settle()
    page.browser.execute_script("document.querySelector('#case').closest('details').open = true")
    field = page.one("#case")
    field.send_keys(Keys.CONTROL, Keys.HOME)
    for key in "# mine\n[":
        field.send_keys(key)
        assert field.is_displayed()
    field.send_keys(Keys.TAB)
    page.until(lambda: page.browser.execute_script("return document.querySelector('#case').offsetHeight") > 0)
    assert field.is_displayed()
    numbers = page.browser.execute_script("return document.querySelector('.editor .numbers').textContent")
    assert len(numbers.split("\n")) == len(text_of(page).split("\n"))


def test_what_a_lab_test_gave_goes_into_the_open_line_in_one_click(page: Page) -> None:
    page.open(f"lines/{quote('examples:lab-to-plant/line.toml', safe='')}")
    page.one("[data-unit=press]")
    page.settle()
    page.browser.execute_script("location.hash = '#/lab/filtration.leaf_test'")
    page.button("Try with example data").click()
    page.one("[data-use] #use-unit")
    page.settle()
    page.button("Use in the line").click()
    page.one("[data-use] a").click()
    page.until(lambda: "data = '''" in text_of(page))
    fits = case_of(page)["fits"]
    assert [set(table["gives"]) for table in fits.values()] == [
        {"press.cake_resistance", "press.medium_resistance"}
    ]
    page.settle()
    page.until(lambda: page.all(".findings") and not page.all(".stale"))


def test_tables_of_a_line_are_taken_as_files(address: str) -> None:
    with httpx.Client(base_url=address, timeout=240) as client:
        case = client.get("/api/examples/grinding-circuit/circuit.toml").json()["text"]
        answers = {
            form: client.post("/api/case/tables", json={"case": case, "form": form})
            for form in ("csv", "xlsx", "pdf")
        }
    rows = list(csv.reader(io.StringIO(answers["csv"].text)))
    book = openpyxl.load_workbook(io.BytesIO(answers["xlsx"].content))
    assert book.sheetnames == ["streams", "sizes", "results", "specifications", "checks", "utilities"]
    lower, upper, *shares = zip(*list(book["sizes"].values)[1:], strict=True)
    assert lower[1:] == upper[:-1]
    assert [sum(of_one) for of_one in shares] == pytest.approx([1.0] * len(shares), rel=1e-9)
    assert [str(cell.value) for cell in book["streams"][1]] == rows[0]
    assert answers["pdf"].status_code == 422


@pytest.mark.parametrize(
    ("operation", "arguments"),
    [
        ("explode", {}),
        ("add_unit", {}),
        ("add_unit", {"model": "streams.nothing"}),
        ("add_unit", {"model": 3}),
        ("connect", {"origin": "x", "target": "y", "more": "z"}),
        ("choose_substances", {"liquids": [1]}),
        ("begin", {"title": " "}),
        ("begin", {"title": "x", "solute": "gold"}),
    ],
)
def test_a_step_that_cannot_be_is_refused_in_words(
    address: str, operation: str, arguments: dict[str, Any]
) -> None:
    answer = httpx.post(
        f"{address}/api/case/build",
        json={
            "case": 'title = "x"\n[mixture]\nliquids = ["water"]\n',
            "operation": operation,
            "arguments": arguments,
        },
        timeout=60,
    )
    assert answer.status_code == 422
    assert answer.json()["error"]["message"]


def test_every_piece_of_equipment_is_found_in_both_languages(address: str) -> None:
    shown = {
        language: httpx.get(f"{address}/api/palette", headers={"x-language": language}, timeout=60).json()[
            "equipment"
        ]
        for language in ("en", "fr")
    }
    assert all(piece["symbol"].startswith("<") for piece in shown["en"])
    for english, french in zip(shown["en"], shown["fr"], strict=True):
        assert french["title"] in english["other_names"]
        assert english["title"] in french["other_names"]


@pytest.mark.parametrize("language", MOSTLY_FRENCH)
def test_a_line_of_a_substance_of_ones_own_is_begun_and_its_constants_changed(
    page: Page, language: str
) -> None:
    w = WORDS[language]
    use, keep = {
        "en": ("Use this substance", "Use these values"),
        "fr": ("Prendre cette substance", "Prendre ces valeurs"),
    }[language]
    page.open("lines", language, width=390)
    page.button(w["new"]).click()
    page.type("#new-title", "PVC")
    page.one("input[name=enters][value=moist_solid]").click()
    page.one("[data-describe] summary").click()
    page.type("#new-own-name", "PVC fin")
    page.leave(page.type("#new-own-solids-density", "1,4 g/cm3"))
    page.leave(page.type("#new-own-solids-heat_capacity", "0,9"))
    page.button(use).click()
    page.until(lambda: page.one("#new-solid").get_attribute("value") == "PVC fin")
    page.check()
    page.button(w["create"]).click()
    pick(page, w["dryer"], w["search"])
    solved(page)
    assert case_of(page)["solid"] == {"PVC fin": {"density": "1.4 g/cm^3", "heat_capacity": "0.9 kJ/(kg*K)"}}
    narrow = """return [...document.querySelectorAll('[data-panel] .quantity input')]
      .map((e) => [e.id, e.clientWidth]).filter(([, width]) => width < 100)"""
    assert page.all("[data-panel] .quantity input")
    assert page.browser.execute_script(narrow) == []  # on a phone too a number can be read and typed
    page.one(".setup > summary").click()  # folded on a phone, where the line comes first
    page.browser.execute_script("document.querySelector('[data-substances]').open = true")
    page.leave(page.type("#own-solid-PVC_fin-density", "1500"))
    page.button(keep).click()  # in g/cm³, as the menu beside it says
    page.until(lambda: "10 kg/m³" in page.one("[data-own='PVC fin'] .out").text)
    page.leave(page.type("#own-solid-PVC_fin-density", "1500 kg/m3"))
    page.button(keep).click()
    page.until(lambda: case_of(page)["solid"]["PVC fin"]["density"] == "1500 kg/m^3")
    solved(page)
    page.check(refused=True)
