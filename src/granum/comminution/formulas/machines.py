"""Geometry and speed of crushers and mills."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import Acceleration, Angle, Distance, Fraction, Length, RotationSpeed, VolumeFlow


@formula(source="coulson2002, ch. 2", equation=r"\omega_c = \sqrt{\frac{2g}{D - d}}", output="rotation_speed", title="Critical speed of a tumbling mill",
         typical={"mill_diameter": (1.0, 5.0), "ball_diameter": (0.01, 0.1)})  # fmt: skip
def rotation_speed_critical(
    mill_diameter: Length, ball_diameter: Distance = 0.0, gravity: Acceleration = STANDARD_GRAVITY
) -> RotationSpeed:
    """Speed at which a ball at the shell no longer falls; mills run at 65 to 80 % of it.

    >>> round(rotation_speed_critical(mill_diameter=1.2), 2)
    4.04
    """
    gap = mill_diameter - ball_diameter
    impossible(gap <= 0.0, ball_diameter, "ball_diameter", 0.0, mill_diameter)
    return jnp.where(gap > 0, jnp.sqrt(2.0 * gravity / jnp.where(gap > 0, gap, 1.0)), jnp.nan)


@formula(source="coulson2002, ch. 2", equation=r"d_{\max} = \frac{D + s}{\cos(\alpha/2)} - D", output="feed_size", title="Largest feed of crushing rolls",
         typical={"nip_angle": (0.3, 0.6), "roll_diameter": (0.5, 1.5), "gap_width": (0.002, 0.02)})  # fmt: skip
def feed_size_rolls(roll_diameter: Length, gap_width: Length, nip_angle: Angle) -> Length:
    """Diameter of the largest sphere that two rolls nip, from the full angle between the tangents at the contacts.

    >>> round(feed_size_rolls(roll_diameter=1.0, gap_width="12.5 mm", nip_angle="31 degree") * 1e3, 1)
    50.7
    """
    return (roll_diameter + gap_width) / jnp.cos(0.5 * nip_angle) - roll_diameter


@formula(source="coulson2002, ch. 2", equation=r"Q = \pi D\,N\,w\,s\,k", output="volume_flow", title="Capacity of crushing rolls",
         typical={"roll_diameter": (0.5, 1.5), "gap_width": (0.002, 0.02), "roll_width": (0.2, 0.6), "filled_fraction": (0.1, 0.3),
                  "rotation_speed": (1.0, 15.0)})  # fmt: skip
def volume_flow_rolls(
    roll_diameter: Length, roll_width: Length, gap_width: Length, rotation_speed: RotationSpeed, filled_fraction: Fraction = 0.12
) -> VolumeFlow:
    """Volume of solid that passes two rolls; the actual capacity is 10 to 30 % of the ribbon that the gap could take.

    >>> round(volume_flow_rolls(1.0, 0.4, "12.5 mm", rotation_speed=1.0, filled_fraction=1.0), 6)
    0.0025
    """
    return 0.5 * roll_diameter * rotation_speed * roll_width * gap_width * filled_fraction
