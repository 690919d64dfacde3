"""Water boiled off a feed, and the humidity of the gas of a stream."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core.errors import ApplicabilityError
from granum.core.i18n import _
from granum.humid_gas.pairs import AirWater
from granum.numerics import safe_divide
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream

PAIR = AirWater()


def require_water(mixture: Mixture, *, carried: bool = False) -> None:
    """Refuse a mixture whose liquid is not water; ``carried``: also one whose gases are not a carrier and then its water vapor."""
    gases = [gas.name for gas in mixture.gases]
    if not mixture.liquids or mixture.liquids[0].name != "water" or "water" not in gases:
        first = mixture.liquids[0].name if mixture.liquids else "–"
        raise ApplicabilityError(
            _("This dryer evaporates water only: the first liquid of the mixture must be water (it is {liquid}), with water among the gases ({gases}).").format(
                liquid=first, gases=", ".join(gases) or "–")
        )  # fmt: skip
    burnt = [gas.name for gas in mixture.gases if gas.composition != ((gas.name, 1.0),)]  # fuels, of which nothing is left in a dryer
    if carried and (len(gases) - len(burnt) != 2 or gases[1] != "water"):
        raise ApplicabilityError(
            _('This dryer knows one carrier gas and its water vapor, in that order, such as gases = ["dry air", "water"]; the mixture has {gases}.').format(
                gases=", ".join(gases))
        )  # fmt: skip


def boiled(feed: Stream, moisture: Any, T_product: Any, T_vapor: Any, pressure: Any) -> tuple[Stream, Stream]:
    """Product of a moisture (never above the feed's), and what evaporates as a stream of vapor."""
    require_water(feed.mixture)
    left = jnp.minimum(moisture * feed.solid_flow, feed.liquid[0])
    nothing = jnp.zeros_like(feed.gas)
    rest = crystallized(feed, 1.0 - safe_divide(left, feed.liquid[0], 1.0))
    product = rest.replace(gas=nothing, temperature=jnp.asarray(T_product, dtype=float))
    gas = feed.gas.at[feed.mixture.index("gases", feed.mixture.liquids[0].name)].add(feed.liquid[0] - left)
    vapor = feed.replace(solid=jnp.zeros_like(feed.solid), liquid=jnp.zeros_like(feed.liquid), gas=gas,
                         temperature=jnp.asarray(T_vapor, dtype=float), pressure=jnp.asarray(pressure, dtype=float))  # fmt: skip
    return product, vapor


def crystallized(wet: Stream, share: Any) -> Stream:
    """Less a share of its water (the first liquid), with the same share of each solute on the solid of its own name, where there is one."""
    m = wet.mixture
    solid, liquid = wet.solid, wet.liquid.at[0].multiply(1.0 - share)
    names = [species.name for species in m.solids]
    for i, species in enumerate(m.liquids[1:], start=1):
        if species.name in names:
            row = names.index(species.name)
            there = jnp.sum(solid[row])
            spread = jnp.where(there > 0, solid[row] / jnp.where(there > 0, there, 1.0), 1.0 / solid[row].size)
            solid, liquid = solid.at[row].add(wet.liquid[i] * share * spread), liquid.at[i].multiply(1.0 - share)
    return wet.replace(solid=solid, liquid=liquid)


def humidity(stream: Stream) -> Any:
    """Vapor per dry gas."""
    require_water(stream.mixture, carried=True)
    return safe_divide(stream.gas[1], stream.gas[0])
