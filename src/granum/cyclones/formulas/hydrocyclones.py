"""Hydrocyclones: Plitt, Rietema, Castilho and Medronho (Rietema's and Bradley's families stay similar in Stk
Eu).
"""

from __future__ import annotations

from typing import NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible, limit_active
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Fraction,
    Length,
    PositiveNumber,
    PressureDrop,
    VolumeFlow,
    VolumeFraction,
)
from granum.cyclones.formulas.efficiency import heavier

SLURRY = {
    "volume_flow": (1e-3, 3e-3), "diameter": (0.09, 0.12), "inlet_diameter": (0.025, 0.035), "outlet_diameter": (0.03, 0.04),  # noqa: E501
    "underflow_diameter": (0.015, 0.025), "free_height": (0.3, 0.5), "solids_volume_fraction": (0.01, 0.1),
    "pressure_drop": (5e4, 2e5), "length": (0.4, 0.6),
}  # fmt: skip


WIDE_OPENING = "The openings of a hydrocyclone must be narrower than its body."
ALL_WATER = "By this law nearly all the water would leave below: its share is cut to 99.9 %."
MOST_WATER = 0.999


class HydrocycloneFigures(NamedTuple):
    """Cut, pressure drop, flow ratio and sharpness of a hydrocyclone."""

    cut_size: Length
    pressure_drop: PressureDrop
    underflow_share: Fraction
    sharpness: PositiveNumber


@formula(
    source="plitt1976; flintoff1987",
    equation=(
        r"d_{50} = "
        r"\frac{39.7\,D^{0.46}D_i^{0.6}D_e^{1.21}\eta^{0.5}e^{0.063\varphi}}{D_u^{0.71}h^{0.38}Q^{0.45}[(\rho_p-\rho_f)/1.6]^{0.5}}"
    ),
    typical=SLURRY,
)
def hydrocyclone_plitt(
    volume_flow: VolumeFlow,
    diameter: Length,
    inlet_diameter: Length,
    outlet_diameter: Length,
    underflow_diameter: Length,
    free_height: Length,
    solids_volume_fraction: VolumeFraction,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
) -> HydrocycloneFigures:
    """Corrected cut size, pressure drop, share of the slurry to the underflow and sharpness of a hydrocyclone
    by Plitt.

    The free height runs from the end of the vortex finder to the apex. The print is in cm, L/min, kPa and
    percent, from 297 tests with silica in water; the viscosity is Flintoff's addition.

    >>> x = hydrocyclone_plitt(
    ...     volume_flow="100 L/min",
    ...     diameter=0.1,
    ...     inlet_diameter=0.03,
    ...     outlet_diameter=0.035,
    ...     underflow_diameter=0.02,
    ...     free_height=0.4,
    ...     solids_volume_fraction=0.05,
    ...     particle_density=2650,
    ...     fluid_density=1000,
    ...     dynamic_viscosity="1 cP",
    ... )
    >>> 5e-6 < x.cut_size < 4e-5 and 0.0 < x.underflow_share < 0.5
    True
    """
    for opening, name in (
        (inlet_diameter, "inlet_diameter"),
        (outlet_diameter, "outlet_diameter"),
        (underflow_diameter, "underflow_diameter"),
    ):
        impossible(~(opening < diameter), opening, name, 0.0, diameter, WIDE_OPENING)
    Dc, Di, Do, Du, h = (
        100.0 * x for x in (diameter, inlet_diameter, outlet_diameter, underflow_diameter, free_height)
    )
    Q, phi = 6e4 * volume_flow, 100.0 * solids_volume_fraction
    excess = heavier(particle_density, fluid_density) / 1600.0
    cut = 39.7e-6 * Dc**0.46 * Di**0.6 * Do**1.21 * jnp.exp(0.063 * phi) / (Du**0.71 * h**0.38 * Q**0.45)
    cut = cut * jnp.sqrt(1e3 * dynamic_viscosity / excess)
    square = Du**2 + Do**2
    kilopascal = 1.88 * Q**1.78 * jnp.exp(0.0055 * phi) / (Dc**0.37 * Di**0.94 * h**0.28 * square**0.87)
    slurry = fluid_density * (1.0 - solids_volume_fraction) + particle_density * solids_volume_fraction
    head = 1e3 * kilopascal / (slurry * 9.80665)  # meters of slurry
    split = 1.9 * (Du / Do) ** 3.31 * h**0.54 * square**0.36 * jnp.exp(0.0054 * phi) / (head**0.24 * Dc**1.11)
    share = split / (1.0 + split)
    sharpness = 1.94 * jnp.exp(-1.58 * share) * (Dc**2 * h / Q) ** 0.15
    return HydrocycloneFigures(cut, 1e3 * kilopascal, share, sharpness)


