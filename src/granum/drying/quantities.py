"""Kinds that only drying needs."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import Kind

AddedHeatTransferCoefficient = Annotated[
    Any, Kind("heat transfer coefficient", "W/(m^2*K)", 0.0, display=("W/(m^2*K)", "kcal/(m^2*hour*K)"))
]  # zero where there is none
ElectricField = Annotated[Any, Kind("electric field", "V/m", 0.0, display=("V/m", "kV/m", "V/cm"))]
PowerDensity = Annotated[Any, Kind("power per volume", "W/m^3", 0.0, display=("W/m^3", "kW/m^3", "W/cm^3"))]
ThermalEffusivity = Annotated[Any, Kind("thermal effusivity", "W*s^0.5/(m^2*K)", 0.0, open_lower=True, display=("W*s^0.5/(m^2*K)",))]
VolumetricHeatTransfer = Annotated[
    Any, Kind("heat transfer coefficient per volume", "W/(m^3*K)", 0.0, display=("W/(m^3*K)", "kW/(m^3*K)", "Btu/(ft^3*hour*delta_degF)"))
]
MassPerArea = Annotated[Any, Kind("mass per area", "kg/m^2", 0.0, open_lower=True, display=("kg/m^2", "g/m^2"))]
GasDrift = Annotated[Any, Kind("slope per velocity of the gas", "s/m", display=("s/m",))]
