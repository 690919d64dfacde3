"""Whether a size analysis is to be believed, judged by its classes.

The cumulative curve, to which the law is fitted, hides a wrong class: one wild mass shifts every point above
it and, through the sum, all others. The shares of the classes are nearly independent, and a class of unknown
mass only changes the scale of the others, which is fitted with the law.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np
import scipy

from granum.core.errors import ConvergenceError, InputError
from granum.core.i18n import _
from granum.estimation import Fit
from granum.estimation.verdicts import no_relation_note, stray_note

if TYPE_CHECKING:
    from granum.particles.lab_tests.size_test import SizeTest

SCALE = "scale"
IMPROBABLE = 0.002
MISFIT = 0.05
"""No law of sizes holds better than this: what moves an estimate less is the misfit of the law, not a wild
class.
"""


def judged_by_class(test: SizeTest, found: Fit, curve: Callable[[Any, Any], Any], rows: np.ndarray) -> Fit:
    """The fit of a cumulative curve with what its classes say: stray ones, and whether they follow the law at
    all.
    """
    sizes, below = test.points()
    shares = np.diff(below, prepend=0.0, append=1.0)

    def model(p: dict[str, Any], x: Any) -> Any:
        return p[SCALE] * jnp.diff(
            curve({n: v for n, v in p.items() if n != SCALE}, x), prepend=0.0, append=1.0
        )

    try:
        classes = test.fitted(
            model,
            {**found.values, SCALE: 1.0},
            sizes,
            shares,
            index=rows,
            bounds={**found.problem.bounds, SCALE: (1e-3, 1e3)},
        )
    except (ConvergenceError, InputError):  # too few classes to judge them
        return found
    told = classes.diagnostics
    assert told is not None
    flags = found.flags + no_relation_note(classes, told.probability)
    if told.stray:
        expected = np.asarray(model({**told.without}, sizes)) / told.without[SCALE]
        corrected = shares.copy()
        left = np.delete(np.arange(shares.size), told.stray)
        corrected[list(told.stray)] = (
            expected[list(told.stray)] * shares[left].sum() / max(expected[left].sum(), 1e-12)
        )
        best = np.array(list(found.values.values())) / found.problem.scale
        q, _outcome = found.problem.solve(best, y=np.cumsum(corrected / corrected.sum())[:-1])
        told = replace(
            told,
            without=dict(zip(found.values, (q * found.problem.scale).tolist(), strict=True)),
            robust={n: v for n, v in told.robust.items() if n != SCALE},
        )
        named = replace(test.rows(sizes, shares, rows), elsewhere=_("What passed the finest sieve"))
        flags += stray_note(told, found, named, MISFIT)
    return replace(found, flags=flags, diagnostics=told)


def improbable_particles(sizes: np.ndarray, below: np.ndarray) -> dict[int, float]:
    """Particles too large or too small for the law, by index, with their deviation; ``below`` is the law at
    their sizes.

    Among n particles the largest exceeds a size with the probability 1 - Fⁿ.
    """
    n, found = sizes.size, {}
    for k, beyond, sign in (
        (int(np.argmax(sizes)), 1.0 - below[np.argmax(sizes)], 1.0),
        (int(np.argmin(sizes)), below[np.argmin(sizes)], -1.0),
    ):
        if -np.expm1(n * np.log1p(-min(max(float(beyond), 0.0), 1.0 - 1e-16))) < IMPROBABLE:
            found[k] = sign * float(scipy.stats.norm.isf(max(float(beyond), 1e-300)))
    return found
