"""Collectors by hand: total efficiency from efficiencies by class, and the smallest particle a cyclone
keeps.
"""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import Area, Density, DynamicViscosity, Fraction, Length, Series, Speed, VolumeFlow
from granum.cyclones.formulas.efficiency import TYPICAL, heavier
from granum.particles.formulas.means import Shares, shares

BODY = {**TYPICAL, "area_inlet": (0.08, 0.12)}


@formula(
    source="richardson2002, ch. 1",
    title="Removal efficiency from the grades",
    equation=r"E = \sum_i x_i E_i",
    output="removal_efficiency",
    symbols={"class_fractions": "x_i"},
)
def removal_efficiency_grades(
    class_fractions: Shares, class_efficiencies: Annotated[Fraction, Series("classes")]
) -> Fraction:
    """Total efficiency of a collector from its efficiency for each size class and the mass fractions of its
    feed.

    Coulson and Richardson's example, 73.5 % of a dust of six classes:

    >>> round(
    ...     removal_efficiency_grades(
    ...         class_fractions="10 15 35 20 10 10 %", class_efficiencies="20 40 80 90 95 100 %"
    ...     ),
    ...     4,
    ... )
    0.735
    """
    return jnp.sum(shares(class_fractions) * jnp.asarray(class_efficiencies), axis=-1)


@formula(
    source="richardson2002, ch. 1",
    title="Settling velocity of the grains retained (Stairmand)",
    equation=r"v_0 = \frac{0.2\,A_i^2 D_e\,g}{\pi H D Q}",
    output="terminal_velocity",
    typical=BODY,
    symbols={"area_inlet": "A_i", "terminal_velocity": "v_0"},
)
def terminal_velocity_retained_stairmand(
    volume_flow: VolumeFlow, diameter: Length, outlet_diameter: Length, height: Length, area_inlet: Area
) -> Speed:
    """Terminal velocity under gravity of the smallest particle that a cyclone keeps, from its main lengths,
    by Stairmand.

    The gas drifts inwards evenly over the height and its swirl falls with the root of the radius; what
    circles at 0.4 of the outlet's diameter is kept.

    >>> round(
    ...     terminal_velocity_retained_stairmand(
    ...         volume_flow=6.627e-3, diameter=0.3, outlet_diameter=0.075, height=1.2, area_inlet=4.418e-3
    ...     ),
    ...     6,
    ... )
    0.000383
    """
    return (
        0.2 * area_inlet**2 * outlet_diameter * STANDARD_GRAVITY / (jnp.pi * height * diameter * volume_flow)
    )


@formula(
    source="richardson2002, ch. 1",
    equation=(
        r"d_{50} = \sqrt{\frac{18\eta v_0}{(\rho_p-\rho_f)g}},\quad v_0 = \frac{0.2\,A_i^2 D_e\,g}{\pi "
        r"H D Q}"
    ),
    output="cut_size",
    typical=BODY,
    symbols={"area_inlet": "A_i"},
)
def cut_size_stairmand(
    volume_flow: VolumeFlow,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    diameter: Length,
    outlet_diameter: Length,
    height: Length,
    area_inlet: Area,
) -> Length:
    """Smallest particle that a cyclone keeps, from its main lengths, by Stairmand and Stokes' law.

    Coulson and Richardson's example, a cyclone of 0.3 m with inlet and outlet of 75 mm at 1.5 m/s, 2.17 µm:

    >>> round(
    ...     1e6
    ...     * cut_size_stairmand(
    ...         volume_flow=6.627e-3,
    ...         particle_density=2700,
    ...         fluid_density=1.3,
    ...         dynamic_viscosity=1.8e-5,
    ...         diameter=0.3,
    ...         outlet_diameter=0.075,
    ...         height=1.2,
    ...         area_inlet=4.418e-3,
    ...     ),
    ...     2,
    ... )
    2.17
    """
    v = terminal_velocity_retained_stairmand(volume_flow, diameter, outlet_diameter, height, area_inlet)
    return jnp.sqrt(
        18.0 * dynamic_viscosity * v / (heavier(particle_density, fluid_density) * STANDARD_GRAVITY)
    )
