"""Beds of product dried by gas that blows through them: heat transfer, grain's resistance to air."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import HOUR
from granum.core.kinds import (
    Fraction,
    HeatTransferCoefficient,
    Length,
    MassFlux,
    PositiveNumber,
    PressureGradient,
    SpecificSurface,
    Speed,
    VoidFraction,
)

VISCOSITY = 2.1e-5  # Pa s, of air, for the Reynolds number at which the two printed forms meet
BORDER = 350.0
EXCHANGED = 0.05  # m of bed, over which bubbles pass on one transfer unit of all the gas
LEAST = 1e-9  # share of the gas in bubbles, and m/s of gas


@formula(
    source="geankoplis2003, ch. 9; wilke1945; gamson1943",
    equation=(
        r"h = 0.151\,\frac{G^{0.59}}{d_p^{0.41}}\ (\mathrm{Re}>350),\quad h = "
        r"0.214\,\frac{G^{0.49}}{d_p^{0.51}}\ (\mathrm{Re}<350),\quad G\text{ in }\mathrm{kg/(m^2 h)}"
    ),
    typical={"gas_mass_flux": (0.3, 2.0), "particle_diameter": (4e-3, 2e-2)},
    output="heat_transfer_coefficient",
    title="Convection to particles of a bed, gas through it",
)
def heat_transfer_coefficient_through_bed(
    gas_mass_flux: MassFlux, particle_diameter: Length
) -> HeatTransferCoefficient:
    """Air through a bed of particles on a belt or screen, flux on the empty section. The form changes at a
    Reynolds number of 350.

    Geankoplis, granular paste in cylinders of equivalent diameter 13.5 mm: G = 2570 kg/(m² h) gives
    90.9 W/(m² K).

    The two forms are those of Wilke and Hougen and of Gamson and others.

    >>> round(heat_transfer_coefficient_through_bed("2570 kg/(m^2*hour)", "13.5 mm"), 0)
    91.0
    """
    G, d = gas_mass_flux * HOUR, particle_diameter
    Re = gas_mass_flux * d / VISCOSITY
    return jnp.where(Re > BORDER, 0.151 * G**0.59 / d**0.41, 0.214 * G**0.49 / d**0.51)


@formula(
    source="geankoplis2003, ch. 9",
    equation=r"a_g = \frac{4(1-\varepsilon)(l + d/2)}{d\,l}",
    typical={"diameter": (3e-3, 2e-2), "length": (3e-3, 5e-2), "void_fraction": (0.35, 0.65)},
    output="specific_surface",
    title="Surface of a bed of cylinders",
    symbols={"diameter": "d", "length": "l"},
)
def specific_surface_cylinders(
    diameter: Length, length: Length, void_fraction: VoidFraction
) -> SpecificSurface:
    """Surface per volume of a bed of cylinders of given diameter and length.

    Geankoplis, cylinders 6.35 mm by 25.4 mm, void fraction 0.6: 283.5 m²/m³.

    >>> round(specific_surface_cylinders("6.35 mm", "25.4 mm", 0.6), 1)
    283.5
    """
    return 4.0 * (1.0 - void_fraction) * (length + 0.5 * diameter) / (diameter * length)


@formula(
    source="shedd1953; asaed272",
    equation=r"\frac{\Delta p}{L} = \frac{a\,U^2}{\ln(1 + b\,U)}",
    fitted={"superficial_velocity": (0.0056, 0.304)},
    typical={"superficial_velocity": (0.01, 0.3)},
    output="pressure_gradient",
    title="Resistance of grain to air flow (Shedd)",
)
def pressure_gradient_shedd(
    superficial_velocity: Speed,
    shedd_coefficient: PositiveNumber = 2.07e4,
    shedd_constant: PositiveNumber = 30.4,
) -> PressureGradient:
    """Pressure lost by air in a bed of grain, with the constants of shelled corn: a in Pa s²/m³, b in s/m;
    loose fill, clean.

    By hand: 2.07e4 · 0.01/ln(4.04) = 148 Pa/m at 0.1 m/s.

    >>> round(pressure_gradient_shedd(0.1))
    148
    """
    U = superficial_velocity
    return shedd_coefficient * U**2 / jnp.log1p(shedd_constant * U)


@formula(
    source="hukill1954",
    equation=r"MR = \frac{2^{D}}{2^{D} + 2^{Y} - 1}",
    typical={"depth_units": (0.1, 8.0), "time_units": (0.1, 8.0)},
    output="moisture_ratio",
    title="Deep bed of grain (Hukill)",
)
def moisture_ratio_hukill(depth_units: PositiveNumber, time_units: PositiveNumber) -> PositiveNumber:
    """Moisture ratio in a deep bed at a depth and time: the time unit halves the moisture ratio of a thin
    layer, the depth unit holds the grain whose whole excess water the air could take up in one time unit.

    Exact for drying in proportion to moisture ratio and to the cooling of the air. At the bottom it halves
    with each time unit:

    >>> round(moisture_ratio_hukill(depth_units=1.0, time_units=1.0), 4)
    0.6667
    >>> round(moisture_ratio_hukill(depth_units=1e-12, time_units=1.0), 9)
    0.5
    """
    D, Y = 2.0**depth_units, 2.0**time_units
    return D / (D + Y - 1.0)


@formula(
    source="groenewold1997; lehmann2021",
    equation=(
        r"b = \beta\,\exp\left(-\frac{H}{\beta\,H_T}\right),\quad \beta = 1 - \frac{U_{mf}}{U},\quad "
        r"H_T = 50\ \mathrm{mm}"
    ),
    typical={
        "superficial_velocity": (0.2, 3.0),
        "minimum_fluidization_velocity": (0.005, 1.0),
        "height": (0.02, 0.6),
    },
    title="Gas that bypasses the grains of a drying bed in bubbles",
    symbols={"bypass_fraction": "b"},
)
def bypass_fraction_groenewold_tsotsas(
    superficial_velocity: Speed, minimum_fluidization_velocity: Speed, height: Length
) -> Fraction:
    """Share of the gas that leaves a fluidized bed as it entered, from the bubbles that the dense phase has
    not reached.

    Between the bubbles and the dense phase of dryers one transfer unit of all the gas takes 5 cm of bed,
    whatever the grains: grains that fall through the bubbles count, so that this is far more than the
    gas alone exchanges with its clouds. The source is recalled; the 5 cm stand in the vibrated dryer of
    Lehmann and others, whose program was read. ``height`` is that of the settled bed.

    >>> round(bypass_fraction_groenewold_tsotsas(0.5, 0.25, "25 mm"), 3) == round(0.5 * 2.718282**-1, 3)
    True
    """
    flowing = jnp.maximum(superficial_velocity, LEAST)
    bubbles = jnp.clip(1.0 - minimum_fluidization_velocity / flowing, LEAST, 1.0)
    return bubbles * jnp.exp(-height / (bubbles * EXCHANGED))
