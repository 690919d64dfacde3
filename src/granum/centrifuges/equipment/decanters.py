"""Scroll decanters for two phases and for three: the scroll moves the sediment along the bowl and up a beach,
where it drains; its load follows from what it moves.
"""

from __future__ import annotations

from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.centrifuges.equipment.bowls import (
    CRITICAL,
    Bowl,
    machine_limits,
    no_floats,
    slender,
)
from granum.centrifuges.equipment.liquids import (
    INTERFACE,
    Parted,
    floated_share,
    interface,
    part_liquids,
    parted_figures,
    refuse_weir,
)
from granum.centrifuges.equipment.settling import Clarified, clarified, clarifier_figures
from granum.centrifuges.formulas.clarifying import sigma_factor_scroll
from granum.centrifuges.formulas.conveying import conveying_torque, conveying_velocity, rising_angle
from granum.centrifuges.formulas.mechanics import critical_speed_bowl
from granum.centrifuges.formulas.spinning import cake_saturation_spinning, irreducible_saturation_leung
from granum.core import equipment
from granum.core.constants import RPM
from granum.core.kinds import (
    Angle,
    Area,
    Distance,
    Fraction,
    Law,
    Length,
    MassFlow,
    MoistureDryBasis,
    OpenFraction,
    Power,
    Ratio,
    RotationSpeed,
    Speed,
    Stress,
    SurfaceTension,
    Torque,
    TurningSpeed,
    Within,
)
from granum.core.limits import Limit
from granum.numerics import find_root
from granum.settling.equipment.gravity import over_axes
from granum.streams.cakes import solid_diameter
from granum.streams.stream import Stream
from granum.streams.units import Limits

BeachAngle = Annotated[Angle, Within(0.0, 1.0)]
FrictionAngle = Annotated[Angle, Within(0.01, 1.2)]
CLIMBS = 0.999  # of the friction on the bowl, the most that the slope may take for a number to be told
SOLID = 0.74  # volume fraction beyond which no sediment is compacted


class Conveyed(NamedTuple):
    """How the sediment travels: its share of solid by volume; layer, m, and velocity, m/s, on the cylinder;
    saturation at discharge; torque, N m; the part of the friction that the slope takes; shares caught.
    """

    solids_fraction: Any
    layer: Any
    velocity: Any
    saturation: Any
    torque: Any
    climbing: Any
    grade: Any


class DecanterFigures(NamedTuple):
    """Figures of a scroll decanter."""

    solids_recovery: Fraction
    cut_size_centrifuge: Distance
    sigma_factor: Area
    centrifugal_effect: Ratio
    shaft_power: Power
    power_acceleration: Power
    power_windage: Power
    hoop_stress_bowl: Stress
    moisture_dry_basis: MoistureDryBasis
    mass_flow_sediment: MassFlow
    power_conveying: Power
    conveying_torque: Torque
    conveying_velocity: Speed
    cake_thickness: Distance
    cake_saturation: Fraction
    sediment_solids_fraction: Fraction
    critical_speed: RotationSpeed


class ThreePhaseFigures(NamedTuple):
    """Figures of a three-phase decanter."""

    solids_recovery: Fraction
    light_recovery: Fraction
    cut_size_centrifuge: Distance
    cut_size_rising: Distance
    radius_interface: Distance
    sigma_factor: Area
    centrifugal_effect: Ratio
    shaft_power: Power
    power_acceleration: Power
    power_windage: Power
    hoop_stress_bowl: Stress
    moisture_dry_basis: MoistureDryBasis
    mass_flow_sediment: MassFlow
    power_conveying: Power
    conveying_torque: Torque
    conveying_velocity: Speed
    cake_thickness: Distance
    cake_saturation: Fraction
    sediment_solids_fraction: Fraction
    critical_speed: RotationSpeed


