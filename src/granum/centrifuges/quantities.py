"""Kinds that only centrifuges need."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import Kind

SpecificVolume = Annotated[Any, Kind("specific volume", "m^3/kg", lower=0.0, open_lower=True, display=("cm^3/g",))]
Stress = Annotated[Any, Kind("stress", "Pa", display=("MPa", "N/mm^2"))]
