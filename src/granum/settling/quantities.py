"""Kinds of settling: volume per mass of solids, and area per solids flow."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import Kind, VolumePerMass

SpecificVolume = VolumePerMass
UnitArea = Annotated[Any, Kind("area per solids flow", "m^2*s/kg", lower=0.0, display=("m^2*day/tonne", "m^2*hour/kg", "m^2*hour/tonne"))]
