"""Which species of a stream play solute, solvent, crystal and vapor in a crystallizer."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core.errors import CaseError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.crystallization.vessels.crystals import Crystal, crystals_at, saturation
from granum.crystallization.vessels.msmpr import Feed
from granum.materials.double_salts import DOUBLE_SALTS
from granum.streams.equilibrium import HumidMixture
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream, empty

BOILED_DRY = (
    "More solvent would evaporate than there is: give less heat, less evaporation, a cooler feed or more "
    "solvent."
)
TOO_COLD = (
    "The feed is too cold to boil at the temperature of the vessel: give a warmer feed, a lower temperature "
    "or more heat."
)
DISSOLVES = (
    "Nothing boils: crystals of the feed dissolve, and that takes more heat than the feed brings. Give a "
    "feed with more dissolved, a lower temperature or more heat."
)
LARGEST = "crystals in the largest size class, which takes what is larger"
SMALLEST = "crystals in the smallest size class, which takes what is smaller"


class Roles(NamedTuple):
    """Positions of the species in the arrays of a stream; ``vapor`` is None without a vapor of the
    solvent.
    """

    solid: int
    solute: int
    solvent: int
    vapor: int | None
    solute_fraction: float


def roles(mixture: Mixture, solid: str, solvent: str) -> Roles:
    """Find the species: the crystal by name (or the first solid), the liquid that is its anhydrous part, the
    solvent.
    """
    if not mixture.solids:
        raise CaseError(_("The mixture has no solid that could crystallize."))
    mixture.require("liquids")
    s = mixture.index("solids", solid) if solid else 0
    w = mixture.index("liquids", solvent) if solvent else 0
    component = mixture.liquids[w].composition[0][0]
    anhydrous = [(name, share) for name, share in mixture.solids[s].composition if name != component]
    pure = [
        i
        for i, item in enumerate(mixture.liquids)
        if [n for n, _share in item.composition] == [n for n, _share in anhydrous]
    ]
    if not pure and mixture.solids[s].name in DOUBLE_SALTS:
        raise CaseError(
            _(
                "'{crystal}' is a double salt, of which no kinetics are known here: it forms in "
                "'crystallization.two_salt_crystallizer' and in evaporators. Name another crystal as 'solid'."
            ).format(crystal=mixture.solids[s].name)
        )
    if not anhydrous or not pure:
        raise CaseError(
            _(
                "The mixture has no dissolved form of '{crystal}': a liquid species made of {parts} "
                "alone is needed."
            ).format(crystal=mixture.solids[s].name, parts=", ".join(n for n, _share in anhydrous) or "—")
        )
    return Roles(s, pure[0], w, vapor_of(mixture, w), sum(share for _name, share in anhydrous))


def vapor_of(mixture: Mixture, liquid: int) -> int | None:
    """The place among the gases of the vapor of a liquid; None where there is none."""
    component = mixture.liquids[liquid].composition[0][0]
    return next(
        (i for i, gas in enumerate(mixture.gases) if [n for n, _x in gas.composition] == [component]), None
    )


def refuse_boiling(vapor: Any, product: Stream, feed: Stream, found: Roles, card: Any) -> None:
    """Record that a vessel cannot boil as asked: no solvent would be left, or solvent that is not there would
    have to condense, because the feed is cold or because its crystals dissolve.
    """
    least = -1e-12 * feed.mass_flow
    solvent = product.liquid[found.solvent]
    dissolve = (product.temperature <= feed.temperature) & (product.solid_flow < feed.solid_flow)
    unsolved(solvent >= least, card, reason=BOILED_DRY)
    unsolved((vapor >= least) | dissolve, card, reason=TOO_COLD)
    unsolved((vapor >= least) | ~dissolve, card, reason=DISSOLVES)


def given_off(feed: Stream, found: Roles, evaporation: Any, temperature: Any) -> Stream:
    """What evaporates, with gas that came in the feed, at the pressure at which the solvent boils there,
    though no more than that of the feed.
    """
    T, gas, pressure = (
        jnp.asarray(temperature, dtype=float),
        feed.gas,
        jnp.asarray(feed.pressure, dtype=float),
    )
    if found.vapor is not None:
        gas = gas.at[found.vapor].add(evaporation)
        solvent = feed.mixture.liquids[0].name
        if (
            found.solvent == 0
            and solvent == feed.mixture.gases[found.vapor].name
            and solvent in feed.mixture.materials.names("fluid")
        ):
            boiling = HumidMixture(feed.mixture, alone=True).saturation_pressure(T)
            pressure = jnp.where(evaporation > 0.0, jnp.minimum(boiling, pressure), pressure)
    return empty(feed.mixture, T).replace(gas=gas, pressure=pressure)


def crystal_of(mixture: Mixture, found: Roles, temperature: Any, volume_shape_factor: Any) -> Crystal:
    """The crystal as the vessel models take it."""
    return Crystal(
        mixture.densities("solids", temperature)[found.solid], volume_shape_factor, found.solute_fraction
    )


def feed_of(stream: Stream, found: Roles) -> Feed:
    """Solute, solvent and crystals by size class of a stream."""
    solid = stream.solid[found.solid]
    return Feed(
        stream.liquid[found.solute],
        stream.liquid[found.solvent],
        jnp.sum(solid, axis=tuple(range(1, solid.ndim))),
    )


def saturated_at(feed: Stream, found: Roles, soluble: Any, temperature: Any) -> Stream:
    """The liquor of the feed at a temperature, what it cannot hold there taken out."""
    entering, x = feed_of(feed, found), found.solute_fraction
    ratio = saturation(soluble, temperature, entering.solvent)
    over = jnp.maximum(crystals_at(entering.solute, entering.solvent, ratio, x), 0.0)
    liquid = feed.liquid.at[found.solute].add(-x * over).at[found.solvent].add(-(1.0 - x) * over)
    return feed.replace(liquid=liquid, temperature=jnp.asarray(temperature, dtype=float))


def with_crystals(stream: Stream, found: Roles, crystals: Any) -> Any:
    """The stream's solid array with new crystal masses by class; further axes keep the shares the feed has,
    or the first class.
    """
    solid = stream.solid[found.solid]
    inner = tuple(range(1, solid.ndim))
    total = jnp.sum(solid, axis=inner, keepdims=True)
    whole = jnp.sum(solid, axis=0, keepdims=True)
    amount = jnp.sum(solid)
    fresh = jnp.zeros_like(whole).reshape(-1).at[0].set(1.0).reshape(whole.shape)
    share = jnp.where(amount > 0, whole / jnp.where(amount > 0, amount, 1.0), fresh)
    own = jnp.where(total > 0, solid / jnp.where(total > 0, total, 1.0), share)
    return stream.solid.at[found.solid].set(own * crystals.reshape((-1,) + (1,) * len(inner)))


def suspension_left(feed: Stream, found: Roles, solid: Any, evaporated: Any, temperature: Any) -> Stream:
    """The feed with new crystals, whose solute and solvent the liquor gains or loses; what has evaporated
    (kg/s) leaves it too.
    """
    dissolved = jnp.sum(feed.solid[found.solid]) - jnp.sum(solid[found.solid])
    x = found.solute_fraction
    solute = feed.liquid[found.solute] + x * dissolved
    solvent = feed.liquid[found.solvent] + (1.0 - x) * dissolved - evaporated
    liquid = feed.liquid.at[found.solute].set(solute).at[found.solvent].set(solvent)
    return feed.replace(solid=solid, liquid=liquid, temperature=jnp.asarray(temperature, dtype=float))
