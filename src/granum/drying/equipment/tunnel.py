"""Tunnel dryer: trucks of trays pushed through a gas that sweeps over them."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import (
    Area,
    HeatTransferCoefficient,
    Law,
    SpecificSurfaceMass,
    Temperature,
    Time,
    Volume,
    Within,
)
from granum.core.limits import Limit
from granum.drying.formulas.heat import heat_transfer_coefficient_parallel
from granum.drying.gas_solid.cells import Contact, Network
from granum.drying.gas_solid.dryer import NOTES, CellDryer, Dried, DryerFigures, Through, sized
from granum.drying.gas_solid.kinetics import AbstractKinetics
from granum.drying.gas_solid.matter import Matter
from granum.drying.gas_solid.steam import in_steam
from granum.drying.kinds import LostHeat
from granum.streams.stream import Stream
from granum.streams.units import Limits

TABLE = NOTES.format(table="IV.8")
TRUCK_HEADS = 10.0  # velocity heads lost between the trucks, our own estimate


@equipment("tunnel_dryer", source="keey1978; geankoplis2003, ch. 9", title="Tunnel dryer")
class TunnelDryer(CellDryer):
    """Trucks in a row with gas along their surface, with or against them, close enough to count as a steady
    flow.

    Heat by the flux of gas through the free section unless a coefficient is given.
    """

    residence_time: Time
    surface_per_mass: SpecificSurfaceMass
    free_area: Area
    volume: Volume
    kinetics: Annotated[Any, Law("drying_kinetics")]
    gas_direction: Literal["counter-current", "co-current"] = "counter-current"
    heat_transfer_coefficient: HeatTransferCoefficient | None = None
    heat_loss: LostHeat = 0.0
    temperature_limit: Temperature | None = None
    cells: Annotated[int, Within(1, 2000)] = 40

    limits: ClassVar[Limits] = CellDryer.limits | {
        "inlet": Limit("gas temperature at the inlet", 303.15, 523.15, "K", TABLE, quiet=True),
        "capacity": Limit(
            "water evaporated per volume and hour", 1.0, 50.0, "kg/(hour*m^3)", TABLE, quiet=True
        ),
        "velocity": Limit("gas velocity over the product", 0.6, 8.0, "m/s", "treybal1980, ch. 12"),
    }

    def extent(self) -> Any:
        return self.volume

    def contact(self, feed: Stream, gas: Stream) -> Contact:
        n, F = self.cells, feed.solid_by_size
        solid = jnp.broadcast_to(F * self.residence_time / n, (n, F.shape[0]))
        h = self.heat_transfer_coefficient
        if h is None:
            h = in_steam(heat_transfer_coefficient_parallel.function, gas.gas_flow / self.free_area, gas)
        exchange = h * self.surface_per_mass
        matter = Matter.of(feed, gas)
        network = (
            Network.counter_current(n) if self.gas_direction == "counter-current" else Network.co_current(n)
        )
        return Contact(
            matter,
            self.kinetics,
            solid,
            jnp.full_like(solid, 1.0) * n / self.residence_time,
            matter.humid.carrier_flow(gas),
            network,
            lambda X, Ts, Tg, Y: exchange,
            heat_loss=self.heat_loss / n,
        )

    @classmethod
    def size(
        cls,
        moisture_outlet: Any,
        feed: Stream,
        gas: Stream,
        surface_per_mass: Any,
        free_area: Any,
        volume: Any,
        kinetics: AbstractKinetics,
        **more: Any,
    ) -> TunnelDryer:
        """The tunnel in which the trucks stay as long as a product moisture needs."""
        first = cls(3600.0, surface_per_mass, free_area, volume, kinetics, **more)
        return sized(first, "residence_time", moisture_outlet, 10.0, 1e6, feed, gas)

    def measured(
        self, inside: Through, outlets: Dried, figures: DryerFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, gas) | {
            "inlet": self.temperature_drying(figures, gas),
            "capacity": self.hourly(figures),
            "velocity": gas.gas_volume_flow / self.free_area,
        }

    def pressure_lost(self, feed: Stream, gas: Stream) -> Any:
        """Velocity heads of the gas between the trucks."""
        return TRUCK_HEADS * 0.5 * gas.gas_density * (gas.gas_volume_flow / self.free_area) ** 2
