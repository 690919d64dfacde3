"""Conical screen centrifuges: a thin cake travels over a sieve cone, moved by a scroll, by vibration, by
tumbling or by its own weight.
"""

from __future__ import annotations

import abc
import math
from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar

import jax.numpy as jnp

from granum.centrifuges.equipment.filtering import (
    FLOODING,
    FilteringCentrifuge,
    Spin,
    SpinFigures,
    Spun,
    machine_limits,
)
from granum.centrifuges.formulas.conveying import (
    power_pushing,
    slide_length_cycle,
    sliding_ratio,
    stay_time_scroll,
    stay_time_sliding,
    tumbling_angle_least,
    vibration_acceleration_least,
)
from granum.centrifuges.formulas.spinning import filtrate_flow_critical
from granum.core import equipment
from granum.core.kinds import (
    Acceleration,
    Angle,
    Fraction,
    Frequency,
    Length,
    Time,
    TurningSpeed,
    Within,
)
from granum.core.limits import Limit
from granum.numerics.smooth import safe_divide
from granum.streams.cakes import Filtered
from granum.streams.stream import Stream
from granum.streams.units import Limits

LEAST, THINNEST = 1e-12, 1e-9
GRAINS = Limit(  # thinner, grains slide one by one, and the formulas of a cake say nothing of them
    "cake thickness over the size of its grains", 1.0, math.inf, "dimensionless", "leung1998"
)
ConeAngle = Annotated[Angle, Within(0.0, 1.2)]


def _screen_limits(finest: float, effect: tuple[float, float]) -> Limits:
    ends = machine_limits(diameter=finest, solids=(0.1, 0.65), effect=effect, layer=(0.0, 0.04))
    return FLOODING | ends | {"grains": GRAINS}


