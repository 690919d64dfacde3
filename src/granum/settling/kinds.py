"""Kinds of settling."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import Kind

UnitArea = Annotated[
    Any,
    Kind(
        "area per solids flow",
        "m^2*s/kg",
        lower=0.0,
        display=("m^2*day/tonne", "m^2*hour/kg", "m^2*hour/tonne"),
    ),
]
LineLoad = Annotated[
    Any, Kind("force per length", "N/m", lower=0.0, open_lower=True, display=("N/m", "lbf/ft"))
]
Torque = Annotated[Any, Kind("torque", "N*m", display=("N*m", "kN*m"))]
