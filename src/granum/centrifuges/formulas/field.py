"""The centrifugal field: free surface, centrifugal effect, force, liquid pressure, and settling velocities in
it.
"""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Density,
    Distance,
    DynamicViscosity,
    Force,
    Length,
    Mass,
    Position,
    PositiveNumber,
    Pressure,
    RotationSpeed,
    Speed,
    Velocity,
)
from granum.particles.formulas.terminal import Drag, drag_coefficient_brown_lawler, terminal_velocity


@formula(
    source="perry2008, § 18",
    equation=r"y = y_0 + \frac{\omega^2 r^2}{2g}",
    typical={"radius": (0.01, 0.3), "rotation_speed": (1.0, 30.0), "surface_height_center": (0.0, 0.5)},
)
def surface_height_rotating(
    radius: Distance, rotation_speed: RotationSpeed, surface_height_center: Position = 0.0
) -> Position:
    """Height of the free surface of a liquid that turns as a whole about a vertical axis: a paraboloid.

    >>> round(surface_height_rotating(radius="10 cm", rotation_speed="100 rpm"), 4)
    0.0559
    """
    return surface_height_center + (rotation_speed * radius) ** 2 / (2.0 * STANDARD_GRAVITY)


@formula(
    source="perry2008, § 18",
    equation=r"K = \frac{\omega^2 r}{g}",
    typical={"rotation_speed": (50.0, 500.0)},
)
def centrifugal_effect(radius: Length, rotation_speed: RotationSpeed) -> PositiveNumber:
    """Centrifugal effect: acceleration of the field over that of gravity, also called relative centrifugal
    force.

    Known as RCF, g-force or separation factor too. The customary 1.118 · 10⁻⁵ r N² holds for r in centimeters
    and N in turns per minute. Differs from the print in the notes, which have 1.119 · 10⁵.

    >>> round(centrifugal_effect(radius="10 cm", rotation_speed="3000 rpm"))
    1006
    """
    return rotation_speed**2 * radius / STANDARD_GRAVITY


@formula(
    source="perry2008, § 18",
    equation=r"\omega = \sqrt{\frac{K g}{r}}",
    output="rotation_speed",
    title="Rotation speed for a centrifugal effect",
)
def rotation_speed_for_effect(centrifugal_effect: PositiveNumber, radius: Length) -> RotationSpeed:
    """Rotation speed that gives a centrifugal effect at a radius.

    >>> round(rotation_speed_for_effect(centrifugal_effect=1006, radius="10 cm") * 60 / 6.283185307, 0)
    2999.0
    """
    return jnp.sqrt(centrifugal_effect * STANDARD_GRAVITY / radius)


@formula(
    source="perry2008, § 18",
    equation=r"F_c = m\left(1 - \frac{\rho_f}{\rho_p}\right)\omega^2 r",
    typical={"rotation_speed": (50.0, 500.0), "mass": (1e-6, 1.0)},
)
def centrifugal_force(
    mass: Mass,
    radius: Length,
    rotation_speed: RotationSpeed,
    particle_density: Density,
    fluid_density: Density,
) -> Force:
    """Net centrifugal force on a particle in a fluid, its buoyancy taken off; negative when it is driven
    inward.

    Without a fluid it is 0.011 m r N² in newtons for N in turns per minute.

    >>> round(
    ...     centrifugal_force(
    ...         mass=1.0, radius=0.1, rotation_speed="1000 rpm", particle_density=2000, fluid_density=1e-6
    ...     ),
    ...     0,
    ... )
    1097.0
    """
    return mass * (1.0 - fluid_density / particle_density) * rotation_speed**2 * radius


@formula(
    source="perry2008, § 18",
    equation=r"p = \tfrac12\,\rho_l\,\omega^2\,(r^2 - r_i^2)",
    output="liquid_pressure_bowl",
    typical={"radius": (0.2, 0.6), "radius_inner": (0.05, 0.18), "rotation_speed": (50.0, 500.0)},
)
def liquid_pressure_bowl(
    radius: Length, radius_inner: Distance, rotation_speed: RotationSpeed, liquid_density: Density
) -> Pressure:
    """Pressure of a liquid ring at a radius above that at its free surface.

    >>> round(liquid_pressure_bowl(radius=0.5, radius_inner=0.4, rotation_speed=100, liquid_density=1000))
    450000
    """
    return 0.5 * liquid_density * rotation_speed**2 * jnp.maximum(radius**2 - radius_inner**2, 0.0)


