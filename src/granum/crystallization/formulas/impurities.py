"""Growth of crystals in an impure solution: impurity on the surface pins the steps."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, law
from granum.core.constants import BOLTZMANN
from granum.core.kinds import (
    Area,
    Fraction,
    GrowthRate,
    Length,
    MassRatio,
    PositiveNumber,
    Ratio,
    Temperature,
    TemperatureDifference,
)
from granum.crystallization.formulas.growth import GrowthLaw
from granum.crystallization.kinds import (
    AdsorptionCoefficient,
    Growth,
    ImpurityConcentration,
    SolubilitySlope,
    StepEnergy,
)


class PinnedSteps(NamedTuple):
    """Impurity on the surface of a growing crystal and what it leaves of the growth."""

    impurity_coverage: Fraction
    impurity_effectiveness: PositiveNumber
    growth_ratio_impure: Fraction
    supersaturation_growth_start: Ratio


@formula(
    source="kubota1995",
    title="Supersaturation below which full coverage with an impurity stops growth",
    equation=r"\sigma_p = \frac{\gamma\,a}{k\,T\,L}",
    output="pinning_supersaturation",
    typical={
        "step_energy": (5e-12, 2e-11),
        "growth_unit_area": (1e-19, 4e-19),
        "active_site_spacing": (1e-8, 3e-8),
        "temperature": (280.0, 330.0),
    },
)
def pinning_supersaturation(
    step_energy: StepEnergy,
    growth_unit_area: Area,
    active_site_spacing: Length,
    temperature: Temperature = 298.15,
) -> PositiveNumber:
    """Relative supersaturation below which a step can no longer pass between impurities that sit on all their
    sites.

    A step bends between two pinning points; its velocity falls from that of a straight step to that at a
    radius of half their distance, and the mean of both counts. Divided by the supersaturation it is the
    impurity effectiveness factor. Of the paper only the abstract was opened; the derivation is checked.

    >>> round(pinning_supersaturation(1e-11, 1.6e-19, 1.6e-8, temperature=298.15), 4)
    0.0243
    """
    return step_energy * growth_unit_area / (BOLTZMANN * temperature * active_site_spacing)


@formula(
    source="kubota1995",
    title="Growth in an impure solution (Kubota and Mullin)",
    equation=(
        r"\frac{G}{G_0} = 1 - \alpha\,\theta,\quad \theta = \frac{K c}{1 + K c},\quad \alpha = "
        r"\frac{\sigma_p}{\sigma}"
    ),
    output="growth_ratio_impure",
    typical={
        "relative_supersaturation": (0.03, 0.1),
        "impurity_concentration": (1e-4, 1e-2),
        "adsorption_coefficient": (100.0, 1000.0),
        "pinning_supersaturation": (0.005, 0.03),
    },
)
def growth_ratio_kubota_mullin(
    relative_supersaturation: PositiveNumber,
    impurity_concentration: ImpurityConcentration,
    adsorption_coefficient: AdsorptionCoefficient,
    pinning_supersaturation: Ratio,
) -> PinnedSteps:
    """Growth rate over that in a pure solution, with Langmuir's coverage and the impurity effectiveness
    factor; zero below a supersaturation that grows with the coverage.

    A strong impurity, of a factor beyond one, stops growth before the surface is covered; a weak one never
    does. Lead on the cube face of sodium chloride: K = 9.35e5 L/mol by the onset of growth and 9.93e5 by
    adsorption (Kubota and others), so that a micromole in a liter covers about half.

    >>> out = growth_ratio_kubota_mullin(
    ...     relative_supersaturation=0.02,
    ...     impurity_concentration="1.07e-6 mol/L",
    ...     adsorption_coefficient="9.35e5 L/mol",
    ...     pinning_supersaturation=0.02,
    ... )
    >>> (
    ...     round(out.impurity_coverage, 2),
    ...     round(out.growth_ratio_impure, 2),
    ...     round(out.supersaturation_growth_start, 2),
    ... )
    (0.5, 0.5, 0.01)
    """
    s = relative_supersaturation
    theta = _coverage(impurity_concentration, adsorption_coefficient)
    start = pinning_supersaturation * theta
    return PinnedSteps(theta, pinning_supersaturation / s, jnp.maximum(1.0 - start / s, 0.0), start)


@formula(
    source="kubota1995; kubota2003",
    title="Undercooling at which crystals start to grow in an impure solution",
    equation=r"\Delta T_G = \frac{\sigma_p}{\mathrm{d}\ln C^*/\mathrm{d}T}\,\frac{K c}{1 + K c}",
    output="undercooling",
    typical={
        "impurity_concentration": (1e-4, 1e-2),
        "adsorption_coefficient": (100.0, 1000.0),
        "pinning_supersaturation": (0.005, 0.03),
        "solubility_slope": (0.005, 0.03),
    },
    symbols={"undercooling": r"\Delta T_G"},
)
def undercooling_growth_start(
    impurity_concentration: ImpurityConcentration,
    adsorption_coefficient: AdsorptionCoefficient,
    pinning_supersaturation: Ratio,
    solubility_slope: SolubilitySlope,
) -> TemperatureDifference:
    """Undercooling that a crystal needs before it grows at all once an impurity has settled on it: the dead
    zone that impurities add to the metastable zone.

    The supersaturation is counted as slope times undercooling. 1/ΔT against 1/c is a straight line, whose
    intercept over its slope is Langmuir's coefficient: that of lead on sodium chloride came out so.

    >>> round(undercooling_growth_start(1e-3, 935.0, 0.02, 0.02), 3)
    0.483
    """
    theta = _coverage(impurity_concentration, adsorption_coefficient)
    return pinning_supersaturation * theta / solubility_slope


def _coverage(concentration: Any, coefficient: Any) -> Any:
    return coefficient * concentration / (1.0 + coefficient * concentration)


@law(
    "growth_rate",
    name="impeded_growth",
    source="kubota1995",
    title="Growth in an impure solution (Kubota and Mullin)",
    equation=r"G = G_0\,\max\left(1 - \frac{\sigma_p}{\sigma}\,\frac{K c}{1 + K c},\,0\right)",
)
class ImpededGrowth(GrowthLaw):
    """Growth by another law, slowed by an impurity that covers the surface after Langmuir and pins the
    steps.

    The concentration is that of the impurity in the mother liquor and stays as given; crystals that dissolve
    are not hindered.
    """

    growth: Growth
    impurity_concentration: ImpurityConcentration
    adsorption_coefficient: AdsorptionCoefficient
    pinning_supersaturation: Ratio

    def __call__(
        self, solute_per_solvent: MassRatio, solubility_per_solvent: PositiveNumber, temperature: Temperature
    ) -> GrowthRate:
        pure = self.growth(solute_per_solvent, solubility_per_solvent, temperature)
        s = solute_per_solvent / solubility_per_solvent - 1.0
        start = self.pinning_supersaturation * _coverage(
            self.impurity_concentration, self.adsorption_coefficient
        )
        grows = s > start
        left = jnp.where(grows, 1.0 - start / jnp.where(grows & (s > 0.0), s, 1.0), 0.0)
        return pure * jnp.where(s > 0.0, left, 1.0)
