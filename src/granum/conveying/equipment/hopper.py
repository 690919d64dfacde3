"""A hopper or silo between two machines: what it holds, whether it lets it out, and how fast."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.conveying.formulas.hoppers import (
    DEGREE,
    NO_FLOW,
    Friction,
    Power,
    Strength,
    Wall,
    arch_exists,
    critical_strength,
    flow_factor_hopper,
    half_angle_mass_flow_cone,
    mass_flow_beverloo,
    outlet_width_jenike,
    silo_stresses_janssen,
    unconfined_strength,
)
from granum.conveying.formulas.outlets import (
    mass_flow_johanson,
    outlet_velocity_carleton,
    rathole_diameter_jenike,
)
from granum.core import equipment
from granum.core.constants import STANDARD_GRAVITY
from granum.core.errors import InputError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    KINDS,
    Angle,
    Density,
    Distance,
    Length,
    MassFlow,
    PositiveNumber,
    Ratio,
    Stress,
    Time,
    Volume,
    Within,
)
from granum.core.limits import Limit
from granum.core.units import show
from granum.numerics.smooth import safe_divide
from granum.streams.cakes import solid_diameter
from granum.streams.equipment.basics import Single
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit

AIR_DENSITY, AIR_VISCOSITY = 1.2, 1.8e-5  # of the room, drawn in from below
GRAINS = 6.0  # of the coarse ones across an outlet, fewer of which lock
EMPTY = 1.4  # Beverloo's ring, in grains
WEAK = 1e-6  # Pa
ANGLE = (1.0 * DEGREE, 80.0 * DEGREE)


class Flow(NamedTuple):
    """What decides how a hopper empties."""

    mass_flow: Any
    least: Any
    discharge: Any
    widest: Any


class HopperFigures(NamedTuple):
    """Figures of a hopper; the stresses are those of filling, at the foot of its cylinder."""

    volume: Volume
    residence_time: Time
    outlet_width_least: Distance
    discharge_largest: MassFlow
    half_angle_widest: Angle
    stress_vertical: Stress
    stress_horizontal: Stress
    stress_wall_shear: Stress


@equipment(
    "hopper",
    source="jenike1964; johanson1965; carleton1972; beverloo1961; janssen1895",
    title="Hopper or silo",
    equation=(
        r"\tau = \frac{\rho_b V}{\dot m},\quad V = \frac{\pi}{4}D^2 H + "
        r"\frac{\pi\left(D^3 - B^3\right)}{24\tan\theta}"
    ),
)
class Hopper(Unit):
    """A cylinder with a cone below, filled as fast as it empties, with checks whether the solid flows.

    Friction angles and the line of strength come from a shear cell (``flow_function``, ``yield_locus``), at
    the moisture and after the time of storage that are to be; a flow function that is a power of the stress
    in kPa has its factor as slope and ``strength_exponent``. Without strength the solid flows freely. A cone
    up to the half angle of mass flow moves as a whole: its outlet must be wider than Jenike's arch, and lets
    out the lesser of Johanson's rate and Carleton's. Beyond that angle a funnel flows: the outlet must be
    wider than the rathole under the stress of filling, and lets out the lesser of Beverloo's rate and
    Carleton's. Air of the room enters from below.
    """

    diameter: Length
    height: Distance
    outlet_width: Length
    hopper_half_angle: Annotated[Angle, Within(*ANGLE)]
    bulk_density: Density
    effective_friction_angle: Friction
    wall_friction_angle: Wall
    strength_intercept: Strength = 0.0
    strength_slope: Ratio = 0.0
    internal_friction_angle: Friction | None = None
    stress_ratio: Annotated[PositiveNumber, Within(0.01, 5.0)] = 0.4
    strength_exponent: Power = 1.0

    limits: ClassVar[Limits] = {
        "flows": Limit(
            "least outlet that neither arch nor rathole closes, over the outlet",
            0.0,
            1.0,
            "dimensionless",
            "jenike1964",
            quiet=True,
        ),
        "rate": Limit("largest discharge over the feed", 1.0, math.inf, "dimensionless", "johanson1965"),
        "funnel": Limit(
            "angle of the hopper over the widest with mass flow",
            0.0,
            1.0,
            "dimensionless",
            "jenike1964",
            quiet=True,
        ),
        "grains": Limit("coarse grains over the outlet", 0.0, 1.0 / GRAINS, "dimensionless", "rhodes2008"),
        "packed": Limit("solid in the stored volume", 0.05, 0.85, "dimensionless", "perry2008"),
        "flooded": Limit(
            "liquid in the voids of the stored solid", 0.0, 1.0, "dimensionless", "perry2008", quiet=True
        ),
    }

    def __check_init__(self) -> None:
        width, diameter = self.outlet_width, self.diameter
        if isinstance(width, int | float) and isinstance(diameter, int | float) and width >= diameter:
            raise InputError(
                _("The outlet ({width}) must be narrower than the hopper ({diameter}).").format(
                    width=show(width, KINDS["Length"]), diameter=show(diameter, KINDS["Length"])
                ),
                name="outlet_width",
            )

    def volume(self) -> Any:
        """Of cylinder and cone."""
        wide, narrow = jnp.asarray(self.diameter), jnp.asarray(self.outlet_width)
        cone = (wide**3 - narrow**3) / (24.0 * jnp.tan(self.hopper_half_angle))
        return jnp.pi * (0.25 * wide**2 * self.height + cone)

    def inside(self, feed: Stream) -> Flow:
        """How the solid of the feed flows."""
        width, theta, rho = self.outlet_width, self.hopper_half_angle, self.bulk_density
        widest = jnp.nan_to_num(
            half_angle_mass_flow_cone.function(self.effective_friction_angle, self.wall_friction_angle)
        )
        mass = theta <= widest
        # beyond it the arch is not what decides: a cone that does flow takes its place there
        held = jnp.where(mass, theta, ANGLE[0])
        factor = flow_factor_hopper.function(
            self.effective_friction_angle, jnp.where(mass, self.wall_friction_angle, ANGLE[0]), held
        )
        slope = jnp.where(mass, self.strength_slope, 0.0)
        power = self.strength_exponent
        unsolved(arch_exists(slope, factor, power), type(self).card, reason=NO_FLOW)
        arch = outlet_width_jenike.function(
            critical_strength.function(self.strength_intercept, slope, factor, power), rho, held
        )
        filled = silo_stresses_janssen.function(
            self.height, self.diameter, rho, self.wall_friction_angle, self.stress_ratio
        )
        friction = (
            self.effective_friction_angle
            if self.internal_friction_angle is None
            else self.internal_friction_angle
        )
        strength = unconfined_strength.function(
            filled.stress_vertical, self.strength_intercept, self.strength_slope, power
        )
        hole = rathole_diameter_jenike.function(strength, rho, friction)
        least = jnp.where(mass, arch, hole)
        stress = (
            rho * STANDARD_GRAVITY * width / outlet_width_jenike.function(rho * STANDARD_GRAVITY, rho, held)
        )
        major = factor * stress
        held_together = unconfined_strength.function(major, self.strength_intercept, slope, power)
        flowability = major / jnp.maximum(held_together, WEAK)
        d = solid_diameter(feed)
        open_enough = width > EMPTY * d
        funnel = mass_flow_beverloo.function(rho, jnp.where(open_enough, width, 2.0 * EMPTY * d), d)
        coarse = jnp.where(
            mass,
            mass_flow_johanson.function(rho, width, held, factor, flowability),
            jnp.where(open_enough & (hole <= width), funnel, 0.0),
        )
        density = jnp.where(feed.solid_flow > 0.0, feed.solid_density, rho)
        fine = outlet_velocity_carleton.function(width, theta, d, density, AIR_DENSITY, AIR_VISCOSITY)
        drawn = rho * 0.25 * jnp.pi * jnp.asarray(width) ** 2 * fine
        return Flow(mass, least, jnp.minimum(coarse, drawn), widest)

    def outlets(self, inside: Flow, feed: Stream) -> Single:
        return Single(feed)

    def figures(self, inside: Flow, outlets: Single, feed: Stream) -> HopperFigures:
        volume, flow = self.volume(), feed.solid_flow + feed.liquid_flow
        stresses = silo_stresses_janssen.function(
            self.height, self.diameter, self.bulk_density, self.wall_friction_angle, self.stress_ratio
        )
        return HopperFigures(
            volume,
            safe_divide(volume * self.bulk_density, flow),
            inside.least,
            inside.discharge,
            inside.widest,
            *stresses,
        )

    def measured(self, inside: Flow, outlets: Single, figures: HopperFigures, feed: Stream) -> dict[str, Any]:
        flow = feed.solid_flow + feed.liquid_flow
        reached = jnp.cumsum(feed.size_fractions) >= 0.95
        coarse = jnp.where(jnp.any(reached), jnp.asarray(feed.mixture.sizes)[jnp.argmax(reached)], 0.0)
        stored = safe_divide(self.bulk_density, flow)  # per volume, over the flow that makes it
        solid, liquid = feed.solid_volume_flow * stored, feed.liquid_volume_flow * stored
        cohesive = inside.least > 0.0
        return {
            "flows": inside.least / self.outlet_width,
            "rate": safe_divide(inside.discharge, flow, otherwise=1.0),
            "funnel": jnp.where(cohesive, self.hopper_half_angle / jnp.maximum(inside.widest, ANGLE[0]), 0.0),
            "grains": coarse / self.outlet_width,
            "packed": solid,
            "flooded": liquid / jnp.maximum(1.0 - solid, 1e-3),
        }
