"""Extraction hood: where a mill, screen, silo or belt gives its dust to the air."""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import Area, Concentration, Fraction, Speed
from granum.core.limits import Limit
from granum.numerics.smooth import safe_divide
from granum.streams.atmosphere import EXPLOSIBLE, explosible
from granum.streams.fines import fall, finest, held, parted
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit

SLOWEST = 1e-9  # m/s
SCREENED = 1.5e-4  # of fines on a screen


class Extracted(NamedTuple):
    """Air with the dust, and the solid that stays."""

    gas: Stream
    product: Stream


class HoodFigures(NamedTuple):
    """Figures of an extraction hood."""

    superficial_velocity: Speed
    entrained_share: Fraction
    concentration_outlet: Concentration


class Drawn(NamedTuple):
    """Velocity in the opening, and share taken of each species and size class."""

    velocity: Any
    share: Any


@equipment(
    "extraction_hood",
    source="acgih2013; ap42_1995; tan2014, eq. 6.22",
    title="Dust extraction hood",
    equation=r"s = e^{-v_s/U}",
)
class ExtractionHood(Unit):
    """Air is drawn off over a falling or moving solid, behind a mill, a screen, a silo outlet or a belt, and
    takes some of it along as dust, the finest.

    How much is a ``dusting_fraction``: AP-42 has 0.15 kg a tonne for screens of fines, 0.02 for crushers of
    fines, 0.0015 for transfers between belts (section 11.19.2, recalled). With ``entrainment`` it is all that
    turbulent air holds against its fall in the opening, as in an air classifier: an upper bound where the
    solid does not rain through the air. Gas that comes with the solid goes with the air.
    """

    area: Area
    dusting_fraction: Fraction = SCREENED
    entrainment: bool = False

    limits: ClassVar[Limits] = {
        "capture": Limit("velocity of the air in the opening of a hood", 0.5, 2.5, "m/s", "acgih2013")
    } | EXPLOSIBLE

    def inside(self, feed: Stream, air: Stream) -> Drawn:
        drawn = feed.part(gas=1.0) + air
        if self.entrainment:
            share = held(fall(feed, drawn), drawn, self.area)
        else:
            share = finest(feed, self.dusting_fraction)
        return Drawn(jnp.maximum(drawn.gas_volume_flow / self.area, SLOWEST), share)

    def outlets(self, inside: Drawn, feed: Stream, air: Stream) -> Extracted:
        drawn = feed.part(gas=1.0) + air
        product, dust = parted(feed.part(solid=1.0, liquid=1.0), inside.share)
        return Extracted(drawn + dust, product)

    def figures(self, inside: Drawn, outlets: Extracted, feed: Stream, air: Stream) -> HoodFigures:
        return HoodFigures(
            inside.velocity,
            safe_divide(outlets.gas.solid_flow - air.solid_flow, feed.solid_flow),
            safe_divide(outlets.gas.solid_flow, outlets.gas.gas_volume_flow),
        )

    def measured(
        self, inside: Drawn, outlets: Extracted, figures: HoodFigures, feed: Stream, air: Stream
    ) -> dict[str, Any]:
        return explosible(outlets.gas) | {"capture": inside.velocity}
