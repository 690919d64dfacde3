"""Energy indices of a dryer, as the course notes define them."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import ZERO_CELSIUS
from granum.core.kinds import (
    HumidityRatio,
    MassFlow,
    Power,
    Ratio,
    SpecificEnergy,
    SpecificMoistureExtraction,
    Temperature,
)

_NOTES = "bonazzi2003; vasseur2009"
_AIR = {
    "humidity_ratio_fresh": (0.005, 0.01),
    "humidity_ratio_outlet": (0.015, 0.02),
    "humidity_ratio_equilibrium": (0.022, 0.03),
    "enthalpy_fresh": (3e4, 5e4),
    "enthalpy_inlet": (7e4, 9e4),
    "dry_gas_flow": (0.5, 5.0),
}

DAMP_AIR = "Fresh air as humid as this takes no water from the product."


def _check_equilibrium(fresh: Any, equilibrium: Any) -> None:
    impossible(~(equilibrium > fresh), equilibrium, "humidity_ratio_equilibrium", fresh, jnp.inf, DAMP_AIR)


@formula(
    source=_NOTES,
    equation=r"\eta_m = \frac{w_2 - w_a}{w_{2e} - w_a}",
    typical=_AIR,
    title="Mass efficiency of a dryer",
    symbols={
        "humidity_ratio_fresh": "w_a",
        "humidity_ratio_outlet": "w_2",
        "humidity_ratio_equilibrium": "w_{2e}",
    },
)
def mass_efficiency(
    humidity_ratio_fresh: HumidityRatio,
    humidity_ratio_outlet: HumidityRatio,
    humidity_ratio_equilibrium: HumidityRatio,
) -> Ratio:
    """Water that the air takes up over what it would take up if it left in equilibrium with the product.

    The notes' maize (D III.4): fresh air at 9.9 g/kg, equilibrium at 20.1; air that leaves at 15 g/kg has
    used half.

    >>> round(mass_efficiency("9.9 g/kg", "15 g/kg", "20.1 g/kg"), 2)
    0.5
    """
    _check_equilibrium(humidity_ratio_fresh, humidity_ratio_equilibrium)
    impossible(
        humidity_ratio_outlet < humidity_ratio_fresh,
        humidity_ratio_outlet,
        "humidity_ratio_outlet",
        humidity_ratio_fresh,
        jnp.inf,
    )
    return (humidity_ratio_outlet - humidity_ratio_fresh) / (
        humidity_ratio_equilibrium - humidity_ratio_fresh
    )


@formula(
    source=_NOTES,
    equation=r"\mathrm{CEM} = \frac{h_1 - h_a}{w_2 - w_a}",
    typical=_AIR,
    title="Energy per mass of water evaporated (CEM)",
    symbols={
        "enthalpy_fresh": "h_a",
        "enthalpy_inlet": "h_1",
        "humidity_ratio_fresh": "w_a",
        "humidity_ratio_outlet": "w_2",
    },
)
def energy_per_water(
    enthalpy_fresh: SpecificEnergy,
    enthalpy_inlet: SpecificEnergy,
    humidity_ratio_fresh: HumidityRatio,
    humidity_ratio_outlet: HumidityRatio,
) -> SpecificEnergy:
    """Heat given to the air for each kilogram of water that it takes from the product.

    The notes' maize (D III.4): 50 to 76 kJ/kg and 9.9 to 20.1 g/kg, that is 26/0.0102 kJ/kg.

    >>> round(energy_per_water("50 kJ/kg", "76 kJ/kg", "9.9 g/kg", "20.1 g/kg") / 1e3)
    2549
    """
    return (enthalpy_inlet - enthalpy_fresh) / (humidity_ratio_outlet - humidity_ratio_fresh)


def latent_heat(temperature: Any) -> Any:
    """Heat of vaporization by the notes' line, J/kg, 0 to 180 °C."""
    return 2501e3 - 2650.0 * (temperature - ZERO_CELSIUS)


@formula(
    source=_NOTES,
    equation=(
        r"\mathrm{RCE} = \frac{\mathrm{CEM}}{L_v(\theta)},\quad L_v = 2501 - " r"2.65\,\theta\ \mathrm{kJ/kg}"
    ),
    fitted={"temperature": (ZERO_CELSIUS, 453.15)},
    typical={"energy_per_water": (2.4e6, 6.5e6), "temperature": (295.0, 360.0)},
    title="Energy consumption ratio (RCE)",
    symbols={"temperature": r"\theta"},
)
def energy_consumption_ratio(energy_per_water: SpecificEnergy, temperature: Temperature) -> Ratio:
    """Energy spent per kilogram of water over its heat of vaporization at the temperature of drying.

    The notes' table III.2 gives 1.5 to 3 for entrainment dryers without recovery (3 300 to 6 500 kJ/kg).

    The notes take 2 435 kJ/kg at 25.1 °C: 4 870 kJ/kg would be 2.0.

    >>> round(energy_consumption_ratio("4870 kJ/kg", "25.1 degC"), 3)
    2.0
    """
    impossible(energy_per_water < 0.0, energy_per_water, "energy_per_water", 0.0, jnp.inf)
    return energy_per_water / latent_heat(temperature)


