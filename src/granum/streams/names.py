"""Units, streams and ports by name: a case file calls them in one language, pages, drawings and reports in
that of the reader.
"""

from __future__ import annotations

from functools import cache
from importlib.resources import files

import tomli

from granum.core.i18n import _, current_language

# where the bare word says something else in another place
PORTS = {"heavy": "heavy liquid", "light": "light liquid"}


@cache
def french() -> dict[str, str]:
    """French for the names of the shipped examples."""
    place = files("granum.streams") / "names_fr.toml"
    return tomli.loads(place.read_text(encoding="utf-8"))


def pretty(name: str) -> str:
    """A unit, a stream or an outlet as people read it; a name not known in their language stays.

    >>> from granum.core.i18n import language
    >>> pretty("hot_liquor"), pretty("hot_liquor.vapor_2")
    ('hot liquor', 'hot liquor · vapor 2')
    >>> with language("fr"):
    ...     pretty("hot_liquor"), pretty("dried_2"), pretty("broyeur_à_moi.product")
    ('liqueur chaude', 'séché 2', 'broyeur à moi · produit')
    """
    unit, dot, port = name.partition(".")
    return _called(unit) + (f" · {port_label(port)}" if dot else "")


def port_label(port: str) -> str:
    """The name of a port in the current language."""
    return _(PORTS.get(port, port.replace("_", " ")))


def _called(name: str) -> str:
    number = name[len(name.rstrip("0123456789")) :]
    word = name.removesuffix(f"_{number}")
    if current_language() == "fr" and word in french():
        return f"{french()[word]} {number}".strip()
    return name.replace("_", " ")
