"""What the page needs to build a line: the operations on the text of a case and the equipment to choose
from.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from granum.app.offered import require_offered
from granum.app.wording import summary_words
from granum.cases import building, describing
from granum.cases.outline import outline, table_of
from granum.cases.reading import knowing_own, parsed
from granum.cases.scaling import median_size_of, scale_of, size_told
from granum.cases.starting import starting_values
from granum.core import registry
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _, current_language
from granum.core.index import entries
from granum.flowsheet.symbols import symbol_of

OPERATIONS: dict[str, Callable[..., str]] = {
    **{name: getattr(building, name) for name in building.__all__},
    "describe_substance": describing.describe_substance,
    "forget_substance": describing.forget_substance,
}


def built(operation: str, case: str, arguments: Mapping[str, Any]) -> str:
    """The text of a case after an operation of ``granum.cases.building`` or ``describing``."""
    if operation not in OPERATIONS:
        raise unknown_name(_("Operation"), operation, OPERATIONS)
    function = OPERATIONS[operation]
    takes_case = "case" in inspect.signature(function).parameters
    words = {"case": case, **arguments} if takes_case else dict(arguments)
    try:
        inspect.signature(function).bind(**words)
    except TypeError as problem:
        raise InputError(
            _("'{operation}' is asked for in the wrong way: {reason}.").format(
                operation=operation, reason=problem
            )
        ) from None
    for name, value in arguments.items():
        fits = isinstance(value, (str, dict)) or (
            isinstance(value, list) and all(isinstance(x, str) for x in value)
        )
        if not fits:
            raise InputError(
                _("'{name}' cannot take this value: {value}.").format(name=name, value=str(value)[:60]),
                name=name,
            )
    require_offered(operation, case, arguments)
    return function(**words)


def told_of(operation: str, case: str, arguments: Mapping[str, Any]) -> str:
    """What is to be said about an operation that was done: for which flow a new piece was sized."""
    if operation != "add_unit" or arguments.get("values"):
        return ""
    raw = parsed(case, "case")
    key = registry.find(arguments["model"]).card.key
    with knowing_own(raw):
        made = starting_values(key, table_of(raw, "mixture"))
        found, origin, brings = outline(case), arguments.get("origin", ""), arguments.get("brings")
        scale = scale_of(key, found, origin, brings)
        return size_told(key, made, scale, median_size_of(found, origin, brings))


def palette() -> list[dict[str, Any]]:
    """Every piece of equipment, with its symbol and whether it needs more than one stream."""
    return _palette(current_language())


def _joins(key: str) -> bool:
    """Whether something besides the first stream must come from elsewhere; gas for a dryer comes with it."""
    thing = registry.find(key)
    return bool(set((thing.inlet_names() or ())[1:]) - {*thing.optional_inlets(), "gas"})


@cache
def _palette(_language: str) -> list[dict[str, Any]]:
    return [
        {
            "model": c.key,
            "domain": c.domain,
            "title": c.title,
            "summary": summary_words(c.summary),
            "other_names": f"{c.english_title} {c.french_title}",
            "symbol": symbol_of(c.key),
            "joins": _joins(c.key),
        }
        for c in entries().values()
        if c.sort == "equipment"
    ]
