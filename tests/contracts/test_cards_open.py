"""What a page shows before anybody types: the example of every card gives a result, inside the range of its
source, or its fields stay empty.
"""

from __future__ import annotations

import pytest
from tests.sharing.samples import EVERYTHING

from granum.app.forms import card_form
from granum.app.tasks import inputs_for

OPENED = {
    key: thing for key, thing in EVERYTHING.items() if thing.card.sort in ("formula", "procedure", "chart")
}


FLAGGED = {
    "cyclones.cyclone_for_efficiency": (
        "the dust of its example is a law made beforehand, and one of two numbers must be chosen"
    ),
    "materials.saturated_solution": (
        "saturated potassium nitrate is stronger than the solutions whose heat capacity was measured, "
        "and says so"
    ),
}


@pytest.mark.parametrize("key", [k for k in OPENED if k not in FLAGGED])
def test_a_card_opens_with_a_result_and_without_a_flag(key: str) -> None:
    thing, form = OPENED[key], card_form(key)
    shown = {
        p["name"]: f"{p['example']['number']} {p['example']['unit']}".strip()
        for p in form["parameters"]
        if p["example"]
    }
    if any(p["required"] and not shown.get(p["name"]) for p in form["parameters"]):
        return  # no ordinary example: the page asks for what is missing
    values = inputs_for(thing.card, shown)
    if thing.card.sort == "chart":
        drawn = thing(**values)
        assert drawn.data or drawn.layout.shapes
        return
    result = thing.evaluate(**values)
    assert not result.notices, [notice["message"] for notice in result.notices]
