"""Cakes that travel in a spinning bowl: pushed by a scroll up a beach, sliding over a conical screen by
themselves, by vibration or by tumbling.
"""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula
from granum.core.flags import impossible
from granum.core.kinds import (
    Acceleration,
    Angle,
    Distance,
    Frequency,
    Length,
    Mass,
    MassFlow,
    PositiveNumber,
    Power,
    RotationSpeed,
    Speed,
    Time,
    Torque,
    Within,
)
from granum.numerics import find_root

QuarterTurn = Annotated[Angle, Within(0.0, 1.5707)]
_CONE = {
    "cone_angle": (0.2, 0.35),
    "friction_angle": (0.4, 0.7),
    "radius": (0.2, 0.6),
    "rotation_speed": (30.0, 250.0),
}


@formula(
    source="records2001",
    title="Stay of the solid in a scroll centrifuge",
    equation=r"t = \frac{2\pi L}{P\,\Delta\omega}",
    output="stay_time",
    typical={"basket_length": (0.2, 0.6), "scroll_pitch": (0.05, 0.15), "differential_speed": (1.0, 10.0)},
)
def stay_time_scroll(basket_length: Length, scroll_pitch: Length, differential_speed: RotationSpeed) -> Time:
    """Stay of the solid in a basket that a scroll empties: one pitch for each turn between scroll and basket.

    >>> round(stay_time_scroll(basket_length="40 cm", scroll_pitch="10 cm", differential_speed="60 rpm"), 6)
    4.0
    """
    return 2.0 * jnp.pi * basket_length / (scroll_pitch * differential_speed)


@formula(source="leung1998", equation=r"R = \frac{\tan\gamma}{\tan\varphi}", typical=_CONE)
def sliding_ratio(cone_angle: QuarterTurn, friction_angle: QuarterTurn) -> PositiveNumber:
    """Slope of a conical basket over the friction of its cake: above 1 the cake slides out by itself whatever
    the speed.

    The angle is that between the wall and the axis.

    >>> round(sliding_ratio(cone_angle="30 degree", friction_angle="30 degree"), 6)
    1.0
    """
    return jnp.tan(cone_angle) / jnp.tan(friction_angle)


@formula(
    source="leung1998; records2001",
    title="Least axial acceleration of the vibration",
    equation=r"a = \omega^2 r\,\tan(\varphi - \gamma)",
    output="vibration_acceleration",
    typical=_CONE,
)
def vibration_acceleration_least(
    rotation_speed: RotationSpeed, radius: Length, cone_angle: QuarterTurn, friction_angle: QuarterTurn
) -> Acceleration:
    """Least axial acceleration of a vibrating basket that makes its cake step forward.

    At the peak of the stroke the cake feels centrifugal and axial acceleration together; it slides when their
    resultant leaves the cone of friction. Nothing is needed where the cone is steeper than the friction.

    >>> round(
    ...     vibration_acceleration_least(
    ...         rotation_speed="300 rpm", radius=0.5, cone_angle="13 degree", friction_angle="25 degree"
    ...     ),
    ...     1,
    ... )
    104.9
    """
    return rotation_speed**2 * radius * jnp.tan(jnp.maximum(friction_angle - cone_angle, 0.0))


@formula(
    source="leung1998",
    title="Least tilt of the tumbling axis",
    equation=r"\delta = \varphi - \gamma",
    output="tumbling_angle",
    typical=_CONE,
)
def tumbling_angle_least(cone_angle: QuarterTurn, friction_angle: QuarterTurn) -> Angle:
    """Least tilt of the tumbling axis that brings each side of the cone, once a turn, above the friction of
    the cake.

    >>> import math
    >>> round(math.degrees(tumbling_angle_least(cone_angle="15 degree", friction_angle="20 degree")), 6)
    5.0
    """
    return jnp.maximum(friction_angle - cone_angle, 0.0)


HELIX = {
    "radius": (0.1, 0.4),
    "scroll_pitch": (0.05, 0.2),
    "beach_angle": (0.1, 0.3),
    "friction_angle_flight": (0.1, 0.3),
    "friction_angle_bowl": (0.35, 0.7),
}
SLIPS = (
    "The cake slips back: the beach is too steep for the friction on it and on the flight. Flatten it, "
    "roughen the bowl or polish the flight."
)


