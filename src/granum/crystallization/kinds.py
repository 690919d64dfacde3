"""Kinds that only crystallization needs."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import Kind

CoolingRate = Annotated[Any, Kind("cooling rate", "K/s", lower=0.0, open_lower=True, display=("K/hour", "K/min"))]
