"""Cakes that travel over a spinning cone: stay under a scroll, and what makes a cake slide by itself, by
vibration or by tumbling.
"""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import Acceleration, Angle, Length, PositiveNumber, RotationSpeed, Time, Within

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
