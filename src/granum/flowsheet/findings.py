"""Is a solved line a solution? What is measured on every stream and unit, and what is wrong, in words that
name unit and cause.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.core.errors import GranumError
from granum.core.i18n import _
from granum.core.kinds import KINDS, Kind
from granum.core.notices import describe
from granum.core.parameters import Parameter
from granum.core.units import format_number, show
from granum.flowsheet.sheet import Flowsheet
from granum.flowsheet.solving import Solution, balances, stacked
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import COLDEST, HOTTEST, Stream

CLOSURE = 1e-9  # of what enters: a balance that misses by more than this is not a balance
LEAST = -1e-9  # of the largest stream: what rounding may leave of a flow that is zero
# a gas that leaves saturated may lie this far above by the difference between two vapor pressures
SATURATED = 1.001
PHASES = {"solid": "solids", "liquid": "liquids", "gas": "gases"}
WRONG = flags.OUTSIDE_DOMAIN | flags.NOT_FINITE | flags.NOT_CONVERGED


class Findings(NamedTuple):
    """Numbers that decide whether a solution is one. Streams in the order of ``line.links``, units in
    ``line.order``, the whole line last.

    Parameters
    ----------
    finite: whether flows and temperature of each stream are finite numbers.
    lowest: lowest flow of any species and class, as a share of the largest stream.
    saturation: partial pressure of the vapor over its saturation pressure; zero where there is no gas, or no
        vapor among the gases.
    temperature: K. mass, energy: relative imbalance. by_component: the same for each conserved component.
    lost: whether a formula inside each unit said that there is no value, or an iteration did not converge.
    figures: whether all figures of each unit, where they were asked for, are finite and within the bounds of
        their quantity.
    """

    finite: Any
    lowest: Any
    saturation: Any
    temperature: Any
    mass: Any
    energy: Any
    by_component: Any
    lost: Any
    figures: Any


class Fault(NamedTuple):
    """Something that cannot be: its kind (``no value``, ``stream``, ``balance``, ``figure``, ``loop``,
    ``target``, ``stopped``), unit, stream and sentence.
    """

    kind: str
    unit: str
    stream: str
    message: str


def findings(line: Flowsheet, solution: Solution) -> Findings:
    """Measure a solution. Pure, so that studies batch it."""
    streams = stacked(line, solution)
    mass_flow = jax.vmap(lambda s: s.mass_flow)(streams)
    largest = jnp.max(mass_flow)
    largest = jnp.where(largest > 0, largest, 1.0)
    mass, energy, by_component = balances(line, solution, streams)
    return Findings(
        finite=jnp.isfinite(mass_flow + streams.temperature),
        lowest=jax.vmap(_lowest)(streams) / largest,
        saturation=_saturations(streams, 1e-9 * largest),
        temperature=streams.temperature,
        mass=mass,
        energy=energy,
        by_component=by_component,
        lost=jnp.stack([unanswered(solution.records[name]) for name in line.order]),
        figures=jnp.stack([_possible_figures(line, solution, name) for name in line.order]),
    )


def sound(found: Findings) -> Any:
    """Whether the solution is one, loops apart."""
    return (
        jnp.all(found.finite)
        & jnp.all(found.lowest >= LEAST)
        & jnp.all(found.saturation <= SATURATED)
        & known_temperatures(found)
        & jnp.all(found.mass <= CLOSURE)
        & jnp.all(found.energy <= CLOSURE)
        & ~jnp.any(found.lost)
        & jnp.all(found.figures)
    )


def known_temperatures(found: Findings) -> Any:
    """Whether all streams lie between the ends at which the search for a temperature gives up."""
    return jnp.all((found.temperature > COLDEST + 1.0) & (found.temperature < HOTTEST - 1.0))


def faults(line: Flowsheet, solution: Solution, found: Findings) -> list[Fault]:
    """What is wrong with a solution, in the order in which the units are calculated: the first is the
    cause.
    """
    fed = [fault for k in line.links if not k.origin for fault in _of_stream(line, solution, found, k.name)]
    units = [unit for block in line.blocks for unit in block.units]
    # what they say of themselves may be said because of what came in
    starved = [unit for unit in units if _unknown(line, found, unit)]
    own = [fault for unit in units for fault in _of_unit(line, solution, found, unit, unit not in starved)]
    return fed + own + [fault for unit in starved for fault in _own_words(solution.records, unit)]


def _lowest(s: Stream) -> Any:
    flows = jnp.concatenate([jnp.ravel(s.solid), s.liquid, s.gas])
    return jnp.min(flows, initial=0.0)


def _saturations(streams: Stream, least: Any) -> Any:
    try:
        humid = HumidMixture(streams.mixture)
    except GranumError:  # one gas alone, or vapors that the library does not know: nothing to hold against it
        return jnp.zeros(jnp.shape(streams.temperature))
    least = jnp.broadcast_to(least, jnp.shape(streams.temperature))
    return jax.vmap(lambda s, few: jnp.where(s.gas_flow > few, humid.relative_humidity(s), 0.0))(
        streams, least
    )


def unanswered(records: list[flags.Record]) -> Any:
    """Whether a formula inside a unit said that there is no value, or an iteration did not converge."""
    return jnp.any(jnp.stack([jnp.any(r.mask) for r in records if r.bit & WRONG] or [jnp.asarray(False)]))


def _place(line: Flowsheet, name: str) -> int:
    return [k.name for k in line.links].index(name)


def _unknown(line: Flowsheet, found: Findings, unit: str) -> bool:
    return any(k.target_unit == unit and not bool(found.finite[_place(line, k.name)]) for k in line.links)


def _own_words(records: Mapping[str, list[flags.Record]], unit: str) -> Iterator[Fault]:
    for row in describe([r for r in records[unit] if r.bit & WRONG]):
        yield Fault(
            "no value",
            unit,
            "",
            _("Unit '{unit}' has no solution: {cause}").format(unit=unit, cause=row["message"]),
        )


def _of_unit(
    line: Flowsheet, solution: Solution, found: Findings, unit: str, speaks: bool
) -> Iterator[Fault]:
    if speaks:
        yield from _own_words(solution.records, unit)
    for k in line.links:
        if k.source_unit == unit:
            yield from _of_stream(line, solution, found, k.name)
    yield from _of_balance(line, found, unit)
    if not bool(found.figures[line.order.index(unit)]):
        yield from _of_figures(line, solution, unit)


def _of_stream(line: Flowsheet, solution: Solution, found: Findings, name: str) -> Iterator[Fault]:
    unit, i = line.link(name).source_unit, _place(line, name)
    if bool(found.finite[i]):
        yield from impossible(line, name, solution.streams[name], *(float(x[i]) for x in found[1:4]))
        return
    # a unit that is given no number gives none: the fault lies before it
    if unit and _unknown(line, found, unit):
        return
    text = _("{what} is not a finite number: check the inputs of that unit.")
    if unit and bool(jnp.isfinite(solution.streams[name].mass_flow)):
        text = _(
            "{what} has no temperature at which it carries the heat that is left for it: check the heat "
            "that goes in and out of that unit."
        )
    yield Fault("no value", unit, name, text.format(what=_what(line, name)))


def _what(line: Flowsheet, name: str) -> str:
    unit = line.link(name).source_unit
    return (
        _("Stream '{stream}' from unit '{unit}'").format(stream=name, unit=unit)
        if unit
        else _("Feed '{stream}'").format(stream=name)
    )


def impossible(
    line: Flowsheet, name: str, stream: Stream, lowest: float, saturation: float, temperature: float
) -> Iterator[Fault]:
    """What cannot be in a stream of finite numbers."""
    unit, what = line.link(name).source_unit, _what(line, name)
    if lowest < LEAST:
        phase, species, flow = _most_negative(stream)
        yield Fault(
            "stream",
            unit,
            name,
            _("{what} would carry {flow} kg/s of {species} ({phase}): a negative flow.").format(
                what=what, flow=format_number(flow), species=species, phase=_(phase)
            ),
        )
    if saturation > SATURATED:
        yield Fault(
            "stream",
            unit,
            name,
            _(
                "{what} would hold {share} times the vapor that saturates it at {temperature}: give it "
                "more gas or a higher temperature, or let it condense in a mixer of humid gases or a "
                "cooler with condensation."
            ).format(what=what, share=format_number(saturation), temperature=_kelvin(temperature)),
        )
    if not COLDEST + 1.0 < temperature < HOTTEST - 1.0:
        yield Fault(
            "stream",
            unit,
            name,
            _(
                "{what} would be at {temperature}, outside all that its properties are known for: check "
                "the heat that goes in and out."
            ).format(what=what, temperature=_kelvin(temperature)),
        )


def fault_in_time(
    line: Flowsheet,
    streams: Mapping[str, Stream],
    times: np.ndarray,
    records: Mapping[str, list[flags.Record]],
) -> tuple[float, Fault] | None:
    """The first instant of a course at which a unit has no solution or a stream is impossible, with what is
    wrong there; None when all is possible.
    """
    largest = np.max([np.asarray(jax.vmap(lambda s: s.mass_flow)(s)) for s in streams.values()], axis=0)
    largest = np.where(largest > 0, largest, 1.0)
    first: tuple[float, Fault] | None = None
    for unit in line.order:
        lost = [r for r in records.get(unit, []) if r.bit & WRONG]
        bad = np.any(
            [np.asarray(r.mask).reshape(len(times), -1).any(axis=1) for r in lost]
            or [np.zeros(len(times), bool)],
            axis=0,
        )
        at = int(np.argmax(bad))
        if bad.any() and (first is None or times[at] < first[0]):
            first = float(times[at]), next(_own_words({unit: lost}, unit))
    for k in line.links:
        s = streams[k.name]
        rows = (jax.vmap(_lowest)(s) / largest, _saturations(s, 1e-9 * jnp.asarray(largest)), s.temperature)
        lowest, saturation, temperature = map(np.asarray, rows)
        bad = (
            (lowest < LEAST)
            | (saturation > SATURATED)
            | ~((temperature > COLDEST + 1.0) & (temperature < HOTTEST - 1.0))
        )
        at = int(np.argmax(bad))
        if bad.any() and (first is None or times[at] < first[0]):
            then = jax.tree.map(lambda leaf, at=at: leaf[at], s)
            told = next(
                impossible(
                    line, k.name, then, float(lowest[at]), float(saturation[at]), float(temperature[at])
                )
            )
            first = float(times[at]), told
    return first


def _of_balance(line: Flowsheet, found: Findings, unit: str) -> Iterator[Fault]:
    i = line.order.index(unit)
    known = [
        bool(found.finite[_place(line, k.name)]) for k in line.links if unit in (k.source_unit, k.target_unit)
    ]
    if not all(known):
        return
    if not float(found.mass[i]) <= CLOSURE:
        row = np.asarray(found.by_component[i])
        worst = int(np.argmax(np.abs(row)))
        component = next(iter(line.feeds.values())).mixture.components[worst]
        yield Fault(
            "balance",
            unit,
            "",
            _(
                "Unit '{unit}' does not conserve {component}: {share} of what enters the unit is "
                "missing or too much."
            ).format(unit=unit, component=component, share=format_number(abs(float(row[worst])), 2)),
        )
    if not float(found.energy[i]) <= CLOSURE:
        yield Fault(
            "balance",
            unit,
            "",
            _(
                "Unit '{unit}' does not conserve energy: {share} % of what flows in and out is missing or "
                "too much, where {allowed} % is allowed. Its temperatures and duties cannot be used. Check "
                "its settings and the state of what enters; if both are ordinary, the model of the unit "
                "is at fault."
            ).format(
                unit=unit,
                share=format_number(100.0 * float(found.energy[i]), 2),
                allowed=format_number(100.0 * CLOSURE, 2),
            ),
        )


def _figures(line: Flowsheet, solution: Solution, unit: str) -> Iterator[tuple[Parameter, Kind, Any]]:
    """The quantities on the data sheet of a unit, where sheets were asked for."""
    if unit in solution.sheets and hasattr(type(line.units[unit]), "card"):
        values = solution.sheets[unit].figures
        for p, value in zip(type(line.units[unit]).card.outputs, values, strict=True):
            if value is not None and p.kind is not None:
                yield p, p.kind, value


def _possible_figures(line: Flowsheet, solution: Solution, unit: str) -> Any:
    rows = [
        (jnp.ravel(jnp.asarray(value, dtype=float)), *_bounds(kind))
        for _p, kind, value in _figures(line, solution, unit)
    ]
    if not rows:
        return jnp.asarray(True)
    low, high = (np.concatenate([np.full(row[0].shape, row[side]) for row in rows]) for side in (1, 2))
    values = jnp.concatenate([row[0] for row in rows])
    return jnp.all((values >= low) & (values <= high))


def _bounds(kind: Kind) -> tuple[float, float]:
    """The bounds of a quantity, widened by rounding; the largest finite numbers where it has none."""
    low, high = kind.lower - 1e-9 * max(abs(kind.lower), 1.0), kind.upper + 1e-9 * max(abs(kind.upper), 1.0)
    most = np.finfo(float).max
    return (low if np.isfinite(low) else -most), (high if np.isfinite(high) else most)


def _of_figures(line: Flowsheet, solution: Solution, unit: str) -> Iterator[Fault]:
    for p, kind, value in _figures(line, solution, unit):
        array, (low, high) = np.ravel(np.asarray(value, dtype=float)), _bounds(kind)
        bad = array[~((array >= low) & (array <= high))]
        if not bad.size:
            continue
        told = _("'{figure}' of unit '{unit}' would be {value}, which is not possible.")
        if not np.isfinite(bad[0]):
            told = _("'{figure}' of unit '{unit}' is not a finite number.")
        yield Fault(
            "figure", unit, "", told.format(figure=p.label, unit=unit, value=show(float(bad[0]), kind))
        )


def _most_negative(s: Stream) -> tuple[str, str, float]:
    flows = {
        "solid": s.solid_by_species if s.mixture.solids else np.zeros(0),
        "liquid": s.liquid,
        "gas": s.gas,
    }
    if s.mixture.solids:  # a class may be negative though its species is not
        flows["solid"] = np.min(np.reshape(np.asarray(s.solid), (len(s.mixture.solids), -1)), axis=1)
    rows = [(float(f), phase, i) for phase, row in flows.items() for i, f in enumerate(np.asarray(row))]
    flow, phase, i = min(rows)
    return phase, getattr(s.mixture, PHASES[phase])[i].name, flow


def _kelvin(value: Any) -> str:
    return show(float(value), KINDS["Temperature"])
