"""Design specifications: parameters found so that results take wanted values, derivatives included."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.flowsheet.sheet import Flowsheet
from granum.flowsheet.solving import Solution, solve
from granum.numerics import find_root, solve_system


class Target(NamedTuple):
    """Vary ``vary`` (unit.parameter) between ``lower`` and ``upper`` so that ``so_that`` (unit.result) equals
    ``equals``, all SI.
    """

    vary: str
    so_that: str
    equals: float
    lower: float
    upper: float


class Designed(NamedTuple):
    """A solved line that meets its specifications, with the values found."""

    line: Flowsheet
    solution: Solution
    values: dict[str, Any]
    converged: Any


def figure(solution: Solution, path: str) -> Any:
    """One result of a unit, ``unit.result``, from a solution with the sheet of that unit."""
    unit, _dot, name = path.partition(".")
    return getattr(solution.sheets[unit][0], name)


def design(line: Flowsheet, targets: tuple[Target, ...], *, sheets: bool = False, **how: Any) -> Designed:
    """Solve a line with its specifications: one by a bracketed root, several together by Newton's method from
    mid-range.

    ``how`` says how its loops are solved, as for ``solve``.
    """
    if not targets:
        solution = solve(line, sheets=sheets, **how)
        return Designed(line, solution, {}, solution.converged)
    asked = {t.so_that.partition(".")[0] for t in targets}
    if len(targets) == 1:
        target = targets[0]

        def miss(x: Any) -> Any:
            changed = line.with_values({target.vary: x})
            return (figure(solve(changed, sheets=asked, **how), target.so_that) - target.equals) / (
                abs(target.equals) or 1.0
            )

        root = find_root(miss, target.lower, target.upper)
        values, found = {target.vary: root.value}, root.converged
    else:
        low = jnp.asarray([t.lower for t in targets])
        width = jnp.asarray([t.upper for t in targets]) - low

        def misses(x: Any, _args: Any) -> Any:
            changed = line.with_values({t.vary: low[i] + width[i] * x[i] for i, t in enumerate(targets)})
            solution = solve(changed, sheets=asked, **how)
            return jnp.stack(
                [(figure(solution, t.so_that) - t.equals) / (abs(t.equals) or 1.0) for t in targets]
            )

        outcome = solve_system(misses, jnp.full((len(targets),), 0.5))
        inside = jnp.all((outcome.state >= 0) & (outcome.state <= 1))
        values = {t.vary: low[i] + width[i] * outcome.state[i] for i, t in enumerate(targets)}
        found = outcome.converged & inside
    final = line.with_values(values)
    solution = solve(final, sheets=sheets, **how)
    return Designed(final, solution, values, found & solution.converged)
