"""What is not a solution is not a result: every way in which a line can be wrong ends in one sentence that
names unit and cause.
"""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.commands import granum
from tests.sharing.streams import FEED, ONLY_WATER, loop

import granum as gr
from granum.core import flags
from granum.core.errors import ConvergenceError
from granum.core.packing import _built
from granum.flowsheet import Flowsheet, ladder
from granum.flowsheet.findings import Fault
from granum.flowsheet.run import Line
from granum.flowsheet.solving import QUICK_METHOD
from granum.flowsheet.specifications import Target, design
from granum.flowsheet.watching import Watch
from granum.streams.equipment.basics import Heater, Mixer, Single, Splitter
from granum.streams.stream import Stream, empty


class Leak(Mixer):
    """Loses a millionth."""

    def outlets(self, inside: None, **inlets: Stream) -> Single:
        return Single(sum(inlets.values(), start=empty(ONLY_WATER)).part(1.0, 1.0 - 1e-6, 1.0))


class Warmer(Mixer):
    """Gives a warmth that nobody pays for."""

    def outlets(self, inside: None, **inlets: Stream) -> Single:
        joined = sum(inlets.values(), start=empty(ONLY_WATER))
        return Single(joined.replace(temperature=joined.temperature + 1e-3))


class Nowhere(Mixer):
    """Gives no number."""

    def outlets(self, inside: None, **inlets: Stream) -> Single:
        return Single(sum(inlets.values(), start=empty(ONLY_WATER)).replace(temperature=jnp.asarray(jnp.nan)))


class Unsettled(Mixer):
    """Says that its own iteration did not converge."""

    def outlets(self, inside: None, **inlets: Stream) -> Single:
        flags.record(flags.NOT_CONVERGED, jnp.asarray(True), jnp.zeros(()), "inner balance", "streams.mixer")
        return Single(sum(inlets.values(), start=empty(ONLY_WATER)))


def refusal(line: Line, watch: Watch | None = None) -> ConvergenceError:
    with pytest.raises(ConvergenceError) as caught:
        line.solve(watch)
    assert caught.value.exit_code == 3
    assert caught.value.last.streams.keys() == {k.name for k in line.sheet.links}
    return caught.value


@pytest.mark.parametrize(
    ("unit", "words"),
    [
        (Leak(), "'middle' does not conserve water"),
        (Warmer(), "'middle' does not conserve energy"),
        (Nowhere(), "from unit 'middle' has no temperature"),
        (Unsettled(), "Unit 'middle' has no solution"),
    ],
)
def test_the_unit_at_fault_is_named_inside_a_loop(unit, words) -> None:
    problem = refusal(Line("loop", loop(unit)))
    assert words in problem.message
    assert problem.details["unit"] == "middle"


class Thirsty(Mixer):
    """Has no answer while one of its inlets is empty, as a dryer without gas."""

    def outlets(self, inside: None, **inlets: Stream) -> Single:
        joined = sum(inlets.values(), start=empty(ONLY_WATER))
        flows = jnp.all(jnp.stack([s.mass_flow > 0 for s in inlets.values()]))
        return Single(joined.replace(temperature=jnp.where(flows, joined.temperature, jnp.nan)))


def test_a_loop_starts_though_a_unit_waits_for_what_comes_round() -> None:
    """The torn stream is empty at first: the unit behind it gave no number, and none came round for ever."""
    units = {"dryer": Thirsty(), "split": Splitter(side_fraction=0.5), "mix": Mixer()}
    links = {
        "cake": ("", "dryer.cake"),
        "air": ("", "mix.fresh"),
        "hot": ("mix", "dryer.gas"),
        "exhaust": ("dryer", "split"),
        "back": ("split.side", "mix.back"),
    }
    line = Line("waiting", Flowsheet(units, {"cake": FEED, "air": FEED}, links))
    assert [block.tears for block in line.sheet.blocks if block.tears] == [("hot",)]
    run = line.solve()
    # two enter, half of it goes round
    assert float(run.streams["exhaust"].mass_flow) == pytest.approx(4.0, rel=1e-10)


def test_a_loop_that_nothing_starts_names_the_unit_that_waits() -> None:
    units = {"dryer": Thirsty(), "split": Splitter(side_fraction=0.5)}
    links = {"cake": ("", "dryer.cake"), "exhaust": ("dryer", "split"), "back": ("split.side", "dryer.back")}
    problem = refusal(Line("stuck", Flowsheet(units, {"cake": FEED}, links)))
    assert "from unit 'dryer' has no temperature" in problem.message


