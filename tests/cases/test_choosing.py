"""Which other machine suits what enters one whose checks fail."""

from __future__ import annotations

import re
import shlex
from html import unescape
from math import log

import pytest
import tomli
from typer.testing import CliRunner

import granum as gr
from granum.cases.building import add_unit, begin
from granum.cases.choosing import Advice, advice
from granum.cases.reading import read_text
from granum.cli import app
from granum.core import registry
from granum.core.datasets import dataset
from granum.core.i18n import language

TABLES = ("drying", "dryers_houdon2017"), ("filtration", "separators_svarovsky2001")
MODULUS = 5e-6


def text_of(model: str, enters: str = "suspension", size: str = "5 um") -> str:
    """A line of one machine with a feed of quartz and water."""
    text = begin("Essai", enters, solid="quartz").replace('"150 um"', f'"{size}"')
    text = text.replace('smallest = "1 um"', 'smallest = "0.01 um"')
    return add_unit(text, model, origin=next(iter(tomli.loads(text)["feeds"])))


def told(model: str, **words: str) -> Advice:
    run = read_text(text_of(model, **words), name="essai").solve()
    assert not all(check.ok for report in run.units.values() for check in report.checks)
    (found,) = advice(run).values()
    return found


def test_a_slurry_in_a_drum_is_sent_to_what_dries_liquids() -> None:
    found = told("drying.rotary_dryer")
    assert found.card == "drying.choose"
    # 200 kg/h of quartz in 1000 kg/h of water
    assert found.inputs["product_form"] == "liquid"
    assert found.inputs["mass_flow"] == "1200 kg/h"
    assert found.inputs["moisture_dry_basis_inlet"] == "5"
    # mujumdar2014, ch. 1: of a pumpable feed drum and spray dryers, the only ones that run continuously
    assert {"drying.drum_dryer", "drying.spray_dryer"} <= {other.model for other in found.others}


def test_fine_grains_in_a_basket_with_slots_are_sent_to_a_press() -> None:
    found = told("centrifuges.pusher")
    assert found.card == "filtration.separator_choice"
    assert float(found.inputs["particle_diameter"].split()[0]) == pytest.approx(
        1e6 * MODULUS * log(2.0) ** (1.0 / 1.5),
        rel=0.05,  # Rosin and Rammler's median; classes are a tenth wide
    )
    assert float(found.inputs["density_difference"].split()[0]) == pytest.approx(2650.0 - 997.0, abs=5.0)
    assert found.others
    # svarovsky2001: baskets with slots of a tenth of a millimeter and more lose them
    slotted = {f"centrifuges.{name}" for name in ("scroll_screen", "sliding_screen", "vibrating_screen")}
    assert not slotted & {other.model for other in found.others}
    assert "filtration.membrane_press" in {other.model for other in found.others}


def test_what_it_was_asked_gives_the_same_order_at_the_command_line() -> None:
    found = told("centrifuges.pusher")
    words = shlex.split(found.command)
    assert words[:2] == ["granum", "calc"]
    shown = CliRunner().invoke(app, words[1:])
    assert shown.exit_code == 0, shown.output
    best = registry.find(found.card)(**found.inputs)[0][0]
    assert found.others[0].name == best


def test_a_machine_whose_checks_hold_is_left_alone() -> None:
    run = read_text(text_of("filtration.chamber_press"), name="essai").solve()
    assert all(check.ok for report in run.units.values() for check in report.checks)
    assert advice(run) == {}


def test_a_salt_that_cooling_leaves_dissolved_is_to_be_boiled_down() -> None:
    """mullin2001, ch. 8: a solubility that hardly changes with temperature asks for evaporation."""
    text = add_unit(
        begin("Salt", "solution", solute="sodium chloride"), "crystallization.msmpr", origin="solution"
    )
    (found,) = advice(read_text(text, name="essai").solve()).values()
    assert found.card == "crystallization.choose"
    assert found.others[0].name.startswith("evaporation")
    assert found.inputs["temperature_hot"] == "80 degC"
    crop = float(re.findall(r"gives ([\d.]+) %", found.told)[0])
    # handbooks: 36 g in 100 g of water at 25 °C, 38 g at 80 °C
    assert crop == pytest.approx(100.0 * (1.0 - 36.0 / 38.0), abs=1.0)
    shown = CliRunner().invoke(app, shlex.split(found.command)[1:])
    assert shown.exit_code == 0, shown.output
    assert "evaporation" in shown.output


def test_where_no_other_sort_is_better_the_settings_are_looked_at() -> None:
    found = told("drying.rotary_dryer", enters="moist_solid")
    assert found.others == ()
    assert "settings" in found.told


def test_it_is_said_in_french() -> None:
    with language("fr"):
        found = told("centrifuges.pusher")
        assert found.others[0].name == registry.find(found.card)(**found.inputs)[0][0]
    assert "Conviennent mieux" in found.told
    assert not re.search(r"\b(the|made|outside|hardly)\b", found.told)


def test_the_command_and_its_json_say_it(tmp_path) -> None:
    case = tmp_path / "line.toml"
    case.write_text(text_of("centrifuges.pusher"), encoding="utf-8")
    report = tmp_path / "line.html"
    shown = CliRunner().invoke(app, ["run", str(case), "--report", str(report)])
    assert shown.exit_code == 0, shown.output
    assert "granum calc filtration.separator_choice" in " ".join(shown.output.split())
    printed = re.search(r'<li class="advice"[^>]*>(.*?)</li>', report.read_text(encoding="utf-8"))
    assert printed is not None
    assert told("centrifuges.pusher").told in unescape(printed[1])


@pytest.mark.parametrize("table", TABLES, ids="-".join)
def test_machines_of_a_ranked_table_have_their_units(table: tuple[str, str]) -> None:
    for row in dataset(*table):
        models = row["models"].split()
        assert models
        assert all(registry.find(model).card.sort == "equipment" for model in models)


@pytest.mark.parametrize(
    ("bowl", "other"),
    [
        ("disc_stack", "disc_separator"),
        ("tubular_bowl", "tubular_separator"),
        ("scroll_decanter", "three_phase_decanter"),
    ],
)
def test_a_bowl_fed_with_drops_is_told_of_the_one_that_lets_them_out(bowl: str, other: str) -> None:
    """It had been told that no other machine suits better, its own check of what floats failing."""
    run = gr.alone(f"centrifuges.{bowl}", mixture={"solids": "olive oil"}, feed={"solid_flow": "200 kg/h"})
    (found,) = advice(run.solve()).values()
    assert [one.model for one in found.others] == [f"centrifuges.{other}"]
    assert "no outlet" in found.told
    asked = registry.find(found.card)(**found.inputs)
    assert max(asked.suitability) > 0.0
