"""Chart of a weak acid or base: what dissolves against pH."""

from __future__ import annotations

from typing import Any

import numpy as np

from granum.core import chart
from granum.core.charts import ACCENT, LIQUID, OUT, SOLID, add_line, axis_title, figure
from granum.core.i18n import _
from granum.core.kinds import MolarConcentration
from granum.crystallization.formulas.ionizable import Exponent, Group, ph_limit_salt

RANGE = np.linspace(0.0, 14.0, 281)


@chart(
    source="avdeef2003, ch. 6; kramer1972",
    title="Solubility of a weak acid or base against pH",
    typical={
        "acid_exponent": (3.0, 5.0),
        "intrinsic_solubility": (0.01, 30.0),
        "salt_solubility": (100.0, 3000.0),
    },
)
def ph_solubility_chart(
    acid_exponent: Exponent,
    intrinsic_solubility: MolarConcentration,
    salt_solubility: MolarConcentration,
    ionizable_group: Group = "acid",
) -> Any:
    """Solubility against pH on a logarithmic scale: flat where the un-ionized form rules, tenfold per unit of
    pH where the ions do, and the salt's own curve beyond the pH at which both are saturated.

    >>> drawing = ph_solubility_chart(4.42, "2.6e-6 mol/L", "0.05 mol/L")
    >>> len(drawing.data)
    4
    """
    sign = 1.0 if ionizable_group == "acid" else -1.0
    ions = 10.0 ** (sign * (RANGE - float(acid_exponent)))
    unionized, salt = intrinsic_solubility * (1.0 + ions), salt_solubility * (1.0 + 1.0 / ions)
    limit = float(
        ph_limit_salt(acid_exponent, intrinsic_solubility, salt_solubility, ionizable_group=ionizable_group)
    )
    most = float(intrinsic_solubility) + float(salt_solubility)
    drawing = figure(
        axis_title("ph_value", ""),
        axis_title("solubility_total", "mol/L"),
        title=_("Solubility against pH"),
        y_log=True,
    )
    for values, word, color in (
        (unionized, _("un-ionized form in equilibrium"), ACCENT),
        (salt, _("salt in equilibrium"), SOLID),
    ):
        shown = np.where(values <= most * (1.0 + 1e-9), values, np.nan)
        add_line(drawing, RANGE, shown / 1000.0, word, color=color, width=3)
    floor = np.full_like(RANGE, float(intrinsic_solubility) / 1000.0)
    add_line(drawing, RANGE, floor, _("un-ionized form in solution"), color=LIQUID, dash="dash")
    heights = np.array([0.5 * float(intrinsic_solubility), most]) / 1000.0
    add_line(
        drawing,
        np.array([limit, limit]),
        heights,
        _("pH of both, {value}").format(value=f"{limit:.2f}"),
        color=OUT,
        dash="dot",
    )
    return drawing
