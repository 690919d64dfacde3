"""Each piece of equipment alone: it opens with a result that nothing is said against, and is changed by
words.
"""

from __future__ import annotations

import json
import tomllib

import numpy as np
import pytest
from tests.sharing.commands import granum

import granum as gr
from granum.app.alone_forms import alone_form
from granum.cases import read_text
from granum.cases.alone import alone, assumed, case_text, tables
from granum.core.conversion import convert
from granum.core.errors import GranumError, InputError
from granum.core.i18n import language
from granum.core.index import entries
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter

EQUIPMENT = [key for key, entry in entries().items() if entry.sort == "equipment"]
# of the forms that the library has of one substance no solution has a known viscosity, and it says so
THIN = "crystallization.polymorph_crystallizer"
DRUM = "filtration.rotary_vacuum_drum"


@pytest.mark.parametrize("key", EQUIPMENT)
def test_it_opens_with_a_result_and_without_a_flag(key: str, left_to_jax: list[str]) -> None:
    run = alone(key).solve()
    assert left_to_jax == []
    (report,) = run.units.values()
    assert all(p.kind is None or p.optional or value is not None for p, value in report.figures())
    assert [check.name for check in report.checks if not check.ok] == []
    told = [flag["message"] for flag in run.as_json()["flags"]]
    assert [m for m in told if key != THIN or "viscosity" not in m] == []
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9


def test_words_change_the_unit_its_feed_and_its_substances() -> None:
    found = tables(
        DRUM, {"area": "12 m2", "feed.solid_flow": "400 kg/h", "mixture.solids": "quartz", "wash": "no"}
    )
    assert found["units"]["rotary_vacuum_drum"]["area"] == "12 m2"
    assert found["feeds"]["feed"]["solid_flow"] == "400 kg/h"
    assert found["mixture"]["solids"] == ["quartz"]
    assert "wash" not in found["feeds"]


def test_substances_may_be_written_in_french() -> None:
    said = {"mixture.liquids": "eau, chlorure de sodium", "mixture.solids": "calcite"}
    assert tables(DRUM, said)["mixture"]["liquids"] == ["water", "sodium chloride"]
    with language("fr"):
        form = alone_form(DRUM, {})
    assert form["values"]["mixture.liquids"] == "eau, chlorure de sodium"
    assert form["values"]["mixture.solids"] == "calcite"


def test_a_flow_said_another_way_replaces_the_first() -> None:
    feed = tables(DRUM, {"feed.mass_flow": "3 t/h", "feed.solids_mass_fraction": "10 %"})["feeds"]["feed"]
    assert "solid_flow" not in feed
    assert "liquid_flow" not in feed
    run = gr.alone(DRUM, feed={"mass_flow": "3 t/h", "solids_mass_fraction": "10 %"}).solve()
    assert run.streams["feed"].solid_flow * 3600 == pytest.approx(300.0)


@pytest.mark.parametrize(
    ("said", "solid", "liquid"),
    [
        ({"mass_flow": "6 t/h"}, 120.0, 5880.0),  # the example: 3 t/h with 2 % of solid
        ({"solids_mass_fraction": "5 %"}, 150.0, 2850.0),
        ({"solid_flow": "150 kg/h"}, 150.0, 2940.0),
        ({"liquid_flow": "1 t/h"}, 60.0, 1000.0),
    ],
)
def test_a_part_of_the_flow_leaves_the_rest_of_the_example(
    said: dict[str, str], solid: float, liquid: float
) -> None:
    feed = gr.alone("centrifuges.disc_stack", feed=said).sheet.feeds["feed"]
    assert feed.solid_flow * 3600 == pytest.approx(solid)
    assert feed.liquid_flow * 3600 == pytest.approx(liquid)


def test_a_total_flow_keeps_the_share_of_solid_of_the_example() -> None:
    feed = tables("comminution.ball_mill", {"feed.mass_flow": "20 t/h"})["feeds"]["feed"]
    assert feed["solids_mass_fraction"] == "66.66666667 %"
    assert tables("settling.lamella", {"feed.mass_flow": ""})["feeds"]["feed"]["solid_flow"] == "100 kg/h"


