"""TOML as users send it: read in bounded time and depth, or refused in one sentence."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

import tomli

from granum.core.errors import InputError
from granum.core.i18n import _

DEEPEST = 50  # tables in tables; a case has five
LONGEST_SHOWN = 60  # characters of a value in a message
_LONG_KEY = re.compile(rf"(?<![\w.\"'-])(?:[\w\"'-]+[ \t]*\.[ \t]*){{{DEEPEST}}}")


def read_toml(text: str) -> dict[str, Any]:
    """The tables of a TOML text.

    >>> read_toml("a.b = 1")
    {'a': {'b': 1}}
    """
    if _LONG_KEY.search(text):  # the parser takes the square of their length
        raise InputError(_("tables stand in tables deeper than {count}").format(count=DEEPEST))
    try:
        return tomli.loads(text)
    except tomli.TOMLDecodeError as problem:
        raise InputError(_unquoted(text, str(problem)) or _worded(str(problem))) from None
    except RecursionError:
        raise InputError(_("tables stand in tables deeper than {count}").format(count=DEEPEST)) from None
    except ValueError:  # Python reads no whole number of more than 4300 digits
        raise InputError(_("a number has more digits than can be read")) from None


def table_in(text: str, name: str) -> Any:
    """The table or list that a text holds, as JSON or as it stands in a case file; the text in brackets of a
    list without quotation marks, which is read as one typed without brackets.

    >>> table_in('{"law": "page"}', "kinetics") == table_in('{law = "page"}', "kinetics")
    True
    >>> table_in("[20 g/L, 50 g/L]", "concentration_points")
    '20 g/L, 50 g/L'
    """
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        pass
    try:
        return read_toml(f"v = {text}")["v"]
    except InputError:
        if bare := _BARE_LIST.fullmatch(text.strip()):
            return bare[1].strip()
        raise InputError(
            _("'{name}': '{text}' is no table; write it as {example}.").format(
                name=name, text=text[:40], example='{law = "…", … = "…"}'
            ),
            name=name,
        ) from None


def wrong_sort(error: Mapping[str, Any]) -> str:
    """What is told of a value that stands where a file needs one of another sort, from what pydantic found.

    >>> wrong_sort({"type": "list_type", "loc": ("mixture", "gases"), "input": "air"})
    "'mixture.gases' = air is not possible: it must be a list, as in [1, 2]."
    """
    sort, place = error["type"], [str(part) for part in error["loc"]]
    amount = place[-1] == "str"  # the first of what a number with its unit may be
    if len(place) > 1 and (amount or place[-1][:1].isupper()):
        place = place[:-1]  # a choice of the shape, no key of the file
    limits = error.get("ctx", {})
    needed = {
        "model": _("a table of keys and values"),
        "dict": _("a table of keys and values"),
        "list": _("a list, as in [1, 2]"),
        "string": _("a text in quotation marks"),
        "int": _("a whole number"),
        "float": _("a number"),
        "greater": _("at least {low}").format(low=limits.get("ge")),
        "less": _("at most {high}").format(high=limits.get("le")),
    }.get(sort.partition("_")[0], _("a value of another sort"))
    if amount:
        needed = _("a number with its unit, in quotation marks")
    return _("'{place}' = {value} is not possible: it must be {allowed}.").format(
        place=".".join(place), value=_as_written(error["input"])[:LONGEST_SHOWN], allowed=needed
    )


def _as_written(value: Any) -> str:
    """A value as it stands in the file, where Python writes it otherwise."""
    return str(value).lower() if isinstance(value, bool) else str(value)


_BARE_LIST = re.compile(r"\[([^][{}\"']+)\]")
_SAID = re.compile(
    r"(?P<what>.*) \(at (?:line (?P<line>\d+), column (?P<column>\d+)|end of document)\)", re.DOTALL
)
_NAMED = (
    ("Cannot declare {name} twice", r"Cannot declare (.+) twice"),
    ("Table {name} is closed already", r"Cannot (?:mutate immutable|redefine) namespace (.+)"),
    ("Key {name} stands twice in one table", r"Duplicate inline table key (.+)"),
    ("{name} is expected here", r"Expected ('=' .+|'\](?:\])?' .+|'.+')"),
    ("{name} is no character of TOML", r"(?:Found invalid|Illegal) character (.+)"),
)


def _unquoted(text: str, said: str) -> str | None:
    """That a name with accents wants quotation marks, where the parser stopped at one.

    >>> _unquoted("[feeds.fumées]", "Expected ']' at the end (at line 1, column 11)")
    'names with accents stand between quotation marks, as in "fumées" (line 1, column 11)'
    """
    found = _SAID.fullmatch(said)
    if not found or not found["line"]:
        return None
    line, column = int(found["line"]), int(found["column"])
    place = next((w for w in re.finditer(r"[\w-]+", text.splitlines()[line - 1]) if w.end() >= column), None)
    if place is None or place[0].isascii():
        return None
    message = _("names with accents stand between quotation marks, as in {example}")
    at = _("line {line}, column {column}").format(line=line, column=column)
    return f"{message.format(example=chr(34) + place[0] + chr(34))} ({at})"


def _worded(said: str) -> str:
    """What the parser of TOML says, in the current language.

    >>> _worded("Cannot declare ('units', 'dryer') twice (at line 2, column 3)")
    'Cannot declare units.dryer twice (line 2, column 3)'
    """
    found = _SAID.fullmatch(said)
    if not found:
        return _(said)
    what = found["what"]
    for template, pattern in _NAMED:
        if named := re.fullmatch(pattern, what, re.DOTALL):
            key = ".".join(re.findall(r"'([^']*)'", named[1])) if named[1].startswith("(") else named[1]
            what = _(template).format(name=re.sub(r" (?:after|at) .*", "", key))
            break
    else:
        what = _(what)
    at = (
        _("line {line}, column {column}").format(line=found["line"], column=found["column"])
        if found["line"]
        else _("end of the text")
    )
    return f"{what} ({at})"
