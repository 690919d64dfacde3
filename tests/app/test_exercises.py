"""Exercises: every answer is computed, every declared slip is told apart from the right answer, and a student
types answers of their own.
"""

from __future__ import annotations

from typing import Any

import pytest
from selenium.webdriver.common.keys import Keys
from tests.app.browsing import Page

from granum.app import exercises
from granum.app.exercises.marking import marked, slips, tolerance_of
from granum.app.exercises.numbers import Numbers
from granum.core.i18n import language

ALL = exercises.declared()["exercise"]
SEEDS = (None, 1, 2, 3, 4, 5)


def seeds(exercise: dict[str, Any]) -> tuple[int | None, ...]:
    return SEEDS if exercise.get("draws") else (None,)


def computed(exercise: dict[str, Any]) -> list[tuple[int, dict[str, Any]]]:
    """The steps whose answer is a number."""
    return [(place, step) for place, step in enumerate(exercise["steps"]) if "choices" not in step]


@pytest.mark.parametrize("exercise", ALL, ids=lambda e: e["id"])
def test_the_printed_answer_is_met_or_has_its_erratum(exercise: dict[str, Any]) -> None:
    numbers = Numbers(exercise)
    for place, step in computed(exercise):
        asked, found = step["expected"], numbers.calculated(place)
        if "value" in asked:
            assert found == pytest.approx(asked["value"], abs=asked["within"]), step["ask"]["en"]
        if "misprint" in asked:
            assert step["erratum"], step["ask"]["en"]
            assert abs(found - asked["misprint"]) > tolerance_of(step, found), step["ask"]["en"]


@pytest.mark.parametrize("exercise", ALL, ids=lambda e: e["id"])
def test_every_slip_is_told_apart_from_the_right_answer(exercise: dict[str, Any]) -> None:
    for seed in seeds(exercise):
        numbers = Numbers(exercise, seed)
        for place, step in computed(exercise):
            right, unit = numbers.calculated(place), step["expected"]["unit"]
            assert marked(exercise["id"], place, seed, f"{right!r} {unit}")["verdict"] == "right"
            for slip, value in slips(numbers, place, right):
                assert abs(value - right) > 1.5 * tolerance_of(step, right), (seed, step["ask"]["en"], slip)
                if value > 0.0:  # where a kind has no negative numbers, the answer is refused in words
                    verdict = marked(exercise["id"], place, seed, f"{value!r} {unit}")
                    assert verdict == {"verdict": "wrong", "text": slip["says"]["en"]}, (seed, place)


def test_every_domain_of_the_course_has_an_exercise() -> None:
    assert {e["domain"] for e in ALL} == set(exercises.domain_labels())
    assert len({e["id"] for e in ALL}) == len(ALL)


def test_fresh_numbers_are_the_same_for_the_same_seed_and_lie_in_their_range() -> None:
    for exercise in ALL:
        for name, draw in exercise.get("draws", {}).items():
            values = [Numbers(exercise, seed).drawn(name)[0] for seed in range(1, 40)]
            assert values == [Numbers(exercise, seed).drawn(name)[0] for seed in range(1, 40)]
            assert len(set(values)) > 3, (exercise["id"], name)
            assert min(values) >= draw["from"] - 0.03 * abs(draw["from"]), (exercise["id"], name)
            assert max(values) <= draw["to"] + 0.03 * abs(draw["to"]), (exercise["id"], name)


def test_units_and_signs_are_told() -> None:
    # Stokes by hand: 9.80665 · (2630 - 1020) · (85e-6)² / (18 · 1.2e-3) = 5.281 mm/s
    assert marked("falling-crystal", 0, None, "5.28 mm/s")["verdict"] == "right"
    assert marked("falling-crystal", 0, None, "0.00528 m/s")["verdict"] == "right"
    assert "5280 mm/s is 1000 times too large" in marked("falling-crystal", 0, None, "5.28 m/s")["text"]
    assert "sign" in marked("air-at-zero", 1, None, "2.68 degC")["text"]
    assert marked("falling-crystal", 0, None, "5.28 kg")["verdict"] == "unclear"
    for number in ("5 kg", "5 m"):  # of a number without a unit: neither "use one of 1" nor nothing
        refused = marked("falling-crystal", 1, None, number)
        assert refused["verdict"] == "unclear"
        assert refused["text"].endswith("does not fit. Give a number without a unit, or in %.")
    assert marked("counted-powder", 2, None, "-30 mm")["text"].endswith("greater than 0 mm.")
    assert marked("falling-crystal", 0, None, "5.5 mm/s")["text"].startswith("Close, but 4.1 % too large")
    assert marked("falling-crystal", 0, None, "7 mm/s")["text"] == "Not this: too large."
    with language("fr"):
        assert marked("falling-crystal", 0, None, "7 mm/s")["text"] == "Pas cela : trop grand."


