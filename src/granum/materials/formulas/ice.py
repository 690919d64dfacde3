"""Ice: vapor pressure over it and pressure at which it melts (IAPWS 2011)."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import Pressure, Temperature

_TRIPLE_TEMPERATURE, _TRIPLE_PRESSURE = 273.16, 611.657


@formula(
    source="iapws2011melting, eq. 6",
    equation=r"\ln\frac{p_v}{p_t} = \theta^{-1}\sum_{i=1}^{3} a_i\theta^{b_i},\quad \theta = T/T_t",
    fitted={"temperature": (50.0, 273.16)},
    typical={"temperature": (200.0, 270.0)},
    output="vapor_pressure",
    title="Vapor pressure over ice (IAPWS 2011)",
)
def ice_vapor_pressure(temperature: Temperature) -> Pressure:
    """Sublimation pressure of ordinary ice: what drives freeze drying.

    >>> round(ice_vapor_pressure(temperature=230.0), 5)
    8.94735
    """
    theta = temperature / _TRIPLE_TEMPERATURE
    total = (
        -21.2144006 * theta**0.00333333333 + 27.3203819 * theta**1.20666667 - 6.10598130 * theta**1.70333333
    )
    return _TRIPLE_PRESSURE * jnp.exp(total / theta)


@formula(
    source="iapws2011melting, eq. 1",
    equation=r"p = p_t\left[1 + \sum_{i=1}^{3} a_i\left(1 - \theta^{b_i}\right)\right],\quad \theta = T/T_t",
    fitted={"temperature": (251.165, 273.16)},
    typical={"temperature": (255.0, 272.0)},
    output="pressure",
    title="Melting pressure of ice (IAPWS 2011)",
)
def ice_melting_pressure(temperature: Temperature) -> Pressure:
    """Pressure at which ordinary ice melts at a temperature below the triple point.

    >>> round(ice_melting_pressure(temperature=260.0) / 1e6, 3)
    138.268
    """
    theta = temperature / _TRIPLE_TEMPERATURE
    total = (
        0.119539337e7 * (1 - theta**3)
        + 0.808183159e5 * (1 - theta**25.75)
        + 0.333826860e4 * (1 - theta**103.75)
    )
    return _TRIPLE_PRESSURE * (1 + total)
