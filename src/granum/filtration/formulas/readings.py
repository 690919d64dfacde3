"""Cake and medium by hand from readings of a test: exactly from two, by the least squares line from more."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible, limit_active
from granum.core.kinds import (
    Area,
    CakeResistance,
    Concentration,
    DynamicViscosity,
    PressureDrop,
    Series,
    Time,
    Volume,
    VolumeFlow,
)
from granum.filtration.formulas.constant_pressure import Ruth
from granum.filtration.kinds import FittedMediumResistance, RuthConstant

_SMALL = {
    "time": (60.0, 600.0),
    "filtrate_volume": (1e-3, 1e-2),
    "area": (0.01, 0.1),
    "pressure_drop": (1e4, 1e5),
}


NO_CAKE = (
    "The readings do not lie on a rising line: at least two different ones are needed, of a cake that grows."
)
BELOW_ZERO = (
    "The line through the readings meets the axis below zero, as if the medium had a negative resistance: "
    "scatter, or settling beside filtration."
)


def _line(x: Any, y: Any) -> tuple[Any, Any]:
    """Slope and intercept; without a slope upwards there is no cake to speak of."""
    u, v = jnp.asarray(x), jnp.asarray(y)
    away = u - jnp.mean(u)
    spread = jnp.sum(away**2)
    slope = jnp.sum(away * v) / jnp.where(spread > 0, spread, jnp.nan)
    impossible(~(slope > 0), slope, "time", reason=NO_CAKE)
    slope = jnp.where(slope > 0, slope, jnp.nan)
    level = jnp.mean(v) - slope * jnp.mean(u)
    limit_active(level < 0, level, "medium_resistance", BELOW_ZERO)
    return slope, level


class Resistances(NamedTuple):
    """Of a cake per mass of solids and area, and of its medium."""

    cake_resistance: CakeResistance
    medium_resistance: FittedMediumResistance


@formula(
    source="ruth1935; geankoplis2003, § 14.2",
    typical=_SMALL,
    title="Ruth's constants from readings",
    equation=r"\frac{t}{V} = \frac{V}{a} + \frac{2V_0}{a},\quad t_0 = \frac{V_0^2}{a}",
)
def ruth_constants_readings(
    time: Annotated[Time, Series("points")], filtrate_volume: Annotated[Volume, Series("points")]
) -> Ruth:
    """Constants of Ruth's equation (V + V₀)² = a (t + t₀) from readings at constant pressure: exact from two,
    fitted from more.

    >>> a, V0, t0 = ruth_constants_readings("3 12 min", "5.21 17.84 L")
    >>> [round(V * (V + 2 * V0) / a) for V in (5.21e-3, 17.84e-3)]
    [180, 720]
    """
    V = jnp.asarray(filtrate_volume)
    slope, level = _line(V, jnp.asarray(time) / V)
    return Ruth(1.0 / slope, level / (2.0 * slope), level**2 / (4.0 * slope))


@formula(
    source="ruth1935",
    typical={"filtrate_volume": (0.01, 0.1), "ruth_constant": (1e-6, 1e-4)},
    equation=r"t = \frac{V^2 + 2VV_0}{a}",
)
def filtration_time_ruth(
    filtrate_volume: Volume, ruth_constant: RuthConstant, ruth_volume: Volume = 0.0
) -> Time:
    """Time to collect a volume of filtrate at constant pressure, from the constants of Ruth's equation.

    >>> round(filtration_time_ruth(filtrate_volume="10 L", ruth_constant=1e-6, ruth_volume="2 L"), 9)
    140.0
    """
    return filtrate_volume * (filtrate_volume + 2.0 * ruth_volume) / ruth_constant


@formula(
    source="ruth1935; geankoplis2003, § 14.2",
    typical=_SMALL,
    title="Resistances from readings at constant pressure",
    equation=(
        r"\alpha = \frac{2\,\Delta p\,A^2}{\eta\,W}\,a,\quad R_s = \frac{\Delta p\,A}{\eta}\,b,\quad "
        r"\frac{t}{V} = a\,V + b"
    ),
)
def resistances_constant_pressure(
    time: Annotated[Time, Series("points")],
    filtrate_volume: Annotated[Volume, Series("points")],
    area: Area,
    pressure_drop: PressureDrop,
    dynamic_viscosity: DynamicViscosity,
    dry_cake_per_filtrate: Concentration,
) -> Resistances:
    """Cake and medium resistance from readings of time and filtrate at constant pressure: exact from two,
    fitted from more.

    >>> alpha, medium = resistances_constant_pressure(
    ...     time="200 1000 s",
    ...     filtrate_volume="10 30 L",
    ...     area=0.1,
    ...     pressure_drop="1 bar",
    ...     dynamic_viscosity=1e-3,
    ...     dry_cake_per_filtrate=20,
    ... )
    >>> round(float(alpha) / 1e10, 6), round(float(medium) / 1e11, 6)
    (6.666667, 1.333333)
    """
    V = jnp.asarray(filtrate_volume)
    slope, level = _line(V, jnp.asarray(time) / V)
    drive = pressure_drop / dynamic_viscosity
    return Resistances(2.0 * slope * drive * area**2 / dry_cake_per_filtrate, level * drive * area)


@formula(
    source="carman1938; tiller1955",
    title="Resistances from readings at constant rate",
    typical={
        "time": (60.0, 600.0),
        "pressure_drop": (1e4, 1e5),
        "filtrate_flow": (1e-5, 1e-4),
        "area": (0.5, 2.0),
    },
    equation=(
        r"\alpha = \frac{A^2}{\eta\,W\,q^2}\,a,\quad R_s = \frac{A}{\eta\,q}\,b,\quad \Delta p = a\,t + "
        r"b"
    ),
)
def resistances_constant_rate(
    time: Annotated[Time, Series("points")],
    pressure_drop: Annotated[PressureDrop, Series("points")],
    filtrate_flow: VolumeFlow,
    area: Area,
    dynamic_viscosity: DynamicViscosity,
    dry_cake_per_filtrate: Concentration,
) -> Resistances:
    """Cake and medium resistance from readings of time and pressure drop at constant rate: exact from two,
    fitted from more.

    >>> alpha, medium = resistances_constant_rate(
    ...     "3 8 min",
    ...     "5340 9310 Pa",
    ...     filtrate_flow="240 mL/s",
    ...     area=1,
    ...     dynamic_viscosity="1 cP",
    ...     dry_cake_per_filtrate=10,
    ... )
    >>> round(float(alpha) / 1e10, 4), round(float(medium) / 1e10, 4)
    (2.2975, 1.2325)
    """
    slope, level = _line(time, pressure_drop)
    u = filtrate_flow / area
    return Resistances(
        slope / (dynamic_viscosity * dry_cake_per_filtrate * u**2), level / (dynamic_viscosity * u)
    )
