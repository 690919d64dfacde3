"""Filters for gases: fibrous layers (efficiency, pressure drop) and dust cakes on bags."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import (
    Concentration,
    DynamicViscosity,
    Fraction,
    Length,
    OpenFraction,
    PressureDrop,
    Ratio,
    Speed,
    Time,
)
from granum.filtration.kinds import DustResistance, ResidualDrag

_MAT = {
    "fiber_diameter": (1e-6, 3e-5),
    "fiber_fraction": (0.01, 0.15),
    "mat_thickness": (5e-4, 2e-2),
    "superficial_velocity": (0.01, 0.5),
    "dynamic_viscosity": (1.7e-5, 2e-5),
    "fiber_efficiency": (1e-3, 0.3),
}


@formula(
    source="davies1953",
    title="Pressure drop of a fibrous filter",
    equation=r"\Delta p = \frac{64\,\eta\,U\,L\,\beta^{1.5}(1 + 56\beta^3)}{d_f^2}",
    fitted={"fiber_fraction": (0.006, 0.3)},
    typical=_MAT,
)
def pressure_drop_fibers(
    mat_thickness: Length,
    fiber_diameter: Length,
    fiber_fraction: OpenFraction,
    superficial_velocity: Speed,
    dynamic_viscosity: DynamicViscosity,
) -> PressureDrop:
    """Pressure drop of a clean fibrous layer, by Davies.

    >>> round(pressure_drop_fibers("1 mm", "2 um", 0.05, "5 cm/s", 1.8e-5), 1)
    162.1
    """
    b = fiber_fraction
    return (
        64.0
        * dynamic_viscosity
        * superficial_velocity
        * mat_thickness
        * b**1.5
        * (1.0 + 56.0 * b**3)
        / fiber_diameter**2
    )


@formula(
    source="brown1993",
    title="Penetration of a fibrous filter",
    equation=r"P = \exp\left(-\frac{4\,\beta\,E\,L}{\pi\,(1-\beta)\,d_f}\right)",
    typical=_MAT,
    output="penetration",
)
def penetration_fibers(
    mat_thickness: Length, fiber_diameter: Length, fiber_fraction: OpenFraction, fiber_efficiency: Ratio
) -> Fraction:
    """Fraction of particles that passes a fibrous layer, from what a single fiber catches.

    >>> round(penetration_fibers("1 mm", "2 um", 0.05, fiber_efficiency=0.1), 5)
    0.03506
    """
    b = fiber_fraction
    return jnp.exp(-4.0 * b * fiber_efficiency * mat_thickness / (jnp.pi * (1.0 - b) * fiber_diameter))


@formula(
    source="cooper2011",
    title="Pressure drop of a dust cake",
    equation=r"\Delta p = K_1 U + K_2\,c\,U^2\,t",
    typical={
        "superficial_velocity": (0.005, 0.03),
        "concentration_inlet": (1e-3, 2e-2),
        "time": (60.0, 3600.0),
    },
)
def pressure_drop_dust_cake(
    superficial_velocity: Speed,
    concentration_inlet: Concentration,
    time: Time,
    residual_drag: ResidualDrag,
    dust_resistance: DustResistance,
) -> PressureDrop:
    """Pressure drop of a bag filter some time after cleaning: residual drag of the cloth and the dust laid on
    it since.

    >>> round(
    ...     pressure_drop_dust_cake("1 m/min", "10 g/m^3", "10 min", residual_drag=2e4, dust_resistance=6e4),
    ...     1,
    ... )
    433.3
    """
    v = superficial_velocity
    return residual_drag * v + dust_resistance * concentration_inlet * v**2 * time
