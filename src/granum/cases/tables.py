"""Nested tables of a case: a value put where its dotted name says, and the tables written as TOML."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any


def put(table: dict[str, Any], name: str, value: Any) -> None:
    """Sets ``a.b`` inside nested tables; a law that has parameters as well is ``a = {law = …}``, and another
    law takes none of them.

    >>> sizes = {"law": "rosin_rammler", "size_modulus": "25 um"}
    >>> put(sizes, "law", "log_normal")
    >>> sizes
    {'law': 'log_normal'}
    """
    head, dot, rest = name.partition(".")
    if not dot:
        if head == "law" and table.get("law") != value:
            table.clear()
        there = table.get(head)
        if isinstance(there, dict) and isinstance(value, str) and there.get("law", value) == value:
            there["law"] = value
        elif isinstance(there, dict) and isinstance(value, str):
            table[head] = {"law": value}
        else:
            table[head] = value
        return
    inner = table.get(head, {})
    table[head] = inner if isinstance(inner, dict) else {"law": inner}
    put(table[head], rest, value)


def as_toml(value: Any) -> str:
    if isinstance(value, Mapping):
        return (
            "{ "
            + ", ".join(f"{json.dumps(str(k), ensure_ascii=False)} = {as_toml(v)}" for k, v in value.items())
            + " }"
            if value
            else "{}"
        )
    if isinstance(value, list):
        return "[" + ", ".join(map(as_toml, value)) + "]"
    return json.dumps(value, ensure_ascii=False)