class Scrolled(Bowl):
    """Abstract bowl with a scroll.

    ``bowl_length`` is that of the cylinder, ``beach_length`` the flooded part of the cone and
    ``dry_beach_length`` the part above the pool, on which the cake drains. The layer of cake follows from the
    velocity at which the scroll moves it; the load counts the cylinder as covered all along, which is on the
    safe side. With a law of compression the sediment is as dense as its own weight makes it halfway down,
    instead of ``sediment_solids_fraction``.
    """

    bowl_length: Length
    beach_length: Distance = 0.0
    _: KW_ONLY
    dry_beach_length: Distance = 0.0
    beach_angle: BeachAngle = 0.17
    scroll_pitch: Length = 0.1
    differential_speed: TurningSpeed = 20 * RPM
    friction_angle_flight: FrictionAngle = 0.15
    friction_angle_bowl: FrictionAngle = 0.5
    surface_tension: SurfaceTension = 0.072
    compression: Annotated[Any, Law("solids_stress")] | None = None

    @property
    def outside_length(self) -> Any:
        return self.bowl_length + self.beach_length + self.dry_beach_length

    def sigma(self) -> Any:
        return sigma_factor_scroll(
            self.bowl_length, self.radius_inner, self.radius_outer, self.rotation_speed, self.beach_length
        )

    def critical(self, feed: Stream) -> Any:
        """First critical speed, rad/s."""
        return critical_speed_bowl(
            self.outside_length, self.wall, self.radius_inner, self.thickness, feed.liquid_density
        )

    def compacted(self, law: Any, stress: Any, solid_density: Any) -> Any:
        """Volume fraction of solid that carries a stress, by a law of compression."""

        def off(concentration, wanted):
            return law(concentration) - wanted

        top = SOLID * solid_density
        found = find_root(off, 1e-3 * solid_density, top, jnp.minimum(stress, law(top))).value
        return jnp.clip(found / solid_density, 0.01, SOLID)

    def conveyed(self, feed: Stream) -> Conveyed:
        """How the sediment travels and drains."""
        grade = self.grade(feed)
        caught = feed.part(solid=over_axes(grade, feed))
        solid, density = caught.solid_volume_flow, caught.solid_density
        liquid = feed.liquid_density
        angles = self.friction_angle_flight, self.friction_angle_bowl
        middle = 0.5 * (self.radius_outer + self.radius_inner)
        end = jnp.maximum(
            self.radius_inner - 0.5 * self.dry_beach_length * jnp.sin(self.beach_angle),
            0.3 * self.radius_inner,
        )
        helix = jnp.arctan(self.scroll_pitch / (2.0 * jnp.pi * end))
        steepest = jnp.arctan(
            CLIMBS * jnp.tan(self.friction_angle_bowl) / jnp.tan(helix + self.friction_angle_flight)
        )
        slope = jnp.minimum(self.beach_angle, steepest)
        places = (
            (self.radius_outer, 0.0, self.bowl_length),
            (middle, slope, self.beach_length),
            (end, slope, self.dry_beach_length),
        )
        speeds = [
            jnp.maximum(conveying_velocity(r, self.scroll_pitch, self.differential_speed, b, *angles), 1e-9)
            for r, b, _length in places
        ]
        field = self.rotation_speed**2 * self.radius_outer
        if self.compression is None:
            packed = jnp.asarray(self.sediment_solids_fraction, dtype=float)
        else:
            weight = 0.5 * jnp.maximum(density - liquid, 0.0) * field
            packed = self.compacted(
                self.compression, weight * solid / (2.0 * jnp.pi * self.radius_outer * speeds[0]), density
            )
        cake = solid / packed
        layers = [cake / (2.0 * jnp.pi * r * v) for (r, _b, _l), v in zip(places, speeds, strict=True)]

        dry = self.dry_beach_length > 0
        size, thick = solid_diameter(caught), jnp.maximum(layers[2], 1e-6)
        spun = size, 1.0 - packed, thick, end, self.rotation_speed, liquid
        lowest = irreducible_saturation_leung(*spun, self.surface_tension)
        drained = cake_saturation_spinning(
            self.dry_beach_length / speeds[2], *spun, feed.liquid_viscosity, lowest
        )
        saturation = jnp.where(dry, drained, 1.0)

        under = jnp.maximum(density - liquid, 0.0) * packed
        above = density * packed + liquid * (1.0 - packed) * saturation
        load = jnp.zeros(())
        for (r, b, length), v, heavy in zip(places, speeds, (under, under, above), strict=True):
            mass = heavy * cake * length / v
            load = load + conveying_torque(
                jnp.maximum(mass, 1e-12), r, self.rotation_speed, self.scroll_pitch, b, *angles
            )
        used = rising_angle(end, self.scroll_pitch, self.beach_angle, *angles)[2]
        return Conveyed(packed, layers[0], speeds[0], saturation, load, used, grade)

    def conveying_figures(self, inside: Conveyed, feed: Stream) -> dict[str, Any]:
        """Figures of the scroll, by name."""
        return {
            "power_conveying": inside.torque * self.differential_speed,
            "conveying_torque": inside.torque,
            "conveying_velocity": inside.velocity,
            "cake_thickness": inside.layer,
            "cake_saturation": inside.saturation,
            "sediment_solids_fraction": inside.solids_fraction,
            "critical_speed": self.critical(feed),
        }

    def measured_scroll(self, inside: Conveyed, feed: Stream, figures: Any) -> dict[str, Any]:
        """Numbers for the limits."""
        return self.measured_bowl(feed, figures) | {
            "slender": self.bowl_length / self.radius_outer,
            "critical": self.rotation_speed / figures.critical_speed,
            "conveying": inside.layer / (self.radius_outer - self.radius_inner),
            "climbing": inside.climbing,
        }


