"""Filtration at constant rate, and constant rate up to a pressure that is then held."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import (
    Area,
    CakeResistance,
    Concentration,
    Density,
    Distance,
    DynamicViscosity,
    MediumResistance,
    PressureDrop,
    Ratio,
    Time,
    VoidFraction,
    Volume,
    VolumeFlow,
    Within,
)

_SMALL = {
    "area": (0.5, 2.0),
    "filtrate_flow": (1e-5, 1e-4),
    "cake_resistance": (1e9, 1e10),
    "time": (10.0, 600.0),
}


@formula(
    source="carman1938; mccabe2005, ch. 29",
    title="Pressure drop at constant rate",
    equation=r"\Delta p = \frac{\eta\,\alpha\,W\,q^2}{A^2}\,t + \frac{\eta\,R_s}{A}\,q",
    typical=_SMALL,
)
def pressure_drop_constant_rate(
    time: Time,
    filtrate_flow: VolumeFlow,
    area: Area,
    dynamic_viscosity: DynamicViscosity,
    cake_resistance: CakeResistance,
    dry_cake_per_filtrate: Concentration,
    medium_resistance: MediumResistance = 0.0,
) -> PressureDrop:
    """Pressure drop after a time of filtration at constant rate, rigid cake.

    >>> round(
    ...     pressure_drop_constant_rate(
    ...         time=100,
    ...         filtrate_flow=1e-3,
    ...         area=1,
    ...         dynamic_viscosity=1e-3,
    ...         cake_resistance=1e10,
    ...         dry_cake_per_filtrate=10,
    ...         medium_resistance=1e10,
    ...     ),
    ...     6,
    ... )
    20000.0
    """
    u = filtrate_flow / area
    return dynamic_viscosity * u * (cake_resistance * dry_cake_per_filtrate * u * time + medium_resistance)


@formula(
    source="tiller1955",
    title="Pressure drop at constant rate, compressible cake",
    equation=(
        r"\Delta p - \frac{\eta R_s q}{A} = "
        r"\left(\frac{\eta\,\alpha_0\,W\,q^2\,t}{A^2\,p_0^{\,n}}\right)^{\frac{1}{1-n}}"
    ),
    typical={**_SMALL, "compressibility": (0.0, 0.7), "cake_resistance_reference": (1e6, 1e8)},
    symbols={"cake_resistance_reference": r"\alpha_0"},
)
def pressure_drop_constant_rate_compressible(
    time: Time,
    filtrate_flow: VolumeFlow,
    area: Area,
    dynamic_viscosity: DynamicViscosity,
    cake_resistance_reference: CakeResistance,
    compressibility: Annotated[Ratio, Within(0.0, 0.95)],
    dry_cake_per_filtrate: Concentration,
    medium_resistance: MediumResistance = 0.0,
    reference_pressure: PressureDrop = 1.0,
) -> PressureDrop:
    """Pressure drop after a time at constant rate, mean resistance of the cake a power of the pressure drop
    across it.

    >>> round(
    ...     pressure_drop_constant_rate_compressible(
    ...         time=100,
    ...         filtrate_flow=1e-3,
    ...         area=1,
    ...         dynamic_viscosity=1e-3,
    ...         cake_resistance_reference=1e8,
    ...         compressibility=0.5,
    ...         dry_cake_per_filtrate=10,
    ...     ),
    ...     6,
    ... )
    10000.0
    """
    u, n = filtrate_flow / area, compressibility
    rigid = dynamic_viscosity * cake_resistance_reference * dry_cake_per_filtrate * u**2 * time
    return (jnp.maximum(rigid, 1e-300) / reference_pressure**n) ** (
        1.0 / (1.0 - n)
    ) + dynamic_viscosity * u * medium_resistance


@formula(
    source="carman1938",
    title="Cake thickness at constant rate",
    equation=r"Z = \frac{1}{(1-\varepsilon)\rho_s}\left(\sqrt{\left(\frac{R_s}{2\alpha}\right)^2 + \frac{\Delta p\,W\,t}{\eta\,\alpha}} - \frac{R_s}{2\alpha}\right)",  # noqa: E501
    typical=_SMALL,
)
def cake_thickness_constant_rate(
    time: Time,
    pressure_drop: PressureDrop,
    dynamic_viscosity: DynamicViscosity,
    cake_resistance: CakeResistance,
    dry_cake_per_filtrate: Concentration,
    void_fraction: VoidFraction,
    solid_density: Density,
    medium_resistance: MediumResistance = 0.0,
) -> Distance:
    """Cake thickness when a filtration at constant rate has reached a pressure drop after a time.

    >>> round(cake_thickness_constant_rate(100, 10000, 1e-3, 1e10, 10, 0.5, 2000) * 1e3, 6)
    1.0
    """
    half = medium_resistance / (2.0 * cake_resistance)
    drive = pressure_drop * dry_cake_per_filtrate * time / (dynamic_viscosity * cake_resistance)
    mass = jnp.where(drive > 0, drive / (jnp.sqrt(jnp.where(drive > 0, half**2 + drive, 1.0)) + half), 0.0)
    return mass / ((1.0 - void_fraction) * solid_density)


@formula(
    source="geankoplis2003, § 14.2",
    title="Filtration time, constant rate then constant pressure",
    equation=(
        r"t = \frac{\eta\,\alpha\,W}{2\,\Delta p\,A^2}(V^2 + V_r^2) + \frac{\eta\,R_s}{\Delta "
        r"p\,A}V,\quad V_r = \frac{A}{\alpha W}\left(\frac{\Delta p\,A}{\eta\,q} - R_s\right)"
    ),
    typical={**_SMALL, "filtrate_volume": (0.1, 1.0), "filtrate_flow": (1e-3, 1e-2)},
)
def filtration_time_rate_then_pressure(
    filtrate_volume: Volume,
    filtrate_flow: VolumeFlow,
    area: Area,
    pressure_drop: PressureDrop,
    dynamic_viscosity: DynamicViscosity,
    cake_resistance: CakeResistance,
    dry_cake_per_filtrate: Concentration,
    medium_resistance: MediumResistance = 0.0,
) -> Time:
    """Time to collect a volume at constant rate until a pressure is reached, then at that pressure.

    While the volume is still below that at which the pressure is reached, the time is V/q.

    >>> round(filtration_time_rate_then_pressure(1.0, 1e-3, 1.0, 1e5, 1e-3, 1e10, 20), 6)
    1250.0
    """
    V, q, A, dp = filtrate_volume, filtrate_flow, area, pressure_drop
    alpha_W = cake_resistance * dry_cake_per_filtrate
    at_pressure = jnp.maximum(A / alpha_W * (dp * A / (dynamic_viscosity * q) - medium_resistance), 0.0)
    rest = (
        dynamic_viscosity
        / (dp * A)
        * (alpha_W * (V**2 - at_pressure**2) / (2.0 * A) + medium_resistance * (V - at_pressure))
    )
    return jnp.where(at_pressure >= V, V / q, at_pressure / q + rest)
