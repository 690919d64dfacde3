"""Bowls with two liquid outlets and one for sediment: disc separator, its nozzle build, tubular separator.

Drops are a dispersed species of the stream, with size classes, lighter than its liquid.
"""

from __future__ import annotations

import abc
from collections.abc import Callable
from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.centrifuges.equipment.bowls import Bowl, held_liquid, refuse_beyond
from granum.centrifuges.equipment.settling import (
    DISC_LIMITS,
    EJECTED,
    TUBE_LIMITS,
    Discs,
    Tube,
)
from granum.centrifuges.formulas.clarifying import (
    grade_efficiency_thin_layer,
    grade_efficiency_tubular_rising,
    radius_interface,
)
from granum.centrifuges.formulas.field import centrifugal_effect
from granum.centrifuges.formulas.mechanics import discharge_interval, nozzle_flow_bowl
from granum.core import equipment
from granum.core.kinds import (
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
    Stress,
    Time,
    Volume,
    VolumeFlow,
    VolumeFraction,
    Within,
)
from granum.core.limits import Limit
from granum.settling.equipment.gravity import floats, over_axes
from granum.streams.stream import Stream
from granum.streams.units import Limits

NARROWEST = 0.02  # of the discs or the pool, what is left to settle in where the interface stands at its edge
INMOST = 0.1  # of the radius of the light weir, where an interface is told to be that is not there
LIGHTER = 0.9  # of the density of the liquid, what a light phase is taken as where the mixture has none

INTERFACE: Limits = {
    "interface": Limit(
        "place of the interface, from inner to outer radius", 0.0, 1.0, "dimensionless", "mccabe2005, ch. 29"
    )
}


class Parted(NamedTuple):
    """Light liquid (drops, cream, floating matter), heavy liquid, sediment."""

    light: Stream
    heavy: Stream
    sediment: Stream


class PartedFigures(NamedTuple):
    """Figures of a separator of two liquids."""

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
    discharge_interval: Time


class NozzleFigures(NamedTuple):
    """Figures of a nozzle separator."""

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
    volume_flow_nozzles: VolumeFlow
    solids_volume_fraction_sediment: VolumeFraction


def floated_share(velocity: Any, efficiency: Callable[[Any], Any]) -> Any:
    """Share of each species and class that rises out, from its velocity (negative where it rises)."""
    return jnp.where(velocity < 0, efficiency(jnp.maximum(-velocity, 0.0)), 0.0)


def part_liquids(feed: Stream, sunk: Any, floated: Any, sediment: Any, light: Any) -> Parted:
    """Feed parted by shares of each species and class, sediment and light liquid at their volume fractions of
    solid; where the liquid does not do for both, what there is is shared out.
    """
    bottom, top = feed.part(solid=over_axes(sunk, feed)), feed.part(solid=over_axes(floated, feed))
    flow = feed.liquid_volume_flow
    below, above = held_liquid(bottom, flow, sediment), held_liquid(top, flow, light)
    scale = 1.0 / jnp.maximum(below + above, 1.0)
    below, above = below * scale, above * scale
    none = 0.0 * feed.gas
    return Parted(
        top.replace(liquid=above * feed.liquid, gas=none),
        feed.replace(solid=feed.solid - top.solid - bottom.solid, liquid=(1.0 - below - above) * feed.liquid),
        bottom.replace(liquid=below * feed.liquid, gas=none),
    )


def recovered(part: Stream, feed: Stream, which: Any) -> Any:
    """Share of some species (1 or 0 of each) that a part holds; zero where there is none."""
    whole = feed.solid_by_species @ which
    return jnp.clip(part.solid_by_species @ which / jnp.where(whole > 0, whole, 1.0), 0.0, 1.0)


def parted_figures(unit: Bowl, feed: Stream, outlets: Parted, conveying: Any = 0.0) -> dict[str, Any]:
    """Figures that machines with two liquid outlets share, by name."""
    light = floats(feed)
    accelerated, windage = unit.acceleration(outlets.sediment, outlets.light, outlets.heavy), unit.windage()
    return {
        "solids_recovery": recovered(outlets.sediment, feed, 1.0 - light),
        "light_recovery": recovered(outlets.light, feed, light),
        "cut_size_centrifuge": unit.cut_size(feed, unit.sigma()),
        "sigma_factor": jnp.asarray(unit.sigma(), dtype=float),
        "centrifugal_effect": centrifugal_effect(unit.radius_outer, unit.rotation_speed),
        "shaft_power": accelerated + windage + conveying,
        "power_acceleration": accelerated,
        "power_windage": windage,
        "hoop_stress_bowl": unit.stress(feed),
        "moisture_dry_basis": outlets.sediment.moisture_dry_basis,
        "mass_flow_sediment": outlets.sediment.mass_flow,
    }


