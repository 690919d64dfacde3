"""The input of a card for which it gives a wanted result."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from granum.core import registry
from granum.core.conversion import Binder, convert
from granum.core.errors import ApplicabilityError, ConvergenceError, InputError, unknown_name
from granum.core.i18n import _, quoted
from granum.core.parameters import Parameter
from granum.core.results import Result
from granum.core.stand_ins import not_varied
from granum.reports.quantities import value_text
from granum.reports.sensitivity import TooLong, takes_arrays, values_at

FAR = 1e5  # times beyond the ordinary range that is still looked at
PLACES, FEW = 241, 31  # looked at in one pass; of a card that takes one set of inputs at a time
PASSES = 12
SAME = 1e-12  # of the input, from which on a bracket is a number
REACHED = 1e-7  # of the result


class Found(NamedTuple):
    """An input, SI, and what the card gives with it."""

    parameter: Parameter
    value: float
    result: Result


def find_input(card: Any, name: str, /, **given: Any) -> Found:
    """The value of the input ``name`` for which the card gives the result that stands among ``given``, which
    else holds its other inputs.

    Looked for between the hard bounds, as far as a factor of 100 000 beyond the ordinary range. Where several
    values give the result, the only one that every source covers is meant; else they are named and refused,
    as where there is none.

    >>> found = find_input(
    ...     "particles.terminal_velocity_stokes",
    ...     "particle_diameter",
    ...     terminal_velocity="1 mm/s",
    ...     particle_density=2650.0,
    ...     fluid_density=1000.0,
    ...     dynamic_viscosity="1 cP",
    ... )
    >>> round(found.value * 1e6, 2)
    33.35
    """
    thing = registry.find(card) if isinstance(card, str) else card
    p, output, wanted, inputs = _asked(thing, name, given)
    count = PLACES if takes_arrays(thing) else FEW
    try:
        x, reach = _all(thing, inputs, p, output, wanted, _first(p, count))
        results = [thing.evaluate(**{**inputs, p.name: v}) for v in x]
    except TooLong:
        raise ApplicabilityError(
            _("{card} takes too long to be solved for {name}.").format(card=thing.card.key, name=p.label)
        ) from None
    if not x:
        raise unreached(p, output, wanted, reach, _first(p, count))
    told = [any(n["flag"] == "extrapolated" for n in r.notices) for r in results]
    chosen = [i for i, beyond in enumerate(told) if not beyond] if len(x) > 1 else [0]
    if len(chosen) != 1:
        raise reached_often(p, output, wanted, x)
    return Found(p, x[chosen[0]], results[chosen[0]])


def _asked(
    thing: Any, name: str, given: Mapping[str, Any]
) -> tuple[Parameter, Parameter, float, dict[str, Any]]:
    """Input and result that are meant, the wanted result in SI, and the other inputs."""
    card = thing.card
    if card.sort not in ("formula", "procedure", "law") or not hasattr(thing, "evaluate"):
        raise InputError(_("'{key}' ({sort}) cannot be used here.").format(key=card.key, sort=_(card.sort)))
    p = next((q for q in card.parameters if q.name == name), None)
    if p is None:
        names, where = [q.name for q in card.parameters], _("for {owner}").format(owner=card.key)
        raise not_varied(name, names, f" {where}") or unknown_name(_("Input"), name, names, where)
    if p.kind is None or p.series or p.sort is int:
        raise InputError(
            _("'{name}' is no single quantity: it cannot be solved for.").format(name=name), name=name
        )
    own = {q.name for q in card.parameters} | {"fluid"}
    results = {q.name: q for q in card.outputs if q.kind is not None and not q.series and q.name not in own}
    wanted = [n for n in given if n in results]
    if len(wanted) != 1:
        raise InputError(
            _("To solve for '{name}', give one result of {card} and its other inputs: {results}.").format(
                name=name, card=card.key, results=", ".join(quoted(n) for n in results)
            ),
            name=name,
        )
    output = results[wanted[0]]
    value = float(convert(given[output.name], output))
    others = {n: v for n, v in given.items() if n not in (output.name, name)}
    inputs = dict(Binder.of(card.key, card.parameters).resolved((), others)[0])
    inputs.pop(name, None)  # which a fluid may have given
    return p, output, value, inputs


def _first(p: Parameter, count: int) -> np.ndarray:
    """Where to look at first: closely in the ordinary range, and widely about it between the hard bounds."""
    kind = p.kind
    assert kind is not None
    low, high = sorted(p.ordinary())
    least = float(np.nextafter(kind.lower, math.inf)) if kind.open_lower else kind.lower
    most = float(np.nextafter(kind.upper, -math.inf)) if kind.open_upper else kind.upper
    near = np.linspace(low, high, count // 2)
    if kind.name == "temperature":
        wide = np.linspace(p.coldest or least, min(most, max(2.0 * high, 1500.0)), count // 2)
    elif kind.lower > -math.inf and kind.upper < math.inf:
        wide = np.linspace(least, most, count // 2)
    elif kind.lower >= 0.0:
        start = (low if low > 0.0 else 1e-6 * high) / FAR
        wide = np.append(np.geomspace(start, high * FAR, count // 2 - 1), least)
    else:
        size = max(abs(low), abs(high)) * FAR
        outward = np.geomspace(size / FAR**2, size, count // 4)
        wide = np.concatenate([-outward[::-1], [0.0], outward])
    return np.unique(np.clip(np.concatenate([near, wide]), least, most))


def _all(
    thing: Any, inputs: dict[str, Any], p: Parameter, output: Parameter, wanted: float, x: np.ndarray
) -> tuple[list[float], tuple[float, float]]:
    """Every place where the result is the wanted one, and the least and the greatest result seen."""
    y = values_at(thing, inputs, p.name, x, output.name)[0]
    good = np.isfinite(y)
    if not good.any():
        thing.evaluate(
            **{**inputs, p.name: float(np.mean(p.ordinary()))}
        )  # tells what is wrong with the rest
        return [], (math.nan, math.nan)
    reach = (float(y[good].min()), float(y[good].max()))
    if reach[1] - reach[0] <= 1e-12 * max(map(abs, reach)):
        raise ApplicabilityError(
            _("{output} does not depend on {name} here: it is {value}.").format(
                output=output.label, name=p.label, value=value_text(reach[0], output)
            )
        )
    miss = np.sign(y - wanted)
    found = [float(v) for v in x[good & (miss == 0.0)]]
    for i in np.flatnonzero(good[:-1] & good[1:] & (miss[:-1] * miss[1:] < 0.0)):
        root = _refined(thing, inputs, p, output, wanted, (float(x[i]), float(x[i + 1])), x.size)
        if root is not None:
            found.append(root)
    if not found and (peak := _touched(thing, inputs, p, output, wanted, x, np.abs(y - wanted))) is not None:
        found.append(peak)
    return sorted(found), reach


def _touched(
    thing: Any,
    inputs: dict[str, Any],
    p: Parameter,
    output: Parameter,
    wanted: float,
    x: np.ndarray,
    miss: np.ndarray,
) -> float | None:
    """Where the result comes to the wanted one without passing it: at its greatest or least."""
    for _pass in range(PASSES):
        at = int(np.nanargmin(miss))
        if miss[at] <= REACHED * abs(wanted):
            return float(x[at])
        x = np.linspace(x[max(at - 1, 0)], x[min(at + 1, x.size - 1)], x.size)
        miss = np.abs(values_at(thing, inputs, p.name, x, output.name)[0] - wanted)
    return None


def _refined(
    thing: Any,
    inputs: dict[str, Any],
    p: Parameter,
    output: Parameter,
    wanted: float,
    ends: tuple[float, float],
    count: int,
) -> float | None:
    """The root in a bracket, cut into many parts at each pass; None where the result jumps over it."""
    low, high = ends
    for _pass in range(PASSES):
        x = np.linspace(low, high, count)
        y = values_at(thing, inputs, p.name, x, output.name)[0]
        miss = y - wanted
        at = np.flatnonzero(np.isfinite(miss[:-1]) & np.isfinite(miss[1:]) & (miss[:-1] * miss[1:] <= 0.0))
        if not at.size:
            return None
        i = int(at[0])
        low, high = float(x[i]), float(x[i + 1])
        if high - low <= SAME * max(abs(low), abs(high)):
            break
    slope = miss[i + 1] - miss[i]
    root = low if slope == 0.0 else low - (high - low) * float(miss[i] / slope)
    scale = max(abs(wanted), 1e-300)
    return root if min(abs(miss[i]), abs(miss[i + 1])) <= REACHED * scale or wanted == 0.0 else None


def reached_often(p: Parameter, output: Parameter, wanted: float, x: Sequence[float]) -> ApplicabilityError:
    """Several values of an input give the wanted result."""
    return ApplicabilityError(
        _("{output} = {wanted} is reached at several values of {name}: {values}. Choose one of them.").format(
            output=output.label,
            wanted=value_text(wanted, output),
            name=p.label,
            values=", ".join(value_text(v, p) for v in x[:4]),
        )
    )


def unreached(
    p: Parameter, output: Parameter, wanted: float, reach: tuple[float, float], looked: np.ndarray
) -> ConvergenceError:
    """No value of an input that was looked at gives the wanted result."""
    return ConvergenceError(
        _(
            "{output} = {wanted} is not reached at any value of {name} from {first} to {last}: with the "
            "other inputs it lies between {low} and {high}."
        ).format(
            output=output.label,
            wanted=value_text(wanted, output),
            name=p.label,
            first=value_text(float(looked[0]) if abs(looked[0]) > 1e-300 else 0.0, p),
            last=value_text(float(looked[-1]), p),
            low=value_text(reach[0], output),
            high=value_text(reach[1], output),
        )
    )
