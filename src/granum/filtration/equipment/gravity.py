"""Gravity filter in a line: slurry poured on a medium sinks through its own cake, averaged over the cycle."""

from __future__ import annotations

from dataclasses import KW_ONLY
from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Area,
    CakeResistance,
    Distance,
    Fraction,
    Length,
    MassPerAreaOrZero,
    MediumResistance,
    MoistureDryBasis,
    PressureDrop,
    Ratio,
    SurfaceTension,
    Time,
    VoidFraction,
    VolumeFlow,
)
from granum.core.limits import Limit
from granum.filtration.formulas.deliquoring import (
    capillary_number_cake,
    irreducible_saturation,
    saturation_after_deliquoring,
    threshold_pressure_cake,
)
from granum.filtration.formulas.gravity import filtration_time_falling_head
from granum.filtration.formulas.resistance import cake_permeability
from granum.numerics.smooth import safe_divide
from granum.streams.cakes import part_cake, solid_diameter
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import AREA, PUMPED, pumped

THINNEST = 1e-9  # m of cake, so that a feed without solid gives numbers


class Drained(NamedTuple):
    """Wet cake and the filtrate, with what drains from the cake."""

    cake: Stream
    filtrate: Stream


class GravityFigures(NamedTuple):
    """Figures of a gravity filter."""

    area_required: Area
    capacity_use: Ratio
    cake_thickness: Distance
    dry_cake_mass_per_area: MassPerAreaOrZero
    cycle_time: Time
    formation_time: Time
    filtrate_flow: VolumeFlow
    pressure_drop: PressureDrop
    cake_saturation: Fraction
    moisture_dry_basis: MoistureDryBasis


class Batch(NamedTuple):
    """One filling: cake and dry cake per area, time until the level meets the cake, whole cycle, area that
    the feed needs, saturation at discharge.
    """

    thickness: Any
    loading: Any
    formation: Any
    cycle: Any
    area: Any
    saturation: Any


