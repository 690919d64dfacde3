"""A pipeline for a settling slurry."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import jax.numpy as jnp

from granum.conveying.formulas.pipes import pressure_gradient_pipe
from granum.conveying.formulas.slurry import (
    deposition_velocity_durand,
    deposition_velocity_wasp,
    deposition_velocity_wilson,
    excess_durand,
    pressure_gradient_slurry_durand,
    pressure_gradient_slurry_wilson,
)
from granum.conveying.inside_charts import drawn_friction
from granum.core import equipment
from granum.core.constants import STANDARD_ATMOSPHERE, STANDARD_GRAVITY
from granum.core.i18n import _
from granum.core.kinds import (
    Distance,
    Fraction,
    Law,
    Length,
    PositiveNumber,
    PressureDrop,
    PressureGradient,
    Speed,
    VolumeFraction,
    Within,
)
from granum.core.limits import Limit
from granum.numerics.smooth import safe_divide
from granum.particles.formulas.drag_modern import drag_coefficient_brown_lawler
from granum.particles.formulas.suspension import relative_viscosity_thomas
from granum.particles.formulas.terminal import terminal_velocity
from granum.streams.stream import Stream, median_of
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import PUMPED, pumped

SOURCE = "wilson2006, ch. 5"
PASSES = 8  # of Wasp's friction velocity
KARMAN = 0.4


class Delivered(NamedTuple):
    """The slurry at the end of the line."""

    product: Stream


class SlurryFigures(NamedTuple):
    """Figures of a slurry pipeline; the gradient is that of its level parts."""

    velocity: Speed
    deposition_velocity: Speed
    particle_diameter: Length
    solids_volume_fraction: VolumeFraction
    suspended_fraction: Fraction
    pressure_gradient: PressureGradient
    pressure_drop: PressureDrop


class Pumped(NamedTuple):
    """Velocity, that of deposition, median size, share of solid by volume and of it in suspension, gradient
    of the level pipe and pressure that the whole line takes.
    """

    velocity: Any
    deposition: Any
    size: Any
    share: Any
    suspended: Any
    pressure_gradient: Any
    drop: Any


@equipment(
    "slurry_pipeline",
    source="wasp1977; durand1952; wilson2006",
    title="Slurry pipeline",
    equation=r"\Delta p = \frac{\Delta p}{L}\,L_h + \left(f\frac{\rho_m v^2}{2D} + \rho_m g\right) L_v",
)
class SlurryPipeline(Unit):
    """Pumps a settling slurry through a pipe; a pump drawn before it spares its own.

    ``wasp`` parts every size class into what turbulence keeps evenly suspended, which is a heavier and
    thicker liquid, and what runs near the bottom, which adds its friction by Durand; the other two laws take
    the median size for all. In rising pipes the slurry is a liquid of its own density; solid and liquid go
    equally fast throughout; a solid as light as the liquid or lighter counts as suspended. A pump of its own
    makes up for pressure that the feed lacks; its heat is not counted.
    """

    diameter: Length
    length_horizontal: Distance
    length_vertical: Distance = 0.0
    pipe_roughness: Length = 5e-5
    head_loss_law: Literal["wasp", "durand", "wilson"] = "wasp"
    deposition_law: Literal["wilson", "wasp", "durand"] = "wilson"
    stratification_exponent: Annotated[PositiveNumber, Within(0.25, 1.7)] = 1.7
    velocity_margin: PositiveNumber = 1.1
    drag: Annotated[Any, Law("drag_coefficient")] = drag_coefficient_brown_lawler

    limits: ClassVar[Limits] = {
        "deposition": Limit(
            "velocity over that of deposition", "velocity_margin", math.inf, "dimensionless", SOURCE
        ),
        "wear": Limit("velocity of the slurry", 0.0, 6.0, "m/s", SOURCE),
        "pumped": Limit("solids in the slurry by volume", 0.0, 0.4, "dimensionless", SOURCE),
    }

    utilities: ClassVar[Utilities] = PUMPED

    def inside(self, feed: Stream) -> Pumped:
        flow = feed.slurry_volume_flow
        velocity = flow / (0.25 * jnp.pi * jnp.asarray(self.diameter) ** 2)
        share, viscosity, liquid = feed.solids_volume_fraction, feed.liquid_viscosity, feed.liquid_density
        some = feed.solid_flow > 0.0
        solid = jnp.maximum(feed.solid_density, 1.001 * liquid)
        size = jnp.where(some, median_of(feed.size_fractions, feed.mixture.edges), 1e-4)
        size = jnp.maximum(size, 1e-9)
        mean = liquid + share * (solid - liquid)

        def drag_of(sizes: Any) -> tuple[Any, Any]:
            fall = terminal_velocity(sizes, solid, liquid, viscosity, drag=self.drag)
            fall = jnp.maximum(fall, 1e-12)
            return fall, 4.0 * STANDARD_GRAVITY * sizes * (solid / liquid - 1.0) / (3.0 * fall**2)

        suspended = jnp.zeros(())
        if self.head_loss_law == "wasp":
            gradient, suspended = self._wasp(feed, velocity, liquid, solid, viscosity, *drag_of(_sizes(feed)))
        elif self.head_loss_law == "durand":
            gradient = pressure_gradient_slurry_durand(
                velocity,
                self.diameter,
                share,
                solid,
                liquid,
                viscosity,
                drag_of(size)[1],
                self.pipe_roughness,
            )
        else:
            gradient = pressure_gradient_slurry_wilson(
                velocity,
                self.diameter,
                size,
                share,
                solid,
                liquid,
                viscosity,
                self.stratification_exponent,
                self.pipe_roughness,
            )
        thick = viscosity * relative_viscosity_thomas.function(jnp.minimum(share, 0.6))
        rising = pressure_gradient_pipe.function(velocity, self.diameter, mean, thick, self.pipe_roughness)
        drop = self.length_horizontal * gradient + self.length_vertical * (rising + mean * STANDARD_GRAVITY)
        match self.deposition_law:
            case "durand":
                slow = deposition_velocity_durand(self.diameter, solid, liquid)
            case "wasp":
                slow = deposition_velocity_wasp(self.diameter, size, share, solid, liquid)
            case _:
                slow = deposition_velocity_wilson(self.diameter, size, solid, liquid)
        drop = jnp.where(flow > 0.0, drop, 0.0)
        gradient = jnp.where(flow > 0.0, gradient, 0.0)
        return Pumped(velocity, jnp.where(some, slow, 0.0), size, share, suspended, gradient, drop)

    def _wasp(
        self, feed: Stream, velocity: Any, liquid: Any, solid: Any, viscosity: Any, fall: Any, drag: Any
    ) -> tuple[Any, Any]:
        """Gradient, and share of the solid that is evenly suspended, by passes over the friction velocity."""
        shares = feed.solids_volume_fraction * feed.size_fractions
        total = jnp.sum(shares)
        mean = liquid + total * (solid - liquid)
        gradient = pressure_gradient_pipe.function(
            velocity, self.diameter, liquid, viscosity, self.pipe_roughness
        )
        lifted = 0.0 * shares
        for _pass in range(PASSES):
            shear = jnp.sqrt(jnp.maximum(gradient * self.diameter / (4.0 * mean), 1e-24))
            lifted = 10.0 ** (-1.8 * fall / (KARMAN * shear))
            even = jnp.sum(shares * lifted)
            thick = viscosity * relative_viscosity_thomas.function(jnp.minimum(even, 0.6))
            heavy = liquid + even * (solid - liquid)
            vehicle = pressure_gradient_pipe.function(
                velocity, self.diameter, heavy, thick, self.pipe_roughness
            )
            bed = jnp.sum(
                excess_durand(velocity, self.diameter, shares * (1.0 - lifted), solid, liquid, drag)
            )
            gradient = vehicle * (1.0 + bed)
        return gradient, safe_divide(jnp.sum(shares * lifted), total)

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        feed, pumped_ = inlets["feed"], made.inside
        if not float(pumped_.velocity) > 0.0:
            return {}
        heading = _("Friction over the velocity")
        return {heading: drawn_friction(self, feed, pumped_, float(pumped_.deposition))}

    def outlets(self, inside: Pumped, feed: Stream) -> Delivered:
        least = jnp.minimum(feed.pressure, STANDARD_ATMOSPHERE)
        return Delivered(feed.replace(pressure=jnp.maximum(feed.pressure - inside.drop, least)))

    def figures(self, inside: Pumped, outlets: Delivered, feed: Stream) -> SlurryFigures:
        return SlurryFigures(*inside)

    def measured(
        self, inside: Pumped, outlets: Delivered, figures: SlurryFigures, feed: Stream
    ) -> dict[str, Any]:
        settles = inside.deposition > 0.0
        over = jnp.where(settles, safe_divide(inside.velocity, inside.deposition), 1e3)
        return {"deposition": over, "wear": inside.velocity, "pumped": inside.share}

    def drawn(
        self, inside: Pumped, outlets: Delivered, figures: SlurryFigures, feed: Stream
    ) -> dict[str, Any]:
        return {"electric_power_pump": pumped(feed.slurry_volume_flow, inside.drop)}


def _sizes(feed: Stream) -> Any:
    return jnp.maximum(jnp.asarray(feed.mixture.sizes, dtype=float), 1e-9)
