"""What passes a machine without effect: gas beside the gas that works, gas without dust to be taken out."""

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


def idle(sheet: Flowsheet, streams: Mapping[str, Stream]) -> list[dict[str, Any]]:
    """One note for each unit whose feed comes in vain."""
    rows = []
    for unit in sheet.order:
        thing, inlets = sheet.units[unit], sheet.inlets_of(unit, streams)
        told = None
        if thing.takes_dust:
            told = _without_dust(inlets["feed"])
        elif {"feed", "gas"} <= set(inlets):
            told = _beside_the_gas(inlets["feed"])
        if told is not None:
            rows.append({"unit": unit, **note("idle gas", told, thing.card.key)})
    return rows


def _beside_the_gas(feed: Stream) -> str | None:
    """Told where gas comes with what a machine works on, though the gas it works with has its own inlet: it
    leaves with the exhaust and dries, carries or cools nothing.
    """
    flow = float(feed.gas_flow) if feed.mixture.gases else 0.0
    if flow <= LEAST * float(feed.mass_flow):
        return None
    return _(
        "{flow} of gas come with the feed, without effect, and leave with the exhaust: the gas that "
        "works enters at 'gas'."
    ).format(flow=show(flow, KINDS["MassFlow"]))


def _without_dust(feed: Stream) -> str | None:
    """Told where a collector has nothing to collect, as behind a dryer that keeps its fines."""
    if not feed.gas_flow > 0.0 or feed.solid_flow > 0.0:
        return None
    return _(
        "No dust enters: this machine takes pressure and power for nothing. Does a dryer or mill before it "
        "keep its fines? Those that have 'entrainment' give them to the gas when it is set to yes."
    )
