"""Continuous thickener by solids flux."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import Area, Concentration, Law, MassFlow, MassFlux, Ratio, Speed, VolumeFlow
from granum.numerics.smooth import safe_divide
from granum.settling.equipment.gravity import Outlets, concentration, divide
from granum.settling.flux import limiting_flux_underflow
from granum.streams.sharing import shared
from granum.streams.stream import Stream
from granum.streams.units import Check, Unit

Settling = Annotated[Any, Law("settling_velocity")]


class ThickenerFigures(NamedTuple):
    """Figures of a thickener."""

    applied_flux: MassFlux
    limiting_flux: MassFlux
    loading_ratio: Ratio
    clarification_ratio: Ratio
    limiting_concentration: Concentration
    overflow_rate: Speed
    underflow_volume_flow: VolumeFlow
    overflow_concentration: Concentration


@equipment("thickener", source="yoshioka1957; coe1916", title="Thickener")
class Thickener(Unit):
    """Continuous thickener of a given area that draws an underflow of a given concentration, by solids-flux theory.

    Up to the limiting flux all solids leave with the underflow; what exceeds it leaves over the weir. All sizes settle together
    (zone settling), so every class splits alike.
    """

    area: Area
    underflow_concentration: Concentration
    settling: Settling

    @shared
    def limit(self, feed: Stream) -> Any:
        """Limiting flux and the layer that causes it."""
        return limiting_flux_underflow(self.underflow_concentration, concentration(feed), self.settling)

    def __call__(self, feed: Stream) -> Outlets:
        load = feed.solid_flow / self.area
        limit = self.limit(feed).limiting_flux
        passes = jnp.where(load > 0, jnp.minimum(limit / jnp.where(load > 0, load, 1.0), 1.0), 1.0)
        # A feed as thick as the underflow has nothing to lose: it passes.
        return divide(feed, jnp.where(jnp.isfinite(passes), passes, 1.0), self.underflow_concentration)

    def results(self, inlets: Mapping[str, Stream], outlets: Outlets) -> ThickenerFigures:
        feed = inlets["feed"]
        applied, found = feed.solid_flow / self.area, self.limit(feed)
        limits = jnp.isfinite(found.limiting_flux)  # a feed as thick as the underflow is its own limiting layer: it passes as it is
        limit, layer = jnp.where(limits, found.limiting_flux, applied), jnp.where(limits, found.limiting_concentration, concentration(feed))
        rate = outlets.overflow.slurry_volume_flow / self.area
        velocity = self.settling(concentration(feed))
        return ThickenerFigures(
            applied, limit, jnp.where(limits, safe_divide(applied, limit), 1.0), rate / velocity, layer, rate,
            outlets.underflow.slurry_volume_flow, concentration(outlets.overflow),
        )  # fmt: skip

    def checks(self, inlets: Mapping[str, Stream], outlets: Outlets) -> tuple[Check, ...]:
        figures = self.results(inlets, outlets)
        diameter = jnp.sqrt(4.0 * self.area / jnp.pi)
        thinner = concentration(inlets["feed"]) / self.underflow_concentration
        return (
            Check("feed thinner than the underflow", thinner, 0.0, 1.0, "dimensionless", "coe1916"),
            Check("loading of the thickening zone", figures.loading_ratio, 0.0, 1.0, "dimensionless", "yoshioka1957"),
            Check("loading of the clarification zone", figures.clarification_ratio, 0.0, 1.0, "dimensionless", "coe1916"),
            Check("diameter", diameter, 0.0, 60.0, "m", "degremont2007"),
        )

    @classmethod
    def size(
        cls, mass_flow: MassFlow, feed_concentration: Concentration, underflow_concentration: Concentration, settling: Any,
        safety_factor: Ratio = 1.25,
    ) -> Thickener:  # fmt: skip
        """The thickener for a solids flow, with a factor on the area that flux theory gives."""
        limit = limiting_flux_underflow(underflow_concentration, feed_concentration, settling).limiting_flux
        return cls(area=safety_factor * mass_flow / limit, underflow_concentration=underflow_concentration, settling=settling)
