"""Charts of filtration: the best cycle, the profiles through a compressible cake, washing."""

from __future__ import annotations

from typing import Any

import numpy as np

from granum.core import chart
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    CakeResistance,
    Concentration,
    DynamicViscosity,
    MediumResistance,
    PositiveNumber,
    PressureDrop,
    Ratio,
    Time,
    VoidFraction,
    Volume,
    kind_of,
)
from granum.filtration.formulas.compressible import cake_profile
from granum.filtration.formulas.constant_pressure import filtrate_volume_constant_pressure
from granum.filtration.formulas.cycle import filtration_cycle
from granum.filtration.formulas.washing import solute_remaining_dispersion, wash_effluent_concentration


@chart(source="carman1938", title="Best moment to stop a batch filter")
def filtration_cycle_chart(
    area: Area,
    pressure_drop: PressureDrop,
    dynamic_viscosity: DynamicViscosity,
    cake_resistance: CakeResistance,
    dry_cake_per_filtrate: Concentration,
    dead_time: Time,
    medium_resistance: MediumResistance = 0.0,
) -> Any:
    """Filtrate against time from the start of the dead time, with the tangent that gives the most filtrate
    per time.
    """
    from granum.core.charts import CAUTION, LIQUID, add_label, add_line, add_points, axis_title, figure
    from granum.core.units import best_unit, format_number, from_si

    case = (area, pressure_drop, dynamic_viscosity, cake_resistance, dry_cake_per_filtrate)
    best = filtration_cycle(*case, dead_time, medium_resistance)
    time, volume = kind_of(Time), kind_of(Volume)
    assert time is not None
    assert volume is not None
    t_unit, v_unit = best_unit(best.cycle_time, time), best_unit(best.filtrate_volume, volume)
    t = np.linspace(0.0, 2.5 * best.filtration_time, 200)
    V = np.asarray(filtrate_volume_constant_pressure(t, *case, medium_resistance))
    drawing = figure(
        axis_title("cycle_time", t_unit),
        axis_title("filtrate_volume", v_unit),
        title=_("Best moment to stop a batch filter"),
    )
    clock = np.concatenate([[0.0], dead_time + t])
    add_line(
        drawing,
        from_si(clock, t_unit, time),
        from_si(np.concatenate([[0.0], V]), v_unit, volume),
        _("filtrate"),
        color=LIQUID,
    )
    reach = np.array([0.0, 1.15 * best.cycle_time])
    add_line(
        drawing,
        from_si(reach, t_unit, time),
        from_si(reach * best.mean_filtrate_flow, v_unit, volume),
        _("tangent"),
        color=CAUTION,
        dash="dash",
    )
    top = (
        float(from_si(best.cycle_time, t_unit, time)),
        float(from_si(best.filtrate_volume, v_unit, volume)),
    )
    add_points(drawing, [top[0]], [top[1]], _("optimum"), color=CAUTION)
    flow = format_number(3600.0 * best.mean_filtrate_flow)
    add_label(
        drawing,
        *top,
        f"V = {format_number(top[1])} {v_unit.replace('^3', '³')}, {flow} m³/h",
        color=CAUTION,
        yshift=-16,
        xanchor="left",
    )
    return drawing


@chart(source="tiller1987", title="Pressures and void fraction through a cake")
def cake_profile_chart(
    pressure_drop: PressureDrop,
    cake_resistance_unloaded: CakeResistance,
    void_fraction_unloaded: VoidFraction,
    compressibility: Ratio,
    compaction_exponent: Ratio,
    characteristic_pressure: PressureDrop,
) -> Any:
    """Liquid pressure, pressure on the solid and void fraction against height above the medium."""
    from granum.core.charts import INK, LIQUID, SOLID, add_line, add_right_axis, axis_title, figure

    z = np.linspace(0.0, 1.0, 101)
    found = cake_profile(
        z,
        pressure_drop,
        cake_resistance_unloaded,
        void_fraction_unloaded,
        compressibility,
        compaction_exponent,
        characteristic_pressure,
    )
    drawing = figure(
        axis_title("relative_height"),
        _("pressure") + " / bar",
        title=_("Pressures and void fraction through a cake"),
    )
    add_line(drawing, z, np.asarray(found.liquid_pressure) / 1e5, _("liquid <i>p</i>"), color=LIQUID)
    add_line(
        drawing, z, np.asarray(found.solids_pressure) / 1e5, _("solid <i>p<sub>g</sub></i>"), color=SOLID
    )
    add_line(
        drawing,
        z,
        np.asarray(found.void_fraction_local),
        axis_title("void_fraction"),
        color=INK,
        dash="dot",
        yaxis="y2",
    )
    add_right_axis(drawing, axis_title("void_fraction"), tickformat=".3f", nticks=7)
    drawing.update_layout(
        legend={"orientation": "h", "y": 1.02, "yanchor": "bottom", "x": 0.0},
        margin={"r": 80, "t": 80},
    )
    return drawing


@chart(source="sherman1964", title="Washing of a cake")
def washing_chart(dispersion_number: PositiveNumber) -> Any:
    """Concentration of the effluent and solute left in the cake against the wash ratio, with plug
    displacement for comparison.
    """
    from granum.core.charts import GAS, LIQUID, SOLID, add_line, axis_title, figure

    w = np.linspace(0.0, 4.0, 201)
    drawing = figure(axis_title("wash_ratio"), _("share of the mother liquor"), title=_("Washing of a cake"))
    add_line(drawing, w, np.maximum(1.0 - w, 0.0), _("plug displacement"), color=GAS, dash="dash")
    add_line(
        drawing, w, np.asarray(wash_effluent_concentration(w, dispersion_number)), _("effluent"), color=LIQUID
    )
    add_line(
        drawing,
        w,
        np.asarray(solute_remaining_dispersion(w, dispersion_number)),
        _("left in the cake"),
        color=SOLID,
    )
    return drawing