def light_density(feed: Stream, share: Any) -> Any:
    """Density of the light liquid when it leaves with a volume fraction of drops, kg/m³."""
    densities = feed.mixture.densities("solids", feed.temperature)
    light = floats(feed)
    flows = jnp.where(feed.solid_by_species @ light > 0, feed.solid_by_species, 1.0) * light
    some = jnp.sum(flows) > 0
    drops = jnp.where(
        some, jnp.sum(flows) / jnp.where(some, jnp.sum(flows / densities), 1.0), LIGHTER * feed.liquid_density
    )
    return share * drops + (1.0 - share) * feed.liquid_density


def interface(unit: Any, feed: Stream, radius_light: Any) -> Any:
    """Radius of the interface, m; a tenth of that of the light weir where the heavy one stands too far in for
    any.
    """
    heavy = feed.liquid_density
    light = jnp.minimum(light_density(feed, unit.light_solids_fraction), heavy - 1e-3)
    least = radius_light * jnp.sqrt((light + INMOST**2 * (heavy - light)) / heavy)
    return radius_interface(jnp.maximum(unit.radius_heavy, least), radius_light, heavy, light)


def refuse_weir(radius: Any, outer: Any, name: str) -> None:
    """Refuse a weir that stands outside the bowl: no liquid ring would form."""
    refuse_beyond(
        radius,
        outer,
        name,
        "A weir at {inner} m stands outside what holds the liquid, which reaches to {outer} m: "
        "give it a smaller radius.",
    )


class Separator(Bowl):
    """Abstract separator of two liquids and sediment. Two weirs (ring dam or gravity disc) set where the
    interface lies: in the discs what is outside it clears the heavy liquid of drops, what is inside it holds
    the light one.
    """

    _: KW_ONLY
    radius_heavy: Length
    radius_light: Length
    light_solids_fraction: OpenFraction = 0.9

    def __check_init__(self) -> None:
        refuse_weir(self.radius_heavy, self.radius_outer, "radius_heavy")
        refuse_weir(self.radius_light, self.radius_outer, "radius_light")

    def neutral(self, feed: Stream) -> Any:
        """Radius of the neutral zone, kept within what can settle, m."""
        reach = self.radius_outer - self.radius_inner
        return jnp.clip(
            interface(self, feed, self.radius_light), self.radius_inner, self.radius_outer - NARROWEST * reach
        )

    @abc.abstractmethod
    def shares(self, feed: Stream) -> tuple[Any, Any]:
        """Shares of each species and class that sink and that rise out."""

    @abc.abstractmethod
    def clearing(self, feed: Stream) -> Any:
        """Equivalent settling area that clears the heavy liquid, m²."""

    def cuts(self, feed: Stream) -> dict[str, Any]:
        """Cut sizes and interface, by name."""
        area = self.clearing(feed)
        return {
            "cut_size_centrifuge": self.cut_size(feed, area),
            "cut_size_rising": self.cut_size(feed, area, rising=True),
            "radius_interface": interface(self, feed, self.radius_light),
        }

    def measured_parting(self, feed: Stream, figures: Any) -> dict[str, Any]:
        """Numbers for the limits."""
        reach = self.radius_outer - self.radius_inner
        return self.measured_bowl(feed, figures) | {
            "solids": feed.solid_by_species
            @ ((1.0 - floats(feed)) / feed.mixture.densities("solids", feed.temperature))
            / jnp.maximum(feed.slurry_volume_flow, 1e-300),
            "drops": feed.solid_by_species
            @ (floats(feed) / feed.mixture.densities("solids", feed.temperature))
            / jnp.maximum(feed.slurry_volume_flow, 1e-300),
            "interface": (figures.radius_interface - self.radius_inner) / reach,
        }


