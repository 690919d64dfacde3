"""Solving a line: units in order, loops by fixed point on the torn streams, exact derivatives through both."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.core import flags
from granum.flowsheet.plan import Block
from granum.flowsheet.sheet import Flowsheet
from granum.numerics import fixed_point
from granum.streams.audit import Closure, closure
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream, empty

TEMPERATURE_SCALE = 100.0  # K: brings the temperature of a torn stream to the size of the scaled flows
TOLERANCE = 1e-12


class Solution(NamedTuple):
    """A solved line.

    Parameters
    ----------
    streams: every stream by name.
    powers: heat and work taken up by each unit, W, as ``{unit: {name: value}}``.
    converged: whether every loop converged (True without loops).
    steps: iterations of each loop. residual: largest scaled change of a torn stream in each loop.
    records: what each unit's formulas flagged at the solution.
    """

    streams: dict[str, Stream]
    powers: dict[str, dict[str, Any]]
    converged: Any
    steps: tuple[Any, ...]
    residual: tuple[Any, ...]
    records: dict[str, list[flags.Record]]


def _pack(stream: Stream, scale: Any) -> Any:
    flows = jnp.concatenate([jnp.ravel(stream.solid), stream.liquid, stream.gas]) / scale
    return jnp.concatenate([flows, jnp.reshape(stream.temperature / TEMPERATURE_SCALE, (1,))])


def _unpack(vector: Any, mixture: Mixture, pressure: Any, scale: Any) -> Stream:
    shape = mixture.solid_shape
    count = 1
    for n in shape:
        count *= n
    solid, liquid, gas = jnp.split(vector[:-1] * scale, [count, count + len(mixture.liquids)])
    return Stream(solid.reshape(shape), liquid, gas, vector[-1] * TEMPERATURE_SCALE, pressure, mixture)


def _run_unit(line: Flowsheet, unit: str, streams: dict[str, Stream]) -> tuple[dict[str, Stream], dict[str, Any], list[flags.Record]]:
    thing = line.units[unit]
    with flags.collect() as records:
        out = thing(**line.inlets_of(unit, streams))
    made = {k.name: getattr(out, k.origin.partition(".")[2]) for k in line.links if k.source_unit == unit}
    return made, {name: getattr(out, name) for name in thing.power_names()}, records


class _Made(NamedTuple):
    streams: dict[str, Stream]
    powers: dict[str, dict[str, Any]]
    records: dict[str, list[flags.Record]]


def _run_block(line: Flowsheet, block: Block, streams: dict[str, Stream]) -> _Made:
    streams, powers, records = dict(streams), {}, {}
    made: dict[str, Stream] = {}
    for unit in block.units:
        new, powers[unit], records[unit] = _run_unit(line, unit, streams)
        made |= new
        streams |= {name: s for name, s in new.items() if name not in block.tears}
    return _Made(made, powers, records)


def solve(line: Flowsheet, start: Mapping[str, Stream] | None = None) -> Solution:
    """Solve a line. Pure: may be jitted, batched with ``vmap`` and differentiated.

    Parameters
    ----------
    line: the flowsheet.
    start: first guesses for torn streams (empty streams otherwise).
    """
    start = start or {}
    streams: dict[str, Stream] = dict(line.feeds)
    powers: dict[str, dict[str, Any]] = {}
    records: dict[str, list[flags.Record]] = {}
    converged, steps, residual = jnp.asarray(True), [], []
    any_feed = next(iter(line.feeds.values()))
    scale = sum((s.mass_flow for s in line.feeds.values()), jnp.zeros(()))
    scale = jax.lax.stop_gradient(jnp.where(scale > 0, scale, 1.0))
    for block in line.blocks:
        if block.tears:
            warmest = jnp.mean(jnp.stack([s.temperature for s in line.feeds.values()]))
            guess = {n: start.get(n, empty(any_feed.mixture, warmest, any_feed.pressure)) for n in block.tears}

            def unpacked(vector: Any, guess: dict[str, Stream] = guess, names: tuple[str, ...] = block.tears) -> dict[str, Stream]:
                return {n: _unpack(vector[i], guess[n].mixture, guess[n].pressure, scale) for i, n in enumerate(names)}

            def once(vector: Any, _args: Any, block: Block = block, known: dict[str, Stream] = streams, unpacked: Any = unpacked) -> Any:
                made = _run_block(line, block, known | unpacked(vector)).streams
                return jnp.stack([_pack(made[n], scale) for n in block.tears])

            found = fixed_point(once, jnp.stack([_pack(guess[n], scale) for n in block.tears]), tolerance=TOLERANCE, scale=1.0)
            streams = streams | unpacked(found.state)
            converged = converged & found.converged
            steps.append(found.steps)
            residual.append(found.residual)
        made = _run_block(line, block, streams)
        streams = streams | {name: s for name, s in made.streams.items() if name not in block.tears}
        powers |= made.powers
        records |= made.records
    return Solution(streams, powers, converged, tuple(steps), tuple(residual), records)


solve_compiled = eqx.filter_jit(solve)


def unit_closures(line: Flowsheet, solution: Solution) -> dict[str, Closure]:
    """Mass and energy closure of every unit."""
    rows = {}
    for unit in line.order:
        out = [solution.streams[k.name] for k in line.links if k.source_unit == unit]
        power = sum(solution.powers[unit].values(), jnp.zeros(()))
        rows[unit] = closure(line.inlets_of(unit, solution.streams).values(), out, power)
    return rows


def line_closure(line: Flowsheet, solution: Solution) -> Closure:
    """Mass and energy closure of the whole line: feeds against products."""
    power = sum((p for unit in solution.powers.values() for p in unit.values()), jnp.zeros(()))
    return closure(line.feeds.values(), [solution.streams[n] for n in line.products], power)
