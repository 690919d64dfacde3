"""The steady continuous crystallizer against closed forms and hand calculations."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.special import gammainc

from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.msmpr import undersize_mass_fraction
from granum.crystallization.formulas.nucleation import PowerLawNucleation
from granum.crystallization.formulas.solubility_laws import PolynomialSolubility
from granum.crystallization.vessels.crystals import Crystal
from granum.crystallization.vessels.msmpr import AdditiveVolumes, Feed, Removal, steady_msmpr

# Potassium nitrate in water: Miller and Rawlings (1994), Chung, Ma and Braatz (1999), in SI units.
SOLUBILITY = PolynomialSolubility([0.1286, 5.88e-3, 1.721e-4])
GROWTH = PowerLawGrowth(6967e-6 / 60, 1.32)
NUCLEATION = PowerLawNucleation(2.78e7 * 1e6 / 60 / 2110.0, 1.78)
CRYSTAL = Crystal(2110.0)
LIQUOR = AdditiveVolumes(2500.0, 998.0)
EDGES = jnp.linspace(0.0, 4e-3, 401)


def vessel(
    solute=0.5,
    volume=5.0,
    crystals=None,
    edges=EDGES,
    crystal=CRYSTAL,
    nucleation=NUCLEATION,
    temperature=293.15,
    **more,
):
    start = jnp.zeros(len(edges) - 1) if crystals is None else crystals
    return steady_msmpr(
        Feed(solute, 1.0, start),
        temperature,
        volume,
        SOLUBILITY,
        GROWTH,
        nucleation,
        crystal,
        LIQUOR,
        edges,
        **more,
    )


def test_exponential_distribution_and_balance():
    found = vessel()
    assert float(jnp.sum(found.crystals) + found.solute) == pytest.approx(0.5, abs=1e-13)
    share = np.cumsum(np.asarray(found.crystals)) / float(jnp.sum(found.crystals))
    exact = gammainc(4, np.asarray(EDGES[1:]) / float(found.length))
    np.testing.assert_allclose(share[:-1], exact[:-1], atol=1e-12)
    np.testing.assert_allclose(
        undersize_mass_fraction(np.asarray(EDGES[1:]), found.growth_rate, found.residence_time),
        exact,
        atol=1e-12,
    )


@pytest.mark.parametrize("solute", [0.4, 0.5, 0.6])
def test_first_order_secondary_nucleation_fixes_the_supersaturation(solute):
    """6 k_v rho k_b S^b (k_g S^g)^3 tau^4 = 1, whatever the feed: the magma density cancels."""
    found = vessel(solute)
    kg, kb, tau = 6967e-6 / 60, 2.78e13 / 60 / 2110.0, float(found.residence_time)
    expected = (6.0 * 2110.0 * kb * kg**3 * tau**4) ** (-1.0 / (1.78 + 3 * 1.32))
    assert float(found.relative_supersaturation) == pytest.approx(expected, rel=1e-9)


def test_cascade_of_equal_growth_is_a_gamma_distribution():
    """Crystals of a first stage that only grow in a second one: each has spent the sum of two exponential
    times.
    """
    fine = jnp.linspace(0.0, 6e-3, 6001)
    first = vessel(edges=fine)
    none = PowerLawNucleation(0.0, 1.0)
    second = steady_msmpr(
        Feed(first.solute, first.solvent, first.crystals),
        285.15,
        5.0,
        SOLUBILITY,
        GROWTH,
        none,
        CRYSTAL,
        LIQUOR,
        fine,
    )
    a, b = float(first.length), float(second.length)
    # Third moment of the sum of two exponential lengths, over that of the first: both stages pass the same
    # number of crystals.
    exact = (6 * a**3 + 6 * a**2 * b + 6 * a * b**2 + 6 * b**3) / (6 * a**3)
    assert float(jnp.sum(second.crystals) / jnp.sum(first.crystals)) == pytest.approx(exact, rel=2e-5)


def test_wash_out_is_reported_not_hidden():
    found = vessel(volume=1e-6)
    assert bool(found.washed_out)
    assert float(jnp.sum(found.crystals)) == 0.0
    assert float(found.solute) == pytest.approx(0.5)


def test_undersaturated_liquor_dissolves_crystals():
    some = jnp.zeros(400).at[100].set(0.05)
    kept = vessel(0.3, crystals=some)
    assert float(jnp.sum(kept.crystals)) == pytest.approx(0.05 - (float(SOLUBILITY(293.15)) - 0.3), rel=1e-9)
    gone = vessel(0.2, crystals=some)
    assert float(jnp.sum(gone.crystals)) == pytest.approx(0.0, abs=1e-15)
    assert float(gone.solute) == pytest.approx(0.25)


def test_hydrate_takes_water_and_balances():
    hydrate = Crystal(1700.0, 1.0, 0.6)
    found = vessel(crystal=hydrate)
    crystals = float(jnp.sum(found.crystals))
    assert float(found.solute) + 0.6 * crystals == pytest.approx(0.5, abs=1e-13)
    assert float(found.solvent) + 0.4 * crystals == pytest.approx(1.0, abs=1e-13)


def test_gradient_and_batch():
    def f(T):
        return vessel(temperature=T).relative_supersaturation

    difference = (f(293.16) - f(293.14)) / 0.02
    assert float(jax.jit(jax.grad(f))(293.15)) == pytest.approx(float(difference), rel=1e-5)
    many = jax.jit(jax.vmap(f))(jnp.array([285.0, 293.15]))
    assert float(many[1]) == pytest.approx(float(f(293.15)), rel=1e-12)


def test_removal_of_one_is_the_plain_vessel():
    plain, same = vessel(), vessel(removal=Removal(1.0, 1e-4, 1.0, 5e-4))
    np.testing.assert_allclose(same.crystals, plain.crystals, rtol=1e-9, atol=1e-15)
    assert float(same.magma_density) == pytest.approx(float(plain.magma_density), rel=1e-12)


def test_fines_dissolution_and_classification_against_quadrature():
    """Product of class = Q times withdrawal times n, with n of the R-Z model integrated numerically."""
    removal = Removal(3.0, 8e-5, 2.5, 4e-4)
    found = vessel(removal=removal)
    size = np.linspace(0.0, 6e-3, 600_001)
    length = float(found.length)
    n = np.exp(-np.asarray(removal.path(size)) / length)
    out = n * np.where(size > 4e-4, 2.5, 1.0) * size**3
    cumulative = np.concatenate([[0.0], np.cumsum(0.5 * (out[1:] + out[:-1]) * np.diff(size))])
    share = np.interp(np.asarray(EDGES[1:]), size, cumulative) / cumulative[-1]
    np.testing.assert_allclose(
        np.cumsum(found.crystals)[:-1] / float(jnp.sum(found.crystals)), share[:-1], atol=2e-5
    )
    # The balance of nuclei: product cube made per second from B V nuclei.
    made = CRYSTAL.mass_per_cube * float(found.nucleation_rate) * 5.0 * cumulative[-1] / length
    assert made == pytest.approx(float(jnp.sum(found.crystals)), rel=1e-4)


def test_fines_dissolution_coarsens_and_classification_narrows():
    def spread(state):
        below = np.cumsum(state.crystals) / float(jnp.sum(state.crystals))
        q16, q50, q84 = np.interp([0.16, 0.5, 0.84], below, np.asarray(EDGES[1:]))
        return q50, (q84 - q16) / (2 * q50)

    plain, fines, classed = (
        spread(vessel()),
        spread(vessel(removal=Removal(5.0, 1e-4))),
        spread(vessel(removal=Removal(1.0, 0.0, 4.0, 4e-4))),
    )
    assert plain[1] == pytest.approx(0.52, abs=0.01)  # Randolph and Larson
    assert fines[0] > 1.1 * plain[0]
    assert classed[1] < plain[1]
