"""Ideal settling basin: overflow rate, length, removal, scour."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Area,
    Density,
    Fraction,
    Length,
    PositiveNumber,
    Series,
    Speed,
    VolumeFlow,
)
from granum.particles.formulas.means import Shares, shares


@formula(
    source="hazen1904; camp1946",
    title="Overflow rate of a basin",
    equation=r"v_0 = \frac{Q}{A}",
    family="overflow_rate",
)
def overflow_rate_basin(volume_flow: VolumeFlow, area: Area) -> Speed:
    """Overflow rate of a basin: the velocity of the slowest particle that an ideal basin removes completely.

    >>> round(overflow_rate_basin(volume_flow="0.5 m^3/s", area=1330.0) * 86400, 1)
    32.5
    """
    return volume_flow / area


@formula(source="hazen1904; camp1946", equation=r"A = \frac{Q}{v_s}", family="basin_area")
def basin_area(volume_flow: VolumeFlow, settling_velocity: Speed) -> Area:
    """Area of an ideal basin that removes completely what settles at a given velocity; the depth plays no
    part.

    >>> round(basin_area(volume_flow="0.5 m^3/s", settling_velocity=32.5 / 86400), 1)
    1329.2
    """
    return volume_flow / settling_velocity


@formula(source="camp1946", title="Horizontal velocity in a basin", equation=r"U_x = \frac{Q}{l\,H}")
def horizontal_velocity_basin(volume_flow: VolumeFlow, width: Length, height: Length) -> Speed:
    """Mean horizontal velocity in a rectangular basin.

    >>> horizontal_velocity_basin(volume_flow=0.06, width=2.0, height=1.0)
    0.03
    """
    return volume_flow / (width * height)


@formula(source="camp1946", equation=r"L = U_x\,\frac{H}{v_s}")
def basin_length(horizontal_velocity: Speed, height: Length, settling_velocity: Speed) -> Length:
    """Length of a rectangular basin in which a particle that enters at the surface just reaches the bottom.

    >>> basin_length(horizontal_velocity="3 cm/s", height="2 m", settling_velocity="1 cm/s")
    6.0
    """
    impossible(~(settling_velocity > 0), settling_velocity, "settling_velocity", 0.0, jnp.inf)
    return horizontal_velocity * height / settling_velocity


@formula(source="hazen1904; camp1946", equation=r"E = \min\left(1, \frac{v_s}{v_0}\right)")
def removal_efficiency_camp(settling_velocity: Speed, overflow_rate: Speed) -> Fraction:
    """Share of particles of one settling velocity that an ideal basin (plug flow, no turbulence) removes.

    >>> removal_efficiency_camp(settling_velocity="0.2 mm/s", overflow_rate="0.5 mm/s")
    0.4
    """
    return jnp.minimum(settling_velocity / overflow_rate, 1.0)


@formula(source="hazen1904", equation=r"E = 1 - \left(1 + \frac{v_s}{n v_0}\right)^{-n}")
def removal_efficiency_hazen(
    settling_velocity: Speed, overflow_rate: Speed, tank_number: PositiveNumber = 3.0
) -> Fraction:
    """Share of particles of one settling velocity removed by a real basin, taken as several mixed tanks in
    series.

    One tank is poor, 3 good, 5 to 8 very good performance; many tanks give ``1 − exp(−v_s/v_0)``.

    >>> removal_efficiency_hazen(settling_velocity="1 mm/s", overflow_rate="1 mm/s", tank_number=1)
    0.5
    """
    return -jnp.expm1(-tank_number * jnp.log1p(settling_velocity / (tank_number * overflow_rate)))


@formula(
    source="camp1946",
    title="Removal efficiency of a basin by classes",
    equation=r"E = \sum_i w_i \min\left(1, \frac{v_i}{v_0}\right)",
    symbols={"class_fractions": "w_i", "class_velocities": "v_i", "overflow_rate": "v_0"},
)
def removal_efficiency_classes(
    class_velocities: Annotated[Speed, Series("classes")], class_fractions: Shares, overflow_rate: Speed
) -> Fraction:
    """Share of all solids that an ideal basin removes, from the settling velocities of the classes and their
    mass fractions.

    >>> round(removal_efficiency_classes([1e-4, 4e-4, 1e-3], [0.2, 0.3, 0.5], overflow_rate=5e-4), 4)
    0.78
    """
    return jnp.sum(
        shares(class_fractions) * jnp.minimum(jnp.asarray(class_velocities) / overflow_rate, 1.0), axis=-1
    )


@formula(
    source="camp1946; metcalf2003, eq. 5-36",
    equation=r"v_H = \sqrt{\frac{8 k (\rho_p/\rho_l - 1) g d_p}{f}}",
    fitted={"scour_constant": (0.04, 0.06), "scour_friction_factor": (0.02, 0.03)},
)
def scour_velocity_camp(
    particle_diameter: Length,
    particle_density: Density,
    liquid_density: Density,
    scour_constant: PositiveNumber = 0.05,
    scour_friction_factor: PositiveNumber = 0.025,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Horizontal velocity above which settled particles are scoured off the bottom.

    The constant is 0.04 for single-grained sand and 0.06 for sticky, interlocking matter; the Darcy friction
    factor 0.02 to 0.03.

    >>> round(scour_velocity_camp("100 um", particle_density=1250, liquid_density=1000), 3)
    0.063
    """
    k, f, s = scour_constant, scour_friction_factor, particle_density / liquid_density
    buoyant = jnp.maximum(s - 1.0, 1e-12)
    return jnp.sqrt(8.0 * k * buoyant * gravity * particle_diameter / f)
