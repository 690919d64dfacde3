"""Kinds of dust collectors."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import Kind

Voltage = Annotated[Any, Kind("voltage", "V", lower=0.0, display=("kV",))]
CurrentDensity = Annotated[Any, Kind("current density", "A/m^2", lower=0.0, display=("mA/m^2", "uA/m^2"))]
ElementaryCharges = Annotated[Any, Kind("number of elementary charges", "dimensionless", lower=0.0)]
IonMobility = Annotated[Any, Kind("ion mobility", "m^2/(V*s)", lower=0.0, display=("cm^2/(V*s)",))]
IonDose = Annotated[Any, Kind("ion concentration times time", "s/m^3", lower=0.0)]
DeflagrationIndex = Annotated[
    Any, Kind("deflagration index", "Pa*m/s", lower=0.0, open_lower=True, display=("bar*m/s",))
]
IgnitionEnergy = Annotated[Any, Kind("ignition energy", "J", lower=0.0, open_lower=True, display=("mJ", "J"))]
