"""What an optimization declares: decisions with their ranges, objective, constraints, starts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import scipy

from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.studies.declared import limits_of, prepare, si, sources_of, whole
from granum.studies.distributions import Source
from granum.studies.engine import Cases
from granum.studies.lines import subject_of
from granum.studies.outcome import Limits
from granum.studies.sampling import inputs_at, unit_points
from granum.studies.search import METHODS, Constraint, Found, Search, Span
from granum.studies.subjects import EXTRAPOLATED, FormulaSubject, Subject

WIDE = 100.0
"""A range of positive values that spans more than this is searched on a logarithmic scale."""


def decisions(subject: Subject, over: Mapping[str, Any]) -> tuple[dict[str, Span], dict[str, float]]:
    if not over:
        raise InputError(
            _("The optimization has nothing to vary: name inputs with their limits under 'over'.")
        )
    spans, starts = {}, {}
    for path, declared in over.items():
        parameter = subject.input(path).parameter
        where = _("in 'over' for '{name}'").format(name=path)
        table: Any = (
            dict(zip(("lower", "upper"), declared, strict=False))
            if isinstance(declared, (list, tuple))
            else declared
        )
        if not isinstance(table, Mapping) or "lower" not in table or "upper" not in table:
            raise InputError(
                _("{where}: give its limits as {{lower = …, upper = …}}.").format(where=where), name=path
            )
        for key in table:
            if key not in ("lower", "upper", "start"):
                raise unknown_name(_("Key"), key, ("lower", "upper", "start"), where)
        low, high = (si(parameter, table[key], where) for key in ("lower", "upper"))
        if not low < high:
            raise InputError(_("{where}: 'lower' must be below 'upper'.").format(where=where), name=path)
        spans[path] = Span(low, high, low > 0 and high / low > WIDE)
        start = si(parameter, table["start"], where) if "start" in table else subject.nominal(path)
        starts[path] = min(max(start, low), high) if np.isfinite(start) else spans[path].at(0.5)
    return spans, starts


def objective_of(minimize_: str | None, maximize_: str | None) -> tuple[str, float]:
    if bool(minimize_) == bool(maximize_):
        raise InputError(_("Give either 'minimize' or 'maximize'."))
    return (str(minimize_), 1.0) if minimize_ else (str(maximize_), -1.0)


def constraints_of(limits: Limits, outputs: tuple[str, ...]) -> list[Constraint]:
    made = []
    for path, (low, high) in limits.items():
        scale = max(abs(low or 0.0), abs(high or 0.0)) or 1.0
        for limit, sign in ((low, 1.0), (high, -1.0)):
            if limit is not None:
                made.append(Constraint(path, outputs.index(path), limit, sign, scale))
    return made


def starts_of(
    spans: Mapping[str, Span], first: Mapping[str, float], count: int, seed: int
) -> list[np.ndarray]:
    places = [np.array([spans[p].place(v) for p, v in first.items()])]
    if count > 1:
        places += list(
            scipy.stats.qmc.LatinHypercube(len(spans), rng=np.random.default_rng(seed)).random(count - 1)
        )
    return places


def search_of(
    thing: Any,
    over: Mapping[str, Any],
    minimize: str | None,
    maximize: str | None,
    limits: Mapping[str, Any] | None,
    outputs: Sequence[str] | None,
    method: str,
    uncertain: Mapping[str, Any] | None,
    samples: int,
    probability: float,
    seed: int,
    fixed: Mapping[str, Any] | None,
    second: str = "",
) -> tuple[Search, str, float, Limits, dict[str, float]]:
    if method not in METHODS:
        raise unknown_name(_("Method"), method, METHODS)
    if not 0.0 < probability < 1.0:
        raise InputError(_("'probability' = {value} must lie between 0 and 1.").format(value=probability))
    subject = subject_of(thing, fixed)
    if isinstance(subject, FormulaSubject) and not subject.pure:
        raise InputError(
            _("'{key}' ({sort}): it has no derivatives and cannot be optimized.").format(
                key=subject.thing.card.key, sort=_("procedure")
            )
        )
    name, sign = objective_of(minimize, maximize)
    subject, name = subject.figure(name)
    if second:
        subject, second = subject.figure(second)
    subject, kept = limits_of(subject, limits or {}, _("in 'limits' for"))
    spans, first = decisions(subject, over)
    sources: list[Source] = []
    if samples:
        wanted = {k: v for k, v in (uncertain or {}).items() if k not in spans}
        sources = sources_of(subject, wanted)
    doubtful = tuple(n for s in sources for n in s.names)
    subject, shown = prepare(subject, outputs or [name], (*spans, *doubtful))
    paths = tuple(dict.fromkeys((name, *((second,) if second else ()), *kept, *shown)))
    drawn = None
    if samples:
        count = whole(samples, "samples", 10, 100_000)
        drawn = inputs_at(
            sources, unit_points("latin_hypercube", count, sum(s.dimensions for s in sources), seed)
        )
    signs = np.zeros(len(paths))
    for path, (low, high) in kept.items():
        if samples and low is not None and high is not None:
            raise InputError(
                _("'{name}': under uncertainty a figure takes one limit, 'lower' or 'upper'.").format(
                    name=path
                ),
                name=path,
            )
        signs[paths.index(path)] = -1.0 if high is None else 1.0
    search = Search(subject, spans, paths, doubtful, drawn, probability, 2 if second else 1, sources, signs)

    return search, name, sign, kept, first


def as_cases(search: Search, ends: Sequence[Found]) -> Cases:
    x = np.array([list(search.values(e.z).values()) for e in ends])
    codes = [EXTRAPOLATED if e.point.extrapolated else e.point.code for e in ends]
    return Cases(
        search.subject,
        tuple(search.spans),
        search.outputs,
        x,
        np.array([e.point.figures for e in ends]),
        np.array(codes, np.int32),
    )
