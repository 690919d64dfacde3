"""Streams that tests begin with: water with heat capacities that can be reckoned in the head, the recycle
through one unit, wet solids and humid air.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.flowsheet import Flowsheet
from granum.streams.equipment.basics import Heater, Mixer, Splitter
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream, empty
from granum.streams.units import Unit

WATER = Species("water", (("water", 1.0),), (1000.0,), (4000.0,), 0.0, 0.018)
ONLY_WATER = Mixture((), (WATER,), (), (1e-6, 1e-3))
FEED = empty(ONLY_WATER, 330.0).replace(liquid=jnp.array([1.0]))


def loop(middle: Unit, side_fraction: float = 0.7) -> Flowsheet:
    """1 kg/s of water to a mixer, a unit and a splitter whose side goes back, cooled to 300 K."""
    units = {
        "mix": Mixer(),
        "middle": middle,
        "split": Splitter(side_fraction=side_fraction),
        "cool": Heater(temperature=300.0),
    }
    links = {
        "feed": ("", "mix.fresh"),
        "mixed": ("mix", "middle.feed"),
        "hot": ("middle", "split"),
        "back_hot": ("split.side", "cool"),
        "back": ("cool", "mix.back"),
    }
    return Flowsheet(units, {"feed": FEED}, links)


def wet(mixture: Mixture, flow: Any, moisture: Any, temperature: float = 300.0) -> Stream:
    """Dry flow of the one solid, alike in every class, with moisture on the dry basis."""
    n = len(mixture.sizes)
    return empty(mixture, temperature).replace(
        solid=jnp.full((1, n), flow / n), liquid=jnp.array([flow * moisture])
    )


def air(mixture: Mixture, flow: Any, humidity: Any, temperature: float) -> Stream:
    """Dry flow of air with its vapor, kg/kg."""
    return empty(mixture, temperature).replace(gas=jnp.array([flow, flow * humidity]))
