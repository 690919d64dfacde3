"""What every piece of equipment takes is declared, and a possible number of dryers; the numbers of the others
are judged in ``test_equipment``, where these are solved. Units slow to compile run under
``GRANUM_RANDOM_SAMPLES``.
"""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.contracts.dryer_settings import BY_BALANCE, HUMID_GAS, PRODUCT, WITH_CELLS
from tests.contracts.taking import judge
from tests.contracts.test_equipment import equipment
from tests.contracts.unit_search import QUICK
from tests.sharing.samples import SAMPLES

from granum.core.sources import cite
from granum.core.utilities import COOLING, ELECTRICITY, HEAT, carrier, sort_of
from granum.costs.tables import emissions

# nothing is known of their size or drive, or nothing moves them
WITHOUT = {
    "comminution.double_deck_screen",
    "comminution.screen",
    "comminution.triple_deck_screen",
    "conveying.hopper",
    "crystallization.impurity_uptake",
    "dust.extraction_hood",
    "streams.adiabatic_humidifier",
    "streams.agglomerator",
    "streams.humid_mixer",
    "streams.mixer",
    "streams.splitter",
}
DRYERS = {**WITH_CELLS, **BY_BALANCE, **HUMID_GAS}
QUICK_DRYERS = ("drum", "tray", "heat pump", "coil", "burner")


def compiled(call: Any, *given: Any) -> Any:
    options: dict[str, Any] = {"compiler_options": QUICK} if jax.default_backend() == "cpu" else {}
    return jax.tree.map(np.asarray, jax.jit(call, **options)(*given))


def taken(unit: Any, inlets: dict[str, Any]) -> Any:
    """What a unit takes, and the powers that its balance takes up."""
    made = unit.operate(**inlets)
    return made.uses, {name: getattr(made.outlets, name) for name in unit.power_names()}


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


@pytest.mark.parametrize("name", DRYERS if SAMPLES else QUICK_DRYERS)
def test_taken_of_dryers(name: str) -> None:
    row = jnp.full(20, 0.5)

    def once(x: Any) -> Any:
        made = DRYERS[name](x, PRODUCT["surface"], jnp.ones(()))
        return taken(made.unit, made.inlets)

    judge(*compiled(once, row))
