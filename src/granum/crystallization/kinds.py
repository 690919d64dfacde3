"""Kinds of crystallization."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import GrowthRate, Kind, MolarEnergy, PositiveNumber, TemperatureRate, Within

CoolingRate = TemperatureRate
PositiveTemperatureDifference = Annotated[
    Any, Kind("positive temperature difference", "delta_degC", lower=0.0, open_lower=True, display=("kelvin", "delta_degF"))
]
SolubilitySlope = Annotated[Any, Kind("slope of a solubility", "1/kelvin", lower=0.0, open_lower=True, display=("1/kelvin",))]
RateCoefficient = Annotated[
    Any, Kind("growth rate at a driving force of one", "m/s", lower=0.0, display=("m/s", "um/s", "um/min", "mm/hour"))
]
ForwardGrowthRate = Annotated[GrowthRate, Within(0.0)]  # crystals that grow; laws may also dissolve
SoluteShare = Annotated[PositiveNumber, Within(0.0, 1.0)]  # anhydrous solute in a crystal
PositiveMolarEnergy = Annotated[MolarEnergy, Within(0.0)]
ProductionRate = Annotated[Any, Kind("production per volume", "kg/(m^3*s)", lower=0.0, display=("kg/(m^3*hour)", "kg/(m^3*s)"))]
