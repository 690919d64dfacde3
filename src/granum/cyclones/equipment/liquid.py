"""Hydrocyclones in streams: Castilho and Medronho's cut, split and sharpness on every size class."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.kinds import Fraction, Length, PositiveNumber, PressureDrop, Within
from granum.core.limits import Limit
from granum.cyclones.formulas.hydrocyclones import (
    HydrocycloneFigures,
    hydrocyclone_castilho_medronho,
    hydrocyclone_efficiency,
)
from granum.numerics.smooth import safe_divide
from granum.streams.cakes import sinking_solids
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import PUMPED, pumped

MOST_PACKED = 0.6  # of solids by volume in what an apex lets out


class Split(NamedTuple):
    """Thick and clear stream."""

    underflow: Stream
    overflow: Stream


class SplitFigures(NamedTuple):
    """Figures of a hydrocyclone."""

    cut_size: Length
    pressure_drop: PressureDrop
    underflow_share: Fraction
    sharpness: PositiveNumber
    removal_efficiency: Fraction


@equipment("hydrocyclone", source="castilho2000; svarovsky2001", title="Hydrocyclone")
class Hydrocyclone(Unit):
    """Equal hydrocyclones of Rietema's proportions in parallel: every size class split by its efficiency, the
    liquid by the water split.

    Both outlets are open to the air: what the feed lacks in pressure, its own pump gives. Solids lighter than
    the liquid are outside the model: they are divided like the liquid, and a check tells it.

    The correlations do not know how thick an underflow still leaves. Above half of solids by volume it comes
    as a rope, which a check tells; beyond 0.6, as solids lie in a heap, the apex is choked, and what it
    cannot pass goes over, of all sizes in the same share (both figures recalled, the share our own).
    """

    diameter: Length
    underflow_diameter: Length
    parallel_number: Annotated[PositiveNumber, Within(1.0, 1000.0)] = 1.0

    limits: ClassVar[Limits] = {
        "drop": Limit("pressure drop", 3e4, 4e5, "Pa", "svarovsky2001"),
        "solids": Limit("solids by volume in the feed", 0.0, 0.1, "dimensionless", "castilho2000"),
        "rope": Limit("solids by volume in the underflow", 0.0, 0.5, "dimensionless", "svarovsky2001"),
        "sinking": Limit(
            "share of the solids that is heavier than the liquid",
            1.0 - 1e-3,
            1.0,
            "dimensionless",
            "castilho2000",
        ),
    }

    utilities: ClassVar[Utilities] = PUMPED

    @staticmethod
    def passed(share: Any, water: Any, feed: Stream) -> Any:
        """The shares of species and sizes that a full apex lets out below: less of what goes beyond the share
        of the water.
        """
        m = feed.mixture
        axes = tuple(range(2, feed.solid.ndim))
        volume = jnp.sum(feed.solid, axis=axes) / m.densities("solids", feed.temperature)[:, None]
        along = water * jnp.sum(volume)
        sorted_out = jnp.sum(volume * (share - water))
        room = MOST_PACKED / (1.0 - MOST_PACKED) * water * feed.liquid_volume_flow - along
        kept = jnp.clip(safe_divide(room, sorted_out, 1.0), 0.0, 1.0)
        return water + kept * (share - water)

    def cut(self, feed: Stream, density: Any) -> HydrocycloneFigures:
        """Cut, pressure drop, split and sharpness for solids of a density."""
        flow = jnp.maximum(feed.slurry_volume_flow, 1e-12) / self.parallel_number
        return hydrocyclone_castilho_medronho(
            flow,
            self.diameter,
            self.underflow_diameter,
            jnp.minimum(feed.solids_volume_fraction, 0.999),
            density,
            feed.liquid_density,
            feed.liquid_viscosity,
        )

    def inside(self, feed: Stream) -> tuple[HydrocycloneFigures, Any]:
        """Cut and split of the solids that sink, and their share of all solids."""
        sinking, density = sinking_solids(feed)
        return self.cut(feed, density), sinking

    def outlets(self, inside: tuple[HydrocycloneFigures, Any], feed: Stream) -> Split:
        m = feed.mixture
        density = m.densities("solids", feed.temperature)[:, None] + 0.0 * jnp.asarray(m.sizes)
        heavy = density > feed.liquid_density
        found = self.cut(feed, jnp.where(heavy, density, 2.0 * feed.liquid_density))
        share = hydrocyclone_efficiency(
            jnp.asarray(m.sizes) + 0.0 * density, found.cut_size, found.sharpness, found.underflow_share
        )
        share = jnp.where(heavy, share, found.underflow_share)
        share = self.passed(share, jnp.ravel(found.underflow_share)[0], feed)
        share = share.reshape(share.shape + (1,) * len(m.axes))
        under = feed.part(solid=share, liquid=jnp.ravel(found.underflow_share)[0])
        over = feed.replace(solid=feed.solid - under.solid, liquid=feed.liquid - under.liquid)
        least = jnp.minimum(feed.pressure, STANDARD_ATMOSPHERE)
        lower = jnp.maximum(feed.pressure - jnp.ravel(found.pressure_drop)[0], least)
        return Split(under.replace(pressure=lower), over.replace(pressure=lower))

    def figures(self, inside: tuple[HydrocycloneFigures, Any], outlets: Split, feed: Stream) -> SplitFigures:
        return SplitFigures(*inside[0], safe_divide(outlets.underflow.solid_flow, feed.solid_flow))

    def measured(
        self, inside: tuple[HydrocycloneFigures, Any], outlets: Split, figures: SplitFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "drop": figures.pressure_drop,
            "solids": feed.solids_volume_fraction,
            "rope": outlets.underflow.solids_volume_fraction,
            "sinking": inside[1],
        }

    def drawn(
        self, inside: tuple[HydrocycloneFigures, Any], outlets: Split, figures: SplitFigures, feed: Stream
    ) -> dict[str, Any]:
        drop = jnp.ravel(jnp.asarray(figures.pressure_drop))[0]
        return {"electric_power_pump": pumped(feed.slurry_volume_flow, drop)}
