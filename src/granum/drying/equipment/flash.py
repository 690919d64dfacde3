"""Flash (pneumatic) dryer: wet particles thrown into a fast hot gas that carries them up a duct."""

from __future__ import annotations

from dataclasses import replace
from math import pi
from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import Fraction, Law, Length, Power, Speed, Temperature, Within
from granum.drying.contact.cells import Inlet, Network, Profile
from granum.drying.contact.conveyed import Path, convey
from granum.drying.contact.dryer import NOTES, Dried, Dryer, DryerFigures, humidity_of, recalled, sized
from granum.drying.contact.kinetics import AbstractKinetics
from granum.drying.contact.liquor import composition, counted
from granum.drying.contact.matter import Matter
from granum.streams.stream import Stream
from granum.streams.units import Check

FIRST_CELLS = 1.08  # growth of the cells from the feed point on, where the particles are still slow


@equipment("flash_dryer", source="baeyens1995; levy1999", title="Flash dryer")
class FlashDryer(Dryer):
    """Particles of each size accelerate from their feed velocity, slip behind the gas and dry on the way; heat after Ranz and Marshall.

    Dilute: particles do not touch. The size does not change with moisture. ``downward`` is 1 for a falling duct, 0.5 for a level one.
    """

    length: Length
    diameter: Length
    kinetics: Annotated[Any, Law("drying_kinetics")]
    feed_velocity: Speed = 1.0
    downward: Fraction = 0.0
    heat_loss: Power = 0.0
    temperature_limit: Temperature | None = None
    cells: Annotated[int, Within(1, 2000)] = 60

    def extent(self) -> Any:
        return 0.25 * pi * self.diameter**2

    def path(self, feed: Stream) -> Path:
        """The duct, with short cells where the particles are slow."""
        growth = FIRST_CELLS ** jnp.arange(self.cells)
        sizes = jnp.asarray(feed.mixture.sizes)
        return Path(
            self.length * growth / jnp.sum(growth), self.extent(), STANDARD_GRAVITY * (2.0 * self.downward - 1.0), self.feed_velocity, sizes,
            feed.solid_density, feed.solid_density, False,
        )  # fmt: skip

    def profile(self, feed: Stream, gas: Stream) -> Profile:
        return _flown(self, feed, gas)[0]

    def holdup(self, feed: Stream, gas: Stream) -> Any:
        return _flown(self, feed, gas)[1]

    @classmethod
    def size(
        cls, moisture_outlet: Any, feed: Stream, gas: Stream, gas_velocity: Any, kinetics: AbstractKinetics, **more: Any
    ) -> FlashDryer:
        """The duct in which the inlet gas has a velocity, as long as a product moisture needs."""
        diameter = float(jnp.sqrt(4.0 / pi * gas.gas_volume_flow / gas_velocity))
        return sized(cls(10.0, diameter, kinetics, **more), "length", moisture_outlet, 0.05, 500.0, feed, gas)

    def ranges(self, inlets: Any, outlets: Dried, figures: DryerFigures) -> tuple[Check, ...]:
        gas, table = inlets["gas"], NOTES.format(table="IV.14")
        return (
            Check("gas velocity at the inlet", gas.gas_volume_flow / self.extent(), 15.0, 30.0, "m/s", table),
            Check("gas temperature at the inlet", gas.temperature, 373.15, 623.15, "K", table),
            Check("gas temperature at the outlet", outlets.exhaust.temperature, 343.15, 393.15, "K", table),
            Check("residence time of the solid", figures.residence_time, 0.5, 3.5, "s", table),
        )


@recalled
def _flown(dryer: FlashDryer, feed: Stream, gas: Stream) -> tuple[Profile, Any]:
    dry = counted(feed)
    X = jnp.full(len(feed.mixture.sizes), 1.0) * dry.moisture_dry_basis
    inlet = Inlet(X, jnp.full_like(X, 1.0) * feed.temperature, humidity_of(gas), gas.temperature)
    matter = replace(Matter.of(dry, gas), dissolved=composition(feed))
    return convey(dryer.path(dry), matter, dryer.kinetics, gas, inlet, dry.solid_by_size, Network.co_current(dryer.cells), dryer.heat_loss)
