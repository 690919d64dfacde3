"""Electric power of the rakes and scrapers of settlers."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core.utilities import Utility
from granum.settling.formulas.rakes import rake_torque
from granum.streams.units import Utilities
from granum.streams.utilities import driven

# N/m, load on the arms over four: 6 lb/ft in a clarifier, 40 lb/ft in a thickener
CLARIFIER, THICKENER = 22.0, 146.0
ARM_LOAD = 88.0  # N/m, of a scraper across a basin
TIP_SPEED, SCRAPER_SPEED = 0.06, 0.01  # m/s
GEARS = 0.7  # of a slow drive
SOURCE = "boyle2012, the torque only: the load, 90 N/m in clarifiers, 580 in thickeners, is our own estimate"

RAKED: Utilities = {"electric_power_rake": Utility(SOURCE)}


def raked(area: Any, torque_factor: Any) -> Any:
    """Of the rake of a round tank, whose tip turns at a set speed, W."""
    diameter = jnp.sqrt(4.0 * area / jnp.pi)
    return driven(rake_torque(diameter, torque_factor) * 2.0 * TIP_SPEED / diameter) / GEARS


def scraped(length: Any, width: Any) -> Any:
    """Of a chain or bridge that scrapes the floor of a rectangular basin, a blade every three meters, W."""
    return driven(ARM_LOAD * width * jnp.maximum(length / 3.0, 1.0) * SCRAPER_SPEED) / GEARS
