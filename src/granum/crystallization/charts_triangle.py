"""Triangle by mass percent: solvent above, two solutes below."""

from __future__ import annotations

from typing import Any

import numpy as np
import plotly.graph_objects as go

from granum.core.charts import GRID, template
from granum.core.constants import ZERO_CELSIUS


def celsius(temperature: float) -> str:
    """A temperature as the name of a line."""
    return f"{temperature - ZERO_CELSIUS:.0f} °C"


def add_on_triangle(drawing: go.Figure, first: Any, second: Any, name: str, **look: Any) -> None:
    """One trace of mass fractions of both solutes."""
    first, second = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    drawing.add_trace(
        go.Scatterternary(
            {
                "a": 100.0 * (1.0 - first - second),
                "b": 100.0 * first,
                "c": 100.0 * second,
                "name": name,
                "showlegend": True,
                "hovertemplate": "%{b:.1f} + %{c:.1f} + %{a:.1f} %<extra>%{fullData.name}</extra>",
            }
            | look
        )
    )


def lay_out_triangle(drawing: go.Figure, title: str, corners: tuple[str, str, str], least: float) -> None:
    """Names of the corners, solvent first, down to this percentage of solvent."""
    axis = {"gridcolor": GRID, "ticks": "outside", "tickfont": {"size": 11}}
    drawing.update_layout(
        template=template(),
        height=520,
        title=title,
        ternary={
            "sum": 100,
            "aaxis": axis | {"title": corners[0], "min": least},
            "baxis": axis | {"title": corners[1]},
            "caxis": axis | {"title": corners[2]},
        },
    )
