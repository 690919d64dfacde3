"""Belt dryer: a layer on a perforated belt, gas blown through it in zones, upwards and downwards."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Area,
    Density,
    HeatTransferCoefficient,
    Law,
    Length,
    SpecificSurface,
    Temperature,
    Within,
)
from granum.core.limits import Limit
from granum.drying.formulas.beds import heat_transfer_coefficient_through_bed
from granum.drying.gas_solid.column import Zone
from granum.drying.gas_solid.dryer import NOTES, Dried, DryerFigures, Through, sized
from granum.drying.gas_solid.kinetics import AbstractKinetics
from granum.drying.gas_solid.layer import LayerDryer
from granum.drying.gas_solid.steam import in_steam
from granum.porous.formulas.packed_beds import pressure_gradient_ergun
from granum.streams.cakes import solid_diameter
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import AREA

TABLE = NOTES.format(table="IV.10")


@equipment("belt_dryer", source="geankoplis2003, ch. 9; keey1978", title="Belt dryer")
class BeltDryer(LayerDryer):
    """Through-circulation: the layer keeps its order, so that its gas side dries first; the gas is shared out
    evenly over the zones.

    With ``alternating`` the gas enters every second zone from the other side. Without a coefficient that of
    Geankoplis is used. ``specific_surface`` is that of the pieces in a volume of layer; where a powder is
    formed to pieces it must be given, since without it the pieces are spheres of the solid's mean size.
    """

    area: Area
    layer_depth: Length
    bulk_density_dry: Density
    kinetics: Annotated[Any, Law("drying_kinetics")]
    zone_count: Annotated[int, Within(1, 100)] = 1
    alternating: bool = False
    heat_transfer_coefficient: HeatTransferCoefficient | None = None
    specific_surface: SpecificSurface | None = None
    temperature_limit: Temperature | None = None
    layers: Annotated[int, Within(1, 1000)] = 24
    steps: Annotated[int, Within(1, 100_000)] = 120

    limits: ClassVar[Limits] = LayerDryer.limits | {
        "inlet": Limit("gas temperature at the inlet", 323.15, 623.15, "K", TABLE, quiet=True),
        "capacity": Limit(
            "water evaporated per area and hour", 6.0, 50.0, "kg/(hour*m^2)", TABLE, quiet=True
        ),
        "velocity": Limit("gas velocity through the layer", 0.25, 2.5, "m/s", "keey1978"),
        "lifted": Limit(
            "gas pressure lost over the weight of the layer, which gas from below lifts at 1",
            0.0,
            1.0,
            "dimensionless",
            "kunii1991, ch. 3",
        ),
    }

    utilities: ClassVar[Utilities] = LayerDryer.utilities | AREA

    def extent(self) -> Any:
        return self.area

    def resolution(self) -> tuple[int, int]:
        return self.layers, self.steps

    def holdup(self, feed: Stream) -> Any:
        return self.area * self.layer_depth * self.bulk_density_dry

    def exchange(self, feed: Stream, gas: Stream) -> Any:
        d, h, surface = solid_diameter(feed), self.heat_transfer_coefficient, self.specific_surface
        if h is None:
            h = in_steam(
                lambda flux: heat_transfer_coefficient_through_bed.function(flux, d),
                gas.gas_flow / self.area,
                gas,
            )
        if surface is None:
            surface = 6.0 / d * self.bulk_density_dry / feed.solid_density
        return h * surface / self.bulk_density_dry

    def zones(self, feed: Stream, *gases: Stream) -> list[Zone]:
        gas = gases[0]
        mass, n = self.holdup(feed), self.zone_count
        humid = HumidMixture(gas.mixture)
        per_solid = humid.carrier_flow(gas) / mass
        time = mass / jnp.maximum(feed.solid_flow, 1e-12) / n
        return [
            Zone(
                time,
                per_solid,
                self.alternating and i % 2 == 1,
                humid.vapor_per_carrier(gas),
                gas.temperature,
            )
            for i in range(n)
        ]

    @classmethod
    def size(
        cls,
        moisture_outlet: Any,
        feed: Stream,
        gas_velocity: Any,
        gas: Stream,
        layer_depth: Any,
        bulk_density_dry: Any,
        kinetics: AbstractKinetics,
        **more: Any,
    ) -> BeltDryer:
        """The belt area that a product moisture needs, with gas (of any flow) taken at a velocity through the
        empty section.
        """
        first = cls(1.0, layer_depth, bulk_density_dry, kinetics, **more)
        return sized(first, "area", moisture_outlet, 1e-3, 1e4, feed, gas, gas_velocity)

    def measured(
        self, inside: Through, outlets: Dried, figures: DryerFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        wet = self.bulk_density_dry * (1.0 + feed.moisture_dry_basis)
        return super().measured(inside, outlets, figures, feed, gas) | {
            "inlet": self.temperature_drying(figures, gas),
            "capacity": self.hourly(figures),
            "velocity": gas.gas_volume_flow / self.area,
            "lifted": self.pressure_lost(feed, gas) / (wet * STANDARD_GRAVITY * self.layer_depth),
        }

    def pressure_lost(self, feed: Stream, gas: Stream) -> Any:
        """By Ergun's equation, around pieces of the surface given, else of the solid's mean size."""
        void = jnp.clip(1.0 - self.bulk_density_dry / feed.solid_density, 0.2, 0.9)
        surface = self.specific_surface
        gradient = pressure_gradient_ergun.function(
            gas.gas_volume_flow / self.area,
            solid_diameter(feed) if surface is None else 6.0 * (1.0 - void) / surface,
            void,
            gas.gas_density,
            gas.gas_viscosity,
        )
        return gradient * self.layer_depth

    def drawn(
        self, inside: Through, outlets: Dried, figures: DryerFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        return super().drawn(inside, outlets, figures, feed, gas) | {"area_installed": self.area}
