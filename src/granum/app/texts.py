"""A result as a page shows it: labels, numbers, equation, the Python and the command that repeat it."""

from __future__ import annotations

import math
import shlex
from typing import Any

import numpy as np

from granum.app.forms import law_label
from granum.core.cards import Card
from granum.core.glossary import quantity_in, term
from granum.core.parameters import default_as_json
from granum.core.results import Result
from granum.reports.html import note_step
from granum.reports.terminal import value_text


def plain_data(value: Any) -> Any:
    """Whatever the package returns as JSON can carry it: arrays as lists, numbers that are not finite as None."""
    if isinstance(value, dict):
        return {str(name): plain_data(item) for name, item in value.items()}
    if hasattr(value, "_asdict"):
        return plain_data(value._asdict())
    if isinstance(value, (list, tuple, set)):
        return [plain_data(item) for item in value]
    if value is None or isinstance(value, (bool, int, str)):
        return value
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if hasattr(value, "__array__"):
        return plain_data(np.asarray(value).tolist())
    return default_as_json(value)


def label_of(name: str) -> str:
    """The glossary's label of a result that is no declared output."""
    word = quantity_in(name)
    return " ".join((term(word).label, *name[len(word) :].split("_"))).strip() if word else name.replace("_", " ")


def python_line(card: Card, given: dict[str, Any]) -> str:
    """The Python that repeats a calculation."""
    arguments = ", ".join(f"{name}={value!r}" for name, value in given.items())
    return f"import granum as gr\n\ngr.{card.key}({arguments})"


def command_line(card: Card, given: dict[str, Any]) -> str:
    """The command that repeats a calculation."""
    return " ".join(["granum", "calc", card.key, *(shlex.quote(f"{name}={_typed(value)}") for name, value in given.items())])


def _typed(value: Any) -> str:
    return " ".join(map(_typed, value)) if isinstance(value, (list, tuple)) else str(default_as_json(value))


def described(result: Result, given: dict[str, Any]) -> dict[str, Any]:
    """The stable calc shape, with what a page shows beside it."""
    step = note_step(result)
    rows = [
        {"name": p.name, "label": p.label, "text": value_text(result.outputs[p.name], p), "symbol": row["symbol"]}
        for p, row in zip(result.card.outputs, step["outputs"], strict=True)
    ]
    used = [p for p in result.card.parameters if result.inputs[p.name] is not None]
    inputs = [
        row | ({"text": law_label(result.inputs[p.name].card)} if hasattr(result.inputs[p.name], "card") else {}) | {"name": p.name}
        for p, row in zip(used, step["inputs"], strict=True)
    ]
    return result.as_json() | {
        "shown": rows,
        "inputs_shown": inputs,
        "equation": step["equation"] if result.card.equation else "",
        "citation": step["source"],
        "python": python_line(result.card, given),
        "command": command_line(result.card, given),
    }
