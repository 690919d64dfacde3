"""Settling slurries in level pipes: velocity at which a bed comes to rest, and pressure gradient."""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.conveying.formulas.pipes import pressure_gradient_pipe
from granum.core import formula, impossible
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Length,
    PositiveNumber,
    PressureGradient,
    Speed,
    VolumeFraction,
    Within,
)

MILLIMETER = 1e-3
DURAND = 81.0
LIGHTER = "These laws are for solids heavier than the liquid."
_PIPE = {
    "velocity": (1.5, 5.0),
    "diameter": (0.1, 0.6),
    "particle_diameter": (1e-4, 2e-3),
    "particle_density": (1500.0, 4000.0),
    "liquid_density": (950.0, 1100.0),
    "solids_volume_fraction": (0.05, 0.3),
}


def _typical(*names: str) -> dict[str, tuple[float, float]]:
    return {name: _PIPE[name] for name in names}


def submerged(particle_density: Any, liquid_density: Any) -> Any:
    """Density of a solid over that of the liquid, less one; no value for a lighter one."""
    excess = particle_density / liquid_density - 1.0
    impossible(excess <= 0.0, particle_density, "particle_density", liquid_density, jnp.inf, LIGHTER)
    return jnp.where(excess > 0.0, excess, jnp.nan)


@formula(
    source="durand1952",
    equation=r"v_D = F_L\,\sqrt{2\,g\,D\left(\frac{\rho_p}{\rho_l} - 1\right)}",
    typical=_typical("diameter", "particle_density", "liquid_density") | {"deposit_froude": (0.8, 1.5)},
)
def deposition_velocity_durand(
    diameter: Length,
    particle_density: Density,
    liquid_density: Density,
    deposit_froude: PositiveNumber = 1.34,
) -> Speed:
    """Velocity of a slurry in a level pipe below which solid rests on its bottom by Durand and Condolios.

    The factor is 1.34 for gravel, a little more for medium sand at high concentration, and near 1 for fine
    sand.

    By hand: 1.34·√(2·9.80665·0.2·1.65).

    >>> round(deposition_velocity_durand("0.2 m", 2650.0, 1000.0), 2)
    3.41
    """
    excess = submerged(particle_density, liquid_density)
    return deposit_froude * jnp.sqrt(2.0 * STANDARD_GRAVITY * diameter * excess)


@formula(
    source="wasp1977",
    equation=(
        r"v_D = 3.116\,\varphi^{0.186}\left(\frac{d_p}{D}\right)^{1/6}"
        r"\sqrt{2\,g\,D\left(\frac{\rho_p}{\rho_l} - 1\right)}"
    ),
    typical=_typical(
        "diameter", "particle_diameter", "solids_volume_fraction", "particle_density", "liquid_density"
    ),
)
def deposition_velocity_wasp(
    diameter: Length,
    particle_diameter: Length,
    solids_volume_fraction: VolumeFraction,
    particle_density: Density,
    liquid_density: Density,
) -> Speed:
    """Velocity of a slurry in a level pipe below which solid rests on its bottom by Wasp and others.

    Constants recalled, not opened.

    By hand: 3.116·0.1^0.186·(0.001)^(1/6)·2.544.

    >>> round(deposition_velocity_wasp("0.2 m", "0.2 mm", 0.1, 2650.0, 1000.0), 2)
    1.63
    """
    excess = submerged(particle_density, liquid_density)
    spread = jnp.where(solids_volume_fraction > 0.0, solids_volume_fraction, 1.0) ** 0.186
    spread = jnp.where(solids_volume_fraction > 0.0, spread, 0.0)
    size = (particle_diameter / diameter) ** (1.0 / 6.0)
    return 3.116 * spread * size * jnp.sqrt(2.0 * STANDARD_GRAVITY * diameter * excess)


@formula(
    source="wilson2006, ch. 5",
    equation=(
        r"v_D = \frac{8.8\left[\frac{\mu_s}{0.66}\left(\frac{\rho_p}{\rho_l} - 1\right)\right]^{0.55}"
        r"D^{0.7}\,d^{1.75}}{d^2 + 0.11\,D^{0.7}},\quad d = \frac{d_p}{1\ \mathrm{mm}}"
    ),
    typical=_typical("diameter", "particle_diameter", "particle_density", "liquid_density")
    | {"sliding_friction": (0.35, 0.5)},
)
def deposition_velocity_wilson(
    diameter: Length,
    particle_diameter: Length,
    particle_density: Density,
    liquid_density: Density,
    sliding_friction: PositiveNumber = 0.4,
) -> Speed:
    """Velocity of a slurry in a level pipe below which a bed of it comes to rest by Wilson: the fit to his
    chart, largest over the concentrations.

    Constants recalled, not opened; the pipe counts in m. At the size that settles first it is what Durand's
    factor of 1.3 says.

    >>> 5.0 < deposition_velocity_wilson("0.5 m", "0.7 mm", 2650.0, 1000.0) < 5.5
    True
    """
    d, pipe = particle_diameter / MILLIMETER, diameter**0.7
    heavy = (sliding_friction * submerged(particle_density, liquid_density) / 0.66) ** 0.55
    return 8.8 * heavy * pipe * d**1.75 / (d**2 + 0.11 * pipe)


