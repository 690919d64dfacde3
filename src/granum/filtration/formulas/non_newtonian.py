"""Cake filtration of liquids that do not follow Newton."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import (
    Area,
    CakeResistance,
    Concentration,
    Density,
    DynamicViscosity,
    FlowIndex,
    MediumResistance,
    PressureDrop,
    ShearRate,
    Time,
    VoidFraction,
    Volume,
)
from granum.filtration.formulas.resistance import cake_permeability
from granum.porous.formulas.non_newtonian import dynamic_viscosity_permeable_christopher_middleman


@formula(
    source="shirato1977; kozicki1990; christopher1965",
    title="Filtration time of a power-law liquid at constant pressure",
    equation=(
        r"t = \frac{n}{n+1}\,\frac{R}{\alpha W\,u}\left[1 - \left(\frac{R_s}{R}\right)^{1+1/n}\right],"
        r"\quad R = \alpha W\frac{V}{A} + R_s,\quad \eta(u)\,u\,R = \Delta p,\quad "
        r"\eta(u) = \frac{\eta_1}{12}\left(9 + \frac{3}{n}\right)^n"
        r"\left(\frac{\dot\gamma_1\sqrt{150\,B\,\varepsilon}}{u}\right)^{1-n},\quad "
        r"B = \frac{1}{\alpha\rho_s(1-\varepsilon)}"
    ),
    typical={
        "area": (0.1, 2.0),
        "filtrate_volume": (0.01, 0.2),
        "cake_resistance": (1e9, 1e11),
        "consistency": (0.01, 1.0),
        "flow_index": (0.4, 1.0),
    },
)
def filtration_time_power_law(
    filtrate_volume: Volume,
    area: Area,
    pressure_drop: PressureDrop,
    consistency: DynamicViscosity,
    flow_index: FlowIndex,
    cake_resistance: CakeResistance,
    dry_cake_per_filtrate: Concentration,
    void_fraction: VoidFraction,
    solid_density: Density,
    medium_resistance: MediumResistance = 0.0,
    reference_shear_rate: ShearRate = 1.0,
) -> Time:
    """Time to collect a volume of filtrate that is a power-law liquid at constant pressure.

    The cake resistance is the one measured with a liquid of Newton; the pores of the medium count as those of
    the cake. Without a medium the time grows with the volume to the power 1 + 1/n. The structure is that of
    Shirato and of Kozicki, the viscosity in the cake that of Christopher and Middleman; sources not opened,
    derived anew.

    >>> water = {"cake_resistance": 1e10, "dry_cake_per_filtrate": 100.0, "void_fraction": 0.5}
    >>> round(filtration_time_power_law(0.05, 1.0, "1 bar", "1 cP", 1.0, solid_density=2700.0, **water), 6)
    12.5
    """
    n = flow_index
    deposit = cake_resistance * dry_cake_per_filtrate * filtrate_volume / area
    through = deposit + medium_resistance
    permeability = cake_permeability.function(cake_resistance, void_fraction, solid_density)
    at_one = dynamic_viscosity_permeable_christopher_middleman.function(
        1.0, permeability, void_fraction, consistency, n, reference_shear_rate
    )
    begun = deposit > 0.0
    last = jnp.exp((jnp.log(pressure_drop / at_one) - jnp.log(jnp.where(begun, through, 1.0))) / n)
    share = jnp.where(begun, deposit / jnp.where(begun, through, 1.0), 0.5)
    alone = share >= 1.0
    first = jnp.where(alone, -1.0, jnp.expm1((1.0 + 1.0 / n) * jnp.log1p(-jnp.where(alone, 0.5, share))))
    return jnp.where(begun, -n / (n + 1.0) * first * filtrate_volume / (area * share * last), 0.0)
