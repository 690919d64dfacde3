"""Start-up as a person meets it: the processor time of whole commands, in times of ``import jax``.

    python -m benchmarks.starting [--rounds 3]

Each round runs every command once after ``python -c "import jax"``, those that solve first with nothing
compiled in the cache, then again; the median of the rounds counts.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from statistics import median

from benchmarks.commands import GRANUM, Cost, cost, empty_cache
from benchmarks.rows import Row, tell

JAX = '`python -c "import jax"`'
GRAIN = "particle_diameter=85um particle_density=2630 fluid_density=1020 dynamic_viscosity=1.2cP"
LIGHT = {
    "`granum --help`": "--help",
    "`granum list`": "list",
    "`granum show particles.terminal_velocity`": "show particles.terminal_velocity",
    "`granum calc particles.terminal_velocity …`": f"calc particles.terminal_velocity {GRAIN}",
}
SOLVING = {
    "`granum run potassium-nitrate/line.toml`": "run examples/potassium-nitrate/line.toml",
    "`granum run potassium-nitrate/full.toml`": "run examples/potassium-nitrate/full.toml",
    "`granum study studies/settling.toml spread`": "study examples/studies/settling.toml spread",
}


def one_round() -> dict[str, Cost]:
    """The cost of every command, ``import jax`` first."""
    with empty_cache() as environment:
        found = {JAX: cost([GRANUM[0], "-c", "import jax"], environment)}
        for typed, words in LIGHT.items():
            found[typed] = cost([*GRANUM, *words.split()], environment)
    for typed, words in SOLVING.items():
        with empty_cache() as environment:
            for turn in ("first", "second"):
                found[f"{typed}, {turn}"] = cost([*GRANUM, *words.split()], environment)
    return found


def middle(costs: list[Cost]) -> Cost:
    """Medians of several runs; a failure of any of them counts."""
    told = max(costs, key=lambda c: abs(c.status))
    medians = {name: median(getattr(c, name) for c in costs) for name in ("processor", "wall", "memory")}
    return replace(told, **medians)


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    options.add_argument("--rounds", type=int, default=3)
    rounds = []
    with empty_cache() as environment:  # Python's bytecode is written beforehand, as an installation does
        for words in {**LIGHT, **SOLVING}.values():
            cost([*GRANUM, *words.split()], environment)
    for turn in range(options.parse_args().rounds):
        print(f"round {turn + 1}", flush=True)
        rounds.append(one_round())
    typical = {typed: middle([found[typed] for found in rounds]) for typed in rounds[0]}
    for typed, found in typical.items():
        tell(
            Row(
                typed,
                found.processor,
                "import jax",
                typical[JAX].processor,
                kind="start",
                figures=found.figures,
            )
        )


if __name__ == "__main__":
    main()
