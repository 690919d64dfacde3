"""Records as what a reader is told: one notice with a sentence for each flag."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np

from granum.core.errors import InputError
from granum.core.flags import EXTRAPOLATED, LIMIT_ACTIVE, OUTSIDE_DOMAIN, WORDS, Record
from granum.core.glossary import quantity_in, term
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.registry import find
from granum.core.units import best_unit, format_number, from_si, pretty_unit


def describe(records: list[Record]) -> list[dict[str, Any]]:
    """The raised flags as plain data with one sentence each, equal ones merged."""
    rows: dict[tuple[Any, ...], dict[str, Any]] = {}
    for found in records:
        mask = np.asarray(found.mask)
        if not mask.any():
            continue
        limits = found.computed or (found.low, found.high)
        values, lows, highs = (
            np.broadcast_to(np.asarray(x, dtype=float), mask.shape)[mask] for x in (found.value, *limits)
        )
        beyond = np.where(np.isfinite(values), np.fmax(lows - values, values - highs), -np.inf)
        at = int(np.argmax(beyond))
        worst, low, high = (float(x[at]) for x in (values, lows, highs))
        key = (found.bit, found.name, found.card, low, high, found.reason)
        row = rows.setdefault(
            key,
            {
                "flag": WORDS[found.bit],
                "name": found.name,
                "card": str(found.card),
                "count": 0,
                "worst": None,
                "low": low if np.isfinite(low) else None,
                "high": high if np.isfinite(high) else None,
                "source": found.source,
            },
        )
        row["count"] += int(mask.sum())
        row["worst"] = worst if np.isfinite(worst) else None
        limited = found.bit in (OUTSIDE_DOMAIN, EXTRAPOLATED) and (
            row["low"] is not None or row["high"] is not None
        )
        told = ([_sentence(row, found.card)] if limited or not found.reason else []) + (
            [_(found.reason)] if found.reason else []
        )
        if found.bit == LIMIT_ACTIVE:
            told.append(_elements(row, values, mask.size))
        row["message"] = " ".join(filter(None, told))
    return list(rows.values())


def beside(records: list[Record], own: Collection[str]) -> list[dict[str, Any]]:
    """Single numbers that a calculation went through and whose range a source states, such as a Reynolds
    number; not those of the names ``own``. Each value stands once, under the range that says most.
    """
    found: dict[tuple[str, str], dict[str, Any]] = {}
    for told in records:
        low, high = told.low, told.high
        value = np.asarray(told.value, dtype=float)
        stated = told.bit == EXTRAPOLATED and not told.reason and told.computed is None
        if (
            not stated
            or told.name in own
            or value.size != 1
            or not np.isfinite(value).all()
            or not (np.isfinite(low) or np.isfinite(high))
        ):
            continue
        number = value.item()
        row = {
            "name": told.name,
            "value": number,
            "low": low if np.isfinite(low) else None,
            "high": high if np.isfinite(high) else None,
            "card": told.card,
            "source": told.source,
        }
        before = found.get(key := (told.name, f"{number:.4g}"))
        if before is None or _width(row) < _width(before):
            found[key] = row
    return list(found.values())


def _width(row: dict[str, Any]) -> float:
    """How wide a range is, for one that lies above zero on a scale of ratios."""
    low, high = row["low"], row["high"]
    if low is None or high is None:
        return np.inf
    return float(np.log(high / low)) if low > 0 else 1e6 + high - low


def _elements(row: dict[str, Any], values: np.ndarray, total: int) -> str:
    """Which elements a limit concerns: how many of how many where there are several, and their values."""
    values = values[np.isfinite(values)]
    if not values.size:
        return ""
    low, high = float(values.min()), float(values.max())
    shown, unit = units_of({**row, "worst": high})
    span = f"{shown(low)}{unit}" if low == high else f"{shown(low)} … {shown(high)}{unit}"
    word = quantity_in(row["name"])
    name = term(word).label if word else row["name"]
    if total == 1:
        return f"({name} = {span})"
    return _("({name} = {span}: {count} of {total} values)").format(
        name=name, span=span, count=values.size, total=total
    )


def _sentence(row: dict[str, Any], card: str) -> str:
    """One readable line for a flag; a property of a material says its name in the current language."""
    word = quantity_in(row["name"])
    name = term(word).label if word else row["name"]
    shown, unit = units_of(row)
    value = "" if row["worst"] is None else f" = {shown(row['worst'])}{unit}"
    span = ""
    if row["low"] is not None or row["high"] is not None:
        low = "−∞" if row["low"] is None else shown(row["low"])
        high = "∞" if row["high"] is None else shown(row["high"])
        span = f" [{low} … {high}{unit}]"
    templates = {
        "extrapolated": _(
            "{name}{value} is outside the range the source covers{span} in {card}: extrapolated."
        ),
        "outside domain": _("{name}{value} is outside what is possible{span} in {card}: no value."),
        "not finite": _("{name} is not a finite number in {card}."),
        "not converged": _("{name} did not converge in {card}."),
    }
    return templates[row["flag"]].format(name=name, value=value, span=span, card=getattr(card, "label", card))


def units_of(row: dict[str, Any]) -> tuple[Any, str]:
    """How to print the numbers of a flag, and their unit: those of the card's parameter where the flag is
    about one.
    """
    try:
        kind = find(row["card"]).card.parameter(row["name"]).kind
    except (InputError, StopIteration):
        # a number computed inside the body, or a material: the kind that bears the name, if one does
        kind = KINDS.get("".join(word.capitalize() for word in row["name"].split("_")))
    if kind is None:
        return format_number, ""
    numbers = [row[end] for end in ("worst", "low", "high") if row[end] is not None and np.isfinite(row[end])]
    unit = best_unit(max(map(abs, numbers), default=0.0), kind)
    return lambda value: format_number(
        float(from_si(value, unit, kind))
    ), f" {pretty_unit(unit)}" if pretty_unit(unit) else ""
