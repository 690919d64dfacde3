"""The course: exercises for every section of the notes, numbers of ordinary size for every student, choices
with their reasons, the sheet for the teacher, the exam.
"""

from __future__ import annotations

import csv
import io
import math
from typing import Any

import numpy as np
import pytest
from selenium.webdriver.common.keys import Keys
from tests.app.browsing import Page
from typer.testing import CliRunner

from granum.app import exercises
from granum.app.exercises.answers import answers, sheet
from granum.app.exercises.marking import marked
from granum.app.exercises.numbers import Numbers
from granum.app.finding import found
from granum.app.forms import card_form
from granum.cli import app
from granum.core.errors import InputError
from granum.core.i18n import language

ALL = exercises.declared()["exercise"]
CHOSEN = [(e, place) for e in ALL for place, step in enumerate(e["steps"]) if "choices" in step]
MANY = (None, *range(1, 51))
MEANT = {("falling-crystal", None)}  # the notes take Stokes' law up to a Reynolds number of 1
FAR = 60.0  # how many times larger or smaller than with the first numbers


@pytest.mark.parametrize("exercise", ALL, ids=lambda e: e["id"])
def test_every_student_gets_numbers_of_ordinary_size(exercise: dict[str, Any]) -> None:
    first: dict[int, float] = {}
    for seed in MANY if exercise.get("draws") else (None,):
        numbers = Numbers(exercise, seed)
        for place, step in enumerate(exercise["steps"]):
            if "choices" in step:
                continue
            result = numbers.outcome(place)
            assert not np.any(result.flags) or (exercise["id"], seed) in MEANT, (seed, place, result.notices)
            value = numbers.calculated(place)
            if seed is None:
                first[place] = value
            assert math.isfinite(value), (seed, place)
            assert value == first[place] or 1.0 / FAR <= value / first[place] <= FAR, (seed, place, value)


@pytest.mark.parametrize(("exercise", "place"), CHOSEN, ids=lambda x: x["id"] if isinstance(x, dict) else x)
def test_every_choice_has_its_reason_and_one_is_right(exercise: dict[str, Any], place: int) -> None:
    choices = exercise["steps"][place]["choices"]
    assert sum(bool(c.get("right")) for c in choices) == 1
    assert len(choices) >= 3
    for code in ("en", "fr"):
        assert len({c["says"][code] for c in choices}) == len(choices)
        assert len({c["why"][code] for c in choices}) == len(choices)
    shown = Numbers(exercise, 7).order(place)
    assert sorted(shown) == list(range(len(choices)))
    for key, choice in enumerate(choices):
        with language("fr"):
            verdict = marked(exercise["id"], place, 7, str(key))
        assert verdict["verdict"] == ("right" if choice.get("right") else "wrong")
        assert len(verdict["text"]) > 10
    assert marked(exercise["id"], place, None, "12")["verdict"] == "unclear"
    assert marked(exercise["id"], place, None, "")["verdict"] == "unclear"


def test_every_section_of_the_notes_has_an_exercise_or_a_question() -> None:
    told = exercises.listing()["notes"]
    assert [len(notes["sections"]) for notes in told] == [141, 81, 50]
    bare = [(n["name"], s) for n in told for s in n["sections"] if not s["exercises"] and not s["quizzes"]]
    assert not bare
    known = {f"{n['key']} {number}" for n in exercises.declared()["notes"] for number in n["sections"]}
    named = {s for kind in ("exercise", "quiz") for e in exercises.declared()[kind] for s in e["sections"]}
    assert named <= known


def test_the_course_is_large_enough_for_a_year() -> None:
    assert len(ALL) >= 60
    assert sum(len(e["steps"]) for e in ALL) >= 3 * len(ALL)
    assert len(CHOSEN) >= 20


WORKED = {  # printed answers of the notes' ten worked exercises, as many as each prints
    "psychrometer": 5,
    "air-at-zero": 5,
    "saturated-air": 4,
    "chart-readings": 4,
    "mixing-two-airs": 4,
    "two-airs": 4,
    "air-from-enthalpy": 2,
    "buchner-to-filter": 8,
    "counted-powder": 5,
    "cyclone-turns": 1,
    "grain-dryer": 12,
}


@pytest.mark.parametrize("name", WORKED)
def test_each_worked_exercise_of_the_notes_is_there_and_met_or_named_as_erratum(name: str) -> None:
    worked, met = exercises.exercise(name), 0
    for place, step in enumerate(worked["steps"]):
        asked = step.get("expected", {})
        if "value" in asked:
            calculated = Numbers(worked).calculated(place)
            assert calculated == pytest.approx(asked["value"], abs=asked["within"]), step["ask"]["en"]
        if "misprint" in asked:
            assert step["erratum"]["fr"]
        met += "value" in asked or "misprint" in asked
    assert met == WORKED[name]


def test_the_sheet_of_a_class_holds_numbers_and_answers() -> None:
    rows = list(csv.reader(io.StringIO(sheet("falling-crystal", 3, 5))))
    assert [row[0] for row in rows] == ["seed", "3", "4", "5"]
    assert rows[0][1] == "particle diameter (µm)"
    for row in rows[1:]:
        micrometers, density, centipoise, stokes = map(float, row[1:5])
        by_hand = 9.80665 * (density - 1020.0) * (micrometers * 1e-6) ** 2 / (18.0 * centipoise * 1e-3)
        assert stokes == pytest.approx(1e3 * by_hand, rel=1e-4)
    with language("fr"):
        told = list(csv.reader(io.StringIO(sheet("six-means", 1, 1)), delimiter=";"))
        assert told[1][-1] == answers("six-means", 1)[6]["text"]
    with pytest.raises(InputError, match="same numbers"):
        sheet("two-airs", 1, 3)
    with pytest.raises(InputError, match="at most 1000"):
        sheet("six-means", 1, 2000)
    with pytest.raises(InputError, match="at most"):
        sheet("six-means", 9, 2)


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ([], "99 exercises"),
        (["svedberg", "--seed", "4", "--answers"], "Runs at rising speed"),
        (["svedberg", "--seeds", "1-2"], "seed,particle diameter (nm)"),
        (["svedberg", "--json"], '"steps"'),
    ],
)
def test_the_command_line_tells_the_course(arguments: list[str], told: str) -> None:
    outcome = CliRunner().invoke(app, ["exercises", *arguments])
    assert outcome.exit_code == 0, outcome.output
    assert told in outcome.output


