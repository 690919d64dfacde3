"""Design specifications that look at a stream, and that vary what enters: ``flowsheet.stream_figures``."""

from __future__ import annotations

import pytest

import granum as gr
from granum.cases import building
from granum.cases.reading import read_text
from granum.core.errors import CaseError, InputError
from granum.flowsheet.run import Run

LINE = """
title = "Brine"
[mixture]
liquids = ["water", "sodium chloride"]
solids = ["quartz"]
sizes = { smallest = "10 um", largest = "1 mm", classes = 4 }
[feeds.brine]
to = "mix.brine"
liquid_flow = "100 kg/h"
liquid = { water = "80 %", "sodium chloride" = "20 %" }
solid_flow = "50 kg/h"
sizes = { law = "rosin_rammler", size_modulus = "150 um", distribution_exponent = 1.5 }
[feeds.water]
to = "mix.water"
liquid_flow = "100 kg/h"
liquid = { water = 1.0 }
[units.mix]
model = "streams.mixer"
[units.warm]
model = "streams.heater"
temperature = "60 degC"
[units.split]
model = "streams.splitter"
side_fraction = 0.3
[streams]
mixed = ["mix.product", "warm.feed"]
hot = ["warm.product", "split.feed"]
back = ["split.side", "mix.back"]
"""


def solved(vary: str, so_that: str, equals: str, lower: str, upper: str) -> Run:
    return read_text(building.set_specification(LINE, vary, so_that, equals, lower, upper)).solve()


@pytest.mark.parametrize("stream", ["mixed", "mix.product", "split.product"])
def test_water_is_found_for_a_concentration(stream: str) -> None:
    """20 kg of salt in 200 kg of liquid is a tenth; the loop does not change the concentration."""
    path = f"{stream}.liquid.sodium chloride"
    run = solved("water.liquid_flow", path, "12.5 %", "10 kg/h", "500 kg/h")
    assert 3600.0 * run.found["water.liquid_flow"] == pytest.approx(20.0 / 0.125 - 100.0, rel=1e-7)
    assert float(run.streams["water"].liquid_flow) == pytest.approx(run.found["water.liquid_flow"])
    assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9


def test_a_purge_is_found_for_the_flow_of_a_stream_inside_a_loop() -> None:
    """250 kg/h enter: the loop carries 500 kg/h when half of it goes round."""
    run = solved("split.side_fraction", "hot.mass_flow", "500 kg/h", "1 %", "95 %")
    assert run.found["split.side_fraction"] == pytest.approx(0.5, abs=1e-8)


def test_moisture_and_temperature_are_looked_at_together() -> None:
    """The moisture of what leaves is that of what enters: 50 kg of solid with 100 kg of liquid."""
    case = building.set_specification(
        LINE, "water.liquid_flow", "split.product.moisture_dry_basis", "200 %", "0.001 kg/h", "90 kg/h"
    ).replace('"0.001 kg/h"', '"0 kg/h"')
    case = case.replace("200 %", "250 %")
    case = building.set_specification(
        case, "warm.temperature", "split.product.temperature", "45 degC", "20 degC", "90 degC"
    )
    run = read_text(case).solve()
    assert 3600.0 * run.found["water.liquid_flow"] == pytest.approx(25.0, rel=1e-7)
    assert run.found["warm.temperature"] == pytest.approx(318.15, abs=1e-6)


def test_a_target_out_of_reach_says_what_can_be_had() -> None:
    with pytest.raises(gr.core.errors.ConvergenceError, match="out of reach"):
        solved("water.liquid_flow", "mixed.liquid.sodium chloride", "30 %", "10 kg/h", "500 kg/h")


@pytest.mark.parametrize(
    ("so_that", "told"),
    [
        ("mixed.liquid.sugar", "sugar"),
        ("mixed.colour", "colour"),
        ("nowhere.mass_flow", "nowhere"),
        ("brine.mass_flow", "given"),
    ],
)
def test_what_no_stream_has_is_refused_in_words(so_that: str, told: str) -> None:
    specified = building.set_specification(
        LINE, "water.liquid_flow", "mixed.mass_flow", "300 kg/h", "10 kg/h", "500 kg/h"
    )
    with pytest.raises(CaseError, match=told):
        read_text(specified.replace('"mixed.mass_flow"', f'"{so_that}"'))
    with pytest.raises(InputError, match=so_that.split(".")[0] if told == "given" else told):
        building.set_specification(LINE, "water.liquid_flow", so_that, "1", "0", "2")


def test_a_phase_that_a_feed_does_not_carry_cannot_be_varied() -> None:
    with pytest.raises(CaseError, match="carries no solid"):
        solved("water.solid_flow", "mixed.mass_flow", "300 kg/h", "0 kg/h", "500 kg/h")
    with pytest.raises(CaseError, match="colour"):
        solved("water.colour", "mixed.mass_flow", "300 kg/h", "0 kg/h", "500 kg/h")


def test_a_specification_keeps_to_its_outlet_when_units_are_renamed_or_taken_out() -> None:
    case = building.set_specification(
        LINE, "water.liquid_flow", "split.product.mass_flow", "300 kg/h", "10 kg/h", "500 kg/h"
    )
    renamed = building.rename(building.rename(case, "split", "purge"), "water", "dilution")
    (spec,) = read_text(renamed).targets
    assert (spec.vary, spec.so_that) == ("dilution.liquid_flow", "purge.product.mass_flow")
    assert not read_text(building.remove(case, "split")).targets
