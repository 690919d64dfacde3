"""A study varies a flow in volumes as a feed states it."""

from __future__ import annotations

import pytest

from granum.cases.studying import studies_of_text
from granum.core.errors import UnitError

CASE = """
title = "pump"
[mixture]
liquids = ["water"]
[feeds.river]
to = "pump.feed"
temperature = "20 degC"
liquid_flow = "10 m3/h"
[units.pump]
model = "streams.pump"
pressure_rise = "2 bar"
[study.flow]
kind = "sweep"
over = {{ "river.liquid_flow" = {{ from = "{low}", to = "{high}", steps = 2 }} }}
outputs = ["pump.volume_flow"]
"""


def test_volumes_are_those_of_the_liquid() -> None:
    run = studies_of_text(CASE.format(low="5 m3/h", high="20 m3/h"))["flow"].run()
    # water of 20 °C weighs 998.2 kg/m³
    assert run.column("river.liquid_flow") == pytest.approx([998.2 * 5 / 3600, 998.2 * 20 / 3600], rel=1e-3)
    assert run.column("pump.volume_flow") == pytest.approx([5 / 3600, 20 / 3600], rel=1e-9)


def test_what_is_neither_mass_nor_volume_is_refused() -> None:
    with pytest.raises(UnitError, match="does not fit"):
        studies_of_text(CASE.format(low="5 m2/h", high="20 m2/h"))["flow"].run()
