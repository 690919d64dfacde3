"""100 000 sieve analyses of 14 root-two classes to D[3,2], D[4,3], d10, d50 and d90, beside the library
``fluids`` in the same run.

    python -m benchmarks.sieve_analyses

``fluids`` takes one analysis at a time: its loop is timed over 200 analyses and scaled. Budget: 0.20 s warm
and 50 times the peer. Needs ``pip install granum[bench]``.
"""

from __future__ import annotations

import time
from dataclasses import replace

import jax
import jax.numpy as jnp
import numpy as np

import granum  # noqa: F401  (64-bit floats)
from benchmarks.rows import Row, installed, tell
from granum.particles.distributions import SizeDistribution

COUNT, SAMPLE = 100_000, 200
EDGES = 45e-6 * 2.0 ** (0.5 * np.arange(15))


@jax.jit
def figures(amounts: jax.Array) -> tuple[jax.Array, ...]:
    """The five figures of every analysis."""
    d = SizeDistribution(EDGES, amounts / amounts.sum(axis=1, keepdims=True))
    return d.mean(3, 2), d.mean(4, 3), d.percentile(jnp.array([0.1, 0.5, 0.9]))


def peer(amounts: np.ndarray) -> tuple[float, ...]:
    """The same figures of one analysis by the peer; not a number where it finds no percentile (in the
    outermost classes).
    """
    from fluids.numerics import NotBoundedError
    from fluids.particle_size_distribution import ParticleSizeDistribution

    d = ParticleSizeDistribution(ds=EDGES, fractions=(amounts / amounts.sum()).tolist(), order=3)

    def percentile(part: float) -> float:
        try:
            return d.dn(part)
        except NotBoundedError:
            return float("nan")

    return d.mean_size(3, 2), d.mean_size(4, 3), *map(percentile, (0.1, 0.5, 0.9))


def main() -> None:
    amounts = np.random.default_rng(0).uniform(0.0, 1.0, (COUNT, EDGES.size - 1))
    start = time.perf_counter()
    sauter, mass_mean, percentiles = jax.block_until_ready(figures(amounts))
    first = time.perf_counter() - start
    taken = []
    for _ in range(7):
        start = time.perf_counter()
        jax.block_until_ready(figures(amounts))
        taken.append(time.perf_counter() - start)
    asked = Row(
        "100 000 sieve analyses to five figures",
        float(np.median(taken)),
        "fluids",
        figures={"first call, s": first},
    )
    if installed("fluids") is None:
        tell(asked)
        return
    few = amounts[:: COUNT // SAMPLE]
    start = time.perf_counter()
    theirs = np.array([peer(row) for row in few])
    scaled = (time.perf_counter() - start) * COUNT / len(few)
    ours = np.column_stack([sauter, mass_mean, percentiles])[:: COUNT // SAMPLE]
    apart = abs(ours / theirs - 1.0)
    agreement = (
        f"{100 * apart[:, :2].max():.2g} % of the means, {100 * np.nanmax(apart[:, 2:]):.2g} % of percentiles"
    )
    tell(replace(asked, peer_seconds=scaled, agreement=agreement))
    print(f"percentiles the peer fails to find: {np.isnan(theirs).sum()} of {theirs[:, 2:].size}")


if __name__ == "__main__":
    main()
