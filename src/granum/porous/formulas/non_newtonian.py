"""Creeping flow of liquids that do not follow Newton through packed beds, as through capillaries."""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula, limit_active
from granum.core.kinds import (
    DynamicViscosity,
    FlowIndex,
    Length,
    Permeability,
    PressureGradient,
    ShearRate,
    Speed,
    Sphericity,
    Velocity,
    VoidFraction,
    Within,
    YieldStress,
)
from granum.porous.formulas.kozeny import permeability_blake_kozeny

TORTUOUS = 25.0 / 12.0  # length of the capillaries over that of the bed, by which Kozeny's 72 becomes 150
RESTS = "The yield stress holds the liquid: this gradient of pressure does not move it."


def _thinned(rate: Any, consistency: Any, n: Any) -> Any:
    """Viscosity of a power-law liquid in capillaries: the rate is U(1 − ε)/(d ε²) over that of reference."""
    return consistency / 12.0 * (9.0 + 3.0 / n) ** n * rate ** (n - 1.0)


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
    rate = (
        superficial_velocity
        * (1.0 - void_fraction)
        / (sphericity * particle_diameter * void_fraction**2 * reference_shear_rate)
    )
    return _thinned(rate, consistency, flow_index)


@formula(
    source="christopher1965; bird2002",
    equation=(
        r"\eta = \frac{\eta_1}{12}\left(9 + \frac{3}{n}\right)^n"
        r"\left(\frac{\dot\gamma_1\sqrt{150\,B\,\varepsilon}}{U}\right)^{1-n}"
    ),
    output="dynamic_viscosity",
    title="Effective viscosity of a power-law liquid in a medium of known permeability",
    typical={
        "superficial_velocity": (1e-6, 1e-3),
        "permeability": (1e-13, 1e-9),
        "consistency": (0.01, 5.0),
        "flow_index": (0.4, 0.9),
    },
)
def dynamic_viscosity_permeable_christopher_middleman(
    superficial_velocity: Annotated[Speed, Within(1e-12)],
    permeability: Permeability,
    void_fraction: VoidFraction,
    consistency: DynamicViscosity,
    flow_index: FlowIndex,
    reference_shear_rate: ShearRate = 1.0,
) -> DynamicViscosity:
    """Viscosity with which Darcy's law gives the pressure gradient of a power-law liquid in creeping flow
    through a cake or a rock whose permeability is known.

    The capillaries are those that would have this permeability by the law of Blake and Kozeny. Sources not
    opened: recalled, and derived anew.

    >>> bed = (1e-3**2 * 0.5**3) / (150.0 * 0.5**2)
    >>> round(dynamic_viscosity_permeable_christopher_middleman(1e-3, bed, 0.5, 1.0, 0.5), 4)
    0.2282
    """
    rate = superficial_velocity / (
        jnp.sqrt(150.0 * permeability) * jnp.sqrt(void_fraction) * reference_shear_rate
    )
    return _thinned(rate, consistency, flow_index)


@formula(
    source="christopher1965; bird2002",
    equation=(
        r"\left(\frac{\Delta p}{L}\right)_y = \frac{25}{12}\cdot\frac{6\,\tau_y\,(1-\varepsilon)}"
        r"{\varepsilon\,\psi d_p}"
    ),
    title="Pressure gradient at which a liquid with a yield stress begins to flow through a bed",
    family="pressure_gradient_least",
    typical={"particle_diameter": (1e-4, 5e-3), "yield_stress": (0.1, 20.0)},
)
def pressure_gradient_yield_bed(
    particle_diameter: Length,
    void_fraction: VoidFraction,
    yield_stress: YieldStress,
    sphericity: Sphericity = 1.0,
) -> PressureGradient:
    """Least gradient of pressure that moves a liquid with a yield stress through a bed, where the stress at
    the walls of the capillaries of Blake and Kozeny is the yield stress.

    The widest pores of a real bed begin to flow before. Derived for equal capillaries; sources not opened.

    >>> round(pressure_gradient_yield_bed("1 mm", 0.4, 2.0), 6)
    37500.0
    """
    wall = 6.0 * (1.0 - void_fraction) / (void_fraction * sphericity * particle_diameter)
    return TORTUOUS * yield_stress * wall


@formula(
    source="christopher1965; bird2002",
    equation=(
        r"U = \frac{B}{\eta_p}\,\frac{\Delta p}{L}\left(1 - \frac43 x + \frac13 x^4\right),\quad "
        r"x = \frac{25\,\tau_y (1-\varepsilon)}{2\,\varepsilon\,\psi d_p\,\Delta p/L} \le 1,"
        r"\quad B = \frac{(\psi d_p)^2\varepsilon^3}{150(1-\varepsilon)^2}"
    ),
    title="Velocity of a Bingham liquid through a bed",
    typical={
        "pressure_gradient": (1e4, 1e7),
        "particle_diameter": (1e-4, 5e-3),
        "plastic_viscosity": (5e-3, 0.1),
        "yield_stress": (0.1, 20.0),
    },
)
def superficial_velocity_bed_bingham(
    pressure_gradient: PressureGradient,
    particle_diameter: Length,
    void_fraction: VoidFraction,
    plastic_viscosity: DynamicViscosity,
    yield_stress: YieldStress,
    sphericity: Sphericity = 1.0,
) -> Velocity:
    """Superficial velocity of a Bingham liquid in creeping flow through a bed: Buckingham and Reiner's law in
    the capillaries of Blake and Kozeny.

    Zero, and flagged, up to the gradient of ``pressure_gradient_yield_bed``; without a yield stress it is
    Darcy's law. Derived for equal capillaries; sources not opened.

    >>> round(1000 * superficial_velocity_bed_bingham("1 bar/m", "1 mm", 0.4, "20 cP", 2.0), 4)
    3.002
    """
    least = pressure_gradient_yield_bed.function(particle_diameter, void_fraction, yield_stress, sphericity)
    drive = jnp.abs(jnp.asarray(pressure_gradient, dtype=float))
    flows = drive > least
    limit_active(~flows, pressure_gradient, "pressure_gradient", RESTS)
    x = jnp.where(flows, least / jnp.where(flows, drive, 1.0), 1.0)
    darcy = (
        permeability_blake_kozeny.function(particle_diameter, void_fraction, sphericity) / plastic_viscosity
    )
    return darcy * pressure_gradient * (1.0 - x) ** 2 * (3.0 + 2.0 * x + x**2) / 3.0
