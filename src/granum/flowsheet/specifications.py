"""Design specifications: parameters found so that results take wanted values, derivatives included."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.core.errors import InputError, unknown_name, without_value
from granum.core.i18n import _
from granum.core.parameters import Parameter
from granum.flowsheet.plan import Link
from granum.flowsheet.sheet import Flowsheet
from granum.flowsheet.solving import Solution, Wanted, solve
from granum.flowsheet.stream_figures import (
    changed,
    feed_parameter,
    given_value,
    stream_figure,
    stream_parameter,
    told_of,
)
from granum.streams.stream import Stream

PASSES = 400
"""Passes through the loops of a line, and again for each parameter that is sought."""


class Target(NamedTuple):
    """Vary ``vary`` (unit.parameter, or a figure of a feed) between ``lower`` and ``upper`` so that
    ``so_that`` (unit.result, or a figure of a stream) equals ``equals``, all SI.
    """

    vary: str
    so_that: str
    equals: float
    lower: float
    upper: float


class Designed(NamedTuple):
    """A solved line that meets its specifications, with the values found."""

    line: Flowsheet
    solution: Solution
    values: dict[str, Any]
    converged: Any


def figure(line: Flowsheet, sheets: Mapping[str, Any], streams: Mapping[str, Stream], path: str) -> Any:
    """One result of a unit, ``unit.result``, from its sheet, or one figure of a stream."""
    told = _of_stream(line, path)
    if told is not None:
        return stream_figure(streams[told[0].name], told[1])
    unit, _dot, name = path.partition(".")
    found = getattr(sheets[unit][0], name)
    if found is None:
        raise without_value(path)
    return found


def _of_stream(line: Flowsheet, path: str) -> tuple[Link, str] | None:
    """The stream and the word of a path that is no result of a unit."""
    unit, _dot, name = path.partition(".")
    if unit in line.units and name in {p.name for p in type(line.units[unit]).card.outputs}:
        return None
    return told_of(line.links, path)


def unit_of(line: Flowsheet, path: str) -> str:
    """The unit whose result a path names, or that gives the stream it names."""
    told = _of_stream(line, path)
    return path.partition(".")[0] if told is None else told[0].source_unit


def design(
    line: Flowsheet,
    targets: tuple[Target, ...],
    *,
    sheets: bool = False,
    near: Mapping[str, Any] | None = None,
    **how: Any,
) -> Designed:
    """Solve a line with its specifications, in one iteration with its loops: a single one within a bracket,
    several by Broyden's method.

    The search begins at the values that the line has, or that are ``near``, where these are within their
    limits, and in the middle otherwise. ``how`` says how loops are solved, as for ``solve``.
    """
    if not targets:
        solution = solve(line, sheets=sheets, **how)
        return Designed(line, solution, {}, solution.converged)
    how.setdefault("max_steps", PASSES * (1 + len(targets)))
    low = jnp.asarray([t.lower for t in targets])
    width = jnp.asarray([t.upper for t in targets]) - low

    def values(sought: Any) -> dict[str, Any]:
        return {t.vary: low[i] + width[i] * sought[i] for i, t in enumerate(targets)}

    def misses(sheets: Any, streams: Any) -> Any:
        figures = [figure(line, sheets, streams, t.so_that) for t in targets]
        wanted = np.asarray([t.equals for t in targets], dtype=float)
        return (jnp.stack(figures) - wanted) / np.where(wanted == 0.0, 1.0, abs(wanted))

    begun = jnp.stack([_number((near or {}).get(t.vary, given_value(line, t.vary))) for t in targets])
    share = jax.lax.stop_gradient((begun - low) / width)
    wanted = Wanted(
        jnp.where((share >= 0.0) & (share <= 1.0), share, 0.5),
        lambda sought: changed(line, values(sought)),
        misses,
        frozenset(unit_of(line, t.so_that) for t in targets),
        among(line, targets),
    )
    solution = solve(line, sheets=sheets, wanted=wanted, **how)
    found = values(solution.sought)
    return Designed(changed(line, found), solution, found, solution.met)


def among(line: Flowsheet, targets: tuple[Target, ...]) -> frozenset[str]:
    """Units and feeds that are varied or looked at."""
    return frozenset(one for t in targets for one in (t.vary.partition(".")[0], unit_of(line, t.so_that)))


def _number(value: Any) -> Any:
    return jnp.asarray(jnp.nan if value is None else value, dtype=float)


def varied(line: Flowsheet, path: str) -> Parameter:
    """What ``vary`` names, or a refusal: a parameter of a unit, or a figure of a feed."""
    head, _dot, word = path.partition(".")
    if head in line.feeds:
        return feed_parameter(line.feeds[head], head, word)
    line.locate(path)
    if "." in word:
        raise InputError(_("'{name}' lies inside a law: vary a parameter of a unit.").format(name=path))
    return type(line.units[head]).card.parameter(word)


def looked_at(line: Flowsheet, path: str) -> Parameter:
    """What ``so_that`` names, or a refusal: a result of a unit, or a figure of a stream it makes."""
    told = _of_stream(line, path)
    if told is not None:
        link, word = told
        if not link.origin:
            raise InputError(
                _("'{name}' is a figure of a feed, which is given: vary it instead.").format(name=path)
            )
        return stream_parameter(next(iter(line.feeds.values())).mixture, link.name, word)
    unit, _dot, name = path.partition(".")
    if unit not in line.units:
        streams = [k.name for k in line.links if k.origin]
        raise unknown_name(_("Unit or stream"), unit, (*line.units, *streams))
    outputs = {p.name: p for p in type(line.units[unit]).card.outputs}
    if name not in outputs:
        raise unknown_name(_("Result"), name, outputs, _("of unit '{unit}'").format(unit=unit))
    return outputs[name]
