"""Studies of the potassium nitrate line (nine units, one recycle): cases a second, cost of a derivative; a
million cases of a formula.

    python benchmarks/studies.py

Budgets, warm, on 2 cores: 10 000 cases of the line within 10 s; figures with one directional derivative
within 5 solves.
"""

from __future__ import annotations

import time
from pathlib import Path

import jax
import jax.numpy as jnp

from granum.cases import read_studies

EXAMPLES = Path(__file__).parents[1] / "examples"


def best_of(job, repeats: int) -> float:
    """Shortest of several runs, s."""
    taken = []
    for _run in range(repeats):
        start = time.perf_counter()
        jax.block_until_ready(job())
        taken.append(time.perf_counter() - start)
    return min(taken)


def main() -> None:
    """Print the figures."""
    study = read_studies(EXAMPLES / "potassium-nitrate" / "studies.toml")["spread"]
    start = time.perf_counter()
    study.with_options(samples=64).run()
    print(f"line, first use (compilation): {time.perf_counter() - start:.1f} s")
    found = study.with_options(samples=10_000)
    times = [found.run().elapsed for _run in range(2)]
    print(f"line, 10 000 cases, warm: {min(times):.2f} s")

    inputs = tuple(study.uncertain)
    run, numbers = study.subject.traced(inputs, tuple(study.options["outputs"])), study.subject.numbers()
    at = jnp.array([study.subject.nominal(p) for p in inputs])
    solve = jax.jit(lambda x: run(numbers, x)[0])
    both = jax.jit(lambda x: jax.jvp(lambda x: run(numbers, x)[0], (x,), (x,)))
    jax.block_until_ready((solve(at), both(at)))
    one, two = best_of(lambda: solve(at), 50), best_of(lambda: both(at), 50)
    print(
        f"line, one solve {1e3 * one:.2f} ms, with a directional derivative {1e3 * two:.2f} ms: "
        f"{two / one:.2f} solves"
    )

    settling = read_studies(EXAMPLES / "studies" / "settling.toml")["spread"].with_options(samples=1_000_000)
    settling.run()
    print(f"formula, 1 000 000 cases, warm: {settling.run().elapsed:.2f} s")


if __name__ == "__main__":
    main()
