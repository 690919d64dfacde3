"""Slug flow in a narrow tube: long bubbles of gas part the liquid, and each slug stirs itself."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, unconverged, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Fraction,
    Frequency,
    Length,
    PressureDrop,
    Ratio,
    SurfaceTension,
    Velocity,
)
from granum.crystallization.formulas.tubes import ForwardVelocity
from granum.numerics import find_root
from granum.numerics.smooth import safe_divide, safe_power

THINNEST, CURVED = 1.34, 3.35  # Aussillous and Quéré: film over radius, 1.34 Ca^(2/3) / (1 + 3.35 Ca^(2/3))
LAMINAR, BENT = 16.0, 0.17  # Kreutzer: friction factor of the slugs and what the ends of bubbles add


class SlugFlow(NamedTuple):
    """What a tube with slugs comes to."""

    velocity_bubble: Velocity
    film_thickness_slug: Length
    gas_fraction_slug: Fraction
    bubble_length: Length
    slug_frequency: Frequency
    capillary_number_slug: Ratio
    eotvos_number: Ratio
    reynolds: Ratio
    pressure_drop: PressureDrop


@formula(
    source="aussillous2000; bretherton1961; kreutzer2005",
    title="Slug flow of gas and liquid in a narrow tube",
    equation=r"\frac{2\delta}{D} = \frac{1.34\,\mathrm{Ca}^{2/3}}{1 + 3.35\,\mathrm{Ca}^{2/3}},\quad "
    r"U_b = \frac{U_L + U_G}{(1 - 2\delta/D)^2},\quad \varepsilon = \frac{U_G}{U_b},\quad "
    r"\Delta p = \frac{32\,\eta\,(U_L + U_G)}{D^2}\left(1 + 0.17\,\frac{D}{L_s}"
    r"\left(\frac{\rho_f D\,\sigma}{\eta^2}\right)^{1/3}\right)(1-\varepsilon)\,L",
    symbols={"superficial_velocity_liquid": "U_L", "superficial_velocity_gas": "U_G"},
    fitted={"capillary_number_slug": (0.0, 1.4)},
    typical={
        "superficial_velocity_liquid": (5e-3, 0.1),
        "superficial_velocity_gas": (5e-3, 0.1),
        "diameter": (1e-3, 4e-3),
        "length": (5.0, 50.0),
    },
)
def slug_flow(
    superficial_velocity_liquid: ForwardVelocity,
    superficial_velocity_gas: ForwardVelocity,
    diameter: Length,
    length: Length,
    slug_length: Length,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    surface_tension: SurfaceTension = 0.072,
) -> SlugFlow:
    """Speed of the bubbles, film past which they glide, share of gas and pressure drop of slug flow.

    Bubbles run ahead of the mean flow by the section that the film takes. The capillary number is that of the
    bubbles; the friction has the mean velocity in both groups. Bubbles count as cylinders that fill the tube.
    Where gravity is stronger than surface tension (Eötvös number beyond 3.4, Bretherton) bubbles rise in the
    liquid and slugs do not part it.

    >>> found = slug_flow("20 mm/s", "20 mm/s", "3 mm", "15 m", "6 mm", 1000, "1 mPa s", "72 mN/m")
    >>> [float(f"{x:.3g}") for x in found[:4]]
    [0.0407, 1.34e-05, 0.491, 0.00579]
    """
    U = superficial_velocity_liquid + superficial_velocity_gas
    eta, sigma = dynamic_viscosity, surface_tension

    def film(bubble: Any) -> Any:
        power = safe_power(eta * bubble / sigma, 2.0 / 3.0)
        return THINNEST * power / (1.0 + CURVED * power)

    highest = U / (1.0 - THINNEST / CURVED) ** 2
    moves = U > 0.0
    root = find_root(
        lambda bubble: bubble * (1.0 - film(bubble)) ** 2 - jnp.where(moves, U, 1.0),
        jnp.where(moves, U, 1.0),
        jnp.where(moves, highest, 3.0) * 1.001,
    )
    unconverged(root.converged)
    bubble = jnp.where(moves, root.value, 0.0)
    capillary = eta * bubble / sigma
    watch(capillary_number_slug=capillary)
    gas = safe_divide(superficial_velocity_gas, bubble)
    per_velocity = fluid_density * diameter / eta
    reynolds = U * per_velocity
    ends = 1.0 + BENT * diameter / slug_length * (per_velocity * sigma / eta) ** (1.0 / 3.0)
    cell = slug_length / jnp.maximum(1.0 - gas, 1e-15)
    return SlugFlow(
        bubble,
        0.5 * diameter * film(bubble),
        gas,
        cell - slug_length,
        bubble / cell,
        capillary,
        fluid_density * STANDARD_GRAVITY * diameter**2 / sigma,
        reynolds,
        2.0 * LAMINAR * eta * U / diameter**2 * ends * (1.0 - gas) * length,
    )