def test_shares_of_substances_that_are_gone_go_with_them() -> None:
    found = tables(DRUM, {"mixture.liquids": "water"})
    assert all("liquid" not in feed for port, feed in found["feeds"].items() if port == "feed")
    assert alone(DRUM, mixture={"liquids": "water"}).solve().audit["mass_closure"] < 1e-9


def test_shares_that_were_said_stay_when_those_of_the_example_go() -> None:
    """Another salt in the crystallizer, its feed said whole."""
    said = {"feed.liquid.water": 0.66, "feed.liquid.potassium chloride": 0.34}
    other = {"mixture.liquids": "water,potassium chloride", "mixture.solids": "potassium chloride"}
    assert tables("crystallization.msmpr", other | said)["feeds"]["feed"]["liquid"] == {
        "water": 0.66,
        "potassium chloride": 0.34,
    }
    odd = said | {"feed.liquid.potassium nitrate": 0.1}
    assert "potassium nitrate" in tables("crystallization.msmpr", other | odd)["feeds"]["feed"]["liquid"]


def test_laws_of_substances_that_are_gone_go_with_them() -> None:
    """The belt of the example dissolves its own salt; another solid does not ask for that salt."""
    belt = "filtration.horizontal_belt_filter"
    assert "wash_dissolution" in tables(belt)["units"]["horizontal_belt_filter"]
    other = {"mixture.solids": "quartz"}
    assert "wash_dissolution" not in tables(belt, other)["units"]["horizontal_belt_filter"]
    said = other | {"wash_dissolution.crystal": "potassium nitrate"}
    assert "wash_dissolution" in tables(belt, said)["units"]["horizontal_belt_filter"]


def test_twice_the_area_is_half_the_load() -> None:
    small, large = (
        alone(DRUM, area=area).solve().units["rotary_vacuum_drum"].values for area in ("9 m2", "18 m2")
    )
    assert float(small.area_required) == pytest.approx(float(large.area_required), rel=0.05)
    assert float(large.capacity_use) == pytest.approx(float(small.capacity_use) / 2, rel=0.05)


def test_a_heater_takes_what_the_water_takes_up() -> None:
    """1 kg/s of water from 20 to 60 °C takes 4.18 kJ/(kg K) × 40 K."""
    run = alone(
        "streams.heater",
        temperature="60 degC",
        feed={"liquid_flow": "1 kg/s", "solid_flow": "1e-9 kg/s", "temperature": "20 degC"},
    ).solve()
    assert float(run.units["heater"].values.heat_duty) == pytest.approx(167.2e3, rel=0.005)


def test_its_text_is_a_case_file_that_says_the_same() -> None:
    text = case_text(DRUM, {"area": "12 m2"})
    assert tomllib.loads(text)["units"]["rotary_vacuum_drum"]["area"] == "12 m2"
    one, other = read_text(text).solve(), alone(DRUM, area="12 m2").solve()
    assert one.as_json()["units"] == other.as_json()["units"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ({"areaa": "12 m2"}, "Did you mean 'area'?"),
        ({"feed.solidflow": "1 kg/s"}, "Did you mean 'feed.solid_flow'?"),
        ({"fed.solid_flow": "1 kg/s"}, "by 'fed'. Known names: feed.solid_flow, wash.solid_flow."),
        ({"slurry.solid_flow": "1 kg/s"}, "Known names: feed.solid_flow, wash.solid_flow."),
        ({"feed.dust": "1 g/m3"}, "Known names: feed.dew_point_temperature, feed.gas"),
        ({"aire": "5 m2"}, "Did you mean 'area'?"),
        ({"wash_dissolution": "{law"}, "is no table"),
    ],
)
def test_what_is_no_word_of_it_is_told(words: dict[str, str], said: str) -> None:
    with pytest.raises(GranumError) as problem:
        case_text(DRUM, words)
    assert said in problem.value.message


