"""Unsteady fall in a fluid at rest: closed forms for Stokes and Newton drag, quadrature for any other.

The inertia is that of the particle plus ``added_mass_coefficient`` times that of the displaced fluid: zero in
the courses, one half for a sphere in a liquid. The history force is left out. Velocities and distances are
positive downwards.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, limit_active, unconverged, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Density,
    Distance,
    DynamicViscosity,
    Length,
    OpenFraction,
    Position,
    Ratio,
    Speed,
    Time,
    Velocity,
)
from granum.numerics import gauss_legendre
from granum.particles.definitions import reynolds_of
from granum.particles.falling import EQUAL_DENSITIES, LEAST, reynolds_from_size
from granum.particles.formulas.drag_modern import drag_coefficient_brown_lawler
from granum.particles.formulas.terminal import Drag

NODES = 48


@formula(
    source="clift1978, chapter 11",
    equation=r"\tau = \frac{(\rho_p + C_A\rho_f)d_p^2}{18\eta}",
    typical={"added_mass_coefficient": (0.0, 0.5)},
)
def relaxation_time(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    added_mass_coefficient: Ratio = 0.0,
) -> Time:
    """Relaxation time of a particle in creeping flow: after it, 63 % of the terminal velocity is reached.

    >>> round(
    ...     1e6
    ...     * relaxation_time(
    ...         particle_diameter="10 um", particle_density=2650, fluid_density=1000, dynamic_viscosity="1 cP"
    ...     ),
    ...     2,
    ... )
    14.72
    """
    return (
        (particle_density + added_mass_coefficient * fluid_density)
        * particle_diameter**2
        / (18.0 * dynamic_viscosity)
    )


class FallState(NamedTuple):
    """Where a falling particle is at a time."""

    velocity: Velocity
    fall_distance: Position


@formula(
    source="clift1978, chapter 11; clift1978, eq. 3-40",
    equation=(
        r"v = v_t + (v_0 - v_t)e^{-t/\tau},\quad z = v_t t + (v_0 - v_t)\tau\left(1 - "
        r"e^{-t/\tau}\right),\quad v_t = \frac{g\,(\rho_p-\rho_f)\,d_p^2}{18\,\eta},\ \tau = "
        r"\frac{(\rho_p + C_A\rho_f)\,d_p^2}{18\,\eta}"
    ),
    fitted={"reynolds": (0.0, 0.2)},
    typical={"time": (1e-4, 1e-2), "initial_velocity": (0.0, 0.1), "added_mass_coefficient": (0.0, 0.5)},
)
def fall_stokes(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    time: Time,
    initial_velocity: Velocity = 0.0,
    gravity: Acceleration = STANDARD_GRAVITY,
    added_mass_coefficient: Ratio = 0.0,
) -> FallState:
    """Velocity and distance of a particle in creeping flow after a time.

    Stokes' law, whose drag is 4 % too low at a Reynolds number of 0.2 (Oseen).

    >>> found = fall_stokes(
    ...     particle_diameter="60 um",
    ...     particle_density=2000,
    ...     fluid_density=1000,
    ...     dynamic_viscosity="1 cP",
    ...     time=4e-4,
    ...     gravity=10.0,
    ... )
    >>> round(found.velocity / (10.0 * 1000 * 60e-6**2 / 18e-3), 4)
    0.6321
    """
    tau = relaxation_time(
        particle_diameter, particle_density, fluid_density, dynamic_viscosity, added_mass_coefficient
    )
    terminal = (
        gravity * (particle_density - fluid_density) * particle_diameter**2 / (18.0 * dynamic_viscosity)
    )
    approach = -jnp.expm1(-time / tau)
    velocity = initial_velocity + (terminal - initial_velocity) * approach
    watch(
        reynolds=jnp.maximum(abs(initial_velocity), abs(terminal))
        * particle_diameter
        * fluid_density
        / dynamic_viscosity
    )
    return FallState(velocity, terminal * time + (initial_velocity - terminal) * tau * approach)


@formula(
    source="clift1978, chapter 11; newton1687",
    equation=(
        r"v = v_t\tanh\frac{t}{\tau_N},\quad z = v_t\tau_N\ln\cosh\frac{t}{\tau_N},\quad \tau_N = "
        r"\frac{(\rho_p + C_A\rho_f)\,v_t}{g(\rho_p-\rho_f)},\ v_t = "
        r"\sqrt{\frac{4\,g\,(\rho_p-\rho_f)\,d_p}{3\cdot0.44\,\rho_f}}"
    ),
    typical={"time": (1e-3, 1.0), "added_mass_coefficient": (0.0, 0.5), "particle_diameter": (5e-3, 5e-2)},
)
def fall_newton(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    time: Time,
    gravity: Acceleration = STANDARD_GRAVITY,
    added_mass_coefficient: Ratio = 0.0,
) -> FallState:
    """Velocity and distance of a particle released at rest under Newton's constant drag after a time.

    >>> found = fall_newton(particle_diameter="10 mm", particle_density=2650, fluid_density=1000, time=10.0)
    >>> round(found.velocity, 3)
    0.7
    """
    rho = fluid_density
    excess = jnp.asarray(particle_density - rho, dtype=float)
    heavy = excess != 0.0
    weight = jnp.where(heavy, abs(excess), 1.0)
    speed = jnp.sqrt(4.0 * gravity * weight * particle_diameter / (3.0 * 0.44 * rho))
    tau = (particle_density + added_mass_coefficient * rho) * speed / (gravity * weight)
    x = time / tau
    log_cosh = x + jnp.log1p(jnp.exp(-2.0 * x)) - jnp.log(2.0)
    sign = jnp.where(heavy, jnp.sign(excess), 0.0)
    return FallState(sign * speed * jnp.tanh(x), sign * speed * tau * log_cosh)


class Approach(NamedTuple):
    """Time and distance until the terminal velocity is nearly reached."""

    time: Time
    fall_distance: Position
    velocity: Velocity


@formula(
    source="clift1978, chapter 11; brown2003",
    equation=(
        r"t = \int_{v_0}^{v_1}\frac{\mathrm dv}{a(v)},\ z = \int_{v_0}^{v_1}\frac{v\,\mathrm "
        r"dv}{a(v)},\quad a = \frac{\rho_p-\rho_f}{\rho_p+C_A\rho_f}g\left[1 - "
        r"\frac{v|v|C_D(\mathrm{Re})}{v_t^2C_D(\mathrm{Re}_t)}\right],\ v_1 = v_0 + f(v_t - v_0)"
    )
    + reynolds_of("v"),
    typical={"approach_fraction": (0.5, 0.99), "added_mass_coefficient": (0.0, 0.5)},
)
def approach_to_terminal(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    approach_fraction: OpenFraction = 0.99,
    gravity: Acceleration = STANDARD_GRAVITY,
    drag: Drag = drag_coefficient_brown_lawler,
    added_mass_coefficient: Ratio = 0.0,
) -> Approach:
    """Time and distance from rest until a fraction of the terminal velocity is reached, under any drag
    law.

    With equal densities nothing moves: the velocity is zero, the time has no meaning and is not a number,
    flagged.

    >>> found = approach_to_terminal(
    ...     particle_diameter="20 um",
    ...     particle_density=2000,
    ...     fluid_density=1000,
    ...     dynamic_viscosity="1 cP",
    ...     approach_fraction=0.99,
    ... )
    >>> tau = relaxation_time(
    ...     particle_diameter="20 um", particle_density=2000, fluid_density=1000, dynamic_viscosity="1 cP"
    ... )
    >>> round(found.time / tau, 1)
    4.6
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    excess = jnp.asarray(particle_density - rho, dtype=float)
    heavy = excess != 0.0
    limit_active(~heavy, particle_density, "particle_density", EQUAL_DENSITIES)
    weight = jnp.where(heavy, abs(excess), 1.0)
    X = jnp.maximum(4.0 / 3.0 * rho * weight * gravity * d**3 / eta**2, LEAST)
    Re, found = reynolds_from_size(drag, X)
    drag(Re)
    unconverged(found)
    speed = Re * eta / (rho * d)
    start = gravity * weight / (particle_density + added_mass_coefficient * rho)
    end = -jnp.log1p(-approach_fraction) + 0.0 * Re  # the rule takes its shape from its limits
    steady = drag(Re)

    # s = v/v_t = 1 − e^−u takes the pole of 1/a at the terminal velocity out of the integrals.
    def share(u: Any) -> Any:
        return -jnp.expm1(-u)

    def time_density(u: Any) -> Any:
        s = share(u)
        return jnp.exp(-u) / (1.0 - s**2 * drag(s * Re) / steady)

    time = speed / start * gauss_legendre(time_density, 0.0, end, order=NODES)
    distance = speed**2 / start * gauss_legendre(lambda u: share(u) * time_density(u), 0.0, end, order=NODES)
    sign = jnp.sign(excess)
    return Approach(
        jnp.where(heavy, time, jnp.nan),
        sign * distance,
        sign * jnp.where(heavy, speed, 0.0) * approach_fraction,
    )


