"""What is left empty, said to be none, or of no effect is told, not taken for something else."""

from __future__ import annotations

from typing import Any

import pytest

import granum as gr
from granum.cases.reading import read_text
from granum.core import registry
from granum.core.errors import GranumError
from granum.core.i18n import language

CLARIFIER = "settling.circular_clarifier"


def removed(**words: Any) -> float:
    return float(gr.alone(CLARIFIER, **words).solve().figure("circular_clarifier.removal_efficiency"))


def test_an_ideal_basin_is_asked_for_by_none() -> None:
    """It removes more than any number of tanks mixed from top to bottom."""
    assert removed(tank_number="none") == removed(tank_number=None)
    assert removed(tank_number=3) < removed(tank_number=1000) < removed(tank_number="none")
    assert removed() == removed(tank_number=3)


def test_an_empty_text_is_refused_where_it_could_be_either() -> None:
    with pytest.raises(GranumError, match="'none' goes without it; left out it is 3"):
        gr.alone(CLARIFIER, tank_number="")
    with pytest.raises(GranumError, match="'none' goes without it"):
        read_text(gr.alone(CLARIFIER).text + '\ntank_number = ""\n')
    with language("fr"), pytest.raises(GranumError, match="s’en passe"):
        gr.alone(CLARIFIER, tank_number="")
    assert removed(weir_length="") == removed()  # has no value unless one is given


@pytest.mark.parametrize("pressure", [0, "0 bar", "-1.01325 barg"])
def test_nothing_comes_from_a_vacuum(pressure: Any) -> None:
    with pytest.raises(GranumError, match="pressure"):
        gr.alone("streams.heater", feed={"pressure": pressure})


@pytest.mark.parametrize("key", ["drying.rotary_dryer", "conveying.pneumatic_conveyor"])
def test_gas_that_comes_with_the_feed_is_told(key: str) -> None:
    line = gr.alone(key)
    assert not [row for row in line.solve().flags if row["flag"] == "idle gas"]
    head, feed = line.text.split("[feeds.feed]\n")
    gas = '[feeds.feed]\ngas_flow = "1 kg/h"\ngas = { "dry air" = 1.0 }\n'
    told = [row for row in read_text(head + gas + feed).solve().flags if row["flag"] == "idle gas"]
    assert [row["unit"] for row in told] == [key.partition(".")[2]]
    assert "1 kg/h of gas" in told[0]["message"]


def test_one_share_said_of_two_liquids() -> None:
    line = gr.alone(
        "evaporation.evaporator", mixture={"liquids": ["water", "sucrose"]}, **{"feed.liquid.water": "95 %"}
    )
    run = line.solve()
    assert run.streams["feed"].liquid_fractions == pytest.approx([0.95, 0.05])


def test_a_difference_of_temperature_is_offered_once() -> None:
    offered = registry.find("evaporation.evaporator").card.inputs["elevation_linear"].units
    assert offered == ("kelvin",)


def test_a_bound_that_is_not_possible_itself_says_so() -> None:
    with pytest.raises(GranumError, match="which are not possible themselves"):
        gr.alone("centrifuges.disc_separator", light_solids_fraction="100 %")
