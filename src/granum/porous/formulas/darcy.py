"""Creeping flow: Darcy's law in every direction, Forchheimer's extension, Poiseuille's pores."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula, impossible, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Density,
    DynamicViscosity,
    Length,
    Permeability,
    PositiveNumber,
    PressureDifference,
    PressureDrop,
    Ratio,
    ReciprocalLength,
    Velocity,
    Within,
)

AGAINST = "Velocity and pressure drop have opposite signs, or one of them is zero."


@formula(source="darcy1856; scheidegger1974", equation=r"\Delta p = \frac{\eta L}{B}U")
def pressure_drop_darcy(
    superficial_velocity: Velocity,
    permeability: Permeability,
    dynamic_viscosity: DynamicViscosity,
    length: Length,
) -> PressureDifference:
    """Pressure drop of a layer in creeping flow by Darcy.

    >>> round(
    ...     pressure_drop_darcy(
    ...         superficial_velocity="1 cm/s", permeability="1 darcy", dynamic_viscosity="1 cP", length="1 cm"
    ...     )
    ... )
    101325
    """
    return dynamic_viscosity * length / permeability * superficial_velocity


@formula(source="darcy1856; scheidegger1974", equation=r"U = \frac{B}{\eta}\frac{\Delta p}{L}")
def superficial_velocity_darcy(
    pressure_drop: PressureDifference,
    permeability: Permeability,
    dynamic_viscosity: DynamicViscosity,
    length: Length,
) -> Velocity:
    """Superficial velocity through a layer in creeping flow by Darcy.

    >>> round(
    ...     100
    ...     * superficial_velocity_darcy(
    ...         pressure_drop="1 atm", permeability="1 darcy", dynamic_viscosity="1 cP", length="1 cm"
    ...     ),
    ...     6,
    ... )
    1.0
    """
    return permeability * pressure_drop / (dynamic_viscosity * length)


@formula(source="darcy1856; scheidegger1974", equation=r"B = \frac{\eta L U}{\Delta p}")
def permeability_darcy(
    superficial_velocity: Velocity,
    pressure_drop: PressureDifference,
    dynamic_viscosity: DynamicViscosity,
    length: Length,
) -> Permeability:
    """Permeability of a layer from one measured velocity and pressure drop in creeping flow.

    One darcy is 0.9869e-12 m²: 1 cP, 1 cm/s, 1 atm per cm. Velocity and pressure drop must have the same
    sign.

    >>> permeability_darcy(
    ...     superficial_velocity="1 cm/s", pressure_drop="1 atm", dynamic_viscosity="1 cP", length="1 cm"
    ... )
    9.869232667160...e-13
    """
    measured = pressure_drop * superficial_velocity > 0.0
    impossible(~measured, pressure_drop, "pressure_drop", reason=AGAINST)
    B = dynamic_viscosity * length * superficial_velocity / jnp.where(measured, pressure_drop, 1.0)
    return jnp.where(measured, B, jnp.nan)


@formula(source="darcy1856; bear1972", equation=r"K = \frac{B\rho_f g}{\eta}")
def hydraulic_conductivity(
    permeability: Permeability,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Velocity:
    """Hydraulic conductivity: velocity of a liquid through a layer under a head loss equal to its length.

    One darcy with water at 20 °C is about 0.83 m a day.

    >>> round(
    ...     86400
    ...     * hydraulic_conductivity(permeability="1 darcy", fluid_density=998, dynamic_viscosity="1.002 cP"),
    ...     2,
    ... )
    0.83
    """
    return permeability * fluid_density * gravity / dynamic_viscosity


@formula(
    source="darcy1856; bear1972",
    title="Permeability from the hydraulic conductivity",
    equation=r"B = \frac{K\eta}{\rho_f g}",
    typical={"hydraulic_conductivity": (1e-6, 1e-2)},
)
def permeability_from_conductivity(
    hydraulic_conductivity: Velocity,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Permeability:
    """Permeability from the hydraulic conductivity that hydrology uses.

    >>> permeability_from_conductivity(
    ...     hydraulic_conductivity=1e-4, fluid_density=1000, dynamic_viscosity="1 cP", gravity=10.0
    ... )
    1.0...e-11
    """
    impossible(~(hydraulic_conductivity > 0), hydraulic_conductivity, "hydraulic_conductivity", 0.0, jnp.inf)
    return hydraulic_conductivity * dynamic_viscosity / (fluid_density * gravity)


@formula(
    source="forchheimer1901; bear1972", equation=r"\frac{\Delta p}{L} = \frac{\eta}{B}U + \beta\rho_f U|U|"
)
def pressure_drop_forchheimer(
    superficial_velocity: Velocity,
    permeability: Permeability,
    inertial_coefficient: ReciprocalLength,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    length: Length,
) -> PressureDifference:
    """Pressure drop of a layer with inertia by Forchheimer; the inertial coefficient is in 1/m.

    >>> round(
    ...     pressure_drop_forchheimer(
    ...         superficial_velocity=0.1,
    ...         permeability=1e-9,
    ...         inertial_coefficient=1e4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...         length=0.1,
    ...     )
    ... )
    20000
    """
    U = superficial_velocity
    return length * (dynamic_viscosity / permeability * U + inertial_coefficient * fluid_density * U * abs(U))


@formula(
    source="forchheimer1901; bear1972",
    equation=r"U = \frac{2\,\Delta p/L}{\eta/B + \sqrt{(\eta/B)^2 + 4\beta\rho_f|\Delta p|/L}}",
)
def superficial_velocity_forchheimer(
    pressure_drop: PressureDifference,
    permeability: Permeability,
    inertial_coefficient: ReciprocalLength,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    length: Length,
) -> Velocity:
    """Superficial velocity through a layer with inertia from the pressure drop: Forchheimer's quadratic
    solved.

    >>> round(
    ...     superficial_velocity_forchheimer(
    ...         pressure_drop=20000.0,
    ...         permeability=1e-9,
    ...         inertial_coefficient=1e4,
    ...         fluid_density=1000,
    ...         dynamic_viscosity="1 cP",
    ...         length=0.1,
    ...     ),
    ...     9,
    ... )
    0.1
    """
    viscous = dynamic_viscosity / permeability
    gradient = pressure_drop / length
    return (
        2.0
        * gradient
        / (viscous + jnp.sqrt(viscous**2 + 4.0 * inertial_coefficient * fluid_density * abs(gradient)))
    )


@formula(source="bear1972; forchheimer1901", equation=r"\mathrm{Fo} = \frac{B\beta\rho_f U}{\eta}")
def forchheimer_number(
    superficial_velocity: Velocity,
    permeability: Permeability,
    inertial_coefficient: ReciprocalLength,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
) -> Ratio:
    """Forchheimer number: inertial over viscous part of the pressure drop. Darcy's law holds within 10 %
    below 0.1.

    >>> forchheimer_number(
    ...     superficial_velocity=0.1,
    ...     permeability=1e-9,
    ...     inertial_coefficient=1e4,
    ...     fluid_density=1000,
    ...     dynamic_viscosity="1 cP",
    ... )
    1.0
    """
    return permeability * inertial_coefficient * fluid_density * abs(superficial_velocity) / dynamic_viscosity


@formula(
    source="poiseuille1846; white2006",
    equation=r"\Delta p = 32\,\gamma\,\frac{\eta L U}{d_h^2}",
    typical={"noncircularity": (0.83, 1.5), "pore_diameter": (1e-6, 1e-3)},
    symbols={"velocity": "U", "pore_diameter": "d_h"},
)
def pressure_drop_poiseuille(
    velocity: Velocity,
    pore_diameter: Length,
    dynamic_viscosity: DynamicViscosity,
    length: Length,
    noncircularity: Annotated[PositiveNumber, Within(0.5, 2.0)] = 1.0,
) -> PressureDifference:
    """Pressure drop of laminar flow in a straight conduit of any section, on the hydraulic diameter.

    The factor is 1 for a circle, 0.83 for an equilateral triangle, 0.89 for a square and 1.5 for a slit.

    >>> round(
    ...     pressure_drop_poiseuille(
    ...         velocity=0.01, pore_diameter="100 um", dynamic_viscosity="1 cP", length="1 cm"
    ...     ),
    ...     3,
    ... )
    320.0
    """
    return 32.0 * noncircularity * dynamic_viscosity * length * velocity / pore_diameter**2


@formula(
    source="shah1978, eq. 341",
    title="Non-circularity of a rectangular channel",
    equation=r"\gamma = \tfrac32\left(1 - 1.3553a + 1.9467a^2 - 1.7012a^3 + 0.9564a^4 - 0.2537a^5\right)",
    typical={"side_ratio": (0.0, 1.0)},
)
def noncircularity_rectangle(side_ratio: Annotated[Ratio, Within(0.0, 1.0)]) -> PositiveNumber:
    """Non-circularity factor of a rectangle from its short over long side: 1.5 for a slit, 0.889 for a
    square.

    >>> round(noncircularity_rectangle(side_ratio=0.0), 3), round(noncircularity_rectangle(side_ratio=1.0), 3)
    (1.5, 0.889)
    """
    a = side_ratio
    return 1.5 * (1.0 - 1.3553 * a + 1.9467 * a**2 - 1.7012 * a**3 + 0.9564 * a**4 - 0.2537 * a**5)


@formula(
    source="klinkenberg1941; ziarani2012",
    equation=r"B_g = B\left(1 + \frac{b}{p}\right)",
    fitted={"klinkenberg_ratio": (0.0, 0.4)},
    typical={"klinkenberg_pressure": (1e3, 1e5)},
    symbols={"=permeability": "B_g"},
)
def permeability_klinkenberg(
    permeability: Permeability, pressure: PressureDrop, klinkenberg_pressure: PressureDrop
) -> Permeability:
    """Apparent permeability to a gas with slip on the pore walls, at the mean pressure.

    For mean free paths up to a tenth of the pore radius (Ziarani and Aguilera), where b/p is 0.4.

    >>> permeability_klinkenberg(permeability=1e-15, pressure=1e5, klinkenberg_pressure=2e4)
    1.2...e-15
    """
    watch(klinkenberg_ratio=klinkenberg_pressure / pressure)
    return permeability * (1.0 + klinkenberg_pressure / pressure)
