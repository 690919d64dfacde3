"""Flights of a rotary drum: what they hold, and the filling at which all of it showers."""

from __future__ import annotations

from math import pi
from typing import Annotated

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import Angle, Distance, Length, PositiveNumber, Ratio, RotationSpeed, Within


@formula(
    source="schofield1962, by way of baker1988, eq. 1",
    equation=(r"\tan\gamma = \frac{\mu + \nu}{1 - \mu\nu},\quad \nu = \frac{D\,\omega^2}{2\,g}"),
    fitted={"centrifugal_ratio": (0.0, 0.4)},
    typical={"repose_friction": (0.5, 1.2), "diameter": (0.5, 4.0), "rotation_speed": (0.1, 0.6)},
    title="Angle of the solid on a flight (Schofield–Glikin)",
)
def flight_repose_angle(repose_friction: Ratio, diameter: Length, rotation_speed: RotationSpeed) -> Angle:
    """Slope of the surface of the solid on a flight that is level with the axis of the drum, to which
    friction and centrifugal force hold it.

    Of free-flowing solids; drums turn at 0.0025 to 0.04 of the centrifugal acceleration that would hold the
    solid at the shell (Baker); that the law holds to ten times as much is recalled. Wet solid that clings
    stands steeper. The print gives it for every place of the flight; the paper of 1962 was not opened.

    By hand: the two angles add up, arctan 0.8 + arctan 0.02 = 38.66 + 1.15 degrees.

    >>> import math
    >>> round(math.degrees(flight_repose_angle(0.8, "2 m", math.sqrt(0.02 * 9.80665))), 2)
    39.81
    """
    ratio = 0.5 * diameter * rotation_speed**2 / STANDARD_GRAVITY
    watch(centrifugal_ratio=ratio)
    return jnp.arctan(repose_friction) + jnp.arctan(ratio)


@formula(
    source="kelly1977, by way of baker1988",
    equation=(
        r"f^* = \frac{n + 1}{2}\,\frac{a}{\pi D^2/4},\quad "
        r"a = l\,b + \tfrac{1}{2}\,l^2\tan\gamma"
    ),
    typical={
        "diameter": (0.5, 4.0),
        "flight_count": (6.0, 40.0),
        "flight_depth": (0.05, 0.4),
        "flight_lip": (0.0, 0.2),
        "flight_repose_angle": (0.5, 0.9),
    },
    title="Design filling of a drum with flights (Kelly–O'Donnell)",
)
def flight_filling_design(
    diameter: Length,
    flight_count: PositiveNumber,
    flight_depth: Length,
    flight_lip: Distance,
    flight_repose_angle: Annotated[Angle, Within(0.0, 1.4)],
) -> Ratio:
    """Share of the drum that solid fills when the flights are just full as they come level with the axis and
    begin to shower: with less the gas meets less falling solid, with more the rest rolls at the bottom.

    Half of the flights, and one, hold what one holds there: a flight of a depth with an upright lip, filled
    to the edge of its lip (our own geometry, the shell behind it taken flat). The form is recalled; Baker's
    paper, which gives it, was opened in part.

    By hand: 14 flights of 0.17 m with lips of 0.08 m in a drum of 1.7 m, 40 degrees: a = 0.0136 + 0.0121 m²,
    7.5 · 0.0257/2.270 = 0.085.

    >>> round(flight_filling_design("1.7 m", 14, "0.17 m", "0.08 m", "40 deg"), 3)
    0.085
    """
    held = flight_depth * flight_lip + 0.5 * flight_depth**2 * jnp.tan(flight_repose_angle)
    return 0.5 * (flight_count + 1.0) * held / (0.25 * pi * diameter**2)
