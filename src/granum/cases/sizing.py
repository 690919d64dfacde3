"""The size of a piece of equipment from its duty: the setting by which it is sized is sought, as by a design
specification of a case file, so that one of its figures takes a value.

The file ``sizes.toml`` says which setting is sought for which figure, or why a piece has no size.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cache
from importlib.resources import files
from math import ceil, floor
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import tomli

from granum.cases.alone import as_words, case_text
from granum.cases.reading import read_text
from granum.cases.sections import with_table
from granum.core import registry
from granum.core.conversion import convert
from granum.core.errors import ApplicabilityError, ConvergenceError, InputError, unknown_name, without_value
from granum.core.i18n import _, quoted
from granum.core.parameters import Parameter
from granum.flowsheet.findings import unanswered
from granum.flowsheet.run import Line, Run
from granum.reports.quantities import value_text
from granum.studies.inverse import reached_often, unreached

FAR, PLACES = 1e2, 41  # times beyond the setting at which a search begins, and how many are looked at
SAME = 1e-9
NO_SIZE = {
    "divides": "It only joins, divides or heats streams: what it is to do is itself a setting.",
    "balance": "It is a balance without dimensions: what it is to reach is itself a setting.",
    "curve": "How it parts is itself a setting, and its dimensions do not enter.",
    "recipe": "What it makes follows from recipe and kinetics; its volume for a batch is among its figures.",
    "asked": "What it is to reach is itself a setting, and its size is among its figures.",
}


class Duty(NamedTuple):
    """The setting by which a piece of equipment is sized, and the figure that says what it does."""

    setting: str
    figure: str


@cache
def _declared() -> dict[str, dict[str, Any]]:
    return tomli.loads((files("granum") / "cases" / "sizes.toml").read_text(encoding="utf-8"))


def duty(key: str) -> Duty:
    """By what a piece of equipment is sized; a refusal that says why where it has no size.

    >>> duty("filtration.nutsche")
    Duty(setting='area', figure='capacity_use')
    """
    thing = registry.find(key)
    if thing.card.sort != "equipment":
        raise InputError(
            _("'{model}' is a {sort}, not equipment.").format(model=key, sort=_(thing.card.sort))
        )
    row = _declared().get(key, {})
    if "reason" in row:
        raise ApplicabilityError(
            _("'{unit}' cannot be sized. {reason}").format(
                unit=thing.card.title, reason=_(NO_SIZE[row["reason"]])
            )
        )
    if not row:
        raise InputError(_("Say which setting of '{unit}' is sought.").format(unit=key))
    return Duty(row["setting"], row["figure"])


class Sought(NamedTuple):
    """A case whose specification finds a size.

    Parameters
    ----------
    text: the case file. path: what it varies. words: what was said, the wanted figure left out.
    """

    text: str
    path: str
    words: dict[str, Any]


def sought(key: str, words: Mapping[str, Any], setting: str = "") -> Sought:
    """The case of a piece of equipment alone whose size a specification finds: ``words`` are those of
    ``case_text``, and one figure of the piece with the value that it is to have.
    """
    thing = registry.find(key)
    name = key.split(".", 1)[1]
    wanted, given, p, figure = _asked(thing, words, setting)
    text = case_text(key, given)
    low, high = bracket(read_text(text, name=key), name, p, figure, wanted)
    path = f"{name}.{p.name}"
    specification = {
        "vary": path,
        "so_that": f"{name}.{figure.name}",
        "equals": wanted,
        "lower": low,
        "upper": high,
    }
    return Sought(with_table(text, ("specifications", "size"), specification), path, given)


def size(key: str, setting: str = "", /, **inputs: Any) -> Run:
    """A piece of equipment sized for a duty, solved: ``inputs`` are those of ``granum.alone``, and one figure
    with the value that it is to have. ``setting`` is sought where it is not that of ``duty``.

    >>> run = size("dust.bag_filter", superficial_velocity="1 m/min", feed={"gas_flow": "30 t/h"})
    >>> round(run.found["bag_filter.area"])
    486
    """
    return read_text(sought(key, as_words(key, inputs), setting).text, name=key).solve()


def doubts(run: Run) -> str:
    """What stands against the size found: that it is no whole number, checks that do not hold there, sources
    that do not reach so far; empty where nothing does.

    >>> doubts(size("dust.bag_filter", superficial_velocity="1 m/min"))
    ''
    """
    failed = [_(check.name) for report in run.units.values() for check in report.checks if not check.ok]
    beyond = [flag["message"] for flag in run.flags if flag.get("flag") == "extrapolated"]
    told = [_("At the size found this check does not hold: {name}.").format(name=name) for name in failed]
    return " ".join([*_counted(run), *told, *dict.fromkeys(beyond)])


def is_whole(key: str) -> bool:
    """Whether what a piece of equipment is sized by is built in a whole number."""
    return bool(_declared().get(key, {}).get("whole"))


def _counted(run: Run) -> Iterator[str]:
    """What is built in a whole number and was found between two."""
    for path, value in run.found.items():
        name, _dot, setting = path.partition(".")
        card = run.units[name].model.card
        if (
            is_whole(card.key)
            and duty(card.key).setting == setting
            and abs(value - round(value)) > SAME * value
        ):
            yield _("A whole number is built: {name} = {low} or {high}.").format(
                name=card.parameter(setting).label, low=floor(value), high=ceil(value)
            )


def _asked(
    thing: Any, words: Mapping[str, Any], setting: str
) -> tuple[float, dict[str, Any], Parameter, Parameter]:
    """The value wanted, SI, the other words, what is sought and the figure."""
    own = Duty(setting, "") if setting else duty(thing.card.key)
    parameters = {q.name: q for q in thing.card.parameters}
    if own.setting not in parameters:
        raise unknown_name(_("Input"), own.setting, parameters, _("for {owner}").format(owner=thing.card.key))
    p = parameters[own.setting]
    if p.kind is None or p.series or p.sort is int:
        raise InputError(
            _("'{name}' is no single quantity: it cannot be solved for.").format(name=p.name), name=p.name
        )
    figures = {q.name: q for q in thing.card.outputs if q.kind is not None and not q.series}
    told = [w for w in words if w in figures and (w not in parameters or w == own.figure)]
    if len(told) != 1:
        raise InputError(
            _("To size '{unit}', give one of its figures, best '{best}': {results}.").format(
                unit=thing.card.key,
                best=own.figure or next(iter(figures)),
                results=", ".join(quoted(n) for n in figures),
            )
        )
    figure = figures[told[0]]
    return (
        float(convert(words[figure.name], figure)),
        {w: v for w, v in words.items() if w != figure.name},
        p,
        figure,
    )


def bracket(line: Line, name: str, p: Parameter, figure: Parameter, wanted: float) -> tuple[float, float]:
    """Two neighboring settings between which the figure passes the value wanted."""
    start = getattr(line.sheet.units[name], p.name)
    if start is None:
        raise InputError(
            _("Give '{name}' a value from which the search begins.").format(name=p.name), name=p.name
        )
    x = _looked_at(p, float(start))
    x, y = _reached(_looking(line, name, p.name, figure.name), x, wanted)
    if not x.size or not np.ptp(y) > SAME * np.abs(y).max():
        said = _("{output} does not depend on {name} here.").format(output=figure.label, name=p.label)
        raise ApplicabilityError(" ".join([said, *_failing(line, name)]))
    miss = np.where(np.abs(y - wanted) <= SAME * abs(wanted), 0.0, np.sign(y - wanted))
    met = np.flatnonzero(miss == 0.0)
    if met.size > 1:
        raise ApplicabilityError(
            _(
                "{output} = {wanted} is met by any {name} from {first} to {last}: it does not say which. "
                "Ask for a value that is not at the end of what can be reached."
            ).format(
                output=figure.label,
                wanted=value_text(wanted, figure),
                name=p.label,
                first=value_text(float(x[met[0]]), p),
                last=value_text(float(x[met[-1]]), p),
            )
        )
    found = [(max(i - 1, 0), min(i + 1, x.size - 1)) for i in met]
    found += [(i, i + 1) for i in np.flatnonzero(miss[:-1] * miss[1:] < 0.0)]
    if not found:
        raise unreached(p, figure, wanted, (float(y.min()), float(y.max())), x)
    if len(found) > 1:
        raise reached_often(p, figure, wanted, [float(x[i]) for i, _j in sorted(found)])
    i, j = found[0]
    return float(x[i]), float(x[j])


def _failing(line: Line, name: str) -> list[str]:
    """The checks of a piece that do not hold at the settings given, told; none where it has no answer."""
    try:
        checks = line.solve().units[name].checks
    except ConvergenceError:
        return []
    return [
        _("With what is given this check does not hold: {name}.").format(name=_(check.name))
        for check in checks
        if not check.ok
    ]


def _reached(
    look: Callable[[np.ndarray], np.ndarray], x: np.ndarray, wanted: float
) -> tuple[np.ndarray, np.ndarray]:
    """The settings that have an answer, with it. Where the value wanted is not among these, the gaps to those
    that have none are looked at more closely: an evaporator still works shortly before it would run dry.
    """
    y = look(x)
    answers = np.isfinite(y)
    edges = np.flatnonzero(answers[:-1] != answers[1:])
    if edges.size and answers.any() and not y[answers].min() <= wanted <= y[answers].max():
        share = np.linspace(0.0, 1.0, x.size // edges.size + 2)[1:-1]
        between = np.concatenate([x[i] + (x[i + 1] - x[i]) * share for i in edges])
        # as many as before, so that nothing is compiled again
        more = look(np.concatenate([between, x[between.size :]]))[: between.size]
        x, y = np.concatenate([x, between]), np.concatenate([y, more])
        order = np.argsort(x)
        x, y = x[order], y[order]
    return x[np.isfinite(y)], y[np.isfinite(y)]


def _looked_at(p: Parameter, start: float) -> np.ndarray:
    assert p.kind is not None  # as what is sought
    x = start * np.geomspace(1.0 / FAR, FAR, PLACES)
    ends = ((p.kind.lower, p.kind.open_lower), (p.kind.upper, p.kind.open_upper))
    closed = [end for end, bare in ends if not bare and x[0] < end < x[-1]]
    return np.unique([*x[(x > p.kind.lower) & (x < p.kind.upper)], *closed])


def _looking(line: Line, name: str, setting: str, figure: str) -> Callable[[np.ndarray], np.ndarray]:
    """A figure of the unit at each of several settings, in one pass; not a number where the unit has no
    answer.
    """
    feeds = {
        link.target.partition(".")[2]: line.sheet.feeds[link.name]
        for link in line.sheet.links
        if not link.origin
    }
    unit = line.sheet.units[name]

    def one(size: Any) -> Any:
        trial = eqx.tree_at(lambda u: getattr(u, setting), unit, size)
        found = trial.operate(**feeds)
        told = getattr(found.figures, figure)
        if told is None:
            raise without_value(f"{name}.{figure}")
        return jnp.where(unanswered(found.records), jnp.nan, jnp.asarray(told, dtype=float))

    look = jax.jit(jax.vmap(one))
    return lambda x: np.asarray(look(jnp.asarray(x)))
