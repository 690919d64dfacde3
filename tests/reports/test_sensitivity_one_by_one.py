"""The chart of a result of a card that takes one value at a time."""

from __future__ import annotations

import pytest

from granum.core import registry
from granum.reports.sensitivity import curve


@pytest.mark.parametrize("key", ["drying.freeze_drying_limit", "particles.approach_to_terminal"])
def test_a_card_that_takes_one_value_at_a_time_is_no_fault(key: str) -> None:
    from granum.app.forms import opening_values

    thing = registry.find(key)
    found = curve(thing, thing.evaluate(**opening_values(thing.card)))
    assert found is None or (len(found.x) == len(found.y) and found.point == found.point)
