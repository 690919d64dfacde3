"""Infrared and microwave help: a wet surface that takes heat besides that of the gas."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, unconverged
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.kinds import (
    Area,
    Fraction,
    HeatFlux,
    HeatTransferCoefficient,
    HumidityRatio,
    Length,
    Power,
    Pressure,
    SignedMassFlux,
    Temperature,
)
from granum.humid_gas.pairs import AIR_WATER, AbstractPair
from granum.materials.formulas.steam import water_heat_of_vaporization
from granum.numerics import Root, find_root

COLDEST_WATER, COLDEST = 275.0, 200.0  # K


class AssistedDrying(NamedTuple):
    """A wet surface with help."""

    surface_temperature: Temperature
    drying_rate_constant: SignedMassFlux


@formula(
    source="treybal1980, ch. 12; dutta2007; iapwsif97",
    fitted={"surface_temperature": (273.15, 623.15)},
    equation=r"h\,(T-T_s) + q_r + \varepsilon\sigma(T_r^4 - T_s^4) = \frac{h}{c_h}\,L_v\,(w_s - w)",
    typical={
        "temperature": (320.0, 380.0),
        "humidity_ratio": (0.005, 0.03),
        "heat_transfer_coefficient": (15.0, 60.0),
        "radiated_heat": (500.0, 5000.0),
        "radiator_temperature": (330.0, 600.0),
        "emissivity": (0.5, 0.9),
    },
    title="Constant drying rate with infrared or microwave heat",
    output="drying_rate_constant",
)
def drying_rate_assisted(
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    heat_transfer_coefficient: HeatTransferCoefficient,
    radiated_heat: HeatFlux = 0.0,
    radiator_temperature: Temperature = 293.15,
    emissivity: Fraction = 0.0,
    pressure: Pressure = STANDARD_ATMOSPHERE,
) -> AssistedDrying:
    """Temperature and evaporation flux of a wet surface that gets infrared or microwave heat besides that of
    the air.

    The surface lies above the wet bulb, and above the air when the help is strong. ``radiated_heat`` is
    absorbed heat per drying area (microwaves: power per volume times thickness); a radiator is given by its
    temperature and the emissivity of the pair. Air over water.

    Without help it is at the wet bulb: 41.5 °C and 1.41 g/(m² s) in air at 120 °C and 0.02 (Dutta's example,
    43.3 W/(m² K)).

    The latent heat is that of water from 0 to 350 °C.

    >>> plain = drying_rate_assisted("120 degC", 0.02, 43.3)
    >>> round(plain.surface_temperature - 273.15), round(plain.drying_rate_constant * 1e3, 2)
    (42, 1.41)
    """
    T, w, P, h = temperature, humidity_ratio, pressure, heat_transfer_coefficient

    def given(Ts: Any) -> Any:
        return h * (T - Ts) + radiated_heat + emissivity * 5.670374419e-8 * (radiator_temperature**4 - Ts**4)

    root = wet_surface(
        given, T, w, h / (1006.0 + 1860.0 * w), P, AIR_WATER, water_heat_of_vaporization.function
    )
    unconverged(root.converged)
    Ts = root.value
    return AssistedDrying(Ts, given(Ts) / water_heat_of_vaporization.function(Ts))


def wet_surface(
    given: Callable[[Any], Any],
    T: Any,
    w: Any,
    transfer: Any,
    P: Any,
    pair: AbstractPair,
    latent: Callable[[Any], Any],
) -> Root:
    """Temperature of a surface wet with the liquid of a pair, where the heat ``given`` to it (W/m²)
    evaporates it; ``transfer`` is the mass transfer coefficient on the difference of humidity ratios, kg/(m²
    s).
    """

    def need(Ts: Any) -> Any:
        y = jnp.minimum(pair.saturated_fraction(Ts, P, False), 1.0 - 1e-9)
        return transfer * latent(Ts) * (pair.humidity_ratio(y) - w)

    top = pair.boiling_temperature(P) * (1.0 - 1e-7)
    low = jnp.minimum(COLDEST_WATER if pair is AIR_WATER else COLDEST, top - 1.0)
    return find_root(
        lambda Ts: need(Ts) - given(Ts), low, top, start=jnp.minimum(T, top) - 20.0, tolerance=1e-13
    )


@formula(
    source="metaxas1983",
    equation=r"q_r = \frac{\eta\,P}{A}\left(1 - e^{-L/D_p}\right)",
    typical={
        "shaft_power": (500.0, 5000.0),
        "area": (0.2, 2.0),
        "thickness": (5e-3, 5e-2),
        "penetration_depth": (5e-3, 3e-2),
    },
    title="Microwave heat in a layer",
    output="radiated_heat",
)
def radiated_heat_microwave(
    shaft_power: Power,
    area: Area,
    thickness: Length,
    penetration_depth: Length,
    microwave_efficiency: Fraction = 0.6,
) -> HeatFlux:
    """Heat per area that a layer takes from microwaves which fall on one side: Lambert's law, and the
    efficiency of the generator.

    By hand, one penetration depth takes 1 − 1/e = 63.2 %.

    >>> round(radiated_heat_microwave(1000.0, 1.0, "10 mm", "10 mm", 0.6))
    379
    """
    return microwave_efficiency * shaft_power / area * -jnp.expm1(-thickness / penetration_depth)