@pytest.mark.parametrize("turned", [False, True])
def test_another_law_takes_none_of_the_parameters_of_the_example(turned: bool) -> None:
    """In whatever order law and parameters are said."""
    said = {
        "feed.sizes.law": "log_normal",
        "feed.sizes.median_diameter": "15 um",
        "feed.sizes.geometric_standard_deviation": "2.9",
    }
    words = dict(reversed(said.items())) if turned else said
    case = tomllib.loads(case_text("cyclones.gas_cyclone", words))
    sizes = {name.rpartition(".")[2]: value for name, value in said.items()}
    assert case["feeds"]["feed"]["sizes"] == sizes
    kept = case_text("cyclones.gas_cyclone", {"feed.sizes.law": "rosin_rammler"})
    assert tomllib.loads(kept)["feeds"] == tomllib.loads(case_text("cyclones.gas_cyclone"))["feeds"]


def test_shares_that_were_not_said_fill_up_those_that_were() -> None:
    """A brine of four fifths water has a fifth of the salt of the example; the others of three keep their
    proportion.
    """
    feed = tables("evaporation.evaporator", {"feed.liquid.water": "80 %"})["feeds"]["feed"]
    assert feed["liquid"].pop("water") == "80 %"
    assert list(feed["liquid"].values()) == [pytest.approx(0.2)]
    text = case_text("evaporation.evaporator", {"feed.liquid.water": 0.8})
    liquid = read_text(text).solve().streams["feed"].liquid
    assert float(liquid.min() / liquid.sum()) == pytest.approx(0.2)
    with pytest.raises(GranumError, match="120 %"):
        read_text(case_text("evaporation.evaporator", {"feed.liquid.water": 1.2}))


def test_what_a_unit_answers_is_no_input_of_it() -> None:
    with pytest.raises(InputError, match=r"is what comminution\.bond_mill answers"):
        tables("comminution.bond_mill", {"product_size": "3 mm"})


def test_gas_said_of_what_is_dried_is_sent_to_its_own_inlet() -> None:
    """It left with the exhaust and dried nothing, in silence."""
    for key in ("drying.rotary_dryer", "drying.spray_dryer", "drying.tray_dryer"):
        with pytest.raises(InputError, match=r"say 'gas\.gas_flow'"):
            tables(key, {"feed.gas_flow": "2 t/h"})
    assert tables("dust.bag_filter", {"feed.gas_flow": "2 t/h"})["feeds"]["feed"]["gas_flow"] == "2 t/h"


def test_a_formula_is_no_equipment() -> None:
    with pytest.raises(GranumError, match="is a formula, not equipment"):
        alone("particles.reynolds_number")


def test_the_command_solves_it() -> None:
    code, out, _err = granum("calc", DRUM, "area=12m2", "feed.solid_flow=400kg/h", "--json")
    assert code == 0
    found = json.loads(out)
    assert found["units"]["rotary_vacuum_drum"]["results"]["capacity_use"]["value"] < 1.0
    code, out, err = granum("calc", DRUM, "area=-1m2")
    assert code == 2
    assert "Traceback" not in err


def test_another_law_takes_none_of_the_parameters_of_the_first():
    named = {"growth": "spiral_growth", "growth.spiral_coefficient": "1e-4 m/s"}
    said = tables("crystallization.msmpr", named)["units"]["msmpr"]["growth"]
    assert said == {"law": "spiral_growth", "spiral_coefficient": "1e-4 m/s"}
    whole = {"law": "spiral_growth", "spiral_coefficient": 1e-4, "spiral_supersaturation": 0.01}
    assert tables("crystallization.msmpr", {"growth": whole})["units"]["msmpr"]["growth"] == whole
    same = tables("crystallization.msmpr", {"growth": "power_law_growth", "growth.growth_order": 2.0})
    assert same["units"]["msmpr"]["growth"]["growth_coefficient"] > 0.0


