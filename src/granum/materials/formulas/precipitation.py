"""Sparingly soluble salts: activity coefficients and the solutions that solubility products give."""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import ZERO_CELSIUS
from granum.core.kinds import Fraction, Molality, Number, PositiveNumber, Series, Temperature

ROOM = 298.15


@formula(
    source="davies1962, ch. 3; malmberg1956",
    equation=(
        r"\log_{10}\gamma = -A z^2\left(\frac{\sqrt I}{1+\sqrt I} - 0.3\,I\right),\quad A = "
        r"1.8246\times10^{6}\,(\epsilon T)^{-3/2}"
    ),
    fitted={"ionic_strength": (0.0, 0.5), "temperature": (273.15, 373.15)},
)
def activity_coefficient_davies(
    charge_number: Number, ionic_strength: Molality, temperature: Temperature = ROOM
) -> PositiveNumber:
    """Activity coefficient of an ion in water from its charge and the ionic strength (mol/kg), with water's
    dielectric constant.

    Within a few percent up to 0.1 mol/kg, a first estimate up to 0.5.

    >>> round(activity_coefficient_davies(charge_number=1.0, ionic_strength=0.1), 2)
    0.78
    """
    t = temperature - ZERO_CELSIUS
    dielectric = 87.740 + t * (-0.40008 + t * (9.398e-4 - 1.410e-6 * t))
    A = 1.8246e6 / (dielectric * temperature) ** 1.5
    root = jnp.sqrt(jnp.maximum(ionic_strength, 1e-16))
    return 10.0 ** (-A * charge_number**2 * (root / (1.0 + root) - 0.3 * ionic_strength))


@formula(
    source="plummer1982, table 1",
    equation=r"\mathrm{p}K_w = 283.971 + 0.05069842\,T - 13323/T - 102.24447 \log_{10}T + 1119669/T^2",
    fitted={"temperature": (273.15, 373.15)},
    typical={"temperature": (280.0, 360.0)},
)
def ionization_exponent_water(temperature: Temperature = ROOM) -> Number:
    """Exponent of the ion product of water on activities, 14.00 at 25 °C: water is the more ionized the
    hotter it is.

    The coefficients were read in the databases that took them over (PHREEQC); the paper was not opened.

    >>> round(ionization_exponent_water(temperature="25 degC"), 2)
    14.0
    """
    T = temperature
    return 283.971 + 0.05069842 * T - 13323.0 / T - 102.24447 * jnp.log10(T) + 1119669.0 / T**2


def hydroxide_molality(net: Any, activity_coefficient: Any, temperature: Any) -> Any:
    """Free hydroxide by the charge balance with the hydrogen ions that water itself gives, mol/kg: ``net`` is
    the hydroxide that all other ions leave to be balanced, negative in an acid.
    """
    product = 10.0 ** -ionization_exponent_water.function(temperature) / activity_coefficient**2
    root = jnp.sqrt(net**2 + 4.0 * product)
    return jnp.where(net > 0.0, 0.5 * (net + root), 2.0 * product / (root + jnp.abs(jnp.minimum(net, 0.0))))


@formula(
    source="haynes2014, sec. 5",
    equation=r"m = \left(\frac{K_{sp}}{p^p q^q}\right)^{1/(p+q)}",
    title="Molality of a salt saturated in pure water",
    typical={"solubility_product": (1e-12, 1e-4)},
    output="salt_molality",
)
def salt_molality_from_product(
    solubility_product: PositiveNumber, cation_count: PositiveNumber = 1.0, anion_count: PositiveNumber = 1.0
) -> Molality:
    """Molality of a salt in the pure water it saturates, ideal solution, no hydrolysis: mol of formula units
    per kg of water.

    >>> round(salt_molality_from_product(1.70e-5, 1.0, 2.0), 4)
    0.0162
    """
    p, q = cation_count, anion_count
    return jnp.exp((jnp.log(solubility_product) - p * jnp.log(p) - q * jnp.log(q)) / (p + q))


@formula(
    source="stumm1996, ch. 3",
    equation=(
        r"\alpha_n = \left[1 + \sum_{k=1}^{n} 10^{\,\sum_{j=n-k+1}^{n} pK_j - " r"k\,\mathrm{pH}}\right]^{-1}"
    ),
    output="deprotonated_fraction",
    typical={"ph_value": (5.0, 11.0)},
    symbols={"deprotonated_fraction": r"\alpha_n"},
)
def deprotonated_fraction(ph_value: Number, acid_exponents: Annotated[Number, Series("steps")]) -> Fraction:
    """Share of a dissolved weak acid that is there as its last anion, from pH and the exponents pK of its
    steps, first step first.

    It turns total carbonate, oxalate or phosphate into the free anion that a solubility product counts.
    Concentration constants at the ionic strength of the solution; ideal where those of infinite dilution are
    used.

    >>> round(float(deprotonated_fraction(ph_value=10.33, acid_exponents=[6.35, 10.33])), 3)
    0.5
    """
    steps = jnp.asarray(acid_exponents)[::-1]
    count = jnp.arange(1, steps.shape[0] + 1)
    powers = jnp.cumsum(steps) - count * jnp.asarray(ph_value)[..., None]
    return 1.0 / (1.0 + jnp.sum(10.0 ** jnp.clip(powers, -300.0, 300.0), axis=-1))