def rising_angle(radius: Any, pitch: Any, beach: Any, flight: Any, bowl: Any) -> tuple[Any, Any, Any]:
    """Angle of the flight to the circumference, angle at which the cake travels over the bowl, and the part
    of the friction on the bowl that the slope of the beach takes up (1: the cake slips back).
    """
    helix = jnp.arctan(pitch / (2.0 * jnp.pi * radius))
    slope = jnp.tan(beach) / jnp.maximum(jnp.tan(bowl), 1e-12)
    held = jnp.minimum(slope * jnp.sin(helix + flight), 1.0 - 1e-12)
    return helix, jnp.arccos(held) - helix - flight, slope * jnp.tan(helix + flight)


@formula(
    source="leung1998, ch. 8",
    equation=(
        r"v = \Delta\omega\,r\,\frac{\tan\alpha\tan\lambda}{\tan\alpha + \tan\lambda},\quad "
        r"\cos(\lambda + \alpha + \varphi_f) = \frac{\tan\beta}{\tan\varphi_b}\sin(\alpha + \varphi_f),\quad "
        r"\tan\alpha = \frac{P}{2\pi r}"
    ),
    typical=HELIX | {"differential_speed": (0.5, 5.0)},
    symbols={
        "friction_angle_flight": r"\varphi_f",
        "friction_angle_bowl": r"\varphi_b",
    },
)
def conveying_velocity(
    radius: Length,
    scroll_pitch: Length,
    differential_speed: RotationSpeed,
    beach_angle: QuarterTurn,
    friction_angle_flight: QuarterTurn,
    friction_angle_bowl: QuarterTurn,
) -> Speed:
    """Velocity along the axis at which a scroll moves a cake over the bowl, or up its beach.

    From the balance on the cake: the flight pushes it at its own angle of friction, the bowl holds it back
    against its path, the slope lets it slip back. Without slope and friction on the flight this is Δω P/2π
    times the cosine of the flight angle squared. The balance is derived here; the source could not be opened.

    >>> round(conveying_velocity("18 cm", "10 cm", "20 rpm", 0.0, 0.0, "30 degree") * 1e3, 2)
    33.07
    """
    helix, path, used = rising_angle(
        radius, scroll_pitch, beach_angle, friction_angle_flight, friction_angle_bowl
    )
    impossible(~(used < 1.0), beach_angle, "beach_angle", 0.0, friction_angle_bowl, SLIPS)
    a, b = jnp.tan(helix), jnp.tan(jnp.maximum(path, 0.0))
    return differential_speed * radius * a * b / (a + b)


@formula(
    source="leung1998, ch. 8; records2001",
    equation=(
        r"T = m\,\omega^2 r^2\,\tan\varphi_b\,\cos\beta\,\cos\lambda,\quad "
        r"\cos(\lambda + \alpha + \varphi_f) = \frac{\tan\beta}{\tan\varphi_b}\sin(\alpha + \varphi_f),\quad "
        r"\tan\alpha = \frac{P}{2\pi r}"
    ),
    typical=HELIX | {"mass": (0.5, 50.0), "rotation_speed": (200.0, 500.0)},
    symbols={
        "friction_angle_flight": r"\varphi_f",
        "friction_angle_bowl": r"\varphi_b",
    },
)
def conveying_torque(
    mass: Mass,
    radius: Length,
    rotation_speed: RotationSpeed,
    scroll_pitch: Length,
    beach_angle: QuarterTurn,
    friction_angle_flight: QuarterTurn,
    friction_angle_bowl: QuarterTurn,
) -> Torque:
    """Torque of a scroll on the cake that it moves; under liquid the mass is that less buoyancy.

    The same balance as for the velocity, its part along the circumference.

    >>> round(conveying_torque(10.0, "18 cm", "3000 rpm", "10 cm", 0.0, 0.0, "30 degree"))
    1626
    """
    _helix, path, used = rising_angle(
        radius, scroll_pitch, beach_angle, friction_angle_flight, friction_angle_bowl
    )
    impossible(~(used < 1.0), beach_angle, "beach_angle", 0.0, friction_angle_bowl, SLIPS)
    weight = mass * rotation_speed**2 * radius
    pull = jnp.tan(friction_angle_bowl) * jnp.cos(beach_angle) * jnp.cos(jnp.maximum(path, 0.0))
    return weight * pull * radius


