"""Kinds of crystallization."""

from __future__ import annotations

from typing import Annotated, Any

from granum.core.kinds import (
    Fraction,
    GrowthRate,
    Kind,
    Law,
    MassFraction,
    MolarEnergy,
    NumberDensity,
    PositiveNumber,
    Pressure,
    Ratio,
    Volume,
    Within,
)

VesselVolume = Annotated[Volume, Within(1e-6)]  # a milliliter: nothing crystallizes in none
PositiveTemperatureDifference = Annotated[
    Any,
    Kind(
        "positive temperature difference",
        "delta_degC",
        lower=0.0,
        open_lower=True,
        display=("kelvin", "delta_degF"),
    ),
]
SolubilitySlope = Annotated[
    Any, Kind("slope of a solubility", "1/kelvin", lower=0.0, open_lower=True, display=("1/kelvin",))
]
RateCoefficient = Annotated[
    Any,
    Kind(
        "growth rate at a driving force of one",
        "m/s",
        lower=0.0,
        display=("m/s", "um/s", "um/min", "mm/hour"),
    ),
]
IntegrationCoefficient = Annotated[
    Any,
    Kind(
        "mass flux at a driving force of 1 kg/m³",
        "kg/(m^2*s)",
        lower=0.0,
        open_lower=True,
        display=("kg/(m^2*s)",),
    ),
]
AgglomerationRate = Annotated[
    Any, Kind("collisions per pair and volume", "m^3/s", lower=0.0, display=("m^3/s", "cm^3/s"))
]
AgglomerationRatePerVolumes = Annotated[
    Any, Kind("collisions per pair and product of volumes", "1/(m^3*s)", lower=0.0, display=("1/(m^3*s)",))
]
SizeParameter = Annotated[
    Any, Kind("reciprocal length", "1/m", lower=0.0, open_lower=True, display=("1/mm", "1/m"))
]
MolarEntropy = Annotated[Any, Kind("entropy per amount", "J/(mol*K)", display=("J/(mol*K)",))]
ForwardGrowthRate = Annotated[GrowthRate, Within(0.0)]  # crystals that grow; laws may also dissolve
# a share of a mixture of which something else is left
OpenShare = Annotated[MassFraction, Within(0.0, 0.999)]
# impurity in the crystal over that in the melt, where crystals are the purer
DistributionCoefficient = Annotated[PositiveNumber, Within(1e-6, 1.0)]
SoluteShare = Annotated[PositiveNumber, Within(0.0, 1.0)]  # anhydrous solute in a crystal
PositiveMolarEnergy = Annotated[MolarEnergy, Within(0.0)]
ProductionRate = Annotated[
    Any, Kind("production per volume", "kg/(m^3*s)", lower=0.0, display=("kg/(m^3*hour)", "kg/(m^3*s)"))
]
StepEnergy = Annotated[
    Any, Kind("energy per length of a step", "J/m", lower=0.0, open_lower=True, display=("J/m", "pJ/m"))
]
ImpurityConcentration = Annotated[
    Any,
    Kind("impurity in the liquor", "mol/m^3", lower=0.0, display=("mmol/L", "umol/L", "mol/L", "mol/m^3")),
]
AdsorptionCoefficient = Annotated[
    Any, Kind("Langmuir coefficient", "m^3/mol", lower=0.0, display=("L/mol", "m^3/mol"))
]
InclusionShare = Annotated[Fraction, Within(0.0, 0.5)]  # of a crystal's volume
# both enantiomers dissolved over one alone, at saturation
RacemateSolubilityRatio = Annotated[PositiveNumber, Within(1.0, 4.0)]
GasPressure = Annotated[Pressure, Within(1e-3)]  # absolute; no gas has none
Saturated = Annotated[Fraction, Within(1e-3, 1.0)]  # share of saturation that a gas reaches
CountBound = Annotated[NumberDensity, Within(1.0)]
ReadingDeviation = Annotated[Fraction, Within(0.0, 0.2)]
KineticDeviation = Annotated[Ratio, Within(0.0, 2.0)]
Solubility = Annotated[Any, Law("solubility_law")]
Growth = Annotated[Any, Law("growth_rate")]
Nucleation = Annotated[Any, Law("nucleation_rate")]
Dissolution = Annotated[Any, Law("dissolution_rate")]
Program = Annotated[Any, Law("program")]
Steps = Annotated[int, Within(2, 100_000)]
