"""Settling chambers: dust that falls out while the gas passes."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import Area, Fraction, Speed, VolumeFlow

_TYPICAL = {"settling_velocity": (0.01, 1.0), "area": (1.0, 100.0), "volume_flow": (0.5, 20.0)}


@formula(
    source="tan2014, eq. 6.16",
    equation=r"E = \min\left(1, \frac{v_s\,A}{Q}\right)",
    typical=_TYPICAL,
    output="grade_efficiency",
    title="Grade efficiency of a settling chamber, laminar",
)
def grade_efficiency_chamber_laminar(
    settling_velocity: Speed, area: Area, volume_flow: VolumeFlow
) -> Fraction:
    """Share of a particle size that reaches the floor, the area, on straight paths.

    Half of the velocity that just falls the whole height is half caught.

    >>> grade_efficiency_chamber_laminar(0.1, 10.0, 2.0)
    0.5
    """
    return jnp.minimum(settling_velocity * area / jnp.maximum(volume_flow, 1e-300), 1.0)


@formula(
    source="tan2014, eq. 6.22",
    equation=r"E = 1 - \exp\left(-\frac{v_s\,A}{Q}\right)",
    typical=_TYPICAL,
    output="grade_efficiency",
    title="Grade efficiency of a settling chamber, turbulent",
)
def grade_efficiency_chamber_turbulent(
    settling_velocity: Speed, area: Area, volume_flow: VolumeFlow
) -> Fraction:
    """Share of a particle size that reaches the floor from gas kept evenly mixed over the height.

    By hand: what would just all fall out on straight paths leaves exp(−1).

    >>> round(grade_efficiency_chamber_turbulent(0.1, 10.0, 1.0), 4)
    0.6321
    """
    return -jnp.expm1(-settling_velocity * area / jnp.maximum(volume_flow, 1e-300))
