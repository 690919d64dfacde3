"""Pressure gradient of packed beds, laws since 1970: high Reynolds numbers, expanded beds, shapes, walls.
Called as in ``packed_beds``.
"""

from __future__ import annotations

from typing import Annotated, Any

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
from granum.particles.definitions import reynolds_of
from granum.porous.definitions import BED_REYNOLDS
from granum.porous.formulas.packed_beds import bed_group


@formula(
    source="tallmadge1970",
    equation=(
        r"\frac{\Delta p}{L} = f\,\frac{\rho_f\,U^2(1-\varepsilon)}{\varepsilon^3\psi\,d_p},\quad f = "
        r"\frac{150}{\mathrm{Re}_1} + \frac{4.2}{\mathrm{Re}_1^{1/6}}"
    )
    + BED_REYNOLDS,
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

    >>> round(
    ...     pressure_gradient_tallmadge(
    ...         superficial_velocity=1e-3,
    ...         particle_diameter="0.8 mm",
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     1,
    ... )
    1365.3
    """
    Re, viscous = bed_group(
        superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity
    )
    watch(reynolds_bed=Re)
    return viscous * (150.0 + 4.2 * jnp.maximum(Re, 1e-30) ** (5.0 / 6.0))


@formula(
    source="erdim2015",
    equation=(
        r"\frac{\Delta p}{L} = \frac{\eta U(1-\varepsilon)^2}{\varepsilon^3 (\psi d_p)^2}\left(160 + "
        r"2.81\,\mathrm{Re}_1^{0.904}\right)"
    )
    + BED_REYNOLDS,
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
    """Pressure gradient of a bed of spheres by Erdim, Akgiray and Demir, the best of 38 equations in their
    review.

    >>> round(
    ...     pressure_gradient_erdim(
    ...         superficial_velocity=2e-3,
    ...         particle_diameter="0.8 mm",
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     1,
    ... )
    2932.4
    """
    Re, viscous = bed_group(
        superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity
    )
    watch(reynolds_bed=Re)
    return viscous * (160.0 + 2.81 * jnp.maximum(Re, 1e-30) ** 0.904)


@formula(
    source="brauer1971",
    equation=(
        r"\frac{\Delta p}{L} = \frac{\eta U(1-\varepsilon)^2}{\varepsilon^3 (\psi d_p)^2}\left(160 + "
        r"3.1\,\mathrm{Re}_1^{0.9}\right)"
    )
    + BED_REYNOLDS,
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

    >>> round(
    ...     pressure_gradient_brauer(
    ...         superficial_velocity=1e-3,
    ...         particle_diameter="0.8 mm",
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     1,
    ... )
    1441.5
    """
    Re, viscous = bed_group(
        superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity
    )
    watch(reynolds_bed=Re)
    return viscous * (160.0 + 3.1 * jnp.maximum(Re, 1e-30) ** 0.9)


@formula(
    source="kta1981",
    title="Pressure gradient of a pebble bed (KTA)",
    equation=(
        r"\frac{\Delta p}{L} = f\,\frac{\rho_f\,U^2(1-\varepsilon)}{\varepsilon^3\psi\,d_p},\quad f = "
        r"\frac{160}{\mathrm{Re}_1} + \frac{3}{\mathrm{Re}_1^{0.1}}"
    )
    + BED_REYNOLDS,
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

    >>> round(
    ...     pressure_gradient_kta(
    ...         superficial_velocity=1e-3,
    ...         particle_diameter="0.8 mm",
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     1,
    ... )
    1440.4
    """
    Re, viscous = bed_group(
        superficial_velocity, sphericity * particle_diameter, void_fraction, fluid_density, dynamic_viscosity
    )
    watch(reynolds_bed=Re)
    return viscous * (160.0 + 3.0 * jnp.maximum(Re, 1e-30) ** 0.9)


@formula(
    source="gibilaro1985",
    equation=(
        r"\frac{\Delta p}{L} = \left(\frac{17.3}{\mathrm{Re}} + 0.336\right)\frac{\rho_f "
        r"U^2}{d_p}(1-\varepsilon)\varepsilon^{-4.8}"
    )
    + reynolds_of("U"),
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

    >>> round(
    ...     pressure_gradient_gibilaro(
    ...         superficial_velocity=1e-3,
    ...         particle_diameter="0.8 mm",
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     1,
    ... )
    1339.1
    """
    U, d = superficial_velocity, sphericity * particle_diameter
    viscous = 17.3 * dynamic_viscosity * U / d**2
    return (viscous + 0.336 * fluid_density * U**2 / d) * (1.0 - void_fraction) * void_fraction**-4.8


@formula(
    source="nemec2005",
    equation=(
        r"\frac{\Delta p}{L} = \frac{\eta U(1-\varepsilon)^2}{\varepsilon^3(\psi "
        r"d_p)^2}\left(\frac{150}{\psi^{3/2}} + \frac{1.75}{\psi^{4/3}}\mathrm{Re}_1\right)"
    )
    + BED_REYNOLDS,
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
    """Pressure gradient of a bed of particles that are not spheres by Nemec and Levec: Ergun's with constants
    that grow with shape.

    >>> round(
    ...     pressure_gradient_nemec_levec(
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
    psi = sphericity
    Re, viscous = bed_group(
        superficial_velocity, psi * particle_diameter, void_fraction, fluid_density, dynamic_viscosity
    )
    watch(reynolds_bed=Re)
    return viscous * (150.0 / psi**1.5 + 1.75 / psi ** (4.0 / 3.0) * Re)


@law(
    "pressure_gradient",
    name="eisfeld_schnitzlein",
    source="eisfeld2001",
    equation=r"\frac{\Delta p}{L} = K_1A_w^2\frac{\eta U(1-\varepsilon)^2}{\varepsilon^3 d_p^2} + \frac{A_w}{B_w}\frac{\rho U^2(1-\varepsilon)}{\varepsilon^3d_p},\quad "  # noqa: E501
    r"A_w = 1 + \frac{2}{3(D/d_p)(1-\varepsilon)},\ B_w = \left[k_1(d_p/D)^2 + k_2\right]^2",
)
class EisfeldSchnitzlein(eqx.Module):
    """Pressure-gradient law with the effect of the column wall, for column over particle diameters below
    about 20.

    The three constants are 154, 1.15 and 0.87 for spheres, 190, 2.00 and 0.77 for cylinders, 155, 1.42 and
    0.83 for all shapes.

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
        Re, viscous = bed_group(superficial_velocity, d, e, fluid_density, dynamic_viscosity)
        return viscous * (self.viscous_constant * A**2 + A / B * Re)


def wall_factors(
    ratio: Any, void_fraction: Any, wall_constant: Any = 1.15, core_constant: Any = 0.87
) -> tuple[Any, Any]:
    """Eisfeld and Schnitzlein's A_w (wall surface in the hydraulic radius) and B_w (open structure at the
    wall).
    """
    return 1.0 + 2.0 / 3.0 * ratio / (1.0 - void_fraction), (wall_constant * ratio**2 + core_constant) ** 2


@formula(
    source="eisfeld2001, table 2",
    equation=(
        r"\frac{\Delta p}{L} = 154A_w^2\frac{\eta U(1-\varepsilon)^2}{\varepsilon^3 d_p^2} + "
        r"\frac{A_w}{B_w}\frac{\rho_f U^2(1-\varepsilon)}{\varepsilon^3d_p}"
    ),
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
    """Pressure gradient of a bed of spheres in a column of any width by Eisfeld and Schnitzlein; the ratio is
    d_p over D.

    >>> round(
    ...     pressure_gradient_eisfeld_schnitzlein_spheres(
    ...         superficial_velocity=1e-3,
    ...         particle_diameter="0.8 mm",
    ...         void_fraction=0.4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...     ),
    ...     1,
    ... )
    1369.0
    """
    d, e = sphericity * particle_diameter, void_fraction
    A, B = wall_factors(wall_ratio, e)
    Re, viscous = bed_group(superficial_velocity, d, e, fluid_density, dynamic_viscosity)
    watch(reynolds_bed=Re)
    return viscous * (154.0 * A**2 + A / B * Re)