class ConicalScreen(FilteringCentrifuge):
    """Abstract conical screen, taken as a cylinder of its mean radius: the stay and the feed set how thick
    the cake is.

    The feed zone must let the mother liquor through (critical flow of the thin cake) or the basket floods.
    """

    basket_length: Length
    _: KW_ONLY
    feed_share: Fraction = 0.3
    wash_share: Fraction = 0.2

    @property
    @abc.abstractmethod
    def stay(self) -> Any:
        """Time the solid spends on the screen."""

    @property
    def height(self) -> Any:
        return self.basket_length

    def inner_radius(self, feed: Stream) -> Any:
        cake = self.void_flow(feed) / self.void_fraction * self.stay
        layer = jnp.maximum(cake / (2.0 * jnp.pi * self.radius_outer * self.basket_length), THINNEST)
        return self.radius_outer * jnp.sqrt(jnp.maximum(1.0 - 2.0 * layer / self.radius_outer, 0.01))

    def spin(self, feed: Stream, wash: Stream | None = None) -> Spin:
        critical = filtrate_flow_critical(basket_height=self.basket_length, **self.case(feed))
        void = self.void_flow(feed)
        forming = jnp.maximum(feed.liquid_volume_flow - void, 0.0) / (self.feed_share * critical)
        washing = 0.0 if wash is None else wash.liquid_volume_flow / (self.wash_share * critical)
        washed = 0.0 if wash is None else self.wash_share
        stay, flooding = jnp.asarray(self.stay, dtype=float), jnp.maximum(forming, washing)
        return Spin(
            self.feed_share * stay,
            washed * stay,
            jnp.zeros(()),
            (1.0 - self.feed_share - washed) * stay,
            stay,
            flooding,
            flooding,
        )

    def measured(
        self, inside: Spun, outlets: Filtered, figures: SpinFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        grains = safe_divide(inside.thickness, self.diameter(feed), 1.0)
        some = feed.solid_flow > 0.0
        return super().measured(inside, outlets, figures, feed, wash) | {
            "grains": jnp.where(some, grains, 1.0)
        }


@equipment(
    "scroll_screen", source="records2001; perry2008, § 18; storrow1957", title="Scroll-screen centrifuge"
)
class ScrollScreen(ConicalScreen):
    """Conical screen that a scroll empties: the stay is one pitch for each turn between scroll and basket."""

    scroll_pitch: Length
    differential_speed: TurningSpeed
    _: KW_ONLY
    friction_angle: ConeAngle = 0.5

    limits: ClassVar[Limits] = _screen_limits(6e-5, (300.0, 3000.0))

    @property
    def stay(self) -> Any:
        return stay_time_scroll(self.basket_length, self.scroll_pitch, self.differential_speed)

    def pushing(self, cake: Stream) -> Any:
        return power_pushing(
            cake.solid_flow + cake.liquid_flow,
            self.basket_length,
            self.radius_outer,
            self.rotation_speed,
            self.friction_angle,
        )


class SlidingScreen(ConicalScreen):
    """Abstract conical screen over which the cake slides. Its stay follows from dry friction unless a test
    gives it; ``radius_outer`` is taken as that of the small end, from which the cake slides.

    It is sized by the time that its cake has to drain, as a spin test asks for it. Moisture hardly tells one
    length from another: on a longer cone the cake is thinner and holds the more for it.
    """

    cone_angle: ConeAngle
    friction_angle: ConeAngle
    _: KW_ONLY
    stay_time: Time | None = None

    @property
    def stay(self) -> Any:
        return self.sliding() if self.stay_time is None else self.stay_time

    @abc.abstractmethod
    def sliding(self) -> Any:
        """Stay by dry friction, s."""

    def by_itself(self) -> Any:
        """Stay of a cake that slides by its own weight in the field, s."""
        return stay_time_sliding(
            self.basket_length, self.radius_outer, self.rotation_speed, self.cone_angle, self.friction_angle
        )

    def by_steps(self, drive: Any, resistance: Any, frequency: Any) -> Any:
        """Stay of a cake that each cycle moves on by a step, s."""
        step = slide_length_cycle(jnp.maximum(drive, LEAST), jnp.maximum(resistance, LEAST), frequency)
        stay = jnp.minimum(self.basket_length / jnp.maximum(step * frequency, LEAST), 3600.0)
        return jnp.where(self.cone_angle < self.friction_angle, stay, self.by_itself())

    @abc.abstractmethod
    def mobility(self) -> Any:
        """What moves the cake over the least that does."""

    def measured(
        self, inside: Spun, outlets: Filtered, figures: SpinFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, wash) | {"moves": self.mobility()}


@equipment("sliding_screen", source="leung1998; perry2008, § 18", title="Conical sliding-cake centrifuge")
class SlidingCakeScreen(SlidingScreen):
    """Conical screen steep enough that the cake slides out by itself; the cone must fit the product."""

    limits: ClassVar[Limits] = _screen_limits(2e-4, (300.0, 3000.0)) | {
        "moves": Limit(
            "slope of the cone over the friction of the cake", 1.0, 1.5, "dimensionless", "leung1998"
        )
    }

    def mobility(self) -> Any:
        return sliding_ratio(self.cone_angle, self.friction_angle)

    def sliding(self) -> Any:
        return self.by_itself()


@equipment("vibrating_screen", source="leung1998; perry2008, § 18", title="Vibrating-screen centrifuge")
class VibratingScreen(SlidingScreen):
    """Flat conical screen shaken along its axis, so that the cake steps forward: coarse, rich feeds, coal
    above all.
    """

    vibration_acceleration: Acceleration
    _: KW_ONLY
    vibration_frequency: Frequency = 30.0

    limits: ClassVar[Limits] = _screen_limits(3e-4, (30.0, 200.0)) | {
        "moves": Limit(
            "vibration over the least that moves the cake", 1.0, math.inf, "dimensionless", "leung1998"
        )
    }

    def mobility(self) -> Any:
        least = vibration_acceleration_least(
            self.rotation_speed, self.radius_outer, self.cone_angle, self.friction_angle
        )
        return self.vibration_acceleration / jnp.maximum(least, LEAST)

    def sliding(self) -> Any:
        wall, friction = self.cone_angle, jnp.tan(self.friction_angle)
        drive = self.vibration_acceleration * (jnp.cos(wall) + friction * jnp.sin(wall))
        field = self.rotation_speed**2 * self.radius_outer
        held = field * (friction * jnp.cos(wall) - jnp.sin(wall))
        return self.by_steps(drive, held, self.vibration_frequency)


@equipment("tumbling_screen", source="leung1998; perry2008, § 18", title="Tumbling centrifuge")
class TumblingScreen(SlidingScreen):
    """Flat conical screen whose axis tumbles, so that each side in turn is steep enough for the cake to
    slide.
    """

    tumbling_angle: ConeAngle
    _: KW_ONLY
    tumbling_frequency: Frequency = 5.0

    limits: ClassVar[Limits] = _screen_limits(5e-4, (30.0, 400.0)) | {
        "moves": Limit(
            "tumbling angle over the least that moves the cake", 1.0, math.inf, "dimensionless", "leung1998"
        )
    }

    def mobility(self) -> Any:
        return self.tumbling_angle / jnp.maximum(
            tumbling_angle_least(self.cone_angle, self.friction_angle), LEAST
        )

    def sliding(self) -> Any:
        # small angles: g (sin(γ + δ) − tan φ cos(γ + δ)) = g sin(γ + δ − φ)/cos φ
        field = self.rotation_speed**2 * self.radius_outer / jnp.cos(self.friction_angle)
        held = field * (self.friction_angle - self.cone_angle)
        return self.by_steps(field * self.tumbling_angle, held, self.tumbling_frequency)
