"""A dryer whose gas blows through a layer that is carried along: what belts and grain columns share."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

import jax
import jax.numpy as jnp

from granum.drying.gas_solid.cells import Contact, Network, Profile
from granum.drying.gas_solid.column import Passage, Zone, mean_moisture, pass_zones, product_enthalpy
from granum.drying.gas_solid.dryer import Dried, Dryer, DryerFigures, Through, dried, ready, solved
from granum.drying.gas_solid.liquor import counted
from granum.drying.gas_solid.matter import Matter
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream


class LayerDryer(Dryer):
    """Layers of solid through which gas blows in zones, one after the other."""

    @abstractmethod
    def holdup(self, feed: Stream) -> Any:
        """Dry solid in the dryer, kg."""

    @abstractmethod
    def exchange(self, feed: Stream, gas: Stream) -> Any:
        """Heat transfer coefficient times surface per dry solid, W/(K kg)."""

    @abstractmethod
    def zones(self, feed: Stream, *gases: Stream) -> list[Zone]:
        """What the layer passes through."""

    @abstractmethod
    def resolution(self) -> tuple[int, int]:
        """Layers, and steps of time in a zone."""

    def column(self, feed: Stream, gas: Stream) -> Contact:
        """One kilogram of dry solid, in layers."""
        n, _steps = self.resolution()
        exchange = self.exchange(feed, gas)
        solid = jnp.full((n, 1), 1.0 / n)
        return Contact(
            Matter.of(feed, gas).blended(feed),
            self.kinetics,
            solid,
            jnp.zeros((n, 1)),
            1.0,
            Network.co_current(n),
            lambda X, Ts, Tg, Y: exchange,
        )

    def passages(self, feed: Stream, *gases: Stream) -> tuple[Contact, list[Passage]]:
        """The column and its way through the zones."""
        dry = counted(feed)
        like = solved(self.column(dry, gases[0]), feed)
        return like, pass_zones(
            like, dry.moisture_dry_basis, feed.temperature, self.zones(dry, *gases), self.resolution()[1]
        )

    def through(self, feed: Stream, gas: Stream) -> Through:
        return _passed(self, feed, gas)

    def outlets(self, inside: Through, feed: Stream, gas: Stream) -> Dried:
        return self.dusted(fogged(feed, gas, inside.profile), inside.profile)

    def exhausted(self, inside: Through) -> Profile:
        """The profile with the vapor and enthalpy of the exhaust alone."""
        return inside.profile

    def figures(
        self, inside: Through, outlets: Any, feed: Stream, gas: Stream, **others: Any
    ) -> DryerFigures:
        """What became fog had evaporated."""
        found = super().figures(inside, outlets, feed, gas, **others)
        clear = dried(feed, gas, self.exhausted(inside)).exhaust
        fog = misty(clear).liquid[0] - clear.liquid[0]
        return found._replace(evaporation_rate=found.evaporation_rate + fog)


def fogged(feed: Stream, gas: Stream, found: Profile) -> Dried:
    """The outlets, with the fog of an exhaust that mixes cold and warm air, each nearly saturated."""
    made = dried(feed, gas, found)
    return made._replace(exhaust=misty(made.exhaust))


def misty(gas: Stream) -> Stream:
    """Gas beyond saturation with what it cannot hold as mist."""
    humid = HumidMixture(gas.mixture)
    wet = (humid.relative_humidity(gas) > 1.0) & (gas.gas_flow > 0.0)
    return jax.tree.map(lambda a, b: jnp.where(wet, a, b), humid.at_own_enthalpy(gas), gas)


@ready
def _passed(dryer: LayerDryer, feed: Stream, *gases: Stream) -> Through:
    like, found = dryer.passages(feed, *gases)
    profile = joined(
        like, found, counted(feed).solid_flow, sum(p.vapor for p in found), sum(p.gas_enthalpy for p in found)
    )
    return Through(profile, dryer.holdup(feed))


def joined(like: Contact, found: list[Passage], flow: Any, vapor: Any, gas_enthalpy: Any) -> Profile:
    """The zones as one profile along the way of the solid; gas as it leaves the layer."""
    n = like.solid.shape[0]
    last = found[-1]
    X = jnp.concatenate([p.layers.moisture[..., 0] for p in found])
    T = jnp.concatenate([p.layers.temperature[..., 0] for p in found])
    time = jnp.concatenate([p.time for p in found])
    Y = jnp.concatenate([p.layers.vapor / p.gas_per_solid for p in found])
    Tg = like.matter.gas_temperature(
        jnp.concatenate([p.layers.gas_enthalpy / p.gas_per_solid for p in found]), Y
    )
    water = jnp.array([flow * mean_moisture(like, last)[-1]])
    heat = jnp.array([flow * product_enthalpy(like, last)])
    return Profile(
        jnp.full(n, 1.0 / n),
        time / time[-1],
        X,
        T,
        Y,
        Tg,
        water,
        heat,
        flow * vapor,
        flow * gas_enthalpy,
        jnp.zeros(()),
        jnp.all(jnp.stack([jnp.all(p.layers.converged) for p in found])),
        jnp.arange(len(time)) == len(time) - 1,
    )
