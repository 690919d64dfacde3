"""What drives a bowl and what holds it: power of feed acceleration and of the air around it, nozzles, hoop
stress, critical speed.
"""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.flags import impossible
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Fraction,
    Length,
    MassFlow,
    PositiveNumber,
    Power,
    PressureDifference,
    RotationSpeed,
    Stress,
    Time,
    Volume,
    VolumeFlow,
    Within,
)
from granum.numerics import find_root

INSIDE_OUT = "The free surface lies within the bowl: its radius is the smaller one."
LONGEST = 30 * 86400.0  # s, what an interval is told to be where nothing or nearly nothing settles

_BOWL = {
    "bowl_radius": (0.05, 0.5),
    "bowl_length": (0.3, 2.0),
    "rotation_speed": (100.0, 1500.0),
}


@formula(
    source="records2001; leung1998",
    equation=r"P_a = \dot m\,\omega^2 r^2",
    output="power_acceleration",
    typical={"mass_flow": (0.1, 20.0), "radius": (0.05, 0.4), "rotation_speed": (100.0, 1000.0)},
)
def power_acceleration(mass_flow: MassFlow, radius: Length, rotation_speed: RotationSpeed) -> Power:
    """Power that brings a flow to the speed of the bowl and lets it go at a radius: half is its kinetic
    energy, half is lost in the acceleration.

    >>> round(power_acceleration("10 t/hour", "10 cm", "3000 rpm"))
    2742
    """
    return mass_flow * (rotation_speed * radius) ** 2


@formula(
    source="theodorsen1944; karman1921",
    equation=(
        r"P_w = \pi\,C_D\,\rho\,\omega^3 R^4 L + 0.073\,\rho\,\omega^3 R^5\,\mathrm{Re}^{-1/5},\quad "
        r"\frac{1}{\sqrt{C_D}} = -0.6 + 4.07\,\lg\left(\mathrm{Re}\sqrt{C_D}\right),\quad "
        r"\mathrm{Re} = \frac{\rho\,\omega R^2}{\eta}"
    ),
    output="power_windage",
    typical=_BOWL,
    fitted={"reynolds": (1e4, 1e8)},
)
def power_windage(
    bowl_radius: Length,
    bowl_length: Length,
    rotation_speed: RotationSpeed,
    fluid_density: Density = 1.2,
    dynamic_viscosity: DynamicViscosity = 1.8e-5,
) -> Power:
    """Power that the air around a smooth bowl takes up: the drag of its shell after Theodorsen and Regier,
    that of its two faces after von Kármán.

    For a bowl that turns freely in still gas: in a close casing the air turns along and takes less, bolts and
    ports take more. The report with the law of the shell could not be opened; that of the faces was read in a
    textbook problem (Bird, Stewart and Lightfoot).

    >>> round(power_windage("15 cm", "30 cm", "7000 rpm"))
    800
    """
    Re = fluid_density * rotation_speed * bowl_radius**2 / dynamic_viscosity
    watch(reynolds=Re)
    counted = jnp.maximum(Re, 100.0)

    def off(x, reynolds):
        return 1.0 / x + 0.6 - 4.07 * jnp.log10(reynolds * x)

    drag = find_root(off, 1e-3, 1.0, counted).value ** 2
    inertia = fluid_density * rotation_speed**3 * bowl_radius**4
    return inertia * (jnp.pi * drag * bowl_length + 0.073 * bowl_radius * counted**-0.2)


@formula(
    source="leung1998",
    equation=r"Q = n\,C_d\,\frac{\pi d^2}{4}\,\omega\sqrt{R^2 - r_i^2}",
    output="volume_flow",
    typical={
        "nozzle_number": (4, 24),
        "nozzle_diameter": (8e-4, 3e-3),
        "rotation_speed": (300.0, 800.0),
        "bowl_radius": (0.2, 0.5),
        "radius_inner": (0.05, 0.15),
    },
    title="Flow through the nozzles of a bowl",
)
def nozzle_flow_bowl(
    nozzle_number: PositiveNumber,
    nozzle_diameter: Length,
    rotation_speed: RotationSpeed,
    bowl_radius: Length,
    radius_inner: Length,
    discharge_coefficient: Fraction = 0.7,
) -> VolumeFlow:
    """Flow through the nozzles at the rim of a bowl, by Bernoulli's law: the pressure of the liquid ring
    drives it, and its density cancels.

    >>> round(nozzle_flow_bowl(12, "1.5 mm", "4500 rpm", "25 cm", "8 cm") * 3600, 2)
    5.96
    """
    impossible(~(radius_inner < bowl_radius), radius_inner, "radius_inner", 0.0, bowl_radius, INSIDE_OUT)
    ring = jnp.maximum(bowl_radius**2 - radius_inner**2, 1e-30)
    area = nozzle_number * jnp.pi / 4.0 * nozzle_diameter**2
    return discharge_coefficient * area * rotation_speed * jnp.sqrt(ring)


