"""Cyclones and hydrocyclones sized backwards: from the pressure drop one can spend and the cut one wants."""

from __future__ import annotations

from math import ceil
from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import procedure
from granum.core.errors import ApplicabilityError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Fraction,
    Law,
    Length,
    MassRatio,
    PositiveNumber,
    PressureDrop,
    Speed,
    VolumeFlow,
    VolumeFraction,
)
from granum.core.units import format_number
from granum.cyclones.formulas.efficiency import cut_size_muschelknautz
from granum.cyclones.formulas.hydrocyclones import hydrocyclone_castilho_medronho
from granum.cyclones.formulas.pressure import inlet_heads_stairmand, saltation_velocity_kalen_zenz
from granum.cyclones.geometry import StandardCyclone
from granum.numerics import find_root

SMALLEST, LARGEST = 0.02, 10.0  # m, what is built


class CycloneSize(NamedTuple):
    """Equal cyclones in parallel that meet a cut and a pressure drop."""

    diameter: Length
    parallel_number: PositiveNumber
    inlet_velocity: Speed
    saltation_velocity: Speed


@procedure(
    source="hoffmann2008; muschelknautz1972; stairmand1949",
    title="Cyclones for a cut and a pressure drop",
    typical={"volume_flow": (1.0, 10.0), "pressure_drop": (500.0, 1500.0), "cut_size": (2e-6, 6e-6)},
)
def cyclone_sizing(
    volume_flow: VolumeFlow,
    cut_size: Length,
    pressure_drop: PressureDrop,
    particle_density: Density,
    fluid_density: Density = 1.2,
    dynamic_viscosity: DynamicViscosity = 1.8e-5,
    dust_loading: MassRatio = 0.0,
    cyclone_geometry: Annotated[Any, Law("cyclone_geometry")] = StandardCyclone(),
) -> CycloneSize:
    """Diameter and number of equal cyclones of given proportions that reach a cut size at a pressure drop.

    The pressure drop sets the inlet velocity, the cut then the diameter, the flow the number, which is left
    broken: round up, and the cut coarsens a little.

    >>> small = cyclone_sizing("1 m^3/s", "2 um", 1000.0, 2000.0)
    >>> small.diameter < cyclone_sizing("1 m^3/s", "4 um", 1000.0, 2000.0).diameter
    True
    """
    heads = inlet_heads_stairmand(*cyclone_geometry(1.0))
    v = (2.0 * pressure_drop / (heads * fluid_density)) ** 0.5

    def flow(D: Any) -> Any:
        shape = cyclone_geometry(D)
        return v * shape.inlet_height * shape.inlet_width

    def off(u: Any) -> Any:
        D = jnp.exp(u)
        cut = cut_size_muschelknautz(
            flow(D), particle_density, fluid_density, dynamic_viscosity, *cyclone_geometry(D), dust_loading
        )
        return jnp.log(cut / cut_size)

    D = float(jnp.exp(find_root(off, jnp.log(SMALLEST), jnp.log(LARGEST)).value))
    if not D > 0.0:
        raise ApplicabilityError(
            _(
                "No cyclone of {low} to {high} m cuts at {cut} µm with {drop} Pa: allow another "
                "pressure drop or other proportions."
            ).format(
                low=SMALLEST,
                high=LARGEST,
                cut=format_number(1e6 * cut_size),
                drop=format_number(pressure_drop),
            )
        )
    salt = saltation_velocity_kalen_zenz(
        v, D, cyclone_geometry(D).inlet_width, particle_density, fluid_density, dynamic_viscosity
    )
    return CycloneSize(D, float(volume_flow / flow(D)), float(v), float(salt))


NARROWEST, WIDEST = 0.005, 1.0  # m, hydrocyclones that are built


class HydrocycloneSize(NamedTuple):
    """Equal hydrocyclones in parallel that meet a cut, a pressure drop and a water split."""

    diameter: Length
    underflow_diameter: Length
    parallel_number: PositiveNumber
    cut_size: Length
    pressure_drop: PressureDrop
    underflow_share: Fraction


@procedure(
    source="castilho2000; svarovsky2001",
    title="Hydrocyclones for a cut and a pressure drop",
    typical={
        "volume_flow": (0.01, 0.1),
        "pressure_drop": (8e4, 2e5),
        "cut_size": (8e-6, 2e-5),
        "underflow_share": (0.05, 0.2),
        "particle_density": (2500.0, 3000.0),
        "fluid_density": (990.0, 1010.0),
        "dynamic_viscosity": (8e-4, 1.2e-3),
        "solids_volume_fraction": (0.0, 0.05),
    },
)
def hydrocyclone_sizing(
    volume_flow: VolumeFlow,
    cut_size: Length,
    pressure_drop: PressureDrop,
    underflow_share: Fraction,
    particle_density: Density,
    fluid_density: Density = 998.0,
    dynamic_viscosity: DynamicViscosity = 1e-3,
    solids_volume_fraction: VolumeFraction = 0.01,
) -> HydrocycloneSize:
    """Diameter, apex and number of equal hydrocyclones of Rietema's proportions for a cut, a pressure drop
    and a share of the water below.

    The number is whole, the diameter that of the wanted cut: at the flow that is then left for each the
    pressure drop is not above the one allowed, and the cut found is stated.

    >>> plant = hydrocyclone_sizing("50 m^3/hour", "10 um", "2 bar", "10 %", 2650)
    >>> plant.pressure_drop <= 2e5, round(1e6 * plant.cut_size) in (10, 11)
    (True, True)
    """
    thin = jnp.exp(-2.12 * solids_volume_fraction)

    def flow(D: Any) -> Any:
        v = (
            2.0
            * pressure_drop
            / (fluid_density * 371.5 * thin * (fluid_density * D / dynamic_viscosity) ** 0.116)
        ) ** (1.0 / 2.116)
        return v * jnp.pi / 4.0 * D**2

    def apex(D: Any, Q: Any) -> Any:
        euler = 371.5 * thin * (4.0 * fluid_density * Q / (jnp.pi * D * dynamic_viscosity)) ** 0.116
        return D * (underflow_share * euler**0.30 / 1218.0) ** (1.0 / 4.75)

    def found(D: Any, Q: Any) -> Any:
        return hydrocyclone_castilho_medronho(
            Q, D, apex(D, Q), solids_volume_fraction, particle_density, fluid_density, dynamic_viscosity
        )

    def off(u: Any) -> Any:
        D = jnp.exp(u)
        return jnp.log(found(D, flow(D)).cut_size / cut_size)

    D = float(jnp.exp(find_root(off, jnp.log(NARROWEST), jnp.log(WIDEST)).value))
    if not D > 0.0:
        raise ApplicabilityError(
            _(
                "No hydrocyclone of {low} to {high} m cuts at {cut} µm with {drop} Pa: allow another "
                "pressure drop or another split."
            ).format(
                low=NARROWEST,
                high=WIDEST,
                cut=format_number(1e6 * cut_size),
                drop=format_number(pressure_drop),
            )
        )
    number = float(ceil(volume_flow / float(flow(D)) - 1e-9))
    Q = volume_flow / number
    each = found(D, Q)
    return HydrocycloneSize(
        D,
        float(apex(D, Q)),
        number,
        float(each.cut_size),
        float(each.pressure_drop),
        float(each.underflow_share),
    )
