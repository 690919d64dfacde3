"""Points of the unit cube: random, Latin hypercube, Sobol sequence; and the inputs they stand for."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy

from granum.core.errors import unknown_name
from granum.core.i18n import _
from granum.studies.distributions import Source

METHODS = ("latin_hypercube", "random", "sobol_sequence")


def unit_points(method: str, count: int, dimensions: int, seed: int) -> np.ndarray:
    """``count`` points of the unit cube; the same seed gives the same points."""
    if method not in METHODS:
        raise unknown_name(_("Sampling method"), method, METHODS)
    if method == "random":
        return np.random.default_rng(seed).random((count, dimensions))
    if method == "latin_hypercube":
        return scipy.stats.qmc.LatinHypercube(dimensions, rng=np.random.default_rng(seed)).random(count)
    whole = int(np.ceil(np.log2(max(count, 2))))  # the sequence is balanced at powers of two
    return scipy.stats.qmc.Sobol(dimensions, rng=np.random.default_rng(seed)).random_base2(whole)[:count]


def inputs_at(sources: Sequence[Source], points: np.ndarray) -> np.ndarray:
    """Values of all uncertain inputs, in the order of the sources, for points of the unit cube."""
    columns, place = [], 0
    for source in sources:
        columns.append(source.values(points[:, place : place + source.dimensions]))
        place += source.dimensions
    return np.concatenate(columns, axis=1)
