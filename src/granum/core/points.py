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
    _ordered(
        lambda steps: steps > 0.0,
        _("'{name}' must fall as '{over}' rises; between points {one} and {other} it rises."),
        (name, values),
        (over, places),
    )


def rise(name: str, values: Any, over: str, places: Any) -> None:
    """Refuse points, in any order, that fall as what they were measured over rises.

    >>> rise("flux_points", [2e-5, 1e-5], "pressure_points", [3e5, 1e5])
    """
    _ordered(
        lambda steps: steps < 0.0,
        _("'{name}' must not fall as '{over}' rises; between points {one} and {other} it falls."),
        (name, values),
        (over, places),
    )


def _ordered(wrong: Any, told: str, values: tuple[str, Any], places: tuple[str, Any]) -> None:
    """Refuse points of which two are at one place, or whose steps are wrong."""
    if is_tracer(values[1]) or is_tracer(places[1]):
        return
    at = np.asarray(places[1], dtype=float)
    order = np.argsort(at, kind="stable")
    if np.any(np.diff(at[order]) == 0.0):
        raise InputError(_("Two points have the same '{name}'.").format(name=places[0]), name=places[0])
    step = _first(wrong, np.asarray(values[1], dtype=float)[order])
    if step is not None:
        raise InputError(
            told.format(name=values[0], over=places[0], one=order[step] + 1, other=order[step + 1] + 1),
            name=values[0],
        )


def _first(wrong: Any, values: Any) -> int | None:
    """The first step between neighbors that is wrong, if any is."""
    if is_tracer(values):
        return None
    found = np.flatnonzero(wrong(np.diff(np.asarray(values, dtype=float))))
    return int(found[0]) if found.size else None
