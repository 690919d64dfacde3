"""A line in time: start-up and disturbances. Units with a holdup march, the others follow at once.

Each step solves the line at its end: torn streams by the same fixed point as in the steady state, holdups by
their own exact step for inlets that change linearly over it. Second order in the step.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.flowsheet.labelled import stream_dataset
from granum.flowsheet.passing import Made, pass_through, told
from granum.flowsheet.plan import Block
from granum.flowsheet.sheet import Flowsheet
from granum.flowsheet.solving import TOLERANCE, pack, solve, unpack
from granum.numerics import settle
from granum.streams.stream import Stream, empty
from granum.streams.units import Dynamic, Operated

if TYPE_CHECKING:
    import xarray as xr


class Profile(NamedTuple):
    """A parameter over time, straight between points and constant outside: ``feed.mass_flow`` scales a feed,
    ``unit.parameter`` is set.
    """

    path: str
    times: Any
    values: Any

    def at(self, time: Any) -> Any:
        """The value at a time."""
        return jnp.interp(time, jnp.asarray(self.times, dtype=float), jnp.asarray(self.values, dtype=float))


class Course(NamedTuple):
    """A line over time: every stream with a leading axis of times.

    Parameters
    ----------
    times: s. streams: by name, arrays with a leading axis of times.
    holdups: the state of each unit that has one, at the end.
    converged: whether the loops converged at each time, all streams being finite. balance: relative mass
        imbalance of feeds, products and holdups over the whole run.
    records: what each unit's formulas flagged, with a leading axis of times.
    """

    times: Any
    streams: dict[str, Stream]
    holdups: dict[str, Any]
    converged: Any
    balance: Any
    records: dict[str, list[flags.Record]]

    @property
    def flags(self) -> list[dict[str, Any]]:
        """What was flagged at any time, with the unit's name."""
        return told(self.records)

    def to_xarray(self) -> xr.Dataset:
        """Every stream by species and size class over time, SI."""
        return stream_dataset(self.streams, self.times)


class _Instant(NamedTuple):
    streams: dict[str, Stream]
    states: dict[str, Any]


class _Step(NamedTuple):
    made: Made
    states: dict[str, Any]


def _with_profiles(line: Flowsheet, profiles: tuple[Profile, ...], time: Any) -> Flowsheet:
    changes = {}
    for p in profiles:
        head, _dot, name = p.path.partition(".")
        if head in line.feeds and name == "mass_flow":
            feed = line.feeds[head]
            share = p.at(time) / feed.mass_flow
            changes |= {
                f"{head}.{phase}": getattr(feed, phase) * share for phase in ("solid", "liquid", "gas")
            }
        else:
            changes[p.path] = p.at(time)
    return line.with_values(changes)


def check_profiles(line: Flowsheet, profiles: tuple[Profile, ...]) -> None:
    """Refuse profiles of unknown parameters or with times that do not increase."""
    for p in profiles:
        head, _dot, name = p.path.partition(".")
        if not (head in line.feeds and name == "mass_flow"):
            line.locate(p.path)
        shape = jnp.asarray(p.times).shape
        if shape != jnp.asarray(p.values).shape or len(shape) != 1 or not _increasing(p.times):
            raise InputError(
                _("The profile of '{path}' needs as many values as times, and times that increase.").format(
                    path=p.path
                )
            )


def check_start(line: Flowsheet, start: str | Mapping[str, Any]) -> dict[str, Any]:
    """How each unit with a holdup starts, where it is told; refuses unknown words and units without a
    holdup.
    """
    holding = [n for n, u in line.units.items() if isinstance(u, Dynamic)]
    told = dict.fromkeys(holding, start) if isinstance(start, str) else dict(start)
    words = {start} if isinstance(start, str) else {at for at in told.values() if isinstance(at, str)}
    for word in words - {"steady", "empty"}:
        raise unknown_name(_("Start"), word, ("steady", "empty"))
    for name in told:
        if name not in holding:
            raise unknown_name(_("Unit with a holdup"), name, holding)
    return told


