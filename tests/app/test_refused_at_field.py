"""What is refused of a line is told in the words of the field where it was typed, and marked there."""

from __future__ import annotations

from typing import Any

import pytest
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select
from tests.app.browsing import Page

from granum.app.building import built
from granum.app.wording import told
from granum.cases.building import add_feed, add_unit, new_line, set_size_classes
from granum.cases.reading import read_text
from granum.core.errors import CaseError, GranumError, InputError
from granum.core.i18n import language

LINE: dict[str, Any] = {
    "title": "A",
    "liquid": "water",
    "solute": "potassium nitrate",
    "solid": "quartz",
    "gas": "dry air",
}
# field of New line, what is typed into it, what enters, what the message must say in English and in French
TYPED = [
    ("liquid", "0", "suspension", "'0' is not in the library", "« 0 » n’est pas dans la bibliothèque"),
    ("liquid", "watter", "suspension", "Did you mean 'water'?", "Vouliez-vous dire « eau » ?"),
    ("liquid", "", "suspension", "nothing is given", "rien n’est donné"),
    ("liquid", "quartz", "suspension", "not for this part", "pas pour ce rôle"),
    ("solid", " ", "broken_solid", "nothing is given", "rien n’est donné"),
    ("solid", "granitt", "suspension", "Did you mean 'granite'?", "Vouliez-vous dire « granite » ?"),
    ("gas", "zz", "moist_solid", "'zz' is not in the library", "« zz » n’est pas dans la bibliothèque"),
    ("solute", "sodum chloride", "solution", "'sodium chloride'", "« chlorure de sodium »"),
]


@pytest.mark.parametrize(("field", "text", "enters", "english", "french"), TYPED)
def test_a_name_is_refused_with_the_words_of_its_field(
    field: str, text: str, enters: str, english: str, french: str
) -> None:
    for code, words in (("en", english), ("fr", french)):
        with language(code), pytest.raises(InputError) as refused:
            built("begin", "", {**LINE, "enters": enters, field: text})
        error = told(refused.value.as_json())
        assert error["name"] == field
        assert words in error["message"]
        assert not set("[]`") & set(error["message"]), "no words of case files"


def test_every_field_that_is_refused_is_told() -> None:
    for code, words in (("en", "is not in the library"), ("fr", "n’est pas dans la bibliothèque")):
        with language(code), pytest.raises(InputError) as refused:
            built("begin", "", {**LINE, "enters": "moist_solid", "liquid": "xx", "solid": "yy", "gas": "zz"})
        error = told(refused.value.as_json())
        assert error["name"] == "solid"
        assert sorted(error["beside"]) == ["gas", "liquid"]
        assert all(words in message for message in error["beside"].values())


def test_a_solute_that_does_not_crystallize_from_a_liquid_is_refused_at_its_field() -> None:
    with pytest.raises(InputError, match="does not crystallize from 'ethanol'") as refused:
        built("begin", "", {**LINE, "enters": "solution", "solute": "sodium chloride", "liquid": "ethanol"})
    assert refused.value.details["name"] == "solute"


def test_substances_that_a_page_does_not_ask_for_are_not_looked_at() -> None:
    assert "quartz" in built("begin", "", {**LINE, "enters": "broken_solid", "liquid": "0", "gas": ""})


def test_a_substance_of_the_case_itself_may_be_chosen() -> None:
    own = built(
        "describe_substance",
        "",
        {"sort": "solid", "name": "mud", "values": {"density": "2 g/cm3", "heat_capacity": "1 kJ/(kg K)"}},
    )
    assert "mud" in built("begin", "", {**LINE, "enters": "suspension", "solid": "mud", "own": own})


def test_a_further_substance_is_refused_at_the_list_of_its_phase() -> None:
    case = new_line("A", ["water"], ["quartz"])
    with pytest.raises(InputError) as refused:
        built("choose_substances", case, {"liquids": ["water"], "solids": ["quartz", "unobtainium"]})
    assert refused.value.details["name"] == "solids"
    assert "unobtainium" in refused.value.message
    assert "[" not in refused.value.message


def test_nothing_is_no_name_of_a_material() -> None:
    with pytest.raises(GranumError):
        new_line("A", [""], ["quartz"])
    with pytest.raises(GranumError):
        new_line("A", ["water"], [""])


SIZES = {"law": "rosin_rammler", "size_modulus": "150 um", "distribution_exponent": 1.5}
FEED = {"liquid_flow": "1 t/h", "solid_flow": "1 t/h", "sizes": SIZES}


def fed(given: dict[str, Any]) -> str:
    """A hydrocyclone with such a feed."""
    line = add_feed(new_line("A", ["water"], ["quartz"]), "slurry", values={**FEED, **given})
    return add_unit(line, "cyclones.hydrocyclone", origin="slurry")


