"""What a correlation measured in air gives in steam, and dryers that steam is no gas for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax.numpy as jnp

from granum.drying.gas_solid.matter import slope
from granum.streams.equilibrium import HumidMixture
from granum.streams.mixture import AIR
from granum.streams.stream import Stream

MEASURED = 363.15  # K, of the air in which coefficients of dryers were measured


def is_steam(gas: Stream) -> Any:
    """Whether a gas is so nearly all vapor that it carries what evaporates itself."""
    humid = HumidMixture(gas.mixture)
    return humid.carrying(gas)[humid.vapor] > 0.0


def in_steam(of_flux: Callable[[Any], Any], flux: Any, gas: Stream) -> Any:
    """Heat transfer coefficient at a mass flux by a correlation for air, carried over to steam by the
    j-factor of Chilton and Colburn: j = C Re^(n−1) is that of any gas, n being the slope of the correlation,
    so that h/h₀ = (c/c₀) (Pr/Pr₀)^(−2/3) (μ/μ₀)^(1−n) at one flux; steam midway between its inlet and
    boiling, air as it was measured. For other gases as it stands.
    """
    h, rise = slope(of_flux, flux)
    measured = gas.mixture.materials.fluid(AIR)
    boiling = HumidMixture(gas.mixture).boiling_temperature(gas.pressure)
    film = gas.replace(temperature=0.5 * (gas.temperature + boiling))
    heat = film.gas_heat_capacity / measured.vapor_heat_capacity(MEASURED)
    viscosity = film.gas_viscosity / measured.vapor_viscosity(MEASURED)
    prandtl = heat * viscosity * measured.vapor_conductivity(MEASURED) / film.gas_conductivity
    ratio = heat * prandtl ** (-2.0 / 3.0) * viscosity ** (1.0 - rise * flux / h)
    return h * jnp.where(is_steam(gas), ratio, 1.0)
