"""Pores that a liquid enters under pressure."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import Angle, Length, Pressure, SurfaceTension, Within

Wetting = Annotated[Angle, Within(jnp.pi / 2.0 + 1e-6, jnp.pi)]
MERCURY_TENSION = 0.480  # N/m, in vacuum at 20 °C
MERCURY_ANGLE = 2.443460952792061  # 140°
Absolute = Annotated[Pressure, Within(1e-3)]


@formula(
    source="washburn1921",
    title="Pore that mercury enters (Washburn)",
    equation=r"d_p = -\frac{4\sigma\cos\theta}{p}",
    typical={"intrusion_pressure": (1e4, 4e8), "surface_tension": (0.47, 0.49)},
)
def pore_diameter_washburn(
    intrusion_pressure: Absolute,
    surface_tension: SurfaceTension = MERCURY_TENSION,
    wetting_angle: Wetting = MERCURY_ANGLE,
) -> Length:
    """Diameter of the smallest round pores that a liquid which does not wet enters at a pressure; by default
    mercury.

    A wide pore behind a narrow neck counts as wide as its neck. Contact angles of mercury lie between 125°
    and 150°, which moves every diameter by as much as its cosine.

    >>> round(1e6 * pore_diameter_washburn(intrusion_pressure="1 atm"), 1)
    14.5
    """
    return -4.0 * surface_tension * jnp.cos(wetting_angle) / intrusion_pressure
