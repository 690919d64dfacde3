"""Gas cyclones of one shape are similar: Euler and Stokes numbers on the velocity in the body, measured once
for each design.
"""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import Density, DynamicViscosity, Length, PositiveNumber, PressureDrop, VolumeFlow
from granum.cyclones.formulas.efficiency import TYPICAL, heavier


@formula(
    source="rhodes2008, ch. 9; stairmand1951",
    title="Cut size of similar cyclones",
    equation=(
        r"\mathrm{Stk}_{50} = \frac{d_{50}^2(\rho_p-\rho_f)v}{18\eta D},\quad v = \frac{4Q}{\pi "
        r"D^2},\quad d_{50} = \sqrt{\frac{18\,\eta\,D\,\mathrm{Stk}_{50}}{(\rho_p - \rho_f)\,v}}"
    ),
    output="cut_size",
    typical=TYPICAL,
)
def cut_size_similar(
    volume_flow: VolumeFlow,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    diameter: Length,
    stokes_number_cut: PositiveNumber = 1.4e-4,
) -> Length:
    """Cut size of a gas cyclone from the Stokes number measured on its design.

    Stairmand's high-efficiency design has 1.4e-4, his high-throughput design 6e-3, at dust loads below some
    5 g/m³.

    Rhodes' example, one cyclone of 1.014 m for 2 m³/s, 4.34 µm:

    >>> round(
    ...     1e6
    ...     * cut_size_similar(
    ...         volume_flow=2.0,
    ...         particle_density=1000.0,
    ...         fluid_density=1e-9,
    ...         dynamic_viscosity=18.25e-6,
    ...         diameter=1.014,
    ...     ),
    ...     2,
    ... )
    4.34
    """
    v = 4.0 * volume_flow / (jnp.pi * diameter**2)
    return jnp.sqrt(
        18.0
        * dynamic_viscosity
        * diameter
        * stokes_number_cut
        / (heavier(particle_density, fluid_density) * v)
    )


@formula(
    source="rhodes2008, ch. 9; stairmand1951",
    title="Pressure drop of similar cyclones",
    equation=r"\Delta p = \mathrm{Eu}\,\frac{\rho_f v^2}{2},\quad v = \frac{4Q}{\pi D^2}",
    output="pressure_drop",
    typical=TYPICAL,
)
def pressure_drop_similar(
    volume_flow: VolumeFlow, fluid_density: Density, diameter: Length, euler_number: PositiveNumber = 320.0
) -> PressureDrop:
    """Pressure drop of a gas cyclone from the Euler number measured on its design.

    Stairmand's high-efficiency design has 320, his high-throughput design 46.

    Rhodes' example, one cyclone of 1.014 m for 2 m³/s, 1177 Pa:

    >>> round(pressure_drop_similar(volume_flow=2.0, fluid_density=1.2, diameter=1.014))
    1178
    """
    return euler_number * fluid_density / 2.0 * (4.0 * volume_flow / (jnp.pi * diameter**2)) ** 2


@formula(
    source="rhodes2008, ch. 9",
    title="Diameter of similar cyclones",
    equation=r"D = \sqrt{\frac{4Q}{\pi}}\left(\frac{\mathrm{Eu}\,\rho_f}{2\Delta p}\right)^{1/4}",
    output="diameter",
    typical={**TYPICAL, "pressure_drop": (500.0, 1500.0)},
)
def diameter_similar(
    volume_flow: VolumeFlow,
    pressure_drop: PressureDrop,
    fluid_density: Density,
    euler_number: PositiveNumber = 320.0,
) -> Length:
    """Diameter of a gas cyclone that costs a pressure drop, from the Euler number measured on its design.

    Rhodes' example: 100 m of gas column, 1.014 m for one cyclone and 0.717 m for each of two:

    >>> [
    ...     round(diameter_similar(volume_flow=q, pressure_drop=1177.0, fluid_density=1.2), 3)
    ...     for q in (2.0, 1.0)
    ... ]
    [1.014, 0.717]
    """
    return (
        jnp.sqrt(4.0 * volume_flow / jnp.pi) * (euler_number * fluid_density / (2.0 * pressure_drop)) ** 0.25
    )
