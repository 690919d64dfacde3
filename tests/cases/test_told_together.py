"""All that a case lacks is told at once, each table on a line."""

import pytest

from granum.cases.reading import read_text
from granum.core.errors import CaseError
from granum.core.i18n import language

MIXTURE = """
title = "A line"
[mixture]
liquids = ["water"]
"""
FEED = """
[feeds.water]
to = "{to}"
temperature = "{temperature}"
liquid_flow = "1 t/h"
"""


def lines_of(text: str) -> list[str]:
    with pytest.raises(CaseError) as told:
        read_text(MIXTURE + text)
    return told.value.message.split("\n")


def test_feeds_and_units_at_fault_are_told_together() -> None:
    units = "".join(f'[units.{name}]\nmodel = "streams.{name}"\n' for name in ("pump", "fan", "heater"))
    first, second, third, fourth = lines_of(FEED.format(to="pump", temperature="20 kg") + units)
    assert "[feeds.water]" in first
    assert "unit 'kg' does not fit" in first
    for line, name in ((second, "pump"), (third, "fan"), (fourth, "heater")):
        assert line.startswith(f"[units.{name}] streams.{name} needs ")


def test_streams_at_fault_are_told_together() -> None:
    units = '[units.mixer]\nmodel = "streams.mixer"\n'
    streams = '[streams]\na = ["mixer.outlet"]\nb = ["blender.product"]\n'
    first, second = lines_of(FEED.format(to="mixer", temperature="20 degC") + units + streams)
    assert "Outlet 'outlet'" in first
    assert "Unit 'blender'" in second


@pytest.mark.parametrize(("code", "last"), [("en", "… and 2 more."), ("fr", "… et encore 2.")])
def test_of_very_many_the_rest_is_counted(code: str, last: str) -> None:
    units = "".join(f'[units.pump_{i}]\nmodel = "streams.pump"\n' for i in range(8))
    with language(code):
        told = lines_of(FEED.format(to="pump_0", temperature="20 degC") + units)
    assert len(told) == 7
    assert told[-1] == last
