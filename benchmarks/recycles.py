"""How each way to bring a loop to rest does on the corpus of hard recycles.

    python -m benchmarks.recycles

Passes through the units for Anderson's method, steps for Newton's (each with directional derivatives of the
whole loop); "–" where the way does not converge. What has no steady state must fail in all of them.
"""

from __future__ import annotations

from typing import Any

import jax
import numpy as np
from tests.flowsheet.corpus import cases as corpus

from benchmarks.rows import Row, tell
from granum.core.packing import compiled
from granum.flowsheet import solve
from granum.numerics import Anderson, Continuation


@compiled
def substituted(line: Any) -> Any:
    """Plain substitution: nothing remembered."""
    return solve(line, method=Anderson(window=0), max_steps=5000)


@compiled
def anderson(line: Any) -> Any:
    """What a line is solved with first."""
    return solve(line)


@compiled
def continuation(line: Any) -> Any:
    """What is tried when that fails; here from empty torn streams."""
    return solve(line, method=Continuation(), max_steps=60)


WAYS = {
    "substitution": substituted,
    "Anderson": anderson,
    "continuation": continuation,
}


def main() -> None:
    passed = dict.fromkeys(WAYS, 0)
    for name, case in corpus.CASES.items():
        line = jax.tree.map(lambda x: np.asarray(x) if isinstance(x, float) else x, case().line)
        found = {way: run(line) for way, run in WAYS.items()}
        for way, solution in found.items():
            passed[way] += bool(solution.converged)
        steps = {
            way: str(sum(int(n) for n in s.steps)) if bool(s.converged) else "–" for way, s in found.items()
        }
        tell(Row(name, kind="recycle", figures=steps))
    solved = {way: str(n) for way, n in passed.items()}
    tell(Row(f"solved of {len(corpus.CASES)}", kind="recycle", figures=solved))
    for name, case in corpus.REFUSED.items():
        line = jax.tree.map(lambda x: np.asarray(x) if isinstance(x, float) else x, case().line)
        steps = {way: "WRONG" if bool(run(line).converged) else "–" for way, run in WAYS.items()}
        tell(Row(f"no steady state: {name}", kind="recycle", figures=steps))


if __name__ == "__main__":
    main()
