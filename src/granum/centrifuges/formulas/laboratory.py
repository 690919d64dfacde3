"""Laboratory centrifuges: sedimentation coefficient, rotors, pelleting time, differential centrifugation."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import GAS_CONSTANT
from granum.core.flags import impossible
from granum.core.kinds import (
    Density,
    Diffusivity,
    DynamicViscosity,
    Fraction,
    Length,
    MolarMass,
    PositiveNumber,
    RotationSpeed,
    SpecificVolume,
    Speed,
    Temperature,
    Time,
)

TOP_BELOW = "The inner radius, at the top of the liquid, must be smaller than the outer one."
FLOATS = "Specific volume times density of the fluid reaches 1: the particle does not settle."
FLOATS_IN_WATER = "The particle would not settle in water at 20 °C."
WATER_20 = 998.2  # kg/m³

_ROTOR = {"radius_inner": (0.03, 0.06), "radius_outer": (0.08, 0.12), "rotation_speed": (500.0, 5000.0)}


@formula(
    source="svedberg1940",
    equation=r"s = \frac{v}{\omega^2 r}",
    typical={"velocity": (1e-9, 1e-6), "rotation_speed": (500.0, 6000.0)},
)
def sedimentation_coefficient(velocity: Speed, radius: Length, rotation_speed: RotationSpeed) -> Time:
    """Sedimentation coefficient from a velocity in a centrifugal field: one svedberg is 10⁻¹³ s.

    >>> round(sedimentation_coefficient(velocity=1e-7, radius=0.065, rotation_speed=6283.185) * 1e13, 3)
    0.39
    """
    return velocity / (rotation_speed**2 * radius)


@formula(
    source="svedberg1940",
    equation=r"s = \frac{d_p^2(\rho_p - \rho_f)}{18\,\eta}",
    typical={"particle_diameter": (1e-8, 1e-6)},
)
def sedimentation_coefficient_stokes(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
) -> Time:
    """Sedimentation coefficient of a small sphere by Stokes' law.

    >>> round(sedimentation_coefficient_stokes("100 nm", 1100, 1000, "1 cP") * 1e13)
    556
    """
    return (
        particle_diameter**2 * jnp.maximum(particle_density - fluid_density, 0.0) / (18.0 * dynamic_viscosity)
    )


@formula(
    source="svedberg1940",
    title="Sedimentation coefficient in water at 20 °C",
    equation=r"s_{20,w} = s\,\frac{\eta}{\eta_{20,w}}\,\frac{1 - \bar v\rho_{20,w}}{1 - \bar v\rho_f}",
    typical={
        "sedimentation_coefficient": (1e-13, 1e-11),
        "partial_specific_volume": (5e-4, 8e-4),
        "fluid_density": (990.0, 1050.0),
    },
    output="sedimentation_coefficient",
    symbols={"=sedimentation_coefficient": "s_{20,w}"},
)
def sedimentation_coefficient_standard(
    sedimentation_coefficient: Time,
    partial_specific_volume: SpecificVolume,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
) -> Time:
    """Sedimentation coefficient carried over to water at 20 °C, the standard state.

    >>> round(sedimentation_coefficient_standard(4e-13, 0.73e-3, 998.2, 1.002e-3) * 1e13, 6)
    4.0
    """
    impossible(
        ~(partial_specific_volume * fluid_density < 1.0),
        fluid_density,
        "fluid_density",
        0.0,
        1.0 / partial_specific_volume,
        FLOATS,
    )
    water = 1.0 - partial_specific_volume * WATER_20
    impossible(
        ~(water > 0.0),
        partial_specific_volume,
        "partial_specific_volume",
        0.0,
        1.0 / WATER_20,
        FLOATS_IN_WATER,
    )
    return (
        sedimentation_coefficient
        * dynamic_viscosity
        / 1.002e-3
        * water
        / (1.0 - partial_specific_volume * fluid_density)
    )


@formula(
    source="svedberg1940",
    title="Molar mass by sedimentation (Svedberg)",
    equation=r"M = \frac{s\,R\,T}{D\,(1 - \bar v\,\rho_f)}",
    output="molar_mass",
    typical={
        "sedimentation_coefficient": (1e-13, 1e-11),
        "partial_specific_volume": (5e-4, 8e-4),
        "fluid_density": (990.0, 1050.0),
        "diffusivity": (1e-11, 1e-10),
    },
)
def molar_mass_svedberg(
    sedimentation_coefficient: Time,
    diffusivity: Diffusivity,
    partial_specific_volume: SpecificVolume,
    fluid_density: Density,
    temperature: Temperature = 293.15,
) -> MolarMass:
    """Molar mass of a macromolecule from sedimentation and diffusion coefficients (Svedberg's equation).

    Hemoglobin: s = 4.31 svedberg, D = 6.9e-11 m²/s, specific volume 0.749 cm³/g.

    >>> round(molar_mass_svedberg(4.31e-13, 6.9e-11, 0.749e-3, 998.2), 1)
    60.3
    """
    impossible(
        ~(partial_specific_volume * fluid_density < 1.0),
        fluid_density,
        "fluid_density",
        0.0,
        1.0 / partial_specific_volume,
        FLOATS,
    )
    return (
        sedimentation_coefficient
        * GAS_CONSTANT
        * temperature
        / (diffusivity * (1.0 - partial_specific_volume * fluid_density))
    )


@formula(
    source="graham2001",
    equation=r"t = \frac{\ln(r_o/r_i)}{\omega^2 s}",
    typical={**_ROTOR, "sedimentation_coefficient": (1e-12, 1e-9)},
)
def pelleting_time(
    radius_inner: Length, radius_outer: Length, rotation_speed: RotationSpeed, sedimentation_coefficient: Time
) -> Time:
    """Time to pellet all particles of a sedimentation coefficient between two radii of a rotor.

    In a fixed-angle rotor the radii are those at the top and the bottom of the liquid in the tilted tube.

    >>> round(pelleting_time("5 cm", "10 cm", "40000 rpm", 80e-13) / 60, 1)
    82.3
    """
    impossible(~(radius_inner < radius_outer), radius_inner, "radius_inner", 0.0, radius_outer, TOP_BELOW)
    return jnp.log(radius_outer / radius_inner) / (rotation_speed**2 * sedimentation_coefficient)


@formula(
    source="graham2001",
    equation=r"k = \frac{10^{13}}{3600}\,\frac{\ln(r_o/r_i)}{\omega^2}",
    typical=_ROTOR,
)
def clearing_factor(
    radius_inner: Length, radius_outer: Length, rotation_speed: RotationSpeed
) -> PositiveNumber:
    """Clearing factor (k-factor) of a rotor: pelleting hours times svedberg.

    The customary 2.53 · 10⁵ ln(r_max/r_min)/(N/1000)². At another speed it goes as the inverse square.

    >>> round(clearing_factor("5 cm", "10 cm", "40000 rpm"), 1)
    109.7
    """
    impossible(~(radius_inner < radius_outer), radius_inner, "radius_inner", 0.0, radius_outer, TOP_BELOW)
    return 1e13 / 3600.0 * jnp.log(radius_outer / radius_inner) / rotation_speed**2


@formula(
    source="graham2001",
    equation=r"t_2 = t_1\,\frac{k_2}{k_1}",
    output="pelleting_time",
    title="Pelleting time in another rotor",
    typical={"clearing_factor": (20.0, 300.0), "clearing_factor_other": (20.0, 300.0)},
    symbols={
        "time": "t_1",
        "clearing_factor": "k_1",
        "clearing_factor_other": "k_2",
        "pelleting_time": "t_2",
    },
)
def pelleting_time_other_rotor(
    time: Time, clearing_factor: PositiveNumber, clearing_factor_other: PositiveNumber
) -> Time:
    """Time that pellets in another rotor what a known run pellets in this one.

    >>> round(
    ...     pelleting_time_other_rotor(time="1 hour", clearing_factor=50, clearing_factor_other=125) / 3600, 6
    ... )
    2.5
    """
    return time * clearing_factor_other / clearing_factor


@formula(
    source="graham2001",
    equation=r"f = \frac{r_o - \max(r_i,\,r_oe^{-s\omega^2 t})}{r_o - r_i}",
    typical={**_ROTOR, "sedimentation_coefficient": (1e-12, 1e-10), "time": (60.0, 600.0)},
)
def pelleted_fraction(
    sedimentation_coefficient: Time,
    time: Time,
    rotation_speed: RotationSpeed,
    radius_inner: Length,
    radius_outer: Length,
) -> Fraction:
    """Fraction of a kind of particle that has reached the bottom of an evenly filled tube of constant
    section.

    One step of differential centrifugation: large particles are in the pellet with this share of the smaller
    ones. Start the next step with what is left.

    >>> round(pelleted_fraction(1e-9, 60, 500, "5 cm", "10 cm"), 4)
    0.0298
    """
    impossible(~(radius_inner < radius_outer), radius_inner, "radius_inner", 0.0, radius_outer, TOP_BELOW)
    reached = radius_outer * jnp.exp(-sedimentation_coefficient * rotation_speed**2 * time)
    return (radius_outer - jnp.maximum(radius_inner, reached)) / (radius_outer - radius_inner)
