"""Continuous thickener by solids flux."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import equipment, stand_ins
from granum.core.i18n import _
from granum.core.kinds import Area, Concentration, Law, MassFlow, MassFlux, Ratio, Speed, VolumeFlow
from granum.core.limits import Limit
from granum.numerics.smooth import safe_divide
from granum.settling.equipment.gravity import (
    Outlets,
    concentration,
    divide,
    floating_share,
    floats,
    over_axes,
)
from granum.settling.equipment.rakes import RAKED, THICKENER, raked
from granum.settling.flux import limiting_flux_underflow
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import AREA

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


stand_ins.circle("underflow_concentration")


@equipment("thickener", source="yoshioka1957; coe1916", title="Thickener")
class Thickener(Unit):
    """Continuous thickener of a given area that draws an underflow of a given concentration, by solids-flux
    theory.

    Up to the limiting flux all solids leave with the underflow; what exceeds it leaves over the weir. All
    sizes settle together (zone settling), so every class splits alike. What is lighter than the liquid goes
    over the weir. Whether the liquid follows Newton or not is in the settling velocity, which is that of a
    test in it.
    """

    area: Area
    underflow_concentration: Concentration
    settling: Settling

    limits: ClassVar[Limits] = {
        "thinner": Limit("feed thinner than the underflow", 0.0, 1.0, "dimensionless", "coe1916"),
        "thickening": Limit("loading of the thickening zone", 0.0, 1.0, "dimensionless", "yoshioka1957"),
        "clarification": Limit("loading of the clarification zone", 0.0, 1.0, "dimensionless", "coe1916"),
        "floats": Limit(
            "floating matter, which has no outlet here", 0.0, 0.01, "dimensionless", "coe1916", quiet=True
        ),
        "diameter": Limit("diameter", 0.0, 60.0, "m", "degremont2007"),
    }

    utilities: ClassVar[Utilities] = RAKED | AREA

    def inside(self, feed: Stream) -> Any:
        """Limiting flux and the layer that causes it."""
        return limiting_flux_underflow(self.underflow_concentration, concentration(feed), self.settling)

    def outlets(self, inside: Any, feed: Stream) -> Outlets:
        load, limit = feed.solid_flow / self.area, inside.limiting_flux
        passes = jnp.where(load > 0, jnp.minimum(limit / jnp.where(load > 0, load, 1.0), 1.0), 1.0)
        # A feed as thick as the underflow has nothing to lose: it passes.
        share = jnp.where(jnp.isfinite(passes), passes, 1.0) * (1.0 - floats(feed))[:, None]
        return divide(feed, over_axes(share, feed), self.underflow_concentration)

    def figures(self, inside: Any, outlets: Outlets, feed: Stream) -> ThickenerFigures:
        applied = feed.solid_flow / self.area
        # a feed as thick as the underflow is its own limiting layer: it passes as it is
        limits = jnp.isfinite(inside.limiting_flux)
        limit, layer = (
            jnp.where(limits, inside.limiting_flux, applied),
            jnp.where(limits, inside.limiting_concentration, concentration(feed)),
        )
        rate = outlets.overflow.slurry_volume_flow / self.area
        velocity = self.settling(concentration(feed))
        return ThickenerFigures(
            applied,
            limit,
            jnp.where(limits, safe_divide(applied, limit), 1.0),
            rate / velocity,
            layer,
            rate,
            outlets.underflow.slurry_volume_flow,
            concentration(outlets.overflow),
        )

    def measured(
        self, inside: Any, outlets: Outlets, figures: ThickenerFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "thinner": concentration(feed) / self.underflow_concentration,
            "thickening": figures.loading_ratio,
            "clarification": figures.clarification_ratio,
            "floats": floating_share(feed),
            "diameter": jnp.sqrt(4.0 * self.area / jnp.pi),
        }

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        from granum.settling.charts import operating_line

        feed, found = inlets["feed"], made.figures
        if float(feed.solid_flow) <= 0.0 or not np.isfinite(float(made.inside.limiting_flux)):
            return {}  # nothing settles, or nothing is left to thicken
        drawn = operating_line(
            float(concentration(feed)),
            float(self.underflow_concentration),
            float(found.applied_flux),
            float(found.limiting_flux),
            float(found.limiting_concentration),
            self.settling,
        )
        return {_("Flux curve and load of a thickener"): drawn}

    def drawn(self, inside: Any, outlets: Outlets, figures: ThickenerFigures, feed: Stream) -> dict[str, Any]:
        return {"electric_power_rake": raked(self.area, THICKENER), "area_installed": self.area}

    @classmethod
    def size(
        cls,
        mass_flow: MassFlow,
        feed_concentration: Concentration,
        underflow_concentration: Concentration,
        settling: Any,
        safety_factor: Ratio = 1.25,
    ) -> Thickener:
        """The thickener for a solids flow, with a factor on the area that flux theory gives."""
        limit = limiting_flux_underflow(underflow_concentration, feed_concentration, settling).limiting_flux
        return cls(
            area=safety_factor * mass_flow / limit,
            underflow_concentration=underflow_concentration,
            settling=settling,
        )
