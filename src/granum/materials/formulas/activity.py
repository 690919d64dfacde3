"""Water activity of solutions: electrolytes by Pitzer's equation, sucrose by Starzak and Peacock, the rest by
Raoult's law.
"""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import GAS_CONSTANT
from granum.core.kinds import (
    Kind,
    Molality,
    MolarEnergy,
    MoleFraction,
    Number,
    PositiveNumber,
    Temperature,
    WaterActivity,
    Within,
)

WATER = 0.01801528  # kg/mol
SLOPE = (
    0.336901532,
    -6.32100430e-4,
    9.14252359,
    -1.35143986e-2,
    2.26089488e-3,
    1.92118597e-6,
    45.2586464,
    0.0,
)
_Q, _A, _B = -17638.0, -1.0038, -0.24653
ROOM = 298.15
DISTANCE = 1.2  # (kg/mol)^0.5, Pitzer's for all ions
Charge = Annotated[PositiveNumber, Within(1.0, 4.0)]
Count = Annotated[PositiveNumber, Within(1.0, 4.0)]
SolubilitySlope = Annotated[
    Any, Kind("relative change of a solubility with temperature", "1/K", display=("%/K", "1/K"))
]
Waters = Annotated[Number, Within(0.0, 24.0)]


TERMS = 10  # of a parameter over temperature


def over_temperature(T: Any, a: Any) -> Any:
    """A parameter over temperature: eight terms of Møller and Greenberg, then Appelo's and Steiger's."""
    terms = (
        1.0,
        T,
        1.0 / T,
        jnp.log(T),
        1.0 / (T - 263.0),
        T**2,
        1.0 / (680.0 - T),
        1.0 / (T - 227.0),
        1.0 / T**2,
        jnp.log(T - 225.0),
    )
    return sum(coefficient * term for coefficient, term in zip(a, terms, strict=False))


def slope_over_temperature(T: Any, a: Any) -> Any:
    """By how much that changes with temperature."""
    terms = (
        0.0,
        1.0,
        -1.0 / T**2,
        1.0 / T,
        -1.0 / (T - 263.0) ** 2,
        2.0 * T,
        1.0 / (680.0 - T) ** 2,
        -1.0 / (T - 227.0) ** 2,
        -2.0 / T**3,
        1.0 / (T - 225.0),
    )
    return sum(coefficient * term for coefficient, term in zip(a, terms, strict=False))


def fading(x: Any) -> Any:
    """How a second virial coefficient of the excess energy fades with ionic strength."""
    return 2.0 * (1.0 - (1.0 + x) * jnp.exp(-x)) / x**2


def usual_exponents(one_charge: float, other_charge: float) -> tuple[float, float]:
    """Those with which Pitzer's coefficients fade for two charges without sign: two ions with charges of two
    or more pair.
    """
    return (1.4 if min(one_charge, other_charge) >= 2 else 2.0), 12.0


def osmotic_coefficient(
    m: Any, T: Any, sets: Any, counts: Any, charges: Any, exponents: tuple[Any, Any]
) -> Any:
    """By Pitzer's equation, from beta zero, one, two and C, and the exponents of the middle two."""
    (nc, na), (zc, za), (zero, one, two, c) = counts, charges, sets
    nu = nc + na
    root = jnp.sqrt(jnp.maximum(0.5 * m * (nc * zc**2 + na * za**2), 1e-24))
    second = zero + one * jnp.exp(-exponents[0] * root) + two * jnp.exp(-exponents[1] * root)
    return (
        1.0
        - zc * za * debye_huckel_slope(T) * root / (1.0 + DISTANCE * root)
        + m * 2.0 * nc * na / nu * second
        + m**2 * 2.0 * (nc * na) ** 1.5 / nu * c
    )


