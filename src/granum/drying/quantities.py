"""Kinds that only drying needs."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import Kind

MassPerArea = Annotated[Any, Kind("mass per area", "kg/m^2", 0.0, open_lower=True, display=("kg/m^2", "g/m^2"))]
