"""Solubility of weak acids and bases against pH: the un-ionized form crystallizes, ions dissolve along."""

from __future__ import annotations

from typing import Annotated, Literal, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import formula, law
from granum.core.kinds import Fraction, MassRatio, MolarConcentration, Number, Temperature, Within
from granum.crystallization.formulas.solubility_laws import SolubilityLaw
from granum.crystallization.kinds import Solubility

Acidity = Annotated[Number, Within(-2.0, 16.0)]
Exponent = Annotated[Number, Within(-10.0, 25.0)]
Group = Literal["acid", "base"]


class IonizedSolubility(NamedTuple):
    """What dissolves at a pH, and how much of it as ions."""

    solubility_total: MolarConcentration
    ionized_fraction: Fraction


@formula(
    source="krebs1945; avdeef2003, eq. 6.4",
    title="Solubility of a weak acid against pH",
    equation=r"S = S_0\left(1 + 10^{\,\mathrm{pH} - \mathrm{p}K_a}\right)",
    output="solubility_ionized",
    typical={
        "ph_value": (2.0, 8.0),
        "acid_exponent": (3.0, 5.0),
        "intrinsic_solubility": (0.01, 30.0),
    },
)
def solubility_weak_acid(
    ph_value: Acidity, acid_exponent: Exponent, intrinsic_solubility: MolarConcentration
) -> IonizedSolubility:
    """Solubility of a weak acid from that of its un-ionized form, over which the solution stays saturated.

    Ideal: concentrations stand for activities, and nothing aggregates. It rises tenfold per unit of pH above
    the exponent, until the salt crystallizes in place of the acid (``ph_limit_salt``). Phenobarbital of
    0.005 mol/L and exponent 7.4 dissolves 0.00625 mol/L at pH 6.8.

    >>> found = solubility_weak_acid(6.8, 7.4, "0.005 mol/L")
    >>> round(found.solubility_total / 1000, 5)
    0.00626
    """
    ions = 10.0 ** (ph_value - acid_exponent)
    return IonizedSolubility(intrinsic_solubility * (1.0 + ions), ions / (1.0 + ions))


@formula(
    source="krebs1945; avdeef2003, eq. 6.4",
    title="Solubility of a weak base against pH",
    equation=r"S = S_0\left(1 + 10^{\,\mathrm{p}K_b - \mathrm{pH}}\right)",
    output="solubility_ionized",
    typical={
        "ph_value": (6.0, 11.0),
        "base_exponent": (8.0, 10.0),
        "intrinsic_solubility": (0.001, 10.0),
    },
)
def solubility_weak_base(
    ph_value: Acidity, base_exponent: Exponent, intrinsic_solubility: MolarConcentration
) -> IonizedSolubility:
    """Solubility of a weak base from that of its un-ionized form, over which the solution stays saturated.

    The exponent is that of the protonated base. Ideal, as for a weak acid. Verapamil of 4.51e-5 mol/L and
    exponent 9.15: ten times the solubility is reached 0.95 below the exponent.

    >>> round(solubility_weak_base(9.15 - 0.954, 9.15, "4.51e-5 mol/L").solubility_total / 0.0451, 1)
    10.0
    """
    ions = 10.0 ** (base_exponent - ph_value)
    return IonizedSolubility(intrinsic_solubility * (1.0 + ions), ions / (1.0 + ions))


@formula(
    source="avdeef2003, eq. 6.7",
    title="Solubility of an ampholyte against pH",
    equation=(
        r"S = S_0\left(1 + 10^{\,\mathrm{pH} - \mathrm{p}K_{a}} + 10^{\,\mathrm{p}K_{b} - \mathrm{pH}}\right)"
    ),
    output="solubility_ionized",
    typical={
        "ph_value": (4.0, 11.0),
        "acid_exponent": (8.0, 10.0),
        "base_exponent": (2.0, 6.5),
        "intrinsic_solubility": (0.01, 100.0),
    },
)
def solubility_ampholyte(
    ph_value: Acidity,
    acid_exponent: Exponent,
    base_exponent: Exponent,
    intrinsic_solubility: MolarConcentration,
) -> IonizedSolubility:
    """Solubility of a substance with an acid and a basic group: least halfway between the two exponents.

    The un-ionized form counts zwitterions along; the base exponent is that of the protonated base.
    Ciprofloxacin, with 8.62 as an acid and 6.16 as a base, dissolves least at pH 7.39.

    >>> least = [solubility_ampholyte(pH, 8.62, 6.16, "1.9e-4 mol/L").solubility_total for pH in (7, 7.39, 8)]
    >>> least[1] < min(least[0], least[2])
    True
    """
    ions = 10.0 ** (ph_value - acid_exponent) + 10.0 ** (base_exponent - ph_value)
    return IonizedSolubility(intrinsic_solubility * (1.0 + ions), ions / (1.0 + ions))


@formula(
    source="kramer1972",
    title="pH at which a weak acid or base gives way to its salt",
    equation=r"\mathrm{pH}_{max} = \mathrm{p}K_a \pm \log_{10}\frac{S_s}{S_0}",
    output="ph_limit",
    typical={
        "acid_exponent": (3.0, 5.0),
        "intrinsic_solubility": (0.01, 30.0),
        "salt_solubility": (100.0, 3000.0),
    },
    symbols={"ph_limit": r"\mathrm{pH}_{max}"},
)
def ph_limit_salt(
    acid_exponent: Exponent,
    intrinsic_solubility: MolarConcentration,
    salt_solubility: MolarConcentration,
    ionizable_group: Group = "acid",
) -> Number:
    """pH beyond which the salt crystallizes and no longer the un-ionized form; both are saturated there, and
    nothing dissolves more.

    The salt's solubility is that of its ion at the counter-ion of the solution. Where both curves cross,
    S0 (1 + r) equals Ss (1 + 1/r). For a base, exponent and sign are those of its protonated form. The paper
    was not opened; the crossing is derived.

    >>> round(ph_limit_salt(4.42, "1e-5 mol/L", "1e-2 mol/L"), 2)
    7.42
    """
    apart = jnp.log10(salt_solubility / intrinsic_solubility)
    return acid_exponent + (apart if ionizable_group == "acid" else -apart)


@law(
    "solubility_law",
    name="ionized_solubility",
    source="krebs1945; avdeef2003, eq. 6.4",
    title="Solubility of a weak acid or base at a pH",
    equation=r"C^* = C_0^*(T)\left(1 + 10^{\pm(\mathrm{pH} - \mathrm{p}K_a)}\right)",
)
class SolubilityAtPh(SolubilityLaw):
    """Solubility of a weak acid or base at a pH that is held, by another law for its un-ionized form.

    Ions count as the un-ionized form that they come from; the salt must not crystallize, and exponent and pH
    do not follow the temperature.
    """

    solubility: Solubility
    ph_value: Acidity
    acid_exponent: Exponent
    ionizable_group: Group = eqx.field(static=True, default="acid")

    def __call__(self, temperature: Temperature) -> MassRatio:
        above = self.ph_value - self.acid_exponent
        ions = 10.0 ** (above if self.ionizable_group == "acid" else -above)
        return self.solubility(temperature) * (1.0 + ions)