@pytest.mark.parametrize(
    ("asked", "exercise"),
    [
        ("essorage", "basket-flow"),
        ("essoreuse", "which-basket"),
        ("porosité", "buchner-to-filter"),
        ("voidage", "buchner-to-filter"),
        ("SVI", "sludge-index"),
        ("Richardson-Zaki", "crowded-fall"),
        ("Kynch", "kynch-tangent"),
        ("bulbe humide", "wet-wick"),
        ("Sauter", "six-means"),
    ],
)
def test_the_search_finds_exercises_by_the_words_of_the_field(asked: str, exercise: str) -> None:
    assert exercise in [hit["key"] for hit in found(asked, 24) if hit["sort"] == "exercise"]


def test_a_card_names_its_exercises_in_the_language_of_the_page() -> None:
    with language("fr"):
        told = card_form("settling.sludge_volume_index")["exercises"]
    assert {"id": "sludge-index", "title": "La boue décante-t-elle ?"} in [
        {"id": e["id"], "title": e["title"].replace("\u202f", " ").replace("\u00a0", " ")} for e in told
    ]
    assert card_form("porous.permeability_davies")["exercises"] == []


@pytest.mark.parametrize(
    ("code", "wrong", "why", "right"),
    [
        ("en", "It falls to nothing", "carried away", "It stays: the bed weighs the same"),
        ("fr", "Elle tombe à zéro", "emporté", "Elle reste"),
    ],
)
def test_a_student_chooses(page: Page, code: str, wrong: str, why: str, right: str) -> None:
    page.open("exercises/bed-wakes-up", code)
    step = "[data-step='4']"
    page.one(f"{step} input[type=radio]")
    choose(page, step, wrong)
    page.one(f"{step} button.main").click()
    page.one(f"{step} [data-verdict=wrong]")
    page.says(f"{step} [data-verdict]", why)
    choose(page, step, right)
    page.one(f"{step} button.main").click()
    page.one(f"{step} [data-verdict=right]")
    page.check()


def choose(page: Page, place: str, text: str) -> None:
    """Walk the choices with the arrow keys to the one that begins with a text."""
    rows = page.all(f"{place} .pick")
    told = [row.text.replace("\u202f", " ").replace("\u00a0", " ") for row in rows]
    wanted = next(i for i, row in enumerate(told) if row.startswith(text))
    buttons = page.all(f"{place} input[type=radio]")
    buttons[0].send_keys(Keys.SPACE)
    for button in buttons[:wanted]:
        button.send_keys(Keys.ARROW_DOWN)
    page.until(lambda: page.all(f"{place} input[type=radio]")[wanted].is_selected())


def test_a_step_shows_its_chart(page: Page) -> None:
    page.open("exercises/first-moments", width=390, theme="dark")
    next(b for b in page.all("[data-step='0'] button") if b.text == "Show the answer").click()
    page.one("[data-step='0'] [data-output=terminal_velocity]")
    page.button("Show the chart").click()
    page.one("[data-sensitivity] .plot svg")
    page.settle()
    page.check()


@pytest.mark.parametrize(
    ("code", "begin", "hand_in", "score"),
    [("en", "Begin", "Hand in", "1 of"), ("fr", "Commencer", "Remettre", "1 justes sur")],
)
def test_an_exam_is_marked_when_it_is_handed_in(
    page: Page, code: str, begin: str, hand_in: str, score: str
) -> None:
    page.open("exercises/exam", code)
    page.type("input[name=seed]", "77")
    page.type("input[name=count]", "1")
    page.type("input[name=minutes]", "45")
    page.check()
    page.button(begin).click()
    field = page.one(".exam-paper [data-step='0'] .quantity input")
    name = page.one(".exam-paper [data-step='0']").get_attribute("data-exercise")
    assert "44:" in page.text("[role=timer]") or "45:00" in page.text("[role=timer]")
    assert not page.all("[data-hint]")
    assert not page.all("[data-verdict]")
    right = f"{answers(name, 77)[0]['value']:.5g}"
    typed = right.replace(".", ",") if code == "fr" else right
    for key in typed:
        field.send_keys(key)
    page.check()
    page.button(hand_in).click()
    assert page.one("[data-score]").get_attribute("data-score").startswith("1/")
    page.says("[data-score]", score)
    assert page.one("[data-step='0'] [data-verdict=right]")
    assert page.all("[data-verdict=wrong]")
    page.check()
    page.browser.refresh()
    page.settle()
    assert page.one("[data-score]"), "what was handed in stays so"


def test_the_sections_of_the_notes_lead_to_exercises(page: Page) -> None:
    page.open("exercises/sections", "fr", width=390)
    assert len(page.all("table.sections tr")) == 272
    page.check()


def test_a_card_leads_to_its_exercises(page: Page) -> None:
    page.open("calculate/settling.sludge_volume_index")
    page.one("[data-exercises] a").click()
    page.one(".statement")
    assert "sludge" in page.browser.current_url or "settling" in page.browser.current_url
    page.check()
