"""What a single fiber catches, and what a filter takes out of particulate matter by ISO 16890."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Fraction,
    Length,
    OpenFraction,
    PositiveNumber,
    Speed,
    Temperature,
    Within,
)
from granum.particles.formulas.slip import brownian_diffusivity

# ISO 16890-1, recalled: median diameter in m, geometric standard deviation, share by volume of two modes
URBAN = ((0.3e-6, 1.8, 0.45), (10e-6, 3.1, 0.55))
RURAL = ((0.25e-6, 2.2, 0.18), (11e-6, 4.0, 0.82))
FINEST = 0.3e-6
POINTS = 201
LARGE = 0.4  # of particle to fiber, from where the inertial term grows no more
FULL = 2.0


@formula(
    source="lee1982; hinds1999, chapter 9",
    equation=(
        r"E = 1 - (1 - E_D)(1 - E_R)(1 - E_I),\quad E_D = 1.6\left(\frac{1-\beta}{Ku}\right)^{1/3}"
        r"\left(\frac{D(T, \eta, C_c)}{U d_f}\right)^{2/3},\quad "
        r"E_R = 0.6\,\frac{1-\beta}{Ku}\,\frac{R^2}{1+R},\quad "
        r"E_I = \frac{J}{(2 Ku)^2}\,\frac{\rho_p d_p^2 C_c U}{18\,\eta\,d_f},\quad R = \frac{d_p}{d_f}"
    ),
    output="fiber_efficiency",
    title="Efficiency of a single fiber (Lee and Liu)",
    typical={
        "particle_diameter": (3e-8, 1e-6),
        "fiber_diameter": (5e-7, 2e-5),
        "fiber_fraction": (0.01, 0.15),
        "superficial_velocity": (0.01, 0.5),
        "dynamic_viscosity": (1.7e-5, 2e-5),
        "temperature": (280.0, 320.0),
        "slip_factor": (1.0, 3.0),
        "particle_density": (900.0, 2700.0),
    },
    fitted={"fiber_fraction": (0.0086, 0.151)},
)
def fiber_efficiency_lee_liu(
    particle_diameter: Annotated[Length, Within(1e-9, 1e-3)],
    fiber_diameter: Annotated[Length, Within(1e-9, 1e-2)],
    fiber_fraction: Annotated[OpenFraction, Within(1e-4, 0.4)],
    superficial_velocity: Annotated[Speed, Within(1e-6, 1e2)],
    dynamic_viscosity: Annotated[DynamicViscosity, Within(1e-6, 1e-3)],
    temperature: Temperature,
    particle_density: Density = 1000.0,
    slip_factor: Annotated[PositiveNumber, Within(1.0, 1e3)] = 1.0,
) -> Fraction:
    """Share of the particles in the way of a fiber that it catches by diffusion, interception and inertia, in
    a mat where fibers hinder one another as Kuwabara has it.

    Between diffusion, which catches the finest, and the others lies the size that passes most. Uncharged:
    electret media catch more while they are new. J is (29.6 − 28 β^0.62) R² − 27.5 R^2.8, and 2 where the
    particle has more than 0.4 of the fiber's diameter; Ku is −ln β/2 − 3/4 + β − β²/4. Sources and range
    recalled; the terms of Kuwabara and of inertia as another program has them. Other books have twice this
    inertia: paths of particles in Kuwabara's flow, integrated in the tests, catch within a half of the whole
    given here.

    By hand, a particle almost without mass: 0.6·0.95/0.7973·0.25/1.5 = 0.119 by touching, 0.004 by diffusion.

    >>> round(fiber_efficiency_lee_liu("1 um", "2 um", 0.05, "10 cm/s", 1.8e-5, "20 degC", 1.0), 3)
    0.123
    """
    b = fiber_fraction
    Ku = -0.5 * jnp.log(b) - 0.75 + b - 0.25 * b**2
    R = particle_diameter / fiber_diameter
    D = brownian_diffusivity.function(particle_diameter, temperature, dynamic_viscosity, slip_factor)
    free = (1.0 - b) / Ku
    diffusing = 1.6 * jnp.cbrt(free) * (D / (superficial_velocity * fiber_diameter)) ** (2.0 / 3.0)
    touching = 0.6 * free * R**2 / (1.0 + R)
    small = jnp.minimum(R, LARGE)
    J = jnp.where(R < LARGE, (29.6 - 28.0 * b**0.62) * small**2 - 27.5 * small**2.8, FULL)
    stokes = (
        particle_density
        * particle_diameter**2
        * slip_factor
        * superficial_velocity
        / (18.0 * dynamic_viscosity * fiber_diameter)
    )
    running = jnp.maximum(J, 0.0) * stokes / (4.0 * Ku**2)
    passes = jnp.ones_like(R)
    for caught in (diffusing, touching, running):
        passes = passes * (1.0 - jnp.clip(caught, 0.0, 1.0))
    return 1.0 - passes


def _density(modes: Any, diameter: Any) -> Any:
    """Volume per logarithm of the diameter, of two modes."""
    total = jnp.zeros_like(diameter)
    for middle, spread, share in modes:
        width = jnp.log(spread)
        total = total + share / width * jnp.exp(-0.5 * (jnp.log(diameter / middle) / width) ** 2)
    return total


def particulate_efficiency(caught: Callable[[Any], Any], size: float, modes: Any) -> Any:
    """Share by volume that a filter takes out of particulate matter from 0.3 µm up to a size (ISO 16890), of
    what it catches of each size.
    """
    sizes = jnp.geomspace(FINEST, size, POINTS)
    weight = _density(modes, sizes).at[jnp.array([0, -1])].multiply(0.5)
    return jnp.sum(weight * caught(sizes)) / jnp.sum(weight)
