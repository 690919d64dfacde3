"""Charts of what happens inside a dryer: moisture and temperature along the way of the solid, or over
time.
"""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np

from granum.core import chart
from granum.core.i18n import _
from granum.core.kinds import MoistureDryBasis, Ratio, Series, Temperature
from granum.drying.gas_solid.cells import Profile
from granum.drying.gas_solid.matter import Matter
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream

ZERO = 273.15
HUMIDITIES = (1.0, 0.5, 0.2, 0.1, 0.05)
ROOM = 1.15  # over the moistest state
EARLY = 0.2  # share of the way, within which a profile that changes no more is drawn alone


def _drawn(x: Any, title: str, x_label: str) -> Any:
    """A figure with temperature on the left and moisture on the right."""
    from granum.core.charts import add_right_axis, axis_title, figure

    drawing = figure(x_label, axis_title("temperature", "degC"), title=title)
    add_right_axis(drawing, axis_title("moisture_dry_basis", "kg/kg"), rangemode="tozero", tickmode="auto")
    drawing.update_layout(
        legend={"orientation": "h", "y": -0.22, "x": 0.0},
        margin={"r": 75, "b": 110},
    )
    drawing.update_xaxes(range=[float(np.min(x)), float(np.max(x))])
    return drawing


@chart(source="keey1978", title="Profiles in a dryer")
def drying_profile_chart(
    place: Annotated[Ratio, Series("points")],
    moisture_dry_basis: Annotated[MoistureDryBasis, Series("points")],
    temperature: Annotated[Temperature, Series("points")],
    temperature_gas: Annotated[Temperature, Series("points")],
) -> Any:
    """Moisture of the solid, and temperatures of solid and gas, along the way of the solid through a dryer
    from 0 to 1.

    >>> len(
    ...     drying_profile_chart(
    ...         place=[0.0, 0.25, 0.5, 0.75, 1.0],
    ...         moisture_dry_basis=[0.4, 0.31, 0.22, 0.13, 0.06],
    ...         temperature="25 38 40 44 62 degC",
    ...         temperature_gas="140 112 94 82 74 degC",
    ...     ).data
    ... )
    3
    """
    from granum.core.charts import GAS, LIQUID, SOLID, add_line, axis_title

    x = np.asarray(place)
    drawing = _drawn(x, _("Profiles in a dryer"), axis_title("place"))
    add_line(drawing, x, np.asarray(temperature_gas) - ZERO, _("gas temperature"), color=GAS)
    add_line(drawing, x, np.asarray(temperature) - ZERO, _("solid temperature"), color=SOLID)
    add_line(drawing, x, moisture_dry_basis, _("moisture"), color=LIQUID, dash="dash", yaxis="y2")
    return drawing


def profile_chart(dryer: Any, feed: Stream, gas: Stream, time: Any = None) -> Any:
    """The profile of a dryer in steady state: means over the classes of solid, with the driest and the
    wettest of them where they differ.

    ``time``: residence time, to draw over it instead of the place.
    """
    return drawn_profile(dryer.profile(feed, gas), time)


def _settled(x: np.ndarray, *lines: np.ndarray) -> float:
    """Where the last of some lines has come within a hundredth of its way to its end."""
    moving = [np.flatnonzero(np.abs(y - y[-1]) > 0.01 * np.ptp(y)) for y in lines if np.ptp(y) > 0.0]
    return float(x[min(max((int(at[-1]) for at in moving if at.size), default=x.size - 2) + 1, x.size - 1)])


