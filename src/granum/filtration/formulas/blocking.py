"""Filtration at constant pressure through a membrane that blocks: Hermia's four laws, written with one time
constant.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import Time, Volume, VolumeFlow, Within

BlockingLaw = Literal["complete", "standard", "intermediate", "cake"]
LAWS: tuple[BlockingLaw, ...] = ("complete", "standard", "intermediate", "cake")
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
