"""Charts of single-particle motion: drag against Reynolds number, deviation from measured drag,
trajectories.
"""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np

from granum.core import chart
from granum.core.constants import STANDARD_GRAVITY
from granum.core.i18n import _
from granum.core.kinds import (
    KINDS,
    Acceleration,
    Density,
    DynamicViscosity,
    Law,
    Length,
    Ratio,
    Time,
    Velocity,
)
from granum.particles.formulas.drag_modern import drag_coefficient_brown_lawler
from granum.particles.formulas.terminal import terminal_velocity
from granum.particles.formulas.trajectories import trajectory, trajectory_stokes
from granum.particles.ranking import measured_drag, sphere_laws

Drag = Annotated[Any, Law("drag_coefficient")]
NAMED = ("stokes", "allen", "newton", "fair_geyer")
"""Laws that get a color of their own beside the chosen one."""


def _author(law: Any) -> str:
    """The name of a drag law among the others: its author."""
    title = law.card.title if hasattr(law, "card") else _("chosen law")
    return title.partition(" (")[2].removesuffix(")") or title


FAINT: dict[str, Any] = {"width": 0.8, "opacity": 0.5, "showlegend": False}
"""How the many lines are drawn among which a few are named; theirs are the names that hover."""


def _inside(law: Any, Re: np.ndarray) -> np.ndarray:
    low, high = law.card.fitted.get("reynolds", (0.0, np.inf))
    return Re[(low <= Re) & (high >= Re)]


@chart(source="clift1978, chapter 5; roos1971; morsi1972", title="Drag coefficient against Reynolds number")
def drag_chart(
    particle_diameter: Length | None = None,
    particle_density: Density | None = None,
    fluid_density: Density | None = None,
    dynamic_viscosity: DynamicViscosity | None = None,
    gravity: Acceleration = STANDARD_GRAVITY,
    drag: Drag = drag_coefficient_brown_lawler,
) -> Any:
    """Drag coefficient of a sphere against the Reynolds number: all laws in their ranges, measurements, the
    operating point.

    The operating point, and the line C_D = X/Re² on which it lies, appear when particle and fluid are given.

    >>> drawing = drag_chart(
    ...     particle_diameter=85e-6, particle_density=2650.0, fluid_density=998.2, dynamic_viscosity=1.0016e-3
    ... )
    >>> drawing.layout.annotations[-1].text
    'Re = 0.5027, C<sub>D</sub> = 52.23'
    """
    from granum.core.charts import (
        ACCENT,
        CAUTION,
        GAS,
        HEAT,
        INK,
        LIQUID,
        SOLID,
        add_label,
        add_line,
        add_points,
        axis_title,
        figure,
    )
    from granum.core.units import format_number

    drawing = figure(
        axis_title("reynolds"),
        axis_title("drag_coefficient"),
        title=_("Drag coefficient against Reynolds number"),
        x_log=True,
        y_log=True,
    )
    Re = np.geomspace(1e-3, 1e6, 271)
    colors: dict[str, str] = dict(zip(NAMED, (SOLID, LIQUID, HEAT, CAUTION), strict=True))
    chosen = drag.card.name.removeprefix("drag_coefficient_") if hasattr(drag, "card") else ""
    for name, law in sphere_laws().items():
        x = _inside(law, Re)
        if name == chosen or not x.size:
            continue
        color = colors.get(name, GAS)
        add_line(
            drawing,
            x,
            np.asarray(law(x)),
            _author(law),
            color=color,
            **(dict[str, Any](width=1.6) if name in colors else FAINT),
        )
    for name, symbol in (("roos1971", "Roos–Willmarth"), ("morsi1972", "Morsi–Alexander")):
        x, y = measured_drag(name)
        add_points(drawing, x, y, symbol, color=GAS, hollow=True, opacity=0.8)
        drawing.data[-1].marker.size = 4
    x = _inside(drag, Re) if hasattr(drag, "card") and drag.card.sort == "formula" else Re
    add_line(drawing, x, np.asarray(drag(x)), _author(drag), color=ACCENT, width=3)
    if None not in (particle_diameter, particle_density, fluid_density, dynamic_viscosity):
        speed = abs(
            terminal_velocity(
                particle_diameter, particle_density, fluid_density, dynamic_viscosity, gravity, drag
            )
        )
        if speed > 0.0:
            at = speed * particle_diameter * fluid_density / dynamic_viscosity
            drawn = float(drag(at))
            line = np.geomspace(at / 10.0, at * 10.0, 20)
            add_line(
                drawing, line, drawn * at**2 / line**2, "X = C<sub>D</sub>Re²", color=INK, dash="dot", width=1
            )
            text = f"Re = {format_number(at)}, C<sub>D</sub> = {format_number(drawn)}"
            add_points(drawing, [at], [drawn], text, color=INK)
            drawing.data[-1].update(marker_size=11, showlegend=False)
            add_label(drawing, at * 1.3, drawn * 2.5, text, color=INK, xanchor="left")
    drawing.update_yaxes(range=[-1.3, 4.5])
    drawing.update_layout(legend={"x": 0.98, "xanchor": "right", "y": 0.98}, height=560)
    return drawing


