"""Published inputs that several tests share, in SI units."""

from __future__ import annotations

import jax.numpy as jnp

from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.nucleation import PowerLawNucleation
from granum.crystallization.formulas.solubility_laws import PolynomialSolubility
from granum.crystallization.population.lagrangian import Model, SolventVolume
from granum.crystallization.population.packets import Seeds
from granum.crystallization.vessels.crystals import Crystal

# Potassium nitrate in water: Miller and Rawlings (1994), Chung, Ma and Braatz (1999). 6967 um/min; 2.78e-5
# 1/(um3 min) per m3/m3.
DENSITY = 2110.0
KG, G_ORDER, KB, B_ORDER = 6967e-6 / 60, 1.32, 2.78e-5 * 1e18 / 60 / DENSITY, 1.78
START = (128.6 + 5.88 * 32 + 0.1721 * 32**2) / 1000
DURATION = 4800.0


def model(kg=KG, growth_order=G_ORDER, kb=KB, nucleation_order=B_ORDER, **more) -> Model:
    return Model(
        PolynomialSolubility([0.1286, 5.88e-3, 1.721e-4]),
        PowerLawGrowth(kg, growth_order),
        PowerLawNucleation(kb, nucleation_order),
        Crystal(DENSITY),
        SolventVolume(1000.0),
        **more,
    )


def linear_cooling(t):
    return 305.15 - 4.0 * t / DURATION


def seeds(mass_per_liter=0.5) -> Seeds:
    """Parabola from 90 to 110 um, in 1 kg (1 L) of solvent."""
    edges = jnp.linspace(90e-6, 110e-6, 33)
    return Seeds.of_density(lambda L: (110e-6 - L) * (L - 90e-6), edges, mass_per_liter / 1000.0, DENSITY)
