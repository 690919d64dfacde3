"""Moisture that is a solution: what is dissolved in it counts as dry matter from the start, and stays on the
solid as the water leaves.

The liquor keeps its composition, that of a saturated one, so that crystal is left in proportion to the water
evaporated. Enthalpies are those of the streams: the heat of crystallization goes with the water.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.numerics import safe_divide
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream


def crystals(mixture: Mixture) -> list[int]:
    """Row among the solids of every dissolved species; a clear error names the one that is missing."""
    return [mixture.index("solids", species.name) for species in mixture.liquids[1:]]


def composition(feed: Stream) -> Any:
    """Dissolved per kilogram of water, one for each liquid after the first."""
    return safe_divide(feed.liquid[1:], feed.liquid[0])


def counted(feed: Stream) -> Stream:
    """The feed as the core counts it: water on dry matter, with everything dissolved already among the
    solids.
    """
    if len(feed.mixture.liquids) < 2:
        return feed
    sizes = safe_divide(jnp.sum(feed.solid, axis=0), feed.solid_flow, 1.0 / feed.solid[0].size)
    solid = feed.solid
    # on crystals of its kind, else on whatever solid there is
    for row, flow in zip(crystals(feed.mixture), feed.liquid[1:], strict=True):
        there = jnp.sum(solid[row])
        solid = solid.at[row].add(
            flow * jnp.where(there > 0, solid[row] / jnp.where(there > 0, there, 1.0), sizes)
        )
    return feed.replace(solid=solid, liquid=jnp.zeros_like(feed.liquid).at[0].set(feed.liquid[0]))


def moistened(dry: Stream, water: Any, dissolved: Any) -> Stream:
    """Dry matter with water on it, in which so much is dissolved per kilogram."""
    solid = dry.solid
    for row, share in zip(crystals(dry.mixture), dissolved, strict=True):
        there = jnp.sum(solid[row])
        solid = solid.at[row].multiply(1.0 - safe_divide(share * water, there))
    return dry.replace(solid=solid, liquid=water * jnp.concatenate([jnp.ones(1), dissolved]))
