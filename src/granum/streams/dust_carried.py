"""Gas that comes to be cleaned and carries nothing."""

from __future__ import annotations

import numpy as np

from granum.core import flags
from granum.streams.stream import Stream

REASON = (
    "No dust enters: this machine takes pressure and power for nothing. Does a dryer or mill before it keep "
    "its fines? Those that have 'entrainment' give them to the gas when it is set to yes."
)


def told_without_dust(feed: Stream, card: str) -> None:
    """Flag a gas without any solid in a machine that is there to take it out."""
    nothing = (feed.gas_flow > 0.0) & (feed.solid_flow <= 0.0)
    flags.record(flags.EXTRAPOLATED, nothing, feed.solid_flow, "solid_flow", card, -np.inf, reason=REASON)
