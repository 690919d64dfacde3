"""From the quick solver to the exact one: a line is tried with each until it has a solution that stands."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

from granum.core.i18n import _
from granum.core.packing import as_arrays, compiled
from granum.core.units import format_number, show
from granum.flowsheet.findings import Fault, Findings, faults, findings, sound
from granum.flowsheet.sheet import Flowsheet
from granum.flowsheet.solving import QUICK_METHOD, neighbor, no_stream, nothing_known, solve, unknowns
from granum.flowsheet.specifications import (
    Designed,
    Target,
    among,
    design,
    figure,
    looked_at,
    unit_of,
    varied,
)
from granum.flowsheet.stream_figures import changed, given_value
from granum.flowsheet.watching import Watch
from granum.numerics import Anderson, Chords, Continuation
from granum.streams.stream import Stream


class Tried(NamedTuple):
    """What one solver found, what was measured on it, and whether it stands."""

    designed: Designed
    findings: Findings
    stands: Any


EXACT: dict[str, Any] = {"method": Continuation(), "max_steps": 60}
RUNGS = 2
QUICK = 80
"""Passes of the quick solver, and again for each specification, before exact derivatives take over."""
PATIENCE = 30
"""Passes in which the residual of a loop falls tenfold where the quick solver will do."""
FIRST = 10
"""Passes through the loops before anybody looks how far they are."""
PAUSE = 1.0
"""Seconds of passes between two looks, where these change nothing."""
ALONG_CHORDS: dict[str, Any] = {"method": Chords(), "max_steps": 10_000}
WIDEST = 400
"""Unknowns of a loop whose slopes are worth measuring one by one."""


class Beginning(NamedTuple):
    """Where the search for a solution begins: torn streams, values to be found, how pressures of torn streams
    were come by, and what a solver for neighbors learned on the way to an earlier one, if there is one.
    """

    torn: dict[str, Stream]
    near: dict[str, Any]
    carried: Mapping[str, Any]
    learned: tuple[Any, ...] = ()

    def how(self) -> dict[str, Any]:
        """For ``design``."""
        return {"start": self.torn, "near": self.near, "carried": self.carried}


def beginning(
    sheet: Flowsheet, targets: tuple[Target, ...], left: Designed | None = None, *, among_many: bool = False
) -> Beginning:
    """Empty streams and the values that the line has, or what an earlier solution left.

    ``among_many``: for one of many neighbors, solved one after the other.
    """
    torn = [name for block in sheet.blocks for name in block.tears]
    asked = among(sheet, targets), len(targets)
    learns = among_many and 0 < unknowns(sheet, *asked) <= WIDEST
    if left is not None:
        streams, known = left.solution.streams, left.solution.known
        learned = neighbor(sheet, known, *asked) if learns else ()
        return Beginning(
            {name: streams[name] for name in torn}, dict(left.values), left.solution.carried, learned
        )
    nothing = no_stream(sheet)
    own = {t.vary: given_value(sheet, t.vary) for t in targets}
    return Beginning(
        dict.fromkeys(torn, nothing),
        {name: np.asarray(np.nan if value is None else value, float) for name, value in own.items()},
        dict.fromkeys(torn, np.zeros(())),
        nothing_known(sheet, ALONG_CHORDS["method"], *asked) if learns else (),
    )


def at_rung(
    sheet: Flowsheet, targets: tuple[Target, ...], rung: int, begin: Beginning | None = None
) -> Designed:
    """The line as the quick solver (0), from where it may ``begin``, or the exact one from where the quick
    one ends (1) leaves it. Pure, to be batched.
    """
    if rung == 0:
        given = begin or beginning(sheet, targets)
        along: dict[str, Any] = ALONG_CHORDS | {"known": given.learned} if given.learned else {}
        return design(sheet, targets, sheets=True, **given.how(), **along)
    left = beginning(sheet, targets, design(sheet, targets, max_steps=QUICK * (1 + len(targets))))
    return design(sheet, targets, sheets=True, **left.how(), **EXACT)


def _measured(sheet: Flowsheet, targets: tuple[Target, ...], **how: Any) -> Tried:
    found = design(sheet, targets, sheets=True, **how)
    measured = findings(found.line, found.solution)
    return Tried(found, measured, found.converged & sound(measured))


@compiled
def _quickly(sheet: Flowsheet, targets: tuple[Target, ...], passes: Any, known: tuple[Any, ...]) -> Tried:
    """The line with its specifications, figures, checks and audit, after so many passes in all."""
    return _measured(sheet, targets, max_steps=passes, known=known)


@compiled
def _exactly(
    sheet: Flowsheet, targets: tuple[Target, ...], passes: Any, known: tuple[Any, ...], begin: Beginning
) -> Tried:
    """The same with exact derivatives, from where another solver has left the line."""
    return _measured(sheet, targets, known=known, **begin.how(), **EXACT | {"max_steps": passes})


@compiled
def _figure(sheet: Flowsheet, path: str) -> tuple[Any, Any]:
    solution = solve(sheet, sheets={unit_of(sheet, path)})
    return figure(sheet, solution.sheets, solution.streams, path), solution.converged


def climb(
    sheet: Flowsheet, targets: tuple[Target, ...] = (), watch: Watch | None = None
) -> tuple[Tried, list[Fault]]:
    """The line solved by the first solver whose result stands; where none does, the last iterate and what is
    wrong with it, the cause first.
    """

    def attempt(solver: Callable[[], Tried]) -> tuple[Tried, list[Fault]]:
        found = solver() if watch is None else watch.run(solver)
        return found, wrongs(found, targets)

    def exactly() -> Tried:
        left = beginning(sheet, targets, found.designed)
        if targets and not np.all(found.findings.finite):
            # lost where there is no solution: from the values that the line has
            settled = _in_passes(_quickly, QUICK_METHOD, sheet, (), QUICK, watch)
            left = beginning(sheet, (), settled.designed)._replace(near=beginning(sheet, targets).near)
        tried = _in_passes(_exactly, EXACT["method"], sheet, targets, EXACT["max_steps"], watch, left)
        given_up = watch is not None and (watch.stopped or watch.late)
        lost = not targets and not np.all(tried.findings.finite)
        if not bool(tried.designed.solution.converged) and not given_up and not lost:
            # near rest, a loop through which nearly all goes round holds Newton's steps short
            again = beginning(sheet, targets, None if targets else tried.designed)
            tried = _in_passes(_exactly, EXACT["method"], sheet, targets, EXACT["max_steps"], watch, again)
        return tried

    most = QUICK * (1 + len(targets))
    found, wrong = attempt(lambda: _in_passes(_quickly, QUICK_METHOD, sheet, targets, most, watch))
    late = watch is not None and (watch.stopped or watch.late)
    if wrong and not late and _may_help(sheet, targets, wrong):
        other, told = attempt(exactly)
        if not told or np.all(other.findings.finite) or not np.all(found.findings.finite):
            found, wrong = other, told
    if watch is not None and wrong and (watch.stopped or watch.late):
        wrong = [Fault("stopped", "", "", _stopped(watch)), *wrong]
    if wrong and wrong[0].kind == "target":
        wrong = [wrong[0]._replace(message=_unmet(sheet, targets))]
    elif wrong and wrong[0].kind in ("loop", "no value") and (told := _out_of_reach(sheet, targets)):
        # the loop does not rest, or a unit has no answer, because it is led out of its limits
        wrong = [Fault("target", "", "", told)]
    return found, wrong


def wrongs(found: Tried, targets: tuple[Target, ...]) -> list[Fault]:
    """Why this is no solution, the cause first; empty when it is one."""
    designed, solution = found.designed, found.designed.solution
    if bool(found.stands):
        return []
    if not all(np.isfinite(float(v)) for v in designed.values.values()):
        return [Fault("target", "", "", "")]
    told = faults(designed.line, solution, found.findings)
    # what hangs in the air balances nowhere: only what a unit says of itself may be a cause
    if not bool(solution.converged):
        return [fault for fault in told if fault.kind == "no value"] or [_open_loop(found)]
    if not bool(designed.converged):
        return [Fault("target", "", "", "")]
    return told


def _in_passes(
    solver: Callable[..., Tried],
    method: Anderson | Continuation,
    sheet: Flowsheet,
    targets: tuple[Target, ...],
    most: int,
    watch: Watch | None,
    *begin: Beginning,
) -> Tried:
    """The line after some passes at a time, between which the watch is told, until it is solved, hopeless, or
    told to stop.
    """
    known = nothing_known(sheet, method, among(sheet, targets), len(targets))
    loops = [block.tears[0] for block in sheet.blocks if block.tears]
    # where a look may hand the line over to the exact solver, it comes after so many passes: what solves a
    # line never depends on the speed of the machine
    by_passes = not targets and isinstance(method, Anderson)
    done, ahead, looks = 0, FIRST, []
    while True:
        goal, began = min(done + ahead, most), time.monotonic()
        found = solver(as_arrays(sheet), targets, np.asarray(goal), known, *as_arrays(begin))
        spent, solution = time.monotonic() - began, found.designed.solution
        if not solution.known:
            return found
        made = max(map(int, solution.steps), default=goal)
        left = [float(x) for x in solution.residual]
        worst = int(np.argmax(left)) if left else 0
        told = (loops[worst], made, left[worst]) if loops else (targets[0].so_that, made, 0.0)
        stop = watch is not None and watch.seen(*told)
        if bool(found.designed.converged) or made < goal or goal >= most or stop:
            return found
        looks.append((made, max(left, default=0.0)))
        if by_passes and _stagnates(looks):
            return found
        # the first look includes tracing and compiling, which say nothing of the passes
        if done and not by_passes:
            ahead = max(1, min(int(PAUSE * (made - done) / spent), 10 * FIRST))
        done, known = made, solution.known


def _stagnates(looks: list[tuple[int, float]]) -> bool:
    """Whether the residual has not fallen tenfold in as many passes as it should."""
    made, _left = looks[-1]
    before = [left for number, left in looks if number <= made - PATIENCE]
    lately = [left for number, left in looks if number > made - PATIENCE]
    return bool(before) and min(lately) > 0.1 * min(before)


def _may_help(sheet: Flowsheet, targets: tuple[Target, ...], wrong: list[Fault]) -> bool:
    """Whether another solver may find what this one has not: no loop brings a specification into reach."""
    looped = any(block.tears for block in sheet.blocks)
    if not looped or wrong[0].kind not in ("loop", "no value", "target"):
        return False
    if not targets and wrong[0].kind == "no value" and wrong[0].unit in before_loops(sheet):
        return False
    if len(targets) != 1:
        return True
    low, high = _reach(sheet, targets[0])
    return not np.isfinite(low + high) or min(low, high) <= targets[0].equals <= max(low, high)


def before_loops(sheet: Flowsheet) -> set[str]:
    """Units that nothing of a loop enters, nor anything that has passed one."""
    before: set[str] = set()
    for block in sheet.blocks:
        fed = {k.source_unit for k in sheet.links if k.target_unit in block.units and k.source_unit}
        if not block.tears and fed <= before:
            before |= set(block.units)
    return before


def _open_loop(found: Tried) -> Fault:
    solution, line = found.designed.solution, found.designed.line
    loops = [b for b in line.blocks if b.tears]
    worst = max(range(len(loops)), key=lambda i: float(solution.residual[i]))
    tear = line.link(loops[worst].tears[0])
    told = _(
        "The loop through stream '{stream}' (from unit '{unit}') did not converge: scaled residual "
        "{residual}. Does the recycle have a way out, such as a purge?"
    )
    shown = format_number(float(solution.residual[worst]), 2)
    return Fault(
        "loop",
        tear.source_unit,
        tear.name,
        told.format(stream=tear.name, unit=tear.source_unit, residual=shown),
    )


def _stopped(watch: Watch) -> str:
    told = (
        _("Stopped after {passes} passes, scaled residual {residual}.")
        if watch.stopped
        else _(
            "Not solved within {seconds} s: {passes} passes, scaled residual {residual}. Give it more "
            "time, or make the line easier."
        )
    )
    return told.format(
        passes=watch.passes,
        residual=format_number(watch.residual, 2),
        seconds=format_number(watch.seconds or 0.0),
    )


def _reach(sheet: Flowsheet, target: Target) -> tuple[float, float]:
    """What the result of a specification is at both ends of the varied parameter, the other specifications
    left out.
    """
    ends = (
        _figure(as_arrays(changed(sheet, {target.vary: x})), target.so_that)
        for x in (target.lower, target.upper)
    )
    low, high = (float(value) if bool(good) else float("nan") for value, good in ends)
    return low, high


def _unmet(sheet: Flowsheet, targets: tuple[Target, ...]) -> str:
    wanted = []
    for t in targets:
        figure, low, high = _shown(sheet, t)
        wanted.append(f"{t.so_that} = {figure(t.equals)} ({t.vary} {low} … {high})")
    return _out_of_reach(sheet, targets) or _(
        "No value of the varied parameters meets the specifications: {wanted}. Widen the limits or "
        "change the wanted value."
    ).format(wanted="; ".join(wanted))


def _shown(sheet: Flowsheet, target: Target) -> tuple[Callable[[float], str], str, str]:
    """How a result is written, and both limits of what is varied, with their units."""
    given, result = varied(sheet, target.vary).kind, looked_at(sheet, target.so_that).kind
    assert given is not None
    assert result is not None  # a law cannot be varied, nor is one a result
    return lambda x: show(x, result), show(target.lower, given), show(target.upper, given)


def _out_of_reach(sheet: Flowsheet, targets: tuple[Target, ...]) -> str:
    """Which result cannot be had between the limits, in words; empty where each can be had by itself."""
    for t in targets:
        low, high = _reach(sheet, t)
        least = 1e-9 * max(abs(low), abs(high), abs(t.equals))  # what is less is rounding
        low, high = (0.0 if abs(x) < least else x for x in (low, high))
        figure, lower, upper = _shown(sheet, t)
        if np.isfinite(low) and np.isclose(low, high, rtol=1e-9):
            return _(
                "{result} does not depend on {vary}: it is {value} at both ends of the range. "
                "Vary another parameter."
            ).format(result=t.so_that, vary=t.vary, value=figure(low))
        if np.isfinite(low + high) and not min(low, high) <= t.equals <= max(low, high):
            return _(
                "{result} = {wanted} is out of reach: it is {low} at {vary} = {lower} and {high} at "
                "{upper}. Widen the limits, ask for a value between, or vary another parameter."
            ).format(
                result=t.so_that,
                wanted=figure(t.equals),
                low=figure(low),
                high=figure(high),
                vary=t.vary,
                lower=lower,
                upper=upper,
            )
    return ""