def test_what_was_not_said_is_told() -> None:
    told = assumed("crystallization.msmpr", {"volume": "5 m3", "growth.growth_order": "1.5"})
    assert told["solubility.solute"] == "potassium nitrate" == told["mixture.solids"]
    assert "growth.growth_coefficient" in told
    assert not {"volume", "growth.growth_order"} & set(told)
    assert not [
        word for word in assumed("crystallization.msmpr", {"growth": "x"}) if word.startswith("growth")
    ]
    _status, shown, _said = granum("calc", "crystallization.msmpr", "volume=5m3")
    assert "solubility.solute=potassium nitrate" in shown
    assert ", volume=" not in shown


def test_another_gas_has_the_share_of_the_one_it_replaces() -> None:
    feed = tables("drying.rotary_dryer", {"mixture.gases": "nitrogen,water"})["feeds"]["gas"]
    usual = tables("drying.rotary_dryer")["feeds"]["gas"]["gas"]
    assert feed["gas"] == {"nitrogen": usual["dry air"], "water": usual["water"]}


def test_gases_without_shares_are_asked_for() -> None:
    with pytest.raises(GranumError, match=r"gas\.nitrogen, gas\.acetone, gas\.water"):
        alone("drying.rotary_dryer", **{"mixture.gases": "nitrogen,acetone,water"})


@pytest.mark.parametrize("key", ["comminution.cone_crusher", "cyclones.gas_cyclone", "settling.thickener"])
@pytest.mark.parametrize(
    ("median", "spread"), [("50 nm", 1.5), ("20 um", 6.0), ("3 mm", 2.0), ("0.4 m", 3.0)]
)
def test_the_size_classes_hold_what_is_said_of_the_feed(key: str, median: str, spread: float) -> None:
    """By a log-normal law whose median and spread are those of the stream; the ratio of the classes stays."""
    law = {
        "feed.sizes.law": "log_normal",
        "feed.sizes.median_diameter": median,
        "feed.sizes.geometric_standard_deviation": spread,
    }
    line = read_text(case_text(key, law))
    feed = line.sheet.feeds["feed"]
    edges, shares = np.asarray(feed.mixture.edges), np.asarray(feed.size_fractions)
    found = float(np.exp(np.sum(shares * np.log(np.sqrt(edges[:-1] * np.maximum(edges[1:], 1e-12))))))
    expected = float(convert(median, Parameter("median_diameter", KINDS["Length"])))
    assert found == pytest.approx(expected, rel=0.06)
    usual = tables(key)["mixture"]["sizes"]
    ends = [float(convert(usual[end], Parameter(end, KINDS["Length"]))) for end in ("smallest", "largest")]
    assert edges[1] / edges[0] == pytest.approx((ends[1] / ends[0]) ** (1.0 / usual["classes"]), rel=1e-9)


def test_size_classes_that_were_said_are_left() -> None:
    words = {"feed.sizes.size_modulus": "300 mm", "mixture.sizes.largest": "204.8 mm"}
    with pytest.raises(GranumError, match="coarser than"):
        read_text(case_text("comminution.cone_crusher", words))


def test_a_humidity_stands_for_the_vapor_of_the_example() -> None:
    feed = tomllib.loads(case_text("drying.rotary_dryer", {"gas.humidity_ratio": "12 g/kg"}))["feeds"]["gas"]
    assert feed["humidity_ratio"] == "12 g/kg"
    assert "gas" not in feed
    other = tomllib.loads(case_text("conveying.pneumatic_conveyor", {"gas.dew_point_temperature": "5 degC"}))
    assert "relative_humidity" not in other["feeds"]["gas"]


@pytest.mark.parametrize("nothing", [0, "0 kg/h", "0,0 t/h"])
def test_an_optional_stream_of_nothing_is_told_how_to_be_left_out(nothing: object) -> None:
    with pytest.raises(GranumError, match='wash="no"'):
        case_text(DRUM, {"wash.liquid_flow": nothing})
