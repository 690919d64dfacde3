"""The course: exercises for every section of the notes, numbers of ordinary size for every student, choices
with their reasons, the sheet for the teacher, the exam.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from granum.app import exercises
from granum.app.exercises.marking import marked
from granum.app.exercises.numbers import Numbers
from granum.core import registry
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
            found = registry.find(step["card"]).evaluate(**numbers.inputs(place))
            assert not np.any(found.flags) or (exercise["id"], seed) in MEANT, (seed, place, found.notices)
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
    found, met = exercises.exercise(name), 0
    for place, step in enumerate(found["steps"]):
        asked = step.get("expected", {})
        if "value" in asked:
            calculated = Numbers(found).calculated(place)
            assert calculated == pytest.approx(asked["value"], abs=asked["within"]), step["ask"]["en"]
        if "misprint" in asked:
            assert step["erratum"]["fr"]
        met += "value" in asked or "misprint" in asked
    assert met == WORKED[name]