@formula(
    source="leung1998",
    equation=r"P_c = \dot m\,\omega^2 r\,L\tan\varphi",
    title="Power that pushes a cake",
    output="power_conveying",
    typical={
        "mass_flow": (0.1, 20.0),
        "basket_length": (0.2, 0.6),
        "radius": (0.2, 0.6),
        "rotation_speed": (100.0, 250.0),
        "friction_angle": (0.3, 0.7),
    },
)
def power_pushing(
    mass_flow: MassFlow,
    basket_length: Length,
    radius: Length,
    rotation_speed: RotationSpeed,
    friction_angle: QuarterTurn,
) -> Power:
    """Power that pushes a cake along a basket against its friction under the field.

    What the mechanism itself takes comes on top.

    >>> round(power_pushing("10 t/hour", "40 cm", "25 cm", "1600 rpm", "30 degree"))
    4502
    """
    return mass_flow * rotation_speed**2 * radius * basket_length * jnp.tan(friction_angle)


@formula(
    source="leung1998",
    equation=(
        r"t = \frac{\operatorname{arcosh}(1 + L\sin\gamma/r)}{\omega\sqrt{\sin\gamma\,(\sin\gamma - "
        r"\tan\varphi\cos\gamma)}}"
    ),
    output="stay_time",
    typical={
        "basket_length": (0.2, 0.6),
        "radius": (0.2, 0.6),
        "rotation_speed": (100.0, 250.0),
        "cone_angle": (0.55, 0.7),
        "friction_angle": (0.3, 0.5),
    },
    title="Stay of a cake that slides by itself",
)
def stay_time_sliding(
    basket_length: Length,
    radius: Length,
    rotation_speed: RotationSpeed,
    cone_angle: QuarterTurn,
    friction_angle: QuarterTurn,
) -> Time:
    """Time in which a cake slides from rest, at the small end of a cone, along a wall of given length.

    Dry friction alone holds it back, so that this is the shortest stay; a cake that sticks, or liquid under
    it, makes it longer. The balance is derived here. Where the friction is the steeper one the cake stays for
    good, told as an hour.

    >>> round(stay_time_sliding("40 cm", "20 cm", "1600 rpm", "35 degree", "25 degree"), 4)
    0.0252
    """
    slope = jnp.sin(cone_angle) - jnp.tan(friction_angle) * jnp.cos(cone_angle)
    grows = rotation_speed * jnp.sqrt(jnp.maximum(jnp.sin(cone_angle) * slope, 1e-18))
    wide = jnp.arccosh(1.0 + jnp.maximum(basket_length * jnp.sin(cone_angle) / radius, 1e-12))
    return jnp.minimum(wide / jnp.maximum(grows, 1e-30), 3600.0)


@formula(
    source="leung1998",
    equation=(
        r"s = \frac{1}{(2\pi f)^2}\left[B\left(\cos\theta_1\,\Delta - \sin\theta_2 + \sin\theta_1\right) - "
        r"\tfrac12 C\Delta^2\right],\quad \sin\theta_1 = \frac{C}{B},\; "
        r"B(\cos\theta_1 - \cos\theta_2) = C\Delta,\; \Delta = \theta_2 - \theta_1"
    ),
    title="Slide of a shaken cake in one cycle",
    output="slide_length",
    typical={
        "acceleration_drive": (50.0, 300.0),
        "acceleration_resistance": (20.0, 49.0),
        "vibration_frequency": (15.0, 40.0),
    },
)
def slide_length_cycle(
    acceleration_drive: Acceleration, acceleration_resistance: Acceleration, vibration_frequency: Frequency
) -> Distance:
    """Way that a cake slides forward in one cycle of vibration: it breaks loose where the drive, which goes
    as a sine, exceeds what holds it, and stops when its velocity is spent.

    Derived here as for a conveyor with dry friction. A cake that would slide all through the cycle is stopped
    at its end, which tells less than the truth; the drive is then more than about 3 times the resistance.

    >>> round(slide_length_cycle(200.0, 100.0, 25.0) * 1e3, 3)
    10.26
    """
    some = acceleration_resistance < acceleration_drive
    ratio = jnp.clip(acceleration_resistance / acceleration_drive, 1e-9, 1.0 - 1e-9)
    first = jnp.arcsin(ratio)

    def spent(span, start, held):
        return (jnp.cos(start) - jnp.cos(start + span)) / span - held

    span = find_root(spent, 1e-6, 2.0 * jnp.pi, first, ratio).value
    moves = jnp.cos(first) * span - jnp.sin(first + span) + jnp.sin(first) - 0.5 * ratio * span**2
    omega = 2.0 * jnp.pi * vibration_frequency
    length = jnp.maximum(moves, 0.0) * acceleration_drive / jnp.maximum(omega, 1e-12) ** 2
    return jnp.where(some, length, 0.0)