def test_statements_carry_their_numbers_in_both_languages() -> None:
    for exercise in ALL:
        for code in ("en", "fr"):
            for seed in seeds(exercise)[:2]:
                with language(code):
                    shown = exercises.worked(exercise["id"], seed)
                texts = [shown["statement"], *(s["ask"] + s["hint"] + s["erratum"] for s in shown["steps"])]
                assert not [text for text in texts if "{" in text]
                assert [s.get("inputs") or s["choices"] for s in shown["steps"]]


@pytest.mark.parametrize(
    ("language_code", "radius", "right", "check", "hint"),
    [("en", "1.32", "5.28", "Check", "Hint"), ("fr", "1,32", "5,28", "Vérifier", "Indice")],
)
def test_a_student_answers(
    page: Page, language_code: str, radius: str, right: str, check: str, hint: str
) -> None:
    page.open("exercises/falling-crystal", language_code)
    field = "[data-step='0'] .quantity input"
    assert "2 %" in page.text("[data-step='0'] [data-within]")
    page.type(field, radius)
    page.one("[data-step='0'] button.main").click()
    page.one("[data-step='0'] [data-verdict=wrong]")
    said = page.text("[data-step='0'] [data-verdict]")
    assert ("radius" if language_code == "en" else "rayon") in said
    page.button(hint).click()
    assert page.one("[data-hint] math")
    page.type(field, f"{right} mm/s")
    assert page.button(check)
    page.one(field).send_keys(Keys.ENTER)
    page.one("[data-step='0'] [data-verdict=right]")
    page.until(lambda: "1/3" in page.text(".course a[aria-current]"))
    page.check()
    page.browser.refresh()
    page.settle()
    assert page.one("[data-step='0'] [data-verdict=right]"), "what was answered is kept"
    assert page.one(field).get_attribute("value") == right
    other = {"en": "fr", "fr": "en"}[language_code]
    page.browser.get(page.browser.current_url.replace(f"lang={language_code}", f"lang={other}"))
    page.settle()
    said = {"en": "Right: 5.281 mm/s when calculated.", "fr": "Juste : 5,281 mm/s par le calcul."}[other]
    page.says("[data-step='0'] [data-verdict=right]", said)
    assert page.one(field).get_attribute("value") == {"en": "5.28", "fr": "5,28"}[other]
    page.says(".course a[aria-current]", "1/3")


def test_fresh_numbers_and_the_answer_on_request(page: Page) -> None:
    page.open("exercises/falling-crystal")
    before = page.text(".statement")
    page.button("Other numbers").click()
    page.until(lambda: "seed=" in page.browser.current_url and page.all(".statement"))
    page.until(lambda: page.text(".statement") != before)
    next(b for b in page.all("[data-step='0'] button") if b.text == "Show the answer").click()
    page.says("[data-step='0'] [data-output=terminal_velocity]", "mm/s")
    page.check()


def test_the_print_stands_beside_the_answer_with_its_erratum(page: Page) -> None:
    page.open("exercises/counted-powder", width=390)
    next(b for b in page.all("[data-step='1'] button") if b.text == "Show the answer").click()
    page.says("[data-printed]", "2.3 %")
    page.says("[data-step='1'] [data-output]", "2.7 %")
    page.says("[data-erratum]", "2.7 %")
    page.check()


@pytest.mark.parametrize("language", ["en", "fr"])
def test_an_answer_that_cannot_be_is_refused_once_at_its_field(page: Page, language: str) -> None:
    page.open("exercises/buchner-to-filter", language)
    page.type("[data-step] input", "7").send_keys(Keys.ENTER)
    page.until(lambda: page.all("[data-step] [data-verdict=unclear]"))
    page.settle()
    told = {"en": "must be between 0 and 1", "fr": "doit être compris entre 0 et 1"}[language]
    page.until(lambda: page.text("[data-step] .quantity .out").count(told) == 1)
    assert page.text("[data-step]").count(told) == 1
