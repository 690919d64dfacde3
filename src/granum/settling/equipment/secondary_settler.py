"""Secondary settler of activated sludge in layers, after Takács."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment, stand_ins
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Concentration,
    Distance,
    Fraction,
    Law,
    Length,
    Mass,
    MassFlux,
    Ratio,
    Speed,
    Time,
    VolumeFlow,
    Within,
)
from granum.core.limits import Limit
from granum.numerics.smooth import safe_divide
from granum.settling.equipment.gravity import Outlets, concentration, floating_share
from granum.settling.equipment.rakes import CLARIFIER, RAKED, raked
from granum.settling.flux import passing_flux
from granum.settling.layers import Tank, at_rest, blanket_height, check_law, settler
from granum.settling.velocities import Takacs
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import AREA


class SecondarySettlerFigures(NamedTuple):
    """Figures of a secondary settler at rest."""

    loading_ratio: Ratio
    overflow_rate: Speed
    applied_flux: MassFlux
    underflow_concentration: Concentration
    overflow_concentration: Concentration
    blanket_height: Distance
    solids_held: Mass
    retention_time: Time


class Layers(NamedTuple):
    """The tank and the concentration of its layers, from the top, kg/m³."""

    tank: Tank
    concentration: Any


stand_ins.circle("underflow_volume_flow", "height")


@equipment(
    "secondary_settler",
    source="takacs1991; alex2008",
    title="Secondary settler in layers (Takács)",
    equation=(
        r"\frac{H}{n}\frac{\mathrm{d}C_j}{\mathrm{d}t} = q_{j-1}C_{j-1} - q_jC_j + J_{j-1} - J_j,\quad "
        r"J_j = \min\left(v_jC_j,\ v_{j+1}C_{j+1}\right)"
    ),
)
class SecondarySettler(Unit):
    """Secondary settler of activated sludge, rated as a pile of even layers at rest, after Takács.

    It tells what flux theory does not: the solids that a tank in good order still loses over the weir. All
    species and sizes settle together. ``nonsettleable_share`` of the feed stays in the water, 0.00228 in the
    IWA benchmark plant. The ten layers are part of the model and stand for the mixing of a real tank; where
    the sludge is compressed, or the load changes, see the clarifier-thickener.
    """

    area: Area
    height: Length
    underflow_volume_flow: VolumeFlow
    settling: Annotated[Any, Law("settling_velocity")] = Takacs()
    nonsettleable_share: Fraction = 0.0
    feed_depth_share: Fraction = 0.45
    threshold_concentration: Concentration = 3.0
    layers: Annotated[int, Within(3, 200)] = eqx.field(static=True, default=10)

    limits: ClassVar[Limits] = {
        "thickening": Limit("loading of the thickening zone", 0.0, 1.0, "dimensionless", "yoshioka1957"),
        "blanket": Limit("blanket over the depth below the feed", 0.0, 1.0, "dimensionless", "keinath1985"),
        "floats": Limit(
            "floating matter, which has no outlet here", 0.0, 0.01, "dimensionless", "coe1916", quiet=True
        ),
        "diameter": Limit("diameter", 0.0, 60.0, "m", "degremont2007"),
        "drawn": Limit("underflow asked for over the feed", 0.0, 1.0, "dimensionless", "coe1916"),
    }

    utilities: ClassVar[Utilities] = RAKED | AREA

    def __check_init__(self) -> None:
        check_law(self.settling, self.nonsettleable_share)

    def inside(self, feed: Stream) -> Layers:
        """The layers at rest."""
        tank = settler(
            feed.slurry_volume_flow,
            concentration(feed),
            self.underflow_volume_flow,
            self.area,
            self.height,
            self.settling,
            self.nonsettleable_share,
            self.feed_depth_share,
            self.threshold_concentration,
            feed.solid_density,
            self.layers,
        )
        rest = at_rest(tank)
        unsolved(rest.found, self.card)
        return Layers(tank, rest.concentration)

    def outlets(self, inside: Layers, feed: Stream) -> Outlets:
        tank, bottom = inside.tank, inside.concentration[-1]
        drawn = tank.underflow_velocity / tank.feed_velocity
        share = jnp.clip(drawn * safe_divide(bottom, tank.feed_concentration, 1.0), 0.0, 1.0)
        liquid = drawn * feed.slurry_volume_flow - share * feed.solid_volume_flow
        wet = jnp.clip(safe_divide(liquid, feed.liquid_volume_flow), 0.0, 1.0)
        return Outlets(
            feed.part(solid=share, liquid=wet), feed.part(solid=1.0 - share, liquid=1.0 - wet, gas=1.0)
        )

    def figures(self, inside: Layers, outlets: Outlets, feed: Stream) -> SecondarySettlerFigures:
        tank, C = inside.tank, concentration(feed)
        applied = tank.feed_velocity * C
        limit = passing_flux(
            C, tank.underflow_velocity, tank.suspension.velocity, jnp.maximum(tank.solid_density, C)
        )[0]
        held = jnp.mean(inside.concentration) * self.height * self.area
        return SecondarySettlerFigures(
            safe_divide(applied, limit),
            tank.feed_velocity - tank.underflow_velocity,
            applied,
            concentration(outlets.underflow),
            concentration(outlets.overflow),
            blanket_height(tank, inside.concentration),
            held,
            held / jnp.where(feed.solid_flow > 0, feed.solid_flow, jnp.inf),
        )

    def measured(
        self, inside: Layers, outlets: Outlets, figures: SecondarySettlerFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "drawn": safe_divide(self.underflow_volume_flow, feed.slurry_volume_flow),
            "thickening": figures.loading_ratio,
            "blanket": figures.blanket_height / (self.height * (1.0 - self.feed_depth_share)),
            "floats": floating_share(feed),
            "diameter": jnp.sqrt(4.0 * self.area / jnp.pi),
        }

    def drawn(
        self, inside: Layers, outlets: Outlets, figures: SecondarySettlerFigures, feed: Stream
    ) -> dict[str, Any]:
        return {"electric_power_rake": raked(self.area, CLARIFIER), "area_installed": self.area}

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        from granum.settling.charts import layered

        return {_("Layers of a secondary settler"): layered(made.inside.concentration, self.height)}
