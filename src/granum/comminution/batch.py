"""Grinding a batch, as one calculation from a size table to a size table."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.comminution.population import Convention, PlugFlow, rate_matrix
from granum.core import procedure
from granum.core.kinds import Law, Length, Ratio, Time
from granum.particles.class_means import Edges, Fractions
from granum.particles.distributions import SizeDistribution


class GroundTable(NamedTuple):
    """Size table of a ground product."""

    class_fractions: Fractions
    feed_size: Length
    product_size: Length
    reduction_ratio: Ratio


@procedure(source="austin1984; reid1965", title="Grinding of a size table")
def ground_fractions(
    class_edges: Edges,
    class_fractions: Fractions,
    grinding_time: Time,
    selection: Annotated[Any, Law("selection_function")],
    breakage: Annotated[Any, Law("breakage_function")],
    mixing: Annotated[Any, Law("residence_time_law")] = PlugFlow(),
    breakage_convention: Convention = "continuous",
) -> GroundTable:
    """Mass fractions by class after grinding a batch for a time, or after a continuous mill of that mean
    residence time.

    Sizes are those that 80 % pass. A batch is plug flow; the solution is exact in time. The laws are those of
    single sizes unless the convention is that of root-two classes (see ``ball_mill``).

    >>> from granum.comminution.breakage import AustinBreakage, AustinSelection
    >>> table = ground_fractions(
    ...     "0, 1, 2, 4 mm", "0, 0, 100 %", "3 s", AustinSelection(0.1, 1.0), AustinBreakage(1.0, 1.0, 4.0)
    ... )
    >>> [round(float(x), 4) for x in table.class_fractions]
    [0.2592, 0.192, 0.5488]
    """
    feed = SizeDistribution(class_edges, class_fractions)
    matrix = rate_matrix(feed.edges, selection, breakage, breakage_convention)
    product = SizeDistribution(
        feed.edges, jnp.maximum(mixing.operator(matrix, grinding_time) @ feed.fractions, 0.0)
    )
    coarse, fine = feed.percentile(0.8), product.percentile(0.8)
    return GroundTable(product.fractions, coarse, fine, coarse / fine)
