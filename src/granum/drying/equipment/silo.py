"""Silo (column) dryer for grain: hot air across a falling layer of grain, then cold air, which may go back to
the heater.
"""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.flags import unsolved
from granum.core.kinds import (
    Density,
    Fraction,
    HeatTransferCoefficient,
    Law,
    Length,
    PressureGradient,
    SpecificSurface,
    Temperature,
    Volume,
    Within,
)
from granum.core.limits import Limit
from granum.drying.formulas.beds import heat_transfer_coefficient_through_bed, pressure_gradient_shedd
from granum.drying.gas_solid.cells import Profile
from granum.drying.gas_solid.column import Zone
from granum.drying.gas_solid.dryer import NOTES, DryerFigures, Through, ready, sized, warmed
from granum.drying.gas_solid.kinetics import AbstractKinetics
from granum.drying.gas_solid.layer import LayerDryer, fogged, joined, misty
from granum.drying.gas_solid.liquor import counted
from granum.drying.gas_solid.steam import is_steam
from granum.streams.atmosphere import VENTED
from granum.streams.cakes import solid_diameter
from granum.streams.equilibrium import HumidMixture
from granum.streams.fines import finest
from granum.streams.stream import Stream, empty
from granum.streams.units import Limits

TABLE = NOTES.format(table="IV.12")
COLUMN_DUST = 1.1e-4  # of the grain
NO_STEAM = (
    "Grain in a silo is not dried in steam, which condenses in it layer after layer: give air at the port "
    "'gas', or dry in steam in a belt, rotary, flash or fluidized-bed dryer."
)


class DriedGrain(NamedTuple):
    """Dried grain, exhaust of the drying zone, air of the cooling zone (to be led back to the heater), heat
    from outside.
    """

    product: Stream
    exhaust: Stream
    warmed_air: Stream
    heat_duty: Any


