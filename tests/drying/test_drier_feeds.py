"""A feed that is drier than the product asked for: the dryer does not wet it, and a check says so."""

from __future__ import annotations

import pytest

from granum.cases import alone

DRYERS = ("tray_dryer", "paddle_dryer", "vacuum_shelf_dryer", "tray_freeze_dryer", "convective_dryer")
LABEL = "moisture of the product against the specification"


@pytest.mark.parametrize("name", DRYERS)
@pytest.mark.parametrize(("asked", "kept"), [(None, True), ("5000 %", False)])
def test_a_moisture_above_that_of_the_feed_is_not_reached(name: str, asked: str | None, kept: bool) -> None:
    given = {} if asked is None else {"moisture_outlet": asked}
    (unit,) = alone(f"drying.{name}", **given).solve().units.values()
    (check,) = [c for c in unit.checks if c.name == LABEL]
    assert bool(check.ok) == kept
