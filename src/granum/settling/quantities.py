"""Kinds that only settling needs: volume per mass of solids, and area per solids flow."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import Kind

SpecificVolume = Annotated[Any, Kind("volume per mass", "m^3/kg", lower=0.0, display=("mL/g", "L/kg", "cm^3/g"))]
UnitArea = Annotated[Any, Kind("area per solids flow", "m^2*s/kg", lower=0.0, display=("m^2*day/tonne", "m^2*hour/kg", "m^2*hour/tonne"))]
