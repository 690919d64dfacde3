"""Design specifications: parameters found so that results take wanted values, derivatives included."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.flowsheet.sheet import Flowsheet
from granum.flowsheet.solving import Solution, Wanted, solve

PASSES = 400
"""Passes through the loops of a line, and again for each parameter that is sought."""


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


def design(
    line: Flowsheet,
    targets: tuple[Target, ...],
    *,
    sheets: bool = False,
    near: Mapping[str, Any] | None = None,
    **how: Any,
) -> Designed:
    """Solve a line with its specifications, in one iteration with its loops: a single one within a bracket,
    several by Broyden's method.

    The search begins at the values that the line has, or that are ``near``, where these are within their
    limits, and in the middle otherwise. ``how`` says how loops are solved, as for ``solve``.
    """
    if not targets:
        solution = solve(line, sheets=sheets, **how)
        return Designed(line, solution, {}, solution.converged)
    how.setdefault("max_steps", PASSES * (1 + len(targets)))
    low = jnp.asarray([t.lower for t in targets])
    width = jnp.asarray([t.upper for t in targets]) - low

    def values(sought: Any) -> dict[str, Any]:
        return {t.vary: low[i] + width[i] * sought[i] for i, t in enumerate(targets)}

    def misses(sheets: Any) -> Any:
        figures = [getattr(sheets[unit][0], name) for unit, name in (_result(t) for t in targets)]
        wanted = np.asarray([t.equals for t in targets], dtype=float)
        return (jnp.stack(figures) - wanted) / np.where(wanted == 0.0, 1.0, abs(wanted))

    begun = jnp.stack([_number((near or {}).get(t.vary, line.value(t.vary))) for t in targets])
    share = jax.lax.stop_gradient((begun - low) / width)
    wanted = Wanted(
        jnp.where((share >= 0.0) & (share <= 1.0), share, 0.5),
        lambda sought: line.with_values(values(sought)),
        misses,
        frozenset(_result(t)[0] for t in targets),
        among(targets),
    )
    solution = solve(line, sheets=sheets, wanted=wanted, **how)
    found = values(solution.sought)
    return Designed(line.with_values(found), solution, found, solution.met)


def among(targets: tuple[Target, ...]) -> frozenset[str]:
    """Units and feeds that are varied or looked at."""
    return frozenset(path.partition(".")[0] for t in targets for path in (t.vary, t.so_that))


def _result(target: Target) -> tuple[str, str]:
    unit, _dot, name = target.so_that.partition(".")
    return unit, name


def _number(value: Any) -> Any:
    return jnp.asarray(jnp.nan if value is None else value, dtype=float)
