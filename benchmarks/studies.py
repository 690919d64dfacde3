"""Studies of the potassium nitrate line (nine units, one recycle): cases a second, cost of a derivative; a
million cases of a formula.

    python -m benchmarks.studies

Budgets, warm, on 2 cores: 10 000 cases of the line within 10 s; figures with one directional derivative
within 5 solves.
"""

from __future__ import annotations

import time
from pathlib import Path

import jax
import jax.numpy as jnp

from benchmarks.rows import Row, tell
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
    """Measure and hand over."""
    study = read_studies(EXAMPLES / "potassium-nitrate" / "studies.toml")["spread"]
    start = time.perf_counter()
    study.with_options(samples=64).run()
    first = time.perf_counter() - start
    found = study.with_options(samples=10_000)
    times = [found.run().elapsed for _run in range(2)]
    tell(
        Row(
            "10 000 cases of the potassium nitrate line",
            min(times),
            kind="alone",
            figures={"first call, s": first},
        )
    )

    inputs = tuple(study.uncertain)
    run, numbers = study.subject.traced(inputs, tuple(study.options["outputs"])), study.subject.numbers()
    at = jnp.array([study.subject.nominal(p) for p in inputs])
    solve = jax.jit(lambda x: run(numbers, x)[0])
    both = jax.jit(lambda x: jax.jvp(lambda x: run(numbers, x)[0], (x,), (x,)))
    jax.block_until_ready((solve(at), both(at)))
    one, two = best_of(lambda: solve(at), 50), best_of(lambda: both(at), 50)
    tell(Row("one solve of the potassium nitrate line", one, kind="alone"))
    tell(Row("one solve of that line with a directional derivative", two, kind="alone"))

    settling = read_studies(EXAMPLES / "studies" / "settling.toml")["spread"].with_options(samples=1_000_000)
    settling.run()
    tell(Row("a million cases of a formula as a study", settling.run().elapsed, kind="alone"))


if __name__ == "__main__":
    main()
