"""Flowability of a powder from its loose and its tapped density."""

from __future__ import annotations

from typing import NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import Density, Fraction, PositiveNumber

LOOSER = "A powder is no looser after tapping: its tapped density is the larger one."


class TappedPowder(NamedTuple):
    """What tapping tells of a powder."""

    hausner_ratio: PositiveNumber
    compressibility_index: Fraction


@formula(
    source="carr1965; usp1174, table 2",
    equation=r"H = \frac{\rho_t}{\rho_b},\quad C = \frac{\rho_t - \rho_b}{\rho_t}",
    typical={"bulk_density": (200.0, 600.0), "tapped_density": (650.0, 1000.0)},
    title="Hausner ratio and Carr's compressibility index",
)
def hausner_ratio(bulk_density: Density, tapped_density: Density) -> TappedPowder:
    """Flowability of a powder told by how much tapping makes it denser.

    The scale of the pharmacopoeia: an index to 10 % is excellent (ratio to 1.11), to 15 % good (1.18), to
    20 % fair (1.25), to 25 % passable (1.34), to 31 % poor (1.45), to 37 % very poor (1.59). It ranks powders
    and sizes no hopper: that takes a shear cell.

    >>> round(hausner_ratio("0.85 g/cm3", "1 g/cm3").hausner_ratio, 2)
    1.18
    """
    denser = tapped_density >= bulk_density
    impossible(~denser, tapped_density, "tapped_density", bulk_density, jnp.inf, LOOSER)
    ratio = jnp.where(denser, tapped_density / bulk_density, jnp.nan)
    return TappedPowder(ratio, 1.0 - 1.0 / ratio)
