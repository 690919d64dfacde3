"""Drops and bubbles: internal circulation, deformation, and the velocities of deformed ones. Positive
downwards.
"""

from __future__ import annotations

from typing import Any, NamedTuple

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
    Speed,
    SurfaceTension,
    Velocity,
)
from granum.particles.formulas.terminal_explicit import terminal_velocity_stokes


@formula(
    source="hadamard1911; rybczynski1911; clift1978, eq. 3-15",
    equation=r"H = \frac{3(\eta_D + \eta)}{2\eta + 3\eta_D}",
    typical={"dispersed_viscosity": (1e-5, 1e-1)},
)
def hadamard_factor(
    dispersed_viscosity: DynamicViscosity, dynamic_viscosity: DynamicViscosity
) -> PositiveNumber:
    """Velocity of a fluid sphere over that of a rigid one in creeping flow: 1 for mist, 1.5 for a bubble.

    Circulation inside lowers the drag and so raises the velocity. Differs from the print: the course says the
    velocity falls. Traces of surfactant stop the circulation, and the factor is then 1.

    >>> round(hadamard_factor(dispersed_viscosity=1.8e-5, dynamic_viscosity=1e-3), 2)
    1.49
    """
    inner, outer = dispersed_viscosity, dynamic_viscosity
    return 3.0 * (inner + outer) / (2.0 * outer + 3.0 * inner)


