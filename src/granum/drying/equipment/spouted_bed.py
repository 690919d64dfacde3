"""Spouted-bed dryer: grains too coarse to bubble go round through a jet in the middle of their bed."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.flags import unsolved
from granum.core.kinds import (
    Angle,
    Fraction,
    HumidityRatio,
    Law,
    Length,
    Mass,
    MoistureDryBasis,
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
from granum.drying.gas_solid.beds import BedDryer
from granum.drying.gas_solid.dryer import Dried, Through, sized
from granum.drying.gas_solid.kinetics import AbstractKinetics
from granum.drying.gas_solid.liquor import counted
from granum.drying.kinds import LostHeat
from granum.fluidization.formulas.spouting import (
    CONE,
    WIDE_JET,
    bed_depth_cone_cylinder,
    minimum_spouting_velocity_mathur_gishler,
    spoutable_depth_mcnab_bridgwater,
    spouting_pressure_drop_lefroy_davidson,
    starting_pressure_drop_asenjo,
)
from granum.streams.cakes import solid_diameter
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import AREA, ducted

BOOK = "mathur1974, recalled"
WORKING = 1.4  # minimum spouting velocities, for which a dryer is sized
DENSER = 1.01  # grains over gas, at least: what gas cannot leave behind has no spout


class SpoutedBedFigures(NamedTuple):
    """Figures of a spouted-bed dryer."""

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
    superficial_velocity: Speed
    minimum_spouting_velocity: Speed
    bed_depth: Length
    spoutable_depth: Length
    spouting_pressure_drop: PressureDrop
    starting_pressure_drop: PressureDrop


class Spout(NamedTuple):
    """The bed as it spouts, with grains as moist as they leave and gas as warm as it leaves."""

    superficial_velocity: Any
    minimum_spouting_velocity: Any
    bed_depth: Any
    spoutable_depth: Any
    spouting_pressure_drop: Any
    starting_pressure_drop: Any


@equipment(
    "spouted_bed_dryer",
    source="mathur1955; becker1960, recalled; mathur1974, recalled",
    title="Spouted-bed dryer",
)
class SpoutedBedDryer(BedDryer):
    """Each particle dries by its own kinetics in the gas of a bed that a jet keeps mixed: grains fly up in
    the spout and sink round it, and gas and grains leave almost alike.

    ``mass`` is the dry solid in ``parallel_number`` equal vessels, a cone below a cylinder each;
    ``cone_angle`` is between wall and axis. Particles stay for exponentially distributed times, so that some
    leave as they came. The grains are as dense as their solid and their water. ``bypass_fraction`` is gas
    that the spout carries past the grains, none in beds of some 20 cm. The spout is that of the gas as it
    leaves, denser than it entered; the fan has the pressure of the open spout, and must give the starting
    pressure for a moment.
    """

    diameter: Length
    inlet_diameter: Length
    mass: Mass
    kinetics: Annotated[Any, Law("drying_kinetics")]
    parallel_number: Annotated[PositiveNumber, Within(1.0, 1000.0)] = 1.0
    cone_angle: Angle = CONE
    void_fraction: VoidFraction = 0.42
    bypass_fraction: Fraction = 0.0
    heat_loss: LostHeat = 0.0
    temperature_limit: Temperature | None = None

    cells: ClassVar[int] = 1

    limits: ClassVar[Limits] = BedDryer.limits | {
        "spouting": Limit("gas velocity over minimum spouting velocity", 1.2, 1.7, "dimensionless", BOOK),
        "depth": Limit(
            "depth of the bed over that of the deepest that spouts", 0.0, 1.0, "dimensionless", "mcnab1977"
        ),
        "slender": Limit("diameter of the vessel over that of the inlet", 3.0, 12.0, "dimensionless", BOOK),
        "orifice": Limit(
            "diameter of the inlet over that of the grains",
            0.0,
            25.0,
            "dimensionless",
            "chandnani1986, recalled",
        ),
        "grains": Limit("size of the grains", 1e-3, 1e-2, "m", "geldart1973; " + BOOK),
        "vessel": Limit("diameter of each vessel", 0.07, 0.61, "m", "mathur1955; peterson1962"),
    }

    utilities: ClassVar[Utilities] = BedDryer.utilities | AREA

    def inside(self, feed: Stream, gas: Stream, *more: Any, **others: Any) -> Through:
        unsolved(self.inlet_diameter < self.diameter, type(self).card, reason=WIDE_JET)
        return super().inside(feed, gas, *more, **others)

    def extent(self) -> Any:
        return self.parallel_number * 0.25 * jnp.pi * self.diameter**2

    def holdup(self, feed: Stream) -> Any:
        return self.mass

    def bypass(self, feed: Stream, gas: Stream) -> Any:
        return self.bypass_fraction

    @property
    def lost(self) -> Any:
        return self.heat_loss

    @classmethod
    def size(
        cls,
        moisture_outlet: Any,
        feed: Stream,
        gas: Stream,
        diameter: Any,
        inlet_diameter: Any,
        kinetics: AbstractKinetics,
        **more: Any,
    ) -> SpoutedBedDryer:
        """As many vessels as the gas makes spout at no less than 1.4 times the minimum, and the bed in which
        the solid stays as long as a product moisture needs.
        """

        def bed(number: float) -> SpoutedBedDryer:
            first = cls(
                diameter, inlet_diameter, 600.0 * feed.solid_flow, kinetics, parallel_number=number, **more
            )
            return sized(first, "mass", moisture_outlet, 1e-3, 1e7, feed, gas)

        found = bed(1.0)
        outlets = found(feed, gas)
        number = 1.0
        while number < 1000.0 and found.working(number + 1.0, outlets) >= WORKING:
            number += 1.0
        return bed(number)

    def working(self, number: Any, outlets: Dried) -> Any:
        """Gas over minimum spouting velocity with the same bed in so many vessels."""
        found = eqx.tree_at(lambda d: d.parallel_number, self, number).spout(outlets)
        return found.superficial_velocity / found.minimum_spouting_velocity

    def spout(self, outlets: Dried) -> Spout:
        grains, gas = counted(outlets.product), outlets.exhaust
        some = grains.solid_flow > 0.0
        flow = jnp.where(some, grains.solid_flow, 1.0)
        X = jnp.where(some, grains.liquid_flow / flow, 0.0)
        volume = jnp.where(some, grains.slurry_volume_flow / flow, 1e-3)  # of moist grain per dry solid
        light = gas.gas_density
        dense = jnp.maximum((1.0 + X) / volume, DENSER * light)
        vessel = self.mass / self.parallel_number * volume / (1.0 - self.void_fraction)
        depth = bed_depth_cone_cylinder.function(vessel, self.diameter, self.inlet_diameter, self.cone_angle)
        jet = {
            "particle_diameter": solid_diameter(grains),
            "particle_density": dense,
            "fluid_density": light,
            "diameter": self.diameter,
            "inlet_diameter": self.inlet_diameter,
        }
        weight = (dense, light, self.void_fraction)
        return Spout(
            gas.gas_volume_flow / self.extent(),
            minimum_spouting_velocity_mathur_gishler.function(**jet, bed_depth=depth),
            depth,
            spoutable_depth_mcnab_bridgwater.function(**jet, dynamic_viscosity=gas.gas_viscosity),
            spouting_pressure_drop_lefroy_davidson.function(depth, *weight),
            starting_pressure_drop_asenjo.function(depth, self.diameter, *weight),
        )

    def figures(
        self, inside: Through, outlets: Dried, feed: Stream, gas: Stream, **_others: Any
    ) -> SpoutedBedFigures:
        return SpoutedBedFigures(*super().figures(inside, outlets, feed, gas), *self.spout(outlets))

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
            "spouting": figures.superficial_velocity / figures.minimum_spouting_velocity,
            "depth": figures.bed_depth / figures.spoutable_depth,
            "slender": self.diameter / self.inlet_diameter,
            "orifice": self.inlet_diameter / solid_diameter(feed),
            "grains": solid_diameter(feed),
            "vessel": self.diameter,
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
            "electric_power_fan": ducted(gas, figures.spouting_pressure_drop),
            "area_installed": self.extent(),
        }
