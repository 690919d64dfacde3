"""Charts of two enantiomers: how they dissolve, and how seeding with one parts them."""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp
import numpy as np
import plotly.graph_objects as go

from granum.core import chart
from granum.core.charts import (
    ACCENT,
    HEAT,
    LINES,
    LIQUID,
    OUT,
    SOLID,
    add_line,
    add_right_axis,
    axis_title,
    figure,
)
from granum.core.i18n import _
from granum.core.kinds import Density, Distance, Length, MassRatio, Ratio, Series, Temperature, Time
from granum.crystallization.charts_triangle import add_on_triangle, celsius, lay_out_triangle
from granum.crystallization.formulas.enantiomers import solubility_per_solvent_enantiomer
from granum.crystallization.formulas.nucleation import NoNucleation
from granum.crystallization.kinds import Growth, Nucleation, Program, RacemateSolubilityRatio, Solubility
from granum.crystallization.vessels.enantiomers import preferential_crystallization

POINTS = 60


def _line(alone: float, ratio: float, others: Any) -> tuple[np.ndarray, np.ndarray]:
    """Mass fractions along the solubility of one enantiomer beside so much of the other, kg/kg solvent."""
    one = np.asarray(solubility_per_solvent_enantiomer(alone, jnp.asarray(others), ratio))
    whole = 1.0 + one + others
    return one / whole, others / whole


@chart(
    source="jacques1981, ch. 3 and 4; meyerhoffer1904",
    title="Two enantiomers in a solvent: triangle",
    typical={"isotherm_temperatures": (293.15, 323.15)},
)
def enantiomers_chart(
    solubility: Solubility,
    isotherm_temperatures: Annotated[Temperature, Series("isotherms")],
    racemate_solubility_ratio: RacemateSolubilityRatio = 2.0,
) -> Any:
    """Solubility of both enantiomers of a conglomerate at several temperatures, on a triangle by mass, and
    what seeding uses: the solubility of one goes on, dashed, beyond the racemate.

    Cooled from the highest temperature to the lowest, the racemic liquor is supersaturated in both. Seeded
    with one it moves straight away from that one's corner, until it meets the dashed line of the coldest
    solution, as long as the other is not born.

    >>> drawing = enantiomers_chart(
    ...     solubility={"law": "library_solubility", "solute": "L-threonine"},
    ...     isotherm_temperatures=["33 degC", "40 degC"],
    ... )
    >>> [trace.name for trace in drawing.data if trace.showlegend]
    ['33 °C', '40 °C', 'seeded with the first']
    """
    temperatures = np.sort(np.atleast_1d(np.asarray(isotherm_temperatures, dtype=float)))
    alpha = float(racemate_solubility_ratio)
    drawing = go.Figure()
    single = [float(solubility(T)) for T in temperatures]
    for T, alone, color in zip(temperatures, single, LINES * 10, strict=False):
        racemic = 0.5 * alpha * alone
        one, other = _line(alone, alpha, np.linspace(0.0, racemic, POINTS))
        line = {"color": color, "width": 2}
        first, second = np.append(one, other[::-1]), np.append(other, one[::-1])
        add_on_triangle(drawing, first, second, celsius(T), line=line, mode="lines")
        one, other = _line(alone, alpha, np.linspace(racemic, 1.6 * racemic, POINTS))
        word = _("beyond the racemate, {where}").format(where=celsius(T))
        first, second = np.append(one, [np.nan, *other]), np.append(other, [np.nan, *one])
        thin = line | {"width": 1, "dash": "dash"}
        add_on_triangle(drawing, first, second, word, mode="lines", line=thin, showlegend=False)
    start, coldest = 0.5 * alpha * single[-1], single[0]
    end = float(solubility_per_solvent_enantiomer(coldest, start, alpha))
    if end < start:
        ratios = np.linspace(start, end, POINTS)
        whole = 1.0 + start + ratios
        path = {"color": HEAT, "width": 3}
        word = _("seeded with the first")
        add_on_triangle(drawing, ratios / whole, start / whole, word, mode="lines", line=path)
    corners = (_("solvent"), _("first enantiomer"), _("second enantiomer"))
    least = 100.0 / (1.0 + 2.2 * alpha * max(single))
    lay_out_triangle(drawing, _("Two enantiomers, mass percent"), corners, least)
    return drawing


@chart(source="elsner2005; angelov2008", title="Preferential crystallization over time")
def resolution_chart(
    solute_per_solvent: MassRatio,
    solute_per_solvent_other: MassRatio,
    solubility: Solubility,
    growth: Growth,
    temperature_program: Program,
    duration: Time,
    crystal_density: Density,
    nucleation: Nucleation = NoNucleation(),
    counter_nucleation: Ratio = 0.0,
    racemate_solubility_ratio: RacemateSolubilityRatio = 2.0,
    seed_mass_per_solvent: MassRatio = 0.0,
    seed_size: Length = 100e-6,
    seed_width: Distance = 0.0,
) -> Any:
    """Both enantiomers in the liquor over time with their solubility, and the purity of the crystals.

    >>> drawing = resolution_chart(
    ...     solute_per_solvent=0.125,
    ...     solute_per_solvent_other=0.125,
    ...     solubility={"law": "polynomial_solubility", "coefficients": [0.11]},
    ...     growth={"law": "power_law_growth", "growth_coefficient": 3e-7, "growth_order": 1.0},
    ...     temperature_program={
    ...         "law": "power_cooling",
    ...         "temperature_start": 306.15,
    ...         "temperature_end": 306.15,
    ...         "duration": 3600,
    ...     },
    ...     duration="4 hour",
    ...     crystal_density=1461,
    ...     seed_mass_per_solvent="3 g/kg",
    ... )
    >>> len(drawing.data)
    4
    """
    out = preferential_crystallization(
        solute_per_solvent,
        solute_per_solvent_other,
        solubility,
        growth,
        temperature_program,
        duration,
        crystal_density,
        nucleation=nucleation,
        counter_nucleation=counter_nucleation,
        racemate_solubility_ratio=racemate_solubility_ratio,
        seed_mass_per_solvent=seed_mass_per_solvent,
        seed_size=seed_size,
        seed_width=seed_width,
    )
    t = np.asarray(out.time) / 3600.0
    drawing = figure(
        axis_title("time", "hour"), axis_title("solute_per_solvent", "kg/kg"), title=_("Seeded with one")
    )
    for values, word, color, dash in (
        (out.solute_per_solvent, _("wanted enantiomer dissolved"), ACCENT, "solid"),
        (out.solute_per_solvent_other, _("other enantiomer dissolved"), LIQUID, "solid"),
        (out.solubility_per_solvent, _("solubility of the wanted one"), OUT, "dash"),
    ):
        add_line(drawing, t, np.asarray(values), word, color=color, dash=dash)
    share = 100.0 * np.asarray(out.enantiomer_fraction)
    add_line(drawing, t, share, _("purity of the crystals"), color=SOLID, yaxis="y2")
    low = min(49.0, float(share.min()))
    add_right_axis(drawing, axis_title("enantiomer_fraction", "percent"), range=[low, 101])
    drawing.update_layout(
        margin={"r": 70, "t": 80},
        legend={"orientation": "h", "y": 1.08},
    )
    return drawing
