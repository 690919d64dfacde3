"""Pressure gradient of packed beds: the family ``pressure_gradient``.

Every law is called with superficial velocity, diameter of the sphere of equal volume, void fraction, density, viscosity and
sphericity; sphericity times diameter is the surface–volume diameter 6/a_g that the equations are written on. Re₁ is
ρUd/(η(1 − ε)), which is six times Carman's Re' = ρU/(η a_g(1 − ε)).
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import formula, law, watch
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


def _group(U: Any, d: Any, e: Any, rho: Any, eta: Any) -> tuple[Any, Any]:
    """Re₁ and the viscous unit η U (1 − ε)²/(ε³ d²)."""
    return rho * U * d / (eta * (1.0 - e)), eta * U * (1.0 - e) ** 2 / (e**3 * d**2)


@formula(
    source="carman1937; kozeny1927",
    equation=r"\frac{\Delta p}{L} = 36\,h_K\,\frac{\eta U(1-\varepsilon)^2}{\varepsilon^3(\psi d_p)^2}",
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
    """Pressure gradient of a bed in creeping flow by Kozeny and Carman; 36 h_K is 180 with the usual coefficient.

    >>> round(pressure_gradient_kozeny_carman(superficial_velocity=1e-3, particle_diameter="100 um", void_fraction=0.4,
    ...                                       fluid_density=1000, dynamic_viscosity="1 cP"))
    101250
    """
    Re, viscous = _group(superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity)
    watch(reynolds_bed=Re)
    return 36.0 * kozeny_coefficient * viscous


@formula(
    source="blake1922; ergun1952",
    equation=r"\frac{\Delta p}{L} = 150\,\frac{\eta U(1-\varepsilon)^2}{\varepsilon^3(\psi d_p)^2}",
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

    >>> round(pressure_gradient_blake_kozeny(superficial_velocity=1e-3, particle_diameter="100 um", void_fraction=0.4,
    ...                                      fluid_density=1000, dynamic_viscosity="1 cP"))
    84375
    """
    Re, viscous = _group(superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity)
    watch(reynolds_bed=Re)
    return 150.0 * viscous


