"""Measured points of a law: what is refused of them before they are used."""

from __future__ import annotations

from typing import Any

import numpy as np

from granum.core.conversion import is_tracer
from granum.core.errors import InputError
from granum.core.i18n import _


def follow(name: str, values: Any) -> None:
    """Refuse points of which one lies before the last.

    >>> follow("time_points", [0.0, 60.0, 60.0])
    """
    wrong = _first(lambda steps: steps < 0.0, values)
    if wrong is not None:
        raise InputError(
            _("'{name}' must not fall from one point to the next; at number {place} it does.").format(
                name=name, place=wrong + 2
            ),
            name=name,
        )


def fall(name: str, values: Any, over: str, places: Any) -> None:
    """Refuse points, in any order, that do not fall as what they were measured over rises.

    >>> fall("flux_points", [1e-5, 2e-5], "concentration_points", [100.0, 10.0])
    """
    if is_tracer(values) or is_tracer(places):
        return
    at = np.asarray(places, dtype=float)
    order = np.argsort(at, kind="stable")
    if np.any(np.diff(at[order]) == 0.0):
        raise InputError(_("Two points have the same '{name}'.").format(name=over), name=over)
    wrong = _first(lambda steps: steps > 0.0, np.asarray(values, dtype=float)[order])
    if wrong is not None:
        raise InputError(
            _("'{name}' must fall as '{over}' rises; between points {one} and {other} it rises.").format(
                name=name, over=over, one=order[wrong] + 1, other=order[wrong + 1] + 1
            ),
            name=name,
        )


def _first(wrong: Any, values: Any) -> int | None:
    """The first step between neighbors that is wrong, if any is."""
    if is_tracer(values):
        return None
    found = np.flatnonzero(wrong(np.diff(np.asarray(values, dtype=float))))
    return int(found[0]) if found.size else None
