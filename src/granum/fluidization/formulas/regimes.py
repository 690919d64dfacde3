"""Limits between the regimes of a fluidized bed: slugging, turbulent, fast; coordinates of Grace's map."""

from __future__ import annotations

from typing import NamedTuple

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import Acceleration, Density, DynamicViscosity, Length, PositiveNumber, Ratio, Speed
from granum.fluidization.formulas.buoyancy import TYPICAL, archimedes, excess
from granum.particles.definitions import ARCHIMEDES, reynolds_of, velocity_of

WIDE = {**TYPICAL, "superficial_velocity": (0.02, 2.0)}


class GraceCoordinates(NamedTuple):
    """Coordinates of Grace's regime map."""

    dimensionless_diameter: PositiveNumber
    dimensionless_velocity: Ratio


@formula(
    source="grace1986",
    equation=r"d^* = \mathrm{Ar}^{1/3},\quad u^* = \mathrm{Re}/\mathrm{Ar}^{1/3}"
    + reynolds_of("U")
    + ARCHIMEDES,
    typical=WIDE,
)
def grace_coordinates(
    superficial_velocity: Speed,
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> GraceCoordinates:
    """Dimensionless diameter and velocity of Grace's regime map.

    >>> x = grace_coordinates(
    ...     superficial_velocity=1.0,
    ...     particle_diameter="100 um",
    ...     particle_density=2500,
    ...     fluid_density=1.2,
    ...     dynamic_viscosity=1.8e-5,
    ... )
    >>> round(x.dimensionless_diameter * x.dimensionless_velocity, 3)  # the Reynolds number
    6.667
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    size = archimedes(d, particle_density, rho, eta, gravity) ** (1.0 / 3.0)
    return GraceCoordinates(size, rho * superficial_velocity * d / (eta * size))


@formula(
    source="bi1995",
    equation=r"\mathrm{Re}_c = 1.24\,\mathrm{Ar}^{0.45}" + velocity_of("U_c", "c") + ARCHIMEDES,
    fitted={"archimedes_number": (2.0, 1e8)},
    typical=TYPICAL,
)
def turbulent_onset_velocity_bi_grace(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Gas velocity at which bubbling turns into turbulent fluidization, from the peak of the pressure
    fluctuations.

    >>> u = turbulent_onset_velocity_bi_grace(
    ...     particle_diameter="100 um", particle_density=2500, fluid_density=1.2, dynamic_viscosity=1.8e-5
    ... )
    >>> 0.5 < u < 2.0
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Ar = archimedes(d, particle_density, rho, eta, gravity)
    watch(archimedes_number=Ar)
    return 1.24 * Ar**0.45 * eta / (rho * d)


@formula(
    source="bi1995",
    equation=r"\mathrm{Re}_{se} = 1.53\,\mathrm{Ar}^{0.5}" + velocity_of("U_{se}", "se") + ARCHIMEDES,
    fitted={"archimedes_number": (2.0, 4e6)},
    typical=TYPICAL,
)
def entrainment_onset_velocity_bi_grace(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Gas velocity of significant entrainment, where fast fluidization begins.

    For fine particles it lies far above the terminal velocity of one particle, because they leave as
    clusters.

    >>> u = entrainment_onset_velocity_bi_grace(
    ...     particle_diameter="100 um", particle_density=2500, fluid_density=1.2, dynamic_viscosity=1.8e-5
    ... )
    >>> 1.0 < u < 4.0
    True
    """
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Ar = archimedes(d, particle_density, rho, eta, gravity)
    watch(archimedes_number=Ar)
    return 1.53 * Ar**0.5 * eta / (rho * d)


@formula(
    source="stewart1967; geldart1986",
    equation=r"U_{ms} = U_{mf} + 0.07\sqrt{gD} + 0.16\,\max(1.34 D^{0.175} - H_{mf},\,0)^2",
    typical={"diameter": (0.05, 1.0), "height": (0.2, 1.2)},
)
def minimum_slugging_velocity(
    minimum_fluidization_velocity: Speed,
    diameter: Length,
    height: Length | None = None,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Gas velocity at which a bed starts to slug, by Stewart and Davidson; shallow beds by Baeyens and
    Geldart.

    The height is that of the bed at minimum fluidization; left out, the bed is taken as deep.

    >>> round(minimum_slugging_velocity(minimum_fluidization_velocity=0.05, diameter=0.1), 4)
    0.1193
    """
    deep = minimum_fluidization_velocity + 0.07 * jnp.sqrt(gravity * diameter)
    if height is None:
        return deep
    return deep + 0.16 * jnp.maximum(slugging_height(diameter) - height, 0.0) ** 2


@formula(
    source="baeyens1974slug; geldart1986",
    equation=r"H_s = 1.34\,D^{0.175}",
    typical={"diameter": (0.05, 1.0)},
)
def slugging_height(diameter: Length) -> Length:
    """Depth a bed must exceed to slug freely; the print is 60 D^0.175 in centimeters.

    >>> round(slugging_height(diameter=0.1), 3)
    0.896
    """
    return 1.34 * diameter**0.175


@formula(
    source="davidson1963",
    equation=r"U_s = U - U_{mf} + 0.35\sqrt{gD}",
    typical={
        "superficial_velocity": (0.3, 1.0),
        "minimum_fluidization_velocity": (0.01, 0.2),
        "diameter": (0.05, 1.0),
    },
)
def slug_rise_velocity(
    superficial_velocity: Speed,
    minimum_fluidization_velocity: Speed,
    diameter: Length,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Rise velocity of slugs in a bed.

    >>> round(
    ...     slug_rise_velocity(superficial_velocity=0.3, minimum_fluidization_velocity=0.1, diameter=0.1), 4
    ... )
    0.5466
    """
    return jnp.maximum(superficial_velocity - minimum_fluidization_velocity, 0.0) + 0.35 * jnp.sqrt(
        gravity * diameter
    )


@formula(
    source="romero1962; wilhelm1948",
    equation=(
        r"N = \frac{U_{mf}^2}{g d_p}\,\frac{\rho_f U_{mf} d_p}{\eta}\,\frac{\rho_p - "
        r"\rho_f}{\rho_f}\,\frac{H_{mf}}{D}"
    ),
    typical={
        **TYPICAL,
        "minimum_fluidization_velocity": (0.01, 0.1),
        "height": (0.5, 3.0),
        "diameter": (0.3, 1.0),
    },
    symbols={"height": "H_{mf}"},
)
def bubbling_number(
    minimum_fluidization_velocity: Speed,
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    height: Length,
    diameter: Length,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Ratio:
    """Romero and Johanson's product of Froude, Reynolds, density and shape: smooth fluidization below 100,
    bubbling above.

    Sand in a gas under pressure:

    >>> round(
    ...     bubbling_number(
    ...         minimum_fluidization_velocity=0.021,
    ...         particle_diameter="0.3 mm",
    ...         particle_density=2600,
    ...         fluid_density=106.2,
    ...         dynamic_viscosity=2.21e-5,
    ...         height=3.25,
    ...         diameter=0.95,
    ...     )
    ... )
    365
    """
    U, d, rho = minimum_fluidization_velocity, particle_diameter, fluid_density
    return (
        U**2
        / (gravity * d)
        * rho
        * U
        * d
        / dynamic_viscosity
        * excess(particle_density, rho)
        / rho
        * height
        / diameter
    )
