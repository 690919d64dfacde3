"""Paths of a particle in two dimensions, in a fluid at rest or in a steady horizontal stream.

``horizontal_position`` grows with the stream, ``depth`` downwards. Inertia as in ``unsteady``.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax
import jax.numpy as jnp

from granum.core import formula, impossible, unconverged, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Density,
    DynamicViscosity,
    Length,
    Position,
    Ratio,
    Series,
    Time,
    Velocity,
)
from granum.numerics import find_root
from granum.particles.falling import EQUAL_DENSITIES
from granum.particles.formulas.drag_modern import drag_coefficient_brown_lawler
from granum.particles.formulas.terminal import Drag
from granum.particles.paths import Motion


class Path(NamedTuple):
    """A path, point by point."""

    horizontal_position: Annotated[Position, Series("points")]
    depth: Annotated[Position, Series("points")]
    horizontal_velocity: Annotated[Velocity, Series("points")]
    vertical_velocity: Annotated[Velocity, Series("points")]


@formula(
    source="clift1978, chapter 11; stokes1851; clift1978, eq. 3-40",
    equation=r"x = u t + (v_{x0}-u)\tau\left(1-e^{-t/\tau}\right),\quad y = v_t t + (v_{y0}-v_t)\tau\left(1-e^{-t/\tau}\right),\quad"  # noqa: E501
    r"\tau = \frac{(\rho_p+C_A\rho_f)d_p^2}{18\eta}",
    fitted={"reynolds": (0.0, 0.2)},
)
def trajectory_stokes(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    time: Annotated[Time, Series("points")],
    initial_horizontal_velocity: Velocity = 0.0,
    initial_vertical_velocity: Velocity = 0.0,
    stream_velocity: Velocity = 0.0,
    gravity: Acceleration = STANDARD_GRAVITY,
    added_mass_coefficient: Ratio = 0.0,
) -> Path:
    """Path of a particle in creeping flow, closed form, after being shot in any direction into a horizontal
    stream.

    Stokes' law, whose drag is 4 % too low at a Reynolds number of 0.2 (Oseen). Checked at the start and at
    the terminal velocity.

    >>> path = trajectory_stokes(
    ...     particle_diameter="50 um",
    ...     particle_density=2650,
    ...     fluid_density=998,
    ...     dynamic_viscosity="1 cP",
    ...     time=[0.0, 10.0],
    ...     initial_horizontal_velocity="2 mm/s",
    ... )
    >>> round(float(path.horizontal_position[1]) * 1e6, 3)
    0.736
    """
    tau = (
        (particle_density + added_mass_coefficient * fluid_density)
        * particle_diameter**2
        / (18.0 * dynamic_viscosity)
    )
    terminal = (
        gravity * (particle_density - fluid_density) * particle_diameter**2 / (18.0 * dynamic_viscosity)
    )
    left = jnp.exp(-time / tau)
    gone = -jnp.expm1(-time / tau)
    across, down = initial_horizontal_velocity - stream_velocity, initial_vertical_velocity - terminal
    fastest = jnp.maximum(
        jnp.hypot(across, jnp.asarray(initial_vertical_velocity, dtype=float)), abs(terminal)
    )
    watch(reynolds=fastest * particle_diameter * fluid_density / dynamic_viscosity)
    return Path(
        stream_velocity * time + across * tau * gone,
        terminal * time + down * tau * gone,
        stream_velocity + across * left,
        terminal + down * left,
    )


@formula(
    source="clift1978, chapter 11; brown2003",
    equation=(
        r"(\rho_p+C_A\rho_f)\frac{\mathrm d\mathbf v}{\mathrm dt} = (\rho_p-\rho_f)\mathbf g - "
        r"\frac{3}{4}\frac{\rho_f}{d_p}C_D(\mathrm{Re})|\mathbf v-\mathbf u|(\mathbf v-\mathbf u),\quad "
        r"\mathrm{Re} = \frac{\rho_f\,|\mathbf v-\mathbf u|\,d_p}{\eta},\quad \frac{\mathrm d "
        r"x}{\mathrm dt} = U_x,\ \frac{\mathrm d y}{\mathrm dt} = v_y"
    ),
)
def trajectory(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    time: Annotated[Time, Series("points")],
    initial_horizontal_velocity: Velocity = 0.0,
    initial_vertical_velocity: Velocity = 0.0,
    stream_velocity: Velocity = 0.0,
    gravity: Acceleration = STANDARD_GRAVITY,
    drag: Drag = drag_coefficient_brown_lawler,
    added_mass_coefficient: Ratio = 0.0,
) -> Path:
    """Path of a particle under any drag law, shot in any direction into a horizontal stream, at increasing
    times from zero on.

    >>> path = trajectory(
    ...     particle_diameter="1 mm",
    ...     particle_density=2650,
    ...     fluid_density=1000,
    ...     dynamic_viscosity="1 cP",
    ...     time=[0.0, 0.5, 1.0],
    ...     initial_horizontal_velocity=1.0,
    ... )
    >>> round(float(path.vertical_velocity[2]), 3)
    0.157
    """
    motion = Motion.of(
        particle_diameter,
        particle_density,
        fluid_density,
        dynamic_viscosity,
        gravity,
        added_mass_coefficient,
        drag,
        initial_horizontal_velocity,
        initial_vertical_velocity,
        stream_velocity,
    )
    return Path(*jax.vmap(motion.at)(jnp.asarray(time, dtype=float)).T)


class Settled(NamedTuple):
    """Where and when a particle has settled through a height."""

    settling_distance: Position
    time: Time


@formula(
    source="stokes1851; clift1978, chapter 11; clift1978, eq. 3-40",
    equation=r"y(t; d_p, \rho_p, \rho_f, \eta) = H,\quad L = x(t; d_p, \rho_p, \rho_f, \eta)",
    fitted={"reynolds": (0.0, 0.2)},
    typical={"height": (0.05, 1.0), "stream_velocity": (0.0, 0.1), "initial_horizontal_velocity": (0.0, 1.0)},
)
def settling_distance_stokes(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    height: Length,
    initial_horizontal_velocity: Velocity = 0.0,
    stream_velocity: Velocity = 0.0,
    gravity: Acceleration = STANDARD_GRAVITY,
    added_mass_coefficient: Ratio = 0.0,
) -> Settled:
    """Horizontal distance and time in which a particle settles (or rises) through a height in creeping
    flow.

    With equal densities it never does: not a number, flagged. Stokes' law, whose drag is 4 % too low at a
    Reynolds number of 0.2 (Oseen). Checked at the start and at the terminal velocity.

    >>> found = settling_distance_stokes(
    ...     particle_diameter="50 um",
    ...     particle_density=2650,
    ...     fluid_density=1000,
    ...     dynamic_viscosity="1 cP",
    ...     height=2.0,
    ...     stream_velocity=0.01,
    ...     initial_horizontal_velocity=0.01,
    ... )
    >>> round(found.settling_distance, 2)
    8.9
    """
    tau = (
        (particle_density + added_mass_coefficient * fluid_density)
        * particle_diameter**2
        / (18.0 * dynamic_viscosity)
    )
    terminal = (
        gravity * abs(particle_density - fluid_density) * particle_diameter**2 / (18.0 * dynamic_viscosity)
    )
    heavy = terminal > 0.0
    impossible(~heavy, particle_density, "particle_density", reason=EQUAL_DENSITIES)
    ratio = height / (jnp.where(heavy, terminal, 1.0) * tau)
    # t/τ − (1 − e^−t/τ) = h/(v_t τ): between the start's parabola and the late straight line
    root = find_root(
        lambda s: s + jnp.expm1(-s) - ratio,
        0.0,
        ratio + 2.0,
        start=jnp.where(ratio > 2.0, ratio + 1.0, jnp.sqrt(2.0 * ratio)),
    )
    unconverged(root.converged)
    time = root.value * tau
    distance = stream_velocity * time + (initial_horizontal_velocity - stream_velocity) * tau * -jnp.expm1(
        -root.value
    )
    fastest = jnp.maximum(
        abs(jnp.asarray(initial_horizontal_velocity - stream_velocity, dtype=float)), terminal
    )
    watch(reynolds=fastest * particle_diameter * fluid_density / dynamic_viscosity)
    return Settled(jnp.where(heavy, distance, jnp.nan), jnp.where(heavy, time, jnp.nan))


@formula(
    source="clift1978, chapter 11; brown2003",
    equation=r"y(t; d_p, \rho_p, \rho_f, \eta) = H,\quad L = x(t; d_p, \rho_p, \rho_f, \eta)",
    typical={
        "height": (0.05, 0.5),
        "stream_velocity": (0.0, 0.1),
        "initial_horizontal_velocity": (0.0, 0.5),
        "particle_diameter": (5e-5, 1e-3),
    },
)
def settling_distance(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    height: Length,
    initial_horizontal_velocity: Velocity = 0.0,
    initial_vertical_velocity: Velocity = 0.0,
    stream_velocity: Velocity = 0.0,
    gravity: Acceleration = STANDARD_GRAVITY,
    drag: Drag = drag_coefficient_brown_lawler,
    added_mass_coefficient: Ratio = 0.0,
) -> Settled:
    """Horizontal distance and time in which a particle settles (or rises) through a height, under any drag
    law.

    With equal densities it never does: not a number, flagged.

    >>> found = settling_distance(
    ...     particle_diameter="1 mm",
    ...     particle_density=2650,
    ...     fluid_density=1000,
    ...     dynamic_viscosity="1 cP",
    ...     height=1.0,
    ...     stream_velocity=0.1,
    ...     initial_horizontal_velocity=0.1,
    ... )
    >>> round(found.settling_distance, 2)
    0.64
    """

    def one(
        d: Any, rho_p: Any, rho: Any, eta: Any, h: Any, vx: Any, vy: Any, stream: Any, g: Any, added: Any
    ) -> Any:
        motion = Motion.of(d, rho_p, rho, eta, g, added, drag, vx, vy, stream)
        state, time = motion.reaching(h)
        moves = rho_p != rho
        return jnp.where(moves, state[0], jnp.nan), jnp.where(moves, time, jnp.nan)

    impossible(
        particle_density == fluid_density, particle_density, "particle_density", reason=EQUAL_DENSITIES
    )
    distance, time = jnp.vectorize(one)(
        particle_diameter,
        particle_density,
        fluid_density,
        dynamic_viscosity,
        height,
        initial_horizontal_velocity,
        initial_vertical_velocity,
        stream_velocity,
        gravity,
        added_mass_coefficient,
    )
    return Settled(distance, time)
