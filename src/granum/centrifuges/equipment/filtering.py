"""Filtering centrifuges in a line: batch basket (peeler) through its whole cycle, and pusher."""

from __future__ import annotations

import abc
from dataclasses import KW_ONLY
from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.centrifuges.formulas.conveying import QuarterTurn as FrictionAngle
from granum.centrifuges.formulas.conveying import power_pushing
from granum.centrifuges.formulas.field import centrifugal_effect
from granum.centrifuges.formulas.mechanics import power_acceleration, power_windage
from granum.centrifuges.formulas.spinning import (
    cake_saturation_spinning,
    filtrate_flow_basket,
    filtrate_flow_critical,
    irreducible_saturation_leung,
    loading_time_basket,
    spin_off_time,
)
from granum.core import equipment
from granum.core.i18n import _
from granum.core.kinds import (
    CakeResistance,
    Distance,
    Fraction,
    Length,
    MoistureDryBasis,
    PositiveNumber,
    Power,
    Ratio,
    Time,
    TurningSpeed,
    VoidFraction,
)
from granum.core.limits import Limit
from granum.numerics.smooth import safe_divide
from granum.streams.cake_course import POINTS, Stage, still
from granum.streams.cake_maker import CakeMaker
from granum.streams.cakes import Filtered
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import DRIVE, driven

# m³/s of filtrate and m³ of cake per m³ of it: a feed without solid or liquid gives numbers
TRICKLE, THIN = 1e-15, 1e-12
Ends = tuple[float, float]


class Spin(NamedTuple):
    """How one cake passes through the machine."""

    loading_time: Any
    wash_time: Any
    spin_off_time: Any
    drainage_time: Any
    cycle_time: Any
    capacity_use: Any
    flooding: Any


class SpinFigures(NamedTuple):
    """Figures of a filtering centrifuge."""

    capacity_use: Ratio
    cake_thickness: Distance
    loading_time: Time
    wash_time: Time
    spin_off_time: Time
    drainage_time: Time
    cycle_time: Time
    centrifugal_effect: Ratio
    wash_ratio: Ratio
    solute_remaining: Fraction
    cake_saturation: Fraction
    moisture_dry_basis: MoistureDryBasis
    dissolved_share: Fraction
    shaft_power: Power
    power_acceleration: Power
    power_windage: Power
    power_conveying: Power


class Spun(NamedTuple):
    """The cake of a machine: its cycle, thickness, wash liquor per void volume, mother liquor that washing
    leaves, saturation at discharge.
    """

    spin: Spin
    thickness: Any
    wash_ratio: Any
    left: Any
    saturation: Any


def machine_limits(*, diameter: float, solids: Ends, effect: Ends, layer: Ends) -> Limits:
    """Limits that every machine has, with its own ends."""
    source = "perry2008, § 18"
    return {
        "coarse": Limit("particle diameter", diameter, 1e-2, "m", source),
        "rich": Limit("solids in the feed by volume", *solids, "dimensionless", source),
        "effect": Limit("centrifugal effect", *effect, "dimensionless", source),
        "layer": Limit("cake thickness", *layer, "m", source),
    }


FLOODING: Limits = {
    "flood": Limit("filtrate over the critical flow (flooding)", 0.0, 1.0, "dimensionless", "storrow1957")
}