@formula(
    source="burke1928; ergun1952",
    equation=r"\frac{\Delta p}{L} = 1.75\,\frac{\rho U^2(1-\varepsilon)}{\varepsilon^3\psi d_p}",
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
    """Pressure gradient of a bed in turbulent flow by Burke and Plummer, the inertial part of Ergun's equation.

    In the form h_B a_g ρU²(1 − ε)/ε³ the constant is h_B = 1.75/6 = 0.29.

    >>> round(pressure_gradient_burke_plummer(superficial_velocity=1.0, particle_diameter="10 mm", void_fraction=0.4,
    ...                                       fluid_density=1.2, dynamic_viscosity=1.8e-5), 2)
    1968.75
    """
    Re, viscous = _group(superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity)
    watch(reynolds_bed=Re)
    return 1.75 * viscous * Re


@formula(
    source="ergun1952",
    equation=r"\frac{\Delta p}{L} = 150\,\frac{\eta U(1-\varepsilon)^2}{\varepsilon^3(\psi d_p)^2} + 1.75\,\frac{\rho U^2(1-\varepsilon)}{\varepsilon^3\psi d_p}",
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

    Over-predicts smooth spheres above Re₁ of about 700. Differs from the print: two sets of notes lose ε³ and U² in the second
    term or swap ε and 1 − ε.

    >>> round(pressure_gradient_ergun(superficial_velocity=1e-3, particle_diameter="0.8 mm", void_fraction=0.4, fluid_density=1000,
    ...                               dynamic_viscosity="1 cP"), 2)
    1338.87
    """
    Re, viscous = _group(superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity)
    watch(reynolds_bed=Re)
    return viscous * (150.0 + 1.75 * Re)


@formula(
    source="macdonald1979",
    equation=r"\frac{\Delta p}{L} = \frac{\eta U(1-\varepsilon)^2}{\varepsilon^3(\psi d_p)^2}\left(180 + b\,\mathrm{Re}_1\right)",
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
    """Pressure gradient of a packed bed by Macdonald and others: Ergun's form with 180 and 1.8 (smooth) to 4.0 (rough grains).

    Within 50 % of all their data.

    >>> round(pressure_gradient_macdonald(superficial_velocity=1e-3, particle_diameter="0.8 mm", void_fraction=0.4, fluid_density=1000,
    ...                                   dynamic_viscosity="1 cP"), 2)
    1603.12
    """
    Re, viscous = _group(superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity)
    watch(reynolds_bed=Re)
    return viscous * (180.0 + inertial_constant * Re)


@formula(
    source="carman1937",
    equation=r"f' = \frac{\Delta p}{L}\frac{\varepsilon^3}{a_g(1-\varepsilon)\rho U^2} = \frac{5}{\mathrm{Re}'} + \frac{0.4}{\mathrm{Re}'^{0.1}},\quad"
    r"\mathrm{Re}' = \frac{\rho U}{a_g(1-\varepsilon)\eta}",
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

    >>> round(pressure_gradient_carman(superficial_velocity=1e-9, particle_diameter="100 um", void_fraction=0.4,
    ...                                fluid_density=1000, dynamic_viscosity="1 cP"), 5)
    0.10125
    """
    Re, viscous = _group(superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity)
    watch(reynolds_bed=Re)
    inertial = 0.4 * 6.0 * 6.0**0.1 * jnp.maximum(Re, 1e-30) ** 0.9
    return viscous * (180.0 + inertial)


@formula(
    source="leva1959",
    equation=r"\frac{\Delta p}{L} = 200\,\frac{\eta U(1-\varepsilon)^2}{\varepsilon^3(\psi d_p)^2}\ (\text{laminar}),\quad"
    r"3.5\,\frac{\rho^{0.9}U^{1.9}\eta^{0.1}(1-\varepsilon)}{\varepsilon^3 (\psi d_p)^{1.1}}\ (\text{turbulent})",
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

    The turbulent constant is 3.5 for smooth, 5.25 for clay-like and 8 for very rough grains. His laminar equation holds below
    Re = ρUd/η of 10, the turbulent one above 100; between them the larger is low by up to a third.

    >>> round(pressure_gradient_leva(superficial_velocity=1e-3, particle_diameter="100 um", void_fraction=0.4,
    ...                              fluid_density=1000, dynamic_viscosity="1 cP"))
    112500
    """
    d = sphericity * particle_diameter
    Re, viscous = _group(superficial_velocity, d, void_fraction, fluid_density, dynamic_viscosity)
    turbulent = inertial_constant * jnp.maximum(Re, 1e-30) * jnp.maximum(Re * (1.0 - void_fraction), 1e-30) ** -0.1
    return viscous * jnp.maximum(200.0, turbulent)


@formula(
    source="stokes1851; happel1958",
    equation=r"\frac{\Delta p}{L} = 18\,\frac{\eta U(1-\varepsilon)}{d_p^2}",
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

    >>> round(pressure_gradient_obstacles(superficial_velocity=1e-3, particle_diameter="100 um", void_fraction=0.999,
    ...                                   fluid_density=1000, dynamic_viscosity="1 cP"), 3)
    1.8
    """
    d = sphericity * particle_diameter
    watch(reynolds=fluid_density * superficial_velocity * d / dynamic_viscosity)
    return 18.0 * dynamic_viscosity * superficial_velocity * (1.0 - void_fraction) / d**2


@formula(
    source="tallmadge1970",
    equation=r"f = \frac{150}{\mathrm{Re}_1} + \frac{4.2}{\mathrm{Re}_1^{1/6}}",
    fitted={"reynolds_bed": (0.1, 1e5)},
)
def pressure_gradient_tallmadge(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
) -> PressureGradient:
    """Pressure gradient of a packed bed by Tallmadge, Ergun's equation carried to higher Reynolds numbers.

    >>> round(pressure_gradient_tallmadge(superficial_velocity=1e-3, particle_diameter="0.8 mm", void_fraction=0.4, fluid_density=1000,
    ...                                   dynamic_viscosity="1 cP"), 1)
    1365.3
    """
    Re, viscous = _group(superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity)
    watch(reynolds_bed=Re)
    return viscous * (150.0 + 4.2 * jnp.maximum(Re, 1e-30) ** (5.0 / 6.0))


@formula(
    source="erdim2015",
    equation=r"\frac{\Delta p}{L} = \frac{\eta U(1-\varepsilon)^2}{\varepsilon^3 (\psi d_p)^2}\left(160 + 2.81\,\mathrm{Re}_1^{0.904}\right)",
    fitted={"reynolds_bed": (2.0, 3600.0)},
)
def pressure_gradient_erdim(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
) -> PressureGradient:
    """Pressure gradient of a bed of spheres by Erdim, Akgiray and Demir, the best of 38 equations in their review.

    >>> round(pressure_gradient_erdim(superficial_velocity=1e-3, particle_diameter="0.8 mm", void_fraction=0.4, fluid_density=1000,
    ...                               dynamic_viscosity="1 cP"), 1)
    1438.3
    """
    Re, viscous = _group(superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity)
    watch(reynolds_bed=Re)
    return viscous * (160.0 + 2.81 * jnp.maximum(Re, 1e-30) ** 0.904)


@formula(
    source="brauer1971",
    equation=r"\frac{\Delta p}{L} = \frac{\eta U(1-\varepsilon)^2}{\varepsilon^3 (\psi d_p)^2}\left(160 + 3.1\,\mathrm{Re}_1^{0.9}\right)",
    fitted={"reynolds_bed": (0.01, 4e4)},
)
def pressure_gradient_brauer(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
) -> PressureGradient:
    """Pressure gradient of a bed of spheres by Brauer.

    >>> round(pressure_gradient_brauer(superficial_velocity=1e-3, particle_diameter="0.8 mm", void_fraction=0.4, fluid_density=1000,
    ...                                dynamic_viscosity="1 cP"), 1)
    1441.5
    """
    Re, viscous = _group(superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity)
    watch(reynolds_bed=Re)
    return viscous * (160.0 + 3.1 * jnp.maximum(Re, 1e-30) ** 0.9)


@formula(
    source="kta1981",
    equation=r"f = \frac{160}{\mathrm{Re}_1} + \frac{3}{\mathrm{Re}_1^{0.1}}",
    fitted={"reynolds_bed": (1.0, 1e5), "void_fraction": (0.36, 0.42)},
    typical={"void_fraction": (0.36, 0.42)},
)
def pressure_gradient_kta(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
) -> PressureGradient:
    """Pressure gradient of a bed of spheres by the German pebble-bed reactor rule.

    >>> round(pressure_gradient_kta(superficial_velocity=1e-3, particle_diameter="0.8 mm", void_fraction=0.4, fluid_density=1000,
    ...                             dynamic_viscosity="1 cP"), 1)
    1440.4
    """
    Re, viscous = _group(superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity)
    watch(reynolds_bed=Re)
    return viscous * (160.0 + 3.0 * jnp.maximum(Re, 1e-30) ** 0.9)


@formula(
    source="gibilaro1985",
    equation=r"\frac{\Delta p}{L} = \left(\frac{17.3}{\mathrm{Re}} + 0.336\right)\frac{\rho U^2}{d_p}(1-\varepsilon)\varepsilon^{-4.8}",
    fitted={"void_fraction": (0.4, 1.0)},
)
def pressure_gradient_gibilaro(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
) -> PressureGradient:
    """Pressure gradient of fixed and expanded beds of spheres by Gibilaro, Di Felice, Waldram and Foscolo.

    Unlike Ergun's it stays right as the bed opens: at porosity one it is the drag of lonely spheres.

    >>> round(pressure_gradient_gibilaro(superficial_velocity=1e-3, particle_diameter="0.8 mm", void_fraction=0.4, fluid_density=1000,
    ...                                  dynamic_viscosity="1 cP"), 1)
    1339.1
    """
    U, d = superficial_velocity, sphericity * particle_diameter
    viscous = 17.3 * dynamic_viscosity * U / d**2
    return (viscous + 0.336 * fluid_density * U**2 / d) * (1.0 - void_fraction) * void_fraction**-4.8


@formula(
    source="nemec2005",
    equation=r"\frac{\Delta p}{L} = \frac{\eta U(1-\varepsilon)^2}{\varepsilon^3(\psi d_p)^2}\left(\frac{150}{\psi^{3/2}} + \frac{1.75}{\psi^{4/3}}\mathrm{Re}_1\right)",
    fitted={"reynolds_bed": (0.0, 400.0)},
)
def pressure_gradient_nemec_levec(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
) -> PressureGradient:
    """Pressure gradient of a bed of particles that are not spheres by Nemec and Levec: Ergun's with constants that grow with shape.

    >>> round(pressure_gradient_nemec_levec(superficial_velocity=1e-3, particle_diameter="0.8 mm", void_fraction=0.4, fluid_density=1000,
    ...                                     dynamic_viscosity="1 cP"), 2)
    1338.87
    """
    psi = sphericity
    Re, viscous = _group(superficial_velocity, psi * particle_diameter, void_fraction, fluid_density, dynamic_viscosity)
    watch(reynolds_bed=Re)
    return viscous * (150.0 / psi**1.5 + 1.75 / psi ** (4.0 / 3.0) * Re)


@law(
    "pressure_gradient",
    name="eisfeld_schnitzlein",
    source="eisfeld2001",
    equation=r"\frac{\Delta p}{L} = K_1A_w^2\frac{\eta U(1-\varepsilon)^2}{\varepsilon^3 d_p^2} + \frac{A_w}{B_w}\frac{\rho U^2(1-\varepsilon)}{\varepsilon^3d_p},\quad"
    r"A_w = 1 + \frac{2}{3(D/d_p)(1-\varepsilon)},\ B_w = \left[k_1(d_p/D)^2 + k_2\right]^2",
)
class EisfeldSchnitzlein(eqx.Module):
    """Pressure-gradient law with the effect of the column wall, for column over particle diameters below about 20.

    The three constants are 154, 1.15 and 0.87 for spheres, 190, 2.00 and 0.77 for cylinders, 155, 1.42 and 0.83 for all shapes.

    >>> narrow = EisfeldSchnitzlein(diameter=0.01)(0.1, 2e-3, 0.45, 1.2, 1.8e-5, 1.0)
    >>> wide = EisfeldSchnitzlein(diameter=10.0)(0.1, 2e-3, 0.45, 1.2, 1.8e-5, 1.0)
    >>> bool(narrow > wide)
    True
    """

    diameter: Length
    viscous_constant: PositiveNumber = 154.0
    wall_constant: PositiveNumber = 1.15
    core_constant: PositiveNumber = 0.87

    def __call__(
        self,
        superficial_velocity: Speed,
        particle_diameter: Length,
        void_fraction: VoidFraction,
        fluid_density: Density,
        dynamic_viscosity: DynamicViscosity,
        sphericity: Sphericity = 1.0,
    ) -> PressureGradient:
        """Pressure gradient at a superficial velocity."""
        d, e = sphericity * particle_diameter, void_fraction
        A, B = wall_factors(d / self.diameter, e, self.wall_constant, self.core_constant)
        Re, viscous = _group(superficial_velocity, d, e, fluid_density, dynamic_viscosity)
        return viscous * (self.viscous_constant * A**2 + A / B * Re)


def wall_factors(ratio: Any, void_fraction: Any, wall_constant: Any = 1.15, core_constant: Any = 0.87) -> tuple[Any, Any]:
    """Eisfeld and Schnitzlein's A_w (wall surface in the hydraulic radius) and B_w (open structure at the wall)."""
    return 1.0 + 2.0 / 3.0 * ratio / (1.0 - void_fraction), (wall_constant * ratio**2 + core_constant) ** 2


@formula(
    source="eisfeld2001, table 2",
    equation=r"\frac{\Delta p}{L} = 154A_w^2\frac{\eta U(1-\varepsilon)^2}{\varepsilon^3 d_p^2} + \frac{A_w}{B_w}\frac{\rho U^2(1-\varepsilon)}{\varepsilon^3d_p}",
    fitted={"reynolds_bed": (0.01, 2e4), "wall_ratio": (0.0, 0.5)},
    typical={"wall_ratio": (0.0, 0.4)},
)
def pressure_gradient_eisfeld_schnitzlein_spheres(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
    wall_ratio: Annotated[Ratio, Within(0.0, 0.95)] = 0.0,
) -> PressureGradient:
    """Pressure gradient of a bed of spheres in a column of any width by Eisfeld and Schnitzlein; the ratio is d_p over D.

    >>> round(pressure_gradient_eisfeld_schnitzlein_spheres(superficial_velocity=1e-3, particle_diameter="0.8 mm", void_fraction=0.4,
    ...                                                     fluid_density=1000, dynamic_viscosity="1 cP"), 1)
    1369.0
    """
    d, e = sphericity * particle_diameter, void_fraction
    A, B = wall_factors(wall_ratio, e)
    Re, viscous = _group(superficial_velocity, d, e, fluid_density, dynamic_viscosity)
    watch(reynolds_bed=Re)
    return viscous * (154.0 * A**2 + A / B * Re)


class BedNumbers(NamedTuple):
    """Dimensionless groups of flow through a bed."""

    reynolds: Ratio
    reynolds_bed: Ratio
    reynolds_carman: Ratio
    inertial_share: Ratio


@formula(
    source="ergun1952; carman1937",
    equation=r"\mathrm{Re} = \frac{\rho U\psi d_p}{\eta},\ \mathrm{Re}_1 = \frac{\mathrm{Re}}{1-\varepsilon},\ \mathrm{Re}' = \frac{\mathrm{Re}_1}{6},"
    r"\ s = \frac{1.75\,\mathrm{Re}_1}{150 + 1.75\,\mathrm{Re}_1}",
)
def packed_bed_numbers(
    superficial_velocity: Speed,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sphericity: Sphericity = 1.0,
) -> BedNumbers:
    """Reynolds numbers of a bed in the three conventions and the share of inertia in the pressure drop by Ergun.

    Creeping below Re₁ = 10 (inertia below 10 %), turbulent above 1000 (inertia above 92 %).

    >>> found = packed_bed_numbers(superficial_velocity=0.06, particle_diameter="1 mm", void_fraction=0.4, fluid_density=1000,
    ...                            dynamic_viscosity="1 cP")
    >>> round(found.reynolds, 6), round(found.reynolds_bed, 6), round(found.inertial_share, 4)
    (60.0, 100.0, 0.5385)
    """
    Re = fluid_density * superficial_velocity * sphericity * particle_diameter / dynamic_viscosity
    Re1 = Re / (1.0 - void_fraction)
    return BedNumbers(Re, Re1, Re1 / 6.0, 1.75 * Re1 / (150.0 + 1.75 * Re1))
