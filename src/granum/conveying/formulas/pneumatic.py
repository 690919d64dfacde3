"""Velocity of conveyed particles and the pressure that their friction, weight and bends take."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Density,
    Length,
    MassFlux,
    MassRatio,
    PositiveNumber,
    PressureDifference,
    PressureGradient,
    Ratio,
    Speed,
)

SLOWEST = 0.1  # of the gas velocity
_PIPE = {
    "gas_velocity": (10.0, 30.0),
    "particle_velocity": (8.0, 25.0),
    "particle_diameter": (1e-4, 3e-3),
    "particle_density": (800.0, 3000.0),
    "fluid_density": (1.0, 3.0),
    "mass_flux": (20.0, 200.0),
    "diameter": (0.05, 0.2),
}


def _typical(*names: str) -> dict[str, tuple[float, float]]:
    return {name: _PIPE[name] for name in names}


@formula(
    source="hinkle1953; rhodes2008, eq. 8.17",
    equation=r"v_p = U_g\left(1 - 0.0638\,d_p^{0.3}\,\rho_p^{0.5}\right)",
    typical=_typical("gas_velocity", "particle_diameter", "particle_density"),
)
def particle_velocity_hinkle(
    gas_velocity: Speed, particle_diameter: Length, particle_density: Density
) -> Speed:
    """Velocity of particles conveyed through a level pipe by Hinkle.

    The constant is that of SI units. Large and heavy particles, for which it would be nothing, keep a tenth
    of the velocity of the gas, which is ours.

    A sheet after Rhodes's method, which was read: 150 µm, 1450 kg/m³.

    >>> round(particle_velocity_hinkle(13.8165, "150 um", 1450.0), 3)
    11.425
    """
    lag = 0.0638 * particle_diameter**0.3 * particle_density**0.5
    return gas_velocity * jnp.maximum(1.0 - lag, SLOWEST)


@formula(
    source="hinkle1953; rhodes2008, eq. 8.19",
    equation=(
        r"f_p = \frac38\,\frac{\rho_f}{\rho_p}\,\frac{D}{d_p}\,C_D\left(\frac{U_g - v_p}{v_p}\right)^2"
    ),
    typical=_typical(
        "gas_velocity",
        "particle_velocity",
        "particle_diameter",
        "particle_density",
        "fluid_density",
        "diameter",
    )
    | {"drag_coefficient": (0.5, 5.0)},
)
def particle_friction_factor_hinkle(
    gas_velocity: Speed,
    particle_velocity: Speed,
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    diameter: Length,
    drag_coefficient: PositiveNumber,
) -> Ratio:
    """Friction factor of conveyed particles in a level pipe, after Fanning, by Hinkle: the drag that makes up
    for what they lose at the wall.

    The drag coefficient is that of the velocity by which they lag. Gas velocity: between the particles.

    A sheet after Rhodes's method, which was read: 0.012921.

    >>> round(
    ...     particle_friction_factor_hinkle(
    ...         13.87575, 11.42467, "150 um", 1450.0, 1.2, "50 mm", drag_coefficient=2.713673
    ...     ),
    ...     5,
    ... )
    0.01292
    """
    lag = (gas_velocity - particle_velocity) / jnp.maximum(particle_velocity, 1e-9)
    size = diameter / particle_diameter
    return 0.375 * fluid_density / particle_density * size * drag_coefficient * lag**2


@formula(
    source="hinkle1953; rhodes2008, eq. 8.18",
    equation=r"\frac{\Delta p}{L} = \frac{2\,f_p\,G\,v_p}{D}",
    typical=_typical("mass_flux", "particle_velocity", "diameter")
    | {"particle_friction_factor": (1e-3, 0.1)},
    title="Friction of conveyed solid in a level pipe (Hinkle)",
)
def pressure_gradient_solid_hinkle(
    mass_flux: MassFlux, particle_velocity: Speed, diameter: Length, particle_friction_factor: Ratio
) -> PressureGradient:
    """Pressure that the friction of conveyed solid takes per length of level pipe; the mass flux is that of
    the solid.

    With Hinkle's velocity of the particles it is far too much for fine powders in wide pipes.

    A sheet after Rhodes's method, which was read: 417.7 Pa/m.

    >>> round(pressure_gradient_solid_hinkle(70.73553, 11.42467, "50 mm", 0.012921), 1)
    417.7
    """
    return 2.0 * particle_friction_factor * mass_flux * particle_velocity / diameter


@formula(
    source="konno1969; rhodes2008, eq. 8.16",
    equation=r"\frac{\Delta p}{L} = 0.057\,G\,\sqrt{\frac{g}{D}}",
    typical=_typical("mass_flux", "diameter"),
    title="Friction of conveyed solid (Konno and Saito)",
)
def pressure_gradient_solid_konno_saito(mass_flux: MassFlux, diameter: Length) -> PressureGradient:
    """Pressure that the friction of conveyed solid takes per length of straight pipe; the mass flux is that
    of the solid.

    The weight of the solid in a rising pipe comes on top. Constant recalled, not opened.

    By hand: 0.057·100·√(9.80665/0.1).

    >>> round(pressure_gradient_solid_konno_saito(100.0, "0.1 m"), 2)
    56.45
    """
    return 0.057 * mass_flux * jnp.sqrt(STANDARD_GRAVITY / diameter)


@formula(
    source="chambers1986",
    equation=r"\Delta p = B\,(1 + \mu)\,\frac{\rho_f U_g^2}{2}",
    typical=_typical("gas_velocity", "fluid_density")
    | {"solids_loading": (1.0, 10.0), "bend_coefficient": (0.5, 1.5)},
    title="Pressure drop of a bend in a pneumatic line",
)
def pressure_drop_bend(
    gas_velocity: Speed,
    fluid_density: Density,
    solids_loading: MassRatio,
    bend_coefficient: Ratio = 0.5,
) -> PressureDifference:
    """Pressure that a bend of a right angle takes, in velocity heads of gas and solid together.

    Coefficients of Chambers and Marcus, recalled and not opened: 0.5 where the bend is six diameters wide or
    more, 0.75 at four, 1.5 at two.

    By hand: half a head of 1.2·20²/2 Pa, sixfold.

    >>> round(pressure_drop_bend(20.0, 1.2, 5.0), 6)
    720.0
    """
    return bend_coefficient * (1.0 + solids_loading) * 0.5 * fluid_density * gas_velocity**2