class FilteringCentrifuge(CakeMaker):
    """Abstract filtering centrifuge: a cylindrical cake between the basket wall and an inner radius."""

    radius_outer: Length
    rotation_speed: TurningSpeed
    cake_resistance: CakeResistance
    void_fraction: VoidFraction

    utilities: ClassVar[Utilities] = DRIVE

    @abc.abstractmethod
    def spin(self, feed: Stream, wash: Stream | None = None) -> Spin:
        """Times and capacity at this feed."""

    @property
    @abc.abstractmethod
    def height(self) -> Any:
        """Length of the cake along the axis."""

    @abc.abstractmethod
    def inner_radius(self, feed: Stream) -> Any:
        """Inner radius of the cake."""

    @property
    def cake_outer(self) -> Any:
        """Outer radius of the cake."""
        return self.radius_outer

    def medium(self, feed: Stream) -> Any:
        """Resistance of what lies under the cake, 1/m."""
        return self.medium_resistance

    def thickness(self, feed: Stream) -> Any:
        """Cake thickness."""
        return self.cake_outer - self.inner_radius(feed)

    def pushing(self, cake: Stream) -> Any:
        """Power that moves the cake through the basket, W; none where it is cut, or slides, by itself."""
        return 0.0

    def permeability(self, feed: Stream) -> Any:
        """Permeability of the cake from its specific resistance."""
        return 1.0 / (self.cake_resistance * (1.0 - self.void_fraction) * feed.solid_density)

    def case(self, feed: Stream) -> dict[str, Any]:
        """What the spinning formulas need."""
        return {
            "radius_outer": self.cake_outer,
            "cake_radius": self.inner_radius(feed),
            "rotation_speed": self.rotation_speed,
            "liquid_density": feed.liquid_density,
            "dynamic_viscosity": feed.liquid_viscosity,
            "cake_permeability": self.permeability(feed),
            "medium_resistance": self.medium(feed),
        }

    def solute_left(self, feed: Stream, wash: Stream | None) -> Any:
        """Fraction of the mother liquor that washing leaves, the wash liquor passing at the critical flow."""
        if wash is None:
            return jnp.ones(())
        face = jnp.pi * (self.radius_outer + self.inner_radius(feed)) * self.height
        velocity = filtrate_flow_critical(basket_height=self.height, **self.case(feed)) / face
        return self.left_by_washing(velocity, self.thickness(feed), feed, wash)

    def saturation(self, feed: Stream, spin: Spin) -> Any:
        """Saturation of the cake at discharge."""
        d, middle = self.diameter(feed), 0.5 * (self.radius_outer + self.inner_radius(feed))
        lowest = irreducible_saturation_leung(
            d,
            self.void_fraction,
            self.thickness(feed),
            middle,
            self.rotation_speed,
            feed.liquid_density,
            self.surface_tension,
        )
        return cake_saturation_spinning(
            spin.drainage_time,
            d,
            self.void_fraction,
            self.thickness(feed),
            middle,
            self.rotation_speed,
            feed.liquid_density,
            feed.liquid_viscosity,
            lowest,
        )

    def formed(self, inside: Spun, feed: Stream) -> Stage:
        """The cake while it forms: at once of its whole thickness, which strokes or the stay set."""
        return still(_("forming"), inside.spin.loading_time, inside.thickness)

    def stages(self, inside: Spun, feed: Stream, wash: Stream | None = None) -> list[Stage]:
        spin, thick = inside.spin, inside.thickness

        def wet(time: Any) -> Any:
            return self.saturation(feed, spin._replace(drainage_time=time))

        rest = spin.cycle_time - spin.loading_time - spin.wash_time - spin.spin_off_time - spin.drainage_time
        return [
            self.formed(inside, feed),
            still(_("washing"), spin.wash_time, thick),
            still(_("liquid sinks in"), spin.spin_off_time, thick),
            still(_("draining"), spin.drainage_time, thick, wet),
            still(_("discharge and return"), jnp.maximum(rest, 0.0), np.nan, np.nan),
        ]

    def inside(self, feed: Stream, wash: Stream | None = None) -> Spun:
        spin = self.spin(feed, wash)
        left, wet = self.solute_left(feed, wash), self.saturation(feed, spin)
        return Spun(
            spin, jnp.asarray(self.thickness(feed), dtype=float), self.wash_ratio(feed, wash), left, wet
        )

    def outlets(self, inside: Spun, feed: Stream, wash: Stream | None = None) -> Filtered:
        return self.parted(feed, wash, saturation=inside.saturation, left=inside.left)

    def figures(
        self, inside: Spun, outlets: Filtered, feed: Stream, wash: Stream | None = None
    ) -> SpinFigures:
        spin = inside.spin
        accelerated = power_acceleration(
            feed.solid_flow + feed.liquid_flow, self.radius_outer, self.rotation_speed
        )
        windage = power_windage(self.radius_outer, self.height, self.rotation_speed)
        pushed = jnp.asarray(self.pushing(outlets.cake), dtype=float)
        return SpinFigures(
            capacity_use=spin.capacity_use,
            cake_thickness=inside.thickness,
            loading_time=spin.loading_time,
            wash_time=spin.wash_time,
            spin_off_time=spin.spin_off_time,
            drainage_time=spin.drainage_time,
            cycle_time=spin.cycle_time,
            centrifugal_effect=centrifugal_effect(self.radius_outer, self.rotation_speed),
            wash_ratio=inside.wash_ratio,
            solute_remaining=inside.left,
            cake_saturation=inside.saturation,
            moisture_dry_basis=outlets.cake.moisture_dry_basis,
            dissolved_share=self.dissolved(feed, outlets.cake),
            shaft_power=accelerated + windage + pushed,
            power_acceleration=accelerated,
            power_windage=windage,
            power_conveying=pushed,
        )

    def measured(
        self, inside: Spun, outlets: Filtered, figures: SpinFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        return {
            "use": inside.spin.capacity_use,
            "flood": inside.spin.flooding,
            "coarse": self.diameter(feed),
            "rich": feed.solids_volume_fraction,
            "effect": figures.centrifugal_effect,
            "layer": inside.thickness,
        }

    def drawn(
        self, inside: Spun, outlets: Filtered, figures: SpinFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        return {"electric_power_drive": driven(figures.shaft_power)}


class SetCake(FilteringCentrifuge):
    """Abstract filtering centrifuge whose cake is cut or pushed at a set radius."""

    cake_radius: Length

    def inner_radius(self, feed: Stream) -> Any:
        return self.cake_radius

    @property
    def cake_volume(self) -> Any:
        """Volume of the cake ring."""
        return jnp.pi * (self.cake_outer**2 - self.cake_radius**2) * self.height


@equipment(
    "peeler",
    source="grace1953; storrow1957; richardson2002, ch. 9",
    title="Basket (peeler) centrifuge",
    equation=r"t_c = t_1 + t_w + t_2 + t_d + t_{mort}",
)
class Peeler(SetCake):
    """Batch basket through its cycle: kept full while the cake grows, washed under a ring of liquor, spun
    off, drained, plowed.

    ``radius_inner`` is the free surface while loading and washing, at the rim of the basket. Several baskets
    share the feed in turn. The plow leaves a heel under the cake, as permeable as the cake when fresh, whose
    resistance grows with each cycle (``heel_blinding``, as a share); all is told for the last of the
    ``heel_cycles`` between two cleanings. A rotating siphon, whose mouth stands at ``siphon_radius`` beyond
    the basket wall, adds its suction.
    """

    basket_height: Length
    radius_inner: Length
    drainage_time: Time = 60.0
    dead_time: Time = 60.0
    basket_number: PositiveNumber = 1.0
    _: KW_ONLY
    heel_thickness: Distance = 0.0
    heel_blinding: Ratio = 0.0
    heel_cycles: PositiveNumber = 1.0
    siphon_radius: Length | None = None

    limits: ClassVar[Limits] = {
        "use": Limit("share of the capacity in use", 0.0, 1.0, "dimensionless", "grace1953"),
        **machine_limits(diameter=5e-6, solids=(0.03, 0.5), effect=(300.0, 2000.0), layer=(0.02, 0.2)),
        "full": Limit("cake height over that of the rim", 0.0, 0.8, "dimensionless", "andritzpeeler"),
        # what typically stays in the machine, of which the heel is most
        "heel": Limit("volume of the heel over that of the basket", 0.0, 0.05, "dimensionless", "grimpeeler"),
        "siphon": Limit("suction of the siphon", 0.0, 0.9, "bar", "perry2008, § 18"),
    }

    @property
    def height(self) -> Any:
        return self.basket_height

    @property
    def cake_outer(self) -> Any:
        return self.radius_outer - self.heel_thickness

    @property
    def mouth(self) -> Any:
        """Radius down to which liquid drives: that of the siphon, or of the basket."""
        return self.radius_outer if self.siphon_radius is None else self.siphon_radius

    def medium(self, feed: Stream) -> Any:
        grown = 1.0 + self.heel_blinding * jnp.maximum(self.heel_cycles - 1.0, 0.0)
        return self.medium_resistance + self.heel_thickness / self.permeability(feed) * grown

    def formed(self, inside: Spun, feed: Stream) -> Stage:
        grown = float(inside.thickness) * np.linspace(0.0, 1.0, POINTS)
        case = self.case(feed) | {"cake_radius": self.cake_outer - grown}
        # the shape alone: how much cake a filtrate carries and what drives it scale all of it
        time = np.asarray(
            loading_time_basket(radius_inner=self.radius_inner, cake_volume_per_filtrate=1.0, **case)
        )
        return Stage(
            _("forming"), time * (float(inside.spin.loading_time) / time[-1]), grown, np.ones(POINTS)
        )

    def spin(self, feed: Stream, wash: Stream | None = None) -> Spin:
        case = self.case(feed)
        void = self.void_flow(feed)
        cake_flow = void / self.void_fraction
        filtrate = jnp.maximum(feed.liquid_volume_flow - void, 1e-12 * feed.liquid_volume_flow + TRICKLE)
        loading = loading_time_basket(
            radius_inner=self.radius_inner,
            cake_volume_per_filtrate=jnp.maximum(cake_flow / filtrate, THIN),
            **case,
        )
        washing_flow = filtrate_flow_basket(
            basket_height=self.basket_height, radius_inner=self.radius_inner, **case
        )
        outer, mouth = self.cake_outer**2, self.mouth**2
        surface, cake = self.radius_inner**2, self.cake_radius**2
        # what drives is the liquid down to the mouth of the siphon, or through the heel to the wall
        drive = (mouth - surface) / (outer - surface)
        loading = jnp.where(void > 0.0, loading / drive, 0.0)  # without solid there is no cake to wait for
        washing_flow = washing_flow * drive
        washing = self.wash_ratio(feed, wash) * self.void_fraction * self.cake_volume / washing_flow
        falling = (
            spin_off_time(radius_inner=self.radius_inner, **case)
            * jnp.log((mouth - surface) / (mouth - cake))
            / jnp.log((outer - surface) / (outer - cake))
        )
        cycle = loading + washing + falling + self.drainage_time + self.dead_time
        use = cake_flow * cycle / (self.cake_volume * self.basket_number)
        return Spin(
            loading, washing, falling, jnp.asarray(self.drainage_time, dtype=float), cycle, use, jnp.zeros(())
        )

    def measured(
        self, inside: Spun, outlets: Filtered, figures: SpinFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        suction = self.rotation_speed**2 * (self.mouth**2 - self.radius_outer**2) * feed.liquid_density / 2.0
        wall, rim = self.radius_outer**2, self.radius_inner**2
        return super().measured(inside, outlets, figures, feed, wash) | {
            "full": (self.radius_outer - self.cake_radius) / (self.radius_outer - self.radius_inner),
            "heel": (wall - self.cake_outer**2) / (wall - rim),
            "siphon": suction / 1e5,
        }


@equipment("pusher", source="storrow1957; perry2008, § 18", title="Pusher centrifuge")
class Pusher(SetCake):
    """Continuous basket along which strokes push a cake of even thickness: it forms, is washed and drains on
    its way out.

    The stay follows from the cake that the basket holds; the feed zone must let the mother liquor through
    (critical flow) or floods.
    """

    basket_length: Length
    feed_share: Fraction = 0.25
    wash_share: Fraction = 0.25
    _: KW_ONLY
    friction_angle: FrictionAngle = 0.5

    limits: ClassVar[Limits] = FLOODING | machine_limits(
        diameter=1e-4, solids=(0.15, 0.6), effect=(200.0, 2500.0), layer=(0.01, 0.08)
    )

    @property
    def height(self) -> Any:
        return self.basket_length

    def spin(self, feed: Stream, wash: Stream | None = None) -> Spin:
        void = self.void_flow(feed)
        stay = safe_divide(self.cake_volume, void / self.void_fraction)  # of no cake none
        critical = filtrate_flow_critical(basket_height=self.basket_length, **self.case(feed))
        forming = (feed.liquid_volume_flow - void) / (self.feed_share * critical)
        washing = 0.0 if wash is None else wash.liquid_volume_flow / (self.wash_share * critical)
        drain = (1.0 - self.feed_share - (0.0 if wash is None else self.wash_share)) * stay
        flooding = jnp.maximum(forming, washing)
        wash_time = jnp.zeros(()) if wash is None else self.wash_share * stay
        return Spin(self.feed_share * stay, wash_time, jnp.zeros(()), drain, stay, flooding, flooding)

    def pushing(self, cake: Stream) -> Any:
        return power_pushing(
            cake.solid_flow + cake.liquid_flow,
            self.basket_length,
            self.radius_outer,
            self.rotation_speed,
            self.friction_angle,
        )
