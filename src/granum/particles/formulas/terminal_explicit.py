"""Terminal velocity without iteration: one regime at a time, and explicit fits to the whole curve. Positive
downwards.
"""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Density,
    DynamicViscosity,
    Length,
    PositiveNumber,
    Ratio,
    Sphericity,
    Velocity,
    Within,
)
from granum.particles.definitions import ARCHIMEDES, SIZE_AND_VELOCITY, reynolds_of, velocity_of


def _reynolds(velocity: Any, d: Any, rho: Any, eta: Any) -> Any:
    return abs(velocity) * d * rho / eta


def _archimedes(d: Any, rho_p: Any, rho: Any, eta: Any, g: Any) -> Any:
    return jnp.maximum(rho * abs(rho_p - rho) * g * d**3 / eta**2, 1e-30)


@formula(
    source="stokes1851; clift1978, eq. 3-18",
    equation=r"v_t = \frac{g(\rho_p-\rho_f)d_p^2}{18\eta}",
    fitted={"reynolds": (0.0, 0.2)},
)
def terminal_velocity_stokes(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Velocity:
    """Terminal velocity of a sphere in creeping flow by Stokes.

    >>> round(
    ...     1000
    ...     * terminal_velocity_stokes(
    ...         particle_diameter="20 um", particle_density=2650, fluid_density=1000, dynamic_viscosity="1 cP"
    ...     ),
    ...     4,
    ... )
    0.3596
    """
    velocity = (
        gravity * (particle_density - fluid_density) * particle_diameter**2 / (18.0 * dynamic_viscosity)
    )
    watch(reynolds=_reynolds(velocity, particle_diameter, fluid_density, dynamic_viscosity))
    return velocity


@formula(
    source="allen1900; perry2008, section 6",
    title="Terminal velocity by a power law of drag",
    equation=r"v_t^{2-n} = \frac{4}{3}\frac{g(\rho_p-\rho_f)d_p^{1+n}}{a\,\rho_f^{1-n}\eta^{n}}",
    typical={"drag_exponent": (0.0, 1.0), "drag_factor": (0.4, 26.0)},
)
def terminal_velocity_power_law(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    drag_factor: PositiveNumber,
    drag_exponent: Annotated[Ratio, Within(0.0, 1.0)],
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Velocity:
    """Terminal velocity of a sphere for any drag law of the form C_D = a Re⁻ⁿ.

    Stokes a = 24, n = 1; Allen 18.5, 0.6; Newton 0.44, 0; and the five rows of the course's table III.2.
    Differs from the print: that table gives U_lim without the fluid density to the power −(1 − n)/(2 − n), so
    its numbers hold for no liquid in SI units except in the Stokes row; the last row writes 5.40 √(Δρ d) for
    5.45 √(Δρ d/ρ_f).

    >>> round(
    ...     terminal_velocity_power_law(
    ...         particle_diameter="10 mm",
    ...         particle_density=2650,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...         drag_factor=0.44,
    ...         drag_exponent=0.0,
    ...     ),
    ...     3,
    ... )
    0.7
    """
    n, d, rho, eta = drag_exponent, particle_diameter, fluid_density, dynamic_viscosity
    excess = jnp.asarray(particle_density - rho, dtype=float)
    heavy = excess != 0.0
    weight = jnp.where(heavy, abs(excess), 1.0)
    power = 4.0 / 3.0 * gravity * weight * d ** (1.0 + n) / (drag_factor * rho ** (1.0 - n) * eta**n)
    return jnp.where(heavy, jnp.sign(excess) * power ** (1.0 / (2.0 - n)), 0.0)


@formula(
    source="allen1900; perry2008, section 6",
    equation=r"v_t^{1.4} = \frac{4}{3}\frac{g(\rho_p-\rho_f)d_p^{1.6}}{18.5\,\rho_f^{0.4}\eta^{0.6}}",
    fitted={"reynolds": (0.2, 1000.0)},
)
def terminal_velocity_allen(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Velocity:
    """Terminal velocity of a sphere in the intermediate regime with Allen's drag.

    >>> round(
    ...     1000
    ...     * terminal_velocity_allen(
    ...         particle_diameter="500 um",
    ...         particle_density=2650,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     1,
    ... )
    70.2
    """
    velocity = terminal_velocity_power_law(
        particle_diameter, particle_density, fluid_density, dynamic_viscosity, 18.5, 0.6, gravity
    )
    watch(reynolds=_reynolds(velocity, particle_diameter, fluid_density, dynamic_viscosity))
    return velocity


@formula(
    source="newton1687; perry2008, section 6",
    equation=r"v_t = \sqrt{\frac{4}{3\cdot0.44}\frac{g(\rho_p-\rho_f)d_p}{\rho_f}}" + reynolds_of("v_t"),
    fitted={"reynolds": (500.0, 2e5)},
)
def terminal_velocity_newton(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Velocity:
    """Terminal velocity of a sphere in the turbulent regime with Newton's constant drag.

    Differs from the print: the course writes the factor 4/(3·0.44) = 3.03 as 3 and once ρ_f as ρ_f^1.44.

    >>> round(
    ...     terminal_velocity_newton(
    ...         particle_diameter="10 mm", particle_density=2650, fluid_density=1000, dynamic_viscosity="1 cP"
    ...     ),
    ...     3,
    ... )
    0.7
    """
    velocity = terminal_velocity_power_law(
        particle_diameter, particle_density, fluid_density, dynamic_viscosity, 0.44, 0.0, gravity
    )
    watch(reynolds=_reynolds(velocity, particle_diameter, fluid_density, dynamic_viscosity))
    return velocity


def _from_reynolds(Re: Any, d: Any, rho_p: Any, rho: Any, eta: Any) -> Any:
    return jnp.sign(jnp.asarray(rho_p - rho, dtype=float)) * Re * eta / (rho * d)


@formula(
    source="khan1987",
    equation=r"\mathrm{Re} = \left(2.33\,\mathrm{Ar}^{0.018} - 1.53\,\mathrm{Ar}^{-0.016}\right)^{13.3}"
    + velocity_of("v_t")
    + ARCHIMEDES,
    fitted={"reynolds": (0.01, 3e5)},
)
def terminal_velocity_khan_richardson(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Velocity:
    """Terminal velocity of a sphere, explicit in the Archimedes number, by Khan and Richardson.

    >>> round(
    ...     terminal_velocity_khan_richardson(
    ...         particle_diameter="1 mm", particle_density=2650, fluid_density=1000, dynamic_viscosity="1 cP"
    ...     ),
    ...     3,
    ... )
    0.159
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Ar = _archimedes(d, particle_density, rho, eta, gravity)
    base = 2.33 * Ar**0.018 - 1.53 * Ar**-0.016
    possible = base > 0.0
    Re = jnp.where(possible, jnp.where(possible, base, 1.0) ** 13.3, 0.0)
    watch(reynolds=Re)
    return _from_reynolds(Re, d, particle_density, rho, eta)


@formula(
    source="brown2003",
    equation=(
        r"u_* = \left[\left(\frac{18}{d_*^2}\right)^{0.898\frac{0.936 d_*+1}{d_*+1}} + "
        r"\left(\frac{0.317}{d_*}\right)^{0.449}\right]^{-1.114},\quad d_* = \mathrm{Ar}^{1/3},\ u_* = "
        r"\mathrm{Re}\,\mathrm{Ar}^{-1/3}"
    )
    + velocity_of("v_t")
    + ARCHIMEDES,
    fitted={"reynolds": (0.0, 4000.0)},
)
def terminal_velocity_brown_lawler(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Velocity:
    """Terminal velocity of a sphere, explicit in the dimensionless diameter, by Brown and Lawler.

    >>> round(
    ...     terminal_velocity_brown_lawler(
    ...         particle_diameter="1 mm", particle_density=2650, fluid_density=1000, dynamic_viscosity="1 cP"
    ...     ),
    ...     3,
    ... )
    0.162
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    size = jnp.cbrt(_archimedes(d, particle_density, rho, eta, gravity))
    slow = (18.0 / size**2) ** (0.898 * (0.936 * size + 1.0) / (size + 1.0))
    Re = size * (slow + (0.317 / size) ** 0.449) ** -1.114
    watch(reynolds=Re)
    return _from_reynolds(Re, d, particle_density, rho, eta)


@formula(
    source="haider1989",
    equation=r"u_* = \left[\frac{18}{d_*^2} + \frac{2.3348 - 1.7439\psi}{d_*^{0.5}}\right]^{-1}"
    + SIZE_AND_VELOCITY
    + velocity_of("v_t")
    + ARCHIMEDES,
    fitted={"sphericity": (0.5, 1.0)},
)
def terminal_velocity_haider_levenspiel(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Velocity:
    """Terminal velocity of a particle of any sphericity above one half, explicit, by Haider and Levenspiel.

    >>> round(
    ...     terminal_velocity_haider_levenspiel(
    ...         particle_diameter="1 mm",
    ...         particle_density=2650,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...         sphericity=0.8,
    ...     ),
    ...     3,
    ... )
    0.118
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    size = jnp.cbrt(_archimedes(d, particle_density, rho, eta, gravity))
    Re = size / (18.0 / size**2 + (2.3348 - 1.7439 * sphericity) / jnp.sqrt(size))
    return _from_reynolds(Re, d, particle_density, rho, eta)


@formula(
    source="turton1987",
    equation=(
        r"u_* = \left[\left(\frac{18}{d_*^2}\right)^{0.824} + "
        r"\left(\frac{0.321}{d_*}\right)^{0.412}\right]^{-1.214}"
    )
    + SIZE_AND_VELOCITY
    + velocity_of("v_t")
    + ARCHIMEDES,
    fitted={"reynolds": (0.0, 2.6e5)},
)
def terminal_velocity_turton_clark(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Velocity:
    """Terminal velocity of a sphere, explicit in the dimensionless diameter, by Turton and Clark.

    >>> round(
    ...     terminal_velocity_turton_clark(
    ...         particle_diameter="1 mm", particle_density=2650, fluid_density=1000, dynamic_viscosity="1 cP"
    ...     ),
    ...     3,
    ... )
    0.161
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    size = jnp.cbrt(_archimedes(d, particle_density, rho, eta, gravity))
    Re = size * ((18.0 / size**2) ** 0.824 + (0.321 / size) ** 0.412) ** -1.214
    watch(reynolds=Re)
    return _from_reynolds(Re, d, particle_density, rho, eta)


@formula(
    source="zigrang1981",
    equation=r"\mathrm{Re} = \left(\sqrt{14.51 + 1.83\sqrt{\mathrm{Ar}}} - 3.81\right)^2"
    + velocity_of("v_t")
    + ARCHIMEDES,
    fitted={"reynolds": (0.0, 1e5)},
)
def terminal_velocity_zigrang_sylvester(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Velocity:
    """Terminal velocity of a sphere, explicit in the Archimedes number, by Zigrang and Sylvester.

    The two constants do not cancel exactly, which spoils it for very small particles (Ar below 1e-2).

    >>> round(
    ...     terminal_velocity_zigrang_sylvester(
    ...         particle_diameter="1 mm", particle_density=2650, fluid_density=1000, dynamic_viscosity="1 cP"
    ...     ),
    ...     3,
    ... )
    0.142
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Re = (jnp.sqrt(14.51 + 1.83 * jnp.sqrt(_archimedes(d, particle_density, rho, eta, gravity))) - 3.81) ** 2
    watch(reynolds=Re)
    return _from_reynolds(Re, d, particle_density, rho, eta)


@formula(
    source="ferguson2004, eq. 4",
    equation=(
        r"v_t = \frac{R g d_p^2}{C_1\nu + \sqrt{0.75\,C_2 R g d_p^3}},\quad R = "
        r"\frac{\rho_p-\rho_f}{\rho_f},\quad \nu = \frac{\eta}{\rho_f}"
    ),
    typical={"newton_drag": (0.4, 1.2)},
)
def terminal_velocity_ferguson_church(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    newton_drag: PositiveNumber = 1.0,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Velocity:
    """Terminal velocity of sediment grains by Ferguson and Church.

    The drag at high Reynolds number is 0.4 for smooth spheres, 1.0 for natural sand by sieve diameter,
    1.2 for angular grains; Stokes' constant is 18.

    >>> round(
    ...     1000
    ...     * terminal_velocity_ferguson_church(
    ...         particle_diameter="1 mm", particle_density=2650, fluid_density=1000, dynamic_viscosity="1 cP"
    ...     ),
    ...     0,
    ... )
    126.0
    """
    d = particle_diameter
    R = jnp.asarray((particle_density - fluid_density) / fluid_density, dtype=float)
    root = jnp.sqrt(jnp.maximum(0.75 * newton_drag * abs(R) * gravity * d**3, 1e-60))
    return R * gravity * d**2 / (18.0 * dynamic_viscosity / fluid_density + root)
