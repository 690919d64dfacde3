"""Charts of crystallization from the melt: zone refining, a layer on a wall."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np

from granum.core import chart
from granum.core.charts import ACCENT, GAS, HEAT, LIQUID, OUT, SOLID, add_line, axis_title, figure
from granum.core.i18n import _
from granum.core.kinds import Within
from granum.crystallization.formulas.melt import (
    BarLength,
    impurity_ratio_zone_ultimate,
    segregation_freezing,
)
from granum.crystallization.kinds import DistributionCoefficient
from granum.crystallization.vessels.zone_melting import profiles


@chart(
    source="pfann1952; pfann1966, ch. 3",
    title="Zone refining: impurity along the bar",
    typical={"distribution_coefficient": (0.1, 0.5), "bar_length_in_zones": (5.0, 10.0)},
)
def zone_refining_chart(
    distribution_coefficient: Annotated[DistributionCoefficient, Within(1e-6, 0.9999)],
    bar_length_in_zones: BarLength = 10.0,
    passes: Annotated[int, Within(1, 100)] = 20,
) -> Any:
    """Impurity along a bar over that at the start after one pass and more, and what very many passes lead to.

    >>> len(zone_refining_chart(distribution_coefficient=0.5).data)
    6
    """
    k, zones = float(distribution_coefficient), float(bar_length_in_zones)
    counts = sorted({1, max(1, passes // 10), max(1, passes // 4), max(1, passes // 2), passes})
    drawing = figure(
        axis_title("bar_position", "percent"),
        axis_title("impurity_ratio", ""),
        title=_("Zone refining"),
        y_log=True,
    )
    lowest = 1.0
    for (count, bar), color in zip(
        profiles(k, zones, counts).items(), (GAS, LIQUID, ACCENT, SOLID, HEAT), strict=False
    ):
        across = 100.0 * (np.arange(len(bar)) + 0.5) / len(bar)
        lowest = min(lowest, float(bar.min()))
        add_line(drawing, across, bar, _("{count} passes").format(count=count), color=color)
    across = np.linspace(0.0, zones - 1.0, 80)
    end = np.asarray(impurity_ratio_zone_ultimate(k, across, zones))
    add_line(drawing, 100.0 * across / zones, end, _("very many passes"), color=OUT, dash="dash")
    drawing.update_yaxes(range=[np.log10(max(lowest, 1e-16)) - 1.0, 1.5])
    return drawing


@chart(
    source="pfann1952; jansens2000",
    title="Layer from a melt: purity against what is frozen",
    typical={"distribution_coefficient": (0.05, 0.3)},
)
def layer_purity_chart(distribution_coefficient: DistributionCoefficient) -> Any:
    """Impurity of the front, of the whole layer and of the melt that is left, over that of the feed.

    >>> len(layer_purity_chart(distribution_coefficient=0.1).data)
    3
    """
    g = np.linspace(0.0, 0.98, 150)
    front, layer, melt = (np.asarray(x) for x in segregation_freezing(distribution_coefficient, g))
    drawing = figure(
        axis_title("frozen_fraction", "percent"),
        axis_title("impurity_ratio", ""),
        title=_("Layer from a melt"),
        y_log=True,
    )
    for values, word, color in (
        (layer, _("layer"), SOLID),
        (front, _("where the layer ends"), ACCENT),
        (melt, _("melt"), LIQUID),
    ):
        add_line(drawing, 100.0 * g, values, word, color=color)
    return drawing
