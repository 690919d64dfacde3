"""What nucleation and growth laws raise to a power: the supersaturation, in the definition of the source of
the kinetics.
"""

from __future__ import annotations

from abc import abstractmethod

import equinox as eqx

from granum.core import law
from granum.core.kinds import Density as DensityKind
from granum.core.kinds import MassRatio, MolarMass, Number, PositiveNumber
from granum.numerics.smooth import safe_log


class DrivingForce(eqx.Module):
    """A measure of supersaturation; negative below saturation."""

    @abstractmethod
    def __call__(self, solute_per_solvent: MassRatio, solubility_per_solvent: PositiveNumber) -> Number:
        """Value in the unit of the kinetics."""


@law(
    "driving_force",
    name="relative",
    source="mullin2001, ch. 3",
    title="Relative supersaturation (C − C*)/C*",
    equation=r"\sigma = (C - C^*)/C^*",
    symbols={"driving_force": r"\sigma"},
)
class RelativeSupersaturation(DrivingForce):
    """Relative supersaturation on anhydrous solute per mass of solvent."""

    def __call__(self, solute_per_solvent: MassRatio, solubility_per_solvent: PositiveNumber) -> Number:
        return (solute_per_solvent - solubility_per_solvent) / solubility_per_solvent


@law(
    "driving_force",
    name="absolute",
    source="mullin2001, ch. 3",
    title="Absolute supersaturation C − C*",
    equation=r"\Delta C = C - C^*",
    symbols={"driving_force": r"\Delta C"},
)
class AbsoluteSupersaturation(DrivingForce):
    """Absolute supersaturation in kg of anhydrous solute per kg of solvent."""

    def __call__(self, solute_per_solvent: MassRatio, solubility_per_solvent: PositiveNumber) -> Number:
        return solute_per_solvent - solubility_per_solvent


@law(
    "driving_force",
    name="logarithmic",
    source="mullin2001, ch. 3",
    title="Logarithm of the supersaturation ratio",
    equation=r"S = \ln(C/C^*)",
)
class LogarithmicSupersaturation(DrivingForce):
    """Logarithm of the supersaturation ratio, the thermodynamic driving force of an ideal solution."""

    def __call__(self, solute_per_solvent: MassRatio, solubility_per_solvent: PositiveNumber) -> Number:
        return safe_log(solute_per_solvent / solubility_per_solvent, otherwise=-700.0)


@law(
    "driving_force",
    name="molar",
    source="mullin2001, ch. 3",
    title="Molar supersaturation in kmol per cubic meter of solvent",
    equation=r"S = \Delta C\,\rho_{solvent} / M",
    symbols={"liquid_density": r"\rho_{solvent}"},
)
class MolarSupersaturation(DrivingForce):
    """Absolute supersaturation in kmol of solute per cubic meter of solvent."""

    liquid_density: DensityKind
    molar_mass: MolarMass

    def __call__(self, solute_per_solvent: MassRatio, solubility_per_solvent: PositiveNumber) -> Number:
        return (solute_per_solvent - solubility_per_solvent) * self.liquid_density / self.molar_mass / 1000.0