def drawn_profile(found: Profile, time: Any = None) -> Any:
    """A profile as a chart."""
    from granum.core.charts import GAS, LIQUID, SOLID, add_line, axis_title
    from granum.core.units import pretty_unit

    shares, X, T = (np.asarray(v) for v in (found.shares, found.moisture, found.temperature))
    x = np.asarray(found.place) * (1.0 if time is None else float(time) / 60.0)
    label = axis_title("place") if time is None else f"{_('time in the dryer')} / {pretty_unit('min')}"
    drawing = _drawn(x, _("Profiles in a dryer"), label)
    add_line(drawing, x, np.asarray(found.gas_temperature) - ZERO, _("gas temperature"), color=GAS)
    add_line(drawing, x, T @ shares - ZERO, _("solid temperature"), color=SOLID)
    add_line(drawing, x, X @ shares, _("moisture"), color=LIQUID, dash="dash", yaxis="y2")
    last_change = _settled(x, np.asarray(found.gas_temperature), T @ shares, X @ shares)
    if last_change < EARLY * x[-1]:  # all that happens would be one upright line at the edge
        drawing.update_xaxes(range=[float(x[0]), 1.5 * last_change])
    some = np.flatnonzero(shares > 1e-6)
    last = X[:, some]
    if np.ptp(last, axis=1).max() > 1e-3 * last.max():
        add_line(
            drawing, x, last.max(axis=1), _("wettest part"), color=LIQUID, dash="dot", width=1, yaxis="y2"
        )
        add_line(
            drawing, x, last.min(axis=1), _("driest part"), color=LIQUID, dash="dashdot", width=1, yaxis="y2"
        )
    return drawing


def drawn_air(found: Profile, feed: Stream, gas: Stream, exhaust: Stream, against: bool) -> Any:
    """The gas of a dryer among lines of relative humidity from where it enters to where it leaves; None for
    steam, which has no dry gas to count by.
    """
    from granum.core.charts import GAS, INK, add_label, add_line, axis_title, faded, figure
    from granum.core.units import format_number

    matter, humid = Matter.of(feed, gas), HumidMixture(gas.mixture)
    if bool(matter.is_steam):
        return None
    way = slice(None, None, -1 if against else 1)
    ends = [(float(s.temperature), float(humid.vapor_per_carrier(s))) for s in (gas, exhaust)]
    T = np.array([ends[0][0], *np.asarray(found.gas_temperature)[way], ends[1][0]])
    Y = np.array([ends[0][1], *np.asarray(found.humidity)[way], ends[1][1]])
    drawing = figure(
        axis_title("temperature", "degC"),
        axis_title("humidity_ratio", "kg/kg"),
        title=_("Path of the air in a dryer"),
    )
    low, high, top = min(T.min(), float(feed.temperature)) - 10.0, T.max() + 10.0, ROOM * Y.max() + 1e-3
    grid = np.linspace(low, high, 200)
    share = np.asarray(matter.saturation_pressure(grid) / matter.pressure)
    for phi in HUMIDITIES:
        y = np.minimum(phi * share, 0.99)
        w = float(matter.molar_mass_ratio) * y / (1.0 - y)
        percent = f"{format_number(100.0 * phi, 2)} %"
        name = f"{axis_title('relative_humidity')} {percent}"
        x, y = grid[w <= top] - ZERO, w[w <= top]
        add_line(drawing, x, y, name, color=faded(INK), width=2 if phi == 1.0 else 1)
        if x.size:
            add_label(drawing, float(x[-1]), float(y[-1]), percent, xanchor="right", yanchor="top", xshift=-2)
    add_line(drawing, T - ZERO, Y, _("gas"), color=GAS)
    drawing.update_layout(showlegend=False)  # the lines say themselves what they are
    drawing.update_xaxes(range=[low - ZERO, high - ZERO])
    drawing.update_yaxes(range=[0.0, top])
    return drawing


def contact_chart(time: Any, moisture: Any, temperature: Any) -> Any:
    """Moisture and temperature of an agitated bed over its time on the wall, s."""
    from granum.core.charts import LIQUID, SOLID, add_line
    from granum.core.units import pretty_unit

    x = np.asarray(time) / 60.0
    drawing = _drawn(x, _("Profiles in a dryer"), f"{_('time in the dryer')} / {pretty_unit('min')}")
    add_line(drawing, x, np.asarray(temperature) - ZERO, _("solid temperature"), color=SOLID)
    add_line(drawing, x, np.asarray(moisture), _("moisture"), color=LIQUID, dash="dash", yaxis="y2")
    return drawing
