"""Solubility as a law of temperature: from the materials library, or by the equations that solubility data
are fitted with.

Every law gives kg of anhydrous solute per kg of solvent.
"""

from __future__ import annotations

from abc import abstractmethod
from copy import copy
from typing import Annotated, Any, ClassVar

import equinox as eqx
import jax.numpy as jnp

from granum.core import law
from granum.core.constants import GAS_CONSTANT, ZERO_CELSIUS
from granum.core.kinds import (
    MassFraction,
    MassRatio,
    MolarEnergy,
    MolarMass,
    Number,
    Series,
    Temperature,
)
from granum.crystallization.kinds import MolarEntropy, Solubility
from granum.materials.library import Library, session


class SolubilityLaw(eqx.Module):
    """Saturation against temperature."""

    @abstractmethod
    def __call__(self, temperature: Temperature) -> MassRatio:
        """kg of anhydrous solute per kg of solvent in equilibrium with the crystal."""


@law(
    "solubility_law",
    name="library_solubility",
    source="mullin2001, appendix",
    title="Solubility from the materials library",
    equation=r"C^* = C^*_{library}(T)",
)
class LibrarySolubility(SolubilityLaw):
    """Solubility of a system of the materials library, over its stable crystal or over a named one.

    It is that in the pure solvent; crystallizers in whose liquor other salts are dissolved correct it by
    ``solubility_beside_salt``.

    >>> round(float(LibrarySolubility("potassium nitrate")(293.15)), 2)
    0.32
    """

    solute: str = eqx.field(static=True)
    crystal: str = eqx.field(static=True, default="")
    materials: Library | None = eqx.field(static=True, init=False, default=None)

    def with_materials(self, materials: Library) -> LibrarySolubility:
        """The same law with the materials of a case, which may have a solute of its own."""
        made = copy(self)
        object.__setattr__(made, "materials", materials)
        return made

    def __call__(self, temperature: Temperature) -> MassRatio:
        return (self.materials or session()).solute(self.solute).solubility(temperature, self.crystal or None)


@law(
    "solubility_law",
    name="polynomial_solubility",
    source="mullin2001, ch. 3",
    title="Solubility by a polynomial in °C",
    equation=r"C^* = \sum_k a_k (T - 273.15)^k",
    symbols={"coefficients": "a_k"},
)
class PolynomialSolubility(SolubilityLaw):
    """Solubility as a polynomial in the temperature in degrees Celsius, lowest power first, in kg per kg of
    solvent.

    >>> round(float(PolynomialSolubility([0.13, 0.006, 0.0002])(283.15)), 4)
    0.21
    """

    coefficients: Annotated[Number, Series("powers")]

    def __call__(self, temperature: Temperature) -> MassRatio:
        theta, total = temperature - ZERO_CELSIUS, 0.0
        for a in jnp.asarray(self.coefficients)[::-1]:
            total = total * theta + a
        return total


def from_mole_fraction(x: Any, solute: Any, solvent: Any) -> Any:
    """Mass ratio of solute to solvent from the mole fraction of solute; none where an equation leaves no
    solvent.
    """
    some = x < 1.0
    return jnp.where(some, x * solute / ((1.0 - jnp.where(some, x, 0.0)) * solvent), jnp.nan)


@law(
    "solubility_law",
    name="apelblat_solubility",
    source="apelblat1999",
    title="Solubility by Apelblat's equation",
    equation=r"\ln x = A + B/T + C \ln T,\quad C^* = \frac{M}{M_s}\,\frac{x}{1 - x}",
)
class ApelblatSolubility(SolubilityLaw):
    """Mole fraction at saturation by the modified Apelblat equation, T in kelvin.

    By hand, ln x = −50 − 1500/298.15 + 9 ln 298.15 = −3.753:

    >>> round(float(ApelblatSolubility(-50.0, -1500.0, 9.0, 0.085)(298.15)), 4)
    0.1133
    """

    apelblat_a: Number
    apelblat_b: Number
    apelblat_c: Number
    molar_mass: MolarMass
    solvent_molar_mass: MolarMass = 0.0180153

    def __call__(self, temperature: Temperature) -> MassRatio:
        x = jnp.exp(self.apelblat_a + self.apelblat_b / temperature + self.apelblat_c * jnp.log(temperature))
        return from_mole_fraction(x, self.molar_mass, self.solvent_molar_mass)


@law(
    "solubility_law",
    name="vant_hoff_solubility",
    source="mullin2001, ch. 3",
    title="Solubility by the van 't Hoff equation",
    equation=r"\ln x = -\frac{\Delta H}{R T} + \frac{\Delta S}{R},\quad C^* = \frac{M}{M_s}\,\frac{x}{1 - x}",
)
class VantHoffSolubility(SolubilityLaw):
    """Mole fraction at saturation by the van 't Hoff equation: one enthalpy and one entropy of
    dissolution.
    """

    enthalpy_of_dissolution: MolarEnergy
    entropy_of_dissolution: MolarEntropy
    molar_mass: MolarMass
    solvent_molar_mass: MolarMass = 0.0180153

    def __call__(self, temperature: Temperature) -> MassRatio:
        x = jnp.exp((self.entropy_of_dissolution - self.enthalpy_of_dissolution / temperature) / GAS_CONSTANT)
        return from_mole_fraction(x, self.molar_mass, self.solvent_molar_mass)


@law(
    "solubility_law",
    name="antisolvent_solubility",
    source="yalkowsky1981",
    title="Solubility in a mixture with an antisolvent (log-linear)",
    equation=r"\ln C^* = \ln C^*_0(T) - \kappa\,w - \kappa_2\,w^2",
)
class AntisolventSolubility(SolubilityLaw):
    """Solubility that falls exponentially with the mass fraction of antisolvent in the solvent mixture, after
    Yalkowsky's log-linear rule.

    The curvature takes up what departs from the rule; with a negative power it describes a mixture that
    dissolves more than either solvent. Both solubilities are per kg of the solvent mixture. Used alone,
    without an antisolvent fraction, it is the law of the pure solvent.
    """

    pure_solubility: Solubility
    antisolvent_power: Number
    antisolvent_curvature: Number = 0.0

    takes_antisolvent: ClassVar[bool] = True

    def __call__(self, temperature: Temperature, antisolvent_fraction: MassFraction = 0.0) -> MassRatio:
        w = antisolvent_fraction
        return self.pure_solubility(temperature) * jnp.exp(
            -w * (self.antisolvent_power + self.antisolvent_curvature * w)
        )
