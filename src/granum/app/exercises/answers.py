"""The answers of an exercise, for the page and for whoever sets it to a class."""

from __future__ import annotations

import csv
import io
import re
from typing import Any

from granum.app import exercises
from granum.app.exercises.numbers import PLACE, Numbers, filled_text
from granum.core import registry
from granum.core.csv_form import csv_form
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.units import format_number, pretty_unit

MOST = 1000  # students of one sheet
DIGITS = 5


def answers(name: str, seed: int | None = None) -> list[dict[str, Any]]:
    """What is right at every step: ``text``, of a choice its ``why``, of a number ``value`` and ``unit``."""
    found = exercises.exercise(name)
    numbers = Numbers(found, seed)
    return [_answer(step, place, numbers) for place, step in enumerate(found["steps"])]


def _answer(step: dict[str, Any], place: int, numbers: Numbers) -> dict[str, Any]:
    if "choices" in step:
        right = exercises.in_language(next(c for c in step["choices"] if c.get("right")))
        return {
            "text": filled_text(right["says"], numbers),
            "why": filled_text(right["why"], numbers),
            "value": None,
            "unit": "",
        }
    unit, value = step["expected"]["unit"], numbers.calculated(place)
    return {
        "text": f"{format_number(value)} {pretty_unit(unit)}".strip(),
        "why": "",
        "value": value,
        "unit": unit,
    }


def sheet(name: str, first: int, last: int) -> str:
    """The teacher's sheet as CSV: one row a student, who is a seed, with the numbers of the statement and the
    answer of every step.
    """
    found = exercises.exercise(name)
    if not found.get("draws"):
        raise InputError(
            _("{name} has the same numbers for everybody; show its answers without seeds.").format(name=name)
        )
    if not 0 <= first <= last or last - first >= MOST:
        raise InputError(
            _("Seeds go from a smaller to a larger whole number, at most {most} of them.").format(most=MOST),
            name="seeds",
        )
    drawn = list(found["draws"])
    written = io.StringIO()
    form = csv_form()
    rows = csv.writer(written, lineterminator="\n", delimiter=form.separator)
    named = _named(found, drawn)
    rows.writerow([_("seed"), *(_headed(named[n], found["draws"][n]["unit"]) for n in drawn), *_asked(found)])
    for seed in range(first, last + 1):
        numbers = Numbers(found, seed)
        rows.writerow(
            [
                seed,
                *(form.cell(float(f"{numbers.drawn(n)[0]:.10g}")) for n in drawn),
                *(form.cell(_cell(answer)) for answer in answers(name, seed)),
            ]
        )
    return written.getvalue()


def _asked(found: dict[str, Any]) -> list[str]:
    """The heads of the answers: number, question and unit of the step, drawn numbers left open."""
    return [
        _headed(
            f"{place}. {PLACE.sub('…', exercises.in_language(step['ask']))}",
            step.get("expected", {}).get("unit", ""),
        )
        for place, step in enumerate(found["steps"], 1)
    ]


def _named(found: dict[str, Any], drawn: list[str]) -> dict[str, str]:
    """What the drawn numbers are called: as the input of the first card that takes one as it is; where none
    does, or two are called the same, by the words before them.
    """
    texts = [found["statement"], *(step["ask"] for step in found["steps"])]
    sentences = [exercises.in_language(text) for text in texts]
    around = {name: next((_around(s, name) for s in sentences if f"{{{name}}}" in s), name) for name in drawn}
    labels = {name: _label(found, name) for name in drawn}
    once = [label for label in labels.values() if list(labels.values()).count(label) == 1]
    return {name: label if label in once and label else around[name] for name, label in labels.items()}


def _label(found: dict[str, Any], name: str) -> str:
    for step in found["steps"]:
        for word, text in step.get("inputs", {}).items():
            if text == f"{{{name}}}":
                card = registry.find(step["card"]).card
                return next((p.label for p in card.parameters if p.name == word), "")
    return ""


def _around(text: str, name: str) -> str:
    """The few words before a number of a sentence."""
    before = text.partition(f"{{{name}}}")[0]
    words = PLACE.sub("…", re.split(r"[.;:?!]\s", before)[-1]).split()
    return " ".join((*words[-5:], "…"))


def _headed(name: str, unit: str) -> str:
    return f"{name} ({pretty_unit(unit)})" if unit else name


def _cell(answer: dict[str, Any]) -> str | float:
    return answer["text"] if answer["value"] is None else float(f"{answer['value']:.{DIGITS}g}")
