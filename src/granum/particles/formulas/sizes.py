"""Equivalent diameters: the sphere that shares one property with a particle of any shape."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Area,
    Density,
    DynamicViscosity,
    Length,
    PositiveNumber,
    SpecificSurface,
    SpecificSurfaceMass,
    Speed,
    Sphericity,
    Volume,
)
from granum.numerics.smooth import safe_divide, safe_power, safe_sqrt


@formula(
    source="allen1997; iso9276-6",
    equation=r"d_v = \left(\frac{6V}{\pi}\right)^{1/3}",
    title="Volume-equivalent diameter",
    symbols={"equivalent_diameter": "d_v"},
)
def equivalent_diameter_volume(particle_volume: Volume) -> Length:
    """Diameter of the sphere that has the volume of the particle.

    >>> round(equivalent_diameter_volume(particle_volume="1 mm^3") * 1e3, 4)
    1.2407
    """
    return safe_power(6.0 * particle_volume / jnp.pi, 1.0 / 3.0)


@formula(
    source="allen1997; iso9276-6",
    equation=r"d_s = \left(\frac{S}{\pi}\right)^{1/2}",
    title="Surface-equivalent diameter",
    symbols={"equivalent_diameter": "d_s"},
)
def equivalent_diameter_surface(particle_surface: Area) -> Length:
    """Diameter of the sphere that has the surface of the particle.

    >>> round(equivalent_diameter_surface(particle_surface="6 mm^2") * 1e3, 4)
    1.382
    """
    return jnp.sqrt(particle_surface / jnp.pi)


@formula(
    source="allen1997",
    equation=r"d_{sv} = \frac{6V}{S}",
    title="Surface–volume diameter",
    symbols={"equivalent_diameter": "d_{sv}"},
)
def equivalent_diameter_surface_volume(particle_volume: Volume, particle_surface: Area) -> Length:
    """Diameter of the sphere that has the surface per volume of the particle.

    >>> round(
    ...     equivalent_diameter_surface_volume(particle_volume="1 mm^3", particle_surface="6 mm^2") * 1e3, 6
    ... )
    1.0
    """
    return 6.0 * particle_volume / particle_surface


@formula(
    source="allen1997",
    equation=r"d_{sv} = \frac{6}{a_g}",
    title="Diameter from the specific surface",
    symbols={"equivalent_diameter": "d_{sv}"},
)
def equivalent_diameter_specific_surface(specific_surface: SpecificSurface) -> Length:
    """Diameter of the sphere that has a given surface per volume.

    >>> round(equivalent_diameter_specific_surface(specific_surface=6e4) * 1e6, 6)
    100.0
    """
    return 6.0 / specific_surface


@formula(
    source="allen1997; iso9276-6",
    equation=r"d_a = \sqrt{\frac{4A_p}{\pi}}",
    title="Projected-area diameter",
    symbols={"equivalent_diameter": "d_a"},
)
def equivalent_diameter_projected_area(projected_area: Area) -> Length:
    """Diameter of the circle that has the area of the particle's projection.

    >>> round(equivalent_diameter_projected_area(projected_area="1 mm^2") * 1e3, 4)
    1.1284
    """
    return jnp.sqrt(4.0 * projected_area / jnp.pi)


@formula(
    source="allen1997; iso9276-6",
    equation=r"d_c = \frac{P}{\pi}",
    title="Perimeter diameter",
    symbols={"equivalent_diameter": "d_c"},
)
def equivalent_diameter_perimeter(projected_perimeter: Length) -> Length:
    """Diameter of the circle that has the perimeter of the particle's projection.

    >>> round(equivalent_diameter_perimeter(projected_perimeter="4 mm") * 1e3, 4)
    1.2732
    """
    return projected_perimeter / jnp.pi


@formula(
    source="allen1997",
    equation=r"d_{St} = \sqrt{\frac{18\,\eta\,v_t}{(\rho_p - \rho_f)\,g}}",
    fitted={"reynolds": (0.0, 0.25)},
    typical={"terminal_velocity": (1e-6, 1e-4)},
    title="Stokes diameter",
    symbols={"equivalent_diameter": "d_{St}"},
)
def equivalent_diameter_stokes(
    terminal_velocity: Speed,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Length:
    """Diameter of the sphere of the same density that falls (or rises) at the same speed in the Stokes
    regime.

    The density difference counts without its sign, so rising particles have a diameter too; equal densities
    give none.

    >>> round(
    ...     equivalent_diameter_stokes(
    ...         terminal_velocity="1 mm/s",
    ...         particle_density=2650,
    ...         fluid_density=998,
    ...         dynamic_viscosity="1.002 mPa*s",
    ...     )
    ...     * 1e6,
    ...     2,
    ... )
    33.37
    """
    difference = abs(particle_density - fluid_density)
    d = safe_sqrt(safe_divide(18.0 * dynamic_viscosity * terminal_velocity, difference * gravity, jnp.inf))
    watch(reynolds=fluid_density * terminal_velocity * d / dynamic_viscosity)
    return d


@formula(
    source="hinds1999, chapter 3",
    equation=r"d_a = d_v\sqrt{\frac{\rho_p}{\rho_0\,\chi}},\quad \rho_0 = 1000\ \mathrm{kg/m^3}",
    title="Aerodynamic diameter",
    typical={"shape_factor_dynamic": (1.0, 1.5)},
    symbols={"equivalent_diameter": "d_a"},
)
def equivalent_diameter_aerodynamic(
    diameter_volume: Length, particle_density: Density, shape_factor_dynamic: PositiveNumber = 1.0
) -> Length:
    """Diameter of the sphere of 1000 kg/m³ that falls as fast in a gas in creeping flow; slip left out.

    The dynamic shape factor is the drag over that of the sphere of equal volume.

    >>> round(equivalent_diameter_aerodynamic(diameter_volume="1.4 um", particle_density="2 g/cm^3") * 1e6, 2)
    1.98
    """
    return diameter_volume * jnp.sqrt(particle_density / (1000.0 * shape_factor_dynamic))


@formula(
    source="allen1997",
    equation=r"a_g = \frac{6}{\psi\,d_v}",
    title="Specific surface from a mean diameter",
    output="specific_surface",
)
def specific_surface_diameter(diameter_volume: Length, sphericity: Sphericity = 1.0) -> SpecificSurface:
    """Surface per volume of solid from the volume-equivalent diameter and the sphericity; 6/d for spheres.

    With a distribution, the diameter is the Sauter mean D[3,2].

    >>> round(specific_surface_diameter(diameter_volume="100 um"), 3)
    60000.0
    """
    return 6.0 / (sphericity * diameter_volume)


@formula(
    source="allen1997",
    equation=r"S_m = \frac{6}{\rho_s\,\psi\,d_v}",
    title="Specific surface per mass from a mean diameter",
    output="specific_surface_mass",
)
def specific_surface_mass_diameter(
    diameter_volume: Length, solid_density: Density, sphericity: Sphericity = 1.0
) -> SpecificSurfaceMass:
    """Surface per mass of solid from the volume-equivalent (Sauter) diameter, the density and the sphericity.

    >>> round(specific_surface_mass_diameter(diameter_volume="10 um", solid_density=3000), 6)
    200.0
    """
    return 6.0 / (solid_density * sphericity * diameter_volume)
