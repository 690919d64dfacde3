"""Minimum fluidization velocity as power laws, for fine powders and for liquids; minimum bubbling
velocity.
"""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import Acceleration, Density, DynamicViscosity, Fraction, Length, Speed
from granum.fluidization.formulas.buoyancy import FINE, TYPICAL, excess
from granum.particles.definitions import GALILEO, velocity_of


@formula(
    source="leva1959",
    equation=(
        r"\rho_f\,U_{mf} = G_{mf} = 688\,d_p^{1.82}\,\frac{[\rho_f(\rho_p - "
        r"\rho_f)]^{0.94}}{\eta^{0.88}}"
    ),
    fitted={"reynolds": (0.0, 10.0)},
    typical=FINE,
)
def minimum_fluidization_velocity_leva_power(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
) -> Speed:
    """Minimum fluidization velocity of fine particles by Leva's power law, which needs neither void fraction
    nor sphericity.

    The print is in lb/(h ft²), inches, lb/ft³ and centipoise, and holds on Earth.

    >>> u = minimum_fluidization_velocity_leva_power(
    ...     particle_diameter="100 um", particle_density=2500, fluid_density=1.2, dynamic_viscosity=1.8e-5
    ... )
    >>> 0.005 < u < 0.015
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    pound_per_cubic_foot, pound_flux = 16.018463, 1.3562299e-3
    inches, product = d / 0.0254, rho * excess(particle_density, rho) / pound_per_cubic_foot**2
    U = 688.0 * inches**1.82 * product**0.94 / (1e3 * eta) ** 0.88 * pound_flux / rho
    watch(reynolds=rho * U * d / eta)
    return U


@formula(
    source="baeyens1974; geldart1986",
    equation=r"U_{mf} = \frac{[g(\rho_p - \rho_f)]^{0.934}\,d_p^{1.8}}{1111\,\eta^{0.87}\,\rho_f^{0.066}}",
    fitted={"particle_diameter": (0.0, 1e-4)},
    typical=FINE,
)
def minimum_fluidization_velocity_baeyens_geldart(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity of powders finer than 100 µm in gases by Baeyens and Geldart.

    >>> u = minimum_fluidization_velocity_baeyens_geldart(
    ...     particle_diameter="60 um", particle_density=1500, fluid_density=1.2, dynamic_viscosity=1.8e-5
    ... )
    >>> 0.001 < u < 0.004
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    return (excess(particle_density, rho) * gravity) ** 0.934 * d**1.8 / (1111.0 * eta**0.87 * rho**0.066)


@formula(
    source="riba1978",
    equation=r"\mathrm{Re}_{mf} = 0.0154\,\mathrm{Ga}^{0.66} M_v^{0.70},\ M_v = (\rho_p - \rho_f)/\rho_f"
    + velocity_of("U_{mf}", "mf")
    + GALILEO,
    fitted={"reynolds": (10.0, 1000.0)},
    typical={"particle_diameter": (1e-3, 5e-3)},
)
def minimum_fluidization_velocity_riba(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum fluidization velocity in liquids by Riba, Routie and Couderc.

    >>> u = minimum_fluidization_velocity_riba(
    ...     particle_diameter="2 mm", particle_density=2500, fluid_density=1000, dynamic_viscosity="1 cP"
    ... )
    >>> 0.01 < u < 0.04
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Re = 0.0154 * (gravity * d**3 * rho**2 / eta**2) ** 0.66 * (excess(particle_density, rho) / rho) ** 0.70
    watch(reynolds=Re)
    return Re * eta / (rho * d)


@formula(
    source="abrahamsen1980",
    equation=r"U_{mb} = 2.07\,e^{0.716 F_{45}}\,\frac{d_p\,\rho_f^{0.06}}{\eta^{0.347}}",
    fitted={"particle_diameter": (2e-5, 7.2e-5)},
    typical={**TYPICAL, "particle_diameter": (2e-5, 7e-5)},
)
def minimum_bubbling_velocity_abrahamsen_geldart(
    particle_diameter: Length,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    fines_fraction: Fraction = 0.1,
) -> Speed:
    """Velocity at which bubbles appear in a bed of fine powder by Abrahamsen and Geldart.

    The fines fraction is the part of the mass below 45 µm. Where it comes out below the minimum fluidization
    velocity the powder is not of group A and bubbles from the start.

    >>> u = minimum_bubbling_velocity_abrahamsen_geldart(
    ...     particle_diameter="60 um", fluid_density=1.2, dynamic_viscosity=1.8e-5
    ... )
    >>> 0.005 < u < 0.01
    True
    """
    return (
        2.07
        * jnp.exp(0.716 * fines_fraction)
        * particle_diameter
        * fluid_density**0.06
        / dynamic_viscosity**0.347
    )
