"""A loop that the quick solver does not settle is solved in a study as it is alone: by the next solver of the
ladder.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core.kinds import MassFlow
from granum.flowsheet import Flowsheet
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream, empty
from granum.streams.units import Unit
from granum.studies.lines import LineSubject
from granum.studies.study import Study

FORMS, MIXED = 6, 3  # the quick solver settles some settings of this line and not others
WATER = Mixture(
    (),
    tuple(Species(f"form {i}", (("water", 1.0),), (1000.0,), (4000.0,)) for i in range(FORMS)),
    (),
    (1e-6, 1e-3),
)
COUPLING = np.random.default_rng(1).normal(size=(60, FORMS, FORMS)) * 1.5
SHIFT = np.random.default_rng(2).normal(size=(60, FORMS))


class Outlets(NamedTuple):
    product: Stream
    recycle: Stream


class Figures(NamedTuple):
    recycled: MassFlow


class Scrambler(Unit):
    """Turns forms of water into one another by a map that leads far from where it settles; mass and energy
    stay what they are.
    """

    coupling: Any
    shift: Any

    def outlets(self, inside: None, feed: Stream, recycle: Stream) -> Outlets:
        both = feed + recycle
        u = 2.0 * FORMS * recycle.liquid - 1.0
        new = 1.0 + 0.9 * jnp.tanh(2.0 * (self.coupling @ u) + self.shift + 0.02 * (feed.temperature - 300.0))
        returned = new / (2.0 * FORMS)
        left = (jnp.sum(both.liquid) - jnp.sum(returned)) * jnp.ones(FORMS) / FORMS
        return Outlets(both.replace(liquid=left), both.replace(liquid=returned))

    def figures(self, inside: None, outlets: Outlets, feed: Stream, recycle: Stream) -> Figures:
        return Figures(outlets.recycle.liquid_flow)


def line(i: int) -> Flowsheet:
    feed = empty(WATER, 300.0).replace(liquid=jnp.ones(FORMS) / FORMS * 3.0)
    links = {
        "fresh": ("", "tank.feed"),
        "back": ("tank.recycle", "tank.recycle"),
        "out": ("tank.product", ""),
    }
    return Flowsheet(
        {"tank": Scrambler(jnp.asarray(COUPLING[i]), jnp.asarray(SHIFT[i]))}, {"fresh": feed}, links
    )


def settled(i: int, temperatures: np.ndarray, y: np.ndarray) -> np.ndarray:
    """By how much each recycle found is not what the map gives back for it."""
    flows = y[:, :1] * y[:, 1:]
    new = np.tanh(
        2.0 * (2.0 * FORMS * flows - 1.0) @ COUPLING[i].T + SHIFT[i] + 0.02 * (temperatures - 300.0)
    )
    return np.abs(flows - (1.0 + 0.9 * new) / (2.0 * FORMS)).max(axis=1)


def test_cases_that_the_quick_solver_leaves_are_tried_with_the_next() -> None:
    outputs = ["back.liquid_flow", *(f"back.liquid.form {i}" for i in range(FORMS))]
    over = {
        "fresh.temperature": {"from": "300 K", "to": "340 K", "steps": 3},
        "fresh.pressure": {"from": "1 bar", "to": "2 bar", "steps": 2},  # which changes nothing
    }
    table = {"kind": "map", "over": over, "outputs": outputs}
    outcome = Study.of("temperatures", table, LineSubject.of(line(MIXED)), {}).run()
    found = outcome.cases
    assert found.fine.all()
    assert 0 < (found.rungs > 0).sum() < len(found.rungs)
    assert settled(MIXED, found.x[:, :1], found.y).max() < 1e-9
    assert outcome.as_json()["counts"]["patient"] == (found.rungs > 0).sum()
