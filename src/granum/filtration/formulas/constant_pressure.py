"""Filtration at constant pressure: time and volume, both ways, Ruth's form and its constants."""

from __future__ import annotations

from typing import NamedTuple

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import (
    Area,
    CakeResistance,
    Concentration,
    DynamicViscosity,
    MediumResistance,
    PositiveNumber,
    PressureDrop,
    Speed,
    Time,
    Volume,
    VolumeFlow,
)
from granum.filtration.kinds import FittedVolume, RuthConstant

_SMALL = {"area": (0.1, 2.0), "filtrate_volume": (0.01, 0.2), "cake_resistance": (1e9, 1e11)}


@formula(
    source="ruth1935; geankoplis2003, § 14.2",
    title="Filtration time at constant pressure",
    equation=r"t = \frac{\eta\,\alpha\,W}{2\,\Delta p\,A^2}V^2 + \frac{\eta\,R_s}{\Delta p\,A}V",
    typical=_SMALL,
)
def filtration_time_constant_pressure(
    filtrate_volume: Volume,
    area: Area,
    pressure_drop: PressureDrop,
    dynamic_viscosity: DynamicViscosity,
    cake_resistance: CakeResistance,
    dry_cake_per_filtrate: Concentration,
    medium_resistance: MediumResistance = 0.0,
) -> Time:
    """Time to collect a volume of filtrate at constant pressure.

    >>> round(
    ...     filtration_time_constant_pressure(
    ...         filtrate_volume=3.37,
    ...         area=17.46,
    ...         pressure_drop="338 kPa",
    ...         dynamic_viscosity=8.937e-4,
    ...         cake_resistance=1.863e11,
    ...         dry_cake_per_filtrate=23.47,
    ...         medium_resistance=10.63e10,
    ...     ),
    ...     0,
    ... )
    270.0
    """
    V, A, dp, eta, alpha, W, Rm = (
        filtrate_volume,
        area,
        pressure_drop,
        dynamic_viscosity,
        cake_resistance,
        dry_cake_per_filtrate,
        medium_resistance,
    )
    return eta / dp * (alpha * W / 2.0 * (V / A) ** 2 + Rm * V / A)


@formula(
    source="ruth1935",
    title="Filtrate volume at constant pressure",
    equation=(
        r"V = A\left(\sqrt{\left(\frac{R_s}{\alpha W}\right)^2 + \frac{2\,\Delta "
        r"p\,t}{\eta\,\alpha\,W}} - \frac{R_s}{\alpha W}\right)"
    ),
    typical={**_SMALL, "time": (10.0, 3600.0)},
)
def filtrate_volume_constant_pressure(
    time: Time,
    area: Area,
    pressure_drop: PressureDrop,
    dynamic_viscosity: DynamicViscosity,
    cake_resistance: CakeResistance,
    dry_cake_per_filtrate: Concentration,
    medium_resistance: MediumResistance = 0.0,
) -> Volume:
    """Filtrate collected in a time at constant pressure.

    >>> round(
    ...     filtrate_volume_constant_pressure(
    ...         time=300,
    ...         area=0.5,
    ...         pressure_drop="0.8 bar",
    ...         dynamic_viscosity=1.2e-3,
    ...         cake_resistance=1.07e8,
    ...         dry_cake_per_filtrate=15.3,
    ...     ),
    ...     1,
    ... )
    2.5
    """
    t, dp, eta, alpha, W, Rm = (
        time,
        pressure_drop,
        dynamic_viscosity,
        cake_resistance,
        dry_cake_per_filtrate,
        medium_resistance,
    )
    drive = 2.0 * dp * t / eta
    # (√(R² + x) − R)/(αW) written without cancellation
    root = jnp.sqrt(jnp.where(drive > 0, Rm**2 + alpha * W * drive, 1.0))
    return jnp.where(drive > 0, area * drive / (root + Rm), 0.0)


class Ruth(NamedTuple):
    """Constants of (V + V₀)² = a (t + t₀)."""

    ruth_constant: RuthConstant
    ruth_volume: FittedVolume
    ruth_time: Time


