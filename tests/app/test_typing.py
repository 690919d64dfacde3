"""What is typed key by key is what is calculated, whatever is typed; nothing is guessed, and no other result
looks like its answer.

The short run makes a few turns. ``GRANUM_RANDOM_SAMPLES=1000 pytest -n 0 tests/app/test_typing.py`` goes
through all cards.
"""

from __future__ import annotations

import random
from urllib.parse import quote

import pytest
from selenium.webdriver.common.by import By
from tests.app.browsing import Page
from tests.app.typist import Typist, complaints
from tests.sharing.samples import SAMPLES

from granum.core import registry

QUICK = (
    "particles.terminal_velocity_stokes",
    "particles.drag_coefficient_haider_levenspiel",
    "materials.ice_vapor_pressure",
)
STOKES = "calculate/particles.terminal_velocity_stokes?particle_diameter=85+um&particle_density=2630+kg%2Fm%5E3&fluid_density=1020+kg%2Fm%5E3&dynamic_viscosity=1.2+cP"  # noqa: E501
MEAN = "calculate/particles.mean_diameter_moment_ratio"
SHAPE = "calculate/particles.drag_coefficient_haider_levenspiel"
DIAMETER = "#field-particle_diameter"
CASE = f"lines/{quote('examples:grinding-circuit/circuit.toml', safe='')}"


def test_whatever_is_typed_the_result_is_that_of_the_text_on_the_screen(page: Page) -> None:
    rng = random.Random(16)
    every = sorted(
        key for key, thing in registry.everything().items() if thing.card.sort in ("formula", "procedure")
    )
    typist, done = Typist(page, seed=16), 0
    while done < max(SAMPLES, 6):
        typist.card(rng.choice(every if SAMPLES else QUICK), rng.choice(("en", "fr")))
        for _ in range(3 if typist.fields else 0):
            typist.turn()
            done += 1
        assert not complaints(page.browser), typist.log[-3:]


@pytest.mark.parametrize(
    ("place", "selector", "typed", "echo"),
    [
        (STOKES, DIAMETER, "1 1/2 in", "= 1.5 in"),
        (STOKES, DIAMETER, "10; 20", "= 10 · 20 µm"),
        (STOKES, DIAMETER, "5 1 um", "= 5 · 1 µm"),
        (STOKES, DIAMETER, "١٢", ""),
        (STOKES, DIAMETER, "5±1 um", "= 5 ± 1 µm"),
        (STOKES, DIAMETER, "80..90 um", "= 80 … 90 µm"),
        (SHAPE, "#field-sphericity", "0.5; 1", "= 0.5 · 1"),
        (MEAN, "#field-class_sizes", "1, 10 mm", "= 1 · 10 mm"),
        (MEAN, "#field-class_sizes", "0,5 mm", ""),
    ],
)
def test_numbers_that_may_be_read_in_two_ways_are_not_guessed(
    page: Page, place: str, selector: str, typed: str, echo: str
) -> None:
    page.open(place)
    field = page.type(selector, typed)
    if echo:
        page.until(lambda: page.texts("[data-echo]") == [echo])
        number, unit = page.leave(field)
        shown = f"{number} { ({'inch': 'in', 'um': 'µm'}.get(unit, unit)) }".replace("; ", " ").strip()
        assert shown == echo[2:].replace(" · ", " ")
    else:
        page.until(lambda: page.text(".quantity .out"))
        page.until(lambda: not page.fresh())
        assert page.leave(field)[0] == typed


def test_a_fluid_in_words_stands_in_place_of_its_properties(page: Page) -> None:
    """Water of 20 °C has 1.0016 mPa s (IAPWS); what was typed for its density before is gone, and what is no
    fluid is told at its field.
    """
    page.open(STOKES)
    page.write("#field-fluid", "watr at 20 °C")
    page.until(lambda: page.text("#field-fluid-note .out"))
    assert page.one("#field-fluid_density").get_attribute("value") == ""
    page.write("#field-fluid", "water at 20 °C")
    page.until(page.fresh)
    page.says("section[aria-label=Believe]", "1.002 mPa·s (water at 20 °C, liquid)")


def test_a_result_of_other_inputs_is_not_kept_to_compare(page: Page) -> None:
    page.open(STOKES)
    assert page.button("Keep to compare").is_enabled()
    page.write(DIAMETER, "-3")  # over the text that stands there, so that the result of before stays, grey
    page.until(lambda: not page.fresh() and not page.button("Keep to compare").is_enabled())


def test_a_study_has_as_many_cases_as_were_typed(page: Page) -> None:
    page.open(
        f"studies/{quote('card:particles.terminal_velocity_stokes', safe='')}?{STOKES.partition('?')[2]}"
    )
    for typed in ("ten", "1 2", ""):
        page.type("[data-part=steps]", typed)
        page.button("Run the study").click()
        page.until(lambda: "must be a whole number" in page.text("[role=alert]"))
        assert "study." not in page.text("[role=alert]")
        assert not page.all("[data-study]")
    page.type("[data-part=steps]", "7")
    page.button("Run the study").click()
    page.until(lambda: page.text("[data-study=sweep]").startswith("● 7 cases"))
    page.one("[data-kind=monte_carlo]").click()
    page.type("input.short", "1 200")
    page.button("Run the study").click()
    assert "1200" in page.text("[data-study=monte_carlo]").replace("\u202f", "")


def test_quantities_of_a_law_have_units_too(page: Page) -> None:
    page.open(CASE)
    page.one(".diagram svg")
    page.browser.execute_script("document.querySelector('[data-form=mill]').open = true")
    option = "[data-form=mill] [data-option=selection_rate] input"
    assert page.leave(page.type(option, "0,7 1/min")) == ("0.7", "1/min")
    page.until(lambda: "0.7 1/min" in page.one("#case").get_attribute("value"))
    page.type(option, "12 kg")
    page.until(lambda: page.text("[data-form=mill] [data-option] .out"))
    page.until(lambda: page.all(".stale .diagram"))


def test_what_is_typed_in_a_line_is_in_the_file_that_is_saved(page: Page) -> None:
    page.open(CASE)
    page.one(".diagram svg")
    page.write("[aria-label='File name']", "mine/typed.toml")
    page.browser.execute_script("document.querySelector('[data-form=mill]').open = true")
    page.type("[data-form=mill] input[id$=holdup_mass]", "2.4 tonne")
    page.button("Save").click()
    page.until(lambda: "typed.toml" in page.browser.current_url)
    read = "fetch('/api/workspace/mine/typed.toml').then((r) => r.json()).then((d) => arguments[0](d.text))"
    assert 'holdup_mass = "2.4 tonne"' in page.browser.execute_async_script(read)
    assert page.browser.find_element(By.CSS_SELECTOR, "#case")
