"""Creeping flow of liquids that do not follow Newton through packed beds."""

from __future__ import annotations

from typing import Annotated

from granum.core import formula
from granum.core.kinds import (
    DynamicViscosity,
    FlowIndex,
    Length,
    ShearRate,
    Speed,
    Sphericity,
    VoidFraction,
    Within,
)


@formula(
    source="christopher1965; bird2002",
    equation=(
        r"\eta = \frac{\eta_1}{12}\left(9 + \frac{3}{n}\right)^n"
        r"\left[\frac{\psi d_p\,\varepsilon^2\,\dot\gamma_1}{(1-\varepsilon)\,U}\right]^{1-n}"
    ),
    output="dynamic_viscosity",
    title="Effective viscosity of a power-law liquid in a bed",
    typical={
        "superficial_velocity": (1e-4, 1e-2),
        "particle_diameter": (1e-4, 5e-3),
        "consistency": (0.01, 5.0),
        "flow_index": (0.4, 0.9),
    },
)
def dynamic_viscosity_bed_christopher_middleman(
    superficial_velocity: Annotated[Speed, Within(1e-12)],
    particle_diameter: Length,
    void_fraction: VoidFraction,
    consistency: DynamicViscosity,
    flow_index: FlowIndex,
    sphericity: Sphericity = 1.0,
    reference_shear_rate: ShearRate = 1.0,
) -> DynamicViscosity:
    """Viscosity with which the law of Blake and Kozeny gives the pressure gradient of a power-law liquid in
    creeping flow through a bed, by Christopher and Middleman.

    Written for any shear rate at which the consistency is the viscosity. Capillaries of the hydraulic
    diameter with 25/12 of the length of the bed give the same by hand. Sources not opened: recalled, and
    derived anew.

    >>> round(dynamic_viscosity_bed_christopher_middleman(1e-3, 1e-3, 0.5, 1.0, 0.5), 4)
    0.2282
    """
    n = flow_index
    rate = (
        superficial_velocity
        * (1.0 - void_fraction)
        / (sphericity * particle_diameter * void_fraction**2 * reference_shear_rate)
    )
    return consistency / 12.0 * (9.0 + 3.0 / n) ** n * rate ** (n - 1.0)
