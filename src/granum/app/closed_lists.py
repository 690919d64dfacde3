"""Words that a text field may hold, where they are a list that somebody knows: of the library, of a table, of
what a machine is fed with.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from granum.comminution.work_indices import work_indices
from granum.core.i18n import _
from granum.core.parameters import Parameter
from granum.core.words import plain
from granum.materials.library import session
from granum.streams.dusts import dusts

# sort of material, by what the input of a card is called
LIBRARY = {
    "system": "solute",
    "solute": "solute",
    "salt": "salt",
    "fluid": "fluid",
    "gas": "fluid",
    "vapor": "fluid",
}
TABLES: dict[str, Callable[[], Iterable[str]]] = {
    "comminution.work_index": work_indices,
    "dust.dust_explosibility": dusts,
}
# phases of a mixture among whose species a machine's input names one
OF_MIXTURE = {
    "solid": ("solids",),
    "other_solid": ("solids",),
    "solvent": ("liquids",),
    "second_solvent": ("liquids",),
    "impurity": ("liquids",),
    "pure_liquid": ("liquids",),
    "adsorbate": ("liquids", "gases"),
}


def listed(p: Parameter, card: str = "") -> list[dict[str, str]]:
    """Names among which a text field chooses, with labels; none where any text may stand."""
    if p.sort is not str:
        return []
    if p.name in LIBRARY:
        return materials(session().names(LIBRARY[p.name]))
    if card in TABLES:
        return _sorted(
            (name, _(name) if session().label(name) == name else session().label(name))
            for name in TABLES[card]()
        )
    return []


def materials(names: Iterable[str]) -> list[dict[str, str]]:
    """Materials of the library by their names in the reader's language."""
    return _sorted((name, session().label(name)) for name in names)


def within(row: Mapping[str, Any], mixture: Mapping[str, Any]) -> list[dict[str, str]]:
    """The species of a mixture that an input of a machine may name; none where it names no species."""
    if row.get("sort") != "str":
        return []
    phases = OF_MIXTURE.get(row["name"], ())
    return materials(dict.fromkeys(name for phase in phases for name in mixture.get(phase, ())))


def _sorted(named: Iterable[tuple[str, str]]) -> list[dict[str, str]]:
    """In the order of the alphabet, letters with accents beside those without."""
    return [{"value": name, "label": label} for name, label in sorted(named, key=lambda pair: plain(pair[1]))]
