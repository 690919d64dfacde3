"""What every spinning bowl without a screen shares: velocities and grade efficiency of sinking and rising
classes, sediment, power, wall.
"""

from __future__ import annotations

import abc
from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar

import jax.numpy as jnp

from granum.centrifuges.formulas.clarifying import (
    cut_size_centrifuge,
    grade_efficiency_thin_layer,
)
from granum.centrifuges.formulas.field import centrifugal_effect, liquid_pressure_bowl
from granum.centrifuges.formulas.mechanics import (
    hoop_stress_bowl,
    power_acceleration,
    power_windage,
)
from granum.core.errors import InputError
from granum.core.i18n import _ as translated
from granum.core.kinds import Density, Length, OpenFraction, PositiveNumber, Stress, TurningSpeed, Within
from granum.core.limits import Limit
from granum.core.units import format_number
from granum.settling.equipment.gravity import (
    DRAG,
    HINDRANCE,
    class_velocities,
    floating_share,
    floats,
)
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import DRIVE, driven

Ends = tuple[float, float]
THIN = 0.0999  # of the radius: the thickest wall that counts as thin


def refuse_beyond(inner: Any, outer: Any, name: str, message: str) -> None:
    """Refuse two known radii of which the first is not the smaller; ``message`` says where it has to lie."""
    if isinstance(inner, float) and isinstance(outer, float) and inner >= outer:
        raise InputError(
            translated(message).format(inner=format_number(inner), outer=format_number(outer)), name=name
        )


def machine_limits(*, solids: Ends, flow: Ends, effect: Ends, source: str) -> Limits:
    """Limits that every machine has, with its own ends."""
    return {
        "solids": Limit("solids in the feed by volume", *solids, "dimensionless", source),
        "flow": Limit("feed flow", *flow, "m^3/s", source),
        "effect": Limit("centrifugal effect", *effect, "dimensionless", source),
        "stress": Limit("hoop stress over that allowed", 0.0, 1.0, "dimensionless", "budynas2015, ch. 3"),
    }


def no_floats(source: str) -> Limits:
    """That of a machine with one liquid outlet."""
    return {
        "floats": Limit(
            "floating matter, which has no outlet here", 0.0, 0.01, "dimensionless", source, quiet=True
        )
    }


def slender(low: float, high: float) -> Limits:
    """Length over radius."""
    return {"slender": Limit("bowl length over radius", low, high, "dimensionless", "robatel1989")}


CRITICAL: Limits = {
    "critical": Limit("speed over the critical speed", 0.0, 0.5, "dimensionless", "budynas2015, ch. 7")
}


def excess_density(feed: Stream, rising: Any) -> Any:
    """Mean difference of density from the liquid, kg/m³, of the species that rise (1) or sink (0); of the
    others where the mixture has none of these.
    """
    densities = feed.mixture.densities("solids", feed.temperature)
    light = floats(feed)
    wanted = light if rising else 1.0 - light
    meant = jnp.where(jnp.any(wanted > 0), wanted, 1.0)
    flows = meant * feed.solid_by_species
    volumes = jnp.where(jnp.sum(flows) > 0, flows, meant) / densities
    apart = jnp.abs(densities - feed.liquid_density)
    return jnp.maximum(jnp.sum(volumes * apart) / jnp.sum(volumes), 1e-3)


def held_liquid(caught: Stream, liquid_volume_flow: Any, solids_fraction: Any) -> Any:
    """Share of a liquid that a catch holds in its voids, at most all."""
    void = caught.solid_volume_flow * (1.0 / solids_fraction - 1.0)
    some = liquid_volume_flow > 0
    return jnp.where(some, jnp.minimum(void / jnp.where(some, liquid_volume_flow, 1.0), 1.0), 0.0)


