"""Cycles: the best moment to stop and clean a batch filter, for production or for cost, and the flow of a
drum.
"""

from __future__ import annotations

from typing import NamedTuple

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import (
    Area,
    CakeResistance,
    Concentration,
    DynamicViscosity,
    Fraction,
    Mass,
    MediumResistance,
    PositiveNumber,
    PressureDrop,
    Ratio,
    Time,
    Volume,
    VolumeFlow,
)
from granum.filtration.formulas.constant_pressure import filtrate_volume_constant_pressure, ruth_constants
from granum.filtration.kinds import RuthConstant


@formula(
    source="carman1938",
    equation=r"V = \sqrt{a\,t_{mort}}",
    output="filtrate_volume",
    title="Filtrate volume of the most productive cycle",
)
def filtrate_volume_optimum(
    ruth_constant: RuthConstant, dead_time: Time, dead_cost_ratio: PositiveNumber = 1.0
) -> Volume:
    """Filtrate volume at which to stop: most filtrate per time, or least cost per filtrate.

    Independent of the medium resistance. The cost ratio is (cost of the dead time + other costs per cycle)
    over what filtering costs in a time as long as the dead time; 1 gives the optimum of production.

    >>> round(filtrate_volume_optimum(ruth_constant=4e-4, dead_time=900), 6)
    0.6
    """
    return jnp.sqrt(ruth_constant * dead_time * dead_cost_ratio)


class Cycle(NamedTuple):
    """The most productive cycle of a batch filter."""

    filtrate_volume: Volume
    filtration_time: Time
    wash_time: Time
    cycle_time: Time
    mean_filtrate_flow: VolumeFlow
    dry_cake_mass: Mass


@formula(
    source="carman1938",
    equation=(
        r"V = \sqrt{\frac{a\,t_{mort}\,C}{1 + r}},\qquad \bar q = \frac{V}{t_{mort} + t + t_w},\qquad a "
        r"= \frac{2\,\Delta p\,A^2}{\eta\,\alpha\,W}"
    ),
    title="Best cycle of a batch filter",
    typical={"area": (1.0, 50.0)},
)
def filtration_cycle(
    area: Area,
    pressure_drop: PressureDrop,
    dynamic_viscosity: DynamicViscosity,
    cake_resistance: CakeResistance,
    dry_cake_per_filtrate: Concentration,
    dead_time: Time,
    medium_resistance: MediumResistance = 0.0,
    wash_time_ratio: Ratio = 0.0,
    dead_cost_ratio: PositiveNumber = 1.0,
) -> Cycle:
    """Best cycle of a batch filter at constant pressure: volume, times, mean flow and cake, for production or
    cost.

    Known as optimum cycle too. The wash time is ``wash_time_ratio`` times the part of the filtration time
    that the cake takes, which holds for a fixed wash ratio.

    >>> best = filtration_cycle(10, "3 bar", "1 cP", 1e11, 20, dead_time="20 min")
    >>> round(best.filtration_time, 6), round(best.filtrate_volume, 4)
    (1200.0, 6.0)
    """
    a, V0, _t0 = ruth_constants(
        area, pressure_drop, dynamic_viscosity, cake_resistance, dry_cake_per_filtrate, medium_resistance
    )
    V = jnp.sqrt(a * dead_time * dead_cost_ratio / (1.0 + wash_time_ratio))
    filtering = V**2 / a + 2.0 * V * V0 / a
    washing = wash_time_ratio * V**2 / a
    whole = dead_time + filtering + washing
    return Cycle(V, filtering, washing, whole, V / whole, dry_cake_per_filtrate * V)


@formula(
    source="tiller1958",
    equation=(
        r"\Delta p = p_m\left(1 - \frac{q^2}{q_m^2}\right),\quad t = \int_0^V \frac{dV}{q},\quad \Delta "
        r"p = \frac{\eta\,q}{A}\left(\frac{\alpha W V}{A} + R_s\right)"
    ),
    title="Filtration time with a centrifugal pump",
    output="filtration_time",
    typical={
        "filtrate_volume": (0.1, 2.0),
        "area": (1.0, 10.0),
        "cake_resistance": (1e10, 1e11),
        "volume_flow_largest": (1e-3, 1e-2),
    },
)
def filtration_time_pump(
    filtrate_volume: Volume,
    area: Area,
    pressure_shutoff: PressureDrop,
    volume_flow_largest: VolumeFlow,
    dynamic_viscosity: DynamicViscosity,
    cake_resistance: CakeResistance,
    dry_cake_per_filtrate: Concentration,
    medium_resistance: MediumResistance = 0.0,
) -> Time:
    """Time to collect a volume when a centrifugal pump with a parabolic curve feeds the filter, rigid cake.

    At each moment pump and cake agree on a flow; the integral over the volume is closed.

    >>> round(filtration_time_pump(1.0, 5.0, 3e5, 1e3, 1e-3, 1e11, 20), 3) == round(
    ...     1e-3 / 3e5 * 1e11 * 20 / 2 / 25, 3
    ... )
    True
    """
    pm, A = pressure_shutoff, area
    rise = dynamic_viscosity * cake_resistance * dry_cake_per_filtrate / A**2
    first = dynamic_viscosity * medium_resistance / A
    last = first + rise * filtrate_volume
    c = 2.0 * pm / volume_flow_largest

    def primitive(R):
        return 0.5 * R**2 + 0.5 * (R * jnp.sqrt(R**2 + c**2) + c**2 * jnp.arcsinh(R / c))

    return (primitive(last) - primitive(first)) / (2.0 * pm * rise)


@formula(
    source="geankoplis2003, § 14.2; mccabe2005, ch. 29",
    title="Filtrate flow of a drum",
    equation=(
        r"q = \frac{V(f\,t_c)}{t_c} \rightarrow A\sqrt{\frac{2\,f\,\Delta p}{t_c\,\eta\,\alpha\,W}}\ "
        r"(R_s = 0)"
    ),
    typical={"area": (1.0, 50.0), "cycle_time": (60.0, 600.0), "cake_resistance": (1e10, 1e12)},
)
def filtrate_flow_drum(
    area: Area,
    cycle_time: Time,
    submergence: Fraction,
    pressure_drop: PressureDrop,
    dynamic_viscosity: DynamicViscosity,
    cake_resistance: CakeResistance,
    dry_cake_per_filtrate: Concentration,
    medium_resistance: MediumResistance = 0.0,
) -> VolumeFlow:
    """Filtrate flow of a rotary drum or disc filter: cake forms on the submerged share of its whole area once
    in each turn.

    McCabe's drum of 81.7 ft² turning once in 5 min, 30 % submerged: 0.133 m³ of filtrate in a turn.

    >>> round(
    ...     300
    ...     * filtrate_flow_drum(
    ...         area="81.7 ft^2",
    ...         cycle_time="5 min",
    ...         submergence=0.3,
    ...         pressure_drop="1414 lbf/ft^2",
    ...         dynamic_viscosity="6.72e-4 lb/ft/s",
    ...         cake_resistance=1.2849e11,
    ...         dry_cake_per_filtrate="19.24 lb/ft^3",
    ...     ),
    ...     3,
    ... )
    0.133
    """
    volume = filtrate_volume_constant_pressure(
        submergence * cycle_time,
        area,
        pressure_drop,
        dynamic_viscosity,
        cake_resistance,
        dry_cake_per_filtrate,
        medium_resistance,
    )
    return volume / cycle_time
