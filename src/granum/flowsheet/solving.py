"""Solving a line: units in order, loops by fixed point on the torn streams, exact derivatives through
both.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from itertools import accumulate
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.flowsheet import returning
from granum.flowsheet.passing import Made, is_known, known_or, pass_through, where
from granum.flowsheet.plan import Block
from granum.flowsheet.returning import Loop
from granum.flowsheet.sheet import Flowsheet
from granum.numerics import Anderson, Chords, Continuation, Seeking, Settled, settle
from granum.numerics.fixed_points import largest
from granum.numerics.settled import Turns, again, knowledge
from granum.streams import audit
from granum.streams.audit import Closure
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream, empty
from granum.streams.units import Operated, Sheet

TEMPERATURE_SCALE = 100.0  # K: brings the temperature of a torn stream to the size of the scaled flows
PRESSURE_SCALE = 2.0**17  # Pa: the same for its pressure, exactly
TOLERANCE = 1e-12
MISSES = 1e-2  # what a wanted figure may miss is so much more than what a torn stream may
NEARLY = 1e-5  # a loop so near to rest is not what is wrong when a figure cannot be had

Method = Anderson | Continuation | Chords
QUICK_METHOD = Anderson(window=8)
"""Whole lines remember more passes than a unit does: a pass costs far more than what is learned from it."""
FILLING = 4
"""Plain passes through a loop that begins empty."""


class Solution(NamedTuple):
    """A solved line.

    Parameters
    ----------
    streams: every stream by name.
    powers: heat and work taken up by each unit, W, as ``{unit: {name: value}}``.
    converged: whether every loop converged (True without loops).
    steps: iterations of each loop. residual: largest scaled change of a torn stream in each loop.
    records: what each unit's formulas flagged at the solution.
    sheets: figures, checks and utilities of each unit, when asked for.
    met: whether what was wanted was found as well. sought: the parameters found, each within 0 … 1.
    known: all that the solver of each loop knows, to go on from there.
    carried: how the pressure of each torn stream was come by, see ``returning``.
    """

    streams: dict[str, Stream]
    powers: dict[str, dict[str, Any]]
    converged: Any
    steps: tuple[Any, ...]
    residual: tuple[Any, ...]
    records: dict[str, list[flags.Record]]
    sheets: dict[str, Sheet]
    met: Any = True
    sought: Any = None
    known: tuple[Any, ...] = ()
    carried: Mapping[str, Any] = {}


def pack(stream: Stream, scale: Any) -> Any:
    """Flows, temperature and pressure of a torn stream as a vector of numbers of about one."""
    flows = jnp.concatenate([jnp.ravel(stream.solid), stream.liquid, stream.gas]) / scale
    state = [stream.temperature / TEMPERATURE_SCALE, stream.pressure / PRESSURE_SCALE]
    return jnp.concatenate([flows, jnp.stack([jnp.asarray(x, dtype=float) for x in state])])


def unpack(vector: Any, mixture: Mixture, scale: Any) -> Stream:
    """The stream again."""
    shape = mixture.solid_shape
    count = 1
    for n in shape:
        count *= n
    solid, liquid, gas = jnp.split(vector[:-2] * scale, [count, count + len(mixture.liquids)])
    temperature, pressure = vector[-2] * TEMPERATURE_SCALE, vector[-1] * PRESSURE_SCALE
    return Stream(solid.reshape(shape), liquid, gas, temperature, pressure, mixture)


def _run_loop(
    line: Flowsheet,
    block: Block,
    streams: dict[str, Stream],
    guess: dict[str, Stream],
    scale: Any,
    sheeted: Collection[str],
    wanted: Wanted | None,
    method: Method,
    max_steps: int,
    known: Any,
    carried: Mapping[str, Any],
) -> tuple[Made, Settled, Any]:
    """A loop, solved, with what is wanted of it. Last the residuals: of each torn stream, and of what is
    wanted.
    """
    # nothing flows from a unit that has no answer yet, such as a dryer whose gas is still to come round
    first = next(iter(line.feeds.values()))
    nothing = empty(first.mixture, first.temperature, first.pressure)
    guess = {n: known_or(s, nothing) for n, s in guess.items()}
    begun = jnp.zeros((0,)) if wanted is None else jnp.asarray(wanted.start, dtype=float)

    loop = _loop(line, block)
    if isinstance(method, Anderson):
        flows = jnp.stack([s.mass_flow for s in guess.values()] or [jnp.ones(())])
        method = replace(method, plain=jnp.where(jnp.any(flows > 0.0), 0, FILLING))

    def torn(vector: Any) -> dict[str, Stream]:
        rows = vector[: loop.count * loop.row].reshape(loop.count, loop.row)
        # steps that look ahead may pass zero; units are not made for less than nothing
        rows = jnp.where(rows < 0.0, 0.0, rows)
        return {n: unpack(rows[i], guess[n].mixture, scale) for i, n in enumerate(block.tears)}

    def once(vector: Any) -> tuple[Any, Any]:
        sought = vector[vector.size - begun.size :]
        changed = line if wanted is None else wanted.line(sought)
        fed = {} if wanted is None else changed.feeds

        def asked(unit: str, inlets: dict[str, Stream]) -> Operated:
            return changed.units[unit].operate(unit in sheeted, **inlets)

        made = pass_through(changed, block, streams | fed | torn(vector), asked, nothing)
        come = {n: known_or(made.streams[n], nothing) for n in block.tears}
        modes = jnp.round(loop.modes(vector))  # slopes measured by a small change are those of a constant
        given = next(iter(changed.feeds.values())).pressure
        taken = {
            n: s.replace(pressure=jnp.where(modes[i] == returning.CARRIED, s.pressure, given))
            for i, (n, s) in enumerate(come.items())
        }
        rows = [pack(s, scale) for s in taken.values()]
        aims = [] if wanted is None else [sought - MISSES * wanted.misses(made.sheets, made.streams)]
        image = jnp.concatenate([*rows, modes, *aims])
        parts = [*rows, modes]
        apart = jnp.split(image - vector, list(accumulate(part.size for part in parts)))
        back = jnp.stack([jnp.asarray(s.pressure) / PRESSURE_SCALE for s in come.values()] or [jnp.zeros(())])
        return image, (made, jnp.stack([largest(part) for part in (*apart[:-2], apart[-1])]), back)

    begin = [
        *(pack(guess[n], scale) for n in block.tears),
        *(jnp.asarray(carried.get(n, 0.0)) for n in block.tears),
    ]
    start = jnp.concatenate([jnp.ravel(part) for part in (*begin, begun)])
    found = settle(
        once,
        start,
        method=_with_parameters(method, begun.size),
        tolerance=TOLERANCE,
        max_steps=max_steps,
        known=known,
        turns=_turns(loop),
    )
    made, left, back = found.made
    told = {n: is_known(s) for n, s in made.streams.items()}
    at_rest = {n: where(told[n], s, made.streams[n]) for n, s in torn(found.state).items()}
    records = dict(made.records)
    for i, (n, s) in enumerate(at_rest.items()):
        unit = line.link(n).source_unit
        card = getattr(type(line.units[unit]), "card", None)
        off = returning.told(back[i] * PRESSURE_SCALE, s.pressure, card.key if card else "")
        records[unit] = [*records[unit], off]
    return (
        made._replace(streams=made.streams | at_rest, records=records),
        found._replace(converged=found.converged & jnp.all(jnp.stack([*told.values()]))),
        jax.lax.stop_gradient(left),
    )


def _loop(line: Flowsheet, block: Block) -> Loop:
    mixture = next(iter(line.feeds.values())).mixture
    row = int(np.prod(mixture.solid_shape)) + len(mixture.liquids) + len(mixture.gases) + 2
    return Loop(len(block.tears), row)


def _turns(loop: Loop) -> Turns | None:
    return returning.turns(loop, lambda made: made[2]) if loop.count else None


class Wanted(NamedTuple):
    """What a line is wanted to give: parameters to find, and the figures that they are found for.

    start: of the parameters, each within 0 … 1. line: the line at such parameters. misses: by how much the
    figures miss, from the sheets of the units and the streams. units: those whose figures are asked for.
    among: all units between which cause and effect lie, and feeds.
    """

    start: Any
    line: Callable[[Any], Flowsheet]
    misses: Callable[[Any, Any], Any]
    units: frozenset[str]
    among: frozenset[str]


def _joined(line: Flowsheet, among: frozenset[str]) -> tuple[tuple[Block, bool], ...]:
    """The blocks of a line, those between cause and effect of what is wanted made one; and whether it is that
    one.
    """
    blocks = line.blocks
    if not among:
        return tuple((block, False) for block in blocks)
    entered = {k.target_unit for k in line.links if k.name in among and not k.origin}
    named = {i for i, block in enumerate(blocks) if (among | entered).intersection(block.units)}
    first, last = min(named), max(named) + 1
    middle = blocks[first:last]
    one = Block(tuple(u for b in middle for u in b.units), tuple(t for b in middle for t in b.tears))
    return (*((b, False) for b in blocks[:first]), (one, True), *((b, False) for b in blocks[last:]))


def solve(
    line: Flowsheet,
    start: Mapping[str, Stream] | None = None,
    *,
    sheets: bool | Collection[str] = False,
    wanted: Wanted | None = None,
    method: Method = QUICK_METHOD,
    max_steps: int = 200,
    known: tuple[Any, ...] | None = None,
    carried: Mapping[str, Any] | None = None,
) -> Solution:
    """Solve a line. Pure: may be jitted, batched with ``vmap`` and differentiated.

    Parameters
    ----------
    line: the flowsheet.
    start: first guesses for torn streams (empty streams otherwise).
    sheets: also work out figures and checks: of every unit, of none, or of those named.
    wanted: parameters to find together with the loops, see ``design``.
    method: how loops are brought to rest: ``Anderson``, or ``Continuation``, which finds what is wanted in
        the same steps, with exact derivatives; it compiles longer and solves loops that do not contract; or
        ``Chords``, for many neighbors of one case, which hands on what it learned of slopes.
        max_steps: most passes through a loop, or steps of ``Continuation``.
    known: of an earlier solution by the same method, to go on from there; ``nothing_known`` to begin.
    carried: of an earlier solution from whose streams it starts.
    """
    start = start or {}
    streams: dict[str, Stream] = dict(line.feeds)
    whole = Made(streams, {}, {}, {})
    converged, met, sought, steps, residual = jnp.asarray(True), jnp.asarray(True), None, [], []
    left_off: list[Any] = []
    modes: dict[str, Any] = {}
    of = frozenset(line.units if sheets is True else sheets or ())
    of = of if wanted is None else of | wanted.units

    def asked(unit: str, inlets: dict[str, Stream]) -> Operated:
        return line.units[unit].operate(unit in of, **inlets)

    scale = sum((s.mass_flow for s in line.feeds.values()), jnp.zeros(()))
    scale = jax.lax.stop_gradient(jnp.where(scale > 0, scale, 1.0))
    for block, aimed in _joined(line, frozenset() if wanted is None else wanted.among):
        if block.tears or aimed:
            guess = {n: start[n] if n in start else no_stream(line) for n in block.tears}
            made, found, left = _run_loop(
                line,
                block,
                streams,
                guess,
                scale,
                of,
                wanted if aimed else None,
                method,
                max_steps,
                None if known is None else known[len(left_off)],
                carried or {},
            )
            left_off.append(found.known)
            modes |= zip(block.tears, _loop(line, block).modes(found.state), strict=True)
            if aimed and wanted is not None:
                sought = found.state[found.state.size - len(wanted.start) :]
                met = found.converged & jnp.all((sought >= 0.0) & (sought <= 1.0))
                whole.streams.update(wanted.line(sought).feeds)
                converged = converged & jnp.all(left[:-1] <= NEARLY)
            else:
                converged = converged & found.converged
            for tears in (b.tears for b in line.blocks if b.tears and set(b.tears) <= set(block.tears)):
                steps.append(found.steps)
                residual.append(jnp.max(jnp.stack([left[block.tears.index(t)] for t in tears])))
        else:
            made = pass_through(line, block, streams, asked)
        whole.streams.update(made.streams)
        whole.powers.update(made.powers)
        whole.records.update(made.records)
        whole.sheets.update(made.sheets)
    return Solution(
        streams,
        whole.powers,
        converged,
        tuple(steps),
        tuple(residual),
        whole.records,
        whole.sheets,
        met & converged,
        sought,
        tuple(left_off),
        modes,
    )


def no_stream(line: Flowsheet) -> Stream:
    """An empty stream as warm as the feeds, from which a loop is begun."""
    feeds = list(line.feeds.values())
    return empty(feeds[0].mixture, jnp.mean(jnp.stack([s.temperature for s in feeds])), feeds[0].pressure)


def _with_parameters(method: Method, count: int) -> Seeking | Method:
    if isinstance(method, Continuation):
        return Continuation(count)
    if isinstance(method, Chords):
        return Chords(count, TOLERANCE)
    return Seeking(count, method, TOLERANCE) if count else method


def nothing_known(line: Flowsheet, method: Method, among: frozenset[str], count: int) -> tuple[Any, ...]:
    """What a solver begins with that is called for some passes at a time, ``count`` parameters being wanted
    ``among`` units.
    """
    return tuple(
        np.zeros(knowledge(how, size, turns))
        for how, size, turns in _sought_at_once(line, method, among, count)
    )


def unknowns(line: Flowsheet, among: frozenset[str], count: int) -> int:
    """How many numbers are sought together at most."""
    return max((size for _how, size, _turns in _sought_at_once(line, QUICK_METHOD, among, count)), default=0)


def neighbor(line: Flowsheet, known: tuple[Any, ...], among: frozenset[str], count: int) -> tuple[Any, ...]:
    """What ``Chords`` left of one case, for another one to begin with."""
    sought = _sought_at_once(line, Chords(), among, count)
    return tuple(
        again(how, left, size, turns) for (how, size, turns), left in zip(sought, known, strict=True)
    )


def _sought_at_once(
    line: Flowsheet, method: Method, among: frozenset[str], count: int
) -> list[tuple[Any, int, Turns | None]]:
    """The solver of each loop, and of what is wanted, with the number of its unknowns."""
    loops = [
        (_loop(line, block), count * aimed) for block, aimed in _joined(line, among) if block.tears or aimed
    ]
    return [
        (_with_parameters(method, wanted), loop.count * (loop.row + 1) + wanted, _turns(loop))
        for loop, wanted in loops
    ]


solve_compiled = eqx.filter_jit(solve)


def unit_closures(line: Flowsheet, solution: Solution) -> dict[str, Closure]:
    """Mass and energy closure of every unit."""
    found, _whole = closures(line, solution)
    return found


def line_closure(line: Flowsheet, solution: Solution) -> Closure:
    """Mass and energy closure of the whole line: feeds against products."""
    _units, whole = closures(line, solution)
    return whole


def closures(line: Flowsheet, solution: Solution) -> tuple[dict[str, Closure], Closure]:
    """Closure of every unit and of the whole line, all streams at once."""
    mass, energy, by_component = balances(line, solution, stacked(line, solution))
    rows = [Closure(mass[i], energy[i], by_component[i]) for i in range(len(line.order) + 1)]
    return dict(zip(line.order, rows[:-1], strict=True)), rows[-1]


def stacked(line: Flowsheet, solution: Solution) -> Stream:
    """All streams as one, along a leading axis in the order of ``line.links``."""
    named = (solution.streams[k.name] for k in line.links)
    return jax.tree.map(
        lambda *leaves: jnp.stack([jnp.asarray(leaf, dtype=float) for leaf in leaves]), *named
    )


def balances(line: Flowsheet, solution: Solution, streams: Stream) -> Closure:
    """Closure of each unit, then of the whole line."""
    entering = np.array(
        [[k.target_unit == unit for k in line.links] for unit in line.order]
        + [[not k.origin for k in line.links]]
    )
    leaving = np.array(
        [[k.source_unit == unit for k in line.links] for unit in line.order]
        + [[not k.target for k in line.links]]
    )
    powers = [sum(solution.powers[unit].values(), 0.0) for unit in line.order]
    powers = jnp.stack([jnp.asarray(p, dtype=float) for p in [*powers, sum(powers, 0.0)]])
    return _closures(streams, entering.astype(float), leaving.astype(float), powers)


@jax.jit
def _closures(streams: Stream, entering: Any, leaving: Any, powers: Any) -> Closure:
    components, enthalpies = jax.vmap(lambda s: (s.components, s.enthalpy_flow))(streams)
    return audit.closures(components, enthalpies, entering, leaving, powers)
