"""The steady balances for one charge: masses where a crystallizer in operation has flows."""

from __future__ import annotations

from typing import NamedTuple

from granum.core import formula
from granum.core.kinds import Energy, Mass, MassFraction, MassRatio, Ratio, Temperature
from granum.crystallization.formulas.balances import crystallizer_balance, crystallizer_balance_library
from granum.crystallization.kinds import SoluteShare


class BatchBalance(NamedTuple):
    """What one charge gives."""

    crystal_mass: Mass
    mother_liquor_mass: Mass
    yield_fraction: Ratio


@formula(
    source="mullin2001, ch. 8; geankoplis2003, sec. 12.11",
    equation=r"m_c = \frac{m x_A - (m - m_v)\,x_L}{x_c - x_L},\quad x_L = \frac{C^*}{1+C^*}",
    title="Crystals and mother liquor from one charge",
    typical={
        "mass": (1.0, 10.0),
        "solute_mass_fraction": (0.3, 0.4),
        "solubility_per_solvent": (0.1, 0.3),
        "solute_fraction_of_crystal": (0.55, 1.0),
        "evaporated_mass": (0.0, 0.05),
    },
    symbols={"solute_mass_fraction": "x_A"},
)
def crystallizer_batch_balance(
    mass: Mass,
    solute_mass_fraction: MassFraction,
    solubility_per_solvent: MassRatio,
    solute_fraction_of_crystal: SoluteShare = 1.0,
    evaporated_mass: Mass = 0.0,
) -> BatchBalance:
    """Crystals, mother liquor and yield of a charge that is left in equilibrium, hydrates and evaporation
    included.

    Compositions are of anhydrous solute. Potassium chloride of Coulson and Richardson, saturated at 360 K and
    cooled to 290 K: 534 kg of 1500 kg.

    >>> out = crystallizer_batch_balance(
    ...     mass="4301 kg", solute_mass_fraction=53.55 / 153.55, solubility_per_solvent="34.5 g/100 g"
    ... )
    >>> round(out.crystal_mass)
    534
    """
    found = crystallizer_balance.function(
        mass, solute_mass_fraction, solubility_per_solvent, solute_fraction_of_crystal, evaporated_mass
    )
    return BatchBalance(*found)


class KnownSoluteBatch(NamedTuple):
    """What one charge gives, of a solute of the library."""

    crystal_mass: Mass
    mother_liquor_mass: Mass
    yield_fraction: Ratio
    solubility_per_solvent: MassRatio
    crystal_per_solute: Ratio
    heat_supplied: Energy


@formula(
    source="mullin2001, ch. 8; geankoplis2003, sec. 12.11",
    equation=r"Q = m_c\,h_c(T) + m_L\,h_L(T) + m_v\,h_v(T) - m\,h(x, T_1)",
    title="Crystals and heat from one charge of a solute of the library",
    typical={
        "mass": (1.0, 10.0),
        "solute_mass_fraction": (0.3, 0.4),
        "temperature": (280.0, 300.0),
        "temperature_inlet": (330.0, 350.0),
        "evaporated_mass": (0.0, 0.06),
    },
    symbols={"temperature_inlet": "T_1"},
)
def crystallizer_batch_balance_library(
    mass: Mass,
    solute_mass_fraction: MassFraction,
    temperature: Temperature,
    temperature_inlet: Temperature,
    system: str,
    evaporated_mass: Mass = 0.0,
) -> KnownSoluteBatch:
    """Crystals, yield and heat of a charge from the solute's name: solubility, hydrate and heats come from
    the library.

    Heat is negative where it is to be removed. Sodium sulfate of Coulson and Richardson: 722 kg of
    decahydrate from 3000 kg.

    >>> out = crystallizer_batch_balance_library(
    ...     mass=3000,
    ...     solute_mass_fraction=1 / 6,
    ...     temperature=283,
    ...     temperature_inlet=333,
    ...     system="sodium sulfate",
    ...     evaporated_mass=50,
    ... )
    >>> round(out.crystal_mass / 722, 1)
    1.0
    """
    found = crystallizer_balance_library.function(
        mass, solute_mass_fraction, temperature, temperature_inlet, system, evaporated_mass
    )
    return KnownSoluteBatch(*found)
