"""What is left of a difference of two large numbers is no heat, and what is left of a drop after a thousand
halvings is no drop: figures of a solved line that are rounding.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.streams.stream import Stream
from granum.streams.units import Sheet, Unit

# of the largest enthalpy flow, some hundred roundings of it; flows and moistures are no differences
LEAST_POWER, LEAST_FLOW, DRY = 1e-13, 1e-15, 1e-15
MOISTURE = KINDS["MoistureDryBasis"]


def thresholds(streams: Iterable[Stream]) -> dict[str, float]:
    """Below which a power (W) and a mass flow (kg/s) are none, in a line that carries some streams."""
    carried = [(abs(float(s.enthalpy_flow)), float(s.mass_flow)) for s in streams]
    power, flow = (max(column) for column in zip(*carried, strict=True)) if carried else (0.0, 0.0)
    return {"W": LEAST_POWER * power, "kg/s": LEAST_FLOW * flow}


def without_noise(unit: Unit, sheet: Sheet, least: Mapping[str, float]) -> Sheet:
    """Figures, checks and utilities of a unit, zero where they are below the thresholds of their line. What a
    unit without a card says stands as it is.
    """
    card = getattr(type(unit), "card", None)
    if card is None:
        return sheet
    told = {p.name: cleared(p, value, least) for p, value in zip(card.outputs, sheet.figures, strict=True)}
    known = {use.parameter.name: use.parameter for use in card.utilities}
    return sheet._replace(
        figures=type(sheet.figures)(**told),
        checks=tuple(
            replace(check, value=0.0)
            if check.unit in ("dimensionless", "kg/kg") and abs(float(check.value)) < DRY
            else check
            for check in sheet.checks
        ),
        uses={name: cleared(known[name], value, least) for name, value in sheet.uses.items()},
    )


def cleared(p: Parameter, value: Any, least: Mapping[str, float]) -> Any:
    """A value, zero where it is below the threshold of what it is."""
    if p.kind is None or value is None:
        return value
    low = DRY if p.kind is MOISTURE else least.get(p.kind.unit, 0.0)
    return np.where(np.abs(value) < low, 0.0, value)[()] if low else value  # a number stays one
