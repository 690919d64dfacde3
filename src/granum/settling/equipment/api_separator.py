"""Oil–water separator after API publication 421: what floats is skimmed, what sinks is scraped."""

from __future__ import annotations

from math import ceil, inf, sqrt
from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import InputError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Density,
    DynamicViscosity,
    Fraction,
    Length,
    PositiveNumber,
    Ratio,
    Speed,
    VolumeFlow,
)
from granum.core.limits import Limit
from granum.settling.equipment.carriers import Carried
from granum.settling.equipment.gravity import (
    DRAG,
    HINDRANCE,
    Drag,
    Hindrance,
    Thickness,
    class_velocities,
    over_axes,
    skim,
)
from granum.settling.equipment.rakes import RAKED, scraped
from granum.settling.formulas.api import (
    HORIZONTAL_LIMIT,
    basin_length_api,
    horizontal_velocity_api,
    rise_velocity_api,
    turbulence_factor_api,
)
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import AREA

ROUNDING = 1e-9
FOOT = 0.3048  # m
HOLDS = (
    "The yield stress holds the globule for which the separator is designed: it never rises, and API has no "
    "such basin. Give a greater 'droplet_diameter', or a liquid that holds less."
)
SECTION_LIMIT = 160 * FOOT**2  # m²: 160 ft² a channel


class Skimmed(NamedTuple):
    """Floated oil, scraped sludge, treated water."""

    skimmings: Stream
    sludge: Stream
    water: Stream


class SeparatorFigures(NamedTuple):
    """Figures of an API separator."""

    horizontal_velocity: Speed
    rise_velocity: Speed
    velocity_ratio: Ratio
    turbulence_factor: PositiveNumber
    basin_area: Area
    basin_length: Length
    removal_efficiency: Fraction


