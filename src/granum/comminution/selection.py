"""Which crusher or mill for a feed and a product: kinds ranked, with reasons."""

from __future__ import annotations

from math import log10
from typing import Annotated, Any, NamedTuple

import numpy as np

from granum.core import procedure
from granum.core.datasets import dataset
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import KINDS, Fraction, Length, Series
from granum.core.units import show

WEAR = 0.1  # of the suitability that is left
PRODUCT = 2.0  # times worse to miss the product, in decades, than the feed, which another machine can break


class Mills(NamedTuple):
    """Crushers and mills, best first."""

    mill: Annotated[str, Series("machines")]
    suitability: Annotated[Fraction, Series("machines")]
    speaks_for: Annotated[str, Series("machines")]
    speaks_against: Annotated[str, Series("machines")]


def _outside(value: float, low: float, high: float) -> float:
    """Decades that a value lies outside a range, no rounding counted."""
    return max(round(log10(low / value), 9), round(log10(value / high), 9), 0.0)


def _length(value: float) -> str:
    return show(value, KINDS["Length"])


@procedure(source="mccabe2005, ch. 28", title="Choice of a crusher or mill")
def mill_choice(feed_size: Length, product_size: Length, abrasive: bool = False) -> Mills:
    """Crushers and mills ranked by the sizes that they take and make, and by what wears them.

    Sizes are those that 80 % of the mass pass. The suitability falls by a factor of ten for each decade that
    the feed lies outside the sizes of common use, and of a hundred for each of the product. Where no machine
    goes the whole way, the best of the product stands first and says which feed it takes: break to that in
    another. Moisture, capacity, stickiness and heat are not judged, and the ranges are orders of magnitude:
    use the list to decide what to try.

    >>> mill_choice("5 mm", "75 um").mill[0]
    'fine grinder (ball, tube or attrition mill)'
    """
    if not product_size < feed_size:
        raise InputError(
            _("The product, {product}, must be finer than the feed, {feed}.").format(
                product=_length(product_size), feed=_length(feed_size)
            ),
            name="product_size",
        )
    rows = []
    for machine in dataset("comminution", "mills_mccabe2005"):
        takes = _outside(feed_size, machine["feed_low"], machine["feed_high"])
        makes = _outside(product_size, machine["product_low"], machine["product_high"])
        ends = {
            "fed": _("takes {low} to {high}").format(
                low=_length(machine["feed_low"]), high=_length(machine["feed_high"])
            ),
            "made": _("makes {low} to {high}").format(
                low=_length(machine["product_low"]), high=_length(machine["product_high"])
            ),
        }
        good = [ends[word] for word, off in (("made", makes), ("fed", takes)) if not off]
        bad = [ends[word] for word, off in (("made", makes), ("fed", takes)) if off]
        share = 10.0 ** -(takes + PRODUCT * makes)
        if abrasive and not machine["hard"]:
            bad.append(_("wears out on hard, abrasive matter"))
            share *= WEAR
        rows.append((share, makes, machine["name"], "; ".join(good), "; ".join(bad)))
    rows.sort(key=lambda row: (-row[0], row[1]))
    columns: Any = list(zip(*rows, strict=True))
    names: Any = tuple(map(_, columns[2]))
    return Mills(names, np.round(columns[0], 3), *columns[3:])
