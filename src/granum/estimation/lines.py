"""Straight lines and parabolas through points, where a fit takes its first values from."""

from __future__ import annotations

from typing import Any

import numpy as np

from granum.core.errors import InputError
from granum.core.i18n import _


def straight_line(x: Any, y: Any) -> tuple[float, float]:
    """Slope and intercept by least squares.

    >>> straight_line([0.0, 1.0, 2.0], [1.0, 3.0, 5.0])
    (2.0, 1.0)
    """
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    if not (np.all(np.isfinite(x)) and np.all(np.isfinite(y))):
        raise InputError(
            _("The points give no finite numbers to fit: a zero or a negative value stands where none can.")
        )
    across = x - x.mean() if x.size else x
    width = float(across @ across)
    if (
        x.size < 2
        or not np.max(np.abs(across)) > 1e-12 * np.max(np.abs(x))
        or not np.isfinite(width)
        or width <= 0.0
    ):
        raise InputError(
            _(
                "All points lie at one place, so no line can be drawn through them: measure at "
                "different conditions."
            )
        )
    slope = float(across @ y) / width
    return slope, float(y.mean() - slope * x.mean())


def polynomial(x: Any, y: Any, degree: int) -> list[float]:
    """Coefficients by least squares, the constant first.

    >>> [round(c, 9) for c in polynomial([0.0, 1.0, 2.0, 3.0], [1.0, 3.0, 7.0, 13.0], 2)]
    [1.0, 1.0, 1.0]
    """
    straight_line(x, y)
    places = len(np.unique(np.asarray(x, dtype=float)))
    if places <= degree:
        raise InputError(
            _(
                "The points lie at {places} places; the curve needs at least {least}: measure at more "
                "conditions."
            ).format(places=places, least=degree + 1)
        )
    found = np.polynomial.Polynomial.fit(x, y, degree).convert().coef
    return [*map(float, found), *[0.0] * (degree + 1 - len(found))]
