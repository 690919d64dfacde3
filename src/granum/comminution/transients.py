"""How a mill answers: holdup and product over time after a change of feed, open or in closed circuit, exact
in time.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax
import jax.numpy as jnp
import jax.scipy.linalg as linalg
import numpy as np

from granum.comminution.population import Convention, rate_matrix
from granum.core import procedure
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Frequency, Law, Length, Mass, MassFlow, Ratio, Series, Time
from granum.particles.class_means import Edges, Fractions
from granum.particles.distributions import SizeDistribution


class MillResponse(NamedTuple):
    """A mill over time."""

    holdup_mass: Annotated[Mass, Series("times")]
    mass_flow: Annotated[MassFlow, Series("times")]
    product_size: Annotated[Length, Series("times")]
    circulating_load: Annotated[Ratio, Series("times")]


def perfect_mill(matrix: Any, discharge_rate: Any, returned: Any) -> Any:
    """Matrix M of dm/dt = f + M m: breakage, discharge, and the part of the discharge that the classifier
    sends back.
    """
    kept = discharge_rate * (1.0 - returned)
    return matrix - jnp.diag(kept * jnp.ones(matrix.shape[0]))


def linear_response(matrix: Any, inflow: Any, start: Any, time: Any) -> Any:
    """State of dm/dt = f + M m after a time, from the exponential of the matrix augmented by f (M may be
    singular).
    """
    n = matrix.shape[0]
    whole = jnp.zeros((n + 1, n + 1)).at[:n, :n].set(matrix).at[:n, n].set(inflow)
    return (linalg.expm(whole * time) @ jnp.append(start, 1.0))[:n]


@procedure(
    source="austin1984, ch. 8; napiermunn1996; whiten1972",
    title="Response of a mill to a change of feed",
    typical={"discharge_rate": (2e-3, 2e-2), "mass_flow": (1.0, 10.0)},
)
def mill_response(
    class_edges: Edges,
    class_fractions: Fractions,
    mass_flow: MassFlow,
    discharge_rate: Frequency,
    selection: Annotated[Any, Law("selection_function")],
    breakage: Annotated[Any, Law("breakage_function")],
    time: Annotated[Time, Series("times")],
    holdup_mass: Mass = 0.0,
    holdup_fractions: Annotated[Fractions, Series("classes")] | None = None,
    separation: Annotated[Any, Law("partition_curve")] | None = None,
    breakage_convention: Convention = "continuous",
) -> MillResponse:
    """A well-mixed mill after its feed has changed: holdup, product, the size that 80 % of it passes, and the
    circulating load over time.

    The mill holds at the start a mass of a size table (by default that of the feed) and is then fed steadily.
    It discharges each class in proportion to what it holds; a partition curve returns the coarse part to the
    mill, without delay. The holdup is free: it grows until breakage keeps pace. The laws are those of single
    sizes unless the convention is that of root-two classes (see ``ball_mill``).

    >>> from granum.comminution.breakage import AustinBreakage, AustinSelection
    >>> found = mill_response(
    ...     "0, 1, 2, 4 mm",
    ...     "0, 0, 100 %",
    ...     "1 kg/s",
    ...     "0.01 1/s",
    ...     AustinSelection(0.1, 1.0),
    ...     AustinBreakage(1.0, 1.0, 4.0),
    ...     "0, 100, 1000 s",
    ... )
    >>> [round(float(m), 2) for m in found.holdup_mass]
    [0.0, 63.21, 100.0]
    """
    feed = SizeDistribution(class_edges, class_fractions)
    edges, times = jnp.asarray(feed.edges), jnp.asarray(time, dtype=float)
    inside = (
        feed.fractions
        if holdup_fractions is None
        else SizeDistribution(class_edges, holdup_fractions).fractions
    )
    if np.any(np.diff(np.asarray(times)) < 0.0):
        raise InputError(_("Times must increase."), name="time")
    returned = jnp.zeros(edges.size - 1) if separation is None else separation.over(edges[:-1], edges[1:])
    matrix = perfect_mill(
        rate_matrix(feed.edges, selection, breakage, breakage_convention), discharge_rate, returned
    )
    start, inflow = holdup_mass * jnp.asarray(inside), mass_flow * jnp.asarray(feed.fractions)
    held = jnp.maximum(jax.vmap(lambda t: linear_response(matrix, inflow, start, t))(times), 0.0)
    product, back = discharge_rate * held * (1.0 - returned), discharge_rate * held * returned
    flow = product.sum(axis=1)
    first = inflow * (1.0 - returned + 1e-12)  # what leaves a mill that is still empty
    tables = jnp.where(flow[:, None] > 0.0, product, first[None, :])
    sizes = jax.vmap(lambda w: SizeDistribution(edges, w / w.sum()).percentile(0.8))(tables)
    return MillResponse(held.sum(axis=1), flow, sizes, back.sum(axis=1) / mass_flow)
