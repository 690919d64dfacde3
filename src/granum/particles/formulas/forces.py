"""Drag force on a particle and the drag coefficient that a measured fall shows."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Density,
    DynamicViscosity,
    Force,
    Length,
    PositiveNumber,
    Speed,
    Sphericity,
)
from granum.particles.definitions import reynolds_of
from granum.particles.falling import LEAST, drag_of_shape
from granum.particles.formulas.drag_modern import drag_coefficient_brown_lawler
from granum.particles.formulas.terminal import Drag

STANDS = "A particle that stands still shows no drag."


@formula(
    source="brown2003; haider1989; clift1978, chapter 5",
    equation=r"F_D = C_D(\mathrm{Re})\,\frac{\pi d_p^2}{4}\,\frac{\rho_f v^2}{2}" + reynolds_of("v"),
)
def drag_force(
    particle_diameter: Length,
    velocity: Speed,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    drag: Drag = drag_coefficient_brown_lawler,
    sphericity: Sphericity | None = None,
) -> Force:
    """Drag force of a fluid on a particle that moves through it, under any drag law.

    The diameter is that of the sphere of equal volume.

    >>> round(
    ...     1e6
    ...     * drag_force(
    ...         particle_diameter="1 mm", velocity="0.1 m/s", fluid_density=1000, dynamic_viscosity="1 cP"
    ...     ),
    ...     2,
    ... )
    4.21
    """
    eta, rho = dynamic_viscosity, fluid_density
    Re = rho * velocity * particle_diameter / eta
    moving = jnp.maximum(Re, LEAST)
    return jnp.pi / 8.0 * eta**2 / rho * drag_of_shape(drag, sphericity)(moving) * moving * Re


@formula(
    source="clift1978, chapter 5",
    equation=r"C_D = \frac{4 g d_p |\rho_p - \rho_f|}{3\,\rho_f v_t^2}",
    symbols={"velocity": "v_t"},
)
def measured_drag_coefficient(
    particle_diameter: Length,
    velocity: Speed,
    particle_density: Density,
    fluid_density: Density,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> PositiveNumber:
    """Drag coefficient of a particle from its measured terminal velocity, falling or rising.

    >>> round(
    ...     measured_drag_coefficient(
    ...         particle_diameter="5 mm",
    ...         velocity="0.6 m/s",
    ...         particle_density=2500,
    ...         fluid_density=1000,
    ...         gravity=9.81,
    ...     ),
    ...     4,
    ... )
    0.2725
    """
    v = jnp.asarray(velocity)
    impossible(~(v > 0.0), v, "velocity", reason=STANDS)
    v = jnp.where(v > 0.0, v, jnp.nan)
    return (
        4.0
        / 3.0
        * gravity
        * particle_diameter
        * jnp.abs(particle_density - fluid_density)
        / (fluid_density * v**2)
    )
