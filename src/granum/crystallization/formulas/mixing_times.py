"""Is what meets mixed before it crystallizes? Times of mixing in a vessel, and of the first crystals."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.flags import impossible
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Fraction,
    GrowthRate,
    Length,
    NucleationRate,
    PositiveNumber,
    SpecificPower,
    Time,
)
from granum.numerics.smooth import safe_power

NOTHING = "No crystals are born, or none grow: the time has no end."


@formula(
    source="nienow1997",
    title="Mixing time of a stirred vessel (Nienow)",
    equation=r"t_m = 5.9\,D_v^{2/3}\,\varepsilon^{-1/3}\,(D/D_v)^{-1/3}",
    typical={"specific_power_input": (0.05, 2.0), "vessel_diameter": (0.3, 4.0)},
    family="mixing_time",
)
def mixing_time_nienow(
    vessel_diameter: Length, impeller_diameter: Length, specific_power_input: SpecificPower
) -> Time:
    """Time until a stirred vessel as high as wide is mixed to 95 %, turbulent, any stirrer.

    Of one power per mass all stirrers mix alike. Nienow (1997) was not opened; the equation is recalled.

    >>> round(mixing_time_nienow(vessel_diameter=1.0, impeller_diameter=0.5, specific_power_input=1.0), 2)
    7.43
    """
    share = impeller_diameter / vessel_diameter
    return 5.9 * safe_power(vessel_diameter**2 / (specific_power_input * share), 1.0 / 3.0)


@formula(
    source="baldyga1999",
    title="Time of engulfment by the smallest eddies (Bałdyga and Bourne)",
    equation=r"t_m = 17.2\,\sqrt{\frac{\eta}{\rho_l\,\varepsilon}}",
    typical={"specific_power_input": (0.05, 2.0)},
    family="mixing_time",
)
def mixing_time_engulfment(
    dynamic_viscosity: DynamicViscosity, liquid_density: Density, specific_power_input: SpecificPower
) -> Time:
    """Time of mixing on the smallest scale, where eddies engulf one liquid in the other.

    Valid where diffusion in the layers is not what takes longest, as in water. Near the stirrer the power is
    some tens of times the mean. Bałdyga and Bourne (1999) were not opened; the equation is recalled.

    >>> round(
    ...     mixing_time_engulfment(dynamic_viscosity=1e-3, liquid_density=1000.0, specific_power_input=1.0),
    ...     4,
    ... )
    0.0172
    """
    return 17.2 * jnp.sqrt(dynamic_viscosity / (liquid_density * specific_power_input))


@formula(
    source="kashchiev2003",
    title="Time until the first crystals fill a share of the volume",
    equation=r"t_{ind} = \left(\frac{4\,\varphi}{k_v\,B_0\,G^3}\right)^{1/4}",
    typical={
        "solids_volume_fraction": (1e-6, 1e-3),
        "nucleation_rate": (1e6, 1e12),
        "growth_rate": (1e-9, 1e-7),
    },
)
def induction_time_volume(
    solids_volume_fraction: Fraction,
    nucleation_rate: NucleationRate,
    growth_rate: GrowthRate,
    volume_shape_factor: PositiveNumber = 1.0,
) -> Time:
    """Time until crystals that are born and grow at constant rates fill a share of the volume.

    Many nuclei, so that chance plays no part; nothing is used up meanwhile. Kashchiev and van Rosmalen (2003)
    were not opened; the equation follows from the integral of the volume of all crystals.

    >>> round(induction_time_volume(solids_volume_fraction=1e-4, nucleation_rate=4e8, growth_rate=1e-8), 0)
    1000.0
    """
    rate = volume_shape_factor * nucleation_rate * growth_rate**3
    some = rate > 0.0
    impossible(~some, rate, "nucleation_rate", reason=NOTHING)
    return jnp.where(
        some, safe_power(4.0 * solids_volume_fraction / jnp.where(some, rate, 1.0), 0.25), jnp.inf
    )