class Bowl(Unit):
    """Abstract bowl that settles.

    Particles of each species settle, or rise, as in Stokes' range at the centrifugal effect of the mean
    radius (with the drag of their true Reynolds number), hindered by one another; drops count as rigid
    spheres. ``sediment_solids_fraction`` is the volume fraction of solid in what is discharged, from a spin
    test; ``sigma_efficiency`` derates the machine against its theory. ``bowl_radius`` is that of the wall,
    whose thickness is about a tenth of it unless given, and which is of steel unless ``wall_density`` says
    otherwise.
    """

    radius_inner: Length
    radius_outer: Length
    rotation_speed: TurningSpeed
    _: KW_ONLY
    sediment_solids_fraction: OpenFraction = 0.5
    sigma_efficiency: PositiveNumber = 0.6
    bowl_radius: Length | None = None
    wall_thickness: Length | None = None
    stress_allowed: Stress = 3e8
    wall_density: Annotated[Density, Within(500.0, 2.5e4)] = 7850.0

    utilities: ClassVar[Utilities] = DRIVE

    def drawn(self, inside: None, outlets: Any, figures: Any, feed: Stream) -> dict[str, Any]:
        return {"electric_power_drive": driven(figures.shaft_power)}

    def __check_init__(self) -> None:
        refuse_beyond(
            self.radius_inner,
            self.radius_outer,
            "radius_inner",
            "The inner radius, {inner} m, must be smaller than the outer one, {outer} m.",
        )

    @abc.abstractmethod
    def sigma(self) -> Any:
        """Equivalent settling area; Q = ``flow_multiple`` · v_g Σ at the size that is caught by half."""

    @property
    @abc.abstractmethod
    def outside_length(self) -> Any:
        """Length of the turning bowl, on which the air drags."""

    @property
    def flow_multiple(self) -> Any:
        """Convention of Sigma."""
        return 2.0

    @property
    def wall(self) -> Any:
        """Radius of the bowl wall."""
        return self.radius_outer if self.bowl_radius is None else self.bowl_radius

    @property
    def thickness(self) -> Any:
        """Of the bowl wall."""
        return THIN * self.wall if self.wall_thickness is None else self.wall_thickness

    def efficiency(self, velocity: Any, flow: Any) -> Any:
        """Share of a size caught at the wall, from its settling velocity under gravity and the flow."""
        return grade_efficiency_thin_layer(velocity, flow, self.sigma())

    def velocities(self, feed: Stream) -> Any:
        """Velocity of each species and size class under gravity, m/s, with the drag it has in the field;
        negative for what rises.
        """
        effect = centrifugal_effect(0.5 * (self.radius_inner + self.radius_outer), self.rotation_speed)
        return class_velocities(feed, DRAG, HINDRANCE, effect)

    def grade(self, feed: Stream) -> Any:
        """Share of each species and size class caught at the wall."""
        velocity = self.velocities(feed)
        flow = jnp.maximum(feed.slurry_volume_flow, 1e-300)
        share = self.efficiency(self.sigma_efficiency * jnp.maximum(velocity, 0.0), flow)
        return jnp.where(velocity > 0, share, 0.0)

    def cut_size(self, feed: Stream, sigma: Any, rising: bool = False) -> Any:
        """Size of which half is caught, of what sinks or rises."""
        return cut_size_centrifuge(
            feed.slurry_volume_flow,
            sigma,
            feed.liquid_density + excess_density(feed, rising),
            feed.liquid_density,
            feed.liquid_viscosity,
            self.flow_multiple,
            self.sigma_efficiency,
        )

    def acceleration(self, sediment: Stream, *liquids: Stream) -> Any:
        """Power that the outlets carry off: sediment from the wall, liquids over the inner radius, W."""
        clear = sum(part.solid_flow + part.liquid_flow for part in liquids)
        return power_acceleration(
            sediment.solid_flow + sediment.liquid_flow, self.wall, self.rotation_speed
        ) + power_acceleration(clear, self.radius_inner, self.rotation_speed)

    def windage(self) -> Any:
        """Power that the air takes up, W."""
        return power_windage(self.wall, self.outside_length, self.rotation_speed)

    def stress(self, feed: Stream) -> Any:
        """Hoop stress in the wall, full of slurry, Pa."""
        volume = feed.slurry_volume_flow
        some = volume > 0
        slurry = (feed.solid_flow + feed.liquid_flow) / jnp.where(some, volume, 1.0)
        pressure = liquid_pressure_bowl(
            self.wall,
            self.radius_inner,
            self.rotation_speed,
            jnp.where(some, slurry, feed.liquid_density),
        )
        return hoop_stress_bowl(self.wall, self.thickness, self.rotation_speed, pressure, self.wall_density)

    def measured_bowl(self, feed: Stream, figures: Any) -> dict[str, Any]:
        """Numbers for the limits that machines share."""
        return {
            "solids": feed.solids_volume_fraction,
            "flow": feed.slurry_volume_flow,
            "effect": figures.centrifugal_effect,
            "stress": figures.hoop_stress_bowl / self.stress_allowed,
            "speed": self.rotation_speed,
            "pond": self.radius_inner / self.radius_outer,
            "floats": floating_share(feed),
        }
