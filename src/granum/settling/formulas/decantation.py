"""Countercurrent decantation: what a row of thickeners loses of what is dissolved."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import Fraction, PositiveNumber, Ratio

TOO_LITTLE_LIQUOR = "Feed and wash must hold at least the liquor that leaves with the underflow."


@formula(
    source="coe1916; "
    "richardson2002, perfect mixing only: the balance of what passes a stage unmixed is our own",
    title="Solute lost by countercurrent decantation",
    equation=(
        r"F = \frac{1}{f\,\frac{w^N - 1}{w - 1} + w^N}\ (E_m = 1),\quad u_k = (1 - E_m)\,u_{k-1} + E_m\,x_k"
    ),
    typical={"wash_ratio": (1.0, 4.0), "wash_stages": (2.0, 6.0)},
)
def soluble_loss_countercurrent(
    wash_ratio: Ratio,
    wash_stages: PositiveNumber,
    feed_liquor_ratio: PositiveNumber = 1.0,
    mixing_efficiency: Fraction = 1.0,
) -> Fraction:
    """Fraction of the solute that leaves with the last underflow of thickeners in a row, solid and wash going
    against one another (countercurrent decantation, CCD).

    The ratio is wash liquor per liquor of an underflow, the same from each thickener; ``feed_liquor_ratio``
    is the liquor that comes with the feed over it. Nothing dissolves or is adsorbed. Of the liquor of each
    underflow the share ``mixing_efficiency`` is mixed with the wash that meets it, the rest goes on with the
    solid as it came.

    >>> soluble_loss_countercurrent(wash_ratio=2.0, wash_stages=3)
    0.06666666666666667
    """
    w, n, f, E = wash_ratio, wash_stages, feed_liquor_ratio, mixing_efficiency
    out = w + f - 1.0
    impossible(out < 0.0, f, "feed_liquor_ratio", 1.0 - w, jnp.inf, TOO_LITTLE_LIQUOR)
    # with the tracer of the feed alone: w x_k = u_(k-1) - d in each stage but the first, d the net flow down
    past = (1.0 - E) * jnp.minimum(f, 1.0)  # of the first underflow
    rest = jnp.maximum(n, 1.0) - 1.0
    even = jnp.abs(w - 1.0) < 1e-7
    safe = jnp.where(even, 2.0, w)
    mixed = (1.0 - E) * w + E
    kept, washed = _power(mixed, rest), _power(w, rest)
    between = jnp.where(even, rest * E, (kept - washed) / (1.0 - safe))
    net = kept * (past * out + (1.0 - past) * f) / (out * (washed + between) + kept * (1.0 - past))
    return net / f


def _power(base: Ratio, exponent: Ratio) -> Ratio:
    """Zero to the power zero is one, and has no slope."""
    some = base > 0.0
    return jnp.where(some, jnp.where(some, base, 1.0) ** exponent, 1.0 * (exponent == 0.0))
