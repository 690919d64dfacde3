"""Kinds that only size reduction uses."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import Kind

EnergyPerSurface = Annotated[Any, Kind("energy per surface", "J/m^2", 0.0, display=("J/m^2", "kJ/m^2"))]
RittingerConstant = Annotated[
    Any, Kind("energy times length per mass", "J*m/kg", 0.0, display=("kJ*mm/kg", "J*m/kg"))
]
WorkIndex = Annotated[
    Any, Kind("work index", "J/kg", 0.0, open_lower=True, display=("kWh/tonne", "kWh/short_ton", "kJ/kg"))
]
MassPerRevolution = Annotated[
    Any, Kind("mass per revolution", "kg", 0.0, open_lower=True, display=("g", "kg"))
]
MassPerEnergy = Annotated[Any, Kind("mass per energy", "kg/J", 0.0, display=("tonne/kWh", "kg/J"))]