@formula(
    source="durand1952",
    equation=(
        r"\frac{\Delta p}{L} = \left.\frac{\Delta p}{L}\right|_l\left(1 + 81\,\varphi\,\psi^{-1.5}\right),"
        r"\quad \psi = \frac{v^2\sqrt{C_D}}{g\,D\,(\rho_p/\rho_l - 1)},\quad "
        r"\left.\frac{\Delta p}{L}\right|_l = f\left(\frac{v\,D\,\rho_l}{\eta}, \frac kD\right)"
        r"\frac{\rho_l v^2}{2\,D}"
    ),
    typical=_typical("velocity", "diameter", "solids_volume_fraction", "particle_density", "liquid_density")
    | {"dynamic_viscosity": (5e-4, 2e-3), "drag_coefficient": (0.4, 10.0), "pipe_roughness": (1e-5, 1e-4)},
    fitted={"diameter": (0.04, 0.58)},
    title="Pressure gradient of a settling slurry (Durand and Condolios)",
)
def pressure_gradient_slurry_durand(
    velocity: Speed,
    diameter: Length,
    solids_volume_fraction: VolumeFraction,
    particle_density: Density,
    liquid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    drag_coefficient: PositiveNumber,
    pipe_roughness: Length = 5e-5,
) -> PressureGradient:
    """Pressure that a settling slurry loses per length of level pipe; the viscosity is that of the liquid,
    the drag coefficient that of a grain that falls alone.

    Drawn from sand and gravel, above deposition. With sand in water the print has 180 for 81 times the excess
    density to 1.5.

    >>> round(81 * 1.65**1.5)
    172
    """
    alone = pressure_gradient_pipe.function(
        velocity, diameter, liquid_density, dynamic_viscosity, pipe_roughness
    )
    return alone * (
        1.0
        + excess_durand(
            velocity, diameter, solids_volume_fraction, particle_density, liquid_density, drag_coefficient
        )
    )


def excess_durand(
    velocity: Any, diameter: Any, share: Any, particle_density: Any, liquid_density: Any, drag: Any
) -> Any:
    """Gradient of a slurry beyond that of its liquid, over it."""
    excess = submerged(particle_density, liquid_density)
    lifted = jnp.maximum(velocity, 1e-6) ** 2 * jnp.sqrt(drag)
    return DURAND * share * (STANDARD_GRAVITY * diameter * excess / lifted) ** 1.5


@formula(
    source="wilson2006, ch. 6",
    equation=(
        r"\frac{\Delta p}{L} = \left.\frac{\Delta p}{L}\right|_l + 0.44\,\varphi\,(\rho_p - \rho_l)\,g\,"
        r"\min\left(\frac12\left(\frac{v}{v_{50}}\right)^{-M},\ 1\right),\quad v_{50} = 3.93\,d^{0.35}"
        r"\left(\frac{\rho_p/\rho_l - 1}{1.65}\right)^{0.45},\ d = \frac{d_p}{1\ \mathrm{mm}},\ "
        r"\left.\frac{\Delta p}{L}\right|_l = f\left(\frac{v\,D\,\rho_l}{\eta}, \frac kD\right)"
        r"\frac{\rho_l v^2}{2\,D}"
    ),
    typical=_typical(
        "velocity",
        "diameter",
        "particle_diameter",
        "solids_volume_fraction",
        "particle_density",
        "liquid_density",
    )
    | {
        "dynamic_viscosity": (5e-4, 2e-3),
        "stratification_exponent": (0.25, 1.7),
        "pipe_roughness": (1e-5, 1e-4),
    },
    title="Pressure gradient of a settling slurry (Wilson)",
)
def pressure_gradient_slurry_wilson(
    velocity: Speed,
    diameter: Length,
    particle_diameter: Length,
    solids_volume_fraction: VolumeFraction,
    particle_density: Density,
    liquid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    stratification_exponent: Annotated[PositiveNumber, Within(0.25, 1.7)] = 1.7,
    pipe_roughness: Length = 5e-5,
) -> PressureGradient:
    """Pressure that a partly stratified slurry in water loses per length of level pipe by Wilson and others;
    the viscosity is that of the liquid.

    The exponent is 1.7 for narrow gradings, 1/ln(d85/d50) for wider ones, 0.25 at least. No more than all of
    the solid can lean on the wall, where the print goes on growing. Constants recalled, not opened.

    By hand: at v50 half of the solid does, 0.22·0.1·1650·9.80665.

    >>> speed = 3.93 * 0.5**0.35
    >>> alone = pressure_gradient_pipe(speed, "0.2 m", 1000.0, 1e-3)
    >>> round(pressure_gradient_slurry_wilson(speed, "0.2 m", "0.5 mm", 0.1, 2650.0, 1000.0, 1e-3) - alone, 1)
    356.0
    """
    excess = submerged(particle_density, liquid_density)
    half = 3.93 * (particle_diameter / MILLIMETER) ** 0.35 * (excess / 1.65) ** 0.45
    alone = pressure_gradient_pipe.function(
        velocity, diameter, liquid_density, dynamic_viscosity, pipe_roughness
    )
    weight = solids_volume_fraction * excess * liquid_density * STANDARD_GRAVITY
    slower = (half / jnp.maximum(velocity, 1e-6)) ** stratification_exponent
    return alone + 0.44 * weight * jnp.minimum(0.5 * slower, 1.0)
