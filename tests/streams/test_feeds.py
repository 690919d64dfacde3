"""A feed in Python is the feed of a case file: the same words, quantities and refusals, and one humidity for
any pair.
"""

from __future__ import annotations

import runpy
from typing import Any

import jax
import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

import granum
from granum.core.errors import InputError
from granum.materials import fluid
from granum.streams.feeding import feed
from granum.streams.from_materials import mixture_of

EDGES = (1e-5, 1e-4, 1e-3)
WET = mixture_of(["water"], ["quartz", "calcite"], ["dry air", "water"], EDGES)
EVEN = {"fractions": [0.5, 0.5]}


def test_flows_and_shares_by_hand() -> None:
    shares = {"quartz": 0.8, "calcite": "20 %"}
    made = feed(
        WET, mass_flow="3.6 t/h", solids_mass_fraction="25 %", solid=shares, sizes=EVEN, temperature="50 degC"
    )
    np.testing.assert_allclose(made.solid, [[0.1, 0.1], [0.025, 0.025]], rtol=1e-14)
    np.testing.assert_allclose(made.liquid, [0.75], rtol=1e-14)
    assert float(made.temperature) == pytest.approx(323.15, rel=1e-14)
    assert float(made.gas_flow) == 0.0


@pytest.mark.parametrize(
    "said",
    [
        {"solid_flow": "3 t/h", "moisture_dry_basis": 1.0 / 3.0},
        {"solid_flow": "3 t/h", "moisture_wet_basis": "25 %"},
        {"mass_flow": "4 t/h", "moisture_wet_basis": 0.25},
        {"mass_flow": "4 t/h", "moisture_dry_basis": "333.3333333333 g/kg"},
    ],
)
def test_a_moisture_says_the_liquid(said) -> None:
    wet = feed(WET, solid={"quartz": 1.0, "calcite": 0.0}, sizes=EVEN, **said)
    assert float(wet.solid_flow) == pytest.approx(3.0 / 3.6, rel=1e-9)
    assert float(wet.liquid_flow) == pytest.approx(1.0 / 3.6, rel=1e-9)


def test_a_moisture_stands_alone() -> None:
    quartz = {"solid": {"quartz": 1.0, "calcite": 0.0}, "sizes": EVEN}
    with pytest.raises(InputError, match="give one of"):
        feed(WET, solid_flow=1.0, liquid_flow=1.0, moisture_dry_basis=0.3, **quartz)
    with pytest.raises(InputError, match="needs the 'solid_flow'"):
        feed(WET, moisture_wet_basis=0.3, **quartz)


def test_a_feed_may_be_a_volume() -> None:
    """By hand: water of 20 °C has 998.2 kg/m³, quartz 2650; dry air 1.2041 at 1 atm, US gallons 3.7854 L. A
    humid gas is as large as its vapor makes it.
    """
    water = feed(WET, temperature="20 degC", liquid_flow="440 gpm")
    assert float(water.liquid_flow) == pytest.approx(440.0 * 3.785412e-3 / 60.0 * 998.2, rel=2e-3)
    quartz = {"quartz": 1.0, "calcite": 0.0}
    slurry = feed(
        WET, temperature="20 degC", mass_flow="36 m3/h", solids_mass_fraction=0.2, solid=quartz, sizes=EVEN
    )
    per_kilogram = 0.2 / float(slurry.solid_density) + 0.8 / 998.2
    assert float(slurry.mass_flow) == pytest.approx(0.01 / per_kilogram, rel=2e-3)
    assert float(slurry.slurry_volume_flow) == pytest.approx(0.01, rel=1e-12)
    dry = feed(WET, temperature="20 degC", gas_flow="3600 m3/h", gas={"dry air": 1.0, "water": 0.0})
    assert float(dry.gas_flow) == pytest.approx(1.2041, rel=1e-3)
    humid = feed(WET, temperature="60 degC", gas_flow="2 m3/s", relative_humidity="60 %")
    assert float(humid.gas_volume_flow) == pytest.approx(2.0, rel=1e-12)
    assert float(humid.gas_flow) < 2.0 * 1.0596  # of dry air at 60 °C
    # 1.293 kg of air fill a cubic meter at 0 °C and 1 atm, however hot it is here
    hot = feed(WET, temperature="150 degC", gas_flow="3600 Nm3/h", gas={"dry air": 1.0, "water": 0.0})
    assert float(hot.gas_flow) == pytest.approx(1.293, rel=1e-3)
    with pytest.raises(InputError, match="'solid_flow': unit 'm3/h' does not fit"):
        feed(WET, solid_flow="1 m3/h", solid=quartz, sizes=EVEN)


