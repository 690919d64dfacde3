"""Charts of centrifuges: a bowl with its radii, grade efficiencies."""

from __future__ import annotations

from typing import Any

import numpy as np

from granum.centrifuges.formulas.clarifying import grade_efficiency_tubular, radius_interface
from granum.core import chart
from granum.core.constants import STANDARD_GRAVITY
from granum.core.i18n import _
from granum.core.kinds import Density, DynamicViscosity, Length, RotationSpeed, VolumeFlow


@chart(source="mccabe2005, ch. 29", title="Radii in a liquid–liquid bowl")
def bowl_chart(
    radius_heavy: Length,
    radius_light: Length,
    density_heavy: Density,
    density_light: Density,
    bowl_radius: Length,
    bowl_length: Length,
) -> Any:
    """Half section of a bowl that parts two liquids: axis at the bottom, light and heavy layer, interface,
    overflows and wall.
    """
    from granum.core.charts import CAUTION, INK, LIQUID, SOLID, add_label, figure
    from granum.core.units import format_number

    ri = radius_interface(radius_heavy, radius_light, density_heavy, density_light)
    L, R = 100.0 * bowl_length, 100.0 * bowl_radius
    drawing = figure(_("length") + " / cm", _("radius") + " / cm", title=_("Radii in a liquid–liquid bowl"))
    interface = min(100.0 * ri, R) if np.isfinite(ri) else R
    for low, high, color in ((100.0 * radius_light, interface, LIQUID), (interface, R, SOLID)):
        drawing.add_shape(
            type="rect", x0=0, x1=L, y0=low, y1=high, fillcolor=color, opacity=0.25, line_width=0
        )
    for radius, text, color in (
        (R, _("wall"), INK),
        (interface, _("interface"), CAUTION),
        (100.0 * radius_heavy, _("overflow of the heavy liquid"), SOLID),
        (100.0 * radius_light, _("overflow of the light liquid"), LIQUID),
    ):
        drawing.add_shape(
            type="line",
            x0=0,
            x1=L,
            y0=radius,
            y1=radius,
            line={"color": color, "width": 2 if radius in (R, interface) else 1},
        )
        below = radius == 100.0 * min(radius_light, radius_heavy)
        add_label(
            drawing,
            0.02 * L,
            radius,
            f"{text} {format_number(radius)} cm",
            color=color,
            xanchor="left",
            yanchor="top" if below else "bottom",
        )
    drawing.update_xaxes(range=[0, L])
    drawing.update_yaxes(range=[0, 1.1 * R])
    return drawing


@chart(source="svarovsky2001", title="Grade efficiency of a tubular bowl")
def grade_efficiency_chart(
    volume_flow: VolumeFlow,
    bowl_length: Length,
    radius_inner: Length,
    radius_outer: Length,
    rotation_speed: RotationSpeed,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
) -> Any:
    """Share caught against particle size in a tubular bowl, by Stokes' law."""
    from granum.core.charts import add_line, axis_title, figure

    d = np.geomspace(1e-8, 1e-3, 400)
    falling = d**2 * (particle_density - fluid_density) * STANDARD_GRAVITY / (18.0 * dynamic_viscosity)
    E = np.asarray(
        grade_efficiency_tubular(
            np.maximum(falling, 0.0), volume_flow, bowl_length, radius_inner, radius_outer, rotation_speed
        )
    )
    shown = (E > 1e-3) & (
        np.arange(d.size) <= min(int(np.argmax(E >= 1.0)) + 20, d.size) if E.max() >= 1.0 else E > 1e-3
    )
    drawing = figure(
        axis_title("particle_diameter", "um"),
        axis_title("grade_efficiency"),
        title=_("Grade efficiency of a tubular bowl"),
        x_log=True,
    )
    add_line(drawing, 1e6 * d[shown], E[shown], _("model"))
    return drawing
