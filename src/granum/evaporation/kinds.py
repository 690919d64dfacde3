"""Kinds of evaporators."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import Kind

ThermalResistance = Annotated[
    Any, Kind("thermal resistance of an area", "m^2*K/W", lower=0.0, display=("m^2*K/W",))
]
EVAPORATION_SOURCE = "mccabe2005, ch. 16"
