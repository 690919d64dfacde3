"""A settling curve h(t) made usable: cleaned, split into zones, and its tangents taken without a hand.

The tangents are the straight pieces of the best convex falling curve through the points (non-negative least
squares on ramps): each piece, prolonged to the axis, is one of Kynch's tangents.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import scipy

from granum.core.errors import InputError
from granum.core.i18n import _

LEAST_POINTS, MOST_POINTS = 5, 300
LEAST_NOISE = 0.002  # of the initial height: reading error below which nobody measures
LAG_SLOPE = 0.7  # first slopes below this share of the steepest mean that the suspension had not come to rest


class Tangents(NamedTuple):
    """Kynch's tangents: time at the middle of the piece, height where it cuts the axis, settling velocity."""

    time: np.ndarray
    intercept_height: np.ndarray
    settling_velocity: np.ndarray


class Convex(NamedTuple):
    """Best convex falling curve: values at the points, and its straight pieces."""

    height: np.ndarray
    tangents: Tangents


class Straight(NamedTuple):
    """A regression line: value at zero time, velocity of fall and its standard error, number of points."""

    height: float
    velocity: float
    standard_error: float
    points: int


class Compression(NamedTuple):
    """Compression point and the height the bed tends to."""

    index: int
    time: float
    height: float
    final_height: float


@dataclass(frozen=True)
class Curve:
    """A cleaned settling curve; ``time`` counts from the end of the induction. ``said`` tells what was done
    to the data.
    """

    time: np.ndarray
    height: np.ndarray
    initial_height: float
    induction_time: float
    noise: float
    convex: Convex
    constant_rate: Straight
    compression: Compression | None
    said: tuple[tuple[str, str], ...]

    @property
    def constant_rate_end(self) -> float:
        """Time of the last point of constant rate, from the end of the induction."""
        return float(self.time[self.constant_rate.points - 1])


def falling(height: np.ndarray) -> np.ndarray:
    """Closest non-increasing sequence (pool adjacent violators)."""
    blocks: list[list[float]] = []
    for value in height:
        blocks.append([float(value), 1.0])
        while len(blocks) > 1 and blocks[-2][0] < blocks[-1][0]:
            (a, m), (b, n) = blocks[-2:]
            blocks[-2:] = [[(a * m + b * n) / (m + n), m + n]]
    return np.concatenate([np.full(int(n), value) for value, n in blocks])


def convex_curve(time: np.ndarray, height: np.ndarray) -> Convex:
    """Best convex, non-increasing, piecewise straight curve through points."""
    scale = time[-1]
    ramps = np.maximum(time[None, 1:] - time[:, None], 0.0) / scale
    matrix = np.hstack([np.ones((time.size, 1)), ramps])
    weights, _residual = scipy.optimize.nnls(matrix, height)
    fitted = matrix @ weights
    knots = np.concatenate([[time[0]], time[1:][weights[1:] > 1e-9 * height.max()]])
    if knots[-1] < time[-1]:
        knots = np.append(knots, time[-1])
    at = np.interp(knots, time, fitted)
    middle, velocity = 0.5 * (knots[1:] + knots[:-1]), -np.diff(at) / np.diff(knots)
    cut = 0.5 * (at[1:] + at[:-1]) + velocity * middle
    real = velocity > 0
    return Convex(fitted, Tangents(middle[real], cut[real], velocity[real]))