@formula(
    source="richardson2002, ch. 9",
    equation=r"v_c = K\,v_t,\quad \mathrm{Re} = \frac{\rho_f v_c d_p}{\eta} \le 2",
    title="Settling velocity in a centrifuge, laminar",
    fitted={"reynolds": (0.0, 2.0)},
    typical={
        "terminal_velocity": (1e-8, 1e-6),
        "particle_diameter": (1e-6, 5e-6),
        "centrifugal_effect": (100.0, 2000.0),
    },
    output="settling_velocity_centrifugal",
)
def settling_velocity_centrifugal_stokes(
    terminal_velocity: Speed,
    centrifugal_effect: PositiveNumber,
    particle_diameter: Length,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
) -> Speed:
    """Settling velocity in a centrifugal field from that under gravity, laminar range: proportional to the
    effect.

    >>> round(settling_velocity_centrifugal_stokes(1e-6, 1000, "1 um", 1000, "1 cP") * 1e3, 6)
    1.0
    """
    v = centrifugal_effect * terminal_velocity
    watch(reynolds=fluid_density * v * particle_diameter / dynamic_viscosity)
    return v


_FAST = {"terminal_velocity": (1e-3, 1e-1), "centrifugal_effect": (100.0, 2000.0)}


@formula(
    source="richardson2002, ch. 9",
    equation=r"v_c = K^{1/1.4}\,v_t",
    title="Settling velocity in a centrifuge, intermediate",
    typical=_FAST,
    output="settling_velocity_centrifugal",
)
def settling_velocity_centrifugal_allen(
    terminal_velocity: Speed, centrifugal_effect: PositiveNumber
) -> Speed:
    """Settling velocity in a centrifugal field from that under gravity, intermediate range with drag
    18.5 Re^−0.6.

    Both velocities must lie in the range. The course notes U print the exponent 2/3 for their own law of that
    range.

    >>> round(settling_velocity_centrifugal_allen(terminal_velocity=0.01, centrifugal_effect=100), 4)
    0.2683
    """
    return centrifugal_effect ** (1.0 / 1.4) * terminal_velocity


@formula(
    source="richardson2002, ch. 9",
    equation=r"v_c = \sqrt{K}\,v_t",
    title="Settling velocity in a centrifuge, turbulent",
    typical=_FAST,
    output="settling_velocity_centrifugal",
)
def settling_velocity_centrifugal_newton(
    terminal_velocity: Speed, centrifugal_effect: PositiveNumber
) -> Speed:
    """Settling velocity in a centrifugal field from that under gravity, turbulent range: as the square root
    of the effect.

    >>> round(settling_velocity_centrifugal_newton(terminal_velocity=0.1, centrifugal_effect=100), 6)
    1.0
    """
    return jnp.sqrt(centrifugal_effect) * terminal_velocity


@formula(
    source="brown2003; richardson2002, ch. 9",
    equation=r"v_c = v_t(d_p, \rho_p, \rho_f, \eta, \omega^2 r)",
    title="Settling velocity in a centrifuge, any range",
    output="settling_velocity_centrifugal",
    typical={"rotation_speed": (50.0, 500.0), "particle_diameter": (1e-6, 1e-4)},
)
def settling_velocity_centrifugal(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    radius: Length,
    rotation_speed: RotationSpeed,
    drag: Drag = drag_coefficient_brown_lawler,
) -> Velocity:
    """Settling velocity of a particle in a centrifugal field under any drag law; outward is positive.

    >>> round(settling_velocity_centrifugal("1 um", 1100, 1000, "1 cP", "10 cm", "3000 rpm") * 1e6, 1)
    54.8
    """
    return terminal_velocity(
        particle_diameter,
        particle_density,
        fluid_density,
        dynamic_viscosity,
        rotation_speed**2 * radius,
        drag,
    )