@chart(source="roos1971; morsi1972", title="Drag laws against measured drag")
def drag_deviation_chart(deviation_largest: Ratio = 0.25) -> Any:
    """Deviation of every drag law from measured drag against the Reynolds number, law by law inside its
    range.
    """
    from granum.core.charts import ACCENT, GAS, HEAT, LIQUID, add_line, axis_title, figure
    from granum.core.units import format_number

    drawing = figure(
        axis_title("reynolds"),
        _("deviation from measured drag") + " / %",
        title=_("Drag laws against measured drag"),
        x_log=True,
    )
    Re, measured = measured_drag("morsi1972")
    found = []
    for law in sphere_laws().values():
        x = _inside(law, Re)
        if x.size >= 3:
            deviation = 100.0 * (np.asarray(law(x)) / np.interp(x, Re, measured) - 1.0)
            found.append((float(np.abs(deviation).mean()), _author(law), x, deviation))
    # named are those that come closest among the laws that speak for the whole range
    whole = sorted(row[:2] for row in found if row[2].size >= 0.9 * Re.size)
    named = dict(zip((author for _mean, author in whole), (ACCENT, LIQUID, HEAT), strict=False))
    for mean, author, x, deviation in sorted(found, key=lambda row: -row[0]):
        text = _("{law}: {deviation} % in the mean").format(law=author, deviation=format_number(mean, 2))
        how: dict[str, Any] = {"width": 2} if author in named else FAINT
        add_line(drawing, x, deviation, text, color=named.get(author, GAS), **how)
    drawing.update_yaxes(range=[-100.0 * deviation_largest, 100.0 * deviation_largest])
    drawing.update_layout(legend={"x": 0.98, "xanchor": "right", "y": 0.98}, height=560)
    return drawing


@chart(source="clift1978, chapter 11; brown2003", title="Trajectory of a particle")
def trajectory_chart(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    time: Time,
    initial_horizontal_velocity: Velocity = 0.0,
    initial_vertical_velocity: Velocity = 0.0,
    stream_velocity: Velocity = 0.0,
    gravity: Acceleration = STANDARD_GRAVITY,
    drag: Drag = drag_coefficient_brown_lawler,
    added_mass_coefficient: Ratio = 0.0,
) -> Any:
    """Path of a particle in a vertical plane under a drag law, with the path that Stokes' law would give."""
    from granum.core.charts import ACCENT, LIQUID, SOLID, add_line, add_points, axis_title, figure
    from granum.core.units import best_unit, format_number, from_si

    # even in the square root of time, so that the start is as smooth as the end
    times = time * np.linspace(0.0, 1.0, 120) ** 2
    inputs = (
        particle_diameter,
        particle_density,
        fluid_density,
        dynamic_viscosity,
        times,
        initial_horizontal_velocity,
        initial_vertical_velocity,
        stream_velocity,
        gravity,
    )
    path = trajectory(*inputs, drag, added_mass_coefficient)
    creeping = trajectory_stokes(*inputs, added_mass_coefficient)
    kind = KINDS["Position"]
    spans = [float(max(np.ptp(np.asarray(v)), 1e-12)) for v in (path.horizontal_position, path.depth)]
    units = [best_unit(span, kind) for span in spans]

    def shown(which: Any) -> tuple[Any, Any]:
        return tuple(
            from_si(np.asarray(v), u, kind)
            for v, u in zip((which.horizontal_position, which.depth), units, strict=True)
        )  # type: ignore[return-value]

    drawing = figure(
        axis_title("horizontal_position", units[0]),
        axis_title("depth", units[1]),
        title=_("Trajectory of a particle"),
    )
    x, y = shown(path)
    sx, sy = shown(creeping)
    beyond = (abs(sx) <= 1.5 * max(abs(x).max(), 1e-12)) & (abs(sy) <= 1.5 * max(abs(y).max(), 1e-12))
    add_line(drawing, sx[beyond], sy[beyond], _("Stokes' law"), color=LIQUID, dash="dash", width=1.5)
    name = drag.card.title if hasattr(drag, "card") else _("chosen law")
    add_line(drawing, x, y, name, color=ACCENT, width=3)
    marks = [int(np.searchsorted(times, f * time)) for f in (0.25, 0.5, 0.75)] + [len(times) - 1]
    add_points(
        drawing,
        x[marks],
        y[marks],
        ", ".join(f"{format_number(float(times[i]))} s" for i in marks),
        color=SOLID,
    )
    drawing.update_yaxes(autorange="reversed")
    return drawing
