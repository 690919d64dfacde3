"""Inclined plates and tubes: projected area, Yao's critical velocities for the three flow directions."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import Angle, Area, KinematicViscosity, Length, PositiveNumber, Ratio, Speed

_ANGLES = {"plate_angle": (0.7, 1.1)}
UPRIGHT = "Plates stand at an angle to the horizontal from 0 to below 90°."
SHORT_PLATES = (
    "The plates are too short for their spacing: what settles between them is carried off with the sludge."
)


def _check_angle(plate_angle: Any) -> None:
    impossible(
        (plate_angle < 0.0) | (plate_angle >= jnp.pi / 2.0),
        plate_angle,
        "plate_angle",
        0.0,
        jnp.pi / 2.0,
        UPRIGHT,
    )


@formula(
    source="yao1970; metcalf2003",
    equation=r"A_p = N\,S\cos\alpha",
    typical=_ANGLES,
    symbols={"area": "S"},
)
def lamella_area(plate_number: PositiveNumber, area: Area, plate_angle: Angle) -> Area:
    """Settling area of a plate pack: the projection of all plates on the horizontal.

    The angle is measured from the horizontal; plates are set at 45 to 60° so that sludge slides off.

    >>> round(lamella_area(plate_number=100, area=2.0, plate_angle="60 degree"), 6)
    100.0
    """
    _check_angle(plate_angle)
    return plate_number * area * jnp.cos(plate_angle)


@formula(
    source="yao1970, eq. 9",
    title="Settling velocity wholly removed, countercurrent plates",
    equation=r"v_c = \frac{S_c\,v_0}{\sin\alpha + (L/b)\cos\alpha}",
    typical=_ANGLES,
    symbols={"velocity": "v_0"},
)
def critical_velocity_countercurrent(
    velocity: Speed,
    plate_length: Length,
    plate_spacing: Length,
    plate_angle: Angle,
    yao_shape_parameter: PositiveNumber = 1.0,
) -> Speed:
    """Slowest particle wholly removed between plates with the water flowing up against the sliding sludge.

    The velocity is the mean one along the plates, the spacing is perpendicular to them. The shape parameter
    is 1 for parallel plates, 4/3 for round and 11/8 for square tubes.

    >>> round(critical_velocity_countercurrent("3 mm/s", "0.72 m", "2.54 cm", "60 degree") * 1e3, 2)
    0.2
    """
    ratio = plate_length / plate_spacing
    _check_angle(plate_angle)
    return yao_shape_parameter * velocity / (jnp.sin(plate_angle) + ratio * jnp.cos(plate_angle))


@formula(
    source="yao1970",
    title="Settling velocity wholly removed, cocurrent plates",
    equation=r"v_c = \frac{S_c\,v_0}{(L/b)\cos\alpha - \sin\alpha}",
    typical=_ANGLES,
    symbols={"velocity": "v_0"},
)
def critical_velocity_cocurrent(
    velocity: Speed,
    plate_length: Length,
    plate_spacing: Length,
    plate_angle: Angle,
    yao_shape_parameter: PositiveNumber = 1.0,
) -> Speed:
    """Slowest particle wholly removed between plates with the water flowing down together with the sludge.

    Yao's equation at a negative angle. Without meaning (infinite) for plates so short that ``L/b < tan α``.

    >>> round(critical_velocity_cocurrent("3 mm/s", "0.72 m", "2.54 cm", "60 degree") * 1e3, 3)
    0.225
    """
    sweep = plate_length / plate_spacing * jnp.cos(plate_angle) - jnp.sin(plate_angle)
    reachable = sweep > 0
    _check_angle(plate_angle)
    impossible(
        ~reachable, plate_length, "plate_length", plate_spacing * jnp.tan(plate_angle), jnp.inf, SHORT_PLATES
    )
    return jnp.where(reachable, yao_shape_parameter * velocity / jnp.where(reachable, sweep, 1.0), jnp.inf)


@formula(
    source="yao1970",
    title="Settling velocity wholly removed, crosscurrent plates",
    equation=r"v_c = \frac{S_c\,v_0}{(L/b)\cos\alpha}",
    typical=_ANGLES,
    symbols={"velocity": "v_0"},
)
def critical_velocity_crosscurrent(
    velocity: Speed,
    plate_length: Length,
    plate_spacing: Length,
    plate_angle: Angle,
    yao_shape_parameter: PositiveNumber = 1.0,
) -> Speed:
    """Slowest particle wholly removed between plates with the water flowing horizontally, across the sliding
    sludge.

    >>> round(critical_velocity_crosscurrent("3 mm/s", "0.72 m", "2.54 cm", "60 degree") * 1e3, 3)
    0.212
    """
    _check_angle(plate_angle)
    return yao_shape_parameter * velocity * plate_spacing / (plate_length * jnp.cos(plate_angle))


@formula(
    source="yao1970",
    equation=r"\frac{L'}{b} = 0.058\,\frac{v_0 b}{\nu}",
    symbols={"velocity": "v_0"},
)
def relative_length_transition_yao(
    velocity: Speed, plate_spacing: Length, kinematic_viscosity: KinematicViscosity
) -> Ratio:
    """Length over which laminar flow develops at the inlet of plates or tubes, in spacings; Yao adds it to
    the plate length.

    >>> round(relative_length_transition_yao("3 mm/s", "5 cm", "1 mm^2/s"), 6)
    8.7
    """
    return 0.058 * velocity * plate_spacing / kinematic_viscosity