@pytest.mark.parametrize(
    ("word", "value", "ratio", "within"),
    [
        ("humidity_ratio", "10 g/kg", 0.01, 1e-12),  # as it is told
        ("humidity_ratio", 0.0, 0.0, 1e-12),
        ("dew_point_temperature", "14 degC", 0.00999, 0.003),  # ASHRAE: 9.99 g/kg saturated at 14 °C
        ("wet_bulb_temperature", "17 degC", 0.00996, 0.005),  # of 22.2 °C: 60 % by the course notes
    ],
)
def test_a_humidity_in_other_words(word: str, value: object, ratio: float, within: float) -> None:
    made = feed(WET, temperature="22.2 degC", gas_flow=2.0, **{word: value})
    vapor = WET.index("gases", "water")
    assert float(made.gas.sum() - made.gas[vapor]) == 2.0
    assert float(made.gas[vapor]) / 2.0 == pytest.approx(ratio, rel=within, abs=1e-12)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ({"humidity_ratio": "50 g/kg"}, "at most"),
        ({"humidity_ratio": "5 g/kg", "relative_humidity": "50 %"}, "one value says"),
        ({"dew_point_temperature": "30 degC"}, "more than saturates"),
    ],
)
def test_a_humidity_that_cannot_be_is_refused(words: dict[str, str], told: str) -> None:
    with pytest.raises(InputError, match=told):
        feed(WET, temperature="20 degC", gas_flow=2.0, **words)


@pytest.mark.parametrize("gases", [("nitrogen", "ethanol"), ("ethanol", "nitrogen")])
def test_relative_humidity_is_that_of_the_pair(gases: tuple[str, str]) -> None:
    """Half the vapor pressure of ethanol at 20 °C: some 0.05 kg per kg of nitrogen, not the 0.007 of water in
    air.
    """
    made = feed(
        mixture_of(["ethanol"], [], gases, EDGES),
        gas_flow=2.0,
        relative_humidity="50 %",
        temperature="20 degC",
    )
    vapor, dry = (float(made.gas[gases.index(name)]) for name in ("ethanol", "nitrogen"))
    share = 0.5 * float(fluid("ethanol").vapor_pressure(293.15)) / 101325.0
    ratio = float(fluid("ethanol").molar_mass / fluid("nitrogen").molar_mass)
    assert dry == 2.0
    assert vapor / dry == pytest.approx(share / (1.0 - share) * ratio, rel=1e-6)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ({}, "nothing flows"),
        ({"mass_flow": 1.0, "liquid_flow": 1.0}, "not both"),
        ({"solid_flow": 1.0, "sizes": EVEN}, "say the shares of the solids: solid.quartz, solid."),
        ({"solid_flow": 1.0, "solid": {"quartz": 1.0}}, "size distribution"),
        ({"solid_flow": 1.0, "solid": {"quartz": 1.0}, "sizes": {"fractions": [1.0]}}, "2 values"),
        ({"solid_flow": 1.0, "solid": {"quarz": 1.0}, "sizes": EVEN}, "quartz"),
        ({"liquid_flow": "1 m"}, "liquid_flow"),
    ],
)
def test_what_is_refused(words: dict[str, Any], told: str) -> None:
    with pytest.raises(InputError, match=told):
        feed(WET, **words)


