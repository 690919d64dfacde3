"""Fluidized-bed dryer: well mixed, or long and narrow with solid in plug flow; gas passes as bubbles and
through the dense phase.
"""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Area,
    AreaOrZero,
    Fraction,
    HeatTransferCoefficient,
    HumidityRatio,
    Law,
    Mass,
    MoistureDryBasis,
    Power,
    Pressure,
    Ratio,
    SignedMassFlow,
    Temperature,
    TemperatureDifference,
    Time,
    VoidFraction,
    Within,
)
from granum.core.limits import Limit
from granum.drying.formulas.beds import bypass_fraction_groenewold_tsotsas
from granum.drying.gas_solid.beds import BedDryer
from granum.drying.gas_solid.dryer import NOTES, Dried, Through, sized
from granum.drying.gas_solid.kinetics import AbstractKinetics
from granum.drying.kinds import LostHeat
from granum.fluidization.equipment.bed import FluidizedBed
from granum.fluidization.formulas.heat import heat_transfer_coefficient_zabrodsky
from granum.fluidization.formulas.minimum import minimum_fluidization_velocity_wen_yu
from granum.materials.formulas.water import water_boiling_temperature
from granum.streams.atmosphere import VENTED
from granum.streams.cakes import solid_diameter
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import AREA, HEAT_APPROACH, HEATED, heated

TABLE = NOTES.format(table="IV.16")
COILS = (
    "kunii1991, ch. 13; tubes of 4 cm two diameters apart, and 70 % of the greatest coefficient on a bundle "
    "of them, are our own estimate"
)
DISTRIBUTOR = 0.3  # of the pressure drop of the bed
BUNDLE = 0.7  # of the greatest heat transfer coefficient, on tubes in a bundle
LEAST = 1.0  # K between steam and bed, below which coils would only grow


class FluidBedFigures(NamedTuple):
    """Figures of a fluidized-bed dryer."""

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
    area_coil: AreaOrZero
    heat_transfer_coefficient_coil: HeatTransferCoefficient


