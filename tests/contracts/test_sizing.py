"""Every piece of equipment is sized from its duty, or says why it has no size.

What a machine of the size in the example does is asked of a machine of another size: the search must come
back to the first. Some are tried each time, all in the long run (``GRANUM_RANDOM_SAMPLES``).
"""

from __future__ import annotations

import json
import math

import pytest
from tests.sharing.samples import SAMPLES
from typer.testing import CliRunner

import granum as gr
from granum.app.tasks import TASKS, Tell
from granum.cases.sizing import NO_SIZE, Duty, _declared, doubts, duty
from granum.cli import app
from granum.core import registry
from granum.core.errors import ApplicabilityError, ConvergenceError, InputError

QUICK = (
    "centrifuges.disc_stack",
    "cyclones.hydrocyclone",
    "dust.electrostatic_precipitator",
    "evaporation.evaporator",
    "filtration.nutsche",
    "settling.clarifier",
)
EQUIPMENT = sorted(key for key, thing in registry.everything().items() if thing.card.sort == "equipment")
SIZED = [key for key in EQUIPMENT if "setting" in _declared().get(key, {})]


def test_every_piece_of_equipment_says_how_it_is_sized_or_why_not() -> None:
    assert sorted(_declared()) == EQUIPMENT
    for key in EQUIPMENT:
        card, row = registry.find(key).card, _declared()[key]
        if key in SIZED:
            assert row["setting"] in {p.name for p in card.parameters}
            assert row["figure"] in {p.name for p in card.outputs}
        else:
            with pytest.raises(ApplicabilityError, match="cannot be sized"):
                duty(key)
    assert {row["reason"] for row in _declared().values() if "reason" in row} == set(NO_SIZE)


@pytest.mark.parametrize("key", SIZED if SAMPLES else QUICK)
def test_the_size_of_what_a_size_does_is_that_size(key: str) -> None:
    name = key.split(".")[1]
    asked = duty(key)
    line = gr.alone(key)
    before = float(getattr(line.sheet.units[name], asked.setting))
    does = line.solve().figure(f"{name}.{asked.figure}")
    run = gr.size(key, **{asked.setting: 1.37 * before, asked.figure: does})
    assert run.found[f"{name}.{asked.setting}"] == pytest.approx(before, rel=1e-6)


def test_cloth_of_a_bag_filter_by_hand() -> None:
    """Twice the gas needs twice the cloth at one velocity; the velocity is flow over area."""
    once = gr.size("dust.bag_filter", superficial_velocity="1 m/min").found["bag_filter.area"]
    run = gr.size("dust.bag_filter", superficial_velocity="1 m/min", feed={"gas_flow": "40 t/h"})
    assert run.found["bag_filter.area"] == pytest.approx(2.0 * once, rel=1e-6)
    assert run.found["bag_filter.area"] == pytest.approx(
        float(run.line.sheet.feeds["feed"].gas_volume_flow) * 60.0, rel=1e-6
    )


@pytest.mark.parametrize("name", ["sliding_screen", "vibrating_screen", "tumbling_screen"])
def test_a_cone_for_the_time_that_its_cake_has_to_drain(name: str) -> None:
    """Where the cake goes at one pace the length goes with the time; where it slides ever faster the farther
    from the axis, by r'' = ω² r sin β (sin β - tan φ cos β) from the small end: r = r₁ cosh(k t).
    """
    key = f"centrifuges.{name}"
    once = gr.size(key, drainage_time="0.1 s").found[f"{name}.basket_length"]
    run = gr.size(key, drainage_time="0.15 s")
    found = run.found[f"{name}.basket_length"]
    if name != "sliding_screen":
        assert found == pytest.approx(1.5 * once, rel=1e-6)
        return
    cone = run.line.sheet.units[name]
    b, f, r1 = float(cone.cone_angle), float(cone.friction_angle), float(cone.radius_outer)
    k = float(cone.rotation_speed) * math.sqrt(math.sin(b) * (math.sin(b) - math.tan(f) * math.cos(b)))
    stay = 0.15 / (1.0 - 0.3)  # but for the share of the length on which the slurry arrives
    assert found * math.sin(b) == pytest.approx(r1 * (math.cosh(k * stay) - 1.0), rel=1e-6)