@equipment("api_separator", source="api421", title="API oil–water separator")
class ApiSeparator(Carried, Unit):
    """Gravity oil–water separator: channels in which oil globules down to 150 µm rise to the surface.

    Oil is a dispersed species of the stream, with size classes, lighter than the liquid; heavier species go
    to the sludge. A class is removed in the ratio of its velocity to the overflow rate times the turbulence
    factor. All limits of API 421 are checks.

    A liquid that does not follow Newton is given by its ``consistency``, viscosity at 1/s, with
    ``flow_index``, ``yield_stress`` or both: globules then rise as spheres in it at rest, and the factor for
    turbulence, which API has for water, is kept.
    """

    length: Length
    width: Length
    height: Length
    channel_number: PositiveNumber = 1.0
    droplet_diameter: Length = 150e-6
    skimmings_concentration: Thickness = 500.0
    underflow_concentration: Thickness = 100.0
    drag: Drag = DRAG
    hindrance: Hindrance = HINDRANCE

    limits: ClassVar[Limits] = {
        "velocity": Limit("horizontal velocity over its limit", 0.0, 1.0, "dimensionless", "api421"),
        "length": Limit("length over the length needed", 1.0, inf, "dimensionless", "api421"),
        "time": Limit("residence time", 0.0, 60.0, "min", "api421"),
        "section": Limit("cross-section of a channel", 0.0, 15.0, "m^2", "api421"),
        "upright": Limit("depth over width", 0.3 - ROUNDING, 0.5 + ROUNDING, "dimensionless", "api421"),
        "slender": Limit("length over width", 5.0 - ROUNDING, inf, "dimensionless", "api421"),
        "depth": Limit("depth", 3 * FOOT, 8 * FOOT, "m", "api421"),
        "width": Limit("width", 6 * FOOT, 20 * FOOT, "m", "api421"),
    }

    utilities: ClassVar[Utilities] = RAKED | AREA

    def inside(self, feed: Stream) -> tuple[Any, Any, Any]:
        """Horizontal velocity, rise velocity of the design globule of the lightest species, turbulence
        factor.
        """
        horizontal = feed.slurry_volume_flow / (self.channel_number * self.width * self.height)
        lightest = jnp.min(feed.mixture.densities("solids", feed.temperature))
        lighter = jnp.minimum(lightest, feed.liquid_density * (1.0 - 1e-9))
        carrier, water, size = self.carrier, feed.liquid_density, self.droplet_diameter
        if carrier is None:
            rise = rise_velocity_api(water, lighter, feed.liquid_viscosity, size)
        else:
            rises = -carrier.falling(size, lighter, water, jnp.asarray(True))[0]
            unsolved(rises > 0.0, type(self).card, reason=HOLDS)
            rise = jnp.maximum(rises, 1e-12)
        return horizontal, rise, turbulence_factor_api(horizontal / rise)

    def outlets(self, inside: tuple[Any, Any, Any], feed: Stream) -> Skimmed:
        velocity = class_velocities(feed, self.drag, self.hindrance, carrier=self.carrier)
        _horizontal, _rise, factor = inside
        loading = factor * feed.slurry_volume_flow / (self.channel_number * self.length * self.width)
        share = jnp.minimum(jnp.abs(velocity) / loading, 1.0)
        up, down = (over_axes(jnp.where(side, share, 0.0), feed) for side in (velocity < 0, velocity > 0))
        made = skim(feed, down, up, self.underflow_concentration, self.skimmings_concentration)
        return Skimmed(made.skimmings, made.underflow, made.overflow)

    def figures(self, inside: tuple[Any, Any, Any], outlets: Skimmed, feed: Stream) -> SeparatorFigures:
        horizontal, rise, factor = inside
        some = jnp.where(feed.solid_flow > 0, feed.solid_flow, 1.0)
        removed = (outlets.skimmings.solid_flow + outlets.sludge.solid_flow) / some
        area = self.channel_number * self.length * self.width
        return SeparatorFigures(
            horizontal,
            rise,
            horizontal / rise,
            factor,
            area,
            basin_length_api(horizontal, rise, self.height),
            removed,
        )

    def measured(
        self, inside: tuple[Any, Any, Any], outlets: Skimmed, figures: SeparatorFigures, feed: Stream
    ) -> dict[str, Any]:
        horizontal, rise, _factor = inside
        return {
            "velocity": horizontal / horizontal_velocity_api(rise),
            "length": self.length / figures.basin_length,
            "time": self.length / horizontal / 60.0,
            "section": self.width * self.height,
            "upright": self.height / self.width,
            "slender": self.length / self.width,
            "depth": self.height,
            "width": self.width,
        }

    def drawn(
        self, inside: tuple[Any, Any, Any], outlets: Skimmed, figures: SeparatorFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "electric_power_rake": scraped(self.length, self.channel_number * self.width),
            "area_installed": figures.basin_area,
        }

    @classmethod
    def size(
        cls,
        volume_flow: VolumeFlow,
        water_density: Density,
        oil_density: Density,
        dynamic_viscosity: DynamicViscosity,
        depth_over_width: Ratio = 0.3,
        droplet_diameter: Length = 150e-6,
        horizontal_velocity_limit: Speed = HORIZONTAL_LIMIT,
    ) -> ApiSeparator:
        """The separator for a flow: section from the horizontal velocity, as many channels as it takes,
        length with turbulence.

        The length is at least five widths. Concrete numbers, SI.
        """
        rise = rise_velocity_api(water_density, oil_density, dynamic_viscosity, droplet_diameter)
        if not rise > 0:
            raise InputError(
                _("The oil must be lighter than the water: {oil} against {water} kg/m³.").format(
                    oil=oil_density, water=water_density
                )
            )
        horizontal = horizontal_velocity_api(rise, horizontal_velocity_limit)
        section = volume_flow / horizontal
        channels = max(1, ceil(section / SECTION_LIMIT - 1e-9))
        height = sqrt(depth_over_width * section / channels)
        width = height / depth_over_width
        length = max(basin_length_api(horizontal, rise, height), 5.0 * width)
        return cls(
            length=length,
            width=width,
            height=height,
            channel_number=float(channels),
            droplet_diameter=droplet_diameter,
        )