def _increasing(times: Any) -> bool:
    """Whether times increase; traced ones were seen before."""
    return isinstance(times, jax.core.Tracer) or bool(np.all(np.diff(np.asarray(times, dtype=float)) > 0))


def march(
    line: Flowsheet,
    times: Any,
    profiles: tuple[Profile, ...] = (),
    *,
    start: str | Mapping[str, Any] = "steady",
) -> Course:
    """Follow a line over equally spaced times. Pure but for its checks; compile it with
    ``eqx.filter_jit``.

    Parameters
    ----------
    line: the flowsheet; units that are ``Dynamic`` hold matter, the others answer at once.
    times: s, equally spaced; the first is the start.
    profiles: disturbances, as parameters or feed flows over time.
    start: ``steady`` (holdups in the steady state of the first instant), ``empty`` (holdups as the units
        declare for a start-up), or either of the two, or the holdup itself, by unit, those left out being as
        for a start-up.
    """
    check_profiles(line, profiles)
    holding = {n: u for n, u in line.units.items() if isinstance(u, Dynamic)}
    starts = check_start(line, start)
    times = jnp.asarray(times, dtype=float)
    step = times[1] - times[0]
    first = _with_profiles(line, profiles, times[0])
    scale = jnp.maximum(sum((s.mass_flow for s in line.feeds.values()), jnp.zeros(())), 1e-12)
    streams, begun = {k.name: _floats(empty(_mixture(line), 298.15)) for k in line.links}, jnp.asarray(True)
    states = {n: first.units[n].initial_holdup(_mixture(line)) for n in holding}  # type: ignore[attr-defined]
    if "steady" in (at for at in starts.values() if isinstance(at, str)):
        standing = solve(first)
        streams, begun = {n: _floats(s) for n, s in standing.streams.items()}, standing.converged
    for n, at in starts.items():
        if not isinstance(at, str):
            states[n] = at
        elif at == "steady":
            states[n] = first.units[n].steady_holdup(first.inlets_of(n, streams))  # type: ignore[attr-defined]
    prepared, still = (
        {n: u.prepare(_mixture(line), h) for n, u in holding.items()} for h in (step, 0.0 * step)
    )
    torn = {n for block in line.blocks for n in block.tears}

    def advance(
        carry: tuple[_Instant, Any, dict[str, Stream]], given: tuple[Any, Any]
    ) -> tuple[Any, tuple[Any, ...]]:
        """One step, or, at first, no step: the streams that belong to the holdups at the start."""
        before, passed, earlier = carry
        time, begins = given
        now, h = _with_profiles(line, profiles, time), (1.0 - begins) * step
        ready = _chosen(begins, still, prepared)
        ahead = {n: _ahead(earlier[n], before.streams[n]) for n in torn}
        after, records, converged = _instant(now, before, begins, ready, h, ahead, scale)
        passed = passed + 0.5 * h * (_net(line, before.streams) + _net(line, after.streams))
        return (after, passed, {n: _chosen(begins, after, before).streams[n] for n in torn}), (
            after.streams,
            converged,
            records,
        )

    begin = _Instant(streams, jax.tree.map(lambda leaf: jnp.asarray(leaf, dtype=float), states))
    carry = (begin, jnp.zeros(()), {n: streams[n] for n in torn})
    (last, passed, _torn), (whole, converged, records) = jax.lax.scan(
        advance, carry, (times, jnp.where(jnp.arange(len(times)) == 0, 1.0, 0.0))
    )
    held = sum(
        (line.units[n].held_mass(last.states[n]) - line.units[n].held_mass(states[n]) for n in states),
        jnp.zeros(()),
    )  # type: ignore[attr-defined]
    converged = converged.at[0].set(converged[0] & begun)
    return Course(
        times,
        whole,
        last.states,
        converged,
        jnp.abs(passed - held) / (scale * (times[-1] - times[0])),
        records,
    )


