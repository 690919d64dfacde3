"""Vibrated fluidized-bed dryer: a shallow bed that its floor throws along, in gas that may be slow."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Angle,
    Frequency,
    HumidityRatio,
    Law,
    Length,
    Mass,
    MoistureDryBasis,
    Number,
    PositiveNumber,
    Power,
    PressureDrop,
    Ratio,
    SignedMassFlow,
    Speed,
    Temperature,
    TemperatureDifference,
    Time,
    VoidFraction,
    Within,
)
from granum.core.limits import Limit
from granum.drying.formulas.beds import bypass_fraction_groenewold_tsotsas
from granum.drying.formulas.vibration import Throw, minimum_mixing_velocity_gupta_mujumdar, vibration_throw
from granum.drying.gas_solid.beds import BedDryer
from granum.drying.gas_solid.dryer import Dried, Through, sized
from granum.drying.gas_solid.kinetics import AbstractKinetics
from granum.drying.kinds import LostHeat
from granum.fluidization.formulas.minimum import minimum_fluidization_velocity_wen_yu
from granum.porous.formulas.packed_beds import pressure_gradient_ergun
from granum.streams.cakes import solid_diameter
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import AREA, DRIVE, driven, ducted

BOOK = "mujumdar2014, recalled"
DISTRIBUTOR = 0.3  # of the pressure drop of the bed
SLOWEST = 5e-3  # m/s, of a bed that is not thrown: loosened by gas it flows to the weir by itself
LOWEST = 1e-3  # m, of a weir
STEEPEST = 1.5  # throw number from which on no gas is needed to mix


class VibratedBedFigures(NamedTuple):
    """Figures of a vibrated fluidized-bed dryer."""

    # negative where the solid came in drier than it is in equilibrium with the gas
    evaporation_rate: SignedMassFlow
    moisture_dry_basis: MoistureDryBasis
    moisture_dry_basis_highest: MoistureDryBasis
    temperature_product: Temperature
    temperature_product_highest: Temperature
    temperature_exhaust: Temperature
    humidity_ratio: HumidityRatio
    relative_humidity: Ratio
    superheat: TemperatureDifference
    solid_holdup: Mass
    residence_time: Time
    heat_duty: Power
    bed_depth: Length
    throw_number: Number
    throw_velocity: Speed
    superficial_velocity: Speed
    minimum_fluidization_velocity: Speed
    minimum_mixing_velocity: Speed
    pressure_drop: PressureDrop
    shaft_power: Power


@equipment(
    "vibrated_bed_dryer",
    source="gupta1980, recalled; lehmann2021, program only; groenewold1997",
    title="Vibrated fluidized-bed dryer",
)
class VibratedBedDryer(BedDryer):
    """The floor throws a shallow bed along through gas that need not fluidize it: solid in plug flow, each
    particle drying by its own kinetics.

    Solid advances at ``transport_factor`` times the velocity of a thrown grain (a maker of conveyors reckons
    with 0.7 to 0.8), and lies as deep as that makes it, but no less than the weir at the end, over which it
    leaves. It passes ``cells`` tanks in series, each with fresh gas; of gas beyond the still bed's minimum
    fluidization velocity part may pass by in bubbles. The drive has the power of the landings, without that
    of its springs; the floor takes 0.3 of the pressure of the bed. ``throw_angle`` is that of the stroke
    above the floor, ``amplitude`` half the stroke.
    """

    length: Length
    width: Length
    kinetics: Annotated[Any, Law("drying_kinetics")]
    amplitude: Length = 3e-3
    vibration_frequency: Frequency = 12.0
    throw_angle: Angle = math.radians(60.0)
    weir_height: Length = 0.1
    transport_factor: Annotated[PositiveNumber, Within(0.01, 1.0)] = 0.75
    cells: Annotated[int, Within(2, 500)] = 20
    void_fraction: VoidFraction = 0.45
    heat_loss: LostHeat = 0.0
    temperature_limit: Temperature | None = None

    limits: ClassVar[Limits] = BedDryer.limits | {
        "throw": Limit("throw number", 1.0, 3.3, "dimensionless", "coppers2003, second-hand"),
        "frequency": Limit("frequency of the vibration", 5.0, 25.0, "1/s", BOOK),
        "amplitude": Limit("amplitude of the vibration", 1e-3, 6e-3, "m", BOOK),
        "mixed": Limit("gas velocity beyond the minimum that mixes", 0.0, 3.0, "m/s", "gupta1980, recalled"),
        "fluidized": Limit(
            "gas velocity over that which fluidizes the still bed", 0.2, 3.0, "dimensionless", BOOK
        ),
        "shallow": Limit("depth of the bed", 0.02, 0.3, "m", BOOK),
    }

    utilities: ClassVar[Utilities] = BedDryer.utilities | AREA | DRIVE

    def extent(self) -> Any:
        return self.length * self.width

    @property
    def lost(self) -> Any:
        return self.heat_loss

    @property
    def throw(self) -> Throw:
        return vibration_throw.function(self.amplitude, self.vibration_frequency, self.throw_angle)

    def depth(self, feed: Stream) -> Any:
        """Of the settled bed: what the throw carries, but no less than the weir keeps."""
        speed = jnp.maximum(self.transport_factor * self.throw.throw_velocity, SLOWEST)
        carried = feed.solid_flow / (self._bulk(feed) * self.width * speed)
        return jnp.maximum(carried, self.weir_height)

    def _bulk(self, feed: Stream) -> Any:
        return feed.solid_density * (1.0 - self.void_fraction)

    def holdup(self, feed: Stream) -> Any:
        return self.depth(feed) * self.extent() * self._bulk(feed)

    def minimum_velocity(self, feed: Stream, gas: Stream) -> Any:
        """Of fluidization without vibration, with the gas of the inlet."""
        return minimum_fluidization_velocity_wen_yu.function(
            solid_diameter(feed), feed.solid_density, gas.gas_density, gas.gas_viscosity
        )

    def bypass(self, feed: Stream, gas: Stream) -> Any:
        return bypass_fraction_groenewold_tsotsas.function(
            gas.gas_volume_flow / self.extent(), self.minimum_velocity(feed, gas), self.depth(feed)
        )

    @classmethod
    def size(
        cls,
        moisture_outlet: Any,
        feed: Stream,
        gas: Stream,
        gas_velocity: Any,
        kinetics: AbstractKinetics,
        length: Any,
        **more: Any,
    ) -> VibratedBedDryer:
        """The floor of a length that the inlet gas crosses at a velocity, with the weir that keeps the solid
        as long as a product moisture needs: hardly any where the throw is slow enough for that.
        """
        width = float(gas.gas_volume_flow / gas_velocity / length)
        bare = cls(length, width, kinetics, weir_height=LOWEST, **more)
        if float(bare(feed, gas).product.moisture_dry_basis) <= float(moisture_outlet):
            return bare
        return sized(bare, "weir_height", moisture_outlet, 0.5 * LOWEST, 10.0, feed, gas)

    def pressure_lost(self, feed: Stream, gas: Stream) -> Any:
        """Of the gas in the settled bed, its weight at most, and 0.3 of it in the floor."""
        packed = pressure_gradient_ergun.function(
            superficial_velocity=gas.gas_volume_flow / self.extent(),
            particle_diameter=solid_diameter(feed),
            void_fraction=self.void_fraction,
            dynamic_viscosity=gas.gas_viscosity,
            fluid_density=gas.gas_density,
        )
        carried = jnp.minimum(packed, self._bulk(feed) * STANDARD_GRAVITY)
        return (1.0 + DISTRIBUTOR) * carried * self.depth(feed)

    def figures(
        self, inside: Through, outlets: Dried, feed: Stream, gas: Stream, **_others: Any
    ) -> VibratedBedFigures:
        whole, throw = super().figures(inside, outlets, feed, gas), self.throw
        U, still = gas.gas_volume_flow / self.extent(), self.minimum_velocity(feed, gas)
        moist = whole.solid_holdup * (1.0 + feed.moisture_dry_basis)
        return VibratedBedFigures(
            *whole,
            bed_depth=self.depth(feed),
            throw_number=throw.throw_number,
            throw_velocity=throw.throw_velocity,
            superficial_velocity=U,
            minimum_fluidization_velocity=still,
            minimum_mixing_velocity=minimum_mixing_velocity_gupta_mujumdar.function(
                still, jnp.minimum(throw.throw_number, STEEPEST)
            ),
            pressure_drop=self.pressure_lost(feed, gas),
            shaft_power=moist * throw.vibration_power,
        )

    def measured(
        self,
        inside: Through,
        outlets: Dried,
        figures: Any,
        feed: Stream,
        gas: Stream,
        **_others: Any,
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, gas) | {
            "throw": figures.throw_number,
            "frequency": self.vibration_frequency,
            "amplitude": self.amplitude,
            "mixed": figures.superficial_velocity - figures.minimum_mixing_velocity,
            "fluidized": figures.superficial_velocity / figures.minimum_fluidization_velocity,
            "shallow": figures.bed_depth,
        }

    def drawn(
        self,
        inside: Through,
        outlets: Dried,
        figures: Any,
        feed: Stream,
        gas: Stream,
        **_others: Any,
    ) -> dict[str, Any]:
        return super().drawn(inside, outlets, figures, feed, gas) | {
            "electric_power_fan": ducted(gas, figures.pressure_drop),
            "electric_power_drive": driven(figures.shaft_power),
            "area_installed": self.extent(),
        }
