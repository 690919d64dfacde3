"""Filtration through a membrane or cartridge that blocks by Hermia's four laws: at constant pressure, written
with one time constant; at constant flow, with the dirt that a pressure drop lets it hold.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import Mass, Pressure, PressureDrop, Time, Volume, VolumeFlow, Within

BlockingLaw = Literal["complete", "standard", "intermediate", "cake"]
LAWS: tuple[BlockingLaw, ...] = ("complete", "standard", "intermediate", "cake")
EXPONENTS = {"complete": 2.0, "standard": 1.5, "intermediate": 1.0, "cake": 0.0}
BlockingTime = Annotated[Time, Within(1e-9)]
_TYPICAL = {
    "time": (30.0, 3600.0),
    "blocking_time": (60.0, 3600.0),
    "filtrate_flow_initial": (1e-8, 1e-4),
}


@formula(
    source="hermia1982",
    equation=(
        r"V = q_0\,\tau\,f,\qquad f = 1 - e^{-t/\tau},\quad \frac{t/\tau}{1 + t/\tau},\quad "
        r"\ln\left(1 + \frac{t}{\tau}\right),\quad 2\left(\sqrt{1 + \frac{t}{\tau}} - 1\right)"
    ),
    output="filtrate_volume",
    title="Filtrate of a membrane that blocks",
    typical=_TYPICAL,
    symbols={"filtrate_flow_initial": "q_0"},
)
def filtrate_volume_blocking(
    time: Time,
    filtrate_flow_initial: VolumeFlow,
    blocking_time: BlockingTime,
    blocking_law: BlockingLaw = "intermediate",
) -> Volume:
    """Filtrate after a time at constant pressure while pores are sealed (complete), narrow inside (standard),
    are sealed or overlaid (intermediate), or while a cake grows: d²t/dV² = k (dt/dV)ⁿ with n of 2, 1.5, 1, 0.

    The flow has fallen after one blocking time to about a third, a quarter, a half and seven tenths of the
    first. By hand, a cake after three blocking times: 2 (√4 − 1).

    >>> filtrate_volume_blocking(time=3.0, filtrate_flow_initial=1.0, blocking_time=1.0, blocking_law="cake")
    2.0
    """
    x = time / blocking_time
    shapes: dict[str, Any] = {
        "complete": -jnp.expm1(-x),
        "standard": x / (1.0 + x),
        "intermediate": jnp.log1p(x),
        "cake": 2.0 * x / (jnp.sqrt(1.0 + x) + 1.0),
    }
    return filtrate_flow_initial * blocking_time * shapes[blocking_law]


def blocked(resistance_ratio: Any, exponent: float) -> Any:
    """What is held while the resistance grows in this ratio, by dR/dm = Rⁿ from R = 1."""
    r = jnp.maximum(resistance_ratio, 1.0)
    return jnp.log(r) if exponent == 1.0 else (r ** (1.0 - exponent) - 1.0) / (1.0 - exponent)


@formula(
    source="hermia1982; hlavacek1993",
    equation=(
        r"m = m_0\,\frac{v(\Delta p_e/\Delta p_0)}{v(\Delta p_m/\Delta p_r)},\qquad "
        r"v(r) = \int_1^r \frac{dr}{r^n},\quad n = 2,\ \tfrac{3}{2},\ 1,\ 0"
    ),
    title="Dirt held by a filter that blocks",
    family="dirt_held",
    typical={
        "pressure_drop_clean": (5e3, 3e4),
        "pressure_drop_change": (1e5, 2.5e5),
        "dirt_capacity": (0.01, 0.2),
        "pressure_drop_rated": (5e3, 3e4),
        "pressure_drop_capacity": (1e5, 2.5e5),
    },
)
def dirt_held_blocking(
    pressure_drop_clean: Pressure,
    pressure_drop_change: PressureDrop,
    dirt_capacity: Mass,
    pressure_drop_rated: PressureDrop,
    pressure_drop_capacity: PressureDrop,
    blocking_law: BlockingLaw = "intermediate",
) -> Mass:
    """Dirt that a filter holds at constant flow until its pressure drop calls for a new one, from the
    capacity that its maker measured at another flow.

    Each of Hermia's laws says how the resistance grows with what is held, whatever the flow: dR/dm in
    proportion to the power n of R, 2 when pores are sealed, 1.5 when they narrow, 1 between, 0 when a cake
    grows. The capacity is that from the rated clean pressure drop up to a stated one; nothing is held where
    the clean filter takes the last pressure drop already. The source was not opened; derived anew.

    By hand, a cake at twice the clean pressure drop: (10/2 − 1)/(10 − 1) of the capacity.

    >>> round(dirt_held_blocking("20 kPa", "1 bar", "90 g", "10 kPa", "1 bar", blocking_law="cake"), 6)
    0.04
    """
    n = EXPONENTS[blocking_law]
    able = pressure_drop_capacity > pressure_drop_rated
    impossible(~able, pressure_drop_capacity, "pressure_drop_capacity", pressure_drop_rated, jnp.inf)
    whole = blocked(jnp.where(able, pressure_drop_capacity / pressure_drop_rated, jnp.nan), n)
    clean = jnp.maximum(pressure_drop_clean, 1e-9 * pressure_drop_change)
    return dirt_capacity * blocked(pressure_drop_change / clean, n) / whole
