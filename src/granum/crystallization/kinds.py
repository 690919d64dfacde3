"""Kinds of crystallization."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import Kind, TemperatureRate

CoolingRate = TemperatureRate
ProductionRate = Annotated[Any, Kind("production per volume", "kg/(m^3*s)", lower=0.0, display=("kg/(m^3*hour)", "kg/(m^3*s)"))]
