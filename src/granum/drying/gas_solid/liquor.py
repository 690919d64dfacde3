"""Moisture that is a solution: what is dissolved in it counts as dry matter from the start, and stays on the
solid as the water leaves; a hydrate keeps its water of crystallization.

The liquor keeps its composition, that of a saturated one, so that crystal is left in proportion to the water
evaporated; only what takes up more water than it came with dilutes it. Enthalpies are those of the streams:
the heat of crystallization goes with the water.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core.errors import InputError
from granum.core.i18n import _
from granum.numerics import safe_divide
from granum.streams.from_materials import taken_up_name
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream


class Deposit(NamedTuple):
    """The crystal that a dissolved species leaves: its row among the solids, and the solvent that it binds
    per kilogram dissolved.
    """

    row: int
    bound: float


@lru_cache(maxsize=256)
def deposits(mixture: Mixture) -> tuple[Deposit, ...]:
    """Of every dissolved species the solid of its name, else its first crystal in the mixture."""
    return tuple(_deposit(mixture, i) for i in range(1, len(mixture.liquids)))


@lru_cache(maxsize=256)
def crystallizing(mixture: Mixture) -> tuple[tuple[int, Deposit], ...]:
    """Places of the liquids that crystallize as the first one leaves, with what they leave: all but second
    solvents, which stay.
    """
    solvents, names = mixture.materials.names("fluid"), [solid.name for solid in mixture.solids]
    return tuple(
        (i, _deposit(mixture, i))
        for i, liquid in enumerate(mixture.liquids)
        if i > 0 and (liquid.name not in solvents or liquid.name in names)
    )


def _deposit(mixture: Mixture, liquid: int) -> Deposit:
    solute, solvent = (dict(mixture.liquids[i].composition) for i in (liquid, 0))
    name = mixture.liquids[liquid].name
    same = [i for i, solid in enumerate(mixture.solids) if solid.name == name]
    if same:
        return Deposit(same[0], 0.0)
    taken_up = {taken_up_name(species.name) for species in mixture.liquids}  # grows within other crystals
    for row, solid in enumerate(mixture.solids):
        if solid.name in taken_up:
            continue
        parts = dict(solid.composition)
        held = sum(parts.get(component, 0.0) for component in solute)
        if held > 0.0 and set(parts) <= {*solute, *solvent}:
            return Deposit(row, (1.0 - held) / held)
    raise InputError(
        _(
            "'{solute}' is dissolved in the moisture and stays when that leaves, but the mixture has no "
            "solid of it: add its crystal to the solids."
        ).format(solute=name)
    )


def held(mixture: Mixture, dissolved: Any) -> Any:
    """Crystal left per kilogram of the water that leaves, for every dissolved species."""
    return jnp.stack([(1.0 + d.bound) * c for d, c in zip(deposits(mixture), dissolved, strict=True)])


def _bound(mixture: Mixture, dissolved: Any) -> Any:
    """Water that these amounts bind as they crystallize."""
    return sum((d.bound * c for d, c in zip(deposits(mixture), dissolved, strict=True)), 0.0)


def composition(feed: Stream) -> Any:
    """Dissolved per kilogram of the water that can leave, one for each liquid after the first."""
    solutes = feed.liquid[1:]
    return safe_divide(solutes, feed.liquid[0] - _bound(feed.mixture, solutes))


def counted(feed: Stream) -> Stream:
    """The feed as the core counts it: the water that can leave on dry matter, with everything dissolved
    already among the solids.
    """
    m = feed.mixture
    if len(m.liquids) < 2:
        return feed
    solutes = feed.liquid[1:]
    sizes = safe_divide(jnp.sum(feed.solid, axis=0), feed.solid_flow, 1.0 / feed.solid[0].size)
    solid = feed.solid
    # on crystals of its kind, else on whatever solid there is
    for place, flow in zip(deposits(m), held(m, solutes), strict=True):
        there = jnp.sum(solid[place.row])
        solid = solid.at[place.row].add(
            flow * jnp.where(there > 0, solid[place.row] / jnp.where(there > 0, there, 1.0), sizes)
        )
    water = feed.liquid[0] - _bound(m, solutes)
    return feed.replace(solid=solid, liquid=jnp.zeros_like(feed.liquid).at[0].set(water))


def moistened(dry: Stream, water: Any, dissolved: Any) -> Stream:
    """Dry matter with water on it that can leave, in which so much is dissolved per kilogram: no more than
    there is, where it has taken up water and its liquor is diluted.
    """
    m, solid, kept = dry.mixture, dry.solid, []
    for place, share in zip(deposits(m), held(m, dissolved) if len(m.liquids) > 1 else (), strict=True):
        asked = safe_divide(share * water, jnp.sum(solid[place.row]))  # of the crystals there are
        solid = solid.at[place.row].multiply(1.0 - jnp.minimum(asked, 1.0))
        kept.append(1.0 / jnp.maximum(asked, 1.0))
    dissolved = dissolved * jnp.stack(kept) if kept else dissolved
    whole = jnp.concatenate([jnp.reshape(1.0 + _bound(m, dissolved), (1,)), dissolved])
    return dry.replace(solid=solid, liquid=water * whole)
