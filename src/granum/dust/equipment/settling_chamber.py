"""Settling chamber: a wide box in which coarse dust falls out."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import (
    Concentration,
    Fraction,
    Law,
    Length,
    MoleFraction,
    PressureDrop,
    Speed,
    Temperature,
)
from granum.core.limits import Limit
from granum.dust.equipment.collector import EMISSION, IGNITION, Cleaned, Collector, seen
from granum.dust.formulas.chambers import (
    grade_efficiency_chamber_laminar,
    grade_efficiency_chamber_turbulent,
)
from granum.numerics.smooth import safe_divide
from granum.particles.formulas.drag_modern import drag_coefficient_brown_lawler
from granum.particles.formulas.terminal import terminal_velocity
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import AREA, FANNED, fanned

HEADS = 1.5  # velocity heads of the inlet duct lost where it widens and narrows
DUCT_SPEED = 15.0  # m/s, in the duct
FLOWS = {"laminar": grade_efficiency_chamber_laminar, "turbulent": grade_efficiency_chamber_turbulent}
SOURCE = "tan2014, § 6.2"


class ChamberFigures(NamedTuple):
    """Figures of a settling chamber; the critical velocity is that of a particle which just falls the whole
    height.
    """

    gas_velocity: Speed
    settling_velocity_critical: Speed
    pressure_drop: PressureDrop
    removal_efficiency: Fraction
    emission_concentration: Concentration


class Fallen(NamedTuple):
    """Velocity of the gas and of what just falls out, m/s, pressure lost, share of each species and class."""

    velocity: Any
    critical: Any
    drop: Any
    share: Any


@equipment("settling_chamber", source="tan2014, § 6.2", title="Settling chamber")
class SettlingChamber(Collector):
    """Dust falls to the floor of a box while the gas passes slowly; by its terminal velocity each species and
    size.

    Turbulent gas keeps the dust mixed over the height; laminar flow is the upper bound. What has fallen
    stays. Below some 50 µm hardly anything is caught.
    """

    length: Length
    width: Length
    height: Length
    flow: Literal["turbulent", "laminar"] = "turbulent"
    drag: Annotated[Any, Law("drag_coefficient")] = drag_coefficient_brown_lawler
    emission_limit: Concentration = EMISSION
    oxygen_fraction: MoleFraction | None = None
    oxygen_reference: MoleFraction | None = None
    explosible_concentration: Concentration | None = None
    layer_ignition_temperature: Temperature | None = None
    explosion_vent: Annotated[Any, Law("explosion_vent")] = None

    takes_dust: ClassVar[bool] = True
    limits: ClassVar[Limits] = (
        Collector.limits
        | IGNITION
        | {
            "velocity": Limit("gas velocity in a settling chamber", 0.0, 3.0, "m/s", SOURCE),
        }
    )

    utilities: ClassVar[Utilities] = FANNED | AREA

    def inside(self, feed: Stream) -> Fallen:
        gas = seen(feed)
        floor = self.length * self.width
        fall = jnp.maximum(
            terminal_velocity(gas.size, gas.particle_density, gas.density, gas.viscosity, drag=self.drag), 0.0
        )
        share = FLOWS[self.flow](fall, floor, gas.volume_flow)
        return Fallen(
            gas.volume_flow / (self.width * self.height),
            gas.volume_flow / floor,
            HEADS * 0.5 * gas.density * DUCT_SPEED**2,
            share,
        )

    def outlets(self, inside: Fallen, feed: Stream) -> Cleaned:
        return self.parted(feed, inside.share, inside.drop)

    def figures(self, inside: Fallen, outlets: Cleaned, feed: Stream) -> ChamberFigures:
        return ChamberFigures(
            inside.velocity,
            inside.critical,
            inside.drop,
            safe_divide(outlets.dust.solid_flow, feed.solid_flow),
            self.emission(outlets.gas),
        )

    def measured(
        self, inside: Fallen, outlets: Cleaned, figures: ChamberFigures, feed: Stream
    ) -> dict[str, Any]:
        burns = self.ignition(
            feed,
            self.explosible_concentration,
            self.layer_ignition_temperature,
            self.explosion_vent,
        )
        return burns | {
            "emission": self.over_limit(figures.emission_concentration),
            "velocity": inside.velocity,
        }

    def drawn(
        self, inside: Fallen, outlets: Cleaned, figures: ChamberFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "electric_power_fan": fanned(feed.gas_volume_flow, inside.drop),
            "area_installed": self.length * self.width,
        }
