"""The curve of pressure drop against velocity with its hysteresis, and the charts of fluidization."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import numpy as np

from granum.core import chart, flags, procedure
from granum.core.constants import STANDARD_GRAVITY
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Length,
    PositiveNumber,
    PressureDrop,
    Series,
    Speed,
    Sphericity,
    VoidFraction,
)
from granum.fluidization.formulas.minimum_beds import minimum_fluidization_velocity_ergun
from granum.fluidization.formulas.regimes import grace_coordinates
from granum.fluidization.ranking import denser, fluidization_regime, geldart_group
from granum.particles.formulas.terminal import terminal_velocity
from granum.porous.formulas.packed_beds import pressure_gradient_ergun


class PressureVelocity(NamedTuple):
    """Rising and falling branch over the same velocities."""

    superficial_velocity: Annotated[Speed, Series("points")]
    pressure_drop_rising: Annotated[PressureDrop, Series("points")]
    pressure_drop_falling: Annotated[PressureDrop, Series("points")]
    minimum_fluidization_velocity: Speed
    plateau_pressure_drop: PressureDrop
    terminal_velocity: Speed


@procedure(
    source="kunii1991, ch. 3; ergun1952", title="Pressure drop of a bed against velocity, with hysteresis"
)
def pressure_velocity(
    height: Length,
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    void_fraction: VoidFraction = 0.43,
    void_fraction_settled: VoidFraction = 0.40,
    sphericity: Sphericity = 1.0,
    overshoot: PositiveNumber = 1.1,
) -> PressureVelocity:
    """Pressure drop of a bed as the velocity rises to transport and falls back.

    Rising, the densely packed bed follows Ergun's line, sticks up to the overshoot times its weight, and
    falls to the weight. Falling, it settles at the looser void fraction of minimum fluidization and follows
    the flatter line. Above the terminal velocity it empties: the curve ends there. Height is that of the
    dense bed.

    >>> curve = pressure_velocity(0.5, "200 um", 2600, 1.2, 1.8e-5)
    >>> round(curve.plateau_pressure_drop / (0.5 * 0.6 * 2598.8 * 9.80665), 6)
    1.0
    """
    denser(particle_density, fluid_density)
    if void_fraction < void_fraction_settled:
        raise InputError(
            _(
                "'void_fraction' at minimum fluidization ({loose}) must not be below that of the "
                "settled bed ({dense})."
            ).format(loose=f"{void_fraction:g}", dense=f"{void_fraction_settled:g}"),
            name="void_fraction",
        )
    solid = height * (1.0 - void_fraction_settled)
    weight = solid * (particle_density - fluid_density) * STANDARD_GRAVITY
    first = minimum_fluidization_velocity_ergun(
        particle_diameter, particle_density, fluid_density, dynamic_viscosity, void_fraction, sphericity
    )
    end = terminal_velocity(particle_diameter, particle_density, fluid_density, dynamic_viscosity)
    U = np.unique(
        np.concatenate(
            [
                np.linspace(0.02 * first, 2.0 * first, 120),
                np.geomspace(2.0 * first, max(end, 2.1 * first), 40),
            ]
        )
    )

    def fixed(e: float) -> Any:
        with flags.collect():  # its range ends where the first term is Kozeny and Carman's law
            gradient = pressure_gradient_ergun(
                U, particle_diameter, e, fluid_density, dynamic_viscosity, sphericity
            )
        return np.asarray(gradient) * solid / (1.0 - e)

    dense = fixed(void_fraction_settled)
    rising = np.where(dense < overshoot * weight, dense, weight)
    return PressureVelocity(U, rising, np.minimum(fixed(void_fraction), weight), first, weight, end)


@chart(source="kunii1991, ch. 3; ergun1952", title="Pressure drop against velocity")
def pressure_velocity_chart(
    height: Length,
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    void_fraction: VoidFraction = 0.43,
    void_fraction_settled: VoidFraction = 0.40,
    sphericity: Sphericity = 1.0,
    overshoot: PositiveNumber = 1.1,
) -> Any:
    """Pressure drop against velocity, rising and falling, with the point of minimum fluidization and the
    terminal velocity.
    """
    from granum.core.charts import ACCENT, CAUTION, OUT, SOLID, add_line, add_points, axis_title, figure

    curve = pressure_velocity(
        height,
        particle_diameter,
        particle_density,
        fluid_density,
        dynamic_viscosity,
        void_fraction,
        void_fraction_settled,
        sphericity,
        overshoot,
    )
    drawing = figure(
        axis_title("superficial_velocity", "m/s"),
        axis_title("pressure_drop", "kPa"),
        x_log=True,
        title=_("Pressure drop against velocity"),
    )
    add_line(
        drawing,
        curve.superficial_velocity,
        curve.pressure_drop_rising / 1e3,
        _("rising velocity"),
        color=SOLID,
    )
    add_line(
        drawing,
        curve.superficial_velocity,
        curve.pressure_drop_falling / 1e3,
        _("falling velocity"),
        color=ACCENT,
        dash="dash",
    )
    top = curve.plateau_pressure_drop / 1e3
    add_points(
        drawing, [curve.minimum_fluidization_velocity], [top], _("minimum fluidization"), color=CAUTION
    )
    add_points(drawing, [curve.terminal_velocity], [top], _("transport"), color=OUT)
    drawing.update_yaxes(rangemode="tozero")
    return drawing


@chart(source="geldart1973; molerus1982", title="Geldart's groups")
def geldart_chart(particle_diameter: Length, particle_density: Density, fluid_density: Density = 1.2) -> Any:
    """Geldart's map of powders with the operating point."""
    from granum.core.charts import INK, OUT, SOLID, add_label, add_line, add_points, axis_title, figure

    heavy = np.geomspace(100.0, 1e4, 30)
    borders = (
        np.array([geldart_group(1e-4, h + fluid_density, fluid_density).border_size for h in heavy]) * 1e6
    )
    drawing = figure(
        axis_title("particle_diameter", "um"),
        axis_title("density_difference", "kg/m^3", _("density difference")),
        x_log=True,
        y_log=True,
        title=_("Geldart's groups"),
    )
    for column, name in enumerate(("C–A", "A–B", "B–D")):
        add_line(drawing, borders[:, column], heavy, name, color=SOLID)
    for x, name in ((8.0, "C"), (50.0, "A"), (250.0, "B"), (2500.0, "D")):
        add_label(drawing, x, 2000.0, f"<b>{name}</b>", color=INK)
    add_points(
        drawing,
        [particle_diameter * 1e6],
        [particle_density - fluid_density],
        _("operating point"),
        color=OUT,
    )
    drawing.update_xaxes(range=[0.5, 4.0])
    return drawing


