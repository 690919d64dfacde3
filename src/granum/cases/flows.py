"""The flow of a feed of solid and liquid said in two ways: total and share of solid, or each phase."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from granum.cases.reading import quantity
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.units import in_unit_of

BY_TOTAL, BY_PHASE = ("mass_flow", "solids_mass_fraction"), ("solid_flow", "liquid_flow")
MOISTURES = ("moisture_dry_basis", "moisture_wet_basis")
"""Which may stand for the share of solid as well as for the flow of liquid."""
WATER = 1000.0  # kg/m³, near enough to size what a feed needs


def percent(share: float) -> str:
    """A share as a case file writes it."""
    return f"{100.0 * share:.10g} %"


def in_totals(feed: Mapping[str, Any]) -> dict[str, str]:
    """Mass flow and share of solid of a feed that says its phases."""
    solid, liquid = (flow_of(feed, name) for name in BY_PHASE)
    total = solid + liquid
    return {"mass_flow": _said(total), "solids_mass_fraction": percent(solid / total if total else 0.0)}


def in_phases(feed: Mapping[str, Any]) -> dict[str, str]:
    """Flows of the phases of a feed that says its total; that of the solid where there is any."""
    total = flow_of(feed, "mass_flow")
    share = _dry_share(feed)
    if share is None:
        share = quantity(feed.get("solids_mass_fraction", 0.0), "MassFraction", "solids_mass_fraction", "")
    solid = {"solid_flow": _said(total * share)} if share else {}
    return solid | {"liquid_flow": _said(total * (1.0 - share))}


def _dry_share(feed: Mapping[str, Any]) -> float | None:
    """Solid in solid and liquid, by the moisture that a feed says; None where it says none."""
    if "moisture_dry_basis" in feed:
        X = quantity(feed["moisture_dry_basis"], "MoistureDryBasis", "moisture_dry_basis", "")
        return 1.0 / (1.0 + X)
    if "moisture_wet_basis" in feed:
        return 1.0 - quantity(feed["moisture_wet_basis"], "MoistureWetBasis", "moisture_wet_basis", "")
    return None


def flow_of(feed: Mapping[str, Any], name: str, per_volume: float | None = None) -> float:
    """A flow that a feed says, kg/s; none where it does not. One that it says as a volume is refused, unless
    a density, kg/m³, is near enough.
    """
    value = feed.get(name)
    share = _dry_share(feed) if name == "liquid_flow" and "mass_flow" not in feed else None
    if share is not None:
        return flow_of(feed, "solid_flow") * (1.0 / share - 1.0)
    if isinstance(value, str) and in_unit_of(value, "m^3/s"):
        if per_volume is None:
            raise InputError(
                _("'{name}' = '{value}' is a volume: write it as a mass first.").format(
                    name=name, value=value
                ),
                name=name,
            )
        return quantity(value, "VolumeFlow", name, "") * per_volume
    return 0.0 if value is None else quantity(value, "MassFlow", name, "")


def _said(flow: float) -> str:
    return f"{3600.0 * flow:.10g} kg/h"
