"""The right column of Calculate: value and units, numbers on the way, sensitivity, other laws, equation with
numbers, wanted results, intervals, comparison, sheet.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

import httpx
import pytest
from selenium.webdriver.support.ui import Select
from tests.app.browsing import MOSTLY_FRENCH, Page

SPHERE = {
    "particle_diameter": "85 um",
    "particle_density": "2630 kg/m^3",
    "fluid_density": "1020 kg/m^3",
    "dynamic_viscosity": "1.2 cP",
}
STOKES = "particles.terminal_velocity_stokes"
PLACE = f"calculate/{STOKES}?" + "&".join(f"{n}={v.replace(' ', '+')}" for n, v in SPHERE.items())
DIAMETER = "#field-particle_diameter"
VALUE = "[data-output=terminal_velocity]"
LANGUAGES = ["en", "fr"]


@pytest.fixture
def client(address: str) -> Iterator[httpx.Client]:
    with httpx.Client(base_url=address, timeout=120, headers={"x-language": "en"}) as found:
        yield found


@pytest.mark.parametrize("language", MOSTLY_FRENCH)
def test_the_column_stands_at_every_width(page: Page, language: str) -> None:
    page.open(PLACE, language, 390)
    for width in (390, 1100, 1440, 1920):
        page.turn(width, "dark" if width == 1100 else "light")
        page.until(lambda: page.all(".sensitivity .main-svg"))
        told = page.text("[data-beside=reynolds]")
        assert ("above 0 … 0.2" if language == "en" else "au-dessus de 0 … 0,2") in told
        assert page.one("[data-numbers] math")
        page.check()


def test_a_value_is_shown_in_the_chosen_unit_and_keeps_its_digits(page: Page) -> None:
    page.open(PLACE)
    page.reads(VALUE, "5.281 mm/s")
    Select(page.one(".answer .units select")).select_by_value("m/hour")
    page.reads(VALUE, "19.01 m/h")
    assert page.one(VALUE).get_attribute("title").startswith("19.01")
    assert len(page.one(VALUE).get_attribute("title")) > 12
    page.until(lambda: "m/h" in page.text(".sensitivity .ytitle"))
    page.type(DIAMETER, "90")
    page.until(page.fresh)
    page.until(lambda: page.text(VALUE).endswith("m/h"))


def test_numbers_under_the_equation_are_as_they_were_typed(client: httpx.Client) -> None:
    typed = SPHERE | {"particle_density": "2.63 g/cm3", "particle_diameter": "0.085 mm"}
    rows = client.post(f"/api/calc/{STOKES}", json=typed).json()["inputs_shown"]
    assert [row["text"] for row in rows[:2]] == ["0.085 mm", "2.63 g/cm³"]
    sheet = client.post(f"/api/sheet/{STOKES}", json={"inputs": typed}).text
    assert "2.63 g/cm³" in sheet


def test_the_chart_follows_the_inputs_and_the_choice_of_one(page: Page) -> None:
    page.open(PLACE)
    page.until(lambda: page.all(".sensitivity .main-svg"))
    point = (  # nothing while the field is empty
        "const d = document.querySelector('.sensitivity .plot')?.data?.at(-1);"
        "return d ? [d.x[0], d.y[0]] : [0, 0]"
    )
    assert page.browser.execute_script(point) == pytest.approx([85, 5.281], rel=1e-3)
    page.type(DIAMETER, "42.5")
    page.until(lambda: page.browser.execute_script(point)[0] == pytest.approx(42.5))
    Select(page.one("[data-menu=against]")).select_by_value("dynamic_viscosity")
    page.until(lambda: page.all("[data-sensitivity=dynamic_viscosity]:not(.stale)"))
    page.until(lambda: page.browser.execute_script(point)[0] == pytest.approx(1.2))
    page.check()


@pytest.mark.parametrize("language", MOSTLY_FRENCH)
def test_other_laws_are_a_strip_a_sentence_and_thin_lines(page: Page, language: str) -> None:
    page.open(PLACE, language)
    page.until(lambda: page.all(".sensitivity .main-svg"))
    text = {"en": "What other laws give", "fr": "Ce que donnent les autres lois"}[language]
    page.until(lambda: next((s for s in page.all("details summary") if s.text == text), None)).click()
    words = page.until(lambda: page.all("[data-summary]"))[0].text
    assert {"en": "median", "fr": "médiane"}[language] in words
    dots = len(page.all(".strip .dot"))
    assert dots == len(page.all("[data-spread] tr"))
    assert len(page.all(".strip .own")) == 1
    lines = "return document.querySelector('.sensitivity .plot').data.length"
    page.until(lambda: page.browser.execute_script(lines) > 2)
    page.check()


@pytest.mark.parametrize("language", MOSTLY_FRENCH)
def test_an_input_is_found_for_a_wanted_result(page: Page, language: str) -> None:
    """v ~ d²: four times the velocity takes twice the diameter."""
    page.open(PLACE, language)
    page.until(page.fresh)
    page.browser.execute_script(
        "document.querySelector('#field-particle_diameter').closest('.field').querySelector('.find-input').click()"
    )
    page.type("#wanted", "21.124 mm/s")
    found = lambda: page.one(DIAMETER).get_attribute("value").replace(",", ".")  # noqa: E731
    page.until(lambda: float(found()) == pytest.approx(170.0, rel=1e-3))
    page.until(lambda: page.fresh() and page.text(VALUE).replace(",", ".").startswith("21.12"))
    page.type("#wanted", "-1")
    page.until(lambda: {"en": "is not reached", "fr": "n’est atteint"}[language] in page.text("#wanted-note"))
    page.browser.get_log("browser")
    page.check()


@pytest.mark.parametrize("language", MOSTLY_FRENCH)
def test_an_interval_is_typed_and_the_result_is_one(page: Page, language: str) -> None:
    page.open(PLACE, language)
    point = "," if language == "fr" else "."
    field = page.type(DIAMETER, "85 ± 5 um")
    page.until(lambda: page.all("[data-interval]"))
    assert page.text("[data-interval]").replace(point, ".").startswith("5.28 ± 0.62 mm/s")
    assert page.leave(field) == ("85 ± 5", "um")
    page.type(DIAMETER, "80..90 um")
    page.until(lambda: "…" in page.text("[data-interval]"))
    page.browser.get_log("browser")
    page.check()


def test_a_comparison_shows_what_changed_and_by_how_much(page: Page) -> None:
    page.open(PLACE)
    page.until(page.fresh)
    page.button("Keep to compare").click()
    page.type(DIAMETER, "170")
    page.until(lambda: page.texts("[data-comparison] [data-change]") == ["+300 %", "+100 %"])
    rows = page.texts("[data-comparison] tbody tr")
    assert len(rows) == 2, "what is the same is folded"
    page.check()


@pytest.mark.parametrize("language", MOSTLY_FRENCH)
def test_cases_of_intervals_are_compared_as_such_and_fit_on_a_phone(page: Page, language: str) -> None:
    """By hand: v ~ d², so that its relative interval is twice that of d, 2 · 5/85 of 5.28 mm/s."""
    page.open(PLACE, language, 390)
    page.until(page.fresh)
    keep = {"en": "Keep to compare", "fr": "Garder pour comparer"}[language]
    page.button(keep).click()
    page.type(DIAMETER, "170 um")
    page.settle()
    page.until(page.fresh)
    page.button(keep).click()
    page.type(DIAMETER, "85 ± 5 um")
    page.until(lambda: len(page.all("[data-comparison] th")) == 3)
    last = lambda: page.texts("[data-comparison] tbody tr:first-child td")[3]  # noqa: E731
    page.until(lambda: last().replace(",", ".").startswith("5.28 ± 0.62 mm/s"))
    cut = "const e = document.querySelector('[data-comparison]'); return e.scrollWidth - e.clientWidth"
    assert page.browser.execute_script(cut) <= 0
    page.check()


def test_what_may_be_left_out_is_folded_and_what_is_refused_unfolds(page: Page) -> None:
    page.open("calculate/particles.terminal_velocity")
    assert not page.one("#field-gravity").is_displayed()
    page.one("details.more summary").click()
    page.type("#field-sphericity", "1.2")
    page.until(lambda: page.text(".field.wrong .out"))
    page.open("calculate/particles.terminal_velocity?sphericity=1.2")
    assert page.one("#field-sphericity").is_displayed()


def test_the_sensitivity_of_a_law_is_drawn_too(client: httpx.Client) -> None:
    given = {
        "solute_per_solvent": "300 g/kg",
        "solubility_per_solvent": "280 g/kg",
        "temperature": "30 degC",
        "growth_coefficient": "1e-4 m/s",
    }
    asked = {"inputs": given, "against": "growth_coefficient"}
    client.post("/api/calc/crystallization.power_law_growth", json=given)  # the first one is not repeated
    drawn = client.post("/api/sensitivity/crystallization.power_law_growth", json=asked)
    assert drawn.status_code == 200, drawn.text
    assert drawn.json()["against"] == "growth_coefficient"


def test_the_sensitivity_beyond_the_bounds_is_a_gap(client: httpx.Client) -> None:
    asked = {"inputs": SPHERE | {"particle_diameter": "86 um"}}
    first = client.post("/api/sensitivity/particles.terminal_velocity", json=asked).json()
    assert first["against"] == "particle_diameter"
    shape = {"particle_length": "6 mm", "particle_width": "4 mm", "particle_thickness": "3 mm"}
    names = [p["name"] for p in client.get("/api/cards/particles.sphericity_krumbein").json()["parameters"]]
    given = dict(zip(names, shape.values(), strict=False))
    drawn = client.post("/api/sensitivity/particles.sphericity_krumbein", json={"inputs": given}).json()
    curve = drawn["figure"]["data"][-2]["y"]
    assert None in curve
    assert 0 not in curve


def test_refusals_of_the_column_are_one_message(client: httpx.Client) -> None:
    for path, body in (
        (f"/api/sensitivity/{STOKES}", {}),
        (f"/api/sensitivity/{STOKES}", {"inputs": {"particle_diameter": "85 kg"}}),
        ("/api/sensitivity/nothing.at_all", {"inputs": {}}),
        (f"/api/solve/{STOKES}", {"inputs": SPHERE, "find": "nothing", "output": "", "wanted": ""}),
        (
            f"/api/solve/{STOKES}",
            {"inputs": SPHERE, "find": "particle_diameter", "output": "terminal_velocity", "wanted": "5 kg"},
        ),
        ("/api/solve/particles.drag_chart", {"inputs": {}, "find": "x"}),
        (f"/api/sheet/{STOKES}", {"inputs": {"particle_diameter": "-1 m"}}),
    ):
        answer = client.post(path, json=body)
        assert answer.status_code in (409, 422), (path, body, answer.text)
        assert answer.json()["error"]["message"]


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_sheet_holds_the_calculation(client: httpx.Client, language: str) -> None:
    asked = {"inputs": SPHERE | {"particle_diameter": "85 ± 5 um"}, "link": "http://127.0.0.1/#/calculate"}
    answer = client.post(f"/api/sheet/{STOKES}", json=asked, headers={"x-language": language})
    text = answer.text.replace(",", ".")
    assert "5.281 mm/s" in text
    assert "5.28 ± 0.62 mm/s" in text
    assert {"en": "Inputs", "fr": "Données"}[language] in text
    assert "http://127.0.0.1/#/calculate" in text
    assert (
        "javascript:"
        not in client.post(f"/api/sheet/{STOKES}", json=asked | {"link": "javascript:alert(1)"}).text[-3000:]
    )
    assert not re.search(r"<(?:script|link|img)[^>]*(?:src|href)=", answer.text), "nothing is fetched"


def test_an_input_of_a_law_is_found(client: httpx.Client) -> None:
    """360 over 280 g/kg is 2/7 of relative supersaturation: 10 µm/s give 20/7 µm/s."""
    given = {
        "solute_per_solvent": "360 g/kg",
        "solubility_per_solvent": "280 g/kg",
        "temperature": "43 degC",
        "growth_coefficient": "1 um/s",
    }
    asked = {
        "inputs": given,
        "find": "growth_coefficient",
        "output": "growth_rate",
        "wanted": f"{20 / 7} um/s",
    }
    found = client.post("/api/solve/crystallization.power_law_growth", json=asked)
    assert found.status_code == 200, found.text
    assert float(found.json()["text"].split()[0]) == pytest.approx(10.0, rel=1e-6)


def test_the_streams_of_a_machine_alone_have_names_of_the_language(page: Page) -> None:
    page.open("calculate/evaporation.evaporator", "fr")
    page.one("[data-figure]")
    names = page.texts("thead th")
    assert {"alimentation", "produit", "vapeur"} <= set(names), names