SCROLL_LIMITS: Limits = (
    machine_limits(solids=(0.02, 0.5), flow=(0.0, 200.0 / 3600), effect=(300.0, 3000.0), source="robatel1989")
    | slender(3.0, 7.0)
    | CRITICAL
    | {
        "conveying": Limit("cake over the depth of the pool", 0.0, 1.0, "dimensionless", "leung1998"),
        "climbing": Limit(
            "slope of the beach over what the scroll can climb", 0.0, 0.9, "dimensionless", "leung1998"
        ),
    }
)


def drained(feed: Stream, made: Conveyed) -> Any:
    """Volume fraction of solid in solid and liquid of the cake as it leaves."""
    return made.solids_fraction / (
        made.solids_fraction + (1.0 - made.solids_fraction) * jnp.maximum(made.saturation, 1e-9)
    )


@equipment(
    "scroll_decanter",
    source="ambler1959; records2001; leung1998",
    title="Scroll decanter",
    equation=r"\Sigma = \frac{2\pi L\,\omega^2}{g}\left(\tfrac34 r_2^2 + \tfrac14 r_1^2\right)",
)
class ScrollDecanter(Scrolled):
    """Horizontal bowl from which a screw conveys the sediment up a beach: continuous, for concentrated
    slurries.

    The scroll must move the cake (layer within the pool, slope within its friction); its torque, the power of
    feed, air and scroll, and the drainage on the dry beach come with it. What is lighter than the liquid
    stays in it: a three-phase decanter has an outlet for that.
    """

    limits: ClassVar[Limits] = SCROLL_LIMITS | no_floats("robatel1989")

    def inside(self, feed: Stream) -> Conveyed:
        return self.conveyed(feed)

    def outlets(self, inside: Conveyed, feed: Stream) -> Clarified:
        return clarified(self, feed, inside.grade, drained(feed, inside))

    def figures(self, inside: Conveyed, outlets: Clarified, feed: Stream) -> DecanterFigures:
        scroll = self.conveying_figures(inside, feed)
        return DecanterFigures(**clarifier_figures(self, feed, outlets, scroll["power_conveying"]), **scroll)

    def measured(
        self, inside: Conveyed, outlets: Clarified, figures: DecanterFigures, feed: Stream
    ) -> dict[str, Any]:
        return self.measured_scroll(inside, feed, figures)


@equipment(
    "three_phase_decanter",
    source="ambler1959; records2001; leung1998; mccabe2005, ch. 29",
    title="Three-phase decanter",
    equation=r"r_i^2 = \frac{\rho_H r_H^2 - \rho_L r_L^2}{\rho_H - \rho_L}",
)
class ThreePhaseDecanter(Scrolled):
    """Scroll decanter with two liquid outlets: solids up the beach, drops and light solids to the inner weir,
    the liquid to the outer one.

    Drops are a dispersed species of the stream, lighter than the liquid; they rise by the same Σ as solids
    sink by and leave at ``light_solids_fraction`` by volume. The two weirs set where the interface lies.
    ``radius_inner`` is the free surface, that of the light liquid.
    """

    _: KW_ONLY
    radius_heavy: Length
    light_solids_fraction: OpenFraction = 0.9

    limits: ClassVar[Limits] = SCROLL_LIMITS | INTERFACE

    def __check_init__(self) -> None:
        refuse_weir(self.radius_heavy, self.radius_outer, "radius_heavy")

    def inside(self, feed: Stream) -> Conveyed:
        return self.conveyed(feed)

    def outlets(self, inside: Conveyed, feed: Stream) -> Parted:
        flow = jnp.maximum(feed.slurry_volume_flow, 1e-300)
        floated = floated_share(
            self.velocities(feed), lambda v: self.efficiency(self.sigma_efficiency * v, flow)
        )
        return part_liquids(feed, inside.grade, floated, drained(feed, inside), self.light_solids_fraction)

    def figures(self, inside: Conveyed, outlets: Parted, feed: Stream) -> ThreePhaseFigures:
        scroll = self.conveying_figures(inside, feed)
        return ThreePhaseFigures(
            **parted_figures(self, feed, outlets, scroll["power_conveying"]),
            cut_size_rising=self.cut_size(feed, self.sigma(), rising=True),
            radius_interface=interface(self, feed, self.radius_inner),
            **scroll,
        )

    def measured(
        self, inside: Conveyed, outlets: Parted, figures: ThreePhaseFigures, feed: Stream
    ) -> dict[str, Any]:
        reach = self.radius_outer - self.radius_inner
        return self.measured_scroll(inside, feed, figures) | {
            "interface": (figures.radius_interface - self.radius_inner) / reach
        }
