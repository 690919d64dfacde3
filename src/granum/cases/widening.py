"""Size classes of a machine alone, as wide as the sizes that are said of what it is fed with."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from granum.cases.reading import quantity
from granum.core.errors import GranumError
from granum.streams.feeding import LEAST_INSIDE, below

MOST = 60  # classes added at either end
OUTSIDE = 1e-3  # of a feed, which may lie beyond either end


def widen(mixture: dict[str, Any], feeds: Mapping[str, Mapping[str, Any]], said: Mapping[str, Any]) -> None:
    """More classes of the same ratio, where those of the example do not hold the sizes that were said."""
    classes = mixture.get("sizes")
    ports = [port for port in feeds if any(word.startswith(f"{port}.sizes") for word in said)]
    own = any(word.startswith("mixture.sizes") for word in said)
    if not ports or own or not isinstance(classes, dict) or "smallest" not in classes:
        return
    try:
        low, high = (quantity(classes[end], "Length", end, "") for end in ("smallest", "largest"))
        count = int(classes["classes"])
        steps = np.arange(-MOST, count + MOST + 1)
        edges = low * (high / low) ** (steps / count)
        finer = [below(feeds[port].get("sizes"), edges) for port in ports]
    except (GranumError, ArithmeticError, LookupError, TypeError, ValueError):  # told where it is read
        return
    first, last = 0, count
    for cumulative in finer:
        if cumulative is None or cumulative[MOST + count] - cumulative[MOST] >= LEAST_INSIDE:
            continue
        first = min(first, int(steps[max(np.searchsorted(cumulative, OUTSIDE, side="right") - 1, 0)]))
        last = max(last, int(steps[min(np.searchsorted(cumulative, 1.0 - OUTSIDE), len(steps) - 1)]))
    if (first, last) != (0, count):
        ends = (low * (high / low) ** (step / count) for step in (first, last))
        smallest, largest = (f"{1e6 * end:.12g} um" for end in ends)
        mixture["sizes"] = classes | {"smallest": smallest, "largest": largest, "classes": last - first}
