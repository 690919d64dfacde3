"""A study typed as words: a card with its inputs, some of them ranges or spreads, as the text of the file
that says the same.

``pressure_drop=0.3..0.8bar`` is a range, ``cake_resistance=1e7+-30%`` a spread. Equipment takes the streams
at its inlets by port (``feed.solid_flow=800kg/h``) and the substances under ``mixture``
(``mixture.solids=quartz``), as the tables of a case file do; what is not said is as in its ordinary example.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import Any

from granum.cases.alone import tables
from granum.cases.schema import OWN
from granum.cases.tables import as_toml
from granum.core import registry
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.core.stand_ins import not_varied, stands_for
from granum.core.written import interval

_LIMIT = re.compile(r"^(.*?)(<=|>=|<|>)(.*)$")
STEPS = {"sweep": 25, "map": 15}
SHOWN = 6  # results of a piece of equipment, when none are named
ROBUST = 200  # samples under which a design is kept safe when none are asked for


def study_text(
    key: str,
    words: Mapping[str, str],
    *,
    minimize: str = "",
    maximize: str = "",
    sobol: bool = False,
    samples: int | None = None,
    steps: int | None = None,
    limit: Sequence[str] = (),
    output: Sequence[str] = (),
) -> str:
    """The text of a study file of one card.

    One range is a sweep and two are a map; spreads, or a number of samples, make a Monte Carlo study (ranges
    are then even); what is to be least or greatest makes an optimization over the ranges.

    >>> print(
    ...     study_text(
    ...         "particles.reynolds_number", {"velocity": "1..3m/s", "particle_diameter": "1mm"}
    ...     ).splitlines()[-1]
    ... )
    "study" = { "sweep" = { "kind" = "sweep", "over" = { "velocity" = { "from" = "1 m/s", "to" = "3m/s", "steps" = 25 } } } }
    """  # noqa: E501
    thing: Any = registry.find(key)
    if thing.card.sort in ("formula", "law", "procedure"):
        known = thing.card.inputs
        for name in words:
            if name == "fluid" or stands_for(name, known):
                continue  # in place of the properties that the card asks of it
            if name.partition(".")[0].partition("[")[0] not in known:
                raise unknown_name(_("Input"), name, known, _("for {owner}").format(owner=key))
    ranges = {name: _pair(name, value, "..") for name, value in words.items() if ".." in value}
    spreads = {
        name: _pair(name, value, "±") for name, value in words.items() if "+-" in value or "±" in value
    }
    asked = {p.name for p in thing.card.parameters}
    for name in (*ranges, *spreads):
        if told := not_varied(name, asked, _(" for {owner}").format(owner=key)):
            raise told
        if name.partition(".")[0] in OWN and name.count(".") > 1:
            raise InputError(
                _("'{name}' belongs to a material: a study cannot vary it, give it one value.").format(
                    name=name
                ),
                name=name,
            )
    fixed = {name: value for name, value in words.items() if name not in ranges and name not in spreads}
    unit = key.rpartition(".")[2] if thing.card.sort == "equipment" else ""
    own = {p.name for p in (*thing.card.parameters, *thing.card.outputs)} if unit else set()

    def path(name: str) -> str:
        return f"{unit}.{name}" if name.partition(".")[0] in own else name

    kind = _kind(len(ranges), len(spreads), bool(minimize or maximize), sobol, samples)
    uncertain = {path(n): _spread(*pair) for n, pair in spreads.items()}
    study: dict[str, Any] = {"kind": kind}
    if kind in ("sweep", "map"):
        study["over"] = {
            path(n): {"from": low, "to": high, "steps": steps or STEPS[kind]}
            for n, (low, high) in ranges.items()
        }
    elif kind == "optimize":
        study["over"] = {path(n): {"lower": low, "upper": high} for n, (low, high) in ranges.items()}
        study |= {word: path(name) for word, name in (("minimize", minimize), ("maximize", maximize)) if name}
        study |= {"samples": samples or ROBUST} if uncertain else {}
    else:
        uncertain |= {
            path(n): {"distribution": "uniform", "lower": low, "upper": high}
            for n, (low, high) in ranges.items()
        }
    shown = list(output) or [p.name for p in thing.card.outputs if p.kind is not None and not p.series][
        :SHOWN
    ] * bool(unit)
    study |= {"outputs": [path(name) for name in shown]} if shown else {}
    study |= {"limits": _limits(limit, path)} if limit else {}
    middle = {n: low for n, (low, _other) in (ranges | spreads).items()}
    model = tables(key, fixed | middle) if unit else {"title": thing.card.title, "card": key, "inputs": fixed}
    written = {**model, "uncertain": uncertain, "study": {kind: study}}
    return "\n".join(f"{json.dumps(name)} = {as_toml(value)}" for name, value in written.items()) + "\n"


def _kind(ranges: int, spreads: int, best: bool, sobol: bool, samples: int | None) -> str:
    if not ranges and not spreads:
        raise InputError(
            _(
                "Nothing varies: give an input as a range, such as temperature=20..60degC, or with its "
                "spread, such as 1.2+-5%."
            )
        )
    if best:
        if not ranges:
            raise InputError(
                _(
                    "The optimization has nothing to vary: give at least one input as a range, such as "
                    "temperature=20..60degC."
                )
            )
        return "optimize"
    if sobol:
        return "sobol"
    if spreads or samples:
        return "monte_carlo"
    if ranges > 2:
        raise InputError(
            _(
                "More than two ranges: draw cases from them with --samples, or ask what moves the "
                "results with --sobol."
            )
        )
    return "sweep" if ranges == 1 else "map"


def _pair(name: str, value: str, mark: str) -> tuple[str, str]:
    """Both numbers of ``0.3..0.8bar`` or ``1e7+-2e6``, the first with the unit of the second when it has
    none.
    """
    found = interval(value)
    if found is None or found[2] != mark:
        raise InputError(
            _(
                "'{name}' = '{value}': write a range as 0.3..0.8bar and a spread as 1e7+-30% or 85+-5um."
            ).format(name=name, value=value),
            name=name,
        )
    return found[:2]


def _spread(mean: str, width: str) -> dict[str, Any]:
    """Normal; a width in percent is relative unless the mean is in percent itself."""
    if width.endswith("%") and not mean.endswith("%"):
        return {"distribution": "normal", "mean": mean, "relative_standard_deviation": width}
    return {"distribution": "normal", "mean": mean, "standard_deviation": width}


def _limits(words: Sequence[str], path: Any) -> dict[str, dict[str, str]]:
    found: dict[str, dict[str, str]] = {}
    for word in words:
        match = _LIMIT.match(word)
        if match is None or not match[1].strip() or not match[3].strip():
            raise InputError(
                _(
                    "'{word}' is not a limit: write it as 'moisture_dry_basis<=3%' or "
                    "'residence_time>=10min'."
                ).format(word=word)
            )
        name, sign, value = (part.strip() for part in match.groups())
        found.setdefault(path(name), {})["upper" if sign[0] == "<" else "lower"] = value
    return found
