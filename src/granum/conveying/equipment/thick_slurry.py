"""A pipeline for a thick slurry that flows as one liquid, which does not follow Newton."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Literal, NamedTuple

import jax.numpy as jnp

from granum.conveying.equipment.slurry import Delivered
from granum.conveying.formulas.non_newtonian import (
    pressure_gradient_bingham,
    pressure_gradient_herschel_bulkley,
    pressure_gradient_power_law,
    reynolds_critical_ryan_johnson,
)
from granum.conveying.inside_charts import drawn_friction
from granum.core import equipment
from granum.core.constants import STANDARD_ATMOSPHERE, STANDARD_GRAVITY
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Distance,
    DynamicViscosity,
    FlowIndex,
    Length,
    PressureDrop,
    PressureGradient,
    Ratio,
    ShearRate,
    Speed,
    Stress,
    VolumeFraction,
    YieldStress,
)
from granum.core.limits import Limit
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import PUMPED, pumped

SLOW = 1e-6  # m/s


class ThickSlurryFigures(NamedTuple):
    """Figures of a pipeline of thick slurry; the gradient is that of friction."""

    velocity: Speed
    reynolds: Ratio
    solids_volume_fraction: VolumeFraction
    wall_stress: Stress
    pressure_gradient: PressureGradient
    pressure_drop: PressureDrop


@equipment(
    "thick_slurry_pipeline",
    source="metzner1955; dodge1959; darby2001; govier1972",
    title="Pipeline of a thick slurry (non-Newtonian)",
    equation=r"\Delta p = \frac{\Delta p}{L}\left(L_h + L_v\right) + \rho_m g\,L_v",
)
class ThickSlurryPipeline(Unit):
    """Pumps a slurry so fine or thick that it flows as one liquid with a flow curve of its own.

    The flow curve is that of this slurry, at its solids content, from a viscometer. ``power_law`` and
    ``bingham`` (whose ``consistency`` is the plastic viscosity) are laminar or turbulent in a smooth pipe;
    ``herschel_bulkley`` is laminar, and a limit tells where it no longer is. A pump of its own makes up for
    pressure that the feed lacks; its heat is not counted.
    """

    diameter: Length
    length_horizontal: Distance
    consistency: DynamicViscosity
    flow_curve: Literal["bingham", "power_law", "herschel_bulkley"] = "bingham"
    yield_stress: YieldStress = 0.0
    flow_index: FlowIndex = 1.0
    length_vertical: Distance = 0.0
    reference_shear_rate: ShearRate = 1.0

    limits: ClassVar[Limits] = {
        "wear": Limit("velocity of the slurry", 0.0, 6.0, "m/s", "wilson2006, ch. 5"),
        "laminar": Limit(
            "Reynolds number over that at which laminar flow ends", 0.0, 1.0, "dimensionless", "ryan1959"
        ),
    }

    utilities: ClassVar[Utilities] = PUMPED

    def __check_init__(self) -> None:
        wrong = {
            "bingham": ("flow_index", self.flow_index, 1.0),
            "power_law": ("yield_stress", self.yield_stress, 0.0),
        }.get(self.flow_curve)
        if wrong and isinstance(wrong[1], int | float) and wrong[1] != wrong[2]:
            raise InputError(
                _(
                    "The flow curve '{curve}' has '{name}' = {value}, not {given}: leave it out, or take "
                    "'herschel_bulkley'."
                ).format(curve=self.flow_curve, name=wrong[0], value=wrong[2], given=wrong[1]),
                name=wrong[0],
            )

    def inside(self, feed: Stream) -> ThickSlurryFigures:
        """The flow and the pressure that it takes."""
        flow, n = feed.slurry_volume_flow, jnp.asarray(self.flow_index, dtype=float)
        velocity = flow / (0.25 * jnp.pi * jnp.asarray(self.diameter) ** 2)
        moving = jnp.maximum(velocity, SLOW)
        mean = (feed.solid_flow + feed.liquid_flow) / jnp.where(flow > 0.0, flow, 1.0)
        mean = jnp.where(flow > 0.0, mean, 1000.0)
        laminar = pressure_gradient_herschel_bulkley(
            moving, self.diameter, self.consistency, n, self.yield_stress, self.reference_shear_rate
        )
        match self.flow_curve:
            case "power_law":
                gradient = pressure_gradient_power_law(
                    moving, self.diameter, mean, self.consistency, n, self.reference_shear_rate
                )
            case "bingham":
                gradient = pressure_gradient_bingham(
                    moving, self.diameter, mean, self.yield_stress, self.consistency
                )
            case _:
                gradient = laminar
        re = 32.0 * mean * moving**2 / (self.diameter * laminar)  # laminar friction is 64/Re
        gradient = jnp.where(flow > 0.0, gradient, 0.0)
        length = self.length_horizontal + self.length_vertical
        drop = gradient * length + jnp.where(flow > 0.0, mean, 0.0) * STANDARD_GRAVITY * self.length_vertical
        return ThickSlurryFigures(
            velocity,
            jnp.where(flow > 0.0, re, 0.0),
            feed.solids_volume_fraction,
            0.25 * gradient * self.diameter,
            gradient,
            drop,
        )

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        if not float(made.inside.velocity) > 0.0:
            return {}
        return {_("Friction over the velocity"): drawn_friction(self, inlets["feed"], made.inside)}

    def outlets(self, inside: ThickSlurryFigures, feed: Stream) -> Delivered:
        least = jnp.minimum(feed.pressure, STANDARD_ATMOSPHERE)
        return Delivered(feed.replace(pressure=jnp.maximum(feed.pressure - inside.pressure_drop, least)))

    def figures(self, inside: ThickSlurryFigures, outlets: Delivered, feed: Stream) -> ThickSlurryFigures:
        return inside

    def measured(
        self, inside: ThickSlurryFigures, outlets: Delivered, figures: ThickSlurryFigures, feed: Stream
    ) -> dict[str, Any]:
        found = {"wear": inside.velocity}
        if self.flow_curve == "herschel_bulkley":
            found["laminar"] = inside.reynolds / reynolds_critical_ryan_johnson(self.flow_index)
        return found

    def drawn(
        self, inside: ThickSlurryFigures, outlets: Delivered, figures: ThickSlurryFigures, feed: Stream
    ) -> dict[str, Any]:
        return {"electric_power_pump": pumped(feed.slurry_volume_flow, inside.pressure_drop)}
