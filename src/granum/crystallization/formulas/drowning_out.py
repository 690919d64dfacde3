"""Drowning out: what an antisolvent gains by lowering the solubility, and loses by diluting."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import MassFraction, MassRatio, Number, PositiveNumber, Within
from granum.crystallization.kinds import OpenShare
from granum.numerics.smooth import safe_divide

Effect = Annotated[Number, Within(0.0, 50.0)]


@formula(
    source="yalkowsky1981; mullin2001, ch. 8",
    title="Yield of drowning out",
    equation=r"R = 1 - \frac{C^*(w)}{C\,(1-w)}",
    output="yield_fraction",
    typical={
        "solute_per_solvent": (0.3, 0.36),
        "solubility_per_solvent": (0.1, 0.2),
        "antisolvent_fraction": (0.1, 0.4),
    },
)
def yield_fraction_antisolvent(
    solute_per_solvent: Annotated[PositiveNumber, Within(1e-9)],
    solubility_per_solvent: MassRatio,
    antisolvent_fraction: OpenShare,
) -> Number:
    """Share of the solute that crystallizes when antisolvent is mixed into a solution and equilibrium is
    reached.

    The feed is counted per kilogram of its own solvent, the solubility per kilogram of the mixture. Negative
    where the mixture dissolves more than there is: an antisolvent also dilutes. A mass balance: 1 kg of
    solvent with 0.36 kg of solute meets 0.5 kg of antisolvent, of which 1.5 kg hold 0.21 kg at 0.14 kg/kg.

    >>> round(yield_fraction_antisolvent(0.36, 0.14, 1.0 / 3.0), 4)
    0.4167
    """
    return 1.0 - solubility_per_solvent / (solute_per_solvent * (1.0 - antisolvent_fraction))


@formula(
    source="yalkowsky1981",
    title="Antisolvent for the highest yield",
    equation=r"(1 - w)\,(\kappa + 2\kappa_2 w) = 1",
    output="antisolvent_fraction",
    typical={"antisolvent_power": (1.5, 6.0), "antisolvent_curvature": (0.0, 3.0)},
)
def antisolvent_fraction_best(antisolvent_power: Effect, antisolvent_curvature: Effect = 0.0) -> MassFraction:
    """Share of antisolvent in the solvent beyond which it dilutes more than it lowers the solubility, for a
    feed of the pure solvent.

    From the derivative of C*(w)/(1 − w) with the log-linear law; zero where an antisolvent is too weak to
    gain anything. Without curvature it is 1 − 1/κ.

    >>> antisolvent_fraction_best(antisolvent_power=4.0)
    0.75
    """
    k, bent = antisolvent_power, antisolvent_curvature
    b = k - 2.0 * bent
    square = b**2 + 8.0 * bent * (k - 1.0)
    root = jnp.sqrt(jnp.where(square > 0.0, square, 1.0))
    rising = safe_divide(2.0 * (k - 1.0), jnp.where(b > 0.0, b + root, 1.0))
    falling = safe_divide(root - b, jnp.where(b > 0.0, 1.0, 4.0 * bent))
    w = jnp.clip(jnp.where(b > 0.0, rising, falling), 0.0, 1.0 - 1e-12)
    gains = jnp.log1p(-w) + w * (k + bent * w) > 0.0
    return jnp.where((square > 0.0) & gains, w, 0.0)