@formula(
    source="rietema1961; svarovsky2001",
    equation=r"\mathrm{Cy}_{50} = \frac{d_{50}^2(\rho_p-\rho_f)L\,\Delta p}{\eta\rho_f Q} = 3.5",
    output="cut_size",
    typical=SLURRY,
)
def cut_size_rietema(
    volume_flow: VolumeFlow,
    pressure_drop: PressureDrop,
    length: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    cyclone_number: PositiveNumber = 3.5,
) -> Length:
    """Cut size of a hydrocyclone of Rietema's best proportions, from its length, flow and pressure drop.

    >>> round(
    ...     1e6
    ...     * cut_size_rietema(
    ...         volume_flow=1e-3,
    ...         pressure_drop=1e5,
    ...         length=0.5,
    ...         particle_density=2000,
    ...         fluid_density=1000,
    ...         dynamic_viscosity=1e-3,
    ...     ),
    ...     2,
    ... )
    8.37
    """
    excess = heavier(particle_density, fluid_density)
    return jnp.sqrt(
        cyclone_number * dynamic_viscosity * fluid_density * volume_flow / (excess * length * pressure_drop)
    )


@formula(
    source="castilho2000; svarovsky2001",
    equation=(
        r"\mathrm{Stk}'_{50}\mathrm{Eu} = 0.0474\left[\ln\frac{1}{R_f}\right]^{0.742}e^{8.96 \varphi},\ "
        r"\mathrm{Eu} = 371.5\,\mathrm{Re}^{0.116}e^{-2.12 \varphi},\ R_f = "
        r"1218\left(\frac{D_u}{D}\right)^{4.75}\mathrm{Eu}^{-0.30},\quad \mathrm{Stk}'_{50} = "
        r"\frac{d_{50}^2\,(\rho_p - \rho_f)\,v}{18\,\eta\,D},\ \mathrm{Re} = \frac{\rho_f v D}{\eta},\ "
        r"v = \frac{4Q}{\pi D^2},\quad \Delta p = \mathrm{Eu}\,\frac{\rho_f v^2}{2}"
    ),
    fitted={"solids_volume_fraction": (0.0, 0.1)},
    typical={**SLURRY, "underflow_diameter": (0.01, 0.018)},
)
def hydrocyclone_castilho_medronho(
    volume_flow: VolumeFlow,
    diameter: Length,
    underflow_diameter: Length,
    solids_volume_fraction: VolumeFraction,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    sharpness: PositiveNumber = 2.7,
) -> HydrocycloneFigures:
    """Reduced cut size, pressure drop, water split and sharpness of a hydrocyclone of Rietema's proportions
    by Castilho and Medronho.

    >>> x = hydrocyclone_castilho_medronho(
    ...     volume_flow=1e-3,
    ...     diameter=0.1,
    ...     underflow_diameter=0.015,
    ...     solids_volume_fraction=0.01,
    ...     particle_density=2650,
    ...     fluid_density=1000,
    ...     dynamic_viscosity=1e-3,
    ... )
    >>> 2e-5 < x.cut_size < 5e-5
    True
    """
    D, rho, eta, c = diameter, fluid_density, dynamic_viscosity, solids_volume_fraction
    v = 4.0 * volume_flow / (jnp.pi * D**2)
    Re = rho * v * D / eta
    Eu = 371.5 * Re**0.116 * jnp.exp(-2.12 * c)
    impossible(~(underflow_diameter < D), underflow_diameter, "underflow_diameter", 0.0, D, WIDE_OPENING)
    water = 1218.0 * (underflow_diameter / D) ** 4.75 * Eu**-0.30
    limit_active(water > MOST_WATER, water, "underflow_share", ALL_WATER)
    water = jnp.clip(water, 1e-6, MOST_WATER)
    product = 0.0474 * jnp.log(1.0 / water) ** 0.742 * jnp.exp(8.96 * c)
    cut = jnp.sqrt(18.0 * eta * D * product / (Eu * heavier(particle_density, rho) * v))
    return HydrocycloneFigures(cut, Eu * rho * v**2 / 2.0, water, sharpness * jnp.ones_like(water))


@formula(
    source="svarovsky2001",
    equation=r"G = R_f + (1 - R_f)\left[1 - e^{-\ln 2\,(d_p/d_{50})^n}\right]",
    typical={
        "cut_size": (5e-6, 3e-5),
        "sharpness": (2.0, 3.5),
        "underflow_share": (0.05, 0.3),
        "particle_diameter": (1e-6, 1e-4),
    },
)
def hydrocyclone_efficiency(
    particle_diameter: Length, cut_size: Length, sharpness: PositiveNumber, underflow_share: Fraction
) -> Fraction:
    """Grade efficiency of a hydrocyclone: what follows the water to the underflow, and Plitt's curve for the
    rest.

    >>> round(
    ...     hydrocyclone_efficiency(
    ...         particle_diameter=1e-5, cut_size=1e-5, sharpness=2.5, underflow_share=0.2
    ...     ),
    ...     6,
    ... )
    0.6
    """
    sorted_out = -jnp.expm1(-jnp.log(2.0) * (particle_diameter / cut_size) ** sharpness)
    return underflow_share + (1.0 - underflow_share) * sorted_out
