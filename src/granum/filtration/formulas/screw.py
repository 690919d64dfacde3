"""Screw of a press: the torque that the friction of its cake on the barrel asks for."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import Length, PressureDrop, Ratio, Torque


@formula(
    source="darnell1956, from the balance of moments of the cake",
    equation=r"T = \mu\,\bar p\,\pi D L\,\frac{D}{2}",
    typical={"screw_diameter": (0.3, 0.8), "screw_length": (1.5, 4.0), "barrel_pressure": (2e4, 1e5)},
)
def screw_torque(
    screw_diameter: Length, screw_length: Length, barrel_pressure: PressureDrop, barrel_friction: Ratio = 0.2
) -> Torque:
    """Greatest torque of the screw of a press: the friction of the cake on the barrel, the only thing around
    that stands still, over the lever of its radius.

    So much a cake takes that turns with the screw; one that is carried along the axis rubs aslant and takes
    somewhat less. What a cone that stands still holds back is left out.

    >>> round(screw_torque("50 cm", "2 m", "0.4 bar", barrel_friction=0.2))
    6283
    """
    wall = jnp.pi * screw_diameter * screw_length
    return barrel_friction * barrel_pressure * wall * 0.5 * screw_diameter
