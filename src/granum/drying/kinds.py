"""Kinds that only drying needs."""

from __future__ import annotations

import math
from typing import Annotated, Any

from granum.core.kinds import Kind, Power, Within

# heat that a dryer is given is a utility, and has inputs of its own
LostHeat = Annotated[Power, Within(0.0, math.inf)]
# zero where there is none
AddedHeatTransferCoefficient = Annotated[
    Any, Kind("heat transfer coefficient", "W/(m^2*K)", 0.0, display=("W/(m^2*K)", "kcal/(m^2*hour*K)"))
]
ElectricField = Annotated[Any, Kind("electric field", "V/m", 0.0, display=("V/m", "kV/m", "V/cm"))]
PowerDensity = Annotated[Any, Kind("power per volume", "W/m^3", 0.0, display=("W/m^3", "kW/m^3", "W/cm^3"))]
EnergyPerVolume = Annotated[
    Any, Kind("energy per volume", "J/m^3", 0.0, display=("kJ/m^3", "W*hour/m^3", "J/m^3"))
]
ThermalEffusivity = Annotated[
    Any, Kind("thermal effusivity", "W*s^0.5/(m^2*K)", 0.0, open_lower=True, display=("W*s^0.5/(m^2*K)",))
]
VolumetricHeatTransfer = Annotated[
    Any,
    Kind(
        "heat transfer coefficient per volume",
        "W/(m^3*K)",
        0.0,
        display=("W/(m^3*K)", "kW/(m^3*K)", "Btu/(ft^3*hour*delta_degF)"),
    ),
]
GasDrift = Annotated[Any, Kind("slope per velocity of the gas", "s/m", display=("s/m",))]
# of freeze drying in vials
HeatTransferPerPressure = Annotated[
    Any,
    Kind(
        "heat transfer coefficient per pressure",
        "W/(m^2*K*Pa)",
        0.0,
        display=("W/(m^2*K*Pa)", "cal/(s*K*cm^2*torr)"),
    ),
]
PerPressure = Annotated[Any, Kind("per pressure", "1/Pa", 0.0, display=("1/Pa", "1/torr"))]
VaporResistance = Annotated[
    Any,
    Kind("resistance to vapor", "m/s", 0.0, open_lower=True, display=("kPa*s*m^2/kg", "cm^2*hour*torr/g")),
]
VaporResistanceGradient = Annotated[
    Any, Kind("resistance to vapor per depth", "1/s", 0.0, display=("kPa*s*m/kg", "cm*hour*torr/g"))
]
PerLength = Annotated[Any, Kind("per length", "1/m", 0.0, display=("1/cm", "1/m"))]
VaporPermeability = Annotated[
    Any, Kind("permeability to vapor", "kg/(m*s*Pa)", 0.0, open_lower=True, display=("kg/(m*s*Pa)",))
]
PerTemperature = Annotated[Any, Kind("per temperature difference", "1/K", 0.0, display=("%/K", "1/K"))]
