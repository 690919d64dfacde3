"""Vibrating screen whose cut follows from its area and its load, after Karra."""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.comminution.equipment.screens import Screen, Screened, fraction_below
from granum.comminution.formulas import screen_capacity as karra
from granum.core import equipment
from granum.core.kinds import (
    Angle,
    Area,
    Density,
    Distance,
    Fraction,
    Length,
    MassFlow,
    MassFlux,
    OpenFraction,
    Ratio,
)
from granum.core.limits import Limit
from granum.particles.partition import RosinRammlerPartition
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import AREA

SHARPNESS = 5.846
_LARGEST_NEAR_SIZE = 0.99


class VibratingScreenFigures(NamedTuple):
    """Figures of a vibrating screen."""

    mass_flow_oversize: MassFlow
    mass_flow_undersize: MassFlow
    cut_size: Length
    throughfall_aperture: Length
    screening_capacity: MassFlux
    screen_loading: Ratio
    screening_recovery: Fraction
    screening_rejection: Fraction
    screening_effectiveness: Fraction


class _Load(NamedTuple):
    opening: Length
    capacity: MassFlux
    loading: Ratio
    cut: Length


@equipment(
    "vibrating_screen",
    source="karra1979; king2012",
    title="Vibrating screen (Karra)",
    typical={"aperture": (2e-3, 5e-2)},
)
class VibratingScreen(Unit):
    """A deck of given area: the more undersize it is fed, the finer it cuts. The cut size never exceeds the
    aperture.

    Capacity and cut size are Karra's; oversize, half-size and near-size fractions are read from the feed.
    Undersize over capacity above 1 means that the screen cuts below its throughfall aperture.
    """

    aperture: Length
    screen_area: Area
    wire_diameter: Distance = 0.0
    deck_inclination: Angle = 0.0
    deck: karra.Deck = 1
    wetting: karra.Wetting = "dry"
    bulk_density: Density = karra.STANDARD_BULK_DENSITY
    open_area_fraction: OpenFraction | None = None
    liquid_split_oversize: Fraction = 0.0

    limits: ClassVar[Limits] = {
        "load": Limit(
            "undersize fed over the capacity of the screen", 0.0, 1.0, "dimensionless", "karra1979"
        ),
    }

    utilities: ClassVar[Utilities] = AREA

    def inside(self, feed: Stream) -> _Load:
        h = karra.throughfall_aperture(self.aperture, self.wire_diameter, self.deck_inclination)
        below = fraction_below(feed, h)
        near = jnp.clip(
            fraction_below(feed, 1.25 * h) - fraction_below(feed, 0.75 * h), 1e-9, _LARGEST_NEAR_SIZE
        )
        capacity = karra.screening_capacity_karra(
            h,
            1.0 - below,
            fraction_below(feed, 0.5 * h),
            near,
            self.deck,
            self.wetting,
            self.bulk_density,
            self.open_area_fraction,
        )
        flux = feed.solid_flow * below / self.screen_area
        light = jnp.maximum(flux, 1e-9 * capacity)  # an idle screen cuts at its aperture as well
        cut = jnp.minimum(karra.cut_size_karra(h, light, capacity), self.aperture)
        return _Load(h, capacity, flux / capacity, cut)

    def outlets(self, inside: _Load, feed: Stream) -> Screened:
        return Screen(RosinRammlerPartition(inside.cut, SHARPNESS), self.liquid_split_oversize)(feed)

    def figures(self, inside: _Load, outlets: Screened, feed: Stream) -> VibratingScreenFigures:
        # judged at the throughfall aperture, the size that an ideal deck would cut at
        figures = Screen(RosinRammlerPartition(inside.opening, SHARPNESS)).figures(None, outlets, feed)
        return VibratingScreenFigures(
            outlets.oversize.mass_flow,
            outlets.undersize.mass_flow,
            inside.cut,
            inside.opening,
            inside.capacity,
            inside.loading,
            figures.screening_recovery,
            figures.screening_rejection,
            figures.screening_effectiveness,
        )

    def measured(
        self, inside: _Load, outlets: Screened, figures: VibratingScreenFigures, feed: Stream
    ) -> dict[str, Any]:
        return {"load": inside.loading}

    def drawn(
        self, inside: _Load, outlets: Screened, figures: VibratingScreenFigures, feed: Stream
    ) -> dict[str, Any]:
        return {"area_installed": self.screen_area}

    @classmethod
    def size(
        cls, mass_flow_undersize: MassFlow, screening_capacity: MassFlux, aperture: Length
    ) -> VibratingScreen:
        """The screen whose area passes a flow of undersize at its capacity."""
        return cls(aperture, karra.screen_area_karra(mass_flow_undersize, screening_capacity))
