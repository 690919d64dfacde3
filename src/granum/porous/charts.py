"""Charts of flow through beds: pressure drop against velocity with the regimes."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np

from granum.core import chart
from granum.core.i18n import _
from granum.core.kinds import KINDS, Density, DynamicViscosity, Law, Length, Speed, Sphericity, VoidFraction
from granum.porous.formulas.packed_beds import (
    pressure_gradient_blake_kozeny,
    pressure_gradient_burke_plummer,
    pressure_gradient_ergun,
)

CREEPING_END, TURBULENT_START = 10.0, 1000.0  # Re₁: inertia below a tenth, above nine tenths


@chart(source="ergun1952; carman1937", title="Pressure drop of a bed against velocity")
def pressure_drop_chart(
    particle_diameter: Length,
    void_fraction: VoidFraction,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    superficial_velocity: Speed,
    length: Length = 1.0,
    sphericity: Sphericity = 1.0,
    pressure_gradient: Annotated[Any, Law("pressure_gradient")] = pressure_gradient_ergun,
) -> Any:
    """Pressure drop of a bed against velocity on log axes: every law, the two asymptotes, the regimes and the
    operating point.
    """
    from granum.core.charts import (
        ACCENT,
        CAUTION,
        GAS,
        GRID,
        INK,
        add_label,
        add_line,
        add_points,
        axis_title,
        figure,
    )
    from granum.core.registry import everything
    from granum.core.units import best_unit, format_number, from_si

    bed = (particle_diameter, void_fraction, fluid_density, dynamic_viscosity, sphericity)
    per_velocity = (
        fluid_density * sphericity * particle_diameter / (dynamic_viscosity * (1.0 - void_fraction))
    )
    center = superficial_velocity if superficial_velocity > 0.0 else CREEPING_END / per_velocity
    low, high = (
        min(center / 100.0, CREEPING_END / per_velocity / 10.0),
        max(center * 100.0, TURBULENT_START / per_velocity * 10.0),
    )
    U = np.geomspace(low, high, 161)
    point = length * float(pressure_gradient(center, *bed))
    kinds = (KINDS["Speed"], KINDS["PressureDrop"])
    units = [best_unit(value, kind) for value, kind in zip((center, point), kinds, strict=True)]
    across = lambda v: from_si(np.asarray(v), units[0], kinds[0])  # noqa: E731
    upward = lambda v: from_si(np.asarray(v), units[1], kinds[1])  # noqa: E731

    drawing = figure(
        axis_title("superficial_velocity", units[0]),
        axis_title("pressure_drop", units[1]),
        title=_("Pressure drop of a bed against velocity"),
        x_log=True,
        y_log=True,
    )
    chosen = pressure_gradient.card.name if hasattr(pressure_gradient, "card") else ""
    for law in everything(("porous",)).values():
        skipped = (
            chosen,
            "pressure_gradient_obstacles",
            "pressure_gradient_blake_kozeny",
            "pressure_gradient_burke_plummer",
        )
        if law.card.family != "pressure_gradient" or law.card.sort != "formula" or law.card.name in skipped:
            continue
        least, most = law.card.fitted.get("reynolds_bed", (0.0, np.inf))
        V = U[(least <= U * per_velocity) & (most >= U * per_velocity)]
        name = law.card.name.removeprefix("pressure_gradient_").replace("_", "–").title()
        add_line(
            drawing,
            across(V),
            upward(length * np.asarray(law(V, *bed))),
            name,
            color=GAS,
            width=0.8,
            opacity=0.6,
            legendgroup="laws",
        )
    for law, name in (
        (pressure_gradient_blake_kozeny, _("viscous part")),
        (pressure_gradient_burke_plummer, _("inertial part")),
    ):
        add_line(
            drawing,
            across(U),
            upward(length * np.asarray(law(U, *bed))),
            name,
            color=CAUTION,
            dash="dash",
            width=1.2,
        )
    title = chosen.removeprefix("pressure_gradient_").replace("_", "–").title() or _("chosen law")
    add_line(
        drawing,
        across(U),
        upward(length * np.asarray(pressure_gradient(U, *bed))),
        title,
        color=ACCENT,
        width=3,
    )
    if superficial_velocity > 0.0:
        text = (
            f"{format_number(float(across(center)))} {units[0]} · {format_number(float(upward(point)))} "
            f"{units[1]}"
        )
        add_points(drawing, [float(across(center))], [float(upward(point))], text, color=INK)
    bounds = (low, CREEPING_END / per_velocity, TURBULENT_START / per_velocity, high)
    top = float(upward(length * float(pressure_gradient(high, *bed))))
    for a, b, name, shade in zip(
        bounds[:-1],
        bounds[1:],
        (_("creeping"), _("intermediate"), _("turbulent")),
        ("white", GRID, "white"),
        strict=True,
    ):
        drawing.add_shape(
            type="rect",
            xref="x",
            yref="paper",
            x0=float(across(a)),
            x1=float(across(b)),
            y0=0,
            y1=1,
            fillcolor=shade,
            opacity=0.5,
            line_width=0,
            layer="below",
        )
        add_label(drawing, float(across(a)), top, name, xanchor="left")
    drawing.update_xaxes(range=[float(np.log10(across(low))), float(np.log10(across(high)))])
    drawing.update_layout(legend={"x": 1.01, "y": 1.0, "font": {"size": 10}}, width=None)
    return drawing
