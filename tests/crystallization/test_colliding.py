"""Crystals that meet and break in a mixed vessel: closed forms of the moments, the vessel without collisions,
balances of what strangers ask.
"""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ive

from granum.crystallization.formulas.agglomeration import (
    Attrition,
    ConstantKernel,
    PowerBreakage,
    TurbulentKernel,
)
from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.nucleation import PowerLawNucleation
from granum.crystallization.formulas.solubility_laws import PolynomialSolubility
from granum.crystallization.population import standing
from granum.crystallization.population.grid import Collisions
from granum.crystallization.population.standing import classes_for, round_of
from granum.crystallization.vessels.crystals import Crystal
from granum.crystallization.vessels.msmpr import AdditiveVolumes, Feed, Removal, steady_msmpr

# Potassium nitrate in water: Miller and Rawlings (1994), Chung, Ma and Braatz (1999), in SI units.
SOLUBILITY = PolynomialSolubility([0.1286, 5.88e-3, 1.721e-4])
GROWTH = PowerLawGrowth(6967e-6 / 60, 1.32)
NUCLEATION = PowerLawNucleation(2.78e7 * 1e6 / 60 / 2110.0, 1.78)
EDGES = np.linspace(0.0, 4e-3, 101)
VOLUME, TIME = 2.0, 3000.0


def vessel(kernel=None, breakage=None, solute=0.5, volume=5.0, crystals=None, removal=None, edges=EDGES):
    collisions = None if kernel is None and breakage is None else Collisions(kernel, breakage)
    fed = jnp.zeros(len(edges) - 1) if crystals is None else crystals
    there = (SOLUBILITY, GROWTH, NUCLEATION, Crystal(2110.0), AdditiveVolumes(2500.0, 998.0), edges)
    return steady_msmpr(
        Feed(solute, 1.0, fed), 293.15, volume, *there, removal=removal, collisions=collisions
    )


def rest(kernel, breakage, born, growth, sizes=(0.0,), largest=4e-3):
    """The population at rest, by repeated substitution."""
    classes = classes_for(growth * TIME, 1.0 / TIME, largest, None)
    numbers, sizes = jnp.atleast_1d(jnp.asarray(born)), jnp.asarray(sizes)

    @jax.jit
    def again(state):
        made = round_of(Collisions(kernel, breakage), classes, state, numbers, sizes, growth, VOLUME)
        return made.numbers, made.cubes

    state = jnp.zeros_like(classes.low), jnp.zeros_like(classes.low)
    for _round in range(120):
        state = again(state)
    return classes, state


@pytest.mark.parametrize("beta", [1e-12, 1e-9, 1e-6])
def test_number_of_a_constant_kernel(beta: float):
    """Smoluchowski's balance of the mixed vessel: β m₀²/2 + m₀/τ = B, whatever the growth; up to some
    thousand encounters in a residence time.
    """
    born = 1e6
    _classes, (numbers, _cubes) = rest(ConstantKernel(beta), None, born, 1e-7)
    a = beta * TIME / VOLUME
    expected = (np.sqrt(1.0 + 2.0 * a * born * TIME) - 1.0) / a
    assert float(jnp.sum(numbers)) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("T", [1.0, 100.0])
def test_agglomeration_alone_against_the_closed_form(monkeypatch, T: float):
    """Steady vessel, constant kernel, feed exponential in volume (the case of Hounslow 1990), by Laplace's
    transform of n + a n m₀ = n_in + a n*n/2: n(u) = [I₀(x) - I₁(x)] exp(-(1+T)u/(1+2T)) / √(1+2T) over N₀/v₀,
    u = v/v₀, x = T u/(1+2T), T = a N₀. The feed comes in narrow classes, without growth.
    """
    monkeypatch.setattr(standing, "CLASSES", 256)
    cuts = np.geomspace(0.01, 40.0, 400)
    share = np.exp(-cuts[:-1]) - np.exp(-cuts[1:])
    held = (cuts[:-1] + 1) * np.exp(-cuts[:-1]) - (cuts[1:] + 1) * np.exp(-cuts[1:])
    mean, born = 1e-12, 1e6
    kernel = ConstantKernel(T * VOLUME / (born * TIME * TIME))
    classes, (numbers, cubes) = rest(
        kernel, None, born * share, 1e-10, (mean * held / share) ** (1 / 3), 5e-4 * (1 + 2 * T) ** (1 / 3)
    )
    assert float(jnp.sum(numbers)) == pytest.approx(born * TIME * (np.sqrt(1 + 2 * T) - 1) / T, rel=0.01)

    def volume(u):
        x = T * u / (1 + 2 * T)
        return u * (ive(0, x) - ive(1, x)) * np.exp(x - (1 + T) * u / (1 + 2 * T)) / np.sqrt(1 + 2 * T)

    assert quad(volume, 0, 400 * (1 + 2 * T), limit=200)[0] == pytest.approx(1.0, rel=1e-5)
    below = np.cumsum(cubes) / float(jnp.sum(cubes))
    for at in np.array([0.5, 1.0, 2.0, 4.0, 8.0]) * (1 + 2 * T) / 3:
        found = np.interp((at * mean) ** (1 / 3), np.asarray(classes.high), below)
        assert found == pytest.approx(quad(volume, 0, at)[0], abs=0.02 if T < 100 else 0.025)


