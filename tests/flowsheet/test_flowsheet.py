"""Flowsheets: order, recycle against closed forms, gradients, open and doubled ports, design
specifications.
"""

from __future__ import annotations

import jax
import jax.numpy as jnp
import pytest
from tests.sharing.streams import FEED, loop

from granum.core.errors import CaseError
from granum.flowsheet import Flowsheet, line_closure, solve, solve_compiled, unit_closures
from granum.flowsheet.drawing import draw
from granum.flowsheet.plan import Link, plan
from granum.flowsheet.specifications import Target, design
from granum.streams.equipment.basics import Heater, Mixer, Splitter

HEATER = Heater(temperature=333.15)


def test_recycle_is_the_geometric_series() -> None:
    solution = solve_compiled(loop(HEATER))
    assert bool(solution.converged)
    assert float(solution.streams["mixed"].mass_flow) == pytest.approx(1 / (1 - 0.7), rel=1e-11)
    assert float(solution.streams["split.product"].mass_flow) == pytest.approx(1.0, rel=1e-11)
    # by hand: (330·1 + 300·7/3)/(10/3) = 309 K, heated to 333.15 K
    assert float(solution.powers["middle"]["heat_duty"]) == pytest.approx(
        10 / 3 * 4000.0 * (333.15 - 309.0), rel=1e-10
    )


def test_units_and_line_close() -> None:
    line = loop(HEATER)
    solution = solve_compiled(line)
    assert float(line_closure(line, solution).mass) < 1e-11
    for found in unit_closures(line, solution).values():
        assert float(found.mass) < 1e-13
        assert float(found.energy) < 1e-13


def test_gradient_through_the_recycle_is_exact() -> None:
    def duty(fraction: float) -> jax.Array:
        line = loop(HEATER).with_values({"split.side_fraction": fraction})
        return solve(line).powers["middle"]["heat_duty"]

    # duty = 4000·[333.15/(1-f) − 330 − 300 f/(1-f)]; derivative 4000·33.15/(1-f)²
    expected = 4000.0 * 33.15 / 0.3**2
    assert float(jax.jit(jax.grad(duty))(0.7)) == pytest.approx(expected, rel=1e-8)
    assert float(jax.jit(jax.jacfwd(duty))(0.7)) == pytest.approx(expected, rel=1e-8)


def test_a_loop_without_a_way_out_is_not_called_converged() -> None:
    assert not bool(solve_compiled(loop(HEATER, 1.0)).converged)


def test_batch_of_lines() -> None:
    def mixed(fraction: jax.Array) -> jax.Array:
        return solve(loop(HEATER).with_values({"split.side_fraction": fraction})).streams["mixed"].mass_flow

    flows = jax.jit(jax.vmap(mixed))(jnp.array([0.1, 0.5, 0.9]))
    assert flows.tolist() == pytest.approx([1 / 0.9, 2.0, 10.0], rel=1e-10)


def test_specification_finds_the_split() -> None:
    target = Target("split.side_fraction", "mix.mass_flow", 4.0, 0.0, 0.95)
    found = design(loop(HEATER), (target,))
    assert bool(found.converged)
    assert float(found.values["split.side_fraction"]) == pytest.approx(0.75, abs=1e-9)


def test_specification_out_of_reach_is_refused() -> None:
    assert not bool(
        design(loop(HEATER), (Target("split.side_fraction", "mix.mass_flow", 400.0, 0.0, 0.95),)).converged
    )


def test_order_tears_one_stream_of_a_simple_loop_and_the_author_decides() -> None:
    links = (Link("a", "x.o", "y.i"), Link("b", "y.o", "z.i"), Link("c", "z.o", "x.i"))
    assert plan(("x", "y", "z"), links)[0].tears == ("c",)
    assert plan(("y", "z", "x"), links)[0].tears == ("a",)


def test_nested_loops_share_one_torn_stream() -> None:
    links = (
        Link("ab", "a.o", "b.i"),
        Link("bc", "b.o", "c.i"),
        Link("cb", "c.p", "b.j"),
        Link("cd", "c.o", "d.i"),
        Link("da", "d.o", "a.i"),
    )
    (block,) = plan(("d", "c", "b", "a"), links)
    assert block.tears == ("bc",)  # one stream breaks both loops


@pytest.mark.parametrize(
    ("links", "message"),
    [
        (
            {"feed": ("", "mix.fresh"), "m": ("mix", "heat"), "x": ("haet", "split")},
            "haet.*Did you mean 'heat'",
        ),
        (
            {
                "feed": ("", "mix.fresh"),
                "m": ("mix", "heat"),
                "h": ("heat", "split"),
                "r": ("split.sid", "cool"),
            },
            "sid.*Did you mean 'side'",
        ),
        (
            {"feed": ("", "mix.fresh"), "m": ("mix", "heat"), "h": ("heat", "split")},
            "Inlet 'feed' of unit 'cool' is open",
        ),
        ({"feed": ("", "mix.fresh"), "m": ("mix", "heat"), "n": ("mix", "cool")}, "both connected"),
        ({"feed": ("", "mix.fresh"), "m": ("mix", "heat"), "g": ("", "split")}, "comes from nowhere"),
    ],
)
def test_wrong_connections_say_what_and_where(links: dict[str, tuple[str, str]], message: str) -> None:
    units = {
        "mix": Mixer(),
        "heat": Heater(temperature=333.15),
        "split": Splitter(side_fraction=0.5),
        "cool": Heater(temperature=300.0),
    }
    with pytest.raises(CaseError, match=message):
        Flowsheet(units, {"feed": FEED}, links)


def test_drawing_names_every_unit_and_stream() -> None:
    line = loop(HEATER)
    svg = draw(line, solve_compiled(line).streams)
    for name in (*line.order, *(k.name for k in line.links)):
        assert f'"{name}"' in svg