AIR = """
title = "two airs"
[mixture]
liquids = {liquids}
gases = {gases}
[feeds.warm]
to = "{unit}.warm"
temperature = "40 degC"
gas_flow = "1 kg/s"
relative_humidity = "{humidity}"
[feeds.cold]
to = "{unit}.cold"
temperature = "-10 degC"
gas_flow = "1 kg/s"
relative_humidity = "90 %"
[units.{unit}]
model = "{model}"
"""


def air(tmp_path: Path, **words: str) -> Line:
    given = {
        "liquids": '["water"]',
        "gases": '["dry air", "water"]',
        "unit": "mix",
        "humidity": "95 %",
        "model": "streams.mixer",
    } | words
    text = AIR.format(**given)
    path = tmp_path / "line.toml"
    path.write_text(text)
    return gr.read(path)


def test_fog_is_no_gas(tmp_path: Path) -> None:
    """Two airs near saturation lie on a chord above the saturation curve: a dry mixing point must say so, the
    humid one makes drops.
    """
    problem = refusal(air(tmp_path))
    assert "mix" in problem.message
    assert "a mixer of humid gases" in problem.message
    run = air(tmp_path, model="streams.humid_mixer").solve()
    assert float(run.streams["mix.product"].liquid_flow) > 0


def test_relative_humidity_of_a_feed_is_that_of_its_own_vapor(tmp_path: Path) -> None:
    """Ethanol at 40 °C: 134.1 mmHg by Antoine (8.11220, 1592.864, 226.184); half of it in nitrogen, by moles,
    whatever the order.
    """
    p = 10 ** (8.11220 - 1592.864 / (226.184 + 40.0)) / 760.0
    expected = 0.5 * p / (1 - 0.5 * p) * 46.069 / 28.013
    for gases in ('["nitrogen", "ethanol"]', '["ethanol", "nitrogen"]'):
        line = air(tmp_path, liquids='["ethanol"]', gases=gases, humidity="50 %", model="streams.humid_mixer")
        feed = line.sheet.feeds["warm"]
        vapor = feed.mixture.index("gases", "ethanol")
        assert float(feed.gas[vapor] / feed.gas[1 - vapor]) == pytest.approx(expected, rel=0.01)


DRYER = """
title = "order of gases"
[mixture]
liquids = {liquids}
solids = ["quartz"]
gases = {gases}
sizes = {{ smallest = "100 um", largest = "1 mm", classes = 4 }}
[feeds.wet]
to = "dryer.feed"
solid_flow = "100 kg/h"
liquid_flow = "10 kg/h"
sizes = {{ fractions = [0.25, 0.25, 0.25, 0.25] }}
[feeds.air]
to = "dryer.gas"
gas_flow = "1000 kg/h"
gas = {gas}
[units.dryer]
model = "drying.{model}"
{more}
"""
CONVECTIVE = 'temperature_inlet = "120 degC"\nmoisture_outlet = "1 %"'


@pytest.mark.parametrize(
    ("liquids", "gases", "gas"),
    [
        ('["water"]', '["water", "dry air"]', '{ "dry air" = 0.99, water = 0.01 }'),
        (
            '["water"]',
            '["dry air", "nitrogen", "water"]',
            '{ "dry air" = 0.5, nitrogen = 0.49, water = 0.01 }',
        ),
        ('["ethanol"]', '["nitrogen", "ethanol"]', "{ nitrogen = 1.0 }"),
    ],
)
@pytest.mark.parametrize(
    ("model", "more"),
    [
        ("convective_dryer", CONVECTIVE),
        ("well_mixed_dryer", 'residence_time = "10 min"\ngas_velocity = "1 m/s"'),
    ],
)
def test_a_dryer_knows_its_vapor_wherever_it_stands(tmp_path, liquids, gases, gas, model, more) -> None:
    path = tmp_path / "dryer.toml"
    path.write_text(DRYER.format(liquids=liquids, gases=gases, gas=gas, model=model, more=more))
    run = gr.read(path).solve()
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    humidity = run.figure(
        "dryer.humidity_ratio_outlet" if model == "convective_dryer" else "dryer.humidity_ratio"
    )
    vapor = run.figure("dryer.evaporation_rate") + (
        0.0 if "nitrogen = 1.0" in gas else 0.01 * 1000.0 / 3600.0
    )
    assert humidity == pytest.approx(
        vapor / (1000.0 / 3600.0 * (1.0 if "nitrogen = 1.0" in gas else 0.99)), rel=1e-9
    )


