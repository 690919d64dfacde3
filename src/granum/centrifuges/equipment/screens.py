"""Conical screen centrifuges: a thin cake travels over a sieve cone, moved by a scroll, by vibration, by tumbling or by its own weight."""

from __future__ import annotations

import abc
from collections.abc import Mapping
from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar

import jax.numpy as jnp

from granum.centrifuges.equipment.filtering import FilteringCentrifuge, Spin
from granum.centrifuges.formulas.conveying import sliding_ratio, stay_time_scroll, tumbling_angle_least, vibration_acceleration_least
from granum.centrifuges.formulas.spinning import filtrate_flow_critical
from granum.core import equipment
from granum.core.kinds import Acceleration, Angle, Fraction, Length, RotationSpeed, Time, Within
from granum.streams.cakes import Filtered, void_flow
from granum.streams.stream import Stream
from granum.streams.units import Check

LEAST, THINNEST = 1e-12, 1e-9
_FLOOD = "filtrate over the critical flow (flooding)"
_SLIDES = "slope of the cone over the friction of the cake"
_SHAKES = "vibration over the least that moves the cake"
_TUMBLES = "tumbling angle over the least that moves the cake"
ConeAngle = Annotated[Angle, Within(0.0, 1.2)]


class ConicalScreen(FilteringCentrifuge):
    """Abstract conical screen, taken as a cylinder of its mean radius: the stay and the feed set how thick the cake is.

    The feed zone must let the mother liquor through (critical flow of the thin cake) or the basket floods.
    """

    basket_length: Length
    _: KW_ONLY
    feed_share: Fraction = 0.3
    wash_share: Fraction = 0.2
    finest: ClassVar[float]
    effects: ClassVar[tuple[float, float]]

    @property
    @abc.abstractmethod
    def stay(self) -> Any:
        """Time the solid spends on the screen."""

    @property
    def height(self) -> Any:
        return self.basket_length

    def inner_radius(self, feed: Stream) -> Any:
        cake = void_flow(feed, self.solids_recovery, self.void_fraction) / self.void_fraction * self.stay
        layer = jnp.maximum(cake / (2.0 * jnp.pi * self.radius_outer * self.basket_length), THINNEST)
        return self.radius_outer * jnp.sqrt(jnp.maximum(1.0 - 2.0 * layer / self.radius_outer, 0.01))

    def spin(self, feed: Stream, wash: Stream | None = None) -> Spin:
        critical = filtrate_flow_critical(basket_height=self.basket_length, **self.case(feed))
        void = void_flow(feed, self.solids_recovery, self.void_fraction)
        forming = jnp.maximum(feed.liquid_volume_flow - void, 0.0) / (self.feed_share * critical)
        washing = 0.0 if wash is None else wash.liquid_volume_flow / (self.wash_share * critical)
        washed = 0.0 if wash is None else self.wash_share
        stay, flooding = jnp.asarray(self.stay, dtype=float), jnp.maximum(forming, washing)
        return Spin(self.feed_share * stay, washed * stay, jnp.zeros(()), (1.0 - self.feed_share - washed) * stay, stay, flooding, flooding)

    def checks(self, inlets: Mapping[str, Stream], outlets: Filtered) -> tuple[Check, ...]:
        feed = inlets["feed"]
        return (
            Check(_FLOOD, self.spin(feed, inlets.get("wash")).flooding, 0.0, 1.0, "dimensionless", "storrow1957"),
            *self.limits(feed, diameter=self.finest, solids=(0.1, 0.65), effect=self.effects, layer=(0.0, 0.04), source="perry2008, § 18"),
        )


@equipment("scroll_screen", source="records2001; perry2008, § 18; storrow1957", title="Scroll-screen centrifuge")
class ScrollScreen(ConicalScreen):
    """Conical screen that a scroll empties: the stay is one pitch for each turn between scroll and basket."""

    scroll_pitch: Length
    differential_speed: RotationSpeed
    finest: ClassVar[float] = 6e-5
    effects: ClassVar[tuple[float, float]] = (300.0, 3000.0)

    @property
    def stay(self) -> Any:
        return stay_time_scroll(self.basket_length, self.scroll_pitch, self.differential_speed)


class SlidingScreen(ConicalScreen):
    """Abstract conical screen over which the cake slides; its stay comes from a test."""

    cone_angle: ConeAngle
    friction_angle: ConeAngle
    _: KW_ONLY
    stay_time: Time = 3.0

    @property
    def stay(self) -> Any:
        return self.stay_time


@equipment("sliding_screen", source="leung1998; perry2008, § 18", title="Conical sliding-cake centrifuge")
class SlidingCakeScreen(SlidingScreen):
    """Conical screen steep enough that the cake slides out by itself; the cone must fit the product."""

    finest: ClassVar[float] = 2e-4
    effects: ClassVar[tuple[float, float]] = (300.0, 3000.0)

    def checks(self, inlets: Mapping[str, Stream], outlets: Filtered) -> tuple[Check, ...]:
        slope = sliding_ratio(self.cone_angle, self.friction_angle)
        return (*super().checks(inlets, outlets), Check(_SLIDES, slope, 1.0, 1.5, "dimensionless", "leung1998"))


@equipment("vibrating_screen", source="leung1998; perry2008, § 18", title="Vibrating-screen centrifuge")
class VibratingScreen(SlidingScreen):
    """Flat conical screen shaken along its axis, so that the cake steps forward: coarse, rich feeds, coal above all."""

    vibration_acceleration: Acceleration
    finest: ClassVar[float] = 3e-4
    effects: ClassVar[tuple[float, float]] = (30.0, 200.0)

    def checks(self, inlets: Mapping[str, Stream], outlets: Filtered) -> tuple[Check, ...]:
        least = vibration_acceleration_least(self.rotation_speed, self.radius_outer, self.cone_angle, self.friction_angle)
        ratio = self.vibration_acceleration / jnp.maximum(least, LEAST)
        return (*super().checks(inlets, outlets), Check(_SHAKES, ratio, 1.0, jnp.inf, "dimensionless", "leung1998"))


@equipment("tumbling_screen", source="leung1998; perry2008, § 18", title="Tumbling centrifuge")
class TumblingScreen(SlidingScreen):
    """Flat conical screen whose axis tumbles, so that each side in turn is steep enough for the cake to slide."""

    tumbling_angle: ConeAngle
    finest: ClassVar[float] = 5e-4
    effects: ClassVar[tuple[float, float]] = (30.0, 400.0)

    def checks(self, inlets: Mapping[str, Stream], outlets: Filtered) -> tuple[Check, ...]:
        ratio = self.tumbling_angle / jnp.maximum(tumbling_angle_least(self.cone_angle, self.friction_angle), LEAST)
        return (*super().checks(inlets, outlets), Check(_TUMBLES, ratio, 1.0, jnp.inf, "dimensionless", "leung1998"))
