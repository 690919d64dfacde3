"""Substances of one's own as a form holds them: what is asked for, and what a case describes already."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from granum.app.forms import entry
from granum.cases.describing import (
    NEEDED,
    PROPERTIES,
    SORTS,
    WATER,
    described,
    likenesses,
    parameters_of_substance,
)
from granum.core.i18n import _
from granum.core.parameters import Parameter
from granum.materials.library import session


def form_row(p: Parameter) -> dict[str, Any]:
    """A parameter that belongs to no card, as a form holds it."""
    return p.as_json() | {
        "required": p.required or p.default is None,
        "allowed": "",
        "source_range": "",
        "options": [],
        "symbol_shown": "",
        "example": None,
        "default_shown": None if p.required or p.default is None else entry(p, p.default),
    }


def asked_of_substances() -> dict[str, Any]:
    """What a form asks of a substance by the part that it plays, and the solutes whose solutions it may be
    likened to.
    """
    alike = [{"value": name, "label": session().label(name)} for name in likenesses(WATER)]
    return {"rows": {part: _rows(part) for part in SORTS}, "alike": sorted(alike, key=lambda r: r["label"])}


def own_substances(raw: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The substances that a case describes, each with its form."""
    found = []
    for one in described(raw):
        rows = {row["name"]: row for row in _rows(_part(one["sort"]))}
        hidden = {*one["formulas"], *(k for k in rows if k.startswith("crystal_"))}
        if one["sort"] == "solute" and "solubility" not in one["values"]:
            hidden |= set(rows) - {"molar_mass"}
        found.append(
            {
                "sort": one["sort"],
                "name": one["name"],
                "rows": [row for key, row in rows.items() if key not in hidden],
                "values": {key: text for key, text in one["values"].items() if key in rows},
                "formulas": [rows[key]["label"] for key in one["formulas"]],
            }
        )
    return found


def _part(sort: str) -> str:
    return next(part for part, known in SORTS.items() if known == sort)


def _rows(part: str) -> list[dict[str, Any]]:
    """Rows by the keys of a materials file: what the part needs first."""
    labels = {
        "solubility": _("solubility, mass of solute in the saturated solution"),
        "heat_of_solution": _("heat of solution, negative where dissolving releases heat"),
        "temperature": _("temperatures of the solubility"),
    }
    rows = [
        form_row(p)
        | {"name": key, "required": p.required}
        | ({"label": labels[key]} if key in labels else {})
        for key, p in zip(PROPERTIES[SORTS[part]], parameters_of_substance(part), strict=True)
    ]
    return sorted(rows, key=lambda row: row["name"] not in NEEDED[part])
