"""Units, streams and ports by name: a case file calls them in one language, pages, drawings and reports in
that of the reader.
"""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files

import tomli

from granum.core.i18n import _, current_language
from granum.core.index import entries
from granum.materials.library import session

# where the bare word says something else in another place
PORTS = {"heavy": "heavy liquid", "light": "light liquid"}


@cache
def french() -> dict[str, str]:
    """French for the names of the shipped examples."""
    place = files("granum.streams") / "names_fr.toml"
    return tomli.loads(place.read_text(encoding="utf-8"))


@cache
def _machines() -> dict[str, str]:
    """French for the names of equipment, which a machine alone and a new unit of a line bear: their titles
    without what is added to them.
    """
    machines = (entry for entry in entries().values() if entry.sort == "equipment")
    titles = {machine.name: re.split(r" \(|, ", machine.french_title)[0] for machine in machines}
    return {name: title[:1].lower() + title[1:] for name, title in titles.items()}


def pretty(name: str) -> str:
    """A unit, a stream or an outlet as people read it; a name not known in their language stays.

    >>> from granum.core.i18n import language
    >>> pretty("hot_liquor"), pretty("hot_liquor.vapor_2")
    ('hot liquor', 'hot liquor · vapor 2')
    >>> with language("fr"):
    ...     pretty("hot_liquor"), pretty("dried_2"), pretty("broyeur_à_moi.product"), pretty("gravity_filter")
    ('liqueur chaude', 'séché 2', 'broyeur à moi · produit', 'filtre par gravité')
    """
    unit, dot, port = name.partition(".")
    return _called(unit) + (f" · {port_label(port)}" if dot else "")


def share_label(phase: str, species: str) -> str:
    """``Potassium nitrate in the liquid``."""
    return _("{species} in the {phase}").format(species=session().label(species), phase=_(phase))


def port_label(port: str) -> str:
    """The name of a port in the current language."""
    return _(PORTS.get(port, port.replace("_", " ")))


def _called(name: str) -> str:
    number = name[len(name.rstrip("0123456789")) :]
    word = name.removesuffix(f"_{number}")
    known = french().get(word) or _machines().get(word) if current_language() == "fr" else None
    if known:
        return f"{known} {number}".strip()
    return name.replace("_", " ")
