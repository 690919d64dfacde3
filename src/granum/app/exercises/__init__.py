"""Worked examples and quizzes of the course notes, as data: statements, live calculations, printed answers.

A new exercise is a table in one TOML file of this folder; CONTRIBUTING.md says what may stand in it.
"""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from typing import Any

import tomli

from granum.app.exercises.numbers import Numbers, filled_text, tolerance_text
from granum.core import registry
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _, current_language, typographic
from granum.core.units import format_number, pretty_unit
from granum.reports.mathml import equation_wrapped


def domain_labels() -> dict[str, str]:
    """The domains of the course in their order."""
    return {
        "powders": _("Particles and powders"),
        "porous": _("Flow through porous media"),
        "motion": _("Motion of particles"),
        "settling": _("Settling and thickening"),
        "centrifugation": _("Centrifugation"),
        "filtration": _("Filtration"),
        "fluidization": _("Fluidization"),
        "crystallization": _("Crystallization"),
        "humid_gas": _("Humid gas"),
        "moist_solids": _("Moist solids and drying kinetics"),
        "dryers": _("Dryers"),
    }


@cache
def declared() -> dict[str, list[dict[str, Any]]]:
    """Exercises, quizzes and sections of the notes as written in the TOML files of this folder."""
    found: dict[str, list[dict[str, Any]]] = {"exercise": [], "quiz": [], "notes": []}
    for path in sorted((files("granum") / "app" / "exercises").iterdir(), key=lambda p: p.name):
        if path.name.endswith(".toml"):
            for sort, rows in tomli.loads(path.read_text(encoding="utf-8")).items():
                found[sort] += rows
    return found


def exercise(name: str) -> dict[str, Any]:
    """An exercise as it is declared."""
    found = {e["id"]: e for e in declared()["exercise"]}
    if name not in found:
        raise unknown_name(_("Exercise"), name, found, quantities=False)
    return found[name]


def step_of(name: str, number: int) -> dict[str, Any]:
    """A step of an exercise, counted from 0."""
    steps = exercise(name)["steps"]
    if not 0 <= number < len(steps):
        raise InputError(_("This exercise has {count} steps.").format(count=len(steps)), name="step")
    return steps[number]


def in_language(value: Any) -> Any:
    """Every ``{en, fr}`` pair replaced by its text in the current language."""
    if isinstance(value, dict):
        if set(value) == {"en", "fr"}:
            text = value[current_language()]
            return typographic(text) if current_language() == "fr" and isinstance(text, str) else text
        return {name: in_language(item) for name, item in value.items()}
    return [in_language(item) for item in value] if isinstance(value, list) else value


def listing() -> dict[str, Any]:
    """Exercises by domain, short, and quizzes, in the current language."""
    labels = domain_labels()
    rows = [
        in_language({"id": e["id"], "title": e["title"], "domain": e["domain"], "steps": len(e["steps"])})
        | {"fresh": bool(e.get("draws"))}
        for e in sorted(declared()["exercise"], key=_place)
    ]
    domains = [
        {"name": name, "label": label, "exercises": [e for e in rows if e["domain"] == name]}
        for name, label in labels.items()
    ]
    return {
        "domains": [d for d in domains if d["exercises"]],
        "quizzes": in_language(declared()["quiz"]),
        "notes": [{"name": n["name"], "sections": _sections(n)} for n in declared()["notes"]],
    }


def _place(one: dict[str, Any]) -> int:
    """Where an exercise stands in the course: at the earliest of its sections."""
    order = [f"{n['key']} {number}" for n in declared()["notes"] for number in n["sections"]]
    return min(order.index(section) for section in one["sections"])


def _sections(notes: dict[str, Any]) -> list[dict[str, Any]]:
    """The sections of one of the notes, each with its exercises, and whether it has ``quizzes``."""
    of: dict[str, list[str]] = {}
    for one in declared()["exercise"]:
        for section in one["sections"]:
            of.setdefault(section, []).append(one["id"])
    asked = {section for one in declared()["quiz"] for section in one["sections"]}
    places = [(number, f"{notes['key']} {number}") for number in notes["sections"]]
    return [
        {"number": number, "exercises": of.get(place, []), "quizzes": place in asked}
        for number, place in places
    ]


def with_card(key: str) -> list[dict[str, str]]:
    """The exercises that use a card: ``{"id", "title"}`` in the current language, in their order."""
    found = [e for e in declared()["exercise"] if any(step.get("card") == key for step in e["steps"])]
    return [in_language({"id": e["id"], "title": e["title"]}) for e in sorted(found, key=_place)]


def worked(name: str, seed: int | None = None) -> dict[str, Any]:
    """An exercise in the current language with its numbers: those of the course, or fresh ones of a seed."""
    found = exercise(name)
    numbers = Numbers(found, seed)
    text = in_language(found)
    return {
        "id": name,
        "title": text["title"],
        "source": text["source"],
        "statement": filled_text(text["statement"], numbers),
        "fresh": bool(found.get("draws")),
        "seed": seed,
        "steps": [_step(step, i, numbers) for i, step in enumerate(text["steps"])],
    }


def _step(step: dict[str, Any], place: int, numbers: Numbers) -> dict[str, Any]:
    told = {
        "ask": filled_text(step["ask"], numbers),
        "hint": filled_text(step.get("hint", ""), numbers),
        "erratum": step.get("erratum", ""),
        "choices": [
            {"key": key, "says": filled_text(step["choices"][key]["says"], numbers)}
            for key in numbers.order(place)
        ],
    }
    return told | (_chosen(step) if told["choices"] else _asked(step, place, numbers))


def _chosen(step: dict[str, Any]) -> dict[str, Any]:
    """What a step tells whose answer is chosen: the card that its subject is, where there is one."""
    card = registry.find(step["card"]).card if "card" in step else None
    return {"card": card.key, "sort": card.sort, "title": card.title} if card else {"card": ""}


def _asked(step: dict[str, Any], place: int, numbers: Numbers) -> dict[str, Any]:
    """What a step tells whose answer is a number that its card computes."""
    card = registry.find(step["card"]).card
    asked = step["expected"]
    printed = asked.get("value", asked.get("misprint")) if numbers.seed is None else None
    return {
        "card": step["card"],
        "sort": card.sort,
        "title": card.title,
        "unit": asked["unit"],
        "within": tolerance_text(step, place, numbers),
        "inputs": numbers.inputs(place),
        "output": asked["output"],
        "label": card.parameter(asked["output"]).label,
        "quantity": card.parameter(asked["output"]).as_json()
        | {"example": {"number": "", "unit": asked["unit"].replace("%", "percent")}},
        "equation": equation_wrapped(card.equation) if card.equation else "",
        "printed": ""
        if printed is None
        else f"{format_number(printed)} {pretty_unit(asked['unit'])}".strip(),
        "remark": step.get("remark", "") if numbers.seed is None else "",
    }
