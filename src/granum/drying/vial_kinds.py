"""Kinds that only freeze drying needs."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import Kind

HeatTransferPerPressure = Annotated[
    Any, Kind("heat transfer coefficient per pressure", "W/(m^2*K*Pa)", 0.0, display=("W/(m^2*K*Pa)", "cal/(s*K*cm^2*torr)"))
]
PerPressure = Annotated[Any, Kind("per pressure", "1/Pa", 0.0, display=("1/Pa", "1/torr"))]
VaporResistance = Annotated[Any, Kind("resistance to vapor", "m/s", 0.0, open_lower=True, display=("kPa*s*m^2/kg", "cm^2*hour*torr/g"))]
VaporResistanceGradient = Annotated[Any, Kind("resistance to vapor per depth", "1/s", 0.0, display=("kPa*s*m/kg", "cm*hour*torr/g"))]
PerLength = Annotated[Any, Kind("per length", "1/m", 0.0, display=("1/cm", "1/m"))]
RampRate = Annotated[Any, Kind("rate of change of temperature", "kelvin/s", 0.0, open_lower=True, display=("kelvin/min", "kelvin/hour"))]
VaporPermeability = Annotated[Any, Kind("permeability to vapor", "kg/(m*s*Pa)", 0.0, open_lower=True, display=("kg/(m*s*Pa)",))]
