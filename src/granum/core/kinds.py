"""Kinds: what sort of quantity an argument is, its SI unit, its hard bounds and the units people write it
in.

A kind is used as an annotation. ``def f(particle_diameter: Length) -> Velocity`` is all that a form, a
converter or a bounds check needs to know. Tighter bounds for one argument: ``Annotated[Ratio, Within(1.0,
20.0)]``. A column or a vector: ``Annotated[Length, Series("classes")]``. A law passed as an argument:
``Annotated[Any, Law("drag_coefficient")]``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf
from typing import Annotated, Any, get_args, get_origin


@dataclass(frozen=True)
class Kind:
    """A sort of quantity.

    Parameters
    ----------
    name: what it is, in words.
    unit: SI unit, as Pint writes it.
    lower, upper: hard bounds, SI. Outside them the quantity has no meaning.
    open_lower, open_upper: whether the bound itself is excluded.
    display: units offered in forms and used to print, the first being the usual one.
    per_volume: of a flow of something known, kg/m³, so that it may be said as a volume.
    """

    name: str
    unit: str
    lower: float = -inf
    upper: float = inf
    open_lower: bool = False
    open_upper: bool = False
    display: tuple[str, ...] = ()
    per_volume: float | None = None

    def contains(self, value: Any) -> Any:
        """Whether a value (scalar or array) lies inside the hard bounds. NaN does not."""
        low = value > self.lower if self.open_lower else value >= self.lower
        high = value < self.upper if self.open_upper else value <= self.upper
        return low & high

    @property
    def units(self) -> tuple[str, ...]:
        """Every unit to offer: the display units, then the SI unit."""
        return self.display + ((self.unit,) if self.unit not in self.display else ())


@dataclass(frozen=True)
class Within:
    """Tighter hard bounds for one argument, SI units; both ends belong to the range."""

    lower: float = -inf
    upper: float = inf


@dataclass(frozen=True)
class Series:
    """Marks an argument that is a vector; ``along`` names what it runs over (classes, points, stages)."""

    along: str = "points"


@dataclass(frozen=True)
class Law:
    """Marks an argument that is itself a law: a formula or model of the named family."""

    family: str


def kind_of(annotation: Any) -> Kind | None:
    """The kind carried by an annotation, with any ``Within`` applied; None when there is none."""
    if get_origin(annotation) is not Annotated:
        return None
    kind = None
    for extra in get_args(annotation)[1:]:
        if isinstance(extra, Kind):
            kind = extra
        elif isinstance(extra, Within) and kind is not None:
            kind = replace(
                kind,
                lower=max(kind.lower, extra.lower),
                upper=min(kind.upper, extra.upper),
                open_lower=kind.open_lower and extra.lower <= kind.lower,
                open_upper=kind.open_upper and extra.upper >= kind.upper,
            )
    return kind


def extra_of(annotation: Any, sort: type) -> Any:
    """The first annotation extra of a given sort (Series, Law …), or None."""
    if get_origin(annotation) is not Annotated:
        return None
    return next((extra for extra in get_args(annotation)[1:] if isinstance(extra, sort)), None)


def _positive(name: str, unit: str, *display: str) -> Kind:
    return Kind(name, unit, lower=0.0, open_lower=True, display=display)


def _nonnegative(name: str, unit: str, *display: str) -> Kind:
    return Kind(name, unit, lower=0.0, display=display)


def _any(name: str, unit: str, *display: str) -> Kind:
    return Kind(name, unit, display=display)


# geometry and time
Length = Annotated[Any, _positive("length", "m", "um", "mm", "m", "cm", "nm", "inch", "ft")]
Distance = Annotated[Any, _nonnegative("distance", "m", "m", "mm", "cm", "um", "ft")]
Position = Annotated[Any, _any("position", "m", "m", "mm", "cm", "um", "ft")]
Area = Annotated[Any, _positive("area", "m^2", "m^2", "cm^2", "mm^2", "ft^2")]
AreaOrZero = Annotated[Any, _nonnegative("area", "m^2", "m^2", "cm^2", "mm^2", "ft^2")]
Volume = Annotated[Any, _nonnegative("volume", "m^3", "m^3", "L", "mL", "cm^3", "ft^3")]
Angle = Annotated[Any, _any("angle", "radian", "degree")]
Time = Annotated[Any, _nonnegative("time", "s", "min", "hour", "day", "s", "ms", "us")]
Frequency = Annotated[Any, _nonnegative("frequency", "1/s", "1/min", "1/hour")]
RotationSpeed = Annotated[Any, _nonnegative("rotation speed", "radian/s", "rpm")]
TurningSpeed = Annotated[Any, _positive("rotation speed", "radian/s", "rpm")]
SpecificSurface = Annotated[Any, _positive("surface per volume", "1/m", "m^2/cm^3", "1/mm")]
SpecificSurfaceMass = Annotated[Any, _positive("surface per mass", "m^2/kg", "m^2/g", "cm^2/g")]
ReciprocalLength = Annotated[Any, _nonnegative("reciprocal length", "1/m", "1/m", "1/mm")]
MassPerArea = Annotated[Any, _positive("mass per area", "kg/m^2", "kg/m^2", "g/m^2")]
MassPerAreaOrZero = Annotated[Any, _nonnegative("mass per area", "kg/m^2", "g/cm^2")]
NumberPerArea = Annotated[Any, _positive("number per area", "1/m^2", "1/m^2", "1/cm^2")]
# mass, amount, flow
Mass = Annotated[Any, _nonnegative("mass", "kg", "kg", "g", "mg", "tonne", "lb", "ug")]
MassFlow = Annotated[Any, _nonnegative("mass flow", "kg/s", "kg/hour", "tonne/hour", "lb/hour")]
SignedMassFlow = Annotated[Any, _any("mass flow", "kg/s", "kg/hour", "tonne/hour", "lb/hour")]
VolumeFlow = Annotated[
    Any, _nonnegative("volume flow", "m^3/s", "m^3/hour", "L/min", "L/s", "mL/min", "gallon/min")
]
MassFlux = Annotated[Any, _nonnegative("mass flux", "kg/(m^2*s)", "kg/(m^2*hour)", "tonne/(m^2*hour)")]
SignedMassFlux = Annotated[Any, _any("mass flux", "kg/(m^2*s)", "kg/(m^2*hour)")]
MolarMass = Annotated[Any, _positive("molar mass", "kg/mol", "g/mol")]
# mechanics
Velocity = Annotated[Any, _any("velocity", "m/s", "mm/s", "m/s", "cm/s", "um/s", "nm/s", "m/hour", "ft/s")]
Speed = Annotated[Any, _nonnegative("speed", "m/s", "mm/s", "m/s", "cm/s", "um/s", "m/hour", "ft/s")]
Acceleration = Annotated[Any, _positive("acceleration", "m/s^2", "m/s^2", "cm/s^2")]
Density = Annotated[Any, _positive("density", "kg/m^3", "kg/m^3", "g/cm^3", "lb/ft^3")]
DensityDifference = Annotated[Any, _any("density difference", "kg/m^3", "kg/m^3", "g/cm^3")]
SpecificVolume = Annotated[Any, _positive("specific volume", "m^3/kg", "m^3/kg", "L/kg", "cm^3/g")]
VolumePerMass = Annotated[Any, _nonnegative("volume per mass", "m^3/kg", "mL/g", "L/kg", "m^3/kg")]
Concentration = Annotated[
    Any,
    _nonnegative("mass concentration", "kg/m^3", "g/L", "mg/L", "ug/L", "g/m^3", "mg/m^3", "ug/m^3"),
]
NumberDensity = Annotated[Any, _nonnegative("number per volume", "1/m^3", "1/cm^3", "1/L")]
MolarConcentration = Annotated[Any, _positive("molar concentration", "mol/m^3", "mol/L", "mmol/L", "mol/m^3")]
Molality = Annotated[Any, _nonnegative("molality", "mol/kg", "mol/kg", "mmol/kg")]
NumberPerMass = Annotated[Any, _nonnegative("number per mass", "1/kg", "1/g", "1/kg")]
PopulationDensity = Annotated[Any, _nonnegative("population density", "1/m^4", "1/(m^3*um)")]
DynamicViscosity = Annotated[Any, _positive("dynamic viscosity", "Pa*s", "mPa*s", "cP", "P", "uPa*s")]
KinematicViscosity = Annotated[Any, _positive("kinematic viscosity", "m^2/s", "mm^2/s", "cSt")]
Pressure = Annotated[Any, _nonnegative("absolute pressure", "Pa", "bar", "kPa", "atm", "mmHg", "psi", "mbar")]
PressureDifference = Annotated[Any, _any("pressure difference", "Pa", "bar", "kPa", "mbar", "psi")]
PressureDrop = Annotated[Any, _positive("pressure drop", "Pa", "bar", "kPa", "mbar", "psi")]
PressureGradient = Annotated[Any, _any("pressure gradient", "Pa/m", "bar/m", "kPa/m", "mbar/m")]
Torque = Annotated[Any, _nonnegative("torque", "N*m", "N*m", "kN*m")]
Force = Annotated[Any, _any("force", "N", "N", "mN", "kN", "uN")]
Stress = Annotated[Any, _any("stress", "Pa", "MPa", "kPa", "N/mm^2")]
PowerPerArea = Annotated[Any, _nonnegative("power per area", "W/m^2", "kW/m^2")]
SurfaceTension = Annotated[Any, _positive("surface tension", "N/m", "mN/m", "dyn/cm")]
Permeability = Annotated[Any, _positive("permeability", "m^2", "darcy", "millidarcy", "um^2")]
MolecularArea = Annotated[Any, _positive("molecular area", "m^2", "nm^2", "angstrom^2")]
Permeance = Annotated[Any, _positive("permeance", "m/(s Pa)", "L/(m^2 hour bar)", "m/(s Pa)")]
CakeResistance = Annotated[Any, _positive("specific cake resistance", "m/kg")]
MediumResistance = Annotated[Any, _nonnegative("medium resistance", "1/m")]
# heat
Temperature = Annotated[Any, Kind("temperature", "K", lower=0.0, open_lower=True, display=("degC", "degF"))]
TemperatureDifference = Annotated[Any, _any("temperature difference", "delta_degC", "kelvin")]
TemperatureRate = Annotated[Any, _positive("rate of change of temperature", "K/s", "K/hour", "K/min")]
Energy = Annotated[Any, _any("energy", "J", "kJ", "MJ", "kWh", "kcal")]
Power = Annotated[Any, _any("power", "W", "kW", "MW", "kcal/hour")]
SpecificEnergy = Annotated[Any, _any("energy per mass", "J/kg", "kJ/kg", "kWh/tonne", "kcal/kg")]
SpecificPower = Annotated[Any, _nonnegative("power per mass", "W/kg", "kW/kg")]
SpecificMoistureExtraction = Annotated[
    Any, _nonnegative("water removed per energy", "kg/J", "kg/kWh", "kg/MJ")
]
HeatCapacity = Annotated[Any, _positive("specific heat capacity", "J/(kg*K)", "kJ/(kg*K)", "kcal/(kg*K)")]
MolarEnergy = Annotated[Any, _any("energy per amount", "J/mol", "kJ/mol", "kcal/mol")]
ThermalConductivity = Annotated[Any, _positive("thermal conductivity", "W/(m*K)", "W/(m*K)", "mW/(m*K)")]
HeatTransferCoefficient = Annotated[
    Any, _positive("heat transfer coefficient", "W/(m^2*K)", "W/(m^2*K)", "kcal/(m^2*hour*K)")
]
HeatFlux = Annotated[Any, _any("heat flux", "W/m^2", "kW/m^2")]
MassTransferCoefficient = Annotated[Any, _positive("mass transfer coefficient", "m/s", "mm/s", "um/s")]
Diffusivity = Annotated[Any, _positive("diffusivity", "m^2/s", "cm^2/s")]
# rates of crystals
GrowthRate = Annotated[Any, _any("growth rate", "m/s", "um/s", "um/min", "nm/s")]
NucleationRate = Annotated[Any, _nonnegative("nucleation rate", "1/(m^3*s)", "1/(L*s)", "1/(cm^3*s)")]
# money: US dollars, whatever the year; other currencies are converted before
Cost = Annotated[Any, _any("cost", "USD", "USD")]
CostRate = Annotated[Any, _any("cost per time", "USD/s", "USD/year", "USD/hour", "USD/day")]
EnergyPrice = Annotated[Any, _nonnegative("price of energy", "USD/J", "USD/kWh", "USD/MWh", "USD/GJ")]
MassPrice = Annotated[Any, _nonnegative("price per mass", "USD/kg", "USD/kg", "USD/tonne")]
# numbers
Number = Annotated[Any, _any("number", "dimensionless", "dimensionless")]
Ratio = Annotated[Any, _nonnegative("ratio", "dimensionless", "dimensionless", "percent")]
# masses too: only their ratios count
Amount = Annotated[Any, _nonnegative("relative amount", "dimensionless", "dimensionless", "percent")]
PositiveNumber = Annotated[Any, _positive("positive number", "dimensionless", "dimensionless")]
FlowIndex = Annotated[PositiveNumber, Within(0.1, 1.9)]
ShearRate = Annotated[Frequency, Within(1e-6, 1e6)]
YieldStress = Annotated[Stress, Within(0.0, 1e6)]
Fraction = Annotated[Any, Kind("fraction", "dimensionless", 0.0, 1.0, display=("percent", "dimensionless"))]
OpenFraction = Annotated[
    Any,
    Kind(
        "fraction strictly between 0 and 1",
        "dimensionless",
        0.0,
        1.0,
        True,
        True,
        ("percent", "dimensionless"),
    ),
]
VolumeFraction = Annotated[
    Any, Kind("volume fraction", "dimensionless", 0.0, 1.0, display=("percent", "dimensionless"))
]
VoidFraction = Annotated[
    Any, Kind("void fraction", "dimensionless", 0.0, 1.0, True, True, ("dimensionless", "percent"))
]
MassFraction = Annotated[
    Any, Kind("mass fraction", "dimensionless", 0.0, 1.0, display=("percent", "dimensionless", "g/kg"))
]
MoleFraction = Annotated[
    Any, Kind("mole fraction", "dimensionless", 0.0, 1.0, display=("percent", "dimensionless"))
]
MassRatio = Annotated[Any, _nonnegative("mass ratio", "kg/kg", "g/kg", "percent", "g/g")]
MoistureDryBasis = Annotated[Any, _nonnegative("moisture, dry basis", "kg/kg", "percent", "g/kg")]
MoistureWetBasis = Annotated[
    Any, Kind("moisture, wet basis", "kg/kg", 0.0, 1.0, open_upper=True, display=("percent", "g/kg"))
]
HumidityRatio = Annotated[Any, _nonnegative("humidity ratio", "kg/kg", "g/kg")]
RelativeHumidity = Annotated[
    Any, Kind("relative humidity", "dimensionless", 0.0, 1.0, display=("percent", "dimensionless"))
]
WaterActivity = Annotated[
    Any, Kind("water activity", "dimensionless", 0.0, 1.0, display=("dimensionless", "percent"))
]
Sphericity = Annotated[
    Any, Kind("sphericity", "dimensionless", 0.0, 1.0, open_lower=True, display=("dimensionless",))
]

KINDS: dict[str, Kind] = {
    name: kind for name, annotation in list(globals().items()) if (kind := kind_of(annotation)) is not None
}
