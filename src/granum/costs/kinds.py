"""Kinds of costs."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import Kind

EmissionFactor = Annotated[
    Any, Kind("greenhouse gas per energy", "kg/J", lower=0.0, display=("kg/kWh", "kg/GJ"))
]