@pytest.mark.parametrize(
    ("key", "figures", "problem", "says"),
    [
        ("settling.clarifier", {"removal_efficiency": "100 %"}, ConvergenceError, "not reached"),
        ("centrifuges.tubular_bowl", {"solids_recovery": "100 %"}, ApplicabilityError, "met by any"),
        ("filtration.reverse_osmosis", {"water_recovery": "99.9 %"}, ConvergenceError, "not reached"),
        pytest.param(
            "drying.belt_dryer",
            {"moisture_dry_basis": "0.0001 %"},
            ConvergenceError,
            "not reached",
            marks=pytest.mark.long,
        ),
        ("dust.bag_filter", {}, InputError, "give one of its figures"),
        ("dust.bag_filter", {"removal_efficiency": "110 %"}, InputError, "removal"),
        (
            "centrifuges.vibrating_screen",
            {"drainage_time": "5 s", "rotation_speed": "1000 rpm"},
            ApplicabilityError,
            "does not hold: vibration over the least",
        ),
        ("streams.mixer", {"mass_flow": "1 kg/s"}, ApplicabilityError, "cannot be sized"),
    ],
)
def test_a_duty_that_cannot_be_is_refused_in_words(
    key: str, figures: dict[str, str], problem: type[Exception], says: str
) -> None:
    with pytest.raises(problem, match=says):
        gr.size(key, **figures)


def test_the_command_line_and_the_page_find_the_same_size() -> None:
    words = ["dust.bag_filter", "superficial_velocity=1 m/min", "--solve", "size", "--json"]
    told = CliRunner().invoke(app, ["calc", *words])
    assert told.exit_code == 0
    area = json.loads(told.output)["specifications"]["bag_filter.area"]
    payload = {
        "key": "dust.bag_filter",
        "inputs": {},
        "find": "area",
        "output": "superficial_velocity",
        "wanted": "1 m/min",
    }
    number, unit = json.loads(TASKS["solve"](payload, Tell()))["text"].split()
    assert (float(number), unit) == (pytest.approx(area, rel=1e-8), "m^2")
    assert duty("dust.bag_filter") == Duty("area", "superficial_velocity")


def test_what_stands_against_a_size_is_told() -> None:
    """The cake of 50 m of slurry is no cake of a gravity filter, whatever its area."""
    deep = gr.size("filtration.gravity_filter", slurry_depth="50 m", capacity_use=0.9)
    assert "does not hold: cake thickness in a gravity filter." in doubts(deep)
    assert not doubts(gr.size("filtration.gravity_filter", capacity_use=0.9))


def test_what_is_counted_is_told_as_a_whole_number() -> None:
    told = doubts(gr.size("settling.lamella", overflow_rate="1 m/hour", feed={"liquid_flow": "150 t/h"}))
    assert "A whole number is built: number of plates = 118 or 119" in told
    counted = {row["setting"] for row in _declared().values() if row.get("whole")}
    assert counted == {
        row["setting"]
        for row in _declared().values()
        if row.get("setting", "").endswith(("_number", "_count"))
    }


def test_the_end_of_what_may_be_set_is_looked_at() -> None:
    """One hydrocyclone is the least there is."""
    with pytest.raises(ConvergenceError, match="from 1 to"):
        gr.size("cyclones.hydrocyclone", cut_size="10 um")


def test_a_size_at_which_there_is_no_answer_is_no_size() -> None:
    """A membrane beyond the liquid that there is has figures, but no answer: they are not looked at."""
    run = gr.size("filtration.ultrafiltration", volume_concentration_factor=10.0)
    assert 250.0 < run.found["ultrafiltration.area"] < 400.0
