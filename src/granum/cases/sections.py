"""The text of a case file cut into its tables, so that one can be put in, taken out, renamed or changed while
every other line stays as it was written.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import tomli
import tomlkit
from tomlkit.exceptions import TOMLKitError

from granum.core.documents import read_toml
from granum.core.errors import CaseError, InputError
from granum.core.i18n import _

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_HEAD = re.compile(r"\s*\[(?!\[)(.+?)\]\s*(#.*)?$")


class Section(NamedTuple):
    """A table under its own heading: its path, the line of the heading, and the line after its last value."""

    path: tuple[str, ...]
    first: int
    last: int


def sections(text: str) -> list[Section]:
    """The tables of a text in the order in which they stand. Comments and blank lines after the last value of
    one belong to whatever follows.
    """
    lines = text.split("\n")
    heads = [(i, path) for i, line in enumerate(lines) if (path := _path_of(lines, i, line))]
    found = []
    for place, (first, path) in enumerate(heads):
        end = heads[place + 1][0] if place + 1 < len(heads) else len(lines)
        while end > first + 1 and lines[end - 1].strip()[:1] in ("", "#"):
            end -= 1
        found.append(Section(path, first, end))
    return found


def _path_of(lines: list[str], i: int, line: str) -> tuple[str, ...]:
    """The path that a heading names; empty for any other line, also for one that only looks so inside a text
    of several lines.
    """
    if not _HEAD.match(line):
        return ()
    try:
        inner: Any = tomli.loads(line)
        tomli.loads("\n".join(lines[:i]))
    except ValueError:
        return ()
    path = []
    while inner:
        ((name, inner),) = inner.items()
        path.append(name)
    return tuple(path)


def heading(path: Iterable[str]) -> str:
    """``[units.filter]``."""
    return f"[{'.'.join(key(name) for name in path)}]"


def key(name: str) -> str:
    """A name as a key of TOML."""
    return name if _BARE.fullmatch(name) else json.dumps(name, ensure_ascii=False)


def written(value: Any) -> str:
    """A value as TOML on one line.

    >>> written({"law": "page", "rate constant": [1.5, "2 h"]})
    '{ law = "page", "rate constant" = [1.5, "2 h"] }'
    """
    if isinstance(value, Mapping):
        inner = ", ".join(f"{key(str(name))} = {written(item)}" for name, item in value.items())
        return f"{{ {inner} }}" if inner else "{}"
    if isinstance(value, list):
        return f"[{', '.join(map(written, value))}]"
    if isinstance(value, str) and "\n" in value and "'''" not in value and "\r" not in value:
        return f"'''\n{value}'''"
    return json.dumps(value, ensure_ascii=False)


def with_table(text: str, path: tuple[str, ...], values: Mapping[str, Any]) -> str:
    """A new table after the last of its kind, else after the tables that belong before it."""
    block = [heading(path), *(f"{key(name)} = {written(value)}" for name, value in values.items())]
    lines = text.rstrip("\n").split("\n") if text.strip() else []
    known = sections("\n".join(lines))
    before = ORDER[: ORDER.index(path[0]) + 1] if path[0] in ORDER else ORDER
    kin = [s for s in known if s.path[0] == path[0]] or [s for s in known if s.path[0] in before]
    at = kin[-1].last if kin else len(lines)
    return "\n".join([*lines[:at], *([""] if at else []), *block, *lines[at:]]) + "\n"


ORDER = ("report", "mixture", "feeds", "units", "streams", "specifications", "prices", "fits")
"""In which the tables of a case are written."""


def with_value(text: str, path: tuple[str, ...], name: str, value: Any) -> str:
    """One value of a table set, the table made where there is none; a comment behind the value stays."""
    own = [s for s in sections(text) if s.path == path]
    try:
        document: Any = tomlkit.parse(text)
        place: Any = document
        for part in path:
            place = place.get(part)
            if place is None:
                return with_table(text, path, {name: value})
        if own and name not in place:
            lines = text.split("\n")
            at = own[0].last
            return "\n".join([*lines[:at], f"{key(name)} = {written(value)}", *lines[at:]])
        place[name] = item(value)
    except (TOMLKitError, TypeError, AttributeError) as problem:
        raise CaseError(
            _("[{place}] cannot be changed: {reason}.").format(place=".".join(path), reason=problem)
        ) from None
    return tomlkit.dumps(document)


def item(value: Any) -> Any:
    """A value as tomlkit holds it on one line."""
    return tomlkit.parse(f"v = {written(value)}")["v"]


def without_value(text: str, path: tuple[str, ...], name: str) -> str:
    """One value of a table taken out, and a list of streams that is then empty with it."""
    try:
        document: Any = tomlkit.parse(text)
        place: Any = document
        for part in path:
            place = place[part]
        if name not in place:
            return text
        nested = [s for s in sections(text) if s.path == (*path, name)]
        if nested:
            return without_table(text, (*path, name))
        del place[name]
    except (TOMLKitError, KeyError, TypeError, AttributeError) as problem:
        raise CaseError(
            _("[{place}] cannot be changed: {reason}.").format(place=".".join(path), reason=problem)
        ) from None
    return tomlkit.dumps(document)


def without_table(text: str, path: tuple[str, ...]) -> str:
    """A table and those below it taken out; comments before and after it stay."""
    found = [s for s in sections(text) if s.path[: len(path)] == path]
    if not found:
        return without_value(text, path[:-1], path[-1])
    lines = text.split("\n")
    for s in reversed(found):
        end = s.last
        if end < len(lines) and not lines[end].strip() and (s.first == 0 or not lines[s.first - 1].strip()):
            end += 1  # one blank line, not two
        del lines[s.first : end]
    return "\n".join(lines)


def renamed_table(text: str, path: tuple[str, ...], new: str) -> str:
    """A table under another name: its heading and those of the tables below it."""
    lines = text.split("\n")
    depth = len(path)
    found = [s for s in sections(text) if s.path[:depth] == path]
    if not found:
        raise CaseError(
            _("'{name}' is not written under a heading of its own; rename it in the case file.").format(
                name=".".join(path)
            )
        )
    for s in found:
        head = _HEAD.match(lines[s.first])
        comment = f"  {head[2]}" if head and head[2] else ""
        lines[s.first] = heading((*path[:-1], new, *s.path[depth:])) + comment
    return "\n".join(lines)


def checked(case: str) -> str:
    """The text, or a refusal where it can no longer be read (a table that was written in another manner than
    is known here).
    """
    try:
        read_toml(case)
    except InputError as problem:
        raise CaseError(
            _("This cannot be changed here; change it in the case file. {problem}").format(
                problem=problem.message
            )
        ) from None
    return case
