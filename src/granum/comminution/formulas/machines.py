"""Geometry and speed of crushers and mills."""

from __future__ import annotations

import jax.numpy as jnp

from granum.comminution.kinds import WorkIndex
from granum.core import formula, impossible
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Angle,
    Density,
    Distance,
    Fraction,
    Length,
    PositiveNumber,
    RotationSpeed,
    VolumeFlow,
)

FLAT_NIP = "The tangents to the rolls at the feed meet at less than 180°; rolls bite at 20 to 35°."


@formula(
    source="richardson2002, ch. 2",
    equation=r"\omega_c = \sqrt{\frac{2g}{D - d}}",
    output="rotation_speed",
    title="Critical speed of a tumbling mill",
    typical={"mill_diameter": (1.0, 5.0), "ball_diameter": (0.01, 0.1)},
    symbols={"rotation_speed": r"\omega_c"},
)
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


@formula(
    source="napiermunn1996",
    equation=r"J = \frac{\beta - \sin\beta}{2\pi},\quad \cos\frac{\beta}{2} = \frac{2h}{D} - 1",
    title="Filling of a mill from the height above its charge",
    typical={"mill_diameter": (1.0, 5.0), "height_above_charge": (0.5, 1.0)},
)
def mill_filling(mill_diameter: Length, height_above_charge: Distance) -> Fraction:
    """Share of the mill's volume that its charge takes, bed and voids, from the height measured above the
    resting charge at mid-mill.

    >>> round(mill_filling(mill_diameter="3 m", height_above_charge="1.5 m"), 6)
    0.5
    """
    lever = 2.0 * height_above_charge / mill_diameter - 1.0
    impossible(lever > 1.0, height_above_charge, "height_above_charge", 0.0, mill_diameter)
    inside = jnp.abs(lever) < 1.0
    angle = 2.0 * jnp.arccos(jnp.where(inside, lever, 0.0))
    filled = (angle - jnp.sin(angle)) / (2.0 * jnp.pi)
    return jnp.where(inside, filled, jnp.where(lever <= -1.0, 1.0, jnp.where(lever > 1.0, jnp.nan, 0.0)))


@formula(
    source="bond1961",
    equation=r"d = 25.4\,\mathrm{mm}\sqrt{\frac{F}{K}}\left(\frac{\rho_s\,W_i}{100\,f_c\sqrt{D}}\right)^{1/3}",  # noqa: E501
    output="ball_diameter",
    title="Largest make-up ball of a mill (Bond)",
    typical={"mill_diameter": (1.0, 5.0), "speed_share": (0.65, 0.8), "feed_size": (5e-4, 1e-2)},
)
def ball_diameter_bond(
    feed_size: Length,
    solid_density: Density,
    work_index: WorkIndex,
    mill_diameter: Length,
    speed_share: PositiveNumber = 0.75,
    ball_size_constant: PositiveNumber = 350.0,
) -> Length:
    """Diameter of the largest steel ball to be added to a mill, from the 80 % size of its feed.

    The source counts the feed in µm, the work index in kWh per short ton, the mill in feet, the density
    against water and the ball in inches; any unit is taken here. The constant is 350 for wet and 335 for dry
    grinding.

    >>> round(
    ...     ball_diameter_bond(
    ...         "10 mm", solid_density=2600, work_index="12.7 kWh/short_ton", mill_diameter="3.5 m"
    ...     )
    ...     * 1e3,
    ...     1,
    ... )
    68.8
    """
    hardness = solid_density / 1000.0 * work_index / (3.6e6 / 907.18474)
    turning = 100.0 * speed_share * jnp.sqrt(mill_diameter / 0.3048)
    return 0.0254 * jnp.sqrt(1e6 * feed_size / ball_size_constant) * jnp.cbrt(hardness / turning)