DROPS: Limits = {
    "drops": Limit(
        "drops in the feed by volume (beyond, the light liquid is the continuous one)",
        0.0,
        0.5,
        "dimensionless",
        "leung1998",
    )
}


class DiscSeparating(Discs, Separator):
    """Abstract stack of discs that clears the heavy liquid outside the neutral zone."""

    def clearing(self, feed: Stream) -> Any:
        return self.sigma_between(self.neutral(feed), self.radius_outer)

    def shares(self, feed: Stream) -> tuple[Any, Any]:
        velocity, area = self.velocities(feed), self.clearing(feed)
        flow = jnp.maximum(feed.slurry_volume_flow, 1e-300)

        def caught(speed: Any) -> Any:
            return grade_efficiency_thin_layer(self.sigma_efficiency * speed, flow, area)

        sunk = jnp.where(velocity > 0, caught(jnp.maximum(velocity, 0.0)), 0.0)
        return sunk, floated_share(velocity, caught)


@equipment(
    "disc_separator",
    source="ambler1959; svarovsky2001; mccabe2005, ch. 29",
    title="Disc separator of two liquids",
    equation=r"E = \min\left(1,\; \frac{v_g\,\Sigma(r_i, r_2)}{Q}\right)",
)
class DiscSeparator(DiscSeparating):
    """Disc bowl with two liquid outlets that takes drops and light solids off a liquid, and ejects what
    sinks: cream from milk, oil from water.

    Drops are a dispersed species of the stream, lighter than the liquid. Each class of them rises, and each
    of the solids sinks, by the Σ of the discs between the interface and their rim, that is where the heavy
    liquid is cleared. Where the light liquid is the continuous one, take a purifier.
    """

    _: KW_ONLY
    sludge_volume: Volume = 0.005

    limits: ClassVar[Limits] = DISC_LIMITS | DROPS | INTERFACE | EJECTED

    def outlets(self, inside: None, feed: Stream) -> Parted:
        return part_liquids(
            feed, *self.shares(feed), self.sediment_solids_fraction, self.light_solids_fraction
        )

    def figures(self, inside: None, outlets: Parted, feed: Stream) -> PartedFigures:
        return PartedFigures(
            **(parted_figures(self, feed, outlets) | self.cuts(feed)),
            discharge_interval=discharge_interval(self.sludge_volume, outlets.sediment.slurry_volume_flow),
        )

    def measured(self, inside: None, outlets: Parted, figures: PartedFigures, feed: Stream) -> dict[str, Any]:
        return self.measured_parting(feed, figures) | {"emptied": figures.discharge_interval / 60.0}


@equipment(
    "nozzle_separator",
    source="ambler1959; svarovsky2001; leung1998",
    title="Nozzle separator",
    equation=r"Q = n\,C_d\,\frac{\pi d^2}{4}\,\omega\sqrt{R^2 - r_i^2}",
)
class NozzleSeparator(DiscSeparating):
    """Disc bowl that lets its concentrate out through nozzles at the rim all the time, with outlets for two
    liquids: yeast, starch, clay.

    The pressure of the liquid ring sets what the nozzles pass, whatever the feed brings; the liquid leaves
    with the sediment as far as there is some. Drops and light solids go to the inner outlet.
    """

    _: KW_ONLY
    nozzle_number: PositiveNumber
    nozzle_diameter: Length
    discharge_coefficient: Annotated[Fraction, Within(0.01)] = 0.7

    limits: ClassVar[Limits] = (
        DISC_LIMITS
        | DROPS
        | INTERFACE
        | {
            "plugging": Limit("largest grain over the nozzle", 0.0, 0.5, "dimensionless", "leung1998"),
            "drawn": Limit("what the nozzles draw, of the feed", 0.02, 0.8, "dimensionless", "leung1998"),
            "thick": Limit(
                "solids in the concentrate by volume over those of a packed sediment",
                0.0,
                0.9,
                "dimensionless",
                "leung1998",
            ),
        }
    )

    def nozzle_flow(self) -> Any:
        """What the nozzles pass, m³/s."""
        return nozzle_flow_bowl(
            self.nozzle_number,
            self.nozzle_diameter,
            self.rotation_speed,
            self.wall,
            self.radius_inner,
            self.discharge_coefficient,
        )

    def outlets(self, inside: None, feed: Stream) -> Parted:
        sunk, floated = self.shares(feed)
        solid = feed.part(solid=over_axes(sunk, feed)).solid_volume_flow
        thin = jnp.clip(solid / self.nozzle_flow(), 1e-12, self.sediment_solids_fraction)
        # Without solids the nozzles draw liquid alone.
        made = part_liquids(feed, sunk, floated, thin, self.light_solids_fraction)
        lacking = jnp.maximum(self.nozzle_flow() - made.sediment.slurry_volume_flow, 0.0)
        left = made.heavy.liquid_volume_flow
        share = jnp.where(left > 0, jnp.minimum(lacking / jnp.where(left > 0, left, 1.0), 1.0), 0.0)
        more = share * made.heavy.liquid
        return Parted(
            made.light,
            made.heavy.replace(liquid=made.heavy.liquid - more),
            made.sediment.replace(liquid=made.sediment.liquid + more),
        )

    def figures(self, inside: None, outlets: Parted, feed: Stream) -> NozzleFigures:
        return NozzleFigures(
            **(parted_figures(self, feed, outlets) | self.cuts(feed)),
            volume_flow_nozzles=outlets.sediment.slurry_volume_flow,
            solids_volume_fraction_sediment=outlets.sediment.solids_volume_fraction,
        )

    def measured(self, inside: None, outlets: Parted, figures: NozzleFigures, feed: Stream) -> dict[str, Any]:
        present = feed.solid_by_size > 1e-3 * feed.solid_flow
        largest = jnp.max(jnp.where(present, jnp.asarray(feed.mixture.sizes), 0.0))
        return self.measured_parting(feed, figures) | {
            "plugging": largest / self.nozzle_diameter,
            "drawn": self.nozzle_flow() / jnp.maximum(feed.slurry_volume_flow, 1e-300),
            "thick": figures.solids_volume_fraction_sediment / self.sediment_solids_fraction,
        }