@pytest.mark.parametrize(
    ("given", "field", "option"),
    [
        ({"sizes": {**SIZES, "size_modulus": "-5 um"}}, "sizes", "size_modulus"),
        ({"sizes": {**SIZES, "size_modulus": "5 kg"}}, "sizes", "size_modulus"),
        ({"sizes": {**SIZES, "distribution_exponent": "x"}}, "sizes", "distribution_exponent"),
        ({"sizes": {**SIZES, "size_modulus": "5 m"}}, "sizes", None),
        ({"liquid": {"water": "150 %"}}, "liquid.water", None),
        ({"liquid_flow": "-1 kg/h"}, "liquid_flow", None),
        ({"temperature": "-300 degC"}, "temperature", None),
    ],
)
def test_what_a_feed_is_refused_for_names_its_field(
    given: dict[str, Any], field: str, option: str | None
) -> None:
    case = fed(given)
    for code in ("en", "fr"):
        with language(code), pytest.raises(CaseError) as refused:
            read_text(case)
        error = told(refused.value.as_json())
        assert (error["unit"], error["name"], error.get("option")) == ("slurry", field, option)
        assert not set("[]'") & set(
            error["message"].replace("'kg'", "").replace("'x'", "").replace("'1.5'", "")
        )


def test_size_classes_are_widened_where_a_feed_asks_for_it() -> None:
    case = fed({"sizes": {**SIZES, "size_modulus": "5 cm"}})
    with pytest.raises(CaseError, match="coarser than 10 mm"):
        read_text(case)
    assert read_text(set_size_classes(case, "10 um", "1 m", "30")) is not None
    for low, high, count, at in (("2 mm", "1 mm", "30", "smallest"), ("1 um", "1 mm", "0", "classes")):
        with pytest.raises(InputError) as refused:
            set_size_classes(case, low, high, count)
        assert refused.value.details["name"] == at
        with language("fr"), pytest.raises(InputError) as refused:
            set_size_classes(case, low, high, count)
        with language("fr"):
            assert "taille" in told(refused.value.as_json())["message"]
            assert "mixture" not in told(refused.value.as_json())["message"]


def options(page: Page, form: str) -> dict[str, str]:
    return {
        row.get_attribute("data-option"): row.find_element("css selector", "input").get_attribute("value")
        for row in page.all(f"{form} .law [data-option]")
    }


def test_a_line_is_refused_and_marked_on_the_page(page: Page) -> None:
    page.open("lines", "fr")
    page.button("Nouvelle ligne").click()
    page.one("input[name=enters][value=suspension]").click()
    page.type("#new-liquid", "0")
    page.browser.execute_script("document.querySelector('[data-describe]').open = true")
    page.type("#new-own-name", "boue")
    page.type("#new-solid", "yy")
    page.one("#new-solid").send_keys(Keys.ENTER)
    page.says("#new-solid-told", "« yy » n’est pas dans la bibliothèque")
    page.says("#new-liquid-told", "« 0 » n’est pas dans la bibliothèque")
    assert page.one("#new-liquid").get_attribute("aria-invalid") == "true"
    assert page.one("#new-liquid").get_attribute("value") == "0"
    page.one("input[name=enters][value=moist_solid]").click()
    page.one("input[name=enters][value=suspension]").click()
    assert page.one("#new-own-name").get_attribute("value") == "boue", "what was begun here stays"
    page.type("#new-liquid", "eau")
    page.paste("#new-solid", "")
    field = page.one("#new-solid")
    field.send_keys(Keys.CONTROL, "a")
    field.send_keys(
        "granit", Keys.ENTER
    )  # in one go: what is made is what stands there, not what was drawn last
    page.one("[data-palette]")
    assert "granite" in page.one("#case").get_attribute("value")
    page.type("[data-palette] input", "hydrocyclone").send_keys(Keys.ENTER)
    page.one("[data-panel]")
    form = "[data-form=suspension]"
    page.browser.execute_script("document.querySelector(arguments[0]).open = true", form)
    size, place = "field-form-suspension-sizes", "#field-form-suspension-sizes-size_modulus"
    page.leave(page.type(place, "85"))
    page.until(lambda: "85 um" in page.one("#case").get_attribute("value"))
    Select(page.one(f"#{size}")).select_by_value("gates_gaudin_schuhmann")
    page.until(lambda: "size_maximum" in options(page, form))
    assert options(page, form)["distribution_exponent"] == "1,5", "what two laws share is kept"
    page.leave(page.type(f"#{size}-size_maximum", "2"))
    page.leave(page.type(f"#{size}-distribution_exponent", "0,8"))
    Select(page.one(f"#{size}")).select_by_value("log_normal")
    page.until(lambda: "median_diameter" in options(page, form))
    Select(page.one(f"#{size}")).select_by_value("gates_gaudin_schuhmann")
    page.until(lambda: "size_maximum" in options(page, form))
    assert options(page, form) == {"size_maximum": "2", "distribution_exponent": "0,8"}, (
        "given back with its law"
    )
    page.leave(page.type(f"#{size}-size_maximum", "5 m"))
    page.button("Résoudre").click()
    page.says(f"{form} .out", "plus grossier que 10 mm")
    assert page.one(f"#{size}").get_attribute("aria-invalid") == "true"
    page.leave(page.type(f"#{size}-size_maximum", "-5 um"))
    page.button("Résoudre").click()
    page.says(f"{form} .told", "−5")
    assert page.one(f"#{size}-size_maximum").get_attribute("aria-invalid") == "true"
    assert page.one(f"#{size}").get_attribute("aria-invalid") == "false"
