"""Wear of the wall of a cyclone where the dust of the inlet strikes it."""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import (
    Angle,
    Density,
    DynamicViscosity,
    Fraction,
    Length,
    MassFlux,
    PositiveNumber,
    Pressure,
    Speed,
    Within,
)

MINERALS = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0)
"""Talc, gypsum, calcite, fluorite, apatite, orthoclase, quartz, topaz, corundum on Mohs' scale."""
HARDNESSES = (0.14e9, 0.61e9, 1.49e9, 2.0e9, 5.43e9, 6.87e9, 12.2e9, 17.6e9, 19.6e9)
"""Their Vickers hardnesses after Broz and others, Pa, recalled."""
WORST = 0.6155  # radian, where sin α cos² α is greatest


def striking_angle(diameter: Any, inlet_width: Any) -> Any:
    """Steepest angle at which dust from a tangential slot flies straight into the wall."""
    return jnp.arccos(jnp.clip(1.0 - 2.0 * inlet_width / diameter, -1.0, 1.0))


@formula(
    source="finnie1960; hutchings1992",
    equation=(
        r"w = \frac{c\,G v^2}{4 p}\begin{cases}\sin 2\alpha - 3\sin^2\alpha & \tan\alpha \le 1/3\\ "
        r"\tfrac13\cos^2\alpha\end{cases}"
    ),
    fitted={"cutting_share": (0.03, 0.6)},
    typical={
        "velocity": (15.0, 25.0),
        "mass_flux": (0.01, 1.0),
        "impact_angle": (0.1, 1.2),
        "wall_hardness": (1e9, 3e9),
    },
)
def wear_velocity_finnie(
    velocity: Speed,
    mass_flux: MassFlux,
    impact_angle: Annotated[Angle, Within(0.0, 1.5708)],
    wall_hardness: Pressure,
    cutting_share: Fraction = 0.1,
) -> Speed:
    """Thickness of a ductile wall worn off per time by hard particles that strike it at an angle, by
    Finnie.

    The flux is the mass of particles per wall area and time, the hardness the flow stress of the wall (some
    1.2 GPa for mild steel), share is that of the particles that cut as the theory has it: 0.03 to 0.6 covers
    the wear measured on metals (Hutchings' 5e-3 to 0.1 of ρv²/2H), so trust the order of magnitude. Brittle
    linings wear most at right angles and are not covered.

    At 20 m/s and 0.1 kg/(m² s), 45° onto mild steel, millimeters in 8000 h:

    >>> w = wear_velocity_finnie(velocity=20.0, mass_flux=0.1, impact_angle="45 degree", wall_hardness=1.2e9)
    >>> round(1e3 * 8000 * 3600 * w, 1)
    4.0
    """
    a = impact_angle
    flat = jnp.sin(2.0 * a) - 3.0 * jnp.sin(a) ** 2
    cut = jnp.where(jnp.tan(jnp.minimum(a, 1.5)) <= 1.0 / 3.0, flat, jnp.cos(a) ** 2 / 3.0)
    return cutting_share * mass_flux * velocity**2 / (4.0 * wall_hardness) * cut


@formula(
    source="finnie1960; hoffmann2008, ch. 12; hutchings1992",
    title="Wear at the inlet of a cyclone",
    output="wear_velocity",
    equation=(
        r"w = w_F(v, G\sin\alpha, \alpha, p),\quad \tan\alpha = \frac{2\tau v}{D},\ \cos\alpha \ge 1 - "
        r"\frac{2b}{D},\quad \tau = \frac{\rho_p d_p^2}{18\,\eta}"
    ),
    fitted={"cutting_share": (0.03, 0.6)},
    typical={
        "velocity": (15.0, 25.0),
        "mass_flux": (0.01, 1.0),
        "diameter": (0.9, 1.1),
        "inlet_width": (0.18, 0.22),
        "wall_hardness": (1e9, 3e9),
        "particle_diameter": (5e-6, 1e-4),
        "dynamic_viscosity": (1.7e-5, 3e-5),
    },
)
def wear_velocity_cyclone_inlet(
    velocity: Speed,
    mass_flux: MassFlux,
    diameter: Length,
    inlet_width: Length,
    particle_diameter: Length,
    particle_density: Density,
    dynamic_viscosity: DynamicViscosity,
    wall_hardness: Pressure,
    cutting_share: Fraction = 0.1,
) -> Speed:
    """Greatest wear of the wall of a cyclone opposite its tangential inlet, for dust of one size.

    The flux is that of the dust through the inlet. Fine dust drifts to the wall at its settling velocity in
    the swirl, coarse dust flies straight on, at most at the angle under which the slot sees the wall. The
    share of the particles that cut was found from 0.03 to 0.6 on metals (Hutchings).

    >>> coarse, fine = (
    ...     wear_velocity_cyclone_inlet(20.0, 0.5, 1.0, 0.2, d, 2600.0, 1.8e-5, 1.2e9) for d in (1e-4, 1e-5)
    ... )
    >>> coarse > 10 * fine
    True
    """
    relaxation = particle_density * particle_diameter**2 / (18.0 * dynamic_viscosity)
    steepest = jnp.minimum(striking_angle(diameter, inlet_width), WORST)
    angle = jnp.minimum(jnp.arctan(2.0 * relaxation * velocity / diameter), steepest)
    return wear_velocity_finnie(velocity, mass_flux * jnp.sin(angle), angle, wall_hardness, cutting_share)


@formula(
    source="broz2006",
    title="Hardness of a mineral from Mohs' scale",
    equation=r"\ln H = \ln H_i + (M - M_i)\,\ln\frac{H_{i+1}}{H_i}",
    typical={"mohs_hardness": (1.0, 9.0)},
)
def indentation_hardness_mohs(mohs_hardness: Annotated[PositiveNumber, Within(1.0, 9.0)]) -> Pressure:
    """Indentation hardness of a mineral, between those measured on Mohs' minerals.

    The nine hardnesses are recalled, the print was not opened.

    >>> round(indentation_hardness_mohs(7.0) / 1e9, 1)
    12.2
    """
    return jnp.exp(jnp.interp(mohs_hardness, jnp.asarray(MINERALS), jnp.log(jnp.asarray(HARDNESSES))))
