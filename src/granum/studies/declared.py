"""What a study declares, read and checked: uncertain inputs, figures, limits, numbers in any unit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from granum.core.conversion import convert
from granum.core.errors import InputError, unknown_name
from granum.core.given import shown, whole_number
from granum.core.i18n import _
from granum.estimation import Fit
from granum.studies.distributions import Marginal, Source, distribution, from_fits
from granum.studies.subjects import FormulaSubject, Subject

MOST_CASES = 5_000_000


def sources_of(subject: Subject, uncertain: Mapping[str, Any]) -> list[Source]:
    """Independent sources of uncertainty from ``{input: distribution}``.

    A distribution is a table (see ``granum.studies.distributions.distribution``), a ``Fit`` (its estimate of
    the same name) or ``(fit, "name of the estimate")``.
    """
    marginals: list[Source] = []
    fits: dict[str, tuple[Fit, str]] = {}
    for path, declared in uncertain.items():
        variable = subject.input(path)
        if isinstance(declared, Fit):
            declared = (declared, path.rpartition(".")[2])
        if isinstance(declared, tuple) and len(declared) == 2 and isinstance(declared[0], Fit):
            fits[path] = declared
        elif isinstance(declared, Marginal):
            marginals.append(declared)
        elif isinstance(declared, Mapping):
            marginals.append(distribution(path, declared, variable.parameter))
        else:
            raise InputError(
                _(
                    "'{name}': write its uncertainty as a table such as {{distribution = \"normal\", "
                    "mean = …, standard_deviation = …}}."
                ).format(name=path),
                name=path,
            )
    if not marginals and not fits:
        raise InputError(_("No input is uncertain: declare at least one under [uncertain]."))
    return marginals + from_fits(fits)


def prepare(
    subject: Subject, outputs: Sequence[str] | None, varied: tuple[str, ...]
) -> tuple[Subject, tuple[str, ...]]:
    """The subject with expressions among the figures resolved, and the figures to compute."""
    if isinstance(outputs, str):
        outputs = [outputs]
    paths: list[str] = []
    for text in outputs or subject.outputs():
        subject, path = subject.figure(str(text))
        paths.append(path)
    if not paths:
        raise InputError(_("The study has no figures to compute: name some under 'outputs'."))
    if isinstance(subject, FormulaSubject):
        subject.complete(varied)
    return subject, tuple(dict.fromkeys(paths))


def limits_of(
    subject: Subject, declared: Mapping[str, Any], where: str
) -> tuple[Subject, dict[str, tuple[float | None, float | None]]]:
    """Limits of figures from ``{figure: {lower, upper}}`` in any unit, SI."""
    found: dict[str, tuple[float | None, float | None]] = {}
    for text, table in declared.items():
        subject, path = subject.figure(text)
        if not isinstance(table, Mapping) or not table:
            raise InputError(
                _("{where} '{name}': give 'lower', 'upper' or both, as in {{upper = \"3 %\"}}.").format(
                    where=where, name=text
                )
            )
        for key in table:
            if key not in ("lower", "upper"):
                raise unknown_name(_("Key"), key, ("lower", "upper"), f"{where} '{text}'")
        low, high = (
            si(subject.output(path).parameter, table[k], f"{where} '{text}'") if k in table else None
            for k in ("lower", "upper")
        )
        if low is not None and high is not None and low > high:
            raise InputError(
                _("{where} '{name}': 'lower' must be below 'upper'.").format(where=where, name=text)
            )
        found[path] = (low, high)
    return subject, found


def si(parameter: Any, value: Any, where: str) -> float:
    """A number in any unit as SI; a figure without a kind takes plain numbers."""
    if parameter.kind is None:
        from granum.studies.expressions import plain_quantity

        return plain_quantity(value, where)
    return float(convert(value, parameter, f" {where}"))


def whole(value: Any, name: str, least: int, most: int) -> int:
    """A count inside its limits."""
    count = whole_number(value)
    if count is None or not least <= count <= most:
        raise InputError(
            _("'{name}' = {value} must be a whole number from {least} to {most}.").format(
                name=name, value=shown(value), least=least, most=most
            )
        )
    return count