@formula(
    source="ruth1935",
    equation=(
        r"a = \frac{2\,\Delta p\,A^2}{\eta\,\alpha\,W},\quad V_0 = \frac{A R_s}{\alpha W},\quad t_0 = "
        r"\frac{\eta R_s^2}{2\,\Delta p\,\alpha\,W}"
    ),
    title="Ruth's constants",
)
def ruth_constants(
    area: Area,
    pressure_drop: PressureDrop,
    dynamic_viscosity: DynamicViscosity,
    cake_resistance: CakeResistance,
    dry_cake_per_filtrate: Concentration,
    medium_resistance: MediumResistance = 0.0,
) -> Ruth:
    """Constants of Ruth's equation (V + V₀)² = a (t + t₀), the medium being replaced by the cake that would
    resist as much.

    Differs from the print in the notes, which have t − t₀.

    >>> a, V0, t0 = ruth_constants(0.5, "0.8 bar", "1.2 cP", 1.07e8, 15.3, 1e9)
    >>> round(V0**2 / (a * t0), 12)
    1.0
    """
    alpha_W = cake_resistance * dry_cake_per_filtrate
    return Ruth(
        2.0 * pressure_drop * area**2 / (dynamic_viscosity * alpha_W),
        area * medium_resistance / alpha_W,
        dynamic_viscosity * medium_resistance**2 / (2.0 * pressure_drop * alpha_W),
    )


@formula(
    source="ruth1935",
    equation=r"u = \frac{\Delta p}{\eta\,(\alpha W V/A + R_s)}",
    typical=_SMALL,
)
def filtrate_flux(
    filtrate_volume: Volume,
    area: Area,
    pressure_drop: PressureDrop,
    dynamic_viscosity: DynamicViscosity,
    cake_resistance: CakeResistance,
    dry_cake_per_filtrate: Concentration,
    medium_resistance: MediumResistance = 0.0,
) -> Speed:
    """Filtrate flux through cake and medium at a moment, by Darcy's law.

    >>> round(
    ...     filtrate_flux(
    ...         filtrate_volume=0.01,
    ...         area=1,
    ...         pressure_drop=1e5,
    ...         dynamic_viscosity=1e-3,
    ...         cake_resistance=1e10,
    ...         dry_cake_per_filtrate=100,
    ...     )
    ...     * 1e3,
    ...     6,
    ... )
    10.0
    """
    through = cake_resistance * dry_cake_per_filtrate * filtrate_volume / area + medium_resistance
    return pressure_drop / (dynamic_viscosity * through)


@formula(
    source="geankoplis2003, § 14.2",
    title="Flow of wash liquid",
    equation=r"q = \frac{f\,A\,\Delta p}{\eta\,(\alpha W V/A + R_s)}",
    typical=_SMALL,
)
def filtrate_flow_washing(
    filtrate_volume: Volume,
    area: Area,
    pressure_drop: PressureDrop,
    dynamic_viscosity: DynamicViscosity,
    cake_resistance: CakeResistance,
    dry_cake_per_filtrate: Concentration,
    medium_resistance: MediumResistance = 0.0,
    wash_rate_ratio: PositiveNumber = 1.0,
) -> VolumeFlow:
    """Flow of wash liquor through a finished cake, against the final filtrate flow.

    The ratio is 1 where wash liquor takes the way of the filtrate (leaf, belt, drum), 1/4 in a
    plate-and-frame press, where it crosses two half cakes on half the area. The viscosity is that of the wash
    liquor.

    >>> round(
    ...     filtrate_flow_washing(
    ...         filtrate_volume=3.37,
    ...         area=17.46,
    ...         pressure_drop="338 kPa",
    ...         dynamic_viscosity=8.937e-4,
    ...         cake_resistance=1.863e11,
    ...         dry_cake_per_filtrate=23.47,
    ...         medium_resistance=10.63e10,
    ...         wash_rate_ratio=0.25,
    ...     )
    ...     * 1e3,
    ...     2,
    ... )
    1.74
    """
    through = cake_resistance * dry_cake_per_filtrate * filtrate_volume / area + medium_resistance
    return wash_rate_ratio * area * pressure_drop / (dynamic_viscosity * through)
