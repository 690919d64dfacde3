"""Blowing liquid out of a cake with gas: threshold, irreducible saturation, saturation after a time, cake
moisture.
"""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula, impossible, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Fraction,
    Length,
    MoistureDryBasis,
    Permeability,
    PositiveNumber,
    PressureDifference,
    PressureDrop,
    Speed,
    SurfaceTension,
    Time,
    VoidFraction,
    Within,
)

_CAKE = {"cake_thickness": (5e-3, 5e-2), "particle_diameter": (1e-5, 2e-4), "pressure_drop": (2e4, 4e5)}


@formula(
    source="wakeman2005",
    title="Threshold pressure of a cake",
    equation=r"p_b = \frac{4.6\,\sigma\,(1-\varepsilon)}{\varepsilon\,d_p}",
    symbols={"threshold_pressure": "p_b"},
)
def threshold_pressure_cake(
    particle_diameter: Length, void_fraction: VoidFraction, surface_tension: SurfaceTension
) -> PressureDrop:
    """Threshold pressure: the pressure difference that first drives gas into a saturated cake.

    >>> round(threshold_pressure_cake(particle_diameter="50 um", void_fraction=0.46, surface_tension=0.05))
    5400
    """
    return 4.6 * surface_tension * (1.0 - void_fraction) / (void_fraction * particle_diameter)


@formula(
    source="wakeman2005",
    title="Capillary number of a cake",
    equation=r"N_{cap} = \frac{\varepsilon^3 d_p^2\,(\rho_l g Z + \Delta p)}{(1-\varepsilon)^2 Z\,\sigma}",
    typical=_CAKE,
)
def capillary_number_cake(
    particle_diameter: Length,
    void_fraction: VoidFraction,
    cake_thickness: Length,
    pressure_drop: Annotated[PressureDifference, Within(0.0)],
    liquid_density: Density,
    surface_tension: SurfaceTension,
) -> PositiveNumber:
    """Capillary number of a cake: driving pressure and weight of the liquid against capillary forces.

    >>> round(capillary_number_cake(1e-4, 0.5, 0.02, 49803.867, 1000, 0.05) * 1e3, 6)
    250.0
    """
    e, L = void_fraction, cake_thickness
    drive = liquid_density * STANDARD_GRAVITY * L + pressure_drop
    return e**3 * particle_diameter**2 * drive / ((1.0 - e) ** 2 * L * surface_tension)


@formula(
    source="wakeman2005",
    equation=r"S_\infty = 0.155\left(1 + 0.031\,N_{cap}^{-0.49}\right)",
    fitted={"capillary_number": (1e-4, 10.0)},
)
def irreducible_saturation(capillary_number: PositiveNumber) -> Fraction:
    """Irreducible saturation of a cake: what no time of blowing removes at this capillary number.

    >>> round(irreducible_saturation(capillary_number=1e-3), 3)
    0.297
    """
    return jnp.minimum(0.155 * (1.0 + 0.031 * capillary_number**-0.49), 1.0)


