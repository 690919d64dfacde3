"""Cyclones sized backwards: from the pressure drop one can spend and the cut one wants."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import procedure
from granum.core.errors import ApplicabilityError
from granum.core.i18n import _
from granum.core.kinds import Density, DynamicViscosity, Law, Length, MassRatio, PositiveNumber, PressureDrop, Speed, VolumeFlow
from granum.core.units import format_number
from granum.cyclones.formulas.efficiency import cut_size_muschelknautz
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


@procedure(source="hoffmann2008; muschelknautz1972; stairmand1949", title="Cyclones for a cut and a pressure drop",
           typical={"volume_flow": (1.0, 10.0), "pressure_drop": (500.0, 1500.0), "cut_size": (2e-6, 6e-6)})  # fmt: skip
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

    The pressure drop sets the inlet velocity, the cut then the diameter, the flow the number, which is left broken: round up, and the cut
    coarsens a little.

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
        cut = cut_size_muschelknautz(flow(D), particle_density, fluid_density, dynamic_viscosity, *cyclone_geometry(D), dust_loading)
        return jnp.log(cut / cut_size)

    D = float(jnp.exp(find_root(off, jnp.log(SMALLEST), jnp.log(LARGEST)).value))
    if not D > 0.0:
        raise ApplicabilityError(
            _("No cyclone of {low} to {high} m cuts at {cut} µm with {drop} Pa: allow another pressure drop or other proportions.").format(
                low=SMALLEST, high=LARGEST, cut=format_number(1e6 * cut_size), drop=format_number(pressure_drop)
            )
        )
    salt = saltation_velocity_kalen_zenz(v, D, cyclone_geometry(D).inlet_width, particle_density, fluid_density, dynamic_viscosity)
    return CycloneSize(D, float(volume_flow / flow(D)), float(v), float(salt))