@pytest.fixture
def from_the_first_pass(monkeypatch: pytest.MonkeyPatch) -> None:
    """Told of the first pass, where ten are made as a rule before anybody looks."""
    monkeypatch.setattr(ladder, "FIRST", 1)


@pytest.mark.usefixtures("from_the_first_pass")
def test_a_watch_is_told_and_stops_with_the_last_iterate() -> None:
    told: list[tuple[str, int, float]] = []
    watch = Watch(lambda *row: told.append(row))
    run = Line("loop", loop(Heater(temperature=333.15))).solve(watch)
    assert told[0][:2] == ("back", 1)
    assert float(run.streams["mixed"].mass_flow) == pytest.approx(1 / 0.3, rel=1e-10)
    stopped = Watch(lambda *row: stopped.stop())
    problem = refusal(Line("loop", loop(Heater(temperature=333.15))), stopped)
    assert problem.details["kind"] == "stopped"
    assert "Stopped after" in problem.message


@pytest.mark.usefixtures("from_the_first_pass")
def test_passes_in_parts_are_the_same_passes() -> None:
    """A line left and taken up again after every pass takes the way of one that is not interrupted."""
    parts = Line("loop", loop(Heater(temperature=333.15))).solve(Watch())
    whole = design(loop(Heater(temperature=333.15)), ())
    assert parts.solution.steps[0] == whole.solution.steps[0]
    assert float(parts.streams["mixed"].mass_flow) == pytest.approx(
        float(whole.solution.streams["mixed"].mass_flow), rel=1e-12
    )


def test_the_speed_of_the_machine_does_not_change_the_way(monkeypatch: pytest.MonkeyPatch) -> None:
    def slow(_sheet: Any, _targets: Any, goal: Any, _known: Any) -> Any:
        looks[-1].append(int(goal))
        solution = SimpleNamespace(known=(0,), steps=(goal,), residual=(10.0 ** -float(goal),))
        return SimpleNamespace(designed=SimpleNamespace(solution=solution, converged=False))

    looks: list[list[int]] = []
    for seconds in (1e-12, 1e12):  # as if every pass took ages, or nothing
        monkeypatch.setattr(ladder, "PAUSE", seconds)
        looks.append([])
        ladder._in_passes(slow, QUICK_METHOD, loop(Heater(temperature=333.15)), (), 45, None)
    assert looks[0] == looks[1] == [10, 20, 30, 40, 45]


@pytest.mark.parametrize(("flow", "helps"), [(2.0, True), (200.0, False)])
def test_no_other_solver_is_asked_for_what_one_specification_cannot_have(flow: float, helps: bool) -> None:
    """1 kg/s goes round: the mixer gives 1/(1 − s), from 1 to 10 kg/s for s up to 0.9."""
    target = Target("split.side_fraction", "mixed.mass_flow", flow, 0.0, 0.9)
    lost = [Fault("loop", "cool", "back", "")]
    assert ladder._may_help(loop(Heater(temperature=333.15)), (target,), lost) is helps


def test_where_the_exact_solver_begins_is_no_part_of_its_program() -> None:
    sheet = loop(Heater(temperature=333.15))
    method = ladder.EXACT["method"]
    for temperature in (300.0, 310.0):
        begin = ladder.beginning(sheet, ())
        torn = {name: s.replace(temperature=np.float64(temperature)) for name, s in begin.torn.items()}
        before = _built.cache_info().misses
        ladder._in_passes(ladder._exactly, method, sheet, (), 3, None, begin._replace(torn=torn))
    assert _built.cache_info().misses == before


@pytest.mark.usefixtures("from_the_first_pass")
def test_time_is_bounded() -> None:
    problem = refusal(Line("loop", loop(Heater(temperature=333.15))), Watch(seconds=1e-9))
    assert "Not solved within" in problem.message
    assert ": 1 passes" in problem.message, "nothing more is begun when the time is up"


def test_command_line_gives_no_figures_unless_asked(tmp_path: Path) -> None:
    air(tmp_path)
    path = str(tmp_path / "line.toml")
    code, out, err = granum("run", path)
    assert (code, out) == (3, "")
    assert "a mixer of humid gases" in err
    code, out, _err = granum("run", path, "--json")
    assert code == 3
    assert set(json.loads(out)) == {"error"}
    code, out, _err = granum("run", path, "--partial")
    assert code == 3
    assert "not a solution" in out