@chart(
    source="grace1986; bi1995; wen1966",
    title="Grace's map of regimes",
    typical={"superficial_velocity": (0.05, 3.0)},
)
def grace_chart(
    superficial_velocity: Speed,
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
) -> Any:
    """Grace's map with minimum fluidization, onset of turbulence and of entrainment, terminal velocity, and
    the operating point.
    """
    from granum.core.charts import CAUTION, INK, LIQUID, OUT, SOLID, add_line, add_points, axis_title, figure

    size = np.geomspace(0.7, 200.0, 80)
    Ar = size**3
    still = np.sqrt(33.7**2 + 0.0408 * Ar) - 33.7
    fall = np.asarray(terminal_velocity(size * (1e-10 / 9.80665) ** (1.0 / 3.0), 2.0, 1.0, 1e-5)) / (
        1e-5 * 9.80665
    ) ** (1.0 / 3.0)
    drawing = figure(
        axis_title("dimensionless_diameter"),
        axis_title("dimensionless_velocity"),
        x_log=True,
        y_log=True,
        title=_("Grace's map of regimes"),
    )
    add_line(drawing, size, still / size, _("minimum fluidization"), color=LIQUID)
    add_line(drawing, size, 1.24 * Ar**0.45 / size, _("turbulent bed"), color=CAUTION)
    add_line(drawing, size, 1.53 * Ar**0.5 / size, _("fast fluidization or transport"), color=SOLID)
    add_line(drawing, size, fall, _("terminal velocity"), color=INK, dash="dash")
    at = grace_coordinates(
        superficial_velocity, particle_diameter, particle_density, fluid_density, dynamic_viscosity
    )
    regime = fluidization_regime(
        superficial_velocity, particle_diameter, particle_density, fluid_density, dynamic_viscosity, 10.0
    ).regime
    add_points(drawing, [at.dimensionless_diameter], [at.dimensionless_velocity], regime, color=OUT)
    return drawing
