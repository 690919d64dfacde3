"""What a student answers: right, a known slip, or wrong, said in words."""

from __future__ import annotations

import math
from typing import Any

from granum.app import exercises
from granum.app.exercises.numbers import Numbers, filled_text, tolerance_of
from granum.app.wording import told
from granum.core import registry
from granum.core.conversion import convert
from granum.core.errors import GranumError
from granum.core.i18n import _
from granum.core.units import format_number, from_si, pretty_unit

FACTORS = (60.0, 3600.0)
NEAR = 0.06  # share by which an answer may be off and still have gone the right way


def marked(name: str, number: int, seed: int | None, answer: str) -> dict[str, Any]:
    """The verdict on an answer typed as a quantity, or on the number of what was chosen.

    It is ``right``, ``wrong``, or ``unclear`` when it cannot be read, with a sentence that says why.
    """
    step = exercises.step_of(name, number)
    if "choices" in step:
        return _chosen(step, Numbers(exercises.exercise(name), seed), answer)
    asked = step["expected"]
    parameter = registry.find(step["card"]).card.parameter(asked["output"])
    assert parameter.kind is not None
    unit = asked["unit"] or "dimensionless"
    try:
        given = float(from_si(convert(answer, parameter), unit, parameter.kind))
    except GranumError as fault:
        return {"verdict": "unclear", "text": told(fault.as_json())["message"]}
    numbers = Numbers(exercises.exercise(name), seed)
    right = numbers.calculated(number)
    shown = f"{format_number(right)} {pretty_unit(asked['unit'])}".strip()
    if abs(given - right) <= tolerance_of(step, right):
        return {"verdict": "right", "text": _("Right: {value} when calculated.").format(value=shown)}
    for slip, value in slips(numbers, number, right):
        if abs(given - value) <= 0.015 * abs(value):
            return {"verdict": "wrong", "text": exercises.in_language(slip["says"])}
    return {"verdict": "wrong", "text": _told(given, right, tolerance_of(step, right), asked["unit"])}


def _chosen(step: dict[str, Any], numbers: Numbers, answer: str) -> dict[str, Any]:
    """The verdict on a choice, with its reason."""
    choices = step["choices"]
    if answer not in {str(key) for key in range(len(choices))}:
        return {"verdict": "unclear", "text": _("Choose one of the answers.")}
    taken = choices[int(answer)]
    verdict = "right" if taken.get("right") else "wrong"
    return {"verdict": verdict, "text": filled_text(exercises.in_language(taken["why"]), numbers)}


def slips(numbers: Numbers, place: int, right: float) -> list[tuple[dict[str, Any], float]]:
    """The declared slips of a step with the answers that they lead to."""
    return [
        (
            slip,
            numbers.worth(slip["value"], right)[0]
            if "value" in slip
            else numbers.calculated(place, slip.get("inputs"), slip.get("card", ""), slip.get("output", "")),
        )
        for slip in numbers.exercise["steps"][place].get("slips", [])
    ]


def _told(given: float, right: float, tolerance: float, unit: str) -> str:
    """A sentence on a wrong answer that no declared slip explains."""
    read = f"{format_number(given)} {pretty_unit(unit)}".strip()
    if right != 0.0 and given != 0.0:
        ratio = given / right
        share = max(tolerance / abs(right), 1e-3)
        if abs(ratio - 1.0) <= NEAR:
            close = _("Close, but {share} too large: a rounded step, or a value read a little off?")
            small = _("Close, but {share} too small: a rounded step, or a value read a little off?")
            return (close if ratio > 1.0 else small).format(
                share=f"{format_number(100.0 * abs(ratio - 1.0), 2)} %"
            )
        if ratio < 0.0 and abs(ratio + 1.0) <= share:
            return _("The size is right, the sign is not.")
        power = round(math.log10(abs(ratio)))
        factors = [10.0 ** abs(power), *FACTORS]
        for factor in factors:
            if factor > 1.0 and abs(ratio / factor - 1.0) <= share:
                return _("{read} is {factor} times too large: look at the units.").format(
                    read=read, factor=format_number(factor)
                )
            if factor > 1.0 and abs(ratio * factor - 1.0) <= share:
                return _("{read} is {factor} times too small: look at the units.").format(
                    read=read, factor=format_number(factor)
                )
    return _("Not this: too large.") if given > right else _("Not this: too small.")
