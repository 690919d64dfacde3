"""Screens: one, two or three decks, each with its partition curve."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import Fraction, Law, Length, MassFlow
from granum.numerics import MonotoneCubic
from granum.numerics.smooth import safe_divide
from granum.particles.distributions import SizeDistribution
from granum.streams.stream import Stream
from granum.streams.units import Unit

Deck = Annotated[Any, Law("partition_curve")]


def _divided(feed: Stream, deck: Any, liquid_share: Any) -> tuple[Stream, Stream]:
    """What stays on a deck and what passes it; nothing is lost. The gas passes."""
    edges = jnp.asarray(feed.mixture.edges)
    stays = feed.by_size(deck.over(edges[:-1], edges[1:]))
    return feed.part(stays, liquid_share, 0.0), feed.part(1.0 - stays, 1.0 - liquid_share, 1.0)


def size_passing(stream: Stream, part: float = 0.8) -> Any:
    """Size that a part of the solid of a stream passes, m; that of an even spread over the classes when there
    is no solid.

    Read off the monotone cubic through the cumulative curve over the logarithm of size: a spread that is even
    inside each class puts it up to a tenth too high in wide classes.
    """
    solid = stream.solid_by_size
    amounts = jnp.where(stream.solid_flow > 0, solid, jnp.ones_like(solid))
    edges = jnp.asarray(stream.mixture.edges)
    if len(stream.mixture.edges) < 3:  # one class has no curve
        return SizeDistribution.from_amounts(edges, amounts).percentile(part)
    below = jnp.concatenate([jnp.zeros(1), jnp.cumsum(amounts)]) / jnp.sum(amounts)
    begin = jnp.where(edges > 0.0, edges, 0.5 * edges[1])  # of classes that begin at nothing
    return jnp.exp(MonotoneCubic.through(jnp.log(begin), below).inverse(part)[0])


def _parts_below(stream: Stream, size: Any) -> Any:
    """Part of each size class below a size."""
    edges = jnp.asarray(stream.mixture.edges)
    return jnp.clip((size - edges[:-1]) / jnp.diff(edges), 0.0, 1.0)


def fraction_below(stream: Stream, size: Any) -> Any:
    """Mass fraction of the solid below a size."""
    return jnp.sum(stream.size_fractions * _parts_below(stream, size))


class Screened(NamedTuple):
    """What stays on the screen and what passes it."""

    oversize: Stream
    undersize: Stream


class ScreenFigures(NamedTuple):
    """Figures of a screen."""

    mass_flow_oversize: MassFlow
    mass_flow_undersize: MassFlow
    cut_size: Length
    passing_fraction_feed: Fraction
    screening_recovery: Fraction
    screening_rejection: Fraction
    screening_effectiveness: Fraction


@equipment("screen", source="wills2016; mccabe2005, ch. 29", title="Screen")
class Screen(Unit):
    """A single deck: each size class is divided by the partition curve, averaged over the class.

    The desired product of the effectiveness is the material finer than the cut size. The liquid follows its
    own split; gas passes.
    """

    separation: Deck
    liquid_split_oversize: Fraction = 0.0

    def outlets(self, inside: None, feed: Stream) -> Screened:
        return Screened(*_divided(feed, self.separation, self.liquid_split_oversize))

    def figures(self, inside: None, outlets: Screened, feed: Stream) -> ScreenFigures:
        size = self.separation.cut_size
        fed, passed = feed.solid_by_size, outlets.undersize.solid_by_size
        below = _parts_below(feed, size)
        recovery = safe_divide(jnp.sum(passed * below), jnp.sum(fed * below))
        # summed as it is: a little coarse feed as a difference of large flows would be rounding alone
        rejection = 1.0 - safe_divide(jnp.sum(passed * (1.0 - below)), jnp.sum(fed * (1.0 - below)))
        return ScreenFigures(
            outlets.oversize.mass_flow,
            outlets.undersize.mass_flow,
            size,
            fraction_below(feed, size),
            recovery,
            rejection,
            recovery * rejection,
        )


class TwoDecks(NamedTuple):
    """Three products of two decks."""

    oversize: Stream
    middlings: Stream
    undersize: Stream


class TwoDeckFigures(NamedTuple):
    """Figures of a double-deck screen."""

    mass_flow_oversize: MassFlow
    mass_flow_middlings: MassFlow
    mass_flow_undersize: MassFlow


@equipment("double_deck_screen", source="wills2016", title="Double-deck screen")
class DoubleDeckScreen(Unit):
    """Two decks one below the other: what passes the upper one falls on the lower one."""

    upper_deck: Deck
    lower_deck: Deck
    liquid_split_oversize: Fraction = 0.0

    def outlets(self, inside: None, feed: Stream) -> TwoDecks:
        oversize, rest = _divided(feed, self.upper_deck, self.liquid_split_oversize)
        return TwoDecks(oversize, *_divided(rest, self.lower_deck, self.liquid_split_oversize))

    def figures(self, inside: None, outlets: TwoDecks, feed: Stream) -> TwoDeckFigures:
        return TwoDeckFigures(*(s.mass_flow for s in outlets))


class ThreeDecks(NamedTuple):
    """Four products of three decks."""

    oversize: Stream
    middlings_coarse: Stream
    middlings_fine: Stream
    undersize: Stream


class ThreeDeckFigures(NamedTuple):
    """Figures of a triple-deck screen."""

    mass_flow_oversize: MassFlow
    mass_flow_middlings_coarse: MassFlow
    mass_flow_middlings_fine: MassFlow
    mass_flow_undersize: MassFlow


@equipment("triple_deck_screen", source="wills2016", title="Triple-deck screen")
class TripleDeckScreen(Unit):
    """Three decks one below the other, coarse to fine."""

    upper_deck: Deck
    middle_deck: Deck
    lower_deck: Deck
    liquid_split_oversize: Fraction = 0.0

    def outlets(self, inside: None, feed: Stream) -> ThreeDecks:
        oversize, rest = _divided(feed, self.upper_deck, self.liquid_split_oversize)
        coarse, rest = _divided(rest, self.middle_deck, self.liquid_split_oversize)
        return ThreeDecks(oversize, coarse, *_divided(rest, self.lower_deck, self.liquid_split_oversize))

    def figures(self, inside: None, outlets: ThreeDecks, feed: Stream) -> ThreeDeckFigures:
        return ThreeDeckFigures(*(s.mass_flow for s in outlets))