def read_curve(time: Any, height: Any, initial_height: float | None = None) -> Curve:
    """Clean a curve, find the induction, the zone of constant rate and the compression point."""
    said: list[tuple[str, str]] = []
    t, h = np.asarray(time, dtype=float), np.asarray(height, dtype=float)
    if t.size < LEAST_POINTS:
        raise InputError(
            _("A settling curve needs at least {least} points; {given} were given.").format(
                least=LEAST_POINTS, given=t.size
            )
        )
    if np.any(np.diff(t) < 0):
        order = np.argsort(t, kind="stable")
        t, h = t[order], h[order]
        said.append(("sorted", _("The points were put in order of time.")))
    unique, first, count = np.unique(t, return_index=True, return_counts=True)
    if unique.size < t.size:
        h = np.add.reduceat(h, first) / count
        t = unique
        said.append(("averaged", _("Points at equal times were averaged.")))
    if t.size > MOST_POINTS:  # the convex curve takes a matrix of points by points
        edges = np.linspace(0, t.size, MOST_POINTS + 1).astype(int)[:-1]
        sizes = np.diff(np.append(edges, t.size))
        said.append(
            (
                "thinned",
                _("{count} points were averaged in groups to {most}.").format(count=t.size, most=MOST_POINTS),
            )
        )
        t, h = np.add.reduceat(t, edges) / sizes, np.add.reduceat(h, edges) / sizes
    smooth = falling(h)
    moved = np.abs(smooth - h)
    if np.any(moved > 1e-12 * h.max()):
        said.append(
            (
                "made falling",
                _(
                    "{count} heights rose with time and were averaged with their neighbors, by at most "
                    "{most} mm."
                ).format(
                    count=int(np.count_nonzero(moved > 1e-12 * h.max())),
                    most=round(1e3 * float(moved.max()), 3),
                ),
            )
        )
        h = smooth
    start = float(h[0] if initial_height is None else initial_height)
    if not h[0] - h[-1] > 0.02 * start:
        raise InputError(
            _("The interface hardly falls: from {first} to {last} m. Is this a settling curve?").format(
                first=h[0], last=h[-1]
            )
        )
    skip = _induction(t, h)
    convex = convex_curve(t[skip:], h[skip:])
    spread = float(np.sqrt(np.sum((h[skip:] - convex.height) ** 2) / max(t.size - skip - 3, 1)))
    noise = max(spread, LEAST_NOISE * start)
    line = _constant_rate(t[skip:], h[skip:], noise)
    if line.points == 2:
        said.append(
            (
                "no zone of constant rate",
                _(
                    "There is no zone of constant rate: the first three points do not lie on a line. The "
                    "first settling velocity is that between the first two readings, and is at least this. "
                    "Sample earlier or dilute the suspension."
                ),
            )
        )
    lag = max((start - line.height) / -line.velocity, 0.0) if skip else 0.0
    if skip:
        said.append(
            (
                "induction left out",
                _(
                    "The first {count} points settle slower than the later ones: an induction time of "
                    "{lag} s was taken off."
                ).format(count=skip, lag=round(lag, 1)),
            )
        )
    t, h = t[skip:] - lag, h[skip:]
    line = line._replace(height=line.height - line.velocity * lag)
    return Curve(
        t, h, start, lag, noise, convex_curve(t, h), line, _compression(t, h, line.points), tuple(said)
    )


def _induction(t: np.ndarray, h: np.ndarray) -> int:
    """Number of first points that are still slower than what follows."""
    slopes = -np.diff(h) / np.diff(t)
    early = slopes[: max(2, slopes.size // 2)]
    steepest = int(np.argmax(early))
    slow = np.flatnonzero(early[:steepest] < LAG_SLOPE * early[steepest])
    return (
        int(slow[-1]) + 1
        if slow.size and early[steepest] - early[slow[-1]] > 3 * LEAST_NOISE * h[0] / np.diff(t)[slow[-1]]
        else 0
    )


def _line(t: np.ndarray, h: np.ndarray) -> tuple[Straight, np.ndarray]:
    centered = t - t.mean()
    slope = float(centered @ h / (centered @ centered))
    residual = h - h.mean() - slope * centered
    variance = float(residual @ residual) / max(t.size - 2, 1)
    error = float(np.sqrt(variance / (centered @ centered)))
    return Straight(float(h.mean() - slope * t.mean()), -slope, error, t.size), residual


def _constant_rate(t: np.ndarray, h: np.ndarray, noise: float) -> Straight:
    """The longest straight start of the curve; its first two points where three already bend."""
    found, residual = _line(t[:3], h[:3])
    if np.max(np.abs(residual)) > 3 * noise:
        found, _none = _line(t[:2], h[:2])
        return found
    for count in range(4, t.size + 1):
        line, residual = _line(t[:count], h[:count])
        ahead = h[count - 1] - (found.height - found.velocity * t[count - 1])
        if np.max(np.abs(residual)) > 3 * noise or ahead > 3 * noise:
            break
        found = line
    if found.velocity <= 0:
        raise InputError(_("There is no zone of constant rate: the interface does not fall at the start."))
    return found


def _decay(t: np.ndarray, h: np.ndarray) -> tuple[float, float]:
    """Sum of squares and asymptote of the best ``h∞ + A e^{−kt}``, both terms non-negative."""
    span = t[-1] - t[0]
    best = (np.inf, float(h[-1]))
    for k in np.geomspace(0.2, 60.0, 30) / span:
        matrix = np.column_stack([np.ones(t.size), np.exp(-k * (t - t[0]))])
        (level, _amplitude), rest = scipy.optimize.nnls(matrix, h)
        best = min(best, (rest**2, level))
    return best


def _compression(t: np.ndarray, h: np.ndarray, start: int) -> Compression | None:
    """Roberts' construction: the falling-rate part is two exponential approaches, which meet at the
    compression point.
    """
    first = start - 1
    if t.size - first < 9:
        return None
    alone = _decay(t[first:], h[first:])[0]
    choices = np.unique(np.linspace(first + 4, t.size - 5, 24).astype(int))
    scores = [
        (_decay(t[first : c + 1], h[first : c + 1])[0] + (tail := _decay(t[c:], h[c:]))[0], int(c), tail[1])
        for c in choices
    ]
    score, at, final = min(scores)
    if score > 0.5 * alone:
        return None
    return Compression(at, float(t[at]), float(h[at]), min(final, float(h[-1])))
