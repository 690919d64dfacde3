"""``Utility``: what a piece of equipment takes from outside the process, declared on its class as its limits
are.

The name of a utility says what it is, by its glossary word, and what for or from which carrier, by the rest:
``electric_power_vacuum``, ``heat_input_steam``, ``cooling_input_chilled_water``, ``consumption_filter_aid``.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from granum.core.glossary import quantity_in
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter

ELECTRICITY, HEAT, COOLING, MATERIAL, AREA = (
    "electric_power",
    "heat_input",
    "cooling_input",
    "consumption",
    "area_installed",
)
SORTS = {ELECTRICITY: "Power", HEAT: "Power", COOLING: "Power", MATERIAL: "MassFlow", AREA: "AreaOrZero"}
"""The glossary word of each sort of utility, and the quantity it is."""


class Utility(NamedTuple):
    """Where the relation stands by which a unit knows what it takes.

    ``inlet``: the port whose stream brings it; a line then counts it only where that stream comes from
    outside the line, as another unit has paid for it elsewhere.
    """

    source: str
    inlet: str = ""


class Use(NamedTuple):
    """A utility as a card shows it."""

    parameter: Parameter
    utility: Utility

    def as_json(self) -> dict[str, Any]:
        """Stable plain data."""
        p = self.parameter
        return {
            "name": p.name,
            "label": p.label,
            "carrier": carrier(p.name),
            "unit": p.kind.unit if p.kind else "",
            "source": self.utility.source,
        }


def sort_of(name: str) -> str:
    """The glossary word that says what sort of utility a name is."""
    word = quantity_in(name) or ""
    if word not in SORTS:
        raise ValueError(f"'{name}' is no utility: it must begin with one of {', '.join(SORTS)}")
    return word


def purpose(name: str) -> str:
    """What it is for, or the carrier of heat.

    >>> purpose("electric_power_vacuum"), purpose("heat_input_steam")
    ('vacuum', 'steam')
    """
    return name[len(sort_of(name)) :].strip("_")


def carrier(name: str) -> str:
    """What is bought: electricity, a carrier of heat or cold, a material; ``area`` is not bought by time.

    >>> carrier("electric_power_vacuum"), carrier("cooling_input_chilled_water")
    ('electricity', 'chilled_water')
    """
    sort = sort_of(name)
    return "electricity" if sort == ELECTRICITY else "area" if sort == AREA else purpose(name)


def parameter(name: str) -> Parameter:
    """A utility as a quantity with its label and units."""
    return Parameter(name, KINDS[SORTS[sort_of(name)]])
