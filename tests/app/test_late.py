"""Answers of the server that come late, and not in the order of the questions: nothing that was typed,
chosen or found meanwhile is lost by them.
"""

from __future__ import annotations

import random
from typing import Any
from urllib.parse import parse_qsl, urlsplit

import pytest
from selenium.webdriver.common.keys import Keys
from tests.app.browsing import Page

LATE = """
    const sent = window.fetch;
    window.asked = [];
    window.late = arguments[0];
    window.fetch = async (path, request) => {
      const found = Object.keys(window.late).find((start) => String(path).startsWith(start));
      window.asked.push(String(path));
      const wait = found ? window.late[found].shift() ?? 0 : 0;
      const response = await sent(path, request);
      await new Promise((done) => setTimeout(done, wait));
      return response;
    };
"""


def late(page: Page, **paths: list[int]) -> None:
    """From now on answers come so many milliseconds late, path by path, one number after the other."""
    page.browser.execute_script(
        LATE, {f"/api/{path.replace('_', '/')}": waits for path, waits in paths.items()}
    )


def asked(page: Page, path: str) -> int:
    return page.browser.execute_script(
        "return window.asked.filter((p) => p.startsWith(arguments[0])).length", path
    )


def typed(page: Page, selector: str, text: str) -> Any:
    """Typed in one go, as a quick hand does."""
    field = page.one(selector)
    page.browser.execute_script("arguments[0].closest('details')?.setAttribute('open', '')", field)
    field.send_keys(Keys.CONTROL, "a")
    field.send_keys(text)
    return field


def rest(page: Page, milliseconds: int) -> None:
    page.browser.execute_async_script("setTimeout(arguments[1], arguments[0])", milliseconds)
    page.settle()


def values(page: Page) -> dict[str, str]:
    return dict(parse_qsl(urlsplit(page.browser.current_url).fragment.partition("?")[2]))


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_what_is_typed_next_outlives_what_is_understood_late(page: Page, seed: int) -> None:
    page.open("calculate/particles.terminal_velocity_stokes")
    late(page, read=random.Random(seed).sample(range(0, 1600, 100), 16))
    wanted = {"particle_diameter": "81 um", "particle_density": "2,7 g/cm3", "fluid_density": "0.99 kg/L"}
    for name, text in wanted.items():
        typed(page, f"#field-{name}", text)
    field = typed(page, "#field-dynamic_viscosity", "1.2 cP")
    rest(page, 2000)
    assert page.browser.switch_to.active_element == field, "the focus stays where one types"
    assert field.get_attribute("value") == "1.2 cP"
    found = values(page)
    assert [found[name].split()[0].replace(",", ".") for name in wanted] == ["81", "2.7", "0.99"], found
    assert found["dynamic_viscosity"].startswith("1.2")
    assert page.fresh()
    for name in ("dynamic_viscosity", "fluid_density"):
        page.button("Undo").click()
        rest(page, 200)
        assert values(page)[name] != found[name], "what was understood is no step of its own"
    assert values(page)["particle_density"].split()[0].replace(",", ".") == "2.7"


def test_a_study_that_was_begun_before_its_field_was_understood_is_no_old_one(page: Page) -> None:
    page.open("studies/card:particles.terminal_velocity_stokes")
    late(page, read=[900, 900])
    typed(page, "[data-part=low] input", "0,03 mm")
    page.button("Run the study").click()
    page.until(lambda: page.all("[data-study]"))
    rest(page, 1200)
    assert not page.all("[data-old]")
    assert page.text("[data-question] h2").count("0.03 mm") == 1


def test_a_row_that_was_removed_stays_away(page: Page) -> None:
    page.open("studies/card:particles.terminal_velocity_stokes")
    page.one("[data-kind=monte_carlo]").click()
    page.button("One more input").click()
    late(page, read=[800, 300])
    last = page.all(".varied")[-1]
    field = last.find_element("css selector", "[data-part=mean] input")
    field.send_keys(Keys.CONTROL, "a")
    field.send_keys("2400")
    next(b for b in last.find_elements("css selector", "button") if b.text == "Remove").click()
    rest(page, 1200)
    assert len(page.all(".varied")) == 1


def test_a_fit_is_asked_once_for_a_text_that_is_understood_late(page: Page) -> None:
    page.open("lab/filtration.leaf_test")
    page.button("Try with example data").click()
    page.until(lambda: page.all("[data-parameter]"))
    late(page, read=[900])
    typed(page, "#field-area", "0,05 m2").send_keys(Keys.TAB)
    rest(page, 2200)
    assert asked(page, "/api/fit") == 1
    assert not page.all(".stale")
    assert values(page)["area"].split()[0].replace(",", ".") == "0.05"


def number(page: Page, place: str) -> str:
    """What a field holds; a machine so slow that a text is taken before its field is left keeps its comma."""
    return page.one(place).get_attribute("value").replace(",", ".")


def test_two_fields_of_a_line_are_two_steps(page: Page) -> None:
    page.open("lines/examples:cyclone/pair.toml")
    page.until(lambda: page.all("[data-streams]"))
    panels = [p for p in page.all("[data-form] input") if "diameter" in (p.get_attribute("id") or "")]
    one, other = (f"#{p.get_attribute('id')}" for p in panels[:2])
    late(page, read=[1400, 200])
    typed(page, one, "0,61 m").send_keys(Keys.TAB)
    rest(page, 700)
    typed(page, other, "0,62 m").send_keys(Keys.TAB)
    rest(page, 2500)
    assert asked(page, "/api/case/edit") == 2
    assert [number(page, place) for place in (one, other)] == ["0.61", "0.62"]
    assert not page.all("[data-old]")
    page.button("Undo").click()
    rest(page, 600)
    assert number(page, one) == "0.61"
    assert number(page, other) != "0.62"


def test_answers_are_held_while_an_exam_is_marked(page: Page) -> None:
    page.open("exercises/exam?seed=7&count=1")
    field = next(iter(page.all(".exam-paper .quantity input")), None)
    assert field is not None
    field.send_keys("1")
    late(page, exercises=[900])
    page.button("Hand in").click()
    page.until(lambda: not page.all(".exam-paper .quantity input"))
    page.one("[data-score]")
    assert "No answer." not in page.all("[data-verdict]")[0].text


def test_what_is_on_its_way_into_a_line_is_not_taken_back_by_an_answer_before_it(page: Page) -> None:
    page.open("lines/examples:dryers/solar.toml")
    page.until(lambda: page.all("[data-form] input"))  # a count, whose text no unit can be parted from
    place = next(
        f"#{p.get_attribute('id')}"
        for p in page.all("[data-form] input")
        if (p.get_attribute("id") or "").endswith("-days")
    )
    late(page, case_form=[1500, 1500, 0])
    field = typed(page, place, "1")
    waited = "setTimeout(arguments[1], arguments[0])"
    page.browser.execute_async_script(waited, 700)  # the first text is on its way
    field.send_keys("2")
    for _look in range(12):
        page.browser.execute_async_script(waited, 200)
        assert field.get_attribute("value") == "12"
    field.send_keys("3")
    assert field.get_attribute("value") == "123"
