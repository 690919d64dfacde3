"""Sorption isotherms of several products on one chart, and what spoils a food at which water activity."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np

from granum.core import chart
from granum.core.charts import (
    ACCENT,
    GAS,
    INK,
    LINES,
    LIQUID,
    OK,
    OUT,
    add_band,
    add_label,
    add_line,
    add_right_axis,
    axis_title,
    figure,
)
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Law, MoistureDryBasis, Temperature, WaterActivity
from granum.drying.formulas.moisture import POTATO, IsothermLaw
from granum.drying.formulas.moisture import water_activity as activity_of
from granum.drying.formulas.storage import LIMITS

Another = Annotated[Any, Law("isotherm")]
ACTIVITY = np.linspace(0.02, 0.95, 187)
FAT, BROWNING = (0.25, 0.35), (0.5, 0.8)  # where fat oxidizes slowest and browning is fastest


def _named(isotherm: Any) -> str:
    return _(type(isotherm).card.title)


def _moisture(isotherm: Any, temperature: Any) -> Any:
    return np.asarray(isotherm(ACTIVITY, temperature), dtype=float) + 0.0 * ACTIVITY


@chart(
    source="keey1978; bonazzi2003",
    title="Sorption isotherms side by side, with their zones",
    typical={"temperature": (283.15, 313.15)},
)
def isotherms_chart(
    isotherm: IsothermLaw = POTATO,
    isotherm_second: Another = None,
    isotherm_third: Another = None,
    temperature: Temperature = 298.15,
    temperature_second: Temperature | None = None,
    isotherm_adsorption: Another = None,
    zone_bound: WaterActivity = 0.2,
    zone_multilayer: WaterActivity = 0.6,
) -> Any:
    """Moisture against water activity of up to three products, the first at a second temperature too and
    with the loop between drying and wetting, over the zones of bound, multilayer and capillary water.

    ``isotherm_adsorption`` is that of the first product as it takes up water. Zones end at 0.2 and 0.6 in the
    notes on thermal drying, at 0.3 and 0.7 in those on unit operations.

    >>> drawing = isotherms_chart("maize", isotherm_second="wheat")
    >>> [trace.name for trace in drawing.data if trace.showlegend is not False]
    ['Isotherm of shelled maize', 'Isotherm of wheat']
    """
    if not zone_multilayer > zone_bound:
        raise InputError(_("The zones follow one another: the second must end above the first."))
    drawing = figure(
        axis_title("water_activity"),
        axis_title("moisture_dry_basis", "kg/kg"),
        title=_("Sorption isotherms"),
    )
    first = _moisture(isotherm, temperature)
    curves = [(_named(isotherm), first)]
    if isotherm_adsorption is not None:
        wetted = _moisture(isotherm_adsorption, temperature)
        add_band(
            drawing,
            ACTIVITY,
            np.minimum(first, wetted),
            np.maximum(first, wetted),
            _("hysteresis"),
            color=GAS,
        )
        curves.append((_("{name}, wetted").format(name=_named(isotherm_adsorption)), wetted))
    if temperature_second is not None:
        curves.append(
            (
                _("{name}, at the other temperature").format(name=_named(isotherm)),
                _moisture(isotherm, temperature_second),
            )
        )
    for other in (isotherm_second, isotherm_third):
        if other is not None:
            curves.append((_named(other), _moisture(other, temperature)))
    for (name, moisture), color in zip(curves, LINES * len(curves), strict=False):
        add_line(drawing, ACTIVITY, moisture, name, color=color, width=3)
    top = float(max(np.nanmax(moisture) for _name, moisture in curves))
    for edge in (zone_bound, zone_multilayer):
        add_line(
            drawing, [edge, edge], [0.0, top], _("zone"), color=INK, dash="dot", width=1, showlegend=False
        )
    middles = (0.5 * zone_bound, 0.5 * (zone_bound + zone_multilayer), 0.5 * (zone_multilayer + 1.0))
    for at, words in zip(middles, (_("bound water"), _("multilayer"), _("capillary water")), strict=True):
        add_label(drawing, float(at), top, words)
    drawing.update_xaxes(range=[0, 1])
    return drawing


@chart(
    source="beuchat1981; labuza1970",
    title="What spoils a food, by its water activity",
    typical={"temperature": (283.15, 313.15), "moisture_dry_basis": (0.02, 0.3)},
)
def stability_chart(
    isotherm: IsothermLaw = POTATO,
    temperature: Temperature = 298.15,
    moisture_dry_basis: MoistureDryBasis | None = None,
) -> Any:
    """Isotherm of a food over what goes on at each water activity: growth of microorganisms from their limits
    on, browning where it is fastest, oxidation of fat where it is slowest.

    Limits of growth are those of ``drying.water_activity_margin``. That fat keeps best near 0.3 was read in a
    text on the stability of foods; the range of browning is recalled. A moisture is marked with the water
    activity that it has.

    >>> drawing = stability_chart("maize", moisture_dry_basis=0.16)
    >>> len(drawing.data) >= 8
    True
    """
    drawing = figure(
        axis_title("water_activity"),
        axis_title("moisture_dry_basis", "kg/kg"),
        title=_("Stability of a food"),
    )
    curve = _moisture(isotherm, temperature)
    add_line(drawing, ACTIVITY, curve, _named(isotherm), color=LIQUID, width=3)
    rows = [(_(name), limit, 1.0, OUT) for name, limit in LIMITS.items()]
    rows += [(_("browning, fastest"), *BROWNING, ACCENT), (_("oxidation of fat, slowest"), *FAT, OK)]
    for level, (name, low, high, color) in enumerate(rows, start=1):
        add_line(
            drawing, [low, high], [level, level], name, color=color, width=6, yaxis="y2", showlegend=False
        )
    add_right_axis(
        drawing,
        "",
        range=[0, len(rows) + 1],
        tickmode="array",
        tickvals=list(range(1, len(rows) + 1)),
        ticktext=[name for name, *_rest in rows],
    )
    if moisture_dry_basis is not None:
        at = float(activity_of(moisture_dry_basis, isotherm, temperature))
        add_line(
            drawing,
            [at, at],
            [0.0, float(np.nanmax(curve))],
            _("this moisture"),
            color=INK,
            dash="dash",
        )
    drawing.update_xaxes(range=[0, 1])
    drawing.update_layout(margin={"r": 200, "t": 60}, legend={"orientation": "h", "y": -0.25})
    return drawing
