"""Settling centrifuges in a line: tubular bowl, disc stack, scroll decanter, solid basket. Each size class by
its own grade efficiency.
"""

from __future__ import annotations

import abc
from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.centrifuges.formulas.clarifying import (
    cut_size_centrifuge,
    grade_efficiency_thin_layer,
    grade_efficiency_tubular,
    sigma_factor_disc,
    sigma_factor_scroll,
    sigma_factor_tubular_half_area,
)
from granum.centrifuges.formulas.field import centrifugal_effect
from granum.core import equipment
from granum.core.constants import RPM
from granum.core.kinds import (
    Angle,
    Area,
    Distance,
    Fraction,
    Length,
    MassFlow,
    MoistureDryBasis,
    OpenFraction,
    PositiveNumber,
    Power,
    Ratio,
    RotationSpeed,
    Within,
)
from granum.core.limits import Limit
from granum.settling.equipment.gravity import (
    DRAG,
    HINDRANCE,
    class_velocities,
    floating_share,
    over_axes,
)
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import DRIVE, driven

Ends = tuple[float, float]


class Clarified(NamedTuple):
    """Sediment with the liquid it holds, and the clarified liquid with the solid that escapes."""

    sediment: Stream
    overflow: Stream


class ClarifierFigures(NamedTuple):
    """Figures of a settling centrifuge."""

    solids_recovery: Fraction
    cut_size_centrifuge: Distance
    sigma_factor: Area
    centrifugal_effect: Ratio
    shaft_power: Power
    moisture_dry_basis: MoistureDryBasis
    mass_flow_sediment: MassFlow


def _machine_limits(*, solids: Ends, flow: Ends, effect: Ends, source: str) -> Limits:
    """Limits that every machine has, with its own ends."""
    return {
        "solids": Limit("solids in the feed by volume", *solids, "dimensionless", source),
        "flow": Limit("feed flow", *flow, "m^3/s", source),
        "effect": Limit("centrifugal effect", *effect, "dimensionless", source),
        "floats": Limit("floating matter, which has no outlet here", 0.0, 0.01, "dimensionless", source),
    }


def excess_density(feed: Stream) -> Any:
    """By how much the solids that sink are denser than the liquid, kg/m³; what floats is lighter where
    nothing sinks.
    """
    densities = feed.mixture.densities("solids", feed.temperature)
    apart = densities - feed.liquid_density
    sinks = apart > 0
    flows = jnp.where(jnp.any(sinks), jnp.where(sinks, feed.solid_by_species, 0.0), feed.solid_by_species)
    alike = jnp.where(jnp.any(sinks), 1.0 * sinks, jnp.ones_like(apart))
    flows = jnp.where(jnp.sum(flows) > 0, flows, alike)
    volumes = flows / densities
    return jnp.maximum(jnp.sum(volumes * jnp.abs(apart)) / jnp.sum(volumes), 1e-3)


def _slender(low: float, high: float) -> Limits:
    return {"slender": Limit("bowl length over radius", low, high, "dimensionless", "robatel1989")}


class SettlingCentrifuge(Unit):
    """Abstract settling centrifuge.

    Particles of each species settle as in Stokes' range at the centrifugal effect of the mean radius (with
    the drag of their true Reynolds number), hindered by one another; drops count as rigid spheres.
    ``sediment_solids_fraction`` is the volume fraction of solid in what is discharged: a property of the
    sediment, from a spin test. ``sigma_efficiency`` derates the machine against its theory.
    """

    radius_inner: Length
    radius_outer: Length
    rotation_speed: RotationSpeed
    _: KW_ONLY
    sediment_solids_fraction: OpenFraction = 0.5
    sigma_efficiency: PositiveNumber = 0.6

    utilities: ClassVar[Utilities] = DRIVE

    @abc.abstractmethod
    def sigma(self) -> Any:
        """Equivalent settling area; Q = ``flow_multiple`` · v_g Σ at the size that is caught by half."""

    @property
    def flow_multiple(self) -> Any:
        """Convention of Sigma."""
        return 2.0

    def efficiency(self, velocity: Any, flow: Any) -> Any:
        """Share of a size caught, from its settling velocity under gravity and the flow."""
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

    def outlets(self, inside: None, feed: Stream) -> Clarified:
        caught = feed.part(solid=over_axes(self.grade(feed), feed))
        void = caught.solid_volume_flow * (1.0 / self.sediment_solids_fraction - 1.0)
        flow = feed.liquid_volume_flow
        share = jnp.minimum(void, flow) / jnp.where(flow > 0, flow, 1.0)
        sediment = caught.replace(liquid=share * feed.liquid)
        overflow = feed.replace(solid=feed.solid - sediment.solid, liquid=feed.liquid - sediment.liquid)
        return Clarified(sediment, overflow)

    def figures(self, inside: None, outlets: Clarified, feed: Stream) -> ClarifierFigures:
        total = feed.solid_flow
        return ClarifierFigures(
            solids_recovery=outlets.sediment.solid_flow / jnp.where(total > 0, total, 1.0),
            cut_size_centrifuge=cut_size_centrifuge(
                feed.slurry_volume_flow,
                self.sigma(),
                feed.liquid_density + excess_density(feed),
                feed.liquid_density,
                feed.liquid_viscosity,
                self.flow_multiple,
                self.sigma_efficiency,
            ),
            sigma_factor=jnp.asarray(self.sigma(), dtype=float),
            centrifugal_effect=centrifugal_effect(self.radius_outer, self.rotation_speed),
            # what it takes to bring the feed to the speed of the bowl wall and let it go there
            shaft_power=(feed.solid_flow + feed.liquid_flow) * (self.rotation_speed * self.radius_outer) ** 2,
            moisture_dry_basis=outlets.sediment.moisture_dry_basis,
            mass_flow_sediment=outlets.sediment.mass_flow,
        )

    def measured(
        self, inside: None, outlets: Clarified, figures: ClarifierFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "solids": feed.solids_volume_fraction,
            "flow": feed.slurry_volume_flow,
            "effect": figures.centrifugal_effect,
            "speed": self.rotation_speed,
            "pond": self.radius_inner / self.radius_outer,
            "floats": floating_share(feed),
        }

    def drawn(
        self, inside: None, outlets: Clarified, figures: ClarifierFigures, feed: Stream
    ) -> dict[str, Any]:
        return {"electric_power_drive": driven(figures.shaft_power)}


