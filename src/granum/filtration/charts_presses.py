"""Chart of a sludge on its way through a press."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from granum.core.i18n import _
from granum.streams.inside_charts import Axis, Curve, drawn_along
from granum.streams.stream import Stream


def drawn_pressing(
    times: Sequence[Any],
    ratios: Sequence[Any],
    pressures: Sequence[Any],
    feed: Stream,
    stages: tuple[Sequence[float], Sequence[str]],
) -> Any:
    """Dry solids of a sludge and the pressure on it, over the time since it came in. Times (each from the
    beginning of its stretch), void ratios and pressures come in stretches.
    """
    starts = np.cumsum([0.0, *(float(t[-1]) for t in times[:-1])])
    time = np.concatenate(
        [start + np.asarray(t, dtype=float) for start, t in zip(starts, times, strict=True)]
    )
    wet = np.concatenate([np.asarray(e, dtype=float) for e in ratios]) * float(feed.liquid_density)
    solid = float(feed.solid_density)
    return drawn_along(
        Axis("time", "Time"),
        time,
        (
            Axis("solids_mass_fraction", "Fraction", "%"),
            [Curve(_("dry solids"), solid / (solid + wet), "SOLID")],
        ),
        (
            Axis("pressure", "Pressure", label=_("pressure")),
            [Curve(_("pressure on the sludge"), np.concatenate(list(pressures)), "GAS", "dash")],
        ),
        stages,
    )
