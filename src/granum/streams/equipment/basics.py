"""Mixing, splitting, heating and cooling."""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce
from operator import add
from typing import Any, NamedTuple

from granum.core import equipment
from granum.core.kinds import Fraction, MassFlow, Power, Temperature
from granum.streams.stream import Stream
from granum.streams.units import Unit


class Single(NamedTuple):
    """One outlet."""

    product: Stream


class Mixed(NamedTuple):
    """Figures of a mixing point."""

    mass_flow: MassFlow
    temperature: Temperature


@equipment("mixer", source="himmelblau2012, ch. 9", title="Mixer")
class Mixer(Unit):
    """Joins any number of streams adiabatically, at the lowest of their pressures."""

    def __call__(self, **inlets: Stream) -> Single:
        return Single(reduce(add, inlets.values()))

    def results(self, inlets: Mapping[str, Stream], outlets: Single) -> Mixed:
        return Mixed(outlets.product.mass_flow, outlets.product.temperature)


class TwoWays(NamedTuple):
    """The stream that goes on and the one that is taken off."""

    product: Stream
    side: Stream


class SplitFigures(NamedTuple):
    """Figures of a splitter."""

    mass_flow: MassFlow
    mass_flow_side: MassFlow


@equipment("splitter", source="himmelblau2012, ch. 6", title="Splitter")
class Splitter(Unit):
    """Divides a stream without changing it: a purge, a bypass, a recycle ratio.

    ``side_fraction`` is the share of the mass that leaves at ``side``.
    """

    side_fraction: Fraction

    def __call__(self, feed: Stream) -> TwoWays:
        f = self.side_fraction
        return TwoWays(feed.part(1 - f, 1 - f, 1 - f), feed.part(f, f, f))

    def results(self, inlets: Mapping[str, Stream], outlets: TwoWays) -> SplitFigures:
        return SplitFigures(outlets.product.mass_flow, outlets.side.mass_flow)


class Heated(NamedTuple):
    """Heated or cooled stream and the heat taken up."""

    product: Stream
    heat_duty: Any


class HeaterFigures(NamedTuple):
    """Figures of a heater or cooler."""

    heat_duty: Power
    temperature: Temperature


@equipment("heater", source="himmelblau2012, ch. 9", title="Heater or cooler")
class Heater(Unit):
    """Brings a stream to a temperature without change of phase; the duty is negative for cooling."""

    temperature: Temperature

    def __call__(self, feed: Stream) -> Heated:
        product = feed.replace(temperature=self.temperature)
        return Heated(product, product.enthalpy_flow - feed.enthalpy_flow)

    def results(self, inlets: Mapping[str, Stream], outlets: Heated) -> HeaterFigures:
        return HeaterFigures(outlets.heat_duty, outlets.product.temperature)