def _floats(stream: Stream) -> Stream:
    return jax.tree.map(lambda leaf: jnp.asarray(leaf, dtype=float), stream)


def _chosen(begins: Any, a: Any, b: Any) -> Any:
    """The first at the first instant (1.0, a number so that loops may be solved around it), the other later
    (0.0).
    """
    return jax.tree.map(lambda x, y: jnp.where(begins > 0.5, x, y), a, b)


def _ahead(earlier: Stream, before: Stream) -> Stream:
    """A torn stream a step on, if it goes on changing as it did."""
    on = jax.tree.map(lambda a, b: 2.0 * b - a, earlier, before)
    return on.replace(
        solid=jnp.maximum(on.solid, 0.0), liquid=jnp.maximum(on.liquid, 0.0), gas=jnp.maximum(on.gas, 0.0)
    )


def _mixture(line: Flowsheet) -> Any:
    return next(iter(line.feeds.values())).mixture


def _net(line: Flowsheet, streams: Mapping[str, Stream]) -> Any:
    flow = jnp.zeros(())
    for k in line.links:
        flow = (
            flow
            + (0.0 if k.origin else streams[k.name].mass_flow)
            - (0.0 if k.target else streams[k.name].mass_flow)
        )
    return flow


def _instant(
    line: Flowsheet,
    before: _Instant,
    begins: Any,
    prepared: dict[str, Any],
    step: Any,
    torn: dict[str, Stream],
    scale: Any,
) -> tuple[_Instant, dict[str, list[flags.Record]], Any]:
    """All streams and holdups at the end of a step, what was flagged on the way, and whether the loops came
    to rest.
    """
    found, records = _Instant(dict(line.feeds), {}), {}
    good = jnp.asarray(True)

    def one_pass(block: Block, known: dict[str, Stream]) -> _Step:
        states: dict[str, Any] = {}

        def operate(name: str, inlets: dict[str, Stream]) -> Operated:
            thing = line.units[name]
            if not isinstance(thing, Dynamic):
                return thing.operate(**inlets)
            earlier = _chosen(begins, inlets, line.inlets_of(name, before.streams))
            with flags.collect() as told_here:
                states[name], outlets = thing.advance(
                    before.states[name], earlier, inlets, step, prepared[name]
                )
            return Operated(outlets, None, (), None, told_here, {})

        return _Step(pass_through(line, block, known, operate), states)

    for block in line.blocks:
        if not block.tears:
            now = one_pass(block, found.streams)
        else:
            guess = {n: torn[n] for n in block.tears}

            def unpacked(vector: Any, guess: dict[str, Stream] = guess) -> dict[str, Stream]:
                rows = vector.reshape(len(guess), -1)
                return {n: unpack(rows[i], s.mixture, scale) for i, (n, s) in enumerate(guess.items())}

            def once(
                vector: Any,
                block: Block = block,
                unpacked: Any = unpacked,
                guess: dict[str, Stream] = guess,
            ) -> tuple[Any, _Step]:
                now = one_pass(block, found.streams | unpacked(vector))
                rows = [
                    pack(now.made.streams[n].replace(pressure=s.pressure), scale) for n, s in guess.items()
                ]
                return jnp.concatenate(rows), now

            solved = settle(
                once, jnp.concatenate([pack(s, scale) for s in guess.values()]), tolerance=1e2 * TOLERANCE
            )
            now = solved.made
            now.made.streams.update(unpacked(solved.state))
            good = good & solved.converged
        found.streams.update(now.made.streams)
        found.states.update(now.states)
        records |= now.made.records
    streams = {k.name: _floats(found.streams[k.name]) for k in line.links}
    # too long a step may burst a holdup
    finite = jnp.isfinite(jnp.stack([s.mass_flow + s.temperature for s in streams.values()]))
    return _Instant(streams, found.states), records, good & jnp.all(finite)
