"""Words that a text field may hold, where they are a list that somebody knows: of the library, of a table, of
what a machine is fed with.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from granum.comminution.work_indices import work_indices
from granum.core.i18n import _, current_language
from granum.core.parameters import Parameter
from granum.core.words import plain
from granum.materials.brines import salts_of_pairs
from granum.materials.library import session
from granum.particles.sieves import sieve_table
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
# authors and standards among the words of a declared choice, which are written small
AUTHORS = frozenset(
    [
        "bingham",
        "bradley",
        "caurie",
        "chen",
        "cole",
        "demir",
        "durand",
        "freundlich",
        "halsey",
        "henderson",
        "hii",
        "hinkle",
        "langmuir",
        "lapple",
        "lewis",
        "matsumoto",
        "midilli",
        "mollier",
        "oswin",
        "page",
        "peleg",
        "rizk",
        "schade",
        "silva",
        "smith",
        "thompson",
        "tyler",
        "verma",
        "vesilind",
        "wasp",
        "weber",
        "weibull",
        "whiten",
        "wilson",
        "aghbashlo",
        "kuhn",
    ]
)
ENGLISH = {
    "astm e11": "ASTM E11",
    "bet": "BET",
    "chung pfost": "Chung–Pfost",
    "ferro fontan": "Ferro-Fontan",
    "fick simplified": "Fick, simplified",
    "gab": "GAB",
    "gates gaudin schuhmann": "Gates–Gaudin–Schuhmann",
    "gaudin meloy": "Gaudin–Meloy",
    "halsey modified": "Halsey, modified",
    "henderson modified": "Henderson, modified",
    "henderson pabis": "Henderson–Pabis",
    "henderson pabis modified": "Henderson–Pabis, modified",
    "herschel bulkley": "Herschel–Bulkley",
    "iglesias chirife": "Iglesias–Chirife",
    "iso565 r10": "ISO 565, series R10",
    "iso565 r20": "ISO 565, series R20",
    "iso565 r20 3": "ISO 565, series R20/3",
    "iso565 r40 3": "ISO 565, series R40/3",
    "konno saito": "Konno and Saito",
    "lewicki three": "Lewicki, three parameters",
    "lewicki two": "Lewicki, two parameters",
    "molerus hoffmann": "Molerus–Hoffmann",
    "morsi1972": "Morsi (1972)",
    "oswin modified": "Oswin, modified",
    "page modified": "Page, modified",
    "peterson whitby": "Peterson–Whitby",
    "richardson zaki": "Richardson–Zaki",
    "roos1971": "Roos (1971)",
    "rosin rammler": "Rosin–Rammler",
    "stairmand high efficiency": "Stairmand, high efficiency",
    "stairmand high throughput": "Stairmand, high throughput",
    "swift general purpose": "Swift, general purpose",
    "swift high efficiency": "Swift, high efficiency",
    "swift high throughput": "Swift, high throughput",
    "takacs": "Takács",
    "wang singh": "Wang–Singh",
    "weibull four": "Weibull, four parameters",
}
# phases of a mixture among whose species a machine's input names one
OF_MIXTURE = {
    "solid": ("solids",),
    "other_solid": ("solids",),
    "solid_solute_other": ("solids",),
    "solvent": ("liquids",),
    "second_solvent": ("liquids",),
    "impurity": ("liquids",),
    "pure_liquid": ("liquids",),
    "adsorbate": ("liquids", "gases"),
    "crystal": ("solids",),
    "first_salt": ("liquids",),
    "second_salt": ("liquids",),
}
PAIRED = ("first_salt", "second_salt", "third_salt")


def word_label(word: str) -> str:
    """A word of a declared choice as people read it.

    >>> word_label("konno_saito"), word_label("rizk"), word_label("pitched_blades")
    ('Konno and Saito', 'Rizk', 'pitched blades')
    """
    text = word.replace("_", " ")
    if current_language() != "en":
        return _(text)
    return ENGLISH.get(text) or (text.title() if text in AUTHORS else text)


def listed(p: Parameter, card: str = "") -> list[dict[str, str]]:
    """Names among which a text field chooses, with labels; none where any text may stand."""
    if p.sort is not str:
        return []
    if p.name in LIBRARY:
        return materials(session().names(LIBRARY[p.name]))
    if p.name in PAIRED:
        return materials(salts_of_pairs())
    if card in TABLES:
        return _sorted(
            (name, _(name) if session().label(name) == name else session().label(name))
            for name in TABLES[card]()
        )
    return []


def materials(names: Iterable[str]) -> list[dict[str, str]]:
    """Materials of the library by their names in the reader's language."""
    return _sorted((name, session().label(name)) for name in names)


def suggested(p: Parameter) -> list[dict[str, str]]:
    """Names that may stand in a text field, with what they are names of, where another field decides among
    them.
    """
    if p.name != "sieve_designation":
        return []
    return [
        {"value": name, "label": word_label(series)}
        for series, sieves in sieve_table().items()
        for name in sieves
    ]


def choose_within(rows: Iterable[dict[str, Any]], mixture: Mapping[str, Any]) -> None:
    """Let the inputs of a machine, and those of a law by which a wash dissolves crystals, choose among the
    species of a mixture; such a law starts from the first of them.
    """
    for row in rows:
        row["options"] = row.get("options") or within(row, mixture)
        for law in row.get("laws", {}).values():
            if law["parameters"].keys() >= {"crystal", "solvent"}:
                choose_within(law["parameters"].values(), mixture)
        for option in row["options"]:
            table = json.loads(option.get("table", "{}"))
            if table.keys() >= {"crystal", "solvent"} and mixture.get("solids") and mixture.get("liquids"):
                solid, liquids = mixture["solids"][0], mixture["liquids"]
                own = {"crystal": solid, "solvent": next((n for n in liquids if n != solid), liquids[0])}
                option["table"] = json.dumps(table | own, ensure_ascii=False)


def within(row: Mapping[str, Any], mixture: Mapping[str, Any]) -> list[dict[str, str]]:
    """The species of a mixture that an input of a machine may name; none where it names no species."""
    if row.get("sort") != "str":
        return []
    phases = OF_MIXTURE.get(row["name"], ())
    return materials(dict.fromkeys(name for phase in phases for name in mixture.get(phase, ())))


def _sorted(named: Iterable[tuple[str, str]]) -> list[dict[str, str]]:
    """In the order of the alphabet, letters with accents beside those without."""
    return [{"value": name, "label": label} for name, label in sorted(named, key=lambda pair: plain(pair[1]))]
