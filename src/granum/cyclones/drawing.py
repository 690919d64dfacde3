"""A gas cyclone drawn to scale: elevation and plan with its dimensions."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np

from granum.core import chart
from granum.core.i18n import _
from granum.core.kinds import Law, Length
from granum.cyclones.geometry import StandardCyclone


@chart(source="leith1973; cooper2011", title="Cyclone drawn to scale", typical={"diameter": (0.5, 2.0)})
def cyclone_drawing(
    diameter: Length, cyclone_geometry: Annotated[Any, Law("cyclone_geometry")] = StandardCyclone()
) -> Any:
    """Elevation and plan of a gas cyclone to scale, with its dimensions in millimeters."""
    from granum.core.charts import ACCENT, GAS, INK, SOLID, add_label, figure

    D, a, b, De, S, h, H, B = (1e3 * float(x) for x in cyclone_geometry(diameter))
    R, out = D / 2.0, 0.25 * D
    drawing = figure("mm", "mm", title=_("Cyclone drawn to scale"), showlegend=False)
    right, plan = 2.4 * D, -0.75 * D  # center of the plan, beside the elevation

    def path(x: Any, y: Any, color: str = INK, dash: str = "solid") -> None:
        drawing.add_scatter(
            x=x, y=y, mode="lines", line={"color": color, "width": 1.6, "dash": dash}, hoverinfo="skip"
        )

    path(
        [-R, R, R, B / 2, B / 2, -B / 2, -B / 2, -R, -R],
        [0, 0, -h, -H, -H - 0.1 * D, -H - 0.1 * D, -H, -h, 0],
    )
    path([-R, R], [-h, -h], dash="dot")
    for side in (-1.0, 1.0):
        path([side * De / 2] * 2, [out, 0], GAS)
        path([side * De / 2] * 2, [0, -S], GAS, "dash")
    path([-De / 2, De / 2], [-S, -S], GAS, "dash")
    path([-R, -R + b, -R + b, -R, -R], [0, 0, -a, -a, 0], ACCENT)  # mouth of the inlet, seen along the gas
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    path(right + R * np.cos(turn), plan + R * np.sin(turn))
    path(right + De / 2 * np.cos(turn), plan + De / 2 * np.sin(turn), GAS)
    reach = np.sqrt(max(R**2 - (R - b) ** 2, 0.0))  # where the inner wall of the inlet meets the body
    side = right - R
    path([side, side, side + b, side + b], [plan, plan - R - out, plan - R - out, plan - reach], ACCENT)

    def dimension(x0: float, y0: float, x1: float, y1: float, symbol: str, color: str = INK) -> None:
        value = f"{abs(x1 - x0) + abs(y1 - y0):.0f}"
        drawing.add_annotation(
            x=x1,
            y=y1,
            ax=x0,
            ay=y0,
            xref="x",
            yref="y",
            axref="x",
            ayref="y",
            text="",
            showarrow=True,
            arrowhead=2,
            arrowside="end+start",
            arrowsize=0.8,
            arrowwidth=1,
            arrowcolor=color,
        )
        upright, sign = x0 == x1, -1 if x0 < -R else 1
        add_label(
            drawing,
            (x0 + x1) / 2,
            (y0 + y1) / 2,
            f"<i>{symbol}</i> {value}",
            color=color,
            xshift=4 * sign if upright else 0,
            xanchor="center" if not upright else "left" if sign > 0 else "right",
            yanchor="middle" if upright else "top" if symbol in "bB" else "bottom",
        )

    dimension(-R, 0.25 * D - h, R, 0.25 * D - h, "D")
    dimension(-De / 2, out + 0.02 * D, De / 2, out + 0.02 * D, "D<sub>e</sub>", GAS)
    dimension(-B / 2, -H - 0.22 * D, B / 2, -H - 0.22 * D, "B", SOLID)
    dimension(side, plan - R - 1.2 * out, side + b, plan - R - 1.2 * out, "b", ACCENT)
    dimension(-1.12 * R, -a, -1.12 * R, 0, "a", ACCENT)
    dimension(0, -S, 0, 0, "S", GAS)
    dimension(1.1 * R, -h, 1.1 * R, 0, "h")
    dimension(1.1 * R, -H, 1.1 * R, -h, "H − h")
    dimension(2.3 * R, -H, 2.3 * R, 0, "H")
    add_label(drawing, 0, 0.5 * D, _("elevation"), yanchor="bottom")
    add_label(drawing, right, plan + 1.1 * R, _("plan"), yanchor="bottom")
    drawing.update_layout(height=720)
    drawing.update_xaxes(range=[-1.2 * D, 3.1 * D], showgrid=False)
    drawing.update_yaxes(scaleanchor="x", scaleratio=1, showgrid=False)
    return drawing
