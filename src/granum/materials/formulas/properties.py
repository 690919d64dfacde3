"""Everything the library knows of a material at a temperature, as cards: what ``granum calc`` and the forms
use.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.flags import limit_active
from granum.core.kinds import (
    Density,
    Diffusivity,
    DynamicViscosity,
    Fraction,
    HeatCapacity,
    MassFraction,
    MassRatio,
    Molality,
    Number,
    PositiveNumber,
    Pressure,
    Ratio,
    SpecificEnergy,
    SurfaceTension,
    Temperature,
    ThermalConductivity,
)
from granum.materials.correlation import Missing
from granum.materials.formulas.precipitation import ROOM
from granum.materials.library import session

NEAR = 0.5  # K beside 25 °C
ONLY_ROOM = (
    "The library has no heat of dissolution of this salt: the product is that of 25 °C at any temperature."
)


def _or_nan(property_of: Any, temperature: Any) -> Any:
    """NaN, hence a flag, where the library has nothing: one gap must not hide the other properties."""
    return jnp.nan + 0.0 * temperature if isinstance(property_of, Missing) else property_of(temperature)


class LiquidProperties(NamedTuple):
    """Properties of a pure liquid."""

    liquid_density: Density
    dynamic_viscosity: DynamicViscosity
    specific_heat_capacity: HeatCapacity
    thermal_conductivity: ThermalConductivity
    surface_tension: SurfaceTension
    vapor_pressure: Pressure
    heat_of_vaporization: SpecificEnergy


@formula(
    source="green2008, sec. 2; iapwsif97; mulero2012",
    typical={"temperature": (285.0, 340.0)},
    title="Properties of a liquid",
)
def liquid_properties(temperature: Temperature, fluid: str = "water") -> LiquidProperties:
    """Density, viscosity, heat capacity, conductivity, surface tension, vapor pressure and heat of
    vaporization of a pure liquid.

    The sources of each property stand in the material's file; ``granum.materials.names("fluid")`` lists the
    fluids.

    >>> round(liquid_properties("25 degC", fluid="ethanol").dynamic_viscosity * 1e3, 1)
    1.1
    """
    f = session().fluid(fluid)
    laws = (
        f.liquid_density,
        f.liquid_viscosity,
        f.liquid_heat_capacity,
        f.liquid_conductivity,
        f.surface_tension,
    )
    return LiquidProperties(
        *(_or_nan(law, temperature) for law in (*laws, f.vapor_pressure, f.heat_of_vaporization))
    )


class GasProperties(NamedTuple):
    """Properties of a gas or dilute vapor."""

    gas_density: Density
    dynamic_viscosity: DynamicViscosity
    specific_heat_capacity: HeatCapacity
    thermal_conductivity: ThermalConductivity


@formula(
    source="lemmon2004; poling2001, app. A; green2008, sec. 2",
    typical={"temperature": (285.0, 500.0)},
    title="Properties of a gas",
)
def gas_properties(
    temperature: Temperature, pressure: Pressure = STANDARD_ATMOSPHERE, fluid: str = "dry air"
) -> GasProperties:
    """Density, viscosity, heat capacity and conductivity of a gas or vapor at low pressure.

    >>> round(gas_properties("20 degC").gas_density, 3)
    1.204
    """
    f = session().fluid(fluid)
    laws = (f.vapor_viscosity, f.vapor_heat_capacity, f.vapor_conductivity)
    return GasProperties(f.vapor_density(temperature, pressure), *(_or_nan(law, temperature) for law in laws))


class VaporInGas(NamedTuple):
    """A vapor in a carrier gas."""

    diffusivity: Diffusivity
    lewis_number: PositiveNumber
    molar_mass_ratio: Ratio


@formula(
    source="poling2001, eq. 11-4.4; marrero1972; fuller1969",
    typical={"temperature": (285.0, 440.0)},
    title="Vapor in a carrier gas",
)
def vapor_in_gas(
    temperature: Temperature,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    vapor: str = "water",
    gas: str = "dry air",
) -> VaporInGas:
    """Diffusivity and Lewis number of a vapor in a gas that carries little of it, and the ratio of their
    molar masses.

    >>> round(vapor_in_gas("25 degC", vapor="toluene").lewis_number, 1)
    2.7
    """
    from granum.materials.pairs import gas_vapor

    pair = gas_vapor(vapor, gas)
    found = pair.diffusivity(temperature, pressure), pair.lewis_number(temperature, pressure)
    return VaporInGas(*found, pair.molar_mass_ratio + 0.0 * temperature)


class Solubility(NamedTuple):
    """What a solvent dissolves, in the usual bases, and how good the curve is."""

    solubility_per_solvent: MassRatio
    solute_mass_fraction: MassFraction
    solute_mole_fraction: Fraction
    solute_molality: Molality
    crystal_per_solute: Ratio
    solubility_misfit: Fraction
    temperature_lowest: Temperature
    temperature_highest: Temperature


@formula(
    source="haynes2014, sec. 5; green2008, table 2-120",
    typical={"temperature": (285.0, 340.0)},
    title="Solubility",
)
def solubility(temperature: Temperature, system: str) -> Solubility:
    """Solubility of a solute over its stable crystal in the usual bases, all of anhydrous solute.

    The misfit is the root mean square of what the curve deviates from the data it was drawn through; zero
    where it goes through them or is the source's own formula. Outside the lowest and highest temperature of
    the data the curve goes on as a van 't Hoff line and is flagged. The sources of each system stand in its
    file; ``granum.materials.names("solute")`` lists the systems. ``saturated_solution`` has the properties of
    the solution.

    >>> found = solubility("80 degC", "potassium aluminum sulfate")
    >>> round(100 * found.solubility_per_solvent, 1), round(found.crystal_per_solute, 3)
    (71.0, 1.837)
    """
    s = session().solute(system)
    T = temperature
    ratio = s.solubility(T)
    moles, solvent = ratio / s.molar_mass, 1.0 / s.solvent.molar_mass
    lowest, highest = s.data_range
    return Solubility(
        ratio,
        s.mass_fraction(ratio),
        moles / (moles + solvent),
        moles,
        s.hydrate_ratio(T),
        s.solubility_misfit(T),
        lowest + 0.0 * T,
        highest + 0.0 * T,
    )


class Saturation(NamedTuple):
    """A saturated solution and the crystal it is in equilibrium with."""

    solubility_per_solvent: MassRatio
    solute_mass_fraction: MassFraction
    crystal_per_solute: Ratio
    heat_of_crystallization: SpecificEnergy
    liquid_density: Density
    dynamic_viscosity: DynamicViscosity
    specific_heat_capacity: HeatCapacity


@formula(
    source="haynes2014, sec. 5; laliberte2009",
    typical={"temperature": (285.0, 340.0)},
    title="Saturated solution",
)
def saturated_solution(temperature: Temperature, system: str) -> Saturation:
    """Solubility of a solute over its stable crystal, with the heat released on crystallization and the
    properties of the solution.

    Everything is per mass of anhydrous solute; ``crystal_per_solute`` is the mass of (hydrated) crystal per
    mass of anhydrous solute. The sources of each system stand in its file;
    ``granum.materials.names("solute")`` lists the systems.

    >>> round(saturated_solution("20 degC", "potassium chloride").liquid_density / 1e3, 2)
    1.17
    """
    s = session().solute(system)
    T = temperature
    ratio = s.solubility(T)
    viscosity = jnp.nan + 0.0 * T if s.viscosity_law.is_missing else s.solution_viscosity(T, ratio)
    heat = s.heat_of_crystallization(T) if all(b.heat_given for b in s.branches) else jnp.nan + 0.0 * T
    return Saturation(
        ratio,
        s.mass_fraction(ratio),
        s.hydrate_ratio(T),
        heat,
        s.solution_density(T, ratio),
        viscosity,
        s.solution_heat_capacity(T, ratio),
    )


class SolutionProperties(NamedTuple):
    """Properties of a solution of one solute."""

    liquid_density: Density
    dynamic_viscosity: DynamicViscosity
    specific_heat_capacity: HeatCapacity


@formula(
    source="laliberte2004; laliberte2007; laliberte2009",
    typical={"temperature": (285.0, 340.0), "solute_mass_fraction": (0.02, 0.2)},
    title="Properties of a solution",
)
def solution_properties(
    temperature: Temperature, solute_mass_fraction: MassFraction, system: str
) -> SolutionProperties:
    """Density, viscosity and heat capacity of a solution of one solute at any strength, saturated or not.

    The fraction is that of anhydrous solute in the solution. Brine of 10 % at 20 °C: 1070.7 kg/m³ and
    1.193 mPa s in the CRC handbook. The sources of each system stand in its file;
    ``granum.materials.names("solute")`` lists the systems.

    >>> brine = solution_properties("20 degC", "10 %", "sodium chloride")
    >>> round(brine.liquid_density), round(1000 * brine.dynamic_viscosity, 1)
    (1071, 1.2)
    """
    s = session().solute(system)
    T, x = temperature, solute_mass_fraction
    gap = jnp.nan + 0.0 * (T + x)
    laws = (s.density_law, s.viscosity_law, s.heat_capacity_law)
    return SolutionProperties(*(gap if getattr(law, "is_missing", False) else law(T, x) for law in laws))


class SaltSaturation(NamedTuple):
    """A sparingly soluble salt in a solution of its ions."""

    solubility_product: PositiveNumber
    saturation_index: Number
    saturation_ratio: PositiveNumber


@formula(
    source="davies1962, ch. 3; haynes2014, sec. 5; ball1991",
    equation=(
        r"\mathrm{SI} = \log_{10}\frac{(\gamma_c m_c)^p(\gamma_a m_a)^q}{K_{sp}},\quad S = "
        r"10^{\mathrm{SI}/(p+q)},\quad \gamma_i = \gamma_i(I)"
    ),
    typical={"cation_molality": (1e-5, 1e-2), "anion_molality": (1e-5, 1e-2), "ionic_strength": (1e-3, 0.3)},
    fitted={"ionic_strength": (0.0, 0.5)},
    title="Saturation of a sparingly soluble salt",
)
def salt_saturation(
    cation_molality: Molality,
    anion_molality: Molality,
    ionic_strength: Molality,
    salt: str,
    temperature: Temperature = ROOM,
) -> SaltSaturation:
    """Saturation index and ratio of a salt from the molalities of its free ions, with Davies activity
    coefficients.

    Free ions only: complexes and protonated forms must be taken off first. The product follows the
    temperature by van 't Hoff where the library has the heat of dissolution.
    ``granum.materials.names("salt")`` lists the salts.

    >>> round(salt_saturation(1.04e-5, 1.04e-5, 0.0, salt="barium sulfate").saturation_ratio, 2)
    1.0
    """
    found = session().salt(salt)
    T = temperature
    index = found.saturation_index(cation_molality, anion_molality, ionic_strength, T)
    product = found.product_at(T) + 0.0 * index
    if found.enthalpy_of_dissolution is None:
        limit_active(jnp.abs(T - ROOM) > NEAR, T, "temperature", reason=ONLY_ROOM)
    return SaltSaturation(product, index, 10.0 ** (index / found.ion_count))