@equipment(
    "tubular_separator",
    source="ambler1959; svarovsky2001; mccabe2005, ch. 29",
    title="Tubular separator of two liquids",
    equation=r"E = \min\left(1,\;\frac{\exp(2 v_g\omega^2\tau/g) - 1}{(r_2/r_i)^2 - 1}\right)",
)
class TubularSeparator(Tube, Separator):
    """Slender bowl at very high speed with a ring dam and two liquid outlets: fine emulsions at small flow;
    what sinks is cleaned out by hand.

    Drops are a dispersed species of the stream, lighter than the liquid; they rise to the interface that the
    weirs set, in plug flow of the whole feed through the heavy layer.
    """

    _: KW_ONLY
    sigma_efficiency: PositiveNumber = 0.9
    sludge_volume: Volume | None = None

    limits: ClassVar[Limits] = TUBE_LIMITS | DROPS | INTERFACE

    def clearing(self, feed: Stream) -> Any:
        return self.sigma()

    def shares(self, feed: Stream) -> tuple[Any, Any]:
        velocity = self.sigma_efficiency * self.velocities(feed)
        flow = jnp.maximum(feed.slurry_volume_flow, 1e-300)
        inner = jnp.maximum(self.neutral(feed), 1e-3 * self.radius_outer)

        def rises(speed: Any) -> Any:
            return grade_efficiency_tubular_rising(
                speed, flow, self.bowl_length, inner, self.radius_outer, self.rotation_speed
            )

        sunk = self.efficiency(jnp.maximum(velocity, 0.0), flow)
        return jnp.where(velocity > 0, sunk, 0.0), floated_share(velocity, rises)

    def outlets(self, inside: None, feed: Stream) -> Parted:
        return part_liquids(
            feed, *self.shares(feed), self.sediment_solids_fraction, self.light_solids_fraction
        )

    def figures(self, inside: None, outlets: Parted, feed: Stream) -> PartedFigures:
        return PartedFigures(
            **(parted_figures(self, feed, outlets) | self.cuts(feed)),
            discharge_interval=discharge_interval(
                self.space(self.sludge_volume), outlets.sediment.slurry_volume_flow
            ),
        )

    def measured(self, inside: None, outlets: Parted, figures: PartedFigures, feed: Stream) -> dict[str, Any]:
        return self.measured_parting(feed, figures) | {
            "slender": self.bowl_length / self.radius_outer,
            "critical": self.rotation_speed / self.critical(feed),
            "emptied": figures.discharge_interval / 3600.0,
        }
