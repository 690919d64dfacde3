"""Equilibrium of vapors and dissolved substances with activated carbon: the family
``adsorption_isotherm``.
"""

from __future__ import annotations

import equinox as eqx
import jax.numpy as jnp

from granum.core import law
from granum.core.kinds import Concentration, MassRatio
from granum.filtration.kinds import (
    AdsorptionAffinity,
    AdsorptionExponent,
    LoadingScale,
    ReferenceConcentration,
)
from granum.numerics import safe_power


@law(
    "adsorption_isotherm",
    name="langmuir_isotherm",
    source="langmuir1918",
    equation=r"q = q_m\,\frac{b\,c}{1 + b\,c}",
    title="Langmuir isotherm of adsorption",
)
class LangmuirIsotherm(eqx.Module):
    """Loading of an adsorbent whose like sites hold one molecule each: proportional to the concentration
    where that is low, a full layer where it is high.

    Source not opened; the equation is known everywhere.

    >>> float(LangmuirIsotherm(0.3, 200.0)(0.005))
    0.15
    """

    loading_highest: LoadingScale
    adsorption_affinity: AdsorptionAffinity

    def __call__(self, concentration: Concentration) -> MassRatio:
        """Loading in equilibrium with a concentration."""
        held = self.adsorption_affinity * jnp.asarray(concentration, dtype=float)
        return self.loading_highest * held / (1.0 + held)


@law(
    "adsorption_isotherm",
    name="freundlich_isotherm",
    source="freundlich1906; crittenden2012, ch. 15",
    equation=r"q = q_1\left(\frac{c}{c_1}\right)^{1/n}",
    title="Freundlich isotherm of adsorption",
)
class FreundlichIsotherm(eqx.Module):
    """Loading of an adsorbent as a power of the concentration, as most carbons hold most substances over the
    range that was measured.

    The loading is given at a reference concentration, so that units stay whole: at 1 mg/L it has the number
    of the usual constant in mg/g and (L/mg)^(1/n). Sources not opened.

    By hand, trichloroethene with 1062 (µg/g)(L/µg)^0.48 at 0.5 mg/L: 1062·500^0.48 µg/g.

    >>> round(float(FreundlichIsotherm(1.062e-3, 0.48, 1e-6)(5e-4)), 5)
    0.02097
    """

    loading_reference: LoadingScale
    adsorption_exponent: AdsorptionExponent
    adsorption_concentration: ReferenceConcentration = 1e-3

    def __call__(self, concentration: Concentration) -> MassRatio:
        """Loading in equilibrium with a concentration."""
        ratio = jnp.asarray(concentration, dtype=float) / self.adsorption_concentration
        return self.loading_reference * safe_power(ratio, self.adsorption_exponent)
