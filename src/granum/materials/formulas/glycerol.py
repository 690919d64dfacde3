"""Viscosity of glycerol and of its mixtures with water."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import ZERO_CELSIUS
from granum.core.kinds import DynamicViscosity, MassFraction, Temperature

_RANGE = {"temperature": (ZERO_CELSIUS, 373.15)}


@formula(
    source="cheng2008, eq. 22",
    title="Viscosity of glycerol",
    equation=r"\eta = 12.1\,\exp\frac{(-1233 + t)\,t}{9900 + 70 t},\quad t = T - 273.15",
    fitted=_RANGE,
    output="dynamic_viscosity",
)
def glycerol_viscosity(temperature: Temperature) -> DynamicViscosity:
    """Dynamic viscosity of glycerol without water.

    One percent of water takes a fifth off it.

    >>> round(glycerol_viscosity(temperature="20 degC"), 2)
    1.41
    """
    t = jnp.maximum(temperature - ZERO_CELSIUS, -120.0)
    return 12.1 * jnp.exp((-1233.0 + t) * t / (9900.0 + 70.0 * t))


@formula(
    source="cheng2008, eq. 6, 12 and 21–22",
    title="Viscosity of glycerol with water",
    equation=r"\eta = \eta_w^{\alpha}\,\eta_g^{1-\alpha},\quad"
    r" \alpha = 1 - x + \frac{a b\,x(1-x)}{a x + b(1-x)},\quad"
    r" a = a(T),\quad b = b(T)",
    fitted=_RANGE,
    output="dynamic_viscosity",
)
def dynamic_viscosity_glycerol_water(
    temperature: Temperature, solute_mass_fraction: MassFraction
) -> DynamicViscosity:
    """Dynamic viscosity of a mixture of glycerol and water, from its share of glycerol by mass.

    Within 5 % of three tables at most points.

    >>> round(1e3 * dynamic_viscosity_glycerol_water(temperature="20 degC", solute_mass_fraction=0.0), 2)
    1.0
    """
    t, C = temperature - ZERO_CELSIUS, solute_mass_fraction
    near = jnp.clip(t, -50.0, 400.0)
    a = 0.705 - 0.0017 * near
    b = (4.9 + 0.036 * near) * a**2.5
    alpha = 1.0 - C + a * b * C * (1.0 - C) / (a * C + b * (1.0 - C))
    water = 1.790e-3 * jnp.exp((-1230.0 - near) * near / (36100.0 + 360.0 * near))
    return water**alpha * glycerol_viscosity(temperature) ** (1.0 - alpha)
