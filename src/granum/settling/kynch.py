"""Settling curve of a uniform suspension by Kynch's theory: shock or fan reaching the interface, in closed
form on characteristics.
"""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp

from granum.numerics import find_root


def kynch_height(
    time: Any, settling: Any, initial_concentration: Any, initial_height: Any, inflection: Any, densest: Any
) -> Any:
    """Height of the interface above the bottom at given times, without compression.

    Parameters
    ----------
    settling: velocity against concentration; flux with at most one inflection.
    inflection: concentration where the settling flux turns from concave to convex (0 when convex throughout).
    densest: a concentration above every one that reaches the interface.

    From mass under the interface, the layer C that reaches it does so at ``t = C0 h0 / (−C² v'(C))``, at the
    height ``h = −f'(C) t``; the first of them follows the shock tangent from C0, or C0 itself past the
    inflection.
    """
    C0, h0, t = initial_concentration, initial_height, jnp.asarray(time, dtype=float)

    def velocity(C: Any) -> tuple[Any, Any]:
        return jax.jvp(settling, (C,), (jnp.ones_like(C),))

    def flux_slope(C: Any) -> Any:
        v, dv = velocity(C)
        return v + C * dv

    C0 = jnp.asarray(C0, dtype=float)
    low = jnp.maximum(C0, jnp.asarray(inflection, dtype=float))
    fall = settling(C0)

    def tangent(C: Any) -> Any:
        return flux_slope(C) * (C - C0) - (C * settling(C) - C0 * fall)

    shocked = inflection > C0
    touch = find_root(tangent, jnp.where(shocked, low, 0.5 * C0), jnp.where(shocked, densest, 0.9 * C0)).value
    first = jnp.where(shocked, jnp.nan_to_num(touch, nan=1.0), low)

    def arrival(C: Any) -> Any:
        return C0 * h0 / jnp.maximum(-(C**2) * velocity(C)[1], 1e-300)

    begins = arrival(first)
    late = t > begins
    asked = jnp.where(late, t, 2.0 * begins)
    layer = find_root(lambda C: jnp.log(arrival(C) / asked), first, densest).value
    layer = jnp.where(late, jnp.nan_to_num(layer, nan=1.0), 2.0 * first)
    fan = -flux_slope(layer) * t
    return jnp.where(late, fan, h0 - fall * t)
