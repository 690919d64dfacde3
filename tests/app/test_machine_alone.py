"""A piece of equipment alone: undone in steps that people made, and studied as it stands on the screen."""

from __future__ import annotations

import httpx
import pytest
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select
from tests.app.browsing import Page

PUMP = "calculate/streams.pump"
RISE = "#field-pressure_rise"
DIAMETER = "#field-particle_diameter"
STUDY, UNDO = {"en": "Study", "fr": "Étudier"}, {"en": "Undo", "fr": "Annuler"}


@pytest.mark.parametrize(
    ("place", "field", "figures"),
    [("calculate/particles.terminal_velocity", DIAMETER, "[data-output]"), (PUMP, RISE, "[data-figure]")],
)
def test_a_field_left_and_entered_again_is_another_step_back(
    page: Page, place: str, field: str, figures: str
) -> None:
    page.open(place)
    page.one(figures)
    before = page.one(field).get_attribute("value")
    for text in ("91", "92"):
        page.type(field, text).send_keys(Keys.TAB)
    for wanted in ("91", before):
        page.button("Undo").click()
        page.until(lambda wanted=wanted: page.one(field).get_attribute("value") == wanted)
    assert not page.button("Undo").is_enabled()


@pytest.mark.parametrize("language", ["en", "fr"])
def test_a_machine_alone_is_studied_as_it_stands_on_the_screen(page: Page, language: str) -> None:
    page.open(PUMP, language)
    page.one("[data-figure]")
    page.type(RISE, "7").send_keys(Keys.TAB)
    page.settle()
    page.until(lambda: next((a for a in page.all("a.button") if a.text == STUDY[language]), None)).click()
    page.one(".varied")
    page.settle()
    menu = page.one(".varied select")
    names = [o.get_attribute("value") for o in menu.find_elements("tag name", "option")]
    name = next(n for n in names if n.endswith(".pressure_rise"))
    page.browser.execute_script(
        "arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('change', {bubbles: true}))",
        menu,
        name,
    )
    page.until(lambda: "7" in page.text(".varied .dim"))
    page.one(".button.main").click()
    page.until(lambda: page.all(".js-plotly-plot"))
    page.check()


KINDS = {
    "sweep": {"over": {"pump.pressure_rise": {"from": "2 bar", "to": "6 bar", "steps": 3}}},
    "monte_carlo": {
        "samples": 16,
        "uncertain": {
            "pump.pressure_rise": {"distribution": "normal", "mean": "4 bar", "standard_deviation": "0.2 bar"}
        },
    },
}


@pytest.mark.parametrize("kind", KINDS)
def test_a_study_of_a_machine_alone_needs_no_file(kind: str, address: str) -> None:
    with httpx.Client(base_url=address, timeout=240, headers={"x-language": "en"}) as client:
        case = client.post("/api/alone/streams.pump", json={"pressure_rise": "4 bar"}).json()["case"]
        asked = {"case": case, "place": "computer:pump.toml"}
        choices = client.post("/api/studies/choices", json=asked).json()
        figure = next(f["name"] for f in choices["figures"] if f["name"].endswith(".electric_power"))
        table = {"kind": kind, "outputs": [figure], **KINDS[kind]}
        job = client.post("/api/studies", json=asked | {"table": table}).json()["id"]
        found = client.get(f"/api/studies/{job}").json()
        while found["state"] not in ("done", "failed"):
            found = client.get(f"/api/studies/{job}").json()
        assert found["state"] == "done", found
        assert found["outcome"]["counts"]["failed"] == 0


@pytest.mark.parametrize(
    ("machine", "language"), [("drying.fluidized_bed_dryer", "fr"), ("centrifuges.peeler", "en")]
)
def test_the_streams_of_a_machine_alone_fit_beside_its_form(page: Page, machine: str, language: str) -> None:
    page.open(f"calculate/{machine}", language, width=1280)
    page.one("[data-figure]")
    table = page.one("[data-streams] table")
    cut = "const box = arguments[0].parentElement; return box.scrollWidth - box.clientWidth"
    assert page.browser.execute_script(cut, table) <= 0
    heads = page.texts("[data-streams] tbody th")
    assert any(head.startswith("T /") for head in heads), heads
    page.check()


def test_a_field_of_what_may_be_left_out_stays_while_it_is_filled(page: Page) -> None:
    page.open(PUMP)
    page.one("[data-figure]")
    field = page.type("#field-machine_efficiency", "65 %")
    page.settle()
    page.until(lambda: "machine_efficiency=" in page.browser.current_url)
    assert field.find_elements("xpath", "ancestor::details[@class='more']"), "it does not move"
    assert page.browser.switch_to.active_element == field


def test_what_was_refused_is_not_said_of_what_is_typed_next(page: Page) -> None:
    page.open(PUMP, "fr")
    page.one("[data-figure]")
    page.leave(page.type("#field-machine_efficiency", "-5 %"))
    page.until(lambda: page.all("[aria-invalid=true]"))
    page.type("#field-machine_efficiency", "60 %")
    page.until(lambda: not page.all("[aria-invalid=true]"))
    page.settle()
    assert not page.all(".message.out")
    assert not page.all(".stale [data-figure]")


def test_refusals_of_a_stream_are_in_words(page: Page) -> None:
    page.open(PUMP, "fr")
    page.one("[data-figure]")
    page.type("#field-feed\\.temperature", "-300 °C")
    page.says(".told", "Température = −300 °C n’est pas possible")
    assert "feed" not in page.text(".told")


def test_a_law_within_a_law_is_chosen_too(page: Page) -> None:
    page.open("calculate/crystallization.antisolvent_crystallizer", "fr")
    inner = page.one("select#field-solubility-pure_solubility")
    assert inner.get_attribute("value") == "library_solubility"
    solute = Select(page.one("#field-solubility-pure_solubility-solute"))
    solute.select_by_visible_text("acide adipique")  # its curve is far below what is dissolved
    page.until(lambda: "adipic" in page.browser.current_url)
    Select(page.one("#field-solubility-pure_solubility-solute")).select_by_value("sodium chloride")
    page.settle()
    page.until(lambda: page.all("[data-figure]") and not page.all(".stale, .message.out"))
    page.check(refused=True)  # of the curve between


def test_a_law_that_needs_parameters_is_chosen_with_names_of_what_the_machine_is_fed(page: Page) -> None:
    page.open("calculate/filtration.nutsche", "fr")
    page.one("[data-figure]")
    page.browser.execute_script("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    Select(page.one("#field-wash_dissolution")).select_by_value("saturating_wash")
    solvent = Select(page.one("#field-wash_dissolution-solvent"))
    assert solvent.first_selected_option.get_attribute("value") == "water"
    assert "nitrate de potassium" in page.texts("#field-wash_dissolution-crystal option")
    page.settle()
    assert not page.all(".message.out")  # it calculates with what it starts from


def test_the_link_of_a_machine_alone_carries_what_was_typed(page: Page) -> None:
    page.open(PUMP, "fr")
    page.one("[data-figure]")
    page.leave(page.type(RISE, "7,5"))
    page.until(lambda: "7.5" in page.browser.current_url)
    page.button("Copier le lien").click()
    page.until(lambda: page.text(".row [role=status]"))
    link = page.browser.current_url
    page.browser.get("about:blank")
    page.browser.get(link)
    page.until(lambda: page.one(RISE).get_attribute("value") == "7,5")
