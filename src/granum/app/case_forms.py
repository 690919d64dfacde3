"""Case files for a page: read safely, shown as forms made from the declarations, edited without losing a
comment.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from granum.app.forms import card_form, entry
from granum.core import registry
from granum.core.errors import CaseError, GranumError, InputError
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter

FEED_KINDS = {
    "mass_flow": "MassFlow",
    "solids_mass_fraction": "MassFraction",
    "solid_flow": "MassFlow",
    "liquid_flow": "MassFlow",
    "gas_flow": "MassFlow",
    "relative_humidity": "Fraction",
    "temperature": "Temperature",
    "pressure": "Pressure",
}


def read_line(payload: Mapping[str, Any]) -> Any:
    """The line of ``{"case", "folder", "root"}``; files it names must lie inside the root."""
    from granum.cases.reading import parsed, read_text

    text = str(payload.get("case", ""))
    folder, root = payload.get("folder"), payload.get("root")
    for named in _files_in(parsed(text, "case")):
        try:
            inside = bool(root) and (Path(str(folder)) / named).resolve().is_relative_to(
                Path(str(root)).resolve()
            )
        except (OSError, ValueError):
            inside = False
        if not inside:
            raise CaseError(
                _("The case names the file '{path}', which is not in the workspace.").format(path=named)
            )
    return read_text(text, folder=Path(str(folder)) if folder else None)


def _files_in(raw: Mapping[str, Any]) -> list[str]:
    """Files that a case names."""
    mixture, fits = raw.get("mixture"), raw.get("fits")
    named = mixture.get("materials", []) if isinstance(mixture, dict) else []
    tables = fits.values() if isinstance(fits, dict) else []
    data = [table.get("data") for table in tables if isinstance(table, dict)]
    return [
        str(name) for name in (*(named if isinstance(named, list) else [named]), *data) if name is not None
    ]


def line_form(case: str) -> dict[str, Any]:
    """Feeds and units of a case as forms."""
    from granum.cases.reading import parsed

    raw = parsed(case, "case")
    units, feeds = (found if isinstance(found := raw.get(name), dict) else {} for name in ("units", "feeds"))
    return {
        "units": {name: _unit(table) for name, table in units.items() if isinstance(table, dict)},
        "feeds": {name: _feed(table) for name, table in feeds.items() if isinstance(table, dict)},
    }


def _unit(table: Mapping[str, Any]) -> dict[str, Any]:
    try:
        card = registry.find(str(table.get("model", ""))).card
    except GranumError as fault:
        return {
            "model": str(table.get("model", "")),
            "title": "",
            "summary": fault.message,
            "parameters": [],
            "limits": [],
            "values": {},
        }
    form = card_form(card.key)
    return {
        "model": card.key,
        "title": form["title"],
        "summary": form["summary"],
        "parameters": form["parameters"],
        "limits": form["limits_shown"],
        "values": {p.name: case_value(table[p.name]) for p in card.parameters if p.name in table},
    }


def _feed(table: Mapping[str, Any]) -> dict[str, Any]:
    rows = []
    for name, kind in FEED_KINDS.items():
        if name in table or name in ("temperature", "pressure"):
            p = Parameter(name, KINDS[kind])
            default = {"temperature": 298.15, "pressure": 101325.0}.get(name)
            row = p.as_json() | {
                "required": default is None,
                "allowed": "",
                "source_range": "",
                "options": [],
                "symbol_shown": "",
                "example": None,
            }
            row["default_shown"] = None if default is None else entry(p, default)
            rows.append(row)
    return {
        "parameters": rows,
        "values": {name: case_value(table[name]) for name in FEED_KINDS if name in table},
    }


def case_value(value: Any) -> str:
    """A value of a case file as a form holds it."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, dict):
        return json.dumps(value, ensure_ascii=False, default=str)
    if isinstance(value, list):
        return (
            "; ".join(map(case_value, value))
            if any(isinstance(x, str) for x in value)
            else " ".join(map(str, value))
        )
    return str(value)


def edited(case: str, table: str, name: str, key: str, text: str) -> str:
    """The case with one value changed; empty text removes it. Everything else, comments included, stays as it
    was written.
    """
    import tomlkit
    from tomlkit.exceptions import TOMLKitError

    if table not in ("units", "feeds"):
        raise InputError(_("'{name}' cannot be edited here.").format(name=table))
    try:
        document = tomlkit.parse(case)
        place: Any = document[table]
        place = place[name]
        if text.strip():
            place[key] = _typed(text, place.get(key))
        elif key in place:
            del place[key]
        return tomlkit.dumps(document)
    except (TOMLKitError, KeyError, TypeError, AttributeError):
        raise CaseError(_("There is no '{name}' in the case.").format(name=f"{table}.{name}")) from None


def _typed(text: str, before: Any) -> Any:
    """Text of a form in the form it has in the file: a table, a number, yes or no, or text with its unit."""
    import tomlkit

    if text.lstrip().startswith("{"):
        try:
            table = json.loads(text)
        except (ValueError, RecursionError):
            raise InputError(_("'{name}' is not valid JSON.").format(name=text[:40])) from None
        made = tomlkit.inline_table()
        made.update(table)
        return made
    if isinstance(before, bool) and text in ("yes", "no"):
        return text == "yes"
    for read in (int, float):
        try:
            return read(text)
        except ValueError:
            continue
    return text
