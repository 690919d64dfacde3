"""Finding the first points of a test that do not belong to its line: late clock, pressure not yet steady, first layer unlike the rest."""

from __future__ import annotations

import numpy as np
from scipy import stats

SIGNIFICANCE = 0.01
NOTICEABLE = 0.05
LEAST_LEFT = 4


def bad_start(x: np.ndarray, y: np.ndarray) -> int:
    """How many leading points to leave out of a straight line.

    At most the first third is in question. The line through the rest is carried back one point at a time; the first point that
    lies outside its 99 % prediction interval and more than 5 % off ends the walk: it and all before it are left out. Walking
    backwards, several bad points cannot hide each other.
    """
    most = min(len(x) // 3, len(x) - LEAST_LEFT)
    for first in range(most, 0, -1):
        u, v = x[first:], y[first:]
        slope, intercept = np.polyfit(u, v, 1)
        dof = len(u) - 2
        variance = np.sum((v - slope * u - intercept) ** 2) / dof
        spread = np.sqrt(variance * (1.0 + 1.0 / len(u) + (x[first - 1] - u.mean()) ** 2 / np.sum((u - u.mean()) ** 2)))
        expected = slope * x[first - 1] + intercept
        miss = abs(y[first - 1] - expected)
        if miss > stats.t.ppf(1.0 - SIGNIFICANCE / 2.0, dof) * spread and miss > NOTICEABLE * abs(expected):
            return first
    return 0


def bend(x: np.ndarray, y: np.ndarray) -> float:
    """Change of slope from one end of the points to the other over the mean slope; 0 where it is not significant at 1 %."""
    if len(x) < 6:
        return 0.0
    u = (x - x.mean()) / (x.max() - x.min())
    design = np.stack([np.ones_like(u), u, u**2], axis=1)
    found, *_rest = np.linalg.lstsq(design, y, rcond=None)
    dof = len(x) - 3
    variance = np.sum((y - design @ found) ** 2) / dof
    error = np.sqrt(variance * np.linalg.inv(design.T @ design)[2, 2])
    significant = abs(found[2]) > stats.t.ppf(1.0 - SIGNIFICANCE / 2.0, dof) * error
    return float(2.0 * found[2] / found[1]) if significant and found[1] != 0 else 0.0
