"""Charts of two salts in one solvent."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
import plotly.graph_objects as go

from granum.core import chart
from granum.core.charts import GRID, LINES, OUT, template
from granum.core.constants import ZERO_CELSIUS
from granum.core.i18n import _
from granum.core.kinds import Series, Temperature
from granum.crystallization.vessels.common_ion import isotherm
from granum.materials.common_ion import common_ion


@chart(
    source="greenberg1989; mullin2001, ch. 4",
    title="Two salts in water: triangle",
    typical={"isotherm_temperatures": (273.15, 373.15)},
)
def two_salts_chart(
    isotherm_temperatures: Annotated[Temperature, Series("isotherms")],
    first_salt: str = "sodium chloride",
    second_salt: str = "potassium chloride",
) -> Any:
    """Saturation lines of two salts with a common ion and their invariant points, at several temperatures, on
    a triangle by mass.

    Above a line the solution is unsaturated. Below it one salt crystallizes along a straight line from its
    corner; between the lines from an invariant point to both corners both do.

    >>> drawing = two_salts_chart(isotherm_temperatures=[298.15, 373.15])
    >>> len(drawing.data)
    4
    """
    pair = common_ion(first_salt, second_salt)
    names = [system.branch().crystal.label for system in (pair.first, pair.second)]
    drawing = go.Figure()
    for T, color in zip(np.atleast_1d(isotherm_temperatures), LINES * 10, strict=False):
        found = isotherm(pair, float(T))
        x, y = np.asarray(found.first), np.asarray(found.second)
        word = f"{T - ZERO_CELSIUS:.0f} °C"
        for several in (True, False):
            here = slice(None) if several else slice(found.corner, found.corner + 1)
            drawing.add_trace(
                go.Scatterternary(
                    a=100.0 * (1.0 - x - y)[here],
                    b=100.0 * x[here],
                    c=100.0 * y[here],
                    mode="lines" if several else "markers",
                    name=word if several else _("both saturated, {where}").format(where=word),
                    line={"color": color, "width": 2},
                    marker={"color": color, "size": 9, "line": {"color": OUT, "width": 1}},
                    showlegend=several,
                    hovertemplate="%{b:.1f} + %{c:.1f} + %{a:.1f} %<extra>%{fullData.name}</extra>",
                )
            )
    axis = {"gridcolor": GRID, "ticks": "outside", "tickfont": {"size": 11}}
    drawing.update_layout(
        template=template(),
        height=520,
        title=_("Two salts in water, mass percent"),
        ternary={
            "sum": 100,
            "aaxis": axis | {"title": _("water"), "min": 50},
            "baxis": axis | {"title": names[0]},
            "caxis": axis | {"title": names[1]},
        },
    )
    return drawing
