"""Very small particles: slip in a gas and Brownian motion, which sets the lower end of settling."""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.constants import BOLTZMANN, GAS_CONSTANT, STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Density,
    Diffusivity,
    Distance,
    DynamicViscosity,
    Law,
    Length,
    MolarMass,
    PositiveNumber,
    Pressure,
    Ratio,
    Temperature,
    Time,
    Velocity,
)


@formula(
    source="hinds1999, chapter 2",
    equation=r"\lambda = \frac{\eta}{p}\sqrt{\frac{\pi R T}{2 M}}",
    typical={"dynamic_viscosity": (1e-5, 3e-5)},
)
def mean_free_path(
    temperature: Temperature, pressure: Pressure, dynamic_viscosity: DynamicViscosity, molar_mass: MolarMass
) -> Length:
    """Mean free path of the molecules of a gas from its viscosity.

    Air at 20 °C and 1 atm: 65 nm.

    >>> round(
    ...     1e9
    ...     * mean_free_path(
    ...         temperature="20 degC", pressure="1 atm", dynamic_viscosity=1.81e-5, molar_mass="28.96 g/mol"
    ...     ),
    ...     1,
    ... )
    65.0
    """
    return dynamic_viscosity / pressure * jnp.sqrt(jnp.pi * GAS_CONSTANT * temperature / (2.0 * molar_mass))


@formula(
    source="hinds1999, chapter 3",
    equation=r"\mathrm{Kn} = \frac{2\lambda}{d_p}",
    typical={"mean_free_path": (5e-8, 1e-7), "particle_diameter": (1e-8, 1e-5)},
)
def knudsen_number(particle_diameter: Length, mean_free_path: Length) -> Ratio:
    """Knudsen number of a particle: mean free path over its radius.

    >>> round(knudsen_number(particle_diameter="1 um", mean_free_path="66 nm"), 3)
    0.132
    """
    return 2.0 * mean_free_path / particle_diameter


def _slip(knudsen: Any, a: float, b: float, c: float) -> Any:
    safe = jnp.maximum(knudsen, 1e-12)
    return 1.0 + knudsen * (a + b * jnp.exp(-c / safe))


@formula(
    source="davies1945", equation=r"C_c = 1 + \mathrm{Kn}\left(1.257 + 0.400\,e^{-1.10/\mathrm{Kn}}\right)"
)
def slip_factor_davies(knudsen_number: Ratio) -> PositiveNumber:
    """Cunningham's slip correction by Davies.

    >>> round(slip_factor_davies(knudsen_number=0.132), 3)
    1.166
    """
    return _slip(knudsen_number, 1.257, 0.400, 1.10)


@formula(
    source="allen1985",
    equation=r"C_c = 1 + \mathrm{Kn}\left(1.142 + 0.558\,e^{-0.999/\mathrm{Kn}}\right)",
    fitted={"knudsen_number": (0.03, 7.2)},
)
def slip_factor_allen_raabe(knudsen_number: Ratio) -> PositiveNumber:
    """Cunningham's slip correction of solid spheres by Allen and Raabe.

    >>> round(slip_factor_allen_raabe(knudsen_number=0.132), 3)
    1.151
    """
    return _slip(knudsen_number, 1.142, 0.558, 0.999)


@formula(
    source="kim2005",
    equation=r"C_c = 1 + \mathrm{Kn}\left(1.165 + 0.483\,e^{-0.997/\mathrm{Kn}}\right)",
    fitted={"knudsen_number": (0.5, 83.0)},
)
def slip_factor_kim(knudsen_number: Ratio) -> PositiveNumber:
    """Cunningham's slip correction of polystyrene spheres by Kim and others, the basis of ISO 15900.

    >>> round(slip_factor_kim(knudsen_number=1.0), 3)
    2.343
    """
    return _slip(knudsen_number, 1.165, 0.483, 0.997)


Slip = Annotated[Any, Law("slip_factor")]