@formula(
    source=_NOTES,
    equation=r"\mathrm{PE} = G\,(w_{2e} - w_a)",
    typical=_AIR,
    title="Evaporative capacity (PE)",
    symbols={"humidity_ratio_fresh": "w_a", "humidity_ratio_equilibrium": "w_{2e}"},
)
def evaporative_capacity(
    dry_gas_flow: MassFlow, humidity_ratio_fresh: HumidityRatio, humidity_ratio_equilibrium: HumidityRatio
) -> MassFlow:
    """Water that a flow of air could evaporate if it left in equilibrium with the product; times the mass
    efficiency it is what it does.

    The notes' maize (D III.4): 2 284 kg of dry air from 9.9 to 20.1 g/kg take 23.3 kg.

    >>> round(evaporative_capacity(2284.0, "9.9 g/kg", "20.1 g/kg"), 1)
    23.3
    """
    _check_equilibrium(humidity_ratio_fresh, humidity_ratio_equilibrium)
    return dry_gas_flow * (humidity_ratio_equilibrium - humidity_ratio_fresh)


@formula(
    source="treybal1980, ch. 12; " + _NOTES,
    equation=r"G = \frac{\dot m_e}{w_2 - w_1}",
    output="dry_gas_flow",
    typical=_AIR | {"evaporation_rate": (0.01, 0.1), "humidity_ratio_inlet": (0.005, 0.01)},
    title="Dry gas that carries off the water",
    symbols={"humidity_ratio_inlet": "w_1", "humidity_ratio_outlet": "w_2"},
)
def dry_gas_flow_evaporation(
    evaporation_rate: MassFlow, humidity_ratio_inlet: HumidityRatio, humidity_ratio_outlet: HumidityRatio
) -> MassFlow:
    """Flow of dry air (or other gas) that takes up an evaporation rate between two humidity ratios; the water
    balance alone.

    The inlet is that of the dryer, or the fresh air where a loop with recirculation is looked at from
    outside. No value where the gas does not gain water. The notes' maize (D III.4): 23.3 kg of water from
    9.9 to 20.1 g/kg take 2 284 kg of dry air.

    >>> round(dry_gas_flow_evaporation("23.3 kg/hour", "9.9 g/kg", "20.1 g/kg") * 3600)
    2284
    """
    gain = humidity_ratio_outlet - humidity_ratio_inlet
    impossible(~(gain > 0), humidity_ratio_outlet, "humidity_ratio_outlet", humidity_ratio_inlet, jnp.inf)
    return evaporation_rate / jnp.where(gain > 0, gain, jnp.nan)


@formula(
    source="mujumdar2014; keey1978",
    equation=r"\mathrm{SMER} = \frac{\dot m_e}{P}",
    typical={"evaporation_rate": (0.01, 0.1), "shaft_power": (1e4, 1e5)},
    title="Specific moisture extraction rate (SMER)",
)
def moisture_extraction_rate(evaporation_rate: MassFlow, shaft_power: Power) -> SpecificMoistureExtraction:
    """Water removed per energy bought, the usual figure of heat-pump dryers.

    By hand: 3.6 kg/h for 1 kW is 3.6 kg/kWh.

    >>> round(moisture_extraction_rate("3.6 kg/hour", "1 kW") * 3.6e6, 6)
    3.6
    """
    impossible(~(shaft_power > 0.0), shaft_power, "shaft_power", 0.0, jnp.inf)
    return evaporation_rate / jnp.where(shaft_power == 0, jnp.nan, shaft_power)


@formula(
    source=_NOTES,
    fitted={"temperature": (273.15, 453.15)},
    equation=r"\eta = \frac{\dot m_e\,L_v}{\dot Q} = \frac{L_v(T)}{\mathrm{CEM}}",
    typical={"energy_per_water": (2.6e6, 6.5e6), "temperature": (295.0, 360.0)},
    title="Thermal efficiency of a dryer",
)
def drying_efficiency(energy_per_water: SpecificEnergy, temperature: Temperature) -> Ratio:
    """Heat of vaporization over the energy spent: the inverse of the energy consumption ratio.

    The notes' heat of vaporization holds from 0 to 180 °C.

    >>> round(drying_efficiency("4870 kJ/kg", "25.1 degC"), 3)
    0.5
    """
    impossible(~(energy_per_water > 0.0), energy_per_water, "energy_per_water", 0.0, jnp.inf)
    return latent_heat(temperature) / energy_per_water