@equipment(
    "tubular_bowl",
    source="ambler1959; svarovsky2001",
    title="Tubular bowl centrifuge",
    equation=r"\Sigma = \frac{\pi L\,\omega^2 (r_2^2 - r_1^2)}{g \ln[2r_2^2/(r_1^2 + r_2^2)]}",
)
class TubularBowl(SettlingCentrifuge):
    """Slender bowl at very high speed: fine particles at low concentration, cleaned by hand when full."""

    bowl_length: Length
    _: KW_ONLY
    sigma_efficiency: PositiveNumber = 0.9

    limits: ClassVar[Limits] = _machine_limits(
        solids=(0.0, 0.01), flow=(0.1 / 3600, 5.0 / 3600), effect=(1000.0, 60000.0), source="robatel1989"
    ) | _slender(8.0, 16.0)

    def measured(
        self, inside: None, outlets: Clarified, figures: ClarifierFigures, feed: Stream
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed) | {
            "slender": self.bowl_length / self.radius_outer
        }

    def sigma(self) -> Any:
        return sigma_factor_tubular_half_area(
            self.bowl_length, self.radius_inner, self.radius_outer, self.rotation_speed
        )

    def efficiency(self, velocity: Any, flow: Any) -> Any:
        return grade_efficiency_tubular(
            velocity, flow, self.bowl_length, self.radius_inner, self.radius_outer, self.rotation_speed
        )


@equipment(
    "disc_stack",
    source="ambler1959; svarovsky2001",
    title="Disc stack centrifuge",
    equation=r"\Sigma = \frac{2\pi n\,\omega^2 (r_2^3 - r_1^3)}{3 g\tan\theta}",
)
class DiscStack(SettlingCentrifuge):
    """Stack of conical discs with narrow gaps: much settling area in a small bowl, for fine solids.

    A clarifier: what is lighter than the liquid stays in it. Emulsions and light solids go to a disc
    separator.
    """

    disc_number: PositiveNumber
    disc_angle: Angle = 0.7
    _: KW_ONLY
    sigma_efficiency: PositiveNumber = 0.55

    limits: ClassVar[Limits] = _machine_limits(
        solids=(0.0, 0.15), flow=(0.0, 100.0 / 3600), effect=(3000.0, 20000.0), source="robatel1989"
    ) | {"speed": Limit("rotation speed", 0.0, 12000 * RPM, "radian/s", "robatel1989")}

    def sigma(self) -> Any:
        return sigma_factor_disc(
            self.disc_number, self.radius_inner, self.radius_outer, self.rotation_speed, self.disc_angle
        )


@equipment(
    "scroll_decanter",
    source="ambler1959; records2001",
    title="Scroll decanter",
    equation=r"\Sigma = \frac{2\pi L\,\omega^2}{g}\left(\tfrac34 r_2^2 + \tfrac14 r_1^2\right)",
)
class ScrollDecanter(SettlingCentrifuge):
    """Horizontal bowl from which a screw conveys the sediment up a beach: continuous, for concentrated
    slurries.
    """

    bowl_length: Length
    beach_length: Distance = 0.0

    limits: ClassVar[Limits] = _machine_limits(
        solids=(0.02, 0.5), flow=(0.0, 200.0 / 3600), effect=(300.0, 3000.0), source="robatel1989"
    ) | _slender(3.0, 7.0)

    def measured(
        self, inside: None, outlets: Clarified, figures: ClarifierFigures, feed: Stream
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed) | {
            "slender": self.bowl_length / self.radius_outer
        }

    def sigma(self) -> Any:
        return sigma_factor_scroll(
            self.bowl_length, self.radius_inner, self.radius_outer, self.rotation_speed, self.beach_length
        )


@equipment("solid_basket", source="ambler1959; svarovsky2001", title="Solid-basket centrifuge")
class SolidBasket(SettlingCentrifuge):
    """Wide unperforated basket that fills with sediment and is then skimmed and plowed; averaged over its
    cycle.
    """

    bowl_length: Length
    working_share: Annotated[Fraction, Within(0.01, 1.0)] = 0.8

    limits: ClassVar[Limits] = _machine_limits(
        solids=(0.0, 0.1), flow=(0.0, 20.0 / 3600), effect=(300.0, 2000.0), source="perry2008, § 18"
    ) | {"pond": Limit("inner over outer radius", 0.5, 0.95, "dimensionless", "perry2008, § 18")}

    @property
    def flow_multiple(self) -> Any:
        return 2.0 * self.working_share

    def sigma(self) -> Any:
        return sigma_factor_tubular_half_area(
            self.bowl_length, self.radius_inner, self.radius_outer, self.rotation_speed
        )

    def efficiency(self, velocity: Any, flow: Any) -> Any:
        return grade_efficiency_tubular(
            velocity,
            flow / self.working_share,
            self.bowl_length,
            self.radius_inner,
            self.radius_outer,
            self.rotation_speed,
        )