@formula(
    source="wakeman2005",
    equation=r"S_R = \frac{S - S_\infty}{1 - S_\infty} = \frac{1}{1 + 1.08\,(\theta p^*)^{0.88}} \;(\theta p^* \le 1.915),\quad "  # noqa: E501
    r"\frac{1}{1 + 1.46\,(\theta p^*)^{0.48}} \;(\theta p^* > 1.915),\quad \theta p^* = \frac{B\,\Delta p\,t}{\eta\,\varepsilon\,(1-S_\infty)Z^2}",  # noqa: E501
    fitted={"dimensionless_time": (0.096, 204.0)},
    typical={
        **_CAKE,
        "time": (10.0, 300.0),
        "cake_permeability": (1e-13, 1e-12),
        "irreducible_saturation": (0.16, 0.3),
    },
)
def saturation_after_deliquoring(
    time: Time,
    pressure_drop: PressureDrop,
    cake_permeability: Permeability,
    dynamic_viscosity: DynamicViscosity,
    void_fraction: VoidFraction,
    cake_thickness: Length,
    irreducible_saturation: Fraction,
) -> Fraction:
    """Saturation of a cake after a time of blowing or sucking gas through it, by Wakeman's charts as
    correlated.

    Holds well above the threshold pressure. The two branches meet within 0.01.

    >>> round(
    ...     saturation_after_deliquoring(
    ...         time=60,
    ...         pressure_drop=5e4,
    ...         cake_permeability=2e-13,
    ...         dynamic_viscosity=1e-3,
    ...         void_fraction=0.45,
    ...         cake_thickness=0.02,
    ...         irreducible_saturation=0.2,
    ...     ),
    ...     3,
    ... )
    0.405
    """
    theta = (
        cake_permeability
        * pressure_drop
        * time
        / (
            dynamic_viscosity
            * void_fraction
            * jnp.maximum(1.0 - irreducible_saturation, 1e-9)
            * cake_thickness**2
        )
    )
    some = theta > 0
    x = jnp.where(some, theta, 1.0)
    watch(dimensionless_time=x)
    reduced = jnp.where(x <= 1.915, 1.0 / (1.0 + 1.08 * x**0.88), 1.0 / (1.0 + 1.46 * x**0.48))
    return jnp.where(some, irreducible_saturation + (1.0 - irreducible_saturation) * reduced, 1.0)


@formula(
    source="wakeman2005",
    title="Moisture of a cake, dry basis",
    equation=r"X = \frac{S\,\varepsilon\,\rho_l}{(1-\varepsilon)\,\rho_s}",
)
def moisture_dry_basis_cake(
    cake_saturation: Fraction, void_fraction: VoidFraction, liquid_density: Density, solid_density: Density
) -> MoistureDryBasis:
    """Cake moisture, dry basis, from its saturation.

    >>> round(
    ...     moisture_dry_basis_cake(
    ...         cake_saturation=0.5, void_fraction=0.4, liquid_density=1000, solid_density=2000
    ...     ),
    ...     4,
    ... )
    0.1667
    """
    return cake_saturation * void_fraction * liquid_density / ((1.0 - void_fraction) * solid_density)


@formula(
    source="wakeman2005; brooks1964",
    equation=r"u_g = \frac{B\,k_{rg}}{\eta_g}\,\frac{p_1^2 - p_2^2}{2\,p_2\,Z},\quad k_{rg} = (1-S_R)^2\left(1 - S_R^{(2+\lambda)/\lambda}\right)",  # noqa: E501
    typical={
        "cake_permeability": (1e-13, 1e-11),
        "cake_thickness": (5e-3, 5e-2),
        "pressure": (1e5, 5e5),
        "pressure_outlet": (2e4, 9e4),
        "dynamic_viscosity": (1.5e-5, 2.5e-5),
        "reduced_saturation": (0.05, 0.8),
    },
    symbols={"pressure": "p_1", "dynamic_viscosity": r"\eta_g"},
)
def gas_velocity_deliquoring(
    cake_permeability: Permeability,
    cake_thickness: Length,
    pressure: PressureDrop,
    pressure_outlet: PressureDrop,
    dynamic_viscosity: DynamicViscosity,
    reduced_saturation: Fraction,
    pore_size_index: PositiveNumber = 5.0,
) -> Speed:
    """Superficial gas velocity at the outlet pressure through a cake that is partly saturated: the duty of
    the vacuum pump.

    The viscosity is that of the gas. Relative permeability after Brooks and Corey with the pore size index of
    unconsolidated cakes.

    >>> round(gas_velocity_deliquoring(1e-12, 0.01, 2e5, 1e5, 2e-5, 0.0), 4)
    0.75
    """
    S = reduced_saturation
    relative = (1.0 - S) ** 2 * (1.0 - jnp.maximum(S, 1e-300) ** ((2.0 + pore_size_index) / pore_size_index))
    p1, p2 = pressure, pressure_outlet
    impossible(p2 > p1, p2, "pressure_outlet", 0.0, p1)
    return cake_permeability * relative / dynamic_viscosity * (p1**2 - p2**2) / (2.0 * p2 * cake_thickness)
