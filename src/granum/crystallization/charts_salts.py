"""Charts of two salts in one solvent."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
import plotly.graph_objects as go

from granum.core import chart
from granum.core.charts import HEAT, LINES, OUT
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import MassFraction, Series, Temperature
from granum.core.units import format_number
from granum.crystallization.charts_triangle import add_on_triangle, celsius, lay_out_triangle
from granum.crystallization.vessels.common_ion import Isotherm, crystallization_path, isotherm
from granum.materials.common_ion import COLDEST, HOTTEST, common_ion

TIES = 4  # tie lines of each branch
SALTIEST = 0.95  # of a liquor; more is a moist salt


@chart(
    source="greenberg1989; mullin2001, ch. 4",
    title="Two salts in water: triangle",
    typical={
        "isotherm_temperatures": (273.15, 373.15),
        "solute_mass_fraction_first": (0.05, 0.2),
        "solute_mass_fraction_second": (0.05, 0.14),
    },
)
def two_salts_chart(
    isotherm_temperatures: Annotated[Temperature, Series("isotherms")],
    first_salt: str = "sodium chloride",
    second_salt: str = "potassium chloride",
    solute_mass_fraction_first: MassFraction = 0.0,
    solute_mass_fraction_second: MassFraction = 0.0,
) -> Any:
    """Saturation lines of two salts with a common ion, their tie lines and invariant points at several
    temperatures, and the path of a liquor that is boiled and cooled, on a triangle by mass.

    Above a line the solution is unsaturated. Below it one salt crystallizes along a straight line from its
    corner, the tie line; between those from an invariant point to both corners both do. The path of the given
    liquor leads from the corner of the water, at the highest temperature, to where both salts are saturated,
    and from there, the crystals being taken off, to the lowest temperature.

    >>> drawing = two_salts_chart(
    ...     isotherm_temperatures=[298.15, 373.15],
    ...     solute_mass_fraction_first="12 %",
    ...     solute_mass_fraction_second="8 %",
    ... )
    >>> [trace.name for trace in drawing.data if trace.showlegend]
    ['25 °C', '100 °C', 'boiled at 100 °C', 'cooled to 25 °C']
    """
    one, other = float(solute_mass_fraction_first), float(solute_mass_fraction_second)
    if one + other > SALTIEST:
        raise InputError(
            _("Both salts together must leave water: {value} % of {most} % at most.").format(
                value=format_number(100.0 * (one + other), 4), most=format_number(100.0 * SALTIEST, 3)
            ),
            name="solute_mass_fraction_second",
        )
    temperatures = np.atleast_1d(np.asarray(isotherm_temperatures, dtype=float))
    for T in temperatures:
        if not COLDEST <= T <= HOTTEST:
            raise InputError(
                _("Both salts are known from {low} to {high}, not at {where}.").format(
                    low=celsius(COLDEST), high=celsius(HOTTEST), where=celsius(T)
                ),
                name="isotherm_temperatures",
            )
    pair = common_ion(first_salt, second_salt)
    names = [system.branch().crystal.label for system in (pair.first, pair.second)]
    drawing = go.Figure()
    for T, color in zip(temperatures, LINES * 10, strict=False):
        found = isotherm(pair, float(T))
        x, y = np.asarray(found.first), np.asarray(found.second)
        word = celsius(T)
        line = {"color": color, "width": 2}
        add_on_triangle(drawing, x, y, word, line=line, mode="lines")
        here = slice(found.corner, found.corner + 1)
        both = _("both saturated, {where}").format(where=word)
        mark = {"color": color, "size": 9, "line": {"color": OUT, "width": 1}}
        add_on_triangle(drawing, x[here], y[here], both, mode="markers", marker=mark, showlegend=False)
        tied = _("tie lines, {where}").format(where=word)
        thin = line | {"width": 1, "dash": "dot"}
        add_on_triangle(
            drawing, *_ties(found), tied, mode="lines", line=thin, showlegend=False, hoverinfo="skip"
        )
    if one + other > 0.0:
        hot, cold = float(temperatures.max()), float(temperatures.min())
        path = crystallization_path(pair, one, other, hot, cold)
        ways = {_("boiled at {where}").format(where=celsius(hot)): (slice(0, path.boiled + 1), "solid")}
        if cold < hot:
            ways[_("cooled to {where}").format(where=celsius(cold))] = (slice(path.boiled, None), "dash")
        for word, (part, dash) in ways.items():
            line = {"color": HEAT, "width": 3, "dash": dash}
            add_on_triangle(drawing, path.first[part], path.second[part], word, mode="lines", line=line)
    corners = (_("water"), names[0], names[1])
    lay_out_triangle(drawing, _("Two salts in water, mass percent"), corners, 50.0)
    return drawing


def _ties(found: Isotherm) -> tuple[np.ndarray, np.ndarray]:
    """Straight lines from saturated solutions to the corners of their crystals, with gaps between them."""
    last = len(found.first) - 1
    ends = [(i, (1.0, 0.0)) for i in np.linspace(0, found.corner, TIES).astype(int)]
    ends += [(i, (0.0, 1.0)) for i in np.linspace(found.corner, last, TIES).astype(int)]
    x = [(found.first[i], corner[0], np.nan) for i, corner in ends]
    y = [(found.second[i], corner[1], np.nan) for i, corner in ends]
    return np.ravel(x), np.ravel(y)
