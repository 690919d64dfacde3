"""Finding the first points of a test that do not belong to its line: late clock, pressure not yet steady,
first layer unlike the rest.
"""

from __future__ import annotations

import numpy as np
import scipy

SIGNIFICANCE = 0.01
NOTICEABLE = 0.05
LEAST_LEFT = 4


def bad_start(x: np.ndarray, y: np.ndarray) -> int:
    """How many leading points to leave out of a straight line.

    At most the first third is in question. The line through the rest is carried back one point at a time; the
    first point that lies outside its 99 % prediction interval and more than 5 % off ends the walk: it and all
    before it are left out. Walking backwards, several bad points cannot hide each other.
    """
    most = min(len(x) // 3, len(x) - LEAST_LEFT)
    if most < 1 or not np.ptp(x[most:]) > 0.0:
        return 0
    # every line at once: sums from the end of the centered and scaled points, which are the sums of each rest
    middle, width, level = x[most:].mean(), np.ptp(x) or 1.0, y[most:].mean()
    height = np.max(np.abs(y - level)) or 1.0
    u, v = (x - middle) / width, (y - level) / height
    first = np.arange(1, most + 1)
    left = len(x) - first
    su, sv, suu, suv, svv = (np.cumsum(z[::-1])[::-1][first] for z in (u, v, u * u, u * v, v * v))
    across = np.maximum(suu - su**2 / left, 1e-300)
    slope = (suv - su * sv / left) / across
    expected = sv / left + slope * (u[first - 1] - su / left)
    squares = np.maximum(svv - sv**2 / left - slope**2 * across, 1e-24)  # round-off is no scatter
    spread = np.sqrt(squares / (left - 2) * (1.0 + 1.0 / left + (u[first - 1] - su / left) ** 2 / across))
    miss = np.abs(v[first - 1] - expected)
    bad = (miss > scipy.stats.t.isf(SIGNIFICANCE / 2.0, left - 2) * spread) & (
        miss * height > NOTICEABLE * np.abs(level + height * expected)
    )
    return int(first[bad][-1]) if bad.any() else 0


def bend(x: np.ndarray, y: np.ndarray) -> float:
    """Change of slope from one end of the points to the other over the mean slope; 0 where it is not
    significant at 1 %.
    """
    if len(x) < 6:
        return 0.0
    u = (x - x.mean()) / (x.max() - x.min())
    design = np.stack([np.ones_like(u), u, u**2], axis=1)
    found, *_rest = np.linalg.lstsq(design, y, rcond=None)
    dof = len(x) - 3
    variance = np.sum((y - design @ found) ** 2) / dof
    error = np.sqrt(variance * np.linalg.inv(design.T @ design)[2, 2])
    significant = abs(found[2]) > scipy.stats.t.ppf(1.0 - SIGNIFICANCE / 2.0, dof) * error
    return float(2.0 * found[2] / found[1]) if significant and found[1] != 0 else 0.0
