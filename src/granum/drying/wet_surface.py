"""Liquid boiled off a feed, and the crystals that it leaves."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core.limits import Limit
from granum.numerics import safe_divide
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream
from granum.streams.units import Limits

AS_SPECIFIED: Limits = {
    "moisture": Limit("moisture of the product against the specification", -1e-9, 1e-9, "kg/kg", "keey1978")
}


def as_specified(feed: Stream, moisture: Any) -> dict[str, Any]:
    """What is measured against ``AS_SPECIFIED`` of a dryer that stops at a moisture: a drier feed stays
    below it, since nothing is wetted.
    """
    drier = jnp.minimum(safe_divide(feed.liquid[0], feed.solid_flow) - moisture, 0.0)
    return {"moisture": jnp.where(feed.solid_flow > 0.0, drier, 0.0)}


def boiled(feed: Stream, moisture: Any, T_product: Any, T_vapor: Any, pressure: Any) -> tuple[Stream, Stream]:
    """Product of a moisture (never above the feed's), and what evaporates as a stream of vapor."""
    humid = HumidMixture(feed.mixture, alone=True)
    left = jnp.minimum(moisture * feed.solid_flow, feed.liquid[0])
    nothing = jnp.zeros_like(feed.gas)
    rest = crystallized(feed, 1.0 - safe_divide(left, feed.liquid[0], 1.0))
    product = rest.replace(gas=nothing, temperature=jnp.asarray(T_product, dtype=float))
    gas = feed.gas.at[humid.vapor].add(feed.liquid[0] - left)
    vapor = feed.replace(
        solid=jnp.zeros_like(feed.solid),
        liquid=jnp.zeros_like(feed.liquid),
        gas=gas,
        temperature=jnp.asarray(T_vapor, dtype=float),
        pressure=jnp.asarray(pressure, dtype=float),
    )
    return product, vapor


def crystallized(wet: Stream, share: Any) -> Stream:
    """Less a share of the liquid that evaporates (the first), with the same share of each solute on the solid
    of its own name, where there is one.
    """
    m = wet.mixture
    solid, liquid = wet.solid, wet.liquid.at[0].multiply(1.0 - share)
    names = [species.name for species in m.solids]
    for i, species in enumerate(m.liquids[1:], start=1):
        if species.name in names:
            row = names.index(species.name)
            there = jnp.sum(solid[row])
            spread = jnp.where(
                there > 0, solid[row] / jnp.where(there > 0, there, 1.0), 1.0 / solid[row].size
            )
            solid, liquid = (
                solid.at[row].add(wet.liquid[i] * share * spread),
                liquid.at[i].multiply(1.0 - share),
            )
    return wet.replace(solid=solid, liquid=liquid)
