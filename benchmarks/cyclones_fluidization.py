"""A million minimum fluidization velocities and a hundred thousand cyclone ratings, beside scalar loops in
the same run.

    python -m benchmarks.cyclones_fluidization

The peer ``fluids`` knows no minimum fluidization: its user finds the root of its Ergun equation against the
weight of the bed, which is timed over 1 000 sizes and scaled. No open library rates cyclones; the ratings
stand alone. Budgets: 0.2 s warm each. Needs ``pip install granum[bench]``.
"""

from __future__ import annotations

import time

import jax
import numpy as np
from scipy.optimize import brentq

import granum
from benchmarks.rows import Row, installed, tell
from granum.cyclones.formulas import efficiency, pressure
from granum.cyclones.geometry import StandardCyclone

COUNT, RATINGS, SAMPLE = 1_000_000, 100_000, 1_000
AIR = {"particle_density": 2600.0, "fluid_density": 1.2, "dynamic_viscosity": 1.8e-5}


def best_of(job, repeats: int = 7) -> float:
    """Median seconds of several runs."""
    taken = []
    for _ in range(repeats):
        start = time.perf_counter()
        jax.block_until_ready(job())
        taken.append(time.perf_counter() - start)
    return float(np.median(taken))


def peer(fluids, d: float):
    """Minimum fluidization by the root of Ergun's pressure drop of one meter of bed."""
    weight = 0.6 * 2598.8 * 9.80665
    drop = fluids.packed_bed.Ergun
    return brentq(lambda U: drop(dp=d, voidage=0.4, vs=U, rho=1.2, mu=1.8e-5, L=1.0) - weight, 1e-9, 10.0)


def main() -> None:
    sizes = np.geomspace(2e-5, 5e-3, COUNT)
    flows, widths = np.linspace(0.5, 3.0, RATINGS), np.linspace(0.6, 1.4, RATINGS)
    shape = StandardCyclone()(widths)
    ergun = granum.fluidization.minimum_fluidization_velocity_ergun
    wen_yu = granum.fluidization.minimum_fluidization_velocity_wen_yu

    def rate():
        cut = efficiency.cut_size_muschelknautz(flows, 2600.0, 1.2, 1.8e-5, *shape, 0.01)
        caught = efficiency.cyclone_efficiency_muschelknautz(5e-6, flows, 2600.0, 1.2, 1.8e-5, *shape, 0.01)
        return cut, caught, pressure.pressure_drop_muschelknautz(flows, 2600.0, 1.2, *shape, 0.01)

    ours = best_of(lambda: ergun(particle_diameter=sizes, void_fraction=0.4, **AIR))
    simple = best_of(lambda: wen_yu(particle_diameter=sizes, **AIR))
    ratings = best_of(rate)
    scaled, agreement = None, ""
    if fluids := installed("fluids"):
        few = sizes[:: COUNT // SAMPLE].tolist()
        start = time.perf_counter()
        theirs = [peer(fluids, d) for d in few]
        scaled = (time.perf_counter() - start) * COUNT / len(few)
        same = np.asarray(ergun(particle_diameter=np.array(few), void_fraction=0.4, **AIR))
        agreement = f"{abs(same / np.array(theirs) - 1.0).max():.0e}"
    question = "a million minimum fluidization velocities by Ergun"
    tell(Row(question, ours, "root of fluids' Ergun", scaled, agreement))
    tell(Row("a million minimum fluidization velocities by Wen and Yu", simple, kind="alone"))
    tell(Row("100 000 cyclones: cut, grade and drop", ratings, kind="alone"))
    if max(ours, simple, ratings) > 0.2:
        raise SystemExit("over budget")


if __name__ == "__main__":
    main()
