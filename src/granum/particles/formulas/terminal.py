"""Terminal velocity of a single particle and the size that has a given one, under any drag law, falling or
rising.
"""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula, impossible, limit_active, unconverged
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import Acceleration, Density, DynamicViscosity, Law, Length, Sphericity, Velocity
from granum.particles.definitions import reynolds_of
from granum.particles.falling import (
    EQUAL_DENSITIES,
    LEAST,
    WRONG_WAY,
    drag_of_shape,
    reynolds_from_size,
    reynolds_from_velocity,
)
from granum.particles.formulas.drag_modern import drag_coefficient_brown_lawler

Drag = Annotated[Any, Law("drag_coefficient")]


@formula(
    source="brown2003; haider1989; clift1978, chapter 5",
    equation=(
        r"v_t = \mathrm{sgn}(\rho_p - \rho_f)\sqrt{\frac{4 g d_p |\rho_p - \rho_f|}{3\, "
        r"C_D(\mathrm{Re})\, \rho_f}}"
    )
    + reynolds_of("v_t"),
)
def terminal_velocity(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
    drag: Drag = drag_coefficient_brown_lawler,
    sphericity: Sphericity | None = None,
) -> Velocity:
    """Terminal velocity of a single particle in a fluid at rest: positive downwards, negative for a particle
    that rises.

    The diameter is that of the sphere of equal volume. Any drag law serves; its range is checked at the
    Reynolds number found. A law that knows the sphericity uses it; a law for spheres is scaled by Haider and
    Levenspiel's ratio of shape to sphere. With equal densities the velocity is zero and flagged. Put ω²r in
    place of gravity for a centrifuge.

    >>> round(
    ...     1000
    ...     * terminal_velocity(
    ...         particle_diameter="85 um",
    ...         particle_density=2630,
    ...         fluid_density=1020,
    ...         dynamic_viscosity="1.2 cP",
    ...     ),
    ...     2,
    ... )
    4.92
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    excess = jnp.asarray(particle_density - rho, dtype=float)
    limit_active(excess == 0.0, particle_density, "particle_density", EQUAL_DENSITIES)
    creeping = gravity * excess * d**2 / (18.0 * eta)
    X = jnp.maximum(
        4.0 / 3.0 * rho * jnp.where(excess < 0.0, -excess, excess) * gravity * d**3 / eta**2, LEAST
    )
    law = drag_of_shape(drag, sphericity)
    Re, found = reynolds_from_size(law, X)
    law(Re)  # for its flags at the Reynolds number found
    unconverged(found)
    return creeping * (24.0 * Re / X)


@formula(
    source="brown2003; haider1989; clift1978, chapter 5",
    equation=(
        r"Y = \frac{\mathrm{Re}}{C_D} = \frac{3 \rho_f^2 v^3}{4 \eta g |\rho_p - \rho_f|},\quad d_p = "
        r"\frac{\mathrm{Re}(Y)\,\eta}{\rho_f v}"
    ),
)
def terminal_diameter(
    velocity: Velocity,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
    drag: Drag = drag_coefficient_brown_lawler,
    sphericity: Sphericity | None = None,
) -> Length:
    """Diameter of the particle that has a given terminal velocity: the inverse of the terminal velocity.

    A rising particle may be given by its speed or by the negative velocity of the convention "positive
    downwards". A negative velocity of a particle heavier than the fluid, and any velocity at equal densities,
    have no size: no value, flagged.

    >>> round(
    ...     1e6
    ...     * terminal_diameter(
    ...         velocity="4.92 mm/s", particle_density=2630, fluid_density=1020, dynamic_viscosity="1.2 cP"
    ...     ),
    ...     1,
    ... )
    85.0
    """
    rho, eta = fluid_density, dynamic_viscosity
    excess = jnp.asarray(particle_density - rho, dtype=float)
    limit_active(excess == 0.0, particle_density, "particle_density", EQUAL_DENSITIES)
    impossible((velocity < 0.0) & (excess > 0.0), velocity, "velocity", reason=WRONG_WAY)
    possible = (excess != 0.0) & (velocity != 0.0) & ((velocity > 0.0) | (excess < 0.0))
    speed = jnp.where(possible, abs(velocity), 1.0)
    weight = jnp.where(possible, abs(excess), 1.0)
    Y = 0.75 * rho**2 * speed**3 / (eta * gravity * weight)
    law = drag_of_shape(drag, sphericity)
    Re, found = reynolds_from_velocity(law, Y)
    law(Re)
    unconverged(found)
    return jnp.where(possible, Re * eta / (rho * speed), jnp.nan)