@formula(
    source="moller1988, eq. 13, as transcribed in pytzer",
    equation=(
        r"A_\phi = a_1 + a_2T + \frac{a_3}{T} + a_4\ln T + \frac{a_5}{T-263} + a_6T^2 + "
        r"\frac{a_7}{680-T}"
    ),
    fitted={"temperature": (273.15, 573.15)},
    title="Debye–Hückel slope of the osmotic coefficient in water (Møller)",
)
def debye_huckel_slope(temperature: Temperature) -> PositiveNumber:
    """Debye–Hückel slope for osmotic coefficients in water at its vapor pressure, (kg/mol)^0.5.

    >>> round(debye_huckel_slope(temperature=298.15), 4)
    0.3915
    """
    return over_temperature(temperature, SLOPE)


@formula(
    source="pitzer1973; pitzer1974; moller1988",
    equation=(
        r"\phi = 1 - z_cz_a\frac{A_\phi(T)\sqrt I}{1+1.2\sqrt I} + m\frac{2pq}{p+q}\left(\beta_0 + "
        r"\beta_1e^{-\alpha\sqrt I} + \beta_2e^{-12\sqrt I}\right) + m^2\frac{2(pq)^{3/2}}{p+q}C_\phi,"
        r"\quad I = \frac m2\left(p z_c^2 + q z_a^2\right)"
    ),
    typical={"salt_molality": (0.1, 6.0)},
    title="Osmotic coefficient of an electrolyte (Pitzer)",
)
def osmotic_coefficient_pitzer(
    salt_molality: Molality,
    pitzer_beta_zero: Number,
    pitzer_beta_one: Number,
    pitzer_c: Number,
    temperature: Temperature = ROOM,
    cation_count: Count = 1.0,
    anion_count: Count = 1.0,
    cation_charge_number: Charge = 1.0,
    anion_charge_number: Charge = 1.0,
    pitzer_beta_two: Number = 0.0,
) -> Number:
    """Osmotic coefficient of one salt in water by Pitzer's equation, charges without sign.

    The exponent α is 2, for two ions of charge 2 or more 1.4; these pair, which their β₂ takes up.

    Sodium chloride at 25 °C with Pitzer and Mayorga's coefficients, 6 mol/kg: 1.271 in Robinson and Stokes'
    table.

    >>> round(osmotic_coefficient_pitzer(6.0, 0.0765, 0.2664, 0.00127), 2)
    1.27
    """
    zc, za = cation_charge_number, anion_charge_number
    pairing = jnp.minimum(zc, za) >= 2.0
    return osmotic_coefficient(
        salt_molality,
        temperature,
        (pitzer_beta_zero, pitzer_beta_one, pitzer_beta_two, pitzer_c),
        (cation_count, anion_count),
        (zc, za),
        (jnp.where(pairing, 1.4, 2.0), 12.0),
    )


@formula(
    source="pitzer1973",
    equation=r"a_w = \exp\left(-\nu\,m\,M_w\,\phi\right)",
    typical={"salt_molality": (0.1, 6.0), "osmotic_coefficient": (0.7, 1.3)},
    title="Water activity from the osmotic coefficient",
)
def water_activity_osmotic(
    salt_molality: Molality,
    osmotic_coefficient: Number,
    ion_count: Annotated[PositiveNumber, Within(1.0, 8.0)],
) -> WaterActivity:
    """Activity of water over a solution of known osmotic coefficient; 1 for a solute that does not
    dissociate.

    Saturated sodium chloride at 25 °C, 6.1 mol/kg, holds 75 % relative humidity.

    >>> round(water_activity_osmotic(salt_molality=6.144, osmotic_coefficient=1.278, ion_count=2.0), 2)
    0.75
    """
    return jnp.exp(-ion_count * salt_molality * WATER * osmotic_coefficient)


