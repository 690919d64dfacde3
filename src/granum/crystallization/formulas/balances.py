"""Steady balances of a crystallizer in equilibrium: crystals, mother liquor, yield and heat, with hydrates
and vapor.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible, limit_active
from granum.core.kinds import (
    Area,
    Fraction,
    HeatCapacity,
    HeatTransferCoefficient,
    MassFlow,
    MassFraction,
    MassRatio,
    MolarMass,
    PositiveNumber,
    Power,
    Ratio,
    SpecificEnergy,
    Temperature,
    TemperatureDifference,
)
from granum.crystallization.kinds import PositiveTemperatureDifference, SoluteShare
from granum.materials.library import solute
from granum.numerics.smooth import safe_divide, safe_log

NOT_SATURATED = "The solution is not saturated at the end: no crystals form."
NO_LIQUOR = (
    "No mother liquor would be left: too much solvent is evaporated, or the hydrate takes more of it than "
    "there is."
)
COLDER_FEED = "Nothing flashes off: to reach this temperature the feed would have to be heated."
MORE_THAN_FEED = "Crystals and vapor together would be more than the feed."
HYDRATE_LIGHTER = "A hydrate weighs more than its anhydrous solute."
COLD_GIVES_MORE = "Without any evaporation more than this yield crystallizes."
HYDRATE_DISSOLVED = (
    "The saturated solution would hold more solute than the crystal. A solubility in hydrate per water "
    "becomes one of anhydrous solute with "
    "'crystallization.solute_per_solvent_from_hydrate'."
)
BEYOND_THE_DATA = (
    "The solubility is extrapolated: the data of this solute end at a lower temperature, or begin at a "
    "higher one."
)


class Balance(NamedTuple):
    """Flows of a crystallizer."""

    crystal_flow: MassFlow
    mother_liquor_flow: MassFlow
    yield_fraction: Ratio


def _crystals_and_liquor(A: Any, V: Any, x_A: Any, x: Any, x_L: Any) -> tuple[Any, Any, Any]:
    """Crystals, mother liquor and yield of a feed A of mass fraction x_A that loses V of solvent; says which
    states cannot be.
    """
    richer = x_L >= x
    raw = (A * x_A - (A - V) * x_L) / jnp.where(richer, 1.0, x - x_L)
    crystals = jnp.maximum(raw, 0.0)
    liquor = A - V - crystals
    none_left = liquor < -1e-9 * A
    impossible(
        richer,
        x_L / (1.0 - x_L),
        "solubility_per_solvent",
        0.0,
        x / jnp.maximum(1.0 - x, 1e-300),
        reason=HYDRATE_DISSOLVED,
    )
    impossible(none_left, liquor, "mother_liquor_flow", reason=NO_LIQUOR)
    limit_active(raw < 0, raw, "crystal_flow", reason=NOT_SATURATED)
    crystals = jnp.where(richer | none_left, jnp.nan, crystals)
    return crystals, A - V - crystals, safe_divide(crystals * x, A * x_A)


@formula(
    source="mullin2001, ch. 3; geankoplis2003, sec. 12.11",
    equation=r"x_c = \frac{M}{M_h}",
    typical={"molar_mass": (0.05, 0.15), "hydrate_molar_mass": (0.15, 0.35)},
)
def solute_fraction_of_crystal(molar_mass: MolarMass, hydrate_molar_mass: MolarMass) -> Ratio:
    """Mass fraction of anhydrous solute in a hydrated crystal.

    >>> round(solute_fraction_of_crystal(molar_mass="105.99 g/mol", hydrate_molar_mass="286.14 g/mol"), 4)
    0.3704
    """
    impossible(
        molar_mass > hydrate_molar_mass,
        hydrate_molar_mass,
        "hydrate_molar_mass",
        molar_mass,
        jnp.inf,
        HYDRATE_LIGHTER,
    )
    return molar_mass / hydrate_molar_mass


@formula(
    source="geankoplis2003, sec. 12.11; mullin2001, ch. 8",
    equation=r"C = \frac{A x_A - (A - V)\,x_L}{x_c - x_L},\quad x_L = \frac{C^*}{1+C^*}",
    title="Crystals and mother liquor of a crystallizer at equilibrium",
    typical={
        "mass_flow": (0.5, 5.0),
        "solute_mass_fraction": (0.3, 0.4),
        "solubility_per_solvent": (0.1, 0.3),
        "solute_fraction_of_crystal": (0.55, 1.0),
        "evaporation": (0.0, 0.05),
    },
    symbols={"mass_flow": "A", "solute_mass_fraction": "x_A", "evaporation": "V"},
)
def crystallizer_balance(
    mass_flow: MassFlow,
    solute_mass_fraction: MassFraction,
    solubility_per_solvent: MassRatio,
    solute_fraction_of_crystal: SoluteShare = 1.0,
    evaporation: MassFlow = 0.0,
) -> Balance:
    """Crystals, mother liquor and yield of a crystallizer that leaves a saturated solution, hydrates and
    evaporation included.

    Compositions are of anhydrous solute. No crystals where the feed is not saturated at the final conditions.
    Sodium carbonate decahydrate, 10 000 kg of 30 % solution cooled to 20 °C (21.5 kg per 100 kg of water),
    gives 6370 kg in the print.

    >>> out = crystallizer_balance(
    ...     mass_flow=10000,
    ...     solute_mass_fraction=0.30,
    ...     solubility_per_solvent=0.215,
    ...     solute_fraction_of_crystal=106.0 / 286.2,
    ... )
    >>> round(out.crystal_flow), round(out.mother_liquor_flow)
    (6362, 3638)
    """
    A, V, x = mass_flow, evaporation, solute_fraction_of_crystal
    x_L = solubility_per_solvent / (1.0 + solubility_per_solvent)
    return Balance(*_crystals_and_liquor(A, V, solute_mass_fraction, x, x_L))


@formula(
    source="geankoplis2003, sec. 12.11; mullin2001, ch. 8",
    title="Heat duty of a crystallizer",
    equation=r"\dot Q = \dot m c_{p} (T - T_1) - C q_c + \dot m_v L_v",
    output="heat_duty",
    typical={
        "mass_flow": (2.0, 10.0),
        "temperature_inlet": (330.0, 350.0),
        "temperature": (280.0, 300.0),
        "crystal_flow": (0.1, 1.0),
        "evaporation": (0.0, 0.2),
    },
    symbols={"temperature_inlet": "T_1"},
)
def heat_duty_crystallizer(
    mass_flow: MassFlow,
    specific_heat_capacity: HeatCapacity,
    temperature_inlet: Temperature,
    temperature: Temperature,
    crystal_flow: MassFlow,
    heat_released_per_crystal: SpecificEnergy,
    evaporation: MassFlow = 0.0,
    heat_of_vaporization: SpecificEnergy = 2.4e6,
) -> Power:
    """Heat to be supplied to a crystallizer (negative: to be removed), with the latent heat of the vapor.

    The feed is brought to the final temperature, where crystals form (``heat_released_per_crystal`` per kg of
    crystal, positive when released) and solvent evaporates. Epsom salt of Geankoplis: 2268 kg/h from 54.4 to
    20 °C with 616.9 kg/h of crystals, −261.9 MJ/h.

    >>> q = heat_duty_crystallizer(
    ...     mass_flow="2268 kg/hour",
    ...     specific_heat_capacity="2.93 kJ/(kg*K)",
    ...     temperature_inlet=327.6,
    ...     temperature=293.2,
    ...     crystal_flow="616.9 kg/hour",
    ...     heat_released_per_crystal="54.0 kJ/kg",
    ... )
    >>> round(q * 3600 / 1e6, 1)
    -261.9
    """
    left = mass_flow - evaporation
    impossible(crystal_flow > left * (1.0 + 1e-12), crystal_flow, "crystal_flow", 0.0, left, MORE_THAN_FEED)
    sensible = mass_flow * specific_heat_capacity * (temperature - temperature_inlet)
    return sensible - crystal_flow * heat_released_per_crystal + evaporation * heat_of_vaporization


class FlashBalance(NamedTuple):
    """Flows of an adiabatic vacuum crystallizer."""

    evaporation: MassFlow
    crystal_flow: MassFlow
    mother_liquor_flow: MassFlow
    yield_fraction: Ratio


@formula(
    source="mullin2001, ch. 8; richardson2002, ch. 15",
    equation=(
        r"V = \frac{q_c C_0 + A c_p (T_A - T_L)}{L_v - q_c\,x_L/(x_c - x_L)},\quad C_0 = A\frac{x_A - "
        r"x_L}{x_c - x_L},\quad x_L = \frac{C^*}{1 + C^*}"
    ),
    title="Adiabatic vacuum crystallizer at equilibrium",
    typical={
        "mass_flow": (0.5, 5.0),
        "solute_mass_fraction": (0.35, 0.4),
        "solubility_per_solvent": (0.2, 0.4),
        "solute_fraction_of_crystal": (0.55, 1.0),
        "temperature_inlet": (340.0, 360.0),
        "temperature": (290.0, 310.0),
    },
    symbols={
        "mass_flow": "A",
        "solute_mass_fraction": "x_A",
        "temperature_inlet": "T_A",
        "temperature": "T_L",
        "evaporation": "V",
    },
)
def vacuum_crystallizer_balance(
    mass_flow: MassFlow,
    solute_mass_fraction: MassFraction,
    solubility_per_solvent: MassRatio,
    temperature_inlet: Temperature,
    temperature: Temperature,
    specific_heat_capacity: HeatCapacity,
    heat_released_per_crystal: SpecificEnergy,
    heat_of_vaporization: SpecificEnergy,
    solute_fraction_of_crystal: SoluteShare = 1.0,
) -> FlashBalance:
    """Solvent flashed off and crystals made when a hot feed flashes adiabatically to a temperature, hydrates
    included.

    Sensible heat and heat of crystallization evaporate solvent, which makes more crystals: one linear
    equation. ``heat_released_per_crystal`` is per kg of crystal. Sodium acetate of Mullin: 2000 kg/h of 40 %
    solution from 80 to 29 °C evaporates 0.153 kg per kg of feed water.

    >>> out = vacuum_crystallizer_balance(
    ...     mass_flow=2000,
    ...     solute_mass_fraction=0.4,
    ...     solubility_per_solvent=0.539,
    ...     temperature_inlet=353.15,
    ...     temperature=302.15,
    ...     specific_heat_capacity=3500,
    ...     heat_released_per_crystal=144e3,
    ...     heat_of_vaporization=2.46e6,
    ...     solute_fraction_of_crystal=82.0 / 136.0,
    ... )
    >>> round(out.evaporation / 1200, 3), round(out.crystal_flow)
    (0.153, 648)
    """
    A, x = mass_flow, solute_fraction_of_crystal
    x_L = solubility_per_solvent / (1.0 + solubility_per_solvent)
    q, L = heat_released_per_crystal, heat_of_vaporization
    sensible = A * specific_heat_capacity * (temperature_inlet - temperature)
    dry = A * (solute_mass_fraction - x_L) / (x - x_L)
    V = (q * dry + sensible) / (L - q * x_L / (x - x_L))
    V = jnp.where(A * solute_mass_fraction > (A - V) * x_L, V, sensible / L)  # no crystals, no heat of theirs
    impossible(V < 0.0, V, "evaporation", reason=COLDER_FEED)
    return FlashBalance(V, *_crystals_and_liquor(A, V, solute_mass_fraction, x, x_L))


@formula(
    source="mullin2001, ch. 8; geankoplis2003, sec. 12.11",
    equation=(
        r"\dot m_v = \dot m\left(1 - \frac{R x_A}{x_c} - \frac{(1-R)\,x_A}{x_L}\right),\quad x_L = "
        r"\frac{C^*}{1+C^*}"
    ),
    output="evaporation",
    title="Evaporation for a yield",
    typical={
        "mass_flow": (0.5, 5.0),
        "yield_fraction": (0.75, 0.9),
        "solute_mass_fraction": (0.15, 0.2),
        "solubility_per_solvent": (0.3, 0.4),
    },
    symbols={"solute_mass_fraction": "x_A"},
)
def evaporation_for_yield(
    mass_flow: MassFlow,
    yield_fraction: Fraction,
    solute_mass_fraction: MassFraction,
    solubility_per_solvent: PositiveNumber,
    solute_fraction_of_crystal: SoluteShare = 1.0,
) -> MassFlow:
    """Solvent to be evaporated so that a given share of the solute crystallizes and leaves a saturated mother
    liquor.

    Not possible (no value) where cooling alone gives more. Brine of 20 % at 80 °C (38.4 kg per 100 kg of
    water): 70 % of the salt takes 644 kg per tonne.

    >>> round(
    ...     evaporation_for_yield(
    ...         mass_flow=1000,
    ...         yield_fraction=0.7,
    ...         solute_mass_fraction=0.2,
    ...         solubility_per_solvent="38.4 g/100 g",
    ...     )
    ... )
    644
    """
    x_L = solubility_per_solvent / (1.0 + solubility_per_solvent)
    left = 1.0 - solute_mass_fraction * (
        yield_fraction / solute_fraction_of_crystal + (1.0 - yield_fraction) / x_L
    )
    impossible(left < 0, mass_flow * left, "evaporation", reason=COLD_GIVES_MORE)
    return jnp.where(left >= 0, mass_flow * left, jnp.nan)


class KnownSoluteBalance(NamedTuple):
    """Flows and duty of a crystallizer whose solute is in the library."""

    crystal_flow: MassFlow
    mother_liquor_flow: MassFlow
    yield_fraction: Ratio
    solubility_per_solvent: MassRatio
    crystal_per_solute: Ratio
    heat_duty: Power


@formula(
    source="geankoplis2003, sec. 12.11; mullin2001, ch. 8",
    equation=r"\dot Q = C\,h_c(T) + L\,h_L(T) + \dot m_v\,h_v(T) - \dot m\,h(x, T_1)",
    title="Crystallizer at equilibrium for a solute of the library",
    typical={
        "mass_flow": (0.5, 5.0),
        "solute_mass_fraction": (0.3, 0.4),
        "temperature": (280.0, 300.0),
        "temperature_inlet": (330.0, 350.0),
        "evaporation": (0.0, 0.05),
    },
    symbols={"temperature_inlet": "T_1"},
)
def crystallizer_balance_library(
    mass_flow: MassFlow,
    solute_mass_fraction: MassFraction,
    temperature: Temperature,
    temperature_inlet: Temperature,
    system: str,
    evaporation: MassFlow = 0.0,
) -> KnownSoluteBalance:
    """Crystals, mother liquor, yield and heat duty from the solute's name: solubility, hydrate and heats come
    from the library.

    The feed is a solution of the given mass fraction of anhydrous solute; heat is supplied where the duty is
    positive, and the vapor leaves at the temperature of the crystallizer. The duty is missing where the
    library has no heat of solution.

    >>> out = crystallizer_balance_library(
    ...     mass_flow="3000 kg/h",
    ...     solute_mass_fraction=1 / 6,
    ...     temperature=283.15,
    ...     temperature_inlet=333.15,
    ...     system="sodium sulfate",
    ...     evaporation="50 kg/h",
    ... )
    >>> round(out.crystal_flow * 3600 / 722, 2)
    0.99
    """
    s = solute(system)
    A, w, T, hot = mass_flow, solute_mass_fraction, temperature, temperature_inlet
    R = s.hydrate_ratio(T)
    ratio = s.solubility(T)
    low, high = s.data_range
    without_liquor = ((low > T) | (high < T)) & (ratio * R >= 1.0 + ratio)
    impossible(without_liquor, T, "temperature", low, high, reason=BEYOND_THE_DATA)
    found = crystallizer_balance.function(A, w, ratio, 1.0 / R, evaporation)
    if all(b.heat_given for b in s.branches):
        water, salt = s.solvent.liquid_enthalpy, s.solute_enthalpy
        sensible = A * (w * (salt(T) - salt(hot)) + (1.0 - w) * (water(T) - water(hot)))
        grown = found.crystal_flow / R  # without what a hydrate binds
        left = A * w - grown, A * (1.0 - w) - evaporation - (R - 1.0) * grown
        duty = (
            sensible
            + s.heat_of_mixing(T, *left)
            - s.heat_of_mixing(hot, A * w, A * (1.0 - w))
            - grown * s.crystal_depth(T)
            + evaporation * s.solvent.heat_of_vaporization(T)
        )
    else:
        duty = jnp.nan + 0.0 * found.crystal_flow
    return KnownSoluteBalance._make((*found, ratio, R, duty))


@formula(
    source="kern1950, ch. 5",
    equation=r"\Delta T_{lm} = \frac{\Delta T_1 - \Delta T_2}{\ln(\Delta T_1/\Delta T_2)}",
    typical={"temperature_difference_inlet": (10.0, 30.0), "temperature_difference_outlet": (3.0, 9.0)},
    symbols={"temperature_difference_inlet": r"\Delta T_1", "temperature_difference_outlet": r"\Delta T_2"},
)
def log_mean_temperature_difference(
    temperature_difference_inlet: PositiveTemperatureDifference,
    temperature_difference_outlet: PositiveTemperatureDifference,
) -> TemperatureDifference:
    """Logarithmic mean of the temperature differences at both ends of a jacket or cooler.

    >>> round(
    ...     log_mean_temperature_difference(
    ...         temperature_difference_inlet=20.0, temperature_difference_outlet=10.0
    ...     ),
    ...     3,
    ... )
    14.427
    """
    a, b = temperature_difference_inlet, temperature_difference_outlet
    ratio = a / b
    near = jnp.abs(ratio - 1.0) < 1e-4
    e = ratio - 1.0
    closed = (a - b) / jnp.where(near, 1.0, safe_log(jnp.where(near, 2.0, ratio)))
    return jnp.where(near, b * (1.0 + e / 2.0 - e**2 / 12.0), closed)


@formula(
    source="mullin2001, ch. 8; kern1950, ch. 20",
    title="Cooling surface of a jacket",
    equation=(
        r"A = \frac{|\dot Q|}{h\,\Delta T_{lm}},\quad \Delta T_{lm} = \frac{\Delta T_1 - \Delta "
        r"T_2}{\ln(\Delta T_1/\Delta T_2)}"
    ),
    output="area",
    typical={"heat_duty": (1e4, 1e6)},
    symbols={"temperature_difference_inlet": r"\Delta T_1", "temperature_difference_outlet": r"\Delta T_2"},
)
def area_jacket(
    heat_duty: Power,
    heat_transfer_coefficient: HeatTransferCoefficient,
    temperature_difference_inlet: PositiveTemperatureDifference,
    temperature_difference_outlet: PositiveTemperatureDifference,
) -> Area:
    """Cooling surface for a heat duty, by the logarithmic mean temperature difference between suspension and
    coolant.

    >>> round(
    ...     area_jacket(
    ...         heat_duty=-100e3,
    ...         heat_transfer_coefficient=500,
    ...         temperature_difference_inlet=20,
    ...         temperature_difference_outlet=10,
    ...     ),
    ...     2,
    ... )
    13.86
    """
    mean = log_mean_temperature_difference(temperature_difference_inlet, temperature_difference_outlet)
    return jnp.abs(heat_duty) / (heat_transfer_coefficient * mean)


@formula(
    source="mullin2001, ch. 8",
    title="Yield of an anhydrous crystal",
    equation=r"R = 1 - \frac{C^* (W - V)}{C W}",
    output="yield_fraction",
    typical={"solute_per_solvent": (0.4, 0.6), "solubility_per_solvent": (0.2, 0.3)},
)
def yield_fraction_anhydrous(
    solute_per_solvent: MassRatio, solubility_per_solvent: MassRatio, evaporated_fraction: Fraction = 0.0
) -> Ratio:
    """Largest yield of an anhydrous crystal by cooling and evaporating a fraction of the solvent.

    >>> round(
    ...     yield_fraction_anhydrous(
    ...         solute_per_solvent=0.5, solubility_per_solvent=0.2, evaporated_fraction=0.1
    ...     ),
    ...     2,
    ... )
    0.64
    """
    dissolved = solubility_per_solvent * (1.0 - evaporated_fraction)
    limit_active(
        dissolved > solute_per_solvent, solute_per_solvent, "solute_per_solvent", reason=NOT_SATURATED
    )
    return jnp.maximum(1.0 - dissolved / solute_per_solvent, 0.0)
