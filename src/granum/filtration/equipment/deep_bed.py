"""Deep bed of sand in a line: capture by size class, head loss, run and backwash, averaged over the cycle."""

from __future__ import annotations

from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import HOUR, STANDARD_GRAVITY
from granum.core.kinds import (
    Area,
    Density,
    Distance,
    Fraction,
    Length,
    OpenFraction,
    SpecificSurface,
    Speed,
    Sphericity,
    Time,
    VoidFraction,
    Within,
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.filtration.formulas.backwash import backwash_velocity
from granum.filtration.formulas.depth import (
    collector_efficiency_tufenkji,
    filter_coefficient,
    head_loss_clean_bed,
)
from granum.filtration.kinds import HeadLossPerDeposit
from granum.numerics.smooth import safe_divide
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import AREA, PUMPED, pumped


class DeepBedOutlets(NamedTuple):
    """Filtrate, and the wash water with what the bed had caught."""

    filtrate: Stream
    washings: Stream


class DeepBedFigures(NamedTuple):
    """Figures of a deep bed."""

    superficial_velocity: Speed
    removal_efficiency: Fraction
    head_loss_clean: Distance
    run_time: Time
    backwash_velocity: Speed
    wash_water_share: Fraction


class FilterRun(NamedTuple):
    """Share caught of each species and class, clean head loss, run time, backwash velocity, share of the
    filtrate that the backwash takes.
    """

    caught: Any
    clean: Any
    run: Any
    wash: Any
    water: Any


@equipment(
    "deep_bed_filter",
    source="iwasaki1937; ives1970; tufenkji2004; fair1933",
    title="Deep bed filter",
    typical={"particle_density": (2500.0, 2700.0)},
)
class DeepBedFilter(Unit):
    """Bed of sand that catches thin suspensions by depth, and is expanded by its own filtrate when the head
    is used up.

    Every size class is caught by its own coefficient (Tufenkji and Elimelech) times the attachment
    efficiency, or all by a given one. The grains of the bed are no part of the streams; their sphericity
    counts for the head loss of the settled bed. Several beds take turns, so that flows are averaged over run
    and backwash.
    """

    area: Area
    bed_depth: Length
    collector_diameter: Length
    _: KW_ONLY
    void_fraction: VoidFraction = 0.42
    attachment_efficiency: Fraction = 0.5
    filter_coefficient: SpecificSurface | None = None
    head_loss_allowed: Distance = 2.0
    head_loss_per_deposit: HeadLossPerDeposit = 1.0
    bed_expansion: Annotated[OpenFraction, Within(0.01, 0.9)] = 0.2
    backwash_time: Time = 600.0
    particle_density: Density = 2650.0
    sphericity: Sphericity = 0.8

    limits: ClassVar[Limits] = {
        "rate": Limit("filtration rate of a deep bed", 2.0, 25.0, "m/hour", "ives1970"),
        "run": Limit("run time between backwashes", 8.0, 100.0, "hour", "ives1970"),
        "wash": Limit("wash water over filtrate", 0.0, 0.06, "dimensionless", "ives1970"),
        "thin": Limit("solids by volume in the feed", 0.0, 5e-4, "dimensionless", "svarovsky2001"),
    }

    utilities: ClassVar[Utilities] = (
        PUMPED | AREA | {"electric_power_backwash": Utility("ives1970; turton2018, ch. 11")}
    )

    def _velocity(self, feed: Stream) -> Any:
        return jnp.maximum(feed.slurry_volume_flow / self.area, 1e-12)

    def caught(self, feed: Stream) -> Any:
        """Share of each species and size class that the bed keeps."""
        m = feed.mixture
        density = m.densities("solids", feed.temperature)[:, None] + 0.0 * jnp.asarray(m.sizes)
        if self.filter_coefficient is not None:
            return -jnp.expm1(-self.filter_coefficient * self.bed_depth) + 0.0 * density
        one = collector_efficiency_tufenkji(
            jnp.asarray(m.sizes) + 0.0 * density,
            self.collector_diameter,
            self._velocity(feed),
            self.void_fraction,
            density,
            feed.liquid_density,
            feed.liquid_viscosity,
            feed.temperature,
        )
        coefficient = filter_coefficient(
            jnp.minimum(one, 1.0), self.collector_diameter, self.void_fraction, self.attachment_efficiency
        )
        return -jnp.expm1(-coefficient * self.bed_depth)

    def inside(self, feed: Stream) -> FilterRun:
        U = self._velocity(feed)
        clean = head_loss_clean_bed(
            self.bed_depth,
            self.sphericity * self.collector_diameter,
            U,
            self.void_fraction,
            feed.liquid_viscosity,
            feed.liquid_density,
        )
        share = self.caught(feed)
        share = share.reshape(share.shape + (1,) * len(feed.mixture.axes))
        kept = jnp.sum(feed.solid * share) / self.area
        run = safe_divide(
            jnp.maximum(self.head_loss_allowed - clean, 0.0), self.head_loss_per_deposit * kept, otherwise=1e9
        )
        wash = backwash_velocity(
            self.bed_expansion,
            jnp.reshape(self.collector_diameter, (1,)),
            jnp.ones(1),
            self.particle_density,
            feed.liquid_density,
            feed.liquid_viscosity,
            self.void_fraction,
        )
        water = jnp.minimum(safe_divide(wash * self.backwash_time, U * (run + self.backwash_time)), 0.999)
        return FilterRun(share, clean, run, wash, water)

    def outlets(self, inside: FilterRun, feed: Stream) -> DeepBedOutlets:
        washings = feed.part(solid=inside.caught, liquid=inside.water)
        return DeepBedOutlets(
            feed.replace(solid=feed.solid - washings.solid, liquid=feed.liquid - washings.liquid), washings
        )

    def figures(self, inside: FilterRun, outlets: DeepBedOutlets, feed: Stream) -> DeepBedFigures:
        removed = safe_divide(outlets.washings.solid_flow, feed.solid_flow)
        return DeepBedFigures(
            self._velocity(feed), removed, inside.clean, inside.run, inside.wash, inside.water
        )

    def measured(
        self, inside: FilterRun, outlets: DeepBedOutlets, figures: DeepBedFigures, feed: Stream
    ) -> dict[str, Any]:
        rate, run = HOUR * figures.superficial_velocity, inside.run / HOUR
        return {"rate": rate, "run": run, "wash": inside.water, "thin": feed.solids_volume_fraction}

    def drawn(
        self, inside: FilterRun, outlets: DeepBedOutlets, figures: DeepBedFigures, feed: Stream
    ) -> dict[str, Any]:
        weight, light = STANDARD_GRAVITY * feed.liquid_density, feed.liquid_density
        head = 0.5 * (inside.clean + jnp.maximum(self.head_loss_allowed, inside.clean))
        bed = (1.0 - self.void_fraction) * self.bed_depth * STANDARD_GRAVITY * (self.particle_density - light)
        washed = outlets.washings.liquid_volume_flow
        return {
            "electric_power_pump": pumped(feed.slurry_volume_flow, weight * head),
            "electric_power_backwash": pumped(washed, jnp.maximum(bed, 0.0)),
            "area_installed": self.area,
        }