@formula(
    source="richardson2002, ch. 2",
    equation=r"F = \frac{D + s}{\cos(\alpha/2)} - D",
    output="feed_size",
    title="Largest feed of crushing rolls",
    typical={"nip_angle": (0.3, 0.6), "roll_diameter": (0.5, 1.5), "gap_width": (0.002, 0.02)},
)
def feed_size_rolls(roll_diameter: Length, gap_width: Length, nip_angle: Angle) -> Length:
    """Diameter of the largest sphere that two rolls nip, from the full angle between the tangents at the
    contacts.

    >>> round(feed_size_rolls(roll_diameter=1.0, gap_width="12.5 mm", nip_angle="31 degree") * 1e3, 1)
    50.7
    """
    impossible((nip_angle < 0.0) | (nip_angle >= jnp.pi), nip_angle, "nip_angle", 0.0, jnp.pi, FLAT_NIP)
    return (roll_diameter + gap_width) / jnp.cos(0.5 * nip_angle) - roll_diameter


@formula(
    source="richardson2002, ch. 2",
    equation=r"\cos\frac{\alpha}{2} = \frac{D + s}{D + F}",
    output="nip_angle",
    title="Angle of nip of crushing rolls",
    typical={"feed_size": (0.01, 0.04), "roll_diameter": (0.5, 1.5), "gap_width": (0.002, 0.009)},
)
def nip_angle_rolls(roll_diameter: Length, gap_width: Length, feed_size: Length) -> Angle:
    """Full angle between the tangents at the contacts of a sphere that rests on two rolls; 0 for one that
    falls through the gap.

    >>> round(nip_angle_rolls(roll_diameter=1.0, gap_width="12.5 mm", feed_size="50.7 mm") * 57.29578, 1)
    31.0
    """
    held = feed_size > gap_width
    ratio = (roll_diameter + gap_width) / (roll_diameter + feed_size)
    return jnp.where(held, 2.0 * jnp.arccos(jnp.where(held, ratio, 0.5)), 0.0)


@formula(
    source="richardson2002, ch. 2",
    equation=r"D = \frac{F\cos(\alpha/2) - s}{1 - \cos(\alpha/2)}",
    output="roll_diameter",
    title="Diameter of crushing rolls for a feed",
    typical={"feed_size": (0.02, 0.05), "nip_angle": (0.4, 0.6), "gap_width": (0.002, 0.009)},
)
def roll_diameter_rolls(feed_size: Length, gap_width: Length, nip_angle: Angle) -> Length:
    """Diameter of the rolls that nip spheres of a size at a given angle of nip.

    >>> round(roll_diameter_rolls(feed_size="50.714 mm", gap_width="12.5 mm", nip_angle="31 degree"), 3)
    1.0
    """
    cosine = jnp.cos(0.5 * nip_angle)
    impossible((nip_angle <= 0.0) | (nip_angle >= jnp.pi), nip_angle, "nip_angle", 0.0, jnp.pi, FLAT_NIP)
    fits = (cosine < 1.0) & (feed_size * cosine > gap_width)
    impossible(~fits, gap_width, "gap_width", 0.0, feed_size * cosine)
    return jnp.where(
        fits, (feed_size * cosine - gap_width) / jnp.where(cosine < 1.0, 1.0 - cosine, 1.0), jnp.nan
    )


@formula(
    source="richardson2002, ch. 2",
    equation=r"Q = \pi D\,\frac{\omega}{2\pi}\,w\,s\,k",
    output="volume_flow",
    title="Capacity of crushing rolls",
    typical={
        "roll_diameter": (0.5, 1.5),
        "gap_width": (0.002, 0.02),
        "roll_width": (0.2, 0.6),
        "filled_fraction": (0.1, 0.3),
        "rotation_speed": (1.0, 15.0),
    },
)
def volume_flow_rolls(
    roll_diameter: Length,
    roll_width: Length,
    gap_width: Length,
    rotation_speed: RotationSpeed,
    filled_fraction: Fraction = 0.12,
) -> VolumeFlow:
    """Volume of solid that passes two rolls; the actual capacity is 10 to 30 % of the ribbon that the gap
    could take.

    >>> round(volume_flow_rolls(1.0, 0.4, "12.5 mm", rotation_speed=1.0, filled_fraction=1.0), 6)
    0.0025
    """
    return 0.5 * roll_diameter * rotation_speed * roll_width * gap_width * filled_fraction
