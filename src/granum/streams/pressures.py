"""What is left of the pressure of a gas behind a machine."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core.flags import unsolved
from granum.streams.stream import Stream

LEAST_LEFT = 0.3  # of the pressure before
SPENT = (
    "The gas would lose more than 70 % of its pressure here: give a larger section, less gas, or gas of a "
    "higher pressure."
)


def pressure_left(feed: Stream, lost: Any, card: Any) -> Any:
    """Pressure of the gas of a feed behind a machine in which it loses some, Pa.

    Correlations of pressure drop take the gas as of one density. Where most of the pressure would be gone
    they say nothing any more, and the machine has no solution.
    """
    left, least = feed.pressure - lost, LEAST_LEFT * feed.pressure
    unsolved((left >= least) | ~(feed.gas_flow > 0.0), card, reason=SPENT)
    return jnp.maximum(left, least)
