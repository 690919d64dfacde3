"""The two criteria that avoid trial and error: X = C_D Re² knows the size, Y = Re/C_D knows the velocity."""

from __future__ import annotations

from typing import NamedTuple

import jax.numpy as jnp

from granum.core import formula, limit_active, unconverged
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Density,
    DynamicViscosity,
    Length,
    PositiveNumber,
    Ratio,
    Speed,
    Velocity,
)
from granum.particles.falling import EQUAL_DENSITIES, LEAST, reynolds_from_size, reynolds_from_velocity
from granum.particles.formulas.drag_modern import drag_coefficient_brown_lawler
from granum.particles.formulas.terminal import Drag

STOKES_END, NEWTON_START = 0.2, 500.0
X_STOKES, X_NEWTON = 24.0 * STOKES_END, 0.44 * NEWTON_START**2  # 4.8 and 110 000
Y_STOKES, Y_NEWTON = STOKES_END**2 / 24.0, NEWTON_START / 0.44  # 1.66e-3 and 1136


@formula(
    source="clift1978, chapter 5", equation=r"\mathrm{Ar} = \frac{\rho_f|\rho_p-\rho_f| g d_p^3}{\eta^2}"
)
def archimedes_number(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Ratio:
    """Archimedes number: apparent weight against viscosity. Also called Galileo number in this form.

    >>> round(
    ...     archimedes_number(
    ...         particle_diameter="1 mm", particle_density=2650, fluid_density=1000, dynamic_viscosity="1 cP"
    ...     )
    ... )
    16181
    """
    return (
        fluid_density
        * abs(particle_density - fluid_density)
        * gravity
        * particle_diameter**3
        / dynamic_viscosity**2
    )


@formula(
    source="clift1978, chapter 5; perry2008, section 6",
    equation=r"X = C_D\mathrm{Re}^2 = \frac{4}{3}\frac{\rho_f|\rho_p-\rho_f| g d_p^3}{\eta^2}",
)
def velocity_criterion(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Ratio:
    """Criterion X = C_D Re² that gives the velocity of a known size: Stokes up to 4.8, Newton from 110 000,
    Allen between.

    >>> round(
    ...     velocity_criterion(
    ...         particle_diameter="85 um",
    ...         particle_density=2630,
    ...         fluid_density=1020,
    ...         dynamic_viscosity="1.2 cP",
    ...     ),
    ...     2,
    ... )
    9.16
    """
    return (
        4.0
        / 3.0
        * archimedes_number(particle_diameter, particle_density, fluid_density, dynamic_viscosity, gravity)
    )


@formula(
    source="clift1978, chapter 5; perry2008, section 6",
    equation=r"Y = \frac{\mathrm{Re}}{C_D} = \frac{3}{4}\frac{\rho_f^2 v^3}{\eta g|\rho_p-\rho_f|}",
)
def diameter_criterion(
    velocity: Speed,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Ratio:
    """Criterion Y = Re/C_D that gives the size of a known velocity: Stokes up to 1.66e-3, Newton from 1136,
    Allen between.

    Infinite at equal densities.

    >>> round(
    ...     diameter_criterion(
    ...         velocity="4.92 mm/s", particle_density=2630, fluid_density=1020, dynamic_viscosity="1.2 cP"
    ...     ),
    ...     5,
    ... )
    0.0049
    """
    weight = dynamic_viscosity * gravity * abs(particle_density - fluid_density)
    heavy = weight > 0.0
    return jnp.where(heavy, 0.75 * fluid_density**2 * velocity**3 / jnp.where(heavy, weight, 1.0), jnp.inf)


@formula(
    source="clift1978, chapter 5",
    title="Reynolds number from the velocity criterion",
    equation=r"C_D(\mathrm{Re})\,\mathrm{Re}^2 = X",
    typical={"velocity_criterion": (1e-2, 1e6)},
)
def reynolds_number_from_velocity_criterion(
    velocity_criterion: PositiveNumber, drag: Drag = drag_coefficient_brown_lawler
) -> Ratio:
    """Reynolds number of terminal motion from the criterion X, under any drag law.

    >>> from granum.particles.formulas.drag import drag_coefficient_stokes
    >>> round(
    ...     reynolds_number_from_velocity_criterion(velocity_criterion=4.8, drag=drag_coefficient_stokes), 6
    ... )
    0.2
    """
    Re, found = reynolds_from_size(drag, jnp.maximum(velocity_criterion, LEAST))
    drag(Re)
    unconverged(found)
    return Re


@formula(
    source="clift1978, chapter 5",
    title="Reynolds number from the diameter criterion",
    equation=r"\frac{\mathrm{Re}}{C_D(\mathrm{Re})} = Y",
    typical={"diameter_criterion": (1e-4, 1e4)},
)
def reynolds_number_from_diameter_criterion(
    diameter_criterion: PositiveNumber, drag: Drag = drag_coefficient_brown_lawler
) -> Ratio:
    """Reynolds number of terminal motion from the criterion Y, under any drag law.

    >>> from granum.particles.formulas.drag import drag_coefficient_newton
    >>> round(
    ...     reynolds_number_from_diameter_criterion(
    ...         diameter_criterion=500 / 0.44, drag=drag_coefficient_newton
    ...     ),
    ...     6,
    ... )
    500.0
    """
    Re, found = reynolds_from_velocity(drag, jnp.maximum(diameter_criterion, LEAST))
    drag(Re)
    unconverged(found)
    return Re


class FallByRegime(NamedTuple):
    """Terminal velocity by the regime that the criterion X selects."""

    terminal_velocity: Velocity
    reynolds_number: Ratio
    velocity_criterion: Ratio
    drag_coefficient: Ratio


@formula(
    source="stokes1851; allen1900; newton1687; perry2008, section 6",
    title="Terminal velocity by regime",
    equation=(
        r"\mathrm{Re} = \frac{X}{24}\ (X\le 4.8),\ \left(\frac{X}{18.5}\right)^{1/1.4},\ "
        r"\sqrt{\frac{X}{0.44}}\ (X\ge 110\,000),\quad X = C_D\,\mathrm{Re}^2 = "
        r"\frac{4\,g\,d_p^3\,\rho_f\,|\rho_p - \rho_f|}{3\,\eta^2},\quad v_t = "
        r"\frac{\mathrm{Re}\,\eta}{\rho_f\,d_p}"
    ),
    fitted={"reynolds_number": (0.0, 2e5)},
)
def terminal_velocity_by_regime(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> FallByRegime:
    """Terminal velocity by Stokes, Allen or Newton, whichever the criterion X selects; positive downwards.

    The hand method of the courses. It jumps by a factor 1.9 at X = 4.8, where Allen's law is far too low in
    drag. Differs from the print: the course gives Newton's velocity as √(3 g (ρ_p/ρ_f − 1) d); 3 stands for
    4/(3·0.44) = 3.03. Newton's law ends at a Reynolds number of 200 000, where the drag of a sphere falls.

    >>> found = terminal_velocity_by_regime(
    ...     particle_diameter="50 um", particle_density=2650, fluid_density=1000, dynamic_viscosity="1 cP"
    ... )
    >>> round(1000 * found.terminal_velocity, 3), round(found.velocity_criterion, 2)
    (2.247, 2.7)
    """
    rho, eta = fluid_density, dynamic_viscosity
    excess = jnp.asarray(particle_density - rho, dtype=float)
    limit_active(excess == 0.0, particle_density, "particle_density", EQUAL_DENSITIES)
    X = velocity_criterion(particle_diameter, particle_density, rho, eta, gravity)
    safe = jnp.maximum(X, LEAST)
    Re = jnp.select(
        [X <= X_STOKES, X < X_NEWTON], [X / 24.0, (safe / 18.5) ** (1.0 / 1.4)], jnp.sqrt(safe / 0.44)
    )
    velocity = jnp.sign(excess) * Re * eta / (rho * particle_diameter)
    return FallByRegime(velocity, Re, X, safe / jnp.maximum(Re, LEAST / 24.0) ** 2)


class SizeByRegime(NamedTuple):
    """Diameter by the regime that the criterion Y selects."""

    terminal_diameter: Length
    reynolds_number: Ratio
    diameter_criterion: Ratio


@formula(
    source="stokes1851; allen1900; newton1687; perry2008, section 6",
    title="Diameter from terminal velocity, by regime",
    equation=(
        r"\mathrm{Re} = \sqrt{24Y}\ (Y\le 1.66\cdot10^{-3}),\ (18.5Y)^{1/1.6},\ 0.44Y\ (Y\ge "
        r"1136),\quad Y = \frac{3\,\rho_f^2 v^3}{4\,\eta\,g\,|\rho_p - \rho_f|},\quad d_p = "
        r"\frac{\mathrm{Re}\,\eta}{\rho_f\,v}"
    ),
    fitted={"reynolds_number": (0.0, 2e5)},
)
def terminal_diameter_by_regime(
    velocity: Speed,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> SizeByRegime:
    """Diameter of the particle with a given terminal speed by Stokes, Allen or Newton, whichever the
    criterion Y selects.

    Newton's law ends at a Reynolds number of 200 000, where the drag of a sphere falls.

    >>> found = terminal_diameter_by_regime(
    ...     velocity="2.247 mm/s", particle_density=2650, fluid_density=1000, dynamic_viscosity="1 cP"
    ... )
    >>> round(1e6 * found.terminal_diameter, 1), round(found.diameter_criterion, 6)
    (50.0, 0.000526)
    """
    rho, eta = fluid_density, dynamic_viscosity
    Y = diameter_criterion(velocity, particle_density, rho, eta, gravity)
    safe = jnp.maximum(Y, LEAST)
    Re = jnp.select(
        [Y <= Y_STOKES, Y < Y_NEWTON], [jnp.sqrt(24.0 * safe), (18.5 * safe) ** (1.0 / 1.6)], 0.44 * Y
    )
    moving = velocity > 0.0
    diameter = jnp.where(moving, Re * eta / (rho * jnp.where(moving, velocity, 1.0)), jnp.nan)
    return SizeByRegime(diameter, Re, Y)
