"""Resistances from the two readings that a short filtration test leaves: a line with no scatter to judge."""

from __future__ import annotations

from typing import NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.flags import extrapolated
from granum.core.kinds import (
    Area,
    CakeResistance,
    Concentration,
    DynamicViscosity,
    MediumResistance,
    Number,
    PressureDrop,
    Time,
    Volume,
    VolumeFlow,
)

LATER = "The second reading must be the later one."
SLOWS = "Each volume takes more time as the cake grows: t/V must rise."
NO_MEDIUM = "The line through both readings meets zero below: the medium would help the flow."
APART = "The second pressure must differ from the first."
LOOSENS = "No cake lets more through the harder it is pressed: look at both readings."
RISES = "At constant rate the pressure rises as the cake grows."


class Resistances(NamedTuple):
    """Resistances of cake and medium."""

    cake_resistance: CakeResistance
    medium_resistance: MediumResistance


@formula(
    source="ruth1935; richardson2002, ch. 7",
    title="Resistances from two readings at constant pressure",
    equation=(
        r"\alpha = \frac{2\,\Delta p\,A^2}{\eta\,W}\,\frac{t_2/V_2 - t_1/V_1}{V_2 - V_1},\qquad R_s = "
        r"\frac{\Delta p\,A}{\eta}\left(\frac{t_1}{V_1} - \frac{\eta\,\alpha\,W}{2\,\Delta p\,A^2}V_1\right)"
    ),
    typical={
        "time_first": (140.0, 160.0),
        "time_second": (420.0, 450.0),
        "filtrate_volume_first": (2.45e-4, 2.55e-4),
        "filtrate_volume_second": (4.9e-4, 5.1e-4),
        "area": (0.02, 0.1),
    },
)
def resistances_two_volumes(
    time_first: Time,
    filtrate_volume_first: Volume,
    time_second: Time,
    filtrate_volume_second: Volume,
    area: Area,
    pressure_drop: PressureDrop,
    dynamic_viscosity: DynamicViscosity,
    dry_cake_per_filtrate: Concentration,
) -> Resistances:
    """Cake and medium resistance from two readings of filtrate and time at constant pressure.

    Both times count from the start of the filtration, both volumes are all the filtrate so far. Two readings
    lie on one line whatever they are: a leaf test of more readings tells how sure the resistances are. The
    example is that of Coulson and Richardson's example 7.1, who have 3.5 mm of cake for the cloth.

    >>> found = resistances_two_volumes(
    ...     "5 min", "250 cm3", "10 min", "400 cm3", "0.05 m2", "71.3 kPa", "1 mPa*s", 150
    ... )
    >>> round(found.cake_resistance / 1e12, 2), round(found.medium_resistance / 1e12, 2)
    (4.75, 2.5)
    """
    t1, V1, t2, V2 = time_first, filtrate_volume_first, time_second, filtrate_volume_second
    impossible(~(V1 < V2), V2, "filtrate_volume_second", V1, jnp.inf, LATER)
    impossible(~(t1 / V1 < t2 / V2), t2, "time_second", t1 * V2 / V1, jnp.inf, SLOWS)
    slope = (t2 / V2 - t1 / V1) / jnp.where(V1 < V2, V2 - V1, 1.0)
    intercept = t1 / V1 - slope * V1
    impossible(intercept < 0.0, t2, "time_second", t1 * V2 / V1, t1 * (V2 / V1) ** 2, NO_MEDIUM)
    per_pressure = pressure_drop * area / dynamic_viscosity
    return Resistances(2.0 * per_pressure * area / dry_cake_per_filtrate * slope, per_pressure * intercept)