@formula(
    source="starzak1997",
    equation=r"a_w = (1-x_m)\exp\left[\frac{Q}{RT}\,x_m^2\left(1 + a x_m + b x_m^2\right)\right]",
    typical={"solute_mole_fraction": (0.0, 0.2), "temperature": (298.15, 393.15)},
    title="Water activity of a sucrose solution (Starzak and Peacock)",
)
def water_activity_starzak_peacock(
    solute_mole_fraction: MoleFraction, temperature: Temperature
) -> WaterActivity:
    """Water activity of sucrose in water, the activity coefficient fitted to a century of data at all
    concentrations.

    Saturated syrup at 25 °C (67.9 %) holds about 85 % relative humidity.

    >>> round(water_activity_starzak_peacock(solute_mole_fraction=0.1002, temperature=298.15), 2)
    0.84
    """
    x = solute_mole_fraction
    return (1.0 - x) * jnp.exp(_Q / (GAS_CONSTANT * temperature) * x**2 * (1.0 + _A * x + _B * x**2))


@formula(
    source="raoult1887",
    equation=r"a_s = \frac{1-x_m}{1-x_m+\nu x_m}",
    fitted={"solute_mole_fraction": (0.0, 0.01)},
    title="Activity of a solvent by Raoult's law",
)
def solvent_activity_raoult(
    solute_mole_fraction: MoleFraction, ion_count: Annotated[PositiveNumber, Within(1.0, 8.0)] = 1.0
) -> WaterActivity:
    """Activity of the solvent of an ideal solution: its mole fraction, where each ion counts as a molecule.

    The law of dilute solutions; an estimate beyond. In saturated solutions at 25 °C urea and sodium nitrate
    come within 0.03 of what is measured, potassium nitrate 0.05 too low and sodium hydroxide far too high.

    >>> round(solvent_activity_raoult(solute_mole_fraction=0.01, ion_count=1.0), 2)
    0.99
    """
    x = solute_mole_fraction
    return (1.0 - x) / (1.0 - x + ion_count * x)


@formula(
    source="williamson1944; konig1985",
    equation=(
        r"\Delta H = R T^2\left(1 - n M_w m\right)\Lambda\,s_T,\quad "
        r"\Lambda = \nu\frac{\mathrm d(m\phi)}{\mathrm dm},\quad "
        r"s_T = \frac{1}{m}\frac{\mathrm dm}{\mathrm dT}"
    ),
    typical={"salt_molality": (0.5, 6.0)},
    title="Heat of solution at saturation from the solubility (Williamson)",
)
def enthalpy_of_dissolution_williamson(
    temperature: Temperature,
    salt_molality: Molality,
    solubility_relative_slope: SolubilitySlope,
    osmotic_slope: Annotated[Number, Within(0.0, 60.0)] = 2.0,
    bound_water: Waters = 0.0,
) -> MolarEnergy:
    """Heat that a mole of crystal takes up as it dissolves in its saturated solution: with its sign changed,
    the heat of crystallization.

    It is the change of the equilibrium with temperature, so that it needs no calorimeter: the slope of the
    solubility along saturation, and how the osmotic coefficient changes with concentration at one
    temperature. The latter is the number of particles of a molecule in an ideal solution, and this then van
    't Hoff's equation. A crystal with n molecules of water brings them along. What dissolves better when warm
    takes up heat as it dissolves. A slope of the solubility that is wrong by 0.1 % per kelvin makes some 2
    kJ/mol.

    Potassium chloride at 25 °C: Robinson and Stokes' osmotic coefficients (0.965, 0.980 and 0.989 at 4.0, 4.5
    and 4.81 mol/kg) and solubilities of 34.2 g in 100 g of water at 20 °C and 37.2 at 30 °C give 14.0 kJ/mol;
    calorimetry 13.8; at infinite dilution it is 17.2.

    >>> found = enthalpy_of_dissolution_williamson("25 degC", 4.77, 0.00841, 2.256)
    >>> round(found / 1e3, 1)
    14.0
    """
    T, m = temperature, salt_molality
    return GAS_CONSTANT * T**2 * (1.0 - bound_water * WATER * m) * osmotic_slope * solubility_relative_slope