@equipment(
    "gravity_filter",
    source="darcy1856; ruth1935; wakeman2005",
    title="Gravity filter",
    equation=(
        r"t = \frac{\eta}{\rho_l\,g}\left[\left(\alpha\,W\,h_0 + R_s\right)\ln\frac{h_0}{Z}"
        r" - \alpha\,W\left(h_0 - Z\right)\right],\qquad Z = \frac{\varphi\,h_0}{1-\varepsilon}"
    ),
)
class GravityFilter(Unit):
    """Slurry is poured on a medium in one depth and filters under its own falling head until the level meets
    the cake, which then drains by its own weight and is shoveled off.

    The head above the medium is that of the liquid, the resistance of the cake does not change with it and
    the solid does not settle ahead. The cake drains above the height that capillarity holds, so that a fine
    one leaves saturated. In a line it stands for several filters working in turn. The cake is checked against
    the thickest of a Nutsche, the head against the pressure that a vacuum gives: deeper, another filter is
    meant.
    """

    area: Area
    slurry_depth: Length
    cake_resistance: CakeResistance
    void_fraction: VoidFraction
    _: KW_ONLY
    medium_resistance: MediumResistance = 0.0
    deliquoring_time: Time = 0.0
    dead_time: Time = 1200.0
    solids_recovery: Fraction = 1.0
    surface_tension: SurfaceTension = 0.072
    particle_diameter: Length | None = None

    limits: ClassVar[Limits] = {
        "capacity": Limit("share of the filtration capacity in use", 0.0, 1.0, "dimensionless", "ruth1935"),
        "packed": Limit(
            "solids in the feed over those of a packed cake", 0.0, 0.9, "dimensionless", "mccabe2005, ch. 29"
        ),
        "cake": Limit("cake thickness in a gravity filter", 0.0, 0.5, "m", "wakeman2005"),
        "head": Limit("head over the medium", 0.0, 8.5e4, "Pa", "perry2008, § 18"),
    }
    utilities: ClassVar[Utilities] = PUMPED | AREA

    def saturation(self, feed: Stream, thickness: Any) -> Any:
        """Saturation of the cake after draining by its own weight, full as high as capillarity lifts."""
        diameter = solid_diameter(feed, self.particle_diameter)
        weight = feed.liquid_density * STANDARD_GRAVITY * thickness
        lowest = irreducible_saturation(
            capillary_number_cake(
                diameter,
                self.void_fraction,
                thickness,
                0.0,
                feed.liquid_density,
                self.surface_tension,
            )
        )
        drained = saturation_after_deliquoring(
            self.deliquoring_time,
            weight,
            cake_permeability(self.cake_resistance, self.void_fraction, feed.solid_density),
            feed.liquid_viscosity,
            self.void_fraction,
            thickness,
            lowest,
        )
        held = threshold_pressure_cake(diameter, self.void_fraction, self.surface_tension) / weight
        return 1.0 - (1.0 - drained) * jnp.maximum(1.0 - held, 0.0)

    def inside(self, feed: Stream) -> Batch:
        flow, solid = feed.slurry_volume_flow, self.solids_recovery * feed.solid_flow
        loading = self.slurry_depth * safe_divide(solid, flow, 0.0)
        thickness = loading / ((1.0 - self.void_fraction) * feed.solid_density)
        filtrate = self.slurry_depth - jnp.clip(thickness, THINNEST, self.slurry_depth * (1.0 - 1e-9))
        formation = filtration_time_falling_head(
            filtrate,
            self.slurry_depth,
            self.cake_resistance,
            self.medium_resistance,
            loading / filtrate,
            feed.liquid_viscosity,
            feed.liquid_density,
        )
        cycle = formation + self.deliquoring_time + self.dead_time
        return Batch(
            thickness,
            loading,
            formation,
            cycle,
            flow * cycle / self.slurry_depth,
            self.saturation(feed, jnp.maximum(thickness, THINNEST)),
        )

    def outlets(self, inside: Batch, feed: Stream) -> Drained:
        parted = part_cake(
            feed,
            None,
            recovery=self.solids_recovery,
            void_fraction=self.void_fraction,
            saturation=inside.saturation,
            left=1.0,
        )
        return Drained(parted.cake, parted.filtrate)

    def figures(self, inside: Batch, outlets: Drained, feed: Stream) -> GravityFigures:
        return GravityFigures(
            area_required=inside.area,
            capacity_use=inside.area / self.area,
            cake_thickness=inside.thickness,
            dry_cake_mass_per_area=inside.loading,
            cycle_time=inside.cycle,
            formation_time=inside.formation,
            filtrate_flow=outlets.filtrate.liquid_volume_flow,
            pressure_drop=feed.liquid_density * STANDARD_GRAVITY * self.slurry_depth,
            cake_saturation=inside.saturation,
            moisture_dry_basis=outlets.cake.moisture_dry_basis,
        )

    def measured(
        self, inside: Batch, outlets: Drained, figures: GravityFigures, feed: Stream
    ) -> dict[str, Any]:
        packed = feed.solids_volume_fraction / (1.0 - self.void_fraction)
        return {
            "capacity": figures.capacity_use,
            "packed": packed,
            "cake": figures.cake_thickness,
            "head": figures.pressure_drop,
        }

    def drawn(self, inside: Batch, outlets: Drained, figures: GravityFigures, feed: Stream) -> dict[str, Any]:
        return {
            "electric_power_pump": pumped(feed.slurry_volume_flow, figures.pressure_drop),
            "area_installed": self.area,
        }

    @classmethod
    def size(cls, feed: Stream, *, capacity_use: float = 1.0, **fields: Any) -> GravityFilter:
        """The filter whose area this feed just fills to the share ``capacity_use``, everything else given."""
        return cls(area=cls(area=1.0, **fields).inside(feed).area / capacity_use, **fields)
