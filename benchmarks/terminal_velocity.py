"""A million terminal velocities of quartz in water, 1 µm to 20 mm, beside the library ``fluids`` in the same
run.

    python -m benchmarks.terminal_velocity

``fluids`` is scalar: its loop is timed over 20 000 sizes spread over the same range and scaled. Budget:
0.10 s warm and 50 times the peer. Needs ``pip install granum[bench]``.
"""

from __future__ import annotations

import time

import numpy as np

import granum
from benchmarks.rows import Row, installed, tell

COUNT, SAMPLE = 1_000_000, 20_000
PHASES = {"particle_density": 2650.0, "fluid_density": 998.0, "dynamic_viscosity": 1.0e-3}


def best_of(job, repeats: int = 7) -> tuple[float, float]:
    """Best and median seconds of several runs."""
    taken = []
    for _ in range(repeats):
        start = time.perf_counter()
        job()
        taken.append(time.perf_counter() - start)
    return min(taken), float(np.median(taken))


def main() -> None:
    sizes = np.geomspace(1e-6, 20e-3, COUNT)
    start = time.perf_counter()
    velocities = granum.particles.terminal_velocity(particle_diameter=sizes, **PHASES).block_until_ready()
    first = time.perf_counter() - start
    ours = best_of(
        lambda: granum.particles.terminal_velocity(particle_diameter=sizes, **PHASES).block_until_ready()
    )
    back = best_of(
        lambda: granum.particles.terminal_diameter(velocity=velocities, **PHASES).block_until_ready()
    )

    one = (
        best_of(
            lambda: [
                granum.particles.terminal_velocity(particle_diameter=85e-6, **PHASES) for _ in range(200)
            ]
        )[0]
        / 200
    )
    theirs, agreement = None, ""
    if fluids := installed("fluids"):
        few = sizes[:: COUNT // SAMPLE].tolist()
        start = time.perf_counter()
        peer = [fluids.v_terminal(D=d, rhop=2650.0, rho=998.0, mu=1.0e-3) for d in few]
        theirs = (time.perf_counter() - start) * COUNT / len(few)
        apart = np.asarray(velocities)[:: COUNT // SAMPLE] / np.asarray(peer) - 1.0
        agreement = f"{100 * abs(apart).max():.2g} % (other drag laws)"
    tell(
        Row(
            "a million terminal velocities",
            ours[1],
            "fluids",
            theirs,
            agreement,
            figures={"first call, s": first},
        )
    )
    tell(Row("a million diameters from terminal velocities", back[1], kind="alone"))
    tell(Row("one terminal velocity", one, kind="alone"))


if __name__ == "__main__":
    main()
