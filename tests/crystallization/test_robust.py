"""Recipes for kinetics that are known only so far: closed forms of linear figures, and draws of the rates."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.crystallization import SEEDED

from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.nucleation import PowerLawNucleation
from granum.crystallization.formulas.solubility_laws import PolynomialSolubility
from granum.crystallization.population.lagrangian import Model, SuspensionVolume
from granum.crystallization.recipes import _run, optimal_cooling
from granum.crystallization.robust import Scaled, guarded, reach
from granum.crystallization.vessels.batch import narrow_seeds
from granum.crystallization.vessels.crystals import Crystal

SLOPES = np.array([[1.0, -2.0], [0.0, 0.5]])


@pytest.mark.parametrize("probability", [0.5, 0.8, 0.95])
def test_a_linear_figure_of_normal_logarithms(probability: float):
    """Its quantile is z √Σ (slope s)², of a log-normal rate s² = ln(1 + variation²); and so are draws."""
    deviations = 0.2, 0.5
    s = np.sqrt(np.log1p(np.square(deviations)))
    found = np.asarray(
        guarded(lambda x: 3.0 + jnp.asarray(SLOPES) @ x, deviations, reach(probability, "chance"))
    )
    drawn = 3.0 + np.random.default_rng(1).normal(size=(200_000, 2)) * s @ SLOPES.T
    np.testing.assert_allclose(found, np.quantile(drawn, probability, axis=0), atol=0.01)


def test_the_region_of_both_rates_reaches_farther():
    """√(−2 ln(1 − p)) standard deviations, where one figure alone wants fewer."""
    for p in (0.5, 0.9, 0.99):
        assert reach(p, "worst case") == pytest.approx(np.sqrt(-2.0 * np.log(1.0 - p)), rel=1e-12)
        assert reach(p, "chance") < reach(p, "worst case")
    assert reach(0.5, "chance") == 0.0


def test_a_scaled_law_is_the_law_times_the_factor():
    law = PowerLawGrowth(1e-4, 1.3)
    assert float(Scaled(law, 1.7)(0.5, 0.4, 300.0)) == pytest.approx(1.7 * float(law(0.5, 0.4, 300.0)))


@pytest.mark.long
@pytest.mark.parametrize("robustness", ["chance", "worst case"])
def test_draws_of_the_rates_keep_to_the_recipe(robustness):
    """Of 300 batches with rates drawn, so many keep each bound as were guarded for, and the recipe for the
    mean rates alone keeps the limit in about half of them.
    """
    given = SEEDED | {"temperature_start": 305.15, "temperature_end": 301.15, "intervals": 5, "steps": 100}
    free = optimal_cooling(**given)
    limit, deviations = 1.1 * float(free.relative_supersaturation_maximum), (0.2, 0.5)
    more = {"growth_deviation": deviations[0], "nucleation_deviation": deviations[1]}
    recipe = optimal_cooling(**given, relative_supersaturation_maximum=limit, robustness=robustness, **more)
    assert float(recipe.relative_supersaturation_guarded) <= limit * (1.0 + 1e-5)
    crystal = Crystal(SEEDED["crystal_density"])
    kinetics = SEEDED["growth"], SEEDED["nucleation"]
    growth = PowerLawGrowth(kinetics[0]["growth_coefficient"], kinetics[0]["growth_order"])
    nucleation = PowerLawNucleation(kinetics[1]["nucleation_coefficient"], kinetics[1]["nucleation_order"])
    seeds = narrow_seeds(100e-6, 20e-6, SEEDED["seed_mass_per_solvent"], crystal.mass_per_cube)
    shares = -jnp.diff(jnp.asarray(recipe.temperature)) / 4.0

    @jax.jit
    @jax.vmap
    def drawn(factors):
        laws = Scaled(growth, factors[0]), Scaled(nucleation, factors[1])
        model = Model(
            PolynomialSolubility([0.1286, 5.88e-3, 1.721e-4]), *laws, crystal, SuspensionVolume(1000.0)
        )
        nuclei, over, _size = _run(
            shares, (model, seeds, SEEDED["solute_per_solvent"], 305.15, 301.15, 4800.0), 100
        )
        return nuclei, jnp.max(over)

    s = np.sqrt(np.log1p(np.square(deviations)))
    factors = np.exp(np.random.default_rng(5).normal(size=(300, 2)) * s)
    nuclei, over = drawn(jnp.asarray(factors))
    least = 0.86 if robustness == "chance" else 0.95
    assert np.mean(np.asarray(over) <= limit) > least
    assert np.mean(np.asarray(nuclei) <= recipe.nuclei_mass_fraction_guarded) > least
    if robustness == "chance":
        assert np.mean(np.asarray(nuclei) <= recipe.nuclei_mass_fraction_guarded) < 0.95
