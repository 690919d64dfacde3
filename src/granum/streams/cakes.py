"""Parting a slurry into a wet cake, a filtrate and washings: the balance that filters and filtering
centrifuges share.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.numerics.smooth import safe_divide
from granum.streams.stream import Stream, empty, settled


class Filtered(NamedTuple):
    """Wet cake, mother filtrate, and the wash filtrate with what it displaced (empty without wash liquor)."""

    cake: Stream
    filtrate: Stream
    washings: Stream


def void_flow(feed: Stream, recovery: Any, void_fraction: Any) -> Any:
    """Void volume of the cake formed per time, m³/s."""
    return recovery * feed.solid_flow / feed.solid_density * void_fraction / (1.0 - void_fraction)


def solid_diameter(feed: Stream, given: Any = None) -> Any:
    """Surface–volume diameter of the solid, m, unless one is given; 0.1 mm when there is no solid."""
    if given is not None:
        return given
    inverse = jnp.sum(feed.size_fractions / feed.mixture.sizes)
    return jnp.where(inverse > 0, 1.0 / jnp.where(inverse > 0, inverse, 1.0), 1e-4)


def sinking_solids(feed: Stream) -> tuple[Any, Any]:
    """Share by mass of the solids that is heavier than the liquid, 1 of none, and its mean density, kg/m³;
    that of all solids where none sinks.
    """
    density = feed.mixture.densities("solids", feed.temperature)
    sinking = jnp.where(density > feed.liquid_density, feed.solid_by_species, 0.0)
    some = jnp.sum(sinking) > 0.0
    mean = jnp.where(some, jnp.sum(sinking), 1.0) / jnp.where(some, jnp.sum(sinking / density), 1.0)
    return safe_divide(jnp.sum(sinking), feed.solid_flow, otherwise=1.0), jnp.where(
        some, mean, feed.solid_density
    )


def part_cake(
    feed: Stream, wash: Stream | None, *, recovery: Any, void_fraction: Any, saturation: Any, left: Any
) -> Filtered:
    """The three streams: the cake takes its voids full of mother liquor, washing leaves the fraction ``left``
    of that and puts wash liquor in its place, draining keeps the share ``saturation``. Cake and washings
    leave at their adiabatic mixing temperature.
    """
    void, liquid = void_flow(feed, recovery, void_fraction), feed.liquid_volume_flow
    share = jnp.minimum(void, liquid) / jnp.where(liquid > 0, liquid, 1.0)
    kept = feed.part(solid=recovery, liquid=share)
    through = feed.part(solid=1.0 - recovery, liquid=1.0 - share, gas=1.0)
    if wash is None:
        cake = kept.part(solid=1.0, liquid=saturation)
        return Filtered(
            cake,
            through.replace(liquid=feed.liquid - cake.liquid),
            empty(feed.mixture, feed.temperature, feed.pressure),
        )
    flow = wash.liquid_volume_flow
    stays = jnp.minimum((1.0 - left) * jnp.minimum(void, liquid) / jnp.where(flow > 0, flow, 1.0), 1.0)
    joined = kept + wash
    cake = joined.replace(
        liquid=saturation * (left * kept.liquid + stays * wash.liquid), gas=0.0 * joined.gas
    )
    washings = joined.replace(solid=0.0 * joined.solid, liquid=joined.liquid - cake.liquid)
    cake, washings = settled(kept.enthalpy_flow + wash.enthalpy_flow, cake, washings)
    return Filtered(cake, through, washings)
