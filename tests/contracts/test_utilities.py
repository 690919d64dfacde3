"""What every piece of equipment takes: declared, a possible number, no less than its balance takes up, and no
less for twice the flow where a stream is moved. Units slow to compile run under ``GRANUM_RANDOM_SAMPLES``.
"""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.contracts.dryer_settings import BY_BALANCE, HUMID_GAS, PRODUCT, WITH_CELLS
from tests.contracts.test_equipment import LONG, cases, equipment, setting
from tests.contracts.unit_search import FEED, QUICK
from tests.sharing.samples import SAMPLES

from granum.core.sources import cite
from granum.core.utilities import COOLING, ELECTRICITY, HEAT, SORTS, carrier, purpose, sort_of
from granum.costs.tables import emissions

# nothing is known of their size or drive, or nothing moves them
WITHOUT = {
    "comminution.double_deck_screen",
    "comminution.screen",
    "comminution.triple_deck_screen",
    "crystallization.impurity_uptake",
    "dust.extraction_hood",
    "streams.adiabatic_humidifier",
    "streams.agglomerator",
    "streams.humid_mixer",
    "streams.mixer",
    "streams.splitter",
}
MOVING = ("pump", "fan", "drive", "atomizer")
ROUNDING = 1e-6
DRYERS = {**WITH_CELLS, **BY_BALANCE, **HUMID_GAS}
QUICK_DRYERS = ("drum", "tray", "heat pump", "coil", "burner")


def compiled(call: Any, *given: Any) -> Any:
    options: dict[str, Any] = {"compiler_options": QUICK} if jax.default_backend() == "cpu" else {}
    return jax.tree.map(np.asarray, jax.jit(call, **options)(*given))


def taken(unit: Any, inlets: dict[str, Any]) -> Any:
    """What a unit takes, and the powers that its balance takes up."""
    made = unit.operate(**inlets)
    return made.uses, {name: getattr(made.outlets, name) for name in unit.power_names()}


def judge(uses: dict[str, Any], powers: dict[str, Any]) -> None:
    values = np.concatenate([np.ravel(x) for x in uses.values()] or [np.zeros(1)])
    assert np.isfinite(values).all()
    assert values.min() >= 0.0
    total = {sort: sum(x for n, x in uses.items() if sort_of(n) == sort) for sort in SORTS}
    shaft = powers.get("shaft_power", 0.0)
    assert total[ELECTRICITY] >= shaft * (1.0 - ROUNDING)
    bought = total[HEAT] - total[COOLING]
    if "heat_duty" in powers and total[HEAT] + total[COOLING] > 0.0:
        assert bought >= powers["heat_duty"] - ROUNDING * (total[HEAT] + total[COOLING])


@pytest.mark.parametrize("key", sorted(equipment()))
def test_declared_with_source(key: str) -> None:
    card = equipment()[key].card
    assert bool(card.utilities) != (key in WITHOUT)
    for use in card.utilities:
        assert use.parameter.term is not None
        assert cite(use.utility.source)
        if sort_of(use.parameter.name) in (ELECTRICITY, HEAT, COOLING):
            assert carrier(use.parameter.name) in emissions()
        assert use.as_json()["carrier"]
        if use.utility.inlet:
            assert use.utility.inlet in (equipment()[key].inlet_names() or ())


@pytest.mark.parametrize("key", [key for key in sorted(cases()) if SAMPLES or key not in LONG])
def test_taken_of_separators_and_vessels(key: str) -> None:
    case = cases()[key]

    def both(row: Any) -> Any:
        feeds = case.feeds(case.mixture, row[:FEED])
        unit = case.unit(feeds, row[FEED:])
        return jax.vmap(lambda n: taken(unit, {name: s.part(n, n, n) for name, s in feeds.items()}))(
            jnp.array([1.0, 2.0])
        )

    uses, powers = compiled(both, jnp.asarray(setting()))
    twice = {name: value[1] for name, value in uses.items()}
    uses, powers = ({name: value[0] for name, value in found.items()} for found in (uses, powers))
    judge(uses, powers)
    for name, value in uses.items():
        if purpose(name) in MOVING:
            assert twice[name] >= value * (1.0 - ROUNDING), name


@pytest.mark.parametrize("name", DRYERS if SAMPLES else QUICK_DRYERS)
def test_taken_of_dryers(name: str) -> None:
    row = jnp.full(20, 0.5)

    def once(x: Any) -> Any:
        made = DRYERS[name](x, PRODUCT["surface"], jnp.ones(()))
        return taken(made.unit, made.inlets)

    judge(*compiled(once, row))
