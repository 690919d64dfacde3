"""Charts of solutions: what an antisolvent takes from one, solubility curves of several solutes."""

from __future__ import annotations

from typing import Any

import numpy as np

from granum.core import chart
from granum.core.charts import ACCENT, LIQUID, SOLID, add_line, axis_title, figure
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import MassRatio, Temperature
from granum.crystallization.kinds import OpenShare, Solubility


@chart(
    source="yalkowsky1981; mullin2001, ch. 8",
    title="Drowning out: solubility, dilution and yield",
    typical={"solute_per_solvent": (0.3, 0.36), "temperature": (290.0, 300.0)},
)
def antisolvent_chart(
    solubility: Solubility,
    solute_per_solvent: MassRatio,
    temperature: Temperature,
    antisolvent_fraction: OpenShare = 0.8,
) -> Any:
    """Solubility against the share of antisolvent, the solution as it is diluted, and the yield between them.

    Crystals form to the right of the crossing; the highest point of the yield is as much antisolvent as pays.

    >>> drawing = antisolvent_chart(
    ...     solubility={
    ...         "law": "antisolvent_solubility",
    ...         "pure_solubility": {"law": "library_solubility", "solute": "sodium chloride"},
    ...         "antisolvent_power": 2.0,
    ...         "antisolvent_curvature": 1.6,
    ...     },
    ...     solute_per_solvent=0.35,
    ...     temperature="25 degC",
    ... )
    >>> [trace.name for trace in drawing.data]
    ['solubility', 'diluted solution', 'yield']
    """
    if not getattr(solubility, "takes_antisolvent", False):
        raise InputError(
            _(
                "The solubility does not depend on an antisolvent: give a law that does, such as "
                "'antisolvent_solubility'."
            ),
            name="solubility",
        )
    w = np.linspace(0.0, float(antisolvent_fraction), 161)
    saturated = np.asarray(solubility(temperature, w)) + np.zeros_like(w)
    diluted = float(solute_per_solvent) * (1.0 - w)
    share = np.clip(1.0 - saturated / np.maximum(diluted, 1e-300), 0.0, None)
    drawing = figure(
        axis_title("antisolvent_fraction", "percent"),
        axis_title("solute_per_solvent", "kg/kg"),
        title=_("Drowning out"),
    )
    add_line(drawing, 100.0 * w, saturated, _("solubility"), color=LIQUID, width=3)
    add_line(drawing, 100.0 * w, diluted, _("diluted solution"), color=ACCENT, dash="dash")
    add_line(drawing, 100.0 * w, 100.0 * share, _("yield"), color=SOLID, yaxis="y2")
    drawing.update_layout(
        yaxis2={
            "overlaying": "y",
            "side": "right",
            "title": axis_title("yield_fraction", "percent"),
            "showgrid": False,
            "range": [0, 100],
        },
        margin={"r": 70, "t": 80},
        legend={"orientation": "h", "y": 1.08},
    )
    return drawing
