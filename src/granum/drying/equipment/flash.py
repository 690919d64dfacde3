"""Flash (pneumatic) dryer: wet particles thrown into a fast hot gas that carries them up a duct."""

from __future__ import annotations

from dataclasses import replace
from math import pi
from typing import Annotated, Any, ClassVar

import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import Fraction, Law, Length, Speed, Temperature, Within
from granum.core.limits import Limit
from granum.drying.gas_solid.cells import Inlet, Network
from granum.drying.gas_solid.conveyed import Path, convey, liquid_density
from granum.drying.gas_solid.dryer import NOTES, Dried, Dryer, DryerFigures, Through, ready, sized
from granum.drying.gas_solid.kinetics import AbstractKinetics
from granum.drying.gas_solid.liquor import composition, counted
from granum.drying.gas_solid.matter import Matter
from granum.drying.kinds import LostHeat
from granum.streams.atmosphere import VENTED
from granum.streams.equilibrium import HumidMixture
from granum.streams.fines import fall, lifted
from granum.streams.stream import Stream
from granum.streams.units import Limits

TABLE = NOTES.format(table="IV.14")
FRICTION = 0.02  # Darcy factor of the gas in the duct
LEVEL = 0.5  # of ``downward``, from where on nothing has to be lifted
FIRST_CELLS = 1.08  # growth of the cells from the feed point on, where the particles are still slow


@equipment("flash_dryer", source="baeyens1995; levy1999", title="Flash dryer")
class FlashDryer(Dryer):
    """Particles of each size accelerate from their feed velocity, slip behind the gas and dry on the way;
    heat after Ranz and Marshall.

    Dilute: particles do not touch. The size does not change with moisture. ``downward`` is 1 for a falling
    duct, 0.5 for a level one. With ``entrainment`` the exhaust carries the powder to the collectors of the
    line: all of it from a falling or level duct, from a rising one what falls slower than the gas flows; else
    a perfect collector ends the duct. An ``explosion_vent`` is that of the duct.
    """

    length: Length
    diameter: Length
    kinetics: Annotated[Any, Law("drying_kinetics")]
    feed_velocity: Speed = 1.0
    downward: Fraction = 0.0
    heat_loss: LostHeat = 0.0
    temperature_limit: Temperature | None = None
    cells: Annotated[int, Within(1, 2000)] = 60
    entrainment: bool = False
    explosion_vent: Annotated[Any, Law("explosion_vent")] = None

    gas_direction = "co-current"
    dust_dries_on = False  # it has flown with the gas all along

    limits: ClassVar[Limits] = (
        Dryer.limits
        | {
            "velocity": Limit("gas velocity at the inlet", 15.0, 30.0, "m/s", TABLE),
            "inlet": Limit("gas temperature at the inlet", 373.15, 623.15, "K", TABLE),
            "outlet": Limit("gas temperature at the outlet", 343.15, 393.15, "K", TABLE),
            "time": Limit("residence time of the solid", 0.5, 3.5, "s", TABLE),
        }
        | VENTED
    )

    def extent(self) -> Any:
        return 0.25 * pi * self.diameter**2

    def path(self, feed: Stream) -> Path:
        """The duct, with short cells where the particles are slow."""
        growth = FIRST_CELLS ** jnp.arange(self.cells)
        sizes = jnp.asarray(feed.mixture.sizes)
        return Path(
            self.length * growth / jnp.sum(growth),
            self.extent(),
            STANDARD_GRAVITY * (2.0 * self.downward - 1.0),
            self.feed_velocity,
            sizes,
            feed.solid_density,
            feed.solid_density,
            liquid_density(feed),
            False,
        )

    def through(self, feed: Stream, gas: Stream) -> Through:
        return _flown(self, feed, gas)

    def entrained(self, product: Stream, exhaust: Stream) -> Any:
        if not self.entrainment:
            return None
        flies = lifted(fall(product, exhaust), exhaust, self.extent()) | (jnp.asarray(self.downward) >= LEVEL)
        return jnp.where(flies, 1.0, 0.0)

    @classmethod
    def size(
        cls,
        moisture_outlet: Any,
        feed: Stream,
        gas: Stream,
        gas_velocity: Any,
        kinetics: AbstractKinetics,
        **more: Any,
    ) -> FlashDryer:
        """The duct in which the inlet gas has a velocity, as long as a product moisture needs."""
        diameter = float(jnp.sqrt(4.0 / pi * gas.gas_volume_flow / gas_velocity))
        return sized(cls(10.0, diameter, kinetics, **more), "length", moisture_outlet, 0.05, 500.0, feed, gas)

    def measured(
        self, inside: Through, outlets: Dried, figures: DryerFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, gas) | {
            "velocity": gas.gas_volume_flow / self.extent(),
            "inlet": gas.temperature,
            "outlet": outlets.exhaust.temperature,
            "time": figures.residence_time,
        }

    def pressure_lost(self, feed: Stream, gas: Stream) -> Any:
        """Solid brought to the speed of the gas and lifted, and friction of the gas in the duct."""
        U = gas.gas_volume_flow / self.extent()
        carried = (feed.solid_flow + feed.liquid_flow) / self.extent()
        lifted = STANDARD_GRAVITY * self.length / jnp.maximum(U, 1e-3) * (1.0 - 2.0 * self.downward)
        friction = FRICTION * self.length / self.diameter * 0.5 * gas.gas_density * U**2
        return jnp.maximum(carried * (U + lifted) + friction, 0.0)


@ready
def _flown(dryer: FlashDryer, feed: Stream, gas: Stream) -> Through:
    dry = counted(feed)
    X = jnp.full(len(feed.mixture.sizes), 1.0) * dry.moisture_dry_basis
    inlet = Inlet(
        X,
        jnp.full_like(X, 1.0) * feed.temperature,
        HumidMixture(gas.mixture).vapor_per_carrier(gas),
        gas.temperature,
    )
    matter = replace(Matter.of(dry, gas), dissolved=composition(feed))
    network = Network.co_current(dryer.cells)
    return Through(
        *convey(
            dryer.path(dry), matter, dryer.kinetics, gas, inlet, dry.solid_by_size, network, dryer.heat_loss
        )
    )