@formula(
    source="clift1978, chapter 11; hinds1999, chapter 5",
    equation=(
        r"s = \frac{4(\rho_p + C_A\rho_f)d_p}{3\rho_f}\int_0^{\mathrm{Re}_0}\frac{\mathrm "
        r"d\mathrm{Re}}{\mathrm{Re}\,C_D(\mathrm{Re})},\quad \mathrm{Re}_0 = "
        r"\frac{\rho_f\,v_0\,d_p}{\eta}"
    ),
    typical={"initial_velocity": (0.01, 10.0), "added_mass_coefficient": (0.0, 0.5)},
)
def stopping_distance(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    initial_velocity: Speed,
    drag: Drag = drag_coefficient_brown_lawler,
    added_mass_coefficient: Ratio = 0.0,
) -> Distance:
    """Distance after which a particle shot into a fluid at rest stops, gravity apart; τv₀ in creeping flow.

    The law must tend to Stokes' law at small Reynolds numbers; a constant drag never stops a particle.

    >>> round(
    ...     1e3
    ...     * stopping_distance(
    ...         particle_diameter="1 um",
    ...         particle_density=1000,
    ...         fluid_density=1.2,
    ...         dynamic_viscosity=1.81e-5,
    ...         initial_velocity=0.01,
    ...     ),
    ...     8,
    ... )
    3.067e-05
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Re0 = initial_velocity * d * rho / eta

    def density(w: Any) -> Any:  # Re = e^w − 1 spreads all decades evenly
        Re = jnp.maximum(jnp.expm1(w), LEAST)
        return (Re + 1.0) / (Re * drag(Re))

    integral = gauss_legendre(density, 0.0, jnp.log1p(Re0), order=NODES)
    drag(jnp.maximum(Re0, LEAST))
    return 4.0 * (particle_density + added_mass_coefficient * rho) * d / (3.0 * rho) * integral
