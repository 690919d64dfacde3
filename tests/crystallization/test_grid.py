"""Agglomeration and breakage against their closed solutions; the grid engine against the packets."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jax import lax
from tests.crystallization.cases import DURATION, START, linear_cooling, model, seeds

from granum.crystallization.formulas.agglomeration import (
    Attrition,
    ConstantKernel,
    PowerBreakage,
    ProductKernel,
    SumKernel,
    TurbulentKernel,
)
from granum.crystallization.population.grid import Grid, births_by_pairs, breakage_matrix, march_grid
from granum.crystallization.population.lagrangian import march
from granum.crystallization.population.operations import Programmed
from granum.crystallization.population.packets import Seeds


def exponential(cells, low, high):
    """Volume classes, and the numbers of exp(-v) in them: those below the grid join its first class."""
    v = np.concatenate([[0.0], np.geomspace(low, high, cells)])
    number = np.exp(-v[:-1]) - np.exp(-v[1:])
    return Grid(jnp.asarray(v ** (1 / 3))), jnp.asarray(number)


def integrate(rate, n, end, steps):
    h = end / steps

    def step(n, _):
        a = rate(n)
        b = rate(n + 0.5 * h * a)
        c = rate(n + 0.5 * h * b)
        return n + h / 6 * (a + 2 * b + 2 * c + rate(n + h * c)), None

    return jax.jit(lambda n: lax.scan(step, n, None, length=steps)[0])(n)


CASES = [
    (ConstantKernel(1.0), 100.0, 2000, (1e-3, 3e3), 2 / (2 + 100.0), 102.0, 0.02),
    (SumKernel(1.0), 1.0, 400, (1e-3, 1e3), np.exp(-1.0), 2 * np.exp(2.0), 0.05),
    (ProductKernel(1.0), 0.3, 400, (1e-3, 1e3), 1 - 0.15, 2 / (1 - 2 * 0.3), 0.05),
]


@pytest.mark.parametrize(("kernel", "end", "steps", "span", "count", "second", "error"), CASES, ids=["constant", "sum", "product"])
def test_agglomeration_of_an_exponential_distribution(kernel, end, steps, span, count, second, error):
    """Smoluchowski's moments in closed form: N(t) and the second moment of volume; volume itself is kept."""
    grid, n = exponential(80, *span)
    sizes = grid.sizes
    beta = kernel(sizes[:, None], sizes[None, :])
    start_volume, start_second = float(n @ grid.cubes), float(n @ grid.cubes**2)
    out = integrate(lambda n: births_by_pairs(n, beta, grid), n, end, steps)
    assert float(out @ grid.cubes) == pytest.approx(start_volume, rel=1e-10)
    assert float(jnp.sum(out)) == pytest.approx(count, rel=error)
    assert float(out @ grid.cubes**2) / (start_second / 2) == pytest.approx(second, rel=2 * error)
    assert bool(jnp.all(out >= 0))


def test_breakage_of_ziff_and_mcgrady():
    """S = v and uniform binary fragments: n = (1 + t)^2 exp(-v (1 + t)), so 1 + t particles."""
    grid, n = exponential(80, 1e-4, 30.0)
    matrix = breakage_matrix(PowerBreakage(1.0, 1.0, 3.0), grid)
    np.testing.assert_allclose(grid.cubes @ matrix, 0.0, atol=1e-12 * float(jnp.max(jnp.abs(matrix))))
    t = 10.0
    out = integrate(lambda n: matrix @ n, n, t, 2000)
    assert float(out @ grid.cubes) == pytest.approx(float(n @ grid.cubes), rel=1e-9)
    assert float(jnp.sum(out)) == pytest.approx(1 + t, rel=0.03)
    v = np.asarray(grid.edges) ** 3
    exact = (1 + t) * (np.exp(-v[:-1] * (1 + t)) - np.exp(-v[1:] * (1 + t)))
    assert float(np.sum(np.abs(np.asarray(out) - exact))) < 0.04 * (1 + t)


def test_attrition_keeps_volume():
    grid, _n = exponential(60, 1e-4, 30.0)
    matrix = breakage_matrix(Attrition(1.0, 1.0, 3.0, 0.02), grid)
    np.testing.assert_allclose(grid.cubes @ matrix, 0.0, atol=1e-12 * float(jnp.max(jnp.abs(matrix))))


def on_grid(**more):
    edges = jnp.linspace(0.0, 800e-6, 401)
    start = Seeds(seeds().low, seeds().high, seeds().number)
    low, high, number = start.low, start.high, start.number
    top = jnp.clip(edges[:, None], low, high)
    counts = jnp.diff(jnp.sum(number * (top - low) / (high - low), axis=1))
    return march_grid(model(), Programmed(linear_cooling), edges, counts, START, 1.0, jnp.linspace(0, DURATION, 1601), **more), counts


def test_grid_agrees_with_packets_on_the_published_batch():
    found, _counts = on_grid()
    exact = march(model(), Programmed(linear_cooling), seeds(), START, 1.0, jnp.linspace(0, DURATION, 1601))
    total = found.solute_per_solvent + found.crystals
    assert float(jnp.max(jnp.abs(total - total[0]))) < 1e-13
    assert float(jnp.max(found.courant)) < 1.0
    assert float(found.moments[-1, 0] / exact.moments[-1, 0]) == pytest.approx(1.0, rel=0.01)
    assert float(found.solute_per_solvent[-1]) == pytest.approx(float(exact.solute_per_solvent[-1]), rel=2e-4)


def test_agglomeration_in_a_batch_lowers_the_number_and_keeps_the_mass():
    plain, _counts = on_grid()
    found, _counts = on_grid(agglomeration=TurbulentKernel(50.0, 0.05))
    assert float(found.moments[-1, 0]) < 0.9 * float(plain.moments[-1, 0])
    total = found.solute_per_solvent + found.crystals
    assert float(jnp.max(jnp.abs(total - total[0]))) < 1e-13
