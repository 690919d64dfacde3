"""Kinds that only filtration needs: quotients of time and filtrate volume."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import Kind

OVER_COMPRESSIBLE = (
    "A compressibility above 1 means that more pressure gives less filtrate; tests seldom bear that out."
)

TimePerVolume = Annotated[Any, Kind("time per volume", "s/m^3", display=("s/L", "s/mL", "min/m^3"))]
TimePerVolumeSquared = Annotated[Any, Kind("time per volume squared", "s/m^6", display=("s/L^2",))]
# an intercept of readings, negative by their scatter
FittedMediumResistance = Annotated[Any, Kind("medium resistance", "1/m")]
FittedVolume = Annotated[Any, Kind("volume", "m^3", display=("L", "mL", "cm^3"))]
RuthConstant = Annotated[
    Any, Kind("volume squared per time", "m^6/s", lower=0.0, open_lower=True, display=("L^2/s",))
]
PressureTimePerVolume = Annotated[Any, Kind("pressure impulse per volume", "Pa*s/m^3", display=("bar*s/L",))]
HeadLossPerDeposit = Annotated[Any, Kind("head loss per mass deposited per area", "m^3/kg", lower=0.0)]
ResidualDrag = Annotated[Any, Kind("pressure drop per velocity", "Pa*s/m", lower=0.0, display=("Pa*min/m",))]
DustResistance = Annotated[Any, Kind("resistance of a dust cake", "1/s", lower=0.0)]
EnergyPerVolume = Annotated[Any, Kind("energy per volume", "J/m^3", lower=0.0, display=("kWh/m^3", "kJ/m^3"))]
VolumePerArea = Annotated[Any, Kind("volume per area", "m", lower=0.0, display=("L/m^2", "mm"))]
LoadPerWidth = Annotated[Any, Kind("mass flow per width", "kg/(m*s)", lower=0.0, display=("kg/(m*hour)",))]
FlowPerWidth = Annotated[Any, Kind("volume flow per width", "m^2/s", lower=0.0, display=("m^3/(m*hour)",))]
ForcePerWidth = Annotated[
    Any, Kind("force per width", "N/m", lower=0.0, open_lower=True, display=("kN/m", "N/mm"))
]
LoadingScale = Annotated[
    Any, Kind("mass adsorbed per mass", "kg/kg", lower=1e-9, upper=5.0, display=("mg/g", "g/kg", "percent"))
]
AdsorptionAffinity = Annotated[
    Any, Kind("adsorption affinity", "m^3/kg", lower=1e-9, upper=1e12, display=("L/g", "L/mg"))
]
AdsorptionExponent = Annotated[
    Any, Kind("exponent of the adsorption", "dimensionless", lower=0.01, upper=5.0)
]
ReferenceConcentration = Annotated[
    Any,
    Kind("mass concentration", "kg/m^3", lower=1e-12, upper=1e4, display=("mg/L", "g/L", "ug/L", "mg/m^3")),
]
AdsorptionRate = Annotated[
    Any, Kind("adsorption rate coefficient", "1/s", lower=1e-7, upper=1e6, display=("1/min", "1/s", "1/hour"))
]
# Suction time and fouling of membranes
SuctionConstant = Annotated[
    Any, Kind("constant of a suction time apparatus", "m^2/Pa", lower=0.0, open_lower=True)
]
FilterabilityConstant = Annotated[Any, Kind("filterability constant", "kg^2/(m^4*s^2)", lower=0.0)]
TimePerConcentration = Annotated[
    Any, Kind("time per mass concentration", "s*m^3/kg", lower=0.0, display=("s*L/g",))
]
FoulingPotential = Annotated[Any, Kind("fouling potential", "1/m^2", lower=0.0, open_lower=True)]
SiltDensityIndex = Annotated[Any, Kind("silt density index", "1/s", display=("percent/min",))]
