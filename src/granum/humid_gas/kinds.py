"""Kinds that humid gas adds to the common ones."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import Kind

SpecificVolume = Annotated[Any, Kind("specific volume", "m^3/kg", 0.0, open_lower=True, display=("m^3/kg", "L/kg"))]
