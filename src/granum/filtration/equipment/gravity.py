"""Gravity filter in a line: slurry poured on a medium sinks through its own cake, averaged over the cycle."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import KW_ONLY
from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.constants import STANDARD_GRAVITY
from granum.core.i18n import _
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
    Speed,
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
from granum.filtration.formulas.gravity import filtration_time_settling, sinking_slurry
from granum.filtration.formulas.resistance import cake_permeability
from granum.numerics.smooth import safe_divide
from granum.particles.formulas.hindered import hindrance_richardson_zaki
from granum.particles.formulas.numbers import reynolds_number
from granum.particles.formulas.terminal import terminal_velocity
from granum.streams.cakes import part_cake, solid_diameter
from granum.streams.inside_charts import Axis, Curve, drawn_along
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import AREA, PUMPED, pumped

PACKED = 1.0 - 1e-9
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
    settling_velocity: Speed
    pressure_drop: PressureDrop
    cake_saturation: Fraction
    moisture_dry_basis: MoistureDryBasis


class Batch(NamedTuple):
    """One filling: cake and dry cake per area, time until the level meets the cake, whole cycle, area that
    the feed needs, saturation at discharge, speed at which the solid settles ahead.
    """

    thickness: Any
    loading: Any
    formation: Any
    cycle: Any
    area: Any
    saturation: Any
    velocity: Any


@equipment(
    "gravity_filter",
    source="darcy1856; ruth1935; wakeman2005",
    title="Gravity filter",
    equation=(
        r"\frac{dh}{dt} = -\frac{\rho_l\,g\,h}{\eta\left(\alpha\,W + R_s\right)},\quad "
        r"\frac{dW}{dt} = \frac{(1-\varepsilon)\,\varphi\,\rho_s}{1-\varepsilon-\varphi}"
        r"\left(v_s - \frac{dh}{dt}\right),\quad h \to \frac{\varphi\,h_0}{1-\varepsilon}"
    ),
)
class GravityFilter(Unit):
    """Slurry is poured on a medium in one depth and filters under its own falling head until the level meets
    the cake, which then drains by its own weight and is shoveled off.

    The head above the medium is that of the liquid, and the resistance of the cake does not change with it.
    Meanwhile the solid settles on the cake, as fast as was measured or as grains of its surface–volume
    diameter do; fine or flocculated solid is better measured. The cake drains above the height that
    capillarity holds, so that a fine one leaves saturated. In a line it stands for several filters working in
    turn. The cake is checked against the thickest of a Nutsche, the head against the pressure that a vacuum
    gives: deeper, another filter is meant.
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
    settling_velocity: Speed | None = None

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

    def settling(self, feed: Stream) -> Any:
        """Speed at which the solid settles in the slurry as it is poured, m/s: as measured, else of grains of
        its surface–volume diameter.
        """
        if self.settling_velocity is not None:
            return self.settling_velocity
        diameter = solid_diameter(feed, self.particle_diameter)
        liquid = feed.liquid_density, feed.liquid_viscosity
        alone = terminal_velocity(diameter, jnp.maximum(feed.solid_density, liquid[0]), *liquid)
        share = jnp.clip(feed.solids_volume_fraction, 1e-12, 1.0 - 1e-9)
        return alone * hindrance_richardson_zaki(share, reynolds_number(diameter, alone, *liquid))

    def inside(self, feed: Stream) -> Batch:
        flow, solid = feed.slurry_volume_flow, self.solids_recovery * feed.solid_flow
        loading = self.slurry_depth * safe_divide(solid, flow, 0.0)
        thickness = loading / ((1.0 - self.void_fraction) * feed.solid_density)
        velocity = self.settling(feed)
        formation = filtration_time_settling(
            self.slurry_depth,
            velocity,
            jnp.clip(
                safe_divide(solid, flow * feed.solid_density, 0.0), 0.0, PACKED * (1.0 - self.void_fraction)
            ),
            self.void_fraction,
            self.cake_resistance,
            self.medium_resistance,
            feed.solid_density,
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
            velocity,
        )

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        feed, batch = inlets["feed"], made.inside
        share = float(self.solids_recovery * feed.solids_volume_fraction)
        if not share > 0.0:
            return {}
        time, level, cake = sinking_slurry(
            np.linspace(0.0, 1.0, 81),
            self.slurry_depth,
            batch.velocity,
            share,
            1.0 - self.void_fraction,
            self.cake_resistance,
            self.medium_resistance,
            feed.solid_density,
            feed.liquid_viscosity,
            feed.liquid_density,
        )
        drawn = drawn_along(
            Axis("time", "Time"),
            time,
            (
                Axis("height", "Distance"),
                [
                    Curve(_("level of the slurry"), level, "LIQUID"),
                    Curve(_("surface of the cake"), cake, "SOLID"),
                ],
            ),
        )
        return {_("A filling as it sinks"): drawn}

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
            settling_velocity=inside.velocity,
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
