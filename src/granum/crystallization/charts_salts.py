"""Charts of two salts in one solvent."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Any

import jax.numpy as jnp
import numpy as np
import plotly.graph_objects as go

from granum.core import chart
from granum.core.charts import HEAT, LINES, OUT
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Fraction, MassFraction, Series, Temperature
from granum.core.units import format_number
from granum.crystallization.charts_triangle import add_on_triangle, celsius, lay_out_triangle
from granum.crystallization.vessels.common_ion import (
    Isotherm,
    crystallization_path,
    diagram,
    four_of,
    ion_shares,
    isotherm,
    liquors,
    pair_of,
)
from granum.materials.activities import SLACK
from granum.materials.brines import Brine
from granum.materials.formulas.activity import WATER
from granum.materials.library import session

TIES = 4  # tie lines of each branch
DRIED, DRYING = 120.0, 30  # mol of charge per kg of water at the end of a path, and its points
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
    corner, or a double salt from its place on the side, the tie line; between those from an invariant point
    to both crystals both do. The path of the given
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
    pair = pair_of(first_salt, second_salt)
    for T in temperatures:
        _within(pair, T, "isotherm_temperatures")
    names = [session().label(system.name) for system in pair.salts]
    drawing = go.Figure()
    for T, color in zip(temperatures, LINES * 10, strict=False):
        found = isotherm(pair, float(T))
        x, y = np.asarray(found.first), np.asarray(found.second)
        word = celsius(T)
        line = {"color": color, "width": 2}
        add_on_triangle(drawing, x, y, word, line=line, mode="lines")
        here = list(found.corners)
        both = _("both saturated, {where}").format(where=word)
        mark = {"color": color, "size": 9, "line": {"color": OUT, "width": 1}}
        add_on_triangle(drawing, x[here], y[here], both, mode="markers", marker=mark, showlegend=False)
        tied = _("tie lines, {where}").format(where=word)
        thin = line | {"width": 1, "dash": "dot"}
        add_on_triangle(
            drawing, *_ties(pair, found), tied, mode="lines", line=thin, showlegend=False, hoverinfo="skip"
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


def _within(salts: Brine, T: float, name: str) -> None:
    low, high = salts.limits
    if not low - SLACK <= T <= high + SLACK:
        raise InputError(
            _("The salts are known beside each other from {low} to {high}, not at {where}.").format(
                low=celsius(low), high=celsius(high), where=celsius(T)
            ),
            name=name,
        )


def _ties(pair: Brine, found: Isotherm) -> tuple[np.ndarray, np.ndarray]:
    """Straight lines from saturated solutions to their crystals, with gaps between them."""
    x, y = [], []
    for start, end in pairwise((0, *found.corners, len(found.first) - 1)):
        form = pair.crystals[found.crystals[(start + end + 1) // 2]]
        salts = form.salts * pair.molar_masses
        whole = np.sum(salts) + WATER * form.water
        for i in np.linspace(start, end, TIES).astype(int):
            x += [found.first[i], salts[0] / whole, np.nan]
            y += [found.second[i], salts[1] / whole, np.nan]
    return np.array(x), np.array(y)


@chart(
    source="pitzer1974mixed; mullin2001, ch. 4",
    title="Reciprocal pair of salts: Jänecke's square",
    typical={"temperature": (288.15, 308.15), "cation_share": (0.2, 0.8), "anion_share": (0.2, 0.8)},
)
def reciprocal_chart(
    temperature: Temperature,
    first_salt: str = "sodium nitrate",
    second_salt: str = "potassium chloride",
    cation_share: Fraction | None = None,
    anion_share: Fraction | None = None,
) -> Any:
    """Fields in which each of four salts crystallizes first, with the water of the saturated solutions, over
    the shares of the ions by charge; and the path of a solution that loses water.

    A solution moves straight away from the corner of the crystal that forms, to the border of its field and
    along that to where three salts are saturated. Of the two diagonals that pair is stable together which no
    other field cuts: the other two salts convert into it. Double salts have fields of their own.

    >>> drawing = reciprocal_chart(temperature="25 degC", cation_share=0.5, anion_share=0.5)
    >>> [trace.name for trace in drawing.data if trace.showlegend][-1]
    'as water is taken off'
    """
    T = float(temperature)
    salts = four_of(first_salt, second_salt)
    _within(salts, T, "temperature")
    found = diagram(salts, T)
    drawing = go.Figure()
    shares = 100.0 * found.shares
    there = [k for k in range(len(salts.crystals)) if np.any(found.crystal == k)]
    for k, color in zip(there, LINES * 10, strict=False):
        drawing.add_heatmap(
            x=shares,
            y=shares,
            z=np.where(found.crystal == k, 1.0, np.nan),
            colorscale=[[0.0, color], [1.0, color]],
            opacity=0.35,
            name=salts.crystals[k].solid.label,
            showlegend=True,
            showscale=False,
            hoverinfo="skip",
        )
    drawing.add_contour(
        x=shares,
        y=shares,
        z=found.water,
        contours={"coloring": "none", "showlabels": True},
        line={"color": OUT, "width": 1},
        name=_("water, kg/kg of salts"),
        showscale=False,
        showlegend=True,
    )
    if len(found.invariant):
        drawing.add_scatter(
            x=100.0 * found.invariant[:, 0],
            y=100.0 * found.invariant[:, 1],
            mode="markers",
            marker={"color": OUT, "size": 11, "symbol": "diamond"},
            name=_("three salts saturated"),
            showlegend=True,
        )
    if cation_share is not None and anion_share is not None:
        x, y = _dried(salts, T, float(cation_share), float(anion_share))
        line = {"color": HEAT, "width": 3}
        name = _("as water is taken off")
        drawing.add_scatter(
            x=100.0 * x, y=100.0 * y, mode="lines+markers", line=line, name=name, showlegend=True
        )
    cations, anions = salts.ions[:2], salts.ions[2:]
    drawing.update_xaxes(
        title=_("{ion} among the cations, % by charge").format(ion=cations[1]), range=[0, 100]
    )
    drawing.update_yaxes(title=_("{ion} among the anions, % by charge").format(ion=anions[1]), range=[0, 100])
    return drawing


def _dried(salts: Brine, T: float, cation: float, anion: float) -> tuple[np.ndarray, np.ndarray]:
    """Shares of the ions in a solution from where it is thin to where nearly all has crystallized."""
    (a, b), (c, d) = salts.charges
    ions = np.array([(1.0 - cation) / a, cation / b, (1.0 - anion) / c, anion / d])
    amounts = np.geomspace(0.5, DRIED, DRYING)[:, None] * ions
    return tuple(ion_shares(salts, liquors(salts, jnp.full(DRYING, T), jnp.asarray(amounts))).T)
