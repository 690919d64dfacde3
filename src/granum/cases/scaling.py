"""Sizes of what is put on a stream: those of its example alone, larger or smaller as the stream is."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Mapping
from math import ceil
from typing import Any, NamedTuple

import numpy as np

from granum.cases.alone import tables
from granum.cases.flows import WATER, flow_of
from granum.cases.outline import Outline, table_of
from granum.cases.reading import quantity
from granum.cases.starting import GAS_PER_MOISTURE, listed
from granum.core import registry
from granum.core.conversion import convert
from granum.core.errors import GranumError
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.core.units import from_si
from granum.core.written import read_number
from granum.reports.quantities import value_text
from granum.streams.feeding import below

# the power of the flow with which they grow: areas and contents in proportion, what a stream flows through
# at the same velocity with its root
POWERS = {
    "area": 1.0,
    "area_collector": 1.0,
    "belt_width": 1.0,
    "diameter": 0.5,
    "holdup_mass": 1.0,
    "flight_lip": 0.5,
    "length": 0.5,
    "mass": 1.0,
    "parallel_number": 1.0,
    "plate_number": 1.0,
    "rotation_speed": -0.5,
    "screen_area": 1.0,
    "shaft_power": 1.0,
    "throat_area": 1.0,
    "volume": 1.0,
}
BY_DIAMETER = frozenset(
    (
        "conveying.pneumatic_conveyor",
        "conveying.slurry_pipeline",
        "conveying.thick_slurry_pipeline",
        "drying.flash_dryer",
        "drying.rotary_dryer",
        "drying.spray_dryer",
        "settling.circular_clarifier",
    )
)
"""What is sized by its diameter, dryers for the gas through them; in others it is a shape, or several run in
parallel.
"""
SHAPE = frozenset(("length", "flight_lip", "rotation_speed"))
BY_SHAPE = frozenset(("drying.rotary_dryer",))
"""What keeps its shape and the speed of its shell: as long, in diameters, as the example."""
FAR = (0.5, 2.0)  # times within which a line as a whole is taken to be as large as the example
OFF = (0.9, 1.1)  # and a stream that is known
SCREENS = frozenset(
    f"comminution.{name}"
    for name in ("screen", "vibrating_screen", "double_deck_screen", "triple_deck_screen")
)
"""What has openings, which are those of its example, wider or narrower as what enters is coarse."""
FINEST = {"comminution.vibrating_screen": 0.8e-3}
"""m: below it the capacity of the screen falls to nothing by its own law (Karra's factor of fineness)."""
OPENINGS = frozenset(("aperture", "wire_diameter", "cut_size"))
EVAPORATES = "evaporation."  # the domain of what drives out solvent
EVAPORATED = (0.9, 2.0)  # what is left must be left
# kg/m³, of a flow that is said as a volume
DENSITIES = {"mass_flow": WATER, "solid_flow": WATER, "liquid_flow": WATER, "gas_flow": 1.2}


class Scale(NamedTuple):
    """How much more enters than in the example: kg/s here, and times as much; whether this is known."""

    flow: float
    times: float
    known: bool


def scale_of(model: str, found: Outline, origin: str = "", brings: Mapping[str, Any] | None = None) -> Scale:
    """How much larger than in its example what enters a piece of equipment is: the stream it is put on, where
    that is a feed or ``brings`` says its ``mass_flow`` and its ``solvent``, else the line as a whole.
    """
    example = tables(model)
    evaporates = model.startswith(EVAPORATES)  # the solvent is driven out, and some must be left
    told = "solvent" if evaporates else "mass_flow"
    measured = _solvent if evaporates else entering
    feeds = table_of(found.raw, "feeds")
    first = next(iter(registry.find(model).inlet_names() or ()), "")
    if brings and told in brings:
        here = quantity(brings[told], "MassFlow", told, "")
    elif origin in feeds:
        here = measured(found.raw, [origin], True)
    else:
        return _scale(
            measured(found.raw, list(feeds)), measured(example, list(table_of(example, "feeds"))), False
        )
    return _scale(here, measured(example, [first], True), True)


def gas_of(model: str, brings: Mapping[str, Any]) -> float:
    """The gas of a dryer for what a stream ``brings``, kg/s: in proportion to its example, and more where
    more is to be evaporated.
    """
    feeds = table_of(tables(model), "feeds")
    here = quantity(brings["mass_flow"], "MassFlow", "mass_flow", "")
    gas = flow_of(table_of(feeds, "gas"), "gas_flow", DENSITIES["gas_flow"])
    flow = gas * _scale(here, entering({"feeds": feeds}, ["feed"], True), True).times
    return max(flow, GAS_PER_MOISTURE * quantity(brings.get("solvent", "0 kg/s"), "MassFlow", "solvent", ""))


def _scale(here: float, alone: float, known: bool) -> Scale:
    return Scale(here, here / alone if alone > 0.0 and here > 0.0 else 1.0, known)


def median_of_feed(feed: Mapping[str, Any]) -> float | None:
    """The size that half of a feed's solid is finer than, m; None where it says none that can be read."""
    edges = np.geomspace(1e-8, 1.0, 161)
    try:
        finer = below(feed.get("sizes"), edges)
    except (GranumError, ArithmeticError, TypeError, ValueError):
        return None
    if finer is None or not finer[0] < 0.5 < finer[-1]:
        return None
    return float(np.exp(np.interp(0.5, finer, np.log(edges))))


def median_size_of(found: Outline, origin: str, brings: Mapping[str, Any] | None) -> float | None:
    """The median size of what a stream brings, m, as far as it is known."""
    if brings and brings.get("median_size"):
        return quantity(brings["median_size"], "Length", "median_size", "")
    return median_of_feed(table_of(table_of(found.raw, "feeds"), origin))


def meshed(model: str, made: Mapping[str, Any], median: float | None) -> dict[str, Any]:
    """Openings of a screen around the median size of what enters it, in the proportions of its example; empty
    for what has none.
    """
    if model not in SCREENS or median is None:
        return {}
    openings = [_meters(x) for x in _openings(made)]
    times = max(median, FINEST.get(model, 0.0)) / math.prod(openings) ** (1.0 / len(openings))
    return {name: _opened(name, x, times) for name, x in made.items() if x != _opened(name, x, times)}


def _openings(made: Mapping[str, Any]) -> list[Any]:
    """Of the decks of a screen, or of its only one."""
    inner = [x["cut_size"] for x in made.values() if isinstance(x, Mapping) and "cut_size" in x]
    return inner or [made["aperture"]]


def _meters(value: Any) -> float:
    return quantity(value, "Length", "aperture", "")


def _opened(name: str, value: Any, times: float) -> Any:
    if isinstance(value, Mapping):
        return {key: _opened(key, x, times) for key, x in value.items()}
    if name not in OPENINGS:
        return value
    length = times * _meters(value)
    unit = "mm" if length >= 1e-3 else "um"
    number = float(from_si(length, unit, KINDS["Length"]))
    return f"{float(f'{number:.2g}'):.10g} {unit}"


def scaled(model: str, made: Mapping[str, Any], scale: Scale) -> dict[str, Any]:
    """Sizes in proportion, of those that a piece of equipment starts from."""
    near = EVAPORATED if model.startswith(EVAPORATES) else OFF if scale.known else FAR
    if near[0] < scale.times < near[1]:
        return {}
    return {p.name: _grown(p, made[p.name], scale.times) for p in _sizes(model) if p.name in made}


def _sizes(model: str) -> list[Parameter]:
    return [
        p
        for p in registry.find(model).card.parameters
        if p.kind is not None
        and p.name in POWERS
        and (p.name != "diameter" or model in BY_DIAMETER)
        and (p.name not in SHAPE or model in BY_SHAPE)
    ]


def _grown(p: Parameter, value: Any, times: float) -> Any:
    size = times ** POWERS[p.name] * float(convert(value, p))
    if p.name.endswith("_number"):
        return max(ceil(size - 1e-9), 1)
    if p.kind is None:
        return size
    typed = read_number(value) if isinstance(value, str) else None
    unit = typed[1] if typed is not None and typed[1] else p.kind.unit  # as somebody wrote it
    return f"{float(f'{float(from_si(size, unit, p.kind)):.2g}'):.10g} {unit}"


def size_told(model: str, made: Mapping[str, Any], scale: Scale, median: float | None = None) -> str:
    """For what a piece of equipment was sized, in words; empty where it keeps the size of its example."""
    told = [_flow_told(model, made, scale)]
    if median is not None and median > FINEST.get(model, 0.0) and meshed(model, made, median):
        size = value_text(float(f"{median:.2g}"), Parameter("median_diameter", KINDS["Length"]))
        told.append(_("Its openings are around the median size of what enters, {size}.").format(size=size))
    return " ".join(filter(None, told))


def _flow_told(model: str, made: Mapping[str, Any], scale: Scale) -> str:
    sizes = {name: x for name, x in scaled(model, made, scale).items() if x != made[name]}
    if not sizes:
        return ""
    flow = Parameter("mass_flow", KINDS["MassFlow"])
    values = [
        f"{p.label} = {value_text(convert(sizes[p.name], p), p)}" for p in _sizes(model) if p.name in sizes
    ]
    told = _("Sized for {flow}, in proportion to its example: {values}.")
    if model.startswith(EVAPORATES):
        told = _("Sized for {flow} of solvent that enters, in proportion to its example: {values}.")
    return told.format(flow=value_text(scale.flow, flow), values=", ".join(values))


def entering(raw: Mapping[str, Any], feeds: list[str], gas: bool = False) -> float:
    """Solid and liquid that feeds bring, and gas where it is asked for, kg/s; unreadable ones count as
    nothing.
    """
    total = 0.0
    for name in feeds:
        for word, dense in DENSITIES.items() if gas else list(DENSITIES.items())[:-1]:
            with contextlib.suppress(GranumError, TypeError):
                total += flow_of(table_of(table_of(raw, "feeds"), name), word, dense)
    return total


def _solvent(raw: Mapping[str, Any], feeds: list[str], _gas: bool = False) -> float:
    """What feeds bring of the first liquid, kg/s; unreadable ones count as nothing."""
    first = (listed(table_of(raw, "mixture"), "liquids") or [""])[0]
    total = 0.0
    for name in feeds:
        with contextlib.suppress(GranumError, TypeError):
            feed = table_of(table_of(raw, "feeds"), name)
            share = quantity(table_of(feed, "liquid").get(first, "100 %"), "MassFraction", first, "")
            total += flow_of(feed, "liquid_flow", WATER) * share
    return total
