"""Water boiled off a feed, and the humidity of the gas of a stream."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.humid_gas.pairs import AirWater
from granum.numerics import safe_divide
from granum.streams.stream import Stream

PAIR = AirWater()


def boiled(feed: Stream, moisture: Any, T_product: Any, T_vapor: Any, pressure: Any) -> tuple[Stream, Stream]:
    """Product of a moisture (never above the feed's), and what evaporates as a stream of vapor."""
    left = jnp.minimum(moisture * feed.solid_flow, feed.liquid[0])
    liquid = feed.liquid.at[0].set(left)
    nothing = jnp.zeros_like(feed.gas)
    product = feed.replace(liquid=liquid, gas=nothing, temperature=jnp.asarray(T_product, dtype=float))
    gas = feed.gas.at[feed.mixture.index("gases", feed.mixture.liquids[0].name)].add(feed.liquid[0] - left)
    vapor = feed.replace(solid=jnp.zeros_like(feed.solid), liquid=jnp.zeros_like(feed.liquid), gas=gas,
                         temperature=jnp.asarray(T_vapor, dtype=float), pressure=jnp.asarray(pressure, dtype=float))  # fmt: skip
    return product, vapor


def humidity(stream: Stream) -> Any:
    """Vapor per dry gas."""
    return safe_divide(stream.gas[1], stream.gas[0])
