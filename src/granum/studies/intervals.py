"""Results as intervals, where inputs are given as ``85 ± 5 um`` or ``80..90 um``.

Where all spreads are ``±`` they are taken as independent and small: their shares of the result, by its exact
derivatives, are added as squares. Otherwise the least and the greatest result are looked for among the
corners of the ranges and places between them.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from granum.core import registry
from granum.core.compiling import once
from granum.core.conversion import convert
from granum.core.errors import GranumError, InputError
from granum.core.i18n import _
from granum.core.parameters import Parameter
from granum.core.results import Result
from granum.core.units import format_number, from_si, pretty_unit, to_si
from granum.core.written import interval, read_number
from granum.reports.quantities import value_text
from granum.reports.sensitivity import measured, takes_arrays

MOST = 6  # ranges whose corners are all looked at
ALONG = 9  # places along each range
INSIDE = 64  # places drawn inside all of them


class Spread(NamedTuple):
    """An input that is known within limits, SI: about its middle (``±``) or between two ends."""

    parameter: Parameter
    low: float
    high: float
    about: bool

    @property
    def middle(self) -> float:
        """The value to calculate with."""
        return 0.5 * (self.low + self.high)

    @property
    def half(self) -> float:
        """Half the width."""
        return 0.5 * (self.high - self.low)

    @property
    def text(self) -> str:
        """The input as people write it."""
        if self.about:
            return _about(self.middle, self.half, self.parameter)
        return _between(self.low, self.high, self.parameter)


class Interval(NamedTuple):
    """A result within limits, SI, and how they were found."""

    low: float
    high: float
    text: str
    how: str


def split(card: Any, given: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Spread]]:
    """The inputs with the middle of each interval in its place, and the intervals."""
    values, spreads = dict(given), {}
    for p in card.parameters:
        text = given.get(p.name)
        found = interval(text) if isinstance(text, str) and not p.law else None
        if found is None or p.kind is None:
            continue
        if p.series or p.sort is int:
            raise InputError(_("'{name}' cannot be an interval.").format(name=p.name), name=p.name)
        spreads[p.name] = spread = spread_of(p, *found)
        unit = (read_number(found[0]) or (0.0, ""))[1] or p.kind.unit
        number = f"{float(from_si(spread.middle, unit, p.kind)):.12g}"
        values[p.name] = number if unit == "dimensionless" else f"{number} {unit}"
    return values, spreads


def spread_of(p: Parameter, first: str, second: str, mark: str) -> Spread:
    """The spread of an input, from what ``written.interval`` reads."""
    assert p.kind is not None
    if mark == "..":
        low, high = float(convert(first, p)), float(convert(second, p))
        if not low < high:
            raise InputError(
                _("'{name}': the range {low} … {high} must rise.").format(
                    name=p.name, low=value_text(low, p), high=value_text(high, p)
                ),
                name=p.name,
            )
        return Spread(p, low, high, False)
    middle = float(convert(first, p))
    number, unit = read_number(second) or (math.nan, "")
    relative = unit == "%" and not first.endswith("%")
    if relative:
        half = abs(middle * number / 100.0)
    elif unit:
        half = abs(float(to_si(number, unit, p.kind, p.name)) - float(to_si(0.0, unit, p.kind, p.name)))
    else:
        half = abs(number)
    return Spread(p, middle - half, middle + half, True)


def stated(card: Any, given: Mapping[str, Any]) -> dict[str, str]:
    """The inputs that are intervals, as people write them."""
    return {name: spread.text for name, spread in split(card, given)[1].items()}


def with_intervals(card: Any, /, **given: Any) -> tuple[Result, dict[str, Interval]]:
    """What a card gives for the middles of its inputs, and each result as an interval.

    >>> result, within = with_intervals(
    ...     "particles.reynolds_number",
    ...     velocity="1 ± 0.1 m/s",
    ...     particle_diameter="2..4 mm",
    ...     fluid_density=1000.0,
    ...     dynamic_viscosity=1e-3,
    ... )
    >>> round(within["reynolds_number"].low), round(within["reynolds_number"].high)
    (1800, 4400)
    """
    thing = registry.find(card) if isinstance(card, str) else card
    values, spreads = split(thing.card, given)
    result = thing.evaluate(**values)
    return result, intervals(thing, result, spreads)


def intervals(thing: Any, result: Result, spreads: Mapping[str, Spread]) -> dict[str, Interval]:
    """The results that are single numbers as intervals; none without spreads."""
    outputs = measured(result)
    if not spreads or not outputs:
        return {}
    inputs = {name: value for name, value in result.inputs.items() if value is not None}
    if all(s.about for s in spreads.values()) and takes_arrays(thing):
        return _linear(thing, result, outputs, inputs, spreads)
    return _extreme(thing, outputs, inputs, spreads)


def _linear(
    thing: Any,
    result: Result,
    outputs: list[Parameter],
    inputs: dict[str, Any],
    spreads: Mapping[str, Spread],
) -> dict[str, Interval]:
    import jax
    import jax.numpy as jnp

    places = [p.name for p in thing.card.outputs]

    def figures(x: Any) -> Any:
        out = thing(**{**inputs, **{name: x[i] for i, name in enumerate(spreads)}})
        all_of = out if isinstance(out, tuple) else (out,)
        return jnp.stack([jnp.asarray(all_of[places.index(p.name)], dtype=float) for p in outputs])

    middles, halves = (np.asarray([getattr(s, end) for s in spreads.values()]) for end in ("middle", "half"))
    slopes = once(jax.jacfwd(figures), middles)
    found = {}
    for p, row in zip(outputs, slopes, strict=True):
        half = float(np.sqrt(np.sum((row * halves) ** 2)))
        value = float(result.outputs[p.name])
        if math.isfinite(half):
            how = _("linear propagation of independent ±, by exact derivatives")
            found[p.name] = Interval(value - half, value + half, _about(value, half, p), how)
    return found


def _about(value: float, half: float, p: Parameter) -> str:
    """``4.92 ± 0.56 mm/s``, to the second figure of the half width."""
    assert p.kind is not None
    unit = p.display_unit(value)
    shown = float(from_si(value, unit, p.kind))
    width = abs(float(from_si(value + half, unit, p.kind)) - shown)
    if not width:
        return value_text(value, p)
    digits = math.floor(math.log10(abs(shown) or width)) - math.floor(math.log10(width)) + 2
    texts = format_number(shown, min(max(digits, 2), 9)), format_number(width, 2)
    return f"{' ± '.join(texts)} {pretty_unit(unit)}".strip()


def _between(low: float, high: float, p: Parameter) -> str:
    return value_text(np.asarray([low, high]), p).replace("; ", " … ")


def _extreme(
    thing: Any, outputs: list[Parameter], inputs: dict[str, Any], spreads: Mapping[str, Spread]
) -> dict[str, Interval]:
    given = {**inputs, **dict(zip(spreads, _places(spreads).T, strict=True))}
    rows: dict[str, np.ndarray]
    if takes_arrays(thing):
        found = thing.evaluate(**given).outputs
        count = len(given[next(iter(spreads))])
        rows = {p.name: np.broadcast_to(np.asarray(found[p.name], dtype=float), (count,)) for p in outputs}
    else:
        rows = _one_by_one(thing, outputs, inputs, spreads)
    about = any(s.about for s in spreads.values())
    how = (
        _("least and greatest over the ranges, ± taken as limits")
        if about
        else _("least and greatest over the ranges")
    )
    within = {}
    for p in outputs:
        good = rows[p.name][np.isfinite(rows[p.name])]
        if good.size:
            low, high = float(good.min()), float(good.max())
            within[p.name] = Interval(low, high, _between(low, high, p), how)
    return within


def _one_by_one(
    thing: Any, outputs: list[Parameter], inputs: dict[str, Any], spreads: Mapping[str, Spread]
) -> dict[str, np.ndarray]:
    """Results of a card that takes one set of inputs at a time: at the corners only."""
    rows: dict[str, list[float]] = {p.name: [] for p in outputs}
    for corner in _corners(spreads):
        try:
            found = thing.evaluate(
                **{**inputs, **dict(zip(spreads, map(float, corner), strict=True))}
            ).outputs
        except GranumError:
            continue
        for name, row in rows.items():
            row.append(float(found[name]))
    return {name: np.asarray(row) for name, row in rows.items()}


def _corners(spreads: Mapping[str, Spread]) -> np.ndarray:
    ends = [(s.low, s.high) for s in spreads.values()]
    if len(ends) > MOST:
        raise InputError(_("At most {most} inputs may be ranges.").format(most=MOST))
    return np.asarray(list(itertools.product(*ends)))


def _places(spreads: Mapping[str, Spread]) -> np.ndarray:
    """Corners, places along each range with the others in their middle, and places inside, as rows."""
    corners = _corners(spreads)
    middles = np.asarray([s.middle for s in spreads.values()])
    low, high = corners.min(axis=0), corners.max(axis=0)
    along = np.repeat(middles[None, :], ALONG * len(middles), axis=0)
    for i in range(len(middles)):
        along[i * ALONG : (i + 1) * ALONG, i] = np.linspace(low[i], high[i], ALONG)
    inside = low + (high - low) * np.random.default_rng(0).random((INSIDE, len(middles)))
    return np.concatenate([corners, along, inside])
