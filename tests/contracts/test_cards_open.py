"""What a page shows before anybody types: every card opens with a result of ordinary size, in the range of
its source.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.sharing.samples import EVERYTHING

from granum.app.forms import card_form
from granum.app.tasks import inputs_for
from granum.core.parameters import Parameter
from granum.reports.quantities import value_text

OPENED = {key: thing for key, thing in EVERYTHING.items() if thing.card.sort in ("formula", "procedure")}
CHARTS = {key: thing for key, thing in EVERYTHING.items() if thing.card.sort == "chart"}
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


@pytest.mark.parametrize("key", CHARTS)
def test_a_chart_opens_with_something_drawn(key: str) -> None:
    drawn = CHARTS[key](**opening(key))
    assert drawn.data or drawn.layout.shapes


def test_numbers_chosen_for_the_arithmetic_do_not_open_a_form() -> None:
    # the docstring has grains of 1 m on a planet with 1 m/s² of gravity
    opened = opening("fluidization.elutriation_flux_lin")
    assert "gravity" not in opened
    text = next(p for p in card_form("fluidization.elutriation_flux_lin")["parameters"] if p["example"])
    assert text["example"]["unit"] in ("mm/s", "m/s")
