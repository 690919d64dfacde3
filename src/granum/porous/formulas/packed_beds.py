"""Pressure gradient of packed beds: the family ``pressure_gradient``.

Every law is called with superficial velocity, diameter of the sphere of equal volume, void fraction, density,
viscosity and sphericity; sphericity times diameter is the surface–volume diameter 6/a_g that the equations
are written on. Re₁ is ρUd/(η(1 − ε)), which is six times Carman's Re' = ρU/(η a_g(1 − ε)).
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Length,
    PositiveNumber,
    PressureGradient,
    Ratio,
    Speed,
    Sphericity,
    VoidFraction,
    Within,
)
from granum.porous.definitions import BED_REYNOLDS


def bed_group(U: Any, d: Any, e: Any, rho: Any, eta: Any) -> tuple[Any, Any]:
    """Re₁ and the viscous unit η U (1 − ε)²/(ε³ d²)."""
    return rho * U * d / (eta * (1.0 - e)), eta * U * (1.0 - e) ** 2 / (e**3 * d**2)


@formula(
    source="carman1937; kozeny1927",
    equation=r"\frac{\Delta p}{L} = 36\,h_K\,\frac{\eta U(1-\varepsilon)^2}{\varepsilon^3(\psi d_p)^2}"
    + BED_REYNOLDS,
    fitted={"reynolds_bed": (0.0, 10.0)},
)
def pressure_gradient_kozeny_carman(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
    kozeny_coefficient: PositiveNumber = 5.0,
) -> PressureGradient:
    """Pressure gradient of a bed in creeping flow by Kozeny and Carman; 36 h_K is 180 with the usual
    coefficient.

    >>> round(
    ...     pressure_gradient_kozeny_carman(
    ...         superficial_velocity=1e-3,
    ...         particle_diameter="100 um",
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     )
    ... )
    101250
    """
    Re, viscous = bed_group(
        superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity
    )
    watch(reynolds_bed=Re)
    return 36.0 * kozeny_coefficient * viscous


@formula(
    source="blake1922; ergun1952",
    equation=r"\frac{\Delta p}{L} = 150\,\frac{\eta U(1-\varepsilon)^2}{\varepsilon^3(\psi d_p)^2}"
    + BED_REYNOLDS,
    fitted={"reynolds_bed": (0.0, 10.0)},
)
def pressure_gradient_blake_kozeny(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
) -> PressureGradient:
    """Pressure gradient of a bed in creeping flow by Blake and Kozeny, the viscous part of Ergun's equation.

    Differs from the print: one set of notes swaps ε and 1 − ε.

    >>> round(
    ...     pressure_gradient_blake_kozeny(
    ...         superficial_velocity=1e-3,
    ...         particle_diameter="100 um",
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     )
    ... )
    84375
    """
    Re, viscous = bed_group(
        superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity
    )
    watch(reynolds_bed=Re)
    return 150.0 * viscous


@formula(
    source="burke1928; ergun1952",
    equation=r"\frac{\Delta p}{L} = 1.75\,\frac{\rho_f U^2(1-\varepsilon)}{\varepsilon^3\psi d_p}"
    + BED_REYNOLDS,
    fitted={"reynolds_bed": (1000.0, 1e5)},
)
def pressure_gradient_burke_plummer(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
) -> PressureGradient:
    """Pressure gradient of a bed in turbulent flow by Burke and Plummer, the inertial part of Ergun's
    equation.

    In the form h_B a_g ρU²(1 − ε)/ε³ the constant is h_B = 1.75/6 = 0.29.

    >>> round(
    ...     pressure_gradient_burke_plummer(
    ...         superficial_velocity=1.0,
    ...         particle_diameter="10 mm",
    ...         void_fraction=0.4,
    ...         fluid_density=1.2,
    ...         dynamic_viscosity=1.8e-5,
    ...     ),
    ...     2,
    ... )
    1968.75
    """
    Re, viscous = bed_group(
        superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity
    )
    watch(reynolds_bed=Re)
    return 1.75 * viscous * Re


@formula(
    source="ergun1952",
    equation=(
        r"\frac{\Delta p}{L} = 150\,\frac{\eta U(1-\varepsilon)^2}{\varepsilon^3(\psi d_p)^2} + "
        r"1.75\,\frac{\rho_f U^2(1-\varepsilon)}{\varepsilon^3\psi d_p}"
    ),
    fitted={"reynolds_bed": (1.0, 2300.0)},
)
def pressure_gradient_ergun(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
) -> PressureGradient:
    """Pressure gradient of a packed bed from creeping to turbulent flow by Ergun.

    Over-predicts smooth spheres above Re₁ of about 700. Differs from the print: two sets of notes lose ε³ and
    U² in the second term or swap ε and 1 − ε.

    >>> round(
    ...     pressure_gradient_ergun(
    ...         superficial_velocity=1e-3,
    ...         particle_diameter="0.8 mm",
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     2,
    ... )
    1338.87
    """
    Re, viscous = bed_group(
        superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity
    )
    watch(reynolds_bed=Re)
    return viscous * (150.0 + 1.75 * Re)


@formula(
    source="macdonald1979",
    equation=(
        r"\frac{\Delta p}{L} = \frac{\eta U(1-\varepsilon)^2}{\varepsilon^3(\psi d_p)^2}\left(180 + "
        r"b\,\mathrm{Re}_1\right)"
    )
    + BED_REYNOLDS,
    fitted={"reynolds_bed": (0.0, 1e4), "void_fraction": (0.36, 0.92)},
    typical={"inertial_constant": (1.8, 4.0)},
)
def pressure_gradient_macdonald(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
    inertial_constant: Annotated[PositiveNumber, Within(1.0, 6.0)] = 1.8,
) -> PressureGradient:
    """Pressure gradient of a packed bed by Macdonald and others: Ergun's form with 180 and 1.8 (smooth) to
    4.0 (rough grains).

    Within 50 % of all their data.

    >>> round(
    ...     pressure_gradient_macdonald(
    ...         superficial_velocity=1e-3,
    ...         particle_diameter="0.8 mm",
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     2,
    ... )
    1603.12
    """
    Re, viscous = bed_group(
        superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity
    )
    watch(reynolds_bed=Re)
    return viscous * (180.0 + inertial_constant * Re)


@formula(
    source="carman1937",
    equation=(
        r"f' = \frac{\Delta p}{L}\frac{\varepsilon^3}{a_g(1-\varepsilon)\rho_f U^2} = "
        r"\frac{5}{\mathrm{Re}'} + \frac{0.4}{\mathrm{Re}'^{0.1}},\quad\mathrm{Re}' = \frac{\rho_f "
        r"U}{a_g(1-\varepsilon)\eta},\quad a_g = \frac{6}{\psi\,d_p}"
    ),
    fitted={"reynolds_bed": (0.06, 6e4)},
)
def pressure_gradient_carman(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
) -> PressureGradient:
    """Pressure gradient of a packed bed of solid grains by Carman, Re' from 0.01 to 10 000.

    Differs from the print: the course drops the factor 0.4 of the second term.

    >>> round(
    ...     pressure_gradient_carman(
    ...         superficial_velocity="1 mm/s",
    ...         particle_diameter="1 mm",
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     1,
    ... )
    1038.1
    >>> round(
    ...     pressure_gradient_carman(
    ...         superficial_velocity=1e-9,
    ...         particle_diameter="100 um",
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     5,
    ... )
    0.10125
    """
    Re, viscous = bed_group(
        superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity
    )
    watch(reynolds_bed=Re)
    inertial = 0.4 * 6.0 * 6.0**0.1 * jnp.maximum(Re, 1e-30) ** 0.9
    return viscous * (180.0 + inertial)


@formula(
    source="leva1959; nikitin2026",
    equation=(
        r"\frac{\Delta p}{L} = 200\,\frac{\eta U(1-\varepsilon)^2}{\varepsilon^3(\psi d_p)^2}\ "
        r"(\text{laminar}),\quad 3.5\,\frac{\rho_f^{0.9}U^{1.9}\eta^{0.1}(1-\varepsilon)}{\varepsilon^3 "
        r"(\psi d_p)^{1.1}}\ (\text{turbulent})"
    ),
    fitted={"reynolds": (0.0, 1e4)},
)
def pressure_gradient_leva(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
    inertial_constant: Annotated[PositiveNumber, Within(1.0, 10.0)] = 3.5,
) -> PressureGradient:
    """Pressure gradient of a packed bed by Leva, the larger of his laminar and his turbulent equation.

    The turbulent constant is 3.5 for smooth, 5.25 for clay-like and 8 for very rough grains. His laminar
    equation holds below Re = ρUd/η of 10, the turbulent one above 100; between them the larger is low by up
    to a third. His data end at 10 000 (Nikitin's collection of such laws).

    >>> round(
    ...     pressure_gradient_leva(
    ...         superficial_velocity=1e-3,
    ...         particle_diameter="100 um",
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     )
    ... )
    112500
    """
    d = sphericity * particle_diameter
    Re, viscous = bed_group(superficial_velocity, d, void_fraction, fluid_density, dynamic_viscosity)
    turbulent = (
        inertial_constant * jnp.maximum(Re, 1e-30) * jnp.maximum(Re * (1.0 - void_fraction), 1e-30) ** -0.1
    )
    watch(reynolds=Re * (1.0 - void_fraction))
    return viscous * jnp.maximum(200.0, turbulent)


@formula(
    source="stokes1851; happel1958",
    title="Pressure gradient of sparse obstacles",
    equation=r"\frac{\Delta p}{L} = 18\,\frac{\eta U(1-\varepsilon)}{d_p^2}" + BED_REYNOLDS,
    fitted={"void_fraction": (0.99, 1.0), "reynolds": (0.0, 0.2)},
    typical={"void_fraction": (0.99, 0.999)},
)
def pressure_gradient_obstacles(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
) -> PressureGradient:
    """Pressure gradient of spheres far from one another, each with Stokes' drag.

    >>> round(
    ...     pressure_gradient_obstacles(
    ...         superficial_velocity=1e-3,
    ...         particle_diameter="100 um",
    ...         void_fraction=0.999,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     3,
    ... )
    1.8
    """
    d = sphericity * particle_diameter
    watch(reynolds=fluid_density * superficial_velocity * d / dynamic_viscosity)
    return 18.0 * dynamic_viscosity * superficial_velocity * (1.0 - void_fraction) / d**2


class BedNumbers(NamedTuple):
    """Dimensionless groups of flow through a bed."""

    reynolds: Ratio
    reynolds_bed: Ratio
    reynolds_carman: Ratio
    inertial_share: Ratio


@formula(
    source="ergun1952; carman1937",
    equation=(
        r"\mathrm{Re} = \frac{\rho_f U\psi d_p}{\eta},\ \mathrm{Re}_1 = "
        r"\frac{\mathrm{Re}}{1-\varepsilon},\ \mathrm{Re}' = \frac{\mathrm{Re}_1}{6},\ s = "
        r"\frac{1.75\,\mathrm{Re}_1}{150 + 1.75\,\mathrm{Re}_1}"
    ),
)
def packed_bed_numbers(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
) -> BedNumbers:
    """Reynolds numbers of a bed in the three conventions and the share of inertia in the pressure drop by
    Ergun.

    Creeping below Re₁ = 10 (inertia below 10 %), turbulent above 1000 (inertia above 92 %).

    >>> found = packed_bed_numbers(
    ...     superficial_velocity=0.06,
    ...     particle_diameter="1 mm",
    ...     void_fraction=0.4,
    ...     fluid_density=1000,
    ...     dynamic_viscosity="1 cP",
    ... )
    >>> round(found.reynolds, 6), round(found.reynolds_bed, 6), round(found.inertial_share, 4)
    (60.0, 100.0, 0.5385)
    """
    Re = fluid_density * superficial_velocity * sphericity * particle_diameter / dynamic_viscosity
    Re1 = Re / (1.0 - void_fraction)
    return BedNumbers(Re, Re1, Re1 / 6.0, 1.75 * Re1 / (150.0 + 1.75 * Re1))
