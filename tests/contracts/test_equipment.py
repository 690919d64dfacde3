"""What every piece of equipment keeps, at one ordinary setting of the smallest case that holds it.

Balances of each component and of energy close; nothing comes out where nothing goes in; the derivative with
respect to a parameter is that of central differences; at twenty random settings besides, every result has
finite derivatives with respect to all feeds and parameters; what it takes is possible, and no less for
twice the flow where a stream is moved; a unit says the same called alone and in a line; limits have a
source. Random settings of the same cases, and species in another order, are in ``test_unit_fuzz`` and
``test_separator_fuzz``; dryers and units for humid gas are in ``test_dryer_settings``. Those under ``LONG``
are tried in the long run only (``GRANUM_RANDOM_SAMPLES``).
"""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.contracts import (
    crystallizer_cases,
    evaporator_cases,
    membrane_cases,
    separator_cases,
    unit_cases,
    vessel_cases,
)
from tests.contracts.taking import judge, judge_twice
from tests.contracts.unit_search import FEED, OWN, QUICK, THERE, Case, present, rows
from tests.sharing.samples import SAMPLES

from granum.core import registry
from granum.flowsheet import Flowsheet, solve
from granum.flowsheet.findings import CLOSURE, LEAST, findings

STEP = 1e-5
ANYWHERE = 20
MADE_EMPTY = 10  # rows that are no ordinary ones, at the beginning
HUMID = {
    "dust.packed_scrubber",
    "dust.spray_tower",
    "dust.venturi_scrubber",
    "streams.adiabatic_humidifier",
    "streams.condenser_cooler",
    "streams.dehumidifying_coil",
    "streams.humid_mixer",
}
LONG = {  # slow to compile, or solved by the code of a neighbor that is tried
    "centrifuges.scroll_screen",
    "centrifuges.sliding_screen",
    "centrifuges.tumbling_screen",
    "crystallization.antisolvent_batch_crystallizer",
    "crystallization.batch_crystallizer",
    "crystallization.classified_crystallizer",
    "crystallization.jacketed_batch_crystallizer",
    "crystallization.plug_flow_crystallizer",
    "crystallization.vacuum_batch_crystallizer",
    "crystallization.vacuum_crystallizer",
    "evaporation.multiple_effect_evaporator",
    "evaporation.steam_jet_evaporator",
    "filtration.candle_filter",
    "filtration.deep_bed_filter",
    "filtration.nutsche",
    "filtration.plate_and_frame_press",
    "filtration.pressure_leaf_filter",
    "filtration.rotary_disc_filter",
    "settling.clarifier_thickener",
    "settling.countercurrent_decantation",
}
ALONE = ("fluidization.fluidized_bed", "cyclones.gas_cyclone", "filtration.rotary_vacuum_drum")
GROUPS = (
    unit_cases.mills,
    unit_cases.filters,
    unit_cases.centrifuges,
    unit_cases.basics,
    vessel_cases.crystallizers,
    evaporator_cases.evaporators,
    membrane_cases.membranes,
    crystallizer_cases.mixed,
)


@cache
def equipment() -> dict[str, Any]:
    return {key: thing for key, thing in registry.everything().items() if thing.card.sort == "equipment"}


# known without a case of each, which takes seconds whenever tests are collected
CASED = [key for key in sorted(equipment()) if not key.startswith("drying.") and key not in HUMID]


@cache
def cases() -> dict[str, Case]:
    """The first case of each card."""
    found: dict[str, Case] = {}
    named = [case for group in GROUPS for case in group(2).values()]
    for case in (*named, *map(separator_cases.case_of, separator_cases.UNITS)):
        x = jnp.full(FEED + OWN, 0.5)
        key = case.unit(case.feeds(case.mixture, x[:FEED]), x[FEED:]).card.key
        found.setdefault(key, case)
    return found


def setting() -> np.ndarray:
    """An ordinary row of numbers: eight for the feeds, six for the unit."""
    return rows(11)[10][[*range(FEED), *range(FEED + THERE, FEED + THERE + OWN)]]


def anywhere() -> tuple[np.ndarray, np.ndarray]:
    """Random rows, and directions in which every number of them changes: along these, what is not finite in
    one derivative is not in their sum.
    """
    random = rows(ANYWHERE + MADE_EMPTY, seed=23)[MADE_EMPTY:]
    ways = np.random.default_rng(29).normal(size=(ANYWHERE, FEED + OWN))
    return np.hstack([random[:, :FEED], random[:, FEED + THERE :]]), ways


class Outcome(NamedTuple):
    """What came of one row: closures of the unit, whether it says that it has no solution, its outlets by
    name, all its figures, what it takes, and the powers of its balance.
    """

    mass: Any
    energy: Any
    lowest: Any
    lost: Any
    flows: Any
    numbers: Any
    uses: Any
    powers: Any