@equipment("silo_dryer", source="brooker1992; thompson1968; ap42_1995", title="Silo dryer for grain")
class SiloDryer(LayerDryer):
    """Cross-flow column: grain falls in a layer through a drying zone and a cooling zone of the same
    thickness; air crosses it.

    Deep bed of thin layers. ``turned`` lets the air of the second half of the drying zone enter from the
    other side. Without air at the port ``cooling`` there is no cooling zone; its air leaves as ``warmed_air``
    and may feed the heater in the flowsheet. What air beyond saturation cannot hold leaves with it as mist.
    With ``entrainment`` the exhaust takes along the ``dusting_fraction`` of the grain, the finest of it: 0.11
    kg a tonne of column dryers, 1.5 of rack dryers (AP-42, table 9.9.1-1, recalled). An ``explosion_vent`` is
    that of the room that the air and the dust of the grain pass, whatever the size classes are.
    """

    volume: Volume
    layer_depth: Length
    bulk_density_dry: Density
    kinetics: Annotated[Any, Law("drying_kinetics")]
    cooling_share: Fraction = 0.25
    turned: bool = False
    heat_transfer_coefficient: HeatTransferCoefficient | None = None
    specific_surface: SpecificSurface | None = None
    temperature_limit: Temperature | None = None
    layers: Annotated[int, Within(1, 1000)] = 20
    steps: Annotated[int, Within(1, 100_000)] = 50
    entrainment: bool = False
    dusting_fraction: Fraction = COLUMN_DUST
    explosion_vent: Annotated[Any, Law("explosion_vent")] = None

    limits: ClassVar[Limits] = (
        LayerDryer.limits
        | {
            "inlet": Limit("gas temperature at the inlet", 303.15, 383.15, "K", "brooker1992"),
            "time": Limit("residence time of the grain", 900.0, 4 * 86400.0, "s", TABLE),
            "pressure": Limit("air pressure lost in the grain", 0.0, 2500.0, "Pa", "brooker1992"),
        }
        | VENTED
    )

    def extent(self) -> Any:
        return self.volume

    def resolution(self) -> tuple[int, int]:
        return self.layers, self.steps

    def holdup(self, feed: Stream) -> Any:
        return self.volume * self.bulk_density_dry

    def area(self) -> Any:
        """Across which the hot air enters."""
        return self.volume * (1.0 - self.cooling_share) / self.layer_depth

    def exchange(self, feed: Stream, gas: Stream) -> Any:
        d, h, surface = solid_diameter(feed), self.heat_transfer_coefficient, self.specific_surface
        if h is None:
            h = heat_transfer_coefficient_through_bed.function(gas.gas_flow / self.area(), d)
        if surface is None:
            surface = 6.0 / d * self.bulk_density_dry / feed.solid_density
        return h * surface / self.bulk_density_dry

    def zones(self, feed: Stream, *gases: Stream) -> list[Zone]:
        humid = HumidMixture(feed.mixture)
        mass = self.holdup(feed)
        time = mass / jnp.maximum(feed.solid_flow, 1e-12)
        cooled = len(gases) > 1
        share = 1.0 - self.cooling_share if cooled else 1.0

        def zone(gas: Stream, part: Any, flow_part: Any, backwards: bool) -> Zone:
            per_solid = humid.carrier_flow(gas) * flow_part / (mass * part)
            return Zone(time * part, per_solid, backwards, humid.vapor_per_carrier(gas), gas.temperature)

        halves = 2 if self.turned else 1
        hot = [zone(gases[0], share / halves, 1.0 / halves, i == 1) for i in range(halves)]
        return hot + ([zone(gases[1], self.cooling_share, 1.0, False)] if cooled else [])

    def entrained(self, product: Stream, exhaust: Stream) -> Any:
        return finest(product, self.dusting_fraction) if self.entrainment else None

    def through(self, feed: Stream, gas: Stream, cooling: Stream | None = None) -> Through:
        unsolved(~is_steam(gas), type(self).card, reason=NO_STEAM)
        return _grain(self, feed, gas, cooling)

    def exhausted(self, inside: Through) -> Profile:
        found = inside.profile
        if inside.cooling is None:
            return found
        vapor, heat = inside.cooling
        return found._replace(vapor=found.vapor - vapor, gas_enthalpy=found.gas_enthalpy - heat)

    def outlets(
        self, inside: Through, feed: Stream, gas: Stream, cooling: Stream | None = None
    ) -> DriedGrain:
        found = inside.profile
        if cooling is None:
            product, exhaust, duty = self.dusted(fogged(feed, gas, found), found)
            return DriedGrain(product, exhaust, empty(feed.mixture, gas.temperature, gas.pressure), duty)
        assert inside.cooling is not None
        vapor, heat = inside.cooling
        apart = self.exhausted(inside)
        product, exhaust, duty = self.dusted(fogged(feed, gas, apart), apart)
        stray = cooling.part(solid=1.0, liquid=1.0)
        air = cooling.replace(gas=cooling.gas.at[HumidMixture(feed.mixture).vapor].set(vapor))
        air = misty(warmed(air, heat + stray.enthalpy_flow))
        return DriedGrain(product, exhaust, air, duty)

    @classmethod
    def size(
        cls,
        moisture_outlet: Any,
        feed: Stream,
        gas: Stream,
        layer_depth: Any,
        bulk_density_dry: Any,
        kinetics: AbstractKinetics,
        **more: Any,
    ) -> SiloDryer:
        """The volume of grain that a product moisture needs with the given hot air."""
        return sized(
            cls(1.0, layer_depth, bulk_density_dry, kinetics, **more),
            "volume",
            moisture_outlet,
            1e-3,
            1e4,
            feed,
            gas,
        )

    def pressure_gradient(self, gas: Stream) -> PressureGradient:
        """That the hot air loses in the grain."""
        return pressure_gradient_shedd.function(gas.gas_volume_flow / self.area())

    def measured(
        self,
        inside: Through,
        outlets: DriedGrain,
        figures: DryerFigures,
        feed: Stream,
        gas: Stream,
        cooling: Stream | None = None,
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, gas) | {
            "inlet": gas.temperature,
            "time": figures.residence_time,
            "pressure": self.pressure_gradient(gas) * self.layer_depth,
        }

    def pressure_lost(self, feed: Stream, gas: Stream) -> Any:
        return self.pressure_gradient(gas) * self.layer_depth


@ready
def _grain(dryer: SiloDryer, feed: Stream, gas: Stream, cooling: Stream | None) -> Through:
    gases = (gas,) if cooling is None else (gas, cooling)
    like, found = dryer.passages(feed, *gases)
    flow = counted(feed).solid_flow
    profile = joined(like, found, flow, sum(p.vapor for p in found), sum(p.gas_enthalpy for p in found))
    return Through(profile, dryer.holdup(feed), (flow * found[-1].vapor, flow * found[-1].gas_enthalpy))
