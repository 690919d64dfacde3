"""The chart of a result that is an integral: its card takes many values at once."""

from __future__ import annotations

import numpy as np
import pytest

from granum.core import registry
from granum.reports.sensitivity import curve


@pytest.mark.parametrize("key", ["drying.freeze_drying_limit", "particles.approach_to_terminal"])
def test_a_result_that_is_an_integral_has_its_chart(key: str) -> None:
    from granum.app.forms import opening_values

    thing = registry.find(key)
    found = curve(thing, thing.evaluate(**opening_values(thing.card)))
    assert found is not None
    assert len(found.x) == len(found.y)
    assert np.isfinite(found.y).any()