@formula(
    source="carman1938; brasch1986, ch. 8",
    title="Resistances from two readings at constant rate",
    equation=(
        r"\alpha = \frac{A^2}{\eta\,W\,q^2}\,\frac{\Delta p_2 - \Delta p_1}{t_2 - t_1},\qquad R_s = "
        r"\frac{A}{\eta\,q}\,\frac{\Delta p_1\,t_2 - \Delta p_2\,t_1}{t_2 - t_1}"
    ),
    typical={
        "time_first": (100.0, 120.0),
        "time_second": (300.0, 400.0),
        "pressure_drop_first": (4e4, 5e4),
        "pressure_drop_second": (6e4, 8e4),
        "area": (0.5, 2.0),
        "filtrate_flow": (1e-5, 1e-4),
    },
)
def resistances_two_pressures(
    time_first: Time,
    pressure_drop_first: PressureDrop,
    time_second: Time,
    pressure_drop_second: PressureDrop,
    filtrate_flow: VolumeFlow,
    area: Area,
    dynamic_viscosity: DynamicViscosity,
    dry_cake_per_filtrate: Concentration,
) -> Resistances:
    """Cake and medium resistance from two readings of pressure and time at constant filtrate flow.

    The cake is rigid, and the times count from the start of the filtration. A test at constant rate of more
    readings tells how sure the resistances are.

    >>> found = resistances_two_pressures(
    ...     "3 min", "5.34 kPa", "8 min", "9.31 kPa", "0.24 L/s", "0.3 m2", "1 mPa*s", 20
    ... )
    >>> round(found.cake_resistance / 1e9, 2), round(found.medium_resistance / 1e9, 2)
    (1.03, 3.7)
    """
    t1, p1, t2, p2 = time_first, pressure_drop_first, time_second, pressure_drop_second
    impossible(~(t1 < t2), t2, "time_second", t1, jnp.inf, LATER)
    impossible(~(p1 < p2), p2, "pressure_drop_second", p1, jnp.inf, RISES)
    slope = (p2 - p1) / jnp.where(t1 < t2, t2 - t1, 1.0)
    intercept = p1 - slope * t1
    impossible(intercept < 0.0, p2, "pressure_drop_second", p1, p1 * t2 / t1, NO_MEDIUM)
    per_velocity = area / (dynamic_viscosity * filtrate_flow)
    return Resistances(
        per_velocity * area / (dry_cake_per_filtrate * filtrate_flow) * slope, per_velocity * intercept
    )


class Compressed(NamedTuple):
    """How the resistance of a cake grows with pressure."""

    compressibility: Number
    cake_resistance_reference: CakeResistance


@formula(
    source="ruth1935; mccabe2005, ch. 29",
    title="Compressibility from tests at two pressures",
    equation=(
        r"n = \frac{\ln(\alpha_2/\alpha_1)}{\ln(\Delta p_2/\Delta p_1)},\qquad "
        r"\alpha_0 = \alpha_1 \left(\frac{p_0}{\Delta p_1}\right)^n"
    ),
    typical={
        "cake_resistance_first": (1e10, 1e11),
        "cake_resistance_second": (2e11, 1e12),
        "pressure_drop_first": (4e4, 5e4),
        "pressure_drop_second": (6e4, 8e4),
    },
)
def compressibility_two_resistances(
    cake_resistance_first: CakeResistance,
    pressure_drop_first: PressureDrop,
    cake_resistance_second: CakeResistance,
    pressure_drop_second: PressureDrop,
    reference_pressure: PressureDrop = 1e5,
) -> Compressed:
    """Compressibility of a cake, and its resistance at the reference pressure, from resistances at two
    pressures.

    Two points lie on one power law whatever they are: tests at more pressures tell how sure it is. By hand:
    twice the resistance at four times the pressure is a compressibility of a half.

    >>> found = compressibility_two_resistances(1e11, "1 bar", 2e11, "4 bar")
    >>> round(found.compressibility, 6), round(found.cake_resistance_reference / 1e11, 6)
    (0.5, 1.0)
    """
    p1, p2 = pressure_drop_first, pressure_drop_second
    apart = p1 != p2
    impossible(~apart, p2, "pressure_drop_second", reason=APART)
    ratio = jnp.where(apart, jnp.log(p2 / p1), 1.0)
    n = jnp.where(apart, jnp.log(cake_resistance_second / cake_resistance_first) / ratio, jnp.nan)
    extrapolated(n < 0.0, n, "compressibility", 0.0, reason=LOOSENS)
    return Compressed(n, cake_resistance_first * (reference_pressure / p1) ** n)
