"""Supersaturation in every definition, each with its basis in the name."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import (
    MassFraction,
    MassRatio,
    Number,
    OpenFraction,
    PositiveNumber,
    Ratio,
    TemperatureDifference,
)
from granum.crystallization.kinds import SolubilitySlope, SoluteShare
from granum.numerics.smooth import safe_log

NO_FREE_WATER = "The crystal water of so much hydrate would be more than all the water."


@formula(source="mullin2001, ch. 3", equation=r"\beta = C / C^*")
def supersaturation_ratio(solute_per_solvent: MassRatio, solubility_per_solvent: PositiveNumber) -> Ratio:
    """Supersaturation ratio on the basis of anhydrous solute per mass of solvent.

    The ratio depends on the basis: sucrose at 20 °C, 2.45 kg in 1 kg of water against a solubility of
    2.04 gives 1.20 here and 1.06 on mass fractions of the solution.

    >>> round(supersaturation_ratio(solute_per_solvent=2.45, solubility_per_solvent=2.04), 2)
    1.2
    """
    return solute_per_solvent / solubility_per_solvent


@formula(source="mullin2001, ch. 3", equation=r"\sigma = (C - C^*) / C^*")
def relative_supersaturation(solute_per_solvent: MassRatio, solubility_per_solvent: PositiveNumber) -> Number:
    """Relative supersaturation on the basis of anhydrous solute per mass of solvent.

    Negative in an undersaturated solution.

    >>> round(relative_supersaturation(solute_per_solvent=2.45, solubility_per_solvent=2.04), 2)
    0.2
    """
    return solute_per_solvent / solubility_per_solvent - 1.0


@formula(source="mullin2001, ch. 3", equation=r"\Delta C = C - C^*")
def absolute_supersaturation(solute_per_solvent: MassRatio, solubility_per_solvent: MassRatio) -> Number:
    """Absolute supersaturation as anhydrous solute per mass of solvent.

    >>> round(absolute_supersaturation(solute_per_solvent=2.45, solubility_per_solvent=2.04), 2)
    0.41
    """
    return solute_per_solvent - solubility_per_solvent


@formula(
    source="mullin2001, ch. 3",
    title="Supersaturation ratio per mass of solution",
    equation=r"\beta_x = \frac{C/(1+C)}{C^*/(1+C^*)}",
    symbols={"supersaturation_ratio": r"\beta_x"},
)
def supersaturation_ratio_solution_basis(
    solute_per_solvent: MassRatio, solubility_per_solvent: PositiveNumber
) -> Ratio:
    """Supersaturation ratio on the basis of mass fractions of the solution.

    >>> round(supersaturation_ratio_solution_basis(solute_per_solvent=2.45, solubility_per_solvent=2.04), 2)
    1.06
    """
    c, s = solute_per_solvent, solubility_per_solvent
    return c * (1.0 + s) / (s * (1.0 + c))


@formula(source="mullin2001, ch. 3", equation=r"\Delta T = \frac{C - C^*}{dC^*/dT}")
def undercooling(
    solute_per_solvent: MassRatio, solubility_per_solvent: MassRatio, solubility_slope: SolubilitySlope
) -> TemperatureDifference:
    """Undercooling that belongs to an absolute supersaturation, by the slope of the solubility in 1/K.

    >>> round(undercooling(solute_per_solvent=0.35, solubility_per_solvent=0.316, solubility_slope=0.0068), 6)
    5.0
    """
    return (solute_per_solvent - solubility_per_solvent) / solubility_slope


@formula(source="mullin2001, ch. 3", equation=r"x = C/(1+C)", output="solute_mass_fraction")
def solute_mass_fraction(solute_per_solvent: MassRatio) -> MassFraction:
    """Mass fraction of anhydrous solute in the solution from the mass ratio to the solvent.

    >>> solute_mass_fraction(solute_per_solvent=0.25)
    0.2
    """
    return solute_per_solvent / (1.0 + solute_per_solvent)


@formula(
    source="mullin2001, ch. 3",
    title="Solute per solvent from a mass fraction",
    equation=r"C = x/(1-x)",
    output="solute_per_solvent",
)
def solute_per_solvent_fraction(solute_mass_fraction: OpenFraction) -> MassRatio:
    """Mass ratio of anhydrous solute to solvent from the mass fraction in the solution.

    >>> solute_per_solvent_fraction(solute_mass_fraction=0.2)
    0.25
    """
    return solute_mass_fraction / (1.0 - solute_mass_fraction)


@formula(
    source="mullin2001, ch. 3",
    title="Hydrate per solvent from anhydrous solute",
    equation=r"C_h = \frac{C}{x_c - C\,(1 - x_c)}",
    output="solute_per_solvent",
    typical={"solute_per_solvent": (0.1, 0.5)},
    symbols={"=solute_per_solvent": "C_h"},
)
def solute_per_solvent_hydrate(
    solute_per_solvent: MassRatio, solute_fraction_of_crystal: SoluteShare
) -> MassRatio:
    """Hydrate per mass of free water from the anhydrous solute per mass of total water.

    The water of the hydrate counts as solute, so the ratio grows without bound as the free water is used up;
    beyond that there is no value. Supersaturation of a hydrate on this basis is larger than on the anhydrous
    basis.

    >>> round(solute_per_solvent_hydrate(solute_per_solvent=0.2, solute_fraction_of_crystal=0.4411), 3)
    0.607
    """
    c, x = solute_per_solvent, solute_fraction_of_crystal
    free = x - c * (1.0 - x)
    impossible(~(free > 0), c, "solute_per_solvent", 0.0, x / jnp.maximum(1.0 - x, 1e-300), NO_FREE_WATER)
    return jnp.where(free > 0, c / jnp.where(free > 0, free, 1.0), jnp.nan)


@formula(
    source="mullin2001, ch. 3",
    equation=r"C = \frac{x_c\,C_h}{1 + (1 - x_c)\,C_h}",
    output="solute_per_solvent",
    title="Anhydrous solute per solvent from hydrate per water",
    typical={"hydrate_per_solvent": (0.3, 1.0)},
)
def solute_per_solvent_from_hydrate(
    hydrate_per_solvent: MassRatio, solute_fraction_of_crystal: SoluteShare
) -> MassRatio:
    """Anhydrous solute per mass of all the water from the hydrate per mass of water it is dissolved in, as
    older tables give solubilities.

    The water of the hydrate joins the solvent. Magnesium sulfate of Bhatt and Vora, example 6.10: 401.2 kg of
    heptahydrate in 100 kg of water is 64.2 kg of sulfate per 100 kg of all the water.

    >>> round(
    ...     solute_per_solvent_from_hydrate(
    ...         hydrate_per_solvent=4.012, solute_fraction_of_crystal=120.3 / 246.3
    ...     ),
    ...     3,
    ... )
    0.642
    """
    h, x = hydrate_per_solvent, solute_fraction_of_crystal
    return h * x / (1.0 + h * (1.0 - x))


@formula(
    source="mullin2001, ch. 3",
    title="Thermodynamic driving force",
    equation=r"S = \frac{\Delta\mu}{RT} = \nu \ln \beta",
    family="supersaturation",
)
def driving_force_thermodynamic(
    supersaturation_ratio: PositiveNumber, ions_per_formula: PositiveNumber = 1.0
) -> Number:
    """Thermodynamic driving force of crystallization over RT, for ideal activity coefficients.

    >>> round(driving_force_thermodynamic(supersaturation_ratio=1.2, ions_per_formula=2.0), 4)
    0.3646
    """
    return ions_per_formula * safe_log(supersaturation_ratio)
