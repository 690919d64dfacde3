"""The pressure of a stream that goes round: found like its flows, whichever stream is torn; or told, where
the loop loses or gains some at every turn.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from granum.core.kinds import Pressure
from granum.flowsheet import Flowsheet, line_closure, solve, solve_compiled
from granum.flowsheet.ladder import at_rung, beginning
from granum.flowsheet.passing import told
from granum.flowsheet.specifications import Target, design
from granum.streams.equipment.basics import Mixer, Splitter, TwoWays
from granum.streams.equipment.movers import Fan
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream, empty
from granum.streams.units import Unit
from granum.studies.lines import LineSubject
from granum.studies.study import Study

AIR = Mixture((), (), (Species("air", (("air", 1.0),), (1.0,), (1005.0,), 0.0, 0.029),), (1e-6, 1e-3))
FED, LOST = 120e3, 5e3  # Pa


class Passed(NamedTuple):
    product: Stream


class Lowered(NamedTuple):
    pressure_outlet: Pressure


class Throttle(Unit):
    """Loses pressure."""

    loss: Any

    def outlets(self, inside: None, feed: Stream) -> Passed:
        return Passed(feed.replace(pressure=feed.pressure - self.loss))

    def figures(self, inside: None, outlets: Passed, feed: Stream) -> Lowered:
        return Lowered(outlets.product.pressure)


class Uneven(Unit):
    """Sends more to its side the more comes."""

    most: Any

    def outlets(self, inside: None, feed: Stream) -> TwoWays:
        side = self.most * feed.mass_flow / (1.0 + feed.mass_flow)
        return TwoWays(feed.replace(gas=(1.0 - side) * feed.gas), feed.replace(gas=side * feed.gas))

    def figures(self, inside: None, outlets: TwoWays, feed: Stream) -> Lowered:
        return Lowered(outlets.product.pressure)


def line(rise: Any = 8e3, loss: Any = LOST, first: str = "mix", side: float = 0.6) -> Flowsheet:
    """Air to a mixer, a throttle, a fan and a splitter whose side goes back; the unit named stands first, so
    that the stream into it is torn.
    """
    units: dict[str, Unit] = {
        "mix": Mixer(),
        "throttle": Throttle(loss),
        "fan": Fan(pressure_rise=rise),
        "split": Splitter(side_fraction=side),
    }
    names = list(units)
    order = names[names.index(first) :] + names[: names.index(first)]
    links = {
        "air": ("", "mix.fresh"),
        "mixed": ("mix", "throttle.feed"),
        "lowered": ("throttle", "fan.feed"),
        "raised": ("fan", "split.feed"),
        "back": ("split.side", "mix.back"),
    }
    feed = empty(AIR, 300.0, FED).replace(gas=jnp.array([1.0]))
    return Flowsheet({name: units[name] for name in order}, {"air": feed}, links)


TORN = {"mix": "back", "throttle": "mixed", "fan": "lowered", "split": "raised"}


@pytest.mark.parametrize("first", TORN)
def test_whichever_stream_is_torn(first: str) -> None:
    """2.5 kg/s pass the fan from 115 to 123 kPa; an ideal gas takes up n R T γ/(γ - 1) (r^0.2857 - 1)."""
    made = line(first=first)
    assert [name for block in made.blocks for name in block.tears] == [TORN[first]]
    found = solve_compiled(made)
    assert bool(found.converged)
    pressures = {name: float(s.pressure) for name, s in found.streams.items()}
    expected = {"mixed": FED, "lowered": FED - LOST, "raised": FED + 3e3, "back": FED + 3e3}
    assert {name: pressures[name] for name in expected} == pytest.approx(expected, rel=1e-12)
    T = float(found.streams["lowered"].temperature)
    work = 2.5 / 0.029 * 8.314462618 * T * 3.5 * ((123.0 / 115.0) ** (1.0 / 3.5) - 1.0)
    assert float(found.powers["fan"]["shaft_power"]) == pytest.approx(
        work / float(made.units["fan"].machine_efficiency), rel=1e-9
    )
    assert float(line_closure(made, found).energy) < 1e-10
    assert not told(found.records)


@pytest.mark.parametrize("first", ["mix", "fan"])
@pytest.mark.parametrize("rise", [1e3, 4e3])
def test_what_is_lost_at_every_turn_is_told(first: str, rise: float) -> None:
    found = solve_compiled(line(rise=rise, first=first))
    assert bool(found.converged)
    assert float(found.streams[TORN[first]].pressure) == pytest.approx(FED, rel=1e-14)
    [row] = told(found.records)
    assert row["unit"] == {"mix": "split", "fan": "throttle"}[first]
    assert "makes good" in row["message"]
    assert float(found.streams["mixed"].mass_flow) == pytest.approx(2.5, rel=1e-11)


def test_what_is_made_good_to_the_pascal_stays_at_the_pressure_of_the_feed() -> None:
    found = solve_compiled(line(rise=LOST, first="fan"))
    assert bool(found.converged)
    assert float(found.streams["lowered"].pressure) == pytest.approx(FED - LOST, rel=1e-14)
    assert not told(found.records)


def test_derivatives_follow_the_pressure_round() -> None:
    def lowered(loss: Any, fed: Any) -> Any:
        made = line(loss=loss, first="fan")
        return solve(made.with_values({"air.pressure": fed})).streams["lowered"].pressure

    by_loss, by_feed = jax.jit(jax.grad(lowered, argnums=(0, 1)))(LOST, FED)
    assert (float(by_loss), float(by_feed)) == pytest.approx((-1.0, 1.0), rel=1e-9)


def test_cases_side_by_side_each_find_their_own() -> None:
    rises = np.array([1e3, 4e3, 5e3, 8e3, 20e3])

    def one(rise: Any) -> tuple[Any, Any, Any]:
        found = solve(line(rise=rise, first="fan"))
        return found.streams["lowered"].pressure, found.converged, found.records["throttle"][-1].mask

    pressures, converged, missed = jax.jit(jax.vmap(one))(rises)
    assert converged.all()
    assert pressures.tolist() == pytest.approx([FED, FED, *[FED - LOST] * 3], rel=1e-12)
    assert missed.tolist() == [True, True, False, False, False]


def test_a_specification_sees_the_pressure_that_is_found() -> None:
    target = Target("fan.pressure_rise", "raised.pressure", 125e3, 6e3, 20e3)
    found = design(line(first="fan"), (target,))
    assert bool(found.converged)
    assert float(found.values["fan.pressure_rise"]) == pytest.approx(125e3 - (FED - LOST), rel=1e-7)


@pytest.mark.parametrize("rung", [0, 1])
def test_the_next_case_goes_on_from_what_was_carried(rung: int) -> None:
    before = at_rung(line(first="fan"), (), rung)
    assert float(before.solution.carried["lowered"]) == 1.0
    after = line(rise=9e3, loss=6e3, first="fan")
    begin = beginning(after, (), before)
    found = at_rung(after, (), 0, begin)
    assert bool(found.converged)
    assert float(found.solution.streams["lowered"].pressure) == pytest.approx(FED - 6e3, rel=1e-12)
    assert int(found.solution.steps[0]) < 10


@pytest.mark.parametrize(("rise", "lost"), [(8e3, LOST), (1e3, 0.0)])
def test_a_study_finds_what_the_line_does_alone(rise: float, lost: float) -> None:
    over = {
        "air.pressure": {"from": "1.2 bar", "to": "2 bar", "steps": 3},
        "split.side_fraction": {"from": 0.3, "to": 0.6, "steps": 2},
    }
    table = {"kind": "map", "over": over, "outputs": ["lowered.pressure"]}
    outcome = Study.of("pressures", table, LineSubject.of(line(rise=rise, first="fan")), {}).run()
    assert outcome.cases.fine.all()
    assert outcome.cases.y[:, 0].tolist() == pytest.approx(
        [fed - lost for fed in (120e3, 160e3, 200e3) for _side in range(2)], rel=1e-12
    )


def test_a_study_goes_to_and_fro_between_loops_that_rest_and_loops_that_drift() -> None:
    over = {
        "air.pressure": {"from": "1.2 bar", "to": "2 bar", "steps": 3},
        "fan.pressure_rise": {"from": "1 kPa", "to": "10 kPa", "steps": 3},
    }
    table = {"kind": "map", "over": over, "outputs": ["lowered.pressure"]}
    cases = Study.of("rises", table, LineSubject.of(line(first="fan")), {}).run().cases
    assert cases.fine.all()
    expected = [x[0] - (0.0 if x[1] < LOST else LOST) for x in cases.x]
    assert cases.y[:, 0].tolist() == pytest.approx(expected, rel=1e-12)


def chain(goes: tuple[int, ...], fed: Any, sides: Any, rises: Any, losses: Any, first: int) -> Flowsheet:
    """Mixer, throttle, blower and splitter again and again; the side of each goes to the mixer named. The
    first feed has another pressure than that of the chain.
    """
    steps = range(len(goes))
    units: dict[str, Unit] = {"aside": Throttle(0.0)}
    links = {"low": ("", "aside.feed"), "air": ("", "mix0.fresh")}
    for i in steps:
        units |= {
            f"mix{i}": Mixer(),
            f"throttle{i}": Throttle(losses[i]),
            f"fan{i}": Throttle(-rises[i]),
            f"split{i}": Uneven(sides[i]),
        }
        links |= {
            f"mixed{i}": (f"mix{i}", f"throttle{i}.feed"),
            f"lowered{i}": (f"throttle{i}", f"fan{i}.feed"),
            f"raised{i}": (f"fan{i}", f"split{i}.feed"),
            f"back{i}": (f"split{i}.side", f"mix{goes[i]}.back{i}"),
        }
        if i:
            links[f"on{i}"] = (f"split{i - 1}.product", f"mix{i}.fresh")
    names = list(units)
    feed = empty(AIR, 300.0, FED).replace(gas=jnp.array([1.0]))
    feeds = {"low": feed, "air": feed.replace(pressure=fed)}
    return Flowsheet({n: units[n] for n in (*names[first:], *names[:first])}, feeds, links)


@pytest.mark.parametrize(
    ("goes", "first"), [((0, 0, 0), 0), ((1, 0, 1), 2), ((2, 0, 2), 5), ((1, 2, 0), 7), ((2, 2, 1), 9)]
)
def test_a_hundred_lines_find_each_pressure_or_tell_that_there_is_none(
    goes: tuple[int, ...], first: int
) -> None:
    dice = np.random.default_rng(first)
    fed = dice.uniform(1e5, 4e5, 100)
    sides = dice.uniform(0.05, 0.95, (100, 3))
    rises = dice.choice([0.0, 1e3, 4e3, 8e3, 30e3], (100, 3))
    losses = dice.uniform(500.0, 6e3, (100, 3))

    def one(fed: Any, sides: Any, rises: Any, losses: Any) -> Any:
        made = chain(goes, fed, sides, rises, losses, first)
        found = solve(made)
        told = {
            f"{unit} {i}": record.mask
            for unit, records in found.records.items()
            for i, record in enumerate(records)
            if record.name == "pressure"
        }
        closure = line_closure(made, found)
        mixed = jnp.stack([found.streams[f"mixed{i}"].pressure for i in range(3)])
        return found.converged, mixed, told, closure.mass, closure.energy

    converged, mixed, told, mass, energy = jax.jit(jax.vmap(one))(fed, sides, rises, losses)
    assert converged.all()
    assert max(abs(mass).max(), abs(energy).max()) < 1e-9

    def passed(mixed: Any) -> Any:
        raised = mixed - losses + rises
        come = [[fed if i == 0 else raised[:, i - 1], *raised.T[np.array(goes) == i]] for i in range(3)]
        return np.stack([np.min(c, axis=0) for c in come], axis=1)

    right = np.full((100, 3), np.inf)
    for _round in range(4):
        right = passed(right)
    rests = (passed(right) == right).all(axis=1)
    assert 10 < rests.sum() < 90
    assert (~np.any([*told.values()], axis=0)).tolist() == rests.tolist()
    assert mixed[rests] == pytest.approx(right[rests], rel=1e-9)
