"""Seeded cooling batch of potassium nitrate: packets against a grid handed to a black-box stiff integrator,
in one run.

The peer is a flux-limited finite volume grid of 200 classes integrated by SciPy's BDF with its
finite-difference Jacobian, as several open tools do it. Accuracy is measured against moment equations at a
tolerance of 1e-11. Run: python -m benchmarks.seeded_batch
"""

from __future__ import annotations

import time

import jax
import jax.numpy as jnp
import numpy as np
from scipy.integrate import solve_ivp

import granum  # noqa: F401  (double precision)
from benchmarks.rows import Row, tell
from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.nucleation import PowerLawNucleation
from granum.crystallization.formulas.solubility_laws import PolynomialSolubility
from granum.crystallization.population.lagrangian import Model, SolventVolume, march
from granum.crystallization.population.operations import Programmed
from granum.crystallization.population.packets import Seeds
from granum.crystallization.vessels.crystals import Crystal

RHO, KG, G, KB, B, END = 2110.0, 6967e-6 / 60, 1.32, 2.78e13 / 60, 1.78, 4800.0
START = 0.1286 + 5.88e-3 * 32 + 1.721e-4 * 32**2
STEPS = 400


def density(size):
    return (110e-6 - size) * (size - 90e-6)


def solubility(theta):
    return 0.1286 + 5.88e-3 * theta + 1.721e-4 * theta**2


def ours(q):
    """Moments and composition at the end for six parameters: kinetics, end temperature, seed mass."""
    model = Model(
        PolynomialSolubility([0.1286, 5.88e-3, 1.721e-4]),
        PowerLawGrowth(q[0], q[1]),
        PowerLawNucleation(q[2] / RHO, q[3]),
        Crystal(RHO),
        SolventVolume(1000.0),
    )
    seeds = Seeds.of_density(density, jnp.linspace(90e-6, 110e-6, 33), q[5], RHO)
    course = march(
        model,
        Programmed(lambda t: 305.15 - q[4] * t / END),
        seeds,
        START,
        1.0,
        jnp.linspace(0.0, END, STEPS + 1),
    )
    return jnp.append(course.moments[-1], course.solute_per_solvent[-1])


def moments_by_scipy():
    x, w = np.polynomial.legendre.leggauss(20)
    size, weight = 100e-6 + 10e-6 * x, (1 - x**2) * w
    m = np.array([np.sum(weight * size**k) for k in range(5)])
    m *= 5e-4 / (RHO * m[3])
    total = START + RHO * m[3]

    def rates(t, y):
        y = y * m
        saturated = solubility(32 - 4 * t / END)
        S = max((total - RHO * y[3]) / saturated - 1, 0.0)
        grow, born = KG * S**G, KB * S**B * y[3] / 1.0
        return np.array([born, *(k * grow * y[k - 1] for k in range(1, 5))]) / m

    y = solve_ivp(rates, (0, END), np.ones(5), method="LSODA", rtol=1e-11, atol=1e-13).y[:, -1] * m
    return y, total - RHO * y[3]


def grid_by_bdf(cells=200, largest=800e-6):
    """Koren-limited finite volumes, solute from the grid's own third moment, BDF with finite differences."""
    edges = np.linspace(0.0, largest, cells + 1)
    width = edges[1]
    cubes = (edges[1:] ** 2 + edges[:-1] ** 2) * (edges[1:] + edges[:-1]) / 4
    L = np.clip(edges, 90e-6, 110e-6)
    number = np.diff(200e-6 * L**2 / 2 - L**3 / 3 - 110e-6 * 90e-6 * L)
    number *= 5e-4 / (RHO * np.sum(number * cubes))
    total = START + RHO * np.sum(number * cubes)
    scale = number.max()

    def rates(t, y):
        n = y * scale
        third = np.sum(n * cubes)
        S = max((total - RHO * third) / solubility(32 - 4 * t / END) - 1, 0.0)
        grow, born = KG * S**G, KB * S**B * third
        padded = np.concatenate([n[:1], n, n[-1:]])
        behind, ahead = padded[1:-1] - padded[:-2], padded[2:] - padded[1:-1]
        ratio = behind / np.where(np.abs(ahead) > 1e-300, ahead, 1e-300)
        limited = np.maximum(0, np.minimum(2 * ratio, np.minimum((1 + 2 * ratio) / 3, 2)))
        face = n + 0.5 * limited * ahead
        flux = np.concatenate([[born], grow * face / width])
        return -np.diff(flux) / scale

    found = solve_ivp(rates, (0, END), number / scale, method="BDF", rtol=1e-6, atol=1e-8)
    return found.y[:, -1] * scale, cubes, total


def clock(run, *given, repeat=30):
    jax.block_until_ready(run(*given))
    times = []
    for _ in range(repeat):
        begin = time.perf_counter()
        jax.block_until_ready(run(*given))
        times.append(time.perf_counter() - begin)
    return min(times), float(np.median(times))


def main():
    exact, composition = moments_by_scipy()
    q = jnp.array([KG, G, KB, B, 4.0, 5e-4])
    run, jacobian = jax.jit(ours), jax.jit(jax.jacfwd(ours))
    out = np.asarray(run(q))
    one = clock(run, q)[0]
    jac = clock(jacobian, q)[0]
    begin = time.perf_counter()
    number, _cubes, _total = grid_by_bdf()
    peer = time.perf_counter() - begin
    many = jax.jit(jax.vmap(ours))
    spread = q * (1 + 0.05 * np.random.default_rng(0).standard_normal((10_000, 6)))
    jax.block_until_ready(many(spread))
    begin = time.perf_counter()
    jax.block_until_ready(many(spread))
    ensemble = time.perf_counter() - begin
    worst = np.max(np.abs(out[:5] / exact - 1))
    print(f"packets, {STEPS} steps: composition {out[5] - composition:+.1e}")
    tell(
        Row(
            "a seeded cooling batch by packets",
            one,
            "grid of 200 classes by SciPy BDF",
            peer,
            f"packets {worst:.0e} (worst moment), grid {abs(number.sum() / exact[0] - 1):.0e} (number)",
        )
    )
    tell(Row("the seeded batch with exact derivatives to 6 parameters", jac, kind="alone"))
    tell(Row("10 000 seeded batches", ensemble, kind="alone"))
    budgets = {
        "moments within 1e-4": worst < 1e-4,
        "100 times the grid": peer > 100 * one,
        "a batch in 3 ms": one < 3e-3,
        "derivatives in 6 batches": jac < 6 * one,
        "10 000 batches in 15 s": ensemble < 15,
    }
    if missed := [words for words, met in budgets.items() if not met]:
        raise SystemExit(f"over budget: {', '.join(missed)}")


if __name__ == "__main__":
    main()
