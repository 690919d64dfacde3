"""Growth rate of crystals: laws that a population balance takes, and the formulas behind them.

Growth rate means dL/dt of the crystal size L (both faces), which is twice the velocity of one face.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import Annotated, Any

import equinox as eqx
import jax.numpy as jnp

from granum.core import formula, law
from granum.core.constants import GAS_CONSTANT
from granum.core.kinds import (
    GrowthRate,
    Law,
    MassRatio,
    MolarEnergy,
    Number,
    PositiveNumber,
    Ratio,
    Temperature,
)
from granum.crystallization.formulas.driving_forces import RelativeSupersaturation
from granum.crystallization.kinds import RateCoefficient
from granum.numerics.smooth import safe_divide, safe_log, safe_power


class GrowthLaw(eqx.Module):
    """Growth rate of size from composition and temperature; zero where the solution is not supersaturated."""

    @abstractmethod
    def __call__(
        self, solute_per_solvent: MassRatio, solubility_per_solvent: PositiveNumber, temperature: Temperature
    ) -> GrowthRate:
        """Growth rate of the smallest crystals."""


def arrhenius(activation_energy: Any, temperature: Any) -> Any:
    """``exp(-E / (R T))``; 1 for no activation energy."""
    return jnp.exp(-activation_energy / (GAS_CONSTANT * temperature))


@formula(
    source="mullin2001, ch. 6",
    title="Growth rate by a power law",
    equation=r"G = k_g\,e^{-E_g/RT}\,\sigma^g",
    family="growth_formula",
)
def growth_rate_power(
    relative_supersaturation: Number,
    growth_coefficient: RateCoefficient,
    growth_order: PositiveNumber,
    temperature: Temperature = 298.15,
    growth_activation_energy: MolarEnergy = 0.0,
) -> GrowthRate:
    """Growth rate of size by the power law in relative supersaturation, the coefficient in m/s.

    Zero at and below saturation. Potassium nitrate of Miller and Rawlings: 6967 µm/min and order 1.32.

    >>> round(
    ...     growth_rate_power(
    ...         relative_supersaturation=0.01, growth_coefficient=6967e-6 / 60, growth_order=1.32
    ...     )
    ...     * 60e6,
    ...     2,
    ... )
    15.96
    """
    k = growth_coefficient * arrhenius(growth_activation_energy, temperature)
    return k * safe_power(relative_supersaturation, growth_order)


@law(
    "growth_rate",
    name="power_law_growth",
    source="mullin2001, ch. 6",
    title="Growth rate by a power law",
    equation=r"G = k_g\,e^{-E_g/RT}\,S^g",
)
class PowerLawGrowth(GrowthLaw):
    """Growth rate proportional to a power of the driving force, with Arrhenius temperature dependence.

    ``growth_coefficient`` is in m/s per (unit of the driving force)^order.
    """

    growth_coefficient: RateCoefficient
    growth_order: PositiveNumber = 1.0
    growth_activation_energy: MolarEnergy = 0.0
    driving_force: Annotated[Any, Law("driving_force")] = RelativeSupersaturation()

    def __call__(
        self, solute_per_solvent: MassRatio, solubility_per_solvent: PositiveNumber, temperature: Temperature
    ) -> GrowthRate:
        S = self.driving_force(solute_per_solvent, solubility_per_solvent)
        return (
            self.growth_coefficient
            * arrhenius(self.growth_activation_energy, temperature)
            * safe_power(S, self.growth_order)
        )


@formula(
    source="burton1951",
    title="Growth rate on spirals",
    equation=r"G = A\,\frac{\sigma^2}{\sigma_1}\tanh\frac{\sigma_1}{\sigma}",
    family="growth_formula",
)
def growth_rate_spiral(
    relative_supersaturation: Ratio,
    spiral_coefficient: RateCoefficient,
    spiral_supersaturation: PositiveNumber,
) -> GrowthRate:
    """Growth rate of size on screw dislocations after Burton, Cabrera and Frank, the coefficient in m/s.

    Parabolic well below the supersaturation of the change of regime and linear well above it.

    >>> round(
    ...     growth_rate_spiral(
    ...         relative_supersaturation=0.001, spiral_coefficient=1e-6, spiral_supersaturation=0.1
    ...     )
    ...     * 1e12,
    ...     3,
    ... )
    10.0
    """
    s, s1 = relative_supersaturation, spiral_supersaturation
    return spiral_coefficient * s**2 / s1 * jnp.tanh(safe_divide(s1, s, 1e3))


@law(
    "growth_rate",
    name="spiral_growth",
    source="burton1951",
    title="Spiral growth (Burton, Cabrera and Frank)",
    equation=r"G = A\,e^{-E_g/RT}\,\frac{\sigma^2}{\sigma_1}\tanh\frac{\sigma_1}{\sigma}",
)
class SpiralGrowth(GrowthLaw):
    """Growth on screw dislocations: parabolic at low, linear at high supersaturation; the coefficient in
    m/s.
    """

    spiral_coefficient: RateCoefficient
    spiral_supersaturation: PositiveNumber
    growth_activation_energy: MolarEnergy = 0.0

    def __call__(
        self, solute_per_solvent: MassRatio, solubility_per_solvent: PositiveNumber, temperature: Temperature
    ) -> GrowthRate:
        sigma = jnp.maximum(solute_per_solvent / solubility_per_solvent - 1.0, 0.0)
        rate = (
            sigma**2
            / self.spiral_supersaturation
            * jnp.tanh(safe_divide(self.spiral_supersaturation, sigma, 1e3))
        )
        return self.spiral_coefficient * arrhenius(self.growth_activation_energy, temperature) * rate


@formula(
    source="ohara1973",
    title="Growth rate by birth and spread",
    equation=(
        r"G = A_1\,\sigma^{2/3}\,(\ln(1+\sigma))^{1/6}\,\exp\left(-\frac{A_2 "
        r"(298.15/T)^2}{\ln(1+\sigma)}\right)"
    ),
    family="growth_formula",
)
def growth_rate_birth_and_spread(
    relative_supersaturation: Ratio,
    birth_spread_coefficient: RateCoefficient,
    birth_spread_barrier: PositiveNumber,
    temperature: Temperature = 298.15,
) -> GrowthRate:
    """Growth rate of size by two-dimensional nuclei that form and spread (birth and spread), the coefficient
    in m/s.

    The barrier is that at 25 °C and falls with the square of the temperature, as two-dimensional nucleation
    does.

    >>> rate = growth_rate_birth_and_spread(
    ...     relative_supersaturation=1.718281828, birth_spread_coefficient=1e-8, birth_spread_barrier=0.1
    ... )
    >>> round(rate * 1e9, 3)
    12.981
    """
    log_ratio = safe_log(1.0 + relative_supersaturation, otherwise=0.0)
    barrier = safe_divide(birth_spread_barrier * (298.15 / temperature) ** 2, log_ratio, 700.0)
    rate = safe_power(relative_supersaturation, 2.0 / 3.0) * safe_power(log_ratio, 1.0 / 6.0)
    return birth_spread_coefficient * rate * jnp.exp(-jnp.minimum(barrier, 700.0))


@law(
    "growth_rate",
    name="birth_and_spread_growth",
    source="ohara1973",
    title="Growth by birth and spread",
    equation=(
        r"G = A_1 e^{-E_g/RT} \sigma^{2/3} (\ln\beta)^{1/6} \exp\left(-\frac{A_2 "
        r"(298.15/T)^2}{\ln\beta}\right)"
    ),
)
class BirthAndSpreadGrowth(GrowthLaw):
    """Growth by two-dimensional nuclei that form and spread on smooth faces; the coefficient in m/s."""

    birth_spread_coefficient: RateCoefficient
    birth_spread_barrier: PositiveNumber
    growth_activation_energy: MolarEnergy = 0.0

    def __call__(
        self, solute_per_solvent: MassRatio, solubility_per_solvent: PositiveNumber, temperature: Temperature
    ) -> GrowthRate:
        sigma = jnp.maximum(solute_per_solvent / solubility_per_solvent - 1.0, 0.0)
        rate = growth_rate_birth_and_spread(
            sigma, self.birth_spread_coefficient, self.birth_spread_barrier, temperature
        )
        return arrhenius(self.growth_activation_energy, temperature) * rate


@law(
    "dissolution_rate",
    name="power_law_dissolution",
    source="mullin2001, ch. 6",
    title="Dissolution rate by a power law",
    equation=r"D = k_{dis}\,e^{-E/RT}\,(-S)^d",
)
class PowerLawDissolution(GrowthLaw):
    """Rate at which crystals shrink in an undersaturated solution, proportional to a power of the
    undersaturation.

    Positive where the solution is undersaturated, zero elsewhere; the coefficient in m/s per (unit of the
    driving force)^order.
    """

    dissolution_coefficient: RateCoefficient
    dissolution_order: PositiveNumber = 1.0
    growth_activation_energy: MolarEnergy = 0.0
    driving_force: Annotated[Any, Law("driving_force")] = RelativeSupersaturation()

    def __call__(
        self, solute_per_solvent: MassRatio, solubility_per_solvent: PositiveNumber, temperature: Temperature
    ) -> GrowthRate:
        S = self.driving_force(solute_per_solvent, solubility_per_solvent)
        return (
            self.dissolution_coefficient
            * arrhenius(self.growth_activation_energy, temperature)
            * safe_power(-S, self.dissolution_order)
        )
