"""Rotary drum dryer: cascading solid in a gas stream, or a drum heated through its wall."""

from __future__ import annotations

from math import pi
from typing import Annotated, Any, ClassVar, Literal

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import (
    Distance,
    Fraction,
    HeatTransferCoefficient,
    Law,
    Length,
    PositiveNumber,
    Ratio,
    Temperature,
    TurningSpeed,
    Within,
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.drying.formulas.flights import flight_filling_design, flight_repose_angle
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
HEAPED = 0.6  # share of a heap that is solid
THINNEST = 0.03  # filling of the thinnest drums in which the exchange by volume was measured


@equipment(
    "rotary_dryer",
    source="friedman1949; friedman1949part2; treybal1980, ch. 12; baker1988; ap42_1995",
    title="Rotary dryer",
)
class RotaryDryer(CellDryer):
    """Drum with flights: time of passage after Friedman and Marshall, heat by the volume, tanks in series for
    the spread of residence times.

    The heat by the volume is that of a drum whose flights are full. Say how many there are (``flight_count``)
    and, unless they are a tenth of the diameter deep without a lip, what they are like: with less solid than
    their design filling the gas meets less, and takes part in proportion. Where they are not described this
    begins at the 3 % of the thinnest drums measured. ``wall_coefficient`` adds heat from a steam-heated wall
    over the wetted share of the shell (the conductive drum). With ``entrainment`` the exhaust takes along
    fines that the flights shower once through the gas, evenly along the drum: what falls slower than the gas
    flows, and has not settled before the gas leaves. A measured ``dusting_fraction`` of the feed, the finest
    of it, takes the place of this estimate; ammonium sulfate dryers lose 2 to 3 % (AP-42, recalled).

    A drum with ``passes`` is two or three tubes in one another, of equal sections, through which solid and
    gas go one after the other: it is reckoned as the drum unrolled, narrower and longer. Such drums lie
    level; ``drum_slope`` is then what the pitch of their flights is worth. A heated wall is the outer one.
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
    flight_count: Annotated[PositiveNumber, Within(1, 500)] | None = None
    flight_depth: Length | None = None
    flight_lip: Distance = 0.0
    repose_friction: Ratio = 0.8
    heat_loss: LostHeat = 0.0
    temperature_limit: Temperature | None = None
    cells: Annotated[int, Within(1, 2000)] = 40
    entrainment: bool = False
    dusting_fraction: Fraction | None = None
    passes: Annotated[int, Within(1, 3)] = 1

    limits: ClassVar[Limits] = CellDryer.limits | {
        "filled": Limit("share of the drum filled with solid", 0.03, 0.15, "dimensionless", "friedman1949"),
        "loaded": Limit(
            "solid in the drum over what its flights are designed for",
            0.5,
            1.25,
            "dimensionless",
            "kelly1977, the design filling only: how far a drum may stray from it is our own estimate",
        ),
        "flux": Limit("gas per cross-section of the drum", 0.5, 5.0, "kg/(m^2*s)", "treybal1980, ch. 12"),
        "slender": Limit("length over diameter of the drum", 4.0, 10.0, "dimensionless", "perry2008, ch. 12"),
        "inlet": Limit("gas temperature at the inlet", 373.15, 1173.15, "K", TABLE, quiet=True),
        "capacity": Limit(
            "water evaporated per volume and hour", 3.0, 100.0, "kg/(hour*m^3)", TABLE, quiet=True
        ),
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
        return self.way * self.section

    @property
    def bore(self) -> Any:
        """Diameter of a tube with the section of one pass."""
        return self.diameter / self.passes**0.5

    @property
    def way(self) -> Any:
        """Length of all passes."""
        return self.length * self.passes

    @property
    def section(self) -> Any:
        """Cross-section of one pass."""
        return 0.25 * pi * self.bore**2

    def entrained(self, product: Stream, exhaust: Stream) -> Any:
        if not self.entrainment:
            return None
        if self.dusting_fraction is not None:
            return finest(product, self.dusting_fraction)
        floor = self.bore * self.way
        return showered(fall(product, exhaust), exhaust, floor, self.section)

    def passage(self, feed: Stream, gas: Stream) -> Any:
        """Mean time of passage of the solid."""
        against = 1.0 if self.gas_direction == "counter-current" else -1.0
        blowing = jnp.where(feed.solid_flow > LEAST, gas.gas_flow, 0.0)  # on some solid
        return residence_time_friedman_marshall.function(
            self.way,
            self.bore,
            self.drum_slope,
            self.rotation_speed,
            solid_diameter(feed),
            blowing / self.section,
            jnp.maximum(feed.solid_flow, LEAST) / self.section,
            against,
        )

    def filled(self, held: Any, feed: Stream) -> Any:
        """Share of the drum that so much dry solid fills, heaped."""
        return held / (feed.solid_density * HEAPED) / self.extent()

    @property
    def design_filling(self) -> Any:
        """Filling from which on more solid brings no more exchange."""
        if self.flight_count is None:
            return THINNEST
        depth = 0.1 * self.bore if self.flight_depth is None else self.flight_depth
        angle = flight_repose_angle.function(self.repose_friction, self.bore, self.rotation_speed)
        return flight_filling_design.function(self.bore, self.flight_count, depth, self.flight_lip, angle)

    def contact(self, feed: Stream, gas: Stream) -> Contact:
        n, F = self.cells, feed.solid_by_size
        time = self.passage(feed, gas)
        held = jnp.maximum(jnp.sum(F), LEAST) * time
        solid = jnp.broadcast_to(F * time / n, (n, F.shape[0]))

        def by_volume(flux: Any) -> Any:
            return volumetric_heat_transfer_rotary.function(
                flux, self.bore, self.transfer_constant, self.transfer_exponent
            )

        Ua = in_steam(by_volume, gas.gas_flow / self.section, gas)
        # every class takes heat in proportion to its mass
        showered_share = jnp.minimum(self.filled(held, feed) / self.design_filling, 1.0)
        exchange = Ua * self.extent() * showered_share / held
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
        filled = self.filled(figures.solid_holdup, feed)
        loaded = {} if self.flight_count is None else {"loaded": filled / self.design_filling}
        if self.passes == 1:
            loaded["slender"] = jnp.asarray(self.length / self.diameter)
        return (
            super().measured(inside, outlets, figures, feed, gas)
            | loaded
            | {
                "filled": filled,
                "flux": gas.gas_flow / self.section,
                "inlet": self.temperature_drying(figures, gas),
                "capacity": self.hourly(figures),
            }
        )

    def drawn(
        self, inside: Through, outlets: Dried, figures: DryerFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        load = inside.holdup * (1.0 + feed.moisture_dry_basis)
        tubes = [self.bore * (k + 1) ** 0.5 for k in range(self.passes)]
        shell = sum(pi * tube**2 * self.length * SHELL * STEEL for tube in tubes)
        turning = shaft_power_rotary_drum(self.rotation_speed, self.diameter, load, shell + load)
        wall = jnp.maximum(outlets.heat_duty + self.heat_loss, 0.0)
        return (
            super().drawn(inside, outlets, figures, feed, gas)
            | heated(wall, self.wall_temperature - HEAT_APPROACH)
            | {"electric_power_drive": driven(turning)}
        )
