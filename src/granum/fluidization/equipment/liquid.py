"""A bed fluidized by a liquid: expansion, pressure drop, limits. Ion exchangers, backwashed filters, growing
crystals.
"""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import (
    Area,
    Density,
    Fraction,
    Length,
    Mass,
    PressureDrop,
    Speed,
    Sphericity,
    VoidFraction,
)
from granum.core.limits import Limit
from granum.fluidization.formulas.expansion import (
    bed_void_fraction_richardson_zaki,
    expansion_exponent,
    pressure_drop_fluidized_bed,
)
from granum.fluidization.formulas.minimum_beds import minimum_fluidization_velocity_ergun
from granum.particles.formulas.terminal import terminal_velocity
from granum.porous.formulas.packed_beds import pressure_gradient_ergun
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import AREA, PUMPED, pumped

LEAST, FULLEST = 1e-12, 0.999


class LiquidOutlets(NamedTuple):
    """The liquid above the bed."""

    liquid: Stream


class LiquidBedFigures(NamedTuple):
    """Figures of a liquid-fluidized bed."""

    superficial_velocity: Speed
    minimum_fluidization_velocity: Speed
    terminal_velocity: Speed
    bed_void_fraction: Fraction
    height_settled: Length
    height_expanded: Length
    pressure_drop: PressureDrop


@equipment(
    "liquid_fluidized_bed",
    source="richardson1954; ergun1952; kunii1991, ch. 3",
    title="Liquid-fluidized bed",
    typical={"particle_density": (2400.0, 2700.0)},
)
class LiquidFluidizedBed(Unit):
    """Bed of equal grains fluidized upwards by the liquid of a stream: expansion, pressure drop, and what
    would be carried off.

    The grains stay and are no part of the stream; the void fraction is that of the settled bed, from which
    Ergun's minimum fluidization and the terminal velocity give the expansion. For graded grains see
    ``graded_bed_expansion``. The pressure of the liquid falls by the buoyant weight of the grains.
    """

    area: Area
    mass: Mass
    particle_diameter: Length
    particle_density: Density
    void_fraction: VoidFraction = 0.42
    sphericity: Sphericity = 1.0

    limits: ClassVar[Limits] = {
        "fluidized": Limit(
            "liquid velocity over minimum fluidization velocity", 1.0, 1e3, "dimensionless", "kunii1991"
        ),
        "carried": Limit(
            "liquid velocity over terminal velocity", 0.0, 1.0, "dimensionless", "richardson1954"
        ),
    }

    utilities: ClassVar[Utilities] = PUMPED | AREA

    @classmethod
    def size(
        cls,
        liquid_volume_flow: Any,
        bed_void_fraction: Any,
        terminal_velocity: Any,
        settling_exponent: Any,
        mass: Any,
        particle_diameter: Any,
        particle_density: Any,
        **more: Any,
    ) -> LiquidFluidizedBed:
        """The bed whose section expands it to a void fraction: U = v_t ε^n."""
        area = liquid_volume_flow / (terminal_velocity * bed_void_fraction**settling_exponent)
        return cls(area, mass, particle_diameter, particle_density, **more)

    def outlets(self, inside: Any, feed: Stream) -> LiquidOutlets:
        return LiquidOutlets(feed.replace(pressure=jnp.maximum(feed.pressure - inside, 1.0)))

    def _velocity(self, feed: Stream) -> Any:
        return jnp.maximum(feed.slurry_volume_flow / self.area, LEAST)

    def inside(self, feed: Stream) -> Any:
        """Ergun's pressure drop of the settled bed, at most the buoyant weight over the section."""
        d, density, rho, eta = self._fluid(feed)
        fixed = (
            pressure_gradient_ergun(self._velocity(feed), d, self.void_fraction, rho, eta, self.sphericity)
            * self._settled
        )
        return jnp.minimum(fixed, pressure_drop_fluidized_bed(self.mass, self.area, density, rho))

    @property
    def _settled(self) -> Any:
        return self.mass / (self.particle_density * (1.0 - self.void_fraction) * self.area)

    def _fluid(self, feed: Stream) -> tuple[Any, Any, Any, Any]:
        return self.particle_diameter, self.particle_density, feed.liquid_density, feed.liquid_viscosity

    def figures(self, inside: Any, outlets: LiquidOutlets, feed: Stream) -> LiquidBedFigures:
        U, fluid = self._velocity(feed), self._fluid(feed)
        first = minimum_fluidization_velocity_ergun(*fluid, self.void_fraction, self.sphericity)
        fall = terminal_velocity(*fluid, sphericity=self.sphericity)
        n = expansion_exponent(fall, first, self.void_fraction)
        e = jnp.maximum(bed_void_fraction_richardson_zaki(U, fall, n), self.void_fraction)
        settled = self._settled
        expanded = settled * (1.0 - self.void_fraction) / (1.0 - jnp.minimum(e, FULLEST))
        return LiquidBedFigures(U, first, fall, e, settled, expanded, inside)

    def measured(
        self, inside: Any, outlets: LiquidOutlets, figures: LiquidBedFigures, feed: Stream
    ) -> dict[str, Any]:
        U = figures.superficial_velocity
        return {
            "fluidized": U / figures.minimum_fluidization_velocity,
            "carried": U / figures.terminal_velocity,
        }

    def drawn(
        self, inside: Any, outlets: LiquidOutlets, figures: LiquidBedFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "electric_power_pump": pumped(feed.slurry_volume_flow, inside),
            "area_installed": self.area,
        }