@formula(
    source="leung1998",
    equation=r"t_s = \frac{V_s}{Q}",
    output="discharge_interval",
    typical={"sludge_volume": (1e-3, 2e-2), "volume_flow": (1e-7, 1e-4)},
)
def discharge_interval(sludge_volume: Volume, volume_flow: VolumeFlow) -> Time:
    """Time in which the sediment fills the sludge space of a bowl: the interval between two discharges.

    Told as 30 days where nothing, or nearly nothing, settles.

    >>> round(discharge_interval("6 L", "36 L/hour") / 60)
    10
    """
    return jnp.minimum(sludge_volume / jnp.maximum(volume_flow, 1e-30), LONGEST)


@formula(
    source="perry2008, § 18; budynas2015, ch. 3",
    fitted={"thickness_ratio": (0.0, 0.1)},
    equation=r"\sigma_\theta = \rho_m\,\omega^2 R^2 + \frac{p R}{s}",
    typical={
        "bowl_radius": (0.1, 0.5),
        "wall_thickness": (5e-3, 3e-2),
        "rotation_speed": (100.0, 600.0),
        "liquid_pressure_bowl": (1e5, 5e6),
    },
)
def hoop_stress_bowl(
    bowl_radius: Length,
    wall_thickness: Length,
    rotation_speed: RotationSpeed,
    liquid_pressure_bowl: Annotated[PressureDifference, Within(0.0, 1e8)],
    wall_density: Density = 7850.0,
) -> Stress:
    """Hoop stress in a thin bowl wall: its own weight in the field and the pressure of its contents.

    A wall counts as thin up to a tenth of its radius (Budynas and Nisbett).

    >>> round(hoop_stress_bowl(0.3, 0.01, 300, 1e6) / 1e6, 1)
    93.6
    """
    watch(thickness_ratio=wall_thickness / bowl_radius)
    return (
        wall_density * (rotation_speed * bowl_radius) ** 2
        + liquid_pressure_bowl * bowl_radius / wall_thickness
    )


@formula(
    source="budynas2015, eq. 7-22",
    title="First critical speed of a bowl",
    equation=(
        r"\omega_c = \left(\frac{\pi}{L}\right)^2\sqrt{\frac{E I}{m'}},\quad I = \pi R^3 s,\quad "
        r"m' = 2\pi R s\,\rho_m + \pi (R^2 - r_i^2)\,\rho_l"
    ),
    output="critical_speed",
    typical={
        "bowl_length": (0.4, 3.0),
        "bowl_radius": (0.1, 0.4),
        "radius_inner": (0.02, 0.09),
        "wall_thickness": (5e-3, 1e-2),
        "elastic_modulus": (1e11, 2.1e11),
    },
    fitted={"thickness_ratio": (0.0, 0.1)},
)
def critical_speed_bowl(
    bowl_length: Length,
    bowl_radius: Length,
    radius_inner: Length,
    wall_thickness: Length,
    liquid_density: Density = 1000.0,
    wall_density: Density = 7850.0,
    elastic_modulus: Stress = 2.0e11,
) -> RotationSpeed:
    """First critical speed of a long bowl between two stiff bearings: a thin tube that bends with its liquid.

    Soft bearings lower it. Shafts are kept below half their critical speed. A wall counts as thin up to a
    tenth of its radius (Budynas and Nisbett).

    >>> round(critical_speed_bowl("70 cm", "10 cm", "5 cm", "8 mm") * 60 / 6.283185307, -2)
    54300.0
    """
    watch(thickness_ratio=wall_thickness / bowl_radius)
    impossible(~(elastic_modulus > 0), elastic_modulus, "elastic_modulus", 0.0, jnp.inf)
    inertia = jnp.pi * bowl_radius**3 * wall_thickness
    ring = jnp.maximum(bowl_radius**2 - radius_inner**2, 0.0)
    mass = 2.0 * jnp.pi * bowl_radius * wall_thickness * wall_density + jnp.pi * ring * liquid_density
    stiffness = jnp.where(elastic_modulus > 0, elastic_modulus, 1.0) * inertia
    return (jnp.pi / bowl_length) ** 2 * jnp.sqrt(stiffness / mass)
