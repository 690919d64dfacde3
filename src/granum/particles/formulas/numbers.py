"""Dimensionless groups of a particle in a fluid."""

from __future__ import annotations

from granum.core import formula
from granum.core.kinds import Density, DynamicViscosity, Length, Ratio, Speed


@formula(source="clift1978, p. 4", equation=r"\mathrm{Re} = \frac{\rho_f v d_p}{\eta}")
def reynolds_number(
    particle_diameter: Length, velocity: Speed, fluid_density: Density, dynamic_viscosity: DynamicViscosity
) -> Ratio:
    """Reynolds number of a particle: inertia against viscosity, on the particle diameter.

    >>> round(
    ...     reynolds_number(
    ...         particle_diameter="1 mm", velocity=0.1, fluid_density=1000, dynamic_viscosity="1 cP"
    ...     ),
    ...     6,
    ... )
    100.0
    """
    d, v, rho, eta = particle_diameter, velocity, fluid_density, dynamic_viscosity
    return rho * v * d / eta