def test_a_solid_among_the_liquids_and_drops_at_their_temperature() -> None:
    with pytest.raises(InputError, match="'quartz' is a solid here: give it among the solids"):
        mixture_of(["water", "quartz"], [], [], EDGES)
    with pytest.raises(InputError, match="'lactose monohydrate'"):
        mixture_of(["water"], ["lactose"], [], EDGES)
    # palm oil at 90 °C: 869 kg/m³ by its line as a liquid
    drops = mixture_of(["water"], ["palm oil"], [], EDGES).densities("solids", 363.15)
    assert float(drops[0]) == pytest.approx(float(fluid("palm oil").liquid_density(363.15)), rel=1e-6)


def test_the_line_in_python_is_the_line_of_the_case_file() -> None:
    made = runpy.run_path(str(EXAMPLES / "line-in-python" / "line_in_python.py"))["run"]
    run = granum.read(EXAMPLES / "grinding-circuit" / "circuit.toml").solve()
    for own, other in zip(jax.tree.leaves(made.sheet.feeds), jax.tree.leaves(run.sheet.feeds), strict=True):
        np.testing.assert_array_equal(own, other)
    assert made.figure("mill.specific_energy") == pytest.approx(run.figure("mill.specific_energy"), rel=1e-9)
    for name in ("returned", "product"):
        np.testing.assert_allclose(made.streams[name].solid, run.streams[name].solid, rtol=1e-9, atol=1e-12)


def test_a_feed_outside_its_size_classes_says_on_which_side_and_what_to_give() -> None:
    """Rosin and Rammler by hand: with 2 mm 1 − exp(−0.005^1.5) = 0.0353 % and exp(−0.5^1.5) = 70.2 %, with
    10 µm 1 − 1/e = 63.2 %.
    """
    law = {"law": "rosin_rammler", "distribution_exponent": 1.5}
    water = {"liquid_flow": 1.0, "solid_flow": 0.1, "solid": {"quartz": 1.0, "calcite": 0.0}}
    feed(WET, sizes={**law, "size_modulus": "200 um"}, **water)
    with pytest.raises(
        InputError, match=r"0\.0353 % .* than 10 µm, where .* begin; 70\.2 % .* coarser than 1 mm.*'largest'"
    ):
        feed(WET, sizes={**law, "size_modulus": "2 mm"}, **water)
    with pytest.raises(InputError, match=r"63\.2 % of the feed is finer .* 'smallest' or 'largest'") as told:
        feed(WET, sizes={**law, "size_modulus": "10 um"}, **water)
    assert "coarser" not in str(told.value)  # of which there are exp(−1000)


@pytest.mark.parametrize(
    ("temperature", "density"),
    [(4, 999.97), (20, 998.21), (25, 997.05), (40, 992.22), (60, 983.20), (95, 961.9)],
)
def test_water_of_a_stream_weighs_what_tables_say(temperature: float, density: float) -> None:
    """Handbook values at 1 atm. Cells differ from their broth by 30 kg/m³: one too few would be 3 % of it."""
    water = mixture_of(["water"], [], [], [1e-6, 1e-3])
    stream = feed(water, temperature=f"{temperature} degC", liquid_flow="1 kg/s")
    assert float(stream.liquid_density) == pytest.approx(density, abs=0.15)


@pytest.mark.parametrize("pressure", [0, "0 bar", "0 atm"])
def test_nothing_flows_out_of_a_vacuum(pressure: Any) -> None:
    with pytest.raises(InputError, match=r"\('pressure'\) = 0 .* greater than 0"):
        feed(WET, liquid_flow="1 t/h", pressure=pressure)
    assert float(feed(WET, liquid_flow="1 t/h", pressure="0.1 mbar").pressure) == pytest.approx(10.0)