@formula(
    source="hinds1999, chapter 3; davies1945; clift1978, eq. 3-40",
    title="Terminal velocity with slip",
    equation=r"v_t = C_c\frac{g\,d_p^2(\rho_p-\rho_f)}{18\,\eta},\quad C_c = C_c(2\lambda/d_p)",
    fitted={"reynolds": (0.0, 0.2)},
    typical={
        "particle_diameter": (1e-8, 2e-5),
        "fluid_density": (0.6, 2.0),
        "dynamic_viscosity": (1e-5, 3e-5),
        "mean_free_path": (5e-8, 1e-7),
    },
)
def terminal_velocity_slip(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    mean_free_path: Length,
    gravity: Acceleration = STANDARD_GRAVITY,
    slip_factor: Slip = slip_factor_davies,
) -> Velocity:
    """Terminal velocity of a fine particle in a gas in creeping flow with slip, positive downwards.

    A unit-density sphere of 1 µm in air at 20 °C falls at 3.5e-5 m/s. Stokes' law, whose drag is 4 % too low
    at a Reynolds number of 0.2 (Oseen).

    >>> round(
    ...     1e6
    ...     * terminal_velocity_slip(
    ...         particle_diameter="1 um",
    ...         particle_density=1000,
    ...         fluid_density=1.2,
    ...         dynamic_viscosity=1.81e-5,
    ...         mean_free_path="66 nm",
    ...     ),
    ...     1,
    ... )
    35.1
    """
    d = particle_diameter
    creeping = gravity * d**2 * (particle_density - fluid_density) / (18.0 * dynamic_viscosity)
    velocity = slip_factor(2.0 * mean_free_path / d) * creeping
    watch(reynolds=abs(velocity) * d * fluid_density / dynamic_viscosity)
    return velocity


@formula(
    source="einstein1905; hinds1999, chapter 7",
    equation=r"D = \frac{k T C_c}{3\pi\eta d_p}",
    typical={"particle_diameter": (1e-9, 1e-6)},
)
def brownian_diffusivity(
    particle_diameter: Length,
    temperature: Temperature,
    dynamic_viscosity: DynamicViscosity,
    slip_factor: PositiveNumber = 1.0,
) -> Diffusivity:
    """Diffusivity of a particle by Brownian motion; the slip factor is one in a liquid.

    >>> round(
    ...     1e12
    ...     * brownian_diffusivity(
    ...         particle_diameter="1 um", temperature="20 degC", dynamic_viscosity="1.002 cP"
    ...     ),
    ...     4,
    ... )
    0.4286
    """
    return BOLTZMANN * temperature * slip_factor / (3.0 * jnp.pi * dynamic_viscosity * particle_diameter)


@formula(source="einstein1905", equation=r"\bar x = \sqrt{2 D t}", typical={"diffusivity": (1e-14, 1e-11)})
def brownian_displacement(diffusivity: Diffusivity, time: Time) -> Distance:
    """Root-mean-square displacement along one axis by Brownian motion.

    >>> round(1e6 * brownian_displacement(diffusivity=4.286e-13, time=1.0), 3)
    0.926
    """
    moving = time > 0.0
    return jnp.where(moving, jnp.sqrt(2.0 * diffusivity * jnp.where(moving, time, 1.0)), 0.0)


@formula(
    source="einstein1905; stokes1851; clift1978, eq. 3-40",
    equation=r"d_B = \left[\frac{18\eta}{g|\rho_p-\rho_f|}\sqrt{\frac{2kT}{3\pi\eta t}}\right]^{2/5}",
    fitted={"reynolds": (0.0, 0.2)},
)
def brownian_diameter(
    temperature: Temperature,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    time: Time,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Length:
    """Diameter at which Brownian motion displaces a particle as far as it settles in a given time: finer ones
    do not settle.

    Creeping flow without slip. Infinite at equal densities. Stokes' law, whose drag is 4 % too low at a
    Reynolds number of 0.2 (Oseen).

    >>> round(
    ...     1e6
    ...     * brownian_diameter(
    ...         temperature="20 degC",
    ...         particle_density=2650,
    ...         fluid_density=998,
    ...         dynamic_viscosity="1 cP",
    ...         time=1.0,
    ...     ),
    ...     2,
    ... )
    1.01
    """
    eta, t = dynamic_viscosity, jnp.maximum(time, 1e-30)
    weight = gravity * abs(particle_density - fluid_density)
    heavy = weight > 0.0
    ratio = (
        18.0
        * eta
        / jnp.where(heavy, weight, 1.0)
        * jnp.sqrt(2.0 * BOLTZMANN * temperature / (3.0 * jnp.pi * eta * t))
    )
    d = ratio**0.4
    watch(reynolds=jnp.where(heavy, fluid_density * weight * d**3 / (18.0 * eta**2), 0.0))
    return jnp.where(heavy, d, jnp.inf)
