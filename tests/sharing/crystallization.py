"""Published inputs that several tests share, in SI units."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
from scipy.integrate import solve_ivp

from granum.crystallization.formulas.growth import GrowthLaw, PowerLawGrowth
from granum.crystallization.formulas.nucleation import NucleationLaw, PowerLawNucleation
from granum.crystallization.formulas.solubility_laws import PolynomialSolubility
from granum.crystallization.population.lagrangian import Model, SolventVolume
from granum.crystallization.population.packets import Seeds
from granum.crystallization.vessels.crystals import Crystal
from granum.streams.mixture import Mixture, Species

# Potassium nitrate in water: Miller and Rawlings (1994), Chung, Ma and Braatz (1999). 6967 um/min; 2.78e-5
# 1/(um3 min) per m3/m3.
DENSITY = 2110.0
KG, G_ORDER, KB, B_ORDER = 6967e-6 / 60, 1.32, 2.78e-5 * 1e18 / 60 / DENSITY, 1.78
START = (128.6 + 5.88 * 32 + 0.1721 * 32**2) / 1000
DURATION = 4800.0
SOLUBILITY = {"law": "polynomial_solubility", "coefficients": [0.1286, 5.88e-3, 1.721e-4]}
GROWTH = {"law": "power_law_growth", "growth_coefficient": KG, "growth_order": 1.32}
NUCLEATION = {"law": "secondary_nucleation", "nucleation_coefficient": KB, "nucleation_order": 1.78}
SEEDED = {
    "solute_per_solvent": START,
    "solubility": SOLUBILITY,
    "growth": GROWTH,
    "nucleation": NUCLEATION,
    "duration": DURATION,
    "crystal_density": DENSITY,
    "seed_mass_per_solvent": 5e-4,
    "seed_size": "100 um",
    "seed_width": "20 um",
}


class Constant(GrowthLaw):
    value: float

    def __call__(self, solute_per_solvent, solubility_per_solvent, temperature):
        return self.value + 0.0 * solute_per_solvent


class ConstantBirths(NucleationLaw):
    value: float

    def __call__(self, solute_per_solvent, solubility_per_solvent, temperature, magma_density):
        return self.value + 0.0 * solute_per_solvent


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


def by_scipy(mass=0.5):
    """Moments of the continuous parabola, integrated by LSODA at 1e-11: written apart from the package."""
    x, w = np.polynomial.legendre.leggauss(20)
    size, weight = 100e-6 + 10e-6 * x, (1 - x**2) * w
    m = np.array([np.sum(weight * size**k) for k in range(5)])
    m *= mass / 1000 / (DENSITY * m[3])
    total = START + DENSITY * m[3]

    def rates(t, y):
        y = y * m
        T = 32 - 4 * t / DURATION
        saturated = 0.1286 + 5.88e-3 * T + 1.721e-4 * T * T
        S = max((total - DENSITY * y[3]) / saturated - 1, 0)
        G, B = KG * S**G_ORDER, KB * S**B_ORDER * DENSITY * y[3]
        return np.array([B, G * y[0], 2 * G * y[1], 3 * G * y[2], 4 * G * y[3]]) / m

    y = solve_ivp(rates, (0, DURATION), np.ones(5), method="LSODA", rtol=1e-11, atol=1e-13).y[:, -1] * m
    return y, total - DENSITY * y[3]


def mixture() -> Mixture:
    edges = (0.0, *map(float, np.geomspace(2e-5, 2.5e-3, 40)))
    return Mixture(
        (Species("potassium nitrate", (("potassium nitrate", 1.0),), (2110.0,), (920.0,), -345e3),),
        (
            Species("water", (("water", 1.0),), (998.0,), (4186.0,)),
            Species("potassium nitrate", (("potassium nitrate", 1.0),), (2500.0,), (900.0,)),
        ),
        (Species("water", (("water", 1.0),), (), (1900.0,), 2.501e6, 0.018),),
        edges,
    )
