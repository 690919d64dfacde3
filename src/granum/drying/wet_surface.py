"""Liquid boiled off a feed, and the crystals that it leaves."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core.limits import Limit
from granum.drying.gas_solid.liquor import crystallizing
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
    share = dried_share(feed, moisture)
    nothing = jnp.zeros_like(feed.gas)
    product = crystallized(feed, share).replace(gas=nothing, temperature=jnp.asarray(T_product, dtype=float))
    gas = feed.gas.at[humid.vapor].add(leaving(feed, share))
    vapor = feed.replace(
        solid=jnp.zeros_like(feed.solid),
        liquid=jnp.zeros_like(feed.liquid),
        gas=gas,
        temperature=jnp.asarray(T_vapor, dtype=float),
        pressure=jnp.asarray(pressure, dtype=float),
    )
    return product, vapor


def dried_share(feed: Stream, moisture: Any) -> Any:
    """Of the liquor that is gone where so much of its solvent is left per solid of the feed."""
    feed.mixture.require("liquids")
    left = jnp.minimum(moisture * feed.solid_flow, feed.liquid[0])
    return 1.0 - safe_divide(left, feed.liquid[0], 1.0)


def _wanted(wet: Stream) -> Any:
    """Solvent that all that is dissolved would bind in its crystals, kg/s."""
    return sum((place.bound * wet.liquid[i] for i, place in crystallizing(wet.mixture)), jnp.zeros(()))


def leaving(wet: Stream, share: Any) -> Any:
    """Solvent that leaves as vapor with a share of the liquor: not what hydrates bind."""
    return share * jnp.maximum(wet.liquid[0] - _wanted(wet), 0.0)


def evaporated(feed: Stream, product: Stream) -> Any:
    """Solvent that has left a feed as vapor, kg/s."""
    return leaving(feed, 1.0 - safe_divide(product.liquid[0], feed.liquid[0], 1.0))


def crystallized(wet: Stream, share: Any) -> Stream:
    """Less a share of the liquor, whose solutes are left on crystals of their kind, hydrates with their water
    as far as there is any; a second solvent stays.
    """
    solid, liquid = wet.solid, wet.liquid.at[0].multiply(1.0 - share)
    enough = jnp.minimum(safe_divide(wet.liquid[0], _wanted(wet), 1.0), 1.0)
    for i, place in crystallizing(wet.mixture):
        there = jnp.sum(solid[place.row])
        spread = jnp.where(
            there > 0, solid[place.row] / jnp.where(there > 0, there, 1.0), 1.0 / solid[place.row].size
        )
        gone = share * (enough if place.bound > 0.0 else 1.0)
        crystals = gone * wet.liquid[i] * (1.0 + place.bound)
        solid, liquid = solid.at[place.row].add(crystals * spread), liquid.at[i].multiply(1.0 - gone)
    return wet.replace(solid=solid, liquid=liquid)
