"""What a page shows before anybody types: every card opens with a result of ordinary size, in the range of
its source.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.sharing.samples import EVERYTHING

from granum.app.forms import card_form, range_text, whole
from granum.app.forms import opening as opened
from granum.app.tasks import inputs_for, valued
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.reports.quantities import value_text

OPENED = {key: thing for key, thing in EVERYTHING.items() if thing.card.sort in ("formula", "procedure")}
CHARTS = {key: thing for key, thing in EVERYTHING.items() if thing.card.sort == "chart"}
LAWS = {
    key: thing for key, thing in EVERYTHING.items() if thing.card.sort == "law" and hasattr(thing, "evaluate")
}
LONG = {"crystallization.precipitation_batch"}  # a course of some seconds; its own test runs it


def opening(key: str) -> dict[str, Any]:
    """The inputs that the form of a card opens with, read as the page sends them; nothing required is left
    out.
    """
    form = card_form(key)
    shown = {
        p["name"]: f"{p['example']['number']} {p['example']['unit']}".strip()
        for p in form["parameters"]
        if p["example"]
    }
    missing = [p["name"] for p in form["parameters"] if p["required"] and not shown.get(p["name"])]
    assert not missing
    return inputs_for(EVERYTHING[key].card, shown)


def numbers(p: Parameter, value: Any) -> np.ndarray:
    return np.ravel(np.asarray(value, dtype=float)) if p.kind else np.empty(0)


@pytest.mark.parametrize("key", [key for key in OPENED if key not in LONG])
def test_a_card_opens_with_a_result_and_without_a_flag(key: str) -> None:
    thing = OPENED[key]
    result = thing.evaluate(**opening(key))
    assert not result.notices, [notice["message"] for notice in result.notices]
    for p in thing.card.outputs:
        value = result.outputs[p.name]
        if value is not None:
            assert np.all(np.isfinite(numbers(p, value))), p.name
            assert value_text(value, p) != "—" or isinstance(value, str), p.name


@pytest.mark.parametrize("key", LAWS)
def test_a_law_opens_with_a_value_and_without_a_flag(key: str) -> None:
    law = valued(key)
    asked = whole(law.card).parameters
    shown = opened(key)
    if any(p.law and p.required and p.name not in shown for p in asked):
        return  # made of other laws, that are chosen first
    result = law.evaluate(**inputs_for(whole(law.card), shown))
    assert not result.notices, [notice["message"] for notice in result.notices]
    assert all(np.all(np.isfinite(numbers(p, result.outputs[p.name]))) for p in law.card.outputs)


@pytest.mark.parametrize("key", CHARTS)
def test_a_chart_opens_with_something_drawn(key: str) -> None:
    drawn = CHARTS[key](**opening(key))
    assert drawn.data or drawn.layout.shapes


@pytest.mark.parametrize(
    ("kind", "limits", "told"),
    [
        ("Velocity", (0.6, 3.0), "0.6 … 3 m/s"),
        ("Temperature", (283.15, 393.15), "10 … 120 °C"),
        ("Length", (1e-5, 8e-4), "10 … 800 µm"),
        ("Length", (1e-6, 1.0), "1 µm … 1 m"),
        ("Length", (0.01, np.inf), "10 mm … ∞"),
        ("Fraction", (0.0, 1.0), "0 … 100 %"),
        ("Ratio", (0.025, 0.9), "0.025 … 0.9"),
    ],
)
def test_both_ends_of_a_range_are_told_in_one_unit(kind: str, limits: tuple[float, float], told: str) -> None:
    assert range_text(Parameter("some", KINDS[kind]), limits) == told


def test_numbers_chosen_for_the_arithmetic_do_not_open_a_form() -> None:
    # the docstring has grains of 1 m on a planet with 1 m/s² of gravity
    opened = opening("fluidization.elutriation_flux_lin")
    assert "gravity" not in opened
    text = next(p for p in card_form("fluidization.elutriation_flux_lin")["parameters"] if p["example"])
    assert text["example"]["unit"] in ("mm/s", "m/s")
