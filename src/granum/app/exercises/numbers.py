"""The numbers of an exercise: those of the course, or fresh ones drawn from a seed; results of earlier steps
as inputs of later ones.
"""

from __future__ import annotations

import random
import re
from dataclasses import dataclass, field
from typing import Any

from granum.core import registry
from granum.core.units import format_number, from_si, pretty_unit
from granum.studies.expressions import Expression

PLACE = re.compile(r"\{([^{}]+)\}")
STEP = re.compile(r"step(\d+)")
TOLERANCE = 0.02


@dataclass
class Numbers:
    """What stands in the places ``{name}`` (a number drawn), ``{step1}`` (the result of step 1) and ``{name /
    2}`` (an expression of them, in the unit of the first).

    With the numbers of the course a later step goes on from the printed result, as the course does; with
    fresh ones from the calculated result.
    """

    exercise: dict[str, Any]
    seed: int | None = None
    _known: dict[int, tuple[float, str]] = field(default_factory=dict)
    _outcomes: dict[tuple[Any, ...], Any] = field(default_factory=dict)

    def drawn(self, name: str) -> tuple[float, str]:
        """A number of the statement with its unit."""
        draw = self.exercise["draws"][name]
        if self.seed is None:
            return draw["printed"], draw["unit"]
        chance = random.Random(f"{self.exercise['id']} {name} {self.seed}")
        value = chance.uniform(draw["from"], draw["to"])
        return float(f"{value:.{draw.get('digits', 2)}g}"), draw["unit"]

    def order(self, place: int) -> list[int]:
        """The choices of a step in the order in which they are shown, another one for each seed."""
        keys = list(range(len(self.exercise["steps"][place].get("choices", []))))
        random.Random(f"{self.exercise['id']} {place} {self.seed}").shuffle(keys)
        return keys

    def result(self, place: int) -> tuple[float, str]:
        """The result of a step, counted from 0, with its unit."""
        asked = self.exercise["steps"][place]["expected"]
        if self.seed is None and "value" in asked:
            return asked["value"], asked["unit"]
        if place not in self._known:
            self._known[place] = self.calculated(place), asked["unit"]
        return self._known[place]

    def at(self, name: str) -> tuple[float, str]:
        """Number and unit of what a name stands for."""
        step = STEP.fullmatch(name)
        return self.result(int(step[1]) - 1) if step else self.drawn(name)

    def worth(self, text: str, right: float | None = None) -> tuple[float, str]:
        """Number of an expression, and the unit of the first name in it; ``right`` is the right answer."""
        expression = Expression.read(text)
        value = expression.value(lambda name: right if name == "right" else self.at(name)[0])
        first = next((name for name in expression.names() if name != "right"), "")
        return float(value), self.at(first)[1] if first else ""

    def inputs(self, place: int, changed: dict[str, str] | None = None) -> dict[str, str]:
        """The inputs of a step with their numbers."""

        def put(found: re.Match[str]) -> str:
            value, unit = self.worth(found[1])
            return f"{value:.10g} {unit}".strip()

        given = self.exercise["steps"][place]["inputs"] | (changed or {})
        return {name: PLACE.sub(put, text) for name, text in given.items() if text}

    def outcome(self, place: int, changed: dict[str, str] | None = None, card: str = "") -> Any:
        """What the card of a step answers, calculated once for the same inputs; ``changed`` replaces some, an
        empty text takes one away.
        """
        key, given = card or self.exercise["steps"][place]["card"], self.inputs(place, changed)
        asked = key, *given.items()
        if asked not in self._outcomes:
            self._outcomes[asked] = registry.find(key).evaluate(**given)
        return self._outcomes[asked]

    def calculated(
        self, place: int, changed: dict[str, str] | None = None, card: str = "", output: str = ""
    ) -> float:
        """What the card of a step gives, in the unit that is asked for; the rest as for the ``outcome``."""
        asked = self.exercise["steps"][place]["expected"]
        result = self.outcome(place, changed, card)
        wanted = output or asked["output"]
        kind = next(p.kind for p in result.card.outputs if p.name == wanted)
        assert kind is not None
        return float(from_si(float(result.outputs[wanted]), asked["unit"] or "dimensionless", kind))


def filled_text(text: str, numbers: Numbers) -> str:
    """A text with its numbers as people read them."""

    def put(found: re.Match[str]) -> str:
        value, unit = numbers.worth(found[1])
        return f"{format_number(value)} {pretty_unit(unit)}".strip()

    return PLACE.sub(put, text)


def tolerance_of(step: dict[str, Any], right: float) -> float:
    """How far an answer may lie from the calculated one, in the unit that is asked for: a share of it, and at
    least what the course itself is off by reading or rounding.
    """
    return max(step.get("tolerance", TOLERANCE) * abs(right), step["expected"].get("within", 0.0))


def tolerance_text(step: dict[str, Any], place: int, numbers: Numbers) -> str:
    """How far an answer may lie off, as a page tells it beforehand: ``2 %``, or ``0.5 °C``."""
    asked = step["expected"]
    share, within = step.get("tolerance", TOLERANCE), asked.get("within", 0.0)
    # nothing is calculated for this where the share alone decides: a statement stands at once
    if within and within > share * abs(numbers.result(place)[0]):
        return f"{format_number(within)} {pretty_unit(asked['unit'])}".strip()
    return f"{format_number(100.0 * share)} %"
