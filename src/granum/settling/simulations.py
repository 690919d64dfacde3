"""Simulations of a settling column as cards: a batch cylinder, and a continuous clarifier-thickener over
hours or days.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import procedure
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Concentration,
    Density,
    Distance,
    Fraction,
    Law,
    Length,
    Number,
    OpenFraction,
    Series,
    Time,
    VolumeFlow,
    Within,
)
from granum.settling.column import Cone, Operation, Simulation, Suspension, settle, simulate

Settling = Annotated[Any, Law("settling_velocity")]
Compression = Annotated[Any, Law("solids_stress")]
Times = Annotated[Time, Series("times")]


class BatchCourse(NamedTuple):
    """Course of a batch cylinder."""

    time: Times
    interface_height: Annotated[Distance, Series("times")]
    bottom_concentration: Annotated[Concentration, Series("times")]
    mass_error: Number


class ContinuousCourse(NamedTuple):
    """Course of a continuous unit; concentrations of the outlets are means over the interval that ends at
    each time.
    """

    time: Times
    underflow_concentration: Annotated[Concentration, Series("times")]
    overflow_concentration: Annotated[Concentration, Series("times")]
    blanket_height: Annotated[Distance, Series("times")]
    mass_error: Number


def check_times(time: Any) -> np.ndarray:
    """Times as an array that starts at zero and increases."""
    times = np.asarray(time, dtype=float)
    if times.ndim == 0 or times.size < 2:
        raise InputError(_("Give at least two times, the first being the start."))
    if np.any(np.diff(times) <= 0):
        raise InputError(_("Times must increase."))
    return times


@procedure(
    source="burger2011; burger2013",
    title="Batch settling simulation",
    typical={"time": (0.0, 7200.0), "initial_concentration": (2.0, 6.0), "initial_height": (0.3, 1.0)},
)
def batch_simulation(
    initial_concentration: Concentration,
    initial_height: Length,
    time: Times,
    settling: Settling = "takacs",
    compression: Compression | None = None,
    solid_density: Density = 1050.0,
    liquid_density: Density = 998.0,
    packed_concentration: Concentration | None = None,
    cells: Annotated[int, Within(5, 5000)] = 100,
) -> BatchCourse:
    """Batch settling of a uniform suspension, hindered and compressed, by a monotone conservative scheme.

    The interface is where the concentration passes half the initial one.

    >>> course = batch_simulation(
    ...     3.0,
    ...     0.4,
    ...     [0, 300],
    ...     {"law": "vesilind", "vesilind_velocity": "5 m/hour", "vesilind_coefficient": 0.4},
    ... )
    >>> round(float(course.interface_height[-1]), 2)
    0.27
    """
    course = batch_course(
        initial_concentration,
        initial_height,
        time,
        Suspension(settling, compression, solid_density, liquid_density, packed_concentration),
        cells,
    )
    height = course.interface_height(0.5 * initial_concentration)
    return BatchCourse(
        np.asarray(course.times),
        np.asarray(height),
        np.asarray(course.concentration[:, -1]),
        float(course.mass_error),
    )


def batch_course(
    initial_concentration: Any, initial_height: Any, time: Any, suspension: Suspension, cells: int
) -> Simulation:
    """The whole field of a batch simulation; a start at zero time is added when it is not given."""
    times = np.asarray(time, dtype=float)
    times = times if times.size and times[0] == 0 else np.concatenate([[0.0], np.atleast_1d(times)])
    return settle(suspension, initial_height, initial_concentration, check_times(times), cells=cells)


@procedure(
    source="burger2011; burger2013; diehl2001",
    title="Continuous clarifier-thickener simulation",
    typical={
        "volume_flow": (0.05, 0.2),
        "feed_concentration": (2.0, 5.0),
        "underflow_volume_flow": (0.02, 0.04),
        "area": (500.0, 1500.0),
        "height": (3.0, 5.0),
    },
)
def continuous_simulation(
    time: Times,
    volume_flow: Annotated[VolumeFlow, Series("intervals")],
    feed_concentration: Annotated[Concentration, Series("intervals")],
    underflow_volume_flow: Annotated[VolumeFlow, Series("intervals")],
    area: Area,
    height: Length,
    settling: Settling = "takacs",
    compression: Compression | None = None,
    solid_density: Density = 1050.0,
    liquid_density: Density = 998.0,
    packed_concentration: Concentration | None = None,
    start_concentration: Concentration = 0.0,
    feed_depth_share: Fraction = 0.5,
    cone_height_share: Fraction = 0.0,
    bottom_area_share: OpenFraction = 0.05,
    cells: Annotated[int, Within(5, 5000)] = 100,
) -> ContinuousCourse:
    """Continuous clarifier-thickener with feed, underflow and overflow that change from interval to
    interval.

    Feed and underflow hold one value, or one for each interval between the times. The blanket is where the
    concentration passes half the last feed concentration. The lower part may be a cone: its share of the
    depth, and of the area at its bottom.

    >>> sludge = {"law": "vesilind", "vesilind_velocity": "5 m/hour", "vesilind_coefficient": 0.5}
    >>> course = continuous_simulation(
    ...     ["0 day", "3 day", "6 day"], "800 m^3/hour", 2.5, "300 m^3/hour", 1000, 4, sludge, cells=30
    ... )
    >>> round(float(course.underflow_concentration[-1]), 3), course.mass_error < 1e-10
    (6.667, True)
    """
    suspension = Suspension(settling, compression, solid_density, liquid_density, packed_concentration)
    course = continuous_course(
        time,
        volume_flow,
        feed_concentration,
        underflow_volume_flow,
        area,
        height,
        suspension,
        start_concentration,
        feed_depth_share,
        cells,
        Cone(cone_height_share, bottom_area_share) if cone_height_share > 0 else None,
    )
    last = float(np.atleast_1d(np.asarray(feed_concentration))[-1])
    return ContinuousCourse(
        np.asarray(course.times[1:]),
        np.asarray(course.underflow_concentration),
        np.asarray(course.overflow_concentration),
        np.asarray(course.interface_height(0.5 * last)[1:]),
        float(course.mass_error),
    )


def continuous_course(
    time: Any,
    volume_flow: Any,
    feed_concentration: Any,
    underflow_volume_flow: Any,
    area: Any,
    height: Any,
    suspension: Suspension,
    start_concentration: Any,
    feed_depth_share: Any,
    cells: int,
    cone: Cone | None = None,
) -> Simulation:
    """The whole field of a continuous simulation."""
    times = check_times(time)
    given = [np.asarray(x, dtype=float) for x in (volume_flow, underflow_volume_flow, feed_concentration)]
    for x in given:
        if x.size not in (1, times.size - 1):
            raise InputError(
                _(
                    "Feed and underflow need one value or one for each of the {count} intervals between "
                    "the times; {given} were given."
                ).format(count=times.size - 1, given=x.size)
            )
    flow, under, feed = (np.broadcast_to(x.reshape(-1), (times.size - 1,)) for x in given)
    if np.any(under > flow):
        raise InputError(_("The underflow must not exceed the feed: the tank would run dry."))
    operation = Operation(
        jnp.asarray(times), jnp.asarray(flow / area), jnp.asarray(under / area), jnp.asarray(feed)
    )
    return simulate(
        suspension,
        height,
        jnp.full(cells, float(start_concentration)),
        operation,
        feed_depth=feed_depth_share,
        cone=cone,
    )
