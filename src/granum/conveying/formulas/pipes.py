"""Friction of a fluid alone in a pipe."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Length,
    PositiveNumber,
    PressureGradient,
    Ratio,
    Speed,
    Within,
)

LEAST = 1e-6  # Reynolds number
Roughness = Annotated[Ratio, Within(0.0, 0.1)]


@formula(
    source="churchill1977",
    equation=(
        r"f = 8\left[\left(\frac{8}{\mathrm{Re}}\right)^{12} + (A + B)^{-1.5}\right]^{1/12},\quad "
        r"A = \left[2.457\,\ln\frac{1}{(7/\mathrm{Re})^{0.9} + 0.27\,k/D}\right]^{16},\ "
        r"B = \left(\frac{37530}{\mathrm{Re}}\right)^{16}"
    ),
    typical={"reynolds": (1e4, 1e6), "relative_roughness": (1e-5, 1e-3)},
)
def friction_factor_churchill(reynolds: Ratio, relative_roughness: Roughness = 0.0) -> PositiveNumber:
    """Friction factor of a pipe after Darcy by Churchill: laminar, turbulent and between in one equation.

    Four times the factor after Fanning. Laminar flow is 64/Re.

    >>> round(friction_factor_churchill(100.0), 3)
    0.64
    """
    re = jnp.maximum(reynolds, LEAST)
    rough = (7.0 / re) ** 0.9 + 0.27 * relative_roughness
    # A falls to nothing where the logarithm changes sign, at Reynolds numbers of a few
    a = (2.457 * jnp.log(1.0 / jnp.minimum(rough, 1.0))) ** 16
    # both terms over (8/Re)^12, so that no power overflows
    turbulent = (a + (37530.0 / re) ** 16) * (8.0 / re) ** 8
    return 64.0 / re * (1.0 + turbulent**-1.5) ** (1.0 / 12.0)


@formula(
    source="churchill1977",
    equation=(
        r"\frac{\Delta p}{L} = f\,\frac{\rho_f v^2}{2\,D},\quad "
        r"f = f\left(\frac{v\,D\,\rho_f}{\eta}, \frac kD\right)"
    ),
    typical={
        "velocity": (1.0, 30.0),
        "diameter": (0.05, 0.5),
        "fluid_density": (1.0, 1000.0),
        "dynamic_viscosity": (1.8e-5, 1e-3),
        "pipe_roughness": (1e-5, 1e-4),
    },
    title="Pressure gradient of a fluid in a pipe (Darcy–Weisbach)",
)
def pressure_gradient_pipe(
    velocity: Speed,
    diameter: Length,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    pipe_roughness: Length = 5e-5,
) -> PressureGradient:
    """Pressure that a fluid loses per length of pipe, with Churchill's friction factor.

    By hand: laminar, 32·η·v/D².

    >>> round(pressure_gradient_pipe("1 mm/s", "10 mm", 1000.0, 1e-3), 3)
    0.32
    """
    reynolds = velocity * diameter * fluid_density / dynamic_viscosity
    rough = jnp.minimum(pipe_roughness / diameter, 0.1)
    factor = friction_factor_churchill.function(reynolds, rough)
    return factor * fluid_density * velocity**2 / (2.0 * diameter)