def test_number_that_breakage_makes():
    """A frequency as the cube of size, two fragments: m₀ = τ (B + s m₃), and growth alone makes volume."""
    frequency, size = 2e-5, 5e-4
    _classes, (numbers, cubes) = rest(None, PowerBreakage(frequency, size), 1e6, 1e-7)
    broken = frequency / size**3 * float(jnp.sum(cubes))
    assert float(jnp.sum(numbers)) == pytest.approx(TIME * (1e6 + broken), rel=0.01)
    _classes, (_numbers, chipped) = rest(None, Attrition(frequency, size), 1e6, 1e-7)
    plain = 6.0 * 1e6 * TIME * (1e-7 * TIME) ** 3
    assert float(jnp.sum(cubes)) > plain
    assert float(jnp.sum(chipped)) > plain  # chips grow on


def test_vessel_without_collisions_is_the_plain_one():
    removal = Removal(3.0, 8e-5, 2.5, 4e-4)
    plain, same = vessel(removal=removal), vessel(ConstantKernel(0.0), removal=removal)
    np.testing.assert_allclose(same.crystals, plain.crystals, rtol=1e-6, atol=1e-11)
    assert float(same.magma_density) == pytest.approx(float(plain.magma_density), rel=1e-8)
    assert float(same.nucleation_rate) == pytest.approx(float(plain.nucleation_rate), rel=1e-6)


def test_crystals_that_meet_often():
    """A vessel is solved where crystals meet some hundred times in a residence time, or meet and break, and
    rarer surface wants more supersaturation; what enters leaves.
    """
    edges = np.concatenate([[0.0], np.geomspace(1e-5, 0.1, 100)])
    for kernels, breakage in (
        ([ConstantKernel(k) for k in np.geomspace(1e-12, 1e-9, 7)], None),
        ([TurbulentKernel(100.0, e) for e in np.geomspace(1e-4, 1e-1, 7)], PowerBreakage(1e-3, 5e-4)),
    ):
        found = [vessel(kernel, breakage, edges=edges) for kernel in kernels]
        assert all(bool(one.converged) for one in found)
        over = [float(one.relative_supersaturation) for one in found]
        assert over == sorted(over)
        assert over[-1] > 3.0 * over[0]
        for one in found:
            assert float(jnp.sum(one.crystals) + one.solute) == pytest.approx(0.5, abs=1e-12)
            assert float(one.crystals[-1]) < 1e-4 * float(jnp.sum(one.crystals))


def test_random_vessels_close():
    rng = np.random.default_rng(7)
    for number in range(24):
        kernel = ConstantKernel(10 ** rng.uniform(-16.0, -12.5))
        breakage = PowerBreakage(10 ** rng.uniform(-7.0, -4.0), 5e-4)
        seeds = jnp.zeros(100).at[int(rng.integers(2, 60))].set(rng.choice([0.0, 0.02, 0.1]))
        solute = rng.uniform(0.2, 0.6)
        found = vessel(kernel, breakage, solute, 10 ** rng.uniform(-3.0, 1.2), seeds)
        assert bool(found.converged), number
        assert float(jnp.sum(found.crystals) + found.solute) == pytest.approx(
            solute + float(jnp.sum(seeds)), abs=1e-12
        )
        assert float(jnp.min(found.crystals)) >= -1e-9


@pytest.mark.long
def test_gradient_and_order():
    """The same vessel as above; a gradient compiles for some seconds."""

    def over(coefficient):
        return vessel(ConstantKernel(coefficient), PowerBreakage(1e-6, 5e-4)).relative_supersaturation

    slope = (over(1.01e-13) - over(0.99e-13)) / 2e-15
    assert float(jax.grad(over)(1e-13)) == pytest.approx(float(slope), rel=1e-3)
    values = [float(over(k)) for k in (1e-15, 1e-14, 1e-13, 1e-12)]
    assert values == sorted(values)  # less surface, more supersaturation