@formula(
    source="hadamard1911; rybczynski1911",
    equation=r"v_t = \frac{g(\rho_p-\rho_f)d_p^2}{18\eta}\,H,\quad H = H(\eta_D/\eta)",
    fitted={"reynolds": (0.0, 0.5)},
    typical={"particle_diameter": (1e-6, 1e-4), "dispersed_viscosity": (1e-5, 1e-1)},
)
def terminal_velocity_hadamard_rybczynski(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    dispersed_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Velocity:
    """Terminal velocity of a clean fluid sphere in creeping flow: Stokes' velocity times Hadamard's factor.

    >>> round(
    ...     1000
    ...     * terminal_velocity_hadamard_rybczynski(
    ...         particle_diameter="50 um",
    ...         particle_density=1.2,
    ...         fluid_density=998,
    ...         dynamic_viscosity="1 cP",
    ...         dispersed_viscosity=1.8e-5,
    ...     ),
    ...     3,
    ... )
    -2.019
    """
    rigid = terminal_velocity_stokes(
        particle_diameter, particle_density, fluid_density, dynamic_viscosity, gravity
    )
    velocity = rigid * hadamard_factor(dispersed_viscosity, dynamic_viscosity)
    watch(reynolds=abs(velocity) * particle_diameter * fluid_density / dynamic_viscosity)
    return velocity


@formula(source="clift1978, p. 26", equation=r"\mathrm{Eo} = \frac{g|\rho_p-\rho_f|d_p^2}{\sigma}")
def eotvos_number(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    surface_tension: SurfaceTension,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Ratio:
    """Eötvös number of a drop or bubble: apparent weight against surface tension. Spherical below 0.4.

    >>> round(
    ...     eotvos_number(
    ...         particle_diameter="1 mm", particle_density=1.2, fluid_density=998, surface_tension="72.8 mN/m"
    ...     ),
    ...     4,
    ... )
    0.1343
    """
    return gravity * abs(particle_density - fluid_density) * particle_diameter**2 / surface_tension


@formula(source="clift1978, p. 26", equation=r"\mathrm{M} = \frac{g\eta^4|\rho_p-\rho_f|}{\rho_f^2\sigma^3}")
def morton_number(
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    surface_tension: SurfaceTension,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Ratio:
    """Morton number of a drop or bubble in a liquid, a property of the pair alone.

    >>> round(
    ...     1e11
    ...     * morton_number(
    ...         particle_density=1.2, fluid_density=998, dynamic_viscosity="1 cP", surface_tension="72.8 mN/m"
    ...     ),
    ...     2,
    ... )
    2.54
    """
    return (
        gravity
        * dynamic_viscosity**4
        * abs(particle_density - fluid_density)
        / (fluid_density**2 * surface_tension**3)
    )


@formula(source="clift1978, p. 26", equation=r"\mathrm{We} = \frac{\rho_f v^2 d_p}{\sigma}")
def weber_number(
    particle_diameter: Length, velocity: Speed, fluid_density: Density, surface_tension: SurfaceTension
) -> Ratio:
    """Weber number of a drop or bubble: inertia of the fluid against surface tension.

    >>> round(
    ...     weber_number(
    ...         particle_diameter="2 mm", velocity=0.25, fluid_density=998, surface_tension="72.8 mN/m"
    ...     ),
    ...     3,
    ... )
    1.714
    """
    return fluid_density * velocity**2 * particle_diameter / surface_tension


@formula(
    source="clift1978, chapter 2",
    equation=r"d_{max} = \sqrt{\frac{\mathrm{Eo}_{lim}\,\sigma}{g|\rho_p-\rho_f|}}",
    typical={"eotvos_limit": (0.2, 1.0)},
)
def spherical_diameter_limit(
    particle_density: Density,
    fluid_density: Density,
    surface_tension: SurfaceTension,
    eotvos_limit: PositiveNumber = 0.4,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Length:
    """Largest drop or bubble that stays a sphere: about 1 to 2 mm for air in water. Infinite at equal
    densities.

    >>> round(
    ...     1000
    ...     * spherical_diameter_limit(particle_density=1.2, fluid_density=998, surface_tension="72.8 mN/m"),
    ...     2,
    ... )
    1.73
    """
    weight = gravity * abs(particle_density - fluid_density)
    heavy = weight > 0.0
    return jnp.where(heavy, jnp.sqrt(eotvos_limit * surface_tension / jnp.where(heavy, weight, 1.0)), jnp.inf)


@formula(
    source="clift1978, chapter 12; grace1978", equation=r"d_{max} = 4\sqrt{\frac{\sigma}{g|\rho_p-\rho_f|}}"
)
def stable_diameter_limit(
    particle_density: Density,
    fluid_density: Density,
    surface_tension: SurfaceTension,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Length:
    """Largest drop that can fall or rise through a fluid without breaking, Eötvös number 16. Infinite at
    equal densities.

    >>> round(
    ...     1000
    ...     * stable_diameter_limit(particle_density=998, fluid_density=1.2, surface_tension="72.8 mN/m"),
    ...     1,
    ... )
    10.9
    """
    weight = gravity * abs(particle_density - fluid_density)
    heavy = weight > 0.0
    return jnp.where(heavy, 4.0 * jnp.sqrt(surface_tension / jnp.where(heavy, weight, 1.0)), jnp.inf)


def _sign(rho_p: Any, rho: Any) -> Any:
    return jnp.sign(jnp.asarray(rho_p - rho, dtype=float))


class GraceVelocity(NamedTuple):
    """Terminal velocity of a deformed drop or bubble with its numbers."""

    terminal_velocity: Velocity
    reynolds_number: Ratio
    eotvos_number: Ratio
    morton_number: Ratio


@formula(
    source="grace1976; clift1978, eq. 7-3 to 7-7",
    equation=(
        r"\mathrm{Re} = \mathrm{M}^{-0.149}(J - 0.857),\ H = "
        r"\tfrac43\mathrm{Eo}\,\mathrm{M}^{-0.149}\left(\frac{\eta}{\eta_w}\right)^{-0.14},\ J = "
        r"0.94H^{0.757}\ (H\le59.3),\ 3.42H^{0.441},\quad \mathrm{Eo} = \frac{g\,|\rho_p - "
        r"\rho_f|\,d_p^2}{\sigma},\ \mathrm{M} = \frac{g\,\eta^4\,|\rho_p - "
        r"\rho_f|}{\rho_f^2\,\sigma^3},\quad v_t = \frac{\mathrm{Re}\,\eta}{\rho_f\,d_p}"
    ),
    fitted={
        "grace_group": (2.0, 1e4),
        "eotvos_number": (0.0, 40.0),
        "morton_number": (0.0, 1e-3),
        "reynolds_number": (0.1, 1e5),
    },
    typical={
        "particle_diameter": (2e-3, 8e-3),
        "particle_density": (1.0, 900.0),
        "fluid_density": (950.0, 1200.0),
        "surface_tension": (0.02, 0.07),
    },
)
def terminal_velocity_grace(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    surface_tension: SurfaceTension,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> GraceVelocity:
    """Terminal velocity of deformed drops and bubbles in liquids that are not surface-clean, by Grace,
    Wairegi and Nguyen.

    For ellipsoidal globules above about 1 mm; 15 % root-mean-square deviation. In thoroughly purified systems
    they go faster. Below H = 2 the globule is a sphere: use the drag laws or Hadamard's factor.

    >>> found = terminal_velocity_grace(
    ...     particle_diameter="5 mm",
    ...     particle_density=1.2,
    ...     fluid_density=998,
    ...     dynamic_viscosity="1 cP",
    ...     surface_tension="72.8 mN/m",
    ... )
    >>> round(found.terminal_velocity, 3)
    -0.242
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Eo = eotvos_number(d, particle_density, rho, surface_tension, gravity)
    M = morton_number(particle_density, rho, eta, surface_tension, gravity)
    scale = jnp.maximum(M, 1e-30) ** -0.149
    H = 4.0 / 3.0 * Eo * scale * (eta / 0.0009) ** -0.14
    watch(grace_group=H)
    safe = jnp.maximum(H, 1e-12)
    J = jnp.where(H <= 59.3, 0.94 * safe**0.757, 3.42 * safe**0.441)
    Re = scale * jnp.maximum(J - 0.857, 0.0)
    return GraceVelocity(_sign(particle_density, rho) * Re * eta / (rho * d), Re, Eo, M)


@formula(
    source="mendelson1967; clift1978, eq. 7-10",
    equation=r"v_t = \sqrt{\frac{2\sigma}{\rho_f d_p} + \frac{g|\rho_p-\rho_f|d_p}{2\rho_f}}",
    fitted={"eotvos_number": (0.25, 40.0)},
    typical={
        "particle_diameter": (2e-3, 1e-2),
        "particle_density": (1.0, 10.0),
        "surface_tension": (0.05, 0.075),
    },
)
def terminal_velocity_mendelson(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    surface_tension: SurfaceTension,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Velocity:
    """Terminal velocity of a deformed bubble in a pure liquid of low viscosity by Mendelson's wave analogy.

    >>> round(
    ...     terminal_velocity_mendelson(
    ...         particle_diameter="5 mm", particle_density=1.2, fluid_density=998, surface_tension="72.8 mN/m"
    ...     ),
    ...     3,
    ... )
    -0.232
    """
    d, rho = particle_diameter, fluid_density
    excess = abs(particle_density - rho)
    watch(eotvos_number=gravity * excess * d**2 / surface_tension)
    return _sign(particle_density, rho) * jnp.sqrt(
        2.0 * surface_tension / (rho * d) + gravity * excess * d / (2.0 * rho)
    )


@formula(
    source="davies1950; clift1978, eq. 8-7",
    equation=r"v_t = 0.711\sqrt{\frac{g|\rho_p-\rho_f|d_p}{\rho_f}}",
    typical={"particle_diameter": (1e-2, 1e-1), "particle_density": (1.0, 10.0)},
)
def terminal_velocity_davies_taylor(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Velocity:
    """Terminal velocity of a large spherical-cap bubble or drop by Davies and Taylor, on the
    volume-equivalent diameter.

    Eötvös number above 40 and Reynolds number above 150.

    >>> round(
    ...     terminal_velocity_davies_taylor(
    ...         particle_diameter="20 mm", particle_density=1.2, fluid_density=998
    ...     ),
    ...     3,
    ... )
    -0.315
    """
    excess = abs(particle_density - fluid_density)
    lift = gravity * excess * particle_diameter / fluid_density
    moves = lift > 0.0
    return _sign(particle_density, fluid_density) * jnp.where(
        moves, 0.711 * jnp.sqrt(jnp.where(moves, lift, 1.0)), 0.0
    )
