"""What machines usually take for what they do to a stream: electric power of pumps, fans, vacuum pumps and
stirrers with usual efficiencies, and the carrier of heat or cold that a temperature asks for.

A machine whose efficiency matters is drawn into the line as a unit of its own (``streams.fan``,
``streams.pump``).
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core.constants import GAS_CONSTANT, STANDARD_ATMOSPHERE
from granum.core.utilities import Utility
from granum.streams.formulas.drives import (
    mass_flow_leakage_hei,
    shaft_power_adiabatic,
    shaft_power_incompressible,
    shaft_power_isothermal,
)
from granum.streams.stirrers import agitation
from granum.streams.stream import Stream
from granum.streams.units import Utilities

HEURISTICS = "turton2018, ch. 11"
MOTOR, PUMP, FAN, VACUUM, COMPRESSOR = 0.9, 0.7, 0.65, 0.5, 0.75
AMBIENT = 298.15  # K, above which gas counts as heated
AIR_VISCOSITY = 1.8e-5  # Pa s
# K: saturated steam at 6, 11 and 42 bar, and what cools; ten or five kelvin apart from the process
STEAM = {"low_pressure_steam": 432.0, "medium_pressure_steam": 457.0, "high_pressure_steam": 526.0}
COLD = {"cooling_water": 303.15, "chilled_water": 278.15, "brine": 253.15, "deep_cold": 223.15}
HEAT_APPROACH, COLD_APPROACH = 10.0, 5.0
DUCT = "perry2008, ch. 12, the dryer only: five velocity heads at 15 m/s in ducts are our own estimate"
DUCT_HEADS, DUCT_SPEED = 5.0, 15.0

DRIVE: Utilities = {"electric_power_drive": Utility(HEURISTICS)}
FANNED: Utilities = {"electric_power_fan": Utility(HEURISTICS)}
PUMPED: Utilities = {"electric_power_pump": Utility(HEURISTICS)}
STIRRED: Utilities = {"electric_power_agitator": Utility("zwietering1958; mccabe2005, ch. 9")}
HEATED: Utilities = {
    **{f"heat_input_{name}": Utility("turton2018, ch. 8") for name in STEAM},
    "heat_input_fuel_gas": Utility("turton2018, ch. 8"),
}
COOLED: Utilities = {f"cooling_input_{name}": Utility("turton2018, ch. 8") for name in COLD}
HOT_GAS: Utilities = {"heat_input_hot_gas": Utility("keey1978", inlet="gas")}
VACUUM_KEPT: Utilities = {
    "electric_power_vacuum": Utility(
        "hei2000, the air that leaks in only: that no vapor comes with it is our own estimate"
    )
}
AREA: Utilities = {"area_installed": Utility(HEURISTICS)}


def driven(shaft_power: Any) -> Any:
    """Electric power of a motor that gives a shaft power, W."""
    return shaft_power / MOTOR


def pumped(volume_flow: Any, pressure_rise: Any) -> Any:
    """Electric power of a pump, W."""
    return driven(shaft_power_incompressible(volume_flow, pressure_rise, PUMP))


def fanned(volume_flow: Any, pressure_rise: Any) -> Any:
    """Electric power of a fan or blower, W: as if incompressible up to some kilopascals, adiabatic beyond."""
    outlet = STANDARD_ATMOSPHERE + jnp.maximum(pressure_rise, 0.0)
    return driven(shaft_power_adiabatic(volume_flow, STANDARD_ATMOSPHERE, outlet, FAN))


def evacuated(volume_flow: Any, pressure: Any) -> Any:
    """Electric power of a liquid-ring pump from a vacuum to the atmosphere, W; the volume is that of the
    vacuum.
    """
    inlet = jnp.clip(pressure, 1.0, STANDARD_ATMOSPHERE)
    return driven(shaft_power_isothermal(volume_flow, inlet, STANDARD_ATMOSPHERE, VACUUM))


def kept_empty(volume: Any, pressure: Any) -> Any:
    """Electric power of a pump that keeps a vacuum in a plant of a volume against the air that leaks in, W;
    the vapor that comes with that air is left out.
    """
    from granum.humid_gas.pairs import AIR_WATER  # what has no vacuum need not read it

    air = mass_flow_leakage_hei.function(volume, pressure) / AIR_WATER.gas_molar_mass
    drawn = air * GAS_CONSTANT * AMBIENT / jnp.maximum(pressure, 1.0)
    return evacuated(drawn, pressure)


def compressed(volume_flow: Any, pressure: Any) -> Any:
    """Electric power of a compressor from the atmosphere to a pressure, W; the volume is that of the
    atmosphere.
    """
    outlet = jnp.maximum(pressure, STANDARD_ATMOSPHERE)
    return driven(shaft_power_adiabatic(volume_flow, STANDARD_ATMOSPHERE, outlet, COMPRESSOR))


def ducted(gas: Stream, more: Any = 0.0) -> Any:
    """Electric power of the fan that drives a gas through ducts, heater and a pressure drop besides, W."""
    lost = DUCT_HEADS * 0.5 * gas.gas_density * DUCT_SPEED**2
    return fanned(gas.gas_volume_flow, lost + more)


def suspended(slurry: Stream, volume: Any) -> Any:
    """Electric power of pitched blades that just keep the solid of a slurry off the bottom of upright vessels
    as high as wide, W; nothing without solid, and not told (``None``) where the viscosity of the liquid is
    unknown, which only this asks for.
    """
    made = agitation(slurry, volume)
    return driven(made.power) if made.known else None


def heated(duty: Any, temperature: Any) -> dict[str, Any]:
    """Heat by the mildest steam that is ten kelvin hotter than a process temperature, else by fuel gas, W."""
    given, left, found = jnp.maximum(duty, 0.0), jnp.asarray(True), {}
    for name, hot in STEAM.items():
        here = left & (temperature <= hot - HEAT_APPROACH)
        found[f"heat_input_{name}"] = jnp.where(here, given, 0.0)
        left = left & ~here
    return found | {"heat_input_fuel_gas": jnp.where(left, given, 0.0)}


def cooled(duty: Any, temperature: Any) -> dict[str, Any]:
    """Cold by the warmest carrier that is five kelvin colder than a process temperature, W; the duty is
    negative where heat is taken away.
    """
    taken, left, found = jnp.maximum(-duty, 0.0), jnp.asarray(True), {}
    for name, cold in COLD.items():
        here = left & ((temperature >= cold + COLD_APPROACH) | (name == "deep_cold"))
        found[f"cooling_input_{name}"] = jnp.where(here, taken, 0.0)
        left = left & ~here
    return found


def warmth(gas: Stream) -> dict[str, Any]:
    """Heat that a gas brings above the surroundings."""
    dry = gas.part(gas=1.0)
    brought = dry.enthalpy_flow - dry.enthalpy_at(AMBIENT)
    return {"heat_input_hot_gas": jnp.maximum(brought, 0.0)}
