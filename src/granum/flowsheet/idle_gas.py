"""Gas that comes with what a machine works on, where the gas it works with has an inlet of its own."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.units import show
from granum.estimation.verdicts import note
from granum.flowsheet.sheet import Flowsheet
from granum.streams.stream import Stream

LEAST = 1e-6  # of what comes with it: less is what rounding or a solution of a loop leaves


def idle_gas(sheet: Flowsheet, streams: Mapping[str, Stream]) -> list[dict[str, Any]]:
    """One note for each unit with the inlets 'feed' and 'gas' whose feed brings gas: it leaves with the
    exhaust and dries, carries or cools nothing.
    """
    rows = []
    for unit in sheet.order:
        inlets = sheet.inlets_of(unit, streams)
        if not {"feed", "gas"} <= set(inlets):
            continue
        feed = inlets["feed"]
        flow = float(feed.gas_flow) if feed.mixture.gases else 0.0
        if flow > LEAST * float(feed.mass_flow):
            sentence = _(
                "{flow} of gas come with the feed, without effect, and leave with the exhaust: the gas that "
                "works enters at 'gas'."
            ).format(flow=show(flow, KINDS["MassFlow"]))
            rows.append({"unit": unit, **note("idle gas", sentence, sheet.units[unit].card.key)})
    return rows
