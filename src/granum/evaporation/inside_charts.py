"""Charts of what happens inside evaporators: from effect to effect, and how a solution boils as it
thickens.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import jax.numpy as jnp
import numpy as np

from granum.core.i18n import _
from granum.evaporation.boiling import SPAN, Effect, Liquor
from granum.numerics import find_root
from granum.streams.inside_charts import Axis, Curve, Mark, drawn_along
from granum.streams.stream import Stream

BEYOND = 1.3  # times what is dissolved in the product, to which the curve is drawn
THICKEST = 0.95
POINTS = 41


def _temperature(label: str) -> Axis:
    return Axis("temperature", "Temperature", "degC", label, zero=False)


def drawn_effects(effects: Sequence[Effect], chest: Any) -> Any:
    """Temperatures on both sides of the wall of each effect, and the vapor that it gives off."""
    number = np.arange(1, len(effects) + 1)
    boiling = np.array([float(made.temperature) for made in effects])
    pure = np.array([float(made.pure) for made in effects])
    drawing = drawn_along(
        Axis("stage_count", "Number", "", _("effect")),
        number,
        (
            _temperature(_("temperature")),
            [
                Curve(_("heating side"), np.array([float(chest), *pure[:-1]]), "HEAT"),
                Curve(_("boiling solution"), boiling, "LIQUID"),
                Curve(_("solvent alone at that pressure"), pure, "GAS", "dot"),
            ],
        ),
        (
            Axis("evaporation_rate", "MassFlow"),
            [Curve(_("vapor"), np.array([float(made.evaporation) for made in effects]), "ACCENT", "dash")],
        ),
        mode="lines+markers",
    )
    drawing.update_xaxes(dtick=1)
    return drawing


def drawn_boiling(liquor: Liquor, made: Effect, chest: Any, feed: Stream) -> Any:
    """Boiling point of a solution over what is dissolved in it, at the pressure of its effect."""
    dissolved = np.asarray(feed.liquid)[1:] / max(float(np.sum(np.asarray(feed.liquid)[1:])), 1e-300)
    whole = np.asarray(made.product.liquid)
    ends = float(np.sum(whole[1:]) / np.sum(whole))
    starts = float(1.0 - feed.liquid[0] / feed.liquid_flow)
    share = np.linspace(0.0, min(BEYOND * max(ends, starts, 1e-3), THICKEST), POINTS)
    liquid = jnp.asarray([1.0 - share, *(part * share for part in dissolved)])
    pure = made.pure + jnp.zeros(POINTS)
    points = find_root(lambda T: liquor.excess(T, pure, liquid), pure - 1.0, pure + SPAN, start=pure + 2.0)
    boiling = np.asarray(points.value)
    return drawn_along(
        Axis("solute_mass_fraction", "MassFraction", "percent", _("dissolved matter in the liquid")),
        share,
        (
            _temperature(_("temperature")),
            [
                Curve(_("condensing steam"), np.full(POINTS, float(chest)), "HEAT"),
                Curve(_("boiling solution"), boiling, "LIQUID"),
                Curve(_("solvent alone at that pressure"), np.asarray(pure), "GAS", "dot"),
            ],
        ),
        marks=[
            Mark(_("as it is fed"), starts, np.interp(starts, share, boiling)),
            Mark(_("in the evaporator"), ends, made.temperature),
        ],
    )
