"""Zone refining: a molten zone passes along a bar again and again and carries impurity to its end."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import numpy as np

from granum.core import procedure
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Fraction, Ratio, Series, Within
from granum.crystallization.formulas.melt import BarLength
from granum.crystallization.kinds import DistributionCoefficient, OpenShare

CELLS = 100  # of one zone


class ZoneRefined(NamedTuple):
    """A bar after all passes, along its length: impurity over that at the start; and what lies before the
    part that is cut off.
    """

    bar_position: Annotated[Fraction, Series("points")]
    impurity_ratio: Annotated[Ratio, Series("points")]
    impurity_ratio_kept: Ratio
    impurity_ratio_begin: Ratio


def passed(bar: np.ndarray, k: float, cells: int) -> np.ndarray:
    """Impurity in the cells of a bar after one pass of a zone so many cells long; what it holds is kept.

    Exact for cells that are even inside: the zone gains what melts and loses k times its own by freezing;
    at the end of the bar it freezes as a whole.
    """
    made = np.empty_like(bar)
    held = float(np.sum(bar[:cells]))
    decay = np.exp(-k / cells)
    last = len(bar) - cells
    for i in range(last):
        melts = float(bar[i + cells])
        balance = melts * cells / k
        after = balance + (held - balance) * decay
        made[i] = held + melts - after
        held = after
    left = np.arange(cells, -1, -1) / cells
    made[last:] = held * -np.diff(left**k)
    return made


@procedure(
    source="pfann1952; pfann1966, ch. 3",
    title="Zone refining in many passes",
    typical={
        "distribution_coefficient": (0.1, 0.5),
        "bar_length_in_zones": (5.0, 10.0),
        "cut_fraction": (0.1, 0.3),
    },
)
def zone_refining(
    distribution_coefficient: DistributionCoefficient,
    bar_length_in_zones: BarLength = 10.0,
    passes: Annotated[int, Within(1, 1000)] = 10,
    cut_fraction: OpenShare = 0.2,
) -> ZoneRefined:
    """Impurity along a bar after so many passes of a molten zone, and what is left in the part that is kept.

    The coefficient is the effective one of the speed of the zone. The solid does not mix, the melt does;
    densities of both are alike. After one pass Pfann's equation holds, after very many his ultimate
    distribution.

    >>> out = zone_refining(distribution_coefficient=0.1, passes=1)
    >>> round(out.impurity_ratio_begin, 2)
    0.1
    """
    cells = round(float(bar_length_in_zones) * CELLS)
    if passes * cells > 2_000_000:
        raise InputError(
            _("{passes} passes of a bar of {zones} zones take too long: give fewer passes.").format(
                passes=passes, zones=round(float(bar_length_in_zones), 2)
            ),
            name="passes",
        )
    bar = np.ones(cells)
    for _pass in range(passes):
        bar = passed(bar, float(distribution_coefficient), CELLS)
    position = (np.arange(cells) + 0.5) / cells
    kept = position <= 1.0 - float(cut_fraction)
    return ZoneRefined(position, bar, float(np.mean(bar[kept])) if kept.any() else 0.0, float(bar[0]))


def profiles(k: float, zones: float, counts: list[int]) -> dict[int, Any]:
    """Impurity along a bar after each of some numbers of passes."""
    bar, found, done = np.ones(round(zones * CELLS)), {}, 0
    for count in sorted(counts):
        for _pass in range(count - done):
            bar = passed(bar, k, CELLS)
        found[count], done = bar.copy(), count
    return found
