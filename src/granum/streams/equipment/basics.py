"""Mixing, splitting, heating and cooling."""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce
from operator import add
from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import Fraction, Mass, MassFlow, Power, Temperature, Time
from granum.numerics.smooth import safe_divide
from granum.streams.stream import Stream
from granum.streams.turnover import Turnover
from granum.streams.units import Dynamic, Unit, Utilities
from granum.streams.utilities import COOLED, HEATED, STIRRED, cooled, heated, suspended


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

    def outlets(self, inside: None, **inlets: Stream) -> Single:
        return Single(reduce(add, inlets.values()))

    def figures(self, inside: None, outlets: Single, **inlets: Stream) -> Mixed:
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

    def outlets(self, inside: None, feed: Stream) -> TwoWays:
        f = self.side_fraction
        return TwoWays(feed.part(1 - f, 1 - f, 1 - f), feed.part(f, f, f))

    def figures(self, inside: None, outlets: TwoWays, feed: Stream) -> SplitFigures:
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

    utilities: ClassVar[Utilities] = HEATED | COOLED

    def outlets(self, inside: None, feed: Stream) -> Heated:
        product = feed.replace(temperature=self.temperature)
        return Heated(product, product.enthalpy_flow - feed.enthalpy_flow)

    def figures(self, inside: None, outlets: Heated, feed: Stream) -> HeaterFigures:
        return HeaterFigures(outlets.heat_duty, outlets.product.temperature)

    def drawn(self, inside: None, outlets: Heated, figures: HeaterFigures, feed: Stream) -> dict[str, Any]:
        hot, cold = outlets.product.temperature, jnp.minimum(feed.temperature, outlets.product.temperature)
        return heated(outlets.heat_duty, hot) | cooled(outlets.heat_duty, cold)


class TankFigures(NamedTuple):
    """Figures of a stirred tank."""

    residence_time: Time
    temperature: Temperature


class Contents(NamedTuple):
    """What a tank holds: kg of each species and class, and J."""

    solid: Any
    liquid: Any
    enthalpy: Any


@equipment(
    "stirred_tank",
    source="levenspiel1999, ch. 6; himmelblau2012, ch. 11",
    title="Stirred tank of constant holdup",
    equation=r"\frac{dm_i}{dt} = \dot m_{i,in} - \frac{\dot m_{in}}{M}\,m_i",
)
class StirredTank(Unit, Dynamic):
    """A full, well-mixed vessel of slurry that overflows: what leaves has the composition inside. It evens
    out disturbances in time.

    In steady state it passes its feed. A start-up begins with the tank full of the first liquid at 25 °C. Gas
    passes at once.
    """

    mass: Mass

    utilities: ClassVar[Utilities] = STIRRED

    def outlets(self, inside: None, feed: Stream) -> Single:
        return Single(feed)

    def figures(self, inside: None, outlets: Single, feed: Stream) -> TankFigures:
        flow = feed.solid_flow + feed.liquid_flow
        return TankFigures(self.mass / jnp.where(flow > 0, flow, 1.0), outlets.product.temperature)

    def drawn(self, inside: None, outlets: Single, figures: TankFigures, feed: Stream) -> dict[str, Any]:
        density = safe_divide(feed.solid_flow + feed.liquid_flow, feed.slurry_volume_flow, 1000.0)
        return {"electric_power_agitator": suspended(feed, self.mass / density)}

    def initial_holdup(self, mixture: Any) -> Contents:
        first = jnp.zeros(len(mixture.liquids)).at[0].set(1.0) * self.mass
        return Contents(
            jnp.zeros(mixture.solid_shape), first, jnp.sum(first * mixture.enthalpies("liquids", 298.15))
        )

    def steady_holdup(self, inlets: Mapping[str, Stream]) -> Contents:
        feed = inlets["feed"]
        time = self.mass / jnp.maximum(feed.solid_flow + feed.liquid_flow, 1e-12)
        return Contents(feed.solid * time, feed.liquid * time, _condensed(feed).enthalpy_flow * time)

    def held_mass(self, state: Contents) -> Any:
        return jnp.sum(state.solid) + jnp.sum(state.liquid)

    def advance(
        self,
        state: Contents,
        before: Mapping[str, Stream],
        after: Mapping[str, Stream],
        step: Any,
        prepared: Any,
    ) -> tuple[Contents, Single]:
        then, now = _condensed(before["feed"]), _condensed(after["feed"])
        new = Turnover.of(0.5 * (then.mass_flow + now.mass_flow) / self.mass, step).through
        full = Contents(
            new(state.solid, then.solid, now.solid),
            new(state.liquid, then.liquid, now.liquid),
            new(state.enthalpy, then.enthalpy_flow, now.enthalpy_flow),
        )
        # A flow that changes within the step leaves the mass a third-order error off its constant.
        share = self.mass / self.held_mass(full)
        state = Contents(full.solid * share, full.liquid * share, full.enthalpy * share)
        out = now.mass_flow / self.mass
        product = now.replace(solid=state.solid * out, liquid=state.liquid * out).at_enthalpy(
            state.enthalpy * out
        )
        return state, Single(product.replace(gas=after["feed"].gas))


def _condensed(stream: Stream) -> Stream:
    return stream.replace(gas=0.0 * stream.gas)
