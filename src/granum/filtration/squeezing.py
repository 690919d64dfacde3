"""Sludge under rising pressure, as in presses: the void ratio that each pressure makes in the end, and how
much of each fall of it there is time for.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.filtration.formulas.expression import consolidation_ratio_terzaghi, consolidation_time
from granum.numerics.smooth import safe_divide

DENSEST = 0.95  # of solid by volume, beyond which no sludge is squeezed


def void_ratio(pressure: Any, reference: Any, reference_pressure: Any, exponent: Any, gel: Any) -> Any:
    """Void ratio that a sludge takes in the end under a pressure, never looser than it packs by itself."""
    packed = reference * (pressure / reference_pressure) ** exponent
    return 1.0 / jnp.clip(packed, gel, DENSEST) - 1.0


def squeezed(
    before: Any, ratios: Any, left: Any, coefficient: Any, solid: Any, faces: float
) -> tuple[Any, Any]:
    """Void ratio after steps of pressure that would lead to ``ratios`` and have the times ``left`` each, and
    the share of the possible fall that is reached; the steps superposed by Terzaghi's law.
    """
    falls = jnp.maximum(-jnp.diff(jnp.minimum(ratios, before), prepend=before), 0.0)
    reached = consolidation_ratio_terzaghi(consolidation_time(left, coefficient, solid, faces))
    fallen, possible = jnp.sum(falls * reached), jnp.sum(falls)
    return before - fallen, safe_divide(fallen, possible, 1.0)
