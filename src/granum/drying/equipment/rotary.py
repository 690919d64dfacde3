"""Rotary drum dryer: cascading solid in a gas stream, or a drum heated through its wall."""

from __future__ import annotations

from math import pi
from typing import Annotated, Any, ClassVar, Literal

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import (
    Fraction,
    HeatTransferCoefficient,
    Law,
    Length,
    PositiveNumber,
    Temperature,
    TurningSpeed,
    Within,
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.drying.formulas.rotary import (
    residence_time_friedman_marshall,
    shaft_power_rotary_drum,
    volumetric_heat_transfer_rotary,
)
from granum.drying.gas_solid.cells import Contact, Network
from granum.drying.gas_solid.dryer import NOTES, CellDryer, Dried, DryerFigures, Through, sized
from granum.drying.gas_solid.kinetics import AbstractKinetics
from granum.drying.gas_solid.matter import Matter
from granum.drying.gas_solid.steam import in_steam
from granum.drying.kinds import LostHeat
from granum.streams.cakes import solid_diameter
from granum.streams.fines import fall, finest, showered
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import HEAT_APPROACH, HEATED, driven, heated

TABLE = NOTES.format(table="IV.6")
SHELL, STEEL = 0.01, 7850.0  # thickness of the shell with flights over the diameter, kg/m³
LEAST = 1e-12  # kg/s of solid, of a drum that runs empty


@equipment(
    "rotary_dryer",
    source="friedman1949; friedman1949part2; treybal1980, ch. 12; ap42_1995",
    title="Rotary dryer",
)
class RotaryDryer(CellDryer):
    """Drum with flights: time of passage after Friedman and Marshall, heat by the volume, tanks in series for
    the spread of residence times.

    ``wall_coefficient`` adds heat from a steam-heated wall over the wetted share of the shell (the conductive
    drum). With ``entrainment`` the exhaust takes along fines that the flights shower once through the gas,
    evenly along the drum: what falls slower than the gas flows, and has not settled before the gas leaves. A
    measured ``dusting_fraction`` of the feed, the finest of it, takes the place of this estimate; ammonium
    sulfate dryers lose 2 to 3 % (AP-42, recalled).
    """

    length: Length
    diameter: Length
    kinetics: Annotated[Any, Law("drying_kinetics")]
    drum_slope: Fraction = 0.04
    rotation_speed: TurningSpeed = 0.4
    gas_direction: Literal["counter-current", "co-current"] = "counter-current"
    transfer_constant: PositiveNumber = 237.0
    transfer_exponent: PositiveNumber = 0.67
    wall_coefficient: HeatTransferCoefficient | None = None
    wall_temperature: Temperature = 423.15
    wetted_share: Fraction = 0.15
    heat_loss: LostHeat = 0.0
    temperature_limit: Temperature | None = None
    cells: Annotated[int, Within(1, 2000)] = 40
    entrainment: bool = False
    dusting_fraction: Fraction | None = None

    limits: ClassVar[Limits] = CellDryer.limits | {
        "filled": Limit("share of the drum filled with solid", 0.03, 0.15, "dimensionless", "friedman1949"),
        "flux": Limit("gas per cross-section of the drum", 0.5, 5.0, "kg/(m^2*s)", "treybal1980, ch. 12"),
        "slender": Limit("length over diameter of the drum", 4.0, 10.0, "dimensionless", "perry2008, ch. 12"),
        "inlet": Limit("gas temperature at the inlet", 373.15, 1173.15, "K", TABLE),
        "capacity": Limit("water evaporated per volume and hour", 3.0, 100.0, "kg/(hour*m^3)", TABLE),
    }

    utilities: ClassVar[Utilities] = (
        CellDryer.utilities
        | HEATED
        | {
            "electric_power_drive": Utility(
                "perry2008, ch. 12, the drive only: the weight of a steel shell is our own estimate"
            )
        }
    )

    def extent(self) -> Any:
        return self.length * self.section

    @property
    def section(self) -> Any:
        """Cross-section of the drum."""
        return 0.25 * pi * self.diameter**2

    def entrained(self, product: Stream, exhaust: Stream) -> Any:
        if not self.entrainment:
            return None
        if self.dusting_fraction is not None:
            return finest(product, self.dusting_fraction)
        floor = self.diameter * self.length
        return showered(fall(product, exhaust), exhaust, floor, self.section)

    def passage(self, feed: Stream, gas: Stream) -> Any:
        """Mean time of passage of the solid."""
        against = 1.0 if self.gas_direction == "counter-current" else -1.0
        return residence_time_friedman_marshall.function(
            self.length,
            self.diameter,
            self.drum_slope,
            self.rotation_speed,
            solid_diameter(feed),
            gas.gas_flow / self.section,
            jnp.maximum(feed.solid_flow, LEAST) / self.section,
            against,
        )

    def contact(self, feed: Stream, gas: Stream) -> Contact:
        n, F = self.cells, feed.solid_by_size
        time = self.passage(feed, gas)
        held = jnp.maximum(jnp.sum(F), LEAST) * time
        solid = jnp.broadcast_to(F * time / n, (n, F.shape[0]))

        def by_volume(flux: Any) -> Any:
            return volumetric_heat_transfer_rotary.function(
                flux, self.diameter, self.transfer_constant, self.transfer_exponent
            )

        Ua = in_steam(by_volume, gas.gas_flow / self.section, gas)
        # every class takes heat in proportion to its mass
        exchange = Ua * self.extent() / held
        wall = 0.0
        if self.wall_coefficient is not None:
            wall = self.wall_coefficient * self.wetted_share * pi * self.diameter * self.length / held
        matter = Matter.of(feed, gas)
        network = (
            Network.counter_current(n) if self.gas_direction == "counter-current" else Network.co_current(n)
        )
        return Contact(
            matter,
            self.kinetics,
            solid,
            jnp.full_like(solid, 1.0) * n / time,
            matter.humid.carrier_flow(gas),
            network,
            lambda X, Ts, Tg, Y: exchange,
            wall,
            self.wall_temperature,
            self.heat_loss / n,
        )

    @classmethod
    def size(
        cls,
        moisture_outlet: Any,
        feed: Stream,
        gas: Stream,
        diameter: Any,
        kinetics: AbstractKinetics,
        **more: Any,
    ) -> RotaryDryer:
        """The drum as long as a product moisture needs."""
        return sized(cls(10.0, diameter, kinetics, **more), "length", moisture_outlet, 0.2, 200.0, feed, gas)

    def measured(
        self, inside: Through, outlets: Dried, figures: DryerFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, gas) | {
            "filled": figures.solid_holdup / (feed.solid_density * 0.6) / self.extent(),
            "flux": gas.gas_flow / self.section,
            "slender": jnp.asarray(self.length / self.diameter),
            "inlet": gas.temperature,
            "capacity": self.hourly(figures),
        }

    def drawn(
        self, inside: Through, outlets: Dried, figures: DryerFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        load = inside.holdup * (1.0 + feed.moisture_dry_basis)
        shell = pi * self.diameter * self.length * SHELL * self.diameter * STEEL
        turning = shaft_power_rotary_drum(self.rotation_speed, self.diameter, load, shell + load)
        wall = jnp.maximum(outlets.heat_duty + self.heat_loss, 0.0)
        return (
            super().drawn(inside, outlets, figures, feed, gas)
            | heated(wall, self.wall_temperature - HEAT_APPROACH)
            | {"electric_power_drive": driven(turning)}
        )
