"""Oil–water separator after API publication 421."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Area,
    Density,
    DynamicViscosity,
    Length,
    PositiveNumber,
    Ratio,
    Speed,
    VolumeFlow,
)

HORIZONTAL_LIMIT = 3 * 0.3048 / 60  # m/s: 3 ft/min
# Figure of turbulence and short-circuiting: ratio of horizontal to rise velocity, factor.
RATIOS, FACTORS = (3.0, 6.0, 10.0, 15.0, 20.0), (1.28, 1.37, 1.52, 1.64, 1.74)


@formula(
    source="api421; stokes1851",
    equation=r"v_t = \frac{g(\rho_w - \rho_o) d^2}{18\,\eta}",
    typical={"droplet_diameter": (5e-5, 2e-4)},
)
def rise_velocity_api(
    water_density: Density,
    oil_density: Density,
    dynamic_viscosity: DynamicViscosity,
    droplet_diameter: Length = 150e-6,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Rise velocity of the design oil globule (150 µm) in water, Stokes law.

    >>> round(rise_velocity_api(water_density=1000, oil_density=880, dynamic_viscosity="1 cP") * 3600, 2)
    5.3
    """
    excess = jnp.maximum(water_density - oil_density, 0.0)
    return gravity * excess * droplet_diameter**2 / (18.0 * dynamic_viscosity)


@formula(source="api421", equation=r"U_x = \min(15\,v_t,\ U_{x,\max})")
def horizontal_velocity_api(
    rise_velocity: Speed, horizontal_velocity_limit: Speed = HORIZONTAL_LIMIT
) -> Speed:
    """Design horizontal velocity of an API separator: 15 times the rise velocity, at most 3 ft/min.

    Differs from the print: the course notes have 15 cm/s for the limit; API 421 has 3 ft/min, which is
    1.5 cm/s.

    >>> round(horizontal_velocity_api(rise_velocity=5.3 / 3600) * 3600, 2)
    54.86
    """
    return jnp.minimum(15.0 * rise_velocity, horizontal_velocity_limit)


@formula(source="api421", equation=r"F = F(v_h/v_t)", fitted={"velocity_ratio": (3.0, 20.0)})
def turbulence_factor_api(velocity_ratio: Ratio) -> PositiveNumber:
    """Factor for turbulence and short-circuiting in an API separator, linear between the points of the API
    figure.

    The points are 1.28 at a ratio of horizontal to rise velocity of 3, 1.37 at 6, 1.52 at 10, 1.64 at 15 and
    1.74 at 20; the end lines are prolonged outside.

    >>> round(turbulence_factor_api(velocity_ratio=10), 4)
    1.52
    """
    r = jnp.asarray(velocity_ratio)
    x, y = jnp.asarray(RATIOS), jnp.asarray(FACTORS)
    i = jnp.clip(jnp.searchsorted(x, r) - 1, 0, x.size - 2)
    return y[i] + (y[i + 1] - y[i]) / (x[i + 1] - x[i]) * (r - x[i])


@formula(source="api421", equation=r"L = F\,\frac{U_x}{v_t}\,H")
def basin_length_api(horizontal_velocity: Speed, rise_velocity: Speed, height: Length) -> Length:
    """Length of an API separator: the ideal basin's length times the turbulence factor.

    >>> round(basin_length_api("54.86 m/hour", "5.3 m/hour", height="1.13 m"), 1)
    17.9
    """
    ratio = horizontal_velocity / rise_velocity
    return turbulence_factor_api(ratio) * ratio * height


@formula(
    source="api421",
    equation=r"A_H = F\,\frac{Q}{v_t}",
    fitted={"turbulence_factor": (1.28, 1.74)},
    symbols={"basin_area": "A_H"},
)
def basin_area_api(
    volume_flow: VolumeFlow, rise_velocity: Speed, turbulence_factor: PositiveNumber = 1.74
) -> Area:
    """Smallest water surface of an API separator.

    The turbulence factor of API 421 runs from 1.28 to 1.74.

    >>> round(basin_area_api(volume_flow=224.79 / 3600, rise_velocity=5.3 / 3600, turbulence_factor=1.53), 1)
    64.9
    """
    return turbulence_factor * volume_flow / rise_velocity
