"""How a request's language and a result's texts are made: labels, numbers, equation, the Python and the command that repeat it."""

from __future__ import annotations

import shlex
from typing import Any

from granum.core.cards import Card
from granum.core.parameters import default_as_json
from granum.core.results import Result
from granum.core.units import show
from granum.reports.html import note_step
from granum.reports.terminal import value_text


def python_line(card: Card, given: dict[str, Any]) -> str:
    """The Python that repeats a calculation."""
    arguments = ", ".join(f"{name}={value!r}" for name, value in given.items())
    return f"import granum as gr\n\ngr.{card.key}({arguments})"


def command_line(card: Card, given: dict[str, Any]) -> str:
    """The command that repeats a calculation."""
    return " ".join(["granum", "calc", card.key, *(shlex.quote(f"{name}={default_as_json(value)}") for name, value in given.items())])


def described(result: Result, given: dict[str, Any]) -> dict[str, Any]:
    """The stable calc shape, with what a page shows beside it."""
    step = note_step(result)
    rows = [
        {"name": p.name, "label": p.label, "text": value_text(result.outputs[p.name], p), "symbol": row["symbol"]}
        for p, row in zip(result.card.outputs, step["outputs"], strict=True)
    ]
    return result.as_json() | {
        "shown": rows,
        "inputs_shown": step["inputs"],
        "equation": step["equation"],
        "citation": step["source"],
        "python": python_line(result.card, given),
        "command": command_line(result.card, given),
    }


def bounds_text(parameter: Any) -> str:
    """The allowed range of a parameter as people read it."""
    kind = parameter.kind
    if kind is None:
        return ""
    low = "−∞" if kind.lower == -float("inf") else show(kind.lower, kind)
    high = "∞" if kind.upper == float("inf") else show(kind.upper, kind)
    return f"{low} … {high}"