def outcome(case: Case, row: Any, there: Any) -> Outcome:
    """A line of the unit alone, solved."""
    meant = case.feeds(case.mixture, row[:FEED])
    feeds = present(meant, there)
    line = Flowsheet({"unit": case.unit(meant, row[FEED:])}, feeds, {n: ("", f"unit.{n}") for n in feeds})
    solution = solve(line, sheets=True)
    found = findings(line, solution)
    products = [solution.streams[n] for n in line.products]
    numbers = [
        jnp.ravel(jnp.asarray(v, dtype=float))
        for v in jax.tree.leaves((products, solution.powers, solution.sheets["unit"][0]))
    ]
    flows = jnp.stack([s.mass_flow for s in products])
    closed = found.mass[0], found.energy[0], jnp.min(found.lowest), found.lost[0]
    uses = solution.sheets["unit"].uses
    return Outcome(*closed, flows, jnp.concatenate(numbers), uses, solution.powers["unit"])


def test_every_card_has_a_case_or_is_humid() -> None:
    assert sorted(cases()) == CASED
    assert equipment().keys() >= HUMID


@pytest.mark.parametrize("key", sorted(equipment()))
def test_limits_have_a_source(key: str) -> None:
    thing = equipment()[key]
    assert list(thing.card.limits) == list(thing.limits.values())
    assert all(limit.name and limit.source and limit.unit for limit in thing.card.limits)
    shares = [limit.high for limit in thing.card.limits if limit.unit == "percent"]
    assert all(high > 1.0 for high in shares if not isinstance(high, str)), "shares, not percents"


@pytest.mark.parametrize("key", ALONE)
def test_a_unit_says_the_same_alone_and_in_a_line(key: str) -> None:
    """Names, bits and sources of flags, and checks, of the unit called and of the line of it alone."""
    case = cases()[key]
    row = jnp.asarray(setting())

    def flagged(row: Any) -> Any:
        feeds = case.feeds(case.mixture, row[:FEED])
        unit = case.unit(feeds, row[FEED:])
        line = Flowsheet({"unit": unit}, feeds, {n: ("", f"unit.{n}") for n in feeds})
        made, solution = unit.operate(**feeds), solve(line, sheets=True)
        return (made.records, made.checks), (solution.records["unit"], solution.sheets["unit"][1])

    alone, lined = jax.tree.map(np.asarray, jax.jit(flagged)(row))
    assert jax.tree.structure(alone) == jax.tree.structure(lined)
    jax.tree.map(np.testing.assert_array_equal, alone, lined)


@pytest.mark.parametrize("key", [key for key in CASED if SAMPLES or key not in LONG])
def test_conserves_keeps_still_has_derivatives_and_takes_what_it_may(key: str) -> None:
    case, middle = cases()[key], setting()
    along = np.zeros(FEED + OWN)
    along[FEED] = 1.0  # the first number of the unit
    settings, ways = anywhere()
    there = np.repeat([1.0, 1.0, 1.0, 0.0, 2.0, *np.ones(ANYWHERE)], THERE).reshape(-1, THERE)
    settings = np.vstack([middle, middle - STEP * along, middle + STEP * along, middle, middle, settings])
    ways = np.vstack([np.tile(along, (5, 1)), ways])

    def tried(row: Any, parts: Any, way: Any) -> tuple[Outcome, Any]:
        found, slopes = jax.jvp(lambda r: outcome(case, r, parts), (row,), (way,))
        return found, slopes.numbers

    options = {"compiler_options": QUICK} if jax.default_backend() == "cpu" else {}
    # one after the other: without fusion a batch of marches copies all its packets at every step
    each = jax.jit(lambda *every: jax.lax.map(lambda one: tried(*one), every), **options)
    found, slopes = jax.tree.map(np.asarray, each(settings, there, ways))
    assert not found.lost[:3].any()
    assert found.mass[:3].max() <= CLOSURE
    assert found.energy[:3].max() <= CLOSURE
    assert found.lowest[:3].min() >= LEAST
    assert np.isfinite(found.numbers[:5]).all() or found.lost[3]
    assert found.lost[3] or not found.flows[3].any()
    assert np.isfinite(slopes[0]).all()
    answered = np.flatnonzero(~found.lost[5:]) + 5
    assert len(answered) >= ANYWHERE / 10  # batches of needles in two size classes refuse most
    assert np.isfinite(found.numbers[answered]).all()
    assert np.isfinite(slopes[answered]).all()
    measured = (found.numbers[2] - found.numbers[1]) / (2.0 * STEP)
    rounding = 1e-6 * found.flows[0].max()  # of what is the rest of two flows
    apart = np.abs(measured - slopes[0]) / (np.abs(found.numbers[0]) + np.abs(slopes[0]) + rounding)
    assert apart.max() <= 1e-4
    once, twice = ({name: x[k] for name, x in found.uses.items()} for k in (0, 4))
    judge(once, {name: x[0] for name, x in found.powers.items()})
    judge_twice(once, twice)
