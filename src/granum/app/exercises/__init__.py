"""Worked examples and quizzes of the course notes, as data: statements, live calculations, printed
answers.
"""

from __future__ import annotations

import tomllib
from functools import cache
from importlib.resources import files
from typing import Any

from granum.core import registry
from granum.core.i18n import current_language
from granum.core.units import format_number, pretty_unit


@cache
def declared() -> dict[str, list[dict[str, Any]]]:
    """All exercises and quizzes as written in the TOML files of this folder."""
    found: dict[str, list[dict[str, Any]]] = {"exercise": [], "quiz": []}
    for path in sorted((files("granum") / "app" / "exercises").iterdir(), key=lambda p: p.name):
        if path.name.endswith(".toml"):
            for sort, rows in tomllib.loads(path.read_text(encoding="utf-8")).items():
                found[sort] += rows
    return found


def _in_language(value: Any) -> Any:
    """Every ``{en, fr}`` pair replaced by its text in the current language."""
    if isinstance(value, dict):
        if set(value) == {"en", "fr"}:
            return value[current_language()]
        return {name: _in_language(item) for name, item in value.items()}
    return [_in_language(item) for item in value] if isinstance(value, list) else value


def listing() -> dict[str, Any]:
    """Exercises and quizzes in the current language, with the labels of the asked quantities."""
    found = _in_language(declared())
    for exercise in found["exercise"]:
        for step in exercise["steps"]:
            card = registry.find(step["card"]).card
            step["title"] = card.title
            step["expected"]["text"] = (
                f"{format_number(step['expected']['value'])} {pretty_unit(step['expected']['unit'])}".strip()
            )
            step["expected"]["label"] = card.parameter(step["expected"]["output"]).label
    return {"exercises": found["exercise"], "quizzes": found["quiz"]}
