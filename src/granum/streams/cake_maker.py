"""``CakeMaker``: what filters and filtering centrifuges share beyond the balance: washing by dispersion,
dissolution, what is left.
"""

from __future__ import annotations

import abc
from collections.abc import Mapping
from dataclasses import KW_ONLY
from typing import Annotated, Any

import jax.numpy as jnp

from granum.core.i18n import _
from granum.core.kinds import Diffusivity, Fraction, Law, Length, MediumResistance, SurfaceTension
from granum.porous.displacement import practical_number, remaining_fraction
from granum.streams.cake_course import Stage, drawn_course
from granum.streams.cakes import Filtered, part_cake, solid_diameter, void_flow
from granum.streams.dissolution import dissolved_share
from granum.streams.stream import Stream
from granum.streams.units import Operated, Unit


class CakeMaker(Unit):
    """Abstract machine that holds a cake, washes it and drains it.

    The surface–volume diameter for washing and drainage is that of the solid in the feed unless given.
    Crystals dissolve in the wash by ``wash_dissolution``, if one is given. Every such machine has a field
    ``void_fraction``, the voids of its cake.
    """

    _: KW_ONLY
    medium_resistance: MediumResistance = 0.0
    solids_recovery: Fraction = 1.0
    surface_tension: SurfaceTension = 0.072
    diffusivity: Diffusivity = 1e-9
    particle_diameter: Length | None = None
    wash_dissolution: Annotated[Any, Law("wash_dissolution")] | None = None

    def diameter(self, feed: Stream) -> Any:
        """Surface–volume diameter of the solid in the cake, m."""
        return solid_diameter(feed, self.particle_diameter)

    @abc.abstractmethod
    def stages(self, inside: Any, feed: Stream, wash: Stream | None = None) -> list[Stage]:
        """The life of one cake."""

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        if float(inlets["feed"].solid_flow) <= 0.0:
            return {}
        drawn = drawn_course(self.stages(made.inside, **inlets))
        return {} if drawn is None else {_("A cake through its cycle"): drawn}

    def void_flow(self: Any, feed: Stream) -> Any:
        """Void volume of the cake formed per time, m³/s."""
        return void_flow(feed, self.solids_recovery, self.void_fraction)

    def wash_ratio(self, feed: Stream, wash: Stream | None) -> Any:
        """Wash liquor per void volume."""
        void = self.void_flow(feed)
        return jnp.zeros(()) if wash is None else wash.liquid_volume_flow / jnp.where(void > 0, void, 1.0)

    def left_by_washing(self: Any, velocity: Any, thickness: Any, feed: Stream, wash: Stream) -> Any:
        """Fraction of the mother liquor that wash liquor of a superficial velocity (m/s) leaves in a cake of
        a thickness (m), by dispersion but never better than practice.
        """
        number = practical_number(
            velocity / self.void_fraction, thickness, self.diameter(feed), self.diffusivity
        )
        return remaining_fraction(self.wash_ratio(feed, wash), number)

    def parted(self: Any, feed: Stream, wash: Stream | None, *, saturation: Any, left: Any) -> Filtered:
        """The three streams at this saturation of the cake and with this fraction of its mother liquor left
        in it.
        """
        found = part_cake(
            feed,
            wash,
            recovery=self.solids_recovery,
            void_fraction=self.void_fraction,
            saturation=saturation,
            left=left,
        )
        return found if wash is None or self.wash_dissolution is None else self.wash_dissolution.out_of(found)

    def dissolved(self, feed: Stream, cake: Stream) -> Any:
        """Share of the retained solid that the wash dissolved."""
        return dissolved_share(feed, self.solids_recovery, cake)
