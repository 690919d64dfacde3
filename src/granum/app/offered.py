"""The substances that a page offers for a line, and the refusal of a name that is not among them: in words of
the field where it was typed.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from granum.app.own_substances import asked_of_substances
from granum.cases.building import BEGINNINGS
from granum.cases.outline import table_of
from granum.cases.reading import knowing_own, parsed
from granum.cases.starting import crystals_of, listed
from granum.core.errors import InputError, nearest
from granum.core.i18n import _, current_language
from granum.core.words import plain
from granum.materials.library import session

SORTS = {"liquid": "fluid", "solute": "solute", "solid": "solid", "gas": "fluid"}
"""By field of a new line the sort of material that may stand there."""
LISTS = {"liquid": "liquids", "solute": "solutes", "solid": "solids", "gas": "gases"}
"""By field the list that it chooses from."""
PHASES = {"liquids": ("liquid", "solute"), "solids": ("solid",), "gases": ("gas",)}
"""By phase of a line the fields that its substances could have been typed in."""


def _complete(field: str, entry: Any) -> bool:
    """Whether the library has what a substance needs for the part it plays."""
    if field == "liquid":
        return entry.liquid_density is not None
    return field != "solid" or (entry.density is not None and entry.heat_capacity is not None)


def substances() -> dict[str, Any]:
    """What a line can be made of, by the part it plays, what each beginning asks for, and what is asked of a
    substance of one's own, in the current language.
    """
    return _substances(current_language())


@cache
def _substances(language: str) -> dict[str, Any]:
    known = session()

    def labelled(name: str, entry: Any) -> dict[str, Any]:
        return {"value": name, "label": entry.fr if language == "fr" and entry.fr else name}

    def ordered(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
        return sorted(rows, key=lambda row: plain(row["label"]))

    fluids, solids = known.entries("fluid"), known.entries("solid")
    solutes = [
        labelled(name.partition(" in ")[0], entry)
        | {
            "solvent": entry.solvent,
            "crystals": [branch.crystal for branch in entry.branches],
            "complete": entry.viscosity is not None
            and all(branch.heat_of_solution is not None for branch in entry.branches),
        }
        for name, entry in known.entries("solute").items()
    ]
    return {
        "beginnings": BEGINNINGS,
        "liquids": ordered([labelled(n, e) for n, e in fluids.items() if _complete("liquid", e)]),
        "solutes": ordered(solutes),
        "solids": ordered([labelled(n, e) for n, e in solids.items() if _complete("solid", e)]),
        "gases": ordered([labelled(n, e) for n, e in fluids.items()]),
        "own": asked_of_substances(),
    }


def require_offered(operation: str, case: str, arguments: Mapping[str, Any]) -> None:
    """Refuses a substance that neither the library nor the case knows, where a line begins or is given other
    substances.
    """
    if operation == "begin":
        fields = BEGINNINGS.get(str(arguments.get("enters")), ())
        given = {name: str(arguments[name]).strip() for name in fields if name in arguments}
        with knowing_own(parsed(str(arguments.get("own", "")), "case")):
            refused = [problem for field, text in given.items() if (problem := _refused(text, field))]
            if refused:
                first, *others = refused
                beside = {str(one.details["name"]): one.as_json() for one in others}
                raise InputError(first.message, **{**first.details, "beside": beside or None})
            if {"solute", "liquid"} <= set(given):
                _require_pair(given["solute"], given["liquid"])
    if operation == "choose_substances":
        raw = parsed(case, "case")
        mixture = table_of(raw, "mixture")
        with knowing_own(raw):
            for phase, fields in PHASES.items() if not mixture.get("materials") else ():
                for text in arguments.get(phase, ()):
                    if isinstance(text, str) and text not in listed(mixture, phase):
                        _require(text.strip(), fields, phase)


def _known(text: str, field: str) -> bool:
    found = session().called(text, SORTS[field])
    return found is not None and _complete(field, session().entry(SORTS[field], text)[1])


def _refused(text: str, field: str) -> InputError | None:
    """Why a text cannot stand in a field; None where it can."""
    try:
        _require(text, (field,), field)
    except InputError as problem:
        return problem
    return None


def _require(text: str, fields: tuple[str, ...], place: str) -> None:
    """Refuses what cannot stand in any of some fields; ``place`` is the field of the page to be marked."""
    if any(_known(text, field) for field in fields):
        return
    part = {
        "liquid": _("liquid"),
        "solute": _("dissolved in it"),
        "solid": _("solid"),
        "gas": _("gas"),
    }[fields[0]]
    rows = [row for field in fields for row in substances()[LISTS[field]]]
    labels = {word: row["label"] for row in rows for word in (row["value"], row["label"])}
    close = labels.get(nearest(text, labels, strict=True) or "")
    if not text:
        told = _("nothing is given.")
    elif any(session().called(text, sort) for sort in SORTS.values()):
        told = _("'{name}' is known, but not for this part.").format(name=session().label(text))
    else:
        told = _("'{name}' is not in the library.").format(name=text[:60])
    message = _("{unit}: {message}").format(unit=part[:1].upper() + part[1:], message=told)
    if close and text:
        message += " " + _("Did you mean '{close}'?").format(close=close)
    message += " " + _(
        "Choose one of the list ({count} substances), or describe it below by its constants."
    ).format(count=len({row["value"] for row in rows}))
    raise InputError(message, name=place, did_you_mean=close if text else None, as_it_is=True)


def _require_pair(solute: str, liquid: str) -> None:
    """Refuses a solute that nothing is known of in this liquid."""
    name, solvent = (session().called(x, sort) or x for x, sort in ((solute, "solute"), (liquid, "fluid")))
    name = name.partition(" in ")[0]
    if crystals_of(name, solvent):
        return
    known = sorted(
        {e.solvent for n, e in session().entries("solute").items() if n.partition(" in ")[0] == name}
    )
    raise InputError(
        _(
            "'{solute}' does not crystallize from '{solvent}', as far as the library knows; it does from: "
            "{known}. Choose another solute or liquid, or describe the solute below by its solubility."
        ).format(
            solute=session().label(name),
            solvent=session().label(solvent),
            known=", ".join(map(session().label, known)),
        ),
        name="solute",
        as_it_is=True,
    )
