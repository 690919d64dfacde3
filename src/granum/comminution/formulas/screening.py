"""Screening between two products: shares, recovery, rejection and effectiveness from three analyses."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import Fraction, MassFraction, OpenFraction, Ratio
from granum.numerics.smooth import safe_divide

_TYPICAL = {
    "desired_fraction_feed": (0.4, 0.6),
    "desired_fraction_product": (0.8, 0.95),
    "desired_fraction_reject": (0.1, 0.3),
}


def _yield(x_f: Any, x_p: Any, x_r: Any) -> Any:
    """Product per feed; no value unless the feed lies between the two products."""
    share = safe_divide(x_f - x_r, x_p - x_r, jnp.nan)
    possible = (share >= 0.0) & (share <= 1.0)
    impossible(~possible, x_f, "desired_fraction_feed", jnp.minimum(x_r, x_p), jnp.maximum(x_r, x_p))
    return jnp.where(possible, share, jnp.nan)


@formula(
    source="mccabe2005, ch. 29",
    equation=r"\frac{P}{F} = \frac{x_F - x_R}{x_P - x_R}",
    typical=_TYPICAL,
    title="Product per feed (two-product formula)",
)
def product_yield(
    desired_fraction_feed: MassFraction,
    desired_fraction_product: MassFraction,
    desired_fraction_reject: MassFraction,
) -> Fraction:
    """Product per feed from the fraction of desired size in feed, product and reject.

    Three analyses that do not close (feed outside the range of the two products, or equal products) give no
    value.

    >>> round(product_yield(0.47, 0.85, 0.195), 3)
    0.42
    """
    return _yield(desired_fraction_feed, desired_fraction_product, desired_fraction_reject)


@formula(
    source="mccabe2005, ch. 29",
    equation=r"f_{DO} = \frac{P\,x_P}{F\,x_F},\quad \frac{P}{F} = \frac{x_F - x_R}{x_P - x_R}",
    typical=_TYPICAL,
    title="Recovery of the desired material",
)
def screening_recovery(
    desired_fraction_feed: OpenFraction,
    desired_fraction_product: MassFraction,
    desired_fraction_reject: MassFraction,
) -> Fraction:
    """Part of the desired material that reaches the product.

    >>> round(screening_recovery(0.47, 0.85, 0.195), 3)
    0.759
    """
    x_f, x_p = desired_fraction_feed, desired_fraction_product
    return _yield(x_f, x_p, desired_fraction_reject) * x_p / x_f


@formula(
    source="mccabe2005, ch. 29",
    equation=r"f_{nDe} = \frac{R\,(1 - x_R)}{F\,(1 - x_F)},\quad \frac{R}{F} = \frac{x_P - x_F}{x_P - x_R}",
    typical=_TYPICAL,
    title="Rejection of the undesired material",
)
def screening_rejection(
    desired_fraction_feed: OpenFraction,
    desired_fraction_product: MassFraction,
    desired_fraction_reject: MassFraction,
) -> Fraction:
    """Part of the undesired material that reaches the reject.

    Differs from the print: the course notes write R x_R/(F x_F), which counts desired material; the undesired
    is 1 - x.

    >>> round(screening_rejection(0.47, 0.85, 0.195), 3)
    0.881
    """
    x_f, x_r = desired_fraction_feed, desired_fraction_reject
    return (1.0 - _yield(x_f, desired_fraction_product, x_r)) * (1.0 - x_r) / (1.0 - x_f)


@formula(
    source="mccabe2005, ch. 29",
    equation=r"\bar E = \frac{P\,x_P}{F\,x_F}\cdot\frac{R\,(1 - x_R)}{F\,(1 - x_F)}",
    typical=_TYPICAL,
)
def screening_effectiveness(
    desired_fraction_feed: OpenFraction,
    desired_fraction_product: MassFraction,
    desired_fraction_reject: MassFraction,
) -> Fraction:
    """Recovery of the desired times rejection of the undesired material; 1 for an ideal screen.

    Known as overall screen efficiency too. Differs from the print: the second factor of the course notes
    lacks the 1 - x.

    >>> round(screening_effectiveness(0.47, 0.85, 0.195), 3)
    0.669
    """
    given = (desired_fraction_feed, desired_fraction_product, desired_fraction_reject)
    return screening_recovery(*given) * screening_rejection(*given)


@formula(
    source="wills2016",
    equation=(
        r"C = \frac{R}{F} = \frac{x_O - x_F}{x_F - x_U}\ \text{(undersize in overflow, feed, " r"underflow)}"
    ),
    title="Circulating load from three analyses",
    typical={
        "passing_fraction_feed": (0.4, 0.6),
        "passing_fraction_fine": (0.8, 0.95),
        "passing_fraction_coarse": (0.1, 0.3),
    },
)
def circulating_load(
    passing_fraction_feed: Fraction, passing_fraction_fine: Fraction, passing_fraction_coarse: Fraction
) -> Ratio:
    """Coarse return per fresh feed of a closed circuit, from what passes one sieve in the classifier's feed,
    fine and coarse product.

    >>> round(circulating_load(0.5, 0.9, 0.3), 3)
    2.0
    """
    share = _yield(passing_fraction_feed, passing_fraction_fine, passing_fraction_coarse)
    return safe_divide(1.0 - share, share, jnp.inf)