@equipment(
    "fluidized_bed_dryer",
    source="kunii1991, ch. 16; vanecek1966; groenewold1997",
    title="Fluidized-bed dryer",
)
class FluidBedDryer(BedDryer):
    """Each particle dries by its own kinetics in the gas of the dense phase; part of the gas passes by in
    bubbles.

    With one cell the bed is well mixed: its gas is one, and particles stay for exponentially distributed
    times, so that some leave as they came. With more cells solid flows along the bed through that many
    tanks in series, each with fresh gas. The bypass is the bubble gas that the dense phase has not reached,
    after Groenewold and Tsotsas, unless it is given. ``coil_duty`` is heat by coils in the bed, alike in all
    cells; their area follows from steam of ``pressure_steam``, the bed around them and 70 % of Zabrodsky's
    greatest coefficient, the resistance of steam and wall left out. With ``entrainment`` the exhaust takes
    fines along by their elutriation constant, as ``fluidization.fluidized_bed`` does; else all solid
    overflows. An ``explosion_vent`` is that of the chamber.
    """

    area: Area
    mass: Mass
    kinetics: Annotated[Any, Law("drying_kinetics")]
    cells: Annotated[int, Within(1, 500)] = 1
    bypass_fraction: Fraction | None = None
    void_fraction: VoidFraction = 0.45
    heat_loss: LostHeat = 0.0
    temperature_limit: Temperature | None = None
    entrainment: bool = False
    explosion_vent: Annotated[Any, Law("explosion_vent")] = None
    coil_duty: LostHeat = 0.0
    pressure_steam: Pressure = 4e5

    limits: ClassVar[Limits] = (
        BedDryer.limits
        | {
            "fluidized": Limit(
                "gas velocity over minimum fluidization velocity", 1.5, 100.0, "dimensionless", "kunii1991"
            ),
            "velocity": Limit("gas velocity at the inlet", 0.2, 3.0, "m/s", TABLE),
            "inlet": Limit("gas temperature at the inlet", 323.15, 473.15, "K", TABLE, quiet=True),
            "time": Limit("residence time of the solid", 120.0, 3600.0, "s", TABLE),
            "capacity": Limit(
                "water evaporated per area and hour", 30.0, 200.0, "kg/(hour*m^2)", TABLE, quiet=True
            ),
            "warmer": Limit(
                "steam in the coils above the hottest bed", 5.0, math.inf, "delta_degC", COILS, quiet=True
            ),
            "room": Limit("area of the coils per volume of settled bed", 0.0, 20.0, "1/m", COILS, quiet=True),
            "grains": Limit(
                "size of the grains for which the coefficient of the coils is known",
                4e-5,
                5e-4,
                "m",
                "zabrodsky1966",
                quiet=True,
            ),
        }
        | VENTED
    )

    utilities: ClassVar[Utilities] = BedDryer.utilities | HEATED | AREA

    def extent(self) -> Any:
        return self.area

    def holdup(self, feed: Stream) -> Any:
        return self.mass

    @property
    def lost(self) -> Any:
        """Heat that the bed loses, less that of its coils, W."""
        return self.heat_loss - self.coil_duty

    def height(self, feed: Stream) -> Any:
        """Of the settled bed."""
        return self.mass / (self.area * feed.solid_density * (1.0 - self.void_fraction))

    def entrained(self, product: Stream, exhaust: Stream) -> Any:
        if not self.entrainment:
            return None
        bed = product.replace(gas=exhaust.gas, temperature=exhaust.temperature, pressure=exhaust.pressure)
        return FluidizedBed(self.area, self.mass, self.void_fraction).inside(bed).carried

    def minimum_velocity(self, feed: Stream, gas: Stream) -> Any:
        """Of fluidization, with the gas of the inlet."""
        return minimum_fluidization_velocity_wen_yu.function(
            solid_diameter(feed), feed.solid_density, gas.gas_density, gas.gas_viscosity
        )

    def bypass(self, feed: Stream, gas: Stream) -> Any:
        """Share of the gas that leaves as it entered."""
        if self.bypass_fraction is not None:
            return self.bypass_fraction
        return bypass_fraction_groenewold_tsotsas.function(
            gas.gas_volume_flow / self.area, self.minimum_velocity(feed, gas), self.height(feed)
        )

    @classmethod
    def size(
        cls,
        moisture_outlet: Any,
        feed: Stream,
        gas: Stream,
        gas_velocity: Any,
        kinetics: AbstractKinetics,
        **more: Any,
    ) -> FluidBedDryer:
        """The bed in which the inlet gas has a velocity, and the solid stays as long as a product moisture
        needs.
        """
        area = float(gas.gas_volume_flow / gas_velocity)
        return sized(cls(area, 200.0 * area, kinetics, **more), "mass", moisture_outlet, 1e-3, 1e7, feed, gas)

    @property
    def temperature_steam(self) -> Any:
        return water_boiling_temperature(self.pressure_steam)

    def figures(
        self, inside: Through, outlets: Dried, feed: Stream, gas: Stream, **_others: Any
    ) -> FluidBedFigures:
        whole = super().figures(inside, outlets, feed, gas)
        coefficient = BUNDLE * heat_transfer_coefficient_zabrodsky.function(
            solid_diameter(feed), feed.solid_density, gas.gas_conductivity
        )
        warmer = jnp.maximum(self.temperature_steam - inside.profile.gas_temperature, LEAST)
        return FluidBedFigures(
            *whole,
            area_coil=jnp.mean(self.coil_duty / (coefficient * warmer)),
            heat_transfer_coefficient_coil=coefficient,
        )

    def measured(
        self, inside: Through, outlets: Dried, figures: Any, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        found = super().measured(inside, outlets, figures, feed, gas)
        hottest = jnp.max(inside.profile.gas_temperature)
        there = jnp.asarray(self.coil_duty) > 0.0
        found["warmer"] = jnp.where(there, self.temperature_steam - hottest, 0.0)
        found["grains"] = jnp.where(there, solid_diameter(feed), 0.0)
        found["room"] = figures.area_coil / (self.area * self.height(feed))
        U = gas.gas_volume_flow / self.area
        return found | {
            "fluidized": U / self.minimum_velocity(feed, gas),
            "velocity": U,
            "inlet": self.temperature_drying(figures, gas),
            "time": figures.residence_time,
            "capacity": self.hourly(figures),
        }

    def pressure_lost(self, feed: Stream, gas: Stream) -> Any:
        """Weight of the bed, and a third of it in the distributor."""
        return (1.0 + DISTRIBUTOR) * self.mass * STANDARD_GRAVITY / self.area

    def drawn(
        self, inside: Through, outlets: Dried, figures: Any, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        coils = heated(self.coil_duty, self.temperature_steam - HEAT_APPROACH)
        return super().drawn(inside, outlets, figures, feed, gas) | coils | {"area_installed": self.area}
